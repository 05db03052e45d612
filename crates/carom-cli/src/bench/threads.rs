//! Work on so many threads.

#[cfg(feature = "rayon")]
use std::num::NonZero;

/// As many as there are processors; 1 without the feature `rayon`.
#[cfg(feature = "rayon")]
pub fn most() -> usize {
    std::thread::available_parallelism().map_or(1, NonZero::get)
}

/// As many as there are processors; 1 without the feature `rayon`.
#[cfg(not(feature = "rayon"))]
pub fn most() -> usize {
    1
}

/// Does work that so many threads share; those of all processors where they cannot be started.
#[cfg(feature = "rayon")]
pub fn on<T: Send>(count: usize, work: impl FnOnce() -> T + Send) -> T {
    match rayon::ThreadPoolBuilder::new().num_threads(count).build() {
        Ok(pool) => pool.install(work),
        Err(_) => work(),
    }
}

/// Does work on the one thread that there is.
#[cfg(not(feature = "rayon"))]
pub fn on<T: Send>(_: usize, work: impl FnOnce() -> T + Send) -> T {
    work()
}
