//! Frames are the poses at the moments that were sampled, however the run is cut into calls.

use crate::support::Client;
use serde_json::json;

fn race() -> Client {
    Client::open(json!({}), json!({"scenario": "race", "seed": "5"}))
}

fn frames(client: &mut Client) -> Vec<f64> {
    let mut numbers = vec![f64::NAN];
    assert!(client.host.frames(0, &mut numbers));
    numbers
}

/// Makes single steps, and puts down the poses after each that reaches or passes a multiple of the period.
fn expected(client: &mut Client, until: f64, period: f64) -> Vec<f64> {
    let (mut all, mut poses, mut reached) = (Vec::new(), Vec::new(), 0);
    loop {
        let status = client.ask("step", json!({}));
        let now = status["now"].as_f64().expect("a time");
        let multiple = (now / period + 1e-6) as u64;
        if multiple > reached {
            reached = multiple;
            assert!(client.host.poses(0, &mut poses));
            all.extend([now, (poses.len() / 11) as f64]);
            all.extend_from_slice(&poses);
        }
        if now >= until {
            return all;
        }
    }
}

#[test]
fn frames_are_the_poses_of_the_sampled_moments() {
    // The second period is not a multiple of the step, the third is shorter than the step.
    for period in [0.1, 0.123, 0.001] {
        let (mut sampled, mut stepped) = (race(), race());
        for until in [0.05, 0.1, 0.11, 0.9, 2.0] {
            sampled.ask("run", json!({"until": until, "sample": period}));
        }
        let kept = frames(&mut sampled);
        assert!(kept.len() > 100);
        assert!(kept == expected(&mut stepped, 2.0, period), "{period}");
        assert_eq!(sampled.digest(), stepped.digest());
        assert!(frames(&mut sampled).is_empty());
    }
}

#[test]
fn frames_follow_robots_that_join() {
    let mut client = race();
    let robots = client
        .ask("fleet", json!({}))
        .as_array()
        .map_or(0, Vec::len);
    let pose = json!({"position": {"x": -3.0, "y": -3.0, "z": 0.0}, "yaw": 0.0, "pitch": 0.0, "roll": 0.0});
    let join = json!({"join": {"like": 0, "name": "late", "pose": pose}});
    client.ask("run", json!({"until": 0.1, "sample": 0.1}));
    client.ask("apply", json!({"intervention": join}));
    client.ask("run", json!({"until": 0.2, "sample": 0.1}));
    let kept = frames(&mut client);
    assert_eq!(kept[1], robots as f64);
    assert_eq!(kept[2 + 11 * robots + 1], robots as f64 + 1.0);
    assert_eq!(kept.len(), 2 * 2 + 11 * (2 * robots + 1));
}

#[test]
fn a_snapshot_keeps_frames_that_were_not_taken() {
    let mut client = race();
    client.ask("run", json!({"until": 1.0, "sample": 0.25}));
    let snapshot = client.ask("snapshot", json!({}));
    let taken = frames(&mut client);
    assert_eq!(taken.first(), Some(&0.25));
    client.ask("run", json!({"until": 2.0, "sample": 0.25}));
    client.ask("restore", json!({"snapshot": snapshot}));
    assert!(frames(&mut client) == taken);
}

#[test]
fn invalid_periods_are_rejected() {
    let mut client = race();
    for period in [json!(0.0), json!(-1.0), json!(1e-12), json!("1s")] {
        let refused = client.try_ask("run", json!({"until": 1.0, "sample": period}));
        assert!(refused.is_err(), "{period}");
    }
    assert_eq!(client.ask("status", json!({}))["now"], 0.0);
    assert!(!client.host.frames(7, &mut Vec::new()));
}
