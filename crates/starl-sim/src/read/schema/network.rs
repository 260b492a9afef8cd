//! The fields of `network`.

use super::*;

use crate::scenario::{Link, Network};

/// How messages travel.
pub(super) const NETWORK: &[Field] = &join::<Field, { KNOBS.len() + 2 }>(&[
    KNOBS,
    &[RESOLUTION],
    fields! {
        /// Links that differ from the rest; the last that matches counts.
        link = Kind::Tables(LINK), Word("none");
    },
]);

/// The resolution is the only field of the network that cannot be changed during a run.
const PARTS: (Field, &[Field]) = match Network::FIELDS.split_last() {
    Some((resolution, knobs)) => (*resolution, knobs),
    None => unreachable!(),
};
const RESOLUTION: Field = PARTS.0;

/// Fields that can also be changed during a run.
const KNOBS: &[Field] =
    &join::<Field, { Link::FIELDS.len() + PARTS.1.len() }>(&[Link::FIELDS, PARTS.1]);

/// Their names.
pub(in crate::read) const KNOB_NAMES: &[&str] = &{
    let mut names = [""; KNOBS.len()];
    let mut index = 0;
    while index < names.len() {
        names[index] = KNOBS[index].name;
        index += 1;
    }
    names
};

/// The same in an event, in which omitted fields do not change.
pub(super) const CHANGES: &[Field] = &{
    let mut fields = join::<Field, { KNOBS.len() }>(&[KNOBS]);
    let mut index = 0;
    while index < fields.len() {
        fields[index].default = Default::Kept(match fields[index].default {
            Default::Word(word) => Some(word),
            _ => None,
        });
        index += 1;
    }
    fields
};

const LINK: &[Field] = &{
    let ends = fields! {
        /// Senders.
        from = Kind::Robots, Word("all");
        /// Receivers.
        to = Kind::Robots, Word("all");
    };
    let mut fields = join::<Field, { Link::FIELDS.len() + 2 }>(&[ends, Link::FIELDS]);
    let mut index = ends.len();
    while index < fields.len() {
        fields[index].default = Default::Depends("the network's");
        index += 1;
    }
    fields
};
