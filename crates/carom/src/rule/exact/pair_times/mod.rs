//! Pair times: when spheres meet their neighbours.

mod kernel;
mod relative;
mod search;

pub(super) use search::{NearTest, Neighbourhood, PairSearch};
