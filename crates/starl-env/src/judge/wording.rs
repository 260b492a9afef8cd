//! The expressions of a task as text, and the program of the language around them.
//!
//! Quantities are variables of a generated program, which each expression joins as a value of one robot.

use starl_lang::check::{NoLibraries, check};
use starl_lang::compile::with_value;
use starl_lang::diagnostic::{Code, Diagnostic, Severity, Span};
use starl_lang::ir;
use starl_lang::machine::operand::{In, Out, PointOut, Slot};
use starl_lang::machine::{Bytecode, Import, Instruction, LoadError, Program, Type};
use std::fmt;

/// The type of a quantity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// True or false; in arrays 1 or 0.
    Bool,
    /// A number.
    Float,
    /// A place or a direction in the plane, metres; in arrays x, y.
    Point,
}

impl Kind {
    /// The numbers that it takes in an array.
    pub fn width(self) -> usize {
        match self {
            Kind::Point => 2,
            Kind::Bool | Kind::Float => 1,
        }
    }

    fn name(self) -> &'static str {
        match self {
            Kind::Bool => "Bool",
            Kind::Float => "Float",
            Kind::Point => "Point",
        }
    }

    fn ty(self) -> ir::Type {
        match self {
            Kind::Bool => ir::Type::Bool,
            Kind::Float => ir::Type::Float,
            Kind::Point => ir::Type::Point,
        }
    }
}

/// A constant quantity.
#[derive(Clone, Debug)]
pub struct Constant {
    /// Its name.
    pub name: String,
    /// Bool or Float.
    pub kind: Kind,
    /// Its value for each robot.
    pub values: Vec<f64>,
}

/// A quantity of the task: part of a row of numbers that each robot has.
#[derive(Clone, Debug)]
pub struct Column {
    /// Its name.
    pub name: String,
    /// Its type.
    pub kind: Kind,
    /// The expression that gives it after each action; none if the caller writes it.
    pub text: Option<String>,
}

/// The expressions of a task.
#[derive(Clone, Debug, Default)]
pub struct Wording {
    /// Constant quantities.
    pub constants: Vec<Constant>,
    /// Quantities in the order of a robot's row. Those with texts are computed in this order.
    pub columns: Vec<Column>,
    /// The reward of a robot, a Float.
    pub reward: Option<String>,
    /// Whether a robot has done its part, a Bool: the episode is terminated when all robots have.
    pub terminated: Option<String>,
    /// Measures with their names, Floats or Bools, which are averaged over robots.
    pub information: Vec<(String, String)>,
}

/// An expression or a name that is refused.
#[derive(Clone, Debug)]
pub struct WordingError {
    /// The part of the task: `reward`, `terminated`, or `measure` or `information` with a name.
    pub part: String,
    /// The expression.
    pub text: String,
    /// Its problems, by places in the text; at least one.
    pub problems: Vec<Diagnostic>,
}

impl fmt::Display for WordingError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let message = self.problems.first().map_or("", |first| &first.message);
        write!(f, "{}: {message}", self.part)
    }
}

impl std::error::Error for WordingError {}

/// Quantities that the platform gives, with their types. `previous` and the task's own come behind them.
const GIVEN: [(&str, &str); 9] = [
    ("touched", "Bool"),
    ("touched_robot", "Bool"),
    ("nearest", "Float"),
    ("mean_position", "Point"),
    ("mean_velocity", "Point"),
    ("steps", "Int"),
    ("radius", "Float"),
    ("top_speed", "Float"),
    ("lidar", "List[Float]"),
];

/// The calls of the host that give all robots.
const ALL: [&str; 2] = ["robot.all", "peers"];

/// The calls of the host about one robot; for each the variable that replaces it, its type, and its field of `previous`.
/// Reading a variable takes less time than a call.
const MOTION: [(&str, &str, &str, &str); 3] = [
    ("robot.position", "position_now", "Point", "position"),
    ("robot.heading", "heading_now", "Float", "heading"),
    ("robot.velocity", "velocity_now", "Point", "velocity"),
];

/// The variable whose value before the action is a field of `previous`.
pub fn variable_of(field: &str) -> &str {
    let motion = MOTION.iter().find(|motion| motion.3 == field);
    motion.map_or(field, |motion| motion.1)
}

/// The part of a task that names belong to.
const NAMES: &str = "names";

impl Wording {
    /// The program around the expressions.
    ///
    /// # Errors
    /// If a name cannot be used.
    pub fn program(&self) -> Result<String, WordingError> {
        let mut program = String::from("program Task\n");
        let mut before = Vec::new();
        for (_, variable, ty, field) in MOTION {
            program += &format!("{variable}: {ty}\n");
            before.push(format!("{field}: {ty}"));
        }
        let given = GIVEN.iter().map(|&(name, ty)| (name, ty, true));
        let constants = self.constants.iter();
        let columns = self.columns.iter();
        let own = constants.map(|one| (&*one.name, one.kind.name(), false));
        let own = own.chain(columns.map(|one| (&*one.name, one.kind.name(), true)));
        for (name, ty, changes) in given.chain(own) {
            program += &format!("{name}: {ty}\n");
            if changes && !matches!(name, "lidar" | "radius" | "top_speed") {
                before.push(format!("{name}: {ty}"));
            }
        }
        let before = before.join(", ");
        program += &format!("record Previous {{{before}}}\nprevious: Previous\n");
        let checked = check(&program, &NoLibraries);
        let problems = checked.diagnostics().iter();
        let mut errors = problems.filter(|problem| problem.severity() == Severity::Error);
        match errors.next() {
            None => Ok(program),
            Some(first) => {
                let text = first.span.of(&program);
                let whole = Span::new(0, text.len() as u32);
                let problem = Diagnostic::new(first.code, whole, &*first.message);
                let problem = problem.note(
                    "values, points and measures have names of their own: letters, digits and _",
                );
                Err(WordingError {
                    part: NAMES.into(),
                    text: text.into(),
                    problems: vec![problem],
                })
            }
        }
    }
}

/// An expression that can be evaluated.
#[derive(Debug)]
pub struct Expression {
    /// The part of the task that it is.
    pub part: String,
    pub kind: Kind,
    pub program: Program,
    /// The function from a robot to the value.
    pub function: u32,
    text: String,
}

impl Expression {
    /// Compiles an expression.
    pub fn new(
        program: &str,
        part: String,
        text: &str,
        kind: Kind,
    ) -> Result<Expression, WordingError> {
        let error = |problems: Vec<Diagnostic>| WordingError {
            part: part.clone(),
            text: text.into(),
            problems: problems.into_iter().map(of_a_task).collect(),
        };
        let (mut bytecode, function) =
            with_value(program, text, &kind.ty(), &NoLibraries).map_err(error)?;
        read_motion(&mut bytecode);
        let spans = bytecode.spans.clone();
        let code = bytecode.code.clone();
        let imports = bytecode.imports.clone();
        let resolve = |import: &Import| number_of(&import.name);
        let program = Program::load(bytecode, &resolve).map_err(|problem| {
            let unknown = |instruction: &Instruction| match instruction {
                Instruction::CallHost { import, .. } => imports
                    .get(import.0 as usize)
                    .is_some_and(|import| number_of(&import.name).is_none()),
                _ => false,
            };
            let place = code.iter().position(unknown).unwrap_or(0) as u32;
            let before = spans.partition_point(|(first, _)| *first <= place);
            let span = before.checked_sub(1).and_then(|index| spans.get(index));
            let span = span.map_or(Span::new(0, 0), |(_, span)| Span::new(span.start, span.end));
            error(vec![not_known(&problem, span, text)])
        })?;
        Ok(Expression {
            part,
            kind,
            program,
            function,
            text: text.into(),
        })
    }

    /// The scalars and objects of the state that it reads.
    pub fn reads(&self) -> (Vec<u32>, Vec<u32>) {
        let (mut scalars, mut objects) = (Vec::new(), Vec::new());
        for instruction in self.program.bytecode().reachable(&[self.function]) {
            match instruction {
                Instruction::LoadOther { variable, .. } => scalars.push(variable.0),
                Instruction::LoadOtherPoint { variable, .. } => {
                    scalars.extend(variable.0..variable.0 + 3);
                }
                Instruction::LoadOtherObject { variable, .. } => objects.push(variable.0),
                _ => {}
            }
        }
        (scalars, objects)
    }

    /// The part of the text that an instruction comes from.
    pub fn excerpt(&self, position: u32) -> &str {
        let span = self.program.span(position);
        let excerpt = span.and_then(|span| self.text.get(span.start as usize..span.end as usize));
        excerpt
            .filter(|part| !part.is_empty())
            .unwrap_or(&self.text)
    }
}

/// The problem in the words of tasks: the checker takes the expression for a property.
fn of_a_task(mut problem: Diagnostic) -> Diagnostic {
    if let Some(rest) = problem.message.strip_prefix("a property ") {
        problem.message = format!("a task {rest}");
        problem.notes = vec![known()];
    }
    problem
}

/// The quantities that the platform gives, for messages.
fn known() -> String {
    let known: Vec<&str> = GIVEN.iter().map(|(name, _)| *name).collect();
    format!(
        "a task knows of a robot: position, heading, velocity, id, previous, {}, and its own quantities",
        known.join(", ")
    )
}

/// The problem of an expression that asks for something which environments do not have.
fn not_known(problem: &LoadError, span: Span, text: &str) -> Diagnostic {
    let asked = span.of(text);
    let message = match problem {
        LoadError::UnknownImport(_) => format!("an environment does not know `{asked}`"),
        problem => problem.to_string(),
    };
    Diagnostic::new(Code::InvalidProperty, span, message).note(known())
}

fn number_of(name: &str) -> Option<u32> {
    let of_motion = MOTION.iter().any(|motion| motion.0 == name);
    (of_motion || ALL.contains(&name)).then_some(0)
}

/// Makes the code read the variables of [`MOTION`] instead of asking the host.
fn read_motion(bytecode: &mut Bytecode) {
    let variable = |import: usize| {
        let name = &bytecode.imports.get(import)?.name;
        let motion = MOTION.iter().find(|motion| motion.0 == name)?;
        let places = places(bytecode);
        let place = places.iter().find(|place| place.0 == motion.1)?;
        Some((Slot(place.2), motion.2 == "Point"))
    };
    let variables: Vec<_> = (0..bytecode.imports.len()).map(variable).collect();
    for instruction in &mut bytecode.code {
        // The robot is in the register in which the result begins.
        if let Instruction::CallHost {
            scalars, import, ..
        } = *instruction
            && let Some(&Some((variable, is_point))) = variables.get(import.0 as usize)
        {
            let robot = In(scalars.0);
            *instruction = match is_point {
                true => Instruction::LoadOtherPoint {
                    to: PointOut(scalars.0),
                    robot,
                    variable,
                },
                false => Instruction::LoadOther {
                    to: Out(scalars.0),
                    robot,
                    variable,
                },
            };
        }
    }
}

/// The places of all variables of a program in its state: for each its name, its type, and where its scalars and
/// objects begin.
pub fn places(bytecode: &Bytecode) -> Vec<(&str, &Type, u32, u32)> {
    let (mut scalar, mut object) = (0, 0);
    let variables = bytecode.variables.iter();
    let places = variables.map(|variable| {
        let layout = starl_lang::machine::Layout::of([&variable.kind]);
        let place = (&*variable.name, &variable.kind, scalar, object);
        scalar += layout.scalars.len() as u32;
        object += layout.objects.len() as u32;
        place
    });
    places.collect()
}
