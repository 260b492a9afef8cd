//! Where a value is that need not be computed: a variable, or a part of one.
//!
//! An expression changes no variable, so that a variable may be read as late as where it is needed.

use crate::compile::body::{Body, Slot};
use crate::compile::problem::Compiled;
use crate::compile::size::Size;
use crate::compile::types::Part;
use crate::ir;
use crate::ir::{Expression, ExpressionKind, RobotMember};
use crate::machine::Instruction;
use crate::machine::operand::{
    FIRST_STATE_OPERAND, In, ObjectIn, ObjectOut, ObjectSlot, Slot as StateSlot,
};

/// A place where a value is.
#[derive(Clone, Copy, Debug)]
pub(in crate::compile) enum Location {
    /// In registers.
    Registers(Slot),
    /// In the state, from this scalar and object on.
    State(Size),
    /// In the state of the robot in this register.
    Other(In, Size),
}

impl Location {
    /// The part that begins so far into it.
    pub fn at(self, offset: Size) -> Self {
        match self {
            Self::Registers(slot) => Self::Registers(slot.at(offset)),
            Self::State(start) => Self::State(start.plus(offset)),
            Self::Other(robot, start) => Self::Other(robot, start.plus(offset)),
        }
    }
}

/// The operand for an object of the state, if there is one.
pub(in crate::compile) fn state_operand(object: u32) -> Option<u8> {
    let operand = object.checked_add(u32::from(FIRST_STATE_OPERAND))?;
    u8::try_from(operand).ok()
}

impl<'p> Body<'_, 'p> {
    /// The location of the value, if it is stored. The operand of `!` must be there.
    pub fn locate(&mut self, expression: &'p Expression) -> Compiled<Option<Location>> {
        Ok(match &expression.kind {
            ExpressionKind::Local(local) => Some(Location::Registers(self.local(*local)?)),
            ExpressionKind::Variable(id) => Some(Location::State(self.unit.variable(*id))),
            ExpressionKind::Parameter(id) => Some(Location::State(self.unit.parameter(*id))),
            ExpressionKind::Field { base, field } => {
                let offset = self.field_offset(&base.ty, *field);
                self.locate(base)?.map(|location| location.at(offset))
            }
            ExpressionKind::Coordinate { base, axis } => {
                let offset = Size::new(u32::from(*axis), 0);
                self.locate(base)?.map(|location| location.at(offset))
            }
            ExpressionKind::OfRobot { robot, member } => {
                let start = match member {
                    RobotMember::Variable(id) => self.unit.variable(*id),
                    RobotMember::Parameter(id) => self.unit.parameter(*id),
                    RobotMember::Id => return self.locate(robot),
                    _ => return Ok(None),
                };
                let robot = self.value(robot)?;
                Some(Location::Other(robot.input(), start))
            }
            ExpressionKind::Unwrap(optional) => {
                let Some(location) = self.locate(optional)? else {
                    return Ok(None);
                };
                self.at(expression.span, |body| body.require(location))?;
                Some(location.at(Size::SCALAR))
            }
            _ => None,
        })
    }

    /// Where a field begins in its record.
    pub fn field_offset(&self, record: &ir::Type, field: u32) -> Size {
        match record {
            ir::Type::Record(id) => self.unit.types.offset(*id, field),
            _ => Size::NONE,
        }
    }

    /// Stops the program unless the optional has a value.
    pub fn require(&mut self, optional: Location) -> Compiled {
        let mark = self.mark();
        let present = self.scalar_at(optional)?;
        self.emit(Instruction::Require {
            present: present.input(),
        });
        self.release(mark);
        Ok(())
    }

    /// The scalar at a location, in a register.
    pub fn scalar_at(&mut self, location: Location) -> Compiled<Slot> {
        if let Location::Registers(slot) = location {
            return Ok(slot);
        }
        let slot = self.take(Size::SCALAR)?;
        self.load_scalars(slot, location, 1);
        Ok(slot)
    }

    /// The value at a location, in registers.
    pub fn value_at(&mut self, location: Location, ty: &ir::Type) -> Compiled<Slot> {
        if let Location::Registers(slot) = location {
            return Ok(slot);
        }
        let slot = self.take_for(ty)?;
        self.load(slot, location, ty);
        Ok(slot)
    }

    /// Copies the value at a location to registers.
    pub fn load(&mut self, to: Slot, location: Location, ty: &ir::Type) {
        let size = self.size(ty);
        match location {
            Location::Registers(from) => self.copy(to, from, size),
            _ => {
                self.load_scalars(to, location, size.scalars);
                for object in 0..size.objects {
                    let offset = Size::new(0, object);
                    self.load_object(to.at(offset), location.at(offset));
                }
            }
        }
    }

    fn load_scalars(&mut self, to: Slot, location: Location, count: u32) {
        let mut done = 0;
        while done < count {
            let step = if count - done >= 3 { 3 } else { 1 };
            let offset = Size::new(done, 0);
            self.load_few(to.at(offset), location.at(offset), step == 3);
            done += step;
        }
    }

    /// Loads three scalars, or one.
    fn load_few(&mut self, to: Slot, location: Location, are_three: bool) {
        let instruction = match (location, are_three) {
            (Location::Registers(from), true) => Instruction::CopyPoint {
                to: to.point_out(),
                from: from.point(),
            },
            (Location::Registers(from), false) => Instruction::Copy {
                to: to.output(),
                from: from.input(),
            },
            (Location::State(start), true) => Instruction::LoadPoint {
                to: to.point_out(),
                variable: StateSlot(start.scalars),
            },
            (Location::State(start), false) => Instruction::Load {
                to: to.output(),
                variable: StateSlot(start.scalars),
            },
            (Location::Other(robot, start), true) => Instruction::LoadOtherPoint {
                to: to.point_out(),
                robot,
                variable: StateSlot(start.scalars),
            },
            (Location::Other(robot, start), false) => Instruction::LoadOther {
                to: to.output(),
                robot,
                variable: StateSlot(start.scalars),
            },
        };
        self.emit(instruction);
    }

    fn load_object(&mut self, to: Slot, location: Location) {
        let to = to.object_out();
        let instruction = match location {
            Location::Registers(from) => Instruction::CopyObject {
                to,
                from: from.object_in(),
            },
            Location::State(start) => match state_operand(start.objects) {
                Some(operand) => Instruction::CopyObject {
                    to,
                    from: ObjectIn(operand),
                },
                None => Instruction::LoadObject {
                    to,
                    variable: ObjectSlot(start.objects),
                },
            },
            Location::Other(robot, start) => Instruction::LoadOtherObject {
                to,
                robot,
                variable: ObjectSlot(start.objects),
            },
        };
        self.emit(instruction);
    }

    /// The operand for the object at a location; it is loaded if there is none.
    pub fn object_at(&mut self, location: Location) -> Compiled<ObjectIn> {
        if let Location::Registers(slot) = location {
            return Ok(slot.object_in());
        }
        if let Location::State(start) = location
            && let Some(operand) = state_operand(start.objects)
        {
            return Ok(ObjectIn(operand));
        }
        let slot = self.take(Size::OBJECT)?;
        self.load_object(slot, location);
        Ok(slot.object_in())
    }

    /// Moves a value from registers into the state.
    pub fn store(&mut self, to: Size, from: Slot, ty: &ir::Type) -> Compiled {
        let size = self.size(ty);
        let mut done = 0;
        while done < size.scalars {
            let offset = Size::new(done, 0);
            let (from, variable) = (from.at(offset), StateSlot(to.scalars + done));
            if size.scalars - done >= 3 {
                let from = from.point();
                self.emit(Instruction::StorePoint { variable, from });
                done += 3;
            } else {
                let from = from.input();
                self.emit(Instruction::Store { variable, from });
                done += 1;
            }
        }
        for object in 0..size.objects {
            let from = from.at(Size::new(0, object)).object_in_out();
            let place = to.objects + object;
            self.emit(match state_operand(place) {
                Some(operand) => Instruction::MoveObject {
                    to: ObjectOut(operand),
                    from,
                },
                None => Instruction::StoreObject {
                    variable: ObjectSlot(place),
                    from,
                },
            });
        }
        Ok(())
    }

    /// The parts of a value that is compared, at a location.
    pub fn part_offset(part: Part) -> Size {
        match part {
            Part::Scalar(at) | Part::Float(at) | Part::Point(at) => Size::new(at, 0),
            Part::Object(at, _) => Size::new(0, at),
        }
    }
}
