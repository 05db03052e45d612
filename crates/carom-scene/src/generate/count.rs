//! How many a generator may make.

use crate::error::Problem;
use crate::requirement::check;

/// More spheres than this in one generator are a slip of the keyboard, and would fill the memory
/// (about 1 GB for the world alone).
pub(super) const MOST_SPHERES: u64 = 10_000_000;

pub(super) fn check_spheres(count: u64, path: &str) -> Result<(), Problem> {
    check_count(count, (MOST_SPHERES, "spheres"), path)
}

pub(super) fn check_count(
    count: u64,
    (most, made): (u64, &str),
    path: &str,
) -> Result<(), Problem> {
    check((1..=most).contains(&count), path, || {
        format!("must make 1 to {most} {made}, not {count}")
    })
}
