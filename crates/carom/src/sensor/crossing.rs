//! When a sphere in flight enters a trigger, and when it leaves it.

use glam::DVec3;

use super::FlightSegment;
use crate::collider_motion::Course;
use crate::contact_time::{self, Probe, bisect};
use crate::detect::{Separation, sphere_surface};
use crate::flight::Flight;
use crate::id::{ColliderId, SphereId};
use crate::norm::Norm;
use crate::report::SensorEvent;
use crate::surface::{Form, LastCarriage, Rectangle, SurfaceMotion};
use crate::system::System;

/// Distances below this part of the coordinates are rounding.
const ROUNDING: f64 = 32.0 * f64::EPSILON;
/// Close to the surface a search steps by at least this part of the segment, and by twice as much each time, so
/// that a path along the surface ends. What it misses is no deeper than a step is long.
const LEAST_STEP: f64 = 1e-12;
/// Largest number of steps of a search; oblique paths take some hundreds.
const MOST_STEPS: u32 = 1 << 16;
/// Halvings that use up the bits of a time.
const MOST_HALVINGS: u32 = 128;
/// Crossings of the plane of a rectangle that a search from behind states at.
const MOST_PASSES: u32 = 16;

/// A surface of a trigger, or its image.
#[derive(Debug, Clone, Copy)]
pub(super) struct Target {
    pub collider: ColliderId,
    pub surface: u32,
    /// Shift from the surface to its image \[m\].
    shift: DVec3,
}

impl Target {
    pub fn new(surface: u32, shift: DVec3, system: &System) -> Self {
        Self { collider: system.surfaces[surface as usize].collider, surface, shift }
    }
}

/// A sphere on a segment, and one trigger.
pub(super) struct Crossing<'a> {
    pub segment: &'a FlightSegment,
    pub targets: &'a [Target],
    pub system: &'a System<'a>,
    /// Time for which the system has the surfaces, on the world's clock \[s\].
    pub step_start: f64,
    /// Motion of the trigger when it was asked for last.
    pub last: &'a LastCarriage,
}

/// Depth and velocity of a sphere relative to a trigger at one time.
#[derive(Debug, Clone, Copy)]
struct TriggerState {
    separation: Separation,
    /// Distance to the outside \[m\]; negative outside.
    depth: f64,
    /// Speed towards the outside \[m/s\].
    opening: f64,
    /// Distance that counts as zero \[m\].
    rounding: f64,
}

impl Crossing<'_> {
    /// Whether the sphere is in the trigger at `time` \[s\]; at the surface it keeps the state `was_in`.
    pub fn is_in_at(&self, time: f64, was_in: bool) -> bool {
        self.state_at(time).is_some_and(|state| {
            if was_in { state.depth >= -state.rounding } else { state.depth > state.rounding }
        })
    }

    /// Time at which the sphere, outside at `now` \[s\], enters, up to the end of the segment.
    pub fn entry(&self, now: f64) -> Option<f64> {
        let times = self.targets.iter().filter_map(|target| self.entry_of(target, now));
        times.min_by(f64::total_cmp)
    }

    fn entry_of(&self, target: &Target, now: f64) -> Option<f64> {
        let (form, motion) = self.place(target, now);
        let track = self.segment.track_from(now, target.shift);
        let horizon = self.segment.to - now;
        let course = self.course(target, now);
        let meet = |form: &Form, radius: f64| {
            contact_time::track_surface(&track, radius, form, &motion, course.as_ref(), horizon)
        };
        let delay = match form {
            Form::Box(solid) => {
                let faces = solid.faces().into_iter().map(Form::Rectangle);
                faces.filter_map(|face| meet(&face, self.segment.radius)).min_by(f64::total_cmp)
            }
            Form::Rectangle(rectangle) => {
                let from_front = meet(&form, self.segment.radius).map(|delay| now + delay);
                let from_behind = self.entry_from_behind(target, &rectangle, now);
                return from_front.into_iter().chain(from_behind).min_by(f64::total_cmp);
            }
            _ => meet(&form, self.segment.radius),
        };
        delay.map(|delay| now + delay)
    }

    /// Time at which the centre moves from behind a rectangle to its front, so near that the sphere overlaps it.
    fn entry_from_behind(&self, target: &Target, rectangle: &Rectangle, now: f64) -> Option<f64> {
        let start = self.segment.flight_from(now).position - target.shift - rectangle.center;
        let mut from = now;
        if start.dot(rectangle.normal) >= 0.0 {
            return None;
        }
        for _ in 0..MOST_PASSES {
            let (form, motion) = self.place(target, from);
            let Form::Rectangle(Rectangle { center, normal, .. }) = form else { return None };
            let track = self.segment.track_from(from, target.shift);
            let front = Form::HalfSpace { point: center, normal: -normal };
            let horizon = self.segment.to - from;
            let course = self.course(target, from);
            let course = course.as_ref();
            let delay = contact_time::track_surface(&track, 0.0, &front, &motion, course, horizon)?;
            let time = from + delay;
            let (form, _) = self.place(target, time);
            let place = self.segment.flight_from(time).position - target.shift;
            let there = crate::detect::known_in_front(&form, place, self.segment.radius);
            if there.is_some_and(|it| it.distance < 0.0) {
                return Some(self.first_in_front(target, time));
            }
            from = time.max(from.next_up());
        }
        None
    }

    /// The first time from `time` \[s\] on at which the centre, about to reach the front of a rectangle, is in
    /// front in rounded numbers, too.
    fn first_in_front(&self, target: &Target, time: f64) -> f64 {
        let (mut time, mut step) = (time, time.next_up() - time);
        while time < self.segment.to && self.state_in(target, time).is_none() {
            (time, step) = ((time + step).min(self.segment.to), 2.0 * step);
        }
        time
    }

    /// Time at which the sphere, inside at `now` \[s\], leaves, up to the end of the segment.
    ///
    /// No way out is shorter than the depth, which bounds a step by the depth over the speed. Where the sphere
    /// comes out for sure within twice the time that it would take at its present rate, halving finds when.
    pub fn exit(&self, now: f64) -> Option<f64> {
        let to = self.segment.to;
        let speed = self.fastest(now);
        let mut least = LEAST_STEP * (to - now);
        let (mut before, mut time) = (now, now);
        for _ in 0..MOST_STEPS {
            let Some(state) = self.state_at(time) else { return Some(self.pin_down(before, time)) };
            if state.depth < -state.rounding {
                return Some(self.pin_down(before, time));
            }
            if time >= to || speed == 0.0 {
                return None;
            }
            let is_close = state.depth <= state.rounding;
            let after = (time + least).max(time.next_up()).min(to);
            let comes_out = is_close && state.opening > ROUNDING * speed;
            if comes_out && self.is_out_at(after) {
                return Some(self.pin_down(time, after));
            }
            let ahead = (time + 2.0 * state.depth.max(0.0) / state.opening).min(to);
            if state.opening > 0.0 && !is_close && self.is_out_at(ahead) {
                return Some(self.pin_down(time, ahead));
            }
            let step = (state.depth / speed).max(least);
            least = if is_close { 2.0 * least } else { LEAST_STEP * (to - now) };
            (before, time) = (time, (time + step).max(time.next_up()).min(to));
        }
        None
    }

    /// Whether the sphere is outside at `time` \[s\], beyond rounding.
    fn is_out_at(&self, time: f64) -> bool {
        self.state_at(time).is_none_or(|state| state.depth < 0.0)
    }

    /// The time \[s\] at which the sphere leaves, for a time when it is inside and a later one when it is outside.
    fn pin_down(&self, before: f64, after: f64) -> f64 {
        let mut latest = after;
        bisect(after - before, MOST_HALVINGS, |elapsed| {
            if self.is_out_at(before + elapsed) {
                latest = before + elapsed;
                Probe::After
            } else {
                Probe::Before
            }
        });
        latest
    }

    /// Depth and velocity of the sphere at `time` \[s\], by the surface in which it is deepest; `None` where it is
    /// on the side of all surfaces that nothing collides with.
    fn state_at(&self, time: f64) -> Option<TriggerState> {
        let states = self.targets.iter().filter_map(|target| self.state_in(target, time));
        states.max_by(|a, b| a.depth.total_cmp(&b.depth))
    }

    fn state_in(&self, target: &Target, time: f64) -> Option<TriggerState> {
        let (form, motion) = self.place(target, time);
        let Flight { position, velocity, .. } = self.segment.flight_from(time);
        let center = position - target.shift;
        let radius = self.segment.radius;
        let separation = sphere_surface(&form, center, radius)?;
        let relative = velocity - motion.velocity_at(separation.point);
        let (mut depth, mut opening) = (-separation.distance, relative.dot(separation.normal));
        if let Form::Rectangle(it) = form {
            // It is out, too, where its centre comes behind.
            let height = (center - it.center).dot(it.normal);
            if height < depth {
                (depth, opening) = (height, -relative.dot(it.normal));
            }
        }
        let flown = self.segment.farthest(time).norm();
        let size = form.coordinates() + self.segment.flight.position.norm() + target.shift.norm();
        let rounding = ROUNDING * (size + flown + radius);
        let point = separation.point + target.shift;
        Some(TriggerState {
            separation: Separation { point, ..separation },
            depth,
            opening,
            rounding,
        })
    }

    /// An upper bound of the speed of the sphere relative to the trigger from `now` to the end of the segment \[m/s\].
    fn fastest(&self, now: f64) -> f64 {
        let Flight { position, velocity, .. } = self.segment.flight_from(now);
        let h = self.segment.to - now;
        let own = velocity.norm() + h * self.segment.most_acceleration();
        let of_surface = |target: &Target| {
            let (_, motion) = self.place(target, now);
            let SurfaceMotion { origin, velocity, angular_velocity, .. } = motion;
            let bounds = self.course(target, now).map(|course| course.bounds(0.0, h));
            let (speed, spin) =
                bounds.map_or((velocity.norm(), angular_velocity.norm()), |it| (it.speed, it.spin));
            let reach = (position - target.shift - origin).norm() + h * (own + speed);
            speed + spin * (reach + self.segment.radius)
        };
        own + self.targets.iter().map(of_surface).fold(0.0, f64::max)
    }

    /// Returns the motion of a surface from `time` \[s\] on, if it is not steady.
    fn course(&self, target: &Target, time: f64) -> Option<Course> {
        self.system.surfaces[target.surface as usize].course_after(time - self.step_start)
    }

    /// Geometry and motion of a surface at `time` \[s\].
    fn place(&self, target: &Target, time: f64) -> (Form, SurfaceMotion) {
        self.last.after(&self.system.surfaces[target.surface as usize], time - self.step_start)
    }

    /// The event of an entry or an exit at `time` \[s\].
    pub fn event(
        &self,
        (sphere, collider): (SphereId, ColliderId),
        enters: bool,
        time: f64,
    ) -> SensorEvent {
        let flight = self.segment.flight_from(time);
        let Target { surface, .. } = self.targets[0];
        let state = self.state_at(time);
        let of_rectangle = || {
            let (form, _) = self.place(&self.targets[0], time);
            let center = flight.position - self.targets[0].shift;
            crate::detect::known_in_front(&form, center, self.segment.radius)
        };
        let separation = state.map(|state| state.separation).or_else(of_rectangle);
        let (point, normal) = separation.map_or((flight.position, DVec3::Y), |separation| {
            (separation.point, separation.normal)
        });
        let (_, motion) = self.system.surfaces[surface as usize].after(time - self.step_start);
        let speed = (flight.velocity - motion.velocity_at(point)).norm();
        SensorEvent { time: time - self.step_start, collider, sphere, enters, point, normal, speed }
    }
}
