//! The command line.

use crate::failure::Failure;
use clap::{Args, Parser, Subcommand, ValueEnum};
use std::net::SocketAddr;
use std::path::PathBuf;

const MOST_THREADS: u32 = 1_024;
const MOST_ROBOTS: u32 = 10_000_000;

/// Reads a whole number in a range, and reports the range if it is something else.
fn whole(low: u32, high: u32) -> impl Fn(&str) -> Result<u32, Failure> + Clone + Send + Sync {
    move |text| match text.parse() {
        Ok(number) if (low..=high).contains(&number) => Ok(number),
        _ => Err(Failure(format!("give a whole number from {low} to {high}"))),
    }
}

/// How many of the scenario's robots.
fn first_robots(text: &str) -> Result<u32, Failure> {
    whole(1, 256)(text)
        .map_err(|Failure(text)| Failure(format!("{text}; their models are those of the scenario")))
}

/// Distributed robot applications: write, run, test, replay and measure them.
#[derive(Parser, Debug)]
#[command(name = "starl", version, arg_required_else_help = true)]
pub struct Arguments {
    /// The subcommand.
    #[command(subcommand)]
    pub command: Command,
}

/// The subcommands.
#[derive(Subcommand, Debug)]
pub enum Command {
    /// Run an example, a scenario file or a program in the simulator
    Run(RunArguments),
    /// Repeat a recorded run, and compare record by record
    Replay(ReplayArguments),
    /// Judge the properties of a run by its trace, whichever host wrote it
    Verify(VerifyArguments),
    /// Explore every behaviour of a small fleet within bounds, or repeat a path that was found
    Explore(ExploreArguments),
    /// Look for violations: run with many seeds and kinds of faults, and shrink failures
    Test(TestArguments),
    /// Run every combination of some fields' values with many seeds, and tabulate the results
    Sweep(SweepArguments),
    /// Compare two versions of a program or a scenario, seed by seed
    Compare(CompareArguments),
    /// Draw the messages of a run as a space-time diagram
    Diagram(DiagramArguments),
    /// Check programs and libraries of the language
    Check(CheckArguments),
    /// Format programs and libraries in the standard layout
    Fmt(FormatArguments),
    /// Draw a program as a state machine, or explain an error by its code
    Explain(ExplainArguments),
    /// Serve an editor by the Language Server Protocol on standard input and output
    Lsp(LspArguments),
    /// Show a recorded run, or a fleet that runs, in a browser
    View(ViewArguments),
    /// Run one robot of a real fleet, until it is stopped
    Robot(RobotArguments),
    /// Run a real fleet, show its status, stop it, and merge the traces of its robots
    Fleet {
        /// The subcommand.
        #[command(subcommand)]
        command: FleetCommand,
    },
    /// Emulate the hardware of robots: the simulator's models behind the wire protocols of real devices
    Emulate {
        /// The device to emulate.
        #[command(subcommand)]
        what: EmulateArguments,
    },
    /// Serve the page with the simulator in it, for a browser on this machine
    Web(PageArguments),
    /// Print the fields of scenario files as a JSON Schema, for editors of TOML files
    Schema,
    /// Show the examples, programs, robot models and planners
    List(ListArguments),
    /// Measure the simulator's speed and memory
    Bench(BenchArguments),
}

/// Arguments of `starl run`.
#[derive(Args, Debug)]
pub struct RunArguments {
    /// An example's name (see `starl list`), a scenario file, or a program: a file ending in .starl
    pub target: String,
    /// The scenario for a program: a scenario file or an example's name
    /// [default: the program's own name with .toml, or else a few robots on an empty floor]
    #[arg(long, value_name = "SCENARIO")]
    pub scenario: Option<String>,
    /// Another fleet: models with the number of each, e.g. create=2,drone=2
    #[arg(long, value_name = "MODEL=N,...")]
    pub robots: Option<String>,
    /// Decides every random draw [default: the scenario's]
    #[arg(long, value_name = "N", allow_hyphen_values = true)]
    pub seed: Option<String>,
    /// Simulated time at which the run ends at the latest, e.g. 120s [default: the scenario's]
    #[arg(long, value_name = "TIME", allow_hyphen_values = true)]
    pub duration: Option<String>,
    /// Set a field of the scenario, e.g. network.loss=0.2; may be repeated
    #[arg(long, value_name = "FIELD=VALUE")]
    pub set: Vec<String>,
    /// A file of faults (`[[fault]]` and `[fault_rates]`) to add to the scenario's
    #[arg(long, value_name = "FILE")]
    pub faults: Option<PathBuf>,
    /// Threads to step robots on; the result is the same for any number [default: all cores for
    /// more than 2,000 robots, else 1]
    #[arg(long, value_name = "N", value_parser = whole(1, MOST_THREADS))]
    pub threads: Option<u32>,
    /// Write all events to this MCAP file
    #[arg(long, value_name = "PATH")]
    pub trace: Option<PathBuf>,
    /// Record every input of each robot's software in the trace, for `starl replay --robot`
    #[arg(long, requires = "trace")]
    pub inputs: bool,
    /// Draw the robots' paths to this .svg or .png file
    #[arg(long, value_name = "PATH")]
    pub plot: Option<PathBuf>,
    /// Print the summary as one JSON object
    #[arg(long)]
    pub json: bool,
    /// Print only errors and violations
    #[arg(long)]
    pub quiet: bool,
    /// The options of the robots' log.
    #[command(flatten)]
    pub log: LogArguments,
    /// Show the run in a browser, and steer it there
    #[arg(long, conflicts_with_all = ["trace", "plot", "json"])]
    pub open: bool,
    /// The options of the page, with `open`.
    #[command(flatten)]
    pub page: PageArguments,
}

/// The levels of `--log`, from the one that shows most.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Shown {
    /// All lines.
    Debug,
    /// All except those for debugging; lines of programs in the StarL language have this level.
    Info,
    /// Lines about something that is probably wrong, and errors.
    Warning,
    /// Lines about something that is certainly wrong.
    Error,
}

/// The options of the robots' log.
#[derive(Args, Clone, Debug, Default, PartialEq, Eq)]
pub struct LogArguments {
    /// Show the log lines of programs while they run, on the error stream; with a level, only lines of this level and
    /// above
    #[arg(long, value_name = "LEVEL", num_args = 0..=1, require_equals = true, default_missing_value = "info")]
    pub log: Option<Shown>,
    /// Show the log of these robots only
    #[arg(long, value_name = "NAME,...", value_delimiter = ',', requires = "log")]
    pub log_robots: Vec<String>,
}

/// The options of the page's server.
#[derive(Args, Clone, Debug, Default, PartialEq, Eq)]
pub struct PageArguments {
    /// The port on 127.0.0.1 to serve the page at [default: a free port]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    pub port: Option<u16>,
    /// Print the page's address without opening a browser
    #[arg(long)]
    pub no_browser: bool,
    /// Serve the page in this folder instead of the built-in one
    #[arg(long = "page", value_name = "DIR")]
    pub folder: Option<PathBuf>,
}

/// Arguments of `starl view`.
#[derive(Args, Debug)]
pub struct ViewArguments {
    /// A file that `starl run --trace` wrote, or a fleet file (.toml) to follow its robots
    #[arg(value_name = "TRACE|FLEET")]
    pub what: PathBuf,
    /// The options of the page.
    #[command(flatten)]
    pub page: PageArguments,
}

/// Arguments of `starl robot`.
#[derive(Args, Debug)]
pub struct RobotArguments {
    /// A program, a file ending in .starl [default: the scenario's]
    pub program: Option<String>,
    /// The robot's name in the scenario
    #[arg(long, value_name = "NAME")]
    pub id: String,
    /// The fleet file
    #[arg(long, value_name = "FILE")]
    pub fleet: PathBuf,
    /// End with the process at the other end of standard input
    #[arg(long, hide = true)]
    pub supervised: bool,
    /// Where the robot keeps its trace and its storage [default: the fleet's last run, beside the fleet file]
    #[arg(long, value_name = "DIR")]
    pub folder: Option<PathBuf>,
    /// Print only errors
    #[arg(long)]
    pub quiet: bool,
}

/// The devices to emulate.
#[derive(Subcommand, Debug)]
pub enum EmulateArguments {
    /// All devices that a fleet file names, in the world of its scenario
    Fleet(EmulateFleet),
    /// An iRobot Create on a serial line
    Create {
        /// Where to put the line [default: the system says]
        #[arg(long, value_name = "PATH")]
        link: Option<PathBuf>,
        /// 1 for the Create of 2007, 2 for the Create 2
        #[arg(long, value_name = "N", default_value_t = 2, value_parser = clap::value_parser!(u8).range(1..=2))]
        generation: u8,
    },
    /// An AR.Drone 2
    Drone {
        /// Where it takes commands
        #[arg(long, value_name = "ADDRESS", default_value = "127.0.0.1:5556")]
        commands: SocketAddr,
        /// Where it gives navdata
        #[arg(long, value_name = "ADDRESS", default_value = "127.0.0.1:5554")]
        navdata: SocketAddr,
    },
    /// A Crazyflie, over UDP
    Crazyflie {
        /// Where it listens
        #[arg(long, value_name = "ADDRESS", default_value = "127.0.0.1:19850")]
        address: SocketAddr,
    },
    /// A multicopter with PX4, over MAVLink 2
    Mavlink {
        /// Where it listens
        #[arg(long, value_name = "ADDRESS", default_value = "127.0.0.1:14580")]
        address: SocketAddr,
        /// Where it sends to
        #[arg(long, value_name = "ADDRESS", default_value = "127.0.0.1:14540")]
        client: SocketAddr,
    },
    /// A ROS 2 robot on two wheels with a laser scanner, over Zenoh
    Ros2 {
        /// Where its Zenoh router listens
        #[arg(long, value_name = "ENDPOINT", default_value = "tcp/127.0.0.1:7447")]
        router: String,
        /// The domain of its nodes
        #[arg(long, value_name = "N", default_value_t = 0)]
        domain: u32,
        /// The namespace of its topics, e.g. /r1
        #[arg(long, value_name = "NAME", default_value = "")]
        namespace: String,
        /// Its size and speed
        #[arg(long, value_name = "MODEL", default_value = "create", value_parser = ["create", "differential"])]
        model: String,
        /// Take TwistStamped instead of Twist
        #[arg(long)]
        stamped: bool,
    },
}

/// Arguments of `starl emulate fleet`.
#[derive(Args, Debug)]
pub struct EmulateFleet {
    /// The fleet file
    pub fleet: PathBuf,
    /// End with the process at the other end of standard input
    #[arg(long, hide = true)]
    pub supervised: bool,
}

/// The subcommands for a real fleet.
#[derive(Subcommand, Debug)]
pub enum FleetCommand {
    /// Run all robots on this machine, each in its own process, and judge the run
    Up(FleetUpArguments),
    /// Show the robots that are alive, with their positions, states and link qualities
    Status(FleetStatusArguments),
    /// Send an operator's order to the programs of robots
    Tell(FleetTellArguments),
    /// Stop the motors of all robots at once, and then the robots
    Stop(FleetStopArguments),
    /// Join the robots' traces on one time axis
    Merge(FleetMergeArguments),
    /// Create the fleet's key, which every member needs
    Key(FleetKeyArguments),
    /// Run the Zenoh router that the fleet file names, until Ctrl-C
    Router(FleetRouterArguments),
}

/// Arguments of `starl fleet up`.
#[derive(Args, Debug)]
pub struct FleetUpArguments {
    /// The fleet file
    pub fleet: PathBuf,
    /// A program for all robots, a file ending in .starl [default: the scenario's]
    #[arg(long, value_name = "FILE")]
    pub program: Option<String>,
    /// Emulate the devices that the fleet file names
    #[arg(long)]
    pub emulate: bool,
    /// Print the processes to start on each machine, without starting them
    #[arg(long)]
    pub print: bool,
    /// Stop after this time [default: the scenario's duration]
    #[arg(long, value_name = "TIME")]
    pub duration: Option<String>,
    /// Continue with the storage and the time of the last run
    #[arg(long)]
    pub resume: bool,
    /// Keep the robots running when all have finished
    #[arg(long)]
    pub keep: bool,
    /// Print less while the fleet runs
    #[arg(long)]
    pub quiet: bool,
}

/// Arguments of `starl fleet status`.
#[derive(Args, Debug)]
pub struct FleetStatusArguments {
    /// The fleet file
    pub fleet: PathBuf,
    /// Print a list in JSON
    #[arg(long)]
    pub json: bool,
}

/// Arguments of `starl fleet tell`.
#[derive(Args, Debug)]
pub struct FleetTellArguments {
    /// The fleet file
    pub fleet: PathBuf,
    /// The name of the order, as in `on input NAME(...)`
    pub order: String,
    /// The fields of the order, with values as in a scenario's `fields`, e.g. 'to=[1.5, 2]'
    #[arg(value_name = "FIELD=VALUE")]
    pub fields: Vec<String>,
    /// Send it to these robots only
    #[arg(long, value_name = "NAME,...", value_delimiter = ',')]
    pub robots: Option<Vec<String>>,
}

/// Arguments of `starl fleet stop`.
#[derive(Args, Debug)]
pub struct FleetStopArguments {
    /// The fleet file
    pub fleet: PathBuf,
}

/// Arguments of `starl fleet merge`.
#[derive(Args, Debug)]
pub struct FleetMergeArguments {
    /// The fleet file
    pub fleet: PathBuf,
    /// Where the robots' traces are [default: the fleet's last run]
    #[arg(long, value_name = "DIR")]
    pub folder: Option<PathBuf>,
    /// Write the joined trace to this file [default: merged.mcap in the folder]
    #[arg(long, value_name = "FILE")]
    pub out: Option<PathBuf>,
}

/// Arguments of `starl fleet key`.
#[derive(Args, Debug)]
pub struct FleetKeyArguments {
    /// The fleet file
    pub fleet: PathBuf,
    /// Make a new key, and keep the present one valid until the key is changed again
    #[arg(long)]
    pub change: bool,
}

/// Arguments of `starl fleet router`.
#[derive(Args, Debug)]
pub struct FleetRouterArguments {
    /// The fleet file
    pub fleet: PathBuf,
}

/// Changes of a target that is run many times, or drawn.
#[derive(Args, Clone, Debug, Default, PartialEq, Eq)]
pub struct ChangeArguments {
    /// The scenario for a program, as for `starl run`
    #[arg(long, value_name = "SCENARIO")]
    pub scenario: Option<String>,
    /// Another fleet, as for `starl run`
    #[arg(long, value_name = "MODEL=N,...")]
    pub robots: Option<String>,
    /// Simulated time at which a run ends at the latest [default: the scenario's]
    #[arg(long, value_name = "TIME", allow_hyphen_values = true)]
    pub duration: Option<String>,
    /// Set a field of the scenario, e.g. network.loss=0.2; may be repeated
    #[arg(long, value_name = "FIELD=VALUE")]
    pub set: Vec<String>,
    /// A file of faults to add to the scenario's
    #[arg(long, value_name = "FILE")]
    pub faults: Option<PathBuf>,
}

impl ChangeArguments {
    /// The arguments of a run of this target with these changes.
    pub fn of(&self, target: &str, seed: Option<String>, quiet: bool) -> RunArguments {
        RunArguments {
            target: target.to_string(),
            scenario: self.scenario.clone(),
            robots: self.robots.clone(),
            seed,
            duration: self.duration.clone(),
            set: self.set.clone(),
            faults: self.faults.clone(),
            threads: None,
            trace: None,
            inputs: false,
            plot: None,
            json: false,
            quiet,
            log: LogArguments::default(),
            open: false,
            page: PageArguments::default(),
        }
    }
}

/// Where many runs are made.
#[derive(Args, Clone, Debug, Default)]
pub struct ClusterArguments {
    /// Run on a cluster of Ray: its address, e.g. ray://HOST:10001; `ray` for the one that RAY_ADDRESS names or that runs
    /// on this machine; or `local` to start one here
    #[arg(long, value_name = "ADDRESS", conflicts_with = "threads")]
    pub cluster: Option<String>,
    /// The Python with the package `starl` that connects to the cluster [default: $STARL_PYTHON, or else python3]
    #[arg(long, value_name = "PATH", requires = "cluster")]
    pub python: Option<PathBuf>,
}

/// How the runs of a sweep or a comparison are made and shown.
#[derive(Args, Debug)]
pub struct RunsArguments {
    /// The number of seeds, or the first and the last one: FIRST..LAST
    #[arg(long, value_name = "N", default_value = "100")]
    pub seeds: String,
    /// Add the faults of this profile to each run: calm, lossy, partitions, crashes, clocks, chaos, swarm or corruption
    #[arg(long, value_name = "NAME")]
    pub profile: Option<String>,
    /// Metrics to show: `goal` or columns of the table; several with commas
    #[arg(long, value_name = "NAME,...", value_delimiter = ',')]
    pub metric: Vec<String>,
    /// Threads to run on; the results are the same for any number [default: all cores]
    #[arg(long, value_name = "N", value_parser = whole(1, MOST_THREADS))]
    pub threads: Option<u32>,
    /// Print the summary as one JSON object
    #[arg(long)]
    pub json: bool,
    /// Print only errors
    #[arg(long)]
    pub quiet: bool,
}

/// Arguments of `starl test`.
#[derive(Args, Debug)]
pub struct TestArguments {
    /// Examples' names (see `starl list`), scenario files, or programs: files ending in .starl
    #[arg(value_name = "TARGET", required_unless_present = "all")]
    pub targets: Vec<String>,
    /// Test every example of `starl list`
    #[arg(long, conflicts_with = "targets")]
    pub all: bool,
    /// The number of seeds for each profile
    #[arg(long, value_name = "N", default_value_t = 100, value_parser = whole(1, u32::MAX))]
    pub seeds: u32,
    /// The first seed
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = whole(0, u32::MAX))]
    pub first_seed: u32,
    /// Kinds of faults: calm, lossy, partitions, crashes, clocks, chaos, swarm, corruption, or all; several with
    /// commas [default: all except corruption]
    #[arg(long, value_name = "NAME,...", value_delimiter = ',')]
    pub profile: Vec<String>,
    /// Count a run that does not reach its goal as a failure, also if robots crash or state is corrupted
    #[arg(long)]
    pub demand_goal: bool,
    /// Threads to run on [default: all cores]
    #[arg(long, value_name = "N", value_parser = whole(1, MOST_THREADS))]
    pub threads: Option<u32>,
    /// Folder for failing scenarios and their diagrams
    #[arg(long, value_name = "DIR", default_value = ".")]
    pub out: PathBuf,
    /// Scenarios to try while shrinking each failure; 0 saves it as found
    #[arg(long, value_name = "N", default_value_t = 1_000, value_parser = whole(0, 1_000_000))]
    pub shrink: u32,
    /// Print the summary as one JSON object
    #[arg(long)]
    pub json: bool,
    /// Print only failures
    #[arg(long)]
    pub quiet: bool,
    /// The cluster.
    #[command(flatten)]
    pub cluster: ClusterArguments,
    /// Changes of the targets.
    #[command(flatten)]
    pub changes: ChangeArguments,
}

/// Arguments of `starl sweep`.
#[derive(Args, Debug)]
#[command(
    mut_arg("set", |set| set
        .value_name("FIELD=VALUES")
        .help("A field of the scenario and its values: A,B,C, or LOW..HIGH:N for N values from LOW to HIGH; the field \
            `fleet` is the number of robots; may be repeated")),
    mut_arg("seeds", |seeds| seeds
        .help("The number of seeds for each combination, or the first and the last one: FIRST..LAST")),
    mut_arg("metric", |metric| metric
        .help("Metrics of the summary and, the first, of the plot: `goal` or columns of the table; several with commas \
            [default: goal,time_to_goal_seconds,messages_sent]")),
)]
pub struct SweepArguments {
    /// An example's name (see `starl list`), a scenario file, or a program: a file ending in .starl
    pub target: String,
    /// Write a row for each run to this file (.parquet, .csv or .jsonl), with a journal beside it from which an
    /// interrupted sweep continues
    #[arg(long, value_name = "FILE")]
    pub out: Option<PathBuf>,
    /// Draw the first metric against the first axis to this .svg or .png file, with a line for each value of the others
    #[arg(long, value_name = "PATH")]
    pub plot: Option<PathBuf>,
    /// The runs.
    #[command(flatten)]
    pub runs: RunsArguments,
    /// The cluster.
    #[command(flatten)]
    pub cluster: ClusterArguments,
    /// Changes of the target.
    #[command(flatten)]
    pub changes: ChangeArguments,
}

/// Arguments of `starl compare`.
#[derive(Args, Debug)]
#[command(
    mut_arg("metric", |metric| metric
        .help("Metrics to compare, as for `starl sweep`; several with commas [default: all that differ for some seed]")),
    mut_arg("quiet", |quiet| quiet.help("Print only seeds that became worse")),
    mut_arg("json", |json| json.help("Print the comparison as one JSON object")),
)]
pub struct CompareArguments {
    /// The version to compare with: an example's name, a scenario file, or a program
    pub a: String,
    /// The version to judge [default: A, with the fields of --set-b]
    #[arg(required_unless_present_any = ["set_a", "set_b"])]
    pub b: Option<String>,
    /// Set a field of A alone; may be repeated
    #[arg(long, value_name = "FIELD=VALUE")]
    pub set_a: Vec<String>,
    /// Set a field of B alone; may be repeated
    #[arg(long, value_name = "FIELD=VALUE")]
    pub set_b: Vec<String>,
    /// The runs.
    #[command(flatten)]
    pub runs: RunsArguments,
    /// Changes of both.
    #[command(flatten)]
    pub changes: ChangeArguments,
}

/// Arguments of `starl diagram`.
#[derive(Args, Debug)]
pub struct DiagramArguments {
    /// A trace (a file ending in .mcap), or a target of `starl run`
    pub target: String,
    /// The drawing: a file ending in .svg or .png
    #[arg(long, value_name = "PATH")]
    pub out: PathBuf,
    /// The length of the drawing before its end, e.g. 500ms [default: as much as is easy to read]
    #[arg(long, value_name = "TIME")]
    pub last: Option<String>,
    /// The end of the drawing, e.g. 12.5s [default: the first violation, or else the end of the run]
    #[arg(long, value_name = "TIME")]
    pub until: Option<String>,
    /// Decides every random draw [default: the scenario's]
    #[arg(long, value_name = "N", allow_hyphen_values = true)]
    pub seed: Option<String>,
    /// Changes of the target.
    #[command(flatten)]
    pub changes: ChangeArguments,
}

/// Arguments of `starl replay`.
#[derive(Args, Debug)]
pub struct ReplayArguments {
    /// A file that `starl run --trace` wrote
    pub trace: PathBuf,
    /// Threads to step robots on [default: as for `starl run`]
    #[arg(long, value_name = "N", value_parser = whole(1, MOST_THREADS))]
    pub threads: Option<u32>,
    /// Run only this robot's software, without the simulator, on the inputs that `starl run --inputs` recorded
    #[arg(long, value_name = "NAME", conflicts_with = "threads")]
    pub robot: Option<String>,
    /// Run this program instead of the recorded one, and show where it begins to behave differently
    #[arg(long, value_name = "FILE", requires = "robot")]
    pub program: Option<PathBuf>,
}

/// Arguments of `starl verify`.
#[derive(Args, Debug)]
pub struct VerifyArguments {
    /// A trace, complete or not
    pub trace: PathBuf,
    /// Print the verdicts as one JSON object
    #[arg(long)]
    pub json: bool,
}

/// Arguments of `starl explore`.
#[derive(Args, Debug)]
pub struct ExploreArguments {
    /// An example's name, a scenario file, or a program, as for `starl run`
    pub target: Option<String>,
    /// The scenario for a program, as for `starl run`
    #[arg(long, value_name = "SCENARIO")]
    pub scenario: Option<String>,
    /// The first N of the scenario's robots [default: 3, or all if there are fewer]
    #[arg(long, value_name = "N", value_parser = first_robots)]
    pub robots: Option<u32>,
    /// Decides the robots' random draws, which are the same on all paths [default: the scenario's]
    #[arg(long, value_name = "N", allow_hyphen_values = true)]
    pub seed: Option<String>,
    /// Set a field of the scenario, e.g. parameters.entries=1; may be repeated
    #[arg(long, value_name = "FIELD=VALUE")]
    pub set: Vec<String>,
    /// Maximum number of lost datagrams
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub loss: u8,
    /// Maximum number of duplicated datagrams
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub duplicates: u8,
    /// Let every datagram arrive any number of times, or never
    #[arg(long, conflicts_with_all = ["duplicates", "loss"])]
    pub any_copies: bool,
    /// Maximum number of crashes; a robot that is down may restart at any time
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub crashes: u8,
    /// Maximum number of suspicions by failure detectors, true or false, and ends of suspicions
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub suspicions: u8,
    /// Maximum number of timers that fire, 255 for any number; without --tick they may fire at any time
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub timers: u8,
    /// Let failure detectors send heartbeats, which adds many states
    #[arg(long)]
    pub heartbeats: bool,
    /// Let clocks tick, with ticks of this length [default: all clocks show zero]
    #[arg(long, value_name = "TIME")]
    pub tick: Option<String>,
    /// Start after the robots' first messages: all of them arrive at once and in order, no program is
    /// activated, and N ticks pass (with --tick)
    #[arg(long, value_name = "N")]
    pub warm_up: Option<u16>,
    /// With --tick: how long clocks tick, after the warm-up
    #[arg(long, value_name = "TIME", requires = "tick", default_value = "10s")]
    pub time: String,
    /// With --tick: by how many ticks a clock may be ahead of another
    #[arg(long, value_name = "N", requires = "tick", default_value_t = 0)]
    pub skew: u16,
    /// With --tick: a datagram in transit for more ticks than this is lost
    /// [default: datagrams may take any time]
    #[arg(long, value_name = "N", requires = "tick", conflicts_with = "skew",
        value_parser = clap::value_parser!(u8).range(..=15))]
    pub delay: Option<u8>,
    /// Maximum number of steps from the start; exit status 3 if there are more
    #[arg(long, value_name = "N")]
    pub depth: Option<u32>,
    /// Threads to search on; the result is the same for any number [default: all cores]
    #[arg(long, value_name = "N", value_parser = whole(1, MOST_THREADS))]
    pub threads: Option<u32>,
    /// Maximum number of states, some 40 bytes each; exit status 3 if there are more
    #[arg(long, value_name = "N", default_value_t = 10_000_000)]
    pub most_states: u32,
    /// Maximum wall time; exit status 3 if it takes longer
    #[arg(long, value_name = "TIME", default_value = "1min")]
    pub within: String,
    /// Compare robots that reached the same state on different paths, in every input
    #[arg(long)]
    pub doubt: bool,
    /// File for the path to a violation [default: TARGET-counterexample.json]
    #[arg(long, value_name = "PATH")]
    pub save: Option<PathBuf>,
    /// File for a space-time diagram of the path to a violation (.svg)
    #[arg(long, value_name = "PATH")]
    pub diagram: Option<PathBuf>,
    /// Follow the path in this file step by step, without exploring
    #[arg(long, value_name = "FILE", conflicts_with_all = ["target", "save"])]
    pub replay: Option<PathBuf>,
    /// Print one JSON object
    #[arg(long)]
    pub json: bool,
    /// Print only errors, and a violation with its path
    #[arg(long)]
    pub quiet: bool,
}

/// Arguments of `starl check`.
#[derive(Args, Debug)]
pub struct CheckArguments {
    /// Files, or folders of `.starl` files; `-` for standard input
    #[arg(required = true, value_name = "FILE")]
    pub files: Vec<PathBuf>,
    /// Exit with status 1 for warnings too
    #[arg(long)]
    pub deny_warnings: bool,
    /// Print one JSON object
    #[arg(long)]
    pub json: bool,
}

/// Arguments of `starl fmt`.
#[derive(Args, Debug)]
pub struct FormatArguments {
    /// Files, or folders of `.starl` files; `-` for standard input to standard output
    #[arg(required = true, value_name = "FILE")]
    pub files: Vec<PathBuf>,
    /// Change nothing; list the files that would change, and exit with status 1 if there are any
    #[arg(long)]
    pub check: bool,
}

/// Arguments of `starl explain`.
#[derive(Args, Debug)]
pub struct ExplainArguments {
    /// An example's name (see `starl list`) or a program: a file ending in .starl; `-` for standard
    /// input. Or the code of an error or a warning, e.g. E0201
    pub program: String,
    /// The enum variable whose values are the states [default: the one that most actions test]
    #[arg(long, value_name = "NAME")]
    pub variable: Option<String>,
    /// The language of the drawing [default: by the file's suffix, else mermaid]
    #[arg(long, value_enum)]
    pub format: Option<Drawing>,
    /// Write to this file (.mmd, .dot, .gv) instead of standard output
    #[arg(long, value_name = "PATH")]
    pub output: Option<PathBuf>,
}

/// Languages that diagrams are drawn in.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Drawing {
    /// A state diagram for Mermaid, which GitHub and many editors show
    Mermaid,
    /// A graph for Graphviz: `dot -Tsvg`
    Dot,
}

/// Arguments of `starl lsp`.
#[derive(Args, Debug)]
pub struct LspArguments {
    /// Accepted without effect, because some editors pass it
    #[arg(long)]
    pub stdio: bool,
}

/// Arguments of `starl list`.
#[derive(Args, Debug)]
pub struct ListArguments {
    /// Print one JSON object
    #[arg(long)]
    pub json: bool,
}

/// Arguments of `starl bench`.
#[derive(Args, Debug)]
pub struct BenchArguments {
    /// The workload.
    #[command(subcommand)]
    pub workload: Workload,
}

/// Workloads to measure.
#[derive(Subcommand, Debug)]
pub enum Workload {
    /// Ground robots with 24 range rays each spread out and avoid each other
    Swarm(SwarmArguments),
    /// Ground robots broadcast at every tick to about eight neighbours
    Radio(RadioArguments),
    /// Ground robots geocast to some 28 neighbours every 5 seconds
    Geocast(GeocastArguments),
    /// Ground robots drive to a far waypoint, each running the program of the example Race
    Race(RaceArguments),
}

/// The common options of all workloads.
#[derive(Args, Debug)]
pub struct LoadArguments {
    /// Simulated seconds
    #[arg(long, value_name = "S", default_value_t = 10, value_parser = whole(1, 1_000_000))]
    pub seconds: u32,
    /// Threads to step robots on
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = whole(1, MOST_THREADS))]
    pub threads: u32,
    /// Decides every random draw
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = whole(0, u32::MAX))]
    pub seed: u32,
    /// Print one JSON object
    #[arg(long)]
    pub json: bool,
}

/// Arguments of `starl bench swarm`.
#[derive(Args, Debug)]
pub struct SwarmArguments {
    /// The number of robots
    #[arg(long, value_name = "N", default_value_t = 10_000, value_parser = whole(1, MOST_ROBOTS))]
    pub robots: u32,
    /// The common options of all workloads.
    #[command(flatten)]
    pub load: LoadArguments,
}

/// Arguments of `starl bench radio`.
#[derive(Args, Debug)]
pub struct RadioArguments {
    /// The number of robots
    #[arg(long, value_name = "N", default_value_t = 1_000, value_parser = whole(1, MOST_ROBOTS))]
    pub robots: u32,
    /// Bodies block the radio
    #[arg(long)]
    pub occluded: bool,
    /// The common options of all workloads.
    #[command(flatten)]
    pub load: LoadArguments,
}

/// Arguments of `starl bench geocast`.
#[derive(Args, Debug)]
pub struct GeocastArguments {
    /// The number of robots
    #[arg(long, value_name = "N", default_value_t = 10_000, value_parser = whole(1, MOST_ROBOTS))]
    pub robots: u32,
    /// The robots send nothing: what they cost without their messages
    #[arg(long)]
    pub silent: bool,
    /// The common options of all workloads.
    #[command(flatten)]
    pub load: LoadArguments,
}

/// Arguments of `starl bench race`.
#[derive(Args, Debug)]
pub struct RaceArguments {
    /// The number of robots
    #[arg(long, value_name = "N", default_value_t = 100_000, value_parser = whole(1, MOST_ROBOTS))]
    pub robots: u32,
    /// Run the program in Rust instead of the one in the StarL language
    #[arg(long)]
    pub native: bool,
    /// The common options of all workloads.
    #[command(flatten)]
    pub load: LoadArguments,
}
