//! After a transient fault every variable holds some value of its type, and the program runs on.

use crate::robot_support::{self, World, compile};
use starl_core::{Program, Random};
use starl_lang::machine::Value;
use starl_lang::robot::RobotProgram;
use std::collections::BTreeSet;

const EVERYTHING: &str = r#"
program Everything

enum Color {red, green, blue}
record Pair {color: Color, name: String?}
message All(flag: Bool, span: Duration, pairs: List[Pair], table: Map[Color, Set[Int]], duo: (Color, (Int, String?)))

param fixed: Int = 42

radio = Broadcast()
motion = ReachAvoid()

role one
    act()
        eff turns += 1; role = two
role two
    act()
        eff turns += 1; role = one

turns: Int
flag: Bool
count: Int
number: Float
name: String
place: Point
moment: Time
span: Duration
color: Color
maybe: Float?
somewhere: Point?
pair: Pair
nested: List[List[List[List[Int]]]]
pairs: List[Pair]
table: Map[Color, Set[Int]]
points: Set[Point]
duo: (Color, (Int, String?))
duos: Map[(Int, String), List[(Color, Float)]]
allread paired[RobotId]: (Int, (Color, Point))
allwrite pair_of_all: (Int, String) = (1, "")
names: Map[String, Pair?]
allread shown[RobotId]: Pair
allwrite board: Int = 3
stones: Obstacles

use()
    eff
        shown[me] = pair
        board = 1
        radio.broadcast(All(flag, span, pairs, table, duo))
        paired[me] = (count, (color, place))
        pair_of_all = (count, name)
        motion.reach_avoid(place, stones)
        emit("state", pairs = pairs, table = table, nested = nested, span = span, moment = moment,
            names = names, points = points, maybe = maybe, somewhere = somewhere, duo = duo, duos = duos)
        if some (_, text) = duos.keys().min() then log("{}", text)
        for shade, numbers in table
            for n in numbers
                flag = n in numbers
        log("{} {} {}", count, number, board)
"#;

#[test]
fn all_variables_get_values_of_their_types_and_the_program_runs_on() {
    let mut world = World::of(&compile(EVERYTHING), 2);
    world.step();
    let code = world.program(0).code().clone();
    let count = code.program().bytecode().variables.len();
    let mut random = Random::keyed(3, &[]);
    let mut seen: Vec<BTreeSet<String>> = vec![BTreeSet::new(); count];
    for _ in 0..300 {
        world.corrupt(0, &mut random);
        let state = world.program(0).state();
        // Values that do not have their variable's type are left out here.
        let values: Vec<(String, Value)> = (code.program().values(state))
            .map(|(name, value)| (name.to_string(), value))
            .collect();
        assert_eq!(values.len(), count);
        for ((name, value), seen) in values.iter().zip(&mut seen) {
            if let Value::Duration(span) = value {
                assert!(i64::try_from(span.0).is_ok(), "{name}");
            }
            if name != "turns" {
                seen.insert(value.to_string());
            }
        }
        assert_eq!(world.int(0, "fixed"), 42);
        world.step();
        let failed = world.failure(0);
        assert!(
            failed.is_none_or(|text| text.contains("too great")),
            "{failed:?}"
        );
        assert_eq!(world.failure(1), None);
    }
    for (variable, seen) in code.program().bytecode().variables.iter().zip(&seen) {
        let name = &variable.name[..];
        match name {
            "fixed" => assert_eq!(seen.len(), 1),
            "turns" | "stones" => {}
            "flag" | "role" => assert_eq!(seen.len(), 2, "{name}"),
            "color" => assert_eq!(seen.len(), 3),
            _ => assert!(seen.len() > 5, "{name}: {seen:?}"),
        }
    }
}

#[test]
fn equal_random_streams_give_equal_faults() {
    let code = compile(EVERYTHING);
    let corrupted = || {
        let mut program: RobotProgram = robot_support::program(&code);
        program.corrupt(&mut Random::keyed(9, &[1]));
        program.state().clone()
    };
    assert_eq!(corrupted(), corrupted());
}

/// Takes and gives back.
const TAKING_TURNS: &str = "use()
    pre not mux.waiting and not mux.held({\"a\"})
    eff mux.acquire({\"a\"})
give_back()
    pre mux.held({\"a\"})
    eff mux.release({\"a\"})";

/// Primitives, and how robots use each in a program that has no other.
const PRIMITIVES: [(&str, &str); 8] = [
    ("mux = Mutex(\"x\")", TAKING_TURNS),
    (
        "mux = Mutex(\"x\", algorithm = MutexAlgorithm.quorum)",
        TAKING_TURNS,
    ),
    ("gate = Barrier(\"x\")", "use()\n    eff gate.arrive()"),
    ("who = Registration(\"x\")", "use()\n    eff who.register()"),
    (
        "chief = LeaderElection(\"x\")",
        "use()\n    eff chief.elect()",
    ),
    (
        "chief = LeaderElection(\"x\", algorithm = ElectionAlgorithm.ballots)",
        "use()\n    eff chief.elect()",
    ),
    (
        "message Hello(n: Int)\nradio = Broadcast(order = Order.causal)",
        "use()\n    eff radio.broadcast(Hello(1))",
    ),
    (
        "motion = ReachAvoid()",
        "use()
    pre not motion.active
    eff motion.reach_avoid(Point(3.0, 4.0), obstacles())",
    ),
];

/// The visible state of the primitives of a program without variables.
fn primitives(world: &World) -> String {
    let mut text = String::new();
    assert!(world.program(0).write_state(&mut text));
    let services = text.find("Services").expect("it shows its services");
    text.truncate(services);
    text
}

#[test]
fn primitives_are_overwritten_and_the_program_runs_on() {
    for (primitive, actions) in PRIMITIVES {
        let code = compile(&format!("program One\n{primitive}\n{actions}\n"));
        let mut world = World::of(&code, 3);
        let mut random = Random::keyed(4, &[]);
        for _ in 0..20 {
            world.step();
        }
        let mut changes = 0;
        for _ in 0..30 {
            let before = primitives(&world);
            world.corrupt(0, &mut random);
            changes += usize::from(primitives(&world) != before);
            (0..5).for_each(|_| world.step());
            let failed = (0..world.robots.len()).find_map(|robot| world.failure(robot));
            assert_eq!(failed, None, "{primitive}");
        }
        assert!(changes > 10, "{primitive}: {changes}");
    }
}
