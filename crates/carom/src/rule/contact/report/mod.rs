//! Reports: impacts of a sub-step, contacts of a world, work of forces.

pub(crate) mod force_work;
pub(crate) mod impacts;
pub(crate) mod listing;
pub(crate) mod virial;
