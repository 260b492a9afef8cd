//! `forall` and `exists`: loops over all robots or over a collection.

use crate::compile::body::{Body, Slot};
use crate::compile::code::Label;
use crate::compile::problem::Compiled;
use crate::compile::size::Size;
use crate::ir::{Expression, LocalId, RobotMember};

impl<'p> Body<'_, 'p> {
    /// `forall` or `exists`: a loop over the robots for each local.
    pub fn branch_quantifier(
        &mut self,
        is_universal: bool,
        robots: &'p [LocalId],
        condition: &'p Expression,
        when: bool,
        label: Label,
    ) -> Compiled {
        self.branch_decided(is_universal, when, label, |body, decided| {
            let mark = body.mark();
            let all = body.take(Size::OBJECT)?;
            body.all_robots(all)?;
            body.for_robots(all, robots, condition, !is_universal, decided)?;
            body.release(mark);
            Ok(())
        })
    }

    /// Goes to the label if a quantifier is `when`. `search` is its loop, which goes to the label that it is given as soon as
    /// an element decides.
    pub fn branch_decided(
        &mut self,
        is_universal: bool,
        when: bool,
        label: Label,
        search: impl FnOnce(&mut Self, Label) -> Compiled,
    ) -> Compiled {
        if is_universal != when {
            return search(self, label);
        }
        let decided = self.label();
        search(self, decided)?;
        self.jump(label);
        self.place(decided);
        Ok(())
    }

    fn for_robots(
        &mut self,
        all: Slot,
        robots: &'p [LocalId],
        condition: &'p Expression,
        when: bool,
        decided: Label,
    ) -> Compiled {
        let Some((first, rest)) = robots.split_first() else {
            return self.branch(condition, when, decided);
        };
        let mark = self.mark();
        let robot = self.declare(*first)?;
        self.run_over(all.object_in(), Some(robot), |body| {
            body.for_robots(all, rest, condition, when, decided)
        })?;
        self.release(mark);
        Ok(())
    }

    pub fn of_robot(
        &mut self,
        robot: &'p Expression,
        member: RobotMember,
        to: Slot,
        ty: &'p crate::ir::Type,
        is_fresh: bool,
    ) -> Compiled {
        let name = match member {
            RobotMember::Position => "robot.position",
            RobotMember::Heading => "robot.heading",
            RobotMember::Velocity => "robot.velocity",
            RobotMember::Finished => "robot.finished",
            RobotMember::Up => "robot.up",
            RobotMember::Id => return self.into(robot, to, is_fresh),
            RobotMember::Shared(id) if self.unit.program[id].is_single_writer => {
                return self.shared_map(id, Some(robot), to, ty, is_fresh);
            }
            RobotMember::Shared(id) => return self.shared(id, Some(robot), to, ty, is_fresh),
            RobotMember::Variable(_) | RobotMember::Parameter(_) => return Err(self.broken()),
        };
        self.ask(name, &[robot], to, ty, is_fresh)
    }
}
