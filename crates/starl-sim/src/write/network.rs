//! Writes `network`.

use super::fleet::names;
use super::table::{Table, flag, metres, number, quantity, text, time};
use crate::scenario::{DelayDistribution, Fleet, Link, LinkOverride, Network};

/// How messages travel.
pub(super) fn write(network: &Network, fleet: &Fleet) -> String {
    let Network {
        link,
        range,
        line_of_sight,
        bandwidth,
        queue,
        largest,
        resolution,
        overrides,
    } = network;
    let default = Network::default();
    let mut table = Table::named("network");
    set_link(&mut table, link, Some(&default.link));
    if let Some(range) = range {
        table.set("range", metres(*range));
    }
    table.differing("line_of_sight", *line_of_sight, default.line_of_sight, flag);
    if let Some(bandwidth) = bandwidth {
        table.set("bandwidth", quantity(*bandwidth, "bit/s"));
    }
    table.differing("queue", *queue, default.queue, time);
    table.differing("largest", *largest, default.largest, |bytes| {
        bytes.to_string()
    });
    table.differing("resolution", *resolution, default.resolution, time);
    let mut out = table.finish();
    for LinkOverride { from, to, link } in overrides {
        let mut table = Table::element("network.link");
        for (name, robots) in [("from", from), ("to", to)] {
            if let Some(robots) = robots {
                table.set(name, names(fleet, robots));
            }
        }
        // Without the field it would be the network's.
        set_link(&mut table, link, None);
        out += &table.finish_element();
    }
    out
}

/// The fields of a link that are not as in `base`.
fn set_link(table: &mut Table, link: &Link, base: Option<&Link>) {
    let Link {
        delay,
        jitter,
        distribution,
        loss,
        duplication,
        reordering,
        reordering_delay,
    } = *link;
    let differs = |differs: fn(&Link, &Link) -> bool| base.is_none_or(|base| differs(link, base));
    let mut set = |is_set: bool, name: &str, value: String| {
        if is_set {
            table.set(name, value);
        }
    };
    set(differs(|a, b| a.delay != b.delay), "delay", time(delay));
    let has_jitter = distribution != DelayDistribution::Constant;
    let jitter_differs = differs(|a, b| a.jitter != b.jitter);
    set(has_jitter && jitter_differs, "jitter", time(jitter));
    let distribution_differs = differs(|a, b| a.distribution != b.distribution);
    set(
        distribution_differs,
        "distribution",
        text(word(distribution)),
    );
    set(differs(|a, b| a.loss != b.loss), "loss", number(loss));
    let duplication_differs = differs(|a, b| a.duplication != b.duplication);
    set(duplication_differs, "duplication", number(duplication));
    let reordering_differs = differs(|a, b| a.reordering != b.reordering);
    set(reordering_differs, "reordering", number(reordering));
    let delay_differs = differs(|a, b| a.reordering_delay != b.reordering_delay);
    set(delay_differs, "reordering_delay", time(reordering_delay));
}

/// The word for a distribution of delays.
pub(super) fn word(distribution: DelayDistribution) -> &'static str {
    match distribution {
        DelayDistribution::Constant => "constant",
        DelayDistribution::Uniform => "uniform",
        DelayDistribution::Normal => "normal",
        DelayDistribution::Exponential => "exponential",
    }
}
