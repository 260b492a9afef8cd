//! A robot's journal: all calls of the robot's software by its host, with the robot's knowledge at each call and the
//! effects.
//!
//! A [`Journal`] records the calls that nodes show to [`crate::Outlet::observe`], a [`Reader`] reads them, and a
//! [`crate::Replayer`] repeats them without a host. An entry contains only the changes of the robot's knowledge since
//! its previous entry. Lists that many robots share (the fleet, waypoints, obstacles) are stored once, under the hash
//! of their content. Everything is restored exactly.
//!
//! The encoding is postcard's. `docs/reference/trace.md` describes it.

mod batch;
mod bytes;
mod change;
mod delta;
mod knowledge;
mod lists;
mod reader;
mod writer;

pub use batch::{Batch, Noted, Packer};
pub use reader::{Damaged, Reader};
pub use writer::Journal;

pub(crate) use bytes::encode;

use alloc::borrow::Cow;
use change::Change;
use serde::{Deserialize, Serialize};
use starl_core::{Effect, Input, Random, Saved, View};

/// The version of the encoding. It is incremented by every change of the encoding, including changes of the types of
/// `starl-core` that it contains.
pub const VERSION: u32 = 1;

/// Something that is done to a robot's software.
#[derive(Clone, Copy, Debug)]
pub enum Observed<'a> {
    /// The robot has fresh software, which has not taken an input yet.
    Started {
        /// The stream that the software draws from.
        random: &'a Random,
        /// The contents of its storage; none if the robot has none.
        saved: Option<&'a Saved>,
    },
    /// The program's state is overwritten at random: [`starl_core::Program::corrupt`].
    Corrupted {
        /// The stream that decides by what.
        random: &'a Random,
    },
    /// The software takes an input.
    Input {
        /// The input.
        input: &'a Input,
        /// The robot's knowledge.
        view: &'a View<'a>,
        /// The effects of the software.
        effects: &'a [Effect],
    },
}

/// [`Observed`] as it is encoded.
#[expect(
    clippy::large_enum_variant,
    reason = "one at a time is made, on the stack"
)]
#[derive(Serialize, Deserialize)]
enum Entry<'a> {
    Started {
        random: Cow<'a, Random>,
        saved: Option<Cow<'a, Saved>>,
    },
    Corrupted {
        random: Cow<'a, Random>,
    },
    Input {
        input: Cow<'a, Input>,
        change: Change<'a>,
        effects: Cow<'a, [Effect]>,
    },
}
