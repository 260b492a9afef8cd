//! The network parts and heals.

use super::Trouble;
use crate::scenario::FaultKind;
use starl_core::RobotId;

/// One to three partitions one after the other, each into two parts, now and then into three; the last
/// is healed permanently, the others mostly.
pub(super) fn part(trouble: &mut Trouble<'_>) {
    cut(trouble, FaultKind::Partition);
}

/// The same, but that parts hear those before them.
pub(super) fn one_way(trouble: &mut Trouble<'_>) {
    cut(trouble, FaultKind::OneWay);
}

fn cut(trouble: &mut Trouble<'_>, kind: fn(Vec<Vec<RobotId>>) -> FaultKind) {
    let robots = trouble.robots();
    if robots.len() < 2 {
        return;
    }
    let count = trouble.count(1, 3);
    let mut moments: Vec<_> = (0..count).map(|_| trouble.moment()).collect();
    moments.sort_unstable();
    for (index, &at) in moments.iter().enumerate() {
        let parts = split(trouble, robots.clone());
        trouble.add(at, kind(parts));
        let next = moments.get(index + 1).copied();
        let end = (at + trouble.span(0.05, 0.5)).min(trouble.until);
        match next {
            // The next one takes its place.
            Some(next) if end >= next => {}
            _ => trouble.add(end, FaultKind::Heal),
        }
    }
}

/// Parts of a fleet, none of them empty, each in the order of the robots' numbers.
fn split(trouble: &mut Trouble<'_>, robots: Vec<RobotId>) -> Vec<Vec<RobotId>> {
    let (total, everyone) = (robots.len(), robots.len());
    let mut rest = trouble.some(robots, everyone);
    let parts = if total > 3 && trouble.random.chance(0.25) {
        3
    } else {
        2
    };
    let mut found = Vec::new();
    for missing in (1..parts).rev() {
        // At least one for each part that is still to come.
        let most = (rest.len() - missing) as u32;
        let size = trouble.count(1, most) as usize;
        found.push(rest.split_off(rest.len() - size));
    }
    found.push(rest);
    found.iter_mut().for_each(|part| part.sort_unstable());
    found
}
