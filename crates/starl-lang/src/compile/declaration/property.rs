//! Properties: functions from robots to Bools, and how they are claimed.

use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;

use crate::compile::body::Body;
use crate::compile::computed::computed;
use crate::compile::problem::{Compiled, Problem};
use crate::compile::unit::{Finished, Unit};
use crate::ir::{Claim, Expression, Property};
use crate::machine::{FunctionKind, Type};
use crate::{diagnostic, machine};

impl<'p> Unit<'p> {
    /// Compiles a property; its functions are defined.
    pub fn property(
        &mut self,
        property: &'p Property,
        name: String,
    ) -> Compiled<machine::Property> {
        let Ok(robots) = u8::try_from(property.robots.len()) else {
            let message = "a property can be about 255 robots at most";
            let site = property.site;
            let code = diagnostic::Code::TooMuch;
            return Err(Problem::new(code, site.file, site.span, message));
        };
        let claim = match &property.claim {
            Claim::Always(holds) => machine::Claim::Always(self.holds(property, holds, &name)?),
            Claim::Eventually { holds, within } => machine::Claim::Eventually {
                holds: self.holds(property, holds, &name)?,
                within: self.deadline(property, within.as_ref())?,
            },
            Claim::EventuallyAlways { holds, within } => machine::Claim::EventuallyAlways {
                holds: self.holds(property, holds, &name)?,
                within: self.deadline(property, within.as_ref())?,
            },
            Claim::LeadsTo {
                cause,
                consequence,
                within,
            } => machine::Claim::LeadsTo {
                cause: self.holds(property, cause, &format!("{name}.cause"))?,
                consequence: self.holds(property, consequence, &format!("{name}.consequence"))?,
                within: self.deadline(property, within.as_ref())?,
            },
        };
        let assumption = match &property.assumption {
            Some(condition) => {
                Some(self.holds(property, condition, &format!("{name}.assumption"))?)
            }
            None => None,
        };
        let recovery = self.deadline(property, property.recovery.as_ref())?;
        Ok(machine::Property {
            assumption,
            recovery,
            is_despite_crashes: property.is_despite_crashes,
            name,
            claim,
            robots,
        })
    }

    /// The function that says whether a condition holds; gives its number.
    fn holds(
        &mut self,
        property: &'p Property,
        condition: &'p Expression,
        name: &str,
    ) -> Compiled<u32> {
        let number = self.reserve();
        let function = self.condition(property, condition, name)?;
        self.define(number, Ok(function));
        Ok(number)
    }

    fn condition(
        &mut self,
        property: &'p Property,
        condition: &'p Expression,
        name: &str,
    ) -> Compiled<Finished> {
        let kind = FunctionKind::Property;
        let mut body = Body::new(self, kind, &property.locals, property.site);
        let mut arguments = Vec::new();
        for robot in &property.robots {
            body.declare(*robot)?;
            arguments.push(Type::Robot);
        }
        let result = body.machine_type(&condition.ty)?;
        body.reserve(&condition.ty)?;
        body.give(Some(condition))?;
        Ok(body.finish(name, arguments, Vec::from([result])))
    }

    /// The nanoseconds of a deadline.
    fn deadline(
        &mut self,
        property: &'p Property,
        within: Option<&'p Expression>,
    ) -> Compiled<Option<u64>> {
        let Some(within) = within else {
            return Ok(None);
        };
        computed(self, within, &property.locals, property.site).map(Some)
    }
}
