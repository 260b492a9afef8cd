//! The numbers of a row that can be averaged, compared and plotted.

use crate::{Error, Row};
use starl_sim::read::suggest;

/// A number of a row.
#[derive(Clone, Copy)]
pub struct Metric {
    /// Its name, a column of tables.
    pub name: &'static str,
    /// Its name for axes, with the unit.
    pub label: &'static str,
    /// Whether it is whole.
    pub is_whole: bool,
    of: fn(&Row) -> Option<f64>,
}

impl std::fmt::Debug for Metric {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.name)
    }
}

/// A metric that every run has and that is whole.
macro_rules! whole {
    ($field:ident, $label:literal) => {
        Metric {
            name: stringify!($field),
            label: $label,
            is_whole: true,
            of: |row| Some(row.$field as f64),
        }
    };
}

/// All metrics, in the order of tables.
pub const METRICS: &[Metric] = &[
    Metric {
        name: "sim_seconds",
        label: "simulated time in s",
        is_whole: false,
        of: |row| Some(row.sim_seconds),
    },
    Metric {
        name: "time_to_goal_seconds",
        label: "time to goal in s",
        is_whole: false,
        of: |row| row.time_to_goal_seconds,
    },
    whole!(robots, "robots"),
    whole!(robots_finished, "robots that finished"),
    whole!(robots_failed, "robots that failed"),
    whole!(violations, "violations"),
    whole!(messages_sent, "messages sent"),
    whole!(messages_delivered, "messages delivered"),
    whole!(messages_lost, "messages lost"),
    whole!(messages_dropped, "messages dropped"),
    whole!(messages_retransmitted, "messages retransmitted"),
    whole!(bytes_sent, "bytes sent"),
    whole!(collisions, "collisions"),
    Metric {
        name: "distance_m",
        label: "distance covered by all robots in m",
        is_whole: false,
        of: |row| Some(row.distance_m),
    },
    whole!(way_points, "waypoints reached"),
    whole!(replans, "replans"),
    whole!(gave_up, "targets given up"),
];

impl Metric {
    /// The metric of this name.
    ///
    /// # Errors
    /// There is no such metric; the message has the nearest name.
    pub fn by_name(name: &str) -> Result<&'static Metric, Error> {
        let found = METRICS.iter().find(|metric| metric.name == name);
        found.ok_or_else(|| {
            let names: Vec<&str> = METRICS.iter().map(|metric| metric.name).collect();
            let help = suggest::nearest(name, names.iter().copied());
            let help = match help {
                Some(name) => format!("did you mean `{name}`?"),
                None => format!("there are: goal, {}", names.join(", ")),
            };
            Error::option(
                &format!("--metric {name}"),
                "there is no such metric",
                &help,
            )
        })
    }

    /// Its value; none where a run has none.
    pub fn of(&self, row: &Row) -> Option<f64> {
        (self.of)(row)
    }
}
