//! Impacts: what happens when bodies meet, and what that changes.

mod account;
mod follow_up;
mod friction;
mod group;
mod growing;
mod kick;
mod pair;
mod single_sphere;
mod surface_contacts;

pub(super) use growing::{of_growing_sphere, of_growing_spheres};
pub(super) use pair::of_spheres;
pub(super) use single_sphere::of_sphere;
