//! The suite that every adapter passes: its driver, on its emulated robot, does what the runtime counts on.
//!
//! ```no_run
//! # fn rig() -> starl_emulate::conformance::Rig { unimplemented!() }
//! for (name, check) in starl_emulate::conformance::CHECKS {
//!     check(rig()).unwrap_or_else(|failure| panic!("{name}: {failure}"));
//! }
//! ```
//!
//! A check gets a [`Rig`] of its own, drives the robot through the driver as the runtime does, every 50 ms, and judges
//! by the true state of the body. It takes seconds of real time.

mod reckoning;

use crate::BodyHandle;
use reckoning::Reckoning;
use starl_core::math::wrap_angle;
use starl_core::{Command, Estimate, Point, Random, Time};
use starl_motion::{Goal, State, Tracking};
use starl_node::{Device, DeviceError, Reading};
use std::any::Any;
use std::thread::sleep;
use std::time::{Duration, Instant};
use thiserror::Error;

/// Sends bytes to where they should not be.
pub type Interference = Box<dyn FnMut(&[u8])>;

/// A driver connected to an emulated robot that stands at rest, with 2 m of free floor around it except where a check
/// says otherwise.
pub struct Rig {
    /// The driver.
    pub device: Box<dyn Device>,
    /// The body of the emulated robot.
    pub body: BodyHandle,
    /// Sends bytes that make no sense to the driver, and to the robot where its protocol can tell noise from commands.
    pub noise: Interference,
    /// How long the robot moves on after its driver has fallen silent. `None` if it would move on for ever.
    pub watchdog: Option<Duration>,
    /// The handle that keeps the emulated robot running.
    pub keep: Box<dyn Any>,
}

/// Why a check has failed.
#[derive(Debug, Error)]
pub enum Unmet {
    /// The driver reports an error.
    #[error(transparent)]
    Device(#[from] DeviceError),
    /// The driver reports no measurement.
    #[error("the device measures nothing")]
    Silent,
    /// The robot does something else than it should.
    #[error("{0}")]
    Wrong(String),
}

/// A check: returns its measurement, or the reason of its failure.
pub type Check = fn(Rig) -> Result<String, Unmet>;

/// The checks with their names.
pub const CHECKS: [(&str, Check); 7] = [
    ("drives_and_measures_its_motion", drives),
    ("stops_when_told", stops_when_told),
    ("stops_when_dropped", stops_when_dropped),
    ("stops_when_its_driver_is_silent", stops_when_silent),
    ("refuses_what_it_cannot_do", refuses),
    ("noise_does_not_move_it", noise_at_rest),
    ("drives_through_noise", drives_through_noise),
];

/// How often the runtime calls a driver.
const PERIOD: Duration = Duration::from_millis(50);
/// The way that [`drives`] takes: ahead, then after a right angle to the left.
const WAY: [Point; 2] = [Point::planar(1.0, 0.0), Point::planar(1.0, 0.6)];
/// The greatest distance from its goal at which a robot stops, metres.
const ARRIVAL: f64 = 0.12;
/// Odometry errs by at most this part of the way.
const ODOMETRY: f64 = 0.06;
/// A slower robot stands, metres per second.
const STANDING: f64 = 0.03;
/// The longest that any manoeuvre may take.
const PATIENCE: Duration = Duration::from_secs(20);
/// The longest that a robot may take to stop, or to land.
const STOPPING: Duration = Duration::from_secs(5);

fn drives(mut rig: Rig) -> Result<String, Unmet> {
    let mut reckoning = Reckoning::new(rig.body.state().pose);
    let way = travel(&mut rig, |_| Ok(()), |reading| reckoning.take(reading))?;
    let (known, truth) = (reckoning.pose(), rig.body.state().pose);
    let error = known.position.planar_distance(truth.position);
    if error > ODOMETRY * way {
        return Err(Unmet::Wrong(format!(
            "after {way:.2} m odometry is off by {error:.3} m: {:?} instead of {:?}",
            known.position, truth.position
        )));
    }
    let turn = wrap_angle(known.yaw - truth.yaw).abs();
    if turn > ODOMETRY {
        return Err(Unmet::Wrong(format!("odometry is off by {turn:.3} rad")));
    }
    Ok(format!(
        "odometry is off by {error:.3} m and {turn:.3} rad after {way:.2} m"
    ))
}

fn stops_when_told(mut rig: Rig) -> Result<String, Unmet> {
    get_going(&mut rig)?;
    rig.device.stop()?;
    let from = rig.body.state();
    comes_to_rest(&rig.body, STOPPING)?;
    Ok(after(&from, &rig.body.state()))
}

fn stops_when_dropped(mut rig: Rig) -> Result<String, Unmet> {
    get_going(&mut rig)?;
    drop(rig.device);
    let from = rig.body.state();
    comes_to_rest(&rig.body, STOPPING)?;
    Ok(after(&from, &rig.body.state()))
}

fn stops_when_silent(mut rig: Rig) -> Result<String, Unmet> {
    let Some(watchdog) = rig.watchdog else {
        return Ok("the protocol has no watchdog".into());
    };
    get_going(&mut rig)?;
    let from = rig.body.state();
    comes_to_rest(&rig.body, watchdog + STOPPING)?;
    Ok(after(&from, &rig.body.state()))
}

fn refuses(mut rig: Rig) -> Result<String, Unmet> {
    let model = rig.body.model();
    let nan = f64::NAN;
    let foreign = [
        Command::Steer {
            speed: 1.0,
            angle: 0.1,
        },
        Command::Straight { speed: nan },
        Command::Wheels {
            left: 0.1,
            right: f64::INFINITY,
        },
        Command::Curve {
            speed: 0.1,
            radius: 0.0,
        },
        Command::Attitude {
            yaw_rate: 0.0,
            pitch: nan,
            roll: 0.0,
            gaz: 0.0,
        },
    ];
    settle(&mut rig)?;
    for command in foreign {
        if model.accepts(&command) {
            return Err(Unmet::Wrong(format!(
                "the check is wrong: the model takes {command:?}"
            )));
        }
        if rig
            .device
            .drive(&command, &estimate(&rig.body, Instant::now()))
            .is_ok()
        {
            return Err(Unmet::Wrong(format!("{command:?} is not reported")));
        }
        sleep(PERIOD);
    }
    stands(&rig.body)?;
    Ok(format!("{} commands refused", foreign.len()))
}

fn noise_at_rest(mut rig: Rig) -> Result<String, Unmet> {
    settle(&mut rig)?;
    let before = rig.body.state().pose;
    let mut random = Random::keyed(1, &[]);
    for _ in 0..200 {
        (rig.noise)(&garbage(&mut random));
        // Faults may be reported; a panic fails the check.
        let _ = rig.device.read();
        sleep(Duration::from_millis(5));
    }
    if rig.body.state().pose != before {
        return Err(Unmet::Wrong(format!(
            "it moved to {:?}",
            rig.body.state().pose
        )));
    }
    Ok("200 pieces".into())
}

fn drives_through_noise(mut rig: Rig) -> Result<String, Unmet> {
    let mut random = Random::keyed(2, &[]);
    let mut noise = std::mem::replace(&mut rig.noise, Box::new(|_| ()));
    let way = travel(
        &mut rig,
        |_| {
            noise(&garbage(&mut random));
            Ok(())
        },
        |_| (),
    )?;
    Ok(format!("{way:.2} m"))
}

/// Tracks [`WAY`] and stops. Calls `every` each period and `heard` with each reading. Returns the length of the way.
fn travel(
    rig: &mut Rig,
    mut every: impl FnMut(&BodyHandle) -> Result<(), Unmet>,
    mut heard: impl FnMut(&Reading),
) -> Result<f64, Unmet> {
    let began = Instant::now();
    let start = rig.body.state().pose;
    let (sin, cos) = start.yaw.sin_cos();
    let height = rig.body.model().limits().vertical_speed.min(0.8);
    let mut length = 0.0;
    let mut last = start.position;
    let mut readings = 0;
    for Point { x, y, .. } in WAY {
        let offset = Point::new(cos * x - sin * y, sin * x + cos * y, height);
        let target = rig
            .body
            .model()
            .body()
            .reachable(start.position.at_height(0.0) + offset);
        let mut tracking = Tracking::default();
        let mut near_since = None;
        let limit = Instant::now() + PATIENCE;
        loop {
            let estimate = estimate(&rig.body, began);
            let command = rig
                .body
                .model()
                .track(&mut tracking, &estimate, &Goal::stop_at(target));
            rig.device.drive(&command, &estimate)?;
            every(&rig.body)?;
            if let Ok(Some(reading)) = rig.device.read() {
                readings += 1;
                heard(&reading);
            }
            let at = rig.body.state().pose.position;
            length += at.planar_distance(last);
            last = at;
            let near = at.distance(target) < ARRIVAL;
            let since = near.then(|| *near_since.get_or_insert_with(Instant::now));
            near_since = since;
            if since.is_some_and(|since| since.elapsed() > Duration::from_secs(1)) {
                break;
            }
            if Instant::now() > limit {
                return Err(Unmet::Wrong(format!(
                    "it is at {at:?} and has not reached {target:?} within {PATIENCE:?}"
                )));
            }
            sleep(PERIOD);
        }
    }
    if readings < 20 {
        return Err(Unmet::Wrong(format!(
            "only {readings} readings have arrived"
        )));
    }
    Ok(length)
}

/// Waits for the first reading, as the runtime does before it drives.
fn settle(rig: &mut Rig) -> Result<(), Unmet> {
    let limit = Instant::now() + PATIENCE;
    while rig.device.read()?.is_none() {
        if Instant::now() > limit {
            return Err(Unmet::Silent);
        }
        sleep(PERIOD);
    }
    Ok(())
}

/// Drives towards a place far ahead until the robot is fast.
fn get_going(rig: &mut Rig) -> Result<(), Unmet> {
    settle(rig)?;
    let began = Instant::now();
    let pose = rig.body.state().pose;
    let ahead = Point::polar(10.0, pose.yaw);
    let model = rig.body.model();
    let target = model.body().reachable(pose.position + ahead);
    let mut tracking = Tracking::default();
    while rig.body.state().twist.linear.planar_length() < 0.5 * model.limits().cruise_speed.min(0.5)
    {
        let estimate = estimate(&rig.body, began);
        let command = model.track(&mut tracking, &estimate, &Goal::stop_at(target));
        rig.device.drive(&command, &estimate)?;
        let _ = rig.device.read();
        if began.elapsed() > PATIENCE {
            return Err(Unmet::Wrong(format!(
                "it does not drive: {:?}",
                rig.body.state()
            )));
        }
        sleep(PERIOD);
    }
    Ok(())
}

fn comes_to_rest(body: &BodyHandle, within: Duration) -> Result<(), Unmet> {
    let limit = Instant::now() + within;
    while Instant::now() < limit {
        if stands(body).is_ok() {
            sleep(Duration::from_millis(300));
            if stands(body).is_ok() {
                return Ok(());
            }
        }
        sleep(Duration::from_millis(10));
    }
    Err(Unmet::Wrong(format!("it still moves: {:?}", body.state())))
}

fn stands(body: &BodyHandle) -> Result<(), Unmet> {
    let twist = body.state().twist;
    if twist.linear.length() < STANDING && twist.yaw.abs() < STANDING {
        Ok(())
    } else {
        Err(Unmet::Wrong(format!("it moves: {twist:?}")))
    }
}

/// The estimate of a perfect localisation.
fn estimate(body: &BodyHandle, began: Instant) -> Estimate {
    let State { pose, twist, .. } = body.state();
    Estimate {
        pose,
        twist,
        at: Time(began.elapsed().as_nanos() as u64),
    }
}

fn garbage(random: &mut Random) -> Vec<u8> {
    let length = random.below(80);
    (0..length).map(|_| random.bits() as u8).collect()
}

fn after(from: &State, to: &State) -> String {
    let way = from.pose.position.planar_distance(to.pose.position);
    format!("stands after {way:.2} m")
}
