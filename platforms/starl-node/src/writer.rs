//! The thread that writes to storage, so that a slow disk does not keep a robot from hearing its messages.

use crate::Storage;
use starl_host::StoreJob;
use std::io;
use std::sync::mpsc::{self, Sender};
use std::thread;
use std::time::Duration;

/// A write that fails is tried again after this.
const RETRY: Duration = Duration::from_secs(1);

/// The result of a write.
#[derive(Debug)]
pub enum Written {
    /// It is on the disk.
    Done(u32),
    /// It failed, and is tried again.
    Failed(String),
}

/// Jobs for the thread.
#[derive(Debug)]
pub struct StorageWriter(Sender<StoreJob>);

impl StorageWriter {
    /// Starts the thread, which hands what comes of each job to `tell` until that returns false.
    ///
    /// # Errors
    /// If the system gives no thread.
    pub fn start(
        mut storage: Storage,
        mut tell: impl FnMut(Written) -> bool + Send + 'static,
    ) -> io::Result<StorageWriter> {
        let (sender, jobs) = mpsc::channel::<StoreJob>();
        thread::Builder::new()
            .name("storage".to_string())
            .spawn(move || {
                for StoreJob { job, saves } in jobs {
                    // Nothing that depends on the write leaves the robot before it is done.
                    while let Err(error) = storage.write(saves.clone()) {
                        if !tell(Written::Failed(error.to_string())) {
                            return;
                        }
                        thread::sleep(RETRY);
                    }
                    if !tell(Written::Done(job)) {
                        return;
                    }
                }
            })?;
        Ok(StorageWriter(sender))
    }

    /// Writes.
    pub fn write(&self, job: StoreJob) {
        // The thread ends only with this end of the channel.
        let _ = self.0.send(job);
    }
}
