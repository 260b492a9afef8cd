//! Quorums: each request asks only some participants, few enough to be cheap, and enough that any two
//! requests have a participant in common (Maekawa 1985).
//!
//! The participants form a grid with about the square root of their number of columns. A quorum is one whole
//! column and one robot of each other column (Cheung, Ammar and Ahamad 1990): of any two, the column of one
//! contains a robot of the other. Maekawa's own row and column is the case in which those robots are in one
//! row. There are many quorums, so one without suspected robots can be chosen.

use alloc::collections::BTreeSet;
use alloc::vec::Vec;
use starl_core::RobotId;

/// How many columns a grid of so many robots has: the root, rounded up, but with two robots in each as far
/// as there are any, so that one that failed can be left out.
fn columns(count: usize) -> usize {
    let root = (1..).find(|root| root * root >= count).unwrap_or(1);
    if count < 4 { root } else { root.min(count / 2) }
}

/// A quorum for this robot without `avoided` robots; none if there is no such quorum. The participants are in the order
/// of their numbers. The robot itself is in it, if it can be: its own grant costs nothing.
pub(super) fn quorum(
    everyone: &[RobotId],
    me: RobotId,
    avoided: &BTreeSet<RobotId>,
) -> Option<Vec<RobotId>> {
    let columns = columns(everyone.len());
    let place = everyone.binary_search(&me).unwrap_or(me.index() % columns);
    let (row, first) = (place / columns, place % columns);
    (first..columns)
        .chain(0..first)
        .find_map(|whole| with_column(everyone, whole, row, columns, avoided))
}

/// The quorum with one whole column and, of each other column, the robot in this row or below it.
fn with_column(
    everyone: &[RobotId],
    whole: usize,
    row: usize,
    columns: usize,
    avoided: &BTreeSet<RobotId>,
) -> Option<Vec<RobotId>> {
    let mut chosen = Vec::new();
    for column in 0..columns {
        let members: Vec<RobotId> = everyone
            .iter()
            .copied()
            .skip(column)
            .step_by(columns)
            .collect();
        if column == whole {
            chosen.extend(members);
        } else if !members.is_empty() {
            let from_row = (0..members.len()).map(|step| members[(row + step) % members.len()]);
            let mut usable = from_row.filter(|robot| !avoided.contains(robot));
            chosen.push(usable.next()?);
        }
    }
    let is_whole = chosen.iter().all(|robot| !avoided.contains(robot));
    is_whole.then_some(chosen)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn fleet(count: u32) -> Vec<RobotId> {
        (0..count).map(RobotId).collect()
    }

    #[test]
    fn any_two_quorums_have_a_robot_in_common() {
        for count in 1..=30 {
            let fleet = fleet(count);
            let mut quorums = Vec::new();
            for me in &fleet {
                for left_out in &fleet {
                    let avoided = BTreeSet::from([*left_out]);
                    quorums.extend(quorum(&fleet, *me, &avoided));
                }
                quorums.extend(quorum(&fleet, *me, &BTreeSet::new()));
            }
            for one in &quorums {
                for other in &quorums {
                    assert!(one.iter().any(|robot| other.contains(robot)), "{count}");
                }
            }
        }
    }

    #[test]
    fn a_robot_is_in_its_own_quorum_of_about_twice_the_root() {
        for count in 1..=200 {
            let fleet = fleet(count);
            for me in &fleet {
                let quorum = quorum(&fleet, *me, &BTreeSet::new()).expect("no robot is avoided");
                assert!(quorum.contains(me));
                assert!(quorum.len() <= 2 * columns(count as usize), "{count}");
            }
        }
    }

    #[test]
    fn a_failed_robot_is_left_out_where_there_are_four_or_more() {
        for count in 4..=30 {
            let fleet = fleet(count);
            for (me, failed) in fleet.iter().zip(fleet.iter().skip(1)) {
                let quorum = quorum(&fleet, *me, &BTreeSet::from([*failed]));
                assert!(
                    quorum.is_some_and(|quorum| !quorum.contains(failed)),
                    "{count}"
                );
            }
        }
    }
}
