//! Rewards, ends and measures of a task, as expressions of the StarL language.
//!
//! An expression is compiled once. After each action it is evaluated for each robot of each environment, on the true
//! quantities of its robots: environments are independent. `previous` has the values of a robot's quantities at the
//! previous evaluation.

mod host;
mod quantity;
mod wording;

use crate::world::World;
use host::EnvironmentHost;
use quantity::{Quantities, Scratch};
use starl_core::RobotId;
use starl_lang::machine::{Limits, Machine, Object, State, Workspace};
use thiserror::Error;
use wording::Expression;
pub use wording::{Column, Constant, Kind, Wording, WordingError};

/// The compiled expressions of a task.
#[derive(Debug)]
pub struct Judge {
    robots: usize,
    quantities: Quantities,
    /// The measures, each with the place of its numbers in a robot's row.
    measures: Vec<(usize, Expression)>,
    reward: Option<Expression>,
    terminated: Option<Expression>,
    information: Vec<Expression>,
    all: Object,
}

/// Where the expressions of one environment find and put numbers.
pub struct Bench<'a> {
    /// N, columns: the rows of robots.
    pub rows: &'a mut [f64],
    /// N, words of [`Judge::memory`]: what the quantities were before.
    pub memory: &'a mut [u64],
    /// N, rays.
    pub lidar: &'a [f64],
    /// N; empty in the first evaluation of an episode, which has no rewards.
    pub rewards: &'a mut [f64],
    /// Whether the episode is terminated.
    pub terminated: &'a mut bool,
    /// A mean for each expression of the information.
    pub information: &'a mut [f64],
}

/// An expression that cannot be evaluated.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("{part}: `{excerpt}` fails for robot {robot} in environment {environment}: {reason}")]
pub struct JudgeError {
    /// The environment.
    pub environment: usize,
    /// The robot in it.
    pub robot: usize,
    /// The part of the task.
    pub part: String,
    /// The part of its text that fails.
    pub excerpt: String,
    /// Why.
    pub reason: String,
}

/// Room for work, used over and over.
pub struct Work {
    workspace: Workspace,
    scratch: Scratch,
    values: Vec<[f64; 2]>,
}

impl Judge {
    /// Compiles the expressions of a task whose robots have these radii and greatest speeds.
    ///
    /// # Errors
    /// The first expression or name that is wrong, with all its problems.
    pub fn new(limits: &[(f64, f64)], wording: &Wording) -> Result<Judge, WordingError> {
        let program = wording.program()?;
        let compiled = |part: &str, text: &str, kind: Kind| {
            Expression::new(&program, part.to_string(), text, kind)
        };
        let mut place = 0;
        let mut measures = Vec::new();
        for column in &wording.columns {
            if let Some(text) = &column.text {
                let part = format!("measures[{:?}]", column.name);
                measures.push((place, compiled(&part, text, column.kind)?));
            }
            place += column.kind.width();
        }
        let one = |part: &str, text: &Option<String>, kind: Kind| {
            text.as_ref()
                .map(|text| compiled(part, text, kind))
                .transpose()
        };
        let reward = one("reward", &wording.reward, Kind::Float)?;
        let terminated = one("terminated", &wording.terminated, Kind::Bool)?;
        let information = wording.information.iter().map(|(name, text)| {
            let part = format!("information[{name:?}]");
            let truth = compiled(&part, text, Kind::Bool);
            truth.or_else(|_| compiled(&part, text, Kind::Float))
        });
        let information = information.collect::<Result<Vec<_>, _>>()?;
        let all = measures.iter().map(|(_, measure)| measure);
        let all: Vec<&Expression> = all
            .chain(&reward)
            .chain(&terminated)
            .chain(&information)
            .collect();
        Ok(Judge {
            robots: limits.len(),
            quantities: Quantities::new(limits, wording, &all),
            measures,
            reward,
            terminated,
            information,
            all: host::all(limits.len()),
        })
    }

    /// The words that a robot's memory takes.
    pub fn memory(&self) -> usize {
        self.quantities.memory()
    }

    /// The numbers that a robot's row takes.
    pub fn row(&self) -> usize {
        self.quantities.row()
    }

    /// The number of means.
    pub fn means(&self) -> usize {
        self.information.len()
    }

    /// Whether there is an expression for rewards.
    pub fn has_reward(&self) -> bool {
        self.reward.is_some()
    }

    /// Room for the work of one thread.
    pub fn work(&self) -> Work {
        Work {
            workspace: Workspace::new(),
            scratch: self.quantities.scratch(),
            values: Vec::new(),
        }
    }

    /// Evaluates all expressions of an environment.
    pub(crate) fn evaluate(
        &self,
        environment: usize,
        world: &World,
        bench: Bench<'_>,
        work: &mut Work,
    ) -> Result<(), JudgeError> {
        let Work {
            workspace,
            scratch,
            values,
        } = work;
        let rows = bench.rows;
        self.quantities
            .fill(world, rows, bench.memory, bench.lidar, scratch);
        for (place, measure) in &self.measures {
            values.clear();
            self.ask(environment, measure, scratch, workspace, |value| {
                values.push(value);
                true
            })?;
            let width = measure.kind.width();
            for (row, value) in rows.chunks_exact_mut(self.row()).zip(&*values) {
                row[*place..][..width].copy_from_slice(&value[..width]);
            }
            self.quantities.set_column(*place, values, scratch);
        }
        if let Some(reward) = &self.reward
            && !bench.rewards.is_empty()
        {
            let mut places = bench.rewards.iter_mut();
            self.ask(environment, reward, scratch, workspace, |value| {
                if let Some(place) = places.next() {
                    *place = value[0];
                }
                true
            })?;
        }
        if let Some(terminated) = &self.terminated {
            let mut all = true;
            self.ask(environment, terminated, scratch, workspace, |value| {
                all = value[0] != 0.0;
                all
            })?;
            *bench.terminated = all;
        }
        for (expression, mean) in self.information.iter().zip(bench.information) {
            let mut sum = 0.0;
            self.ask(environment, expression, scratch, workspace, |value| {
                sum += value[0];
                true
            })?;
            *mean = sum / self.robots as f64;
        }
        self.quantities.keep(scratch, bench.memory);
        Ok(())
    }

    /// Evaluates an expression for each robot in order, as long as the values are taken.
    fn ask(
        &self,
        environment: usize,
        expression: &Expression,
        scratch: &Scratch,
        workspace: &mut Workspace,
        mut take: impl FnMut([f64; 2]) -> bool,
    ) -> Result<(), JudgeError> {
        let mut host = EnvironmentHost {
            states: scratch.states(),
            all: &self.all,
        };
        let mut none = State::default(); // expressions read the states of robots
        let robots = self.robots as u64;
        let limits = Limits {
            fuel: FUEL * robots,
            ..Limits::default()
        };
        let program = &expression.program;
        let mut machine = Machine::new(program, &mut none, workspace, &mut host, limits);
        for robot in 0..robots {
            let value = match machine.call(expression.function, &[robot], &[]) {
                Ok((scalars, _)) => expression.kind.value(scalars),
                Err(error) => {
                    return Err(JudgeError {
                        environment,
                        robot: RobotId(robot as u32).index(),
                        part: expression.part.clone(),
                        excerpt: expression.excerpt(error.position).to_string(),
                        reason: error.fault.to_string(),
                    });
                }
            };
            if !take(value) {
                break;
            }
        }
        Ok(())
    }
}

/// The units of fuel that an expression may use for a robot: about as many instructions.
const FUEL: u64 = 100_000;

impl Kind {
    /// The numbers of a value of the machine.
    fn value(self, scalars: &[u64]) -> [f64; 2] {
        let float = |index: usize| f64::from_bits(scalars.get(index).copied().unwrap_or(0));
        match self {
            Kind::Bool => [f64::from(u8::from(scalars.first() == Some(&1))), 0.0],
            Kind::Float => [float(0), 0.0],
            Kind::Point => [float(0), float(1)],
        }
    }
}
