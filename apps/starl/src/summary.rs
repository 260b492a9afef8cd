//! The summary that people read, within 80 columns.

use crate::console::{grouped, rounded};
use crate::report::{Breach, Ending, Excused, Failed, Property, Report, Robot, UNUSED, remark};
use starl_sim::Outcome;
use starl_sim::engine::Drops;
use std::fmt::{self, Write};

/// Larger fleets are summed up by model instead of robot by robot.
const MOST_ROBOTS_LISTED: usize = 16;

/// A robot that moved less than this, metres, never moved.
const STILL: f64 = 0.01;

/// The most robots that are named in a remark on idle ones.
const MOST_NAMES_LISTED: usize = 5;

/// The summary as text.
pub fn text(report: &Report) -> String {
    let mut text = String::new();
    // Writing to a string does not fail.
    let _ = write(&mut text, report);
    text
}

/// The violations and failures alone, which `--quiet` also prints.
pub fn violations(report: &Report) -> String {
    let mut text = String::new();
    let _ = failures(&mut text, report);
    for property in &report.properties {
        if let Some(first) = &property.first {
            let _ = violation(&mut text, property, first, report);
        }
    }
    text
}

/// Why datagrams were dropped, after a colon; nothing if none were.
fn reasons(drops: &Drops) -> String {
    let counts = [
        (drops.range, "out of range"),
        (drops.partition, "partition"),
        (drops.down, "receiver down"),
        (drops.bandwidth, "queue full"),
        (drops.size, "too large"),
    ];
    let counts = counts.iter().filter(|(count, _)| *count > 0);
    let reasons: Vec<String> = counts
        .map(|(count, reason)| format!("{} {reason}", grouped(*count)))
        .collect();
    match reasons.is_empty() {
        true => String::new(),
        false => format!(": {}", reasons.join(", ")),
    }
}

fn write(text: &mut String, report: &Report) -> fmt::Result {
    writeln!(text, "{}: {}", report.title, ending(report))?;
    writeln!(text)?;
    let messages = &report.messages;
    writeln!(
        text,
        "time        {} s simulated in {} s, {} times real time",
        rounded(report.sim_seconds),
        rounded(report.wall_seconds),
        rounded(report.speed_factor)
    )?;
    writeln!(
        text,
        "messages    {} sent, {} delivered,\n            {} lost, {} dropped{}",
        grouped(messages.sent),
        grouped(messages.delivered),
        grouped(messages.lost),
        grouped(messages.dropped),
        reasons(&messages.drops)
    )?;
    if messages.retransmitted > 0 {
        let repeated = grouped(messages.retransmitted);
        writeln!(
            text,
            "            {repeated} retransmitted by Broadcast, Geocast or Unicast"
        )?;
    }
    writeln!(text, "collisions  {}", grouped(report.collisions))?;
    writeln!(text, "seed        {}", report.seed)?;
    writeln!(text, "digest      {}", report.digest)?;
    for (label, path) in [("trace", &report.trace), ("plot", &report.plot)] {
        if let Some(path) = path {
            writeln!(text, "{label:12}{path}")?;
        }
    }
    writeln!(text)?;
    match report.robots.len() {
        0..=MOST_ROBOTS_LISTED => robots(text, &report.robots)?,
        _ => models(text, &report.robots)?,
    }
    // Robots without a command to move are as they should be, if nothing is wrong.
    let moves = report.properties.iter().any(|property| {
        let is_motion = property.property.starts_with("reach_avoid.");
        match property.verdict {
            UNUSED => false,
            "holds" => is_motion,
            _ => true,
        }
    });
    idle(text, &report.robots, moves)?;
    if !report.properties.is_empty() {
        writeln!(text)?;
        properties(text, &report.properties)?;
    }
    let violations = violations(report);
    if !violations.is_empty() {
        write!(text, "\n{violations}")?;
    }
    Ok(())
}

fn ending(report: &Report) -> String {
    let progress = &report.progress;
    let at = format!("{:.1} s", report.sim_seconds);
    let done = format!(
        "{} of {} robots had finished",
        progress.finished, progress.robots
    );
    match report.outcome {
        Ending::Over(Outcome::Reached) if report.only_lasts() => format!("ran for {at}"),
        Ending::Over(Outcome::Violated) if report.only_lasts() => {
            format!("ran for {at}; a property was violated")
        }
        Ending::Over(Outcome::Reached) => match &report.open().collect::<Vec<_>>()[..] {
            [] => format!("goal reached after {at}"),
            open => format!(
                "goal reached after {at}, but {} is still open",
                listed(open)
            ),
        },
        Ending::Over(Outcome::Violated) => {
            format!("goal reached after {at}, but a property was violated")
        }
        Ending::Over(Outcome::TimedOut) => format!("goal not reached within {at}; {done}"),
        Ending::Over(Outcome::Failed) if progress.up == 0 => {
            format!("failed after {at}: no robot is left")
        }
        Ending::Over(Outcome::Failed) => {
            let robots = match progress.failed {
                1 => "1 robot".to_string(),
                many => format!("{many} robots"),
            };
            format!("failed after {at}: {robots} cannot continue; {done}")
        }
        Ending::Interrupted => format!("interrupted after {at}; {done}"),
    }
}

fn robots(text: &mut String, robots: &[Robot]) -> fmt::Result {
    let name_width = robots
        .iter()
        .map(|robot| robot.name.chars().count())
        .max()
        .unwrap_or(0);
    let name_width = name_width.clamp(5, 30);
    writeln!(
        text,
        "{:name_width$}  {:12}  {:>10}  {:>10}",
        "robot", "model", "distance", "waypoints"
    )?;
    for robot in robots {
        writeln!(
            text,
            "{:name_width$}  {:12}  {:>8.2} m  {:>10}",
            robot.name, robot.model, robot.distance_m, robot.way_points
        )?;
    }
    Ok(())
}

/// Robots that never moved, gave up a target, or never sent. `moves` says whether a fleet that stands still is remarkable.
fn idle(text: &mut String, robots: &[Robot], moves: bool) -> fmt::Result {
    let some = |is: &dyn Fn(&Robot) -> bool| {
        let mut names = Vec::new();
        names.extend(
            robots
                .iter()
                .filter(|robot| is(robot))
                .map(|robot| &*robot.name),
        );
        names
    };
    let still = some(&|robot| robot.distance_m < STILL);
    let silent = some(&|robot| robot.sent == 0);
    let gave_up = some(&|robot| robot.gave_up > 0);
    for (what, names) in [
        ("never moved", still),
        ("never sent a message", silent),
        ("gave up a target", gave_up),
    ] {
        // Where no robot moves or sends, the program is often not made for it.
        let is_expected = match what {
            "never moved" => !moves,
            "never sent a message" => true,
            _ => false,
        };
        let is_expected = is_expected && names.len() == robots.len();
        if !names.is_empty() && !is_expected {
            writeln!(text, "{what}: {}", listed(&names))?;
        }
    }
    Ok(())
}

/// The first names of a list, and how many more there are.
fn listed(names: &[&str]) -> String {
    let shown = names.len().min(MOST_NAMES_LISTED);
    let more = names.len() - shown;
    let shown = names[..shown].join(", ");
    match more {
        0 => shown,
        more => format!("{shown} and {} more", grouped(more as u64)),
    }
}

fn models(text: &mut String, robots: &[Robot]) -> fmt::Result {
    let mut names: Vec<&str> = robots.iter().map(|robot| robot.model).collect();
    names.sort_unstable();
    names.dedup();
    writeln!(
        text,
        "{:12}  {:>10}  {:>30}  {:>10}",
        "model", "robots", "distance least/mean/greatest", "waypoints"
    )?;
    for name in names {
        let of_kind = || robots.iter().filter(|robot| robot.model == name);
        let distances = || of_kind().map(|robot| robot.distance_m);
        let count = of_kind().count();
        let mean = distances().sum::<f64>() / count as f64;
        let (least, greatest) = (
            distances().fold(f64::INFINITY, f64::min),
            distances().fold(0.0, f64::max),
        );
        let spread = format!("{least:.2} / {mean:.2} / {greatest:.2} m");
        let way_points = of_kind().map(|robot| u64::from(robot.way_points)).sum();
        let (count, way_points) = (grouped(count as u64), grouped(way_points));
        writeln!(
            text,
            "{name:12}  {count:>10}  {spread:>30}  {way_points:>10}"
        )?;
    }
    Ok(())
}

fn properties(text: &mut String, properties: &[Property]) -> fmt::Result {
    let used = || properties.iter().filter(|entry| entry.verdict != UNUSED);
    let width = used().map(|entry| entry.property.len()).max();
    let width = width.unwrap_or(0).max(8);
    writeln!(text, "{:width$}  verdict", "property")?;
    for Property {
        property,
        verdict,
        violations,
        excused,
        ..
    } in used()
    {
        match violations {
            0 => verdict_line(text, property, width, verdict, excused)?,
            1 => writeln!(text, "{property:width$}  VIOLATED")?,
            n => writeln!(
                text,
                "{property:width$}  VIOLATED {} times",
                grouped(*n as u64)
            )?,
        }
    }
    match properties.len() - used().count() {
        0 => Ok(()),
        1 => writeln!(text, "1 more property does not apply (unused primitive)"),
        unused => writeln!(
            text,
            "{unused} more properties do not apply (unused primitives)"
        ),
    }
}

/// A verdict, and what was excused: beside it, or below it where there is no room.
fn verdict_line(
    text: &mut String,
    property: &str,
    width: usize,
    verdict: &str,
    excused: &[Excused],
) -> fmt::Result {
    const COLUMNS: usize = 80;
    let line = format!("{property:width$}  {verdict}{}", remark(excused));
    if line.chars().count() <= COLUMNS {
        return writeln!(text, "{line}");
    }
    let total: u64 = excused.iter().map(|excused| excused.count).sum();
    let total = grouped(total);
    writeln!(text, "{property:width$}  {verdict}; {total} excused:")?;
    for Excused { reason, count } in excused {
        writeln!(text, "{:width$}    {}: {reason}", "", grouped(*count))?;
    }
    Ok(())
}

/// More programs that cannot continue are counted, not listed.
const MOST_FAILURES_LISTED: usize = 8;

fn failures(text: &mut String, report: &Report) -> fmt::Result {
    for failed in report.failures.iter().take(MOST_FAILURES_LISTED) {
        let Failed {
            at_seconds,
            robot,
            text: reason,
        } = failed;
        writeln!(text, "failed: {robot} at {at_seconds:.3} s\n  {reason}")?;
    }
    let more = report.failures.len().saturating_sub(MOST_FAILURES_LISTED);
    if more > 0 {
        writeln!(text, "failed: {} more", grouped(more as u64))?;
    }
    match report.failures.is_empty() {
        true => Ok(()),
        false => writeln!(text, "  to see it again: {}", report.replay),
    }
}

fn violation(
    text: &mut String,
    property: &Property,
    first: &Breach,
    report: &Report,
) -> fmt::Result {
    write!(
        text,
        "violated: {} at {:.3} s",
        property.property, first.at_seconds
    )?;
    if !first.robots.is_empty() {
        write!(text, " by {}", first.robots.join(", "))?;
    }
    writeln!(text, "\n  {}", first.text)?;
    writeln!(text, "  to see it again: {}", report.replay)
}
