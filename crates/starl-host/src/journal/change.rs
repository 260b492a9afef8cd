//! The difference between a robot's knowledge and that of its previous entry.

use super::Damaged;
use super::delta::Delta;
use super::knowledge::{Knowledge, estimate_of, estimate_words, ray_words, rays_of, same_point};
use alloc::borrow::Cow;
use serde::{Deserialize, Serialize};
use starl_core::event::Name;
use starl_core::motion::{Body, Workspace};
use starl_core::sensor::{Contact, Detection};
use starl_core::{Estimate, RobotId, Sensors, Time, View, WayPoint};

/// Absent members have not changed.
#[derive(Debug, Default, Serialize, Deserialize)]
pub struct Change<'a> {
    /// The robot's clock less the host's, nanoseconds, modulo 2^64.
    ahead: Option<i64>,
    estimate: Option<NewEstimate>,
    sensors: Option<NewSensors<'a>>,
    pub surroundings: Option<Surroundings>,
}

#[derive(Debug, Serialize, Deserialize)]
struct NewEstimate {
    /// How long before the entry it was taken, nanoseconds of the robot's clock, modulo 2^64.
    age: u64,
    numbers: Option<Delta>,
}

#[derive(Debug, Serialize, Deserialize)]
struct NewSensors<'a> {
    bumper: Option<Contact>,
    shows_proximity: bool,
    proximity: Option<Delta>,
    shows_detections: bool,
    detections: Option<Cow<'a, [Detection]>>,
    holding: Option<u32>,
    thing_names: Option<Cow<'a, [Name]>>,
}

/// The parts that rarely change. Lists are named by their hashes.
#[derive(Debug, Default, Serialize, Deserialize)]
pub struct Surroundings {
    pub body: Option<Body>,
    pub fleet: Option<u64>,
    pub way_points: Option<u64>,
    pub obstacles: Option<u64>,
}

impl<'a> Change<'a> {
    /// The change from `known` to `view`, except [`Change::surroundings`].
    pub fn between(known: &Knowledge, at: Time, view: &View<'a>) -> Change<'a> {
        let ahead = view.now.0.wrapping_sub(at.0);
        Change {
            ahead: (ahead != known.ahead).then_some(ahead.cast_signed()),
            estimate: NewEstimate::between(&known.estimate, view),
            sensors: NewSensors::between(known, view.sensors),
            surroundings: None,
        }
    }

    /// Updates from the view itself, except the lists of [`Change::surroundings`]. The result is that
    /// of [`Change::apply`], in less time.
    pub fn note(&self, known: &mut Knowledge, at: Time, view: &View<'_>) {
        known.ahead = view.now.0.wrapping_sub(at.0);
        known.estimate = view.estimate;
        known.body = view.body;
        if let Some(new) = &self.sensors {
            let sensors = view.sensors;
            known.bumper = sensors.bumper;
            known.shows_proximity = new.shows_proximity;
            known.shows_detections = new.shows_detections;
            if new.proximity.is_some() {
                known.proximity.clear();
                known.proximity.extend_from_slice(sensors.proximity);
            }
            if new.detections.is_some() {
                known.detections.clear();
                known.detections.extend_from_slice(sensors.detections);
            }
            known.holding = sensors.holding;
            if new.thing_names.is_some() {
                known.thing_names = sensors.thing_names.to_vec();
            }
        }
    }

    /// Applies the change, except the lists of [`Change::surroundings`].
    pub fn apply(&self, known: &mut Knowledge, at: Time) -> Result<(), Damaged> {
        if let Some(ahead) = self.ahead {
            known.ahead = ahead.cast_unsigned();
        }
        if let Some(new) = &self.estimate {
            let now = at.0.wrapping_add(known.ahead);
            let mut words = estimate_words(&known.estimate);
            if let Some(delta) = &new.numbers {
                let changed = delta.apply(words.into_iter()).ok_or(Damaged)?;
                words = changed.try_into().map_err(|_| Damaged)?;
            }
            known.estimate = estimate_of(&words, Time(now.wrapping_sub(new.age)));
        }
        if let Some(new) = &self.sensors {
            known.bumper = new.bumper;
            known.shows_proximity = new.shows_proximity;
            known.shows_detections = new.shows_detections;
            if let Some(delta) = &new.proximity {
                let words = delta.apply(ray_words(&known.proximity));
                known.proximity = words.as_deref().and_then(rays_of).ok_or(Damaged)?;
            }
            if let Some(detections) = &new.detections {
                known.detections.clear();
                known.detections.extend_from_slice(detections);
            }
            known.holding = new.holding;
            if let Some(names) = &new.thing_names {
                known.thing_names = names.to_vec();
            }
        }
        if let Some(Surroundings {
            body: Some(body), ..
        }) = self.surroundings
        {
            known.body = body;
        }
        Ok(())
    }
}

impl NewEstimate {
    fn between(known: &Estimate, view: &View<'_>) -> Option<NewEstimate> {
        let (old, new) = (estimate_words(known), estimate_words(&view.estimate));
        let numbers = Delta::between(old.into_iter(), new.into_iter());
        (numbers.is_some() || known.at != view.estimate.at).then(|| NewEstimate {
            age: view.now.0.wrapping_sub(view.estimate.at.0),
            numbers,
        })
    }
}

impl<'a> NewSensors<'a> {
    fn between(known: &Knowledge, now: Sensors<'a>) -> Option<NewSensors<'a>> {
        let shows_proximity = !now.proximity.is_empty();
        let shows_detections = !now.detections.is_empty();
        let proximity = match shows_proximity {
            true => Delta::between(ray_words(&known.proximity), ray_words(now.proximity)),
            false => None,
        };
        let is_new = shows_detections && !same_detections(&known.detections, now.detections);
        let bits = |bumper: Option<Contact>| bumper.map(|contact| contact.bearing.to_bits());
        let names_differ = known.thing_names != now.thing_names;
        let changed = bits(known.bumper) != bits(now.bumper)
            || known.shows_proximity != shows_proximity
            || known.shows_detections != shows_detections
            || proximity.is_some()
            || is_new
            || known.holding != now.holding
            || names_differ;
        changed.then_some(NewSensors {
            bumper: now.bumper,
            shows_proximity,
            proximity,
            shows_detections,
            detections: is_new.then_some(Cow::Borrowed(now.detections)),
            holding: now.holding,
            thing_names: names_differ.then_some(Cow::Borrowed(now.thing_names)),
        })
    }
}

fn same_detections(a: &[Detection], b: &[Detection]) -> bool {
    let same =
        |(a, b): (&Detection, &Detection)| a.what == b.what && same_point(a.position, b.position);
    a.len() == b.len() && a.iter().zip(b).all(same)
}

/// Whether two lists of waypoints are the same to the last bit.
pub fn same_places(a: &[WayPoint], b: &[WayPoint]) -> bool {
    let same = |(a, b): (&WayPoint, &WayPoint)| {
        (a.group, &a.name) == (b.group, &b.name) && same_point(a.position, b.position)
    };
    a.len() == b.len() && a.iter().zip(b).all(same)
}

/// Whether two lists of robots are the same. Long ones are compared at each entry, so it is done without
/// branches, several robots at a time.
pub fn same_fleet(a: &[RobotId], b: &[RobotId]) -> bool {
    let pairs = a.iter().zip(b);
    a.len() == b.len() && pairs.fold(0, |differ, (a, b)| differ | (a.0 ^ b.0)) == 0
}

/// Whether two bodies are the same to the last bit.
pub fn same_body(a: &Body, b: &Body) -> bool {
    let bits = |body: &Body| {
        let lowest = match body.workspace {
            Workspace::Ground => None,
            Workspace::Air { lowest } => Some(lowest.to_bits()),
        };
        (body.radius.to_bits(), body.height.to_bits(), lowest)
    };
    bits(a) == bits(b)
}
