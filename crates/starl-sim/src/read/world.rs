//! Reads `world`, and merges it with its files.

use super::contents::Contents;
use super::inputs::Recorder;
use super::names::Names;
use super::report::Report;
use super::section::Section;
use super::{Placed, obstacle, occupancy, start, world_file};
use crate::scenario::{Bounds, Thing, World};
use starl_core::{Point, WayPoint};
use std::collections::BTreeMap;

/// The contents of the world.
pub(super) fn read(table: Section<'_>, names: &Names, files: &Recorder<'_>) -> Contents {
    let mut contents = Contents {
        bounds: table.optional_table("bounds", start::area),
        start_area: table.optional_table("start_area", start::area),
        ..Contents::default()
    };
    for (path, origin, field) in table.texts("files") {
        match files.load(&path) {
            Ok(bytes) => world_file::read(&path, &bytes, names, &mut contents, table.report),
            Err(reason) => {
                let message = format!("cannot read {path}: {reason}");
                table.report.problem(origin, &field, message);
            }
        }
    }
    let obstacles = table.tables("obstacle", obstacle::read);
    contents.obstacles.extend(obstacles.into_iter().flatten());
    for image in table.tables("occupancy", |table| occupancy::read(table, files)) {
        contents.obstacles.extend(image);
    }
    contents
        .way_points
        .extend(table.tables("way_point", way_point).into_iter().flatten());
    contents
        .things
        .extend(table.tables("thing", thing).into_iter().flatten());
    contents.check(table.report);
    contents
}

fn way_point(table: Section<'_>) -> Option<Placed<WayPoint>> {
    let (name, position) = (table.text("name"), table.point("position"));
    let group = table.count("group").unwrap_or_default() as u32;
    let value = WayPoint {
        name: name?,
        position: position?.0,
        group,
    };
    Some(Placed::at(table, "position", value))
}

fn thing(table: Section<'_>) -> Option<Placed<Thing>> {
    let (name, position) = (table.text("name"), table.point("position"));
    let value = Thing {
        name: name?,
        position: position?.0,
    };
    Some(Placed::at(table, "position", value))
}

impl Bounds {
    fn contains_planar(&self, p: Point) -> bool {
        self.low.x <= p.x && p.x <= self.high.x && self.low.y <= p.y && p.y <= self.high.y
    }
}

impl Contents {
    fn check(&self, report: &Report) {
        self.check_named("waypoint", &self.way_points, report, |w| {
            (&w.name, w.position)
        });
        self.check_named("thing", &self.things, report, |t| (&t.name, t.position));
        let mut known = BTreeMap::new();
        for Placed {
            value: (name, _),
            origin,
            field,
        } in &self.starts
        {
            if let Some(other) = known.insert(name, *origin) {
                let message = format!("{name} starts at two places");
                let help = format!("leave one out; the other is at {}", report.place(other));
                report.problem_with_help(*origin, field, message, help);
            }
        }
        if let (Some(bounds), Some(area)) = (&self.bounds, &self.start_area)
            && !(bounds.value.contains_planar(area.value.low)
                && bounds.value.contains_planar(area.value.high))
        {
            let message = "the start area reaches beyond the bounds of the world";
            report.problem_with_help(area.origin, &area.field, message, "make it smaller");
        }
    }

    /// Refuses two of a kind with one name, and any outside the bounds.
    fn check_named<T>(
        &self,
        kind: &str,
        all: &[Placed<T>],
        report: &Report,
        named: impl Fn(&T) -> (&str, Point),
    ) {
        let mut known = BTreeMap::new();
        for Placed {
            value,
            origin,
            field,
        } in all
        {
            let (name, position) = named(value);
            if let Some(other) = known.insert(name, *origin) {
                let message = format!("there are two {kind}s called {name}");
                let help = format!("rename one; the other is at {}", report.place(other));
                report.problem_with_help(*origin, field, message, help);
            }
            let within = |bounds: &Placed<Bounds>| bounds.value.contains_planar(position);
            if !self.bounds.as_ref().is_none_or(within) {
                let message = format!("the {kind} {name} is outside the bounds of the world");
                report.problem_with_help(*origin, field, message, "move it, or the bounds");
            }
        }
    }

    /// Everything in the world and 1 m around it; none if there is nothing.
    pub fn surroundings(&self) -> Option<Bounds> {
        let points = (self.way_points.iter().map(|placed| placed.value.position))
            .chain(self.things.iter().map(|placed| placed.value.position))
            .chain(self.starts.iter().map(|placed| placed.value.1.position))
            .map(|point| Bounds::around(point, 0.0));
        let boxes = self.obstacles.iter().map(|obstacle| {
            let bounds = obstacle.obstacle.bounds();
            let (low, high) = (bounds.low, bounds.high);
            Bounds { low, high }
        });
        let Bounds { low, high } = points.chain(boxes).reduce(Bounds::joined)?;
        let around = Point::planar(1.0, 1.0);
        Some(Bounds {
            low: (low - around).at_height(0.0),
            high: (high + around).at_height(0.0),
        })
    }

    /// The world as the engine wants it.
    pub fn world(self) -> World {
        World {
            bounds: self.bounds.map(|bounds| bounds.value),
            obstacles: self.obstacles,
            way_points: self
                .way_points
                .into_iter()
                .map(|placed| placed.value)
                .collect(),
            things: self.things.into_iter().map(|placed| placed.value).collect(),
        }
    }
}
