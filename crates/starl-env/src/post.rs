//! Messages on their way between the robots of one environment.
//!
//! The fate of a message is drawn by a key of its action, sender and receiver, so that no draw depends on another.

use crate::settings::Radio;
use starl_core::Random;
use starl_motion::Neighbour;

/// A message on its way.
#[derive(Clone, Copy, Debug)]
struct Flight {
    due: u64,
    sent: u64,
    from: u32,
    to: u32,
}

/// The messages of one environment.
#[derive(Clone, Debug)]
pub struct Post {
    /// The messages of the last actions, a ring of one more than the longest delay; a row for each robot.
    sent: Vec<f64>,
    flights: Vec<Flight>,
    /// The newest message that each robot has from each other.
    received: Vec<f64>,
    /// The action with which it was sent, plus one; 0 if there is none.
    stamps: Vec<u64>,
}

impl Post {
    pub fn new(radio: &Radio, robots: usize) -> Post {
        let ring = radio.delay.1 as usize + 1;
        Post {
            sent: vec![0.0; ring * robots * radio.numbers],
            flights: Vec::new(),
            received: vec![0.0; robots * robots * radio.numbers],
            stamps: vec![0; robots * robots],
        }
    }

    /// Forgets all messages.
    pub fn clear(&mut self) {
        self.flights.clear();
        self.received.fill(0.0);
        self.stamps.fill(0);
    }

    /// Sends the messages of action `now`, a row for each robot, to those in range.
    pub fn send(&mut self, radio: &Radio, key: u64, now: u64, bodies: &[Neighbour], rows: &[f64]) {
        let slot = self.slot(now, rows.len());
        self.sent[slot..slot + rows.len()].copy_from_slice(rows);
        let (shortest, longest) = radio.delay;
        for (to, receiver) in bodies.iter().enumerate() {
            for (from, sender) in bodies.iter().enumerate() {
                if to == from || sender.position.distance(receiver.position) > radio.range {
                    continue;
                }
                let mut random = Random::keyed(key, &[now, from as u64, to as u64]);
                if random.chance(radio.loss) {
                    continue;
                }
                let delay = shortest + random.below(longest - shortest + 1);
                self.flights.push(Flight {
                    due: now + u64::from(delay),
                    sent: now,
                    from: from as u32,
                    to: to as u32,
                });
            }
        }
    }

    /// Delivers the messages due at the end of action `now`. Of two messages of one sender the newer one is kept.
    pub fn deliver(&mut self, radio: &Radio, now: u64, robots: usize) {
        let numbers = radio.numbers;
        let mut flights = std::mem::take(&mut self.flights);
        flights.retain(|flight| {
            if flight.due > now {
                return true;
            }
            let (from, to) = (flight.from as usize, flight.to as usize);
            let place = to * robots + from;
            if flight.sent + 1 > self.stamps[place] {
                self.stamps[place] = flight.sent + 1;
                let row = self.slot(flight.sent, robots * numbers) + from * numbers;
                let (sent, received) = (&self.sent, &mut self.received);
                received[place * numbers..][..numbers].copy_from_slice(&sent[row..][..numbers]);
            }
            false
        });
        self.flights = flights;
    }

    fn slot(&self, action: u64, row: usize) -> usize {
        let ring = self.sent.len() / row;
        (action % ring as u64) as usize * row
    }

    /// Writes the newest messages, by receiver and sender, and how many actions ago each was sent, -1 if none came.
    pub fn show(&self, now: u64, messages: &mut [f64], ages: &mut [i32]) {
        messages.copy_from_slice(&self.received);
        for (age, &stamp) in ages.iter_mut().zip(&self.stamps) {
            *age = match stamp {
                0 => -1,
                stamp => i32::try_from((now + 1).saturating_sub(stamp)).unwrap_or(i32::MAX),
            };
        }
    }
}
