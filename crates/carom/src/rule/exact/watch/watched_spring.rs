//! The work of a spring along the flights of its ends.

use glam::DVec3;

use super::seen::Seen;
use crate::force_work::ForceWork;
use crate::forces::{Spring, SpringEnd};
use crate::integrate::gauss_legendre::integral;
use crate::settings::nearest_image;
use crate::system::System;

/// A spring whose ends are watched.
#[derive(Debug, Clone)]
pub(super) struct WatchedSpring {
    spring: Spring,
    /// Indices of the spheres at its ends.
    first: u32,
    second: Option<u32>,
    /// Time up to which its work is counted, on the world's clock \[s\].
    until: f64,
}

/// A spring over the offset of its ends \[m\].
struct Stretched {
    offset: DVec3,
    /// Velocities of the ends \[m/s\].
    velocities: [DVec3; 2],
}

impl WatchedSpring {
    /// A spring that is watched from `now` \[s\] on; `None` if one of its spheres is not in the world.
    pub fn of(spring: Spring, system: &System, now: f64) -> Option<Self> {
        let place = |id| system.spheres.id.binary_search(&id).ok().map(|it| it as u32);
        let second = match spring.to {
            SpringEnd::Sphere(id) => Some(place(id)?),
            SpringEnd::Point(_) => None,
        };
        Some(Self { spring, first: place(spring.sphere)?, second, until: now })
    }

    /// Indices of the spheres at its ends.
    pub fn ends(&self) -> impl Iterator<Item = u32> {
        [self.first].into_iter().chain(self.second)
    }

    /// Returns the work since the last call, up to `now` \[s\]: that of its damper, and what its held forces did
    /// beyond its own, without the work of the former.
    pub fn work_until(&mut self, now: f64, seen: &[Seen], system: &System) -> ForceWork {
        let range = [self.until, now];
        if now <= self.until {
            return ForceWork::default();
        }
        self.until = now;
        let ends = [Some(self.first), self.second].map(|end| end.map(|end| &seen[end as usize]));
        let period = system.settings.boundary.period();
        let at = |time: f64| self.stretched(ends, period, time);
        let mut work = ForceWork::default();
        if self.spring.damping > 0.0 {
            work.forces = integral(range, |time| self.damper_powers(&at(time)).iter().sum());
        }
        let are_held = ends.map(|end| end.is_some_and(|seen| seen.held_force.is_some()));
        if are_held == [false; 2] {
            return work;
        }
        // A held end gains what its force holds, and loses what the damper does, which is counted as if it acted.
        let damper_on_held = match self.spring.damping > 0.0 {
            true => integral(range, |time| sum_where(are_held, self.damper_powers(&at(time)))),
            false => 0.0,
        };
        let are_curved = ends.map(|end| end.is_some_and(|seen| seen.curve.is_some()));
        let on_curves = match are_curved == [false; 2] {
            true => 0.0,
            false => integral(range, |time| sum_where(are_curved, self.elastic_powers(&at(time)))),
        };
        let [before, after] = range.map(|time| self.spring.energy_over(at(time).offset));
        work.integration = after - before + on_curves - damper_on_held;
        work
    }

    fn stretched(
        &self,
        [first, second]: [Option<&Seen>; 2],
        period: DVec3,
        time: f64,
    ) -> Stretched {
        let state =
            |seen: Option<&Seen>| seen.map_or_else(Default::default, |it| it.state_at(time));
        let (from, velocity) = state(first);
        let (to, other) = match (second, self.spring.to) {
            (None, SpringEnd::Point(point)) => (point, DVec3::ZERO),
            _ => state(second),
        };
        Stretched { offset: nearest_image(to - from, period), velocities: [velocity, other] }
    }

    /// Power of the damper on each end \[W\].
    fn damper_powers(&self, at: &Stretched) -> [f64; 2] {
        powers(at, |offset, velocity| self.spring.damping_pull(offset, velocity))
    }

    /// Power of the spring without its damper on each end \[W\].
    fn elastic_powers(&self, at: &Stretched) -> [f64; 2] {
        let undamped = self.spring.with_damping(0.0);
        powers(at, |offset, velocity| undamped.pull(offset, velocity))
    }
}

/// Power on each end \[W\] of a pull over the offset of the ends \[m\] at their relative velocity \[m/s\].
fn powers(at: &Stretched, pull: impl Fn(DVec3, DVec3) -> DVec3) -> [f64; 2] {
    let [first, second] = at.velocities;
    let pull = pull(at.offset, second - first);
    [pull.dot(first), -pull.dot(second)]
}

/// The sum of those values whose flag is set.
fn sum_where(flags: [bool; 2], values: [f64; 2]) -> f64 {
    flags.into_iter().zip(values).filter(|it| it.0).map(|it| it.1).sum()
}
