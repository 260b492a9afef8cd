//! How messages travel.

use crate::fields::schema::{Dimension, Field, Kind, PERIOD, Range, SIZE, TIME};
use crate::fields::section::Section;
use crate::fields::tree::Node;
use crate::fields::value::{self, Complaint};
use crate::fields::written::{Table, text};
use crate::fields::{FieldTable, FieldValue, field_table, read_written};
use starl_core::intervention::{DelayDistribution, NetworkKnob};
use starl_core::{Duration, RobotId};

field_table! {
    /// The simulated network. A datagram is sent once; every robot it could reach receives it, or not,
    /// on its own account.
    pub struct Network {
        /// Radio range between robots' centres.
        range: Option<f64> = SIZE, Word("everywhere");
        /// Obstacles and other robots' bodies block the radio.
        line_of_sight: bool = Kind::Flag, Value("false");
        /// The send rate of each robot; datagrams queue.
        bandwidth: Option<f64> = Kind::Quantity(Dimension::BitRate, Range::Positive), Word("unlimited");
        /// The longest wait of a datagram in the sender's queue before it is dropped.
        queue: Duration = TIME, Value("1s");
        /// Largest datagram in bytes; larger ones are dropped, and the trace records this.
        largest: u32 = Kind::Count(1, 1 << 30), Value("65507");
        /// Datagrams arrive at their exact times, but at the soonest in the slot of this length after the one in which
        /// they were sent.
        resolution: Duration = PERIOD, Value("1ms");
    }
    besides {
        /// The default for links.
        pub link: Link,
        /// Links that differ from the rest; the last that matches counts.
        pub overrides: Vec<LinkOverride>,
    }
}

field_table! {
    /// The properties of a link.
    #[derive(Copy)]
    pub struct Link {
        /// Mean delay.
        delay: Duration = TIME, Value("15ms");
        /// Standard deviation of the delay.
        jitter: Duration = TIME, Value("5ms");
        /// The distribution of delays: always the mean; even over the mean plus and minus the square root of three times
        /// the jitter; normal, cut off at zero; or the mean minus the jitter, plus an exponential part whose mean is the
        /// jitter.
        distribution: DelayDistribution = Kind::Choice(&DISTRIBUTIONS), Value("normal");
        /// A datagram is lost.
        loss: f64 = Kind::Probability, Value("0");
        /// It arrives twice, the second after a delay of its own.
        duplication: f64 = Kind::Probability, Value("0");
        /// It is held back, so that later ones overtake it.
        reordering: f64 = Kind::Probability, Value("0");
        /// The time for which it is held back, in addition to its delay.
        reordering_delay: Duration = TIME, Value("50ms");
    }
}

/// The words for the distributions of delays.
const DISTRIBUTIONS: [&str; 4] = ["constant", "uniform", "normal", "exponential"];

impl FieldValue for DelayDistribution {
    fn parse(node: &Node, _: &Kind) -> Result<DelayDistribution, Complaint> {
        Ok(match value::choice(node, &DISTRIBUTIONS)?.as_str() {
            "constant" => DelayDistribution::Constant,
            "uniform" => DelayDistribution::Uniform,
            "exponential" => DelayDistribution::Exponential,
            _ => DelayDistribution::Normal,
        })
    }

    fn show(&self, _: &Field) -> String {
        text(match self {
            DelayDistribution::Constant => "constant",
            DelayDistribution::Uniform => "uniform",
            DelayDistribution::Normal => "normal",
            DelayDistribution::Exponential => "exponential",
        })
    }
}

/// A set of links that differ from the rest.
#[derive(Clone, Debug, PartialEq)]
pub struct LinkOverride {
    /// Senders; none: all.
    pub from: Option<Vec<RobotId>>,
    /// Receivers; none: all.
    pub to: Option<Vec<RobotId>>,
    /// The properties of these links.
    pub link: Link,
}

/// Parts of a link's delay that do not go together, and what to do about it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Contradiction {
    pub message: String,
    pub help: &'static str,
}

impl Link {
    /// Whether the distribution would reach below zero, or leave a jitter that is given without effect.
    pub(crate) fn contradiction(&self, sets_jitter: bool) -> Option<Contradiction> {
        let (delay, jitter) = (self.delay, self.jitter);
        let (message, help) = match self.distribution {
            DelayDistribution::Constant if sets_jitter && jitter > Duration::ZERO => (
                "a constant delay has no jitter".to_string(),
                "leave it out, or choose another distribution",
            ),
            DelayDistribution::Uniform if jitter.seconds() * 3.0_f64.sqrt() > delay.seconds() => (
                format!(
                    "a delay of {delay} cannot vary evenly with a jitter of {jitter}: it would be \
                     negative at times"
                ),
                "make the jitter at most 0.57 of the delay, or choose another distribution",
            ),
            DelayDistribution::Exponential if jitter > delay => (
                format!("an exponential delay of {delay} cannot have the greater jitter {jitter}"),
                "make the jitter at most the delay, or choose another distribution",
            ),
            _ => return None,
        };
        Some(Contradiction { message, help })
    }
}

impl Network {
    /// The properties of the link between two robots.
    pub fn link(&self, from: RobotId, to: RobotId) -> &Link {
        let names = |set: &Option<Vec<RobotId>>, robot| {
            set.as_ref().is_none_or(|robots| robots.contains(&robot))
        };
        self.overrides
            .iter()
            .rev()
            .find(|link| names(&link.from, from) && names(&link.to, to))
            .map_or(&self.link, |link| &link.link)
    }
}

/// Declares which field of the network each knob changes.
macro_rules! knobs {
    ($($knob:ident: $field:ident $(of $table:ident)?,)+) => {
        impl Network {
            /// Turns one knob.
            pub fn turn(&mut self, knob: NetworkKnob) {
                match knob {
                    $(NetworkKnob::$knob(value) => self.$($table.)?$field = value,)+
                }
            }

            /// The positions of all knobs.
            pub fn knobs(&self) -> Vec<NetworkKnob> {
                vec![$(NetworkKnob::$knob(self.$($table.)?$field),)+]
            }

            /// The changes of the network that are written in a table.
            pub(crate) fn read_knobs(section: Section<'_>) -> Vec<NetworkKnob> {
                let mut knobs = Vec::new();
                $(knobs.extend(read_written(section, stringify!($field)).map(NetworkKnob::$knob));)+
                knobs
            }

            /// Writes a change of the network.
            pub(crate) fn write_knob(table: &mut Table, knob: NetworkKnob) {
                let field = |name: &str| {
                    let mut fields = Link::FIELDS.iter().chain(Network::FIELDS);
                    fields.find(|field| field.name == name)
                };
                match knob {
                    $(NetworkKnob::$knob(value) => {
                        if let Some(field) = field(stringify!($field)) {
                            table.set(field.name, value.show(field));
                        }
                    })+
                }
            }
        }
    };
}

knobs! {
    Delay: delay of link,
    Jitter: jitter of link,
    Distribution: distribution of link,
    Loss: loss of link,
    Duplication: duplication of link,
    Reordering: reordering of link,
    ReorderingDelay: reordering_delay of link,
    Range: range,
    LineOfSight: line_of_sight,
    Bandwidth: bandwidth,
    Queue: queue,
    Largest: largest,
}
