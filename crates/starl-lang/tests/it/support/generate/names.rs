//! The readable names in a scope, and the values reachable from them, by type.

use super::Generator;
use super::model::{Place, Type};

impl Generator<'_> {
    /// The readable expressions of this type.
    pub(super) fn readable(&self, ty: &Type) -> Vec<String> {
        let mut found = Vec::new();
        self.visit(&mut |name, of| {
            if of == ty {
                found.push(name.to_string());
            }
        });
        found
    }

    /// Everything that can be read here, with its type.
    pub(super) fn all_readable(&self) -> Vec<(String, Type)> {
        let mut found = Vec::new();
        self.visit(&mut |name, of| found.push((name.to_string(), of.clone())));
        found
    }

    fn visit(&self, found: &mut dyn FnMut(&str, &Type)) {
        let (place, model) = (self.place, &self.model);
        for local in &self.locals {
            found(&local.name, &local.ty);
            if place.is_property() && local.ty == Type::Robot {
                self.of_robot(&local.name, found);
            }
        }
        for constant in &model.constants {
            found(&constant.name, &constant.ty);
        }
        let sees_parameters = place.sees_variables() || place.is_property() && self.robot_is_last();
        if sees_parameters {
            model
                .parameters
                .iter()
                .for_each(|one| found(&one.name, &one.ty));
        }
        if place.sees_variables() {
            model
                .variables
                .iter()
                .for_each(|one| found(&one.name, &one.ty));
            if let Some(roles) = model.roles {
                found("role", &Type::Enum(roles));
            }
        }
        if place == Place::Property(true) {
            for (name, ty) in [
                ("position", Type::Point),
                ("(heading / 1rad)", Type::Float),
                ("finished", Type::Bool),
                ("up", Type::Bool),
                ("me", Type::Robot),
            ] {
                found(name, &ty);
            }
        }
        if place.asks() {
            self.asked(found);
        }
        if place.sees_shared() || place == Place::Property(true) {
            self.shared_names("", "me", found);
        }
        if place.sees_shared() {
            self.flags(found);
        }
    }

    /// Whether the innermost local is a robot, which a property needs to read a parameter.
    fn robot_is_last(&self) -> bool {
        self.locals
            .last()
            .is_some_and(|local| local.ty == Type::Robot)
    }

    /// The attributes of a robot in a property.
    fn of_robot(&self, robot: &str, found: &mut dyn FnMut(&str, &Type)) {
        for variable in &self.model.variables {
            found(&format!("{robot}.{}", variable.name), &variable.ty);
        }
        self.shared_names(&format!("{robot}."), robot, found);
        for (name, ty) in [
            ("position", Type::Point),
            ("finished", Type::Bool),
            ("up", Type::Bool),
            ("id", Type::Robot),
        ] {
            found(&format!("{robot}.{name}"), &ty);
        }
        found(&format!("({robot}.heading / 1rad)"), &Type::Float);
    }

    /// Built-in names that ask the robot.
    fn asked(&self, found: &mut dyn FnMut(&str, &Type)) {
        for (name, ty) in [
            ("me", Type::Robot),
            ("position", Type::Point),
            ("(heading / 1rad)", Type::Float),
            ("velocity", Type::Point),
            ("now", Type::Time),
            ("peers", Type::set(Type::Robot)),
            ("bumped", Type::optional(Type::Enum(0))),
            ("ranges", Type::list(Type::Float)),
            ("detected", Type::list(Type::Record(0))),
            ("way_points()", Type::list(Type::Point)),
            ("obstacles()", Type::Obstacles),
        ] {
            found(name, &ty);
        }
    }

    /// Shared variables, in a property those of the robot that the prefix names.
    fn shared_names(&self, prefix: &str, owner: &str, found: &mut dyn FnMut(&str, &Type)) {
        for shared in &self.model.shared {
            let (name, ty) = (format!("{prefix}{}", shared.name), shared.ty.clone());
            if shared.is_single_writer {
                found(&format!("{name}[{owner}]"), &Type::optional(ty.clone()));
                found(&name, &Type::map(Type::Robot, ty));
            } else if shared.has_initial {
                found(&name, &ty);
            } else {
                found(&name, &Type::optional(ty));
            }
        }
    }

    /// The flags of primitives.
    fn flags(&self, found: &mut dyn FnMut(&str, &Type)) {
        for binding in &self.model.bindings {
            if binding.kind == "ReachAvoid" {
                for flag in ["active", "done", "failed"] {
                    found(&format!("{}.{flag}", binding.name), &Type::Bool);
                }
            }
        }
    }
}
