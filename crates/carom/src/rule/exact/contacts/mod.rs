//! Contacts at one instant: which bodies touch, and to what accuracy.

mod curvature;
mod gather;
mod group;
mod member;
mod planes;
mod separation;
mod touch;

pub(crate) use curvature::{NormalCurvature, curvature_of};
pub(super) use gather::{gather, gather_cluster};
pub(super) use group::Group;
pub(super) use member::Member;
pub(super) use planes::{Corner, MOST_PLANES, Plane};
pub(super) use separation::{
    HoldingMesh, are_within, beyond, holding_mesh, is_over_face, separation, slack_of,
    touches_surface,
};
pub(super) use touch::Touch;
