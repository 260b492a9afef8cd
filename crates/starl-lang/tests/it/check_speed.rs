//! How long it takes to read and check a program of 1,000 lines: shown by
//! `cargo test --release -p starl-lang --test it check_speed -- --ignored --nocapture`.
#![allow(
    clippy::disallowed_methods,
    reason = "it shows how long something takes"
)]

use std::fmt::Write as _;
use std::time::Instant;

use starl_lang::check::{NoLibraries, check};
use starl_lang::diagnostic::{Colour, render};
use starl_lang::syntax::parse;

/// A program of about this many lines, with a bit of everything in each of its parts.
fn program(lines: usize) -> String {
    let mut text = String::from(
        "program Long\n\nmessage Tell(index: Int, at: Point)\nradio = Broadcast()\nmotion = ReachAvoid()\n\
         on Tell(from, index, at)\n    log(\"{} {} {}\", from, index, at)\n",
    );
    let mut part = 0;
    while text.lines().count() < lines {
        write!(
            text,
            "
enum State{part} {{first{part}, second{part}, third{part}}}
record Pair{part} {{left: Int, right: Point}}
state{part}: State{part}
pairs{part}: Map[Int, Pair{part}]
allread seen{part}[RobotId]: Point

/// Counts what lies near.
function near{part}(points: List[Point], center: Point) -> Int
    let close = [p for p in points if distance(p, center) < 2m]
    return close.size() + if center.x > 0.5 then 1 else 0

start{part}()
    pre state{part} == first{part} and near{part}(way_points(), position) >= 0
    eff
        pairs{part}[{part}] = Pair{part}(left = {part}, right = position)
        seen{part}[me] = position
        state{part} = second{part}

go{part}()
    pre state{part} == second{part} and some p = pairs{part}.get({part}) and not motion.active
    eff
        for robot, at in seen{part}
            if robot != me and distance(at, position) < 75mm
                radio.broadcast(Tell(p.left + 1, p.right * 2.0 - Point(1.0, 0.0)))
            elif at.x < 0.0 or p.left % 2 == 1
                motion.reach_avoid(at, obstacles())
        state{part} = if p.left > 10 then third{part} else first{part}

end{part}()
    pre state{part} == third{part}
    eff state{part} = first{part}; finish()

invariant apart{part}: forall r, s: r.id == s.id or distance(r.position, s.position) > 10cm
"
        )
        .unwrap();
        part += 1;
    }
    text
}

#[test]
fn a_long_program_is_correct() {
    let text = program(1000);
    let checked = check(&text, &NoLibraries);
    let said = render("long", &text, checked.diagnostics(), Colour::Off);
    assert_eq!(said, "");
}

#[test]
#[ignore = "shows a time, and claims nothing"]
fn the_time_that_a_long_program_takes() {
    for lines in [1000, 10_000] {
        let text = program(lines);
        let (mut reading, mut both) = (f64::MAX, f64::MAX);
        for _ in 0..20 {
            let start = Instant::now();
            let parsed = parse(&text);
            reading = reading.min(start.elapsed().as_secs_f64());
            let start = Instant::now();
            let checked = check(&text, &NoLibraries);
            both = both.min(start.elapsed().as_secs_f64());
            assert!(parsed.diagnostics().is_empty() && !checked.has_errors());
        }
        println!(
            "{} lines: read in {:.2} ms, read and checked in {:.2} ms",
            text.lines().count(),
            reading * 1e3,
            both * 1e3
        );
    }
}
