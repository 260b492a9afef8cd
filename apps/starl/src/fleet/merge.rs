//! `starl fleet merge`: joins the traces of a fleet's robots on one time axis.
//!
//! The differences of the robots' clocks are computed from the traces: a datagram is recorded at its sender and at its
//! receiver. The shortest delays in both directions between two robots bound the difference of their clocks (as in RFC
//! 5905). Clocks drift, so in a long run a line is fitted through the differences in its parts.

mod endings;

use super::file::Fleet;
use super::folder::Folder;
use crate::args::FleetMergeArguments;
use crate::console;
use crate::failure::Failure;
use crate::output::{create_now, identity};
use crate::replay::{open, unreadable};
use endings::{Ending, Endings, Span};
use starl_catalog::disk::{self, reason};
use starl_catalog::programs::Registry;
use starl_core::event::{Event, Fault};
use starl_core::{Duration, RobotId, Time};
use starl_host::journal;
use starl_properties::Setting;
use starl_trace::{Header, Inputs, Item, Outcome, Reader, TraceError, ViewOptions, Writer};
use std::cmp::Reverse;
use std::collections::{BTreeMap, BinaryHeap, HashMap, HashSet};
use std::fs::File;
use std::io::BufReader;
use std::path::{Path, PathBuf};

/// Merges what the last run of a fleet has left.
pub fn run(arguments: &FleetMergeArguments, registry: &Registry) -> Result<bool, Failure> {
    let fleet = Fleet::read(&arguments.fleet, None, true, registry)?;
    let folder = match &arguments.folder {
        Some(folder) => Folder(folder.clone()),
        None => Folder::last(&arguments.fleet)?,
    };
    let out = arguments
        .out
        .clone()
        .unwrap_or_else(|| folder.0.join("merged.mcap"));
    let merged = merge(&fleet, &folder, &out)?;
    console::print(&merged.text(&fleet, &out))?;
    Ok(true)
}

/// The result of a merge.
pub struct Merged {
    records: u64,
    clocks: BTreeMap<RobotId, Clock>,
    /// Robots of which there is no trace.
    missing: Vec<RobotId>,
    /// Robots whose clocks could not be compared.
    apart: Vec<RobotId>,
    /// Robots whose records end although they continued, and when.
    unrecorded: Vec<(RobotId, Time)>,
    /// Traces that are cut short, when, and how.
    cut: Vec<(PathBuf, Time, TraceError)>,
}

impl Merged {
    /// An account for people.
    pub fn text(&self, fleet: &Fleet, out: &Path) -> String {
        let name = |robot: &RobotId| fleet.robots[robot.index()].name.clone();
        let mut text = format!(
            "{}: {} of {}\n",
            out.display(),
            console::counted(self.records as usize, "record"),
            console::counted(fleet.robots.len() - self.missing.len(), "robot"),
        );
        let most = |of: fn(&Clock) -> f64| self.clocks.values().map(of).fold(0.0, f64::max);
        if self.clocks.len() > 1 {
            text += &format!(
                "clocks: up to {:.3} ms apart, known to {:.3} ms",
                most(|clock| clock.ahead.abs()) * 1e3,
                most(|clock| clock.error) * 1e3
            );
            let drift = most(|clock| clock.drift.abs());
            text += &match drift > 0.0 {
                true => format!(", drift up to {:.1} ppm\n", drift * 1e6),
                false => "\n".to_string(),
            };
        }
        for (path, at, error) in &self.cut {
            let file = path.file_name().unwrap_or_default().display();
            text += &match error {
                TraceError::Truncated(_) | TraceError::NoEnd(_) if *at > Time::ZERO => format!(
                    "{file}: is cut short at {:.3} s, where its process was killed or lost its power, unless it still runs\n",
                    at.seconds()
                ),
                _ if *at > Time::ZERO => format!(
                    "{file}: cannot be read after {:.3} s, and its robot counts as crashed then: {error}\n",
                    at.seconds()
                ),
                _ => format!("{file}: contains no records, and is left out: {error}\n"),
            };
        }
        for robot in &self.missing {
            text += &format!("{}: its trace is missing\n", name(robot));
        }
        for (robot, at) in &self.unrecorded {
            text += &format!(
                "{}: its records end at {:.3} s, but it continued, so the fleet is not judged as a whole after that\n",
                name(robot),
                at.seconds()
            );
        }
        for robot in &self.apart {
            text += &format!(
                "{}: has exchanged no messages, so its clock could not be compared\n",
                name(robot)
            );
        }
        text
    }
}

/// Joins the traces in a folder to one.
pub fn merge(fleet: &Fleet, folder: &Folder, out: &Path) -> Result<Merged, Failure> {
    let robots = fleet.robots.iter();
    let mut lives: BTreeMap<RobotId, Vec<PathBuf>> = robots
        .map(|robot| (robot.id, folder.traces_of(&robot.name)))
        .collect();
    let mut cut = Vec::new();
    for paths in lives.values_mut() {
        leave_out_empty(paths, &mut cut)?;
    }
    let missing: Vec<RobotId> = (lives.iter().filter(|(_, paths)| paths.is_empty()))
        .map(|(robot, _)| *robot)
        .collect();
    let Some(first) = lives.values().flatten().next() else {
        return Err(Failure::file(&folder.0, "holds no traces of robots"));
    };
    if let Some(input) = lives
        .values()
        .flatten()
        .find(|input| identity(input) == identity(out))
    {
        let what = "is one of the traces to join, which would be lost; give another file by --out";
        return Err(Failure::file(input, what));
    }
    let (mut header, mut setting) = header(first)?;
    let exchanges = Exchanges::read(&lives, &header)?;
    let recorded: Vec<RobotId> = lives
        .keys()
        .copied()
        .filter(|robot| !missing.contains(robot))
        .collect();
    let clocks = exchanges.clocks(&recorded);
    let apart = lives
        .keys()
        .filter(|robot| !clocks.contains_key(robot) && !missing.contains(robot));
    let endings = exchanges.endings(&clocks);
    for (path, robot, at, error) in &exchanges.cut {
        cut.push((path.clone(), corrected(&clocks, *robot, *at), error.clone()));
    }
    setting.unrecorded = endings.unrecorded();
    header.setting =
        serde_json::to_string_pretty(&setting).map_err(|error| Failure::file(out, error))?;
    let merged = Merged {
        records: write(&lives, &clocks, &exchanges.sent, &endings, &header, out)?,
        apart: apart.copied().collect(),
        unrecorded: setting.unrecorded,
        missing,
        cut,
        clocks,
    };
    Ok(merged)
}

/// The bytes by which an MCAP file is recognised.
const MAGIC: u64 = 8;

/// Leaves out the traces of processes that were killed before they had written anything.
fn leave_out_empty(
    paths: &mut Vec<PathBuf>,
    cut: &mut Vec<(PathBuf, Time, TraceError)>,
) -> Result<(), Failure> {
    for path in std::mem::take(paths) {
        let cannot = |error| Failure::file(&path, reason(&error));
        let file = disk::open(&path).map_err(cannot)?;
        let is_begun = file.metadata().map_err(cannot)?.len() >= MAGIC;
        match Reader::new(BufReader::new(file)) {
            Err(error @ TraceError::Truncated(_)) => cut.push((path, Time::ZERO, error)),
            Err(error @ TraceError::NotMcap) if !is_begun => cut.push((path, Time::ZERO, error)),
            Err(error) => return Err(unreadable(&path, &error)),
            Ok(_) => paths.push(path),
        }
    }
    Ok(())
}

/// A time of a robot's clock on the first robot's.
fn corrected(clocks: &BTreeMap<RobotId, Clock>, robot: RobotId, at: Time) -> Time {
    match clocks.get(&robot) {
        Some(clock) => Time((clock.corrected(at.seconds()) * 1e9).max(0.0) as u64),
        None => at,
    }
}

/// The header and the setting of one robot's trace, as those of a trace of all.
fn header(path: &Path) -> Result<(Header, Setting), Failure> {
    let header = open(path)?.header().clone();
    let setting = Setting {
        only: None,
        ..setting_of(path, &header)?
    };
    Ok((header, setting))
}

/// The setting of a trace with this header.
fn setting_of(path: &Path, header: &Header) -> Result<Setting, Failure> {
    serde_json::from_str(&header.setting)
        .map_err(|error| Failure::file(path, format!("the attachment starl/setting.json: {error}")))
}

/// How a robot's clock differs from the first robot's.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Clock {
    /// How far it is ahead at time 0 of the first robot's clock, seconds.
    ahead: f64,
    /// How much farther it gets ahead in each second.
    drift: f64,
    /// How exact that is, seconds.
    error: f64,
}

impl Clock {
    /// The first robot's time when this clock shows `shown`, seconds.
    fn corrected(&self, shown: f64) -> f64 {
        (shown - self.ahead) / (1.0 + self.drift)
    }

    /// The clock through what was found at some times: time, how far ahead, and how exact. Exact values count for more
    /// (a regression line, weighted by the inverse square of the errors).
    fn through(found: &[(f64, f64, f64)]) -> Clock {
        let weighted: Vec<_> = (found.iter())
            .map(|&(at, ahead, error)| (at, ahead, (error + 1e-6).powi(-2)))
            .collect();
        let sum = |of: &dyn Fn(f64, f64) -> f64| -> f64 {
            let parts = weighted.iter();
            parts
                .map(|&(at, ahead, weight)| weight * of(at, ahead))
                .sum()
        };
        let total = sum(&|_, _| 1.0);
        let (middle, mean) = (sum(&|at, _| at) / total, sum(&|_, ahead| ahead) / total);
        let spread = sum(&|at, _| (at - middle).powi(2));
        let drift = match spread > 0.0 {
            true => sum(&|at, ahead| (at - middle) * (ahead - mean)) / spread,
            false => 0.0,
        };
        let ahead = mean - drift * middle;
        let misses = |&(at, found, error): &(f64, f64, f64)| {
            ((ahead + drift * at - found).abs() - error).max(0.0)
        };
        Clock {
            ahead,
            drift,
            error: found.iter().map(misses).fold(1.0 / total.sqrt(), f64::max),
        }
    }
}

/// Clocks that drift by 100 ppm, more than most, get 3 ms farther apart in a part of a run of this length, seconds.
const PART: f64 = 30.0;

/// The datagrams that were sent by one robot and have arrived at another.
#[derive(Default)]
struct Exchanges {
    /// When each was sent, by its sender's clock.
    sent: HashMap<(RobotId, u32), Time>,
    arrived: Vec<Exchange>,
    /// Datagrams of which no sending is recorded: the sender, the receiver, and when they arrived by its clock.
    strays: Vec<(RobotId, RobotId, Time)>,
    /// The lives of each robot: when they begin and end by its clock, and how.
    spans: BTreeMap<RobotId, Vec<(Time, Time, Ending)>>,
    /// Traces that are cut short: the robot, when by its clock, and how.
    cut: Vec<(PathBuf, RobotId, Time, TraceError)>,
}

/// A datagram: its sender, its receiver, when it arrived by the receiver's clock, and how long it took by the clocks of
/// either end, seconds.
#[derive(Clone, Copy, Debug)]
struct Exchange {
    from: RobotId,
    to: RobotId,
    at: f64,
    delay: f64,
}

impl Exchanges {
    fn read(
        lives: &BTreeMap<RobotId, Vec<PathBuf>>,
        header: &Header,
    ) -> Result<Exchanges, Failure> {
        let mut sent: HashMap<(RobotId, u32), Time> = HashMap::new();
        let mut arrived: Vec<(RobotId, RobotId, u32, Time)> = Vec::new();
        let mut cut = Vec::new();
        let mut spans: BTreeMap<RobotId, Vec<_>> =
            lives.keys().map(|robot| (*robot, Vec::new())).collect();
        for (&robot, path) in lives
            .iter()
            .flat_map(|(robot, paths)| paths.iter().map(move |path| (robot, path)))
        {
            let mut life = Life::open(path, robot, 0)?;
            if setting_of(path, life.reader.header())?.only != Some(robot) {
                let name = &header.robots[robot.index()].name;
                return Err(Failure::file(
                    path,
                    format!("is not a trace of {name} alone"),
                ));
            }
            if life.reader.header().scenario != header.scenario {
                return Err(Failure::file(
                    path,
                    "is of another scenario than the first robot's trace",
                ));
            }
            let mut begin = None;
            while let Some((at, item)) = life.next()? {
                begin.get_or_insert(at);
                match item {
                    Piece::Record(Event::Sent { sequence, .. }) => {
                        sent.insert((robot, sequence), at);
                    }
                    Piece::Record(Event::Delivered { from, sequence }) => {
                        arrived.push((from, robot, sequence, at));
                    }
                    _ => {}
                }
            }
            let ending = Ending::of(life.reader.summary());
            let span = (begin.unwrap_or_default(), life.last, ending);
            spans.entry(robot).or_default().push(span);
            cut.extend(life.cut.map(|error| (life.path, robot, life.last, error)));
        }
        let mut exchanges = Exchanges {
            sent,
            spans,
            cut,
            ..Exchanges::default()
        };
        for (from, to, sequence, at) in arrived {
            match exchanges.sent.get(&(from, sequence)) {
                Some(sent) => exchanges.arrived.push(Exchange {
                    from,
                    to,
                    at: at.seconds(),
                    delay: at.seconds() - sent.seconds(),
                }),
                None => exchanges.strays.push((from, to, at)),
            }
        }
        Ok(exchanges)
    }

    /// How the robots' traces end, on one time axis.
    fn endings(&self, clocks: &BTreeMap<RobotId, Clock>) -> Endings {
        let corrected = |robot: RobotId, at: Time| match clocks.get(&robot) {
            Some(clock) => clock.corrected(at.seconds()),
            None => at.seconds(),
        };
        let lives = self.spans.iter().map(|(&robot, spans)| {
            let spans = spans.iter().map(|&(begin, end, ending)| Span {
                begin: corrected(robot, begin),
                end: corrected(robot, end),
                ending,
            });
            (robot, spans.collect())
        });
        let strays = self.strays.iter();
        Endings {
            lives: lives.collect(),
            strays: strays
                .map(|&(from, to, at)| (from, corrected(to, at)))
                .collect(),
        }
    }

    /// The robots' clocks; none for robots that cannot be compared with the first one.
    fn clocks(&self, robots: &[RobotId]) -> BTreeMap<RobotId, Clock> {
        let whole = Delays::of(&self.arrived).offsets(robots);
        let corrected = |exchange: &Exchange| {
            let ahead = whole.get(&exchange.to).map_or(0.0, |offset| offset.0);
            exchange.at - ahead
        };
        let mut parts: BTreeMap<i64, Vec<Exchange>> = BTreeMap::new();
        for exchange in &self.arrived {
            let part = (corrected(exchange) / PART).floor() as i64;
            parts.entry(part).or_default().push(*exchange);
        }
        let mut found: BTreeMap<RobotId, Vec<(f64, f64, f64)>> = BTreeMap::new();
        for (part, exchanges) in &parts {
            let middle = (*part as f64 + 0.5) * PART;
            for (robot, (ahead, error)) in Delays::of(exchanges).offsets(robots) {
                found.entry(robot).or_default().push((middle, ahead, error));
            }
        }
        let clocks = whole.into_iter().map(|(robot, (ahead, error))| {
            let constant = Clock {
                ahead,
                drift: 0.0,
                error,
            };
            // A line through a few parts of a short run would follow their errors.
            let found = found.get(&robot).filter(|found| found.len() >= 4);
            (robot, found.map_or(constant, |found| Clock::through(found)))
        });
        clocks.collect()
    }
}

/// The shortest time from sending to arrival, by the clocks of either end, for each pair of robots.
#[derive(Default)]
struct Delays(BTreeMap<(RobotId, RobotId), f64>);

impl Delays {
    fn of(exchanges: &[Exchange]) -> Delays {
        let mut delays = Delays::default();
        for &Exchange {
            from, to, delay, ..
        } in exchanges
        {
            let shortest = delays.0.entry((from, to)).or_insert(delay);
            *shortest = shortest.min(delay);
        }
        delays
    }

    /// How far each robot's clock is ahead of the first one's, and how exact that is; none for robots that cannot be
    /// compared. No datagram arrives before it was sent by the clocks that come of it: they are the middle between the
    /// latest and the earliest ones for which that holds (shortest paths, by Floyd and Warshall).
    fn offsets(&self, robots: &[RobotId]) -> BTreeMap<RobotId, (f64, f64)> {
        let mut shortest = self.0.clone();
        for &middle in robots {
            for &from in robots {
                for &to in robots {
                    let legs = (shortest.get(&(from, middle)), shortest.get(&(middle, to)));
                    if let (Some(first), Some(second)) = legs {
                        let way = first + second;
                        let known = shortest.entry((from, to)).or_insert(way);
                        *known = known.min(way);
                    }
                }
            }
        }
        let Some(&first) = robots.first() else {
            return BTreeMap::new();
        };
        let others = robots[1..].iter().filter_map(|&robot| {
            let (there, back) = (
                shortest.get(&(first, robot))?,
                shortest.get(&(robot, first))?,
            );
            Some((robot, ((there - back) / 2.0, (there + back).abs() / 2.0)))
        });
        others.chain([(first, (0.0, 0.0))]).collect()
    }
}

/// The trace of one life of a robot.
struct Life {
    path: PathBuf,
    robot: RobotId,
    /// Counts the robot's lives from 0.
    number: usize,
    reader: Reader<BufReader<File>>,
    last: Time,
    begun: bool,
    /// Why it cannot be read to its end.
    cut: Option<TraceError>,
}

/// A part of a life.
enum Piece {
    Record(Event),
    Inputs(Vec<u8>),
}

impl Life {
    fn open(path: &Path, robot: RobotId, number: usize) -> Result<Life, Failure> {
        Ok(Life {
            path: path.to_path_buf(),
            robot,
            number,
            reader: open(path)?,
            last: Time::ZERO,
            begun: false,
            cut: None,
        })
    }

    /// The next part, and its time by the robot's clock. A life that was cut short ends at the cut: a process that is
    /// killed while it replaces the end of its trace leaves there whatever it had got to.
    fn next(&mut self) -> Result<Option<(Time, Piece)>, Failure> {
        let next = match self.reader.next_item() {
            None => return Ok(None),
            Some(Err(error)) => match error {
                TraceError::Truncated(_)
                | TraceError::NoEnd(_)
                | TraceError::Damaged { .. }
                | TraceError::TooLong { .. } => {
                    self.cut = Some(error);
                    return Ok(None);
                }
                _ => return Err(unreadable(&self.path, &error)),
            },
            Some(Ok(Item::Record(record))) => (record.at, Piece::Record(record.event)),
            Some(Ok(Item::Inputs(Inputs { at, data }))) => (at, Piece::Inputs(data.to_vec())),
        };
        self.last = self.last.max(next.0);
        Ok(Some(next))
    }
}

/// An arrival waits for a sending that is at most so much later.
const MOST_EARLY: Duration = Duration::from_millis(100);

/// Writes all lives in the order of time; gives how many records there are.
fn write(
    lives: &BTreeMap<RobotId, Vec<PathBuf>>,
    clocks: &BTreeMap<RobotId, Clock>,
    sent: &HashMap<(RobotId, u32), Time>,
    endings: &Endings,
    header: &Header,
    out: &Path,
) -> Result<u64, Failure> {
    let cannot = |error: starl_trace::WriteError| Failure::file(out, error);
    let mut writer =
        Writer::new(create_now(out)?, header, &ViewOptions::default()).map_err(cannot)?;
    writer.expect_inputs(journal::VERSION).map_err(cannot)?;
    let shift = |robot: RobotId, at: Time| corrected(clocks, robot, at);
    // A line through the differences of clocks is not exact, so an arrival waits for its sending.
    let mut written: HashSet<(RobotId, u32)> = HashSet::new();
    let waits_until = |piece: &Option<Piece>, at: Time, written: &HashSet<_>| match piece {
        Some(Piece::Record(Event::Delivered { from, sequence })) => {
            let datagram = (*from, *sequence);
            let sent = shift(*from, *sent.get(&datagram)?);
            let later = sent.max(at + Duration(1_000));
            (!written.contains(&datagram) && sent < at + MOST_EARLY).then_some(later)
        }
        _ => None,
    };
    for robot in endings.never_seen() {
        let crash = Event::Fault(Fault::Crash);
        writer
            .event(Time::ZERO, Some(robot), &crash)
            .map_err(cannot)?;
    }
    let mut open: Vec<Life> = Vec::new();
    for (&robot, paths) in lives {
        for (number, path) in paths.iter().enumerate() {
            open.push(Life::open(path, robot, number)?);
        }
    }
    let mut waiting: Vec<Option<Piece>> = Vec::new();
    let mut queue = BinaryHeap::new();
    for (index, life) in open.iter_mut().enumerate() {
        let next = life.next()?;
        waiting.push(next.map(|(at, piece)| {
            queue.push(Reverse((shift(life.robot, at), index)));
            piece
        }));
    }
    let (mut end, mut finished) = (Time::ZERO, BTreeMap::new());
    while let Some(Reverse((at, index))) = queue.pop() {
        if let Some(later) = waits_until(&waiting[index], at, &written) {
            queue.push(Reverse((later, index)));
            continue;
        }
        let life = &mut open[index];
        let robot = life.robot;
        end = end.max(at);
        let fault =
            |writer: &mut Writer<File>, fault| writer.event(at, Some(robot), &Event::Fault(fault));
        if !std::mem::replace(&mut life.begun, true) && life.number > 0 {
            // A robot whose trace had reached its limit crashed at a time that is not known.
            if !endings.went_down(robot, life.number - 1) {
                fault(&mut writer, Fault::Crash).map_err(cannot)?;
            }
            fault(&mut writer, Fault::Restart).map_err(cannot)?;
            finished.remove(&robot);
        }
        match waiting[index].take() {
            Some(Piece::Record(event)) => {
                match event {
                    Event::Finished => {
                        finished.insert(robot, at);
                    }
                    Event::Sent { sequence, .. } => {
                        written.insert((robot, sequence));
                    }
                    _ => {}
                }
                writer.event(at, Some(robot), &event).map_err(cannot)?;
            }
            Some(Piece::Inputs(data)) => writer.inputs(at, &data).map_err(cannot)?,
            None => {}
        }
        match life.next()? {
            Some((next, piece)) => {
                // A batch of inputs begins before the records that came of them.
                queue.push(Reverse((shift(robot, next).max(at), index)));
                waiting[index] = Some(piece);
            }
            None if endings.went_down(robot, life.number) => {
                fault(&mut writer, Fault::Crash).map_err(cannot)?;
            }
            None => {}
        }
    }
    let records = writer.records();
    let is_reached = finished.len() == lives.values().filter(|paths| !paths.is_empty()).count();
    let outcome = Outcome {
        outcome: if is_reached { "reached" } else { "stopped" }.to_string(),
        digest: 0,
        end,
    };
    writer.finish(&outcome).map_err(cannot)?;
    Ok(records)
}

#[cfg(test)]
mod tests {
    use super::*;
    use starl_core::Random;

    #[test]
    fn no_datagram_arrives_before_it_was_sent() {
        for seed in 0..200 {
            let mut random = Random::keyed(seed, &[]);
            let robots: Vec<RobotId> = (0..6).map(RobotId).collect();
            let ahead: Vec<f64> = robots.iter().map(|_| random.between(-5.0, 5.0)).collect();
            let mut delays = Delays::default();
            for &from in &robots {
                for to in robots.iter().filter(|to| **to != from) {
                    // Not all robots have exchanged messages.
                    if from.0 + 1 == to.0 || to.0 + 1 == from.0 || random.chance(0.3) {
                        let delay = random.between(0.0001, 0.02);
                        let seen = delay + ahead[to.index()] - ahead[from.index()];
                        delays.0.insert((from, *to), seen);
                    }
                }
            }
            let offsets = delays.offsets(&robots);
            assert_eq!(offsets.len(), robots.len());
            for ((from, to), seen) in &delays.0 {
                let delay = seen - offsets[to].0 + offsets[from].0;
                assert!(delay > -1e-9, "seed {seed}: {from} to {to}: {delay}");
            }
            for (robot, (offset, error)) in &offsets {
                let truth = ahead[robot.index()] - ahead[0];
                assert!(
                    (offset - truth).abs() <= error + 1e-9,
                    "seed {seed}: {robot}"
                );
            }
        }
    }

    #[test]
    fn clocks_that_drift_are_joined_in_a_long_run() {
        for seed in 0..20 {
            let mut random = Random::keyed(seed, &[]);
            let robots: Vec<RobotId> = (0..4).map(RobotId).collect();
            let clocks: Vec<Clock> = robots
                .iter()
                .map(|robot| Clock {
                    ahead: f64::from(robot.0) * random.between(-5.0, 5.0),
                    drift: f64::from(robot.0) * random.between(-50e-6, 50e-6),
                    error: 0.0,
                })
                .collect();
            let shown = |robot: RobotId, time: f64| {
                let clock = clocks[robot.index()];
                time + clock.ahead + clock.drift * time
            };
            let mut arrived = Vec::new();
            for second in 0..1800 {
                for &from in &robots {
                    let to = RobotId((from.0 + 1 + second % 3) % 4);
                    let time = f64::from(second) + random.between(0.0, 1.0);
                    let arrival = time + 0.001 + random.between(0.0, 0.02);
                    let at = shown(to, arrival);
                    let delay = at - shown(from, time);
                    arrived.push(Exchange {
                        from,
                        to,
                        at,
                        delay,
                    });
                }
            }
            let exchanges = Exchanges {
                arrived,
                ..Exchanges::default()
            };
            let found = exchanges.clocks(&robots);
            assert_eq!(found.len(), robots.len());
            for (robot, clock) in &found {
                for time in [0.0, 900.0, 1800.0] {
                    let error = clock.corrected(shown(*robot, time)) - time;
                    assert!(error.abs() < 0.002, "seed {seed}: {robot}: {error} s");
                }
            }
        }
    }
}
