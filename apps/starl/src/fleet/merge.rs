//! `starl fleet merge`: joins the traces of a fleet's robots on one time axis.
//!
//! The differences of the robots' clocks are computed from the traces: a datagram is recorded at its sender and at its
//! receiver. The shortest delays in both directions between two robots bound the difference of their clocks (as in RFC
//! 5905). One difference is used for the whole run.

use super::file::Fleet;
use super::folder::Folder;
use crate::args::FleetMergeArguments;
use crate::console;
use crate::failure::Failure;
use crate::output::create_now;
use crate::replay::{open, unreadable};
use starl_catalog::programs::Registry;
use starl_core::event::{Event, Fault};
use starl_core::{RobotId, Time};
use starl_host::journal;
use starl_properties::Setting;
use starl_trace::{Header, Inputs, Item, Outcome, Reader, ViewOptions, Writer};
use std::cmp::Reverse;
use std::collections::{BTreeMap, BinaryHeap, HashMap};
use std::fs::File;
use std::io::BufReader;
use std::path::{Path, PathBuf};

/// Merges what the last run of a fleet has left.
pub fn run(arguments: &FleetMergeArguments, registry: &Registry) -> Result<bool, Failure> {
    let fleet = Fleet::read(&arguments.fleet, None, registry)?;
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
    /// How far each robot's clock was ahead of the first one's, and how exact that is, seconds.
    offsets: BTreeMap<RobotId, (f64, f64)>,
    /// Robots of which there is no trace.
    missing: Vec<RobotId>,
    /// Robots whose clocks could not be compared.
    apart: Vec<RobotId>,
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
        let (mut most, mut exact) = (0.0_f64, 0.0_f64);
        for (offset, error) in self.offsets.values() {
            (most, exact) = (most.max(offset.abs()), exact.max(*error));
        }
        if self.offsets.len() > 1 {
            text += &format!(
                "clocks: up to {:.3} ms apart, known to {:.3} ms\n",
                most * 1e3,
                exact * 1e3
            );
        }
        for robot in &self.missing {
            text += &format!("{}: its trace is missing\n", name(robot));
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
    let lives: BTreeMap<RobotId, Vec<PathBuf>> = robots
        .map(|robot| (robot.id, folder.traces_of(&robot.name)))
        .collect();
    let missing: Vec<RobotId> = (lives.iter().filter(|(_, paths)| paths.is_empty()))
        .map(|(robot, _)| *robot)
        .collect();
    let Some(first) = lives.values().flatten().next() else {
        return Err(Failure::file(&folder.0, "holds no traces of robots"));
    };
    let header = header(first)?;
    let delays = Delays::read(&lives, &header)?;
    let recorded: Vec<RobotId> = lives
        .keys()
        .copied()
        .filter(|robot| !missing.contains(robot))
        .collect();
    let offsets = delays.offsets(&recorded);
    let apart = lives
        .keys()
        .filter(|robot| !offsets.contains_key(robot) && !missing.contains(robot));
    let merged = Merged {
        records: write(&lives, &offsets, &header, out)?,
        apart: apart.copied().collect(),
        missing,
        offsets,
    };
    Ok(merged)
}

/// The header of one robot's trace, as that of a trace of all.
fn header(path: &Path) -> Result<Header, Failure> {
    let mut header = open(path)?.header().clone();
    let setting: Setting = serde_json::from_str(&header.setting).map_err(|error| {
        Failure::file(path, format!("the attachment starl/setting.json: {error}"))
    })?;
    let setting = Setting {
        only: None,
        ..setting
    };
    header.setting =
        serde_json::to_string_pretty(&setting).map_err(|error| Failure::file(path, error))?;
    Ok(header)
}

/// The shortest time from sending to arrival, by the clocks of either end, for each pair of robots.
#[derive(Default)]
struct Delays(BTreeMap<(RobotId, RobotId), f64>);

impl Delays {
    fn read(lives: &BTreeMap<RobotId, Vec<PathBuf>>, header: &Header) -> Result<Delays, Failure> {
        let mut sent: HashMap<(RobotId, u32), Time> = HashMap::new();
        let mut arrived: Vec<(RobotId, RobotId, u32, Time)> = Vec::new();
        for (&robot, path) in lives
            .iter()
            .flat_map(|(robot, paths)| paths.iter().map(move |path| (robot, path)))
        {
            let mut life = Life::open(path, robot, 0)?;
            if life.reader.header().scenario != header.scenario {
                return Err(Failure::file(
                    path,
                    "is of another scenario than the first robot's trace",
                ));
            }
            while let Some((at, item)) = life.next()? {
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
        }
        let mut delays = Delays::default();
        for (from, to, sequence, at) in arrived {
            if let Some(sent) = sent.get(&(from, sequence)) {
                let delay = at.0 as f64 * 1e-9 - sent.0 as f64 * 1e-9;
                let shortest = delays.0.entry((from, to)).or_insert(delay);
                *shortest = shortest.min(delay);
            }
        }
        Ok(delays)
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
        })
    }

    /// The next part, and its time by the robot's clock. A life that was cut short ends at the cut.
    fn next(&mut self) -> Result<Option<(Time, Piece)>, Failure> {
        let next = match self.reader.next_item() {
            None => return Ok(None),
            Some(Err(error)) if error.is_missing_end() => return Ok(None),
            Some(Err(error)) => return Err(unreadable(&self.path, &error)),
            Some(Ok(Item::Record(record))) => (record.at, Piece::Record(record.event)),
            Some(Ok(Item::Inputs(Inputs { at, data }))) => (at, Piece::Inputs(data.to_vec())),
        };
        self.last = self.last.max(next.0);
        Ok(Some(next))
    }
}

/// Writes all lives in the order of time; gives how many records there are.
fn write(
    lives: &BTreeMap<RobotId, Vec<PathBuf>>,
    offsets: &BTreeMap<RobotId, (f64, f64)>,
    header: &Header,
    out: &Path,
) -> Result<u64, Failure> {
    let cannot = |error: starl_trace::WriteError| Failure::file(out, error);
    let mut writer =
        Writer::new(create_now(out)?, header, &ViewOptions::default()).map_err(cannot)?;
    writer.expect_inputs(journal::VERSION).map_err(cannot)?;
    let shift = |robot: RobotId, at: Time| {
        let ahead = offsets.get(&robot).map_or(0.0, |offset| offset.0);
        Time(at.0.saturating_add_signed(-(ahead * 1e9) as i64))
    };
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
        let life = &mut open[index];
        let robot = life.robot;
        end = end.max(at);
        let fault =
            |writer: &mut Writer<File>, fault| writer.event(at, Some(robot), &Event::Fault(fault));
        if !std::mem::replace(&mut life.begun, true) && life.number > 0 {
            fault(&mut writer, Fault::Restart).map_err(cannot)?;
            finished.remove(&robot);
        }
        match waiting[index].take() {
            Some(Piece::Record(event)) => {
                if event == Event::Finished {
                    finished.insert(robot, at);
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
            None if life.number + 1 < lives[&robot].len() => {
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
}
