//! Reads what programs changed since the last step.

pub mod balls;
pub mod colliders;
pub mod forces;
pub mod gravity;
pub mod meshes;
mod places;
pub mod removed;
