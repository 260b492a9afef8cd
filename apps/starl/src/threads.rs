//! On how many threads robots step. The results are the same on any number.

use crate::failure::Failure;
use rayon::{ThreadPool, ThreadPoolBuilder};

/// Fleets up to this size step on one thread unless told otherwise: what they would gain from more
/// is lost again in handing work over.
const SMALL_FLEET: usize = 2_000;

/// How many threads to use.
pub fn count(asked: Option<u32>, robots: usize) -> usize {
    match asked {
        Some(threads) => threads as usize,
        None if robots <= SMALL_FLEET => 1,
        None => std::thread::available_parallelism().map_or(1, |cores| cores.get()),
    }
}

/// How many runs to do at once.
pub fn for_runs(asked: Option<u32>) -> usize {
    match asked {
        Some(threads) => threads as usize,
        None => std::thread::available_parallelism().map_or(1, |cores| cores.get()),
    }
}

/// Runs `job` with this number of threads.
pub fn with<T: Send>(threads: usize, job: impl FnOnce() -> T + Send) -> Result<T, Failure> {
    Ok(match pool(threads)? {
        Some(pool) => pool.install(job),
        None => job(),
    })
}

/// A pool of this number of threads; none for one thread, which exists already.
pub fn pool(threads: usize) -> Result<Option<ThreadPool>, Failure> {
    if threads <= 1 {
        return Ok(None);
    }
    let pool = ThreadPoolBuilder::new().num_threads(threads).build();
    pool.map(Some)
        .map_err(|error| Failure(format!("{threads} threads cannot be started: {error}")))
}
