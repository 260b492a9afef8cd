//! The axis of time: which part of a run is shown, and where each moment lies.
//!
//! Runs are quiet most of the time and busy for moments. So the axis gives a gap between two events room
//! by its logarithm: the order of events is kept, and a long silence takes little more room than a short
//! one. The times at its foot are exact.

use super::Extent;
use super::story::{MarkKind, Story};
use starl_core::{Duration, Time};

/// As many moments at which something happens are easy to read.
const MOMENTS: usize = 90;

/// Least and greatest room between two moments.
const ROOM: (f64, f64) = (5.0, 90.0);

/// Moments of a run with their places.
pub struct Axis {
    /// In ascending order; the ends of what is shown are the first and the last.
    moments: Vec<(Time, f64)>,
}

impl Axis {
    /// An axis from `left` on for the shown part of a story.
    pub fn new(story: &Story, extent: &Extent, left: f64) -> Axis {
        let violated = story.violations.first().map(|violation| violation.at);
        let end = extent
            .until
            .or(violated)
            .unwrap_or_else(|| last_of_interest(story));
        let mut times = moments(story);
        times.retain(|&at| at <= end);
        times.push(end);
        times.sort_unstable();
        times.dedup();
        let start = match extent.last {
            Some(last) => end - last,
            None => times[times.len().saturating_sub(MOMENTS)],
        };
        times.retain(|&at| at >= start);
        if times.first() != Some(&start) {
            times.insert(0, start);
        }
        let mut x = left;
        let mut moments = Vec::with_capacity(times.len());
        let mut before = start;
        for at in times {
            if at > before {
                x += room(at.since(before));
            }
            moments.push((at, x));
            before = at;
        }
        Axis { moments }
    }

    /// The time at which the shown part begins.
    pub fn start(&self) -> Time {
        self.moments[0].0
    }

    /// When it ends.
    pub fn end(&self) -> Time {
        self.moments[self.moments.len() - 1].0
    }

    /// Where it ends.
    pub fn right(&self) -> f64 {
        self.moments[self.moments.len() - 1].1
    }

    /// The position of a moment; moments before and after the shown part are at its ends.
    pub fn place(&self, at: Time) -> f64 {
        let after = self.moments.partition_point(|&(moment, _)| moment < at);
        let Some(&(next, x)) = self.moments.get(after) else {
            return self.right();
        };
        if next == at || after == 0 {
            return x;
        }
        let (last, start) = self.moments[after - 1];
        let share = at.since(last).seconds() / next.since(last).seconds();
        start + (x - start) * share
    }

    /// Whether a moment is in the shown part.
    pub fn shows(&self, at: Time) -> bool {
        self.start() <= at && at <= self.end()
    }

    /// Moments to write at the foot, far enough apart.
    pub fn ticks(&self, apart: f64) -> Vec<(Time, f64)> {
        let mut ticks: Vec<(Time, f64)> = Vec::new();
        for &(at, x) in self.moments.iter().rev() {
            if ticks.last().is_none_or(|&(_, last)| last - x >= apart) {
                ticks.push((at, x));
            }
        }
        ticks
    }
}

/// Room for a gap between two events.
fn room(gap: Duration) -> f64 {
    let millis = gap.seconds() * 1e3;
    (ROOM.0 + 9.0 * (1.0 + millis / 2.0).ln()).min(ROOM.1)
}

/// All moments at which something happens.
fn moments(story: &Story) -> Vec<Time> {
    let messages = story.messages.iter();
    let mut times: Vec<Time> = messages
        .flat_map(|message| [message.sent, message.at])
        .collect();
    times.extend(story.marks.iter().map(|mark| mark.at));
    times.extend(story.violations.iter().map(|violation| violation.at));
    for partition in &story.partitions {
        times.extend([partition.from, partition.to]);
    }
    times
}

/// When a run that went well has come to what it was for.
fn last_of_interest(story: &Story) -> Time {
    let mut marks = story.marks.iter().rev();
    let end = marks
        .find(|mark| mark.kind == MarkKind::End)
        .map(|mark| mark.at);
    end.unwrap_or(story.end)
}
