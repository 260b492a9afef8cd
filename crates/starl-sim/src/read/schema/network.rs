//! The fields of `network`.

use super::*;

const DELAY: Field = field("delay", TIME, Default::Value("15ms"), "Mean delay.");
const JITTER: Field = field(
    "jitter",
    TIME,
    Default::Value("5ms"),
    "Standard deviation of the delay.",
);
const DISTRIBUTION: Field = field(
    "distribution",
    Kind::Choice(&["constant", "uniform", "normal", "exponential"]),
    Default::Value("normal"),
    "The distribution of delays: always the mean; even over the mean plus and minus the square root of three times the jitter; normal, cut off at zero; or the mean minus the jitter, plus an exponential part whose mean is the jitter.",
);
const LOSS: Field = field(
    "loss",
    Kind::Probability,
    Default::Value("0"),
    "A datagram is lost.",
);
const DUPLICATION: Field = field(
    "duplication",
    Kind::Probability,
    Default::Value("0"),
    "It arrives twice, the second after a delay of its own.",
);
const REORDERING: Field = field(
    "reordering",
    Kind::Probability,
    Default::Value("0"),
    "It is held back, so that later ones overtake it.",
);
const REORDERING_DELAY: Field = field(
    "reordering_delay",
    TIME,
    Default::Value("50ms"),
    "The time for which it is held back, in addition to its delay.",
);

/// How messages travel.
pub(super) const NETWORK: &[Field] = &join::<{ KNOBS.len() + 2 }>(&[
    KNOBS,
    &[field(
        "resolution",
        PERIOD,
        Default::Value("1ms"),
        "Datagrams arrive at their exact times, but at the soonest in the slot of this length after the one in which \
         they were sent.",
    )],
    &[tables(
        "link",
        LINK,
        "Links that differ from the rest; the last that matches counts.",
    )],
]);

/// Fields that can also be changed during a run.
const KNOBS: &[Field] = &[
    DELAY,
    JITTER,
    DISTRIBUTION,
    LOSS,
    DUPLICATION,
    REORDERING,
    REORDERING_DELAY,
    field(
        "range",
        SIZE,
        Default::Word("everywhere"),
        "Radio range between robots' centres.",
    ),
    field(
        "line_of_sight",
        Kind::Flag,
        Default::Value("false"),
        "Obstacles and other robots' bodies block the radio.",
    ),
    field(
        "bandwidth",
        Kind::Quantity(Dimension::BitRate, Range::Positive),
        Default::Word("unlimited"),
        "The send rate of each robot; datagrams queue.",
    ),
    field(
        "queue",
        TIME,
        Default::Value("1s"),
        "The longest wait of a datagram in the sender's queue before it is dropped.",
    ),
    field(
        "largest",
        Kind::Count(1, 1 << 30),
        Default::Value("65507"),
        "Largest datagram in bytes; larger ones are dropped, and the trace records this.",
    ),
];

/// The same in an event, in which omitted fields do not change.
pub(super) const CHANGES: &[Field] = &{
    let mut fields = join::<{ KNOBS.len() }>(&[KNOBS]);
    let mut index = 0;
    while index < fields.len() {
        fields[index].default = Default::Kept(match fields[index].default {
            Default::Word(word) => Some(word),
            _ => None,
        });
        index += 1;
    }
    fields
};

const fn inherited(field: Field) -> Field {
    Field {
        default: Default::Depends("the network's"),
        ..field
    }
}

const LINK: &[Field] = &[
    field("from", Kind::Robots, Default::Word("all"), "Senders."),
    field("to", Kind::Robots, Default::Word("all"), "Receivers."),
    inherited(DELAY),
    inherited(JITTER),
    inherited(DISTRIBUTION),
    inherited(LOSS),
    inherited(DUPLICATION),
    inherited(REORDERING),
    inherited(REORDERING_DELAY),
];
