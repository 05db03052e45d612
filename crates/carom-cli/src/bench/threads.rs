//! Runs work on a given number of threads.

#[cfg(feature = "rayon")]
use std::num::NonZero;

/// Number of processors; 1 without the feature `rayon`.
#[cfg(feature = "rayon")]
pub fn most() -> usize {
    std::thread::available_parallelism().map_or(1, NonZero::get)
}

/// Number of processors; 1 without the feature `rayon`.
#[cfg(not(feature = "rayon"))]
pub fn most() -> usize {
    1
}

/// Runs `work` on `count` threads; on those of all processors if the threads cannot be started.
#[cfg(feature = "rayon")]
pub fn on<T: Send>(count: usize, work: impl FnOnce() -> T + Send) -> T {
    match rayon::ThreadPoolBuilder::new().num_threads(count).build() {
        Ok(pool) => pool.install(work),
        Err(_) => work(),
    }
}

/// Runs `work` on the current thread.
#[cfg(not(feature = "rayon"))]
pub fn on<T: Send>(_: usize, work: impl FnOnce() -> T + Send) -> T {
    work()
}
