//! Common code of the machine's tests: a host that records its calls, and functions that run code in text form.

pub mod every;

use starl_core::{Point, RobotId};
use starl_lang::machine::{
    Fault, Host, HostCall, Import, Limits, List, LoadError, Machine, Object, Program, RuntimeError,
    State, Workspace, assemble,
};
use std::borrow::Cow;
use std::collections::BTreeMap;

/// A host with a few functions, which records its calls.
#[derive(Default)]
pub struct TestHost {
    pub calls: Vec<String>,
    pub states: BTreeMap<u32, State>,
}

/// The functions of [`TestHost`]: name, number.
const FUNCTIONS: [(&str, u32); 9] = [
    ("position", 0),
    ("emit", 1),
    ("way_points", 2),
    ("Mutex.bind", 3),
    ("Mutex.acquire", 4),
    ("Mutex.held", 5),
    ("fail", 6),
    ("expensive", 7),
    ("Motion.reach_avoid", 8),
];

pub fn resolve(import: &Import) -> Option<u32> {
    let found = FUNCTIONS.iter().find(|(name, _)| *name == import.name);
    found.map(|(_, number)| *number)
}

impl Host for TestHost {
    fn call(&mut self, function: u32, call: &mut HostCall<'_>) -> Result<u64, Cow<'static, str>> {
        let name = &call.import.name;
        match function {
            0 => call.set_point(0, Point::new(1.0, 2.0, 3.0)),
            1 => {
                let fields: Vec<String> = call
                    .import
                    .labels
                    .iter()
                    .enumerate()
                    .map(|(i, label)| format!("{label}={}", call.int(i)))
                    .collect();
                let text = format!("emit {} {}", call.text(0), fields.join(" "));
                self.calls.push(text);
            }
            2 => {
                let points = [Point::planar(1.0, 0.0), Point::planar(2.0, 0.0)];
                call.set_object(0, List::of_points(&points).into());
            }
            3 | 4 => {
                let text = format!("{name} {} {}", call.int(0), call.object(0).size());
                self.calls.push(text);
            }
            5 => {
                let asked = format!("Mutex.acquire {} ", call.int(0));
                let held = self.calls.iter().any(|call| call.starts_with(&asked));
                call.set_bool(0, held);
            }
            6 => return Err(Cow::Owned(call.text(0).to_string())),
            7 => return Ok(1000),
            _ => {
                let text = format!("{name} {} {}", call.int(0), call.point(1));
                self.calls.push(text);
            }
        }
        Ok(0)
    }

    fn state_of(&self, robot: RobotId) -> Option<&State> {
        self.states.get(&robot.0)
    }
}

/// A program in text form, verified and joined to [`TestHost`].
pub fn load(text: &str) -> Result<Program, LoadError> {
    let bytecode = assemble(text).unwrap_or_else(|error| panic!("{error}\n{text}"));
    Program::load(bytecode, &resolve)
}

pub fn program(text: &str) -> Program {
    load(text).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

/// The result of a call: scalars and objects, or the error.
pub type Outcome = Result<(Vec<u64>, Vec<Object>), RuntimeError>;

/// Calls function 0 of a program on a new state, with default limits.
pub fn call(program: &Program, scalars: &[u64], objects: &[Object]) -> Outcome {
    call_within(program, Limits::default(), scalars, objects).0
}

/// Calls function 0; gives the outcome and the fuel that was used.
pub fn call_within(
    program: &Program,
    limits: Limits,
    scalars: &[u64],
    objects: &[Object],
) -> (Outcome, u64) {
    let mut state = program.new_state();
    let mut workspace = Workspace::new();
    let mut host = TestHost::default();
    let mut machine = Machine::new(program, &mut state, &mut workspace, &mut host, limits);
    let outcome = machine
        .call(0, scalars, objects)
        .map(|(scalars, objects)| (scalars.to_vec(), objects.to_vec()));
    let used = limits.fuel - machine.fuel();
    (outcome, used)
}

/// The one scalar that a body of instructions leaves in `r0`, which gets the arguments in `r0` and
/// on, out of 32 registers.
pub fn scalar(body: &str, arguments: &[u64]) -> Result<u64, Fault> {
    let types = vec!["Int"; arguments.len()].join(", ");
    let text = format!(
        "function test function ({types}) (Int) registers 32 objects 0\n{body}\nreturn #0 #0"
    );
    let program = program(&text);
    match call(&program, arguments, &[]) {
        Ok((scalars, _)) => Ok(scalars[0]),
        Err(error) => Err(error.fault),
    }
}

/// As [`scalar`], for Ints.
pub fn int(body: &str, arguments: &[i64]) -> Result<i64, Fault> {
    let arguments: Vec<u64> = arguments.iter().map(|&number| number as u64).collect();
    scalar(body, &arguments).map(|result| result as i64)
}

/// As [`scalar`], for Floats.
pub fn float(body: &str, arguments: &[f64]) -> f64 {
    let arguments: Vec<u64> = arguments.iter().map(|number| number.to_bits()).collect();
    f64::from_bits(scalar(body, &arguments).expect("Floats have no errors"))
}

/// As [`scalar`], from Floats to a Bool or an Int.
pub fn of_floats(body: &str, arguments: &[f64]) -> Result<i64, Fault> {
    let arguments: Vec<u64> = arguments.iter().map(|number| number.to_bits()).collect();
    scalar(body, &arguments).map(|result| result as i64)
}

/// A list of Ints.
pub fn ints(numbers: &[i64]) -> Object {
    List::of_scalars(numbers.iter().map(|&number| number as u64).collect()).into()
}

/// The Ints of a list or set.
pub fn numbers(object: &Object) -> Vec<i64> {
    let list = object.list();
    list.map_or(Vec::new(), |list| {
        list.scalars().iter().map(|&n| n as i64).collect()
    })
}

/// A small race: visits the waypoints in order, and follows the robots that are ahead.
pub const RACE: &str = r#"
program Race
enum Location init pick wait
type List[Point]
type Text
text "arrived"
variable loc enum0
variable currentIndex Int
variable target type0
import way_points query () (type0)
import emit (Int, type1) () labels index
import Motion.reach_avoid (Int, Point) ()
primitive motion Motion
start f0
action initialize f1 f2
action pick f3 f4
action wait f5 f6
handler Reached f7
property in_order 1 always f8
property all_done 0 eventually f9 within 120000000000

function start procedure () () registers 1 objects 0
    int r0 0
    store v0 r0
    return #0 #0

function initialize.pre guard () (Bool) registers 1 objects 0
    jump_if_state_not 0 @no v0
    int r0 1
    return #0 #0
no: 
    return_false #0

function initialize.eff procedure () () registers 1 objects 1
    call_host r0 b0 h0
    move_object s0 b0
    int r0 0
    store v1 r0
    int r0 1
    store v0 r0
    return #0 #1

function pick.pre guard () (Bool, Point) registers 4 objects 0
    jump_if_state_not 1 @no v0
span 0 100 120
    load r1 v1
    size r2 s0
    jump_if_less r1 r2 @yes
no:
    return_false #0
yes:
span 0 130 140
    list_get s0 r1 r1 b0
    int r0 1
    return #0 #0

function pick.eff procedure (Point) () registers 8 objects 0
    copy_point r4 r0
    int r3 0
    call_host r3 b0 h2
    int r0 2
    store v0 r0
    return #0 #0

function wait.pre guard () (Bool) registers 1 objects 0
    jump_if_state_not 2 @no v0
    int r0 1
    return #0 #0
no: 
    return_false #0

function wait.eff procedure () () registers 1 objects 1
    load r0 v1
    load_text b0 t0
    call_host r0 b0 h1
    load r0 v1
    add_constant r0 r0 1
    store v1 r0
    int r0 1
    store v0 r0
    return #0 #1

function Reached procedure (Robot, Int) () registers 3 objects 0
    load r2 v1
    jump_if_less r1 r2 @end
    add_constant r1 r1 1
    store v1 r1
    int r1 1
    store v0 r1
end:
    return #0 #0

function in_order property (Robot) (Bool) registers 3 objects 1
    load_other_object b0 r0 s0
    size r1 b0
    load_other r2 r0 v1
    less_equal_int r0 r2 r1
    return_scalar r0 #1

function all_done property () (Bool) registers 2 objects 0
    int r0 0
    load_other r0 r0 v1
    int r1 2
    equal r0 r0 r1
    return_scalar r0 #0
"#;
