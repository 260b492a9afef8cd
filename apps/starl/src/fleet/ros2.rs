//! ROS 2 robots of a fleet, over Zenoh: their drivers, and their emulation.

use super::file::{Fleet, Member, Positions};
use super::hardware::{Emulated, Hardware};
use crate::failure::Failure;
use starl_emulate::BodyHandle;
use starl_sim::scenario::Group;

/// Where a robot is in its network.
#[cfg_attr(
    not(feature = "zenoh"),
    expect(dead_code, reason = "read by Zenoh alone")
)]
#[derive(Clone, Debug)]
pub struct Place {
    /// The Zenoh router.
    pub router: String,
    /// The domain.
    pub domain: u32,
    /// The namespace, with its `/`; empty for none.
    pub namespace: String,
}

impl Place {
    /// A place as it is written, with the defaults.
    pub fn of(router: Option<&str>, domain: Option<u32>, namespace: Option<&str>) -> Place {
        let namespace = namespace.unwrap_or_default().trim_matches('/');
        Place {
            router: router.unwrap_or("tcp/127.0.0.1:7447").to_string(),
            domain: domain.unwrap_or(0),
            namespace: match namespace {
                "" => String::new(),
                name => format!("/{name}"),
            },
        }
    }
}

/// How an emulated robot shows itself besides.
#[cfg_attr(
    not(feature = "zenoh"),
    expect(dead_code, reason = "read by Zenoh alone")
)]
#[derive(Clone, Debug, Default)]
pub struct Manner {
    /// Whether it takes `TwistStamped`.
    pub stamped: bool,
    /// The frame that is the world; default `map`.
    pub map: Option<String>,
    /// Standard deviation of its localisation, metres.
    pub deviation: f64,
    /// Seeds the errors of its localisation.
    pub seed: u64,
}

impl Manner {
    /// As a fleet's scenario and its positions say.
    pub fn of(fleet: &Fleet) -> Manner {
        let scenario = fleet.application.scenario();
        Manner {
            stamped: false,
            map: map(fleet),
            deviation: scenario.positioning.position_noise,
            seed: scenario.seed,
        }
    }
}

/// The frame that is the fleet's world, if robots locate themselves.
fn map(fleet: &Fleet) -> Option<String> {
    match &fleet.positions {
        Some(Positions::Ros2 { map }) => map.clone(),
        _ => None,
    }
}

/// Why a member has no position from its own localisation.
pub fn no_localisation(member: &Member) -> Failure {
    Failure(format!(
        "{}: positions.kind = \"ros2\" needs robots whose device has `kind = \"ros2\"`; use \"natnet\" or \"vrpn\"",
        member.name
    ))
}

#[cfg(feature = "zenoh")]
pub use with_zenoh::{Routers, connect, emulate};

#[cfg(not(feature = "zenoh"))]
pub use without_zenoh::{Routers, connect, emulate};

#[cfg(feature = "zenoh")]
mod with_zenoh {
    use super::*;
    use starl_emulate::ros2::{EmulatedRos2, Ros2Setup, is_driven_by_velocities, router};
    use starl_node::motors::PositionSource;
    use starl_ros2::node::Context;
    use starl_ros2::{Ros2Options, Ros2Robot};
    use std::collections::BTreeMap;

    /// Connects to a robot, and to its own localisation if that is the source of positions.
    pub fn connect(
        fleet: &Fleet,
        member: &Member,
        group: &Group,
        place: &Place,
    ) -> Result<Hardware, Failure> {
        let limits = group.model.limits();
        let usual = Ros2Options::default();
        let options = Ros2Options {
            router: place.router.clone(),
            domain: place.domain,
            namespace: place.namespace.clone(),
            map: map(fleet).unwrap_or(usual.map),
            speed: limits.speed,
            turn_rate: limits.turn_rate,
        };
        let robot = Ros2Robot::connect(&options)
            .map_err(|error| Failure(format!("{}: its device: {error}", member.name)))?;
        let positions: Option<Box<dyn PositionSource>> = match &fleet.positions {
            Some(Positions::Ros2 { .. }) => Some(Box::new(robot.localisation())),
            _ => None,
        };
        Ok((Box::new(robot), positions))
    }

    /// The routers of emulated robots. Robots at the same endpoint share one.
    #[derive(Default)]
    pub struct Routers(BTreeMap<String, Context>);

    impl Routers {
        fn at(&mut self, place: &Place) -> Result<Context, Failure> {
            let Place {
                router: at, domain, ..
            } = place;
            let context = match self.0.get(at) {
                Some(context) => context.clone(),
                None => router(at, *domain).map_err(|error| Failure(format!("{at}: {error}")))?,
            };
            self.0.insert(at.clone(), context.clone());
            Ok(context.in_domain(*domain))
        }
    }

    /// Emulates a robot at its router.
    pub fn emulate(
        body: BodyHandle,
        routers: &mut Routers,
        place: &Place,
        manner: &Manner,
    ) -> Result<Emulated, Failure> {
        if !is_driven_by_velocities(&body) {
            return Err(Failure(format!(
                "a ROS 2 robot drives on two wheels; use the model create or differential instead of {}",
                body.model().name()
            )));
        }
        let usual = Ros2Setup::default();
        let setup = Ros2Setup {
            namespace: place.namespace.clone(),
            stamped: manner.stamped,
            map: manner.map.clone().unwrap_or(usual.map),
            deviation: manner.deviation,
            seed: manner.seed,
        };
        let context = routers.at(place)?;
        let device = EmulatedRos2::start(body, &context, &setup)
            .map_err(|error| Failure(format!("{}: {error}", place.router)))?;
        let Place {
            router,
            domain,
            namespace,
        } = place;
        Ok(Emulated {
            text: format!(
                "a ROS 2 robot with the topics {namespace}/cmd_vel, odom, tf and scan in domain {domain}, router {router}"
            ),
            _device: Box::new((device, context)),
        })
    }
}

#[cfg(not(feature = "zenoh"))]
mod without_zenoh {
    use super::*;

    const MISSING: &str = "ROS 2 robots are reached over Zenoh, which this build does not have; build it with the feature `zenoh`";

    pub fn connect(_: &Fleet, member: &Member, _: &Group, _: &Place) -> Result<Hardware, Failure> {
        Err(Failure(format!("{}: {MISSING}", member.name)))
    }

    #[derive(Default)]
    pub struct Routers(());

    pub fn emulate(
        _: BodyHandle,
        _: &mut Routers,
        _: &Place,
        _: &Manner,
    ) -> Result<Emulated, Failure> {
        Err(Failure(MISSING.to_string()))
    }
}
