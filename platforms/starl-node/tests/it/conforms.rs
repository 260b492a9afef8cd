//! The robots' loop passes the suite of all hosts, in virtual time: each life of a robot is a [`Core`] of its own, as
//! each life of a real robot is a process of its own.

use starl_core::event::{DropReason, Event};
use starl_core::motion::{Body, Path, Workspace};
use starl_core::{
    Command, Duration, Estimate, Pose, Random, Record, RobotId, Saved, Time, WayPoint,
};
use starl_host::hardware::Drive;
use starl_host::testing::conformance::{DELAY, Fleet, Host, Need, PERIOD, TICK, WRITE_TIME};
use starl_host::{Hardware, Observed, PlanJob, StoreJob};
use starl_motion::Neighbour;
use starl_motion::sensing::SensorSuite;
use starl_node::link::frame::Frame;
use starl_node::link::{Arrival, Channel, Member, Origin};
use starl_node::robot::{Core, Equipment, Incoming, Recorder, Setup};
use starl_node::writer::Written;
use starl_node::{Safety, Storage};
use std::cell::RefCell;
use std::path::PathBuf;
use std::rc::Rc;
use std::sync::Arc;
use std::sync::atomic::{AtomicU32, Ordering};
use std::time::Instant;

/// Robots, and the machine and the network around them.
struct Robots {
    fleet: Fleet,
    lives: Vec<Option<Core<Notes, Hands>>>,
    world: Rc<RefCell<World>>,
    storage: PathBuf,
    now: Time,
}

/// The pending inputs, and the record of events.
#[derive(Default)]
struct World {
    coming: Vec<(Time, RobotId, Coming)>,
    records: Vec<Record>,
    now: Time,
}

enum Coming {
    Packet(Member, Vec<u8>),
    Path(u32, Option<Path>),
    Write(StoreJob),
}

/// The equipment of a robot in virtual time.
struct Hands {
    id: RobotId,
    hardware: Hardware,
    saved: Option<Arc<Saved>>,
    world: Rc<RefCell<World>>,
}

/// Keeps the records of a robot.
struct Notes(RobotId, Rc<RefCell<World>>);

impl Recorder for Notes {
    fn record(&mut self, at: Time, event: Event) {
        let robot = Some(self.0);
        self.1
            .borrow_mut()
            .records
            .push(Record { at, robot, event });
    }

    fn observe(&mut self, _: Time, _: Observed<'_>) {}

    fn advance(&mut self, _: Time) {}

    fn notice(&mut self, _: Time, _: &str) {}
}

impl Hands {
    fn later(&self, after: Duration, to: RobotId, coming: Coming) {
        let mut world = self.world.borrow_mut();
        let at = world.now + after;
        world.coming.push((at, to, coming));
    }
}

impl Equipment for Hands {
    fn saved(&self) -> Option<Arc<Saved>> {
        self.saved.clone()
    }

    fn has_fixes(&self) -> bool {
        false
    }

    fn drive(&mut self, _: Command, _: &Estimate) {}

    fn stop(&mut self) {}

    fn end(&mut self) {}

    fn find(&mut self, job: PlanJob, neighbours: Vec<Neighbour>) {
        let path = job.run(&self.hardware, &neighbours);
        self.later(TICK, self.id, Coming::Path(job.job, path));
    }

    fn write(&mut self, job: StoreJob) {
        self.later(WRITE_TIME, self.id, Coming::Write(job));
    }

    fn send(&mut self, to: Member, packet: &[u8]) -> std::io::Result<()> {
        let packet = Coming::Packet(self.id.0, packet.to_vec());
        self.later(DELAY, RobotId(to), packet);
        Ok(())
    }

    fn learn(&mut self, _: Member, _: Origin) {}
}

impl Robots {
    fn file(&self, robot: RobotId) -> PathBuf {
        self.storage.join(format!("{robot}"))
    }

    /// A process of this robot starts now.
    fn come_up(&mut self, robot: RobotId) {
        let storage = Storage::open(&self.file(robot)).expect("the storage can be opened");
        let model = starl_motion::models::by_name("create").expect("there is such a model");
        let body = Body {
            radius: 0.1,
            height: 0.1,
            workspace: Workspace::Ground,
        };
        let hardware = Hardware {
            body,
            control_period: PERIOD,
            drive: Some(Drive {
                model,
                avoidance: None,
                position_error: 0.0,
                seed: 1,
            }),
        };
        let equipment = Hands {
            id: robot,
            hardware: hardware.clone(),
            saved: self
                .fleet
                .has_storage
                .then(|| Arc::new(storage.saved().clone())),
            world: self.world.clone(),
        };
        let setup = Setup {
            id: robot,
            bodies: vec![body; self.fleet.robots.len()],
            program: self.fleet.robots[robot.index()].clone().boxed(),
            random: Random::keyed(1, &[u64::from(robot.0)]),
            hardware,
            sensors: SensorSuite::default(),
            things: Vec::new(),
            way_points: Vec::<WayPoint>::new(),
            obstacles: Vec::new(),
            positioning_period: PERIOD,
            accuracy: Default::default(),
            start: Some(Pose::default()),
            safety: Safety {
                // The robots of the suite have no odometry.
                localisation: Duration::from_seconds(3600),
                link: None,
            },
        };
        let channel = Channel::new(robot.0, "suite", Vec::new());
        let notes = Notes(robot, self.world.clone());
        self.lives[robot.index()] = Some(Core::new(self.now, setup, channel, equipment, notes));
    }

    /// The inputs due at `now` for a robot; those for a robot that is down are lost.
    fn due(&mut self, robot: RobotId) -> Vec<Incoming> {
        let now = self.now;
        let mut world = self.world.borrow_mut();
        let is_due = |(at, to, _): &mut (Time, RobotId, Coming)| *at <= now && *to == robot;
        let due: Vec<_> = world.coming.extract_if(.., is_due).collect();
        drop(world);
        due.into_iter()
            .filter_map(|(_, _, coming)| self.arrive(robot, coming))
            .collect()
    }

    fn arrive(&mut self, robot: RobotId, coming: Coming) -> Option<Incoming> {
        if self.lives[robot.index()].is_none() {
            self.lose(robot, &coming);
            return None;
        }
        Some(match coming {
            Coming::Packet(_, packet) => Incoming::Packet(Arrival {
                at: Instant::now(),
                origin: Origin::Named,
                packet,
            }),
            Coming::Path(job, path) => Incoming::Planned(job, path),
            Coming::Write(StoreJob { job, saves }) => {
                let mut storage = Storage::open(&self.file(robot)).expect("it can be opened");
                storage.write(saves).expect("it can be written");
                Incoming::Written(Written::Done(job))
            }
        })
    }

    /// The network takes down what it could not deliver.
    fn lose(&mut self, robot: RobotId, coming: &Coming) {
        // A packet without protection is a kind, the sender's number and a frame.
        if let Coming::Packet(from, packet) = coming
            && let Some(Frame::Datagram { sequence, .. }) =
                starl_core::message::decode(&packet[5..])
        {
            let event = Event::Dropped {
                from: RobotId(*from),
                to: Some(robot),
                sequence,
                reason: DropReason::Down,
            };
            let (at, robot) = (self.now, Some(robot));
            self.world
                .borrow_mut()
                .records
                .push(Record { at, robot, event });
        }
    }

    fn next(&self) -> Time {
        let lives = self.lives.iter().flatten().map(Core::next_due);
        let world = self.world.borrow();
        let coming = world.coming.iter().map(|(at, ..)| *at);
        lives.chain(coming).min().unwrap_or(Time::NEVER)
    }
}

impl Host for Robots {
    const LACKS: &'static [(Need, &'static str)] = &[
        (
            Need::Clocks,
            "a robot has no other clock than that of its process",
        ),
        (Need::Corruption, "nobody overwrites a real robot's state"),
        (
            Need::Count,
            "a robot's datagrams are numbered from the time of its start",
        ),
    ];

    fn start(fleet: Fleet) -> Robots {
        static COUNT: AtomicU32 = AtomicU32::new(0);
        let count = COUNT.fetch_add(1, Ordering::Relaxed);
        let name = format!("starl-conforms-{}-{count}", std::process::id());
        let storage = std::env::temp_dir().join(name);
        std::fs::create_dir_all(&storage).expect("a folder can be made");
        let count = fleet.robots.len();
        let mut host = Robots {
            fleet,
            lives: (0..count).map(|_| None).collect(),
            world: Rc::default(),
            storage,
            now: Time::ZERO,
        };
        (0..count as u32).for_each(|robot| host.come_up(RobotId(robot)));
        host
    }

    fn run_before(&mut self, end: Time) {
        while self.next() < end {
            self.now = self.now.max(self.next());
            self.world.borrow_mut().now = self.now;
            for robot in 0..self.lives.len() {
                let mut incoming = self.due(RobotId(robot as u32));
                if let Some(life) = &mut self.lives[robot] {
                    life.step(self.now, &mut incoming);
                }
            }
        }
        self.stall(end);
    }

    fn crash(&mut self, robot: RobotId) {
        self.lives[robot.index()] = None;
        // The threads end with the process.
        let is_own = |(_, to, coming): &(Time, RobotId, Coming)| {
            *to == robot && !matches!(coming, Coming::Packet(..))
        };
        self.world
            .borrow_mut()
            .coming
            .retain(|coming| !is_own(coming));
    }

    fn restart(&mut self, robot: RobotId) {
        self.come_up(robot);
    }

    fn corrupt(&mut self, _: RobotId) {
        unreachable!("nobody overwrites a real robot's state");
    }

    fn stall(&mut self, end: Time) {
        self.now = self.now.max(end);
    }

    fn records(&self) -> Vec<Record> {
        self.world.borrow().records.clone()
    }
}

impl Drop for Robots {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.storage);
    }
}

starl_host::conformance!(
    Robots,
    skip clocks_run_wrong = "a robot has no other clock than that of its process",
    skip a_corrupted_robot_continues_until_it_restarts = "nobody overwrites a real robot's state",
    skip the_next_life_continues_the_numbers =
        "a robot's datagrams are numbered from the time of its start",
);
