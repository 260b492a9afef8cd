//! How an action runs twice: once to find out what it writes, on a copy of everything and with no effect, and
//! once for real when that is stored. The second time every call to the host gives what it gave the first
//! time, so that the action takes the same course.

use super::super::arguments::Called;
use crate::machine::{HostCall, Object};
use alloc::vec::Vec;

/// What a call to the host gave.
#[derive(Clone, Debug)]
pub struct Given {
    function: u32,
    scalars: Vec<u64>,
    objects: Vec<Object>,
    fuel: u64,
}

/// What calls to the host do.
#[derive(Clone, Debug, Default)]
pub enum Script {
    /// What they are for.
    #[default]
    None,
    /// What they are for, and it is noted what they give.
    Noted(Vec<Given>),
    /// Queries give what is noted, and so do others after they have done what they are for; those that
    /// remain.
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

    /// What the next call gives, if it is noted.
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
    /// Gives it again.
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
