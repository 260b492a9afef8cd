//! World files of StarL 1.5 are read as they are: with Windows line ends, comments, walls, hidden and
//! expiring obstacles, groups of waypoints, and no newline at the end.

use crate::reading::{self, Files};
use starl_core::{Point, Time};
use starl_sim::{Scenario, read};

/// A crossing as the original's traffic application has it, and some of everything else.
const TOWN: &str = "\u{feff}Obstacle;0,0;0,5000;-1\r\n\
    Obstacle;0,0;5000,0;-1\r\n\
    //above are surrounding wall\r\n\
    \r\n\
    Hidden;1000,2000;2000,2000;2000,2500;1000,2500;60000\r\n\
    Obstacle;3000,1000;3500,1000;3500,1500;3000,1500;3000,1000;-1 // closed\r\n\
    WAY,1800,2250,0,A,0\r\n\
    WAY, 2750 , 4300.5, 600 , E1 , 1\r\n\
    SENSE,4000,4000,0,lamp\r\n\
    WAY,600,600,0,iRobot0,0\r\n\
    WAY,2750,600,0,iRobot1,90\r\n\
    WAY,4000,600,0,iRobot2,270\r\n\
    WAY,4600,600,0,iRobot7,180";

fn town() -> Scenario {
    let text = "program = \"traffic\"\n[world]\nfiles = [\"town.wpt\"]\n\
        [[robots]]\nmodel = \"create\"\nname = \"iRobot\"\ncount = 3\n";
    let mut files = Files::default();
    files
        .0
        .insert("town.wpt".to_string(), TOWN.as_bytes().to_vec());
    let read = read::scenario(&reading::request(text, &[]), &files);
    read.unwrap_or_else(|problems| panic!("{problems}"))
        .scenario
}

#[test]
fn walls_and_polygons_hidden_and_expiring() {
    let obstacles = town().world.obstacles;
    assert_eq!(obstacles.len(), 4);
    let bounds = obstacles[0].obstacle.bounds();
    assert_eq!(
        (bounds.low.x, bounds.high.x, bounds.high.y),
        (0.0, 0.0, 5.0)
    );
    let plain: Vec<(bool, Time)> = obstacles
        .iter()
        .map(|obstacle| (obstacle.hidden, obstacle.expires))
        .collect();
    let for_ever = (false, Time::NEVER);
    assert_eq!(
        plain,
        [for_ever, for_ever, (true, Time(60_000_000_000)), for_ever]
    );
    assert_eq!(obstacles[3].obstacle.bounds().low.x, 3.0);
}

#[test]
fn waypoints_and_things_in_metres() {
    let world = town().world;
    let way_points: Vec<(&str, Point, u32)> = (world.way_points.iter())
        .map(|way| (way.name.as_str(), way.position, way.group))
        .collect();
    let expected = [
        ("A", Point::planar(1.8, 2.25), 0),
        ("E1", Point::new(2.75, 4.3005, 0.6), 1),
    ];
    assert_eq!(way_points, expected);
    assert_eq!(world.things.len(), 1);
    assert_eq!(
        (world.things[0].name.as_str(), world.things[0].position.x),
        ("lamp", 4.0)
    );
}

#[test]
fn starts_of_robots_with_headings_in_degrees() {
    let fleet = town().fleet;
    let starts = &fleet.groups[0].starts;
    assert_eq!(starts.len(), 3);
    assert_eq!(starts[1].position, Point::planar(2.75, 0.6));
    let quarter = std::f64::consts::FRAC_PI_2;
    assert_eq!((starts[0].yaw, starts[1].yaw), (0.0, quarter));
    assert!(
        (starts[2].yaw + quarter).abs() < 1e-12,
        "270 degrees are a quarter to the right"
    );
}
