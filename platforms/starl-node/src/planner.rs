//! The thread that finds paths, so that a long search does not keep a robot from hearing its messages.

use starl_core::motion::Path;
use starl_host::{Hardware, PlanJob};
use starl_motion::Neighbour;
use std::io;
use std::sync::mpsc::{self, Sender};
use std::thread;

/// Jobs for the thread.
#[derive(Debug)]
pub struct Planner(Sender<(PlanJob, Vec<Neighbour>)>);

impl Planner {
    /// Starts the thread, which hands the number of each job and its path to `done`.
    ///
    /// # Errors
    /// If the system gives no thread.
    pub fn start(
        hardware: Hardware,
        mut done: impl FnMut(u32, Option<Path>) + Send + 'static,
    ) -> io::Result<Planner> {
        let (sender, jobs) = mpsc::channel::<(PlanJob, Vec<Neighbour>)>();
        thread::Builder::new()
            .name("planner".to_string())
            .spawn(move || {
                for (job, neighbours) in jobs {
                    done(job.job, job.run(&hardware, &neighbours));
                }
            })?;
        Ok(Planner(sender))
    }

    /// Finds a path.
    pub fn find(&self, job: PlanJob, neighbours: Vec<Neighbour>) {
        // The thread ends only with this end of the channel.
        let _ = self.0.send((job, neighbours));
    }
}
