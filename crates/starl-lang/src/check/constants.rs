//! The order of constants, and constants that need themselves.

use alloc::collections::BTreeSet;
use alloc::format;
use alloc::vec::Vec;

use super::state::{Checker, Needed};
use crate::diagnostic::{Code, Diagnostic};
use crate::ir::ConstantId;

impl Checker {
    /// Orders the constants so that each comes after those that its value needs, by way of functions
    /// too. One that needs itself is reported.
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

    /// All that something needs, by way of others too.
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
        let message = format!("the value of `{}` needs itself", constant.name);
        let problem = Diagnostic::new(Code::ConstantCycle, constant.site.span, message);
        self.report(problem);
        self.file = 0;
    }
}
