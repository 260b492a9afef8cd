//! Mutual exclusion on sets of named resources (thesis, section 3.4.3).
//!
//! A robot requests several resources at once, gets all of them at once, and releases them together or one
//! by one. The [`Algorithm`] decides when it gets them: permission of all others, grants of a quorum, or
//! leases of a majority. Their guarantees are the same:
//! - safety: no resource is held by two robots at once, whatever the network does and whichever robots
//!   crash and restart. With leases this requires that clocks keep the bound of [`Options::drift`]; if they
//!   do not, [`Mutex::fencing`] identifies the later holder;
//! - progress: if every holder releases its resources, every request is granted, in the order of
//!   Lamport's clock where requests overlap: there is no starvation, and overlapping sets do not
//!   deadlock;
//! - non-interference: a request without overlap is granted after one exchange of messages, two if robots hear of each
//!   other for the first time;
//! - failures are visible: if a request waits for a robot that the program's
//!   [`crate::FailureDetector`] suspects, [`Mutex::failed`] is true until the robot is trusted
//!   again.
//!
//! The resources of a crashed robot stay locked until it is up again, when it holds nothing; with leases
//! until its lease ends.
//!
//! Resources that are places are kept apart by sight too: [`Mutex::with_places`].
//!
//! After a corruption of its state a robot may believe that it holds a resource of another robot, until it releases it.
//! From then on all guarantees hold again.

mod arbitration;
mod common;
mod lease;
mod options;
mod permission;
mod places;
mod quorum;

pub use options::{Algorithm, Options};
pub use places::PlaceOptions;

use alloc::boxed::Box;
use alloc::collections::{BTreeMap, BTreeSet};
use arbitration::Arbitration;
use common::Common;
use permission::Permission;
use places::Places;
use starl_core::event::MutexEvent;
use starl_core::{Area, Input, Port, Primitive, Random, Robot, RobotId};

/// Names of resources.
pub type Resources = BTreeSet<Box<str>>;

/// Locks on named resources, held by one robot at a time. See the [module](self).
#[derive(Clone, Debug)]
pub struct Mutex {
    common: Common,
    protocol: Protocol,
    /// Where resources are, if they are places.
    places: Option<Box<Places>>,
}

/// The state of the algorithm.
#[derive(Clone, Debug)]
enum Protocol {
    Permission(Permission),
    Arbitration(Box<Arbitration>),
}

/// Calls the same method of whatever algorithm it is.
macro_rules! each {
    ($protocol:expr, $state:ident => $call:expr) => {
        match $protocol {
            Protocol::Permission($state) => $call,
            Protocol::Arbitration($state) => $call,
        }
    };
}

/// Why a request was refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AcquireError {
    /// The robot already holds resources. Two robots that hold some and wait for others could deadlock, so a robot must
    /// request all its resources at once.
    HoldsOthers,
}

impl Mutex {
    /// An instance; those of the same name on all robots lock the same resources. `participants` are
    /// the robots that request and grant: by default the whole fleet. Robots that may request the
    /// same resource must be participants of each other.
    pub fn new(name: &str, participants: Option<BTreeSet<RobotId>>, options: Options) -> Mutex {
        Mutex {
            common: Common::new(Port::named(name), participants, options),
            protocol: match options.algorithm {
                Algorithm::Permission => Protocol::Permission(Permission::default()),
                Algorithm::Quorum | Algorithm::Lease => Protocol::Arbitration(Box::default()),
            },
            places: None,
        }
    }

    /// Resources with these names are places in the floor plane: robots see whether another is there, and ask all that
    /// they see nearby. The robots need detectors.
    #[must_use]
    pub fn with_places(mut self, areas: BTreeMap<Box<str>, Area>, options: PlaceOptions) -> Mutex {
        let mut places = Places::new(areas, options);
        places.members = self.common.participants.take();
        self.places = Some(Box::new(places));
        self
    }

    /// Whether its resources are places: then it looks around whenever the robot is activated.
    pub fn has_places(&self) -> bool {
        self.places.is_some()
    }

    /// Changes the participants from the next request on, with places at once.
    pub fn set_participants(&mut self, participants: Option<BTreeSet<RobotId>>) {
        match &mut self.places {
            Some(places) => places.members = participants,
            None => self.common.participants = participants,
        }
    }

    /// Requests all of these resources at once (the thesis's do_mutex). A pending request is withdrawn, unless it
    /// is for the same resources: that one keeps its turn, and with [`Algorithm::Permission`] the current
    /// participants are asked. An empty set needs no request and counts as held.
    ///
    /// With places the request lasts until it is withdrawn: it is made when no robot stands in them, and made again
    /// whenever the robot has given way. Other resources that the robot holds are given back. The participants are
    /// always the last ones that were set, so set them as long as the robot may have to give way.
    ///
    /// # Errors
    /// If the robot holds something, and the resources are not places.
    pub fn acquire(
        &mut self,
        robot: &mut Robot<'_>,
        resources: Resources,
    ) -> Result<(), AcquireError> {
        let Some(places) = &mut self.places else {
            return self.request(robot, resources);
        };
        if *places.wish() != resources {
            places.set_wish(resources);
            self.tend_places(robot);
        }
        Ok(())
    }

    /// Requests resources by the algorithm.
    fn request(&mut self, robot: &mut Robot<'_>, resources: Resources) -> Result<(), AcquireError> {
        let common = &mut self.common;
        if !common.held.is_empty() {
            return match common.held.is_superset(&resources) {
                true => Ok(()),
                false => Err(AcquireError::HoldsOthers),
            };
        }
        if self.wanted() == Some(&resources) {
            if let Protocol::Permission(permission) = &mut self.protocol {
                permission.ask_others(&mut self.common, robot);
            }
            return Ok(());
        }
        self.withdraw(robot);
        if !resources.is_empty() {
            let common = &mut self.common;
            let acquire = |resource| MutexEvent::Acquire { resource };
            common.report(robot, acquire, &resources);
            each!(&mut self.protocol, state => state.acquire(common, robot, resources));
        }
        Ok(())
    }

    /// Releases all held resources or some; requests for them are withdrawn.
    pub fn release(&mut self, robot: &mut Robot<'_>, resources: &Resources) {
        if let Some(places) = &mut self.places {
            places.give_back(resources);
        }
        self.release_by_algorithm(robot, resources);
    }

    /// Releases all held resources, and withdraws all requests.
    pub fn release_all(&mut self, robot: &mut Robot<'_>) {
        let mut known = self.known_resources();
        if let Some(places) = &self.places {
            known.extend(places.wish().iter().cloned());
        }
        self.release(robot, &known);
    }

    /// Releases resources by the algorithm.
    fn release_by_algorithm(&mut self, robot: &mut Robot<'_>, resources: &Resources) {
        let common = &mut self.common;
        let left: Resources = common.held.intersection(resources).cloned().collect();
        if !left.is_empty() {
            common.held.retain(|resource| !resources.contains(resource));
            common.report(robot, |resource| MutexEvent::Release { resource }, &left);
            each!(&mut self.protocol, state => state.released(common, robot));
        }
        let waits = |wanted: &Resources| !wanted.is_disjoint(resources);
        if self.wanted().is_some_and(waits) {
            self.withdraw(robot);
        }
    }

    /// Whether this robot holds all of these resources.
    pub fn holds(&self, resources: &Resources) -> bool {
        resources.iter().all(|resource| self.has(resource))
    }

    /// Whether this robot holds the resource. One that is a place it holds only while it sees no other robot there.
    pub fn has(&self, resource: &str) -> bool {
        let places = self.places.as_ref();
        self.common.held.contains(resource) && places.is_none_or(|places| places.is_free(resource))
    }

    /// The resources that are granted to this robot.
    pub fn held(&self) -> &Resources {
        &self.common.held
    }

    /// Whether this robot holds anything (the thesis's crit, until all is given back).
    pub fn crit(&self) -> bool {
        !self.common.held.is_empty()
    }

    /// The number of the held resources, with [`Algorithm::Lease`]: greater than those of all earlier
    /// holders of one of them, and different from every other robot's. Operations on the resources should
    /// carry it, so that their receivers can refuse lower numbers than they have seen.
    pub fn fencing(&self) -> Option<u64> {
        match &self.protocol {
            Protocol::Permission(_) => None,
            Protocol::Arbitration(state) => state.fencing(&self.common),
        }
    }

    /// Whether a request is under way.
    pub fn is_waiting(&self) -> bool {
        if let Some(places) = &self.places
            && places.has_wish()
        {
            return !self.common.held.is_superset(places.wish());
        }
        // A fault may have left a request for nothing, which would wait for ever.
        self.wanted().is_some_and(|wanted| !wanted.is_empty())
    }

    /// Whether a request waits for a suspected robot. The request stays, and continues if the robot returns;
    /// [`Mutex::release`] withdraws it.
    pub fn failed(&self) -> bool {
        each!(&self.protocol, state => state.failed(&self.common))
    }

    /// Overwrites the state at random, as a transient fault would, given the resources that there are.
    pub fn corrupt(&mut self, random: &mut Random, resources: &Resources) {
        let some = |random: &mut Random| -> Resources {
            let chosen = resources.iter().filter(|_| random.chance(0.5));
            chosen.cloned().collect()
        };
        let held = some(random);
        self.common.corrupt(random, held);
        let wanted = some(random);
        each!(&mut self.protocol, state => state.corrupt(random, wanted));
        if let Some(places) = &mut self.places {
            places.corrupt(random);
        }
    }

    /// All resources that this robot knows: those that it or others hold, request or held.
    pub fn known_resources(&self) -> Resources {
        let mut known = self.common.held.clone();
        each!(&self.protocol, state => state.add_resources(&mut known));
        known
    }

    /// The requested resources.
    fn wanted(&self) -> Option<&Resources> {
        each!(&self.protocol, state => state.wanted())
    }

    fn withdraw(&mut self, robot: &mut Robot<'_>) {
        if let Some(wanted) = self.wanted() {
            let withdraw = |resource| MutexEvent::Withdraw { resource };
            self.common.report(robot, withdraw, wanted);
            each!(&mut self.protocol, state => state.withdraw(&mut self.common, robot));
        }
    }
}

impl Primitive for Mutex {
    fn port(&self) -> Port {
        self.common.port
    }

    fn handle(&mut self, robot: &mut Robot<'_>, input: &Input) {
        if matches!(input, Input::Activate)
            && let Some(places) = &mut self.places
        {
            places.look(robot);
            self.tend_places(robot);
        }
        let common = &mut self.common;
        if let Protocol::Arbitration(state) = &mut self.protocol {
            state.look(common, robot);
        }
        match input {
            // A robot outside the fleet cannot request anything.
            Input::Message(message)
                if message.port == common.port && robot.fleet().contains(&message.from) =>
            {
                each!(&mut self.protocol, state => state.receive(common, robot, message));
            }
            Input::Timer(key) if key.port == common.port => {
                if let Some(alarm) = key.read() {
                    each!(&mut self.protocol, state => state.time_out(common, robot, alarm));
                }
            }
            Input::Suspected(peer) => {
                common.suspects.insert(*peer);
                if let Protocol::Arbitration(state) = &mut self.protocol {
                    state.avoid_suspects(common, robot);
                }
            }
            Input::Trusted(peer) => {
                common.suspects.remove(peer);
                each!(&mut self.protocol, state => state.trusted(common, robot, *peer));
            }
            _ => {}
        }
    }

    fn save(&mut self, robot: &mut Robot<'_>) {
        // With permissions a robot that restarts has nothing to remember: see `permission`.
        if let Protocol::Arbitration(state) = &mut self.protocol {
            state.save(&self.common, robot);
        }
    }
}
