//! Features of surfaces: the part of a surface that has a sphere, how the normal turns there, and how long the sphere
//! stays.

mod curvature;
mod feature;
mod ring;
mod separation;
mod time_on;

pub(crate) use curvature::{NormalCurvature, curvature_of};
pub(crate) use feature::Feature;
pub(crate) use ring::{separation_from_side, side_of_ring};
pub(super) use separation::TOUCHING;
pub(crate) use separation::{are_within, beyond, has, is_above, is_over_face, is_part, separation};
pub(crate) use time_on::{time_on, time_on_curve};
