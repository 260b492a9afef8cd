//! Writes `world`.

use super::table::{Table, flag, list, metres, planar, quantity, solid, spatial, text, time};
use crate::scenario::{Bounds, Thing, World, WorldObstacle};
use starl_core::geometry::{HeightSpan, Shape};
use starl_core::{Duration, Obstacle, Time, WayPoint};

/// Obstacles, waypoints and things.
pub(super) fn write(world: &World) -> String {
    let World {
        bounds,
        obstacles,
        way_points,
        things,
    } = world;
    let mut table = Table::named("world");
    if let Some(Bounds { low, high }) = bounds {
        let (low, high) = (planar(*low), planar(*high));
        table.set("bounds", format!("{{ low = {low}, high = {high} }}"));
    }
    let mut out = table.finish();
    out.extend(obstacles.iter().map(obstacle));
    out.extend(way_points.iter().map(way_point));
    out.extend(things.iter().map(thing));
    out
}

fn obstacle(entry: &WorldObstacle) -> String {
    let WorldObstacle {
        obstacle,
        hidden,
        expires,
    } = entry;
    let mut table = Table::element("world.obstacle");
    set_shape(&mut table, obstacle);
    table.differing("hidden", *hidden, false, flag);
    table.differing("expires", *expires, Time::NEVER, |at| time(Duration(at.0)));
    table.finish_element()
}

/// The shape and place of an obstacle.
pub(super) fn set_shape(table: &mut Table, obstacle: &Obstacle) {
    match &obstacle.shape {
        Shape::Polygon { base, height } => {
            let corners = base.vertices().iter().map(|&corner| planar(corner));
            table.set("polygon", list(corners));
            set_height(table, *height);
        }
        Shape::Circle {
            center,
            radius,
            height,
        } => {
            let (center, radius) = (planar(*center), quantity(*radius, "m"));
            let circle = format!("{{ center = {center}, radius = {radius} }}");
            table.set("circle", circle);
            set_height(table, *height);
        }
        Shape::Cuboid { low, high } => {
            let (low, high) = (solid(*low), solid(*high));
            table.set("box", format!("{{ low = {low}, high = {high} }}"));
        }
    }
}

fn set_height(table: &mut Table, height: Option<HeightSpan>) {
    if let Some(HeightSpan { low, high }) = height {
        table.set("height", list([low, high].map(metres)));
    }
}

fn way_point(way_point: &WayPoint) -> String {
    let WayPoint {
        name,
        position,
        group,
    } = way_point;
    let mut table = Table::element("world.way_point");
    table.set("name", text(name));
    table.set("position", spatial(*position));
    table.differing("group", *group, 0, |group| group.to_string());
    table.finish_element()
}

fn thing(thing: &Thing) -> String {
    let Thing { name, position } = thing;
    let mut table = Table::element("world.thing");
    table.set("name", text(name));
    table.set("position", spatial(*position));
    table.finish_element()
}
