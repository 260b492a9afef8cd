//! Expressions of a given type.

use super::Generator;
use super::model::{Function, Type};

/// How tightly operators bind; what binds tighter than its surroundings needs no parentheses.
pub mod power {
    /// `if c then a else b`, quantifiers.
    pub const OPEN: u8 = 0;
    pub const OR: u8 = 1;
    pub const AND: u8 = 2;
    pub const NOT: u8 = 3;
    pub const COMPARISON: u8 = 4;
    pub const RANGE: u8 = 5;
    pub const DEFAULT: u8 = 6;
    pub const SUM: u8 = 7;
    pub const PRODUCT: u8 = 8;
    pub const SIGN: u8 = 9;
    pub const ATOM: u8 = 10;
}

/// The type information available where an expression is generated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Context {
    /// Nothing, or what does not apply: the expression must say its type itself.
    Unknown,
    /// The type; the expression must have it.
    Known,
    /// The type; where it is optional a value will do.
    Fit,
}

impl Context {
    /// Of an operand with the type of the whole.
    pub fn exact(self) -> Context {
        match self {
            Context::Unknown => Context::Unknown,
            _ => Context::Known,
        }
    }

    /// Of an element of a collection that is written out.
    pub fn part(self) -> Context {
        match self {
            Context::Unknown => Context::Unknown,
            _ => Context::Fit,
        }
    }
}

/// An expression as it is written.
pub struct Text {
    pub text: String,
    pub power: u8,
}

impl Text {
    /// One that nothing tears apart.
    pub fn atom(text: impl Into<String>) -> Text {
        Text {
            text: text.into(),
            power: power::ATOM,
        }
    }

    /// In parentheses if it binds less tightly than this.
    pub fn at(self, least: u8) -> String {
        if self.power >= least {
            self.text
        } else {
            format!("({})", self.text)
        }
    }
}

impl Generator<'_> {
    /// An expression with an operator of this power.
    pub(super) fn made(&self, text: String, power: u8) -> Text {
        let text = Text { text, power };
        if self.all_parentheses && power > power::OPEN {
            return Text::atom(text.at(power::ATOM));
        }
        text
    }

    /// An expression of the type.
    pub(super) fn expression(&mut self, ty: &Type, context: Context, depth: u32) -> Text {
        let is_built = self.can_write(ty) || *ty == Type::Time;
        if depth == 0 || self.budget == 0 || !is_built {
            return self.leaf(ty, context);
        }
        self.budget -= 1;
        match self.choices.below(14) {
            0..=2 => self.leaf(ty, context),
            3 => self.conditional(ty, context, depth - 1),
            4 => self.default(ty, context, depth - 1),
            5 => self.unwrap(ty, context, depth - 1),
            6 => self.part(ty, context, depth - 1),
            7 => self.call(ty, context, depth - 1),
            8 if *ty == Type::Bool => self.closed_condition(depth - 1),
            _ => self.operation(ty, context, depth - 1),
        }
    }

    fn conditional(&mut self, ty: &Type, context: Context, depth: u32) -> Text {
        let mark = self.locals.len();
        let condition = self.condition(depth);
        let then = self.expression(ty, context, depth).at(power::OR);
        self.locals.truncate(mark);
        let otherwise = self.expression(ty, context, depth).text;
        let text = format!("if {condition} then {then} else {otherwise}");
        self.made(text, power::OPEN)
    }

    /// A condition, perhaps one that binds locals, which stay.
    pub(super) fn condition(&mut self, depth: u32) -> String {
        let count = [1, 1, 1, 2, 3][self.choices.below(5)];
        let mut parts = Vec::new();
        for _ in 0..count {
            let binds = self.choices.below(4) == 3;
            parts.push(if binds {
                self.some(depth)
            } else {
                let least = if count == 1 { power::OR } else { power::NOT };
                self.expression(&Type::Bool, Context::Known, depth)
                    .at(least)
            });
        }
        parts.join(" and ")
    }

    /// A condition or a quantifier over a collection, whose locals are known in it alone.
    fn closed_condition(&mut self, depth: u32) -> Text {
        let mark = self.locals.len();
        let text = match self.choices.below(3) {
            0 => format!("(not ({}))", self.condition(depth)),
            kind => {
                let word = ["forall", "exists"][kind - 1];
                let iteration = self.iteration(depth);
                let condition = self.condition(depth);
                format!("({word}{}: {condition})", &iteration["for".len()..])
            }
        };
        self.locals.truncate(mark);
        Text::atom(text)
    }

    /// `some x = optional`; the local stays.
    fn some(&mut self, depth: u32) -> String {
        let inner = self.plain_type();
        let optional = Type::optional(inner.clone());
        let value = self.expression(&optional, Context::Unknown, depth);
        let value = value.at(power::RANGE);
        let name = self.pattern(inner, false);
        format!("some {name} = {value}")
    }

    /// A type that is not optional, of which a value can be made.
    pub(super) fn plain_type(&mut self) -> Type {
        match self.made_type(1) {
            Type::Optional(inner) => *inner,
            ty => ty,
        }
    }

    fn default(&mut self, ty: &Type, context: Context, depth: u32) -> Text {
        let optional = Type::optional(ty.clone());
        let left = self.expression(&optional, context.exact(), depth);
        let right = match ty {
            Type::Optional(_) if self.choices.below(4) == 3 => Text::atom("none"),
            Type::Optional(_) => self.expression(ty, Context::Unknown, depth),
            _ => self.expression(ty, Context::Known, depth),
        };
        let text = format!("{} ?? {}", left.at(power::SUM), right.at(power::DEFAULT));
        self.made(text, power::DEFAULT)
    }

    fn unwrap(&mut self, ty: &Type, context: Context, depth: u32) -> Text {
        if matches!(ty, Type::Optional(_)) || self.choices.below(3) < 2 {
            return self.leaf(ty, context);
        }
        let optional = Type::optional(ty.clone());
        let value = self.expression(&optional, context.exact(), depth);
        Text::atom(format!("{}!", value.at(power::ATOM)))
    }

    /// A part of something that can be read.
    fn part(&mut self, ty: &Type, context: Context, depth: u32) -> Text {
        let mut found: Vec<(String, Option<Type>)> = Vec::new();
        for (name, whole) in self.all_readable() {
            match whole {
                Type::Record(number) => {
                    let fields = self.model.records[number].fields.iter();
                    let fields = fields.filter(|field| field.ty == *ty);
                    found.extend(fields.map(|field| (format!("{name}.{}", field.name), None)));
                }
                Type::Tuple(parts) => {
                    let parts = parts.iter().enumerate().filter(|(_, part)| *part == ty);
                    found.extend(parts.map(|(number, _)| (format!("{name}.{number}"), None)));
                }
                Type::Point if *ty == Type::Float => {
                    found.extend(["x", "y", "z"].map(|axis| (format!("{name}.{axis}"), None)));
                }
                Type::List(element) if *element == *ty => found.push((name, Some(Type::Int))),
                Type::Map(key, value) => {
                    // An element of a single-writer variable may be none.
                    let is_shared = self.is_single_writer(&name);
                    let part = if is_shared {
                        Type::optional(*value)
                    } else {
                        *value
                    };
                    if part == *ty && self.can_make(&key) {
                        found.push((name, Some(*key)));
                    }
                }
                _ => {}
            }
        }
        if found.is_empty() {
            return self.leaf(ty, context);
        }
        let (text, key) = found.swap_remove(self.choices.below(found.len().min(256)));
        match key {
            None => Text::atom(text),
            Some(Type::Int) if self.choices.below(4) > 0 => Text::atom(format!("{text}[0]")),
            Some(key) => {
                let key = self.expression(&key, Context::Fit, depth);
                Text::atom(format!("{text}[{}]", key.text))
            }
        }
    }

    fn is_single_writer(&self, name: &str) -> bool {
        let mut shared = self.model.shared.iter();
        shared.any(|shared| shared.is_single_writer && name.ends_with(&shared.name))
    }

    /// A call of a function that the program declares.
    fn call(&mut self, ty: &Type, context: Context, depth: u32) -> Text {
        let functions = self.model.functions.iter();
        let fitting: Vec<Function> = functions
            .filter(|function| function.result == *ty)
            .filter(|function| function.parameters.iter().all(|one| self.can_make(&one.ty)))
            .cloned()
            .collect();
        if fitting.is_empty() {
            return self.leaf(ty, context);
        }
        let function = &fitting[self.choices.below(fitting.len())];
        self.call_of(function, depth)
    }

    fn call_of(&mut self, function: &Function, depth: u32) -> Text {
        let mut arguments = Vec::new();
        for (number, parameter) in function.parameters.iter().enumerate() {
            arguments.push(if number == 0 && function.is_recursive {
                self.one_of(&["0", "1", "2", "3", "4", "5", "6"]).text
            } else {
                self.expression(&parameter.ty, Context::Fit, depth).text
            });
        }
        if self.choices.below(3) == 2 {
            // By names, in the reverse order.
            let named = function.parameters.iter().zip(&arguments).rev();
            let named = named.map(|(parameter, value)| format!("{} = {value}", parameter.name));
            arguments = named.collect();
        }
        Text::atom(format!("{}({})", function.name, arguments.join(", ")))
    }

    /// Two operands with an operator between them.
    pub(super) fn joined(&mut self, left: Text, sign: &str, right: Text, power: u8) -> Text {
        // Those of one power are taken from left to right; comparisons are not compared again.
        let left_power = if power == power::COMPARISON {
            power + 1
        } else {
            power
        };
        let text = format!("{} {sign} {}", left.at(left_power), right.at(power + 1));
        self.made(text, power)
    }

    /// The same, of two operands that are made here; `context` is that of the left one.
    pub(super) fn binary(
        &mut self,
        sign: &str,
        power: u8,
        types: [&Type; 2],
        context: Context,
        depth: u32,
    ) -> Text {
        let left = self.expression(types[0], context.exact(), depth);
        let known = if types[0] == types[1] {
            Context::Known
        } else {
            Context::Unknown
        };
        let right = self.expression(types[1], known, depth);
        self.joined(left, sign, right, power)
    }

    /// `name(a, b)` with arguments of these types.
    pub(super) fn applied(&mut self, name: &str, types: &[&Type], depth: u32) -> Text {
        let arguments: Vec<String> = (types.iter())
            .map(|ty| self.expression(ty, Context::Fit, depth).text)
            .collect();
        Text::atom(format!("{name}({})", arguments.join(", ")))
    }

    /// `receiver.name(a, b)`.
    pub(super) fn method(
        &mut self,
        receiver: &Type,
        name: &str,
        types: &[&Type],
        depth: u32,
    ) -> Text {
        let receiver = self.expression(receiver, Context::Unknown, depth);
        let receiver = receiver.at(power::ATOM);
        let call = self.applied(name, types, depth);
        Text::atom(format!("{receiver}.{}", call.text))
    }
}
