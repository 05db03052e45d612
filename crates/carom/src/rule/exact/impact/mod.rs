//! Impacts: what happens when bodies meet, and what that changes.

mod account;
mod follow_up;
mod friction;
mod group;
mod kick;
mod pair;
mod single_sphere;
mod surface_contacts;

pub(super) use pair::answer_pair;
pub(super) use single_sphere::answer_single;
