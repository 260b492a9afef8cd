//! An operator's end of the link: asks robots how they are, sends orders to their programs, and stops them.

use crate::WallClock;
use crate::link::channel::Opened;
use crate::link::frame::{Frame, Seen, Status};
use crate::link::{Arrival, Channel, Key, Member, OPERATORS, Transport};
use starl_core::Order;
use std::collections::BTreeMap;
use std::sync::mpsc::Receiver;
use std::time::{Duration, Instant};

/// A question is asked again after this.
const REPEAT: Duration = Duration::from_millis(200);

/// How often robots are informed that they are watched.
const REPEAT_WATCH: Duration = Duration::from_millis(500);

/// A member of the fleet that is an operator, not a robot.
pub struct Operator {
    channel: Channel,
    transport: Box<dyn Transport>,
    inbox: Receiver<Arrival>,
    clock: WallClock,
    robots: Vec<Member>,
    /// When robots were last informed that they are watched.
    watched: Option<Instant>,
    /// The number of the last order.
    orders: u32,
}

/// A number for an operator that no other operator has, most likely.
pub fn fresh_member() -> Member {
    OPERATORS | getrandom::u32().unwrap_or(1)
}

impl Operator {
    /// The end of the operator `me`, which reaches these robots by `transport` and hears what arrives in `inbox`.
    pub fn new(
        me: Member,
        fleet: &str,
        keys: Vec<Key>,
        robots: Vec<Member>,
        transport: Box<dyn Transport>,
        inbox: Receiver<Arrival>,
    ) -> Operator {
        let mut channel = Channel::new(me, fleet, keys);
        robots.iter().for_each(|robot| channel.want(*robot));
        Operator {
            channel,
            transport,
            inbox,
            clock: WallClock::since(WallClock::system()),
            robots,
            watched: None,
            orders: 0,
        }
    }

    /// How each robot is. Those that have not answered when `patience` ends are missing.
    pub fn statuses(&mut self, patience: Duration) -> BTreeMap<Member, Status> {
        let robots = self.robots.clone();
        let answers = self.question(&robots, &Frame::Ask, patience);
        let status = |(robot, frame)| match frame {
            Frame::Status(status) => Some((robot, *status)),
            _ => None,
        };
        answers.into_iter().filter_map(status).collect()
    }

    /// Stops robots: their motors at once, then their processes. Returns those that have confirmed it.
    pub fn halt(&mut self, robots: &[Member], patience: Duration) -> Vec<Member> {
        let answers = self.question(robots, &Frame::Halt, patience);
        answers.into_keys().collect()
    }

    /// Sends an order to the programs of robots, each of which receives it at most once. Returns the robots whose
    /// programs have received it.
    pub fn order(&mut self, robots: &[Member], order: Order, patience: Duration) -> Vec<Member> {
        self.orders += 1;
        let answers = self.question(robots, &Frame::Order(self.orders, order), patience);
        answers.into_keys().collect()
    }

    /// Requests the events of all robots, and returns those that arrive until `end`: the robot, the time of arrival,
    /// and the events. Call it again within a second, or the robots stop sending.
    pub fn watch(&mut self, end: Instant) -> Vec<(Member, Instant, Seen)> {
        let is_due = self.watched.is_none_or(|at| at.elapsed() >= REPEAT_WATCH);
        if is_due {
            self.watched = Some(Instant::now());
            self.connect();
            for robot in self.robots.clone() {
                self.send(robot, &Frame::Watch);
            }
        }
        let mut seen = Vec::new();
        loop {
            let wait = end.saturating_duration_since(Instant::now());
            let Ok(arrival) = self.inbox.recv_timeout(wait) else {
                return seen;
            };
            if let Some((from, Frame::Seen(told))) = self.open(&arrival) {
                seen.push((from, arrival.at, *told));
            }
        }
    }

    /// Asks these robots until all have answered, or patience ends.
    fn question(
        &mut self,
        robots: &[Member],
        question: &Frame,
        patience: Duration,
    ) -> BTreeMap<Member, Frame> {
        let end = Instant::now() + patience;
        let mut answers = BTreeMap::new();
        // Answers to earlier questions are old.
        self.drain();
        let mut asked = BTreeMap::new();
        while answers.len() < robots.len() && Instant::now() < end {
            self.connect();
            for &robot in robots {
                let is_due = asked
                    .get(&robot)
                    .is_none_or(|at: &Instant| at.elapsed() >= REPEAT);
                if !answers.contains_key(&robot) && is_due && self.send(robot, question) {
                    asked.insert(robot, Instant::now());
                }
            }
            if let Ok(arrival) = self.inbox.recv_timeout(Duration::from_millis(10))
                && let Some((from, frame)) = self.open(&arrival)
            {
                let is_answer = match question {
                    Frame::Halt => matches!(frame, Frame::Halted),
                    Frame::Order(number, _) => frame == Frame::Ordered(*number),
                    _ => matches!(frame, Frame::Status(_)),
                };
                if is_answer && robots.contains(&from) {
                    answers.insert(from, frame);
                }
            }
        }
        answers
    }

    fn drain(&mut self) {
        while let Ok(arrival) = self.inbox.try_recv() {
            self.open(&arrival);
        }
    }

    fn connect(&mut self) {
        for (member, packet) in self.channel.due(self.clock.now()) {
            let _ = self.transport.send(member, &packet);
        }
    }

    fn send(&mut self, to: Member, frame: &Frame) -> bool {
        let content = starl_core::message::encode(frame);
        let packet = self.channel.seal(to, &content);
        packet.is_some_and(|packet| self.transport.send(to, &packet).is_ok())
    }

    fn open(&mut self, arrival: &Arrival) -> Option<(Member, Frame)> {
        match self.channel.open(self.clock.now(), &arrival.packet) {
            Opened::Content { from, content } => {
                Some((from, starl_core::message::decode(&content)?))
            }
            _ => None,
        }
    }
}
