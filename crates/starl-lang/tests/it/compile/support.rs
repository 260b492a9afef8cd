//! A robot for compiled programs that records calls, and functions that run programs on it.

use std::borrow::Cow;
use std::collections::BTreeMap;

use starl_core::{Duration, Point, RobotId, Time};
use starl_lang::check::{Checked, Libraries, NoLibraries, check};
use starl_lang::compile::compile;
use starl_lang::diagnostic::{Colour, Diagnostic, render};
use starl_lang::machine::{
    Bytecode, Claim, Fault, Host, HostCall, Import, Limits, Machine, Object, Program, RuntimeError,
    State, Value, Workspace,
};

/// An error and its position: `race.starl:12:5`.
#[derive(Clone, Debug, PartialEq)]
pub struct Stopped {
    pub fault: Fault,
    pub place: String,
}

/// A robot: its program, its state, and its recorded calls.
pub struct Robot {
    pub program: Program,
    pub state: State,
    pub world: World,
    pub limits: Limits,
    /// The fuel that the last call used.
    pub used: u64,
}

/// The world around the robot.
#[derive(Default)]
pub struct World {
    /// Every call except queries, as text.
    pub told: Vec<String>,
    /// The answers to queries; other queries get the answer of [`usual`], or none.
    pub answers: BTreeMap<String, Value>,
    /// The states of the robots of the fleet, for properties.
    pub states: BTreeMap<u32, State>,
}

/// A joined world: answers need the program to be written.
struct Joined<'a> {
    program: &'a Program,
    world: &'a mut World,
}

pub fn some(value: Value) -> Value {
    Value::Some(Box::new(value))
}

pub fn robot(number: u32) -> Value {
    Value::Robot(RobotId(number))
}

/// The default answers to queries.
fn usual(name: &str) -> Option<Value> {
    Some(match name {
        "me" => robot(1),
        "position" => Value::Point(Point::new(1.0, 2.0, 3.0)),
        "heading" => Value::Float(0.5),
        "velocity" => Value::Point(Point::new(0.25, 0.0, 0.0)),
        "now" => Value::Time(Time::ZERO + Duration::from_millis(1500)),
        "peers" => Value::Set([0, 1, 2].map(robot).to_vec()),
        "way_points" => Value::List(
            [1.0, 2.0, 4.0]
                .map(|x| Value::Point(Point::planar(x, 0.0)))
                .to_vec(),
        ),
        "robot.all" => Value::List([0, 1, 2].map(robot).to_vec()),
        _ => return None,
    })
}

impl Host for Joined<'_> {
    fn call(&mut self, _: u32, call: &mut HostCall<'_>) -> Result<u64, Cow<'static, str>> {
        let import = call.import;
        let values = Value::read_all(self.program, &import.arguments, call.scalars, call.objects);
        let values = values.expect("arguments are values of their types");
        let words: Vec<String> = values.iter().map(ToString::to_string).collect();
        let text = format!("{}({})", import.name, words.join(", "));
        if !import.query {
            let labels = import.labels.join(" ");
            let label = if labels.is_empty() { "" } else { " " };
            self.world.told.push(format!("{text}{label}{labels}"));
        }
        if let Some(Value::Text(reason)) =
            self.world.answers.get(&format!("{} refuses", import.name))
        {
            return Err(Cow::Owned(reason.clone()));
        }
        let Some(kind) = import.results.first() else {
            return Ok(0);
        };
        let answers = &self.world.answers;
        let answer = answers.get(&text).or_else(|| answers.get(&import.name));
        let Some(answer) = answer.cloned().or_else(|| usual(&import.name)) else {
            let width = starl_lang::machine::Layout::of([kind]);
            (0..width.scalars.len()).for_each(|index| call.set_scalar(index, 0));
            (0..width.objects.len()).for_each(|index| call.set_object(index, Object::EMPTY));
            return Ok(0);
        };
        let (mut scalars, mut objects) = (Vec::new(), Vec::new());
        let fits = answer.write(self.program, kind, &mut scalars, &mut objects);
        assert!(fits, "{answer} is no answer to {text}");
        for (index, scalar) in scalars.into_iter().enumerate() {
            call.set_scalar(index, scalar);
        }
        for (index, object) in objects.into_iter().enumerate() {
            call.set_object(index, object);
        }
        Ok(0)
    }

    fn state_of(&self, robot: RobotId) -> Option<&State> {
        self.world.states.get(&robot.0)
    }
}

pub fn shown(checked: &Checked, problems: &[Diagnostic]) -> String {
    let file = &checked.files[0];
    render("test.starl", &file.source, problems, Colour::Off)
}

/// The bytecode of a program that has no errors.
pub fn bytecode(source: &str, libraries: &dyn Libraries) -> Bytecode {
    let checked = check(source, libraries);
    compile(&checked).unwrap_or_else(|problems| panic!("{}", shown(&checked, &problems)))
}

/// A program that has no errors, loaded.
pub fn program(source: &str) -> Program {
    load(bytecode(source, &NoLibraries))
}

pub fn load(bytecode: Bytecode) -> Program {
    let text = starl_lang::machine::disassemble(&bytecode);
    Program::load(bytecode, &|_: &Import| Some(0)).unwrap_or_else(|why| panic!("{why}\n{text}"))
}

impl Robot {
    /// A robot that has not started.
    pub fn new(source: &str) -> Self {
        Self::of(program(source))
    }

    pub fn of(program: Program) -> Self {
        Self {
            state: program.new_state(),
            program,
            world: World::default(),
            limits: Limits::default(),
            used: 0,
        }
    }

    /// A robot that has started without an error.
    pub fn started(source: &str) -> Self {
        let mut robot = Self::new(source);
        robot.start().expect("the start has no errors");
        robot.world.told.clear();
        robot
    }

    fn with<T>(
        &mut self,
        run: impl FnOnce(&mut Machine<'_>) -> Result<T, RuntimeError>,
    ) -> Result<T, Stopped> {
        let mut workspace = Workspace::new();
        let mut host = Joined {
            program: &self.program,
            world: &mut self.world,
        };
        let (program, state) = (&self.program, &mut self.state);
        let mut machine = Machine::new(program, state, &mut workspace, &mut host, self.limits);
        let result = run(&mut machine);
        self.used = self.limits.fuel - machine.fuel();
        result.map_err(|error| Stopped {
            place: program
                .source(error.position)
                .expect("every instruction has a place"),
            fault: error.fault,
        })
    }

    pub fn start(&mut self) -> Result<(), Stopped> {
        self.with(|machine| machine.defaults())?;
        self.with(|machine| machine.start())
    }

    /// Tries an action by its name; whether it was done.
    pub fn action(&mut self, name: &str) -> Result<bool, Stopped> {
        let actions = &self.program.bytecode().actions;
        let index = actions.iter().position(|action| action.name == name);
        let index = index.expect("there is such an action") as u32;
        self.with(|machine| machine.action(index))
    }

    /// Runs all handlers of an event with these arguments.
    pub fn handle(&mut self, event: &str, arguments: &[Value]) -> Result<(), Stopped> {
        let handlers = self.program.bytecode().handlers.clone();
        for (index, handler) in handlers.iter().enumerate() {
            if handler.event != event {
                continue;
            }
            let function = &self.program.bytecode().functions[handler.function as usize];
            let (mut scalars, mut objects) = (Vec::new(), Vec::new());
            for (value, kind) in arguments.iter().zip(&function.arguments) {
                assert!(value.write(&self.program, kind, &mut scalars, &mut objects));
            }
            self.with(|machine| machine.handler(index as u32, &scalars, &objects))?;
        }
        Ok(())
    }

    /// Calls a function of a library by its name.
    pub fn call(&mut self, name: &str, arguments: &[Value]) -> Result<Value, Stopped> {
        let functions = &self.program.bytecode().functions;
        let index = functions.iter().position(|function| function.name == name);
        let index = index.expect("there is such a function");
        let function = functions[index].clone();
        let (mut scalars, mut objects) = (Vec::new(), Vec::new());
        for (value, kind) in arguments.iter().zip(&function.arguments) {
            assert!(value.write(&self.program, kind, &mut scalars, &mut objects));
        }
        let result = self.with(|machine| {
            let (scalars, objects) = machine.call(index as u32, &scalars, &objects)?;
            Ok((scalars.to_vec(), objects.to_vec()))
        });
        let (scalars, objects) = result?;
        let kind = &function.results[0];
        Ok(Value::read(&self.program, kind, &scalars, &objects).expect("a value of its type"))
    }

    /// Whether a property's condition holds of these robots; of `leads_to` the second is the
    /// consequence.
    pub fn holds(&mut self, name: &str, part: usize, robots: &[u32]) -> Result<bool, Fault> {
        let properties = &self.program.bytecode().properties;
        let property = properties.iter().find(|property| property.name == name);
        let functions = match property.expect("there is such a property").claim {
            Claim::Always(holds)
            | Claim::Eventually { holds, .. }
            | Claim::EventuallyAlways { holds, .. } => vec![holds],
            Claim::LeadsTo {
                cause, consequence, ..
            } => vec![cause, consequence],
        };
        let robots: Vec<RobotId> = robots.iter().copied().map(RobotId).collect();
        let mut workspace = Workspace::new();
        let mut host = Joined {
            program: &self.program,
            world: &mut self.world,
        };
        let (program, limits) = (&self.program, self.limits);
        let function = functions[part];
        Machine::holds(
            program,
            function,
            &robots,
            &mut workspace,
            &mut host,
            limits,
        )
        .map_err(|error| error.fault)
    }

    /// The value of a variable, as text.
    pub fn get(&self, variable: &str) -> String {
        let value = self.program.get(&self.state, variable);
        value.expect("there is such a variable").to_string()
    }

    pub fn set(&mut self, variable: &str, value: &Value) {
        assert!(self.program.set(&mut self.state, variable, value));
    }

    /// The calls since the last time.
    pub fn told(&mut self) -> Vec<String> {
        std::mem::take(&mut self.world.told)
    }
}

/// The calls of an effect with these statements, in a program with these declarations.
pub fn effect(declarations: &str, statements: &str) -> Result<Vec<String>, Stopped> {
    let indented: String = statements
        .lines()
        .map(|line| format!("        {line}\n"))
        .collect();
    let source = format!("program Test\n{declarations}\ngo()\n    eff\n{indented}");
    let mut robot = Robot::started(&source);
    robot.action("go")?;
    Ok(robot.told())
}

/// The text that `log` writes for expressions, in a program with these declarations.
pub fn logged(declarations: &str, expressions: &[&str]) -> Vec<String> {
    let lines: Vec<String> = expressions
        .iter()
        .map(|expression| format!("log(\"{{}}\", {expression})"))
        .collect();
    let told = effect(declarations, &lines.join("\n")).expect("no errors");
    let text = |line: &String| {
        let text = line
            .strip_prefix("log(\"")
            .and_then(|text| text.strip_suffix("\")"));
        text.expect("a call of log").replace("\\\"", "\"")
    };
    told.iter().map(text).collect()
}

/// Holds expressions to their values, each as `String` writes it.
pub fn values(declarations: &str, rows: &[(&str, &str)]) {
    let expressions: Vec<&str> = rows.iter().map(|(expression, _)| *expression).collect();
    let found = logged(declarations, &expressions);
    let found: Vec<(&str, &str)> = expressions
        .into_iter()
        .zip(found.iter().map(String::as_str))
        .collect();
    let wrong: Vec<_> = rows
        .iter()
        .zip(&found)
        .filter(|(row, found)| row != found)
        .collect();
    assert!(wrong.is_empty(), "expected and found: {wrong:#?}");
    assert_eq!(rows.len(), found.len());
}

/// Holds statements to the fault that they end with and the line of the effect that it is in.
pub fn faults(declarations: &str, rows: &[(&str, u32, Fault)]) {
    let lines = 4 + declarations.matches('\n').count() as u32;
    for (statements, line, fault) in rows {
        let stopped = effect(declarations, statements).expect_err(statements);
        assert_eq!(stopped.fault, *fault, "{statements}");
        let place: Vec<&str> = stopped.place.split(':').collect();
        assert_eq!(
            (place[0], place[1].parse()),
            ("test.starl", Ok(lines + line)),
            "{statements}"
        );
    }
}
