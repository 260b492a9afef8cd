//! A host runs a program's start, actions, handlers and properties.

use crate::machine_support::{RACE, TestHost, call, program};
use starl_core::RobotId;
use starl_lang::machine::{Fault, Limits, Machine, Object, Span, State, Value, Workspace};

/// Runs one activation: the actions in order.
fn activate(machine: &mut Machine<'_>) -> Vec<&'static str> {
    let actions = ["initialize", "pick", "wait"];
    let fires = |(index, name)| machine.action(index).expect("no error").then_some(name);
    (0..).zip(actions).filter_map(fires).collect()
}

#[test]
fn a_race_from_start_to_finish() {
    let program = program(RACE);
    let mut state = program.new_state();
    let mut workspace = Workspace::new();
    let mut host = TestHost::default();
    let limits = Limits::default();
    let mut machine = Machine::new(&program, &mut state, &mut workspace, &mut host, limits);
    machine.start().expect("no error");
    assert_eq!(activate(&mut machine), ["initialize", "pick", "wait"]);
    assert_eq!(machine.guard(0), Ok(false));
    assert_eq!(machine.guard(1), Ok(true));
    assert_eq!(activate(&mut machine), ["pick", "wait"]);
    assert_eq!(activate(&mut machine), [""; 0]);
    assert_eq!(
        host.calls,
        [
            "Motion.reach_avoid 0 (1.000, 0.000, 0.000) m",
            "emit arrived index=0",
            "Motion.reach_avoid 0 (2.000, 0.000, 0.000) m",
            "emit arrived index=1",
        ]
    );
}

#[test]
fn a_handler_gets_the_sender_and_the_fields() {
    let program = program(RACE);
    let mut state = program.new_state();
    let mut workspace = Workspace::new();
    let mut host = TestHost::default();
    let limits = Limits::default();
    let mut machine = Machine::new(&program, &mut state, &mut workspace, &mut host, limits);
    machine.start().expect("no error");
    machine.handler(0, &[7, 4], &[]).expect("no error");
    assert_eq!(machine.state().scalars[..], [1, 5]);
    machine.handler(0, &[7, 3], &[]).expect("no error");
    assert_eq!(
        machine.state().scalars[..],
        [1, 5],
        "older news change nothing"
    );
    // Arguments of other number are refused.
    let wrong = machine.handler(0, &[7], &[]).map_err(|error| error.fault);
    assert_eq!(wrong, Err(Fault::Malformed));
    let wrong = machine.handler(0, &[7, 1], &[Object::EMPTY]);
    assert_eq!(wrong.map_err(|error| error.fault), Err(Fault::Malformed));
}

#[test]
fn properties_look_at_the_states_of_robots() {
    let program = program(RACE);
    let mut host = TestHost::default();
    for (robot, index) in [(0, 2), (1, 3)] {
        let mut state = program.new_state();
        state.scalars[1] = index;
        state.objects[0] = starl_lang::machine::List::of_points(&[Default::default(); 2]).into();
        host.states.insert(robot, state);
    }
    let mut workspace = Workspace::new();
    let mut holds = |function, robots: &[u32]| {
        let robots: Vec<RobotId> = robots.iter().map(|&robot| RobotId(robot)).collect();
        let limits = Limits::default();
        let result = Machine::holds(
            &program,
            function,
            &robots,
            &mut workspace,
            &mut host,
            limits,
        );
        result.map_err(|error| error.fault)
    };
    assert_eq!(holds(8, &[0]), Ok(true));
    assert_eq!(holds(8, &[1]), Ok(false));
    assert_eq!(holds(9, &[]), Ok(true));
    assert!(
        matches!(holds(8, &[2]), Err(Fault::Host(_))),
        "there is no robot 2"
    );
}

#[test]
fn a_host_error_stops_the_program_where_it_is() {
    let program = program(
        "type Text\n text \"out of order\"\n import fail (type0) ()\n\
         function f procedure () () registers 1 objects 1\n\
         span 0 10 20\n load_text b0 t0\n span 0 30 45\n call_host r0 b0 h0\n return #0 #1",
    );
    let error = call(&program, &[], &[]).expect_err("the host refuses");
    assert_eq!(error.fault, Fault::Host("out of order".into()));
    assert_eq!(error.position, 1);
    let (file, start, end) = (0, 30, 45);
    assert_eq!(
        program.span(error.position),
        Some(Span { file, start, end })
    );
    let function = program.function_at(error.position).map(|f| &f.name[..]);
    assert_eq!(function, Some("f"));
}

#[test]
fn primitives_are_called_by_their_instance() {
    let program = program(
        "type Text\n type Set[type0]\n text \"a\"\n\
         import Mutex.acquire (Int, type1) ()\n import Mutex.held query (Int) (Bool)\n\
         primitive first Mutex\n primitive second Mutex\n\
         function f procedure () (Bool, Bool) registers 4 objects 2\n\
         int r1 1\n load_text b1 t0\n clear_object b0 type1\n set_add b0 r1 b1 type1\n\
         call_host r1 b0 h0\n\
         int r2 0\n call_host r2 b0 h1\n copy r0 r2\n\
         int r2 1\n call_host r2 b0 h1\n copy r1 r2\n\
         return #0 #2",
    );
    assert_eq!(call(&program, &[], &[]).expect("no error").0, [0, 1]);
}

#[test]
fn states_can_be_shown_with_names() {
    let program = program(RACE);
    let mut state: State = program.new_state();
    state.scalars[..].copy_from_slice(&[2, 7]);
    state.objects[0] = starl_lang::machine::List::of_points(&[Default::default()]).into();
    let variables = &program.bytecode().variables;
    let kinds = variables.iter().map(|variable| &variable.kind);
    let values = Value::read_all(&program, kinds, &state.scalars, &state.objects).expect("values");
    let shown: Vec<String> = variables
        .iter()
        .zip(&values)
        .map(|(variable, value)| format!("{} = {value}", variable.name))
        .collect();
    let expected = [
        "loc = wait",
        "currentIndex = 7",
        "target = [(0.0, 0.0, 0.0)]",
    ];
    assert_eq!(shown, expected);
    // And written back.
    let (mut scalars, mut objects) = (Vec::new(), Vec::new());
    for (variable, value) in variables.iter().zip(&values) {
        assert!(value.write(&program, &variable.kind, &mut scalars, &mut objects));
    }
    assert_eq!(
        (&scalars[..], &objects[..]),
        (&state.scalars[..], &state.objects[..])
    );
}
