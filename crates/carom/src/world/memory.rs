//! Working memory of worlds.

use super::World;

impl World {
    /// Exchanges the working memory of steps with another world's. It changes no result: worlds that step one after the
    /// other in one thread can so use the same memory, which stays in the cache of the processor.
    pub fn swap_memory(&mut self, other: &mut Self) {
        std::mem::swap(&mut self.scratch, &mut other.scratch);
    }
}
