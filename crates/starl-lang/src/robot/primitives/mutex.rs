//! Mutex in programs.

use super::kind::{Kind, Member, flag, method, query};
use crate::machine::{Body, List};
use crate::robot::arguments::Arguments;
use crate::robot::context::Context;
use crate::robot::instance::Instance;
use crate::robot::services::Needs;
use crate::robot::shape::{MUTEX_ALGORITHMS, Shape};
use alloc::borrow::Cow;
use alloc::boxed::Box;
use alloc::collections::BTreeMap;
use alloc::format;
use starl_core::{Area, Primitive, Random, Robot};
use starl_primitives::Mutex;
use starl_primitives::mutex::{AcquireError, Options, PlaceOptions, Resources};

impl Kind for Mutex {
    const NAME: &'static str = "Mutex";

    /// The name of the mutex, the participants (all, if none are given), the algorithm, the duration of a lease, the
    /// longest time between repetitions of a request, the areas of resources that are places, and how long silent robots
    /// near them are waited for.
    const CONSTRUCTOR: &'static [Shape] = &[
        Shape::Text,
        Shape::Optional(&Shape::Set(&Shape::Robot)),
        Shape::Optional(&Shape::MutexAlgorithm),
        Shape::Optional(&Shape::Duration),
        Shape::Optional(&Shape::Duration),
        Shape::Optional(&Shape::Map(&Shape::Text, &Shape::Area)),
        Shape::Optional(&Shape::Duration),
    ];

    const MEMBERS: &'static [Member<Mutex>] = &[
        method(
            "acquire",
            &[
                Shape::Set(&Shape::Text),
                Shape::Optional(&Shape::Set(&Shape::Robot)),
            ],
            None,
            |mutex, context, call| {
                let mut arguments = Arguments::after_instance(call);
                let resources = texts(&mut arguments);
                if let Some(participants) = arguments.participants(context.robot) {
                    mutex.set_participants(participants);
                }
                let cost = 10 + resources.len() as u64;
                match mutex.acquire(context.robot, resources) {
                    Ok(()) => Ok(cost),
                    Err(AcquireError::HoldsOthers) => Err("this robot already holds resources; \
                        release them first, or request all needed resources at once"
                        .into()),
                }
            },
        ),
        method(
            "release",
            &[Shape::Optional(&Shape::Set(&Shape::Text))],
            None,
            |mutex, context, call| {
                // Programs give back what they may hold, just in case: the set is made only if there is something.
                if !mutex.crit() && !mutex.is_waiting() {
                    return Ok(10);
                }
                let Some(resources) = Arguments::after_instance(call).optional(texts) else {
                    mutex.release_all(context.robot);
                    return Ok(10);
                };
                mutex.release(context.robot, &resources);
                Ok(10 + resources.len() as u64)
            },
        ),
        query(
            "held",
            &[Shape::Set(&Shape::Text)],
            Shape::Bool,
            |mutex, _, call| {
                // Programs query at every activation, so the set is not rebuilt each time.
                let arguments = &mut Arguments::after_instance(call);
                let (mut count, mut held) = (0, true);
                for resource in names(arguments) {
                    count += 1;
                    held &= mutex.has(resource);
                }
                call.set_bool(0, held);
                Ok(1 + count)
            },
        ),
        flag!("waiting", Mutex::is_waiting),
        query(
            "fencing",
            &[],
            Shape::Optional(&Shape::Int),
            |mutex, _, call| {
                call.set_optional(0, mutex.fencing());
                Ok(0)
            },
        ),
        flag!("failed", Mutex::failed),
    ];

    const NEEDS: Needs = Needs::DETECTOR;

    fn bind(
        _: &Instance,
        context: &mut Context<'_, '_>,
        arguments: &mut Arguments<'_>,
    ) -> Result<Mutex, Cow<'static, str>> {
        let name = format!("mutex/{}", arguments.text());
        let participants = arguments.participants(context.robot).flatten();
        let default = Options::default();
        let options = Options {
            algorithm: arguments.choice("algorithm", &MUTEX_ALGORITHMS, default.algorithm)?,
            lease: arguments.duration_or(default.lease),
            longest_timeout: arguments.duration_or(default.longest_timeout),
            ..default
        };
        for (name, time) in [
            ("lease", options.lease),
            ("repeat", options.longest_timeout),
        ] {
            if time.is_zero() {
                return Err(format!("`{name}` must be greater than 0 s").into());
            }
        }
        let places = arguments.optional(areas).transpose()?;
        let default = PlaceOptions::default();
        let patience = arguments.duration_or(default.patience);
        if patience.is_zero() {
            return Err("`patience` must be greater than 0 s".into());
        }
        let mutex = Mutex::new(&name, participants, options);
        Ok(match places {
            Some(places) => mutex.with_places(
                places,
                PlaceOptions {
                    patience,
                    ..default
                },
            ),
            None => mutex,
        })
    }

    fn primitive(&mut self) -> Option<&mut dyn Primitive> {
        Some(self)
    }

    fn corrupt(&mut self, random: &mut Random) {
        let known = self.known_resources();
        Mutex::corrupt(self, random, &known);
    }

    fn reset(&mut self, robot: &mut Robot<'_>) {
        self.release_all(robot);
    }

    fn looks(&self) -> bool {
        self.has_places()
    }
}

/// Areas by their names.
fn areas(arguments: &mut Arguments<'_>) -> Result<BTreeMap<Box<str>, Area>, Cow<'static, str>> {
    let Some(Body::Map(map)) = arguments.object().body() else {
        return Ok(BTreeMap::new());
    };
    map.iter()
        .filter_map(|[name, area]| Some((name.objects.first()?, area.objects.first()?)))
        .map(|(name, area)| match area.area() {
            Some(area) => Ok((name.text().into(), area.clone())),
            None => Err("there is no area".into()),
        })
        .collect()
}

/// A set of texts.
fn texts(arguments: &mut Arguments<'_>) -> Resources {
    names(arguments).map(Box::from).collect()
}

/// The texts of a set in their order.
fn names<'a>(arguments: &mut Arguments<'a>) -> impl Iterator<Item = &'a str> + use<'a> {
    let elements = arguments.object().list().into_iter().flat_map(List::iter);
    let texts = elements.filter_map(|block| block.objects.first());
    texts.map(|text| text.text())
}
