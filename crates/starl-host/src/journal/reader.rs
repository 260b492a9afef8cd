//! Reads the contents of a journal.

use super::batch::Frame;
use super::knowledge::Knowledge;
use super::lists::List;
use super::{Entry, Observed};
use alloc::collections::BTreeMap;
use starl_core::{RobotId, Time};
use thiserror::Error;

/// Reads one robot's journal from the messages of a trace.
#[derive(Clone, Debug)]
pub struct Reader {
    robot: RobotId,
    known: Knowledge,
    lists: BTreeMap<u64, List>,
}

/// The bytes are not a journal.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[error("its bytes are not those of a journal")]
pub struct Damaged;

impl Reader {
    /// A reader of this robot's entries.
    pub fn new(robot: RobotId) -> Reader {
        Reader {
            robot,
            known: Knowledge::default(),
            lists: BTreeMap::new(),
        }
    }

    /// Reads the next message and shows each of the robot's entries to `see`. Messages must be passed in the order in
    /// which they were packed, without omissions.
    ///
    /// # Errors
    /// If the bytes are not a journal. The entries before are shown.
    pub fn read(
        &mut self,
        start: Time,
        mut message: &[u8],
        see: &mut dyn FnMut(Time, Observed<'_>),
    ) -> Result<(), Damaged> {
        while !message.is_empty() {
            let (frame, rest) = postcard::take_from_bytes(message).map_err(|_| Damaged)?;
            message = rest;
            match frame {
                Frame::List { hash, list } => {
                    let list = decode(list)?;
                    self.lists.insert(hash, list);
                }
                Frame::Entry {
                    robot,
                    after,
                    entry,
                } if robot == self.robot => {
                    let at = Time(start.0.checked_add(after).ok_or(Damaged)?);
                    self.show(at, decode(entry)?, see)?;
                }
                Frame::Entry { .. } => {}
            }
        }
        Ok(())
    }

    fn show(
        &mut self,
        at: Time,
        entry: Entry<'_>,
        see: &mut dyn FnMut(Time, Observed<'_>),
    ) -> Result<(), Damaged> {
        match &entry {
            Entry::Started { random, saved } => {
                let saved = saved.as_deref();
                see(at, Observed::Started { random, saved });
            }
            Entry::Corrupted { random } => see(at, Observed::Corrupted { random }),
            Entry::Input {
                input,
                change,
                effects,
            } => {
                change.apply(&mut self.known, at)?;
                if let Some(new) = &change.surroundings {
                    for hash in [new.fleet, new.way_points, new.obstacles]
                        .into_iter()
                        .flatten()
                    {
                        let list = self.lists.get(&hash).ok_or(Damaged)?;
                        list.clone().put_into(&mut self.known);
                    }
                }
                let view = &self.known.view(self.robot, at);
                see(
                    at,
                    Observed::Input {
                        input,
                        view,
                        effects,
                    },
                );
            }
        }
        Ok(())
    }
}

/// Decodes a value that takes all the bytes.
fn decode<'a, T: serde::Deserialize<'a>>(bytes: &'a [u8]) -> Result<T, Damaged> {
    match postcard::take_from_bytes(bytes) {
        Ok((value, [])) => Ok(value),
        _ => Err(Damaged),
    }
}
