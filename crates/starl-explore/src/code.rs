//! Steps in one word each, since a search keeps one for every state.

use starl_core::RobotId;

/// A step in one word: what happens in the upper four bits, to what in the others.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Code(pub u32);

/// The event.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub(crate) enum Kind {
    Activate,
    Timer,
    Deliver,
    Duplicate,
    Lose,
    Crash,
    Restart,
    RestartDeaf,
    Suspect,
    Trust,
    Tick,
    TickAll,
}

const KINDS: [Kind; 12] = [
    Kind::Activate,
    Kind::Timer,
    Kind::Deliver,
    Kind::Duplicate,
    Kind::Lose,
    Kind::Crash,
    Kind::Restart,
    Kind::RestartDeaf,
    Kind::Suspect,
    Kind::Trust,
    Kind::Tick,
    Kind::TickAll,
];

const SHIFT: u32 = 28;

/// A datagram on its way in one word: for how many ticks it has been, and its number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Flying(pub u32);

/// The greatest age that is distinguished.
pub(crate) const OLDEST: u8 = 15;

impl Flying {
    /// One that was just sent.
    pub fn new(number: u32) -> Flying {
        Flying(number)
    }

    /// One that has been on its way for some ticks.
    pub fn aged(number: u32, age: u8) -> Flying {
        Flying(u32::from(age.min(OLDEST)) << SHIFT | number)
    }

    /// The datagram's number.
    pub fn number(self) -> u32 {
        self.0 & ((1 << SHIFT) - 1)
    }

    /// The same a tick later; none if it has been under way for longer than that.
    pub fn age(self, delay: u8) -> Option<Flying> {
        let age = (self.0 >> SHIFT) + 1;
        (age <= u32::from(delay.min(OLDEST))).then(|| Flying(age << SHIFT | self.number()))
    }
}

/// More kinds of datagrams than this have no numbers.
pub(crate) const MOST_DATAGRAMS: usize = 1 << SHIFT;

/// More robots than this have no numbers here.
pub(crate) const MOST_ROBOTS: usize = 1 << 8;

impl Code {
    /// Something that happens to the datagram with this number.
    pub fn datagram(kind: Kind, number: u32) -> Code {
        Code((kind as u32) << SHIFT | number)
    }

    /// Something that happens to a robot; which of its timers or peers is given where that matters.
    pub fn robot(kind: Kind, robot: RobotId, which: u32) -> Code {
        Code((kind as u32) << SHIFT | which << 8 | robot.0)
    }

    pub fn kind(self) -> Kind {
        KINDS[(self.0 >> SHIFT) as usize % KINDS.len()]
    }

    /// The datagram's number.
    pub fn number(self) -> u32 {
        self.0 & ((1 << SHIFT) - 1)
    }

    /// Which timer or peer.
    pub fn which(self) -> u32 {
        self.number() >> 8
    }

    /// The robot to which it happens; none where it happens to a datagram or to all.
    pub fn of_robot(self) -> Option<RobotId> {
        match self.kind() {
            Kind::Deliver | Kind::Duplicate | Kind::Lose | Kind::TickAll => None,
            _ => Some(RobotId(self.0 & 0xff)),
        }
    }
}
