//! Independent work on many spheres: on all threads with the feature `rayon`, on one without it. The results are
//! the same to the last bit.

/// Below this number threads cost more than they help.
#[cfg(feature = "rayon")]
const FEW: usize = 512;

/// The results of `f` for 0, 1, ... below `count`, in this order. `f` gets working memory with arbitrary content.
#[cfg(feature = "rayon")]
pub(crate) fn map<M: Default, T: Send>(
    count: usize,
    f: impl Fn(&mut M, usize) -> T + Sync + Send,
) -> Vec<T> {
    use rayon::prelude::*;
    if count < 2 * FEW {
        return map_in_order(count, f);
    }
    (0..count).into_par_iter().with_min_len(FEW).map_init(M::default, f).collect()
}

/// Maps the numbers below `count` in their order, with working memory.
#[cfg(not(feature = "rayon"))]
pub(crate) fn map<M: Default, T: Send>(
    count: usize,
    f: impl Fn(&mut M, usize) -> T + Sync + Send,
) -> Vec<T> {
    map_in_order(count, f)
}

fn map_in_order<M: Default, T>(count: usize, f: impl Fn(&mut M, usize) -> T) -> Vec<T> {
    let mut memory = M::default();
    (0..count).map(|number| f(&mut memory, number)).collect()
}

/// Fills two arrays of one length, run by run; `f` gets the number of the first item of a run.
#[cfg(feature = "rayon")]
pub(crate) fn fill<A: Send, B: Send>(
    (first, second): (&mut [A], &mut [B]),
    f: impl Fn(usize, (&mut [A], &mut [B])) + Sync + Send,
) {
    use rayon::prelude::*;
    if first.len() < 2 * FEW {
        return f(0, (first, second));
    }
    let runs = first.par_chunks_mut(FEW).zip(second.par_chunks_mut(FEW)).enumerate();
    runs.for_each(|(number, run)| f(number * FEW, run));
}

/// Fills two arrays of one length, in one run.
#[cfg(not(feature = "rayon"))]
pub(crate) fn fill<A: Send, B: Send>(
    both: (&mut [A], &mut [B]),
    f: impl Fn(usize, (&mut [A], &mut [B])) + Sync + Send,
) {
    f(0, both);
}

/// Runs `work` on a number of `items` within the thread pool, so that its parallel parts need not wake threads.
#[cfg(feature = "rayon")]
pub(crate) fn among_threads<T: Send>(items: usize, work: impl FnOnce() -> T + Send) -> T {
    if items < 2 * FEW { work() } else { rayon::scope(|_| work()) }
}

/// Runs work on this thread.
#[cfg(not(feature = "rayon"))]
pub(crate) fn among_threads<T: Send>(_: usize, work: impl FnOnce() -> T + Send) -> T {
    work()
}

/// Returns how many threads there are for parallel work.
pub(crate) fn threads() -> usize {
    #[cfg(feature = "rayon")]
    return rayon::current_num_threads();
    #[cfg(not(feature = "rayon"))]
    return 1;
}

/// Runs independent tasks in parallel.
#[cfg(feature = "rayon")]
pub(crate) fn for_each<T: Send>(tasks: Vec<T>, f: impl Fn(T) + Sync + Send) {
    use rayon::prelude::*;
    if tasks.len() <= 1 {
        tasks.into_iter().for_each(f);
    } else {
        tasks.into_par_iter().for_each(f);
    }
}

/// Runs tasks in their order.
#[cfg(not(feature = "rayon"))]
pub(crate) fn for_each<T: Send>(tasks: Vec<T>, f: impl Fn(T) + Sync + Send) {
    tasks.into_iter().for_each(f);
}
