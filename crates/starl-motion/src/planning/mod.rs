//! Path planning: from a robot's position to its target, clear of the unsafe set.
//!
//! Hosts call [`plan`]. It grows the obstacles by the robot's body and checks whether the straight
//! line is free, which is the most frequent case. Otherwise one of the planners searches: [`rrt`],
//! [`rrt_connect`] or [`rrt_star`], in the plane for robots on the floor and in space for those in the
//! air. Paths are then shortened ([`shorten`]).
//!
//! The planners do not depend on robots: they search a [`space::Space`]. Collision tests are exact, not at sample
//! points, and the same request gives the same path on every machine.
//!
//! ```
//! use starl_core::Random;
//! use starl_motion::planning::free_space::FreeSpace;
//! use starl_motion::planning::grown::GrownList;
//! use starl_motion::planning::rrt_connect::{Options, rrt_connect};
//!
//! let mut list = GrownList::new();
//! list.push_box([3.0, 1.0], [4.0, 9.0]);
//! let space = FreeSpace::new([0.0, 0.0], [10.0, 10.0], list);
//! let options = Options { most_nodes: 1_000, longest_step: f64::INFINITY, shortest_step: 1e-3 };
//! let path = rrt_connect(&space, &[1.0, 5.0], &[9.0, 5.0], &options, &mut Random::keyed(1, &[]));
//! assert!(path.is_some());
//! ```

pub mod box_tree;
pub mod cost_tree;
mod dent;
mod driving;
pub mod ellipsoid;
pub mod escape;
pub mod free_space;
mod grow;
pub mod grown;
pub mod nearest;
mod outline;
pub mod ray;
pub mod rrt;
pub mod rrt_connect;
pub mod rrt_star;
pub mod shorten;
pub mod space;
mod task;
pub mod tree;
pub mod vector;

use crate::avoidance::OBSTACLE_MARGIN;
use crate::{Model, Neighbour};
use starl_core::motion::{Estimate, Path, PlanRequest};
use task::Task;

/// The options of planning that a host may change.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// The margin between the body and obstacles, as a fraction of the body's radius; see [`plan`] for exceptions.
    pub margin_radii: f64,
    /// The smallest margin if there is no path otherwise, metres. It must exceed the errors of positions and tracking,
    /// or the robot may touch obstacles. If it exceeds the whole margin, the whole margin is used.
    pub least_margin: f64,
    /// How far a robot that is too near to something may go to get clear of it, in radii.
    pub escape_radii: f64,
}

/// The least margin is so many standard deviations of positions.
const DEVIATIONS: f64 = 4.0;

impl Options {
    /// The defaults for robots whose positions err by this standard deviation, metres.
    pub fn with_accuracy(deviation: f64) -> Options {
        let options = Options::default();
        Options {
            least_margin: options.least_margin.max(DEVIATIONS * deviation),
            ..options
        }
    }
}

impl Default for Options {
    fn default() -> Options {
        Options {
            margin_radii: 0.3,
            least_margin: OBSTACLE_MARGIN,
            escape_radii: 4.0,
        }
    }
}

/// Waypoints from the estimated pose to the target; none if the planner gave up.
///
/// - The last waypoint is the target if the body can be there. If not, it is the nearest place where the body has the
///   margin, or half of the room that the request's vicinity leaves; if there is no such room, there is no path.
/// - The body stays out of the unsafe set along the whole path, with the margin of `margin_radii`. If there is no such
///   path, a half, a quarter and an eighth of the margin are tried, each with half of the remaining nodes, but never
///   below `least_margin`: a narrower passage has no path.
/// - If the start or end is within the margin of an obstacle, a smaller margin applies around that
///   end, within twice the missing distance. It is half of the gap, or `least_margin` if that is
///   more, or nine tenths of the gap if that is less than `least_margin`.
/// - If the body touches something at the start, the first waypoint is the nearest place with the
///   margin that can be reached by moving away from it. A robot whose centre is inside an obstacle
///   gets no path.
/// - A robot in the air below its lowest height of travel is assumed to have risen to it.
pub fn plan(
    model: &dyn Model,
    start: &Estimate,
    request: &PlanRequest,
    robots: &[Neighbour],
) -> Option<Path> {
    plan_with(&Options::default(), model, start, request, robots)
}

/// [`plan`] with options.
pub fn plan_with(
    options: &Options,
    model: &dyn Model,
    start: &Estimate,
    request: &PlanRequest,
    robots: &[Neighbour],
) -> Option<Path> {
    let body = model.body();
    let from = body.reachable(start.pose.position);
    let target = body.reachable(request.target);
    if !from.is_finite() || !target.is_finite() {
        return None;
    }
    let robots = if request.around_robots { robots } else { &[] };
    let task = Task {
        options,
        model,
        start,
        request,
        robots,
        from,
        target,
    };
    if body.flies() {
        task.solve::<3>()
    } else {
        task.solve::<2>()
    }
}
