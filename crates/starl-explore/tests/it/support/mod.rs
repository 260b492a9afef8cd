//! Small programs to explore, and a search of them.

pub mod elector;
pub mod keeper;
pub mod locker;
pub mod registrar;
pub mod sharer;
pub mod speaker;
pub mod tieless;
pub mod waiter;

use starl_core::{Duration, Event, Program, Record};
use starl_explore::{Bounds, Clocks, End, Model, Report, Search, Setup, Walk};
use starl_properties::{Checker, Properties, Setting, Violation};

/// A fleet of robots that run the same program, without checkers.
pub fn setup(robots: usize, program: impl Program + Clone + 'static, bounds: Bounds) -> Setup {
    let programs = (0..robots).map(|_| Box::new(program.clone()) as Box<dyn Program>);
    Setup {
        model: Model::new(programs.collect()),
        bounds,
        checkers: Vec::new(),
        invariants: Vec::new(),
    }
}

/// The same, watched by the checkers that watch every run.
pub fn watched(setup: Setup) -> Setup {
    let members = setup.model.members.iter();
    // Nothing is ever too late.
    let forever = Duration::from_seconds(1 << 30);
    let setting = Setting {
        bodies: members.map(|member| member.body).collect(),
        properties: Properties::default().without_bounds(forever),
        keeps_storage: setup.model.keeps_storage,
        ..Setting::default()
    };
    Setup {
        checkers: starl_properties::checkers(&setting),
        ..setup
    }
}

/// Clocks that tick once a second: `warm_up` ticks in the warm-up and `ticks` after it. Datagrams arrive within the
/// delay or not at all.
pub fn seconds(warm_up: u16, ticks: u16, delay: Option<u8>) -> Clocks {
    Clocks::Ticking {
        tick: Duration::from_seconds(1),
        ticks: warm_up + ticks,
        skew: 0,
        delay,
    }
}

/// Searches to the end from the state after a warm-up, doubting on the way.
pub fn search_warm(setup: Setup, warm_up: u16) -> Search {
    let (mut walk, first) = Walk::start(setup);
    let taken = walk.warm_up(warm_up).expect("robots come to rest");
    let moments = taken.iter().flat_map(|(_, moment)| &moment.violations);
    let violations = first.violations.iter().chain(moments).cloned().collect();
    let mut search = Search::from(&walk, violations).expect("few robots");
    search.set_doubting(true);
    search.run();
    search
}

/// Explores after a warm-up, and finds no violation; gives the states, transitions and depth.
pub fn all_is_well(setup: Setup, warm_up: u16) -> (u32, u64, u32) {
    let mut search = search_warm(setup, warm_up);
    assert_eq!(search.run(), &End::Complete);
    let report = search.report();
    assert!(report.compared > 0, "no two robots came to the same state");
    size(&report)
}

/// Whether a primitive reports this event in some behaviour after a warm-up: a search in which nothing is ever
/// granted would show nothing.
pub fn happens(setup: Setup, warm_up: u16, event: &'static str) -> bool {
    matches!(
        search_warm(seeing(setup, event, 1), warm_up).run(),
        End::Violated(_)
    )
}

/// The same with an event of a primitive that happens so many times as the only violation.
pub fn seeing(setup: Setup, event: &'static str, times: u32) -> Setup {
    let before = times - 1;
    Setup {
        checkers: vec![Box::new(Sees { event, before })],
        ..setup
    }
}

/// Takes an event of a primitive for a violation.
#[derive(Clone, Debug)]
struct Sees {
    event: &'static str,
    /// How often it happens before.
    before: u32,
}

impl Checker for Sees {
    fn properties(&self) -> &'static [&'static str] {
        &["seen"]
    }

    fn observe(&mut self, record: &Record, violations: &mut Vec<Violation>) {
        if let (Some(robot), Event::Primitive { event, .. }) = (record.robot, &record.event)
            && event.name() == self.event
        {
            if self.before > 0 {
                self.before -= 1;
                return;
            }
            let name = event.name();
            violations.push(Violation {
                property: "seen".into(),
                at: record.at,
                robots: vec![robot],
                text: format!("robot {robot} reports {name}"),
            });
        }
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
