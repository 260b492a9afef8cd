//! The failure detector in programs: the robots that it suspects, and its events.
//!
//! There is one detector for all primitives of a program; any number of instances read it.

use super::kind::{Attention, Event, Kind, Member, Report, query};
use crate::robot::arguments::Arguments;
use crate::robot::context::Context;
use crate::robot::instance::Instance;
use crate::robot::services::Needs;
use crate::robot::shape::Shape;
use crate::robot::workbench::robots;
use alloc::borrow::Cow;
use alloc::collections::BTreeSet;
use alloc::vec::Vec;
use starl_core::{Input, Port, Primitive, Random, Robot, RobotId};

/// The robots that the program's detector suspects.
fn suspected<'a>(context: &'a Context<'_, '_>) -> impl Iterator<Item = RobotId> + use<'a> {
    let detector = context.services.detector.as_deref();
    detector
        .into_iter()
        .flat_map(|detector| detector.suspected())
}

/// A program's view of its failure detector.
#[derive(Clone, Debug)]
pub struct Watch {
    port: Port,
    /// The events that have not been delivered yet.
    reports: Vec<Report>,
}

impl Kind for Watch {
    const NAME: &'static str = "FailureDetector";

    const CONSTRUCTOR: &'static [Shape] = &[];

    const MEMBERS: &'static [Member<Watch>] = &[
        query(
            "suspects",
            &[],
            Shape::Set(&Shape::Robot),
            |_, context, call| {
                call.set_object(0, robots(suspected(context)));
                Ok(2)
            },
        ),
        query(
            "live",
            &[],
            Shape::Set(&Shape::Robot),
            |_, context, call| {
                let suspects: BTreeSet<RobotId> = suspected(context).collect();
                let fleet = context.robot.fleet().iter().copied();
                call.set_object(0, robots(fleet.filter(|robot| !suspects.contains(robot))));
                Ok(2 + context.robot.fleet().len() as u64 / 8)
            },
        ),
    ];

    const EVENTS: &'static [Event] = &[
        Event {
            name: "suspected",
            parameters: &[Shape::Robot],
        },
        Event {
            name: "trusted",
            parameters: &[Shape::Robot],
        },
    ];

    const NEEDS: Needs = Needs::DETECTOR;

    const ATTENTION: Attention = Attention::NONE;

    fn bind(
        instance: &Instance,
        _: &mut Context<'_, '_>,
        _: &mut Arguments<'_>,
    ) -> Result<Watch, Cow<'static, str>> {
        Ok(Watch {
            port: Port::named(&instance.name),
            reports: Vec::new(),
        })
    }

    fn primitive(&mut self) -> Option<&mut dyn Primitive> {
        Some(self)
    }

    /// The detector itself is the services'.
    fn corrupt(&mut self, random: &mut Random) {
        self.reports.retain(|_| random.chance(0.5));
    }

    fn take_reports(&mut self, take: &mut dyn FnMut(Report)) {
        self.reports.drain(..).for_each(take);
    }
}

impl Primitive for Watch {
    fn port(&self) -> Port {
        self.port
    }

    fn handle(&mut self, _: &mut Robot<'_>, input: &Input) {
        let (event, robot) = match input {
            Input::Suspected(robot) => (0, robot),
            Input::Trusted(robot) => (1, robot),
            _ => return,
        };
        self.reports.push(Report {
            event,
            scalars: [u64::from(robot.0)].into(),
            objects: Vec::new(),
        });
    }
}
