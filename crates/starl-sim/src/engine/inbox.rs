//! Messages on their way: a calendar of the steps in which they will arrive, and the sorted inboxes
//! of the present step.
//!
//! Invariant: a robot receives messages ordered by (time, sender, sequence number), whatever the
//! order in which they were posted.

use starl_core::{Payload, Port, RobotId, Time};
use std::collections::VecDeque;

/// A datagram's content, held once for all its receivers of one step.
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
    /// Index among the transmissions of the same step.
    pub transmission: u32,
}

/// The arrivals of one step.
#[derive(Clone, Debug, Default)]
struct Page {
    transmissions: Vec<Transmission>,
    deliveries: Vec<Delivery>,
}

/// Arrivals of coming steps.
#[derive(Clone, Debug, Default)]
pub struct Calendar {
    pages: VecDeque<Page>,
    /// An emptied page, whose memory is used again.
    spare: Page,
}

impl Calendar {
    /// Notes a transmission that arrives somewhere `steps` steps after the present one.
    pub fn add_transmission(&mut self, steps: usize, transmission: Transmission) -> u32 {
        while self.pages.len() <= steps {
            self.pages.push_back(std::mem::take(&mut self.spare));
        }
        let page = &mut self.pages[steps];
        page.transmissions.push(transmission);
        page.transmissions.len() as u32 - 1
    }

    /// Notes an arrival of a transmission of the same step.
    pub fn add_delivery(&mut self, steps: usize, delivery: Delivery) {
        self.pages[steps].deliveries.push(delivery);
    }

    /// The datagrams on their way to a robot with their times of arrival, in the order in which they will
    /// arrive. Takes time in proportion to all datagrams under way.
    pub fn mail(&self, robot: RobotId) -> Vec<(Time, &Transmission)> {
        let mut mail = Vec::new();
        for page in &self.pages {
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

    /// Sorts the arrivals of the coming step into `inboxes`, and makes it the present one.
    pub fn turn(&mut self, robots: usize, inboxes: &mut Inboxes) {
        let mut page = self.pages.pop_front().unwrap_or_default();
        inboxes.fill(robots, &mut page);
        page.transmissions.clear();
        page.deliveries.clear();
        self.spare = page;
    }
}

/// The arrivals of the present step, by receiver.
#[derive(Clone, Debug, Default)]
pub struct Inboxes {
    starts: Vec<u32>,
    deliveries: Vec<Delivery>,
    transmissions: Vec<Transmission>,
}

impl Inboxes {
    /// A counting sort by receiver.
    fn fill(&mut self, robots: usize, page: &mut Page) {
        std::mem::swap(&mut self.transmissions, &mut page.transmissions);
        self.starts.clear();
        self.deliveries.clear();
        if page.deliveries.is_empty() {
            return;
        }
        self.starts.resize(robots + 2, 0);
        for delivery in &page.deliveries {
            self.starts[delivery.to as usize + 2] += 1;
        }
        for robot in 1..self.starts.len() {
            self.starts[robot] += self.starts[robot - 1];
        }
        self.deliveries
            .resize(page.deliveries.len(), page.deliveries[0]);
        for delivery in &page.deliveries {
            let next = &mut self.starts[delivery.to as usize + 1];
            self.deliveries[*next as usize] = *delivery;
            *next += 1;
        }
    }

    /// The arrivals at a robot in this step, by time, sender and sequence number.
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
