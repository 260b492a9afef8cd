//! Work on the threads of the pool in which a search is called, with the feature `parallel`. Without it there is one
//! thread, and the results are the same.

/// Sharing work on fewer steps than this takes longer than it saves.
const FEWEST: usize = 1 << 9;

/// Whether work on so many steps is shared.
pub(crate) fn pays(steps: usize) -> bool {
    cfg!(feature = "parallel") && steps >= FEWEST
}

/// The results of both, on two threads perhaps.
#[cfg(feature = "parallel")]
pub(crate) fn both<A: Send, B: Send>(
    parallel: bool,
    one: impl FnOnce() -> A + Send,
    other: impl FnOnce() -> B + Send,
) -> (A, B) {
    match parallel {
        true => rayon::join(one, other),
        false => (one(), other()),
    }
}

/// The results of a function for each, in order.
#[cfg(feature = "parallel")]
pub(crate) fn each<J: Send, R: Send>(
    parallel: bool,
    jobs: Vec<J>,
    run: impl Fn(J) -> R + Send + Sync,
) -> Vec<R> {
    use rayon::iter::{IntoParallelIterator, ParallelIterator};
    match parallel {
        true => jobs.into_par_iter().map(run).collect(),
        false => jobs.into_iter().map(run).collect(),
    }
}

#[cfg(not(feature = "parallel"))]
pub(crate) fn both<A, B>(_: bool, one: impl FnOnce() -> A, other: impl FnOnce() -> B) -> (A, B) {
    (one(), other())
}

#[cfg(not(feature = "parallel"))]
pub(crate) fn each<J, R>(_: bool, jobs: Vec<J>, run: impl Fn(J) -> R) -> Vec<R> {
    jobs.into_iter().map(run).collect()
}
