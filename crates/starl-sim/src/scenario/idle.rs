//! Fields that are set and cannot have their effect, because of what another field is.

use super::{FaultRates, Link, Motion, Scenario, Storage, Wind};
use starl_core::{Intervention, Point};

impl Scenario {
    /// Fields that do not have their effect as the scenario stands: their paths, and the reason with a suggested fix.
    pub fn idle_fields(&self) -> Vec<(&'static str, String)> {
        let step = self.physics.step;
        let is_changed =
            |event: &super::ScenarioEvent| matches!(event.what, Intervention::Network(_));
        let flies = |group: &super::Group| group.model.body().flies();
        let mut found = self.idle_faults();
        let mut idle = |is_idle: bool, field, reason: String| {
            if is_idle {
                found.push((field, reason));
            }
        };
        let (network, wind) = (&self.network, Wind::default());
        let others = network.overrides.iter().map(|different| &different.link);
        let links = others.chain([&network.link]);
        if !self.events.iter().any(is_changed) {
            let queue = super::Network::default().queue;
            let is_idle = network.queue != queue && network.bandwidth.is_none();
            idle(is_idle, "network.queue", needs("network.bandwidth"));
            let is_held_back = links.clone().any(|link| link.reordering > 0.0);
            let is_set = network.link.reordering_delay != Link::default().reordering_delay;
            let field = "network.reordering_delay";
            idle(is_set && !is_held_back, field, needs("network.reordering"));
        }
        let slot = network.resolution.min(step);
        let mut delays = links.map(|link| link.delay);
        // Zero means as soon as possible. A warning would name no fix, since every slot takes some time.
        if let Some(delay) = delays.find(|delay| !delay.is_zero() && *delay < slot) {
            let reason = format!(
                "{delay} is shorter than a slot, so datagrams take up to {slot}; lower `network.resolution`"
            );
            idle(true, "network.delay", reason);
        }
        let reason = format!(
            "slots are not longer than `physics.step`, {step}; lower it, or raise the step"
        );
        let is_set = network.resolution != super::Network::default().resolution;
        idle(
            is_set && network.resolution > step,
            "network.resolution",
            reason,
        );
        let reason = format!("poses are recorded once in a `physics.step`, {step}; lower the step");
        let period = self.trace.pose_period;
        let is_set = period != super::Trace::default().pose_period;
        idle(is_set && period < step, "trace.pose_period", reason);
        let is_calm = self.wind.steady == Point::ZERO && self.wind.gust == Point::ZERO;
        let reason =
            "no robot of the fleet flies, and robots on the ground do not feel wind".into();
        idle(
            !is_calm && !self.fleet.groups.iter().any(flies),
            "wind",
            reason,
        );
        let is_set = self.wind.gust_period != wind.gust_period;
        let is_idle = is_set && self.wind.gust == Point::ZERO;
        idle(is_idle, "wind.gust_period", needs("wind.gust"));
        let Motion {
            speed_noise,
            turn_noise,
            noise_period,
            ..
        } = self.motion;
        let is_exact = speed_noise == 0.0 && turn_noise == 0.0;
        let is_set = noise_period != Motion::default().noise_period;
        let reason = needs("motion.speed_noise` or `motion.turn_noise");
        idle(is_set && is_exact, "motion.noise_period", reason);
        let Storage {
            kept,
            write_time,
            loss,
        } = self.storage;
        let is_set = write_time != Storage::default().write_time && !write_time.is_zero();
        idle(is_set && !kept, "storage.write_time", needs("storage.kept"));
        idle(loss > 0.0 && !kept, "storage.loss", needs("storage.kept"));
        found
    }

    fn idle_faults(&self) -> Vec<(&'static str, String)> {
        let (rates, default) = (&self.faults.rates, FaultRates::default());
        let impair = rates.stuck_motor.max(rates.frozen_sensor);
        let ends = [
            (
                "fault_rates.restart_after",
                rates.restart_after != default.restart_after,
                rates.crash,
                "crash",
            ),
            (
                "fault_rates.heal_after",
                rates.heal_after != default.heal_after,
                rates.partition,
                "partition",
            ),
            (
                "fault_rates.repair_after",
                rates.repair_after != default.repair_after,
                impair,
                "stuck_motor",
            ),
        ];
        let idle = ends
            .into_iter()
            .filter(|(_, is_set, rate, _)| *is_set && *rate == 0.0);
        idle.map(|(field, _, _, rate)| (field, needs(&format!("fault_rates.{rate}"))))
            .collect()
    }
}

/// The reason of a field that needs another one.
fn needs(field: &str) -> String {
    format!("it has no effect without `{field}`; set that too, or leave this out")
}
