//! Robots hear those in range, late and not always.

use crate::support::{Arrays, radio, settings};
use starl_core::{Point, Pose};
use starl_env::{Batch, Radio, Settings};

fn batch(radio: Radio, places: &[f64]) -> Batch {
    let settings = Settings {
        radio: Some(radio),
        obstacles: Vec::new(),
        ..settings("holonomic", places.len())
    };
    let mut batch = Batch::new(settings, 1).expect("fair settings");
    batch.seed(0, 5);
    let poses = places
        .iter()
        .map(|&x| Pose::level(Point::planar(x, 0.0), 0.0));
    batch.place(0, &poses.collect::<Vec<_>>());
    batch
}

/// Robots stand still and say the number of the step, and their own.
fn talk(batch: &mut Batch, steps: usize) -> Vec<Arrays> {
    let robots = batch.settings().robots();
    let mut arrays = Arrays::of(batch);
    let turn = |step: usize| {
        let words = (0..robots).flat_map(|robot| [step as f64, robot as f64]);
        let words: Vec<f64> = words.collect();
        let still = vec![0.0; robots * 3];
        batch
            .step(&still, &words, arrays.outputs())
            .expect("finite");
        arrays.clone()
    };
    (0..steps).map(turn).collect()
}

#[test]
fn messages_arrive_at_once_without_delay() {
    let heard = talk(&mut batch(radio(2), &[0.0, 1.0]), 3);
    assert_eq!(heard[2].ages, [-1, 0, 0, -1]);
    assert_eq!(heard[2].messages, [0.0, 0.0, 2.0, 1.0, 2.0, 0.0, 0.0, 0.0]);
}

#[test]
fn messages_arrive_after_their_delay() {
    let late = Radio {
        delay: (2, 2),
        ..radio(2)
    };
    let heard = talk(&mut batch(late, &[0.0, 1.0]), 5);
    assert_eq!(heard[1].ages, [-1, -1, -1, -1]);
    assert_eq!(heard[2].ages, [-1, 2, 2, -1]);
    assert_eq!(heard[4].messages[2..4], [2.0, 1.0]);
}

#[test]
fn robots_out_of_range_hear_nothing() {
    let near = Radio {
        range: 1.5,
        ..radio(2)
    };
    let heard = talk(&mut batch(near, &[0.0, 1.0, 2.0]), 2);
    assert_eq!(heard[1].ages, [-1, 0, -1, 0, -1, 0, -1, 0, -1]);
}

#[test]
fn losses_have_their_rate_and_newer_messages_are_kept() {
    let lossy = Radio {
        loss: 0.25,
        delay: (0, 3),
        ..radio(2)
    };
    let heard = talk(&mut batch(lossy, &[0.0, 1.0]), 4000);
    let mut last = [-1.0; 2];
    let mut came = 0;
    for (step, arrays) in heard.iter().enumerate() {
        for (which, place) in [1, 2].into_iter().enumerate() {
            let (age, said) = (arrays.ages[place], arrays.messages[place * 2]);
            if age >= 0 {
                assert_eq!(said as i64, step as i64 - i64::from(age));
                assert!(said >= last[which], "an older message replaces a newer one");
                last[which] = said;
            }
            came += usize::from(age == 0);
        }
    }
    // A quarter of the messages that arrive have no delay.
    let expected = 0.75 * 0.25 * 8000.0;
    assert!(
        (came as f64 - expected).abs() < 0.1 * expected,
        "{came} of {expected}"
    );
}

#[test]
fn a_new_episode_forgets_messages() {
    let mut batch = batch(radio(2), &[0.0, 1.0]);
    talk(&mut batch, 3);
    batch.place(
        0,
        &[Pose::default(), Pose::level(Point::planar(1.0, 0.0), 0.0)],
    );
    let mut arrays = Arrays::of(&batch);
    batch.show(|_| true, arrays.outputs());
    assert_eq!(arrays.ages, [-1; 4]);
    assert_eq!(arrays.messages, [0.0; 8]);
}
