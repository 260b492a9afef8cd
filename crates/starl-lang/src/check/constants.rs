//! The order of constants, and constants that need themselves.

use alloc::collections::BTreeSet;
use alloc::format;
use alloc::vec::Vec;

use super::scope::Entity;
use super::state::{Checker, Needed};
use crate::diagnostic::{Code, Diagnostic};
use crate::ir::ConstantId;
use crate::syntax::ast::{self, AstNode};

impl Checker {
    /// Orders the constants so that each follows those that its value needs, also through functions. A constant that
    /// needs itself is reported.
    pub fn order_constants(&mut self) {
        let mut sizes = Vec::new();
        for number in 0..self.program.constants.len() {
            let id = ConstantId(number as u32);
            let needed = self.all_needed(Needed::Constant(id));
            if needed.contains(&Needed::Constant(id)) {
                self.report_cycle(id);
            }
            let constants = needed
                .iter()
                .filter(|one| matches!(one, Needed::Constant(_)));
            sizes.push((constants.count(), id));
        }
        // Whatever a constant needs needs fewer constants than it does, unless they need each other.
        sizes.sort_unstable();
        self.program.constant_order = sizes.into_iter().map(|(_, id)| id).collect();
    }

    /// All constants, each after those that its value names, where that is possible: so that checking one
    /// finds the types of the others known.
    pub fn constants_by_need(&self) -> Vec<ConstantId> {
        let mut order = Vec::new();
        let mut seen = BTreeSet::new();
        for number in 0..self.nodes.constants.len() {
            // The stack of pending constants; the flag says whether the constants that it names are done.
            let mut open = Vec::from([(ConstantId(number as u32), false)]);
            while let Some((id, is_ready)) = open.pop() {
                if is_ready {
                    order.push(id);
                } else if seen.insert(id) {
                    open.push((id, true));
                    open.extend(self.constants_named(id).map(|named| (named, false)));
                }
            }
        }
        order
    }

    /// The constants that the text of a constant's value names.
    fn constants_named(&self, id: ConstantId) -> impl Iterator<Item = ConstantId> + use<'_> {
        let (file, node) = &self.nodes.constants[id.index()];
        let value = node.value().map(|value| value.syntax().clone());
        let nodes = value.into_iter().flat_map(|value| value.descendants());
        nodes.filter_map(|node| {
            let (file, word) = match ast::Expression::cast(node)? {
                ast::Expression::Name(name) => (*file, name.token()?),
                ast::Expression::Field(field) => {
                    let ast::Expression::Name(library) = field.base()? else {
                        return None;
                    };
                    let imports = &self.files[*file as usize].imports;
                    (*imports.get(&library.text())?, field.field()?)
                }
                _ => return None,
            };
            match self.declared(file, word.text())? {
                Entity::Constant(id) => Some(id),
                _ => None,
            }
        })
    }

    /// Everything that something needs, through others too.
    fn all_needed(&self, user: Needed) -> BTreeSet<Needed> {
        let mut found = BTreeSet::new();
        let mut open = Vec::from([user]);
        while let Some(user) = open.pop() {
            let least = Needed::Constant(ConstantId(0));
            for (of, needed) in self.needs.range((user, least)..) {
                if *of != user {
                    break;
                }
                if found.insert(*needed) {
                    open.push(*needed);
                }
            }
        }
        found
    }

    fn report_cycle(&mut self, id: ConstantId) {
        let constant = &self.program[id];
        self.file = constant.site.file;
        let message = format!("the value of `{}` depends on itself", constant.name);
        let problem = Diagnostic::new(Code::ConstantCycle, constant.site.span, message);
        self.report(problem);
        self.file = 0;
    }
}
