//! The programs in Rust that scenarios can name, and how each is made from its parameters.
//!
//! To add a program to those that we ship, add a line to [`Registry::default`].

mod beacon;
mod diffusion;
mod drive;
mod keeper;
mod radio;

use crate::language::SUFFIX;
use crate::parameters::Parameters;
use beacon::Beacon;
use diffusion::Diffusion;
use drive::Drive;
use keeper::Keeper;
use radio::Radio;
use starl_core::motion::Planner;
use starl_core::{Duration, Program};
use starl_primitives::{reach_avoid, reliable};
use starl_properties::Monitor;
use starl_race::Race;
use starl_sim::engine::Complaint;
use starl_sim::read::suggest;
use starl_sim::scenario::{Fleet, Group};
use std::fmt;
use std::sync::Arc;

/// The programs in Rust that scenarios can name. A front end hands it to [`read`](crate::read), so that two
/// front ends in one process may know different programs.
#[derive(Clone, Debug)]
pub struct Registry(Vec<Entry>);

/// A program with its name.
#[derive(Clone)]
pub struct Entry {
    /// Its name in scenarios.
    pub name: String,
    /// A description, in one line.
    pub summary: String,
    make: Arc<Make>,
    monitor: Option<Box<dyn Monitor>>,
}

type Make = dyn Fn(&mut Parameters<'_>) -> Box<dyn Program> + Send + Sync;

impl fmt::Debug for Entry {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.name)
    }
}

impl Default for Registry {
    /// The programs that StarL ships with.
    fn default() -> Registry {
        let race = "drive through waypoints; the first to arrive sends all on";
        let diffusion = "drive straight, turn away from what the proximity rays see";
        let drive = "give the drive one command of the model";
        let keeper = "read, write and update registers at random";
        let radio = "drive in circles and broadcast four bytes at every activation";
        let beacon = "geocast to the surroundings again and again";
        Registry(Vec::new())
            .with("race", race, |parameters| {
                Race::new(race_options(parameters))
            })
            .with("diffusion", diffusion, |_| Diffusion)
            .with("drive", drive, Drive::new)
            .with("keeper", keeper, |parameters| {
                let (pause, patience) = (Duration::from_millis(500), Duration::from_seconds(3600));
                Keeper::new(
                    parameters.count("operations", 20),
                    parameters.duration("pause", pause),
                    parameters.duration("patience", patience),
                )
            })
            .with("radio", radio, |_| Radio::default())
            .with("beacon", beacon, |parameters| {
                let pause = Duration::from_seconds(5);
                Beacon::new(
                    parameters.duration("pause", pause),
                    parameters.length("radius", 6.0),
                )
            })
    }
}

impl Registry {
    /// Adds a program: its name in scenarios, its summary in one line, and a function that makes a robot's program from
    /// the parameters of its group.
    ///
    /// # Panics
    /// If the name is empty, is taken, or ends in `.starl`, which names files.
    #[must_use]
    pub fn with<P: Program + 'static>(
        mut self,
        name: &str,
        summary: &str,
        make: impl Fn(&mut Parameters<'_>) -> P + Send + Sync + 'static,
    ) -> Registry {
        let is_free = self.entries().iter().all(|entry| entry.name != name);
        assert!(is_free, "there is a program {name:?} already");
        let is_name = !name.is_empty() && !name.ends_with(SUFFIX);
        assert!(is_name, "{name:?} cannot be the name of a program in Rust");
        self.0.push(Entry {
            name: name.to_string(),
            summary: summary.to_string(),
            make: Arc::new(move |parameters| Box::new(make(parameters))),
            monitor: None,
        });
        self
    }

    /// With properties of the program that was added last, which every run with a robot of this program is judged by.
    #[must_use]
    pub fn watched_by(mut self, monitor: impl Monitor + 'static) -> Registry {
        if let Some(entry) = self.0.last_mut() {
            entry.monitor = Some(Box::new(monitor));
        }
        self
    }

    /// Fresh monitors of the properties of a fleet's programs.
    pub fn monitors(&self, fleet: &Fleet) -> Vec<Box<dyn Monitor>> {
        let runs = |entry: &&Entry| {
            let mut groups = fleet.groups.iter();
            groups.any(|group| group.program == entry.name)
        };
        let entries = self.0.iter().filter(runs);
        entries.filter_map(|entry| entry.monitor.clone()).collect()
    }

    /// All programs, in the order in which they were added.
    pub fn entries(&self) -> &[Entry] {
        &self.0
    }

    /// Makes the program of a group of robots.
    ///
    /// # Errors
    /// There is no such program, or it does not accept the parameters.
    pub fn make(&self, group: &Group) -> Result<Box<dyn Program>, Complaint> {
        let Some(entry) = self.0.iter().find(|entry| entry.name == group.program) else {
            let names: Vec<&str> = self.0.iter().map(|entry| &*entry.name).collect();
            return Err(Complaint {
                field: "program".to_string(),
                message: format!("there is no program {:?}", group.program),
                help: suggest::help(&group.program, &names, "there are").unwrap_or_default(),
            });
        };
        let mut parameters = Parameters::new(&group.parameters);
        let program = (entry.make)(&mut parameters);
        parameters.finish(program)
    }
}

/// The names of the planners.
pub const PLANNERS: [(&str, Planner); 4] = [
    ("auto", Planner::Auto),
    ("rrt", Planner::Rrt),
    ("rrt-connect", Planner::RrtConnect),
    ("rrt-star", Planner::RrtStar),
];

fn race_options(parameters: &mut Parameters<'_>) -> starl_race::Options {
    starl_race::Options {
        reach_avoid: reach_avoid_options(parameters),
        broadcast: reliable_options(parameters),
    }
}

fn reach_avoid_options(parameters: &mut Parameters<'_>) -> reach_avoid::Options {
    let default = reach_avoid::Options::default();
    reach_avoid::Options {
        vicinity: parameters.length("vicinity", default.vicinity),
        pass_radius: parameters.length("pass_radius", default.pass_radius),
        off_path: parameters.length("off_path", default.off_path),
        stuck_after: parameters.duration("stuck_after", default.stuck_after),
        least_progress: parameters.length("least_progress", default.least_progress),
        most_replans: parameters.count("most_replans", default.most_replans),
        most_plan_failures: parameters.count("most_plan_failures", default.most_plan_failures),
        plan_pause: parameters.duration("plan_pause", default.plan_pause),
        planner: parameters.choice("planner", default.planner, &PLANNERS),
        most_nodes: parameters.count("most_nodes", default.most_nodes),
        ..default
    }
}

fn reliable_options(parameters: &mut Parameters<'_>) -> reliable::Options {
    let default = reliable::Options::default();
    reliable::Options {
        first_timeout: parameters.duration("first_timeout", default.first_timeout),
        longest_timeout: parameters.duration("longest_timeout", default.longest_timeout),
        jitter: parameters.fraction("timeout_jitter", default.jitter),
        retries: parameters.count("retries", default.retries),
        first_in_first_out: parameters.flag("first_in_first_out", default.first_in_first_out),
        most_outstanding: parameters.count("most_outstanding", default.most_outstanding),
        window: parameters.count("window", default.window),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use starl_sim::scenario::{Clock, Parameter, SensorSuite};

    fn group(program: &str, parameters: &[(&str, Parameter)]) -> Group {
        let named = |(name, value): &(&str, Parameter)| ((*name).to_string(), value.clone());
        Group {
            name: "create".to_string(),
            numbered: true,
            first_number: 0,
            model: starl_motion::models::by_name("create").expect("there is this model"),
            program: program.to_string(),
            parameters: parameters.iter().map(named).collect(),
            starts: Vec::new(),
            control_period: starl_core::Duration::from_millis(100),
            sensors: SensorSuite::default(),
            clock: Clock::default(),
        }
    }

    fn make(group: &Group) -> Result<Box<dyn Program>, Complaint> {
        Registry::default().make(group)
    }

    #[test]
    fn every_program_can_be_made_from_its_defaults() {
        for entry in Registry::default().entries() {
            assert!(make(&group(&entry.name, &[])).is_ok(), "{entry:?}");
        }
    }

    #[test]
    fn an_unknown_parameter_is_answered_with_those_there_are() {
        let complaint = make(&group("race", &[("vicinty", Parameter::Float(0.1))])).err();
        let complaint = complaint.expect("there is no such parameter");
        assert_eq!(complaint.field, "parameters.vicinty");
        assert!(
            complaint.help.contains("vicinity, pass_radius"),
            "{}",
            complaint.help
        );
    }

    #[test]
    fn a_parameter_of_the_wrong_kind_is_refused() {
        let wrong = [
            ("vicinity", Parameter::Float(-0.1)),
            ("vicinity", Parameter::Text("near".to_string())),
            ("retries", Parameter::Int(-1)),
            ("planner", Parameter::Text("dijkstra".to_string())),
            ("first_in_first_out", Parameter::Int(1)),
            ("stuck_after", Parameter::Float(4.0)),
        ];
        for (name, value) in wrong {
            let complaint = make(&group("race", &[(name, value.clone())])).err();
            let complaint = complaint.unwrap_or_else(|| panic!("{name} took {value:?}"));
            assert_eq!(complaint.field, format!("parameters.{name}"));
        }
    }
}
