//! GSD files with the schema of HOOMD-blue: `hoomd.rs` knows particles, `layout.rs` the file layer.
//!
//! Sources: "File layer" (version 2) and "HOOMD Schema" (version 1.4) of the documents of GSD,
//! <https://gsd.readthedocs.io>, M. Spellings, J. A. Anderson and others, Glotzer group.

mod chunk;
mod chunks;
mod hoomd;
mod layout;
mod reader;
mod writer;

pub(super) use reader::GsdReader;
pub(super) use writer::GsdWriter;
