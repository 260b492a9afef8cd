//! The topics on which StarL's own records travel: one for each kind of event.

use starl_core::Event;

/// All topics of StarL's own start with this; topics beside it are views, made for display.
pub const PREFIX: &str = "/starl/";

/// A topic of StarL's own.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Topic {
    /// [`Event::Moved`].
    Pose,
    /// [`Event::Estimated`].
    Estimate,
    /// [`Event::Sent`].
    Sent,
    /// [`Event::Delivered`].
    Delivered,
    /// [`Event::Dropped`].
    Dropped,
    /// [`Event::Collided`].
    Collision,
    /// [`Event::Action`].
    Action,
    /// [`Event::Program`].
    Program,
    /// [`Event::Primitive`].
    Primitive,
    /// [`Event::Log`].
    Log,
    /// [`Event::Draw`].
    Mark,
    /// [`Event::Fault`].
    Fault,
    /// [`Event::Discovered`].
    Discovered,
    /// [`Event::Finished`] and [`Event::Failed`].
    Status,
    /// [`Event::Violated`].
    Violation,
    /// [`Event::Took`] and [`Event::PutDown`].
    Thing,
    /// [`Event::Intervention`].
    Intervention,
    /// How the run ended: [`crate::Summary`], the last record of a whole trace.
    Summary,
}

impl Topic {
    /// All topics, in the order in which the writer numbers its channels.
    pub const ALL: [Topic; 18] = [
        Topic::Pose,
        Topic::Estimate,
        Topic::Sent,
        Topic::Delivered,
        Topic::Dropped,
        Topic::Collision,
        Topic::Action,
        Topic::Program,
        Topic::Primitive,
        Topic::Log,
        Topic::Mark,
        Topic::Fault,
        Topic::Discovered,
        Topic::Status,
        Topic::Violation,
        Topic::Thing,
        Topic::Intervention,
        Topic::Summary,
    ];

    /// Its name in the file.
    pub fn name(self) -> &'static str {
        match self {
            Topic::Pose => "/starl/pose",
            Topic::Estimate => "/starl/estimate",
            Topic::Sent => "/starl/sent",
            Topic::Delivered => "/starl/delivered",
            Topic::Dropped => "/starl/dropped",
            Topic::Collision => "/starl/collision",
            Topic::Action => "/starl/action",
            Topic::Program => "/starl/program",
            Topic::Primitive => "/starl/primitive",
            Topic::Log => "/starl/log",
            Topic::Mark => "/starl/mark",
            Topic::Fault => "/starl/fault",
            Topic::Discovered => "/starl/discovered",
            Topic::Status => "/starl/status",
            Topic::Violation => "/starl/violation",
            Topic::Thing => "/starl/thing",
            Topic::Intervention => "/starl/intervention",
            Topic::Summary => "/starl/summary",
        }
    }

    /// The topic with this name.
    pub fn named(name: &str) -> Option<Topic> {
        Topic::ALL.into_iter().find(|topic| topic.name() == name)
    }

    /// The topic that carries this event.
    pub fn of(event: &Event) -> Topic {
        match event {
            Event::Moved(_) => Topic::Pose,
            Event::Estimated(_) => Topic::Estimate,
            Event::Sent { .. } => Topic::Sent,
            Event::Delivered { .. } => Topic::Delivered,
            Event::Dropped { .. } => Topic::Dropped,
            Event::Collided { .. } => Topic::Collision,
            Event::Action(_) => Topic::Action,
            Event::Program { .. } => Topic::Program,
            Event::Primitive { .. } => Topic::Primitive,
            Event::Log { .. } => Topic::Log,
            Event::Draw(_) => Topic::Mark,
            Event::Fault(_) => Topic::Fault,
            Event::Discovered(_) => Topic::Discovered,
            Event::Finished | Event::Failed(_) => Topic::Status,
            Event::Violated { .. } => Topic::Violation,
            Event::Took(_) | Event::PutDown { .. } => Topic::Thing,
            Event::Intervention(_) => Topic::Intervention,
        }
    }
}

/// The topic of the inputs of robots, and how they are encoded.
pub(crate) const INPUTS: &str = "/starl/inputs";
pub(crate) const INPUTS_SCHEMA: &str = "starl.Inputs";
pub(crate) const INPUTS_ENCODING: &str = "postcard";
/// The key, in the metadata of that channel, of the version of the encoding.
pub(crate) const VERSION: &str = "version";

/// The metadata record with which a trace begins.
pub(crate) const METADATA: &str = "starl";
/// The attachment with the scenario.
pub(crate) const SCENARIO: &str = "starl/scenario.toml";
/// Attachments of files that the scenario names have this before the name.
pub(crate) const FILES: &str = "starl/files/";
/// The attachment with what properties are judged by.
pub(crate) const SETTING: &str = "starl/setting.json";
/// The attachment with the fleet and the world, the last before the records.
pub(crate) const WORLD: &str = "starl/world.json";
