//! Total order over long lives: every robot broadcasts all the time, robots restart again and again, and
//! copies of what they sent before arrive long after.

use crate::harness::Wire;
use crate::harness::storm::{Storm, Victims};
use starl_core::{Duration, Random};

fn storm(robots: usize, seed: u64, victims: Victims) -> Storm {
    Storm {
        robots,
        seed,
        span: Duration::from_seconds(60),
        wire: Wire {
            loss: 0.1,
            duplication: 0.1,
            delay_ms: (5, 60),
            ..Wire::perfect()
        },
        late: (0.2, Duration::from_seconds(2)),
        period: Duration::from_millis(150),
        victims,
        crash_period: Duration::from_seconds(3),
        downtime: Duration::from_millis(300),
    }
}

fn check(storm: &Storm) {
    let after = storm.run();
    assert_eq!(after.violation(), None, "{storm:?}");
    // In the second half of the calm everything reaches all.
    let since = after.world.now - Duration::from_seconds(10);
    let handed = after.handed_to_all(since);
    let sent = 10.0 / storm.period.seconds() * storm.robots as f64;
    println!(
        "{} robots, {:?}, seed {}: {} restarts, {handed} of about {sent:.0}",
        storm.robots, storm.victims, storm.seed, after.restarts
    );
    assert!(handed as f64 > 0.5 * sent, "{storm:?}: {handed} of {sent}");
    assert!(after.restarts > 10, "{storm:?}");
}

#[test]
fn one_robot_restarts_again_and_again() {
    for robots in [3, 5] {
        for seed in 0..6 {
            check(&storm(robots, seed, Victims::One(seed as usize % robots)));
        }
    }
}

#[test]
fn all_robots_restart_in_turn() {
    for robots in [3, 5] {
        for seed in 0..6 {
            let span = Duration::from_seconds(30 * robots as u64);
            let victims = Victims::InTurn;
            check(&Storm {
                span,
                ..storm(robots, seed, victims)
            });
        }
    }
}

#[test]
fn any_robots_restart() {
    for robots in [3, 5, 10] {
        for seed in 0..4 {
            check(&storm(robots, seed, Victims::Any));
        }
    }
}

#[test]
fn copies_arrive_ten_seconds_late() {
    for robots in [3, 5] {
        for seed in 0..4 {
            let late = (0.3, Duration::from_seconds(10));
            let victims = Victims::One(0);
            check(&Storm {
                late,
                ..storm(robots, seed, victims)
            });
        }
    }
}

/// Weather, load and crashes drawn by the seed.
fn drawn(seed: u64) -> Storm {
    let mut random = Random::keyed(seed, &[3]);
    let mut pick = |all: &[u64]| all[random.below(all.len() as u32) as usize];
    let (loss, duplication) = (pick(&[0, 10, 30]), pick(&[0, 10, 30]));
    let (late, longest) = (pick(&[0, 20, 40]), pick(&[1, 2, 10, 30]));
    let robots = pick(&[3, 4, 5, 7, 10, 15]) as usize;
    Storm {
        robots,
        seed,
        span: Duration::from_seconds(if robots > 5 { 30 } else { 80 }),
        wire: Wire {
            loss: loss as f64 / 100.0,
            duplication: duplication as f64 / 100.0,
            delay_ms: (5, pick(&[5, 60, 400, 2000])),
            ..Wire::perfect()
        },
        late: (late as f64 / 100.0, Duration::from_seconds(longest)),
        period: Duration::from_millis(pick(&[100, 200, 1000])),
        victims: [Victims::One(0), Victims::Any, Victims::InTurn][pick(&[0, 1, 2]) as usize],
        crash_period: Duration::from_millis(pick(&[700, 2000, 4000])),
        downtime: Duration::from_millis(pick(&[100, 300, 2000])),
    }
}

#[test]
fn the_order_is_one_in_every_weather() {
    for seed in 0..30 {
        let storm = drawn(seed);
        let after = storm.run();
        assert_eq!(after.violation(), None, "{storm:?}");
    }
}

#[test]
#[ignore = "takes minutes"]
fn the_order_is_one_in_every_weather_of_a_thousand() {
    for seed in 30..1000 {
        let storm = drawn(seed);
        let after = storm.run();
        assert_eq!(after.violation(), None, "{storm:?}");
    }
}
