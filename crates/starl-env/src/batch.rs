//! Environments side by side.

use crate::judge::{Bench, Judge, JudgeError, Work};
use crate::scatter::{self, NoRoom, Region};
use crate::settings::{Settings, SettingsError};
use crate::world::{Common, Map, NotFinite, Room, Scratch, World};
use starl_core::{Obstacle, Point, Pose};
use starl_motion::State;
use starl_motion::proximity::Rays;
use std::sync::Arc;

/// Environments that step together.
#[derive(Debug)]
pub struct Batch {
    common: Common,
    worlds: Vec<World>,
    parallel: bool,
}

/// The outputs: arrays whose first dimensions are environments E and robots N, in row-major order.
pub struct Outputs<'a> {
    /// E, N, 6: x, y, z in metres, then yaw, pitch and roll in radians.
    pub poses: &'a mut [f64],
    /// E, N, 6: the velocity in the world frame, metres per second, then the rates of yaw, pitch and roll.
    pub velocities: &'a mut [f64],
    /// E, N: the first thing that the robot touched in the last action: -1 for nothing, below N another robot, from N
    /// on an obstacle.
    pub contacts: &'a mut [i32],
    /// E, N, rays: the distance from the body's edge to what the ray meets, metres; the range if it meets nothing.
    pub lidar: &'a mut [f64],
    /// E, N, N, numbers: the newest message by receiver and sender; 0 where none came.
    pub messages: &'a mut [f64],
    /// E, N, N: how many actions ago that was sent; -1 where none came.
    pub ages: &'a mut [i32],
}

/// Where the expressions of a task find and put numbers: arrays in row-major order.
pub struct Verdicts<'a> {
    /// E, N, [`Judge::row`]: the task's own quantities.
    pub rows: &'a mut [f64],
    /// E, N, [`Judge::memory`]: what quantities were before. Nothing else writes it.
    pub memory: &'a mut [u64],
    /// E, N, rays, as in [`Outputs`].
    pub lidar: &'a [f64],
    /// E, N: the rewards of the last action.
    pub rewards: &'a mut [f64],
    /// E: whether the episode is terminated.
    pub terminated: &'a mut [bool],
    /// E, [`Judge::means`]: measures of the information, averaged over robots.
    pub information: &'a mut [f64],
}

impl Batch {
    /// Environments with seed 0, the robots of each in a row. Seed and place them before the first step.
    ///
    /// # Errors
    /// If a setting is out of its range.
    pub fn new(settings: Settings, environments: usize) -> Result<Batch, SettingsError> {
        settings.check()?;
        let common = Common {
            rays: settings
                .lidar
                .map(|lidar| Rays::even(lidar.rays, lidar.range)),
            map: Arc::new(Map::new(&settings.obstacles)),
            settings,
        };
        Ok(Batch {
            worlds: (0..environments).map(|_| World::new(&common)).collect(),
            common,
            parallel: false,
        })
    }

    /// Whether environments step in parallel, on the thread pool in which [`Batch::step`] is called. The results are
    /// the same either way. Without the feature `parallel` this does nothing.
    pub fn set_parallel(&mut self, parallel: bool) {
        self.parallel = parallel;
    }

    /// The settings of all environments.
    pub fn settings(&self) -> &Settings {
        &self.common.settings
    }

    /// The number of environments.
    pub fn environments(&self) -> usize {
        self.worlds.len()
    }

    /// A robot's true state.
    pub fn state(&self, environment: usize, robot: usize) -> &State {
        &self.worlds[environment].states[robot]
    }

    /// Restarts an environment's random streams.
    pub fn seed(&mut self, environment: usize, seed: u64) {
        self.worlds[environment].seed(seed);
    }

    /// The next number of the environment's random stream, uniform in [0, 1).
    pub fn draw(&mut self, environment: usize) -> f64 {
        self.worlds[environment].random.uniform()
    }

    /// Draws free places from the environment's random stream. Robots do not count as obstacles.
    ///
    /// # Errors
    /// If the region is too full.
    pub fn scatter(
        &mut self,
        environment: usize,
        region: &Region,
        places: &mut [Point],
    ) -> Result<(), NoRoom> {
        let World { random, map, .. } = &mut self.worlds[environment];
        scatter::scatter(random, &map.index, region, places)
    }

    /// Gives an environment these obstacles beside those of all environments.
    pub fn set_obstacles(&mut self, environment: usize, own: &[Obstacle]) {
        let world = &mut self.worlds[environment];
        world.map = match own.is_empty() {
            true => self.common.map.clone(),
            false => {
                let all = [self.common.settings.obstacles.as_slice(), own].concat();
                Arc::new(Map::new(&all))
            }
        };
    }

    /// Begins an episode of an environment, with its robots at rest at these poses, one for each robot.
    pub fn place(&mut self, environment: usize, poses: &[Pose]) {
        self.worlds[environment].place(&self.common, poses);
    }

    /// Carries out one action of every robot and writes the results. `actions` has the shape environments, robots,
    /// [`Settings::action_numbers`]; `messages` the shape environments, robots, [`Settings::message_numbers`].
    ///
    /// # Errors
    /// The first environment with a number that is not finite. It is unchanged; the others have stepped.
    pub fn step(
        &mut self,
        actions: &[f64],
        messages: &[f64],
        outputs: Outputs<'_>,
    ) -> Result<(), NotFinite> {
        let Batch {
            common,
            worlds,
            parallel,
        } = self;
        let settings = &common.settings;
        let row = settings.robots() * settings.action_numbers();
        let mail = settings.robots() * settings.message_numbers();
        let jobs = rooms(settings, worlds.len(), outputs).zip(worlds);
        let turn = |work: &mut Scratch, (index, (room, world)): (usize, (Room<'_>, &mut World))| {
            let actions = &actions[index * row..][..row];
            let messages = &messages[index * mail..][..mail];
            let result = world.act(common, actions, messages, work);
            world.show(common, room, work);
            result.err().map(|robot| NotFinite {
                environment: index,
                robot,
            })
        };
        run(*parallel, jobs, Scratch::default, turn).map_or(Ok(()), Err)
    }

    /// Evaluates the expressions of a task for all environments after an action, or for those that begin an episode.
    ///
    /// # Errors
    /// An expression of the first environment that cannot be evaluated; the others have been evaluated.
    pub fn judge(
        &mut self,
        judge: &Judge,
        begins: Option<&[bool]>,
        verdicts: Verdicts<'_>,
    ) -> Result<(), JudgeError> {
        let Batch {
            common,
            worlds,
            parallel,
        } = self;
        let robots = common.settings.robots();
        let mut rows = parts(verdicts.rows, robots * judge.row());
        let mut memory = parts(verdicts.memory, robots * judge.memory());
        let mut rewards = parts(verdicts.rewards, robots);
        let mut information = parts(verdicts.information, judge.means());
        let mut terminated = verdicts.terminated.iter_mut();
        let rays = robots * common.settings.rays();
        let jobs = worlds.iter_mut().enumerate().filter_map(|(index, world)| {
            let bench = Bench {
                rows: rows(),
                memory: memory(),
                lidar: &verdicts.lidar[index * rays..][..rays],
                rewards: rewards(),
                terminated: terminated.next()?,
                information: information(),
            };
            let is_new = begins.map(|begins| begins[index]);
            Some((bench, world, is_new))
        });
        let turn =
            |work: &mut Work, (index, job): (usize, (Bench<'_>, &mut World, Option<bool>))| {
                let (mut bench, world, is_new) = job;
                match is_new {
                    Some(false) => return None,
                    Some(true) => {
                        bench.rewards = &mut [];
                        bench.memory.fill(0);
                    }
                    None => {}
                }
                judge.evaluate(index, world, bench, work).err()
            };
        run(*parallel, jobs, || judge.work(), turn).map_or(Ok(()), Err)
    }

    /// Writes the results of some environments as they are now, without a step.
    pub fn show(&self, is_shown: impl Fn(usize) -> bool, outputs: Outputs<'_>) {
        let mut work = Scratch::default();
        let rooms = rooms(&self.common.settings, self.worlds.len(), outputs);
        for (index, (room, world)) in rooms.zip(&self.worlds).enumerate() {
            if is_shown(index) {
                world.show(&self.common, room, &mut work);
            }
        }
    }
}

/// Does a job for each environment with room for work, and returns the first error by environment.
fn run<J: Send, W, E: Send>(
    parallel: bool,
    jobs: impl Iterator<Item = J>,
    work: impl Fn() -> W + Sync + Send,
    turn: impl Fn(&mut W, (usize, J)) -> Option<E> + Sync + Send,
) -> Option<E> {
    let numbered = |work: &mut W, (index, job): (usize, J)| {
        let error = turn(work, (index, job));
        error.map(|error| (index, error))
    };
    #[cfg(feature = "parallel")]
    if parallel {
        use rayon::prelude::*;
        let jobs: Vec<_> = jobs.enumerate().collect();
        // Jobs are short, so that threads take several at once.
        let jobs = jobs.into_par_iter().with_min_len(8);
        let errors = jobs.map_init(work, numbered).flatten();
        return errors.min_by_key(|error| error.0).map(|error| error.1);
    }
    let _ = parallel;
    let mut work = work();
    let errors = jobs.enumerate().map(|job| numbered(&mut work, job));
    errors.fold(None, Option::or).map(|error| error.1)
}

/// The parts of the arrays by environment.
fn rooms<'a>(
    settings: &Settings,
    environments: usize,
    outputs: Outputs<'a>,
) -> impl Iterator<Item = Room<'a>> + use<'a> {
    let robots = settings.robots();
    let pairs = robots * robots * usize::from(settings.radio.is_some());
    let mut poses = parts(outputs.poses, robots * 6);
    let mut velocities = parts(outputs.velocities, robots * 6);
    let mut contacts = parts(outputs.contacts, robots);
    let mut lidar = parts(outputs.lidar, robots * settings.rays());
    let mut messages = parts(outputs.messages, pairs * settings.message_numbers());
    let mut ages = parts(outputs.ages, pairs);
    (0..environments).map(move |_| Room {
        poses: poses(),
        velocities: velocities(),
        contacts: contacts(),
        lidar: lidar(),
        messages: messages(),
        ages: ages(),
    })
}

/// Splits off one part of an array after another.
fn parts<'a, T>(mut rest: &'a mut [T], size: usize) -> impl FnMut() -> &'a mut [T] {
    move || {
        let (part, others) = std::mem::take(&mut rest).split_at_mut(size);
        rest = others;
        part
    }
}
