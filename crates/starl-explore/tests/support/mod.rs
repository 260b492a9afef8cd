//! Small programs to explore, and a search of them.

#![allow(dead_code, reason = "each test uses some of this")]

pub mod locker;
pub mod tieless;

use starl_core::Program;
use starl_explore::{Bounds, Model, Report, Search, Setup};
use starl_sim::Scenario;
use starl_sim::properties::{self, Setting};

/// A fleet of robots that run the same program, watched by the checkers that are on by default.
pub fn setup(robots: usize, program: impl Program + Clone + 'static, bounds: Bounds) -> Setup {
    let programs = (0..robots).map(|_| Box::new(program.clone()) as Box<dyn Program>);
    let model = Model::new(programs.collect());
    let setting = Setting {
        bodies: model.members.iter().map(|member| member.body).collect(),
        obstacles: Vec::new(),
        walls: 0,
    };
    Setup {
        model,
        bounds,
        checkers: properties::checkers(&Scenario::default(), &setting),
        invariants: Vec::new(),
    }
}

/// Searches to the end, doubting on the way.
pub fn search(setup: Setup) -> Search {
    let mut search = Search::new(setup).expect("few robots");
    search.set_doubting(true);
    search.run();
    search
}

/// The states, transitions and depth of a search.
pub fn size(report: &Report) -> (u32, u64, u32) {
    (report.states, report.transitions, report.depth)
}
