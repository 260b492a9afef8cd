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

/// Reads a world from files, with one robot far from everything.
fn world(files: &[(&str, &str)]) -> starl_sim::scenario::World {
    let names: Vec<String> = files.iter().map(|(name, _)| format!("{name:?}")).collect();
    let text = format!(
        "program = \"drive\"\n[world]\nfiles = [{}]\n[[robots]]\nmodel = \"drone\"\nname = \"light\"\n\
         start = [{{ position = [2.5, 9] }}]\n",
        names.join(", ")
    );
    let mut given = Files::default();
    for (name, text) in files {
        given.0.insert(name.to_string(), text.as_bytes().to_vec());
    }
    let read = read::scenario(&reading::request(&text, &[]), &given);
    read.unwrap_or_else(|problems| panic!("{problems}"))
        .scenario
        .world
}

/// `ProjectApp/resources/Obstacles_square.wpt` of StarL 1.5.
const SQUARES: &str = "Hidden;0,0;5000,0;-1\nHidden;0,5000;5000,5000;-1\nHidden;0,0;0,5000;-1\n\
    Hidden;5000,0;5000,5000;-1\nHidden;1125,1125;1875,1125;1125,1875;1875,1875;-1\n\
    Hidden;3875,1125;3125,1125;3875,1875;3125,1875;-1\nHidden;1125,3875;1875,3875;1125,3125;1875,3125;-1\n\
    Hidden;3875,3875;3125,3875;3875,3125;3125,3125;-1\n-1\n";

#[test]
fn corners_listed_crosswise_and_a_lifetime_left_over() {
    let obstacles = world(&[("squares.wpt", SQUARES)]).obstacles;
    assert_eq!(obstacles.len(), 8);
    let squares: Vec<_> = obstacles[4..]
        .iter()
        .map(|one| one.obstacle.bounds())
        .collect();
    for square in &squares {
        let size = square.high - square.low;
        assert!(
            (size.x - 0.75).abs() < 1e-12 && (size.y - 0.75).abs() < 1e-12,
            "{square:?}"
        );
    }
    assert_eq!(squares[3].high.x, 3.875);
}

#[test]
fn ends_of_strokes_are_groups_on_the_floor_and_their_third_value_is_a_colour() {
    let rainbow = "WAY,450,1032,16711680,0-A_5\nWAY,517,1299,16711680,0-B_5\nWAY,764,1670,16744192,1-A_5\n\
        WAY,918,1804,16744192,1-B_5\nWAY,100,100,300,3-C\nWAY,200,100,300,-A\nWAY,300,100,300,4-A_\n";
    let line = "WAY,2514,2421,0,0-A\nWAY,3610,2576,0,0-B\n";
    let renamed = line.replace("0-A", "7-A").replace("0-B", "7-B");
    let ways = world(&[("rainbow.wpt", rainbow), ("line.wpt", &renamed)]).way_points;
    let read: Vec<(&str, u32, f64)> = (ways.iter())
        .map(|way| (way.name.as_str(), way.group, way.position.z))
        .collect();
    let expected = [
        ("0-A_5", 1, 0.0),
        ("0-B_5", 1, 0.0),
        ("1-A_5", 2, 0.0),
        ("1-B_5", 2, 0.0),
        ("3-C", 0, 0.3),
        ("-A", 0, 0.3),
        ("4-A_", 0, 0.3),
        ("7-A", 10, 0.0),
        ("7-B", 10, 0.0),
    ];
    assert_eq!(read, expected);
    assert_eq!(ways[0].position, Point::planar(0.45, 1.032));
}
