//! Impacts: what happens when bodies meet, and what that changes.

mod account;
mod closings;
mod follow_up;
mod friction;
mod group;
mod group_log;
mod growing;
mod kick;
mod meeting;
mod pair;
mod sheared;
mod single_sphere;
mod surface_contacts;
mod well;

pub(super) use growing::{answer_growing_pair, answer_growing_single};
pub(super) use pair::answer_pair;
pub(super) use sheared::answer_sheared_pair;
pub(super) use single_sphere::answer_single;
pub(super) use well::{answer_at_edge, meet_at_edge};
