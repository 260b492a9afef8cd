//! Where robots are, as plain numbers, now and at the moments of a run that were sampled.

use super::inspect::condition;
use starl_core::{Duration, Time};
use starl_sim::Run;
use std::collections::VecDeque;
use std::mem;

/// How many numbers there are for each robot.
pub const POSE_NUMBERS: usize = 11;

/// The limit of numbers in frames that are kept until they are taken; beyond it the oldest frames are dropped.
pub const MOST_FRAME_NUMBERS: usize = 20_000_000;

/// The numbers of a frame before those of its robots: its time and how many robots there are.
const HEAD: usize = 2;

/// The poses of all robots in the order of their numbers: the true x, y, z, yaw, pitch and roll; x, y, z and yaw as
/// the robot believes them; and its condition, 0 for running, 1 for finished, 2 for failed, 3 for down, 4 for left.
/// Metres and radians.
pub(super) fn poses(run: &Run) -> impl Iterator<Item = f64> {
    let simulation = run.simulation();
    simulation.robots().iter().flat_map(move |&robot| {
        let truth = simulation.state(robot).pose;
        let belief = simulation.estimate(robot).pose;
        let condition = match condition(run, robot) {
            "running" => 0.0,
            "finished" => 1.0,
            "failed" => 2.0,
            "down" => 3.0,
            _ => 4.0,
        };
        let numbers: [f64; POSE_NUMBERS] = [
            truth.position.x,
            truth.position.y,
            truth.position.z,
            truth.yaw,
            truth.pitch,
            truth.roll,
            belief.position.x,
            belief.position.y,
            belief.position.z,
            belief.yaw,
            condition,
        ];
        numbers
    })
}

/// Poses at moments of a run, the oldest first; each frame is its time in seconds, how many robots there are, and
/// their [`poses`].
#[derive(Clone, Default)]
pub(super) struct Frames(VecDeque<f64>);

impl Frames {
    /// Keeps the present moment if the step that ended in it reached or passed a multiple of `period`.
    pub fn sample(&mut self, run: &Run, before: Time, period: Duration) {
        let simulation = run.simulation();
        let now = simulation.now();
        if now.0 / period.0 == before.0 / period.0 {
            return;
        }
        self.0
            .extend([now.seconds(), simulation.robots().len() as f64]);
        self.0.extend(poses(run));
        self.drop_oldest(MOST_FRAME_NUMBERS);
    }

    /// Drops the oldest frames until no more than `most` numbers are left.
    fn drop_oldest(&mut self, most: usize) {
        while self.0.len() > most {
            let robots = self.0[1] as usize;
            self.0.drain(..HEAD + robots * POSE_NUMBERS);
        }
    }

    /// Takes all frames.
    pub fn take(&mut self) -> Vec<f64> {
        mem::take(&mut self.0).into()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A frame of robots that all stand at the origin.
    fn frame(seconds: f64, robots: usize) -> impl Iterator<Item = f64> {
        let head = [seconds, robots as f64];
        head.into_iter().chain([0.0; POSE_NUMBERS].repeat(robots))
    }

    #[test]
    fn the_oldest_frames_are_dropped_whole() {
        let mut frames = Frames::default();
        for (seconds, robots) in [(1.0, 1), (2.0, 2), (3.0, 3)] {
            frames.0.extend(frame(seconds, robots));
        }
        let two = 2 * HEAD + 5 * POSE_NUMBERS;
        frames.drop_oldest(two + HEAD + POSE_NUMBERS - 1);
        let left: Vec<f64> = frame(2.0, 2).chain(frame(3.0, 3)).collect();
        assert_eq!(left.len(), two);
        assert_eq!(frames.take(), left);
        assert!(frames.take().is_empty());
    }
}
