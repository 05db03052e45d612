//! Reconstructs a step from its report: the flights and impacts that it consisted of.

use std::collections::{BTreeMap, VecDeque};

use glam::DVec3;

use super::coefficients::{RestitutionRates, restitution_of, sliding_of};
use super::cornered::CorneredFlight;
use super::curved::CurvedFlight;
use super::curves::Curves;
use super::departure::Departure;
use super::edge_passage::{Passage, Side};
use super::error::DerivativeError;
use super::group::{GroupSaltation, LooseContact};
use super::input_rates::InputChange;
use super::saltation::{Colliding, First, Saltation};
use super::start::{Flying, Held, ROUNDING, Start};
use super::supported::{Ending, Mode, Rates, SupportedFlight};
use super::tightening::Tightening;
use super::touched::touched;
use crate::detect::contact::Bodies;
use crate::detect::instant::Instant;
use crate::flight::Propagator;
use crate::id::SphereId;
use crate::report::{BodyPair, Impact};
use crate::respond;
use crate::rule::exact::{FlightLog, GroupImpact, HeldMotion, SupportChange};
use crate::rule::periodic;
use crate::system::System;
use crate::world::World;

/// An impact counts as plastic if its bodies part at less than this fraction of the speed that the coefficient of
/// restitution requires.
const NOTHING: f64 = 0.5;

/// A linear map of small changes of the motion of spheres.
#[derive(Debug, Clone)]
pub(super) enum Piece {
    /// Flight of the sphere with this index in the arrays of the world, for a time \[s\] at a drag rate \[1/s\].
    Flight {
        place: usize,
        time: f64,
        drag_rate: f64,
    },
    Supported(Box<SupportedFlight>),
    InputChange(Box<InputChange>),
    Curved(Box<CurvedFlight>),
    Tightening(Box<Tightening>),
    Cornered(Box<CorneredFlight>),
    Departure(Box<Departure>),
    Passage(Box<Passage>),
    Impact(Box<Saltation>),
    Group(Box<GroupSaltation>),
    Loose(Box<LooseContact>),
}

/// Reconstruction of a step from its report.
pub(super) struct Replay<'a> {
    pub start: Start,
    pub system: System<'a>,
    /// Time from the start of the derivatives to the start of the step \[s\].
    pub elapsed: f64,
    /// Changes of persistent contact during the step, by index of the sphere.
    pub changes: BTreeMap<usize, VecDeque<SupportChange>>,
    pub curves: Curves,
    /// Impacts of groups that are still to come, in order of time.
    pub groups: VecDeque<GroupImpact>,
    /// For each sphere on a curve, by index, the side of each edge of forces on which it flew last.
    pub sides: BTreeMap<usize, Vec<Side>>,
    pub pieces: Vec<Piece>,
    /// End of the step on the world's clock \[s\].
    pub end: f64,
}

impl Start {
    /// Returns the linear maps of the step that the world took, in order. `log` has the persistent contacts and
    /// the curved flights of the step, `elapsed` is the time from the start of the derivatives to the step \[s\].
    ///
    /// # Errors
    /// The part of the step that has no derivative.
    pub fn pieces(
        mut self,
        world: &World,
        log: FlightLog,
        elapsed: f64,
    ) -> Result<Vec<Piece>, DerivativeError> {
        let report = world.report();
        let Instant { system, motion, time: end } = world.now();
        self.add(&log.arrivals, &system);
        self.check(report, &system, end)?;
        let mut changes: BTreeMap<usize, VecDeque<SupportChange>> = BTreeMap::new();
        for change in log.supports {
            changes.entry(change.index as usize).or_default().push_back(change);
        }
        let curves = Curves::new(log.curves, [self.time, end]);
        let mut replay = Replay {
            start: self,
            system,
            elapsed,
            changes,
            curves,
            groups: log.groups.into(),
            sides: BTreeMap::new(),
            pieces: Vec::new(),
            end,
        };
        for group in &report.groups {
            let impact = &report.impacts[group.first];
            if let Some(it) = replay.group_of(report, group) {
                replay.collide_group(&it, group.law)?;
                continue;
            }
            if group.count > 1 {
                let time = replay.start.time + impact.time;
                return Err(DerivativeError::Simultaneous { sphere: second_of(impact), time });
            }
            replay.collide(impact)?;
        }
        for place in 0..motion.position.len() {
            replay.advance(place, f64::INFINITY)?;
            replay.fly(place, end - replay.start.time, None)?;
            let body = &replay.start.bodies[place];
            let period = replay.system.settings.boundary.period();
            let off = periodic::wrapped(motion.position[place] - body.position, period);
            if off.length() > body.tolerance {
                return Err(replay.lost(place));
            }
        }
        replay.add_loose_contacts(world);
        Ok(replay.pieces)
    }
}

impl Replay<'_> {
    /// Returns the error for a sphere whose motion has no known derivative.
    pub fn lost(&self, place: usize) -> DerivativeError {
        let sphere = self.start.ids[place];
        DerivativeError::PersistentContact { sphere, from: self.start.time, to: self.end }
    }

    /// Advances a sphere through its changes of persistent contact before a time since the start of the step \[s\].
    pub fn advance(&mut self, place: usize, time: f64) -> Result<(), DerivativeError> {
        while let Some(change) = self.next_change(place, |at| at < time) {
            let at = self.since_start(&change);
            let next = match change.held {
                Some(motion) => {
                    Some(self.held(place, &motion, at).ok_or_else(|| self.lost(place))?)
                }
                None => None,
            };
            let was_held = self.start.bodies[place].held.is_some();
            let begins = change.held.is_some_and(|motion| motion.is_old) || at == 0.0;
            match (was_held, next) {
                // The sphere comes onto a plane without an impact.
                (false, Some(_)) if !begins => return Err(self.lost(place)),
                _ => {}
            }
            self.fly(place, at, change.held.zip(next))?;
            if let Some((motion, held)) = change.held.zip(next) {
                self.hold(place, &motion, held)?;
            } else if was_held {
                let departure = self.departure(place, at)?;
                self.pieces.push(Piece::Departure(Box::new(departure)));
                self.start.bodies[place].held = None;
            }
        }
        Ok(())
    }

    /// Advances a sphere to a time since the start of the step \[s\]. `next` is its persistent contact from then
    /// on, if it changes.
    pub fn fly(
        &mut self,
        place: usize,
        time: f64,
        next: Option<(HeldMotion, Held)>,
    ) -> Result<(), DerivativeError> {
        if self.start.bodies[place].is_curved {
            return self.fly_on_curve(place, time);
        }
        let body = &mut self.start.bodies[place];
        let over = time - body.since;
        let turned = match body.held {
            None => {
                let drag_rate = body.linear.drag_rate;
                self.pieces.push(Piece::Flight { place, time: over, drag_rate });
                None
            }
            Some(held) => Some(self.fly_on_plane((place, held), over, next)?),
        };
        self.add_input_change(place, over);
        let body = &mut self.start.bodies[place];
        let linear = body.held.map_or(body.linear, |held| held.rates(body.linear).linear);
        let (position, velocity) = body.flight(linear).after(over);
        body.tolerance += ROUNDING * (position - body.position).length();
        (body.position, body.velocity, body.since) = (position, velocity, time);
        body.angular_velocity = turned.unwrap_or(body.angular_velocity);
        Ok(())
    }

    /// Adds the derivative of a flight of a length \[s\] by radius and mass, where forces depend on them.
    fn add_input_change(&mut self, place: usize, time: f64) {
        let Some(rates) = self.start.inputs.get(&place) else { return };
        let body = &self.start.bodies[place];
        let by = match body.held {
            None => rates.change(body.linear, body.velocity, time),
            // The flight on the plane counts that of the acceleration, and without friction drag acts along the plane.
            Some(held) => {
                let Some(rates) = rates.of_drag() else { return };
                let along = |it: DVec3| it - it.dot(held.normal) * held.normal;
                let linear = held.rates(body.linear).linear;
                rates.change(linear, body.velocity, time).map(|input| input.map(along))
            }
        };
        let change = InputChange { place, id: self.start.ids[place], by };
        self.pieces.push(Piece::InputChange(Box::new(change)));
    }

    /// Adds the derivative of a flight of a length \[s\] on the plane that supports a sphere. Returns the angular velocity
    /// at its end \[rad/s\].
    fn fly_on_plane(
        &mut self,
        (place, held): (usize, Held),
        over: f64,
        next: Option<(HeldMotion, Held)>,
    ) -> Result<DVec3, DerivativeError> {
        let body = &self.start.bodies[place];
        let Rates { linear, angular_acceleration } = held.rates(body.linear);
        let (_, velocity) = body.flight(linear).after(over);
        let angular_velocity = body.angular_velocity + over * angular_acceleration;
        if over > 0.0 {
            let piece = match self.corner_of(place, &held) {
                Some(corner) => {
                    let flight = corner.filter(|it| it.goes_on(next.map(|it| it.1)));
                    let flight = flight.ok_or_else(|| self.lost(place))?;
                    Piece::Cornered(Box::new(flight.over(over)))
                }
                None => {
                    let flight = self.supported(place, held, over, next);
                    let flight = flight.ok_or_else(|| self.lost(place))?;
                    let ends = [velocity - held.velocity, angular_velocity];
                    if !flight.is_that(linear.acceleration, ends) {
                        return Err(self.lost(place));
                    }
                    Piece::Supported(Box::new(flight))
                }
            };
            self.pieces.push(piece);
        }
        Ok(angular_velocity)
    }

    /// Returns the flight of a sphere on the plane that supports it, of a length \[s\]; `None` if its friction has
    /// no closed form.
    fn supported(
        &self,
        place: usize,
        held: Held,
        time: f64,
        next: Option<(HeldMotion, Held)>,
    ) -> Option<SupportedFlight> {
        let Flying { velocity, angular_velocity, .. } = self.start.bodies[place];
        let mut flight = self.flight_on(place, held, [velocity, angular_velocity]);
        (flight.time, flight.mode) = (time, flight.mode_of()?);
        let Some((motion, next)) = next else { return Some(flight) };
        if next.surface != held.surface
            && (next.collider != held.collider || (next.normal - held.normal).length() > ROUNDING)
        {
            return None;
        }
        if next.velocity != held.velocity || self.corner_of(place, &next).is_some() {
            return None;
        }
        let after = self.flight_on(place, next, [motion.velocity, motion.angular_velocity]);
        flight.ending = flight.ending_before(&after, after.mode_of()?);
        flight.after = after.rates()?;
        Some(flight)
    }

    /// Returns a flight of length zero on a plane, with these velocities.
    pub fn flight_on(
        &self,
        place: usize,
        held: Held,
        [velocity, angular_velocity]: [DVec3; 2],
    ) -> SupportedFlight {
        let Flying { linear, since, .. } = self.start.bodies[place];
        let bodies = Bodies::Surface { sphere: place as u32, surface: held.surface };
        let friction = respond::friction_of(bodies, &self.system);
        SupportedFlight {
            place,
            id: self.start.ids[place],
            collider: held.collider,
            normal: held.normal,
            radius: self.system.spheres.radius[place],
            inertia_factor: self.system.spheres.inertia_factor(place),
            velocity: velocity - held.velocity,
            angular_velocity,
            linear,
            by_inputs: self.start.inputs.get(&place).map_or([DVec3::ZERO; 2], |it| it.acceleration),
            sliding: sliding_of(&self.system, bodies),
            rolling: friction.rolling,
            spinning: friction.spinning,
            mode: Mode::Gliding,
            time: 0.0,
            began: self.elapsed + since,
            ending: Ending::Given,
            after: held.rates(linear),
        }
    }

    /// Returns the accelerations of a sphere with these velocities, in free flight or on a plane.
    pub fn rates_in(
        &self,
        place: usize,
        held: Option<(Held, [DVec3; 2])>,
    ) -> Result<Rates, DerivativeError> {
        let linear = self.start.bodies[place].linear;
        let free = Rates { linear, angular_acceleration: DVec3::ZERO };
        let Some((held, velocities)) = held else { return Ok(free) };
        if let Some(corner) = self.corner_of(place, &held) {
            return corner.map(|_| held.rates(linear)).ok_or_else(|| self.lost(place));
        }
        self.flight_on(place, held, velocities).rates().ok_or_else(|| self.lost(place))
    }

    /// Advances the spheres of an impact to its time, and applies the impact.
    fn collide(&mut self, impact: &Impact) -> Result<(), DerivativeError> {
        let places = self.start.places(impact);
        for &place in places.iter().flatten() {
            self.advance(place, impact.time)?;
            self.fly(place, impact.time, None)?;
        }
        let second = places[1].ok_or(DerivativeError::Changed)?;
        let mut afterwards: [Option<(HeldMotion, Held)>; 2] = [None; 2];
        if !self.changes.is_empty() {
            for (next, place) in afterwards.iter_mut().zip(places) {
                *next = place.map_or(Ok(None), |place| self.held_after(place, impact.time))?;
            }
        }
        let mut rates = [None; 2];
        for ((rates, place), next) in rates.iter_mut().zip(places).zip(&afterwards) {
            let Some(place) = place else { continue };
            let Flying { held, velocity, angular_velocity, .. } = self.start.bodies[place];
            let before = held.map(|held| (held, [velocity, angular_velocity]));
            let after =
                next.map(|(motion, held)| (held, [motion.velocity, motion.angular_velocity]));
            *rates = Some([self.rates_in(place, before)?, self.rates_in(place, after)?]);
        }
        let before = self.accelerations_on_curves(places);
        let saltation = self.saltation(impact, places, rates);
        let mut saltation = saltation.ok_or_else(|| self.lost(second))?;
        self.leave(&saltation);
        if !before.is_empty() {
            saltation.set_curved(&before, &self.accelerations_on_curves(places));
            before.iter().for_each(|&(place, _)| self.start.bodies[place].acceleration = None);
        }
        self.pieces.push(Piece::Impact(saltation));
        for (place, next) in places.into_iter().zip(afterwards) {
            let Some(place) = place else { continue };
            self.start.bodies[place].held = None;
            if let Some((motion, held)) = next {
                self.hold(place, &motion, held)?;
            }
        }
        Ok(())
    }

    /// Returns the derivative of an impact, with the accelerations of its spheres before and after; `None` if the
    /// spheres are not where the impact was.
    fn saltation(
        &mut self,
        impact: &Impact,
        places: [Option<usize>; 2],
        rates: [Option<[Rates; 2]>; 2],
    ) -> Option<Box<Saltation>> {
        let system = &self.system;
        let period = system.settings.boundary.period();
        let Impact { point, normal, .. } = *impact;
        let (bodies, ids) = (&mut self.start.bodies, &self.start.ids);
        let mut colliding = |place: usize, side: f64, rates: [Rates; 2]| {
            let touching = point + side * system.spheres.radius[place] * normal;
            let body = &mut bodies[place];
            let off = periodic::wrapped(touching - body.position, period);
            let is_there = off.length() <= body.tolerance;
            // Positions and velocities are those that the step had, so that no rounding accumulates.
            body.position += off;
            is_there.then(|| Colliding {
                position: touching,
                ..Colliding::of(system, (place, ids[place]), body, rates)
            })
        };
        let second_place = places[1]?;
        let second = colliding(second_place, 1.0, rates[1]?)?;
        let (first, bodies) = match (impact.between, places[0]) {
            (BodyPair::Collider { collider, .. }, _) => {
                let touched = touched(&self.start.colliders, (collider, impact), &second)?;
                let (surface, touched) = touched;
                let sphere = second_place as u32;
                (First::Surface(touched), Bodies::Surface { sphere, surface })
            }
            (_, Some(place)) => {
                let bodies = Bodies::pair([place as u32, second_place as u32]);
                (First::Sphere(colliding(place, -1.0, rates[0]?)?), bodies)
            }
            (_, None) => return None,
        };
        let mut restitution = restitution_of(system, bodies, impact.approach_speed);
        let asked = restitution.combined.value * impact.approach_speed + impact.kick;
        if impact.separation_speed < NOTHING * asked {
            restitution = RestitutionRates::default();
        }
        Some(Box::new(Saltation {
            first,
            second,
            normal,
            restitution,
            sliding: sliding_of(system, bodies),
            friction: respond::friction_of(bodies, system),
            kick: impact.kick,
            companions: Vec::new(),
            time: self.elapsed + impact.time,
        }))
    }

    /// Sets the motion of the spheres of an impact to that after it.
    fn leave(&mut self, saltation: &Saltation) {
        let outcome = saltation.outcome();
        let mut set = |place: usize, [velocity, angular_velocity]: [DVec3; 2]| {
            (self.start.bodies[place].velocity, self.start.bodies[place].angular_velocity) =
                (velocity, angular_velocity);
        };
        set(saltation.second.place, outcome[1]);
        if let First::Sphere(first) = &saltation.first {
            set(first.place, outcome[0]);
        }
    }
}

impl Piece {
    /// Returns the propagator of a flight.
    pub fn propagator(time: f64, drag_rate: f64) -> Propagator {
        Propagator::over(time, drag_rate)
    }
}

fn second_of(impact: &Impact) -> SphereId {
    match impact.between {
        BodyPair::Spheres(_, second) | BodyPair::Collider { sphere: second, .. } => second,
    }
}
