//! Going to a place as a robot of a given model does: tracked in closed loop, simulated step by step.
//!
//! This is what a tree of the thesis is grown by. A robot that follows a path continues to the next waypoint without
//! stopping, from [`PASS`] metres if that way is free, so from there the straight way on must be clear; it must be
//! clear from the waypoint itself, too, which is what is seen of a path from outside. Since any waypoint may be the
//! last the robot is simulated until it is [`NEAR`]. Between two estimates the body moves along a short arc; its chord
//! is what is tested, exactly, and the margin of the grown obstacles covers the height of the arc.

use super::free_space::FreeSpace;
use super::grow::Mover;
use super::rrt::Steering;
use super::vector::Vector;
use crate::tracking::{Goal, Tracking};
use crate::{Disturbance, Model, State};
use alloc::vec::Vec;
use core::cell::Cell;
use starl_core::motion::Estimate;
use starl_core::{Duration, Time, math};

/// How near to a waypoint the robot continues to the next if that way is free, metres.
const PASS: f64 = 0.15;

/// How near to the last waypoint the robot comes, metres.
const NEAR: f64 = 0.06;

/// Nearer places are not worth driving to, metres: they are as good as passed.
pub const SHORTEST_DRIVE: f64 = 0.2;

/// A robot that has driven so far towards a place keeps on as it does until it is as near to the place, metres: what is
/// between is not simulated. Otherwise the work would grow with the distance, and a fault can set any target.
const FAR: f64 = 500.0;

/// Time between estimates.
const PERIOD: Duration = Duration::from_millis(100);

/// For each node of a tree so many steps are simulated, on average over the search. Where the tree has to fill a space
/// of thousands of kilometres this ends the search.
const STEPS_PER_NODE: u64 = 200;

/// A robot of a model, driving in a space.
#[derive(Clone, Debug)]
pub struct Driving<'a, const D: usize> {
    model: &'a dyn Model,
    space: &'a FreeSpace<D>,
    /// How many steps it may still simulate. No drive arrives without any.
    steps_left: Cell<u64>,
}

impl<'a, const D: usize> Driving<'a, D> {
    /// A robot of a model that drives in a space, for a search with at most so many nodes.
    pub fn new(model: &'a dyn Model, space: &'a FreeSpace<D>, most_nodes: u32) -> Driving<'a, D> {
        let steps_left = Cell::new(STEPS_PER_NODE * u64::from(most_nodes));
        Driving {
            model,
            space,
            steps_left,
        }
    }

    /// An upper bound of the steps of a drive that arrives: turning all the way round twice and
    /// thrice the distance, at the model's own pace.
    fn most_steps(&self, distance: f64) -> u32 {
        let limits = self.model.limits();
        let speed = limits.cruise_speed.clamp(1e-3, 1e3);
        let turning = 2.0 * math::TAU / limits.turn_rate.clamp(0.1, 1e3);
        let around = 2.0 * math::TAU * limits.turn_radius / speed;
        let seconds = 3.0 * distance / speed + turning + around + 2.0;
        (seconds / PERIOD.seconds()) as u32
    }

    /// Drives to a place; the state from which the robot would continue to another. `clear` is asked about every step
    /// from one place to the next.
    fn drive(
        &self,
        from: &State,
        to: &Vector<D>,
        clear: impl Fn(&Vector<D>, &Vector<D>) -> bool,
    ) -> Option<State> {
        let target = Mover::to_world(to);
        let goal = Goal::stop_at(target);
        let mut tracking = Tracking::default();
        let mut state = *from;
        let mut at = Time::ZERO;
        let mut passing = None;
        let whole = from.pose.position.distance(target);
        for _ in 0..self.most_steps(whole.min(2.0 * FAR)) {
            let mut distance = state.pose.position.distance(target);
            if distance > FAR && distance < whole - FAR {
                let before = state.pose.position;
                state.pose.position = target + (before - target) * (FAR / distance);
                if !clear(
                    &Mover::to_space(before),
                    &Mover::to_space(state.pose.position),
                ) {
                    return None;
                }
                distance = FAR;
            }
            if distance <= PASS {
                passing = passing.or(Some(state));
            }
            if distance <= NEAR {
                return passing;
            }
            self.steps_left.set(self.steps_left.get().checked_sub(1)?);
            let estimate = Estimate {
                pose: state.pose,
                twist: state.twist,
                at,
            };
            let command = self.model.track(&mut tracking, &estimate, &goal);
            let next = self
                .model
                .predict(&state, &command, &Disturbance::default(), PERIOD);
            let (a, b) = (state.pose.position, next.pose.position);
            if !clear(&Mover::to_space(a), &Mover::to_space(b)) {
                return None;
            }
            state = next;
            at += PERIOD;
        }
        None
    }

    /// Drives to a place whatever is in the way; where the robot is then, or was at first if it does
    /// not arrive.
    pub fn force(&self, from: &State, to: &Vector<D>) -> State {
        self.drive(from, to, |_, _| true).unwrap_or(*from)
    }

    /// Whether all the waypoints can be driven to in order, from the first, where the robot is.
    fn follows(&self, from: &State, mut path: impl Iterator<Item = Vector<D>>) -> bool {
        let Some(mut at) = path.next() else {
            return true;
        };
        let mut state = *from;
        for place in path {
            match self.go(&at, &state, &place) {
                Some(next) => (at, state) = (place, next),
                None => return false,
            }
        }
        true
    }

    /// Leaves out waypoints, the earliest first, wherever the rest can then still be driven. The
    /// first is where the robot is and stays.
    pub fn leave_out(&self, from: &State, path: &mut Vec<Vector<D>>) {
        let mut at = 1;
        while at + 1 < path.len() {
            let without = path.iter().enumerate().filter(|&(index, _)| index != at);
            if self.follows(from, without.map(|(_, place)| *place)) {
                path.remove(at);
            } else {
                at += 1;
            }
        }
    }
}

impl<const D: usize> Steering<D> for Driving<'_, D> {
    type State = State;

    fn go(&self, from: &Vector<D>, state: &State, to: &Vector<D>) -> Option<State> {
        let here = Mover::to_space(state.pose.position);
        if !self.space.is_clear(from, to) || !self.space.is_clear(&here, to) {
            return None;
        }
        self.drive(state, to, |a, b| self.space.is_clear(a, b))
    }
}
