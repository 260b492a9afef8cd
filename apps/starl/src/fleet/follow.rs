//! `starl view FLEET.toml`: the events on the robots of a running fleet, as one growing trace.
//!
//! Each robot sends its events (`starl_node::link::frame::Seen`). The times in the trace count from the start of the
//! command. The offset of a robot's clock is computed from its fastest packet, so the events of different robots are in
//! order within the delay of packets.

use super::connect::connect;
use super::file::Fleet;
use super::stream::Stream;
use crate::failure::Failure;
use starl_catalog::programs::Registry;
use starl_catalog::recording;
use starl_core::event::{Event, Fault, Level};
use starl_core::{Record, RobotId, Time, Value};
use starl_node::Operator;
use starl_node::link::frame::Seen;
use starl_properties::Setting;
use std::collections::BTreeMap;
use std::io;
use std::path::Path;
use std::time::{Duration, Instant};

/// Events are shown this often.
const PERIOD: Duration = Duration::from_millis(50);

/// Events wait for so long for earlier ones of other robots.
const HOLD: Duration = Duration::from_millis(200);

/// A robot that says nothing for so long does not answer.
const SILENCE: Duration = Duration::from_secs(2);

/// A connection to a fleet.
pub struct Follower {
    fleet: Fleet,
    operator: Operator,
}

/// Connects to the fleet of a file, whether it runs or not.
pub fn follow(path: &Path, registry: &Registry) -> Result<Follower, Failure> {
    let fleet = Fleet::read(path, None, true, registry)?;
    let operator = connect(&fleet)?;
    Ok(Follower { fleet, operator })
}

impl Follower {
    /// The fleet's name.
    pub fn name(&self) -> &str {
        &self.fleet.name
    }

    /// Passes on a trace, piece by piece, until its receiver refuses.
    pub fn run(mut self, mut take: impl FnMut(&[u8]) -> io::Result<()>) -> Result<(), Failure> {
        let application = &self.fleet.application;
        let setting = Setting {
            simulated: false,
            ..starl_sim::setting(application.scenario())
        };
        let header = recording::header(application.resolved(), &setting);
        let mut stream = Stream::new(&header).map_err(|error| Failure(error.to_string()))?;
        for (robot, start) in starts(&self.fleet) {
            let event = Event::Moved(start);
            stream.write(&record(Time::ZERO, robot, event));
        }
        let begun = Instant::now();
        let mut order = Order::default();
        let mut robots: BTreeMap<u32, Told> = BTreeMap::new();
        while take(&stream.take()).is_ok() {
            for (member, arrived, seen) in self.operator.watch(Instant::now() + PERIOD) {
                let robot = RobotId(member);
                let told = robots.entry(member).or_default();
                let events = told.take(arrived.saturating_duration_since(begun), seen);
                events.for_each(|(at, event)| order.insert(record(at, robot, event)));
            }
            let now = begun.elapsed();
            for (member, told) in &mut robots {
                if told.falls_silent(now) {
                    let event = log("the robot does not answer");
                    order.insert(record(time(now), RobotId(*member), event));
                }
            }
            for record in order.before(time(now.saturating_sub(HOLD))) {
                stream.write(&record);
            }
        }
        Ok(())
    }
}

fn starts(fleet: &Fleet) -> impl Iterator<Item = (RobotId, starl_core::Pose)> {
    let groups = fleet.application.scenario().fleet.groups.iter();
    let starts = groups.flat_map(|group| group.starts.iter().copied());
    (0..).map(RobotId).zip(starts)
}

fn time(span: Duration) -> Time {
    Time(u64::try_from(span.as_nanos()).unwrap_or(u64::MAX))
}

fn record(at: Time, robot: RobotId, event: Event) -> Record {
    let robot = Some(robot);
    Record { at, robot, event }
}

fn log(text: &str) -> Event {
    Event::Log {
        level: Level::Warning,
        text: text.to_string().into(),
    }
}

/// Records that wait for earlier ones.
#[derive(Default)]
struct Order {
    waiting: BTreeMap<(Time, u64), Record>,
    count: u64,
    last: Time,
}

impl Order {
    fn insert(&mut self, mut record: Record) {
        // An event that comes too late is shown late.
        record.at = record.at.max(self.last);
        self.count += 1;
        self.waiting.insert((record.at, self.count), record);
    }

    /// All records before a time, in order.
    fn before(&mut self, end: Time) -> impl Iterator<Item = Record> {
        self.last = self.last.max(end);
        let later = self.waiting.split_off(&(end, 0));
        std::mem::replace(&mut self.waiting, later).into_values()
    }
}

/// The events that a robot has sent.
#[derive(Default)]
struct Told {
    /// How much later it is for the follower than for the robot, nanoseconds; as of the quickest packet.
    shift: Option<i128>,
    /// The number of the next event.
    next: Option<u64>,
    /// When its process began.
    begun: Option<Time>,
    state: Option<String>,
    heard: Duration,
    is_silent: bool,
}

impl Told {
    /// The events of a packet that arrived `now`, with the follower's times.
    fn take(&mut self, now: Duration, seen: Seen) -> std::vec::IntoIter<(Time, Event)> {
        if self.begun.is_some_and(|begun| seen.begun < begun) {
            // It was still on its way when the robot restarted.
            return Vec::new().into_iter();
        }
        let before = self.begun.replace(seen.begun);
        let has_restarted = before.is_some_and(|begun| begun != seen.begun);
        let shift = now.as_nanos() as i128 - i128::from(seen.now.0);
        let shift = match self.shift.filter(|_| !has_restarted) {
            Some(known) => known.min(shift),
            None => shift,
        };
        self.shift = Some(shift);
        let shifted =
            move |at: Time| Time((i128::from(at.0) + shift).clamp(0, u64::MAX.into()) as u64);
        let begin = seen.events.first().map_or(seen.now, |(at, _)| *at);
        let mut events = Vec::new();
        let mut tell = |event| events.push((shifted(begin), event));
        if has_restarted {
            tell(Event::Fault(Fault::Restart));
        } else if std::mem::take(&mut self.is_silent) {
            tell(log("the robot answers again"));
        }
        let lost = seen.first.saturating_sub(self.next.unwrap_or(seen.first));
        if lost > 0 && !has_restarted {
            tell(log(&format!(
                "{lost} events of the robot were lost on the way"
            )));
        }
        if self.state != seen.state {
            self.state.clone_from(&seen.state);
            let state = seen.state.unwrap_or_default();
            let fields = vec![("state".into(), Value::Text(state.into()))];
            tell(Event::Program {
                name: "state".into(),
                fields,
            });
        }
        let count = seen.first + seen.events.len() as u64;
        self.next = match self.next.filter(|_| !has_restarted) {
            Some(next) => Some(next.max(count)),
            None => Some(count),
        };
        self.heard = now;
        self.is_silent = false;
        let told = seen.events.into_iter();
        events.extend(told.map(|(at, event)| (shifted(at), event)));
        events.into_iter()
    }

    /// Whether nothing has been heard for too long, since now.
    fn falls_silent(&mut self, now: Duration) -> bool {
        let is_silent = now.saturating_sub(self.heard) > SILENCE;
        is_silent && !std::mem::replace(&mut self.is_silent, true)
    }
}
