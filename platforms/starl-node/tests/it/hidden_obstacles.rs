//! A robot discovers obstacles that its map lacks, by sight and by its bumper, and forgets those that have expired.

use crate::support::{Idle, Notes, at, setup};
use starl_core::event::{Event, Level};
use starl_core::geometry::Obstacle;
use starl_core::sensor::Contact;
use starl_core::{Point, Pose, Program, Robot, Time};
use starl_node::Reading;
use starl_node::link::Channel;
use starl_node::motors::Report;
use starl_node::robot::MapObstacle;
use starl_node::robot::{Core, Incoming, Setup};

/// Logs how many obstacles it knows.
#[derive(Clone, Debug, starl_core::Primitives)]
struct Counting;

impl Program for Counting {
    fn activate(&mut self, robot: &mut Robot<'_>) {
        let known = robot.obstacles().len();
        robot.log(Level::Info, format!("{known}"));
    }
}

/// A post of radius 0.1 m whose centre is at `x` metres.
fn post(x: f64) -> Obstacle {
    Obstacle::circle(Point::planar(x, 0.0), 0.1)
}

/// Posts at these places, hidden or not, that disappear at these times in milliseconds.
fn obstacles(posts: &[(f64, bool, u64)]) -> Vec<MapObstacle> {
    let posts = posts.iter().map(|&(x, hidden, expires)| MapObstacle {
        obstacle: post(x),
        hidden,
        expires: at(expires),
    });
    posts.collect()
}

/// A robot with these hidden obstacles that perceives them to `range` metres.
fn hiding(range: f64, hidden: &[Obstacle]) -> Setup {
    let mut setup = setup(Counting);
    let hidden = hidden.iter().map(|obstacle| MapObstacle {
        obstacle: obstacle.clone(),
        hidden: true,
        expires: Time::NEVER,
    });
    setup.obstacles = hidden.collect();
    setup.sensors.discovery_range = range;
    setup
}

/// Runs a robot for a second, shows it these reports, and returns what it has discovered and when, and how many obstacles
/// its program knows at the end.
fn run(setup: Setup, reports: impl Fn(u64) -> Option<Report>) -> (Vec<(Time, Obstacle)>, String) {
    run_for(1000, setup, reports)
}

/// The same for so many milliseconds.
fn run_for(
    end: u64,
    setup: Setup,
    reports: impl Fn(u64) -> Option<Report>,
) -> (Vec<(Time, Obstacle)>, String) {
    let channel = Channel::new(0, "fleet", Vec::new());
    let mut core = Core::new(at(0), setup, channel, Idle::default(), Notes::default());
    for ms in 0..=end {
        let mut incoming: Vec<_> = reports(ms).map(Incoming::Device).into_iter().collect();
        core.step(at(ms), &mut incoming);
    }
    let (mut found, mut known) = (Vec::new(), String::new());
    for (at, event) in core.end(at(end)).0 {
        match event {
            Event::Discovered(obstacle) => found.push((at, obstacle)),
            Event::Log { text, .. } => known = text.to_string(),
            _ => {}
        }
    }
    (found, known)
}

fn seen_at(ms: u64, x: f64) -> Option<Report> {
    Some(Report::Seen(
        at(ms),
        Pose::level(Point::planar(x, 0.0), 0.0),
    ))
}

fn touched(ms: u64, bearing: f64) -> Option<Report> {
    let reading = Reading {
        bumper: Some(Some(Contact { bearing })),
        ..Reading::default()
    };
    Some(Report::Measured(at(ms), reading))
}

#[test]
fn an_obstacle_in_range_and_in_sight_is_discovered_once() {
    // Its edges are 1 m and 1.5 m from the robot's; the second one stands behind the first.
    let setup = hiding(0.6, &[post(1.3), post(1.8)]);
    let (found, known) = run(setup, |ms| match ms.is_multiple_of(10) {
        true => seen_at(ms, if ms < 500 { 0.0 } else { 0.5 }),
        false => None,
    });
    assert_eq!(found, [(at(500), post(1.3))]);
    assert_eq!(known, "1");
}

#[test]
fn a_touched_obstacle_is_discovered_whatever_the_range() {
    let (found, known) = run(hiding(0.0, &[post(0.32), post(3.0)]), |ms| match ms {
        300 | 310 => touched(ms, 0.0),
        _ => seen_at(ms, 0.0),
    });
    assert_eq!(found, [(at(300), post(0.32))]);
    assert_eq!(known, "1");
}

#[test]
fn a_touch_that_the_scenario_does_not_explain_becomes_a_post() {
    let (found, known) = run(hiding(0.6, &[]), |ms| match ms {
        300 | 310 => touched(ms, std::f64::consts::FRAC_PI_2),
        _ => seen_at(ms, 0.0),
    });
    assert_eq!(found.len(), 1, "{found:?}");
    let gap = found[0].1.body_gap(Point::ZERO, 0.2, 0.1);
    assert!(gap.abs() < 1e-9, "{gap}");
    assert_eq!(known, "1");
}

#[test]
fn a_touch_of_a_robot_is_no_obstacle() {
    let mut setup = hiding(0.6, &[]);
    setup.bodies = vec![setup.bodies[0]; 2];
    let other = Pose::level(Point::planar(0.4, 0.0), 0.0);
    let (found, _) = run(setup, |ms| match ms {
        0 => Some(Report::SawOther(starl_core::RobotId(1), at(0), other)),
        300 => touched(ms, 0.0),
        _ => seen_at(ms, 0.0),
    });
    assert_eq!(found, []);
}

#[test]
fn an_obstacle_that_has_expired_is_not_known_any_more() {
    let seen = |ms: u64| seen_at(ms, 0.0);
    // The first one is known and hides the third one, which expires first.
    for (end, expected) in [(450, "2"), (650, "1"), (1000, "0")] {
        let mut setup = hiding(0.6, &[]);
        setup.obstacles = obstacles(&[(0.5, false, 500), (-0.5, true, 700), (0.6, true, 400)]);
        let (found, known) = run_for(end, setup, seen);
        assert_eq!(known, expected, "after {end} ms");
        assert_eq!(found, [(at(0), post(-0.5))]);
    }
}

#[test]
fn an_obstacle_that_has_expired_is_not_discovered_and_does_not_hide_others() {
    let mut setup = hiding(0.6, &[]);
    setup.obstacles = obstacles(&[(0.5, true, 300), (0.8, true, 2000)]);
    let (found, known) = run(setup, |ms| match ms.is_multiple_of(10) {
        true => seen_at(ms, if ms < 500 { -1.0 } else { 0.3 }),
        false => None,
    });
    assert_eq!(found, [(at(500), post(0.8))]);
    assert_eq!(known, "1");
}
