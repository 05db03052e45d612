//! Contacts at one instant: which bodies touch, and to what accuracy.

pub(crate) mod contact_scale;
mod gather;
mod group;
mod member;
mod planes;
mod ring;
mod separation;
mod touch;

pub(super) use gather::{gather, gather_cluster};
pub(super) use group::Group;
pub(super) use member::Member;
pub(super) use planes::{Corner, MOST_PLANES, Plane};
pub(super) use ring::{add_sides, closing_sides};
pub(super) use separation::{HoldingMesh, holding_mesh, touches_surface};
pub(super) use touch::Touch;
