//! Writes `network`.

use super::fleet::names;
use super::table::Table;
use crate::fields::FieldTable;
use crate::scenario::{DelayDistribution, Fleet, Link, LinkOverride, Network};
use starl_core::Duration;

/// How messages travel.
pub(super) fn write(network: &Network, fleet: &Fleet) -> String {
    let default = Network::default();
    let mut table = Table::named("network");
    let link = without_jitter(network.link, default.link.jitter);
    link.write_over(&mut table, Some(&default.link));
    network.write_over(&mut table, Some(&default));
    let mut out = table.finish();
    for LinkOverride { from, to, link } in &network.overrides {
        let mut table = Table::element("network.link");
        for (name, robots) in [("from", from), ("to", to)] {
            if let Some(robots) = robots {
                table.set(name, names(fleet, robots));
            }
        }
        // Without the field it would be the network's.
        without_jitter(*link, Duration::ZERO).write_over(&mut table, None);
        out += &table.finish_element();
    }
    out
}

/// A constant delay has no jitter, and none may be written.
fn without_jitter(link: Link, jitter: Duration) -> Link {
    match link.distribution {
        DelayDistribution::Constant => Link { jitter, ..link },
        _ => link,
    }
}
