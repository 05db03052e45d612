//! Neighbours: which spheres and surfaces a sphere can meet before it leaves its neighbour region.
//!
//! Each sphere has a neighbour region, a box about a place where it was. It leaves the region by a cell
//! crossing, an event of its own, and gets another one; between such events the spheres near it stay
//! the same.
//!
//! A hierarchy of cell lists finds them. A level holds the spheres of one size class, and as visitors
//! all smaller ones; its cells are parts of those of the level above. Two spheres that can meet lie in
//! the same or in adjacent cells of the level of the larger one. As a rule the neighbour region of a
//! sphere is its cell, and the spheres in the cells around it may be met.
//!
//! Where spheres of one size are crowded, that would be many. There a neighbour region is a cube about
//! the sphere itself, and each has a list of the others that it can meet while both are in theirs
//! (Donev, Torquato and Stillinger, J. Comput. Phys. 202, 737 (2005)).
//!
//! In a periodic box positions are wrapped into the box, and each sphere has an image offset since its
//! flight began. On open axes the outermost cells, and the regions in them, reach to infinity, so
//! spheres may go anywhere.
//!
//! Neighbours decide only when a meeting is noticed, never its time: results do not depend on them.

mod buffer;
mod cells;
pub(crate) mod clearance;
mod contents;
mod grid;
mod hierarchy;
mod images;
mod level;
mod neighbour;
mod neighbour_lists;
mod paged_lists;
mod region;
mod sliding;
mod surfaces;

pub(super) use buffer::NeighbourBuffer;
pub(super) use contents::{Contents, SURFACES_PER_SPHERE};
pub(super) use grid::Layout;
pub(super) use hierarchy::Neighbours;
pub(super) use images::Images;
pub(crate) use neighbour::MAX_SPHERES;
pub(super) use neighbour::Neighbour;
pub(super) use region::Region;
pub(super) use sliding::Sliding;
