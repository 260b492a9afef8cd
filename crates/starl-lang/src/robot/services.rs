//! The services that the primitives of a program share: the storage of its shared variables, and the failure detector.
//! A program has the services that its primitives need.

use super::atomic::{Atomic, Groups};
use alloc::boxed::Box;
use alloc::format;
use alloc::string::String;
use starl_core::{Input, Port, Primitive, Random, Robot};
use starl_primitives::{FailureDetector, SharedMemory, failure_detector, shared_memory};

/// The services that a kind of primitive needs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Needs {
    /// The memory that shared variables lie in.
    pub memory: bool,
    /// The detector of failed robots.
    pub detector: bool,
    /// The services of actions with `atomic`.
    pub atomic: bool,
}

impl Needs {
    /// Nothing.
    pub const NOTHING: Needs = Needs {
        memory: false,
        detector: false,
        atomic: false,
    };

    /// The detector alone.
    pub const DETECTOR: Needs = Needs {
        detector: true,
        ..Needs::NOTHING
    };

    /// The needs of either.
    pub fn or(self, other: Needs) -> Needs {
        Needs {
            memory: self.memory || other.memory,
            detector: self.detector || other.detector,
            atomic: self.atomic || other.atomic,
        }
    }
}

/// The common parts of one robot's program. Before its start it has none.
#[derive(Clone, Debug, Default)]
pub struct Services {
    /// The shared variables.
    pub memory: Option<Box<SharedMemory>>,
    /// The linearizable variables.
    pub atomic: Option<Box<Atomic>>,
    /// The failure detector.
    pub detector: Option<Box<FailureDetector>>,
}

impl Services {
    /// The services of a program of this name, not started.
    pub fn of(program: &str, needs: Needs) -> Services {
        let Needs {
            memory,
            detector,
            atomic,
        } = needs;
        let memory = memory.then(|| {
            let options = shared_memory::Options::default();
            Box::new(SharedMemory::new(&format!("{program}/shared"), options))
        });
        let detector = detector.then(|| {
            let options = failure_detector::Options::default();
            Box::new(FailureDetector::new(&detector_name(program), options))
        });
        let atomic = atomic.then(|| Box::new(Atomic::new(program)));
        Services {
            memory,
            atomic,
            detector,
        }
    }

    /// A copy of these, started.
    pub fn started(&self, groups: &Groups, robot: &mut Robot<'_>) -> Services {
        let mut services = self.clone();
        services.primitives(groups, &mut |primitive| {
            primitive.handle(robot, &Input::Start)
        });
        services
    }

    /// Whether one of them listens at the port.
    pub fn listen_at(&mut self, groups: &Groups, port: Port) -> bool {
        let mut found = false;
        self.primitives(groups, &mut |primitive| found |= primitive.port() == port);
        found
    }

    /// Shows each to `visit`, always in the same order.
    pub fn primitives(&mut self, groups: &Groups, visit: &mut dyn FnMut(&mut dyn Primitive)) {
        if let Some(memory) = &mut self.memory {
            visit(&mut **memory);
        }
        if let Some(atomic) = &mut self.atomic {
            atomic.primitives(groups, visit);
        }
        if let Some(detector) = &mut self.detector {
            visit(&mut **detector);
        }
    }

    /// Overwrites their states at random.
    pub fn corrupt(&mut self, groups: &Groups, random: &mut Random) {
        if let Some(memory) = &mut self.memory {
            memory.corrupt(random);
        }
        if let Some(atomic) = &mut self.atomic {
            atomic.corrupt(groups, random);
        }
        if let Some(detector) = &mut self.detector {
            detector.corrupt(random);
        }
    }
}

/// Where the failure detector of the program of this name listens.
pub fn detector_port(program: &str) -> Port {
    Port::named(&detector_name(program))
}

/// The name of a program's detector.
fn detector_name(program: &str) -> String {
    format!("{program}/failures")
}
