//! A scenario's parameters reach a program in the StarL language with the types that it declares.
//! Values that do not match are refused, with the place in the scenario and a suggested fix.

use starl_catalog::{Application, Refusal};
use starl_core::{Duration, FileError, Time};
use starl_lang::machine::Value;
use starl_lang::robot::RobotProgram;
use starl_sim::read::{Loader, Request, Source};

const PROGRAM: &str = "\
program Settings
enum Side {left, right}
param flag: Bool
param count: Int in -9..10 = 1
param length: Float = 1.0
param name: String = \"a\"
param span: Duration = 1s
param start: Time = now_zero()
param place: Point = Point(0.0, 0.0)
param side: Side = left
param leader: RobotId
param places: List[Point] = []
param kinds: Set[Int] = {}
param maybe: Float? = none
param bids: List[(Float, RobotId)] = []
idle()
    eff log(\"{} {} {} {} {} {} {} {} {} {} {} {} {}\", flag, count, length, name, span, start, place, side, leader, places, kinds, maybe, bids)
";

struct OneFile(String);

impl Loader for OneFile {
    fn load(&self, path: &str) -> Result<Vec<u8>, FileError> {
        match path {
            "settings.starl" => Ok(self.0.clone().into_bytes()),
            _ => Err(FileError::Missing),
        }
    }
}

fn read(parameters: &str) -> Result<Application, Refusal> {
    // No constant has the type Time, so this one is left to the scenario.
    let program = PROGRAM.replace(" = now_zero()", "");
    let scenario = format!(
        "program = \"settings.starl\"\n[parameters]\n{parameters}\n\
         [[robots]]\nmodel = \"create\"\nstart = [{{ position = [0, 0] }}, {{ position = [1, 0] }}]\n"
    );
    starl_catalog::read(
        &Request::new(Source::new("run.toml", scenario)),
        &OneFile(program),
        &starl_catalog::programs::Registry::default(),
    )
}

/// The least that the program must be given.
const LEAST: &str = "flag = true\nleader = \"create1\"\nstart = \"2s\"\n";

#[test]
fn each_type_is_written_in_its_way() {
    let given = "flag = true\ncount = -3\nlength = \"75mm\"\nname = \"north\"\nspan = \"250ms\"\nstart = \"2s\"\n\
                 place = [1, 2.5]\nside = \"right\"\nleader = \"create1\"\nplaces = [[0, 1], [2, 3, 4]]\n\
                 kinds = [3, 1, 3]\nmaybe = 2\nbids = [[1, \"create1\"], [\"75mm\", \"create0\"]]\n";
    let application = read(given).unwrap_or_else(|refusal| panic!("{refusal}"));
    let run = application.run().unwrap();
    let program = run
        .simulation()
        .program(starl_core::RobotId(0))
        .inspect()
        .unwrap();
    let program: &RobotProgram = program.downcast_ref().unwrap();
    let value = |name| program.code().program().get(program.state(), name).unwrap();
    let shown = |name| value(name).to_string();
    assert_eq!(value("flag"), Value::Bool(true));
    assert_eq!(value("count"), Value::Int(-3));
    assert_eq!(value("length"), Value::Float(0.075));
    assert_eq!(value("name"), Value::Text("north".into()));
    assert_eq!(value("span"), Value::Duration(Duration::from_millis(250)));
    assert_eq!(value("start"), Value::Time(Time(2_000_000_000)));
    assert_eq!(shown("place"), "(1.0, 2.5, 0.0)");
    assert_eq!(value("side"), Value::Variant("right".into()));
    assert_eq!(value("leader"), Value::Robot(starl_core::RobotId(1)));
    assert_eq!(shown("places"), "[(0.0, 1.0, 0.0), (2.0, 3.0, 4.0)]");
    assert_eq!(shown("kinds"), "{1, 3}");
    assert_eq!(shown("maybe"), "2.0");
    assert_eq!(shown("bids"), "[(1.0, robot1), (0.075, robot0)]");
}

#[test]
fn omitted_parameters_have_their_defaults() {
    let application = read(LEAST).unwrap_or_else(|refusal| panic!("{refusal}"));
    let run = application.run().unwrap();
    let program = run
        .simulation()
        .program(starl_core::RobotId(1))
        .inspect()
        .unwrap();
    let program: &RobotProgram = program.downcast_ref().unwrap();
    let value = |name| program.code().program().get(program.state(), name).unwrap();
    assert_eq!(value("count"), Value::Int(1));
    assert_eq!(value("side"), Value::Variant("left".into()));
    assert_eq!(value("maybe"), Value::None);
}

#[test]
fn invalid_values_are_rejected_with_their_position() {
    let cases = [
        (
            "count = 1.5",
            "run.toml:6:9: parameters.count: 1.5 does not fit; give a whole number, without unit or point",
        ),
        (
            "count = \"3m\"",
            "run.toml:6:9: parameters.count: 3 does not fit; give a whole number, without unit or point",
        ),
        (
            "count = 10",
            "run.toml:6:9: parameters.count: 10 is out of range; give a whole number, without unit or point, from -9 to 9",
        ),
        (
            "length = \"2s\"",
            "parameters.length: \"2s\" does not fit; give a number, or a quantity such as \"75mm\"",
        ),
        (
            "name = 4",
            "parameters.name: 4 does not fit; give a text that is not a quantity",
        ),
        (
            "span = 4",
            "parameters.span: 4 does not fit; give a time, such as \"250ms\"",
        ),
        (
            "place = [1]",
            "parameters.place: a list of 1 does not fit; give a point [x, y] or [x, y, z], metres",
        ),
        (
            "side = \"up\"",
            "parameters.side: \"up\" does not fit; give one of left, right",
        ),
        (
            "places = [[0, 0], 4]",
            "parameters.places.1: 4 does not fit; give a point [x, y] or [x, y, z], metres",
        ),
        (
            "kinds = [1, \"a\"]",
            "parameters.kinds.1: \"a\" does not fit; give a whole number, without unit or point",
        ),
        (
            "maybe = \"a\"",
            "parameters.maybe: \"a\" does not fit; give a number, or a quantity such as \"75mm\"",
        ),
        (
            "bids = [[1, \"create7\"]]",
            "parameters.bids.0.1: \"create7\" does not fit; give the name of a robot",
        ),
        (
            "bids = [[1]]",
            "parameters.bids.0: a list of 1 does not fit; give a list [a number, or a quantity such as \"75mm\"; the name of a robot]",
        ),
        (
            "sidde = \"left\"",
            "run.toml:6:9: parameters.sidde: the program has no such parameter; did you mean `side`?",
        ),
    ];
    for (given, expected) in cases {
        let refusal = read(&format!("{LEAST}{given}"))
            .expect_err(given)
            .to_string();
        assert!(refusal.ends_with(expected), "{given}: {refusal}");
        assert!(refusal.starts_with("run.toml:6:"), "{given}: {refusal}");
    }
}

#[test]
fn missing_required_parameters_are_reported() {
    let refusal = read("flag = true\nstart = \"0s\"")
        .expect_err("there is no leader")
        .to_string();
    assert!(
        refusal.contains("parameters.leader: is missing"),
        "{refusal}"
    );
    assert!(refusal.ends_with("give the name of a robot"), "{refusal}");
    let unknown = read("flag = true\nstart = \"0s\"\nleader = \"create7\"")
        .expect_err("there is no such robot");
    let unknown = unknown.to_string();
    assert!(
        unknown.ends_with("parameters.leader: \"create7\" does not fit; give the name of a robot"),
        "{unknown}"
    );
}
