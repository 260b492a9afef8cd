//! Declared names as values: where they may be read, and their types.

use alloc::boxed::Box;
use alloc::format;

use super::body::Where;
use super::report::{broken, made};
use super::scope::Entity;
use super::state::{Checker, Needed, Progress};
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::ir::{Consistency, Expression, ExpressionKind, RobotMember, SharedId, Type};

impl Checker {
    /// A declaration, of this file or of a library, as a value.
    pub fn entity_value(&mut self, entity: Entity, name: &str, span: Span) -> Expression {
        self.usage.used.insert(entity);
        match entity {
            Entity::Parameter(id) => self.parameter_value(id, name, span),
            Entity::Constant(id) => {
                self.need(Needed::Constant(id));
                let ty = self.constant_type(id);
                made(ExpressionKind::Constant(id), ty, span)
            }
            Entity::Variable(id) => self.variable_value(id, name, span),
            Entity::Shared(id) => self.shared_value(id, name, span),
            Entity::Broken => broken(span),
            Entity::Enum(id) => {
                let message = format!("`{name}` is an enum, not a value");
                let problem = Diagnostic::new(Code::NoValue, span, message);
                let first = self.program[id].variants.first();
                let form =
                    first.map(|variant| format!("a value is written `{}.{}`", name, variant.name));
                self.refuse(problem.note_if(form))
            }
            Entity::Function(_) | Entity::Record(_) | Entity::Binding(_) | Entity::Library(_) => {
                let message = format!("`{name}` is {}, not a value", entity.what());
                let problem = Diagnostic::new(Code::NoValue, span, message);
                self.refuse(problem.note(match entity {
                    Entity::Function(_) | Entity::Record(_) => format!("call it: `{name}(...)`"),
                    _ => format!("its declarations are named `{name}.something`"),
                }))
            }
        }
    }

    pub fn parameter_value(
        &mut self,
        id: crate::ir::ParameterId,
        name: &str,
        span: Span,
    ) -> Expression {
        match self.body.place {
            Where::Constant | Where::Function => {
                self.state_out_of_reach("read", name, span);
                broken(span)
            }
            Where::Property => {
                // A parameter may differ between robots; where nothing else is said it is that of the
                // robot that the property is about, or that a quantifier named last.
                let Some(robot) = self.body.robot.or_else(|| self.body.quantified()) else {
                    return self.of_no_robot(name, name, span);
                };
                let robot = self.local_value(robot, span);
                self.of_robot(robot, RobotMember::Parameter(id), span)
            }
            _ => {
                let ty = self.program[id].ty.clone();
                made(ExpressionKind::Parameter(id), ty, span)
            }
        }
    }

    /// Notes that what is being checked needs a constant or a function.
    pub fn need(&mut self, needed: Needed) {
        if let Some(user) = self.user {
            self.needs.insert((user, needed));
        }
    }

    pub fn constant_type(&mut self, id: crate::ir::ConstantId) -> Type {
        // Constants are checked in the order of need, so that only one which needs itself is found
        // unchecked here; that is reported when they are ordered.
        if self.constants[id.index()] == Progress::Untouched && self.user.is_none() {
            self.check_constant(id);
        }
        self.program[id].ty.clone()
    }

    pub fn variable_value(
        &mut self,
        id: crate::ir::VariableId,
        name: &str,
        span: Span,
    ) -> Expression {
        let ty = self.program[id].ty.clone();
        let kind = match self.body.place {
            Where::Guard | Where::Effect => ExpressionKind::Variable(id),
            Where::Initial(own) if id < own => ExpressionKind::Variable(id),
            Where::Initial(_) => {
                let message = format!("`{name}` has no value yet");
                let problem = Diagnostic::new(Code::UsedTooEarly, span, message);
                let note = "variables get their initial values in the order of the text";
                return self.refuse(problem.note(note));
            }
            Where::Property => return self.property_variable(id, name, span),
            Where::Constant | Where::Function | Where::Binding => {
                self.state_out_of_reach("read", name, span);
                return broken(span);
            }
        };
        made(kind, ty, span)
    }

    /// In a property a variable is one of a robot.
    pub fn property_variable(
        &mut self,
        id: crate::ir::VariableId,
        name: &str,
        span: Span,
    ) -> Expression {
        if let Some(robot) = self.robot_of_property(span) {
            return self.of_robot(robot, RobotMember::Variable(id), span);
        }
        self.of_no_robot(name, name, span)
    }

    /// Reports what is a robot's, called `member` where the robot is named, under a quantifier.
    pub fn of_no_robot(&mut self, name: &str, member: &str, span: Span) -> Expression {
        let message = format!("`{name}` needs a robot");
        let problem = Diagnostic::new(Code::InvalidProperty, span, message);
        let robot = (self.body.names.last()).map_or("r", |(robot, _)| robot.as_str());
        let meant = format!("{robot}.{member}");
        self.refuse(problem.replace(format!("did you mean `{meant}`?"), span, meant))
    }

    /// The robot that a property without quantifier is about.
    pub fn robot_of_property(&mut self, span: Span) -> Option<Expression> {
        let robot = self.body.robot?;
        Some(self.local_value(robot, span))
    }

    /// The attribute of a robot in a property.
    pub fn of_robot(&self, robot: Expression, member: RobotMember, span: Span) -> Expression {
        let ty = match member {
            RobotMember::Variable(id) => self.program[id].ty.clone(),
            RobotMember::Parameter(id) => self.program[id].ty.clone(),
            RobotMember::Shared(id) => self.shared_type(id),
            RobotMember::Position | RobotMember::Velocity => Type::Point,
            RobotMember::Heading => Type::Float,
            RobotMember::Finished | RobotMember::Up => Type::Bool,
            RobotMember::Id => Type::Robot,
        };
        let robot = Box::new(robot);
        made(ExpressionKind::OfRobot { robot, member }, ty, span)
    }

    /// Reports state where it cannot be seen; `verb` is what was tried: to `read` it, or to `use` it.
    pub fn state_out_of_reach(&mut self, verb: &str, name: &str, span: Span) {
        let what = self.body.place.what();
        let message = format!("{what} cannot {verb} `{name}`");
        let problem = Diagnostic::new(Code::StateOutOfReach, span, message);
        let note = match self.body.place {
            Where::Function => {
                "a function depends on its arguments and on constants; pass the value to it"
            }
            Where::Binding => "it is made of constants, parameters, `me` and `peers`",
            _ => "a constant is the same for all robots and all runs",
        };
        self.report(problem.note(note));
    }

    pub fn shared_value(&mut self, id: SharedId, name: &str, span: Span) -> Expression {
        match self.body.place {
            Where::Guard | Where::Effect => {}
            Where::Property => {
                if self.is_linearizable(id, name, span) {
                    return broken(span);
                }
                return match self.robot_of_property(span) {
                    Some(robot) => self.of_robot(robot, RobotMember::Shared(id), span),
                    None => self.of_no_robot(name, name, span),
                };
            }
            _ => {
                self.state_out_of_reach("read", name, span);
                return broken(span);
            }
        }
        self.body.touched.push((id, span));
        let ty = self.shared_type(id);
        let kind = match self.program[id].is_single_writer {
            true => ExpressionKind::SharedMap(id),
            false => ExpressionKind::Shared(id),
        };
        made(kind, ty, span)
    }

    /// The type that a shared variable has for its readers.
    fn shared_type(&self, id: SharedId) -> Type {
        let ty = self.program[id].ty.clone();
        if self.program[id].is_single_writer {
            Type::map(Type::Robot, ty)
        } else if self.nodes.shared[id.index()].value().is_some() {
            ty
        } else {
            Type::optional(ty)
        }
    }

    /// Whether a shared variable has no copies that a property could read; reports it if so.
    pub fn is_linearizable(&mut self, id: SharedId, name: &str, span: Span) -> bool {
        if self.program[id].consistency != Consistency::Linearizable {
            return false;
        }
        let message = format!("a property cannot read the linearizable variable `{name}`");
        let problem = Diagnostic::new(Code::InvalidProperty, span, message);
        let note = "robots have no copies of it; store what an action reads in a variable";
        self.report(problem.note(note));
        true
    }
}
