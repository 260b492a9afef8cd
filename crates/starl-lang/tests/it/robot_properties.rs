//! Properties: each kind, for rows of robots and for the fleet, and the messages of violations.

use crate::robot_support::{self, compile};
use starl_core::{Duration, Point, Pose, RobotId, Time};
use starl_lang::machine::{State, Value};
use starl_lang::robot::Code;
use starl_lang::robot::properties::{Fleet, Judge, Reason, Standing, Violation};

/// Robots whose state the test sets.
pub struct Given {
    code: Code,
    ids: Vec<RobotId>,
    states: Vec<Option<State>>,
    pub places: Vec<Point>,
    finished: Vec<bool>,
    pub up: Vec<bool>,
    /// The versions of the robots' states, if they are recorded.
    versions: Option<Vec<u64>>,
    pub undisturbed: Duration,
    pub uncorrupted: Duration,
}

impl Given {
    pub fn new(source: &str, robots: usize) -> Given {
        let code = compile(source);
        let state = robot_support::program(&code).state().clone();
        Given {
            code,
            ids: (0..robots as u32).map(RobotId).collect(),
            states: vec![Some(state); robots],
            places: (0..robots).map(|x| Point::planar(x as f64, 0.0)).collect(),
            finished: vec![false; robots],
            up: vec![true; robots],
            versions: None,
            undisturbed: Duration(u64::MAX),
            uncorrupted: Duration(u64::MAX),
        }
    }

    pub fn set(&mut self, robot: usize, variable: &str, value: Value) {
        let state = self.states[robot].as_mut().expect("the robot has started");
        assert!(self.code.program().set(state, variable, &value));
        if let Some(versions) = &mut self.versions {
            versions[robot] += 1;
        }
    }

    pub fn judge(&self) -> Judge {
        Judge::new(&self.code)
    }
}

impl Fleet for Given {
    fn robots(&self) -> &[RobotId] {
        &self.ids
    }

    fn state_of(&self, robot: RobotId) -> Option<&State> {
        self.states.get(robot.index())?.as_ref()
    }

    fn version(&self, robot: RobotId) -> Option<u64> {
        Some(self.versions.as_ref()?[robot.index()])
    }

    fn pose(&self, robot: RobotId) -> Option<Pose> {
        let position = *self.places.get(robot.index())?;
        Some(Pose {
            position,
            ..Pose::default()
        })
    }

    fn velocity(&self, robot: RobotId) -> Option<Point> {
        self.places.get(robot.index()).map(|_| Point::ZERO)
    }

    fn has_finished(&self, robot: RobotId) -> bool {
        self.finished[robot.index()]
    }

    fn is_up(&self, robot: RobotId) -> bool {
        self.up[robot.index()]
    }

    fn undisturbed(&self) -> Duration {
        self.undisturbed
    }

    fn uncorrupted(&self) -> Duration {
        self.uncorrupted
    }
}

pub fn seconds(seconds: u64) -> Time {
    Time::ZERO + Duration::from_seconds(seconds)
}

pub fn rows(violations: &[Violation]) -> Vec<Vec<u32>> {
    let row = |violation: &Violation| violation.robots.iter().map(|robot| robot.0).collect();
    violations.iter().map(row).collect()
}

/// Judges a property that asks for 5 s of what `word` says and `set` gives.
fn asks_for_time(word: &str, set: impl Fn(&mut Given, Duration)) {
    let source = format!(
        "program Calm

count: Int = 0

work()
    eff count += 1

always done: count > 0 or {word} < 5s
"
    );
    let mut fleet = Given::new(&source, 1);
    let mut judge = fleet.judge();
    for (time, given, violations) in [(1, 4, 0), (2, 0, 0), (7, 5, 1)] {
        set(&mut fleet, Duration::from_seconds(given));
        assert_eq!(judge.observe(seconds(time), &fleet).len(), violations);
    }
}

#[test]
fn a_property_may_ask_for_time_without_faults() {
    asks_for_time("undisturbed", |fleet, time| fleet.undisturbed = time);
}

#[test]
fn a_property_may_ask_for_time_without_corruption() {
    asks_for_time("uncorrupted", |fleet, time| fleet.uncorrupted = time);
}

const ALWAYS: &str = "program Always

limit: Int = 10
count: Int = 0
names: List[String]

work()
    eff count += 1; names = []; limit = 10

invariant small: count < limit
";

#[test]
fn an_invariant_is_reported_once_for_each_robot_with_its_state() {
    let mut fleet = Given::new(ALWAYS, 3);
    let mut judge = fleet.judge();
    for robot in 0..3 {
        fleet.set(robot, "limit", Value::Int(10));
    }
    assert_eq!(judge.observe(seconds(1), &fleet), []);
    assert_eq!(judge.standing(0), Standing::Holds);
    fleet.set(1, "count", Value::Int(12));
    let violations = judge.observe(seconds(2), &fleet);
    assert_eq!(rows(&violations), [[1]]);
    let violation = &violations[0];
    assert_eq!(
        (violation.name.as_str(), violation.at),
        ("small", seconds(2))
    );
    assert_eq!(violation.reason, Reason::Untrue);
    assert_eq!(
        violation.to_string(),
        "is not true; robot 1 at (1.00, 0.00, 0.00): limit = 10, count = 12"
    );
    let place = violation.place.as_deref().unwrap_or_default();
    assert!(place.starts_with("always.starl:10:"), "{place}");
    // The same robot is not reported again, another is.
    fleet.set(2, "count", Value::Int(10));
    assert_eq!(rows(&judge.observe(seconds(3), &fleet)), [[2]]);
    assert_eq!(judge.observe(seconds(4), &fleet), []);
    assert_eq!(judge.standing(0), Standing::Violated);
    assert_eq!(judge.standing_of(0, &[RobotId(0)]), Standing::Holds);
    assert_eq!(judge.standing_of(0, &[RobotId(1)]), Standing::Violated);
}

const APART: &str = "program Apart

x: Int = 0

work()
    eff x += 1

always apart: forall r, s: r == s or distance(r.position, s.position) > 50cm
always same: forall r, s: r.x == s.x
";

#[test]
fn a_property_of_two_robots_is_judged_of_all_pairs() {
    let mut fleet = Given::new(APART, 3);
    let mut judge = fleet.judge();
    assert_eq!(judge.observe(seconds(1), &fleet), []);
    fleet.places[2] = Point::planar(0.9, 0.0);
    fleet.set(0, "x", Value::Int(1));
    let violations = judge.observe(seconds(2), &fleet);
    let (apart, same): (Vec<_>, Vec<_>) = violations.into_iter().partition(|v| v.property == 0);
    assert_eq!(rows(&apart), [[1, 2], [2, 1]]);
    assert_eq!(rows(&same), [[0, 1], [0, 2], [1, 0], [2, 0]]);
    assert!(
        same[0]
            .to_string()
            .ends_with(": x = 1; robot 1 at (1.00, 0.00, 0.00): x = 0")
    );
}

#[test]
fn a_robot_counts_from_when_its_program_has_started() {
    let mut fleet = Given::new(APART, 2);
    fleet.set(1, "x", Value::Int(5));
    let late = fleet.states[1].take();
    let mut judge = fleet.judge();
    assert_eq!(judge.observe(seconds(1), &fleet), []);
    fleet.states[1] = late;
    assert_eq!(rows(&judge.observe(seconds(2), &fleet)), [[0, 1], [1, 0]]);
}

const EVENTUALLY: &str = "program Eventually

done: Bool = false

work()
    eff done = true

eventually each: done within 10s
eventually all_done: forall r: r.finished and r.up within 20s
eventually some_day: exists r: r.done
";

#[test]
fn an_eventual_condition_is_open_until_it_is_true_or_late() {
    let mut fleet = Given::new(EVENTUALLY, 2);
    let mut judge = fleet.judge();
    let standings = |judge: &Judge| [0, 1, 2].map(|property| judge.standing(property));
    use Standing::{Holds, Open, Violated};
    assert_eq!(standings(&judge), [Open, Open, Open]);
    assert_eq!(judge.observe(seconds(1), &fleet), []);
    fleet.set(0, "done", Value::Bool(true));
    assert_eq!(judge.observe(seconds(9), &fleet), []);
    assert_eq!(standings(&judge), [Open, Open, Holds]);
    assert_eq!(judge.standing_of(0, &[RobotId(0)]), Holds);
    assert_eq!(judge.standing_of(0, &[RobotId(1)]), Open);
    // It was true for one robot, and need not stay so.
    fleet.set(0, "done", Value::Bool(false));
    let violations = judge.observe(seconds(10), &fleet);
    assert_eq!(rows(&violations), [[1]]);
    let within = Duration::from_seconds(10);
    assert_eq!(violations[0].reason, Reason::NotInTime { within });
    assert_eq!(
        violations[0].to_string(),
        "has not become true within 10s; robot 1 at (1.00, 0.00, 0.00): done = false"
    );
    // That of the fleet holds when it is true of all at once.
    fleet.finished = vec![true, false];
    assert_eq!(judge.observe(seconds(15), &fleet), []);
    assert_eq!(standings(&judge), [Violated, Open, Holds]);
    fleet.finished = vec![true, true];
    assert_eq!(judge.observe(seconds(20), &fleet), []);
    assert_eq!(standings(&judge), [Violated, Holds, Holds]);
    fleet.up[1] = false;
    assert_eq!(judge.observe(seconds(50), &fleet), []);
}

#[test]
fn a_claim_about_the_fleet_names_the_robot_that_was_looked_at_last() {
    let mut fleet = Given::new(EVENTUALLY, 3);
    fleet.finished = vec![true, false, true];
    for robot in 0..3 {
        fleet.set(robot, "done", Value::Bool(true));
    }
    let mut judge = fleet.judge();
    assert_eq!(judge.observe(seconds(9), &fleet), []);
    let violations = judge.observe(seconds(21), &fleet);
    assert_eq!(rows(&violations), [Vec::<u32>::new()]);
    let text = violations[0].to_string();
    let seen = "looked at last; robot 1 at (1.00, 0.00, 0.00): finished = false, done = true";
    assert!(text.ends_with(seen), "{text}");
}

const LEADS_TO: &str = "program LeadsTo

asked: Bool = false
answered: Bool = false

work()
    eff asked = true; answered = true

always answer: asked leads_to answered within 5s
always sometime: asked leads_to answered
";

#[test]
fn a_consequence_must_be_true_in_time() {
    let mut fleet = Given::new(LEADS_TO, 2);
    let mut judge = fleet.judge();
    let set = |fleet: &mut Given, robot, asked, answered| {
        fleet.set(robot, "asked", Value::Bool(asked));
        fleet.set(robot, "answered", Value::Bool(answered));
    };
    assert_eq!(judge.observe(seconds(0), &fleet), []);
    assert_eq!(judge.standing(0), Standing::Holds);
    // At once.
    set(&mut fleet, 0, true, true);
    assert_eq!(judge.observe(seconds(1), &fleet), []);
    assert_eq!(judge.standing(0), Standing::Holds);
    // Later, when the question is gone.
    set(&mut fleet, 0, true, false);
    assert_eq!(judge.observe(seconds(2), &fleet), []);
    assert_eq!(judge.standing(0), Standing::Open);
    set(&mut fleet, 0, false, false);
    assert_eq!(judge.observe(seconds(6), &fleet), []);
    set(&mut fleet, 0, false, true);
    assert_eq!(judge.observe(seconds(7), &fleet), []);
    assert_eq!(judge.standing(0), Standing::Holds);
    // Too late, counted from the first of the questions.
    set(&mut fleet, 1, true, false);
    assert_eq!(judge.observe(seconds(10), &fleet), []);
    assert_eq!(judge.observe(seconds(14), &fleet), []);
    set(&mut fleet, 1, true, true);
    let violations = judge.observe(seconds(16), &fleet);
    assert_eq!(rows(&violations), [[1]]);
    let (since, within) = (seconds(10), Duration::from_seconds(5));
    assert_eq!(violations[0].reason, Reason::NotFollowed { since, within });
    assert!(
        violations[0]
            .to_string()
            .starts_with("the consequence is not true within 5s of 10.000s")
    );
    // Without limit nothing is too late.
    assert_eq!(judge.standing(1), Standing::Holds);
    assert_eq!(
        [judge.standing(0), judge.standing_of(0, &[RobotId(0)])],
        [Standing::Violated, Standing::Holds]
    );
}

#[test]
fn evaluation_errors_are_reported_with_their_position() {
    let source = "program Hard

numbers: List[Int]
index: Int = 0

work()
    eff numbers = [1]; index = 3

invariant hard: numbers[index] > 0
";
    let fleet = Given::new(source, 1);
    let violations = fleet.judge().observe(seconds(1), &fleet);
    assert_eq!(
        violations[0].to_string(),
        "cannot be judged: hard.starl:9:17: index 0 of an empty list; robot 0 at (0.00, 0.00, 0.00): \
         numbers = [], index = 0"
    );
}

#[test]
fn quantifiers_within_a_property_range_over_all_robots() {
    let source = "program Inner

leader: Bool = false
speed: Float = 0.0

work()
    eff leader = true; speed = 1.0

always one: exists r: r.leader and (forall s: s == r or not s.leader)
always listed: forall r: r in peers and now >= now and robot_name(r).size() == 6
";
    let mut fleet = Given::new(source, 3);
    let mut judge = fleet.judge();
    fleet.set(1, "leader", Value::Bool(true));
    assert_eq!(judge.observe(seconds(1), &fleet), []);
    fleet.set(2, "leader", Value::Bool(true));
    let violations = judge.observe(seconds(2), &fleet);
    assert_eq!(violations.len(), 1);
    assert_eq!(violations[0].name, "one");
}

#[test]
fn judging_only_changed_robots_gives_the_same_verdicts() {
    let source = "program Changes

x: Int = 0
y: Int = 0
other: RobotId? = none

work()
    eff x += 1; y += 1; other = me

always small: x < 4
always elsewhere: position.x < 2.5
always other_small: forall r: r.other == none or (r.other!).x < 3
eventually grows: x > 2 within 6s
always follows: x > 0 leads_to y > 0 within 2s
";
    let mut random = starl_core::Random::keyed(5, &[]);
    let mut seen = 0;
    for _ in 0..200 {
        let mut all = Given::new(source, 3);
        let mut changed = Given::new(source, 3);
        changed.versions = Some(vec![1; 3]);
        let (mut judge, mut lazy) = (all.judge(), changed.judge());
        let mut down: [Option<State>; 3] = Default::default();
        for second in 0..10 {
            for _ in 0..random.below(3) {
                let robot = random.below(3) as usize;
                if all.states[robot].is_none() {
                    continue;
                }
                let (name, value) = match random.below(3) {
                    0 => ("x", Value::Int(i64::from(random.below(5)))),
                    1 => ("y", Value::Int(i64::from(random.below(2)))),
                    _ => (
                        "other",
                        Value::Some(Box::new(Value::Robot(RobotId(random.below(3))))),
                    ),
                };
                all.set(robot, name, value.clone());
                changed.set(robot, name, value);
            }
            if random.chance(0.2) {
                // A robot crashes, or comes back as it was.
                let robot = random.below(3) as usize;
                let (state, other) = (&mut all.states[robot], &mut changed.states[robot]);
                match state.take() {
                    Some(gone) => down[robot] = Some(gone),
                    None => *state = down[robot].take(),
                }
                other.clone_from(state);
            }
            if random.chance(0.1) {
                let place = Point::planar(f64::from(random.below(4)), 0.0);
                let robot = random.below(3) as usize;
                (all.places[robot], changed.places[robot]) = (place, place);
            }
            let violations = judge.observe(seconds(second), &all);
            seen += violations.len();
            assert_eq!(lazy.observe(seconds(second), &changed), violations);
            for property in 0..judge.properties().len() {
                assert_eq!(lazy.standing(property), judge.standing(property));
            }
        }
    }
    assert!(seen > 500, "{seen} violations");
}
