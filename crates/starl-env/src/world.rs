//! One environment: its robots, obstacles and messages, and what an action does.

use crate::post::Post;
use crate::settings::{Actions, Settings};
use starl_core::event::Hit;
use starl_core::geometry::ObstacleIndex;
use starl_core::motion::Estimate;
use starl_core::{Command, Duration, MotionRequest, Point, Pose, Random, RobotId, Time, random};
use starl_motion::contact::{self, Contact, Contacts, Motions, Parts};
use starl_motion::proximity::Rays;
use starl_motion::scene::{Grid, Scene};
use starl_motion::{Disturbance, Neighbour, Pilot, State};
use std::sync::Arc;
use thiserror::Error;

/// The purposes of random streams.
const PLACES: u64 = 1;
const MESSAGES: u64 = 2;

/// The constant data that environments share.
#[derive(Debug)]
pub struct Common {
    pub settings: Settings,
    pub rays: Option<Rays>,
    pub map: Arc<Map>,
}

/// Obstacles, with the numbers by which contacts name them.
#[derive(Debug)]
pub struct Map {
    pub index: ObstacleIndex,
    standing: Vec<u32>,
}

impl Map {
    pub fn new(obstacles: &[starl_core::Obstacle]) -> Map {
        Map {
            index: ObstacleIndex::new(obstacles),
            standing: (0..obstacles.len() as u32).collect(),
        }
    }
}

/// An environment.
#[derive(Clone, Debug)]
pub struct World {
    /// The environment's own stream.
    pub random: Random,
    seed: u64,
    episode: u64,
    /// Actions since the robots were placed.
    pub actions: u64,
    now: Time,
    pub map: Arc<Map>,
    pub states: Vec<State>,
    bodies: Vec<Neighbour>,
    grid: Grid,
    /// The first thing that each robot has touched in the action.
    pub touched: Vec<Option<Hit>>,
    /// Empty unless actions are waypoints.
    pilots: Vec<Pilot>,
    post: Option<Post>,
}

/// Room for work, used over and over.
#[derive(Default)]
pub struct Scratch {
    commands: Vec<Command>,
    predicted: Vec<State>,
    next: Vec<Point>,
    found: Vec<(RobotId, Contact)>,
    contacts: Contacts,
    nearby: Vec<Neighbour>,
}

/// Where an environment's part of the results goes.
pub struct Room<'a> {
    pub poses: &'a mut [f64],
    pub velocities: &'a mut [f64],
    pub contacts: &'a mut [i32],
    pub lidar: &'a mut [f64],
    pub messages: &'a mut [f64],
    pub ages: &'a mut [i32],
}

/// A number of an action is not finite.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[error("the action of robot {robot} in environment {environment} has a number that is not finite")]
pub struct NotFinite {
    /// The environment.
    pub environment: usize,
    /// The robot in it.
    pub robot: usize,
}

impl World {
    /// Robots in a row, to be placed before anything else.
    pub fn new(common: &Common) -> World {
        let settings = &common.settings;
        let robots = settings.robots();
        let mut world = World {
            random: Random::keyed(0, &[PLACES]),
            seed: 0,
            episode: 0,
            actions: 0,
            now: Time::ZERO,
            map: common.map.clone(),
            states: vec![State::default(); robots],
            bodies: Vec::with_capacity(robots),
            grid: Grid::default(),
            touched: vec![None; robots],
            pilots: Vec::new(),
            post: settings.radio.map(|radio| Post::new(&radio, robots)),
        };
        let mut x = 0.0;
        let row = settings.models.iter().map(|model| {
            let radius = model.body().radius;
            let place = Point::planar(x + radius, 0.0);
            x = place.x + 1.5 * radius;
            Pose::level(place, 0.0)
        });
        world.place(common, &row.collect::<Vec<_>>());
        world
    }

    /// Restarts the environment's random streams.
    pub fn seed(&mut self, seed: u64) {
        self.seed = seed;
        self.random = Random::keyed(seed, &[PLACES]);
        self.episode = 0;
    }

    /// Begins an episode with the robots at rest at these poses.
    pub fn place(&mut self, common: &Common, poses: &[Pose]) {
        let models = &common.settings.models;
        self.episode += 1;
        self.actions = 0;
        self.now = Time::ZERO;
        self.bodies.clear();
        self.pilots.clear();
        for ((model, state), &pose) in models.iter().zip(&mut self.states).zip(poses) {
            *state = model.at_rest(pose);
            let body = model.body();
            self.bodies.push(Neighbour {
                position: state.pose.position,
                velocity: Point::ZERO,
                radius: body.radius,
                height: body.height,
            });
            if let Actions::Waypoints { .. } = common.settings.actions {
                self.pilots.push(Pilot::new(model.as_ref(), None));
            }
        }
        self.grid.rebuild(&self.bodies, &[]);
        self.touched.fill(None);
        if let Some(post) = &mut self.post {
            post.clear();
        }
    }

    /// Carries out one action of each robot, `rows` with a row for each: the action, then its message.
    ///
    /// # Errors
    /// The robot whose row has a number that is not finite; the world is unchanged then.
    pub fn act(
        &mut self,
        common: &Common,
        actions: &[f64],
        messages: &[f64],
        work: &mut Scratch,
    ) -> Result<(), usize> {
        let settings = &common.settings;
        let (numbers, words) = (settings.action_numbers(), settings.message_numbers());
        let bad = |list: &[f64], row: usize| {
            let place = list.iter().position(|number| !number.is_finite());
            place.map(|place| place / row)
        };
        if let Some(robot) = bad(actions, numbers).or_else(|| bad(messages, words)) {
            return Err(robot);
        }
        if let (Some(post), Some(radio)) = (&mut self.post, &settings.radio) {
            let key = random::hash_key(self.seed, &[MESSAGES, self.episode]);
            post.send(radio, key, self.actions, &self.bodies, messages);
        }
        self.request(settings, actions, numbers, work);
        self.touched.fill(None);
        for _ in 0..settings.steps_per_action {
            self.step(common, work);
        }
        if let (Some(post), Some(radio)) = (&mut self.post, &settings.radio) {
            post.deliver(radio, self.actions, self.states.len());
        }
        self.actions += 1;
        Ok(())
    }

    /// Turns actions into commands, or into requests to pilots.
    fn request(
        &mut self,
        settings: &Settings,
        actions: &[f64],
        numbers: usize,
        work: &mut Scratch,
    ) {
        work.commands.clear();
        match settings.actions {
            Actions::Commands => {
                let rows = settings.models.iter().zip(actions.chunks_exact(numbers));
                let commands = rows.map(|(model, row)| model.command_of(row));
                work.commands.extend(commands);
            }
            Actions::Waypoints { reach } => {
                let rows = actions.chunks_exact(numbers).zip(&self.states);
                for (pilot, (row, state)) in self.pilots.iter_mut().zip(rows) {
                    let part = |which: usize| row.get(which).map_or(0.0, |n| n.clamp(-1.0, 1.0));
                    let way = Point::new(part(0), part(1), part(2)) * reach;
                    pilot.request(&MotionRequest::Track {
                        target: state.pose.position + way,
                        next: None,
                    });
                }
                work.commands.resize(self.states.len(), Command::Stop);
            }
        }
    }

    /// One physics step, as the simulator makes it.
    fn step(&mut self, common: &Common, work: &mut Scratch) {
        let settings = &common.settings;
        self.pilot(settings, work);
        let mut parts = Parts::of(settings.physics_step);
        loop {
            let bend = self.predict(settings, parts.length(), work);
            if settings.collisions && !parts.suits(bend) {
                continue;
            }
            self.advance(settings, work);
            if !parts.proceed() {
                break;
            }
        }
        self.now += settings.physics_step;
    }

    /// Predicts where robots are after a part of the step. Returns the greatest bend of a path, metres.
    fn predict(&mut self, settings: &Settings, part: Duration, work: &mut Scratch) -> f64 {
        work.predicted.clear();
        work.next.clear();
        let mut greatest: f64 = 0.0;
        for ((model, state), command) in
            settings.models.iter().zip(&self.states).zip(&work.commands)
        {
            let predicted = model.predict(state, command, &Disturbance::default(), part);
            let bend = contact::bend(state.pose.position, &predicted, part.seconds());
            greatest = greatest.max(bend);
            work.next.push(predicted.pose.position);
            work.predicted.push(predicted);
        }
        greatest
    }

    /// Moves robots to where they were predicted, or to where they touch something.
    fn advance(&mut self, settings: &Settings, work: &mut Scratch) {
        if settings.collisions {
            let scene = Scene {
                bodies: &self.bodies,
                grid: &self.grid,
                map: &self.map.index,
            };
            let motions = Motions::new(scene, &self.map.standing, &work.next);
            motions.first_contacts(self.grid.entries(), &mut work.found);
            work.contacts.settle(&motions, work.found.drain(..));
        }
        let mut is_moving = false;
        for (robot, state) in self.states.iter_mut().enumerate() {
            let contact = work.contacts.of(RobotId(robot as u32));
            is_moving |= work.next[robot] != state.pose.position;
            *state = work.predicted[robot];
            if let Some(Contact { impact, .. }) = contact {
                settings.models[robot].stop_at(state, impact.place);
            }
            self.bodies[robot].position = state.pose.position;
            self.bodies[robot].velocity = state.twist.linear;
            let touched = &mut self.touched[robot];
            *touched = touched.or(contact.map(|contact| contact.with));
        }
        if is_moving {
            self.grid.rebuild(&self.bodies, &[]);
        }
    }

    /// Lets pilots give the commands that track their waypoints.
    fn pilot(&mut self, settings: &Settings, work: &mut Scratch) {
        for (robot, pilot) in self.pilots.iter_mut().enumerate() {
            let State { pose, twist, .. } = self.states[robot];
            let at = self.now;
            let estimate = Estimate { pose, twist, at };
            let model = settings.models[robot].as_ref();
            // Only avoidance draws, which these pilots do not have.
            let mut random = self.random.clone();
            work.commands[robot] = pilot.command(model, &estimate, &[], &[], &mut random);
        }
    }

    /// Writes what robots see now.
    pub fn show(&self, common: &Common, room: Room<'_>, work: &mut Scratch) {
        let robots = self.states.len() as u32;
        let poses = room.poses.as_chunks_mut().0;
        let velocities = room.velocities.as_chunks_mut().0;
        for (state, (pose, velocity)) in self.states.iter().zip(poses.iter_mut().zip(velocities)) {
            let State { pose: p, twist, .. } = state;
            let (position, linear) = (p.position, twist.linear);
            *pose = [position.x, position.y, position.z, p.yaw, p.pitch, p.roll];
            *velocity = [
                linear.x,
                linear.y,
                linear.z,
                twist.yaw,
                twist.pitch,
                twist.roll,
            ];
        }
        for (shown, touched) in room.contacts.iter_mut().zip(&self.touched) {
            *shown = match touched {
                None => -1,
                Some(Hit::Robot(other)) => other.0 as i32,
                Some(Hit::Obstacle(index)) => (robots + index) as i32,
            };
        }
        if let Some(rays) = &common.rays {
            let scene = Scene {
                bodies: &self.bodies,
                grid: &self.grid,
                map: &self.map.index,
            };
            room.lidar.fill(rays.range);
            let rows = room.lidar.chunks_exact_mut(rays.bearings.len());
            for (robot, (row, state)) in rows.zip(&self.states).enumerate() {
                let meets = |ray: usize, distance: f64| row[ray] = distance;
                rays.measure(&scene, robot, state.pose.yaw, &mut work.nearby, meets);
            }
        }
        if let Some(post) = &self.post {
            // Ages count from the last action.
            post.show(self.actions.saturating_sub(1), room.messages, room.ages);
        }
    }
}
