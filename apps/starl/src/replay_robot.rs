//! `starl replay --robot`: runs one robot's software again on its recorded inputs, without the simulator, and compares
//! its effects bit by bit.

use crate::args::ReplayArguments;
use crate::changed_program;
use crate::console::{self, counted, grouped};
use crate::failure::Failure;
use crate::replay::{
    as_far_as_it_goes, inputs, missing_end, of_real_robots, open, other_version, unreadable,
};
use starl_catalog::programs::Registry;
use starl_core::{Effect, Event, Intervention, Program, RobotId};
use starl_host::{Departure, Difference, Replayer, journal};
use starl_trace::{Header, Inputs, Item, TraceError};
use std::path::Path;

/// Replays the robot called `name`; whether it does the same.
pub fn replay(
    arguments: &ReplayArguments,
    name: &str,
    registry: &Registry,
) -> Result<bool, Failure> {
    let path = arguments.trace.as_path();
    let header = open(path)?.header().clone();
    let Replayed { robot, like } = robot(path, &header, name)?;
    if of_real_robots(&header).is_some_and(|setting| setting.only.is_none()) {
        let what = format!(
            "is joined from several robots on one time axis, which is not the clock of {name}; replay its own trace, such as {name}.1.mcap"
        );
        return Err(Failure::file(path, what));
    }
    let mut replayer = Replayer::new(program(arguments, &header, like, registry)?);
    let Outcome { departure, cut } = feed(path, robot, &header, &mut replayer)?;
    let agreed = format!(
        "{}, {}",
        counted(replayer.entries() as usize, "input"),
        match replayer.lives() {
            1 => "1 life".to_string(),
            lives => format!("{} lives", grouped(u64::from(lives))),
        }
    );
    let (same, text) = match (departure, &cut) {
        (None, None) => (true, format!("identical: {agreed}")),
        (None, Some(_)) => (true, as_far_as_it_goes(&agreed)),
        (Some(Departure::Different(found)), _) => {
            let hint = match arguments.program {
                Some(_) => String::new(),
                None => other_version(&header),
            };
            (false, tell(&found) + &hint)
        }
        (Some(Departure::NotStarted), _) => {
            let what = format!("the inputs of {name} begin in the middle of its run");
            return Err(Failure::file(path, what));
        }
    };
    let with = match &arguments.program {
        Some(program) => format!(" with {}", program.display()),
        None => String::new(),
    };
    let end = missing_end(cut.as_ref());
    console::print(&format!(
        "{}: robot {name}{with}: {text}{end}\n",
        path.display()
    ))?;
    Ok(same)
}

/// The robot to replay.
struct Replayed {
    robot: RobotId,
    /// The robot of the scenario with the same program and parameters: itself, unless it joined during the run.
    like: RobotId,
}

/// The robot called so, which may have joined during the run.
fn robot(path: &Path, header: &Header, name: &str) -> Result<Replayed, Failure> {
    if let Some(found) = header.robots.iter().find(|robot| robot.name == name) {
        let robot = found.id;
        return Ok(Replayed { robot, like: robot });
    }
    /// A list of more names would not help.
    const MOST: usize = 20;
    let joined = joined(path, header)?;
    let mut names: Vec<&str> = header.robots.iter().map(|robot| &*robot.name).collect();
    for (number, (joined_name, like)) in joined.iter().enumerate() {
        if joined_name == name {
            let robot = RobotId((header.robots.len() + number) as u32);
            return Ok(Replayed { robot, like: *like });
        }
        names.push(joined_name);
    }
    let more = match names.len() > MOST {
        true => format!(" and {} more", grouped((names.len() - MOST) as u64)),
        false => String::new(),
    };
    let names = names[..names.len().min(MOST)].join(", ");
    Err(Failure(format!(
        "--robot {name}: no robot in {} is called this; the robots are {names}{more}",
        path.display()
    )))
}

/// The names of the robots that joined during the run, in the order of their numbers, each with the robot of the
/// scenario whose program it runs.
fn joined(path: &Path, header: &Header) -> Result<Vec<(String, RobotId)>, Failure> {
    let (mut joining, mut joined) = (Vec::new(), Vec::<(String, RobotId)>::new());
    let mut reader = open(path)?;
    while let Some(item) = reader.next_item() {
        let record = match item {
            Ok(Item::Record(record)) => record,
            Ok(Item::Inputs(_)) => continue,
            Err(error) if error.is_missing_end() => break,
            Err(error) => return Err(unreadable(path, &error)),
        };
        match (record.event, record.robot) {
            (Event::Intervention(what), None) => {
                let Intervention::Join { name, pose, like } = *what else {
                    continue;
                };
                joining.push((name, pose, like));
            }
            // An intervention that is impossible at its time is not followed by a robot.
            (Event::Moved(pose), Some(robot))
                if robot.index() == header.robots.len() + joined.len() =>
            {
                let mut places = joining.iter();
                if let Some(found) =
                    places.position(|(_, place, _)| place.position == pose.position)
                {
                    let (name, _, like) = joining.swap_remove(found);
                    let earlier = like.index().checked_sub(header.robots.len());
                    let earlier = earlier.and_then(|number| joined.get(number));
                    let like = earlier.map_or(like, |(_, like)| *like);
                    joined.push((name, like));
                }
            }
            _ => {}
        }
    }
    Ok(joined)
}

/// The recorded program of the robot, or the new one.
fn program(
    arguments: &ReplayArguments,
    header: &Header,
    robot: RobotId,
    registry: &Registry,
) -> Result<Box<dyn Program>, Failure> {
    let path = arguments.trace.as_path();
    let application = inputs(path, header, registry)?;
    let application = match &arguments.program {
        Some(program) => {
            changed_program::read(path, header, &application, robot, program, registry)?
        }
        None => application,
    };
    (application.program_of(robot)).map_err(|complaint| Failure::file(path, complaint.message))
}

/// How far a replay came.
struct Outcome {
    departure: Option<Departure>,
    /// Why the trace ends before the run.
    cut: Option<TraceError>,
}

/// Feeds the recorded inputs up to the first difference, or to the end.
fn feed(
    path: &Path,
    robot: RobotId,
    header: &Header,
    replayer: &mut Replayer,
) -> Result<Outcome, Failure> {
    let mut reader = open(path)?;
    let mut recorded = journal::Reader::new(robot);
    let (mut departure, mut cut, mut is_checked) = (None, None, false);
    while let Some(item) = reader.next_item() {
        let Inputs { at, data } = match item {
            Ok(Item::Inputs(inputs)) => inputs,
            Ok(Item::Record(_)) => continue,
            Err(error) if error.is_missing_end() => {
                cut = Some(error);
                break;
            }
            Err(error) => return Err(unreadable(path, &error)),
        };
        if !std::mem::replace(&mut is_checked, true) {
            check_version(path, header, reader.inputs_version())?;
        }
        let mut take = |at, observed: starl_host::Observed<'_>| {
            if departure.is_none() {
                departure = replayer.observe(at, observed).err();
            }
        };
        recorded
            .read(at, &data, &mut take)
            .map_err(|error| Failure::file(path, format!("inputs at {at}: {error}")))?;
        if departure.is_some() {
            break;
        }
    }
    if reader.inputs_version().is_none() {
        return Err(Failure::file(
            path,
            "contains no inputs of robots; record it with `starl run --trace FILE --inputs`",
        ));
    }
    Ok(Outcome { departure, cut })
}

fn check_version(path: &Path, header: &Header, version: Option<u32>) -> Result<(), Failure> {
    let ours = journal::VERSION;
    match version {
        Some(version) if version != ours => Err(Failure::file(
            path,
            format!(
                "its inputs have version {version}, and this command reads version {ours}: use StarL {}",
                header.starl_version
            ),
        )),
        _ => Ok(()),
    }
}

/// Says where the software departs from the recording.
fn tell(found: &Difference) -> String {
    let place = found.effect();
    let show = |effects: &[Effect]| match effects.get(place) {
        Some(effect) => format!(
            "{}, number {} of {}",
            shown(effect),
            place + 1,
            effects.len()
        ),
        None => format!("nothing after {}", counted(place, "effect")),
    };
    format!(
        "different: first at {:.9} s, after {} equal inputs\n  input:     {}\n  recorded:  {}\n  run again: {}",
        found.at.seconds(),
        grouped(found.agreed),
        shown(&found.input),
        show(&found.recorded),
        show(&found.replayed)
    )
}

/// As much of a value as can be read at a glance.
fn shown(value: &impl std::fmt::Debug) -> String {
    const LONGEST: usize = 400;
    let text = format!("{value:?}");
    match text.char_indices().nth(LONGEST) {
        Some((end, _)) => format!("{}...", &text[..end]),
        None => text,
    }
}
