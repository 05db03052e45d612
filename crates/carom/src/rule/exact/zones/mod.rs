//! Stepped zones: how spheres come into one, what happens at its ticks, and how they leave it.
//!
//! Where impacts follow each other faster than they can be answered, the sub-steps of the rule `contact`
//! move the spheres, from tick to tick of the world's clock. Between ticks they fly straight, so that all
//! others meet them at the exact time. What meets one joins it.

pub(crate) mod budget;
mod changes;
pub(crate) mod frame_work;
mod join;
mod near;
mod tick;
mod waiting;
pub(crate) mod zone;

pub(super) use join::{make_zone, make_zone_about, meet};
pub(super) use near::find_near;
pub(super) use tick::{tick, write_velocities};
