//! Step rules: how the stages are put together to advance all spheres. One module per rule.

pub(crate) mod bisect;
pub(crate) mod discrete;
pub(crate) mod exact;
mod islands;

use islands::Islands;

use crate::detect::contact::Contact;
use crate::detect::contacts::Search;

/// Working memory of the rules, kept from step to step only to spare its allocation.
#[derive(Debug, Clone, Default)]
pub(crate) struct Scratch {
    near: Vec<u32>,
    search: Search,
    contacts: Vec<Contact>,
    islands: Islands,
    bisect: bisect::Buffers,
}
