//! The values of expressions.

use super::builtin::{index, method, position, pure, sum};
use super::operator::{apply, settled};
use super::value::{Value, equal, find, order, put, set, shown, text, weight};
use super::{Outcome, Reference, Stop, shared_kind};
use starl_lang::check::{Builtin, Purity, Signature};
use starl_lang::ir::*;
use starl_lang::machine::{self, Fault};

impl<'a> Reference<'a> {
    /// Whether a Bool is true.
    pub fn holds(&mut self, expression: &'a Expression) -> Outcome<bool> {
        match self.evaluate(expression)? {
            Value::Bool(holds) => Ok(holds),
            other => panic!("{other:?} is no Bool"),
        }
    }

    pub fn int(&mut self, expression: &'a Expression) -> Outcome<i64> {
        match self.evaluate(expression)? {
            Value::Int(value) => Ok(value),
            other => panic!("{other:?} is no Int"),
        }
    }

    fn all(&mut self, expressions: &'a [Expression]) -> Outcome<Vec<Value>> {
        expressions.iter().map(|one| self.evaluate(one)).collect()
    }

    /// The value of an optional, if there is one.
    fn there(&mut self, expression: &'a Expression) -> Outcome<Option<Value>> {
        match self.evaluate(expression)? {
            Value::Optional(inner) => Ok(inner.map(|value| *value)),
            other => panic!("{other:?} is no optional"),
        }
    }

    pub fn evaluate(&mut self, expression: &'a Expression) -> Outcome<Value> {
        use ExpressionKind as Kind;
        self.step()?;
        let ty = &expression.ty;
        Ok(match &expression.kind {
            Kind::Error | Kind::Range { .. } => panic!("no value: {expression:?}"),
            Kind::Bool(value) => Value::Bool(*value),
            Kind::Int(value) => Value::Int(*value),
            Kind::Float(value) => Value::Float(*value),
            Kind::Duration(value) => Value::Duration(*value),
            Kind::String(value) => Value::Text(value.clone()),
            Kind::None => Value::Optional(None),
            Kind::Present(value) => Value::Optional(Some(Box::new(self.evaluate(value)?))),
            Kind::Variant(number) => Value::Variant(*number),
            Kind::Local(local) => self.locals[local.index()]
                .clone()
                .expect("a local has a value"),
            Kind::Parameter(id) => self.parameters[id.index()].clone(),
            Kind::Variable(id) => self.variables[id.index()].clone(),
            Kind::Constant(id) => {
                let constant = &self.program[*id];
                let locals = vec![None; constant.locals.len()];
                self.inside(locals, |reference| reference.evaluate(&constant.value))?
            }
            Kind::Shared(id) => self.shared(*id, None)?,
            Kind::SharedElement { shared, robot, of } => {
                let of = of.as_ref().map(|of| self.evaluate(of)).transpose()?;
                let robot = self.evaluate(robot)?;
                let robot = shown(self.program, &Type::Robot, &robot);
                self.of_shared(*shared, of, "element", Some(robot), ty)?
            }
            Kind::SharedMap(shared) => self.of_shared(*shared, None, "all", None, ty)?,
            Kind::Call {
                function,
                arguments,
            } => {
                let arguments = self.all(arguments)?;
                self.call(*function, arguments)?
            }
            Kind::Builtin {
                builtin,
                arguments,
                rest,
            } => self.builtin(*builtin, arguments, rest, ty)?,
            Kind::Method {
                receiver,
                method,
                arguments,
            } => {
                let value = self.evaluate(receiver)?;
                let arguments = self.all(arguments)?;
                match (method.name(), value, ty) {
                    ("sum", Value::List(list), Type::Int) => sum(list, Value::Int(0))?,
                    ("sum", Value::List(list), _) => sum(list, Value::Float(0.0))?,
                    (_, value, _) => self::method(*method, value, arguments)?,
                }
            }
            Kind::Change { .. } => panic!("a change gives nothing"),
            Kind::Primitive {
                binding,
                member,
                arguments,
            } => {
                let kind = self.program[*binding]
                    .primitive
                    .expect("a primitive")
                    .name();
                let mut values = vec![machine::Value::Int(i64::from(binding.0))];
                values.extend(self.arguments(&member.signature(), arguments)?);
                let name = format!("{kind}.{}", member.name());
                if *ty == Type::Nothing {
                    self.host(&name, values)?;
                    return Ok(Value::Bool(false));
                }
                self.ask(&name, values, ty)?
            }
            Kind::Record(values) => Value::Record(self.all(values)?),
            Kind::Field { base, field } => match self.evaluate(base)? {
                Value::Record(mut fields) => fields.swap_remove(*field as usize),
                other => panic!("{other:?} has no fields"),
            },
            Kind::Coordinate { base, axis } => match self.evaluate(base)? {
                Value::Point(point) => {
                    Value::Float([point.x, point.y, point.z][usize::from(*axis)])
                }
                other => panic!("{other:?} has no coordinates"),
            },
            Kind::Index { base, index: at } => {
                let base = self.evaluate(base)?;
                let at = self.int(at)?;
                let Value::List(mut list) = base else {
                    panic!("no list")
                };
                let at = index(at, list.len())?;
                list.swap_remove(at)
            }
            Kind::Lookup { base, key } => {
                let base = self.evaluate(base)?;
                let key = self.evaluate(key)?;
                let Value::Map(mut map) = base else {
                    panic!("no map")
                };
                let at = find(&map, &key).ok_or(Stop::Fault(Fault::KeyMissing))?;
                map.swap_remove(at).1
            }
            Kind::Unwrap(value) => self
                .there(value)?
                .ok_or(Stop::Fault(Fault::NoneUnwrapped))?,
            Kind::IsNone(value) => Value::Bool(self.there(value)?.is_none()),
            Kind::Default { optional, default } => match self.evaluate(optional)? {
                Value::Optional(None) => self.evaluate(default)?,
                value if matches!(ty, Type::Optional(_)) => value,
                Value::Optional(Some(value)) => *value,
                other => panic!("{other:?} is no optional"),
            },
            Kind::Negate(value) => match self.evaluate(value)? {
                Value::Int(value) => {
                    Value::Int(value.checked_neg().ok_or(Stop::Fault(Fault::Overflow))?)
                }
                Value::Float(value) => Value::Float(-value),
                Value::Point(p) => {
                    let [x, y, z] = [p.x, p.y, p.z].map(|part| settled(-part));
                    Value::Point(starl_core::Point::new(x, y, z))
                }
                other => panic!("{other:?} is not negated"),
            },
            Kind::Not(value) => Value::Bool(!self.holds(value)?),
            Kind::Binary {
                operator: Operator::And,
                left,
                right,
            } => Value::Bool(self.holds(left)? && self.holds(right)?),
            Kind::Binary {
                operator: Operator::Or,
                left,
                right,
            } => Value::Bool(self.holds(left)? || self.holds(right)?),
            Kind::Binary {
                operator,
                left,
                right,
            } => {
                let left = self.evaluate(left)?;
                let right = self.evaluate(right)?;
                Self::limited(apply(*operator, left, right)?)?
            }
            Kind::In { item, collection } => Value::Bool(self.contained(item, collection)?),
            Kind::Conditional {
                condition,
                then,
                otherwise,
            } => {
                let way = if self.holds(condition)? {
                    then
                } else {
                    otherwise
                };
                self.evaluate(way)?
            }
            Kind::Bind { local, value } => {
                let value = self.there(value)?;
                let is_there = value.is_some();
                self.locals[local.index()] = value;
                Value::Bool(is_there)
            }
            Kind::List(elements) => Value::List(self.all(elements)?),
            Kind::Set(elements) => Value::Set(set(self.all(elements)?)),
            Kind::Map(entries) => {
                let mut map = Vec::new();
                for (key, value) in entries {
                    let key = self.evaluate(key)?;
                    let value = self.evaluate(value)?;
                    put(&mut map, key, value);
                }
                Value::Map(map)
            }
            Kind::Comprehension(comprehension) => self.comprehension(comprehension, ty)?,
            Kind::Best {
                comprehension,
                is_greatest,
            } => {
                let mut rows = self.rows(comprehension)?;
                let of = |row: &(Value, Option<Value>)| row.1.clone().unwrap_or(row.0.clone());
                rows.sort_by(|left, right| match is_greatest {
                    true => order(&of(right), &of(left)),
                    false => order(&of(left), &of(right)),
                });
                match rows.into_iter().next() {
                    Some((Value::Optional(inner), _)) => Value::Optional(inner),
                    row => Value::Optional(row.map(|(value, _)| Box::new(value))),
                }
            }
            Kind::Quantifier {
                is_universal,
                robots,
                condition,
            } => {
                let all = self.ask("robot.all", Vec::new(), &Type::list(Type::Robot))?;
                let Value::List(all) = all else {
                    panic!("no robots")
                };
                let found = self.quantifier(robots, &all, !is_universal, condition)?;
                Value::Bool(found != *is_universal)
            }
            Kind::Over {
                is_universal,
                variables,
                collection,
                condition,
            } => {
                let mut found = false;
                for item in self.items(collection)? {
                    self.step()?;
                    self.bind_loop(*variables, item);
                    if self.holds(condition)? != *is_universal {
                        found = true;
                        break;
                    }
                }
                Value::Bool(found != *is_universal)
            }
            Kind::OfRobot { robot, member } => {
                let robot = self.evaluate(robot)?;
                self.of_robot(robot, *member, ty)?
            }
        })
    }

    /// Whether there are robots for which the condition is as wanted.
    fn quantifier(
        &mut self,
        robots: &'a [LocalId],
        all: &[Value],
        wanted: bool,
        condition: &'a Expression,
    ) -> Outcome<bool> {
        let Some((first, rest)) = robots.split_first() else {
            return Ok(self.holds(condition)? == wanted);
        };
        for robot in all {
            self.locals[first.index()] = Some(robot.clone());
            if self.quantifier(rest, all, wanted, condition)? {
                return Ok(true);
            }
        }
        Ok(false)
    }

    /// Does something with other locals.
    pub fn inside<T>(
        &mut self,
        locals: Vec<Option<Value>>,
        then: impl FnOnce(&mut Self) -> Outcome<T>,
    ) -> Outcome<T> {
        if self.depth > 40 {
            return Err(Stop::TooLong);
        }
        self.depth += 1;
        let outer = std::mem::replace(&mut self.locals, locals);
        let result = then(self)?;
        self.locals = outer;
        self.depth -= 1;
        Ok(result)
    }

    fn call(&mut self, id: FunctionId, arguments: Vec<Value>) -> Outcome<Value> {
        let function = &self.program[id];
        let mut locals: Vec<Option<Value>> = arguments.into_iter().map(Some).collect();
        locals.resize(function.locals.len(), None);
        let result = self.inside(locals, |reference| reference.block(&function.body))?;
        Ok(result.flatten().expect("a function returns"))
    }

    pub fn shared(&mut self, id: SharedId, of: Option<Value>) -> Outcome<Value> {
        let shared = &self.program[id];
        let optional = Type::optional(shared.ty.clone());
        let value = self.of_shared(id, of, "read", None, &optional)?;
        match (value, &shared.initial) {
            (Value::Optional(Some(value)), Some(_)) => Ok(*value),
            (value, _) => Ok(value),
        }
    }

    /// Asks for a shared variable; in properties for the copy of a robot.
    pub fn of_shared(
        &mut self,
        id: SharedId,
        of: Option<Value>,
        member: &str,
        owner: Option<machine::Value>,
        ty: &Type,
    ) -> Outcome<Value> {
        let instance = machine::Value::Int(i64::from(id.0) + self.program.bindings.len() as i64);
        let kind = match of {
            Some(_) => "shared",
            None => shared_kind(&self.program[id]),
        };
        let of = of.map(|robot| shown(self.program, &Type::Robot, &robot));
        let arguments = [Some(instance), of, owner].into_iter().flatten().collect();
        self.ask(&format!("{kind}.{member}"), arguments, ty)
    }

    /// Arguments for the host: an omitted optional one is none.
    pub fn arguments(
        &mut self,
        signature: &Signature,
        arguments: &'a [Option<Expression>],
    ) -> Outcome<Vec<machine::Value>> {
        let mut values = Vec::new();
        for (parameter, argument) in signature.parameters.iter().zip(arguments) {
            let value = match argument {
                Some(argument) => {
                    let value = self.evaluate(argument)?;
                    Some(shown(self.program, &argument.ty, &value))
                }
                None => None,
            };
            values.push(match (value, parameter.is_optional) {
                (Some(value), true) => machine::Value::Some(Box::new(value)),
                (Some(value), false) => value,
                (None, _) => machine::Value::None,
            });
        }
        Ok(values)
    }

    fn builtin(
        &mut self,
        builtin: Builtin,
        arguments: &'a [Option<Expression>],
        rest: &'a [(Option<String>, Expression)],
        ty: &Type,
    ) -> Outcome<Value> {
        let program = self.program;
        if builtin == Builtin::Log {
            let format = arguments[0].as_ref().expect("a format");
            let Value::Text(format) = self.evaluate(format)? else {
                panic!("no text")
            };
            let mut words = Vec::new();
            for (_, value) in rest {
                let word = self.evaluate(value)?;
                words.push(text(program, &value.ty, &word));
            }
            let mut words = words.into_iter();
            let mut pieces = format.split("{}");
            let mut line = pieces.next().unwrap_or_default().to_string();
            for piece in pieces {
                line += &words.next().unwrap_or("{}".into());
                line += piece;
            }
            self.host("log", vec![machine::Value::Text(line)])?;
            return Ok(Value::Bool(false));
        }
        if builtin == Builtin::Choose {
            let list = arguments[0].as_ref().expect("a list");
            let Value::List(mut list) = self.evaluate(list)? else {
                panic!("no list")
            };
            if list.is_empty() {
                return Ok(Value::Optional(None));
            }
            let bounds = vec![
                machine::Value::Int(0),
                machine::Value::Int(list.len() as i64),
            ];
            let Value::Int(at) = self.ask("random_int", bounds, &Type::Int)? else {
                panic!("no Int")
            };
            return Ok(match list.swap_remove(at as usize) {
                value @ Value::Optional(_) => value,
                value => Value::Optional(Some(Box::new(value))),
            });
        }
        if builtin == Builtin::ToString {
            let argument = arguments[0].as_ref().expect("a value");
            let value = self.evaluate(argument)?;
            return Ok(Value::Text(text(program, &argument.ty, &value)));
        }
        if builtin.purity() == Purity::Pure {
            let values = arguments.iter().map(|argument| {
                argument
                    .as_ref()
                    .map(|argument| self.evaluate(argument))
                    .transpose()
            });
            return pure(builtin, values.collect::<Outcome<_>>()?);
        }
        let mut values = self.arguments(&builtin.signature(), arguments)?;
        for (_, value) in rest {
            let given = self.evaluate(value)?;
            values.push(shown(program, &value.ty, &given));
        }
        if *ty == Type::Nothing {
            self.host(builtin.name(), values)?;
            return Ok(Value::Bool(false));
        }
        self.ask(builtin.name(), values, ty)
    }

    fn contained(&mut self, item: &'a Expression, collection: &'a Expression) -> Outcome<bool> {
        let item = self.evaluate(item)?;
        if let ExpressionKind::Range { start, end } = &collection.kind {
            let (start, end) = (self.int(start)?, self.int(end)?);
            let Value::Int(item) = item else {
                panic!("no Int")
            };
            return Ok((start..end).contains(&item));
        }
        Ok(match self.evaluate(collection)? {
            Value::List(list) => position(&list, &item)?.is_some(),
            Value::Set(set) => {
                let same = |other| equal(other, &item, true).ok_or(Stop::Unknown);
                set.iter()
                    .map(same)
                    .collect::<Outcome<Vec<bool>>>()?
                    .contains(&true)
            }
            Value::Map(map) => find(&map, &item).is_some(),
            Value::Text(text) => {
                let Value::Text(part) = item else {
                    panic!("no text")
                };
                text.contains(&part)
            }
            other => panic!("nothing is in {other:?}"),
        })
    }

    fn comprehension(&mut self, of: &'a Comprehension, ty: &Type) -> Outcome<Value> {
        let items = self.items(&of.collection)?;
        let (mut elements, mut map, mut total) = (Vec::new(), Vec::new(), 0);
        let mut keys = Vec::new();
        for item in items {
            self.step()?;
            self.bind_loop(of.variables, item);
            if let Some(condition) = &of.condition
                && !self.holds(condition)?
            {
                continue;
            }
            match &of.element {
                Element::One(element) => {
                    let element = self.evaluate(element)?;
                    total += weight(&element);
                    elements.push(element);
                }
                Element::Entry(key, value) => {
                    let key = self.evaluate(key)?;
                    let value = self.evaluate(value)?;
                    total += weight(&key) + weight(&value);
                    put(&mut map, key, value);
                }
            }
            if let Some(key) = &of.key {
                keys.push(self.evaluate(key)?);
            }
            if total > 5000 {
                return Err(Stop::TooLong);
            }
        }
        if of.key.is_some() {
            let mut rows: Vec<_> = keys.into_iter().zip(elements).collect();
            rows.sort_by(|(left, _), (right, _)| order(left, right));
            elements = rows.into_iter().map(|(_, element)| element).collect();
        }
        Ok(match ty {
            Type::List(_) => Value::List(elements),
            Type::Set(_) => Value::Set(set(elements)),
            _ => Value::Map(map),
        })
    }

    /// The elements that a comprehension finds, with their keys.
    fn rows(&mut self, of: &'a Comprehension) -> Outcome<Vec<(Value, Option<Value>)>> {
        let mut rows = Vec::new();
        let Element::One(element) = &of.element else {
            panic!("an entry of a map")
        };
        for item in self.items(&of.collection)? {
            self.step()?;
            self.bind_loop(of.variables, item);
            if let Some(condition) = &of.condition
                && !self.holds(condition)?
            {
                continue;
            }
            let element = self.evaluate(element)?;
            let key = of.key.as_ref().map(|key| self.evaluate(key)).transpose()?;
            rows.push((element, key));
        }
        Ok(rows)
    }

    /// The items of a loop: elements, or keys with their values.
    pub fn items(&mut self, collection: &'a Expression) -> Outcome<Items> {
        if let ExpressionKind::Range { start, end } = &collection.kind {
            let (start, end) = (self.int(start)?, self.int(end)?);
            return Ok(Box::new((start..end).map(|at| (Value::Int(at), None))));
        }
        Ok(match self.evaluate(collection)? {
            Value::List(list) | Value::Set(list) => {
                Box::new(list.into_iter().map(|value| (value, None)))
            }
            Value::Map(map) => Box::new(map.into_iter().map(|(key, value)| (key, Some(value)))),
            other => panic!("{other:?} is no collection"),
        })
    }

    pub fn bind_loop(&mut self, variables: LoopVariables, item: (Value, Option<Value>)) {
        let (LoopVariables::One(first) | LoopVariables::Two(first, _)) = variables;
        if let Some(first) = first {
            self.locals[first.index()] = Some(item.0);
        }
        if let LoopVariables::Two(_, Some(second)) = variables {
            self.locals[second.index()] = item.1;
        }
    }
}

/// The items of a loop.
pub type Items = Box<dyn Iterator<Item = (Value, Option<Value>)>>;
