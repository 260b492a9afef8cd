//! Registers and calls of a running program. One workspace serves any number of robots, one after
//! the other: nothing in it outlives an activation.

use crate::machine::value::object::Object;
use alloc::vec::Vec;

/// The scalar registers that a function sees.
pub(in crate::machine) const WINDOW: usize = 256;
/// The object registers that a function sees.
pub(in crate::machine) const OBJECT_WINDOW: usize = 128;
/// The scalar registers of a function.
pub(in crate::machine) type Registers = [u64; WINDOW];

/// The deepest that calls may be nested.
pub(in crate::machine) const DEEPEST_CALL: usize = 1000;
/// The most scalar registers, those of all calls together.
const MOST_SCALARS: usize = 64 * 1024;
/// The most object registers, those of all calls together.
const MOST_OBJECTS: usize = 16 * 1024;

/// Where a call came from.
#[derive(Clone, Copy, Debug, Default)]
pub(in crate::machine) struct Frame {
    /// The instruction after the call.
    pub position: u32,
    /// Where the caller's scalar registers begin.
    pub base: u32,
    /// Where the caller's object registers begin.
    pub object_base: u32,
}

/// The registers of running functions; grows as calls need it, up to fixed bounds.
#[derive(Clone, Debug)]
pub struct Workspace {
    pub(in crate::machine) scalars: Vec<u64>,
    pub(in crate::machine) objects: Vec<Object>,
    pub(in crate::machine) frames: Vec<Frame>,
    /// Whether object registers may hold anything.
    pub(in crate::machine) used: bool,
}

impl Default for Workspace {
    fn default() -> Workspace {
        Workspace {
            scalars: alloc::vec![0; 2 * WINDOW],
            objects: alloc::vec![Object::EMPTY; OBJECT_WINDOW],
            frames: alloc::vec![Frame::default(); 8],
            used: false,
        }
    }
}

impl Workspace {
    /// A workspace of the least size.
    pub fn new() -> Workspace {
        Workspace::default()
    }

    /// Frees the memory of deep calls.
    pub fn trim(&mut self) {
        if self.scalars.len() > 16 * WINDOW || self.objects.len() > 16 * OBJECT_WINDOW {
            *self = Workspace::new();
        }
    }

    /// Empties object registers.
    pub(in crate::machine) fn clear(&mut self) {
        if core::mem::take(&mut self.used) {
            self.objects.fill(Object::EMPTY);
        }
    }

    /// Makes room for windows that begin at these registers and for this number of calls; false if they exceed the
    /// bounds.
    #[cold]
    pub(in crate::machine) fn grow(
        &mut self,
        base: usize,
        object_base: usize,
        depth: usize,
    ) -> bool {
        let (scalars, objects) = (base + WINDOW, object_base + OBJECT_WINDOW);
        if scalars > MOST_SCALARS || objects > MOST_OBJECTS || depth > DEEPEST_CALL {
            return false;
        }
        if scalars > self.scalars.len() {
            self.scalars.resize((2 * scalars).min(MOST_SCALARS), 0);
        }
        if objects > self.objects.len() {
            self.objects
                .resize((2 * objects).min(MOST_OBJECTS), Object::EMPTY);
        }
        if depth > self.frames.len() {
            self.frames
                .resize((2 * depth).min(DEEPEST_CALL), Frame::default());
        }
        true
    }
}
