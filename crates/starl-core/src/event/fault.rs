//! The faults that traces record.

use super::Name;
use core::fmt;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// A fault that set in, or was healed. A partition, in both directions or one, and its end are the network's; all
/// others are a robot's.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Fault {
    /// The robot is down.
    Crash,
    /// A crash erased the robot's storage.
    StorageLost,
    /// The robot restarts, with no state except that in its storage.
    Restart,
    /// The network falls into parts, which may have been others before.
    Partition,
    /// Some robots are not heard by others, which they hear.
    OneWay,
    /// The network is whole again.
    Heal,
    /// The robot's motors do not answer.
    StuckMotor,
    /// The robot's sensors and positioning repeat their last readings.
    FrozenSensor,
    /// Motors, sensors and positioning work again.
    Repair,
    /// The variables of the robot's software were overwritten at random.
    CorruptState,
    /// Another one, of a host of its own.
    Other(Name),
}

impl Fault {
    /// All that have a name of their own.
    const KNOWN: [Fault; 10] = [
        Fault::Crash,
        Fault::StorageLost,
        Fault::Restart,
        Fault::Partition,
        Fault::OneWay,
        Fault::Heal,
        Fault::StuckMotor,
        Fault::FrozenSensor,
        Fault::Repair,
        Fault::CorruptState,
    ];

    /// Whether it keeps robots from hearing each other, until the network is whole again.
    pub fn parts(&self) -> bool {
        matches!(self, Fault::Partition | Fault::OneWay)
    }

    /// Its name in traces.
    pub fn name(&self) -> &str {
        match self {
            Fault::Crash => "crash",
            Fault::StorageLost => "storage lost",
            Fault::Restart => "restart",
            Fault::Partition => "partition",
            Fault::OneWay => "one way",
            Fault::Heal => "heal",
            Fault::StuckMotor => "stuck motor",
            Fault::FrozenSensor => "frozen sensor",
            Fault::Repair => "repair",
            Fault::CorruptState => "corrupt state",
            Fault::Other(name) => name,
        }
    }

    /// The fault that traces call so.
    pub fn named(name: Name) -> Fault {
        let known = Fault::KNOWN.into_iter().find(|fault| fault.name() == name);
        known.unwrap_or(Fault::Other(name))
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl Serialize for Fault {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.name())
    }
}

impl<'de> Deserialize<'de> for Fault {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Fault, D::Error> {
        Name::deserialize(deserializer).map(Fault::named)
    }
}
