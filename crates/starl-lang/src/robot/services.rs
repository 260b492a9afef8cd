//! The services that the primitives of a program share: the storage of its shared variables, and the failure detector.
//! A program has the services that its primitives need.

use super::atomic::{Atomic, Conflicts};
use super::code::Code;
use super::primitives::Needs;
use alloc::boxed::Box;
use alloc::format;
use alloc::string::String;
use starl_core::{Input, Port, Primitive, Random, Robot};
use starl_primitives::{FailureDetector, SharedMemory, failure_detector, shared_memory};

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

    /// The services of a program, started.
    pub fn start(code: &Code, robot: &mut Robot<'_>) -> Services {
        let mut services = code.services().clone();
        services.primitives(code, &mut |primitive| {
            primitive.handle(robot, &Input::Start)
        });
        services
    }

    /// Whether one of them listens at the port.
    pub fn listen_at(&mut self, code: &Code, port: Port) -> bool {
        let mut found = false;
        self.primitives(code, &mut |primitive| found |= primitive.port() == port);
        found
    }

    /// The operations that must wait while the writes of an action with `atomic` are being stored.
    pub fn held<'c>(&self, code: &'c Code) -> Option<&'c Conflicts> {
        code.conflicts(self.atomic.as_ref()?.stores()?)
    }

    /// Shows each to `visit`, always in the same order.
    pub fn primitives(&mut self, code: &Code, visit: &mut dyn FnMut(&mut dyn Primitive)) {
        if let Some(memory) = &mut self.memory {
            visit(&mut **memory);
        }
        if let Some(atomic) = &mut self.atomic {
            atomic.primitives(code, visit);
        }
        if let Some(detector) = &mut self.detector {
            visit(&mut **detector);
        }
    }

    /// Overwrites their states at random.
    pub fn corrupt(&mut self, code: &Code, random: &mut Random) {
        if let Some(memory) = &mut self.memory {
            memory.corrupt(random);
        }
        if let Some(atomic) = &mut self.atomic {
            atomic.corrupt(code, random);
        }
        if let Some(detector) = &mut self.detector {
            detector.corrupt(random);
        }
    }
}

/// The name of a program's detector.
fn detector_name(program: &str) -> String {
    format!("{program}/failures")
}

impl Code {
    /// Where the program's failure detector listens, if it has one.
    pub fn detector(&self) -> Option<Port> {
        let program = &self.program().bytecode().name;
        let has_one = self.needs().detector;
        has_one.then(|| Port::named(&detector_name(program)))
    }
}
