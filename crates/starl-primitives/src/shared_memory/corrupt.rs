//! Overwriting a memory at random, as a transient fault would.

use super::SharedMemory;
use super::stamp::HybridClock;
use starl_core::{Duration, Payload, Random, RobotId, Time};

/// Corrupted values are up to this long, bytes.
const LONGEST_VALUE: u32 = 40;

impl SharedMemory {
    /// Overwrites the memory's state at random, within its types: for a program's [`starl_core::Program::corrupt`]. The
    /// names of variables do not change, because they are part of the program.
    pub fn corrupt(&mut self, random: &mut Random) {
        for element in self.store.all_mut() {
            if random.chance(0.5) {
                continue;
            }
            let clock = clock(random);
            element.stamp.time = clock.time;
            element.stamp.count = clock.count;
            if random.chance(0.5) {
                element.stamp.writer = RobotId(random.bits());
                element.stamp.incarnation = random.bits();
            }
            let length = random.below(LONGEST_VALUE);
            element.value = (0..length)
                .map(|_| random.bits() as u8)
                .collect::<Payload>();
            for dependency in element.depends.iter_mut().flatten() {
                dependency.stamp.time = time(random);
                dependency.stamp.count = random.bits();
                if random.chance(0.5) {
                    dependency.key = word(random);
                }
            }
            element.mine = random.chance(0.5);
            element.touched = time(random);
        }
        self.clock = clock(random);
        *self.store.fingerprint_mut() = word(random);
        self.changed = time(random);
        self.unsent = (0..random.below(4)).map(|_| word(random)).collect();
        self.repairs = (0..random.below(4)).map(|_| word(random)).collect();
        self.repair_due = random.chance(0.5).then(|| time(random));
        self.gossip.interval = Duration(word(random));
        self.gossip.begun = random.chance(0.5);
        self.gossip.vain = random.bits();
        self.gossip.equal = random.bits();
        self.gossip.differing = random.chance(0.5).then(|| RobotId(random.bits()));
    }
}

fn clock(random: &mut Random) -> HybridClock {
    HybridClock {
        time: time(random),
        count: random.bits(),
    }
}

/// A moment of any order of magnitude.
fn time(random: &mut Random) -> Time {
    Time(word(random) >> random.below(64))
}

fn word(random: &mut Random) -> u64 {
    u64::from(random.bits()) << 32 | u64::from(random.bits())
}
