//! When a contact begins.
//!
//! For spheres in free flight ([`Flight`](crate::Flight)) the time follows from the paths: in
//! closed form where there is one ([`sphere_sphere_linear`], half-spaces), by a search that
//! cannot step over a contact where there is none. For motion that is known only step by step,
//! [`bisect`] halves the interval.
//!
//! **Contact** means the same everywhere: the earliest time t >= 0, up to a horizon, at which the
//! distance d(t) of the surfaces is <= 0 and is about to fall: `d' < 0`, or `d' = 0` and
//! `d'' < 0`. So two bodies that touch and part, or touch at rest without pressing, are not in
//! contact, but their return is found; bodies that overlap and part are in contact once they
//! return or, should they turn before they are apart, where they turn. "Zero" is within the
//! rounding of the numbers that d and its derivatives are made of (`roundoff`).
//!
//! The formulas, and why nothing is missed, are in `docs/physics/contact-times.md`.

mod bisection;
#[cfg(test)]
mod claims;
mod driven;
mod feature;
mod growing;
mod half_space;
mod leaving;
mod nearest;
mod obstacle;
#[cfg(test)]
mod oracle;
mod path;
mod reach;
mod roundoff;
mod search;
mod sphere_sphere;
mod sphere_surface;
mod track;
mod turning;

pub use bisection::{Bisection, Probe, bisect};
pub use growing::sphere_sphere_growing;
pub(crate) use growing::{GrowingApproach, growing_sphere_surface};
pub use leaving::sphere_sphere_leaving;
pub(crate) use reach::Reach;
pub(crate) use sphere_sphere::Approach;
pub use sphere_sphere::{sphere_sphere, sphere_sphere_linear};
pub(crate) use sphere_surface::{sphere_surface, sphere_surface_in_reach};
pub(crate) use track::{PolynomialTrack, Track, track_surface, tracks};
