//! Views for Foxglove, derived from the records, in Foxglove's own schemas.
//!
//! A view contains only data of the records, is rounded to millionths, and is written at most once a period; readers
//! skip views. After a jump in time most panels show only the last message of a topic, so each message is complete: all
//! frames together, a path from its beginning.

mod lines;
mod pose;
mod primitive;
mod scene;
mod trail;

use crate::output::Output;
use crate::schema;
use crate::{Header, RobotEntry, WriteError};
use starl_core::{Duration, Event, Pose, RobotId, Time};
use std::collections::BTreeSet;
use std::io::Write;
use trail::Trail;

/// The frame of the world: metres, z up.
const WORLD: &str = "world";
/// This long between two paths of a robot.
const PATH_PERIOD: Duration = Duration::from_seconds(5);

/// Which views to write beside the records.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ViewOptions {
    /// Whether to write any.
    pub enabled: bool,
    /// At least this long between two poses of a robot; default 100 ms.
    pub period: Duration,
    /// Fleets larger than this get no topics of their own for each robot, only frames and bodies;
    /// default 64.
    pub most_robot_topics: u32,
}

impl Default for ViewOptions {
    fn default() -> ViewOptions {
        ViewOptions {
            enabled: true,
            period: Duration::from_millis(100),
            most_robot_topics: 64,
        }
    }
}

impl ViewOptions {
    /// Records only.
    pub fn none() -> ViewOptions {
        ViewOptions {
            enabled: false,
            ..ViewOptions::default()
        }
    }
}

/// The state of the views; nothing if none are written.
pub(crate) struct Views(Option<State>);

struct State {
    period: Duration,
    frames: u16,
    log: u16,
    marks: u16,
    robots: Vec<RobotView>,
    /// The time of the last record, and when poses are due again.
    now: Time,
    due: Time,
    paths_due: Time,
    changed: bool,
}

/// A robot as it was last seen.
struct RobotView {
    name: String,
    color: primitive::Color,
    pose: Latest,
    estimate: Latest,
    path_channel: Option<u16>,
    trail: Trail,
}

/// A pose that may not have been shown yet.
#[derive(Default)]
struct Latest {
    pose: Option<Pose>,
    changed: bool,
    channel: Option<u16>,
}

impl Latest {
    fn set(&mut self, pose: Pose) {
        self.pose = Some(pose);
        self.changed = true;
    }
}

impl Views {
    /// Makes the channels, and shows what does not move.
    pub fn new<W: Write>(
        output: &mut Output<W>,
        header: &Header,
        options: &ViewOptions,
    ) -> Result<Views, WriteError> {
        if !options.enabled {
            return Ok(Views(None));
        }
        let scene_text = schema::scene_update();
        let scene = ("foxglove.SceneUpdate", scene_text.as_str());
        let world = output.channel("/world", scene.0, scene.1)?;
        let bodies = output.channel("/bodies", scene.0, scene.1)?;
        let mut state = State {
            period: options.period,
            frames: output.channel(
                "/frames",
                "foxglove.FrameTransforms",
                &schema::frame_transforms(),
            )?,
            log: output.channel("/log", "foxglove.Log", &schema::log())?,
            marks: output.channel("/marks", scene.0, scene.1)?,
            robots: named(&header.robots),
            now: Time::ZERO,
            due: Time::ZERO,
            paths_due: Time::ZERO + PATH_PERIOD,
            changed: false,
        };
        if header.robots.len() as u64 <= u64::from(options.most_robot_topics) {
            let text = schema::pose_in_frame();
            for robot in &mut state.robots {
                let topic = |what: &str| format!("/robot/{}/{what}", robot.name);
                let pose = "foxglove.PoseInFrame";
                robot.pose.channel = Some(output.channel(&topic("pose"), pose, &text)?);
                robot.estimate.channel = Some(output.channel(&topic("estimate"), pose, &text)?);
                robot.path_channel = Some(output.channel(&topic("path"), scene.0, scene.1)?);
            }
        }
        scene::world(&mut output.json, header);
        output.send_view(world, Time::ZERO)?;
        scene::bodies(&mut output.json, &header.robots, &state.robots);
        output.send_view(bodies, Time::ZERO)?;
        Ok(Views(Some(state)))
    }

    /// Advances to `at`: writes the view of all earlier records, if it is due.
    pub fn advance<W: Write>(
        &mut self,
        output: &mut Output<W>,
        at: Time,
    ) -> Result<(), WriteError> {
        if let Views(Some(state)) = self
            && at > state.now
        {
            if state.changed && state.now >= state.due {
                state.show(output)?;
            }
            state.now = at;
        }
        Ok(())
    }

    /// Records an event; marks and lines of the log are shown at once.
    pub fn event<W: Write>(
        &mut self,
        output: &mut Output<W>,
        at: Time,
        robot: Option<RobotId>,
        event: &Event,
    ) -> Result<(), WriteError> {
        let Views(Some(state)) = self else {
            return Ok(());
        };
        let view = robot.and_then(|robot| state.robots.get_mut(robot.index()));
        match (event, view) {
            (Event::Moved(pose), Some(view)) => {
                view.pose.set(*pose);
                state.changed = true;
            }
            (Event::Estimated(pose), Some(view)) => {
                view.estimate.set(*pose);
                state.changed = true;
            }
            (Event::Draw(mark), Some(view)) => {
                scene::mark(&mut output.json, at, view, mark);
                output.send_view(state.marks, at)?;
            }
            (event, view) => {
                if let Some((level, text)) = lines::line(event) {
                    let name = view.map_or(WORLD, |view| view.name.as_str());
                    lines::encode(&mut output.json, at, level, name, &text);
                    output.send_view(state.log, at)?;
                }
            }
        }
        Ok(())
    }

    /// Writes the remaining views.
    pub fn finish<W: Write>(&mut self, output: &mut Output<W>) -> Result<(), WriteError> {
        match &mut self.0 {
            Some(state) => {
                state.paths_due = Time::ZERO;
                state.show(output)
            }
            None => Ok(()),
        }
    }
}

impl State {
    /// Shows the poses of all robots as of now, and their paths if those are due.
    fn show<W: Write>(&mut self, output: &mut Output<W>) -> Result<(), WriteError> {
        let at = self.now;
        pose::frames(&mut output.json, at, &self.robots);
        output.send_view(self.frames, at)?;
        let paths = at >= self.paths_due;
        for robot in &mut self.robots {
            for latest in [&mut robot.pose, &mut robot.estimate] {
                if let (Some(channel), Some(pose), true) =
                    (latest.channel, latest.pose, latest.changed)
                {
                    pose::in_frame(&mut output.json, at, &pose);
                    output.send_view(channel, at)?;
                }
                latest.changed = false;
            }
            if let (Some(channel), Some(pose)) = (robot.path_channel, robot.pose.pose) {
                robot.trail.extend(pose.position);
                if paths {
                    scene::path(&mut output.json, at, robot);
                    output.send_view(channel, at)?;
                }
            }
        }
        self.due = at + self.period;
        if paths {
            self.paths_due = at + PATH_PERIOD;
        }
        self.changed = false;
        Ok(())
    }
}

/// The robots by the names of their frames and topics: their own, unless that is missing or taken.
fn named(robots: &[RobotEntry]) -> Vec<RobotView> {
    let mut taken = BTreeSet::from([WORLD.to_string(), String::new()]);
    (robots.iter().enumerate())
        .map(|(index, robot)| {
            let mut name = robot.name.replace('/', "_");
            while !taken.insert(name.clone()) {
                name = format!("{name}#{}", robot.id);
            }
            RobotView {
                name,
                color: primitive::palette(index),
                pose: Latest::default(),
                estimate: Latest::default(),
                path_channel: None,
                trail: Trail::default(),
            }
        })
        .collect()
}
