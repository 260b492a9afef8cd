//! A robot's storage, which survives a restart.
//!
//! A robot's software saves values under keys ([`crate::Robot::save`]), and finds them again when it starts the next
//! time ([`crate::Robot::saved`]). Writes are atomic. All effects of an input, from messages to records, take place
//! only after everything saved by it and before it is in storage. A crash before that undoes the input. So no other
//! robot learns of a state that this one forgets. (This is output commit: Strom and Yemini 1985, "Optimistic Recovery
//! in Distributed Systems".)
//!
//! Robots need not have storage; then no value is saved or found.

use crate::event::Name;
use crate::{Payload, Port, message};
use alloc::collections::BTreeMap;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

/// One value to be written or taken away.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Save {
    /// The owner: the program, or a primitive.
    pub port: Port,
    /// Names it among those of its owner.
    pub key: Name,
    /// The new value; none removes it.
    pub value: Option<Payload>,
}

/// The contents of storage.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Saved {
    values: BTreeMap<(Port, Name), Payload>,
    is_whole: bool,
}

impl Default for Saved {
    /// Storage that is new: nothing was ever saved there.
    fn default() -> Saved {
        Saved {
            values: BTreeMap::new(),
            is_whole: true,
        }
    }
}

impl Saved {
    /// Storage that was erased, or may have been.
    pub fn lost() -> Saved {
        Saved {
            is_whole: false,
            ..Saved::default()
        }
    }

    /// Whether nothing was ever lost. If storage is empty then, the robot has never saved anything, so this
    /// is effectively its first life.
    pub fn is_whole(&self) -> bool {
        self.is_whole
    }

    /// Writes a value, or takes it away.
    pub fn apply(&mut self, save: Save) {
        let Save { port, key, value } = save;
        match value {
            Some(value) => self.values.insert((port, key), value),
            None => self.values.remove(&(port, key)),
        };
    }

    /// A value, if there is one and it is a `T`.
    pub fn get<T: DeserializeOwned>(&self, port: Port, key: &'static str) -> Option<T> {
        message::decode(self.values.get(&(port, Name::Borrowed(key)))?)
    }

    /// All values of an owner with their keys, in the order of the keys.
    pub fn of(&self, port: Port) -> impl Iterator<Item = (&str, &[u8])> {
        let from = (port, Name::Borrowed(""));
        let values = self.values.range(from..);
        let values = values.take_while(move |((owner, _), _)| *owner == port);
        values.map(|((_, key), value)| (&**key, &**value))
    }

    /// Whether nothing is held.
    pub fn is_empty(&self) -> bool {
        self.values.is_empty()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::vec::Vec;

    fn save(port: u32, key: &'static str, value: Option<u8>) -> Save {
        Save {
            port: Port(port),
            key: key.into(),
            value: value.map(|value| message::encode(&value)),
        }
    }

    #[test]
    fn each_owner_finds_its_own_values() {
        let mut saved = Saved::default();
        for (port, key, value) in [(2, "b", 1), (1, "a", 2), (2, "a", 3), (3, "", 4)] {
            saved.apply(save(port, key, Some(value)));
        }
        assert_eq!(saved.get::<u8>(Port(2), "a"), Some(3));
        assert_eq!(saved.get::<u8>(Port(1), "b"), None);
        let keys: Vec<&str> = saved.of(Port(2)).map(|(key, _)| key).collect();
        assert_eq!(keys, ["a", "b"]);
        saved.apply(save(2, "a", None));
        assert_eq!(saved.get::<u8>(Port(2), "a"), None);
        assert_eq!(saved.of(Port(2)).count(), 1);
    }

    #[test]
    fn a_value_of_another_type_is_not_found() {
        let mut saved = Saved::default();
        saved.apply(save(1, "a", Some(7)));
        assert_eq!(saved.get::<(u8, u8)>(Port(1), "a"), None);
    }
}
