//! Built-in functions and names: pure ones are instructions, the others ask or tell the host.

use alloc::string::String;
use alloc::vec::Vec;

use crate::check::{Builtin, Purity};
use crate::compile::body::{Body, Slot};
use crate::compile::call::{Argument, Arguments, HostFunction};
use crate::compile::problem::Compiled;
use crate::compile::size::Size;
use crate::ir::{Expression, Type};
use crate::machine::operand::{Binary, Rounding, Unary};
use crate::machine::{Instruction, operand};

/// Further arguments, with their names if they have names.
type Rest = [(Option<String>, Expression)];

impl<'p> Body<'_, 'p> {
    /// The value of a built-in function or name.
    pub fn builtin(
        &mut self,
        expression: &'p Expression,
        builtin: Builtin,
        arguments: Arguments<'p>,
        rest: &'p Rest,
        to: Slot,
        is_fresh: bool,
    ) -> Compiled {
        let ty = &expression.ty;
        if builtin == Builtin::Log {
            return self.log(arguments, rest);
        }
        if builtin == Builtin::Choose {
            return self.choose(self.given(arguments, 0)?, ty, to);
        }
        if builtin.purity() != Purity::Pure {
            return self.robot(builtin, arguments, rest, ty, to, is_fresh);
        }
        match builtin {
            Builtin::Abs | Builtin::Min | Builtin::Max | Builtin::Clamp => {
                self.extreme(builtin, arguments, to)
            }
            Builtin::ToString => self.text_of(self.given(arguments, 0)?, to),
            Builtin::ToFloat => {
                let from = self.value(self.given(arguments, 0)?)?.input();
                self.emit(Instruction::FloatOfInt {
                    to: to.output(),
                    from,
                });
                Ok(())
            }
            Builtin::ToInt => match self.given(arguments, 0)? {
                robot if robot.ty == Type::Robot => self.into(robot, to, is_fresh),
                _ => self.rounded(arguments, Rounding::Truncate, to),
            },
            Builtin::Round => self.rounded(arguments, Rounding::Nearest, to),
            Builtin::Floor => self.rounded(arguments, Rounding::Floor, to),
            Builtin::Ceil => self.rounded(arguments, Rounding::Ceiling, to),
            Builtin::Sqrt => self.unary(arguments, Unary::SquareRoot, to),
            Builtin::Sin => self.unary(arguments, Unary::Sine, to),
            Builtin::Cos => self.unary(arguments, Unary::Cosine, to),
            Builtin::Tan => self.unary(arguments, Unary::Tangent, to),
            Builtin::Exp => self.unary(arguments, Unary::Exponential, to),
            Builtin::LogE => self.unary(arguments, Unary::Logarithm, to),
            Builtin::Atan2 => self.binary(arguments, Binary::ArcTangent, to),
            Builtin::Pow => self.binary(arguments, Binary::Power, to),
            _ => self.geometry(builtin, arguments, to),
        }
    }

    /// An argument that is always there.
    pub fn given(&self, arguments: Arguments<'p>, index: usize) -> Compiled<&'p Expression> {
        let argument = arguments.get(index).and_then(Option::as_ref);
        argument.ok_or_else(|| self.broken())
    }

    /// A call to the host.
    fn robot(
        &mut self,
        builtin: Builtin,
        arguments: Arguments<'p>,
        rest: &'p Rest,
        ty: &Type,
        to: Slot,
        is_fresh: bool,
    ) -> Compiled {
        let mut values = self.arguments(&builtin.signature(), arguments)?;
        values.extend(rest.iter().map(|(_, value)| Argument::Value(value)));
        let labels = rest.iter().filter_map(|(name, _)| name.clone());
        let import = HostFunction {
            labels: labels.collect(),
            ..match builtin.purity() {
                Purity::Effect => HostFunction::effect(builtin.name()),
                _ => HostFunction::query(builtin.name()),
            }
        };
        self.host(import, &values, ty, to, is_fresh)
    }

    fn unary(&mut self, arguments: Arguments<'p>, function: Unary, to: Slot) -> Compiled {
        let from = self.value(self.given(arguments, 0)?)?.input();
        let to = to.output();
        self.emit(Instruction::Unary { to, from, function });
        Ok(())
    }

    fn binary(&mut self, arguments: Arguments<'p>, function: Binary, to: Slot) -> Compiled {
        let left = self.value(self.given(arguments, 0)?)?.input();
        let right = self.value(self.given(arguments, 1)?)?.input();
        self.emit(Instruction::Binary {
            to: to.output(),
            left,
            right,
            function,
        });
        Ok(())
    }

    fn rounded(&mut self, arguments: Arguments<'p>, rounding: Rounding, to: Slot) -> Compiled {
        let from = self.value(self.given(arguments, 0)?)?.input();
        self.emit(Instruction::IntOfFloat {
            to: to.output(),
            from,
            rounding,
        });
        Ok(())
    }

    fn extreme(&mut self, builtin: Builtin, arguments: Arguments<'p>, to: Slot) -> Compiled {
        let first = self.given(arguments, 0)?;
        if let Type::Record(_) = first.ty {
            return self.extreme_tuple(builtin, arguments, to);
        }
        let is_float = first.ty == Type::Float;
        let left = self.value(first)?;
        let (output, from) = (to.output(), left.input());
        match builtin {
            Builtin::Abs => self.emit(match is_float {
                true => Instruction::AbsoluteFloat { to: output, from },
                false => Instruction::AbsoluteInt { to: output, from },
            }),
            Builtin::Clamp => {
                let low = self.value(self.given(arguments, 1)?)?;
                let high = self.value(self.given(arguments, 2)?)?;
                self.emit(lesser_or_greater(is_float, true, output, [left, low]));
                self.emit(lesser_or_greater(is_float, false, output, [to, high]));
            }
            _ => {
                let right = self.value(self.given(arguments, 1)?)?;
                let is_greater = builtin == Builtin::Max;
                self.emit(lesser_or_greater(
                    is_float,
                    is_greater,
                    output,
                    [left, right],
                ));
            }
        }
        Ok(())
    }

    /// `min`, `max` or `clamp` of tuples.
    fn extreme_tuple(&mut self, builtin: Builtin, arguments: Arguments<'p>, to: Slot) -> Compiled {
        let first = self.given(arguments, 0)?;
        let (parts, size) = (self.parts(&first.ty)?, self.size(&first.ty));
        let best = self.take(size)?;
        self.into(first, best, true)?;
        let others = arguments.iter().flatten().skip(1);
        let others: Vec<Slot> = others
            .map(|other| self.value(other))
            .collect::<Compiled<_>>()?;
        for (index, other) in others.into_iter().enumerate() {
            let is_greater = builtin == Builtin::Max || builtin == Builtin::Clamp && index == 0;
            let sides = if is_greater {
                [best, other]
            } else {
                [other, best]
            };
            let keep = self.label();
            self.branch_parts_order(&parts, sides, false, false, keep)?;
            self.copy(best, other, size);
            self.place(keep);
        }
        self.move_value(to, best, size);
        Ok(())
    }

    /// A random element of a list.
    fn choose(&mut self, list: &'p Expression, ty: &Type, to: Slot) -> Compiled {
        let from = self.object(list)?;
        let size = self.object_size(from)?;
        self.element_or_none(from, size, &list.ty, ty, to, |body, index| {
            let first = body.take(Size::new(2, 0))?;
            body.scalar(first, 0);
            body.copy(first.at(Size::SCALAR), size, Size::SCALAR);
            body.random_int(first)?;
            body.copy(index, first, Size::SCALAR);
            Ok(())
        })
    }

    /// Replaces the two Ints in a row by a random one from the first to before the second.
    fn random_int(&mut self, bounds: Slot) -> Compiled {
        use crate::machine::{Import, Type};
        let import = Import {
            name: Builtin::RandomInt.name().into(),
            query: false,
            labels: Vec::new(),
            arguments: Vec::from([Type::Int, Type::Int]),
            results: Vec::from([Type::Int]),
        };
        self.call_host(import, bounds);
        Ok(())
    }
}

fn lesser_or_greater(
    is_float: bool,
    is_greater: bool,
    to: operand::Out,
    [left, right]: [Slot; 2],
) -> Instruction {
    let (left, right) = (left.input(), right.input());
    match (is_float, is_greater) {
        (true, true) => Instruction::MaximumFloat { to, left, right },
        (true, false) => Instruction::MinimumFloat { to, left, right },
        (false, true) => Instruction::MaximumInt { to, left, right },
        (false, false) => Instruction::MinimumInt { to, left, right },
    }
}
