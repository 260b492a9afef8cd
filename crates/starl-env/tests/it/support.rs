//! Small batches, and arrays for their results.

use starl_core::{Duration, Obstacle, Point, Pose, Random};
use starl_env::{Actions, Batch, Lidar, Outputs, Radio, Region, Settings};
use starl_motion::models;

/// Arrays for the results of a batch.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Arrays {
    pub poses: Vec<f64>,
    pub velocities: Vec<f64>,
    pub contacts: Vec<i32>,
    pub lidar: Vec<f64>,
    pub messages: Vec<f64>,
    pub ages: Vec<i32>,
}

impl Arrays {
    pub fn of(batch: &Batch) -> Arrays {
        let settings = batch.settings();
        let (environments, robots) = (batch.environments(), settings.robots());
        let all = environments * robots;
        let pairs = all * robots * usize::from(settings.radio.is_some());
        Arrays {
            poses: vec![0.0; all * 6],
            velocities: vec![0.0; all * 6],
            contacts: vec![0; all],
            lidar: vec![0.0; all * settings.rays()],
            messages: vec![0.0; pairs * settings.message_numbers()],
            ages: vec![0; pairs],
        }
    }

    pub fn outputs(&mut self) -> Outputs<'_> {
        Outputs {
            poses: &mut self.poses,
            velocities: &mut self.velocities,
            contacts: &mut self.contacts,
            lidar: &mut self.lidar,
            messages: &mut self.messages,
            ages: &mut self.ages,
        }
    }
}

/// Robots of one model with lidar, without radio, on a floor with a pillar.
pub fn settings(model: &str, robots: usize) -> Settings {
    let model = models::by_name(model).expect("a model");
    Settings {
        models: vec![model; robots],
        physics_step: Duration::from_millis(50),
        steps_per_action: 2,
        collisions: true,
        obstacles: vec![Obstacle::circle(Point::planar(0.0, 0.0), 0.2)],
        lidar: Some(Lidar {
            rays: 12,
            range: 1.0,
        }),
        actions: Actions::Commands,
        radio: None,
    }
}

/// Everyone hears everyone, at once and always.
pub fn radio(numbers: usize) -> Radio {
    Radio {
        numbers,
        range: f64::INFINITY,
        loss: 0.0,
        delay: (0, 0),
    }
}

/// A square around the pillar.
pub fn square(half: f64) -> Region {
    Region {
        low: Point::planar(-half, -half),
        high: Point::planar(half, half),
        clearance: 0.4,
        height: 0.2,
        gap: 0.8,
    }
}

/// Seeds an environment and puts its robots into free places.
pub fn start(batch: &mut Batch, environment: usize, seed: u64) {
    batch.seed(environment, seed);
    let mut places = vec![Point::ZERO; batch.settings().robots()];
    let found = batch.scatter(environment, &square(1.5), &mut places);
    found.expect("room for all");
    let poses = places.into_iter().map(|place| {
        let yaw = 6.0 * batch.draw(environment);
        Pose::level(place, yaw)
    });
    let poses: Vec<Pose> = poses.collect();
    batch.place(environment, &poses);
}

/// The actions of an environment in a step, drawn by its seed.
pub fn actions(seed: u64, step: u64, count: usize) -> Vec<f64> {
    let mut random = Random::keyed(seed, &[step]);
    (0..count).map(|_| random.between(-0.3, 1.2)).collect()
}
