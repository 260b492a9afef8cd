//! Environments for learning: batches of worlds, whose results are written to arrays of the caller.

use numpy::{
    PyReadonlyArray1, PyReadonlyArray3, PyReadwriteArray1, PyReadwriteArray2, PyReadwriteArray3,
    PyReadwriteArray4,
};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};
use starl_core::{ConvexPolygon, Duration, Obstacle, Point, Pose};
use starl_env::{Actions, Lidar, Outputs, Radio, Region, Settings, Verdicts};
use starl_motion::models;

/// Environments side by side.
#[pyclass(module = "starl._native")]
pub struct Batch {
    pub batch: starl_env::Batch,
    /// None if one thread does all.
    pool: Option<ThreadPool>,
}

/// The compiled expressions of a task, and what its quantities were before.
#[pyclass(module = "starl._native")]
pub struct Judge {
    pub judge: starl_env::Judge,
    pub memory: Vec<u64>,
}

/// A model's name, and its parameters that are not at their defaults.
type Model = (String, Vec<(String, f64)>);
/// The numbers of a message, the range, the loss, and the shortest and longest delay.
type RadioNumbers = (usize, f64, f64, u32, u32);

#[pymethods]
impl Batch {
    #[new]
    #[pyo3(signature = (
        models, environments, *, physics_step, steps_per_action, collisions, circles, boxes, walls, lidar, reach, radio,
        threads
    ))]
    #[expect(
        clippy::too_many_arguments,
        reason = "called by one function of the package, by name"
    )]
    fn new(
        models: Vec<Model>,
        environments: usize,
        physics_step: f64,
        steps_per_action: u32,
        collisions: bool,
        circles: Vec<[f64; 3]>,
        boxes: Vec<[f64; 4]>,
        walls: Option<[f64; 4]>,
        lidar: Option<(u32, f64)>,
        reach: Option<f64>,
        radio: Option<RadioNumbers>,
        threads: usize,
    ) -> PyResult<Batch> {
        let model = |(name, parameters): &Model| models::with_parameters(name, parameters);
        let models: Result<Vec<_>, _> = models.iter().map(model).collect();
        let mut obstacles: Vec<Obstacle> = circles.into_iter().map(circle).collect();
        for [left, bottom, right, top] in boxes {
            obstacles.push(polygon(&rectangle(left, bottom, right, top))?);
        }
        if let Some([left, bottom, right, top]) = walls {
            let [a, b, c, d] = rectangle(left, bottom, right, top);
            for ends in [[a, b], [b, c], [c, d], [d, a]] {
                obstacles.push(polygon(&ends)?);
            }
        }
        let settings = Settings {
            models: models.map_err(refused)?,
            physics_step: Duration::from_seconds_f64(physics_step),
            steps_per_action,
            collisions,
            obstacles,
            lidar: lidar.map(|(rays, range)| Lidar { rays, range }),
            actions: reach.map_or(Actions::Commands, |reach| Actions::Waypoints { reach }),
            radio: radio.map(|(numbers, range, loss, shortest, longest)| Radio {
                numbers,
                range,
                loss,
                delay: (shortest, longest),
            }),
        };
        let mut batch = starl_env::Batch::new(settings, environments).map_err(refused)?;
        batch.set_parallel(threads > 1);
        let pool = || ThreadPoolBuilder::new().num_threads(threads).build();
        let pool = (threads > 1).then(pool).transpose().map_err(refused)?;
        Ok(Batch { batch, pool })
    }

    /// How many numbers a robot's action has, its message left out.
    #[getter]
    fn action_numbers(&self) -> usize {
        self.batch.settings().action_numbers()
    }

    /// The radius, the greatest speed and the greatest rate of turn of each robot.
    #[getter]
    pub fn limits(&self) -> Vec<(f64, f64, f64)> {
        let models = self.batch.settings().models.iter();
        models
            .map(|model| {
                let limits = model.limits();
                (model.body().radius, limits.speed, limits.turn_rate)
            })
            .collect()
    }

    /// Restarts the random streams of environments.
    fn seed(
        &mut self,
        environments: PyReadonlyArray1<'_, i64>,
        seeds: PyReadonlyArray1<'_, u64>,
    ) -> PyResult<()> {
        let chosen = self.chosen(&environments)?;
        for (environment, &seed) in chosen.into_iter().zip(seeds.as_slice()?) {
            self.batch.seed(environment, seed);
        }
        Ok(())
    }

    /// Fills a row for each environment with numbers of its stream, uniform in [0, 1).
    fn draw(
        &mut self,
        environments: PyReadonlyArray1<'_, i64>,
        mut numbers: PyReadwriteArray2<'_, f64>,
    ) -> PyResult<()> {
        let chosen = self.chosen(&environments)?;
        let columns = numbers.as_array().ncols();
        let rows = numbers.as_slice_mut()?.chunks_exact_mut(columns.max(1));
        for (environment, row) in chosen.into_iter().zip(rows) {
            row.fill_with(|| self.batch.draw(environment));
        }
        Ok(())
    }

    /// Fills a row for each environment with free places: x, y, z.
    fn scatter(
        &mut self,
        environments: PyReadonlyArray1<'_, i64>,
        corners: ([f64; 3], [f64; 3]),
        distances: (f64, f64, f64),
        mut places: PyReadwriteArray3<'_, f64>,
    ) -> PyResult<()> {
        let chosen = self.chosen(&environments)?;
        let (clearance, height, gap) = distances;
        let region = Region {
            low: point(corners.0),
            high: point(corners.1),
            clearance,
            height,
            gap,
        };
        let count = places.as_array().shape()[1];
        let mut found = vec![Point::ZERO; count];
        let rows = places.as_slice_mut()?.chunks_exact_mut(3 * count.max(1));
        for (environment, row) in chosen.into_iter().zip(rows) {
            let done = self.batch.scatter(environment, &region, &mut found);
            done.map_err(|error| refused(format!("environment {environment}: {error}")))?;
            for (numbers, place) in row.as_chunks_mut().0.iter_mut().zip(&found) {
                *numbers = [place.x, place.y, place.z];
            }
        }
        Ok(())
    }

    /// Gives each environment a row of circles of its own: x, y, radius.
    fn set_circles(
        &mut self,
        environments: PyReadonlyArray1<'_, i64>,
        circles: PyReadonlyArray3<'_, f64>,
    ) -> PyResult<()> {
        let chosen = self.chosen(&environments)?;
        let count = circles.as_array().shape()[1];
        let all: Vec<Obstacle> = circles
            .as_slice()?
            .as_chunks()
            .0
            .iter()
            .map(|&one| circle(one))
            .collect();
        if all.iter().any(|circle| !circle.is_valid()) {
            return Err(refused(
                "circles: a number is not finite, or a radius is negative",
            ));
        }
        for (place, environment) in chosen.into_iter().enumerate() {
            let own = &all[place * count..][..count];
            self.batch.set_obstacles(environment, own);
        }
        Ok(())
    }

    /// Begins an episode in each environment with its row of poses: x, y, z, yaw.
    fn place(
        &mut self,
        environments: PyReadonlyArray1<'_, i64>,
        poses: PyReadonlyArray3<'_, f64>,
    ) -> PyResult<()> {
        let chosen = self.chosen(&environments)?;
        let robots = self.batch.settings().robots();
        if poses.as_array().shape() != [chosen.len(), robots, 4] {
            return Err(refused(format!(
                "poses have the shape {:?}; use ({}, {robots}, 4)",
                poses.as_array().shape(),
                chosen.len()
            )));
        }
        let numbers = poses.as_slice()?;
        if let Some(place) = numbers.iter().position(|number| !number.is_finite()) {
            let (environment, robot) = (chosen[place / (4 * robots)], place / 4 % robots);
            return Err(refused(format!(
                "the pose of robot {robot} in environment {environment} has a number that is not finite"
            )));
        }
        for (environment, row) in chosen.into_iter().zip(numbers.chunks_exact(4 * robots)) {
            let pose = |&[x, y, z, yaw]: &[f64; 4]| Pose::level(Point::new(x, y, z), yaw);
            let poses: Vec<Pose> = row.as_chunks().0.iter().map(pose).collect();
            self.batch.place(environment, &poses);
        }
        Ok(())
    }

    /// Carries out an action of every robot and writes the results. Other threads of Python run meanwhile.
    #[expect(clippy::too_many_arguments, reason = "an argument for each array")]
    fn step(
        &mut self,
        py: Python<'_>,
        actions: PyReadonlyArray3<'_, f64>,
        sent: PyReadonlyArray3<'_, f64>,
        mut poses: PyReadwriteArray3<'_, f64>,
        mut velocities: PyReadwriteArray3<'_, f64>,
        mut contacts: PyReadwriteArray2<'_, i32>,
        mut lidar: PyReadwriteArray3<'_, f64>,
        mut messages: PyReadwriteArray4<'_, f64>,
        mut ages: PyReadwriteArray3<'_, i32>,
    ) -> PyResult<()> {
        let outputs = Outputs {
            poses: poses.as_slice_mut()?,
            velocities: velocities.as_slice_mut()?,
            contacts: contacts.as_slice_mut()?,
            lidar: lidar.as_slice_mut()?,
            messages: messages.as_slice_mut()?,
            ages: ages.as_slice_mut()?,
        };
        let (actions, sent) = (actions.as_slice()?, sent.as_slice()?);
        let Batch { batch, pool } = self;
        let step = || batch.step(actions, sent, outputs);
        py.detach(|| match pool {
            Some(pool) => pool.install(step),
            None => step(),
        })
        .map_err(refused)
    }

    /// Evaluates the expressions of a task after an action; with `begins`, for the environments that begin an episode.
    #[expect(clippy::too_many_arguments, reason = "an argument for each array")]
    fn judge(
        &mut self,
        py: Python<'_>,
        judge: &mut Judge,
        begins: Option<PyReadonlyArray1<'_, bool>>,
        mut rows: PyReadwriteArray3<'_, f64>,
        lidar: PyReadonlyArray3<'_, f64>,
        mut rewards: PyReadwriteArray2<'_, f64>,
        mut terminated: PyReadwriteArray1<'_, bool>,
        mut information: PyReadwriteArray2<'_, f64>,
    ) -> PyResult<()> {
        let verdicts = Verdicts {
            rows: rows.as_slice_mut()?,
            memory: &mut judge.memory,
            lidar: lidar.as_slice()?,
            rewards: rewards.as_slice_mut()?,
            terminated: terminated.as_slice_mut()?,
            information: information.as_slice_mut()?,
        };
        let begins = begins
            .as_ref()
            .map(|begins| begins.as_slice())
            .transpose()?;
        let Batch { batch, pool } = self;
        let judge = &judge.judge;
        let turn = || batch.judge(judge, begins, verdicts);
        py.detach(|| match pool {
            Some(pool) => pool.install(turn),
            None => turn(),
        })
        .map_err(refused)
    }

    /// Writes the results of these environments as they are now.
    #[expect(clippy::too_many_arguments, reason = "an argument for each array")]
    fn show(
        &mut self,
        environments: PyReadonlyArray1<'_, i64>,
        mut poses: PyReadwriteArray3<'_, f64>,
        mut velocities: PyReadwriteArray3<'_, f64>,
        mut contacts: PyReadwriteArray2<'_, i32>,
        mut lidar: PyReadwriteArray3<'_, f64>,
        mut messages: PyReadwriteArray4<'_, f64>,
        mut ages: PyReadwriteArray3<'_, i32>,
    ) -> PyResult<()> {
        let mut is_shown = vec![false; self.batch.environments()];
        for environment in self.chosen(&environments)? {
            is_shown[environment] = true;
        }
        let outputs = Outputs {
            poses: poses.as_slice_mut()?,
            velocities: velocities.as_slice_mut()?,
            contacts: contacts.as_slice_mut()?,
            lidar: lidar.as_slice_mut()?,
            messages: messages.as_slice_mut()?,
            ages: ages.as_slice_mut()?,
        };
        self.batch
            .show(|environment| is_shown[environment], outputs);
        Ok(())
    }
}

impl Batch {
    /// The environments with these numbers.
    fn chosen(&self, numbers: &PyReadonlyArray1<'_, i64>) -> PyResult<Vec<usize>> {
        let environments = self.batch.environments();
        numbers
            .as_array()
            .iter()
            .map(|&number| {
                let index = usize::try_from(number).ok();
                index.filter(|&index| index < environments).ok_or_else(|| {
                    refused(format!(
                        "there is no environment {number}; there are {environments}, from 0"
                    ))
                })
            })
            .collect()
    }
}

pub fn refused(error: impl ToString) -> PyErr {
    PyValueError::new_err(error.to_string())
}

fn point([x, y, z]: [f64; 3]) -> Point {
    Point::new(x, y, z)
}

fn circle([x, y, radius]: [f64; 3]) -> Obstacle {
    Obstacle::circle(Point::planar(x, y), radius)
}

/// The corners, counter-clockwise.
fn rectangle(left: f64, bottom: f64, right: f64, top: f64) -> [Point; 4] {
    [(left, bottom), (right, bottom), (right, top), (left, top)].map(|(x, y)| Point::planar(x, y))
}

fn polygon(corners: &[Point]) -> PyResult<Obstacle> {
    match ConvexPolygon::new(corners) {
        Ok(base) => Ok(Obstacle::polygon(base)),
        Err(error) => Err(refused(format!(
            "obstacles: a box or wall is invalid: {error}"
        ))),
    }
}
