//! Work spread over threads, with results on the calling thread.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{SyncSender, sync_channel};
use std::sync::{Mutex, PoisonError};
use std::thread;

/// Results that wait to be taken, a thread.
const MOST_WAITING: usize = 64;

/// Runs `work` for each of `items` on this number of threads, and passes each result to `take` on this thread, in no
/// defined order. Ends early when `stop` is set or `take` fails; work that has begun is finished and taken.
///
/// # Errors
/// The first error of `take`.
///
/// # Panics
/// If `work` panics.
pub fn spread<I: Send, T: Send, E>(
    threads: usize,
    items: impl Iterator<Item = I> + Send,
    stop: &AtomicBool,
    work: impl Fn(I) -> T + Sync,
    mut take: impl FnMut(T) -> Result<(), E>,
) -> Result<(), E> {
    let items = Mutex::new(items);
    let next = || {
        let mut items = items.lock().unwrap_or_else(PoisonError::into_inner);
        items.next()
    };
    let worker = |sender: SyncSender<T>| {
        while !stop.load(Ordering::Relaxed)
            && let Some(item) = next()
        {
            // After a failure no more results are taken.
            if sender.send(work(item)).is_err() {
                return;
            }
        }
    };
    thread::scope(|scope| {
        let (sender, results) = sync_channel(threads.max(1) * MOST_WAITING);
        let mut workers = Vec::new();
        for _ in 0..threads.max(1) {
            let (worker, sender) = (&worker, sender.clone());
            workers.push(scope.spawn(move || worker(sender)));
        }
        drop(sender);
        let taken = results.into_iter().try_for_each(&mut take);
        for worker in workers {
            // A bug of ours: it is reported as such.
            if let Err(panic) = worker.join() {
                std::panic::resume_unwind(panic);
            }
        }
        taken
    })
}
