//! A row: the result of one run.

use serde::{Deserialize, Serialize};
use starl_core::event::{PrimitiveEvent, ReachAvoidEvent};
use starl_core::{Event, Record};
use starl_sim::scenario::Goal;
use starl_sim::{Outcome, Run};

/// The result of one run. The same task gives the same row on every machine.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// The place of the task in its plan.
    pub number: u64,
    /// The seed.
    pub seed: u64,
    /// `reached`, `violated` (the goal was reached but a property violated), `timed_out` or `failed`.
    pub outcome: String,
    /// Whether the goal was reached, also where a property was violated.
    pub goal_reached: bool,
    /// The names of the violated properties, in order, each once.
    pub violated: Vec<String>,
    /// The hash of all events, hexadecimal.
    pub digest: String,
    /// When the run ended.
    pub sim_seconds: f64,
    /// When the goal was reached; none if it was not, or if the run is only to last.
    pub time_to_goal_seconds: Option<f64>,
    /// Robots at the end, those that have left too.
    pub robots: u64,
    /// Robots that are up at the end and have finished.
    pub robots_finished: u64,
    /// Robots that are up at the end and whose programs have failed.
    pub robots_failed: u64,
    /// How often properties were violated.
    pub violations: u64,
    /// Datagrams handed to the network.
    pub messages_sent: u64,
    /// Datagrams that arrived; one that is sent to all arrives at each receiver.
    pub messages_delivered: u64,
    /// Datagrams lost at random.
    pub messages_lost: u64,
    /// Datagrams dropped for another reason.
    pub messages_dropped: u64,
    /// Datagrams sent again by Broadcast, Geocast or Unicast.
    pub messages_retransmitted: u64,
    /// Content of the datagrams handed to the network, bytes.
    pub bytes_sent: u64,
    /// The number of contacts of bodies.
    pub collisions: u64,
    /// Sum of the distances that robots covered, metres.
    pub distance_m: f64,
    /// Waypoints reached by all robots.
    pub way_points: u64,
    /// How often ReachAvoid gave up a path and asked for another one.
    pub replans: u64,
    /// How often ReachAvoid gave up its target.
    pub gave_up: u64,
}

/// Counts that only the records of a run contain.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Counts {
    bytes_sent: u64,
    replans: u64,
}

impl Counts {
    pub fn observe(&mut self, records: &[Record]) {
        for record in records {
            match &record.event {
                Event::Sent { payload, .. } => self.bytes_sent += payload.len() as u64,
                Event::Primitive {
                    event: PrimitiveEvent::ReachAvoid(ReachAvoidEvent::Replan { .. }),
                    ..
                } => self.replans += 1,
                _ => {}
            }
        }
    }
}

impl Row {
    /// The row of a run that is over.
    pub(crate) fn of(run: &Run, (number, seed): (u64, u64), counts: Counts) -> Row {
        let simulation = run.simulation();
        let outcome = run.outcome();
        let goal_reached = matches!(outcome, Outcome::Reached | Outcome::Violated);
        let sim_seconds = simulation.now().seconds();
        let has_goal = simulation.scenario().goal != Goal::Duration;
        let (tally, progress) = (simulation.tally(), simulation.progress());
        let mut violated: Vec<String> = run
            .violations()
            .iter()
            .map(|violation| violation.property.to_string())
            .collect();
        violated.sort_unstable();
        violated.dedup();
        let robots = simulation.robots();
        let sum = |of: &dyn Fn(starl_core::RobotId) -> u32| {
            let counts = robots.iter().map(|robot| u64::from(of(*robot)));
            counts.sum()
        };
        Row {
            number,
            seed,
            outcome: outcome.word().to_string(),
            goal_reached,
            violated,
            digest: simulation.digest().to_string(),
            sim_seconds,
            time_to_goal_seconds: (goal_reached && has_goal).then_some(sim_seconds),
            robots: robots.len() as u64,
            robots_finished: progress.finished as u64,
            robots_failed: progress.failed as u64,
            violations: run.violations().len() as u64,
            messages_sent: tally.sent,
            messages_delivered: tally.delivered,
            messages_lost: tally.lost,
            messages_dropped: tally.drops.total(),
            messages_retransmitted: tally.retransmitted,
            bytes_sent: counts.bytes_sent,
            collisions: tally.collisions,
            distance_m: robots.iter().map(|robot| simulation.distance(*robot)).sum(),
            way_points: sum(&|robot| simulation.way_points(robot)),
            replans: counts.replans,
            gave_up: sum(&|robot| simulation.gave_up(robot)),
        }
    }

    /// Whether the goal was reached and no property was violated.
    pub fn is_success(&self) -> bool {
        self.outcome == Outcome::Reached.word()
    }
}
