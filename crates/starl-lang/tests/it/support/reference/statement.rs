//! The execution of statements.

use super::builtin::{index, position};
use super::operator::apply;
use super::value::{Value, add, find, put, shown};
use super::{Outcome, Reference, Stop, shared_kind};
use starl_lang::check::Method;
use starl_lang::ir::*;
use starl_lang::machine::{self, Fault};

/// The end of a block: none if execution continues after it, else the returned value.
type End = Option<Option<Value>>;

/// A step with its index or key, which was computed.
enum Way {
    Field(usize),
    Coordinate(u8),
    Index(i64),
    Key(Value),
}

impl<'a> Reference<'a> {
    pub fn procedure(&mut self, procedure: &'a Procedure) -> Outcome<()> {
        let locals = vec![None; procedure.locals.len()];
        self.inside(locals, |reference| reference.block(&procedure.body))?;
        Ok(())
    }

    pub fn block(&mut self, statements: &'a [Statement]) -> Outcome<End> {
        for statement in statements {
            let end = self.statement(statement)?;
            if end.is_some() {
                return Ok(end);
            }
        }
        Ok(None)
    }

    fn statement(&mut self, statement: &'a Statement) -> Outcome<End> {
        self.step()?;
        match &statement.kind {
            StatementKind::Let { local, value } => {
                let value = Self::limited(self.evaluate(value)?)?;
                self.locals[local.index()] = Some(value);
            }
            StatementKind::Assign { place, value } => {
                let way = self.way(place)?;
                let value = self.evaluate(value)?;
                self.change(place, &way, Some(Value::Bool(false)), |old| {
                    *old = value;
                    Ok(())
                })?;
            }
            StatementKind::Update {
                place,
                operator,
                value,
            } => {
                let way = self.way(place)?;
                let mut whole = self.root(place)?;
                let adds = matches!(operator, Operator::Add | Operator::Subtract);
                let start = || adds.then(|| zero(&place.ty));
                let old = with_part(&mut whole, &way, start(), |part| Ok(part.clone()))?;
                let value = self.evaluate(value)?;
                let new = apply(*operator, old, value)?;
                self.change(place, &way, start(), |old| {
                    *old = new;
                    Ok(())
                })?;
            }
            StatementKind::ChangeRole { value } => {
                let role = self.evaluate(value)?;
                let variable = self.program.roles.as_ref().expect("roles").variable.index();
                let old = std::mem::replace(&mut self.variables[variable], role.clone());
                let (Value::Variant(old), Value::Variant(new)) = (old, role) else {
                    panic!("a role is a variant")
                };
                if old != new {
                    self.enter_role()?;
                }
            }
            StatementKind::If {
                condition,
                then,
                otherwise,
            } => {
                let way = if self.holds(condition)? {
                    then
                } else {
                    otherwise
                };
                return self.block(way);
            }
            StatementKind::For {
                variables,
                collection,
                body,
            } => {
                for item in self.items(collection)? {
                    self.step()?;
                    self.bind_loop(*variables, item);
                    let end = self.block(body)?;
                    if end.is_some() {
                        return Ok(end);
                    }
                }
            }
            StatementKind::Return(value) => {
                let value = value
                    .as_ref()
                    .map(|value| self.evaluate(value))
                    .transpose()?;
                return Ok(Some(value));
            }
            StatementKind::Evaluate(expression) => match &expression.kind {
                ExpressionKind::Change {
                    place,
                    method,
                    arguments,
                } => {
                    self.method(place, *method, arguments)?;
                }
                _ => {
                    self.evaluate(expression)?;
                }
            },
            StatementKind::Atomic { body, .. } => return self.block(body),
        }
        Ok(None)
    }

    /// Runs the entry of the robot's role.
    pub fn enter_role(&mut self) -> Outcome<()> {
        let roles = self.program.roles.as_ref().expect("roles");
        let Value::Variant(role) = self.variables[roles.variable.index()] else {
            panic!("a role is a variant")
        };
        if self.depth > 40 {
            return Err(Stop::TooLong);
        }
        for (number, variable) in self.program.variables.iter().enumerate() {
            if variable.role == Some(role) {
                self.initialize(number)?;
            }
        }
        if let Some(entry) = &roles.roles[usize::from(role)].entry {
            self.procedure(entry)?;
        }
        Ok(())
    }

    /// The way to a part, its indices and keys computed.
    fn way(&mut self, place: &'a Place) -> Outcome<Vec<Way>> {
        let mut way = Vec::new();
        for step in &place.path {
            way.push(match step {
                Step::Field(number) => Way::Field(*number as usize),
                Step::Coordinate(axis) => Way::Coordinate(*axis),
                Step::Index(index) => Way::Index(self.int(index)?),
                Step::Key(key) => Way::Key(self.evaluate(key)?),
            });
        }
        Ok(way)
    }

    /// The whole variable.
    fn root(&mut self, place: &'a Place) -> Outcome<Value> {
        Ok(match &place.root {
            Root::Local(local) => self.locals[local.index()]
                .clone()
                .expect("a local has a value"),
            Root::Variable(id) => self.variables[id.index()].clone(),
            Root::Shared(id) => self.shared(*id, None)?,
            Root::OwnElement(_) | Root::Error => panic!("it is written as a whole"),
        })
    }

    /// Changes a part of a variable, or assigns it. A missing key at its end gets `start`, if there is one.
    fn change(
        &mut self,
        place: &'a Place,
        way: &[Way],
        start: Option<Value>,
        change: impl FnOnce(&mut Value) -> Outcome<()>,
    ) -> Outcome<()> {
        let program = self.program;
        let mut whole = match &place.root {
            Root::OwnElement(_) => Value::Bool(false),
            // It is assigned, not changed.
            Root::Shared(_) if way.is_empty() && matches!(start, Some(Value::Bool(_))) => {
                Value::Bool(false)
            }
            _ => self.root(place)?,
        };
        with_part(&mut whole, way, start, change)?;
        let whole = Self::limited(whole)?;
        match &place.root {
            Root::Local(local) => self.locals[local.index()] = Some(whole),
            Root::Variable(id) => self.variables[id.index()] = whole,
            Root::OwnElement(id) | Root::Shared(id) => {
                let shared = &program[*id];
                let instance = i64::from(id.0) + program.bindings.len() as i64;
                let value = shown(program, &shared.ty, &whole);
                let name = format!("{}.write", shared_kind(shared));
                self.host(&name, vec![machine::Value::Int(instance), value])?;
            }
            Root::Error => panic!("no variable"),
        }
        Ok(())
    }

    fn method(
        &mut self,
        place: &'a Place,
        method: Method,
        arguments: &'a [Expression],
    ) -> Outcome<()> {
        let way = self.way(place)?;
        let mut values = Vec::new();
        for argument in arguments {
            values.push(self.evaluate(argument)?);
        }
        let start = (method.name() == "add").then(|| zero(&place.ty));
        self.change(place, &way, start, |value| changed(value, method, values))
    }
}

/// Calls a method that changes its receiver.
fn changed(value: &mut Value, method: Method, arguments: Vec<Value>) -> Outcome<()> {
    let mut arguments = arguments.into_iter();
    match (method.name(), value, arguments.next(), arguments.next()) {
        ("add", Value::List(list), Some(element), _) => list.push(element),
        ("insert", Value::List(list), Some(Value::Int(at)), Some(element)) => {
            // One more than for reading: it may go to the end.
            let length = list.len() as u32;
            let fault = Stop::Fault(Fault::IndexOutOfRange { index: at, length });
            let at = usize::try_from(at)
                .ok()
                .filter(|at| *at <= list.len())
                .ok_or(fault)?;
            list.insert(at, element);
        }
        ("remove_at", Value::List(list), Some(Value::Int(at)), _) => {
            let at = index(at, list.len())?;
            list.remove(at);
        }
        ("remove", Value::List(list), Some(element), _) => {
            if let Some(at) = position(list, &element)? {
                list.remove(at);
            }
        }
        ("add", Value::Set(set), Some(element), _) => add(set, element),
        ("remove", Value::Set(set), Some(element), _) => {
            set.retain(|other| super::value::order(other, &element).is_ne());
        }
        ("remove", Value::Map(map), Some(key), _) => {
            if let Some(at) = find(map, &key) {
                map.remove(at);
            }
        }
        (name, value, ..) => panic!("{name} of {value:?}"),
    }
    Ok(())
}

/// The value from which `+=`, `-=` and `add` start where a key is missing.
fn zero(ty: &Type) -> Value {
    match ty {
        Type::Float => Value::Float(0.0),
        Type::Point => Value::Point(Default::default()),
        Type::String => Value::Text(String::new()),
        Type::Time => Value::Time(0),
        Type::Duration => Value::Duration(0),
        Type::List(_) => Value::List(Vec::new()),
        Type::Set(_) => Value::Set(Vec::new()),
        _ => Value::Int(0),
    }
}

/// A part of a value. A missing key gets the value `start`, if there is one and it is the last step.
fn part<'v>(whole: &'v mut Value, way: &[Way], start: Option<Value>) -> Outcome<&'v mut Value> {
    let Some((step, rest)) = way.split_first() else {
        return Ok(whole);
    };
    let inner = match (step, whole) {
        (Way::Field(number), Value::Record(fields)) => &mut fields[*number],
        (Way::Index(at), Value::List(list)) => {
            let at = index(*at, list.len())?;
            &mut list[at]
        }
        (Way::Key(key), Value::Map(map)) => {
            if find(map, key).is_none() {
                let start = start.clone().filter(|_| rest.is_empty());
                let missing = Stop::Fault(Fault::KeyMissing);
                put(map, key.clone(), start.ok_or(missing)?);
            }
            let at = find(map, key).expect("it is there");
            &mut map[at].1
        }
        (_, whole) => panic!("{whole:?} has no such part"),
    };
    part(inner, rest, start)
}

/// Does something with a part of a value. A coordinate is not a separate value: it is read and written
/// back.
fn with_part<T>(
    whole: &mut Value,
    way: &[Way],
    start: Option<Value>,
    then: impl FnOnce(&mut Value) -> Outcome<T>,
) -> Outcome<T> {
    let Some((Way::Coordinate(axis), before)) = way.split_last() else {
        return then(part(whole, way, start)?);
    };
    let Value::Point(point) = part(whole, before, None)? else {
        panic!("only a point has coordinates")
    };
    let coordinate = match axis {
        0 => &mut point.x,
        1 => &mut point.y,
        _ => &mut point.z,
    };
    let mut value = Value::Float(*coordinate);
    let result = then(&mut value)?;
    if let Value::Float(value) = value {
        *coordinate = value;
    }
    Ok(result)
}
