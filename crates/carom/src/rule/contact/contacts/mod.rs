//! Contacts of spheres with each other and with surfaces, in the stages of a sub-step.

pub(crate) mod aim;
pub(crate) mod batch;
pub(crate) mod coulomb;
pub(crate) mod dormant;
pub(crate) mod gather;
pub(crate) mod images;
pub(crate) mod kernel;
pub(crate) mod materials;
pub(crate) mod passages;
pub(crate) mod surface_sweeps;
pub(crate) mod surfaces;
pub(crate) mod swept;
