//! Finds where two runs part.

use crate::TraceError;
use core::fmt;
use starl_core::{Digest, Record};

/// The first place at which a run again is not as it was recorded.
#[derive(Clone, Debug, PartialEq)]
pub struct Difference {
    /// How many records agree before.
    pub agreed: u64,
    /// The next record of the recording; none if that has ended.
    pub recorded: Option<Record>,
    /// The next record of the run again; none if that has ended.
    pub rerun: Option<Record>,
}

impl fmt::Display for Difference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "first difference after {} equal records:", self.agreed)?;
        write!(f, "  recorded: ")?;
        show(f, self.recorded.as_ref())?;
        write!(f, "\n  run again: ")?;
        show(f, self.rerun.as_ref())
    }
}

fn show(f: &mut fmt::Formatter<'_>, record: Option<&Record>) -> fmt::Result {
    let Some(Record { at, robot, event }) = record else {
        return write!(f, "nothing more");
    };
    write!(f, "at {} ns", at.0)?;
    match robot {
        Some(robot) => write!(f, ", robot {robot}: {event:?}"),
        None => write!(f, ", the world: {event:?}"),
    }
}

/// Compares a recording with a repeated run during that run: pass each of its records to [`Comparison::push`].
pub struct Comparison<I> {
    recorded: I,
    agreed: u64,
    difference: Option<Difference>,
}

impl<I: Iterator<Item = Result<Record, TraceError>>> Comparison<I> {
    /// Compares with these records, e.g. a [`crate::Reader`].
    pub fn new(recorded: I) -> Comparison<I> {
        Comparison {
            recorded,
            agreed: 0,
            difference: None,
        }
    }

    /// The next record of the run again. After the first difference nothing more is compared.
    pub fn push(&mut self, rerun: &Record) -> Result<(), TraceError> {
        if self.difference.is_some() {
            return Ok(());
        }
        let recorded = self.recorded.next().transpose()?;
        if recorded
            .as_ref()
            .is_some_and(|recorded| same(recorded, rerun))
        {
            self.agreed += 1;
        } else {
            let (agreed, rerun) = (self.agreed, Some(rerun.clone()));
            self.difference = Some(Difference {
                agreed,
                recorded,
                rerun,
            });
        }
        Ok(())
    }

    /// The first difference, once one was found.
    pub fn difference(&self) -> Option<&Difference> {
        self.difference.as_ref()
    }

    /// The run again has ended: the first difference, or none.
    pub fn finish(mut self) -> Result<Option<Difference>, TraceError> {
        if self.difference.is_none()
            && let Some(left) = self.recorded.next().transpose()?
        {
            let (agreed, recorded) = (self.agreed, Some(left));
            self.difference = Some(Difference {
                agreed,
                recorded,
                rerun: None,
            });
        }
        Ok(self.difference)
    }

    /// How many records agreed so far.
    pub fn agreed(&self) -> u64 {
        self.agreed
    }
}

/// The first place at which two sequences of records differ.
pub fn first_difference(
    recorded: impl IntoIterator<Item = Record>,
    rerun: impl IntoIterator<Item = Record>,
) -> Option<Difference> {
    let mut comparison = Comparison::new(recorded.into_iter().map(Ok));
    for record in rerun {
        let _ = comparison.push(&record);
        if comparison.difference().is_some() {
            break;
        }
    }
    comparison.finish().ok().flatten()
}

/// Whether two records are the same to the last bit. Zeros of different sign are equal as numbers but
/// not here, and a not-a-number is the same as itself.
fn same(a: &Record, b: &Record) -> bool {
    let fingerprint = |record: &Record| {
        let mut digest = Digest::default();
        digest.event(record.at, &record.event);
        digest
    };
    (a.at, a.robot) == (b.at, b.robot) && fingerprint(a) == fingerprint(b)
}
