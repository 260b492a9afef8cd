//! Robots above one another: which of them need no avoidance in the plane, and how far a robot may
//! climb or descend.
//!
//! Two bodies are avoided in the plane as soon as the free height between them is below a clearance,
//! which both judge alike. A robot does not climb or sink into that clearance, each taking half of
//! the height that is left, unless it has room beside the other.

use super::Avoidance;
use super::pace::Pace;
use super::plane::{larger, smaller};
use crate::Neighbour;
use starl_core::motion::{Body, Estimate};

impl Avoidance {
    /// Whether the neighbour passes above or below with enough free height.
    pub(super) fn is_clear_in_height(
        &self,
        body: &Body,
        pace: &Pace,
        estimate: &Estimate,
        neighbour: &Neighbour,
    ) -> bool {
        let own = estimate.pose.position.z;
        let gap = free_height(own, body.height, neighbour);
        let above = if neighbour.position.z > own {
            1.0
        } else {
            -1.0
        };
        let closing = (estimate.twist.linear.z - neighbour.velocity.z) * above;
        let time = pace.braking_time + pace.horizon;
        gap >= self.options.vertical_clearance && gap - closing * time > 0.0
    }

    /// The height to go to: the wished one, or as near to it as neighbours above and below allow.
    pub(super) fn height(
        &self,
        body: &Body,
        pace: &Pace,
        estimate: &Estimate,
        wished: f64,
        neighbours: &[Neighbour],
    ) -> f64 {
        let here = estimate.pose.position;
        if !body.flies() || wished == here.z {
            return wished;
        }
        let (mut low, mut high) = (f64::NEG_INFINITY, f64::INFINITY);
        for neighbour in neighbours {
            let gap = free_height(here.z, body.height, neighbour);
            let beside = neighbour.position.planar_distance(here) - body.radius - neighbour.radius;
            let closing = estimate.twist.linear - neighbour.velocity;
            let room = 2.0 * self.options.margin
                + closing.planar_length() * (pace.braking_time + pace.horizon);
            if gap <= 0.0 || beside > room {
                continue;
            }
            let share = larger(0.5 * (gap - self.options.vertical_clearance), 0.0);
            if neighbour.position.z > here.z {
                high = smaller(high, here.z + share);
            } else {
                low = larger(low, here.z - share);
            }
        }
        larger(smaller(wished, high), low)
    }
}

/// Free height between the body and the neighbour, metres; negative if their heights overlap.
fn free_height(own: f64, height: f64, neighbour: &Neighbour) -> f64 {
    larger(
        neighbour.position.z - (own + height),
        own - (neighbour.position.z + neighbour.height),
    )
}
