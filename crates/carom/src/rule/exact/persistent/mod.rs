//! Persistent contacts: contact forces, and the motion of spheres that they hold together.

mod accelerations;
mod correction;
pub(super) mod held_forces;
mod listing;
mod on_curves;
mod piece;
pub(super) mod piece_end;
pub(super) mod planar;
mod pushed_piece;
mod pushed_sphere;
mod pushed_spheres;
mod pushing_contact;
mod rolling;
mod rolling_over;
mod sliding;
pub(super) mod solve;
mod with_friction;

pub(super) use accelerations::{free_acceleration, is_back_within};
pub(super) use listing::list;
pub(super) use on_curves::flies_with;
pub(super) use solve::REST;

/// Friction acts at contacts whose motion has no closed form.
#[derive(Debug, Clone, Copy)]
pub(super) struct NoClosedForm;
