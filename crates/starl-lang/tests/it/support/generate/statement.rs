//! Statements of functions, effects and handlers.

use super::Generator;
use super::expression::{Context, power};
use super::model::{Place, Type};

impl Generator<'_> {
    /// A block of statements, deeper than what stands around it, with locals of its own.
    pub(super) fn block(&mut self, depth: u32) {
        let mark = self.locals.len();
        self.level += 1;
        self.statements(depth);
        self.level -= 1;
        self.locals.truncate(mark);
    }

    /// Statements; their locals stay.
    pub(super) fn statements(&mut self, depth: u32) {
        for _ in 0..=self.choices.below(4) {
            self.statement(depth);
        }
    }

    fn statement(&mut self, depth: u32) {
        if depth == 0 || self.budget == 0 {
            let line = self.simple();
            return self.line(&line);
        }
        match self.choices.below(12) {
            0..=3 => {
                let line = self.simple();
                self.line(&line);
            }
            4 => self.local(),
            5 | 6 => self.branches(depth),
            7 | 8 => {
                let mark = self.locals.len();
                let iteration = self.iteration(2);
                self.line(&iteration);
                self.block(depth - 1);
                self.locals.truncate(mark);
            }
            9 => self.inline_if(),
            10 => {
                let (first, second) = (self.simple(), self.simple());
                self.line(&format!("{first}; {second}"));
            }
            _ if self.is_action && self.has_atomic => {
                self.line("atomic");
                self.level += 1;
                self.line("counted += 1");
                self.level -= 1;
                self.block(depth - 1);
            }
            _ => self.local(),
        }
    }

    /// `let x = value`.
    fn local(&mut self) {
        let ty = self.made_type(2);
        let line = if self.choices.below(2) == 0 {
            let value = self.expression(&ty, Context::Unknown, 3).text;
            format!("let {} = {value}", self.pattern(ty, true))
        } else {
            let value = self.expression(&ty, Context::Fit, 3).text;
            let written = self.model.written(&ty);
            format!("let {}: {written} = {value}", self.pattern(ty, true))
        };
        self.line(&line);
    }

    /// `if`, perhaps with `elif` and `else`.
    fn branches(&mut self, depth: u32) {
        for number in 0..=self.choices.below(2) {
            let mark = self.locals.len();
            let condition = self.condition(2);
            self.line(&format!(
                "{} {condition}",
                if number == 0 { "if" } else { "elif" }
            ));
            self.block(depth - 1);
            self.locals.truncate(mark);
        }
        if self.choices.below(2) == 1 {
            self.line("else");
            self.block(depth - 1);
        }
    }

    /// `if c then statement else statement`.
    fn inline_if(&mut self) {
        let mark = self.locals.len();
        let condition = self.condition(2);
        let then = match self.choices.below(5) {
            4 => self.return_statement(),
            _ => self.simple(),
        };
        self.locals.truncate(mark);
        let line = match self.choices.below(2) {
            0 => format!("if {condition} then {then}"),
            _ => format!("if {condition} then {then} else {}", self.simple()),
        };
        self.line(&line);
    }

    pub(super) fn return_statement(&mut self) -> String {
        match self.result.clone() {
            Some(result) => {
                format!("return {}", self.expression(&result, Context::Fit, 3).text)
            }
            None => "return".into(),
        }
    }

    /// A statement in a part of a line.
    fn simple(&mut self) -> String {
        let is_effect = self.place == Place::Effect;
        let made = match self.choices.below(8) {
            0..=2 => self.assignment(),
            3 | 4 => self.update(),
            5 => match self.choices.below(4) {
                0 => self.count(),
                _ => self.change(),
            },
            _ if is_effect => Some(self.effect()),
            _ => self.assignment(),
        };
        match made {
            Some(line) => line,
            None if is_effect => self.effect(),
            // The only statement of a function without variables.
            None => self.return_statement(),
        }
    }

    /// The writable variables, and whether each can be read and changed in parts.
    fn writable(&self) -> Vec<(String, Type, bool)> {
        let mut found = Vec::new();
        for local in self.locals.iter().filter(|local| local.is_writable) {
            found.push((local.name.clone(), local.ty.clone(), true));
        }
        if self.place == Place::Effect {
            for variable in &self.model.variables {
                found.push((variable.name.clone(), variable.ty.clone(), true));
            }
            for shared in &self.model.shared {
                let own = if shared.is_single_writer { "[me]" } else { "" };
                let name = format!("{}{own}", shared.name);
                found.push((name, shared.ty.clone(), shared.has_initial));
            }
        }
        found
    }

    /// The way into a value, as far as one goes.
    fn path(&mut self, mut text: String, mut ty: Type) -> (String, Type) {
        for _ in 0..3 {
            if self.choices.below(2) == 0 {
                break;
            }
            (text, ty) = match ty {
                Type::Record(number) if !self.model.records[number].fields.is_empty() => {
                    let fields = &self.model.records[number].fields;
                    let field = &fields[self.choices.below(fields.len())];
                    (format!("{text}.{}", field.name), field.ty.clone())
                }
                Type::Point => {
                    let axis = ["x", "y", "z"][self.choices.below(3)];
                    (format!("{text}.{axis}"), Type::Float)
                }
                Type::List(element) => {
                    let index = match self.choices.below(4) {
                        3 => self.expression(&Type::Int, Context::Fit, 2).text,
                        _ => "0".into(),
                    };
                    (format!("{text}[{index}]"), *element)
                }
                Type::Map(key, value) if self.can_make(&key) => {
                    let key = self.expression(&key, Context::Fit, 1).text;
                    (format!("{text}[{key}]"), *value)
                }
                ty => (text, ty),
            };
        }
        (text, ty)
    }

    /// A place to write to, of those whose type is wanted.
    fn place(&mut self, wanted: fn(&Type) -> bool, is_changed: bool) -> Option<(String, Type)> {
        let mut roots = self.writable();
        roots.retain(|(_, _, has_parts)| *has_parts || !is_changed);
        for _ in 0..3 {
            if roots.is_empty() {
                return None;
            }
            let root = roots.swap_remove(self.choices.below(roots.len().min(256)));
            let (text, ty, has_parts) = root;
            let found = if has_parts {
                self.path(text, ty)
            } else {
                (text, ty)
            };
            if wanted(&found.1) && self.can_make(&found.1) {
                return Some(found);
            }
        }
        None
    }

    /// `place = value`.
    fn assignment(&mut self) -> Option<String> {
        let (place, ty) = self.place(|_| true, false)?;
        let value = self.expression(&ty, Context::Fit, 3).text;
        Some(format!("{place} = {value}"))
    }

    /// `place += value` and the like.
    fn update(&mut self) -> Option<String> {
        use Type::{Duration, Float, Int, List, Point, String, Time};
        let can_change =
            |ty: &Type| matches!(ty, Int | Float | Duration | Time | Point | String | List(_));
        let (place, ty) = self.place(can_change, true)?;
        let (sign, value) = match (&ty, self.choices.below(3)) {
            (String | List(_), _) => ("+=", ty.clone()),
            (Time, sign) => (["+=", "-="][sign % 2], Duration),
            (_, 0) => ("+=", ty.clone()),
            (_, 1) => ("-=", ty.clone()),
            (Int, _) => ("*=", Int),
            (Duration, _) => ("*=", [Int, Float][self.choices.below(2)].clone()),
            _ => ("*=", Float),
        };
        let known = if value == ty {
            Context::Known
        } else {
            Context::Unknown
        };
        let value = self.expression(&value, known, 2).text;
        Some(format!("{place} {sign} {value}"))
    }

    /// `m[k] = (m.get(k) ?? 0) + value`.
    fn count(&mut self) -> Option<String> {
        let counts = |ty: &Type| matches!(ty, Type::Map(_, value) if matches!(**value, Type::Int | Type::Float));
        let (place, ty) = self.place(counts, true)?;
        let Type::Map(key, value) = ty else {
            return None;
        };
        if !self.can_make(&key) {
            return None;
        }
        let key = self.expression(&key, Context::Fit, 0).text;
        let default = match *value {
            Type::Int => ["0", "0", "1"],
            _ => ["0.0", "-0.0", "1.0"],
        };
        let default = default[self.choices.below(3)];
        let value = self.expression(&value, Context::Known, 1).text;
        Some(format!(
            "{place}[{key}] = ({place}.get({key}) ?? {default}) + ({value})"
        ))
    }

    /// `place.add(value)` and the like.
    fn change(&mut self) -> Option<String> {
        let (place, ty) = self.place(
            |ty| matches!(ty, Type::List(_) | Type::Set(_) | Type::Map(..)),
            true,
        )?;
        let kind = self.choices.below(6);
        let call = match (&ty, kind) {
            // A function sees no robots, so it cannot make what some of its tuples hold.
            (Type::List(part) | Type::Set(part) | Type::Map(part, _), _)
                if !self.can_make(part) =>
            {
                return None;
            }
            (Type::List(element), 0..=2) => self.applied("add", &[element], 2).text,
            (Type::List(element), 3) => {
                let element = self.expression(element, Context::Fit, 2).text;
                format!("insert(0, {element})")
            }
            (Type::List(_), 4) => "remove_at(0)".into(),
            (Type::List(element), _) => self.applied("remove", &[element], 2).text,
            (Type::Set(element), 0..=3) => self.applied("add", &[element], 2).text,
            (Type::Set(key) | Type::Map(key, _), _) => self.applied("remove", &[key], 2).text,
            _ => return None,
        };
        Some(format!("{place}.{call}"))
    }

    /// A call that does something.
    fn effect(&mut self) -> String {
        use Type::{Float, Point, String};
        match self.choices.below(12) {
            0..=2 => self.told(),
            3 => self.applied("draw_point", &[&String, &Point], 2).text,
            4 => {
                self.applied("draw_line", &[&String, &Type::list(Point)], 2)
                    .text
            }
            5 => {
                self.applied("draw_circle", &[&String, &Point, &Float], 2)
                    .text
            }
            6 => match self.choices.below(3) {
                0 => "stop()".into(),
                1 => self.applied("draw_text", &[&String, &Point], 2).text,
                _ => self.applied("draw_nothing", &[&String], 2).text,
            },
            7 if self.choices.below(8) == 7 => "finish()".into(),
            8 if self.choices.below(8) == 7 => self.applied("fail", &[&String], 1).text,
            9 if self.model.roles.is_some() => {
                let roles = Type::Enum(self.model.roles.unwrap_or(0));
                format!("role = {}", self.expression(&roles, Context::Fit, 1).text)
            }
            10 | 11 if !self.model.bindings.is_empty() => self.primitive(),
            _ => self.told(),
        }
    }

    /// `emit` or `log`.
    fn told(&mut self) -> String {
        let count = self.choices.below(3);
        let values: Vec<std::string::String> = (0..count)
            .map(|_| {
                let ty = self.made_type(2);
                self.expression(&ty, Context::Unknown, 2).text
            })
            .collect();
        let rest = |form: &dyn Fn(usize, &str) -> std::string::String| {
            let parts = values.iter().enumerate();
            parts
                .map(|(number, value)| form(number, value))
                .collect::<std::string::String>()
        };
        if self.choices.below(2) == 0 {
            let fields = rest(&|number, value| format!(", field{number} = {value}"));
            format!("emit(\"told\"{fields})")
        } else {
            let values = rest(&|_, value| format!(", {value}"));
            format!("log(\"{}\"{values})", " {}".repeat(count).trim_start())
        }
    }

    fn primitive(&mut self) -> String {
        let bindings = &self.model.bindings;
        let binding = &bindings[self.choices.below(bindings.len())];
        let (name, kind) = (binding.name.clone(), binding.kind);
        let call = match kind {
            "ReachAvoid" if self.choices.below(4) == 3 => "stop()".into(),
            "ReachAvoid" => {
                self.applied("reach_avoid", &[&Type::Point, &Type::Obstacles], 2)
                    .text
            }
            _ => {
                let records = self.model.records.iter().enumerate();
                let messages: Vec<usize> = records
                    .filter(|(_, record)| record.is_message)
                    .map(|(number, _)| number)
                    .collect();
                if messages.is_empty() {
                    return self.told();
                }
                let number = messages[self.choices.below(messages.len())];
                let message = self.record(number, 2).text;
                match kind {
                    "Broadcast" => format!("broadcast({message})"),
                    "Unicast" => {
                        let to = self.expression(&Type::Robot, Context::Fit, 1).text;
                        format!("send({to}, {message})")
                    }
                    _ => {
                        let area = self.expression(&Type::Area, Context::Fit, 2).text;
                        format!("geocast({message}, {area})")
                    }
                }
            }
        };
        format!("{name}.{call}")
    }

    /// A condition as the guard of an action, which has its line.
    pub(super) fn guard(&mut self) -> String {
        format!("pre {}", self.condition(3))
    }

    /// An expression that may stand before `within` and `leads_to`.
    pub(super) fn claim(&mut self) -> String {
        self.expression(&Type::Bool, Context::Known, 4)
            .at(power::OPEN)
    }
}
