//! How searches end: complete, at a bound, at a robot that waits for ever, at a program that fails, at a
//! program that keeps something to itself.

use crate::support::{search, setup};
use starl_core::{
    Destination, Duration, Message, Port, Primitives, Program, Robot, RobotId, TimerKey, timers,
};
use starl_explore::{Bounds, Clocks, End, FAILED, STUCK, Step};
use std::fmt::Write;

/// Robot 0 greets robot 1 once; a robot that has greeted or was greeted finishes.
#[derive(Clone, Debug, Default, Primitives)]
struct Greeter {
    /// Greets again when this fires.
    patience: Option<Duration>,
    fails: bool,
    is_done: bool,
}

timers! {
    enum Alarm {
        Early,
        Late,
    }
}

fn alarm(alarm: Alarm) -> TimerKey {
    TimerKey::new(Port::PROGRAM, alarm)
}

impl Greeter {
    fn greet(&self, robot: &mut Robot<'_>) {
        robot.transmit(Destination::Robot(RobotId(1)), Port::PROGRAM, &7u8);
        if let Some(patience) = self.patience {
            robot.set_timer(alarm(Alarm::Early), patience);
        }
    }
}

impl Program for Greeter {
    fn activate(&mut self, robot: &mut Robot<'_>) {
        if robot.id() == RobotId(0) && !self.is_done {
            self.is_done = true;
            self.greet(robot);
            robot.finish();
        }
    }

    fn timer(&mut self, robot: &mut Robot<'_>, _: TimerKey) {
        self.greet(robot);
    }

    fn receive(&mut self, robot: &mut Robot<'_>, _: &Message) {
        if self.fails {
            robot.fail("no manners");
        } else {
            robot.finish();
        }
    }

    fn write_state(&self, text: &mut dyn Write) -> bool {
        write!(text, "{self:?}").is_ok()
    }
}

#[test]
fn all_is_explored() {
    let mut setup = setup(2, Greeter::default(), Bounds::default());
    setup.model.all_finish = true;
    let mut search = search(setup);
    assert_eq!(search.run(), &End::Complete);
    // Before the greeting, on its way, after it.
    assert_eq!(search.report().states, 3);
}

#[test]
fn a_robot_that_waits_for_a_lost_message_is_stuck() {
    let bounds = Bounds {
        losses: 1,
        ..Bounds::default()
    };
    let mut setup = setup(2, Greeter::default(), bounds);
    setup.model.all_finish = true;
    match search(setup.clone()).run() {
        End::Violated(found) => {
            assert_eq!(found.violation.property, STUCK);
            assert_eq!(found.violation.robots, [RobotId(1)]);
            assert_eq!(found.steps.len(), 2);
        }
        other => panic!("{other:?}"),
    }
    // With other goals the robots need not finish.
    setup.model.all_finish = false;
    assert_eq!(search(setup).run(), &End::Complete);
}

#[test]
fn of_two_violations_that_are_equally_near_the_first_one_ends_the_search() {
    // The greeting arrives or is lost, and the third robot waits for ever.
    let bounds = Bounds {
        losses: 1,
        ..Bounds::default()
    };
    let mut setup = setup(3, Greeter::default(), bounds);
    setup.model.all_finish = true;
    let mut search = search(setup);
    let End::Violated(found) = search.run() else {
        panic!("{:?}", search.report());
    };
    assert_eq!(found.violation.robots, [RobotId(2)]);
    assert_eq!(search.report().terminal, 1);
}

#[test]
fn a_robot_that_retransmits_is_not_stuck() {
    for timers in [0, 1, 2] {
        let greeter = Greeter {
            patience: Some(Duration::from_millis(100)),
            ..Greeter::default()
        };
        let bounds = Bounds {
            losses: 1,
            timers,
            ..Bounds::default()
        };
        let mut setup = setup(2, greeter, bounds);
        setup.model.all_finish = true;
        assert_eq!(search(setup).run(), &End::Complete);
    }
}

#[test]
fn a_program_that_fails_is_a_violation() {
    let greeter = Greeter {
        fails: true,
        ..Greeter::default()
    };
    match search(setup(2, greeter, Bounds::default())).run() {
        End::Violated(found) => {
            assert_eq!(found.violation.property, FAILED);
            assert!(found.violation.text.contains("no manners"));
            assert_eq!(found.steps[0], Step::Activate(RobotId(0)));
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn reached_bounds_are_reported() {
    let greeter = Greeter {
        patience: Some(Duration::from_millis(100)),
        ..Greeter::default()
    };
    let bounds = Bounds {
        timers: 3,
        ..Bounds::default()
    };
    let shallow = Bounds {
        depth: Some(2),
        ..bounds
    };
    let mut search_to_depth = search(setup(2, greeter.clone(), shallow));
    assert_eq!(search_to_depth.run(), &End::Depth);
    assert_eq!(search_to_depth.report().depth, 2);
    let small = Bounds {
        most_states: 4,
        ..bounds
    };
    assert_eq!(search(setup(2, greeter.clone(), small)).run(), &End::Full);
    assert_eq!(search(setup(2, greeter, bounds)).run(), &End::Complete);
}

/// Counts activations and says so at the third, but does not show the count.
#[derive(Clone, Debug, Default, Primitives)]
struct Secretive(u32);

impl Program for Secretive {
    fn activate(&mut self, robot: &mut Robot<'_>) {
        self.0 += 1;
        let Secretive(count) = self;
        robot.emit("activated", [("third", (*count == 3).into())]);
    }

    fn write_state(&self, _: &mut dyn Write) -> bool {
        true
    }
}

#[test]
fn a_program_that_does_not_write_its_state_is_found_out() {
    let end = search(setup(1, Secretive::default(), Bounds::default()))
        .run()
        .clone();
    assert!(matches!(end, End::Contradiction(_)), "{end:?}");
}

/// The same count, but without a claim to show it: its history distinguishes it.
#[derive(Clone, Debug, Default, Primitives)]
struct Silent(u32);

impl Program for Silent {
    fn activate(&mut self, robot: &mut Robot<'_>) {
        self.0 += 1;
        if self.0 == 3 {
            robot.fail("three");
        }
    }
}

#[test]
fn a_program_without_written_state_is_identified_by_its_history() {
    let bounds = Bounds {
        depth: Some(10),
        ..Bounds::default()
    };
    match search(setup(1, Silent::default(), bounds)).run() {
        End::Violated(found) => assert_eq!(found.steps.len(), 3),
        other => panic!("{other:?}"),
    }
}

/// Finishes when two of its timers have fired, and fails if the later one comes first.
#[derive(Clone, Debug, Default, Primitives)]
struct Timed {
    fired: Vec<Alarm>,
}

impl Program for Timed {
    fn start(&mut self, robot: &mut Robot<'_>) {
        robot.set_timer(alarm(Alarm::Late), Duration::from_millis(900));
        robot.set_timer(alarm(Alarm::Early), Duration::from_millis(300));
    }

    fn activate(&mut self, _: &mut Robot<'_>) {}

    fn timer(&mut self, robot: &mut Robot<'_>, key: TimerKey) {
        self.fired.extend(key.read::<Alarm>());
        match (&self.fired[..], robot.now().seconds()) {
            ([Alarm::Early], now) if (0.3..0.9).contains(&now) => {}
            ([Alarm::Early, Alarm::Late], now) if now >= 0.9 => robot.finish(),
            other => robot.fail(format!("{other:?}")),
        }
    }

    fn write_state(&self, text: &mut dyn Write) -> bool {
        write!(text, "{self:?}").is_ok()
    }
}

#[test]
fn timers_fire_in_their_order_where_clocks_tick() {
    let ticking = |skew| Bounds {
        clocks: Clocks::Ticking {
            tick: Duration::from_millis(250),
            ticks: 6,
            skew,
            delay: None,
        },
        ..Bounds::default()
    };
    let mut sizes = Vec::new();
    for skew in [0, 1, 6] {
        let mut setup = setup(2, Timed::default(), ticking(skew));
        setup.model.all_finish = true;
        let mut search = search(setup);
        assert_eq!(search.run(), &End::Complete);
        sizes.push(search.report().states);
    }
    // A robot is in one state at each of the seven readings of its clock, and in a second one at the two at
    // which a timer fires: nine. Together: the pairs with the same reading; those and the pairs with
    // readings next to each other; all.
    assert_eq!(sizes, [13, 13 + 20, 81]);
}

#[test]
fn without_ticking_clocks_timers_fire_in_any_order() {
    let bounds = Bounds {
        timers: 2,
        ..Bounds::default()
    };
    let mut search = search(setup(1, Timed::default(), bounds));
    assert!(matches!(search.run(), End::Violated(_)));
}
