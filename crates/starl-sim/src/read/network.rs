//! Reads `network`.

use super::names::Names;
use super::section::Section;
use crate::scenario::{DelayDistribution, Link, LinkOverride, Network};
use starl_core::Duration;

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
        overrides,
    }
}

/// What a link does; what is left out is as in `base`, or else as the schema says.
fn link(table: Section<'_>, base: &Link) -> Link {
    let duration = |name, base| table.optional_duration(name).unwrap_or(base);
    let probability = |name, base| table.optional_number(name).unwrap_or(base);
    let distribution = match table.choice("distribution").as_deref() {
        Some("constant") => DelayDistribution::Constant,
        Some("uniform") => DelayDistribution::Uniform,
        Some("normal") => DelayDistribution::Normal,
        Some("exponential") => DelayDistribution::Exponential,
        _ => base.distribution,
    };
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

/// Refuses distributions that would reach below zero, or that leave a given jitter without effect.
fn check_delays(table: Section<'_>, link: &Link) {
    let (delay, jitter) = (link.delay, link.jitter);
    let field = if table.has("jitter") || !table.has("delay") {
        "jitter"
    } else {
        "delay"
    };
    match link.distribution {
        DelayDistribution::Constant if table.has("jitter") && jitter > Duration::ZERO => {
            let help = "leave it out, or choose another distribution";
            table.problem("jitter", "a constant delay has no jitter", help);
        }
        DelayDistribution::Uniform if jitter.seconds() * 3.0_f64.sqrt() > delay.seconds() => {
            let message = format!(
                "a delay of {delay} cannot vary evenly with a jitter of {jitter}: it would be \
                 negative at times"
            );
            let help = "make the jitter at most 0.57 of the delay, or choose another distribution";
            table.problem(field, message, help);
        }
        DelayDistribution::Exponential if jitter > delay => {
            let message =
                format!("an exponential delay of {delay} cannot have the greater jitter {jitter}");
            let help = "make the jitter at most the delay, or choose another distribution";
            table.problem(field, message, help);
        }
        _ => {}
    }
}
