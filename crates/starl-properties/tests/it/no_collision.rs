//! Every collision is reported, once: what the host says, and what the poses show on their own.

use crate::support::{self, FLYER, GROUND, Story, assert_none, assert_only, at};
use starl_core::event::Hit;
use starl_core::{Event, Intervention, Obstacle, Point, Pose, Random, RobotId};
use std::f64::consts::SQRT_2;

const WITH_ROBOT_1: Hit = Hit::Robot(RobotId(1));

fn pillar(story: &mut Story, x: f64, expires_ms: u64) {
    let pillar = Obstacle::circle(at(x, 0.0), 0.5);
    let expires = support::ms(expires_ms);
    story.setting.obstacles.push((pillar, expires));
}

#[test]
fn two_robots_that_run_into_each_other_are_one_collision() {
    let mut story = Story::of_ground_robots(3);
    story.collided(500, 0, WITH_ROBOT_1);
    story.collided(500, 1, Hit::Robot(RobotId(0)));
    let verdict = story.verdict(1000);
    assert_only(&verdict, "no_collision", 500, &[0, 1]);
    assert_eq!(verdict[0].text, "robot 0 ran into robot 1");
}

#[test]
fn repeated_contacts_are_one_collision_until_the_bodies_separate() {
    let mut story = Story::of_ground_robots(2);
    story.stays(0, 2000, 0, at(0.0, 0.0));
    story.stays(0, 1000, 1, at(0.45, 0.0));
    story.collided(150, 0, WITH_ROBOT_1);
    story.collided(350, 1, Hit::Robot(RobotId(0)));
    story.collided(550, 0, WITH_ROBOT_1);
    assert_only(&story.clone().verdict(2000), "no_collision", 150, &[0, 1]);
    // 0.12 m between the bodies: they have partitioned.
    story.moved(1100, 1, at(0.52, 0.0));
    story.collided(1150, 1, Hit::Robot(RobotId(0)));
    let verdict = story.verdict(2000);
    assert_eq!(verdict.len(), 2, "{verdict:#?}");
    assert_eq!(verdict[1].at, support::ms(1150));
}

#[test]
fn an_obstacle_that_is_hit_is_reported_with_the_place() {
    let mut story = Story::of_ground_robots(1);
    pillar(&mut story, 3.0, u64::MAX / 1_000_000);
    story.stays(0, 900, 0, at(2.28, 0.0));
    story.collided(450, 0, Hit::Obstacle(0));
    story.collided(650, 0, Hit::Obstacle(0));
    let verdict = story.verdict(1000);
    assert_only(&verdict, "no_collision", 450, &[0]);
    assert_eq!(
        verdict[0].text,
        "robot 0 ran into obstacle 0 near (2.280, 0.000, 0.000) m"
    );
}

#[test]
fn the_edge_of_the_world_counts_too() {
    let mut story = Story::of_ground_robots(1);
    pillar(&mut story, 9.0, u64::MAX / 1_000_000);
    story.stays(0, 900, 0, at(2.28, 0.0));
    // Hosts count the walls of the world's bounds after the obstacles.
    story.collided(450, 0, Hit::Obstacle(1));
    story.collided(650, 0, Hit::Obstacle(1));
    let verdict = story.verdict(1000);
    assert_only(&verdict, "no_collision", 450, &[0]);
    assert!(
        verdict[0]
            .text
            .starts_with("robot 0 ran into the edge of the world")
    );
}

#[test]
fn bodies_that_overlap_are_found_without_the_hosts_word() {
    let mut story = Story::of_ground_robots(3);
    story.stays(0, 1000, 0, at(0.0, 0.0));
    story.stays(0, 1000, 2, at(9.0, 0.0));
    // At 0.1 m a pose, the distance falls below 0.4 m at 600 ms.
    story.walks(0, 1000, 1, at(0.95, 0.0), at(-0.05, 0.0));
    let verdict = story.verdict(1000);
    assert_only(&verdict, "no_collision", 600, &[0, 1]);
    assert_eq!(
        verdict[0].text,
        "the bodies of robots 0 and 1 overlap by 0.050 m near (0.000, 0.000, 0.000) m"
    );
}

#[test]
fn bodies_that_just_touch_do_not_overlap() {
    let mut story = Story::of_ground_robots(2);
    story.stays(0, 1000, 0, at(0.0, 0.0));
    story.stays(0, 1000, 1, at(0.3995, 0.0));
    assert_none(&story.verdict(1000));
    let mut nearer = Story::of_ground_robots(2);
    nearer.stays(0, 1000, 0, at(0.0, 0.0));
    nearer.stays(0, 1000, 1, at(0.3985, 0.0));
    assert_only(&nearer.verdict(1000), "no_collision", 0, &[0, 1]);
}

#[test]
fn measured_poses_overlap_only_beyond_their_error() {
    for (simulated, depth, collides) in [
        (true, 0.02, true),
        (false, 0.02, false),
        (false, 0.04, true),
    ] {
        let measured = |mut story: Story| {
            story.setting.position_noise = 0.005;
            story.setting.simulated = simulated;
            story.verdict(1000)
        };
        let mut wall = Story::of_ground_robots(1);
        pillar(&mut wall, 3.0, u64::MAX / 1_000_000);
        wall.stays(0, 1000, 0, at(2.3 + depth, 0.0));
        assert_eq!(measured(wall).is_empty(), !collides, "{depth}");
        // Both poses of a pair have errors.
        let mut pair = Story::of_ground_robots(2);
        pair.stays(0, 1000, 0, at(0.0, 0.0));
        pair.stays(0, 1000, 1, at(0.4 - SQRT_2 * depth, 0.0));
        assert_eq!(measured(pair).is_empty(), !collides, "{depth}");
    }
}

#[test]
fn a_drone_passes_over_a_ground_robot_but_not_through_it() {
    for (height, passes) in [(0.11, true), (0.09, false)] {
        let mut story = Story::of(&[GROUND, FLYER]);
        story.moved(100, 0, at(0.0, 0.0));
        story.moved(100, 1, Point::new(0.1, 0.1, height));
        assert_eq!(story.verdict(200).is_empty(), passes, "{height}");
    }
}

/// A flyer over a ground robot that crashes, comes down from 0.5 m within a second, and lies on it.
fn crash_landing() -> Story {
    let mut story = Story::of(&[GROUND, FLYER]);
    story.stays(0, 3000, 0, at(0.0, 0.0));
    story.stays(0, 500, 1, Point::new(0.1, 0.0, 0.5));
    story.fault(550, Some(1), "crash");
    let low = Point::new(0.1, 0.0, 0.09);
    story.walks(600, 1500, 1, Point::new(0.1, 0.0, 0.5), low);
    story.stays(1600, 3000, 1, low);
    story
}

#[test]
fn a_robot_under_a_falling_drone_has_not_collided() {
    let mut story = crash_landing();
    story.collided(1500, 0, WITH_ROBOT_1);
    // It lies on the robot, which bumps against it as it drives away.
    story.collided(2900, 0, WITH_ROBOT_1);
    assert_none(&story.verdict(3000));
}

/// A flyer crashes and lands on a robot, and a second later another one meets it.
fn wreck_on_a_robot(wreck: f64) -> Story {
    let mut story = Story::of(&[GROUND, FLYER, GROUND]);
    story.stays(0, 3000, 0, at(0.0, 0.0));
    story.stays(0, 500, 1, Point::new(0.1, 0.0, 0.5));
    story.fault(550, Some(1), "crash");
    let low = Point::new(0.1, 0.0, wreck);
    story.walks(600, 1500, 1, Point::new(0.1, 0.0, 0.5), low);
    story.stays(1600, 3000, 1, low);
    story.walks(0, 3000, 2, at(0.69, 0.0), at(0.601, 0.0));
    story.collided(1500, 0, WITH_ROBOT_1);
    story.collided(2500, 2, WITH_ROBOT_1);
    story
}

#[test]
fn a_wreck_that_lies_on_one_robot_and_sinks_onto_the_next_has_not_collided() {
    assert_none(&wreck_on_a_robot(0.1).verdict(3000));
}

#[test]
fn a_robot_that_runs_into_a_wreck_beside_it_collides() {
    let verdict = wreck_on_a_robot(0.05).verdict(3000);
    assert!(
        verdict.iter().any(|found| found.at == support::ms(2500)),
        "{verdict:#?}"
    );
}

/// A flyer over a ground robot that crashes at one height, starts again at a lower one, and sinks on until it is on the
/// robot.
fn restart_in_the_fall((top, high): (f64, f64), restarts: u64, lands: u64) -> Story {
    let over = |height| Point::new(0.1, 0.0, height);
    let mut story = Story::of(&[GROUND, FLYER]);
    story.stays(0, lands, 0, at(0.0, 0.0));
    story.stays(0, 500, 1, over(top));
    story.fault(550, Some(1), "crash");
    story.walks(600, restarts - 50, 1, over(top), over(high));
    story.fault(restarts, Some(1), "restart");
    story.walks(restarts + 50, lands, 1, over(high), over(0.09));
    story.collided(lands, 0, WITH_ROBOT_1);
    story
}

#[test]
fn a_drone_that_restarts_while_falling_sinks_for_a_moment() {
    // It comes down on the robot before it has caught itself.
    let story = restart_in_the_fall((0.6, 0.2), 1450, 1800);
    assert_none(&story.verdict(1800));
}

#[test]
fn a_drone_that_restarts_while_falling_and_descends_by_itself_collides() {
    // It never rises, but two seconds after its restart no robot falls.
    let story = restart_in_the_fall((0.9, 0.7), 1050, 3100);
    let verdict = story.verdict(3100);
    assert_only(&verdict, "no_collision", 3100, &[0, 1]);
}

#[test]
fn a_drone_that_restarts_on_a_robot_and_returns_collides() {
    for flies_off in [false, true] {
        let mut story = crash_landing();
        story.stays(3100, 4000, 0, at(0.0, 0.0));
        story.fault(3000, Some(1), "restart");
        let low = Point::new(0.1, 0.0, 0.09);
        let away = match flies_off {
            true => Point::new(1.0, 0.0, 0.4),
            false => low,
        };
        story.walks(3100, 3500, 1, low, away);
        story.walks(3600, 4000, 1, away, low);
        story.collided(4000, 0, WITH_ROBOT_1);
        assert_eq!(story.verdict(4100).is_empty(), !flies_off);
    }
}

#[test]
fn a_robot_that_runs_into_a_fallen_drone_collides() {
    let mut story = Story::of(&[GROUND, FLYER]);
    story.stays(0, 3000, 0, at(2.0, 0.0));
    story.stays(0, 500, 1, Point::new(0.0, 0.0, 0.5));
    story.fault(550, Some(1), "crash");
    story.walks(600, 1500, 1, Point::new(0.0, 0.0, 0.5), at(0.0, 0.0));
    story.stays(1600, 3000, 1, at(0.0, 0.0));
    story.collided(2100, 0, WITH_ROBOT_1);
    assert_only(&story.verdict(3000), "no_collision", 2100, &[0, 1]);
}

#[test]
fn a_crash_on_the_ground_excuses_no_robot() {
    let mut story = Story::of_ground_robots(2);
    story.stays(0, 1000, 0, at(0.0, 0.0));
    story.stays(0, 1000, 1, at(0.45, 0.0));
    story.fault(500, Some(1), "crash");
    story.collided(600, 0, WITH_ROBOT_1);
    assert_only(&story.verdict(1000), "no_collision", 600, &[0, 1]);
}

#[test]
fn poses_of_different_moments_are_not_compared() {
    let mut story = Story::of_ground_robots(2);
    story.moved(100, 0, at(0.0, 0.0));
    story.moved(150, 1, at(0.1, 0.0));
    assert_none(&story.verdict(1000));
}

#[test]
fn a_body_in_an_obstacle_is_found_as_long_as_the_obstacle_stands() {
    for (expires, hits) in [(300, 1), (200, 1), (199, 0)] {
        let mut story = Story::of_ground_robots(1);
        pillar(&mut story, 3.0, expires);
        story.moved(100, 0, at(2.0, 0.0));
        story.moved(200, 0, at(2.4, 0.0));
        story.moved(300, 0, at(2.5, 0.0));
        let verdict = story.verdict(1000);
        assert_eq!(verdict.len(), hits, "{expires}: {verdict:#?}");
        if hits == 1 {
            assert_only(&verdict, "no_collision", 200, &[0]);
            assert!(verdict[0].text.contains("reaches 0.100 m into obstacle 0"));
        }
    }
}

#[test]
fn records_of_unknown_robots_and_impossible_places_do_no_harm() {
    let mut story = Story::of_ground_robots(2);
    story.moved(100, 5, at(0.0, 0.0));
    story.moved(100, 0, at(f64::NAN, 0.0));
    story.moved(100, 1, at(0.0, 0.0));
    story.collided(200, 0, Hit::Robot(RobotId(9)));
    story.collided(200, 9, Hit::Robot(RobotId(0)));
    assert_none(&story.verdict(1000));
}

/// The sweep finds the same pairs as a look at all pairs.
#[test]
fn in_a_crowd_exactly_the_pairs_that_overlap_are_reported() {
    let mut random = Random::keyed(1, &[1]);
    for round in 0..20 {
        let bodies: Vec<_> = (0..150)
            .map(|robot| match robot % 3 {
                0 => FLYER,
                _ => GROUND,
            })
            .collect();
        let places: Vec<Point> = bodies
            .iter()
            .map(|_| {
                let mut draw = |high| random.between(0.0, high);
                Point::new(draw(10.0), draw(10.0), draw(0.3))
            })
            .collect();
        let mut story = Story::of(&bodies);
        for (robot, &place) in places.iter().enumerate() {
            story.moved(100, robot as u32, place);
        }
        let mut found: Vec<_> = story
            .verdict(200)
            .into_iter()
            .map(|violation| (violation.robots[0], violation.robots[1]))
            .collect();
        found.sort();
        let mut expected = Vec::new();
        for a in 0..bodies.len() {
            for b in a + 1..bodies.len() {
                let near = places[a].planar_distance(places[b])
                    < bodies[a].radius + bodies[b].radius - 0.001;
                let (span_a, span_b) = (bodies[a].span(places[a].z), bodies[b].span(places[b].z));
                let level = span_a.low < span_b.high - 0.001 && span_b.low < span_a.high - 0.001;
                if near && level {
                    expected.push((RobotId(a as u32), RobotId(b as u32)));
                }
            }
        }
        assert!(expected.len() > 10, "round {round} has something to find");
        assert_eq!(found, expected, "round {round}");
    }
}

fn steered(story: &mut Story, millis: u64, what: Intervention) {
    story.record(millis, None, Event::Intervention(Box::new(what)));
}

/// A pillar that appears, at x.
fn appearing(x: f64) -> Intervention {
    Intervention::AddObstacle {
        obstacle: Obstacle::circle(at(x, 0.0), 0.5),
        hidden: false,
    }
}

#[test]
fn an_obstacle_that_appears_is_reached_into_from_then_on() {
    let mut story = Story::of_ground_robots(1);
    pillar(&mut story, 9.0, u64::MAX / 1_000_000);
    story.setting.walls = 1;
    story.walks(0, 900, 0, at(1.0, 0.0), at(1.9, 0.0));
    steered(&mut story, 350, appearing(2.2));
    let verdict = story.verdict(1000);
    assert_only(&verdict, "no_collision", 600, &[0]);
    assert!(
        verdict[0].text.ends_with("into obstacle 1"),
        "{}",
        verdict[0].text
    );
}

#[test]
fn an_obstacle_that_appears_on_a_robot_is_not_the_robots_fault() {
    let mut story = Story::of_ground_robots(1);
    story.stays(0, 900, 0, at(1.0, 0.0));
    steered(&mut story, 350, appearing(1.2));
    assert_none(&story.verdict(1000));
}

#[test]
fn an_obstacle_that_moves_or_vanishes_is_not_where_it_was() {
    let mut story = Story::of_ground_robots(1);
    pillar(&mut story, 2.0, u64::MAX / 1_000_000);
    story.walks(0, 1900, 0, at(0.5, 0.0), at(2.4, 0.0));
    let obstacle = Obstacle::circle(at(1.0, 3.0), 0.5);
    let away = Intervention::MoveObstacle { index: 0, obstacle };
    let mut vanishes = story.clone();
    steered(
        &mut vanishes,
        350,
        Intervention::RemoveObstacle { index: 0 },
    );
    steered(&mut story, 350, away);
    assert_none(&story.verdict(2000));
    assert_none(&vanishes.verdict(2000));
}

#[test]
fn a_robot_that_joins_is_watched_and_one_that_leaves_is_not() {
    let mut story = Story::of_ground_robots(2);
    let join = |x: f64| Intervention::Join {
        like: RobotId(0),
        name: "late".into(),
        pose: Pose::level(at(x, 0.0), 0.0),
    };
    story.stays(0, 1700, 0, at(0.0, 0.0));
    story.stays(0, 900, 1, at(2.0, 0.0));
    // Where robot 1 stands there is no room.
    steered(&mut story, 500, join(2.0));
    steered(&mut story, 500, join(1.0));
    story.walks(500, 1900, 2, at(1.0, 0.0), at(0.3, 0.0));
    steered(&mut story, 950, Intervention::Leave(vec![RobotId(1)]));
    let mut leaves = story.clone();
    // At 0.4 m they touch, which rounding does not count.
    story.stays(1800, 1900, 0, at(0.0, 0.0));
    assert_only(&story.verdict(2000), "no_collision", 1800, &[0, 2]);
    steered(&mut leaves, 1750, Intervention::Leave(vec![RobotId(0)]));
    assert_none(&leaves.verdict(2000));
}

#[test]
fn robots_that_change_places_between_two_poses_pass_through_each_other() {
    for (aside, passes) in [(0.0, true), (0.35, true), (0.45, false)] {
        let mut story = Story::of_ground_robots(2);
        // 2 m a pose, so that no pose shows an overlap.
        story.walks(0, 1000, 0, at(0.0, 0.0), at(20.0, 0.0));
        story.walks(0, 1000, 1, at(21.0, aside), at(1.0, aside));
        let verdict = story.verdict(1200);
        if !passes {
            assert_none(&verdict);
            continue;
        }
        assert_only(&verdict, "no_collision", 600, &[0, 1]);
        assert!(
            verdict[0]
                .text
                .starts_with("robots 0 and 1 pass through each other")
        );
    }
}

#[test]
fn a_robot_that_jumps_over_a_pillar_passes_through_it() {
    for (aside, passes) in [(0.0, true), (0.6, true), (0.75, false)] {
        let mut story = Story::of_ground_robots(1);
        pillar(&mut story, 11.0, u64::MAX / 1_000_000);
        story.walks(0, 1000, 0, at(0.0, aside), at(20.0, aside));
        let verdict = story.verdict(1200);
        if !passes {
            assert_none(&verdict);
            continue;
        }
        assert_only(&verdict, "no_collision", 600, &[0]);
        assert!(
            verdict[0]
                .text
                .starts_with("robot 0 passes through obstacle 0")
        );
    }
}

#[test]
fn a_robot_that_turns_back_between_two_poses_has_passed_nothing() {
    let mut story = Story::of_ground_robots(2);
    story.stays(0, 1000, 1, at(5.0, 0.0));
    // On the straight way from 400 to 500 ms it would touch the other; it went round.
    story.walks(0, 400, 0, at(3.0, -4.0), at(3.0, -0.5));
    story.walks(500, 1000, 0, at(7.0, 0.5), at(7.0, 4.0));
    assert_none(&story.verdict(1200));
}

/// Only the place where they were nearest in the floor plane was looked at: here the start of the way.
#[test]
fn drones_that_pass_each_other_upright_have_passed_through_each_other() {
    for (aside, passes) in [(0.0, true), (0.65, false)] {
        let mut story = Story::of(&[FLYER, FLYER]);
        let place = |x: f64, height: f64| Point::new(x, 0.0, height);
        story.walks(0, 1000, 0, place(0.0, 1.0), place(0.0, 21.0));
        story.walks(0, 1000, 1, place(aside, 22.0), place(aside, 2.0));
        let verdict = story.verdict(1200);
        match passes {
            true => assert_only(&verdict, "no_collision", 600, &[0, 1]),
            false => assert_none(&verdict),
        }
    }
}
