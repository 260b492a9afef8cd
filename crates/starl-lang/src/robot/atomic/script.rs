//! Scripts for the two executions of an action: a trial, which computes its writes on copies and has no effect, and the
//! execution proper after the writes are stored. In the second one every call to the host returns the results of the
//! first, so that the action takes the same path.

use super::super::arguments::Called;
use crate::machine::{HostCall, Object};
use alloc::vec::Vec;

/// The results of a call to the host.
#[derive(Clone, Debug)]
pub struct Given {
    function: u32,
    scalars: Vec<u64>,
    objects: Vec<Object>,
    fuel: u64,
}

/// The treatment of calls to the host.
#[derive(Clone, Debug, Default)]
pub enum Script {
    /// Calls take effect.
    #[default]
    None,
    /// Calls take effect, and their results are recorded.
    Noted(Vec<Given>),
    /// Calls return the recorded results; calls other than queries take effect too. Contains the remaining results.
    Followed(alloc::collections::VecDeque<Given>),
}

impl Script {
    /// Notes what a call has given.
    pub fn note(&mut self, function: u32, call: &HostCall<'_>, called: &Called) {
        if let (Script::Noted(given), &Ok(fuel)) = (self, called) {
            given.push(Given {
                function,
                scalars: call.scalars.to_vec(),
                objects: call.objects.to_vec(),
                fuel,
            });
        }
    }

    /// The results of the next call, if they are recorded.
    pub fn next(&mut self, function: u32) -> Option<Given> {
        match self {
            Script::Followed(given) => given.pop_front().filter(|next| next.function == function),
            _ => None,
        }
    }

    /// To be followed next time.
    pub fn follow(self) -> Script {
        match self {
            Script::Noted(given) => Script::Followed(given.into()),
            other => other,
        }
    }
}

impl Given {
    /// Returns it again.
    pub fn give(self, call: &mut HostCall<'_>) -> Called {
        for (index, scalar) in self.scalars.into_iter().enumerate() {
            call.set_scalar(index, scalar);
        }
        for (index, object) in self.objects.into_iter().enumerate() {
            call.set_object(index, object);
        }
        Ok(self.fuel)
    }
}
