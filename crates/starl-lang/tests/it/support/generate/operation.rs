//! Operators, built-in functions and methods, by the type that they give.

use super::Generator;
use super::expression::{Context, Text, power};
use super::model::{Place, Type};

use Type::{Bool, Duration, Float, Int, Point, Robot, String as Str, Time};
use power::{PRODUCT, SUM};

impl Generator<'_> {
    /// An operator or a call that gives the type.
    pub(super) fn operation(&mut self, ty: &Type, context: Context, depth: u32) -> Text {
        match ty {
            Type::Int => self.int(context, depth),
            Type::Float => self.float(context, depth),
            Type::Bool => self.bool(depth),
            Type::String => self.string(context, depth),
            Type::Point => self.point(context, depth),
            Type::Time => self.time(context, depth),
            Type::Duration => self.duration(context, depth),
            Type::Record(number) => self.record(*number, depth),
            Type::Tuple(_) if ty.is_ordered() && self.choices.below(4) == 3 => {
                self.chosen(ty, depth)
            }
            Type::Tuple(parts) => self.tuple(parts, context, depth),
            Type::List(element) => self.list(element, context, depth),
            Type::Set(element) => self.set(element, context, depth),
            Type::Map(key, value) => self.map(key, value, context, depth),
            Type::Optional(inner) => self.optional(inner, context, depth),
            Type::Area => self.area(depth),
            Type::Robot | Type::Obstacles | Type::Enum(_) => self.leaf(ty, context),
        }
    }

    /// An operator on numbers; divisors are mostly not zero.
    fn numbers(&mut self, ty: &Type, context: Context, depth: u32) -> Text {
        match self.choices.below(4) {
            0 => self.binary("+", SUM, [ty, ty], context, depth),
            1 => self.binary("-", SUM, [ty, ty], context, depth),
            2 => self.binary("*", PRODUCT, [ty, ty], context, depth),
            _ => {
                let left = self.expression(ty, context.exact(), depth);
                let right = match self.choices.below(3) {
                    0 => self.one_of(if *ty == Int {
                        &["2", "3", "-5"]
                    } else {
                        &["2.0", "-0.5"]
                    }),
                    _ => self.expression(ty, Context::Known, depth),
                };
                let sign = if *ty == Int && self.choices.below(2) == 1 {
                    "%"
                } else {
                    "/"
                };
                self.joined(left, sign, right, PRODUCT)
            }
        }
    }

    /// `-x`.
    fn negated(&mut self, ty: &Type, context: Context, depth: u32) -> Text {
        let operand = self.expression(ty, context.exact(), depth).at(power::SIGN);
        // A literal with its sign is another thing, and two signs in a row are none.
        let is_bare = operand.starts_with(|first: char| first == '-' || first.is_ascii_digit());
        let operand = if is_bare {
            format!("({operand})")
        } else {
            operand
        };
        self.made(format!("-{operand}"), power::SIGN)
    }

    /// `min`, `max`, `clamp`, whose first argument says the type.
    fn chosen(&mut self, ty: &Type, depth: u32) -> Text {
        let first = self.expression(ty, Context::Unknown, depth).text;
        let second = self.expression(ty, Context::Fit, depth).text;
        match self.choices.below(3) {
            0 => Text::atom(format!("min({first}, {second})")),
            1 => Text::atom(format!("max({first}, {second})")),
            _ => {
                let third = self.expression(ty, Context::Fit, depth).text;
                Text::atom(format!("clamp({first}, {second}, {third})"))
            }
        }
    }

    fn absolute(&mut self, ty: &Type, depth: u32) -> Text {
        let value = self.expression(ty, Context::Unknown, depth);
        Text::atom(format!("abs({})", value.text))
    }

    fn int(&mut self, context: Context, depth: u32) -> Text {
        let element = self.made_key();
        match self.choices.below(15) {
            0..=4 => self.numbers(&Int, context, depth),
            5 => self.negated(&Int, context, depth),
            6 => self.absolute(&Int, depth),
            7 => self.chosen(&Int, depth),
            8 => {
                let name = ["round", "floor", "ceil", "Int", "Int"][self.choices.below(5)];
                let takes_robot = name == "Int" && self.place.asks();
                let of = if takes_robot && self.choices.below(2) == 1 {
                    &Robot
                } else {
                    &Float
                };
                self.applied(name, &[of], depth)
            }
            9 => self.method(&Type::list(element), "size", &[], depth),
            10 => self.method(&Type::set(element), "size", &[], depth),
            11 => self.method(&Type::map(element, Int), "size", &[], depth),
            12 => self.method(&Str, "size", &[], depth),
            13 => self.method(&Type::list(Int), "sum", &[], depth),
            _ if self.place == Place::Effect => {
                let low = self.expression(&Int, Context::Fit, depth);
                Text::atom(format!("random_int({}, {})", low.text, "2000"))
            }
            _ => self.numbers(&Int, context, depth),
        }
    }

    fn float(&mut self, context: Context, depth: u32) -> Text {
        match self.choices.below(16) {
            0..=4 => self.numbers(&Float, context, depth),
            5 => self.negated(&Float, context, depth),
            6 => self.absolute(&Float, depth),
            7 => self.chosen(&Float, depth),
            8 => {
                let names = ["sqrt", "sin", "cos", "tan", "exp", "log_e"];
                let name = names[self.choices.below(6)];
                self.applied(name, &[&Float], depth)
            }
            9 => {
                let name = ["atan2", "pow"][self.choices.below(2)];
                let applied = self.applied(name, &[&Float, &Float], depth);
                Text::atom(format!("({} / 1rad)", applied.text))
            }
            10 => self.applied("Float", &[&Int], depth),
            11 => {
                let name = ["distance", "bearing"][self.choices.below(2)];
                let applied = self.applied(name, &[&Point, &Point], depth);
                Text::atom(format!("({} / 1m)", applied.text))
            }
            12 => {
                let base = self
                    .expression(&Point, Context::Unknown, depth)
                    .at(power::ATOM);
                let axis = ["x", "y", "z"][self.choices.below(3)];
                Text::atom(format!("{base}.{axis}"))
            }
            13 => self.binary(
                "/",
                PRODUCT,
                [&Duration, &Duration],
                Context::Unknown,
                depth,
            ),
            14 => self.method(&Type::list(Float), "sum", &[], depth),
            _ if self.place == Place::Effect => Text::atom("random(0.5, 2.5)"),
            _ => Text::atom("pi"),
        }
    }

    fn string(&mut self, context: Context, depth: u32) -> Text {
        match self.choices.below(6) {
            0 if self.place.asks() => self.applied("robot_name", &[&Robot], depth),
            0 | 1 => self.binary("+", SUM, [&Str, &Str], context, depth),
            2 => match self.choices.below(5) {
                0 => self.method(&Type::list(Str), "join", &[&Str], depth),
                1 => self.method(&Str, "replace", &[&Str, &Str], depth),
                other => self.method(&Str, ["lower", "upper", "trim"][other - 2], &[], depth),
            },
            _ => {
                let ty = self.made_type(1);
                let value = self.expression(&ty, Context::Unknown, depth);
                Text::atom(format!("String({})", value.text))
            }
        }
    }

    fn point(&mut self, context: Context, depth: u32) -> Text {
        match self.choices.below(9) {
            0 => self.applied("Point", &[&Float, &Float], depth),
            1 => self.applied("Point", &[&Float, &Float, &Float], depth),
            2 | 3 => self.binary("+", SUM, [&Point, &Point], context, depth),
            4 => self.binary("-", SUM, [&Point, &Point], context, depth),
            5 => self.binary("*", PRODUCT, [&Point, &Float], context, depth),
            6 => self.binary("*", PRODUCT, [&Float, &Point], Context::Unknown, depth),
            7 => self.binary("/", PRODUCT, [&Point, &Float], context, depth),
            _ => self.negated(&Point, context, depth),
        }
    }

    fn time(&mut self, context: Context, depth: u32) -> Text {
        match self.choices.below(4) {
            0 => self.binary("+", SUM, [&Time, &Duration], context, depth),
            1 => self.binary("+", SUM, [&Duration, &Time], Context::Unknown, depth),
            2 => self.binary("-", SUM, [&Time, &Duration], context, depth),
            _ => self.chosen(&Time, depth),
        }
    }

    fn duration(&mut self, context: Context, depth: u32) -> Text {
        let unknown = Context::Unknown;
        match self.choices.below(9) {
            0 => self.binary("+", SUM, [&Duration, &Duration], context, depth),
            1 => self.binary("-", SUM, [&Duration, &Duration], context, depth),
            2 => self.binary("*", PRODUCT, [&Duration, &Int], context, depth),
            3 => self.binary("*", PRODUCT, [&Duration, &Float], context, depth),
            4 => self.binary("*", PRODUCT, [&Int, &Duration], unknown, depth),
            5 => self.binary("*", PRODUCT, [&Float, &Duration], unknown, depth),
            6 => self.binary("/", PRODUCT, [&Duration, &Int], context, depth),
            7 if self.can_make(&Time) => self.binary("-", SUM, [&Time, &Time], unknown, depth),
            7 => self.binary("/", PRODUCT, [&Duration, &Float], context, depth),
            _ => self.chosen(&Duration, depth),
        }
    }

    fn bool(&mut self, depth: u32) -> Text {
        match self.choices.below(14) {
            0 | 1 => self.binary("and", power::AND, [&Bool, &Bool], Context::Known, depth),
            2 | 3 => self.binary("or", power::OR, [&Bool, &Bool], Context::Known, depth),
            4 => {
                let operand = self.expression(&Bool, Context::Known, depth);
                self.made(format!("not {}", operand.at(power::NOT)), power::NOT)
            }
            5 | 6 => self.equality(depth),
            7 | 8 => self.order(depth),
            9 => self.is_none(depth),
            10 | 11 => self.contained(depth),
            12 => self.contains(depth),
            _ if self.place.is_property() && !self.is_about_robot() => self.quantifier(depth),
            _ => self.order(depth),
        }
    }

    fn is_about_robot(&self) -> bool {
        self.place == Place::Property(true)
    }

    fn equality(&mut self, depth: u32) -> Text {
        let ty = self.made_type(1);
        let sign = ["==", "!="][self.choices.below(2)];
        let left = self.expression(&ty, Context::Unknown, depth);
        let right = match &ty {
            // The other side may be there for sure.
            Type::Optional(inner) if self.can_make(inner) && self.choices.below(2) == 1 => {
                self.expression(inner, Context::Unknown, depth)
            }
            _ => self.expression(&ty, Context::Unknown, depth),
        };
        self.joined(left, sign, right, power::COMPARISON)
    }

    fn order(&mut self, depth: u32) -> Text {
        let types = [Int, Float, Str, Duration, Time, Robot];
        let tuple = Type::Tuple(vec![Float, self.ordered_tuple()]);
        let ty = types.get(self.choices.below(8)).unwrap_or(&tuple);
        let ty = if self.can_make(ty) { ty } else { &Int };
        let sign = ["<", "<=", ">", ">="][self.choices.below(4)];
        // A built-in name is looked at after the other side, which then has nothing to go by.
        let left = self.expression(ty, Context::Unknown, depth);
        let right = self.expression(ty, Context::Unknown, depth);
        self.joined(left, sign, right, power::COMPARISON)
    }

    fn is_none(&mut self, depth: u32) -> Text {
        let optional = Type::optional(self.plain_type());
        let sign = ["==", "!="][self.choices.below(2)];
        let value = self.expression(&optional, Context::Unknown, depth);
        let none = Text::atom("none");
        match self.choices.below(3) {
            2 => self.joined(none, sign, value, power::COMPARISON),
            _ => self.joined(value, sign, none, power::COMPARISON),
        }
    }

    /// `x in collection`.
    fn contained(&mut self, depth: u32) -> Text {
        let element = self.made_key();
        let (item, collection) = match self.choices.below(5) {
            0 => (Int, None),
            1 => (element.clone(), Some(Type::list(element))),
            2 => (element.clone(), Some(Type::set(element))),
            3 => (element.clone(), Some(Type::map(element, Int))),
            _ => (Str, Some(Str)),
        };
        let sign = ["in", "not in"][self.choices.below(2)];
        let item = self.expression(&item, Context::Unknown, depth);
        let collection = match collection {
            None => self.range(depth),
            Some(ty) => self.expression(&ty, Context::Unknown, depth),
        };
        self.joined(item, sign, collection, power::COMPARISON)
    }

    /// `a..b`.
    pub(super) fn range(&mut self, depth: u32) -> Text {
        let start = match self.choices.below(3) {
            2 => self.expression(&Int, Context::Known, depth),
            _ => self.one_of(&["0", "1", "-2"]),
        };
        let end = match self.choices.below(4) {
            3 => self.expression(&Int, Context::Known, depth),
            _ => self.one_of(&["3", "0", "1", "5", "8"]),
        };
        let text = format!("{}..{}", start.at(power::DEFAULT), end.at(power::DEFAULT));
        self.made(text, power::RANGE)
    }

    /// `collection.contains(x)`.
    fn contains(&mut self, depth: u32) -> Text {
        let element = self.made_key();
        match self.choices.below(5) {
            0 => self.method(&Type::list(element.clone()), "contains", &[&element], depth),
            1 => self.method(&Type::set(element.clone()), "contains", &[&element], depth),
            2 => self.method(
                &Type::map(element.clone(), Bool),
                "contains",
                &[&element],
                depth,
            ),
            3 => {
                let name = ["contains", "starts_with", "ends_with"][self.choices.below(3)];
                self.method(&Str, name, &[&Str], depth)
            }
            _ => self.method(&Type::Area, "contains", &[&Point], depth),
        }
    }

    fn area(&mut self, depth: u32) -> Text {
        if self.choices.below(2) == 0 {
            return self.applied("circle", &[&Point, &Float], depth);
        }
        let shift = self.expression(&Point, Context::Known, depth).at(PRODUCT);
        let corners = ["Point(0.0, 0.0)", "Point(2.0, 0.0)", "Point(0.0, 3.0)"];
        let corners = corners.map(|corner| format!("{corner} + {shift}"));
        Text::atom(format!("polygon([{}])", corners.join(", ")))
    }
}
