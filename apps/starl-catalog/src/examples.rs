//! The examples, with all their files, so that `starl run race` works in any folder and in a browser.
//!
//! To add an example, write its folder under `examples/` and a line in [`EXAMPLES`].

use crate::language::SUFFIX;
use starl_sim::read::{Loader, Source};

/// An example: a scenario and the files that it names.
#[derive(Clone, Copy, Debug)]
pub struct Example {
    /// What it is called on the command line.
    pub name: &'static str,
    /// What one sees, in one line.
    pub summary: &'static str,
    /// Its scenario's path in the repository, by which errors call it.
    pub path: &'static str,
    /// The scenario.
    pub text: &'static str,
    /// The files that the scenario names, by the paths it has for them.
    pub files: &'static [(&'static str, &'static [u8])],
}

/// A scenario for programs that come without one: a few robots on the floor, and way-points. It names
/// no program.
pub const DEFAULT_SCENARIO: &str = include_str!("default.toml");

/// A file of an example: its path from the scenario, and its content.
macro_rules! file {
    ($example:literal, $path:literal) => {
        (
            $path,
            include_bytes!(concat!("../../../examples/", $example, "/", $path)),
        )
    };
}

const INTERSECTION: &[(&str, &[u8])] = &[
    file!("intersection", "intersection.starl"),
    file!("intersection", "junction.starl"),
    file!("intersection", "traffic.starl"),
];

/// All examples.
pub const EXAMPLES: &[Example] = &[
    Example {
        name: "race",
        summary: "ground robots and quadcopters race through way-points",
        path: "examples/race/race.toml",
        text: include_str!("../../../examples/race/race.toml"),
        files: &[
            file!("race", "race.starl"),
            file!("race", "worlds/four.wpt"),
            file!("race", "worlds/Obstacles.wpt"),
            file!("race", "worlds/start.wpt"),
        ],
    },
    Example {
        name: "formation",
        summary: "robots that know two others each form a regular polygon",
        path: "examples/formation/formation.toml",
        text: include_str!("../../../examples/formation/formation.toml"),
        files: &[file!("formation", "formation.starl")],
    },
    Example {
        name: "line",
        summary: "robots spread evenly on the line between two of them",
        path: "examples/line/line.toml",
        text: include_str!("../../../examples/line/line.toml"),
        files: &[file!("line", "line.starl")],
    },
    Example {
        name: "intersection",
        summary: "four cars agree on who crosses which zone when",
        path: "examples/intersection/intersection.toml",
        text: include_str!("../../../examples/intersection/intersection.toml"),
        files: INTERSECTION,
    },
    Example {
        name: "intersection-stream",
        summary: "a hundred cars come to the intersection at random",
        path: "examples/intersection/stream.toml",
        text: include_str!("../../../examples/intersection/stream.toml"),
        files: INTERSECTION,
    },
    Example {
        name: "mutex",
        summary: "robots hold sets of resources, one robot at a time",
        path: "examples/primitives/mutex.toml",
        text: include_str!("../../../examples/primitives/mutex.toml"),
        files: &[file!("primitives", "mutex.starl")],
    },
    Example {
        name: "election",
        summary: "robots elect a leader again and again",
        path: "examples/primitives/election.toml",
        text: include_str!("../../../examples/primitives/election.toml"),
        files: &[file!("primitives", "election.starl")],
    },
    Example {
        name: "broadcast",
        summary: "robots tell each other numbers in one order for all",
        path: "examples/primitives/broadcast.toml",
        text: include_str!("../../../examples/primitives/broadcast.toml"),
        files: &[file!("primitives", "broadcast.starl")],
    },
    Example {
        name: "flocking",
        summary: "groups of robots travel in lines abreast",
        path: "examples/flocking/flocking.toml",
        text: include_str!("../../../examples/flocking/flocking.toml"),
        files: &[file!("flocking", "flocking.starl")],
    },
    Example {
        name: "maze",
        summary: "robots look for goals and tell of the walls they meet",
        path: "examples/maze/maze.toml",
        text: include_str!("../../../examples/maze/maze.toml"),
        files: &[file!("maze", "maze.starl")],
    },
    Example {
        name: "auction",
        summary: "robots share out places to visit by bidding for them",
        path: "examples/auction/auction.toml",
        text: include_str!("../../../examples/auction/auction.toml"),
        files: &[file!("auction", "auction.starl")],
    },
    Example {
        name: "traffic-signs",
        summary: "robots stop at a crossing and go over it in turn",
        path: "examples/traffic-signs/traffic-signs.toml",
        text: include_str!("../../../examples/traffic-signs/traffic-signs.toml"),
        files: &[file!("traffic-signs", "traffic-signs.starl")],
    },
    Example {
        name: "light-painting",
        summary: "robots share out a drawing and draw it with lights",
        path: "examples/light-painting/light-painting.toml",
        text: include_str!("../../../examples/light-painting/light-painting.toml"),
        files: &[
            file!("light-painting", "light-painting.starl"),
            file!("light-painting", "house.svg"),
        ],
    },
    Example {
        name: "search",
        summary: "robots look for an item in the rooms of a house",
        path: "examples/search/search.toml",
        text: include_str!("../../../examples/search/search.toml"),
        files: &[
            file!("search", "search.starl"),
            file!("search", "worlds/house.wpt"),
        ],
    },
    Example {
        name: "search-building",
        summary: "twenty robots look for an item in fifty rooms",
        path: "examples/search/building.toml",
        text: include_str!("../../../examples/search/building.toml"),
        files: &[
            file!("search", "search.starl"),
            file!("search", "worlds/building.wpt"),
        ],
    },
    Example {
        name: "register",
        summary: "robots draw tickets from one roll, each ticket once",
        path: "examples/primitives/register.toml",
        text: include_str!("../../../examples/primitives/register.toml"),
        files: &[file!("primitives", "register.starl")],
    },
    Example {
        name: "memory",
        summary: "robots tell results before that they are done",
        path: "examples/primitives/memory.toml",
        text: include_str!("../../../examples/primitives/memory.toml"),
        files: &[file!("primitives", "memory.starl")],
    },
    Example {
        name: "registration",
        summary: "robots come and go, and agree on who takes part",
        path: "examples/primitives/registration.toml",
        text: include_str!("../../../examples/primitives/registration.toml"),
        files: &[file!("primitives", "registration.starl")],
    },
    Example {
        name: "barrier",
        summary: "robots begin each round together",
        path: "examples/primitives/barrier.toml",
        text: include_str!("../../../examples/primitives/barrier.toml"),
        files: &[file!("primitives", "barrier.starl")],
    },
];

impl Example {
    /// The programs in the StarL language that it brings, by path.
    pub fn programs(&self) -> impl Iterator<Item = &'static str> {
        let paths = self.files.iter().map(|file| file.0);
        paths.filter(|path| path.ends_with(SUFFIX))
    }
}

/// What names of examples' files begin with where they stand in other scenarios: `example:race/race.starl`.
const GLOBAL: &str = "example:";

/// A loader that knows the files of all examples by their names besides what it has from another, which
/// goes before.
pub(crate) struct WithExamples<'a>(pub &'a dyn Loader);

impl Loader for WithExamples<'_> {
    fn load(&self, path: &str) -> Result<Vec<u8>, String> {
        let found = self.0.load(path);
        let global = path
            .strip_prefix(GLOBAL)
            .and_then(|name| name.split_once('/'));
        match (found, global) {
            (Err(_), Some((name, path))) => match find(name) {
                Some(example) => example.load(path),
                None => Err(format!("there is no example {name:?}")),
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
    fn load(&self, path: &str) -> Result<Vec<u8>, String> {
        match self.files.iter().find(|file| file.0 == path) {
            Some(file) => Ok(file.1.to_vec()),
            None => Err("the example has no such file".to_string()),
        }
    }
}
