//! Datagrams are lost, doubled, held back and delayed.

use super::Trouble;
use crate::scenario::{DelayDistribution, Link};
use starl_core::Duration;

/// Degrades all links that the scenario does not describe individually. Loss is 2 to 30 %, duplication
/// up to 20 %, and up to 30 % are held back by up to half a second. Delays are up to 100 ms on average
/// with a spread from none to the delay itself.
pub(super) fn lossy(trouble: &mut Trouble<'_>) {
    let delay = Duration::from_millis(trouble.count(5, 100).into());
    let jitter =
        Duration::from_millis((delay.seconds() * 1e3 * trouble.hundredths(0.0, 1.0)) as u64);
    let worse = Link {
        delay,
        jitter,
        distribution: DelayDistribution::Exponential,
        loss: trouble.hundredths(0.02, 0.3),
        duplication: trouble.hundredths(0.0, 0.2),
        reordering: trouble.hundredths(0.0, 0.3),
        reordering_delay: Duration::from_millis(trouble.count(20, 500).into()),
    };
    let link = &mut trouble.scenario.network.link;
    *link = Link {
        loss: worse.loss.max(link.loss),
        duplication: worse.duplication.max(link.duplication),
        reordering: worse.reordering.max(link.reordering),
        ..worse
    };
}

/// About every tenth copy arrives two to ten seconds late, and many arrive twice.
pub(super) fn late(trouble: &mut Trouble<'_>) {
    let reordering = trouble.hundredths(0.05, 0.2);
    let duplication = trouble.hundredths(0.1, 0.4);
    let delay = Duration::from_millis(trouble.count(2000, 10_000).into());
    let link = &mut trouble.scenario.network.link;
    link.reordering = reordering;
    link.reordering_delay = delay;
    link.duplication = duplication.max(link.duplication);
}
