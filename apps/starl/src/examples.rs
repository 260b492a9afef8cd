//! The examples that are part of the command, so that `starl run race` works in any folder.
//!
//! To add an example, write its folder under `examples/` and a line in [`EXAMPLES`].

/// An example: a scenario and the files that it names.
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

/// All examples.
pub const EXAMPLES: [Example; 1] = [Example {
    name: "race",
    summary: "robots on the ground and in the air race through way-points among obstacles",
    path: "examples/race/race.toml",
    text: include_str!("../../../examples/race/race.toml"),
    files: &[
        (
            "worlds/four.wpt",
            include_bytes!("../../../examples/race/worlds/four.wpt"),
        ),
        (
            "worlds/Obstacles.wpt",
            include_bytes!("../../../examples/race/worlds/Obstacles.wpt"),
        ),
        (
            "worlds/start.wpt",
            include_bytes!("../../../examples/race/worlds/start.wpt"),
        ),
    ],
}];

/// The example of this name.
pub fn find(name: &str) -> Option<&'static Example> {
    EXAMPLES.iter().find(|example| example.name == name)
}
