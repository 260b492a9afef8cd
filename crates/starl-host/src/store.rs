//! Storage in memory for simulating hosts: its content, and the current write.

use crate::StoreJob;
use alloc::sync::Arc;
use starl_core::{Duration, Saved, Time};

/// The storage of one robot.
#[derive(Clone, Debug, Default)]
pub struct Store {
    saved: Arc<Saved>,
    /// The current write, and the time when it ends.
    writing: Option<(Time, StoreJob)>,
}

impl Store {
    /// Its current contents.
    pub fn saved(&self) -> Arc<Saved> {
        self.saved.clone()
    }

    /// Begins a write; a node requests one at a time.
    pub fn begin(&mut self, at: Time, job: StoreJob, write_time: Duration) {
        self.writing = Some((at + write_time, job));
    }

    /// When the write that is under way is done; [`Time::NEVER`] if none is.
    pub fn due(&self) -> Time {
        self.writing.as_ref().map_or(Time::NEVER, |(at, _)| *at)
    }

    /// The write that is under way is done; gives its number.
    pub fn finish(&mut self) -> Option<u32> {
        let (_, StoreJob { job, saves }) = self.writing.take()?;
        let saved = Arc::make_mut(&mut self.saved);
        saves.into_iter().for_each(|save| saved.apply(save));
        Some(job)
    }

    /// A crash undoes the write that is under way, and may erase everything.
    pub fn crash(&mut self, is_lost: bool) {
        self.writing = None;
        if is_lost {
            self.saved = Arc::new(Saved::lost());
        }
    }
}
