//! The behaviour of generated programs: `init`, actions, handlers, roles and properties.

use super::Generator;
use super::model::{Enum, Place, Type};

impl Generator<'_> {
    pub(super) fn init(&mut self) {
        self.place = Place::Effect;
        self.line("init");
        self.block(2);
    }

    pub(super) fn actions(&mut self, prefix: &str) {
        for number in 0..self.choices.below(4) {
            self.line(&format!("{prefix}{number}()"));
            self.level += 1;
            self.place = Place::Guard;
            if self.choices.below(4) > 0 {
                let guard = self.guard();
                self.line(&guard);
            }
            self.place = Place::Effect;
            self.is_action = true;
            self.line("eff");
            self.block(3);
            self.is_action = false;
            self.locals.clear();
            self.level -= 1;
        }
    }

    pub(super) fn handlers(&mut self) {
        let records = self.model.records.iter().enumerate();
        let messages: Vec<usize> = records
            .filter(|(_, record)| record.is_message)
            .map(|(number, _)| number)
            .collect();
        for _ in 0..self.choices.below(3) {
            self.place = Place::Effect;
            let reporting = self
                .model
                .bindings
                .iter()
                .find(|one| one.kind != "ReachAvoid");
            let (event, parts) = match (reporting.map(|one| one.name.clone()), messages.len()) {
                (Some(name), count) if count == 0 || self.choices.below(4) == 3 => {
                    let parts = vec![Type::Int, Type::list(Type::Robot)];
                    (format!("{name}.failed"), parts)
                }
                (_, 0) => return,
                (_, count) => {
                    let record = &self.model.records[messages[self.choices.below(count)]];
                    let fields = record.fields.iter().map(|field| field.ty.clone());
                    (
                        record.name.clone(),
                        [Type::Robot].into_iter().chain(fields).collect(),
                    )
                }
            };
            let names: Vec<String> = (parts.into_iter())
                .map(|ty| match self.choices.below(6) {
                    5 => "_".into(),
                    _ => self.add_local(ty, false),
                })
                .collect();
            self.line(&format!("on {event}({})", names.join(", ")));
            self.block(2);
            self.locals.clear();
        }
        if self.choices.below(4) == 3 {
            self.input();
        }
    }

    /// A handler of an input with an unused name, or of the waypoints.
    fn input(&mut self) {
        self.place = Place::Effect;
        let count = self.choices.below(4);
        let fields: Vec<String> = (0..count)
            .map(|_| {
                let ty = self.field_of_order();
                let written = self.model.written(&ty);
                format!("{}: {written}", self.add_local(ty, false))
            })
            .collect();
        let name = if fields.is_empty() {
            "way_points".into()
        } else {
            format!("order{}", self.text.matches("on input").count())
        };
        self.line(&format!("on input {name}({})", fields.join(", ")));
        self.block(2);
        self.locals.clear();
    }

    /// The type of a field of an order.
    fn field_of_order(&mut self) -> Type {
        match self.choices.below(8) {
            0 => Type::Int,
            1 => Type::Bool,
            2 => Type::Float,
            3 => Type::String,
            4 => Type::Point,
            5 => Type::Robot,
            6 => Type::list(Type::Point),
            _ => Type::list(Type::Robot),
        }
    }

    /// The roles are known before anything that may name them.
    pub(super) fn declare_roles(&mut self) {
        if self.choices.below(4) < 3 {
            return;
        }
        let count = 1 + self.choices.below(3);
        self.model.roles = Some(self.model.enums.len());
        self.model.enums.push(Enum {
            name: None,
            variants: (0..count).map(|number| format!("role{number}")).collect(),
        });
    }

    pub(super) fn roles(&mut self) {
        let Some(roles) = self.model.roles else {
            return;
        };
        for number in 0..self.model.enums[roles].variants.len() {
            self.line(&format!("role role{number}"));
            self.level += 1;
            if self.choices.below(2) == 1 {
                self.init();
            }
            self.actions(&format!("role{number}_act"));
            // A role has something in it.
            self.line(&format!("stay{number}()"));
            self.level += 1;
            self.line("eff stop()");
            self.level -= 1;
            self.handlers();
            self.level -= 1;
        }
    }

    pub(super) fn properties(&mut self) {
        for number in 0..self.choices.below(4) {
            let is_about_robot = self.choices.below(2) == 1;
            self.place = Place::Property(is_about_robot);
            let name = if self.choices.below(4) == 3 {
                "".into()
            } else {
                format!(" claim{number}")
            };
            let condition = self.stated(is_about_robot);
            let line = match self.choices.below(5) {
                0 => format!("invariant{name}: {condition}"),
                1 => format!("always{name}: {condition}"),
                2 => format!("eventually{name}: {condition} within 90s"),
                3 => format!("eventually{name}: {condition}"),
                _ => {
                    let then = self.stated(is_about_robot);
                    format!("always{name}: {condition} leads_to {then} within 1.5min")
                }
            };
            self.line(&line);
        }
    }

    /// A condition on one robot or on all.
    fn stated(&mut self, is_about_robot: bool) -> String {
        if is_about_robot {
            self.claim()
        } else {
            self.quantifier(4).text
        }
    }
}
