//! The handle through which a program in Python sees and moves its robot.
//!
//! Python objects may outlive a call, and a [`Robot`] may not. So a handle owns copies of the robot's knowledge,
//! collects effects, and returns them at the end of the call; from then on it is empty.

use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use starl_core::effect::Effects;
use starl_core::event::Level;
use starl_core::motion::{Body, Obstacles};
use starl_core::sensor::{Contact, Detection, Ray};
use starl_core::{Command, Estimate, Point, Random, Robot, RobotId, Sensors, Time, View, WayPoint};
use std::sync::{Mutex, PoisonError};

/// x, y and z, metres.
pub type Place = (f64, f64, f64);

/// A robot for the duration of one call of its program.
#[pyclass(frozen, module = "starl._native")]
pub struct Handle(Mutex<Option<Context>>);

/// The data that a [`Robot`] borrows.
pub struct Context {
    id: RobotId,
    now: Time,
    estimate: Estimate,
    body: Body,
    fleet: Vec<RobotId>,
    way_points: Vec<WayPoint>,
    obstacles: Obstacles,
    bumper: Option<Contact>,
    proximity: Vec<Ray>,
    detections: Vec<Detection>,
    holding: Option<u32>,
    has_storage: bool,
    pub effects: Effects,
    pub random: Random,
}

impl Context {
    fn of(robot: &mut Robot<'_>) -> Context {
        let sensors = *robot.sensors();
        Context {
            id: robot.id(),
            now: robot.now(),
            estimate: *robot.estimate(),
            body: *robot.body(),
            fleet: robot.fleet().to_vec(),
            way_points: robot.way_points().to_vec(),
            obstacles: robot.obstacles(),
            bumper: sensors.bumper,
            proximity: sensors.proximity.to_vec(),
            detections: sensors.detections.to_vec(),
            holding: sensors.holding,
            has_storage: robot.has_storage(),
            effects: Effects::default(),
            random: robot.random().clone(),
        }
    }
}

impl Handle {
    /// A handle of this robot.
    pub fn of(robot: &mut Robot<'_>) -> Handle {
        Handle(Mutex::new(Some(Context::of(robot))))
    }

    /// Ends the call: the robot gets the effects and the random stream.
    pub fn end(&self, robot: &mut Robot<'_>) {
        let context = self.0.lock().unwrap_or_else(PoisonError::into_inner).take();
        if let Some(context) = context {
            robot.absorb(context.effects);
            *robot.random() = context.random;
        }
    }

    /// Does something with the robot.
    pub fn with<T>(&self, run: impl FnOnce(&mut Robot<'_>) -> T) -> PyResult<T> {
        let mut context = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let Some(context) = context.as_mut() else {
            return Err(ended());
        };
        let view = View {
            id: context.id,
            now: context.now,
            estimate: context.estimate,
            body: context.body,
            sensors: Sensors {
                bumper: context.bumper,
                proximity: &context.proximity,
                detections: &context.detections,
                holding: context.holding,
                thing_names: &[],
            },
            fleet: &context.fleet,
            way_points: &context.way_points,
            obstacles: &context.obstacles,
        };
        Ok(run(&mut Robot::new(
            &view,
            &mut context.effects,
            &mut context.random,
        )))
    }
}

fn ended() -> PyErr {
    PyRuntimeError::new_err(
        "this robot belongs to a call that has returned; use the one that is passed to each call",
    )
}

#[pymethods]
impl Handle {
    #[getter]
    fn id(&self) -> PyResult<usize> {
        self.with(|robot| robot.id().index())
    }

    #[getter]
    fn now(&self) -> PyResult<f64> {
        self.with(|robot| robot.now().seconds())
    }

    #[getter]
    fn fleet(&self) -> PyResult<Vec<usize>> {
        self.with(|robot| robot.fleet().iter().map(|robot| robot.index()).collect())
    }

    #[getter]
    fn position(&self) -> PyResult<Place> {
        self.with(|robot| numbers(robot.position()))
    }

    #[getter]
    fn velocity(&self) -> PyResult<Place> {
        self.with(|robot| numbers(robot.velocity()))
    }

    #[getter]
    fn heading(&self) -> PyResult<f64> {
        self.with(|robot| robot.heading())
    }

    /// Name and position of each waypoint.
    #[getter]
    fn way_points(&self) -> PyResult<Vec<(String, Place)>> {
        let of = |point: &WayPoint| (point.name.clone(), numbers(point.position));
        self.with(|robot| robot.way_points().iter().map(of).collect())
    }

    /// Bearing and distance of each proximity ray; the range where nothing is near.
    #[getter]
    fn proximity(&self) -> PyResult<Vec<(f64, f64)>> {
        let of = |ray: &Ray| (ray.bearing, ray.distance);
        self.with(|robot| robot.sensors().proximity.iter().map(of).collect())
    }

    #[getter]
    fn bumped(&self) -> PyResult<bool> {
        self.with(|robot| robot.sensors().bumper.is_some())
    }

    /// Whether stable variables survive a crash.
    #[getter]
    fn has_storage(&self) -> PyResult<bool> {
        let context = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        context
            .as_ref()
            .map_or_else(|| Err(ended()), |context| Ok(context.has_storage))
    }

    fn finish(&self) -> PyResult<()> {
        self.with(|robot| robot.finish())
    }

    fn fail(&self, reason: String) -> PyResult<()> {
        self.with(|robot| robot.fail(reason))
    }

    /// A guarded action fired.
    fn action(&self, name: String) -> PyResult<()> {
        self.with(|robot| robot.action(name))
    }

    fn log(&self, text: String, warning: bool) -> PyResult<()> {
        let level = match warning {
            true => Level::Warning,
            false => Level::Info,
        };
        self.with(|robot| robot.log(level, text))
    }

    /// Turns the wheels of a differential drive at these rim speeds, metres per second.
    fn wheels(&self, left: f64, right: f64) -> PyResult<()> {
        self.with(|robot| robot.drive(Command::Wheels { left, right }))
    }

    /// Moves a holonomic robot with this velocity in the world frame, metres per second, and turns it, radians per second.
    fn drive(&self, x: f64, y: f64, yaw_rate: f64) -> PyResult<()> {
        let velocity = Point::new(x, y, 0.0);
        self.with(|robot| robot.drive(Command::Velocity { velocity, yaw_rate }))
    }

    /// Stands still, or hovers.
    fn halt(&self) -> PyResult<()> {
        self.with(|robot| robot.drive(Command::Stop))
    }

    /// A number from 0 to 1 of the robot's random stream.
    fn random(&self) -> PyResult<f64> {
        self.with(|robot| robot.random().uniform())
    }
}

/// x, y and z.
pub fn numbers(point: Point) -> Place {
    (point.x, point.y, point.z)
}

/// Random numbers for a fault that overwrites variables.
#[pyclass(frozen, module = "starl._native")]
pub struct Draws(Mutex<Random>);

impl Draws {
    /// The draws that follow in a stream.
    pub fn of(random: &Random) -> Draws {
        Draws(Mutex::new(random.clone()))
    }

    /// The stream after the draws.
    pub fn end(&self) -> Random {
        self.0
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
            .clone()
    }
}

#[pymethods]
impl Draws {
    /// A number from 0 to 1.
    fn random(&self) -> f64 {
        let mut random = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        random.uniform()
    }
}
