//! Primitives as objects of Python: state machines that a program owns. Their classes in Python give them names.

use super::handle::{Handle, Place, numbers};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use starl_core::motion::Planner;
use starl_core::{Area, Point, Random, RobotId};
use starl_primitives::broadcast::Order;
use starl_primitives::mutex::{self, Algorithm};
use starl_primitives::register::{OperationError, OperationId};
use starl_primitives::{
    Barrier, Broadcast, FailureDetector, Geocast, LeaderElection, LocalBroadcast, Mutex,
    ReachAvoid, Register, Registration, SharedMemory, Unicast, barrier, election, failure_detector,
    reach_avoid, register, registration, reliable, shared_memory,
};
use std::collections::BTreeMap;
use std::sync::{Mutex as Lock, MutexGuard, PoisonError};

/// A primitive of a program.
#[pyclass(frozen, module = "starl._native")]
pub struct Primitive(Lock<Kind>);

/// The kinds of primitives.
#[derive(Clone)]
enum Kind {
    ReachAvoid(Box<ReachAvoid>),
    Broadcast(Box<Broadcast>),
    Unicast(Box<Unicast>),
    LocalBroadcast(Box<LocalBroadcast>),
    Mutex(Box<Mutex>),
    LeaderElection(Box<LeaderElection>),
    FailureDetector(Box<FailureDetector>),
    Registration(Box<Registration>),
    Barrier(Box<Barrier>),
    SharedMemory(Box<SharedMemory>),
    Geocast(Box<Geocast>),
    Register(Box<Operations>),
}

/// Registers, and the operations that the program has begun, by their numbers in Python.
#[derive(Clone)]
struct Operations {
    register: Register,
    begun: BTreeMap<u64, OperationId>,
    last: u64,
}

impl Operations {
    fn begin(&mut self, begun: Result<OperationId, OperationError>) -> PyResult<u64> {
        let id = begun.map_err(|error| PyValueError::new_err(error.to_string()))?;
        // Results that the registers have forgotten need no number.
        let register = &self.register;
        self.begun
            .retain(|_, id| register.status(*id) != register::Status::Unknown);
        self.last += 1;
        self.begun.insert(self.last, id);
        Ok(self.last)
    }
}

/// The primitive of this kind, or the error that it is of another.
macro_rules! of_kind {
    ($guard:expr, $kind:ident) => {
        match &mut *$guard {
            Kind::$kind(primitive) => primitive,
            _ => {
                return Err(PyTypeError::new_err(concat!(
                    "this is not a ",
                    stringify!($kind)
                )))
            }
        }
    };
}

#[pymethods]
impl Primitive {
    #[staticmethod]
    fn reach_avoid(
        name: &str,
        vicinity: f64,
        planner: &str,
        most_nodes: u32,
        gap: f64,
    ) -> PyResult<Primitive> {
        for (name, length) in [("vicinity", vicinity), ("gap", gap)] {
            if !(length > 0.0 && length.is_finite()) {
                return Err(PyValueError::new_err(format!(
                    "{name} {length}: give metres, more than 0"
                )));
            }
        }
        let planner: Planner = serde_json::from_value(planner.into())
            .map_err(|error| PyValueError::new_err(format!("planner: {error}")))?;
        let options = reach_avoid::Options {
            vicinity,
            planner,
            most_nodes,
            gap,
            ..reach_avoid::Options::default()
        };
        Ok(Primitive::of(Kind::ReachAvoid(Box::new(ReachAvoid::new(
            name, options,
        )))))
    }

    #[staticmethod]
    fn broadcast(name: &str, order: &str) -> PyResult<Primitive> {
        let order = match order {
            "unordered" => Order::Unordered,
            "fifo" => Order::Fifo,
            "causal" => Order::Causal,
            "total" => Order::Total,
            _ => {
                let message = format!("order {order:?}: choose unordered, fifo, causal or total");
                return Err(PyValueError::new_err(message));
            }
        };
        let broadcast = Broadcast::in_order(name, order, reliable::Options::default());
        Ok(Primitive::of(Kind::Broadcast(Box::new(broadcast))))
    }

    #[staticmethod]
    fn unicast(name: &str) -> Primitive {
        let unicast = Unicast::new(name, reliable::Options::default());
        Primitive::of(Kind::Unicast(Box::new(unicast)))
    }

    #[staticmethod]
    fn local_broadcast(name: &str) -> Primitive {
        Primitive::of(Kind::LocalBroadcast(Box::new(LocalBroadcast::new(name))))
    }

    #[staticmethod]
    fn mutex(name: &str, algorithm: &str) -> PyResult<Primitive> {
        let algorithm = match algorithm {
            "permission" => Algorithm::Permission,
            "quorum" => Algorithm::Quorum,
            "lease" => Algorithm::Lease,
            _ => {
                let message =
                    format!("algorithm {algorithm:?}: choose permission, quorum or lease");
                return Err(PyValueError::new_err(message));
            }
        };
        let options = mutex::Options {
            algorithm,
            ..mutex::Options::default()
        };
        Ok(Primitive::of(Kind::Mutex(Box::new(Mutex::new(
            name, None, options,
        )))))
    }

    #[staticmethod]
    fn leader_election(name: &str) -> Primitive {
        let election = LeaderElection::new(name, None, election::Options::default());
        Primitive::of(Kind::LeaderElection(Box::new(election)))
    }

    #[staticmethod]
    fn failure_detector(name: &str) -> Primitive {
        let detector = FailureDetector::new(name, failure_detector::Options::default());
        Primitive::of(Kind::FailureDetector(Box::new(detector)))
    }

    #[staticmethod]
    fn registration(name: &str) -> Primitive {
        let registration = Registration::new(name, registration::Options::default());
        Primitive::of(Kind::Registration(Box::new(registration)))
    }

    #[staticmethod]
    fn barrier(name: &str) -> Primitive {
        let barrier = Barrier::new(name, None, barrier::Options::default());
        Primitive::of(Kind::Barrier(Box::new(barrier)))
    }

    #[staticmethod]
    fn shared_memory(name: &str) -> Primitive {
        let memory = SharedMemory::new(name, shared_memory::Options::default());
        Primitive::of(Kind::SharedMemory(Box::new(memory)))
    }

    #[staticmethod]
    fn geocast(name: &str) -> Primitive {
        let geocast = Geocast::new(name, reliable::Options::default());
        Primitive::of(Kind::Geocast(Box::new(geocast)))
    }

    #[staticmethod]
    fn registers(name: &str) -> Primitive {
        Primitive::of(Kind::Register(Box::new(Operations {
            register: Register::new(name, None, register::Options::default()),
            begun: BTreeMap::new(),
            last: 0,
        })))
    }

    /// Sends bytes to the other robots in an area: a circle of a centre and a radius, or a box of two corners.
    fn send_into(
        &self,
        robot: &Handle,
        circle: Option<(Place, f64)>,
        corners: Option<(Place, Place)>,
        content: Vec<u8>,
    ) -> PyResult<()> {
        let point = |(x, y, z): Place| Point::new(x, y, z);
        let area = match (circle, corners) {
            (Some((center, radius)), None) if radius.is_finite() && radius >= 0.0 => Area::Circle {
                center: point(center),
                radius,
            },
            (None, Some((low, high))) => Area::Box {
                low: point(low),
                high: point(high),
            },
            _ => {
                let message =
                    "give a centre with a radius of at least 0 m, or the two corners of a box";
                return Err(PyValueError::new_err(message));
            }
        };
        let mut kind = self.kind();
        let geocast = of_kind!(kind, Geocast);
        robot.with(|robot| {
            geocast.geocast(robot, &content, &area);
        })
    }

    /// Begins to read a register, and gives the number of the operation.
    fn begin_read(&self, robot: &Handle, register: &str) -> PyResult<u64> {
        let mut kind = self.kind();
        let operations = of_kind!(kind, Register);
        let begun = robot.with(|robot| operations.register.read(robot, register))?;
        operations.begin(begun)
    }

    /// Begins to write a register, and gives the number of the operation.
    fn begin_write(&self, robot: &Handle, register: &str, value: Vec<u8>) -> PyResult<u64> {
        let mut kind = self.kind();
        let operations = of_kind!(kind, Register);
        let value = value[..].into();
        let begun = robot.with(|robot| operations.register.write(robot, register, value))?;
        operations.begin(begun)
    }

    /// How far an operation is, in a word, and the value that was read or written.
    fn status(&self, operation: u64) -> PyResult<(&'static str, Option<Vec<u8>>)> {
        let mut kind = self.kind();
        let operations = of_kind!(kind, Register);
        let id = operations.begun.get(&operation);
        let status = id.map_or(register::Status::Unknown, |id| {
            operations.register.status(*id)
        });
        Ok(match status {
            register::Status::Pending => ("pending", None),
            register::Status::NoQuorum => ("no_quorum", None),
            register::Status::Done(value) => ("done", value.map(|value| value.to_vec())),
            // Python offers no claims.
            register::Status::Lost | register::Status::Refused | register::Status::Unknown => {
                ("unknown", None)
            }
        })
    }

    /// Gives up an operation, or forgets its result.
    fn withdraw(&self, robot: &Handle, operation: u64) -> PyResult<()> {
        let mut kind = self.kind();
        let operations = of_kind!(kind, Register);
        match operations.begun.remove(&operation) {
            Some(id) => robot.with(|robot| operations.register.withdraw(robot, id)),
            None => Ok(()),
        }
    }

    /// The value of this robot's own copy of a register.
    fn known(&self, register: &str) -> PyResult<Option<Vec<u8>>> {
        let mut kind = self.kind();
        let operations = of_kind!(kind, Register);
        Ok(operations.register.known(register).map(<[u8]>::to_vec))
    }

    fn __deepcopy__(&self, memo: &Bound<'_, PyDict>) -> Primitive {
        let _ = memo;
        Primitive::of(self.kind().clone())
    }

    fn go(&self, robot: &Handle, x: f64, y: f64, z: f64) -> PyResult<()> {
        let mut kind = self.kind();
        let motion = of_kind!(kind, ReachAvoid);
        robot.with(|robot| {
            let unsafe_set = robot.obstacles();
            motion.reach_avoid(robot, Point::new(x, y, z), unsafe_set);
        })
    }

    fn drive_lane(&self, robot: &Handle, line: Vec<(f64, f64, f64)>, until: f64) -> PyResult<()> {
        let line: Vec<Point> = line.iter().map(|&(x, y, z)| Point::new(x, y, z)).collect();
        if line.is_empty() || !line.iter().all(|point| point.is_finite()) {
            return Err(PyValueError::new_err(
                "line: give at least one point, and finite numbers only",
            ));
        }
        if !until.is_finite() {
            return Err(PyValueError::new_err(format!(
                "until {until}: give metres from the start of the line"
            )));
        }
        let mut kind = self.kind();
        let motion = of_kind!(kind, ReachAvoid);
        robot.with(|robot| motion.drive_lane(robot, &line, until))
    }

    /// How far along its lane the robot is, metres.
    fn along(&self) -> PyResult<f64> {
        let mut kind = self.kind();
        Ok(of_kind!(kind, ReachAvoid).along())
    }

    fn stop(&self, robot: &Handle) -> PyResult<()> {
        let mut kind = self.kind();
        let motion = of_kind!(kind, ReachAvoid);
        robot.with(|robot| motion.stop(robot))
    }

    /// Whether a target is under way, was reached, and was given up.
    fn motion(&self) -> PyResult<(bool, bool, bool)> {
        let mut kind = self.kind();
        let motion = of_kind!(kind, ReachAvoid);
        Ok((motion.active(), motion.done(), motion.failed()))
    }

    fn target(&self) -> PyResult<Option<(f64, f64, f64)>> {
        let mut kind = self.kind();
        Ok(of_kind!(kind, ReachAvoid).target().map(numbers))
    }

    /// Sends bytes to all other robots; to those in reach of the radio if it is a LocalBroadcast.
    fn send_all(&self, robot: &Handle, content: Vec<u8>) -> PyResult<()> {
        let mut kind = self.kind();
        if let Kind::LocalBroadcast(local) = &mut *kind {
            return robot.with(|robot| local.broadcast(robot, content[..].into()));
        }
        let broadcast = of_kind!(kind, Broadcast);
        robot.with(|robot| {
            broadcast.broadcast(robot, &content);
        })
    }

    fn send(&self, robot: &Handle, to: u32, content: Vec<u8>) -> PyResult<()> {
        let mut kind = self.kind();
        let unicast = of_kind!(kind, Unicast);
        robot.with(|robot| match robot.fleet().contains(&RobotId(to)) {
            true => {
                unicast.send(robot, RobotId(to), &content);
                Ok(())
            }
            false => Err(PyValueError::new_err(format!("there is no robot {to}"))),
        })?
    }

    fn acquire(&self, robot: &Handle, resources: Vec<String>) -> PyResult<()> {
        let mut kind = self.kind();
        let mutex = of_kind!(kind, Mutex);
        let resources = resources.into_iter().map(String::into_boxed_str).collect();
        robot
            .with(|robot| mutex.acquire(robot, resources))?
            .map_err(|_| {
                PyValueError::new_err("this robot holds resources already; release them first")
            })
    }

    fn release(&self, robot: &Handle, resources: Vec<String>) -> PyResult<()> {
        let mut kind = self.kind();
        let mutex = of_kind!(kind, Mutex);
        let resources = resources.into_iter().map(String::into_boxed_str).collect();
        robot.with(|robot| mutex.release(robot, &resources))
    }

    /// Whether the mutex is held, and whether it is waited for.
    fn held(&self) -> PyResult<(bool, bool)> {
        let mut kind = self.kind();
        let mutex = of_kind!(kind, Mutex);
        Ok((mutex.crit(), mutex.is_waiting()))
    }

    fn elect(&self, robot: &Handle) -> PyResult<()> {
        let mut kind = self.kind();
        let election = of_kind!(kind, LeaderElection);
        robot.with(|robot| election.elect(robot))
    }

    fn leader(&self) -> PyResult<Option<usize>> {
        let mut kind = self.kind();
        Ok(of_kind!(kind, LeaderElection).leader().map(RobotId::index))
    }

    fn suspects(&self) -> PyResult<Vec<usize>> {
        let mut kind = self.kind();
        Ok(of_kind!(kind, FailureDetector)
            .suspected()
            .map(RobotId::index)
            .collect())
    }

    fn register(&self, robot: &Handle) -> PyResult<()> {
        let mut kind = self.kind();
        let registration = of_kind!(kind, Registration);
        robot.with(|robot| registration.register(robot, None))
    }

    fn unregister(&self, robot: &Handle) -> PyResult<()> {
        let mut kind = self.kind();
        let registration = of_kind!(kind, Registration);
        robot.with(|robot| registration.unregister(robot))
    }

    /// The robots that have agreed to be registered; none before they agree.
    fn members(&self) -> PyResult<Option<Vec<usize>>> {
        let mut kind = self.kind();
        let members = of_kind!(kind, Registration).members();
        Ok(members.map(|members| members.iter().map(|robot| robot.index()).collect()))
    }

    fn arrive(&self, robot: &Handle) -> PyResult<()> {
        let mut kind = self.kind();
        let barrier = of_kind!(kind, Barrier);
        robot.with(|robot| barrier.arrive(robot))
    }

    /// Whether all have arrived, and whether this robot waits for others.
    fn passed(&self) -> PyResult<(bool, bool)> {
        let mut kind = self.kind();
        let barrier = of_kind!(kind, Barrier);
        Ok((barrier.passed(), barrier.is_waiting()))
    }

    fn write(&self, robot: &Handle, variable: &str, value: Vec<u8>) -> PyResult<()> {
        let mut kind = self.kind();
        let memory = of_kind!(kind, SharedMemory);
        let written = robot.with(|robot| memory.write(robot, variable, value[..].into()))?;
        written
            .map(|_| ())
            .map_err(|error| PyValueError::new_err(format!("{variable}: {error:?}")))
    }

    fn read(&self, variable: &str) -> PyResult<Option<Vec<u8>>> {
        let mut kind = self.kind();
        Ok(of_kind!(kind, SharedMemory)
            .read(variable)
            .map(<[u8]>::to_vec))
    }
}

impl Primitive {
    fn of(kind: Kind) -> Primitive {
        Primitive(Lock::new(kind))
    }

    fn kind(&self) -> MutexGuard<'_, Kind> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Shows the state machine.
    pub fn visit<T>(&self, visit: impl FnOnce(&mut dyn starl_core::Primitive) -> T) -> T {
        match &mut *self.kind() {
            Kind::ReachAvoid(primitive) => visit(&mut **primitive),
            Kind::Broadcast(primitive) => visit(&mut **primitive),
            Kind::Unicast(primitive) => visit(&mut **primitive),
            Kind::LocalBroadcast(primitive) => visit(&mut **primitive),
            Kind::Mutex(primitive) => visit(&mut **primitive),
            Kind::LeaderElection(primitive) => visit(&mut **primitive),
            Kind::FailureDetector(primitive) => visit(&mut **primitive),
            Kind::Registration(primitive) => visit(&mut **primitive),
            Kind::Barrier(primitive) => visit(&mut **primitive),
            Kind::SharedMemory(primitive) => visit(&mut **primitive),
            Kind::Geocast(primitive) => visit(&mut **primitive),
            Kind::Register(operations) => visit(&mut operations.register),
        }
    }

    /// Overwrites state at random that primitives of programs in the language may lose so.
    pub fn corrupt(&self, random: &mut Random) {
        match &mut *self.kind() {
            Kind::Barrier(barrier) => barrier.corrupt(random),
            Kind::Registration(registration) => registration.corrupt(random),
            _ => {}
        }
    }

    /// Whether messages of this port are bytes as they were sent, and not bytes within a packet.
    pub fn passes_raw(&self) -> bool {
        matches!(*self.kind(), Kind::LocalBroadcast(_))
    }
}
