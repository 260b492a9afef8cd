//! `some x = optional` in a condition.

use crate::compile::body::Body;
use crate::compile::code::Label;
use crate::compile::expression::is_located;
use crate::compile::problem::Compiled;
use crate::compile::size::Size;
use crate::ir::{Expression, LocalId};

impl<'p> Body<'_, 'p> {
    /// `some local = value`
    pub fn branch_bind(
        &mut self,
        local: LocalId,
        value: &'p Expression,
        when: bool,
        label: Label,
    ) -> Compiled {
        let absent = match when {
            true => self.label(),
            false => label,
        };
        let ty = &self.declared[local.index()].ty;
        let size = self.size(ty);
        // A local that already has its place is passed from a guard to its effect.
        let reserved = self.bound(local);
        if is_located(value) {
            let slot = match reserved {
                Some(slot) => slot,
                None => self.declare(local)?,
            };
            let mark = self.mark();
            if let Some(location) = self.locate(value)? {
                self.branch_location(location, false, absent)?;
                self.load(slot, location.at(Size::SCALAR), ty);
            }
            self.release(mark);
        } else {
            let mark = self.mark();
            let optional = self.take(Size::SCALAR.plus(size))?;
            self.into(value, optional, true)?;
            self.jump_on(optional, false, absent);
            match reserved {
                Some(slot) => {
                    self.move_value(slot, optional.at(Size::SCALAR), size);
                    self.release(mark);
                }
                None => self.bind(local, optional.at(Size::SCALAR)),
            }
        }
        if when {
            self.jump(label);
            self.place(absent);
        }
        Ok(())
    }
}
