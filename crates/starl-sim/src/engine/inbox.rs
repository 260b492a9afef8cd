//! Messages in transit: a calendar of the time slots in which they will arrive, and the sorted inboxes of the current
//! slot.
//!
//! Invariant: a robot receives messages ordered by (time, sender, sequence number), whatever the
//! order in which they were posted.

use starl_core::{Payload, Port, RobotId, Time};
use std::collections::BTreeMap;

/// A datagram's content, held once for all its receivers of one slot.
#[derive(Clone, Debug)]
pub struct Transmission {
    pub from: RobotId,
    pub sequence: u32,
    pub port: Port,
    pub payload: Payload,
}

/// One arrival.
#[derive(Clone, Copy, Debug)]
pub struct Delivery {
    pub at: Time,
    pub to: u32,
    /// Index among the transmissions of the same slot.
    pub transmission: u32,
}

/// The arrivals of one slot.
#[derive(Clone, Debug, Default)]
struct Page {
    transmissions: Vec<Transmission>,
    deliveries: Vec<Delivery>,
}

/// Arrivals of coming slots, by number.
#[derive(Clone, Debug, Default)]
pub struct Calendar {
    pages: BTreeMap<u64, Page>,
    /// Emptied pages, whose memory is used again.
    spare: Vec<Page>,
}

impl Calendar {
    /// Notes a transmission that arrives somewhere in a slot.
    pub fn add_transmission(&mut self, slot: u64, transmission: Transmission) -> u32 {
        let spare = &mut self.spare;
        let fresh = || spare.pop().unwrap_or_default();
        let page = self.pages.entry(slot).or_insert_with(fresh);
        page.transmissions.push(transmission);
        page.transmissions.len() as u32 - 1
    }

    /// Notes an arrival of a transmission of the same slot.
    pub fn add_delivery(&mut self, slot: u64, delivery: Delivery) {
        if let Some(page) = self.pages.get_mut(&slot) {
            page.deliveries.push(delivery);
        }
    }

    /// The next slot in which anything arrives.
    pub fn next(&self) -> Option<u64> {
        self.pages.first_key_value().map(|(&slot, _)| slot)
    }

    /// The datagrams on their way to a robot with their times of arrival, in the order in which they will
    /// arrive. Takes time in proportion to all datagrams under way.
    pub fn mail(&self, robot: RobotId) -> Vec<(Time, &Transmission)> {
        let mut mail = Vec::new();
        for page in self.pages.values() {
            let mine = page.deliveries.iter();
            let mine = mine.filter(|delivery| delivery.to as usize == robot.index());
            mail.extend(mine.map(|delivery| {
                let transmission = &page.transmissions[delivery.transmission as usize];
                (delivery.at, transmission)
            }));
        }
        mail.sort_by_key(|(at, content)| (*at, content.from, content.sequence));
        mail
    }

    /// Sorts the arrivals before the slot `end` and the time `until` into `inboxes`.
    pub fn turn(&mut self, robots: usize, (end, until): (u64, Time), inboxes: &mut Inboxes) {
        inboxes.starts.clear();
        inboxes.arrivals.clear();
        let mut later = Vec::new();
        while let Some(first) = self.pages.first_entry()
            && *first.key() < end
        {
            let slot = *first.key();
            let mut page = first.remove();
            for delivery in page
                .deliveries
                .extract_if(.., |delivery| delivery.at >= until)
            {
                let content = &page.transmissions[delivery.transmission as usize];
                later.push((slot, delivery, content.clone()));
            }
            inboxes.take(&mut page);
            self.spare.push(page);
        }
        for (slot, delivery, content) in later {
            let transmission = self.add_transmission(slot, content);
            let delivery = Delivery {
                transmission,
                ..delivery
            };
            self.add_delivery(slot, delivery);
        }
        inboxes.sort(robots);
    }
}

/// The arrivals of the present slot, by receiver.
#[derive(Clone, Debug, Default)]
pub struct Inboxes {
    starts: Vec<u32>,
    deliveries: Vec<Delivery>,
    /// The same in the order in which they were posted.
    arrivals: Vec<Delivery>,
    /// All transmissions of the step so far.
    transmissions: Vec<Transmission>,
}

impl Inboxes {
    /// Forgets the transmissions of the step before.
    pub fn begin_step(&mut self) {
        self.starts.clear();
        self.arrivals.clear();
        self.transmissions.clear();
    }

    /// Empties a page.
    fn take(&mut self, page: &mut Page) {
        let before = self.transmissions.len() as u32;
        self.transmissions.append(&mut page.transmissions);
        let arrivals = page.deliveries.drain(..).map(|delivery| Delivery {
            transmission: before + delivery.transmission,
            ..delivery
        });
        self.arrivals.extend(arrivals);
    }

    /// A counting sort by receiver.
    fn sort(&mut self, robots: usize) {
        let Some(&first) = self.arrivals.first() else {
            return;
        };
        self.starts.resize(robots + 2, 0);
        for delivery in &self.arrivals {
            self.starts[delivery.to as usize + 2] += 1;
        }
        for robot in 1..self.starts.len() {
            self.starts[robot] += self.starts[robot - 1];
        }
        self.deliveries.resize(self.arrivals.len(), first);
        for delivery in &self.arrivals {
            let next = &mut self.starts[delivery.to as usize + 1];
            self.deliveries[*next as usize] = *delivery;
            *next += 1;
        }
    }

    /// The arrivals of this slot.
    pub fn arrivals(&self) -> &[Delivery] {
        &self.arrivals
    }

    /// The arrivals at a robot in this slot, by time, sender and sequence number.
    pub fn of(&self, robot: RobotId, sorted: &mut Vec<Delivery>) {
        sorted.clear();
        if self.starts.is_empty() {
            return;
        }
        let range = self.starts[robot.index()] as usize..self.starts[robot.index() + 1] as usize;
        sorted.extend_from_slice(&self.deliveries[range]);
        let key = |delivery: &Delivery| {
            let transmission = self.transmission(delivery);
            (delivery.at, transmission.from, transmission.sequence)
        };
        if !sorted.is_sorted_by_key(key) {
            sorted.sort_unstable_by_key(key);
        }
    }

    /// The arrivals in the present step of the datagram that `from` sent under this number.
    pub fn find(&self, from: RobotId, sequence: u32) -> Option<&Transmission> {
        let mut all = self.transmissions.iter();
        all.find(|content| content.from == from && content.sequence == sequence)
    }

    /// The content of an arrival.
    pub fn transmission(&self, delivery: &Delivery) -> &Transmission {
        &self.transmissions[delivery.transmission as usize]
    }
}
