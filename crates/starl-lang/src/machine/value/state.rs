//! The state of a robot's program between activations: its variables and nothing else.

use crate::machine::types::Layout;
use crate::machine::value::list::WORD;
use crate::machine::value::object::Object;
use alloc::boxed::Box;
use serde::{Deserialize, Serialize};
use starl_core::Digest;

/// The variables of one robot's program, in the layout that the program gives.
///
/// Cloning copies the scalars and shares the objects; equality and digest are of the bits.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct State {
    /// The scalars of all variables in order.
    pub scalars: Box<[u64]>,
    /// The objects of all variables in order.
    pub objects: Box<[Object]>,
}

impl State {
    /// All variables zero, false, empty, none.
    pub fn new(layout: &Layout) -> State {
        State {
            scalars: layout.scalars.iter().map(|_| 0).collect(),
            objects: layout.objects.iter().map(|_| Object::EMPTY).collect(),
        }
    }

    /// The size as if nothing were shared, bytes.
    pub fn bytes(&self) -> usize {
        let objects = self.objects.iter().map(|o| WORD + o.bytes()).sum::<usize>();
        size_of::<State>() + WORD * self.scalars.len() + objects
    }

    /// Folds the values of all variables into a digest.
    pub fn digest(&self, digest: &mut Digest) {
        self.scalars.iter().for_each(|&word| digest.word(word));
        self.objects.iter().for_each(|object| object.digest(digest));
    }
}
