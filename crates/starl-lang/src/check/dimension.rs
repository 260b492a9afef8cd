//! Lengths and angles are not added to each other, nor compared.
//!
//! A Float does not tell what it measures. A literal with a unit does, and so do `heading`, `distance` and the like, and
//! names that are declared with such a value. A product or a quotient may measure anything.

use alloc::format;

use super::body::Dimension;
use super::report::article;
use super::scope::Entity;
use super::state::Checker;
use super::tables::Builtin;
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::ir::{Expression, ExpressionKind, Operator, Place, RobotMember, Root, Type};

/// The known facts of a number.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct Measure {
    /// Its dimension, if that is known.
    dimension: Option<Dimension>,
    /// Whether it consists of literals, so that one without a unit has none on purpose.
    is_written: bool,
}

impl Measure {
    const fn of(dimension: Dimension) -> Self {
        Self {
            dimension: Some(dimension),
            is_written: false,
        }
    }

    /// The facts of a value that may be either; none if they contradict each other.
    fn joined(self, other: Self) -> Option<Self> {
        let is_written = self.is_written && other.is_written;
        match (self.dimension, other.dimension) {
            (Some(a), Some(b)) if a != b => None,
            (Some(_), None) | (None, Some(_)) if is_written => None,
            (a, b) => Some(Self {
                dimension: a.or(b),
                is_written,
            }),
        }
    }

    /// The facts of the value multiplied with another.
    fn scaled(self, by: Self) -> Self {
        match by.dimension.is_none() && by.is_written {
            true => self,
            false => Self::default(),
        }
    }

    fn text(self) -> &'static str {
        self.dimension
            .map_or("number without a unit", Dimension::text)
    }
}

impl Checker {
    /// Reports it if two values measure different things, which `sign` joins or compares.
    pub fn check_dimensions(
        &mut self,
        sign: &str,
        left: &Expression,
        right: &Expression,
        span: Span,
    ) {
        let (of_left, of_right) = (self.measure(left), self.measure(right));
        if of_left.joined(of_right).is_some() {
            return;
        }
        let (l, r) = (article(of_left.text()), article(of_right.text()));
        let message = format!("`{sign}` mixes {l} and {r}");
        let problem = Diagnostic::new(Code::MixedDimensions, span, message);
        let problem = problem.label(left.span, l).label(right.span, r);
        let problem = match (of_left.dimension, of_right.dimension) {
            (Some(dimension), None) => self.with_unit(problem, right, dimension),
            (None, Some(dimension)) => self.with_unit(problem, left, dimension),
            _ => problem.note("`x / 1m` is a length as a plain number, `x / 1rad` an angle"),
        };
        self.report(problem);
    }

    /// Reports it if a variable that measures one thing is set to, or changed by, something else.
    pub fn check_assigned_dimension(&mut self, place: &Place, value: &Expression) {
        let declared = self.dimension_of_place(place);
        let assigned = self.measure(value).dimension;
        let (Some(declared), Some(assigned)) = (declared, assigned) else {
            return;
        };
        if declared == assigned {
            return;
        }
        let (a, b) = (article(assigned.text()), article(declared.text()));
        let name = self.text(place.span);
        let message = format!("the value is {a}, and `{name}` is declared as {b}");
        self.report(Diagnostic::new(Code::MixedDimensions, value.span, message));
    }

    /// Notes the dimension of a name that is declared with these values.
    pub fn note_dimension<'a>(
        &mut self,
        entity: Entity,
        values: impl IntoIterator<Item = &'a Expression>,
    ) {
        let dimension = values
            .into_iter()
            .find_map(|value| self.measure(value).dimension);
        if let Some(dimension) = dimension {
            self.dimensions.insert(entity, dimension);
        }
    }

    /// The dimension of a value, if that is known.
    pub fn dimension(&self, value: &Expression) -> Option<Dimension> {
        self.measure(value).dimension
    }

    fn dimension_of_place(&self, place: &Place) -> Option<Dimension> {
        if !place.path.is_empty() {
            return None;
        }
        match place.root {
            Root::Local(local) => self.body.dimensions[local.index()],
            Root::Variable(id) => self.dimension_of(Entity::Variable(id)),
            Root::Shared(id) | Root::OwnElement(id) => self.dimension_of(Entity::Shared(id)),
            Root::Error => None,
        }
    }

    fn dimension_of(&self, entity: Entity) -> Option<Dimension> {
        self.dimensions.get(&entity).copied()
    }

    fn measure(&self, value: &Expression) -> Measure {
        let named = |dimension| Measure {
            dimension,
            is_written: false,
        };
        let either = |a, b| {
            let (a, b) = (self.measure(a), self.measure(b));
            a.joined(b).unwrap_or_default()
        };
        match &value.kind {
            // Zero is zero in every unit.
            ExpressionKind::Float(0.0) => Measure::default(),
            ExpressionKind::Float(_) => Measure {
                dimension: unit_of(self.text(value.span)),
                is_written: true,
            },
            ExpressionKind::Present(inner)
            | ExpressionKind::Unwrap(inner)
            | ExpressionKind::Negate(inner) => self.measure(inner),
            ExpressionKind::Default { optional, default } => either(optional, default),
            ExpressionKind::Conditional {
                then, otherwise, ..
            } => either(then, otherwise),
            ExpressionKind::Local(local) => named(self.body.dimensions[local.index()]),
            ExpressionKind::Parameter(id) => named(self.dimension_of(Entity::Parameter(*id))),
            ExpressionKind::Constant(id) => named(self.dimension_of(Entity::Constant(*id))),
            ExpressionKind::Variable(id) => named(self.dimension_of(Entity::Variable(*id))),
            ExpressionKind::Shared(id) => named(self.dimension_of(Entity::Shared(*id))),
            ExpressionKind::OfRobot { member, .. } => named(match member {
                RobotMember::Heading => Some(Dimension::Angle),
                RobotMember::Variable(id) => self.dimension_of(Entity::Variable(*id)),
                RobotMember::Parameter(id) => self.dimension_of(Entity::Parameter(*id)),
                _ => None,
            }),
            ExpressionKind::Builtin {
                builtin, arguments, ..
            } => match (builtin, &arguments[..]) {
                (Builtin::Heading | Builtin::Bearing | Builtin::Atan2, _) => {
                    Measure::of(Dimension::Angle)
                }
                (Builtin::Distance, _) => Measure::of(Dimension::Length),
                (Builtin::Abs, [Some(x)]) => self.measure(x),
                (Builtin::Min | Builtin::Max, [Some(a), Some(b)])
                | (Builtin::Random, [Some(a), Some(b)])
                | (Builtin::Clamp, [Some(a), Some(b), _]) => either(a, b),
                _ => Measure::default(),
            },
            ExpressionKind::Binary {
                operator,
                left,
                right,
            } if value.ty == Type::Float => match operator {
                Operator::Add | Operator::Subtract => either(left, right),
                Operator::Multiply => {
                    let (left, right) = (self.measure(left), self.measure(right));
                    match left.dimension {
                        Some(_) => left.scaled(right),
                        None => right.scaled(left),
                    }
                }
                Operator::Divide => self.measure(left).scaled(self.measure(right)),
                _ => Measure::default(),
            },
            _ => Measure::default(),
        }
    }

    /// The problem with a fix that gives a number the unit which it lacks.
    fn with_unit(
        &self,
        problem: Diagnostic,
        number: &Expression,
        dimension: Dimension,
    ) -> Diagnostic {
        let unit = dimension.unit();
        if let ExpressionKind::Float(_) = number.kind {
            let meant = format!("{}{unit}", self.text(number.span));
            return problem.write(number.span, meant);
        }
        problem.note(format!("give it a unit: multiply it by `1{unit}`"))
    }
}

/// The digits of a literal, and its unit.
pub(super) fn split_unit(text: &str) -> (&str, &str) {
    let digits = text.trim_end_matches(|last: char| last.is_ascii_alphabetic());
    text.split_at(digits.len())
}

/// The dimension of a literal with this text, by its unit.
fn unit_of(text: &str) -> Option<Dimension> {
    match split_unit(text).1 {
        "mm" | "cm" | "m" | "km" => Some(Dimension::Length),
        "deg" | "rad" => Some(Dimension::Angle),
        _ => None,
    }
}
