//! Reads `network`.

use super::names::Names;
use super::section::Section;
use crate::scenario::{DelayDistribution, Link, LinkOverride, Network};

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
        range: table.optional_number("range"),
        line_of_sight: table.flag("line_of_sight"),
        bandwidth: table.optional_number("bandwidth"),
        queue: table.duration("queue"),
        largest: table.count("largest").unwrap_or_default() as u32,
        resolution: table.duration("resolution"),
        overrides,
    }
}

/// The properties of a link; missing fields are as in `base`, or else as the schema says.
fn link(table: Section<'_>, base: &Link) -> Link {
    let duration = |name, base| table.optional_duration(name).unwrap_or(base);
    let probability = |name, base| table.optional_number(name).unwrap_or(base);
    let distribution = distribution(table).unwrap_or(base.distribution);
    let link = Link {
        delay: duration("delay", base.delay),
        jitter: duration("jitter", base.jitter),
        distribution,
        loss: probability("loss", base.loss),
        duplication: probability("duplication", base.duplication),
        reordering: probability("reordering", base.reordering),
        reordering_delay: duration("reordering_delay", base.reordering_delay),
    };
    check_delays(table, &link);
    link
}

/// The field `distribution`.
pub(super) fn distribution(table: Section<'_>) -> Option<DelayDistribution> {
    match table.choice("distribution").as_deref() {
        Some("constant") => Some(DelayDistribution::Constant),
        Some("uniform") => Some(DelayDistribution::Uniform),
        Some("normal") => Some(DelayDistribution::Normal),
        Some("exponential") => Some(DelayDistribution::Exponential),
        _ => None,
    }
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
