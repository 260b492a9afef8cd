//! The cost of code: loops are bounded, and good code is cheap.

use starl_lang::check::NoLibraries;
use starl_lang::machine::{Fault, Limits, Value, disassemble};

use super::support::{Robot, bytecode, load};

const SOURCE: &str = "library L
function loop(turns: Int) -> Int
    let s = 0
    for i in 0..turns
        s += i % 7
    return s
function fib(n: Int) -> Int
    if n < 2 then return n
    return fib(n - 1) + fib(n - 2)
function list(turns: Int) -> Int
    let numbers = [i for i in 0..1000]
    let s = 0
    for turn in 0..turns
        for i in 0..1000
            let number = numbers[i]
            s += number
            numbers[i] = number
    return s
";

fn robot(fuel: u64) -> Robot {
    let mut robot = Robot::of(load(bytecode(SOURCE, &NoLibraries)));
    robot.limits = Limits {
        fuel,
        ..Limits::default()
    };
    robot
}

#[test]
fn a_turn_of_the_loop_is_three_instructions() {
    let mut robot = robot(u64::MAX);
    assert_eq!(
        robot.call("loop", &[Value::Int(1000)]),
        Ok(Value::Int(2997))
    );
    let once = robot.used;
    assert_eq!(
        robot.call("loop", &[Value::Int(2000)]),
        Ok(Value::Int(5995))
    );
    assert_eq!(robot.used - once, 3000);
}

#[test]
fn a_call_of_fib_is_eight_instructions() {
    let mut robot = robot(u64::MAX);
    assert_eq!(robot.call("fib", &[Value::Int(20)]), Ok(Value::Int(6765)));
    // A call with a result below two is two instructions, another one eight.
    let (leaves, others) = (10946, 10945);
    let per_call = (robot.used - 2 * leaves) as f64 / f64::from(others);
    assert!(
        per_call <= 7.0,
        "{per_call}\n{}",
        disassemble(robot.program.bytecode())
    );
}

#[test]
fn a_turn_over_a_list_is_four_instructions() {
    let mut robot = robot(u64::MAX);
    assert_eq!(
        robot.call("list", &[Value::Int(1)]),
        Ok(Value::Int(499_500))
    );
    let once = robot.used;
    robot.call("list", &[Value::Int(2)]).unwrap();
    assert!(robot.used - once <= 4005, "{}", robot.used - once);
}

#[test]
fn long_computations_are_stopped_at_their_position() {
    let mut robot = robot(10_000);
    let stopped = robot
        .call("loop", &[Value::Int(1_000_000)])
        .expect_err("it is too long");
    assert_eq!(stopped.fault, Fault::OutOfFuel);
    let line: u32 = stopped.place.split(':').nth(1).unwrap().parse().unwrap();
    assert!((4..=5).contains(&line), "{}", stopped.place);
    assert_eq!(robot.used, 10_000);
}

#[test]
fn memory_is_bounded() {
    let source = "program Test\nl: List[Int] = [1]\ngo()\n    eff\n        for i in 0..40\n            l += l\n";
    let mut robot = Robot::started(source);
    let stopped = robot.action("go").expect_err("it does not fit");
    assert!(
        matches!(stopped.fault, Fault::OutOfMemory { .. }),
        "{stopped:?}"
    );
    assert_eq!(stopped.place, "test.starl:6:13");
}

#[test]
fn guards_of_a_control_variable_are_one_jump() {
    let source =
        "program Test\nenum L {a, b}\nloc: L = a\ngo()\n    pre loc == b\n    eff loc = a\n";
    let mut robot = Robot::started(source);
    assert_eq!(robot.action("go"), Ok(false));
    assert_eq!(robot.used, 2);
}
