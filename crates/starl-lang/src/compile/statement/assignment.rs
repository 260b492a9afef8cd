//! Assignments.

use crate::check::Builtin;
use crate::compile::body::{Body, Location, Slot};
use crate::compile::constant::folded;
use crate::compile::expression::arithmetic::Left;
use crate::compile::expression::is_located;
use crate::compile::problem::Compiled;
use crate::compile::statement::way::{Prepared, Way};
use crate::ir::{Expression, ExpressionKind, LocalId, Operator, Place, Root, Step, Type};
use crate::machine::Instruction;
use crate::machine::operand::Short;

impl<'p> Body<'_, 'p> {
    /// `place = value`
    pub fn assign(&mut self, place: &'p Place, value: &'p Expression) -> Compiled {
        if let Some(added) = self.grown(place, value) {
            return self.update(place, Operator::Add, added);
        }
        let mark = self.mark();
        let prepared = self.prepare(place)?;
        match (place.path.last(), prepared.last()) {
            (Some(Step::Key(key)), Some(Prepared::Entry(entry))) => {
                let at = entry.at(self.size(&key.ty));
                self.into(value, at, true)?;
                let (way, _) = self.go(place, &prepared, place.path.len() - 1, false)?;
                self.put_entry(way, *entry)?;
            }
            (Some(Step::Index(_)), Some(Prepared::Index(index))) => {
                let element = self.value(value)?;
                let (mut way, _) = self.go(place, &prepared, place.path.len() - 1, false)?;
                let list = self.container(&mut way)?;
                self.at(place.span, |body| {
                    body.emit(Instruction::ListSet {
                        list,
                        index: *index,
                        scalars: element.block(),
                        objects: element.objects(),
                    });
                });
                self.write_back(way.back)?;
            }
            _ => self.assign_part(place, &prepared, value)?,
        }
        self.release(mark);
        Ok(())
    }

    /// Writes a whole variable, or a field of what is on the way.
    fn assign_part(
        &mut self,
        place: &'p Place,
        prepared: &[Prepared],
        value: &'p Expression,
    ) -> Compiled {
        if let (Root::Local(local), true) = (&place.root, place.path.is_empty()) {
            let slot = self.local(*local)?;
            return self.into(value, slot, false);
        }
        if place.path.is_empty()
            && let Root::OwnElement(id) | Root::Shared(id) = &place.root
        {
            return self.at(place.span, |body| body.write_shared(*id, "write", value));
        }
        // Objects are moved into their place, so they must not be those of another variable.
        let size = self.size(&value.ty);
        let made = if size.objects == 0 {
            self.value(value)?
        } else {
            let made = self.take(size)?;
            self.into(value, made, true)?;
            made
        };
        let (way, ty) = self.go(place, prepared, place.path.len(), false)?;
        self.at(place.span, |body| body.write(way.at, made, ty))?;
        self.write_back(way.back)
    }

    /// Moves a value to where it belongs.
    fn write(&mut self, at: Location, from: Slot, ty: &Type) -> Compiled {
        match at {
            Location::Registers(to) => {
                let size = self.size(ty);
                self.move_value(to, from, size);
                Ok(())
            }
            Location::State(to) => self.store(to, from, ty),
            Location::Other(..) => Err(self.broken()),
        }
    }

    /// The value that `x = x + value` appends to a text or a list, and that `m[k] = (m.get(k) ?? 0) + value` adds.
    fn grown(&self, place: &Place, value: &'p Expression) -> Option<&'p Expression> {
        let ExpressionKind::Binary {
            operator: Operator::Add,
            left,
            right,
        } = &value.kind
        else {
            return None;
        };
        if let [Step::Key(key)] = &place.path[..] {
            let (receiver, argument) = self.counted(left)?;
            let is_same = match (&key.kind, &argument.kind) {
                (ExpressionKind::Local(own), ExpressionKind::Local(other)) => own == other,
                (ExpressionKind::Variable(own), ExpressionKind::Variable(other)) => own == other,
                _ => false,
            };
            return (is_root(&place.root, receiver) && is_same).then_some(right);
        }
        let grows = matches!(value.ty, Type::String | Type::List(_));
        (is_root(&place.root, left) && grows && place.path.is_empty()).then_some(right)
    }

    /// `place += value` and the like.
    pub fn update(
        &mut self,
        place: &'p Place,
        operator: Operator,
        value: &'p Expression,
    ) -> Compiled {
        // A number that is known or in a register or variable can be read before the map.
        if let Some(Step::Key(key)) = place.path.last()
            && (operator, &value.ty) == (Operator::Add, &Type::Int)
            && (is_located(value) || folded(&self.unit.known, value).is_some())
        {
            return self.count(place, key, value);
        }
        let mark = self.mark();
        let prepared = self.prepare(place)?;
        let adds = matches!(operator, Operator::Add | Operator::Subtract);
        let (mut way, ty) = self.go(place, &prepared, place.path.len(), adds)?;
        if matches!(ty, Type::String | Type::List(_)) {
            let is_apart = match (&place.root, place.path.is_empty()) {
                (Root::Local(local), true) => is_apart(value, *local),
                _ => false,
            };
            let object = self.container(&mut way)?;
            self.append(object, value, is_apart)?;
            self.write_back(way.back)?;
            self.release(mark);
            return Ok(());
        }
        match way.at {
            Location::Registers(slot) => {
                self.operate(operator, Left::Value(slot, ty), value, slot, false)?;
            }
            at => {
                let slot = self.value_at(at, ty)?;
                self.operate(operator, Left::Value(slot, ty), value, slot, false)?;
                self.at(place.span, |body| body.write(at, slot, ty))?;
            }
        }
        self.write_back(way.back)?;
        self.release(mark);
        Ok(())
    }

    /// `m[key] += value` with whole numbers.
    fn count(&mut self, place: &'p Place, key: &'p Expression, value: &'p Expression) -> Compiled {
        let mark = self.mark();
        let steps = place.path.len() - 1;
        let prepared = self.prepare_some(place, steps)?;
        let key = self.value(key)?;
        let constant =
            folded(&self.unit.known, value).and_then(|bits| i16::try_from(bits as i64).ok());
        let amount = match constant {
            Some(_) => key,
            None => self.value(value)?,
        };
        let (mut way, _) = self.go(place, &prepared, steps, false)?;
        let kind = self.object_type(way.ty)?;
        let map = self.container(&mut way)?;
        let (scalars, objects) = (key.block(), key.objects());
        self.at(place.span, |body| {
            body.emit(match constant {
                Some(amount) => Instruction::MapAddConstant {
                    map,
                    scalars,
                    objects,
                    amount: Short(amount),
                    kind,
                },
                None => Instruction::MapAdd {
                    map,
                    scalars,
                    objects,
                    amount: amount.input(),
                    kind,
                },
            });
        });
        self.write_back(way.back)?;
        self.release(mark);
        Ok(())
    }

    /// Puts a key and its value into the map that a way has come to.
    fn put_entry(&mut self, mut way: Way<'p>, entry: Slot) -> Compiled {
        let kind = self.object_type(way.ty)?;
        let map = self.container(&mut way)?;
        self.map_put(map, entry, kind);
        self.write_back(way.back)
    }
}

/// Whether this is the variable where a place begins.
fn is_root(root: &Root, expression: &Expression) -> bool {
    match (root, &expression.kind) {
        (Root::Local(local), ExpressionKind::Local(other)) => local == other,
        (Root::Variable(id), ExpressionKind::Variable(other)) => id == other,
        _ => false,
    }
}

/// Whether a value surely does not read a local variable.
fn is_apart(value: &Expression, local: LocalId) -> bool {
    match &value.kind {
        ExpressionKind::Local(other) => *other != local,
        ExpressionKind::String(_)
        | ExpressionKind::Int(_)
        | ExpressionKind::Float(_)
        | ExpressionKind::Variable(_)
        | ExpressionKind::Parameter(_)
        | ExpressionKind::Constant(_) => true,
        ExpressionKind::Binary { left, right, .. } => {
            is_apart(left, local) && is_apart(right, local)
        }
        ExpressionKind::Index { base, index } => is_apart(base, local) && is_apart(index, local),
        ExpressionKind::Field { base, .. } => is_apart(base, local),
        ExpressionKind::Builtin {
            builtin: Builtin::ToString,
            arguments,
            ..
        } => arguments
            .iter()
            .flatten()
            .all(|argument| is_apart(argument, local)),
        _ => false,
    }
}
