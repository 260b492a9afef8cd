//! Lists, sets, maps and optionals: written out, built from others, and given by methods.

use super::Generator;
use super::expression::{Context, Text, power};
use super::model::{Place, Type};

impl Generator<'_> {
    pub(super) fn list(&mut self, element: &Type, context: Context, depth: u32) -> Text {
        let ty = Type::list(element.clone());
        match self.choices.below(9) {
            0 | 1 => {
                let elements = self.elements(element, context, depth);
                Text::atom(format!("[{elements}]"))
            }
            2 | 3 => self.comprehension("[", "]", element, context, depth),
            4 => self.binary("+", power::SUM, [&ty, &ty], context, depth),
            5 => self.method(&ty, "reversed", &[], depth),
            6 if element.is_ordered() => self.method(&ty, "sorted", &[], depth),
            6 | 7 => {
                let receiver = self
                    .expression(&ty, Context::Unknown, depth)
                    .at(power::ATOM);
                let end = self.choices.below(3);
                Text::atom(format!("{receiver}.slice(0, {end})"))
            }
            _ if *element == Type::String => {
                self.method(&Type::String, "split", &[&Type::String], depth)
            }
            _ => {
                let key = self.made_key();
                self.method(&Type::map(key, element.clone()), "values", &[], depth)
            }
        }
    }

    /// Elements with commas between them, one at least.
    fn elements(&mut self, element: &Type, context: Context, depth: u32) -> String {
        let count = 1 + self.choices.below(4);
        let elements: Vec<String> = (0..count)
            .map(|_| self.expression(element, context.part(), depth).text)
            .collect();
        elements.join(", ")
    }

    pub(super) fn set(&mut self, element: &Type, context: Context, depth: u32) -> Text {
        let ty = Type::set(element.clone());
        match self.choices.below(8) {
            0 | 1 => {
                let elements = self.elements(element, context, depth);
                Text::atom(format!("{{{elements}}}"))
            }
            2 | 3 => self.comprehension("{", "}", element, context, depth),
            4 => {
                let key = element.clone();
                self.method(&Type::map(key, Type::Int), "keys", &[], depth)
            }
            other => {
                let name = ["union", "intersection", "difference"][other - 5];
                self.method(&ty, name, &[&ty], depth)
            }
        }
    }

    pub(super) fn map(&mut self, key: &Type, value: &Type, context: Context, depth: u32) -> Text {
        if self.choices.below(3) == 2 {
            return self.map_comprehension(key, value, context, depth);
        }
        let count = 1 + self.choices.below(3);
        let entries: Vec<String> = (0..count)
            .map(|_| {
                let key = self.expression(key, context.part(), depth).at(power::OR);
                let value = self.expression(value, context.part(), depth).text;
                format!("{key}: {value}")
            })
            .collect();
        Text::atom(format!("{{{}}}", entries.join(", ")))
    }

    fn comprehension(
        &mut self,
        open: &str,
        close: &str,
        element: &Type,
        context: Context,
        depth: u32,
    ) -> Text {
        let mark = self.locals.len();
        let (clause, condition) = self.clause(depth);
        let element = self
            .expression(element, context.exact(), depth)
            .at(power::OR);
        let order = match self.choices.below(3) {
            0 if open == "[" => self.sorting(depth),
            _ => String::new(),
        };
        self.locals.truncate(mark);
        Text::atom(format!("{open}{element} {clause}{condition}{order}{close}"))
    }

    fn map_comprehension(
        &mut self,
        key: &Type,
        value: &Type,
        context: Context,
        depth: u32,
    ) -> Text {
        let mark = self.locals.len();
        let (clause, condition) = self.clause(depth);
        let key = self.expression(key, context.exact(), depth).at(power::OR);
        let value = self.expression(value, context.exact(), depth).at(power::OR);
        self.locals.truncate(mark);
        Text::atom(format!("{{{key}: {value} {clause}{condition}}}"))
    }

    /// `for x in xs` and `if c` of a comprehension; the locals stay.
    fn clause(&mut self, depth: u32) -> (String, String) {
        let clause = self.iteration(depth);
        let condition = match self.choices.below(3) {
            2 => format!(" if {}", self.condition(depth)),
            _ => String::new(),
        };
        (clause, condition)
    }

    /// ` by key`
    fn sorting(&mut self, depth: u32) -> String {
        let pair = Type::Tuple(vec![Type::Float, Type::String]);
        let ordered = [Type::Int, Type::Float, Type::String, Type::Duration, pair];
        let key = &ordered[self.choices.below(ordered.len())];
        let key = self.expression(key, Context::Unknown, depth).at(power::OR);
        format!(" by {key}")
    }

    /// `for x in xs`; the locals stay.
    pub(super) fn iteration(&mut self, depth: u32) -> String {
        let key = self.made_key();
        let (collection, one, two) = match self.choices.below(5) {
            0 => (self.range(depth), Type::Int, None),
            1 => {
                let element = self.made_type(0);
                let list = Type::list(element.clone());
                (
                    self.expression(&list, Context::Unknown, depth),
                    element,
                    None,
                )
            }
            2 => {
                let set = Type::set(key.clone());
                (self.expression(&set, Context::Unknown, depth), key, None)
            }
            kind => {
                let value = self.made_type(0);
                let map = Type::map(key.clone(), value.clone());
                let map = self.expression(&map, Context::Unknown, depth);
                (map, key, Some(value).filter(|_| kind == 4))
            }
        };
        let collection = collection.at(power::OR);
        let mut names = self.loop_variable(one);
        if let Some(value) = two {
            names = format!("{names}, {}", self.loop_variable(value));
        }
        format!("for {names} in {collection}")
    }

    fn loop_variable(&mut self, ty: Type) -> String {
        if self.choices.below(8) == 7 {
            return "_".into();
        }
        self.pattern(ty, false)
    }

    pub(super) fn optional(&mut self, inner: &Type, context: Context, depth: u32) -> Text {
        let list = Type::list(inner.clone());
        match self.choices.below(9) {
            0 | 1 if context == Context::Fit => self.expression(inner, Context::Fit, depth),
            2 => self.method(&list, "last", &[], depth),
            3 | 4 => {
                let key = self.made_key();
                self.method(
                    &Type::map(key.clone(), inner.clone()),
                    "get",
                    &[&key],
                    depth,
                )
            }
            5 if *inner == Type::Int => {
                let element = self.made_key();
                self.method(&Type::list(element.clone()), "index_of", &[&element], depth)
            }
            5 | 6 if self.model.is_key(inner) => {
                let name = ["min", "max"][self.choices.below(2)];
                self.method(&Type::set(inner.clone()), name, &[], depth)
            }
            7 if self.place == Place::Effect => {
                let list = self.expression(&list, Context::Unknown, depth);
                Text::atom(format!("choose({})", list.text))
            }
            0 | 1 | 8 if self.choices.below(2) == 1 => self.best(inner, depth),
            8 if *inner == Type::Point && self.place.asks() => {
                self.applied("way_point", &[&Type::String], depth)
            }
            _ => self.method(&list, "first", &[], depth),
        }
    }

    /// `min(x for x in xs by key)`
    fn best(&mut self, inner: &Type, depth: u32) -> Text {
        let name = ["min", "max"][self.choices.below(2)];
        let mark = self.locals.len();
        let (clause, condition) = self.clause(depth);
        let element = self
            .expression(inner, Context::Unknown, depth)
            .at(power::OR);
        let key = match inner.is_ordered() && self.choices.below(2) == 1 {
            true => String::new(),
            false => self.sorting(depth),
        };
        self.locals.truncate(mark);
        Text::atom(format!("{name}({element} {clause}{condition}{key})"))
    }

    /// `forall r: condition`.
    pub(super) fn quantifier(&mut self, depth: u32) -> Text {
        let word = ["forall", "exists"][self.choices.below(2)];
        let mark = self.locals.len();
        let mut names = vec![self.add_local(Type::Robot, false)];
        if self.choices.below(3) == 2 {
            names.push(self.add_local(Type::Robot, false));
        }
        let condition = self.expression(&Type::Bool, Context::Known, depth);
        self.locals.truncate(mark);
        let text = format!("{word} {}: {}", names.join(", "), condition.text);
        self.made(text, power::OPEN)
    }
}
