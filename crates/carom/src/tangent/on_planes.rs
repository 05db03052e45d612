//! Reconstruction of the motion of a sphere that several planes hold, or that leaves a plane over its end.

use glam::DVec3;

use super::cornered::{CorneredFlight, Wall};
use super::departure::Departure;
use super::error::DerivativeError;
use super::replay::Replay;
use super::start::{Flying, Held, Plane, ROUNDING};
use crate::detect::contact::Bodies;
use crate::forces::LinearForce;
use crate::respond;
use crate::surface::Form;

/// Planes hold a sphere apart if the product of each normal and its part across the others is at least this: far above
/// rounding.
const APART: f64 = 1e-6;
/// A plane bears a sphere if its part of the acceleration is at least this part of the whole.
const BEARS: f64 = 1e-9;
/// Largest error of the acceleration as a part of that without contacts: rounding.
const SAME: f64 = 1e-9;

impl Replay<'_> {
    /// Returns the flight of a sphere, of length zero, unless one plane holds it alone; `None` inside if its derivative is
    /// not known.
    pub fn corner_of(&self, place: usize, held: &Held) -> Option<Option<CorneredFlight>> {
        if !held.has_others {
            return None;
        }
        let body = &self.start.bodies[place];
        let alone = self.flight_on(place, *held, [body.velocity, body.angular_velocity]);
        (!alone.is_alone(held.acceleration)).then(|| self.cornered(place, held))
    }

    /// Returns the flight, of length zero, of a sphere that several planes hold; `None` if its derivative is not known.
    fn cornered(&self, place: usize, held: &Held) -> Option<CorneredFlight> {
        let body = &self.start.bodies[place];
        let LinearForce { acceleration: free, drag_rate } = body.linear;
        if held.touches_spheres || drag_rate > 0.0 {
            return None;
        }
        let bears = |planes: &[Plane]| -> Option<Vec<Plane>> {
            let walls = walls_of(planes)?;
            let bears = |wall: &Wall| -wall.shift.dot(free) > BEARS * free.length();
            Some(planes.iter().zip(&walls).filter(|it| bears(it.1)).map(|it| *it.0).collect())
        };
        let all: Vec<Plane> = held.planes.into_iter().flatten().collect();
        let some = bears(&all)?;
        let bearing = bears(&some)?;
        let walls = walls_of(&bearing)?;
        let across = walls.iter().fold(free, |rest, it| rest - it.normal.dot(free) * it.shift);
        let is_that = (across - held.acceleration).length() <= SAME * free.length();
        (bearing.len() == some.len() && walls.len() > 1 && is_that).then_some(())?;
        let rubs = |it: &Plane| {
            let bodies = Bodies::Surface { sphere: place as u32, surface: it.surface };
            respond::friction_of(bodies, &self.system).acts()
        };
        (!all.iter().any(rubs)).then_some(())?;
        let inputs = self.start.inputs.get(&place);
        Some(CorneredFlight {
            place,
            id: self.start.ids[place],
            walls,
            by_inputs: inputs.map_or([DVec3::ZERO; 2], |it| it.acceleration),
            time: 0.0,
            began: self.elapsed + body.since,
        })
    }

    /// Returns the derivative of a sphere's leaving the plane that holds it at a time since the start of the step \[s\].
    pub fn departure(&self, place: usize, at: f64) -> Result<Departure, DerivativeError> {
        let body = &self.start.bodies[place];
        let held = body.held.ok_or_else(|| self.lost(place))?;
        let Flying { velocity, angular_velocity, .. } = *body;
        if self.corner_of(place, &held).is_some() {
            return Err(self.lost(place));
        }
        let outward = self.end_of_face(body, &held, at).ok_or_else(|| self.lost(place))?;
        let before = self.rates_in(place, Some((held, [velocity, angular_velocity])))?;
        let after = self.rates_in(place, None)?;
        let velocity = velocity - held.velocity;
        if velocity.dot(outward) <= ROUNDING * velocity.length() {
            return Err(self.lost(place));
        }
        Ok(Departure {
            place,
            id: self.start.ids[place],
            collider: held.collider,
            outward,
            velocity,
            lost: [
                before.linear.acceleration - after.linear.acceleration,
                before.angular_acceleration - after.angular_acceleration,
            ],
            time: self.elapsed + at,
        })
    }

    /// Returns the direction out of the face that holds a sphere, at whose end the sphere is; `None` if it is at none, or at
    /// a corner.
    fn end_of_face(&self, body: &Flying, held: &Held, at: f64) -> Option<DVec3> {
        let (form, _) = self.start.colliders.surfaces()[held.surface as usize].after(at);
        let is_at = |beyond: f64| beyond.abs() <= body.tolerance;
        match form {
            Form::Rectangle(it) => {
                let from = body.position - it.center;
                let ends = [(it.axis_x, it.half_x), (it.axis_z, it.half_z)];
                let mut ends = ends.into_iter().filter_map(|(axis, half)| {
                    let along = from.dot(axis);
                    is_at(along.abs() - half).then_some(along.signum() * axis)
                });
                let outward = ends.next()?;
                ends.next().is_none().then_some(outward)
            }
            Form::Band(it) => {
                let from = body.position - it.center;
                let along = from - from.dot(it.axis) * it.axis;
                let is_outer = is_at(along.length() - it.disc_radius()?);
                is_outer.then(|| along.normalize())
            }
            _ => None,
        }
    }
}

/// Returns planes with their shifts; `None` if these are not unique.
fn walls_of(planes: &[Plane]) -> Option<Vec<Wall>> {
    let wall = |(number, plane): (usize, &Plane)| {
        let mut others: Vec<DVec3> = Vec::new();
        let across = |normal: DVec3, others: &[DVec3]| {
            others.iter().fold(normal, |rest, it| rest - rest.dot(*it) * *it)
        };
        for (_, other) in planes.iter().enumerate().filter(|it| it.0 != number) {
            let rest = across(other.normal, &others);
            (rest.length() >= APART).then(|| others.push(rest.normalize()))?;
        }
        let own = across(plane.normal, &others);
        let size = own.dot(plane.normal);
        let (collider, normal) = (plane.collider, plane.normal);
        (size >= APART).then_some(Wall { collider, normal, shift: own / size })
    };
    planes.iter().enumerate().map(wall).collect()
}
