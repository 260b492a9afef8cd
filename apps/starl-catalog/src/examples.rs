//! The examples, with all their files, so that `starl run race` works in any folder and in a browser.
//!
//! To add an example, write its folder under `examples/` and a line in [`EXAMPLES`].

use crate::language::SUFFIX;
use starl_core::FileError;
use starl_sim::read::{Loader, Source};

/// An example: a scenario and the files that it names.
#[derive(Clone, Copy, Debug)]
pub struct Example {
    /// Its name on the command line.
    pub name: &'static str,
    /// A description, in one line.
    pub summary: &'static str,
    /// Its scenario's path in the repository, by which errors call it.
    pub path: &'static str,
    /// The scenario.
    pub text: &'static str,
    /// The files that the scenario names, by the paths it has for them.
    pub files: &'static [(&'static str, &'static [u8])],
}

/// A scenario for programs without one: a few robots on the floor, and waypoints. It names no program.
pub const DEFAULT_SCENARIO: &str = include_str!("default.toml");

/// An example: its name, what one sees, its folder, and the scenario and its files in there.
macro_rules! example {
    ($name:literal, $summary:literal, $folder:literal, $scenario:literal, [$($file:literal),+]) => {
        Example {
            name: $name,
            summary: $summary,
            path: concat!("examples/", $folder, "/", $scenario),
            text: include_str!(concat!("../../../examples/", $folder, "/", $scenario)),
            files: &[$((
                $file,
                include_bytes!(concat!("../../../examples/", $folder, "/", $file)),
            )),+],
        }
    };
}

/// All examples.
pub const EXAMPLES: &[Example] = &[
    example!(
        "race",
        "ground robots and quadcopters race through waypoints",
        "race",
        "race.toml",
        [
            "race.starl",
            "worlds/four.wpt",
            "worlds/Obstacles.wpt",
            "worlds/start.wpt"
        ]
    ),
    example!(
        "formation",
        "robots that know two others each form a regular polygon",
        "formation",
        "formation.toml",
        ["formation.starl"]
    ),
    example!(
        "formation-space",
        "quadcopters form a regular polygon that is tilted",
        "formation",
        "space.toml",
        ["formation.starl"]
    ),
    example!(
        "line",
        "robots spread evenly on the line between two of them",
        "line",
        "line.toml",
        ["line.starl"]
    ),
    example!(
        "intersection",
        "four cars agree on the order in which they cross zones",
        "intersection",
        "intersection.toml",
        [
            "intersection.starl",
            "light.starl",
            "junction.starl",
            "signals.starl",
            "traffic.starl"
        ]
    ),
    example!(
        "intersection-stream",
        "a hundred cars arrive at the intersection at random",
        "intersection",
        "stream.toml",
        [
            "intersection.starl",
            "light.starl",
            "junction.starl",
            "signals.starl",
            "traffic.starl"
        ]
    ),
    example!(
        "mutex",
        "robots hold sets of resources, one robot at a time",
        "primitives",
        "mutex.toml",
        ["mutex.starl"]
    ),
    example!(
        "election",
        "robots elect a leader again and again",
        "primitives",
        "election.toml",
        ["election.starl"]
    ),
    example!(
        "messages",
        "robots send letters to areas and get receipts",
        "primitives",
        "messages.toml",
        ["messages.starl"]
    ),
    example!(
        "broadcast",
        "robots broadcast numbers, which all receive in one order",
        "primitives",
        "broadcast.toml",
        ["broadcast.starl"]
    ),
    example!(
        "flocking",
        "groups of robots travel in lines abreast",
        "flocking",
        "flocking.toml",
        ["flocking.starl"]
    ),
    example!(
        "crossing",
        "a trained network takes robots past each other",
        "crossing",
        "crossing.toml",
        ["crossing.starl", "crossing.onnx"]
    ),
    example!(
        "diffusion",
        "robots spread out by their proximity sensors alone",
        "diffusion",
        "diffusion.toml",
        ["diffusion.starl"]
    ),
    example!(
        "maze",
        "robots look for goals and report the walls they meet",
        "maze",
        "maze.toml",
        ["maze.starl"]
    ),
    example!(
        "auction",
        "robots share out places to visit by bidding for them",
        "auction",
        "auction.toml",
        ["auction.starl"]
    ),
    example!(
        "traffic-signs",
        "robots stop at a crossing and go over it in turn",
        "traffic-signs",
        "traffic-signs.toml",
        ["traffic-signs.starl"]
    ),
    example!(
        "light-painting",
        "robots share out a drawing and draw it with lights",
        "light-painting",
        "light-painting.toml",
        ["light-painting.starl", "house.svg"]
    ),
    example!(
        "search",
        "robots look for an item in the rooms of a house",
        "search",
        "search.toml",
        ["search.starl", "worlds/house.wpt"]
    ),
    example!(
        "search-building",
        "twenty robots look for an item in fifty rooms",
        "search",
        "building.toml",
        ["search.starl", "worlds/building.wpt"]
    ),
    example!(
        "register",
        "robots draw tickets from one roll, each ticket once",
        "primitives",
        "register.toml",
        ["register.starl"]
    ),
    example!(
        "memory",
        "robots tell results before that they are done",
        "primitives",
        "memory.toml",
        ["memory.starl"]
    ),
    example!(
        "registration",
        "robots join and leave, and agree on the participants",
        "primitives",
        "registration.toml",
        ["registration.starl"]
    ),
    example!(
        "detector",
        "robots tell each other which of them seem to have failed",
        "primitives",
        "detector.toml",
        ["detector.starl"]
    ),
    example!(
        "barrier",
        "robots begin each round together",
        "primitives",
        "barrier.toml",
        ["barrier.starl"]
    ),
];

/// The content of a file of an example that is not text. Projects of the page hold texts only, so that their programs
/// find it here.
pub fn model(path: &str) -> Option<&'static [u8]> {
    let mut files = EXAMPLES.iter().flat_map(|example| example.files);
    let found = files.find(|(name, content)| *name == path && str::from_utf8(content).is_err());
    found.map(|(_, content)| *content)
}

impl Example {
    /// The programs in the StarL language that it brings, by path.
    pub fn programs(&self) -> impl Iterator<Item = &'static str> {
        let paths = self.files.iter().map(|file| file.0);
        paths.filter(|path| path.ends_with(SUFFIX))
    }
}

/// The prefix of examples' files in other scenarios: `example:race/race.starl`.
const GLOBAL: &str = "example:";

/// A loader of the files of all examples by their names; files of another loader have precedence.
pub(crate) struct WithExamples<'a>(pub &'a dyn Loader);

impl Loader for WithExamples<'_> {
    fn load(&self, path: &str) -> Result<Vec<u8>, FileError> {
        let found = self.0.load(path);
        let global = path
            .strip_prefix(GLOBAL)
            .and_then(|name| name.split_once('/'));
        match (found, global) {
            (Err(_), Some((name, path))) => match find(name) {
                Some(example) => example.load(path),
                None => {
                    let reason = format!("there is no example {name:?}");
                    Err(FileError::Unreadable(reason))
                }
            },
            (found, _) => found,
        }
    }
}

/// The example of this name.
pub fn find(name: &str) -> Option<&'static Example> {
    EXAMPLES.iter().find(|example| example.name == name)
}

impl Example {
    /// The name by which any scenario can name one of its files.
    pub fn global_name(&self, path: &str) -> String {
        format!("{GLOBAL}{}/{path}", self.name)
    }

    /// Its scenario. The example itself loads the files that the scenario names.
    pub fn source(&self) -> Source {
        Source::new(self.path, self.text)
    }
}

impl Loader for Example {
    fn load(&self, path: &str) -> Result<Vec<u8>, FileError> {
        match self.files.iter().find(|file| file.0 == path) {
            Some(file) => Ok(file.1.to_vec()),
            None => Err(FileError::Missing),
        }
    }
}
