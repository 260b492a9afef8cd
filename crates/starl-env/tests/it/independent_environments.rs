//! An environment is independent of the others, and of the number of threads.

use crate::support::{Arrays, actions, radio, settings, start};
use starl_env::{Actions, Batch, Radio, Settings};

const STEPS: u64 = 60;

/// The results of environment `which` after each step, among so many.
fn trajectory(
    settings: &Settings,
    environments: usize,
    which: usize,
    parallel: bool,
) -> Vec<Vec<u64>> {
    let mut batch = Batch::new(settings.clone(), environments).expect("fair settings");
    batch.set_parallel(parallel);
    let mut arrays = Arrays::of(&batch);
    // The environment that is looked at has the same seed everywhere.
    let seed = |index: usize| (1000 + index as u64).wrapping_sub(which as u64);
    for index in 0..environments {
        start(&mut batch, index, seed(index));
    }
    let (robots, numbers) = (settings.robots(), settings.action_numbers());
    let mail = settings.message_numbers();
    let mut seen = Vec::new();
    for step in 0..STEPS {
        let all = |count: usize, salt: u64| -> Vec<f64> {
            let one = |index| actions(seed(index), step * 2 + salt, robots * count);
            (0..environments).flat_map(one).collect()
        };
        let (acts, messages) = (all(numbers, 0), all(mail, 1));
        batch
            .step(&acts, &messages, arrays.outputs())
            .expect("finite");
        if step == STEPS / 2 {
            for index in (0..environments).filter(|index| index % 3 == which % 3) {
                start(&mut batch, index, seed(index) + 7);
            }
        }
        let part = |list: &[f64]| {
            let size = list.len() / environments;
            let row = &list[which * size..][..size];
            row.iter()
                .map(|number| number.to_bits())
                .collect::<Vec<u64>>()
        };
        let floats = [
            &arrays.poses,
            &arrays.velocities,
            &arrays.lidar,
            &arrays.messages,
        ];
        let mut row: Vec<u64> = floats.iter().flat_map(|list| part(list)).collect();
        for list in [&arrays.contacts, &arrays.ages] {
            let size = list.len() / environments;
            row.extend(list[which * size..][..size].iter().map(|&n| n as u64));
        }
        seen.push(row);
    }
    seen
}

fn kinds() -> Vec<Settings> {
    let with_radio = Settings {
        radio: Some(Radio {
            range: 1.5,
            loss: 0.3,
            delay: (0, 4),
            ..radio(3)
        }),
        ..settings("create", 4)
    };
    let with_pilots = Settings {
        actions: Actions::Waypoints { reach: 0.5 },
        ..settings("car", 3)
    };
    vec![settings("holonomic", 5), with_radio, with_pilots]
}

#[test]
fn the_size_of_the_batch_changes_nothing() {
    for settings in kinds() {
        let alone = trajectory(&settings, 1, 0, false);
        assert!(alone[0] != alone[10], "the robots move");
        for environments in [7, 64] {
            for which in [0, environments / 2, environments - 1] {
                let among = trajectory(&settings, environments, which, false);
                assert!(alone == among, "environment {which} of {environments}");
            }
        }
    }
}

#[cfg(feature = "parallel")]
#[test]
fn the_number_of_threads_changes_nothing() {
    for settings in kinds() {
        let expected = trajectory(&settings, 64, 9, false);
        for threads in [1, 2, 5] {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
            let found = pool
                .expect("a pool")
                .install(|| trajectory(&settings, 64, 9, true));
            assert!(expected == found, "{threads} threads");
        }
    }
}
