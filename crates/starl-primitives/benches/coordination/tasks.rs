//! The measured tasks: their preparation, the task, and the cost in theory.

use crate::harness::crosser::{Crosser, arrive, crosser};
use crate::harness::elector::{ELECT, Elector, agreed, by};
use crate::harness::keeper::{self, Keeper};
use crate::harness::locker::{self, Locker, acquire, mutex, release};
use crate::harness::registrar::{Registrar, agree, register, unregister};
use crate::harness::{Wire, World};
use starl_core::{Duration, Input, Program};
use starl_primitives::{election, mutex, registration};

pub struct Task {
    pub name: &'static str,
    /// The name of the instances whose messages count.
    pub port: &'static str,
    /// A ready fleet of this number of robots, by seed and delay in milliseconds.
    pub prepare: Box<dyn Fn(usize, u64, u64) -> World>,
    /// Does it, and gives how long robots waited for it.
    pub run: Box<dyn Fn(&mut World) -> Duration>,
    /// Whether it is done once for each robot.
    pub is_of_each: bool,
    /// The theoretical number of messages, by the number of robots.
    pub messages: Box<dyn Fn(f64) -> String>,
    /// The theoretical number of successive delays.
    pub delays: &'static str,
}

pub fn all() -> Vec<Task> {
    let mut all = Vec::new();
    all.extend(mutexes());
    all.extend(registers());
    all.extend(elections());
    all.extend(registrations());
    all.push(crossing());
    all
}

const MOST: Duration = Duration::from_seconds(100);

/// Runs until this is so, and gives how long that took; none if it took longer than [`MOST`]. It is looked at
/// when everything of a moment has happened.
fn run_until(world: &mut World, done: impl Fn(&World) -> bool) -> Option<Duration> {
    let begun = world.now;
    while !done(world) {
        let next = world.next_moment();
        if next > begun + MOST {
            return None;
        }
        world.run_for(next.since(world.now));
    }
    Some(world.now.since(begun))
}

/// Runs until this is so, and on until what is on its way has come.
fn until(world: &mut World, done: impl Fn(&World) -> bool) -> Duration {
    let waited = run_until(world, done).expect("it comes about");
    world.run_for(world.wire.longest_delay() * 4);
    waited
}

fn fleet(
    robots: usize,
    seed: u64,
    delay_ms: u64,
    make: impl Fn() -> Box<dyn Program> + 'static,
) -> World {
    let mut world = World::new(robots, seed, Wire::delayed(delay_ms), None, make);
    (0..robots).for_each(|robot| world.input(robot, &Input::Activate));
    world
}

fn exactly(messages: impl Fn(f64) -> f64 + 'static) -> Box<dyn Fn(f64) -> String> {
    Box::new(move |robots| format!("{:.1}", messages(robots)))
}

fn at_most(messages: impl Fn(f64) -> f64 + 'static) -> Box<dyn Fn(f64) -> String> {
    Box::new(move |robots| format!("<= {:.1}", messages(robots)))
}

fn at_least(messages: impl Fn(f64) -> f64 + 'static) -> Box<dyn Fn(f64) -> String> {
    Box::new(move |robots| format!(">= {:.1}", messages(robots)))
}

fn mutexes() -> Vec<Task> {
    use mutex::Algorithm::{Lease, Permission, Quorum};
    // Request and permission; or request, grant and release. In a crowd robots that wait for a quorum receive
    // that news, are asked to yield, and yield.
    let each = |algorithm| match algorithm {
        Permission => ("2", 2.0, "1", 2.0),
        Quorum => ("2", 3.0, "2", 6.0),
        Lease => ("2", 3.0, "2", 3.0),
    };
    let named = [
        (
            Permission,
            [
                "mutex, permission",
                "mutex, permission, crowd",
                "mutex, permission, kept",
            ],
        ),
        (
            Quorum,
            [
                "mutex, quorum",
                "mutex, quorum, crowd",
                "mutex, quorum, kept",
            ],
        ),
        (
            Lease,
            ["mutex, lease", "mutex, lease, crowd", "mutex, lease, kept"],
        ),
    ];
    let tasks = named
        .into_iter()
        .flat_map(|(algorithm, [alone, crowd, kept])| {
            let (delays, messages, crowd_delays, crowd_messages) = each(algorithm);
            let asked = move |robots: f64| locker::asked(algorithm, robots as usize);
            let prepare = move |robots, seed, delay_ms| {
                let mut world = fleet(robots, seed, delay_ms, Locker::bare(algorithm));
                world.run_for(Duration::from_seconds(5));
                turns(&mut world);
                world
            };
            let task = |name, run: fn(&mut World) -> Duration, messages, delays| Task {
                name,
                port: "lock",
                prepare: Box::new(prepare),
                run: Box::new(run),
                is_of_each: true,
                messages,
                delays,
            };
            [
                task(alone, turns, exactly(move |n| messages * asked(n)), delays),
                task(
                    crowd,
                    all_at_once,
                    at_most(move |n| crowd_messages * asked(n)),
                    crowd_delays,
                ),
                task(
                    kept,
                    all_for_a_while,
                    Box::new(|_| "repetitions".into()),
                    crowd_delays,
                ),
            ]
        });
    tasks.collect()
}

/// Each robot enters once, alone.
fn turns(world: &mut World) -> Duration {
    let mut waited = Duration::ZERO;
    for robot in 0..world.size() {
        world.command(robot, acquire(&["a"]));
        waited = waited + until(world, |world| mutex(world, robot).crit());
        world.command(robot, release(&["a"]));
        world.run_for(world.wire.longest_delay() * 4);
    }
    waited
}

/// All robots ask at once, and give back what they get at once.
fn all_at_once(world: &mut World) -> Duration {
    one_after_the_other(world, Duration::ZERO)
}

/// All robots ask at once, and keep what they get for 150 ms.
fn all_for_a_while(world: &mut World) -> Duration {
    one_after_the_other(world, Duration::from_millis(150))
}

fn one_after_the_other(world: &mut World, kept: Duration) -> Duration {
    let robots = world.size();
    let begun = world.now;
    (0..robots).for_each(|robot| world.command(robot, acquire(&["a"])));
    let inside = |world: &World| (0..robots).find(|&robot| mutex(world, robot).crit());
    for _ in 0..robots {
        let granted = run_until(world, |world| inside(world).is_some());
        granted.expect("everybody gets it");
        let robot = inside(world).expect("somebody has it");
        world.run_for(kept);
        world.command(robot, release(&["a"]));
    }
    world.now.since(begun)
}

fn registers() -> Vec<Task> {
    let task = |name, run: fn(&mut World), messages, delays| Task {
        name,
        port: "register",
        prepare: Box::new(|robots, seed, delay_ms| {
            let mut world = fleet(robots, seed, delay_ms, Keeper::boxed(false, None));
            world.run_for(Duration::from_seconds(5));
            world
        }),
        run: Box::new(move |world| {
            let begun = world.now;
            run(world);
            world.now.since(begun)
        }),
        is_of_each: true,
        messages,
        delays,
    };
    let write_all = |world: &mut World| {
        (0..world.size()).for_each(|robot| world.command(robot, keeper::write(robot as u32)));
        keeper::until_done(world);
    };
    vec![
        // Two questions to all and their answers, all robots at once; then gossip.
        task(
            "register, all write",
            write_all,
            exactly(|n| 4.0 * (n - 1.0)),
            "4 for all",
        ),
        // The same for a claim and its write, if no robot is refused.
        task(
            "register, all claim and write",
            keeper::all_count,
            at_least(|n| 4.0 * (n - 1.0)),
            ">= 4",
        ),
    ]
}

fn elections() -> Vec<Task> {
    use election::Algorithm::{Ballots, Bully, Leases};
    let task = |name, algorithm, standing: fn(usize) -> Vec<usize>, messages, delays| Task {
        name,
        port: "election",
        prepare: Box::new(move |robots, seed, delay_ms| {
            let make = Elector::boxed(by(algorithm), None, false, false);
            let mut world = fleet(robots, seed, delay_ms, make);
            if algorithm == Leases {
                world.run_for(Duration::from_seconds(5));
            }
            world
        }),
        run: Box::new(move |world| {
            let all: Vec<usize> = (0..world.size()).collect();
            for robot in standing(world.size()) {
                world.command(robot, ELECT);
            }
            until(world, |world| agreed(world, &all).is_some())
        }),
        is_of_each: false,
        messages,
        delays,
    };
    let one = |_| vec![1];
    let all = |robots| (0..robots).collect();
    vec![
        // It asks for votes, gets them, and says that it leads.
        task(
            "election, leases, one stands",
            Leases,
            one,
            exactly(|n| 3.0 * (n - 1.0)),
            "3",
        ),
        // The same, where the first is through before another stands.
        task(
            "election, leases, all stand",
            Leases,
            all,
            at_least(|n| 3.0 * (n - 1.0)),
            "3",
        ),
        // Each tells its ballot, from which all know the winner; and the winner that it has won.
        task(
            "election, ballots",
            Ballots,
            all,
            exactly(|n| (n + 1.0) * (n - 1.0)),
            "1",
        ),
        // Each asks the greater ones, or all at once if these are more than half; these answer; the greatest says
        // that it leads.
        task("election, bully", Bully, all, exactly(bully), "1"),
    ]
}

fn bully(robots: f64) -> f64 {
    let others = robots - 1.0;
    let greater = (0..robots as usize).map(|greater| greater as f64);
    let asked = greater.map(|greater| {
        if 2.0 * greater > others {
            others
        } else {
            greater
        }
    });
    asked.sum::<f64>() + robots * others / 2.0 + others
}

fn registrations() -> Vec<Task> {
    let task =
        |name, before: fn(usize) -> usize, after: fn(usize) -> usize, messages, delays| Task {
            name,
            port: "who",
            prepare: Box::new(move |robots, seed, delay_ms| {
                let options = registration::Options {
                    longest_interval: Duration::from_seconds(100_000),
                    ..registration::Options::default()
                };
                let mut world = fleet(robots, seed, delay_ms, Registrar::bare(options));
                (0..before(robots)).for_each(|robot| world.command(robot, register()));
                world.run_for(Duration::from_seconds(10));
                world
            }),
            run: Box::new(move |world| {
                let (before, after) = (before(world.size()), after(world.size()));
                (before..after).for_each(|robot| world.command(robot, register()));
                (after..before).for_each(|robot| world.command(robot, unregister()));
                let members: Vec<u32> = (0..after as u32).collect();
                until(world, |world| agree(world, &members))
            }),
            is_of_each: false,
            messages,
            delays,
        };
    // Announcements, a proposal, an acceptance of each but one, and that all have accepted. Where all announce
    // themselves at once they wait for longer than that takes.
    vec![
        task(
            "registration, all",
            |_| 0,
            |n| n,
            exactly(|n| (n + 3.0) * (n - 1.0)),
            "3",
        ),
        task(
            "registration, one joins",
            |n| n - 1,
            |n| n,
            exactly(|n| 4.0 * (n - 1.0)),
            "4",
        ),
        task(
            "registration, one leaves",
            |n| n,
            |n| n - 1,
            exactly(|n| 4.0 * (n - 1.0) - 1.0),
            "4",
        ),
    ]
}

fn crossing() -> Task {
    let cross = |world: &mut World| {
        (0..world.size()).for_each(|robot| world.command(robot, arrive()));
        until(world, |world| {
            (0..world.size()).all(|robot| crosser(world, robot).barrier.passed())
        })
    };
    Task {
        name: "barrier",
        port: "gate",
        prepare: Box::new(move |robots, seed, delay_ms| {
            let mut world = fleet(robots, seed, delay_ms, Crosser::bare());
            cross(&mut world);
            world
        }),
        run: Box::new(cross),
        is_of_each: false,
        messages: exactly(|n| n * (n - 1.0)),
        delays: "1",
    }
}
