//! Robots restart again and again, and majorities all at once.

use super::Trouble;
use crate::scenario::FaultKind;
use starl_core::{Duration, RobotId, Time};

/// One robot, or all in turn, restart four to twelve times after a moment each.
pub(super) fn repeat(trouble: &mut Trouble<'_>) {
    let robots = trouble.robots();
    let count = trouble.count(4, 12);
    let only = trouble.random.chance(0.5).then(|| trouble.one(&robots));
    let mut moments: Vec<Time> = (0..count).map(|_| trouble.moment()).collect();
    moments.sort_unstable();
    for (place, &at) in moments.iter().enumerate() {
        let robot = only.unwrap_or(robots[place % robots.len()]);
        let most = if trouble.random.chance(0.5) {
            300
        } else {
            3000
        };
        let pause = Duration::from_millis(trouble.count(1, most).into());
        // It is up for a moment before it goes down again.
        let next = moments.get(place + 1).copied().unwrap_or(trouble.until);
        down(trouble, vec![robot], at, (at + pause).min(next));
    }
}

/// More than half of the robots crash at once, once or twice, and return together or one by one.
pub(super) fn majority(trouble: &mut Trouble<'_>) {
    let robots = trouble.robots();
    let mut moments = [trouble.moment(), trouble.moment()];
    moments.sort_unstable();
    let mut all_up = Time::ZERO;
    for at in moments.into_iter().take(trouble.count(1, 2) as usize) {
        if at < all_up {
            continue;
        }
        let size = trouble.count(robots.len() as u32 / 2 + 1, robots.len() as u32);
        let mut struck = trouble.some(robots.clone(), size as usize);
        struck.sort_unstable();
        let groups = match trouble.random.chance(0.5) {
            true => vec![struck],
            false => struck.into_iter().map(|robot| vec![robot]).collect(),
        };
        for group in groups {
            let up = (at + trouble.span(0.01, 0.2)).min(trouble.until);
            down(trouble, group, at, up);
            all_up = all_up.max(up);
        }
    }
}

/// These robots are down from one moment to another, and restart.
fn down(trouble: &mut Trouble<'_>, robots: Vec<RobotId>, from: Time, to: Time) {
    if from < to {
        trouble.add(from, FaultKind::Crash(robots.clone()));
        trouble.add(to, FaultKind::Restart(robots));
    }
}
