//! Robots in processes of their own, in real time: what a user of `starl robot` and `starl fleet` sees.

#![cfg(unix)]

use crate::support::*;
use serde_json::Value;
use std::net::{TcpListener, UdpSocket};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::sync::atomic::{AtomicU16, Ordering};
use std::time::{Duration, Instant};

/// Real time is slow: a test that waits for longer has failed.
pub(crate) const PATIENCE: Duration = Duration::from_secs(60);

/// Two robots that run a race of about five seconds.
pub(crate) const RACE: &str = r#"
program = "race"
duration = "60s"

[world]
way_point = [
    { name = "A", position = [2, 0] },
    { name = "B", position = [2, 2] },
]

[[robots]]
model = "holonomic"
name = "robot"
count = 2
start = [{ position = [0, 0] }, { position = [0, 1] }]
"#;

/// The first of `count` successive ports that are free. Each is given once, and all are below those that the system gives
/// to sockets that ask for any.
pub(crate) fn ports(count: u16) -> u16 {
    static GIVEN: AtomicU16 = AtomicU16::new(0);
    let free = |port: u16| {
        let address = ("127.0.0.1", port);
        UdpSocket::bind(address).is_ok() && TcpListener::bind(address).is_ok()
    };
    let start = 12_000 + (std::process::id() % 100) as u16 * 100;
    loop {
        let first = start + GIVEN.fetch_add(count, Ordering::Relaxed);
        if (first..first + count).all(free) {
            return first;
        }
    }
}

/// A folder with a fleet of two robots.
fn fleet(test: &str) -> std::path::PathBuf {
    let folder = folder(test);
    file(&folder, "race.toml", RACE);
    fleet_file(&folder, "race.toml");
    folder
}

/// A file of a fleet of two robots that run this scenario.
pub(crate) fn fleet_file(folder: &Path, scenario: &str) {
    let first = ports(2);
    let text = format!("scenario = \"{scenario}\"\n[link]\nfirst_port = {first}\n");
    file(folder, "fleet.toml", &text);
}

/// A fleet, or its router, that runs until this is dropped.
pub(crate) struct Up(pub(crate) Child);

impl Up {
    pub(crate) fn start(folder: &Path, arguments: &[&str]) -> Up {
        let mut all = vec!["fleet", "up", "fleet.toml"];
        all.extend_from_slice(arguments);
        let mut command = command(folder, &all);
        command.stdout(Stdio::piped()).stderr(Stdio::piped());
        Up(command.spawn().expect("the command was built"))
    }

    /// Its output, once it has ended.
    pub(crate) fn end(mut self) -> std::process::Output {
        let begun = Instant::now();
        while self.0.try_wait().expect("it can be asked").is_none() {
            assert!(begun.elapsed() < PATIENCE, "the fleet does not end");
            std::thread::sleep(Duration::from_millis(20));
        }
        let taken = std::mem::replace(&mut self.0, idle());
        taken.wait_with_output().expect("it has ended")
    }
}

/// A process that is there to be replaced.
fn idle() -> Child {
    Command::new("true")
        .spawn()
        .expect("there is such a command")
}

/// Presses Ctrl-C.
fn interrupt(up: &Up) {
    let id = up.0.id().to_string();
    let _ = Command::new("kill").args(["-INT", &id]).status();
}

impl Drop for Up {
    fn drop(&mut self) {
        // In good order, so that it ends its robots.
        if self.0.try_wait().is_ok_and(|ended| ended.is_none()) {
            interrupt(self);
        }
        let _ = self.0.wait();
    }
}

/// Copies the folder of an example into this one.
fn copy_example(folder: &Path, name: &str) {
    let examples = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples");
    let copy = Command::new("cp")
        .arg("-r")
        .arg(examples.join(name))
        .arg(folder.join(name))
        .status();
    assert!(copy.expect("there is such a command").success());
}

/// Sends a robot of the folder's fleet packets that make no sense, of every length and kind.
fn disturb(folder: &Path) {
    let text = std::fs::read_to_string(folder.join("fleet.toml")).expect("it is there");
    let port = text
        .lines()
        .find_map(|line| line.strip_prefix("first_port = "));
    let port: u16 = port
        .and_then(|port| port.parse().ok())
        .expect("a port is given");
    let socket = UdpSocket::bind("127.0.0.1:0").expect("there is a free port");
    let mut state = 1u64;
    for count in 0..20_000u64 {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1);
        let length = (state >> 33) as usize % 300;
        let mut packet: Vec<u8> = (0..length).map(|i| (state >> (i % 50)) as u8).collect();
        if let Some(kind) = packet.first_mut() {
            *kind = (count % 6) as u8;
        }
        let _ = socket.send_to(&packet, ("127.0.0.1", port));
    }
}

fn status_of(folder: &Path) -> Vec<Value> {
    let output = starl(folder, &["fleet", "status", "fleet.toml", "--json"]);
    // The fleet may not have made its key yet.
    let listed: Option<Value> = serde_json::from_slice(&output.stdout).ok();
    let robots = listed.and_then(|listed| listed.as_array().cloned());
    robots.unwrap_or_default()
}

/// Asks until the fleet is as it is to be.
pub(crate) fn wait_until(folder: &Path, is_so: impl Fn(&[Value]) -> bool) -> Vec<Value> {
    let begun = Instant::now();
    loop {
        let status = status_of(folder);
        if is_so(&status) {
            return status;
        }
        assert!(begun.elapsed() < PATIENCE, "{status:?}");
    }
}

pub(crate) fn hear_each_other(status: &[Value]) -> bool {
    let hears = |robot: &Value| {
        robot["links"][0]["heard_ago"]
            .as_f64()
            .is_some_and(|ago| ago < 0.5)
    };
    status.len() == 2 && status.iter().all(hears)
}

/// Ends a robot's process as a power cut does.
fn kill(folder: &Path, robot: &str) {
    let path = folder.join("fleet.runs").display().to_string();
    let listed = Command::new("ps")
        .args(["-eo", "pid,args"])
        .output()
        .expect("there is such a command");
    let listed = String::from_utf8_lossy(&listed.stdout).into_owned();
    let own = |line: &&str| line.contains(&format!("--id {robot} ")) && !line.contains("ps -eo");
    // Other tests run fleets too, whose robots are called the same: this one's run in this folder.
    let ids = listed
        .lines()
        .filter(own)
        .filter_map(|line| line.split_whitespace().next());
    let here = |id: &&str| {
        let place = std::fs::read_link(format!("/proc/{id}/cwd"));
        place.is_ok_and(|place| Path::new(&path).starts_with(place))
    };
    let id = ids
        .into_iter()
        .find(here)
        .unwrap_or_else(|| panic!("{robot} does not run:\n{listed}"));
    assert!(
        Command::new("kill")
            .args(["-9", id])
            .status()
            .expect("there is such a command")
            .success()
    );
}

/// Reads what a server sends of the trace of a fleet, until that is enough.
#[cfg(feature = "web")]
fn follow(
    server: &crate::web_support::Server,
    is_enough: impl Fn(&[starl_core::Record]) -> bool,
) -> Vec<starl_core::Record> {
    use std::io::{Read, Write};
    let mut stream = std::net::TcpStream::connect(server.host()).expect("the server listens");
    let (host, cookie) = (server.host(), server.cookie());
    // Without chunks, so that what comes is the trace.
    let request = format!("GET /trace HTTP/1.0\r\nhost: {host}\r\ncookie: {cookie}\r\n\r\n");
    stream.write_all(request.as_bytes()).expect("it is read");
    let timeout = Some(Duration::from_secs(5));
    stream.set_read_timeout(timeout).expect("it can be set");
    let (mut bytes, mut part) = (Vec::new(), [0; 65_536]);
    let mut records: Vec<starl_core::Record> = Vec::new();
    let begun = Instant::now();
    loop {
        let length = match stream.read(&mut part) {
            Ok(length) => length,
            // The process, or the whole machine, was stopped for a while.
            Err(error) if error.kind() == std::io::ErrorKind::Interrupted => continue,
            Err(error) => {
                let last = &records[records.len().saturating_sub(40)..];
                panic!("the stream pauses: {error}, after {last:#?}")
            }
        };
        bytes.extend_from_slice(&part[..length]);
        let head = bytes.windows(4).position(|four| four == b"\r\n\r\n");
        let trace = head.map_or(&[][..], |head| &bytes[head + 4..]);
        // At first there is not even a whole header.
        let Ok(reader) = starl_trace::Reader::new(trace) else {
            continue;
        };
        records = reader.map_while(Result::ok).collect();
        if is_enough(&records) {
            return records;
        }
        assert!(begun.elapsed() < PATIENCE, "that is not enough");
    }
}

#[cfg(feature = "web")]
#[test]
fn a_fleet_is_followed_while_it_runs() {
    use starl_core::Event;
    let folder = fleet("fleet_view");
    assert_eq!(status(&starl(&folder, &["fleet", "key", "fleet.toml"])), 0);
    let server = crate::web_support::Server::start(&folder, &["view", "fleet.toml"]);
    let start = server.get("/start.json", &[]).json();
    assert_eq!(
        start,
        serde_json::json!({ "mode": "fleet", "name": "fleet" })
    );
    let up = Up::start(&folder, &[]);
    let has = |records: &[starl_core::Record], robot, is_so: fn(&Event) -> bool| {
        let robot = Some(starl_core::RobotId(robot));
        let mut own = records.iter().filter(|record| record.robot == robot);
        own.any(|record| is_so(&record.event))
    };
    follow(&server, |records| {
        has(records, 1, |event| matches!(event, Event::Estimated(_)))
    });
    kill(&folder, "robot1");
    let records = follow(&server, |records| {
        (0..2).all(|robot| has(records, robot, |event| *event == Event::Finished))
    });
    assert!(records.is_sorted_by_key(|record| record.at));
    let count = |is_so: fn(&Event) -> bool| {
        let mut robots = [0, 0];
        for record in records.iter().filter(|record| is_so(&record.event)) {
            robots[record.robot.expect("a robot's").index()] += 1;
        }
        robots
    };
    let moves = count(|event| matches!(event, Event::Moved(_)));
    assert!(moves.iter().all(|count| *count > 20), "{moves:?}");
    let sent = count(|event| matches!(event, Event::Sent { .. }));
    let delivered = count(|event| matches!(event, Event::Delivered { .. }));
    assert!(sent[0] > 0 && delivered[1] > 0, "{sent:?} {delivered:?}");
    let restarts = count(|event| *event == Event::Fault(starl_core::event::Fault::Restart));
    assert_eq!(restarts, [0, 1]);
    up.end();
}

#[test]
fn a_fleet_finishes_although_a_robot_is_killed() {
    let folder = fleet("fleet_race");
    let up = Up::start(&folder, &[]);
    wait_until(&folder, hear_each_other);
    kill(&folder, "robot1");
    let output = up.end();
    let (text, messages) = (stdout(&output), stderr(&output));
    assert_eq!(status(&output), 0, "{text}{messages}");
    assert!(
        messages.contains("robot1 has died (signal 9), and is restarted"),
        "{messages}"
    );
    assert!(text.contains("broadcast.integrity   holds"), "{text}");
    let run = folder.join("fleet.runs/0001");
    assert_eq!(
        names(&run),
        [
            "epoch",
            "merged.mcap",
            "robot0.1.mcap",
            "robot1.1.mcap",
            "robot1.2.mcap"
        ]
    );
    // Each life of a robot is repeated at a desk.
    for (trace, robot) in [("robot0.1.mcap", "robot0"), ("robot1.2.mcap", "robot1")] {
        let output = starl(&run, &["replay", trace, "--robot", robot]);
        assert_eq!(status(&output), 0, "{}", stderr(&output));
        assert!(stdout(&output).contains("identical"), "{}", stdout(&output));
    }
    let output = starl(&run, &["replay", "robot1.1.mcap", "--robot", "robot1"]);
    assert!(
        stdout(&output).contains("same as far as it goes") || status(&output) == 0,
        "{}",
        stdout(&output)
    );
    // One robot's records say nothing of the others.
    let output = starl(&run, &["verify", "robot0.1.mcap"]);
    assert_eq!(status(&output), 2);
    assert!(
        stderr(&output).contains("holds the records of robot0 alone"),
        "{}",
        stderr(&output)
    );
    // Nothing repeats the robots together, whose clocks differ.
    for arguments in [
        &["replay", "merged.mcap"][..],
        &["replay", "merged.mcap", "--robot", "robot0"],
    ] {
        let output = starl(&run, arguments);
        assert_eq!(status(&output), 2, "{}", stdout(&output));
    }
    // The traces of robots are never overwritten.
    let trace = run.join("robot0.1.mcap");
    let before = std::fs::read(&trace).expect("it is there");
    let arguments = [
        "fleet",
        "merge",
        "fleet.toml",
        "--out",
        "fleet.runs/0001/robot0.1.mcap",
    ];
    assert_eq!(status(&starl(&folder, &arguments)), 2);
    assert!(std::fs::read(&trace).is_ok_and(|after| after == before));
    // A start that fails leaves a folder without traces, and is not the last run.
    std::fs::create_dir(folder.join("fleet.runs/0002")).expect("it can be made");
    let output = starl(&folder, &["fleet", "merge", "fleet.toml"]);
    assert_eq!(status(&output), 0, "{}", stderr(&output));
}

/// Merges the last run of a folder's fleet and verifies the result; what both print.
fn merge_and_verify(folder: &Path) -> (String, String) {
    let merged = starl(folder, &["fleet", "merge", "fleet.toml"]);
    assert_eq!(status(&merged), 0, "{}", stderr(&merged));
    let judged = starl(folder, &["verify", "fleet.runs/0001/merged.mcap"]);
    let text = stdout(&judged);
    assert_eq!(status(&judged), 0, "{text}{}", stderr(&judged));
    (stdout(&merged), text)
}

#[test]
fn a_trace_that_is_cut_anywhere_is_merged_and_verified() {
    let folder = fleet("fleet_cut");
    let output = Up::start(&folder, &[]).end();
    assert_eq!(status(&output), 0, "{}{}", stdout(&output), stderr(&output));
    let path = folder.join("fleet.runs/0001/robot1.1.mcap");
    let whole = std::fs::read(&path).expect("it was written");
    assert!(!merge_and_verify(&folder).0.contains("robot1.1.mcap"));
    for part in 1..8 {
        let length = whole.len() * part / 8;
        std::fs::write(&path, &whole[..length]).expect("it can be written");
        let (merged, judged) = merge_and_verify(&folder);
        let is_named = merged.contains("robot1.1.mcap: is cut short at ")
            || merged.contains("robot1.1.mcap: contains no records, and is left out");
        assert!(is_named, "cut at {length}: {merged}");
        assert!(judged.contains("broadcast.integrity   holds"), "{judged}");
    }
    for length in [0, 4, 8, 100] {
        std::fs::write(&path, &whole[..length]).expect("it can be written");
        let (merged, _) = merge_and_verify(&folder);
        for message in [
            "robot1.1.mcap: contains no records, and is left out",
            "robot1: its trace is missing",
        ] {
            assert!(merged.contains(message), "cut at {length}: {merged}");
        }
    }
    // The process was killed while it replaced the end of the file by a chunk.
    let mut damaged = whole.clone();
    for byte in damaged.iter_mut().skip(whole.len() * 3 / 4) {
        *byte ^= 0x55;
    }
    std::fs::write(&path, damaged).expect("it can be written");
    let (merged, _) = merge_and_verify(&folder);
    let is_named = merged.contains("robot1.1.mcap: cannot be read after ")
        || merged.contains(
            "robot1.1.mcap: contains no records, and is left out: the trace is damaged at ",
        );
    assert!(is_named, "{merged}");
}

#[test]
fn an_operator_sees_and_stops_a_fleet_and_a_stranger_does_not() {
    let folder = fleet("fleet_operator");
    let up = Up::start(&folder, &["--keep"]);
    let offset = |robots: &[Value]| robots[0]["links"][0]["clock_offset"].as_f64();
    let robots = wait_until(&folder, |robots| {
        hear_each_other(robots) && offset(robots).is_some()
    });
    assert_eq!(robots[0]["name"], "robot0");
    assert!(robots[0]["position"][0].as_f64().is_some(), "{robots:?}");
    assert!(
        offset(&robots).is_some_and(|s| s.abs() < 0.05),
        "{robots:?}"
    );

    disturb(&folder);
    let robots = wait_until(&folder, |robots| {
        hear_each_other(robots) && robots[0]["refused_packets"].as_u64() > Some(1000)
    });
    assert!(
        robots.iter().all(|robot| robot["failure"].is_null()),
        "{robots:?}"
    );

    // The same fleet file with another key.
    let strange = folder.join("stranger");
    std::fs::create_dir(&strange).expect("it can be made");
    for name in ["race.toml", "fleet.toml"] {
        std::fs::copy(folder.join(name), strange.join(name)).expect("it can be copied");
    }
    assert_eq!(status(&starl(&strange, &["fleet", "key", "fleet.toml"])), 0);
    let output = starl(&strange, &["fleet", "stop", "fleet.toml"]);
    assert_eq!(status(&output), 1, "{}", stderr(&output));
    assert!(
        stderr(&output).contains("no answer from robot0, robot1"),
        "{}",
        stderr(&output)
    );
    let robots = wait_until(&folder, |robots| {
        robots[0]["refused_packets"].as_u64() > Some(0)
    });
    assert!(
        robots.iter().all(|robot| robot["condition"] != "missing"),
        "{robots:?}"
    );

    let output = starl(&folder, &["fleet", "stop", "fleet.toml"]);
    assert_eq!(status(&output), 0, "{}", stderr(&output));
    assert_eq!(stdout(&output), "stopped 2 robots\n");
    // They are not started again, and the run is judged.
    let output = up.end();
    let (text, messages) = (stdout(&output), stderr(&output));
    assert!(!messages.contains("restarted"), "{messages}");
    assert!(
        messages.contains("all robots have been stopped"),
        "{messages}"
    );
    assert!(text.contains("broadcast.integrity   holds"), "{text}");
    assert!(
        status_of(&folder)
            .iter()
            .all(|robot| robot["condition"] == "missing")
    );
}

#[test]
fn problems_of_a_fleet_file_are_reported_in_one_message() {
    let folder = folder("fleet_bad");
    file(&folder, "race.toml", RACE);
    let cases = [
        (
            "scenario = \"race.toml\"\nspeed = 3\n",
            "fleet.toml:2: unknown field `speed`",
        ),
        (
            "scenario = \"nothing.toml\"\n",
            "fleet.toml: scenario = \"nothing.toml\": there is no example and no file",
        ),
        (
            "scenario = \"race.toml\"\nset = [\"parameters.speed=1\"]\n",
            "fleet.toml: set: parameters.speed: the program has no such parameter",
        ),
        (
            "scenario = \"race.toml\"\n[robots.robot7]\n",
            "robots.robot7: the scenario has no robot of this name",
        ),
        (
            "scenario = \"race.toml\"\n[robots.robot0]\naddress = \"here\"\n",
            "fleet.toml:3: address = \"here\": give an address with its port",
        ),
        (
            "scenario = \"race.toml\"\nworld = \"emulated\"\n",
            "fleet.toml:2: world = \"emulated\": give an address with its port",
        ),
        (
            "scenario = \"race.toml\"\n[world]\nobstacle = []\n",
            "`world` is an address, such as world = \"127.0.0.1:7500\"",
        ),
        (
            "scenario = \"race.toml\"\nworld = \"127.0.0.1:7401\"\n",
            "world: is 127.0.0.1:7401, as robot1's address; take another port",
        ),
        (
            "scenario = \"race.toml\"\n[robots.robot0]\naddress = \"127.0.0.1:7000\"\n[robots.robot1]\naddress = \"127.0.0.1:7000\"\n",
            "robots.robot1: has the address 127.0.0.1:7000, as robot0 has",
        ),
        (
            "scenario = \"race.toml\"\n[safety]\nlink_timeout = \"fast\"\n",
            "safety.link_timeout = \"fast\": give a time",
        ),
        (
            "scenario = \"race.toml\"\n[link]\nrouter = \"tcp/here:1\"\n",
            "link.router: is for `kind = \"zenoh\"`",
        ),
        (
            "scenario = \"race.toml\"\n[robots.robot0]\ndevice = { kind = \"toaster\" }\n",
            "fleet.toml:3: unknown variant `toaster`",
        ),
        (
            "scenario = \"race.toml\"\n[robots.robot0]\ndevice = { kind = \"ardrone\" }\n",
            "robots.robot0.device: kind = \"ardrone\" is for the model drone, and the scenario's robot is a holonomic",
        ),
        (
            "scenario = \"race.toml\"\n[robots.robot0]\ndevice = { kind = \"create\", port = \"x\", generation = 3 }\n",
            "robots.robot0.device.generation = 3: give 1 for the Create of 2007",
        ),
        (
            "scenario = \"race.toml\"\n[robots.robot1]\nbody = \"robot0\"\n",
            "robots.robot1.body: is \"robot0\", as robot0's",
        ),
        (
            "scenario = \"race.toml\"\ntrace_limit_mib = 0\n",
            "fleet.toml:2: invalid value: integer `0`",
        ),
    ];
    for (text, message) in cases {
        file(&folder, "fleet.toml", text);
        for arguments in [
            ["fleet", "status", "fleet.toml"],
            ["fleet", "up", "fleet.toml"],
        ] {
            let output = starl(&folder, &arguments);
            assert_eq!(status(&output), 2, "{text}");
            assert!(stderr(&output).contains(message), "{}", stderr(&output));
        }
    }
    file(&folder, "fleet.toml", "scenario = \"race.toml\"\n");
    let output = starl(
        &folder,
        &["robot", "--id", "robot0", "--fleet", "fleet.toml"],
    );
    assert_eq!(status(&output), 2);
    assert!(
        stderr(&output).contains("`starl fleet key fleet.toml` makes a key"),
        "{}",
        stderr(&output)
    );
    let output = starl(
        &folder,
        &["robot", "--id", "nobody", "--fleet", "fleet.toml"],
    );
    assert_eq!(status(&output), 2);
    assert!(
        stderr(&output).contains("the robots are: robot0, robot1"),
        "{}",
        stderr(&output)
    );
}

/// Race, byte for byte the program that the simulator runs, on four processes: two Creates on serial lines, two
/// AR.Drones on UDP, positions from motion capture, and messages over Zenoh.
#[cfg(feature = "zenoh")]
#[test]
fn race_runs_on_emulated_creates_and_drones_over_zenoh() {
    let folder = folder("fleet_emulated");
    copy_example(&folder, "race");
    // In its own world B is 3 cm too near to an obstacle for a drone. There the outcome would depend on how late this
    // machine lets the processes run, so B moves 0.2 m away.
    let ways = folder.join("race/worlds/four.wpt");
    let text = std::fs::read_to_string(&ways).expect("the example has it");
    let moved = text.replace("WAY,93,1430,0,B", "WAY,0,1600,0,B");
    assert_ne!(text, moved);
    file(&folder, "race/worlds/four.wpt", &moved);
    let first = ports(9);
    let mut text = format!(
        "scenario = \"race/race.toml\"\nlink = {{ kind = \"zenoh\", first_port = {first} }}\n\
         positions = {{ kind = \"natnet\", server = \"127.0.0.1:{}\" }}\n",
        first + 4
    );
    for (index, robot) in ["iRobot0", "iRobot1"].iter().enumerate() {
        text += &format!(
            "[robots.{robot}]\ndevice = {{ kind = \"create\", port = \"line{index}\" }}\n"
        );
    }
    for (index, robot) in ["quadcopter0", "quadcopter1"].iter().enumerate() {
        let port = first + 5 + 2 * index as u16;
        text += &format!(
            "[robots.{robot}]\ndevice = {{ kind = \"ardrone\", commands = \"127.0.0.1:{port}\", navdata = \"127.0.0.1:{}\" }}\n",
            port + 1
        );
    }
    file(&folder, "fleet.toml", &text);
    let output = Up::start(&folder, &["--emulate"]).end();
    let (text, messages) = (stdout(&output), stderr(&output));
    assert_eq!(status(&output), 0, "{text}{messages}");
    assert!(!messages.contains("ran into"), "{messages}");
    for property in [
        "no_collision",
        "reach_avoid.goal",
        "broadcast.delivery",
        "broadcast.integrity",
    ] {
        let line = text.lines().find(|line| line.starts_with(property));
        assert!(line.is_some_and(|line| line.ends_with("holds")), "{text}");
    }
}

/// A robot drives ahead until it bumps into something.
const RAM: &str = r#"
program Ram

ahead()
    pre bumped == none
    eff drive_wheels(0.3, 0.3)

rest()
    pre bumped != none
    eff drive_wheels(0.0, 0.0); finish()
"#;

/// Runs robots with the program [`RAM`] in the world of the emulator, from these starts, and returns its output.
fn ram(test: &str, starts: &str, extra: &str) -> std::process::Output {
    let folder = folder(test);
    file(&folder, "ram.starl", RAM);
    let count = starts.matches("position").count();
    let scenario = format!(
        "program = \"ram.starl\"\nduration = \"30s\"\n{extra}\n[[robots]]\nmodel = \"create\"\n\
         name = \"robot\"\ncount = {count}\nstart = [{starts}]\n"
    );
    file(&folder, "ram.toml", &scenario);
    let first = ports(3);
    let text = format!(
        "scenario = \"ram.toml\"\nworld = \"127.0.0.1:{}\"\n[link]\nfirst_port = {first}\n",
        first + 2
    );
    file(&folder, "fleet.toml", &text);
    Up::start(&folder, &["--emulate"]).end()
}

/// Two robots that face each other.
const FACE_TO_FACE: &str = "{ position = [0, 0] }, { position = [1, 0], heading = \"180deg\" }";

#[test]
fn a_fleet_whose_emulated_robots_collide_fails() {
    let output = ram("fleet_collides", FACE_TO_FACE, "");
    let (text, messages) = (stdout(&output), stderr(&output));
    assert_eq!(status(&output), 1, "{text}{messages}");
    for message in [
        " ran into robot",
        "all robots have finished",
        "emulated robots ran into something ",
    ] {
        assert!(messages.contains(message), "{message}: {text}{messages}");
    }
}

#[test]
fn a_fleet_may_collide_where_its_scenario_allows_it() {
    let allowed = "[properties]\nno_collision = false\n";
    let output = ram("fleet_may_collide", FACE_TO_FACE, allowed);
    let messages = stderr(&output);
    assert_eq!(status(&output), 0, "{}{messages}", stdout(&output));
    assert!(messages.contains(" ran into robot"), "{messages}");
}

#[test]
fn a_fleet_whose_emulated_robot_runs_into_an_obstacle_fails() {
    let wall = "[[world.obstacle]]\nbox = { low = [0.8, -1, 0], high = [1, 1, 1] }\n";
    let output = ram("fleet_wall", "{ position = [0, 0] }", wall);
    let messages = stderr(&output);
    assert_eq!(status(&output), 1, "{}{messages}", stdout(&output));
    assert!(
        messages.contains("robot0 ran into an obstacle near (0.6"),
        "{messages}"
    );
}

/// Two Creates that run a race of a few seconds.
#[cfg(feature = "zenoh")]
const CREATES: &str = r#"
program = "race"
duration = "60s"

[world]
way_point = [
    { name = "A", position = [1, 0] },
    { name = "B", position = [1, 1] },
]

[[robots]]
model = "create"
name = "robot"
count = 2
start = [{ position = [0, 0] }, { position = [0, 1] }]
"#;

#[cfg(feature = "zenoh")]
#[test]
fn ros_2_robots_race_and_locate_themselves() {
    let folder = folder("fleet_ros2");
    file(&folder, "race.toml", CREATES);
    let first = ports(3);
    let mut text = format!("scenario = \"race.toml\"\n[link]\nfirst_port = {first}\n");
    text += "[positions]\nkind = \"ros2\"\n";
    for robot in ["robot0", "robot1"] {
        let router = format!("tcp/127.0.0.1:{}", first + 2);
        text += &format!(
            "[robots.{robot}]\ndevice = {{ kind = \"ros2\", router = \"{router}\", namespace = \"{robot}\" }}\n"
        );
    }
    file(&folder, "fleet.toml", &text);
    let output = Up::start(&folder, &["--emulate"]).end();
    let (text, messages) = (stdout(&output), stderr(&output));
    assert_eq!(status(&output), 0, "{text}{messages}");
    let run = folder.join("fleet.runs/0001");
    let output = starl(&run, &["verify", "merged.mcap"]);
    assert_eq!(status(&output), 0, "{}", stdout(&output));
    assert!(
        stdout(&output).contains("broadcast.integrity   holds"),
        "{}",
        stdout(&output)
    );
}

/// A folder with a fleet of two robots that reach each other by a router, and its endpoint.
#[cfg(feature = "zenoh")]
fn fleet_with_router(test: &str) -> (std::path::PathBuf, String) {
    let folder = fleet(test);
    let endpoint = format!("tcp/127.0.0.1:{}", ports(1));
    name_router(&folder, &endpoint);
    (folder, endpoint)
}

#[cfg(feature = "zenoh")]
fn name_router(folder: &Path, endpoint: &str) {
    let link = format!("link = {{ kind = \"zenoh\", router = \"{endpoint}\" }}\n");
    let text = format!("scenario = \"race.toml\"\n{link}");
    file(folder, "fleet.toml", &text);
}

#[cfg(feature = "zenoh")]
#[test]
fn robots_race_by_a_router_that_starts_after_them() {
    let (folder, endpoint) = fleet_with_router("fleet_router");
    let printed = starl(&folder, &["fleet", "up", "fleet.toml", "--print"]);
    let first = format!("{endpoint}: starl fleet router fleet.toml, or another Zenoh router\n");
    assert!(stdout(&printed).starts_with(&first), "{}", stdout(&printed));
    let up = Up::start(&folder, &[]);
    std::thread::sleep(Duration::from_millis(500));
    let mut router = command(&folder, &["fleet", "router", "fleet.toml"]);
    let router = Up(router.stdout(Stdio::piped()).spawn().expect("it was built"));
    let output = up.end();
    assert_eq!(status(&output), 0, "{}{}", stdout(&output), stderr(&output));
    assert!(stdout(&output).contains("broadcast.integrity   holds"));
    let second = starl(&folder, &["fleet", "router", "fleet.toml"]);
    assert_eq!(status(&second), 2);
    let message = format!("fleet.toml: link.router: no router can run at {endpoint}: ");
    assert!(stderr(&second).contains(&message), "{}", stderr(&second));
    interrupt(&router);
    let output = router.end();
    assert_eq!(status(&output), 0);
    assert_eq!(stdout(&output), format!("routing at {endpoint}\nready\n"));
}

#[test]
fn a_robot_whose_trace_cannot_be_written_drives_without_one() {
    let folder = fleet("fleet_no_trace");
    let run = folder.join("fleet.runs/0001");
    std::fs::create_dir_all(&run).expect("it can be made");
    let nowhere = folder.join("nowhere/trace.mcap");
    std::os::unix::fs::symlink(nowhere, run.join("robot0.1.mcap")).expect("it can be made");
    let output = Up::start(&folder, &["--resume"]).end();
    let (text, messages) = (stdout(&output), stderr(&output));
    assert_eq!(status(&output), 0, "{text}{messages}");
    assert!(
        messages.contains("the robot continues without a trace"),
        "{messages}"
    );
    assert!(messages.contains("all robots have finished"), "{messages}");
    assert!(text.contains("robot0: its trace is missing"), "{text}");
}

#[test]
fn a_run_of_another_scenario_is_not_continued() {
    let folder = fleet("fleet_changed");
    let output = Up::start(&folder, &["--duration", "1s"]).end();
    assert_eq!(status(&output), 1, "{}", stderr(&output));
    file(&folder, "race.toml", &RACE.replace("[2, 2]", "[2, 3]"));
    let output = Up::start(&folder, &["--resume"]).end();
    assert_eq!(status(&output), 2);
    let message =
        "error: fleet.runs/0001: is a run of another scenario; begin a new run without --resume\n";
    assert_eq!(stderr(&output), message);
}

#[cfg(feature = "zenoh")]
#[test]
fn a_fleet_without_its_router_waits_and_can_be_ended() {
    let (folder, endpoint) = fleet_with_router("fleet_lost_router");
    let up = Up::start(&folder, &[]);
    std::thread::sleep(Duration::from_millis(500));
    for command in ["status", "stop"] {
        let output = starl(&folder, &["fleet", command, "fleet.toml"]);
        let message = format!("link.router: no router answers at {endpoint}; `starl fleet router");
        assert_eq!(status(&output), 2);
        assert!(stderr(&output).contains(&message), "{}", stderr(&output));
    }
    interrupt(&up);
    let output = up.end();
    assert_eq!(status(&output), 1);
    let message = format!("fleet: waits for the router at {endpoint}\n");
    assert_eq!(stderr(&output), message);
}

#[cfg(feature = "zenoh")]
#[test]
fn a_router_needs_a_place() {
    let folder = fleet("fleet_no_router");
    let refuse = |expected: &str| {
        let output = starl(&folder, &["fleet", "router", "fleet.toml"]);
        assert_eq!(status(&output), 2);
        assert!(stderr(&output).contains(expected), "{}", stderr(&output));
    };
    refuse("link.router: a router is for `kind = \"zenoh\"`");
    file(
        &folder,
        "fleet.toml",
        "scenario = \"race.toml\"\nlink.kind = \"zenoh\"\n",
    );
    refuse("link.router: give the place of the router");
    name_router(&folder, "127.0.0.1:7447");
    refuse("link.router: \"127.0.0.1:7447\" is not an endpoint");
}

#[cfg(feature = "zenoh")]
#[test]
fn robots_that_have_no_localisation_cannot_be_located_by_ros_2() {
    let folder = folder("fleet_ros2_bad");
    file(&folder, "race.toml", CREATES);
    let device = "[robots.robot0]\ndevice = { kind = \"create\", port = \"/dev/null\" }\n";
    let text = format!("scenario = \"race.toml\"\n[positions]\nkind = \"ros2\"\n{device}");
    file(&folder, "fleet.toml", &text);
    starl(&folder, &["fleet", "key", "fleet.toml"]);
    let arguments = ["robot", "--id", "robot0", "--fleet", "fleet.toml"];
    let output = starl(&folder, &arguments);
    assert_eq!(status(&output), 2);
    assert!(
        stderr(&output).contains("positions.kind"),
        "{}",
        stderr(&output)
    );
}

/// A robot finishes when its detector shows another one.
const LOOKOUT: &str = r#"
program Lookout

look()
    pre sees(detected)
    eff finish()

function sees(seen: List[Detection]) -> Bool
    for other in seen
        if other.robot != none
            return true
    return false
"#;

#[test]
fn a_detector_shows_robots_that_motion_capture_follows() {
    let folder = folder("fleet_detector");
    file(&folder, "lookout.starl", LOOKOUT);
    let scenario = r#"
program = "lookout.starl"
duration = "60s"

[[robots]]
model = "create"
name = "robot"
count = 2
start = [{ position = [0, 0] }, { position = [1, 0] }]
sensors = { detector = { range = "1.5m" } }
"#;
    file(&folder, "lookout.toml", scenario);
    let first = ports(3);
    let mut text = format!(
        "scenario = \"lookout.toml\"\n[link]\nfirst_port = {first}\n\
         [positions]\nkind = \"natnet\"\nserver = \"127.0.0.1:{}\"\n",
        first + 2
    );
    for robot in ["robot0", "robot1"] {
        text += &format!(
            "[robots.{robot}]\ndevice = {{ kind = \"create\", port = \"{robot}.line\" }}\n"
        );
    }
    file(&folder, "fleet.toml", &text);
    let output = Up::start(&folder, &["--emulate"]).end();
    assert_eq!(status(&output), 0, "{}{}", stdout(&output), stderr(&output));
    for robot in ["robot0", "robot1"] {
        let trace = format!("fleet.runs/0001/{robot}.1.mcap");
        let output = starl(&folder, &["replay", &trace, "--robot", robot]);
        assert!(stdout(&output).contains("identical"), "{}", stderr(&output));
    }
}

#[test]
fn a_trained_network_steers_robots_in_processes_of_their_own() {
    let folder = folder("fleet_policy");
    copy_example(&folder, "crossing");
    let scenario = r#"
program = "crossing/crossing.starl"
duration = "60s"

[[robots]]
model = "holonomic"
name = "robot"
count = 2
model_parameters = { speed = "0.5m/s", cruise_speed = "0.5m/s" }
start = [{ position = [1, 0] }, { position = [-1, 0] }]

[world]
way_point = [{ name = "robot0", position = [-1, 0] }, { name = "robot1", position = [1, 0] }]
"#;
    file(&folder, "two.toml", scenario);
    fleet_file(&folder, "two.toml");
    let output = Up::start(&folder, &[]).end();
    assert_eq!(status(&output), 0, "{}{}", stdout(&output), stderr(&output));
    // The network is in the trace, and gives the same numbers there.
    let trace = "fleet.runs/0001/robot0.1.mcap";
    let output = starl(&folder, &["replay", trace, "--robot", "robot0"]);
    assert!(stdout(&output).contains("identical"), "{}", stderr(&output));
}
