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
                dependency.stamp.time = Time(random.magnitude());
                dependency.stamp.count = random.bits();
                if random.chance(0.5) {
                    dependency.key = random.word();
                }
            }
            element.mine = random.chance(0.5);
            element.touched = Time(random.magnitude());
        }
        self.clock = clock(random);
        *self.store.fingerprint_mut() = random.word();
        self.changed = Time(random.magnitude());
        self.unsent = (0..random.below(4)).map(|_| random.word()).collect();
        self.repairs = (0..random.below(4)).map(|_| random.word()).collect();
        self.repair_due = random.chance(0.5).then(|| Time(random.magnitude()));
        self.gossip.interval = Duration(random.word());
        self.gossip.begun = random.chance(0.5);
        self.gossip.vain = random.bits();
        self.gossip.equal = random.bits();
        self.gossip.unasked = random.bits() as u8;
        self.gossip.next = random.word();
        self.gossip.differing = random.chance(0.5).then(|| RobotId(random.bits()));
    }
}

fn clock(random: &mut Random) -> HybridClock {
    HybridClock {
        time: Time(random.magnitude()),
        count: random.bits(),
    }
}
