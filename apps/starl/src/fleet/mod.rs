//! Real fleets: `starl robot` runs one robot, and `starl fleet` has the commands for all of them.

mod connect;
mod device;
mod emulate;
mod file;
mod folder;
#[cfg(feature = "web")]
mod follow;
mod hardware;
mod key;
mod link;
mod member;
mod merge;
mod recorder;
mod ros2;
mod router;
mod status;
mod stop;
#[cfg(feature = "web")]
mod stream;
mod tell;
mod up;

#[cfg(feature = "web")]
pub use follow::follow;

use crate::args::{EmulateArguments, FleetCommand, RobotArguments};
use crate::failure::Failure;
use starl_catalog::programs::Registry;

/// `starl robot`
pub fn robot(arguments: &RobotArguments, registry: &Registry) -> Result<bool, Failure> {
    member::run(arguments, registry)
}

/// `starl emulate`
pub fn emulate(arguments: &EmulateArguments, registry: &Registry) -> Result<bool, Failure> {
    emulate::run(arguments, registry)
}

/// `starl fleet`
pub fn fleet(command: &FleetCommand, registry: &Registry) -> Result<bool, Failure> {
    match command {
        FleetCommand::Up(arguments) => up::up(arguments, registry),
        FleetCommand::Status(arguments) => status::show(arguments, registry),
        FleetCommand::Tell(arguments) => tell::tell(arguments, registry),
        FleetCommand::Stop(arguments) => stop::stop(arguments, registry),
        FleetCommand::Merge(arguments) => merge::run(arguments, registry),
        FleetCommand::Key(arguments) => key::make(arguments),
        FleetCommand::Router(arguments) => router::run(arguments, registry),
    }
}

/// Does this when the process ends that holds the other end of standard input.
fn when_abandoned(end: impl FnOnce() + Send + 'static) {
    std::thread::spawn(move || {
        // Nothing is ever written there.
        let _ = std::io::copy(&mut std::io::stdin(), &mut std::io::sink());
        end();
    });
}
