//! Reading a scenario never panics, its problems name places that can be found, and what can be read
//! is read again the same from what was recorded.
//!
//! An input is several texts with a line of `%%` between them: the scenario, a world file, an
//! occupancy image, a fault file, `--robots`, and `--set` a line each; missing ones are left out.
//! Seeds: `fuzz/seeds/scenario_reader`, and the cases of `crates/starl-sim/tests/bad_scenarios`.

#![no_main]

use libfuzzer_sys::fuzz_target;
use starl_core::FileError;
use starl_sim::read::{self, Loader, Override, Place, Request, Source};

/// Whatever path is asked for: an image if its name ends like one, else the world file.
struct Files<'a> {
    world: &'a [u8],
    image: &'a [u8],
}

impl Loader for Files<'_> {
    fn load(&self, path: &str) -> Result<Vec<u8>, FileError> {
        let image = path.ends_with("pgm") || path.ends_with("png");
        Ok(if image { self.image } else { self.world }.to_vec())
    }
}

fuzz_target!(|bytes: &[u8]| {
    let parts = split(bytes);
    let part = |index: usize| parts.get(index).copied().unwrap_or_default();
    let text = |index: usize| String::from_utf8_lossy(part(index)).into_owned();
    let mut request = Request::new(Source::new("run.toml", text(0)));
    let given = |index: usize| parts.len() > index && !part(index).is_empty();
    request.faults = given(3).then(|| Source::new("faults.toml", text(3)));
    request.robots = given(4).then(|| text(4));
    request.overrides = text(5)
        .lines()
        .filter_map(|line| Override::set(line).ok())
        .collect();
    // Fleets of millions are slow, not wrong.
    if bytes
        .windows(5)
        .any(|window| window.iter().all(|b| b.is_ascii_digit() || *b == b'_'))
    {
        return;
    }
    let files = Files {
        world: part(1),
        image: part(2),
    };
    match read::scenario(&request, &files) {
        Ok(resolved) => {
            assert!(!resolved.scenario.fleet.is_empty());
            let again = read::again(&resolved.inputs).expect("it was read before");
            assert_eq!(
                format!("{:?}", again.scenario),
                format!("{:?}", resolved.scenario)
            );
        }
        Err(problems) => {
            assert!(!problems.0.is_empty());
            for problem in &problems.0 {
                assert!(!problem.to_string().contains('\0') || bytes.contains(&0));
                if let Place::File { line, column, .. } = problem.place {
                    assert!(line >= 1 && column >= 1);
                }
            }
        }
    }
});

/// The texts between lines of `%%`.
fn split(bytes: &[u8]) -> Vec<&[u8]> {
    let mut parts = Vec::new();
    let mut rest = bytes;
    while let Some(at) = rest.windows(4).position(|window| window == b"\n%%\n") {
        parts.push(&rest[..at + 1]);
        rest = &rest[at + 4..];
    }
    parts.push(rest);
    parts
}
