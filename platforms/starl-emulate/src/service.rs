//! The thread of an emulated device.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::{self, JoinHandle};

/// A thread that checks every few milliseconds whether it must end. Dropping this ends it and waits for it.
#[derive(Debug)]
pub(crate) struct Service {
    stop: Arc<AtomicBool>,
    thread: Option<JoinHandle<()>>,
}

impl Service {
    /// Calls `turn` again and again until the service ends or `turn` fails.
    pub fn start(mut turn: impl FnMut() -> std::io::Result<()> + Send + 'static) -> Service {
        let stop = Arc::new(AtomicBool::new(false));
        let stopped = stop.clone();
        let thread = thread::spawn(
            move || {
                while !stopped.load(Ordering::Relaxed) && turn().is_ok() {}
            },
        );
        Service {
            stop,
            thread: Some(thread),
        }
    }

    /// Ends the thread now.
    pub fn end(&mut self) {
        self.stop.store(true, Ordering::Relaxed);
        if let Some(thread) = self.thread.take() {
            let _ = thread.join();
        }
    }
}

impl Drop for Service {
    fn drop(&mut self) {
        self.end();
    }
}
