//! The workloads as scenarios: a square arena with 1.6 square metres a robot and walls around, small
//! ground robots strewn over it, ten ticks a second.

use crate::args::{GeocastArguments, LoadArguments, RaceArguments, RadioArguments, SwarmArguments};

/// A scenario to measure.
pub struct Workload {
    /// Its name.
    pub name: &'static str,
    /// The scenario file.
    pub scenario: String,
    /// The same with few robots, run first: it loads everything that any run needs.
    pub rehearsal: String,
}

/// Robots of a rehearsal, enough for every kind of work to be done.
const FEW: u32 = 64;

/// Floor for each robot, square metres.
const FLOOR: f64 = 1.6;

/// Robots that turn away from each other and from the walls.
pub fn swarm(arguments: &SwarmArguments) -> Workload {
    Workload {
        name: "swarm",
        scenario: scenario("diffusion", arguments.robots, &arguments.load, ""),
        rehearsal: scenario("diffusion", FEW, &arguments.load, ""),
    }
}

/// The same robots, driving in circles, broadcast to all within 2.26 m, some eight others, at every tick.
pub fn radio(arguments: &RadioArguments) -> Workload {
    let RadioArguments {
        robots,
        occluded,
        load,
    } = arguments;
    let network = format!("range = \"2.26m\"\nline_of_sight = {occluded}\n");
    Workload {
        name: if *occluded {
            "radio, occluded"
        } else {
            "radio"
        },
        scenario: scenario("radio", *robots, load, &network),
        rehearsal: scenario("radio", FEW, load, &network),
    }
}

/// The same robots, standing, geocast to all within 3.78 m, some 28 others, every 5 s. Silent ones wait for longer than
/// a run takes.
pub fn geocast(arguments: &GeocastArguments) -> Workload {
    let GeocastArguments {
        robots,
        silent,
        load,
    } = arguments;
    let (name, pause) = match silent {
        true => ("geocast, silent", "1000000h"),
        false => ("geocast", "5s"),
    };
    let of = |robots: u32| {
        let network = "range = \"3.78m\"\n";
        let parameters = format!("\n[parameters]\npause = \"{pause}\"\nradius = \"3.78m\"\n");
        scenario("beacon", robots, load, network) + &parameters
    };
    Workload {
        name,
        scenario: of(*robots),
        rehearsal: of(FEW),
    }
}

/// The same robots, driving to a waypoint that none of them reaches in the first seconds.
pub fn race(arguments: &RaceArguments) -> Workload {
    let RaceArguments {
        robots,
        native,
        load,
    } = arguments;
    let (name, program) = match native {
        true => ("race, native", "race"),
        false => ("race", "race.starl"),
    };
    let of = |robots: u32| {
        let far = side(robots) / 2.0;
        let way_point =
            format!("\n[[world.way_point]]\nname = \"far\"\nposition = [{far}, {far}]\n");
        scenario(program, robots, load, "") + &way_point
    };
    Workload {
        name,
        scenario: of(*robots),
        rehearsal: of(FEW),
    }
}

/// Robots with 24 range rays each. Nothing is random but where the robots start, and messages arrive at
/// the next tick, as in the systems that this is compared with.
fn scenario(program: &str, robots: u32, load: &LoadArguments, network: &str) -> String {
    let side = side(robots);
    let LoadArguments { seconds, seed, .. } = load;
    format!(
        r#"program = "{program}"
seed = {seed}
duration = "{seconds}s"
goal = "duration"

[world.bounds]
low = [0, 0]
high = [{side}, {side}]

[[robots]]
model = "differential"
count = {robots}
spacing = "0m"
control_period = "100ms"
sensors = {{ proximity = {{ rays = 24, range = "100mm" }} }}

[physics]
step = "100ms"

[positioning]
period = "100ms"

[motion]
avoidance = false

[network]
delay = "0s"
distribution = "constant"
{network}
[properties]
no_collision = false
reach_avoid = false
broadcast = false
geocast = false

[trace]
pose_period = "100ms"
"#
    )
}

/// How long and wide the arena is, metres.
fn side(robots: u32) -> f64 {
    (f64::from(robots) * FLOOR).sqrt()
}
