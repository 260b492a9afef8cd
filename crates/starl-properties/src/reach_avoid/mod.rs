//! ReachAvoid's safety, goal and progress (thesis, section 3.2.1), judged by true positions.
//!
//! A command counts from its `start` to its `done`, `failed`, `give_up` or `stop`, or to the next
//! `start`. It is excused from the moment on at which its robot crashes or its program fails, its
//! motors stick, its sensors freeze or its variables are overwritten: the properties are promised for
//! actuators and positioning that work.

mod command;

use super::health::{Health, Needs};
use super::report::Report;
use super::track::{Tolerance, Track};
use super::{Checker, Excuse, Excused, Kinds, Setting, Violation};
use command::{Command, Phase};
use starl_core::event::{Event, ReachAvoidEvent};
use starl_core::motion::Body;
use starl_core::{Duration, Point, Port, Record, RobotId, Time};
use std::collections::VecDeque;

const SAFETY: &str = "reach_avoid.safety";
const GOAL: &str = "reach_avoid.goal";
const PROGRESS: &str = "reach_avoid.progress";

/// How far back the recent past reaches in which the robot has been at the target, at least.
const RECENT: Duration = Duration::from_seconds(1);

/// Watches every ReachAvoid of every robot.
#[derive(Clone, Debug)]
pub(super) struct ReachAvoid {
    bound: Duration,
    recent: Duration,
    tolerance: Tolerance,
    health: Health,
    robots: Vec<Watch>,
    /// When commands have to have ended: the time, whose they are, and when they started.
    deadlines: VecDeque<(Time, RobotId, Port, Time)>,
    excused: Excused,
}

/// One robot.
#[derive(Clone, Debug)]
struct Watch {
    body: Body,
    track: Track,
    /// At most one for each instance.
    commands: Vec<Command>,
}

impl ReachAvoid {
    pub fn new(setting: &Setting) -> ReachAvoid {
        let watch = |&body: &Body| Watch {
            body,
            track: Track::default(),
            commands: Vec::new(),
        };
        ReachAvoid {
            bound: setting.properties.progress_bound,
            recent: RECENT.max(setting.pose_period * 2),
            tolerance: Tolerance::new(setting, Duration::ZERO),
            health: Health::new(setting.bodies.len(), Needs::Moving, Duration::ZERO),
            robots: setting.bodies.iter().map(watch).collect(),
            deadlines: VecDeque::new(),
            excused: Excused::default(),
        }
    }

    fn moved(&mut self, at: Time, robot: RobotId, position: Point, found: &mut Vec<Violation>) {
        let Some(watch) = self.robots.get_mut(robot.index()) else {
            return;
        };
        watch.track.push(at, position);
        watch.track.forget_before(at - self.recent);
        for command in &mut watch.commands {
            let well = self.health.well_since(robot, command.started);
            match command.check_safety(at, robot, position) {
                Some(text) if well => found.push(Violation {
                    property: SAFETY.into(),
                    at,
                    robots: vec![robot],
                    text,
                }),
                Some(_) => self.excused.note(SAFETY, self.health.excuse(robot)),
                None => {}
            }
        }
        watch
            .commands
            .retain(|command| command.phase == Phase::Active);
    }

    fn reported(&mut self, report: &Report<'_, ReachAvoidEvent>, found: &mut Vec<Violation>) {
        let Report {
            at, robot, port, ..
        } = *report;
        let Some(watch) = self.robots.get_mut(robot.index()) else {
            return;
        };
        let active = |command: &Command| command.port == port && command.phase == Phase::Active;
        match report.event {
            ReachAvoidEvent::Start {
                target,
                vicinity,
                unsafe_set,
            } => {
                watch.commands.retain(|command| !active(command));
                let target = watch.body.reachable(*target);
                let command = Command::new((port, at), target, *vicinity, unsafe_set.clone());
                watch.commands.push(command);
                self.deadlines.push_back((at + self.bound, robot, port, at));
            }
            ReachAvoidEvent::Failed { .. } => {
                for command in watch.commands.iter_mut().filter(|command| active(command)) {
                    command.phase = Phase::Failed;
                }
            }
            ReachAvoidEvent::Done { .. } => {
                if let Some(index) = watch.commands.iter().position(active) {
                    let command = watch.commands.remove(index);
                    let well = self.health.well_since(robot, command.started);
                    match self.check_goal(robot, &command, at) {
                        Some(text) if well => found.push(Violation {
                            property: GOAL.into(),
                            at,
                            robots: vec![robot],
                            text,
                        }),
                        Some(_) => self.excused.note(GOAL, self.health.excuse(robot)),
                        None => {}
                    }
                }
            }
            ReachAvoidEvent::GiveUp { .. } | ReachAvoidEvent::Stop => {
                watch.commands.retain(|command| !active(command));
            }
            ReachAvoidEvent::Path { .. } | ReachAvoidEvent::Replan { .. } => {}
        }
    }

    /// The violation if a finished command has not brought its robot to the target.
    fn check_goal(&self, robot: RobotId, command: &Command, at: Time) -> Option<String> {
        let watch = &self.robots[robot.index()];
        let target = command.target;
        let distance = |position: Point| match watch.body.flies() {
            true => position.distance(target),
            false => position.planar_distance(target),
        };
        let mut nearest = f64::INFINITY;
        for sample in watch.track.between(at - self.recent, at) {
            let off = distance(sample.position);
            if off <= command.vicinity + self.tolerance.around(sample) {
                return None;
            }
            nearest = nearest.min(off);
        }
        nearest.is_finite().then(|| {
            format!(
                "robot {robot} reported that it had reached {target}, but had come no nearer than \
                 {nearest:.3} m in the last {}; the vicinity is {:.3} m",
                self.recent, command.vicinity,
            )
        })
    }

    fn check_progress(&mut self, now: Time, found: &mut Vec<Violation>) {
        while let Some(&(due, robot, port, started)) = self.deadlines.front()
            && due < now
        {
            self.deadlines.pop_front();
            let watch = &mut self.robots[robot.index()];
            let late = watch.commands.iter_mut().find(|command| {
                command.port == port
                    && command.started == started
                    && command.phase == Phase::Active
                    && !command.overdue
            });
            let Some(command) = late else { continue };
            command.overdue = true;
            if self.health.well_since(robot, started) {
                found.push(Violation {
                    property: PROGRESS.into(),
                    at: due,
                    robots: vec![robot],
                    text: format!(
                        "robot {robot} was sent to {} at {started} and was still under way {} later",
                        command.target, self.bound,
                    ),
                });
            } else {
                self.excused.note(PROGRESS, self.health.excuse(robot));
            }
        }
    }
}

impl Checker for ReachAvoid {
    fn properties(&self) -> &'static [&'static str] {
        &[SAFETY, GOAL, PROGRESS]
    }

    fn bears_missing_robots(&self) -> bool {
        true
    }

    fn heeds(&self) -> Kinds {
        // Missed deadlines are found at the next record of any kind.
        match self.deadlines.is_empty() {
            true => Kinds::REPORTS | Kinds::MOVED | Kinds::INTERVENTION,
            false => Kinds::ALL,
        }
    }

    fn needs(&self, property: &str) -> Kinds {
        match property {
            PROGRESS => Kinds::NONE,
            _ => Kinds::MOVED,
        }
    }

    fn is_owed(&self, property: &str) -> bool {
        property == PROGRESS
            && self.robots.iter().any(|watch| {
                let mut commands = watch.commands.iter();
                commands.any(|command| command.phase == Phase::Active && !command.overdue)
            })
    }

    fn excused(&self, property: &str) -> Vec<(Excuse, u64)> {
        self.excused.of(property)
    }

    fn observe(&mut self, record: &Record, violations: &mut Vec<Violation>) {
        self.check_progress(record.at, violations);
        match (&record.event, record.robot) {
            (Event::Moved(pose), Some(robot)) => {
                self.moved(record.at, robot, pose.position, violations);
            }
            (Event::Primitive { .. }, _) => {
                if let Some(report) = Report::of(record) {
                    self.reported(&report, violations);
                }
            }
            (Event::Fault(_) | Event::Failed(_) | Event::Intervention(_), _) => {
                self.health.observe(record);
            }
            _ => {}
        }
    }

    fn advance(&mut self, now: Time, violations: &mut Vec<Violation>) {
        self.check_progress(now, violations);
    }
}
