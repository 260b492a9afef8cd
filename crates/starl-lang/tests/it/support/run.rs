//! Running a compiled program for a while, as a robot would.

use super::world::{TestHost, World, value};
use starl_core::{Digest, Random};
use starl_lang::machine::{
    Bytecode, Claim, Fault, Limits, Machine, Object, Parameter, Program, RuntimeError, State,
    Workspace,
};

/// The limits of an activation.
pub const LIMITS: Limits = Limits {
    fuel: 50_000,
    memory: 1 << 17,
};

/// One thing that happens to a program.
#[derive(Clone, Copy, Debug)]
pub enum Input {
    Defaults,
    Start,
    Action(u32),
    Handler(u32),
}

/// The inputs of a program in a run, in order.
pub fn inputs(bytecode: &Bytecode) -> Vec<Input> {
    let mut inputs = vec![Input::Defaults, Input::Start];
    for round in 0..4 {
        inputs.extend((0..bytecode.actions.len() as u32).map(Input::Action));
        let handlers = bytecode.handlers.len() as u32;
        inputs.extend((round..handlers.max(round)).map(Input::Handler));
        inputs.extend((0..handlers.min(round)).map(Input::Handler));
    }
    inputs
}

/// A program's run.
pub struct Run<'a> {
    pub host: TestHost<'a>,
    pub state: State,
    pub workspace: Workspace,
    /// Fuel that was used.
    pub fuel: u64,
}

impl<'a> Run<'a> {
    pub fn new(program: &'a Program) -> Run<'a> {
        let host = TestHost {
            program,
            world: World::default(),
            others: Vec::new(),
        };
        Run {
            host,
            state: program.new_state(),
            workspace: Workspace::new(),
            fuel: 0,
        }
    }

    /// A copy of the run that continues from here.
    pub fn split(&self) -> Run<'a> {
        let host = TestHost {
            program: self.host.program,
            world: self.host.world.clone(),
            others: self.host.others.clone(),
        };
        Run {
            host,
            state: self.state.clone(),
            workspace: Workspace::new(),
            fuel: self.fuel,
        }
    }

    /// Gives the program an input; whether it did something.
    pub fn input(&mut self, input: Input) -> Result<bool, RuntimeError> {
        self.host.world.moment += 1;
        let program = self.host.program;
        let (scalars, objects) = self.arguments(input);
        let host = &mut self.host;
        let mut machine = Machine::new(program, &mut self.state, &mut self.workspace, host, LIMITS);
        let result = match input {
            Input::Defaults => machine.defaults().map(|()| true),
            Input::Start => machine.start().map(|()| true),
            Input::Action(number) => machine.action(number),
            Input::Handler(number) => machine.handler(number, &scalars, &objects).map(|()| true),
        };
        let left = machine.fuel();
        assert!(left <= LIMITS.fuel, "fuel came from nowhere");
        self.fuel += LIMITS.fuel - left;
        if let Err(error) = &result {
            assert_ne!(error.fault, Fault::Malformed, "{input:?}: {error}");
        }
        let most = 2 * LIMITS.memory + 16 * self.state.scalars.len() + 1000;
        assert!(
            self.state.bytes() <= most,
            "the state takes {} bytes",
            self.state.bytes()
        );
        result
    }

    /// The arguments of the handler.
    fn arguments(&self, input: Input) -> (Vec<u64>, Vec<Object>) {
        let program = self.host.program;
        let (mut scalars, mut objects) = (Vec::new(), Vec::new());
        for (kind, value) in self.event(input) {
            assert!(
                value.write(program, &kind, &mut scalars, &mut objects),
                "{value}"
            );
        }
        (scalars, objects)
    }

    /// The parts of the event that the handler is given, with their types.
    pub fn event(
        &self,
        input: Input,
    ) -> Vec<(starl_lang::machine::Type, starl_lang::machine::Value)> {
        let Input::Handler(number) = input else {
            return Vec::new();
        };
        let bytecode = self.host.program.bytecode();
        let handler = &bytecode.handlers[number as usize];
        let kinds = &bytecode.functions[handler.function as usize].arguments;
        let mut random = Random::keyed(self.host.world.moment, &[u64::from(number)]);
        let of = |kind: &starl_lang::machine::Type| {
            (kind.clone(), value(bytecode, kind, &mut random, 3))
        };
        kinds.iter().map(of).collect()
    }

    /// Asks of every property whether it holds of some robots.
    pub fn properties(&mut self) -> Vec<Result<bool, RuntimeError>> {
        let program = self.host.program;
        self.host.others = vec![self.state.clone(); 3];
        self.host.world.moment += 1;
        let mut results = Vec::new();
        for property in &program.bytecode().properties {
            let functions = match property.claim {
                Claim::Always(holds)
                | Claim::Eventually { holds, .. }
                | Claim::EventuallyAlways { holds, .. } => vec![holds],
                Claim::LeadsTo {
                    cause, consequence, ..
                } => vec![cause, consequence],
            };
            let robots: Vec<_> = (0..property.robots)
                .map(|robot| starl_core::RobotId(u32::from(robot) % 3))
                .collect();
            for function in functions {
                let (workspace, host) = (&mut self.workspace, &mut self.host);
                let holds = Machine::holds(program, function, &robots, workspace, host, LIMITS);
                if let Err(error) = &holds {
                    assert_ne!(error.fault, Fault::Malformed, "{}: {error}", property.name);
                }
                results.push(holds);
            }
        }
        results
    }

    /// A digest of the state.
    pub fn digest(&self) -> u64 {
        let mut digest = Digest::default();
        self.state.digest(&mut digest);
        digest.word(self.fuel);
        self.host
            .world
            .log
            .iter()
            .for_each(|line| digest.bytes(line.as_bytes()));
        digest.value()
    }
}

/// Runs a program to the end of the inputs or its first error, and checks that there is no internal error: no malformed
/// value, no more fuel or memory than allowed, and the same result in a repetition and in a continued copy. Returns the
/// error.
pub fn never_goes_wrong(program: &Program) -> Option<RuntimeError> {
    let required =
        |variable: &starl_lang::machine::Variable| variable.parameter == Parameter::Required;
    assert!(
        !program.bytecode().variables.iter().any(required),
        "parameters have defaults here"
    );
    let inputs = inputs(program.bytecode());
    let (mut run, mut again) = (Run::new(program), Run::new(program));
    let mut copy = None;
    for (number, input) in inputs.iter().enumerate() {
        if number == inputs.len() / 2 {
            copy = Some(run.split());
        }
        let result = run.input(*input);
        assert_eq!(again.input(*input), result, "{input:?} again");
        if let Some(copy) = &mut copy {
            assert_eq!(copy.input(*input), result, "{input:?} of a copy");
            assert_eq!(copy.digest(), run.digest(), "a copy after {input:?}");
        }
        assert_eq!(again.digest(), run.digest(), "again after {input:?}");
        if let Err(error) = result {
            return Some(error);
        }
        assert!(program.values(&run.state).count() == program.bytecode().variables.len());
    }
    run.properties();
    None
}

/// The program of this bytecode, on a robot that has every function.
pub fn load(bytecode: &Bytecode) -> Program {
    let loaded = Program::load(bytecode.clone(), &|_: &starl_lang::machine::Import| Some(0));
    loaded.unwrap_or_else(|error| panic!("{error}\n{}", starl_lang::machine::disassemble(bytecode)))
}
