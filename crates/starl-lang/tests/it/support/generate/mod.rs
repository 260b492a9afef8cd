//! Random well-typed programs, as text: the checker must accept every one of them.
//!
//! The program depends on bytes alone, so that a property test or a fuzzer may choose them. It may contain all types,
//! declarations, statements, operators, methods and built-in functions that a program on a robot can use.

mod behaviour;
mod choices;
mod collection;
mod declaration;
mod expression;
pub mod layout;
mod library;
mod literal;
mod model;
mod names;
mod operation;
mod statement;
mod types;

pub use choices::Choices;
use model::{Local, Model, Place, Type};

/// The program generated from these bytes.
pub fn program(bytes: &[u8]) -> String {
    generate(bytes, false)
}

/// The same with parentheses around every operation.
pub fn program_with_parentheses(bytes: &[u8]) -> String {
    generate(bytes, true)
}

fn generate(bytes: &[u8], all_parentheses: bool) -> String {
    let mut generator = Generator {
        choices: Choices::new(bytes),
        model: Model::new(),
        locals: Vec::new(),
        place: Place::Constant,
        result: None,
        all_parentheses,
        has_atomic: false,
        is_action: false,
        text: String::new(),
        level: 0,
        budget: 500,
    };
    generator.file();
    generator.text
}

struct Generator<'a> {
    choices: Choices<'a>,
    model: Model,
    /// The locals that can be seen.
    locals: Vec<Local>,
    place: Place,
    /// The result type of the function whose body is being generated.
    result: Option<Type>,
    all_parentheses: bool,
    /// Whether there may be `atomic`.
    has_atomic: bool,
    /// Whether the effect of an action is made.
    is_action: bool,
    text: String,
    /// How deep the block is that is made.
    level: usize,
    /// How many more parts of expressions may be made.
    budget: u32,
}

impl Generator<'_> {
    fn file(&mut self) {
        self.line("program Generated");
        self.has_atomic = self.choices.below(16) == 7;
        self.imports();
        self.enums();
        self.records();
        self.constants("plain");
        self.functions();
        self.constants("made");
        self.parameters();
        self.declare_roles();
        self.bindings();
        self.variables();
        self.shared();
        if self.choices.below(2) == 1 {
            self.init();
        }
        self.actions("act");
        self.handlers();
        self.roles();
        self.properties();
    }

    fn line(&mut self, text: &str) {
        self.text += &"    ".repeat(self.level);
        self.text += text;
        self.text.push('\n');
    }

    /// A local, or the parts of a tuple as locals.
    fn pattern(&mut self, ty: Type, is_writable: bool) -> String {
        let parts = match ty {
            Type::Tuple(parts) if self.choices.below(2) == 1 => parts,
            ty => return self.add_local(ty, is_writable),
        };
        let mut names = Vec::new();
        for part in parts {
            names.push(match self.choices.below(8) {
                7 => "_".into(),
                _ => self.add_local(part, is_writable),
            });
        }
        format!("({})", names.join(", "))
    }

    /// A local with a name that no other has which can be seen.
    fn add_local(&mut self, ty: Type, is_writable: bool) -> String {
        let name = format!("x{}", self.locals.len());
        self.locals.push(Local {
            name: name.clone(),
            ty,
            is_writable,
        });
        name
    }
}
