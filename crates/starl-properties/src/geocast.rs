//! Geocast's exclusion and inclusion (thesis, section 3.3.1), judged by true positions.
//!
//! With t0 the time of the geocast and d2 the bound:
//! - exclusion: a robot that delivers the message has been in the area between t0 and that moment,
//!   or t0 + d2 if that is earlier. The thesis demands this, and its "a robot outside A is
//!   guaranteed not to receive the message" covers robots that enter the area only after the
//!   delivery;
//! - inclusion: a robot that has been inside throughout [t0, t0 + d2] has delivered it by then.
//!
//! In addition, a robot accepts only sent messages, each once, inside or outside (integrity).
//!
//! "Outside" and "inside" exclude a margin along the boundary, within which the robot's estimate may lead to either
//! decision.

use super::health::{Health, Needs};
use super::outstanding::Outstanding;
use super::report::{MessageKey, Report};
use super::taken::Taken;
use super::track::{Sample, Tolerance, Track};
use super::{Checker, Excuse, Excused, Kinds, Setting, Violation, robot_list};
use starl_core::event::{Event, Fault, GeocastEvent, TransferEvent};
use starl_core::{Area, Duration, Point, Record, RobotId, Time};

const EXCLUSION: &str = "geocast.exclusion";
const INCLUSION: &str = "geocast.inclusion";
const INTEGRITY: &str = "geocast.integrity";

/// Watches every message sent through a Geocast.
#[derive(Clone, Debug)]
pub(super) struct Geocast {
    bound: Duration,
    tolerance: Tolerance,
    /// How old an estimate can be, by which a robot decides.
    staleness: Duration,
    health: Health,
    /// By robot; back to the oldest message that is not forgotten.
    tracks: Vec<Track>,
    /// Messages whose bound has not run out.
    outstanding: Outstanding<Message>,
    /// Messages of which copies may yet come.
    late: Outstanding<Message>,
    taken: Taken,
    /// Until then violations by invented state of a corruption do not count.
    void_until: Time,
    excused: Excused,
}

#[derive(Clone, Debug)]
struct Message {
    sent: Time,
    area: Area,
    /// How long its sender repeats it.
    retry_span: Duration,
    /// The robots that have delivered it, in the order of their numbers.
    delivered: Vec<RobotId>,
}

impl Geocast {
    pub fn new(setting: &Setting) -> Geocast {
        let bound = setting.properties.geocast_bound;
        let staleness = setting.estimate_period;
        let robots = setting.bodies.len();
        Geocast {
            bound,
            tolerance: Tolerance::new(setting, staleness),
            staleness,
            health: Health::new(robots, Needs::Sensing, bound),
            tracks: vec![Track::default(); robots],
            outstanding: Outstanding::default(),
            late: Outstanding::default(),
            taken: Taken::default(),
            void_until: Time::ZERO,
            excused: Excused::default(),
        }
    }

    fn moved(&mut self, at: Time, robot: RobotId, position: Point) {
        let oldest = self.late.oldest().or(self.outstanding.oldest());
        let since = oldest.map_or(at, |message| message.sent);
        if let Some(track) = self.tracks.get_mut(robot.index()) {
            track.push(at, position);
            track.forget_before(since);
        }
    }

    fn reported(&mut self, report: &Report<'_, GeocastEvent>, found: &mut Vec<Violation>) {
        let Report { at, robot, .. } = *report;
        match report.event {
            GeocastEvent::Geocast {
                message,
                retry_span,
                area,
            } => {
                let key = report.message(robot, *message);
                self.taken.sent(&key, None);
                let message = Message {
                    sent: at,
                    area: (**area).clone(),
                    retry_span: *retry_span,
                    delivered: Vec::new(),
                };
                self.outstanding.insert(key, at + self.bound, message);
            }
            GeocastEvent::Transfer(TransferEvent::Deliver { from, message }) => {
                let key = report.message(*from, *message);
                self.health.delivered(&key, robot);
                self.takes(at, robot, &key, found);
                self.delivered(at, robot, key, found);
            }
            GeocastEvent::Outside { from, message } => {
                self.takes(at, robot, &report.message(*from, *message), found);
            }
            GeocastEvent::Transfer(_) => {}
        }
    }

    fn takes(&mut self, at: Time, robot: RobotId, key: &MessageKey, found: &mut Vec<Violation>) {
        let Some(what) = self.taken.take(robot, key, None) else {
            return;
        };
        if at < self.void_until {
            return self.excused.note(INTEGRITY, Excuse::Corruption);
        }
        let MessageKey { from, number, .. } = *key;
        let text = format!("robot {robot} took message {number} of robot {from}, {what}");
        found.push(Violation::new(INTEGRITY, at, [robot, from], text));
    }

    fn delivered(&mut self, at: Time, robot: RobotId, key: MessageKey, found: &mut Vec<Violation>) {
        let known = self.outstanding.get_mut(&key);
        let Some(message) = known.or_else(|| self.late.get_mut(&key)) else {
            return;
        };
        let Err(index) = message.delivered.binary_search(&robot) else {
            return;
        };
        message.delivered.insert(index, robot);
        let (sent, area) = (message.sent, &message.area);
        let until = at.min(sent + self.bound);
        let Some(track) = self.tracks.get(robot.index()) else {
            return;
        };
        let Some(text) = outside(track.between(sent, until), area, &self.tolerance) else {
            return;
        };
        if !self.health.well_since(robot, sent - self.staleness) {
            return self.excused.note(EXCLUSION, self.health.excuse(robot));
        }
        let MessageKey { from, number, .. } = key;
        found.push(Violation {
            property: EXCLUSION.into(),
            at,
            robots: vec![robot, from],
            text: format!(
                "robot {robot} delivered message {number} that robot {from} geocast at {sent}, {text}"
            ),
        });
    }

    fn check_bound(&mut self, now: Time, found: &mut Vec<Violation>) {
        while let Some((due, key, message)) = self.outstanding.pop_overdue(now) {
            self.check_inclusion(due, &key, &message, found);
            let last_copy = due + message.retry_span;
            self.late.insert(key, last_copy, message);
        }
        while self.late.pop_overdue(now).is_some() {}
    }

    fn check_inclusion(
        &mut self,
        due: Time,
        key: &MessageKey,
        message: &Message,
        found: &mut Vec<Violation>,
    ) {
        let MessageKey { from, number, .. } = *key;
        let sent = message.sent;
        if !message.area.is_valid() {
            return;
        }
        let mut missed: Vec<RobotId> = (0..self.tracks.len() as u32)
            .map(RobotId)
            .filter(|&robot| robot != from && message.delivered.binary_search(&robot).is_err())
            .filter(|&robot| self.was_inside(robot, message, due))
            .collect();
        missed.retain(|&robot| {
            let stale = !self.health.well_since(robot, sent - self.staleness);
            let stale = stale.then(|| self.health.excuse(robot));
            let excuse = self.health.excuse_of(key, robot, sent).or(stale);
            if let Some(excuse) = excuse {
                self.excused.note(INCLUSION, excuse);
            }
            excuse.is_none()
        });
        if missed.is_empty() {
            return;
        }
        found.push(Violation {
            property: INCLUSION.into(),
            at: due,
            text: format!(
                "message {number} that robot {from} geocast at {sent} did not reach {} within {}, \
                 inside its area throughout",
                robot_list(&missed),
                self.bound,
            ),
            robots: [from].into_iter().chain(missed).collect(),
        });
    }

    /// Whether the robot was in the message's area for certain until `due`.
    fn was_inside(&self, robot: RobotId, message: &Message, due: Time) -> bool {
        let inside =
            |sample: &Sample| depth(&message.area, sample.position) > self.tolerance.around(sample);
        // Of a robot that has joined later nothing is known.
        let Some(track) = self.tracks.get(robot.index()) else {
            return false;
        };
        let mut samples = track.between(message.sent, due).peekable();
        samples.peek().is_some() && samples.all(inside)
    }
}

impl Checker for Geocast {
    fn properties(&self) -> &'static [&'static str] {
        &[EXCLUSION, INCLUSION, INTEGRITY]
    }

    fn heeds(&self) -> Kinds {
        // Missed deadlines are found at the next record of any kind.
        match self.outstanding.oldest().or(self.late.oldest()) {
            None => Kinds::REPORTS | Kinds::MOVED | Kinds::DROPPED,
            Some(_) => Kinds::ALL,
        }
    }

    fn needs(&self, property: &str) -> Kinds {
        match property {
            INTEGRITY => Kinds::NONE,
            _ => Kinds::MOVED,
        }
    }

    fn is_owed(&self, property: &str) -> bool {
        property == INCLUSION && self.outstanding.oldest().is_some()
    }

    fn excused(&self, property: &str) -> Vec<(Excuse, u64)> {
        self.excused.of(property)
    }

    fn observe(&mut self, record: &Record, violations: &mut Vec<Violation>) {
        // Recorded ahead of its time where a datagram waits in the sender's queue.
        if matches!(record.event, Event::Dropped { .. }) {
            return self.health.observe(record);
        }
        self.check_bound(record.at, violations);
        match (&record.event, record.robot) {
            (Event::Moved(pose), Some(robot)) => self.moved(record.at, robot, pose.position),
            (Event::Primitive { .. }, _) => {
                if let Some(report) = Report::of(record) {
                    self.reported(&report, violations);
                }
            }
            (Event::Fault(fault), robot) => {
                self.health.observe(record);
                match (robot, fault) {
                    (Some(robot), Fault::Crash) => self.taken.forget(robot),
                    (Some(_), Fault::CorruptState) => self.void_until = record.at + self.bound,
                    _ => {}
                }
            }
            (Event::Failed(_), _) => self.health.observe(record),
            _ => {}
        }
    }

    fn advance(&mut self, now: Time, violations: &mut Vec<Violation>) {
        self.check_bound(now, violations);
    }
}

/// Says so if a robot was outside an area at all these samples, for certain.
fn outside<'a>(
    samples: impl Iterator<Item = &'a Sample>,
    area: &Area,
    tolerance: &Tolerance,
) -> Option<String> {
    let mut samples = samples.peekable();
    samples.peek()?;
    if !area.is_valid() {
        return Some("whose area is invalid".into());
    }
    let mut kept = f64::INFINITY;
    for sample in samples {
        let distance = area.distance(sample.position);
        if distance <= tolerance.around(sample) {
            return None;
        }
        kept = kept.min(distance);
    }
    Some(format!(
        "but had stayed at least {kept:.3} m away from its area since"
    ))
}

/// How far inside the area a point is, metres; negative outside.
fn depth(area: &Area, p: Point) -> f64 {
    match area {
        Area::Circle { center, radius } => radius - center.planar_distance(p),
        Area::Polygon(polygon) => -polygon.signed_distance(p),
        Area::Box { low, high } => {
            let (below, above) = (p - *low, *high - p);
            let corner = |room: Point| room.x.min(room.y).min(room.z);
            corner(below).min(corner(above))
        }
    }
}
