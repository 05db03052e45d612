//! Values that all surfaces of a collider share.

use crate::id::ColliderId;

/// A value of the last collider, computed once for its surfaces in a row.
#[derive(Debug)]
pub(super) struct OfCollider<T>(Option<(ColliderId, T)>);

impl<T> Default for OfCollider<T> {
    fn default() -> Self {
        Self(None)
    }
}

impl<T: Copy> OfCollider<T> {
    /// Returns the value of a collider; computes it if the last one was of another collider.
    pub fn get(&mut self, collider: ColliderId, compute: impl FnOnce() -> T) -> T {
        match self.0 {
            Some((known, value)) if known == collider => value,
            _ => self.0.insert((collider, compute())).1,
        }
    }
}
