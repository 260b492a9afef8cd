//! Reads `network`.

use super::names::Names;
use super::section::Section;
use crate::fields::FieldTable;
use crate::scenario::{Link, LinkOverride, Network};

/// How messages travel.
pub(super) fn read(table: Section<'_>, names: &Names) -> Network {
    let link = link(table, &Link::default());
    let overrides = table.tables("link", |table| LinkOverride {
        from: names.optional_robots(table, "from"),
        to: names.optional_robots(table, "to"),
        link: self::link(table, &link),
    });
    Network {
        link,
        overrides,
        ..Network::read(table)
    }
}

/// The properties of a link; missing fields are as in `base`.
fn link(table: Section<'_>, base: &Link) -> Link {
    let link = Link::read_over(table, base);
    check_delays(table, &link);
    link
}

/// Refuses distributions that would reach below zero, or that leave a given jitter without effect.
fn check_delays(table: Section<'_>, link: &Link) {
    let field = if table.has("jitter") || !table.has("delay") {
        "jitter"
    } else {
        "delay"
    };
    if let Some(found) = link.contradiction(table.has("jitter")) {
        table.problem(field, found.message, found.help);
    }
}
