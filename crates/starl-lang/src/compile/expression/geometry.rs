//! Built-in functions of points and areas.

use crate::check::Builtin;
use crate::compile::body::{Body, Slot};
use crate::compile::call::Arguments;
use crate::compile::problem::Compiled;
use crate::compile::size::Size;
use crate::ir::Type;
use crate::machine::operand::Binary;
use crate::machine::{Instruction, operand};

impl<'p> Body<'_, 'p> {
    pub fn geometry(&mut self, builtin: Builtin, arguments: Arguments<'p>, to: Slot) -> Compiled {
        match builtin {
            Builtin::MakePoint => self.make_point(arguments, to),
            Builtin::Distance => {
                let left = self.value(self.given(arguments, 0)?)?.point();
                let right = self.value(self.given(arguments, 1)?)?.point();
                self.emit(Instruction::Distance {
                    to: to.output(),
                    left,
                    right,
                });
                Ok(())
            }
            Builtin::Bearing => self.bearing(arguments, to),
            Builtin::Circle => {
                self.area_type()?;
                let center = self.value(self.given(arguments, 0)?)?.point();
                let radius = self.value(self.given(arguments, 1)?)?.input();
                self.emit(Instruction::Circle {
                    to: to.object_out(),
                    center,
                    radius,
                });
                Ok(())
            }
            Builtin::Polygon => {
                self.area_type()?;
                let corners = self.object(self.given(arguments, 0)?)?;
                self.emit(Instruction::Polygon {
                    to: to.object_out(),
                    corners,
                });
                Ok(())
            }
            _ => Err(self.broken()),
        }
    }

    /// `Point(x, y, z)`
    fn make_point(&mut self, arguments: Arguments<'p>, to: Slot) -> Compiled {
        for axis in 0..3 {
            let at = to.at(Size::new(axis, 0));
            match arguments.get(axis as usize).and_then(Option::as_ref) {
                Some(coordinate) => self.into(coordinate, at, true)?,
                None => self.scalar(at, 0),
            }
        }
        Ok(())
    }

    /// The direction from one point to another.
    fn bearing(&mut self, arguments: Arguments<'p>, to: Slot) -> Compiled {
        let from = self.value(self.given(arguments, 0)?)?.point();
        let at = self.value(self.given(arguments, 1)?)?.point();
        let way = self.take(Size::new(3, 0))?;
        self.emit(Instruction::SubtractPoint {
            to: way.point_out(),
            left: at,
            right: from,
        });
        self.emit(Instruction::Binary {
            to: to.output(),
            left: way.at(Size::SCALAR).input(),
            right: way.input(),
            function: Binary::ArcTangent,
        });
        Ok(())
    }

    /// Areas have to be among the program's types where one is made.
    fn area_type(&mut self) -> Compiled<operand::Type> {
        self.object_type(&Type::Area)
    }
}
