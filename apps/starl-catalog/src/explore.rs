//! A scenario for an explorer: its robots, which stand still at their starts, with its programs and
//! properties. Its motion, network and faults are ignored: the exploration's bounds define the possible
//! faults.

use crate::Application;
use starl_core::Duration;
use starl_core::motion::Obstacles;
use starl_explore::{Bounds, Clocks, Member, Model, Setup};
use starl_properties::Setting;
use starl_sim::engine::StartError;
use starl_sim::scenario::{self, Goal, Scenario};

/// A bound that never runs out: nothing is too late in an exploration.
const FOREVER: Duration = Duration::from_seconds(100 * 365 * 24 * 3600);

impl Application {
    /// An exploration of the first `robots` of the fleet. With `heartbeats` failure detectors send them, which adds
    /// many states; without, their verdicts change only within the bounds.
    ///
    /// # Errors
    /// As for [`Application::run`].
    pub fn exploration(
        &self,
        robots: usize,
        bounds: Bounds,
        heartbeats: bool,
    ) -> Result<Setup, StartError> {
        let scenario = self.scenario();
        let mut members = Vec::new();
        for (index, group) in scenario.fleet.groups.iter().enumerate() {
            let program = self.program(group).map_err(|complaint| StartError {
                group: index,
                complaint,
            })?;
            members.extend(group.starts.iter().map(|&pose| Member {
                program: program.clone(),
                pose,
                body: group.model.body(),
            }));
        }
        members.truncate(robots);
        // Checkers that never find anything too late.
        let setting = Setting {
            bodies: members.iter().map(|member| member.body).collect(),
            properties: scenario.properties.without_bounds(FOREVER),
            ..starl_sim::setting(scenario)
        };
        let invariants = match scenario.properties.program {
            true => self.programs.invariants(scenario, members.len()),
            false => Vec::new(),
        };
        Ok(Setup {
            model: Model {
                members,
                way_points: scenario.world.way_points.clone(),
                obstacles: known(scenario),
                seed: scenario.seed,
                silent: match heartbeats {
                    true => Default::default(),
                    false => self.programs.detectors(),
                },
                keeps_storage: scenario.storage.kept,
                // Without time, a robot that waits for time does not finish.
                all_finish: scenario.goal == Goal::AllFinished
                    && (bounds.clocks != Clocks::Still || !self.programs.wait_for_time()),
            },
            bounds,
            checkers: starl_properties::checkers(&setting),
            invariants,
        })
    }

    /// The programs' properties that an exploration does not judge, because they are about more than single states.
    pub fn unexplored_properties(&self) -> Vec<String> {
        let scenario = self.scenario();
        match scenario.properties.program {
            true => self.programs.properties_of_paths(scenario),
            false => Vec::new(),
        }
    }
}

/// The obstacles that robots know from the start.
fn known(scenario: &Scenario) -> Obstacles {
    let listed = scenario.world.obstacles.iter();
    let listed = listed.filter(|entry| !entry.hidden);
    let walls = scenario
        .world
        .bounds
        .iter()
        .flat_map(scenario::Bounds::walls);
    let listed = listed.map(|entry| entry.obstacle.clone());
    listed.chain(walls).collect()
}
