//! The state that survives a restart, on robots with storage: the copies and promises, and the
//! crash vector.
//!
//! A robot that finds its own life on storage answers immediately, in the same life: all its acknowledgements
//! were on storage before others could see them. So does a robot with empty storage that never lost anything: no
//! robot has heard of it. A robot with lost storage enters like robots without storage, and saves nothing until
//! it is up.

use super::Register;
use super::entering::Standing;
use super::lives::FIRST;
use super::replica::Copy;
use alloc::format;
use alloc::vec::Vec;
use starl_core::{Robot, RobotId, message};

/// Under which the crash vector is saved, with the robot's own life.
const LIVES: &str = "lives";

/// Before the names of registers.
const COPY: char = '=';

impl Register {
    /// Takes up what storage holds, when the robot starts.
    pub(super) fn recall(&mut self, robot: &mut Robot<'_>) {
        let me = robot.id();
        let Some(saved) = robot.saved().filter(|_| self.is_member(robot, me)) else {
            return;
        };
        let (life, lives) = match saved.get::<(u64, Vec<(RobotId, u64)>)>(self.port, LIVES) {
            Some(found) => found,
            None if saved.is_whole() => (FIRST, Vec::new()),
            None => return,
        };
        for (robot, life) in lives {
            self.lives.learn(robot, life);
        }
        for (key, value) in saved.of(self.port) {
            if let Some(register) = key.strip_prefix(COPY)
                && let Some(copy) = message::decode::<Copy>(value)
            {
                self.replica.restore(register, copy);
            }
        }
        self.standing = Standing::Up(life);
        self.report_up(robot, life);
    }

    /// Saves changes.
    pub(super) fn save_changes(&mut self, robot: &mut Robot<'_>) {
        let Standing::Up(life) = self.standing else {
            return;
        };
        let port = self.port;
        self.replica.save_changed(|register, copy| {
            robot.save(port, format!("{COPY}{register}"), copy);
        });
        let lives = self.lives.fingerprint(life);
        if self.saved_lives != Some(lives) {
            self.saved_lives = Some(lives);
            robot.save(port, LIVES, &(life, self.lives.list()));
        }
    }
}
