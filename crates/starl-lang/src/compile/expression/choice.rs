//! Values that are one of two: conditionals, and optionals with a default.

use crate::compile::body::{Body, Slot};
use crate::compile::expression::is_located;
use crate::compile::problem::Compiled;
use crate::compile::size::Size;
use crate::ir::Expression;

impl<'p> Body<'_, 'p> {
    pub fn conditional(
        &mut self,
        condition: &'p Expression,
        [then, otherwise]: [&'p Expression; 2],
        to: Slot,
        is_fresh: bool,
    ) -> Compiled {
        let (no, end) = (self.label(), self.label());
        self.branch(condition, false, no)?;
        self.into(then, to, is_fresh)?;
        self.jump(end);
        self.place(no);
        self.into(otherwise, to, is_fresh)?;
        self.place(end);
        Ok(())
    }

    pub fn or_default(
        &mut self,
        optional: &'p Expression,
        default: &'p Expression,
        to: Slot,
        is_fresh: bool,
    ) -> Compiled {
        let (no, end) = (self.label(), self.label());
        let mark = self.mark();
        // The default may be an optional again: then the whole of the other is the value.
        let skipped = match optional.ty == default.ty {
            true => Size::NONE,
            false => Size::SCALAR,
        };
        let size = self.size(&default.ty);
        if is_located(optional)
            && let Some(location) = self.locate(optional)?
        {
            let present = self.scalar_at(location)?;
            self.jump_on(present, false, no);
            self.load(to, location.at(skipped), &default.ty);
        } else {
            let value = self.value(optional)?;
            self.jump_on(value, false, no);
            self.move_value(to, value.at(skipped), size);
        }
        self.release(mark);
        self.jump(end);
        self.place(no);
        self.into(default, to, is_fresh)?;
        self.place(end);
        Ok(())
    }
}
