//! LeaderElection in programs.

use super::kind::{Event, Kind, Member, Report, flag, method, query};
use crate::robot::arguments::Arguments;
use crate::robot::context::Context;
use crate::robot::instance::Instance;
use crate::robot::services::Needs;
use crate::robot::shape::{ELECTION_ALGORITHMS, Shape};
use alloc::borrow::Cow;
use alloc::format;
use alloc::vec::Vec;
use starl_core::{Primitive, Random, Robot};
use starl_primitives::LeaderElection;
use starl_primitives::election::{Change, Options};

impl Kind for LeaderElection {
    const NAME: &'static str = "LeaderElection";

    /// The name of the election, the participants (all, if none are given), and the algorithm.
    const CONSTRUCTOR: &'static [Shape] = &[
        Shape::Text,
        Shape::Optional(&Shape::Set(&Shape::Robot)),
        Shape::Optional(&Shape::ElectionAlgorithm),
    ];

    const MEMBERS: &'static [Member<LeaderElection>] = &[
        method("elect", &[], None, |election, context, _| {
            election.elect(context.robot);
            Ok(10)
        }),
        method("resign", &[], None, |election, context, _| {
            election.resign(context.robot);
            Ok(10)
        }),
        query(
            "leader",
            &[],
            Shape::Optional(&Shape::Robot),
            |election, _, call| {
                let leader = election.leader();
                call.set_optional(0, leader.map(|leader| leader.0.into()));
                Ok(0)
            },
        ),
        query(
            "epoch",
            &[],
            Shape::Optional(&Shape::Int),
            |election, _, call| {
                // Epochs have 63 bits.
                call.set_optional(0, election.epoch());
                Ok(0)
            },
        ),
        flag!("failed", LeaderElection::failed),
    ];

    const EVENTS: &'static [Event] = &[
        Event {
            name: "elected",
            parameters: &[Shape::Robot],
        },
        Event {
            name: "lost",
            parameters: &[Shape::Robot],
        },
    ];

    const NEEDS: Needs = Needs::DETECTOR;

    fn bind(
        _: &Instance,
        context: &mut Context<'_, '_>,
        arguments: &mut Arguments<'_>,
    ) -> Result<LeaderElection, Cow<'static, str>> {
        let name = format!("election/{}", arguments.text());
        let participants = arguments.participants(context.robot).flatten();
        let default = Options::default();
        let options = Options {
            algorithm: arguments.choice("algorithm", &ELECTION_ALGORITHMS, default.algorithm)?,
            ..default
        };
        Ok(LeaderElection::new(&name, participants, options))
    }

    fn primitive(&mut self) -> Option<&mut dyn Primitive> {
        Some(self)
    }

    fn corrupt(&mut self, random: &mut Random) {
        LeaderElection::corrupt(self, random);
    }

    fn reset(&mut self, robot: &mut Robot<'_>) {
        self.resign(robot);
    }

    fn take_reports(&mut self, take: &mut dyn FnMut(Report)) {
        for change in self.take_changes() {
            let (event, robot) = match change {
                Change::Elected(leader) => (0, leader),
                Change::Lost(leader) => (1, leader),
            };
            take(Report {
                event,
                scalars: Vec::from([u64::from(robot.0)]),
                objects: Vec::new(),
            });
        }
    }
}
