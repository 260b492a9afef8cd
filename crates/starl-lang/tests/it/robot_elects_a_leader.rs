//! LeaderElection in programs: all robots show one leader, get its event immediately, and get another leader when it
//! resigns or fails.

use crate::robot_support::{World, compile};
use starl_lang::machine::Value;

/// A program with this algorithm that resigns after it has led for so many activations.
fn program(algorithm: &str, longest: u32) -> String {
    format!(
        r#"
program Elect

election = LeaderElection("chief", algorithm = ElectionAlgorithm.{algorithm})

stands: Bool = false
led_for: Int = 0
leader: RobotId? = none
epoch: Int? = none
told: List[RobotId] = []
lost: Int = 0

start()
    pre not stands and led_for == 0
    eff election.elect(); stands = true

rest()
    pre stands and led_for >= {longest}
    eff election.resign(); stands = false

watch()
    eff
        leader = election.leader
        epoch = election.epoch
        if some l = election.leader and l == me then led_for += 1

on election.elected(robot)
    told.add(robot)

on election.lost(robot)
    lost += 1
"#
    )
}

/// The leader that all of these show.
fn agreed(world: &World, robots: &[usize]) -> Option<String> {
    let shown = |&robot: &usize| world.get(robot, "leader").to_string();
    let leaders: Vec<String> = robots.iter().map(shown).collect();
    let agree = leaders.iter().all(|leader| *leader == leaders[0]) && leaders[0] != "none";
    agree.then(|| leaders[0].clone())
}

#[test]
fn all_show_one_leader_and_another_when_it_resigns() {
    for algorithm in ["leases", "ballots", "bully"] {
        let mut world = World::of(&compile(&program(algorithm, 60)), 4);
        world.steps(50);
        let first = agreed(&world, &[0, 1, 2, 3]).expect(algorithm);
        for robot in 0..4 {
            let told = world.get(robot, "told").to_string();
            assert_eq!(told, format!("[{first}]"), "{algorithm}");
            assert_eq!(world.int(robot, "lost"), 0);
            let has_epoch = world.get(robot, "epoch") != Value::None;
            assert_eq!(has_epoch, algorithm == "leases");
        }
        world.steps(100);
        let second = agreed(&world, &[0, 1, 2, 3]).expect(algorithm);
        assert_ne!(first, second, "{algorithm}");
    }
}

#[test]
fn a_robot_in_a_minority_partition_has_no_leader() {
    let mut world = World::of(&compile(&program("leases", 1000)), 3);
    world.steps(50);
    let leader = agreed(&world, &[0, 1, 2]).expect("a leader");
    world.wire.isolate(0, 3);
    world.steps(100);
    assert_eq!(world.get(0, "leader"), Value::None);
    let rest = agreed(&world, &[1, 2]).expect("a leader");
    world.wire.cut.clear();
    world.steps(100);
    assert_eq!(agreed(&world, &[0, 1, 2]), Some(rest.clone()));
    assert!(leader != "robot0" || rest != "robot0");
}
