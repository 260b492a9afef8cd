//! Refuses waypoints that no robot of the fleet can ever reach.
//!
//! A waypoint passes if some robot can get within its program's vicinity of it. The search uses a
//! grid in which a cell is free if any point in it could be free. So a waypoint is refused only if
//! it is certainly unreachable, never because the grid is coarse. Obstacles that expire do not
//! count, nor, for robots that fly, those that they might fly over.

use super::Placed;
use super::contents::Contents;
use super::report::Report;
use crate::scenario::{Bounds, Fleet, Group, Parameter};
use starl_core::geometry::{Bounds as Box, ObstacleIndex};
use starl_core::{Obstacle, Point, Time, WayPoint};

/// The vicinity of programs whose parameters do not say, metres.
const VICINITY: f64 = 0.075;

/// Cells of the search; enough for cells of 25 mm in a hall of 25 m.
const MOST_CELLS: f64 = 1_000_000.0;

/// Straight lines are tried from so many starts.
const STARTS_LOOKED_FROM: usize = 16;

/// Looks at every waypoint.
pub(super) fn check(fleet: &Fleet, contents: &Contents, report: &Report) {
    let mut open: Vec<&Placed<WayPoint>> = contents.way_points.iter().collect();
    let mut standing = vec![false; open.len()];
    for group in &fleet.groups {
        if open.is_empty() {
            return;
        }
        let free = FreeSpace::new(group, contents);
        for (place, stands) in contents.way_points.iter().zip(&mut standing) {
            *stands |= free.can_stand_near(place.value.position);
        }
        open = free.not_in_sight(group, open);
        if !open.is_empty() {
            // All the starts are one search: reachable is what any of the group can reach.
            let reached = free.flood(group);
            open.retain(|place| !free.near_reached(&reached, place.value.position));
        }
    }
    for (place, stands) in contents.way_points.iter().zip(standing) {
        let name = &place.value.name;
        if !stands {
            let message = format!("no robot of the fleet can stand near the waypoint {name}");
            let help = "move it away from the obstacles around it";
            report.problem_with_help(place.origin, &place.field, message, help);
        } else if open.iter().any(|other| std::ptr::eq(*other, place)) {
            let message = format!("no robot of the fleet can get to the waypoint {name}");
            let help = "open a way between the obstacles around it";
            report.problem_with_help(place.origin, &place.field, message, help);
        }
    }
}

/// Where the bodies of a group can be, in cells.
struct FreeSpace {
    obstacles: ObstacleIndex,
    bounds: Option<Bounds>,
    radius: f64,
    height: f64,
    vicinity: f64,
    low: Point,
    cell: f64,
    columns: usize,
    rows: usize,
}

impl FreeSpace {
    fn new(group: &Group, contents: &Contents) -> FreeSpace {
        let body = group.model.body();
        let counts = |obstacle: &&crate::scenario::WorldObstacle| {
            obstacle.expires == Time::NEVER
                && match (body.flies(), obstacle.obstacle.height()) {
                    (_, None) => true,
                    (true, Some(_)) => false,
                    (false, Some(span)) => span.high > 0.0 && span.low <= body.height,
                }
        };
        let obstacles: Vec<Obstacle> = (contents.obstacles.iter())
            .filter(counts)
            .map(|obstacle| obstacle.obstacle.clone())
            .collect();
        let vicinity = match group.parameters.get("vicinity") {
            Some(Parameter::Float(vicinity)) => vicinity.max(0.0),
            Some(Parameter::Int(vicinity)) => vicinity.max(&0).to_owned() as f64,
            _ => VICINITY,
        };
        let index = ObstacleIndex::new(&obstacles);
        let starts = group.starts.iter().map(|pose| pose.position);
        let points = contents
            .way_points
            .iter()
            .map(|place| place.value.position)
            .chain(starts);
        let points = points.map(|point| Bounds::around(point, 0.0));
        let boxes = index.bounds().iter().map(|bounds| Bounds {
            low: bounds.low,
            high: bounds.high,
        });
        let origin = Bounds::around(Point::ZERO, 0.0);
        let Bounds { low, high } = points.chain(boxes).fold(origin, Bounds::joined);
        // Room to go round everything.
        let margin = Point::planar(1.0, 1.0) * (3.0 * body.radius + vicinity);
        let (low, high) = (low - margin, high + margin);
        let (width, depth) = (high.x - low.x, high.y - low.y);
        let finest = body.radius / 6.0;
        let cell = finest
            .max((width * depth / MOST_CELLS).sqrt())
            .max(width.max(depth) / 1e5);
        FreeSpace {
            obstacles: index,
            bounds: contents.bounds.as_ref().map(|bounds| bounds.value),
            radius: body.radius,
            height: body.height,
            vicinity,
            low,
            cell,
            columns: (width / cell).ceil().max(1.0) as usize,
            rows: (depth / cell).ceil().max(1.0) as usize,
        }
    }

    /// Whether some body within `slack` metres of here could be free.
    fn could_be_free(&self, position: Point, slack: f64) -> bool {
        let within = self.bounds.is_none_or(|Bounds { low, high }| {
            let margin = self.radius - slack;
            low.x + margin <= position.x
                && position.x <= high.x - margin
                && low.y + margin <= position.y
                && position.y <= high.y - margin
        });
        let at = position.at_height(0.0);
        let reach = Box::of_body(at, at, self.radius, self.height).planar();
        let blocks = |index: u32| {
            let obstacle = &self.obstacles.obstacles()[index as usize];
            // Heights were settled when the obstacles were chosen.
            let height = obstacle.height().map_or(0.0, |span| span.low);
            obstacle.body_gap(at.at_height(height), self.radius, self.height) < -slack
        };
        within && !self.obstacles.any_near(&reach, blocks)
    }

    /// Whether a body can be within the vicinity of this point.
    fn can_stand_near(&self, point: Point) -> bool {
        self.could_be_free(point, self.vicinity)
    }

    /// The waypoints that are not at the end of a free straight line from a start or from another
    /// such waypoint; in most worlds there are none left, and the search can be saved.
    fn not_in_sight<'p>(
        &self,
        group: &Group,
        open: Vec<&'p Placed<WayPoint>>,
    ) -> Vec<&'p Placed<WayPoint>> {
        let mut from: Vec<Point> = group
            .starts
            .iter()
            .take(STARTS_LOOKED_FROM)
            .map(|pose| pose.position)
            .collect();
        let in_sight = |place: &&Placed<WayPoint>| {
            let to = place.value.position.at_height(0.0);
            let free = |from: &Point| {
                let from = from.at_height(0.0);
                !self
                    .obstacles
                    .blocks_body(from, to, self.radius, self.height)
            };
            let seen = self.could_be_free(to, 0.0) && from.iter().any(free);
            if seen && from.len() < 2 * STARTS_LOOKED_FROM {
                from.push(to);
            }
            seen
        };
        let (_, hidden): (Vec<_>, Vec<_>) = open.into_iter().partition(in_sight);
        hidden
    }

    fn center(&self, column: usize, row: usize) -> Point {
        self.low + Point::planar(column as f64 + 0.5, row as f64 + 0.5) * self.cell
    }

    fn cell_of(&self, point: Point) -> (usize, usize) {
        let index = |offset: f64, most: usize| ((offset / self.cell) as usize).min(most - 1);
        let offset = point - self.low;
        (index(offset.x, self.columns), index(offset.y, self.rows))
    }

    /// The cells that the group's robots may get to, row by row.
    fn flood(&self, group: &Group) -> Vec<bool> {
        // Half the diagonal: if a body is free anywhere in a cell, its centre passes.
        let slack = self.cell * std::f64::consts::FRAC_1_SQRT_2;
        let mut reached = vec![false; self.columns * self.rows];
        let mut ahead = Vec::new();
        for start in &group.starts {
            let (column, row) = self.cell_of(start.position);
            if !std::mem::replace(&mut reached[row * self.columns + column], true) {
                ahead.push((column, row));
            }
        }
        while let Some((column, row)) = ahead.pop() {
            // Also across corners: a body may pass from any point of a cell to any of the next.
            for row in row.saturating_sub(1)..=(row + 1).min(self.rows - 1) {
                for column in column.saturating_sub(1)..=(column + 1).min(self.columns - 1) {
                    let index = row * self.columns + column;
                    if !reached[index] && self.could_be_free(self.center(column, row), slack) {
                        reached[index] = true;
                        ahead.push((column, row));
                    }
                }
            }
        }
        reached
    }

    /// Whether a cell that was reached may hold a point within the vicinity of this one.
    fn near_reached(&self, reached: &[bool], point: Point) -> bool {
        let reach = self.vicinity + self.cell;
        let (low_column, low_row) = self.cell_of(point - Point::planar(reach, reach));
        let (high_column, high_row) = self.cell_of(point + Point::planar(reach, reach));
        (low_row..=high_row).any(|row| {
            let row = row * self.columns;
            reached[row + low_column..=row + high_column].contains(&true)
        })
    }
}
