//! Journals of one robot whose knowledge a test changes.

use starl_core::event::{Level, Name};
use starl_core::motion::{Body, Obstacles, Workspace};
use starl_core::sensor::{Contact, Detected, Detection, Ray};
use starl_core::{
    ConvexPolygon, Effect, Estimate, Event, Input, Obstacle, Point, Port, Pose, Random, RobotId,
    Save, Saved, Sensors, Time, Twist, View, WayPoint, message,
};
use starl_host::Observed;
use starl_host::journal::{Batch, Damaged, Journal, Packer, Reader};

pub const ROBOT: RobotId = RobotId(7);

/// A robot's knowledge, owned.
#[derive(Clone, Debug)]
pub struct World {
    pub now: Time,
    pub estimate: Estimate,
    pub body: Body,
    pub bumper: Option<Contact>,
    pub proximity: Vec<Ray>,
    pub detections: Vec<Detection>,
    pub holding: Option<u32>,
    pub thing_names: Vec<Name>,
    pub fleet: Vec<RobotId>,
    pub way_points: Vec<WayPoint>,
    pub obstacles: Obstacles,
}

impl Default for World {
    fn default() -> World {
        World {
            now: Time(1_000),
            estimate: Estimate {
                pose: Pose::level(Point::planar(1.0, 2.0), 0.5),
                twist: Twist::default(),
                at: Time(900),
            },
            body: Body {
                radius: 0.2,
                height: 0.3,
                workspace: Workspace::Air { lowest: 1.5 },
            },
            bumper: None,
            proximity: Vec::new(),
            detections: Vec::new(),
            holding: None,
            thing_names: Vec::new(),
            fleet: vec![RobotId(0), ROBOT],
            way_points: vec![WayPoint {
                name: "A".into(),
                position: Point::ZERO,
                group: 3,
            }],
            obstacles: [Obstacle::circle(Point::planar(4.0, 5.0), 0.5), wall()].into(),
        }
    }
}

pub fn wall() -> Obstacle {
    let corners = [Point::planar(0.1, 0.2), Point::planar(3.3, 0.7)];
    Obstacle::polygon(ConvexPolygon::new(&corners).expect("it is a wall"))
}

impl World {
    pub fn view(&self) -> View<'_> {
        View {
            id: ROBOT,
            now: self.now,
            estimate: self.estimate,
            body: self.body,
            sensors: Sensors {
                bumper: self.bumper,
                proximity: &self.proximity,
                detections: &self.detections,
                holding: self.holding,
                thing_names: &self.thing_names,
            },
            fleet: &self.fleet,
            way_points: &self.way_points,
            obstacles: &self.obstacles,
        }
    }

    /// Makes one random change; some change a number to an equal one with other bits.
    pub fn change(&mut self, random: &mut Random) {
        let number = match random.below(8) {
            0 => -0.0,
            1 => 0.0,
            2 => f64::NAN,
            3 => f64::INFINITY,
            _ => random.between(-5.0, 5.0),
        };
        let point = Point {
            x: number,
            y: 0.0,
            z: -number,
        };
        self.now = Time(self.now.0 + u64::from(random.below(3)) * 50_000_001);
        match random.below(18) {
            0 => self.estimate.pose.position = point,
            1 => self.estimate.pose.yaw = number,
            2 => self.estimate.pose.roll = number,
            3 => self.estimate.twist.linear = point,
            4 => self.estimate.twist.pitch = number,
            5 => self.estimate.at = Time(self.now.0 - u64::from(random.below(2))),
            6 => self.body.height = number,
            7 => self.body.workspace = Workspace::Ground,
            8 => {
                self.bumper = random.chance(0.5).then_some(Contact { bearing: number });
            }
            9 => self.proximity.clear(),
            10 => {
                let rays = 1 + random.below(9);
                self.proximity = (0..rays)
                    .map(|ray| Ray {
                        bearing: f64::from(ray),
                        distance: if random.chance(0.5) { 1.0 } else { number },
                        nearness: 0.0,
                    })
                    .collect();
            }
            11 => self.detections.clear(),
            12 => {
                let what = match random.chance(0.5) {
                    true => Detected::Thing(random.below(3)),
                    false => Detected::Robot(RobotId(random.below(3))),
                };
                let position = point;
                self.detections.push(Detection { what, position });
            }
            13 => self.fleet.push(RobotId(100 + random.below(100))),
            15 => self.holding = random.chance(0.5).then_some(random.below(3)),
            16 => self
                .thing_names
                .push(format!("thing{}", random.below(9)).into()),
            14 => self.way_points[0].position = point,
            _ => {
                let extra = Obstacle::cuboid(Point::ZERO, Point::planar(1.0, 1.0));
                self.obstacles = match random.below(3) {
                    0 => [].into(),
                    1 => self.obstacles.iter().cloned().collect(),
                    _ => self.obstacles.iter().cloned().chain([extra]).collect(),
                };
            }
        }
    }
}

/// A program's report, as an effect.
pub fn said(text: impl Into<String>) -> Effect {
    Effect::Record(Event::Log {
        level: Level::Info,
        text: text.into().into(),
    })
}

/// Something that is done to a robot's software, owned.
#[derive(Clone, Debug)]
pub enum Deed {
    Started(Random, Option<Saved>),
    Corrupted(Random),
    Input(Box<World>, Input, Vec<Effect>),
}

impl Deed {
    pub fn show(&self, at: Time, see: &mut dyn FnMut(Time, Observed<'_>)) {
        match self {
            Deed::Started(random, saved) => {
                let saved = saved.as_ref();
                see(at, Observed::Started { random, saved });
            }
            Deed::Corrupted(random) => see(at, Observed::Corrupted { random }),
            Deed::Input(world, input, effects) => {
                let view = &world.view();
                let observed = Observed::Input {
                    input,
                    view,
                    effects,
                };
                see(at, observed);
            }
        }
    }
}

/// Everything in an observation as text, exactly, except the payload of NaN.
pub fn text(at: Time, observed: Observed<'_>) -> String {
    format!("{at:?} {observed:?}")
}

/// The messages in which a trace holds these deeds, `size` to a message.
pub fn messages(deeds: &[(Time, Deed)], size: usize) -> Vec<(Time, Vec<u8>)> {
    let mut journal = Journal::new(ROBOT, 1);
    let mut packer = Packer::default();
    let mut batch = Batch::default();
    let pack = |deeds: &[(Time, Deed)]| {
        for (at, deed) in deeds {
            deed.show(*at, &mut |at, observed| {
                journal.observe(ROBOT, at, observed)
            });
        }
        batch.clear();
        journal.append_to(&mut batch);
        batch.sort();
        packer.pack(&batch).expect("there are some")
    };
    deeds.chunks(size).map(pack).collect()
}

/// The view of a reader of these messages.
pub fn read(messages: &[(Time, Vec<u8>)]) -> Result<Vec<String>, Damaged> {
    let mut reader = Reader::new(ROBOT);
    let mut seen = Vec::new();
    for (at, message) in messages {
        reader.read(*at, message, &mut |at, observed| {
            seen.push(text(at, observed))
        })?;
    }
    Ok(seen)
}

/// Storage that holds two values.
pub fn saved() -> Saved {
    let mut saved = Saved::default();
    for save in saves() {
        saved.apply(save);
    }
    saved
}

/// Two values of an owner.
pub fn saves() -> [Save; 2] {
    ["", "life"].map(|key| Save {
        port: Port(3),
        key: key.into(),
        value: Some(message::encode(&key)),
    })
}

/// A run of a robot whose knowledge changes at random.
pub fn random_deeds(seed: u64, count: usize) -> Vec<(Time, Deed)> {
    let mut random = Random::keyed(seed, &[]);
    let mut world = World::default();
    let mut deeds = vec![(Time(10), Deed::Started(random.clone(), None))];
    while deeds.len() < count {
        let at = Time(deeds.len() as u64 * 1_000);
        let deed = match random.below(20) {
            0 => Deed::Started(random.clone(), random.chance(0.5).then(saved)),
            1 => Deed::Corrupted(random.clone()),
            _ => {
                for _ in 0..random.below(4) {
                    world.change(&mut random);
                }
                let input = match random.below(3) {
                    0 => Input::Activate,
                    1 => Input::Estimate,
                    _ => Input::Suspected(RobotId(random.below(9))),
                };
                let effects = (0..random.below(3)).map(|number| said(format!("line {number}")));
                Deed::Input(Box::new(world.clone()), input, effects.collect())
            }
        };
        deeds.push((at, deed));
    }
    deeds
}
