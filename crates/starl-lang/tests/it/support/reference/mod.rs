//! A reference interpreter: it walks the typed program, and every value is a tree. It shares no code with the compiler
//! and the machine, which are compared with it.
//!
//! It has no exact limits of fuel and memory, only rough ones of its own: [`Stop::TooLong`].

mod builtin;
mod expression;
mod operator;
mod statement;
pub mod value;

use super::world::World;
use starl_lang::ir::{Action, Claim, Consistency, Handler, Program, RobotMember, Type};
use starl_lang::machine::{self, Bytecode, Fault};
use value::{Value, default, read, shown, weight};

/// Why a program stopped.
#[derive(Clone, Debug, PartialEq)]
pub enum Stop {
    /// A run-time error.
    Fault(Fault),
    /// The language does not say what happens.
    Unknown,
    /// It takes too long, goes too deep or grows too large.
    TooLong,
}

pub type Outcome<T> = Result<T, Stop>;

/// A program on a robot.
pub struct Reference<'a> {
    pub program: &'a Program,
    /// Only to see with which types the host's functions are called.
    bytecode: &'a Bytecode,
    pub world: World,
    variables: Vec<Value>,
    parameters: Vec<Value>,
    /// The locals of the body that runs.
    locals: Vec<Option<Value>>,
    steps: u32,
    depth: u32,
}

impl<'a> Reference<'a> {
    pub fn new(program: &'a Program, bytecode: &'a Bytecode) -> Reference<'a> {
        let of = |ty: &Type| default(program, ty);
        Reference {
            program,
            bytecode,
            world: World::default(),
            variables: program.variables.iter().map(|one| of(&one.ty)).collect(),
            parameters: program.parameters.iter().map(|one| of(&one.ty)).collect(),
            locals: Vec::new(),
            steps: 0,
            depth: 0,
        }
    }

    /// The variables and parameters by name.
    pub fn values(&self) -> Vec<(&'a str, machine::Value)> {
        let program = self.program;
        let variables = program.variables.iter().zip(&self.variables);
        let variables = variables.map(|(of, value)| (&of.name[..], shown(program, &of.ty, value)));
        let parameters = program.parameters.iter().zip(&self.parameters);
        let parameters =
            parameters.map(|(of, value)| (&of.name[..], shown(program, &of.ty, value)));
        variables.chain(parameters).collect()
    }

    /// Counts something that is done.
    fn step(&mut self) -> Outcome<()> {
        self.steps += 1;
        if self.steps > 100_000 {
            Err(Stop::TooLong)
        } else {
            Ok(())
        }
    }

    /// The value, if it is not too large.
    fn limited(value: Value) -> Outcome<Value> {
        if weight(&value) > 5000 {
            Err(Stop::TooLong)
        } else {
            Ok(value)
        }
    }

    fn begin(&mut self, locals: usize) {
        self.world.moment += 1;
        self.steps = 0;
        self.depth = 0;
        self.locals = vec![None; locals];
    }

    /// Gives parameters their defaults.
    pub fn defaults(&mut self) -> Outcome<()> {
        self.begin(0);
        for (number, parameter) in self.program.parameters.iter().enumerate() {
            if let Some(default) = &parameter.default {
                self.locals = vec![None; parameter.locals.len()];
                self.parameters[number] = self.evaluate(default)?;
            }
        }
        Ok(())
    }

    /// Binds primitives, initializes variables, and runs `init`.
    pub fn start(&mut self) -> Outcome<()> {
        self.begin(0);
        let program = self.program;
        for (number, binding) in program.bindings.iter().enumerate() {
            self.locals = vec![None; binding.locals.len()];
            let primitive = binding.primitive.expect("a program without errors");
            let mut arguments = vec![machine::Value::Int(number as i64)];
            let signature = starl_lang::check::Signature::read(primitive.constructor);
            arguments.extend(self.arguments(&signature, &binding.arguments)?);
            self.host(&format!("{}.bind", primitive.name()), arguments)?;
        }
        for (number, shared) in program.shared.iter().enumerate() {
            let instance = machine::Value::Int((program.bindings.len() + number) as i64);
            let kind = shared_kind(shared);
            let consistency = match shared.consistency {
                Consistency::Eventual => machine::Value::None,
                named => machine::Value::Some(Box::new(machine::Value::Text(named.name().into()))),
            };
            self.host(&format!("{kind}.bind"), vec![instance.clone(), consistency])?;
            if let Some(initial) = &shared.initial {
                self.locals = vec![None; shared.locals.len()];
                let value = self.evaluate(initial)?;
                let value = shown(program, &shared.ty, &value);
                self.host(&format!("{kind}.initialize"), vec![instance, value])?;
            }
        }
        for number in 0..program.variables.len() {
            self.initialize(number)?;
        }
        if let Some(init) = &program.init {
            self.procedure(init)?;
        }
        if program.roles.is_some() {
            self.enter_role()?;
        }
        Ok(())
    }

    fn initialize(&mut self, number: usize) -> Outcome<()> {
        let variable = &self.program.variables[number];
        self.variables[number] = match &variable.initial {
            Some(initial) => {
                let outer = std::mem::replace(&mut self.locals, vec![None; variable.locals.len()]);
                let value = self.evaluate(initial)?;
                self.locals = outer;
                value
            }
            None => default(self.program, &variable.ty),
        };
        Ok(())
    }

    /// Runs the effect of an action if its guard holds; whether it did.
    pub fn action(&mut self, action: &'a Action) -> Outcome<bool> {
        self.begin(action.locals.len());
        if !self.holds(&action.guard)? {
            return Ok(false);
        }
        self.block(&action.effect)?;
        Ok(true)
    }

    /// Runs a handler with all parts of its event.
    pub fn handler(
        &mut self,
        handler: &'a Handler,
        event: &[(Type, machine::Value)],
    ) -> Outcome<()> {
        self.begin(handler.locals.len());
        for (local, (ty, value)) in handler.parameters.iter().zip(event) {
            if let Some(local) = local {
                self.locals[local.index()] = Some(read(self.program, ty, value));
            }
        }
        self.block(&handler.body)?;
        Ok(())
    }

    /// Evaluates every property for some robots, all of which have the same state.
    pub fn properties(&mut self) -> Vec<Outcome<bool>> {
        self.world.moment += 1;
        let mut results = Vec::new();
        for property in &self.program.properties {
            let conditions = match &property.claim {
                Claim::Always(holds)
                | Claim::Eventually { holds, .. }
                | Claim::EventuallyAlways { holds, .. } => vec![holds],
                Claim::LeadsTo {
                    cause, consequence, ..
                } => vec![cause, consequence],
            };
            for condition in conditions {
                self.steps = 0;
                self.locals = vec![None; property.locals.len()];
                for (number, robot) in property.robots.iter().enumerate() {
                    self.locals[robot.index()] = Some(Value::Robot(number as u32 % 3));
                }
                results.push(self.holds(condition));
            }
        }
        results
    }

    /// The attribute of a robot in a property.
    fn of_robot(&mut self, robot: Value, member: RobotMember, ty: &Type) -> Outcome<Value> {
        let name = match member {
            RobotMember::Variable(id) => return Ok(self.variables[id.index()].clone()),
            RobotMember::Parameter(id) => return Ok(self.parameters[id.index()].clone()),
            RobotMember::Id => return Ok(robot),
            RobotMember::Position => "robot.position",
            RobotMember::Heading => "robot.heading",
            RobotMember::Velocity => "robot.velocity",
            RobotMember::Finished => "robot.finished",
            RobotMember::Up => "robot.up",
            RobotMember::Shared(id) if self.program[id].is_single_writer => {
                return self.of_shared(id, Some(robot), "all", None, ty);
            }
            RobotMember::Shared(id) => return self.shared(id, Some(robot)),
        };
        let robot = shown(self.program, &Type::Robot, &robot);
        self.ask(name, vec![robot], ty)
    }

    /// Calls a function of the host that gives a value.
    fn ask(&mut self, name: &str, arguments: Vec<machine::Value>, ty: &Type) -> Outcome<Value> {
        let answer = self.host(name, arguments)?.expect("a value");
        Ok(read(self.program, ty, &answer))
    }

    /// Calls a function of the host.
    fn host(
        &mut self,
        name: &str,
        arguments: Vec<machine::Value>,
    ) -> Outcome<Option<machine::Value>> {
        let mut imports = self.bytecode.imports.iter();
        let fits = |import: &&machine::Import| {
            // Where several have the name, those with a result differ by instance only.
            import.name == name && import.arguments.len() == arguments.len()
        };
        let import = imports
            .find(fits)
            .unwrap_or_else(|| panic!("{name} is not imported"));
        let answer = self.world.answer(self.bytecode, import, &arguments);
        answer.map_err(|text| Stop::Fault(Fault::Host(text.into())))
    }
}

fn shared_kind(shared: &starl_lang::ir::Shared) -> &'static str {
    match (shared.is_single_writer, shared.consistency) {
        (true, _) => "SingleWriter",
        (false, Consistency::Linearizable) => "Linearizable",
        (false, _) => "MultiWriter",
    }
}
