//! How the requests that wait at an arbiter stand, all in one pass in the order of their ranks: a crowd's every
//! message makes the arbiter look at all of it.

use super::super::Resources;
use super::entry::Entry;
use alloc::boxed::Box;
use alloc::collections::{BTreeMap, BTreeSet};
use alloc::vec::Vec;
use starl_core::RobotId;

/// How a request that waits stands.
#[derive(Debug)]
pub(super) struct Standing {
    pub robot: RobotId,
    /// An earlier request that it waits for, if the robot has not been informed of it yet.
    pub behind: Option<RobotId>,
    /// Whether it is its turn, and nothing in the way.
    pub is_next: bool,
    /// Later requests that have been granted some of its resources.
    pub granted_before_it: Vec<RobotId>,
}

/// All waiting requests, the earliest first; `tells` if waiting robots learn for which robots they wait.
pub(super) fn standings(entries: &BTreeMap<RobotId, Entry>, tells: bool) -> Vec<Standing> {
    let mut order: Vec<(RobotId, &Entry)> =
        entries.iter().map(|(&id, entry)| (id, entry)).collect();
    order.sort_unstable_by_key(|(robot, entry)| entry.rank(*robot));
    let mut granted: Vec<(RobotId, &Entry)> = order.clone();
    granted.retain(|(_, entry)| entry.is_granted);
    // The resources that all earlier ones request or hold.
    let mut claimed: BTreeSet<&Box<str>> = BTreeSet::new();
    let mut standings = Vec::new();
    for (robot, entry) in order {
        let wanted = &entry.wish.resources;
        if !entry.is_granted {
            let must_wait = wanted.iter().any(|resource| claimed.contains(resource));
            let rank = entry.rank(robot);
            let later = granted.iter().filter(|(peer, other)| {
                other.rank(*peer) > rank && overlap(&other.wish.resources, wanted)
            });
            let granted_before_it: Vec<RobotId> = later.map(|(peer, _)| *peer).collect();
            standings.push(Standing {
                robot,
                behind: match must_wait && tells && entry.told.is_none() {
                    true => first_before(entries, robot, entry),
                    false => None,
                },
                is_next: !must_wait && granted_before_it.is_empty(),
                granted_before_it,
            });
        }
        claimed.extend(wanted);
    }
    standings
}

/// Of the earlier ones that want or have some of the same, the robot with the least number.
fn first_before(
    entries: &BTreeMap<RobotId, Entry>,
    robot: RobotId,
    entry: &Entry,
) -> Option<RobotId> {
    let rank = entry.rank(robot);
    let mut before = entries.iter().filter(|&(&peer, other)| {
        other.rank(peer) < rank && overlap(&other.wish.resources, &entry.wish.resources)
    });
    before.next().map(|(&peer, _)| peer)
}

fn overlap(some: &Resources, others: &Resources) -> bool {
    !some.is_disjoint(others)
}
