//! Random programs that are well written, though most would mean nothing, in random layout.

use starl_core::Random;

/// A random program; equal seeds give equal programs.
pub fn program(seed: u64) -> String {
    let mut generator = Generator {
        random: Random::keyed(seed, &[1]),
        text: String::new(),
        indentation: vec![0],
        budget: 400,
    };
    generator.file();
    generator.text
}

struct Generator {
    random: Random,
    text: String,
    /// The indentation of each block that is open.
    indentation: Vec<usize>,
    /// How many more parts may be made.
    budget: u32,
}

const NAMES: &[&str] = &[
    "a",
    "loc",
    "currentIndex",
    "init",
    "wait",
    "role",
    "within",
    "by",
    "x_1",
    "motion",
    "program",
    "_y",
    "m",
];
const TYPES: &[&str] = &[
    "Int",
    "Float",
    "Point",
    "RobotId",
    "Location",
    "geometry.Line",
    "Duration",
];
const LITERALS: &[&str] = &[
    "0",
    "1_000",
    "1.5",
    "1e-3",
    "500ms",
    "2s",
    "75mm",
    "90deg",
    "1.5rad",
    "true",
    "false",
    "none",
    "\"a // b\"",
    "\"\\n\\\"\\u{e9}\"",
    "\"\"",
];
const BINARY: &[&str] = &["+", "-", "*", "/", "%", "and", "or", "??"];
const COMPARE: &[&str] = &["==", "!=", "<", "<=", ">", ">=", "in", "not in"];

impl Generator {
    fn pick<'a>(&mut self, choices: &[&'a str]) -> &'a str {
        choices[self.random.below(choices.len() as u32) as usize]
    }

    fn name(&mut self) -> String {
        self.pick(NAMES).into()
    }

    /// Some white space that means nothing.
    fn space(&mut self) -> &'static str {
        ["", " ", "  "][self.random.below(3) as usize]
    }

    /// Some white space that parts two words.
    fn gap(&mut self) -> &'static str {
        [" ", "  "][self.random.below(2) as usize]
    }

    /// A line in the block that is open, perhaps with empty lines and comments around it.
    fn line(&mut self, text: &str) {
        let indentation = *self.indentation.last().unwrap_or(&0);
        if self.random.chance(0.1) {
            let count = self.random.below(3) as usize + 1;
            self.text += &"\n".repeat(count);
        }
        if self.random.chance(0.1) {
            let column = self.random.below(9) as usize;
            self.text += &format!("{}// a comment, {column}\n", " ".repeat(column));
        }
        self.text += &" ".repeat(indentation);
        self.text += text;
        if self.random.chance(0.1) {
            let space = self.space();
            self.text += space;
            self.text += "// behind";
        }
        self.text += if self.random.chance(0.02) {
            "\r\n"
        } else {
            "\n"
        };
    }

    /// The output of `inside`, indented one level deeper.
    fn block(&mut self, inside: impl FnOnce(&mut Self)) {
        let deeper = self.indentation.last().unwrap_or(&0) + 1 + self.random.below(5) as usize;
        self.indentation.push(deeper);
        inside(self);
        self.indentation.pop();
    }

    fn file(&mut self) {
        let header = self.pick(&["program  Name", "library Name"]);
        self.line(header);
        for _ in 0..=self.random.below(12) {
            if self.random.chance(0.2) {
                self.line("/// documents");
            }
            self.item();
        }
    }

    fn item(&mut self) {
        let (name, ty) = (self.name(), self.ty());
        match self.random.below(14) {
            0 => self.line(&format!("import {name}")),
            1 => self.line(&format!("enum {name}{{a ,b,  c}}")),
            2 => self.line(&format!("record {name} {{ x: {ty}, y:Int }}")),
            3 => self.line(&format!("message {name} ( x: {ty} )")),
            4 => {
                let value = self.expression(2);
                self.line(&format!("param {name}: {ty} = {value}"));
            }
            5 => {
                let value = self.expression(2);
                self.line(&format!("const {name}={value}"));
            }
            6 => self.line(&format!("allread {name} [RobotId]:{ty}")),
            7 => {
                let value = self.expression(1);
                self.line(&format!("allwrite {name}: {ty} = {value}"));
            }
            8 => self.line(&format!("thing=Primitive ( {name} = 1 , 2 )")),
            9 => self.function(&name, &ty),
            10 => self.property(&name),
            11 => {
                self.line(&format!("role {name}"));
                self.block(|generator| {
                    generator.action();
                    generator.handler();
                });
            }
            12 => self.handler(),
            _ => self.action(),
        }
    }

    fn function(&mut self, name: &str, ty: &str) {
        if self.random.chance(0.5) {
            let value = self.expression(3);
            return self.line(&format!("function {name}(a: {ty}, b:Int)->{ty} = {value}"));
        }
        self.line(&format!("function {name}( ) -> {ty}"));
        self.block(Self::statements);
    }

    fn property(&mut self, name: &str) {
        let (condition, other) = (self.expression(3), self.expression(2));
        let line = match self.random.below(4) {
            0 => format!("invariant {name}: {condition}"),
            1 => format!("always: forall r, s: {condition}"),
            2 => format!("eventually {name}: exists r : {condition} within 5s"),
            _ => format!("always {name}:\n   {condition}\n   leads_to {other}\n   within 5s"),
        };
        self.line(&line);
    }

    fn action(&mut self) {
        let name = self.name();
        self.line(&format!("{name}( )"));
        self.block(|generator| {
            let deeper = " ".repeat(generator.indentation.last().unwrap_or(&0) + 2);
            match generator.random.below(3) {
                0 => {
                    let (a, b) = (generator.comparison(1), generator.comparison(1));
                    generator.line(&format!("pre {a} and\n{deeper}some q = f(1) and {b}"));
                }
                1 => {
                    let condition = generator.expression(3);
                    generator.line(&format!("pre {condition}"));
                }
                _ => {}
            }
            if generator.random.chance(0.5) {
                let (a, b) = (generator.simple(), generator.simple());
                generator.line(&format!("eff {a};{b}"));
                if generator.random.chance(0.3) {
                    generator.block(Self::statements);
                }
            } else {
                generator.line("eff");
                generator.block(Self::statements);
            }
        });
    }

    fn handler(&mut self) {
        let event = self.pick(&["Reached(from, index)", "radio.failed ( _ )", "M()"]);
        self.line(&format!("on {event}"));
        self.block(Self::statements);
    }

    fn statements(&mut self) {
        for _ in 0..=self.random.below(3) {
            self.statement();
        }
    }

    fn statement(&mut self) {
        self.budget = self.budget.saturating_sub(1);
        let kind = if self.budget == 0 || self.indentation.len() > 5 {
            9
        } else {
            self.random.below(10)
        };
        match kind {
            0 => {
                let condition = self.expression(2);
                self.line(&format!("if {condition}"));
                self.block(Self::statements);
                if self.random.chance(0.3) {
                    let condition = self.comparison(1);
                    self.line(&format!("elif {condition}"));
                    self.block(Self::statements);
                }
                if self.random.chance(0.4) {
                    self.line("else");
                    self.block(Self::statements);
                }
            }
            1 => {
                let (condition, a, b) = (self.expression(2), self.simple(), self.simple());
                self.line(&format!("if {condition} then {a} else {b}"));
            }
            2 => {
                let (name, collection) = (self.name(), self.expression(2));
                self.line(&format!("for {name} in {collection}"));
                self.block(Self::statements);
            }
            3 => {
                self.line("for k,v in 0 .. 5");
                self.block(Self::statements);
            }
            4 => {
                self.line("atomic");
                self.block(Self::statements);
            }
            5 => {
                let value = self.expression(3);
                self.line(&format!("return {value}"));
            }
            6 => {
                let (a, b) = (self.simple(), self.simple());
                self.line(&format!("{a} ;  {b};"));
            }
            _ => {
                let line = self.simple();
                self.line(&line);
            }
        }
    }

    /// A statement on a line.
    fn simple(&mut self) -> String {
        let (name, value) = (self.name(), self.expression(3));
        match self.random.below(5) {
            0 => format!("let {name}{}={}{value}", self.space(), self.space()),
            1 => format!("let {name}: Int = {value}"),
            2 => format!("{name}[{value}].x = {value}"),
            3 => format!("motion.f{}({value}, name = {value})", self.space()),
            _ => {
                let operator = self.pick(&["=", "+=", "-=", "*="]);
                format!("{name} {operator} {value}")
            }
        }
    }

    fn ty(&mut self) -> String {
        let ty = self.pick(TYPES);
        match self.random.below(6) {
            0 => format!("List [{ty}]"),
            1 => format!("Map[String,{ty} ]"),
            2 => format!("{ty} ?"),
            3 => "enum{a,b}".into(),
            _ => ty.into(),
        }
    }

    fn comparison(&mut self, depth: u32) -> String {
        let (a, operator, b) = (self.operand(depth), self.pick(COMPARE), self.operand(depth));
        format!("{a}{}{operator}{}{b}", self.gap(), self.gap())
    }

    fn expression(&mut self, depth: u32) -> String {
        match self.random.below(6) {
            0 if depth > 0 => self.comparison(depth - 1),
            1 if depth > 0 => {
                let (a, operator, b) = (
                    self.operand(depth - 1),
                    self.pick(BINARY),
                    self.operand(depth - 1),
                );
                format!("{a}{}{operator}{}{b}", self.gap(), self.gap())
            }
            2 if depth > 0 => {
                let (c, a, b) = (
                    self.operand(depth - 1),
                    self.operand(depth - 1),
                    self.operand(depth - 1),
                );
                format!("if {c} then {a} else {b}")
            }
            3 if depth > 0 => format!("not {}", self.operand(depth - 1)),
            _ => self.operand(depth),
        }
    }

    /// Something that may stand beside any operator.
    fn operand(&mut self, depth: u32) -> String {
        let kind = if depth == 0 {
            self.random.below(2)
        } else {
            self.random.below(12)
        };
        if kind < 2 {
            return if kind == 0 {
                self.pick(LITERALS).into()
            } else {
                self.name()
            };
        }
        let a = self.expression(depth - 1);
        let b = self.expression(depth - 1);
        match kind {
            2 => format!("({}{a}{})", self.space(), self.space()),
            3 => format!("f({a}, x = {b})"),
            4 => format!("a . field[{a}]"),
            5 => format!("[{a},{b}]"),
            6 => format!("[f(x) for x in xs if {a} by {a}]"),
            7 => format!("{{{a} : {b}}}"),
            8 => format!("{{{a},\n{b},\n}}"),
            9 => {
                let (a, b) = (self.operand(depth - 1), self.operand(depth - 1));
                format!("(\n  {a}\n // inside\n   + {b})")
            }
            10 => format!("-{}g({a}).y", self.space()),
            _ => self.pick(&["{:}", "{}", "[]", "pos[r]!", "x ! .y"]).into(),
        }
    }
}
