//! Step rules: how the stages are put together to advance all spheres. One module per rule.

pub(crate) mod bisect;
pub(crate) mod contact;
pub(crate) mod discrete;
pub(crate) mod exact;
mod islands;
pub(crate) mod periodic;
