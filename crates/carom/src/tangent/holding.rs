//! Planes that hold spheres, as the log of a step has them.

use glam::DVec3;

use super::error::DerivativeError;
use super::replay::Replay;
use super::start::{Held, Plane};
use crate::detect::sphere_surface;
use crate::rule::exact::{HeldMotion, NormalCurvature, SupportChange, curvature_of};
use crate::rule::periodic;

impl Replay<'_> {
    /// Removes and returns the next change of a sphere's persistent contact if `at` accepts its time since the
    /// start of the step \[s\]. Of several changes at one time it is the last.
    pub fn next_change(&mut self, place: usize, at: impl Fn(f64) -> bool) -> Option<SupportChange> {
        let times = [self.start.time, self.end];
        let changes = self.changes.get_mut(&place)?;
        let mut next = *changes.front().filter(|it| at(since(it, times)))?;
        let time = since(&next, times);
        while let Some(change) = changes.front().filter(|it| since(it, times) == time) {
            next = *change;
            changes.pop_front();
        }
        Some(next)
    }

    pub fn since_start(&self, change: &SupportChange) -> f64 {
        since(change, [self.start.time, self.end])
    }

    /// Returns the plane that holds a sphere at a time since the start of the step \[s\], of several the one that bears
    /// most; `None` if something else holds it.
    pub fn held(&self, place: usize, motion: &HeldMotion, at: f64) -> Option<Held> {
        let surfaces = motion.surfaces.iter().flatten();
        let planes = surfaces.map(|&it| self.held_by((place, motion), it, at));
        let planes: Option<Vec<Held>> = planes.collect();
        let planes = planes?;
        let mut all = [None; 3];
        for (slot, it) in all.iter_mut().zip(&planes) {
            let &Held { surface, collider, normal, .. } = it;
            *slot = Some(Plane { surface, collider, normal });
        }
        let moves = planes.iter().any(|it| it.velocity != DVec3::ZERO);
        if planes.len() > 1 && moves {
            return None;
        }
        let pull = self.start.bodies[place].linear.acceleration;
        let bearing = |it: &Held| -pull.dot(it.normal);
        let first = planes.into_iter().max_by(|a, b| bearing(a).total_cmp(&bearing(b)))?;
        Some(Held { planes: all, ..first })
    }

    /// Returns a surface as the plane that holds a sphere; `None` if it is none, turns, or changes its velocity.
    fn held_by(
        &self,
        (place, motion): (usize, &HeldMotion),
        surface: u32,
        at: f64,
    ) -> Option<Held> {
        let body = &self.start.bodies[place];
        let it = &self.start.colliders.surfaces()[surface as usize];
        let is_steady = it.course.is_none()
            && it.motion.drive.is_none()
            && it.motion.angular_velocity == DVec3::ZERO;
        // The air does not move with a surface.
        let is_dragged = body.linear.drag_rate > 0.0 && it.carries();
        if body.is_curved || !is_steady || is_dragged {
            return None;
        }
        let (form, surface_motion) = it.after(at);
        let separation = sphere_surface(&form, motion.position, self.system.spheres.radius[place])?;
        let normal = separation.normal;
        let belt = surface_motion.belt - surface_motion.belt.dot(normal) * normal;
        let velocity = surface_motion.velocity + belt;
        let beside = [motion.position, motion.velocity - surface_motion.velocity];
        let curvature = curvature_of(&form, beside, &separation);
        (curvature == NormalCurvature::Flat).then_some(Held {
            surface,
            collider: it.collider,
            normal,
            velocity,
            acceleration: motion.acceleration,
            angular_acceleration: motion.angular_acceleration,
            planes: [None; 3],
            has_others: motion.has_others,
            touches_spheres: motion.touches_spheres,
        })
    }

    /// Sets the motion of a sphere that a plane supports from now on.
    pub fn hold(
        &mut self,
        place: usize,
        motion: &HeldMotion,
        held: Held,
    ) -> Result<(), DerivativeError> {
        let period = self.system.settings.boundary.period();
        let body = &mut self.start.bodies[place];
        let off = periodic::wrapped(motion.position - body.position, period);
        body.position += off;
        body.velocity = motion.velocity;
        body.angular_velocity = motion.angular_velocity;
        body.held = Some(held);
        if off.length() > body.tolerance { Err(self.lost(place)) } else { Ok(()) }
    }

    /// Returns the persistent contact of a sphere after an impact at a time since the start of the step \[s\], if any.
    pub fn held_after(
        &mut self,
        place: usize,
        time: f64,
    ) -> Result<Option<(HeldMotion, Held)>, DerivativeError> {
        let motion = self.next_change(place, |at| at == time).and_then(|it| it.held);
        let Some(motion) = motion else { return Ok(None) };
        let held = self.held(place, &motion, time).ok_or_else(|| self.lost(place))?;
        Ok(Some((motion, held)))
    }
}

/// Returns the time of a change since the start of a step that lasts from `start` to `end` \[s\].
fn since(change: &SupportChange, [start, end]: [f64; 2]) -> f64 {
    (change.time - start).clamp(0.0, end - start)
}
