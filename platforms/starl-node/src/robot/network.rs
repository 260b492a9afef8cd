//! The robot's end of the link: what it hears from others and tells them.

use super::core::{BEACON_PERIOD, Core, Peer};
use super::equipment::Equipment;
use crate::link::beacon::Beacon;
use crate::link::channel::{self, Opened};
use crate::link::frame::{Frame, Seen, Status};
use crate::link::{Arrival, Member, OPERATORS};
use crate::recorder::Recorder;
use starl_core::event::DropReason;
use starl_core::{Destination, Duration, Event, Input, Intervention, Message, Order, RobotId};
use starl_host::{Datagram, NodeInput};

/// A robot that was stopped answers for so long, since its confirmation may be lost.
const FAREWELL: Duration = Duration::from_millis(1000);

/// The number of nearest robots that hear each round of beacons, because this one may have to avoid them.
const NEAR: usize = 8;

/// The other robots hear one round of this number, in turns. A robot of a hundred that told all of them its position ten
/// times a second would send and receive 2,000 packets a second.
const TURNS: u32 = 6;

/// The number of robots, near or far, that hear each round of a robot that stands in a larger fleet, and the most rounds
/// until all have heard it. Others reckon that a robot of which they hear nothing stands where it was last.
const STANDING: u32 = 2;
const MOST_TURNS: u32 = 40;

/// A robot stands when it has been within this distance of one place, metres, for so long.
const SAME_PLACE: f64 = 0.02;
const SETTLED: Duration = Duration::from_millis(2000);

/// A round that is late shows that the computer has too much to do. Distant robots miss rounds for this many times the
/// delay, so that beacons do not displace the messages of programs.
const EASING: u64 = 10;

/// Until all have heard this robot, they miss rounds for at most this time altogether.
const LONGEST_EASING: Duration = Duration::from_millis(6000);

/// The number of the latest orders that are remembered, so that copies of them are recognised. An operator repeats an order
/// for a few seconds.
const MOST_ORDERS: usize = 64;

/// A robot of so large a fleet hears each other one at least this often, unless beacons are lost.
pub fn longest_silence(robots: usize) -> Duration {
    match robots > NEAR + 1 {
        true => LONGEST_EASING + Duration(BEACON_PERIOD.0 * u64::from(MOST_TURNS)),
        false => Duration::from_millis(1000),
    }
}

impl<R: Recorder, E: Equipment> Core<R, E> {
    pub(super) fn receive(&mut self, arrival: &Arrival) {
        match self.channel.open(self.now, &arrival.packet) {
            Opened::Content { from, content } => {
                self.equipment.learn(from, arrival.origin);
                if let Some(frame) = starl_core::message::decode::<Frame>(&content) {
                    self.hear(from, frame);
                }
            }
            Opened::Handshake { from, answer } => {
                self.equipment.learn(from, arrival.origin);
                if let Some(answer) = answer {
                    let _ = self.equipment.send(from, &answer);
                } else {
                    // The other end uses the session once it has heard something in it.
                    self.send_beacon(from);
                }
            }
            Opened::Refused(_) => {}
        }
    }

    fn hear(&mut self, from: Member, frame: Frame) {
        if from < OPERATORS && from as usize >= self.peers.len() || from == self.setup.id.0 {
            return;
        }
        if from < OPERATORS {
            self.link_heard = self.now;
        }
        match frame {
            Frame::Halt if from >= OPERATORS => {
                self.equipment.stop();
                self.send(from, &Frame::Halted);
                if self.leaving.is_none() {
                    self.recorder.notice(self.now, "stopped by an operator");
                    self.leaving = Some(self.now + FAREWELL);
                }
            }
            _ if self.leaving.is_some() => {}
            Frame::Datagram {
                sequence,
                port,
                payload,
            } if from < OPERATORS => {
                let message = Message {
                    from: RobotId(from),
                    port,
                    payload,
                };
                self.handle(NodeInput::Datagram { sequence, message });
            }
            Frame::Beacon(beacon) if from < OPERATORS => self.notice_peer(from, &beacon),
            Frame::Ask if from >= OPERATORS => {
                let status = Frame::Status(Box::new(self.status()));
                self.send(from, &status);
            }
            Frame::Watch if from >= OPERATORS => self.recorder.watch(self.now, from),
            Frame::Order(number, order) if from >= OPERATORS => self.obey(from, number, order),
            _ => {}
        }
    }

    /// Passes an operator's order to the program, if it runs and this is no copy.
    fn obey(&mut self, from: Member, number: u32, order: Order) {
        if !self.node.condition().started || !self.node.runs() {
            return;
        }
        if !self.orders.contains(&(from, number)) {
            self.orders.truncate(MOST_ORDERS - 1);
            self.orders.insert(0, (from, number));
            let told = Intervention::Tell {
                robots: vec![self.setup.id],
                order: order.clone(),
            };
            let told = Event::Intervention(Box::new(told));
            self.recorder.record(self.now, told);
            self.handle(NodeInput::Input(Input::Order(order)));
        }
        self.send(from, &Frame::Ordered(number));
    }

    fn notice_peer(&mut self, from: Member, beacon: &Beacon) {
        // It has restarted, or the network was cut, so it may not know where this robot stands.
        let silence = Duration(2 * u64::from(self.turns(false)) * BEACON_PERIOD.0);
        let peer = &mut self.peers[from as usize];
        let is_back = peer.quality.is_back(self.now, silence, beacon);
        peer.quality.take(self.now, beacon);
        peer.latest = Some((beacon.sent, self.now));
        if let Some(pose) = beacon.pose {
            peer.place = Some(pose.position);
            let robot = RobotId(from);
            self.surroundings
                .hear(robot, self.now, pose.position, beacon.velocity);
        }
        if is_back {
            self.send_beacon(from);
        }
    }

    /// Sends a round of beacons, which is so late.
    pub(super) fn send_beacons(&mut self, late: Duration) {
        for (member, packet) in self.channel.due(self.now) {
            let _ = self.equipment.send(member, &packet);
        }
        let tells_near = self.has_moved() || self.peers.len() <= NEAR + 1;
        let turns = self.turns(tells_near);
        let mut turn = None;
        if self.next_far <= self.now {
            turn = Some(self.turn);
            self.turn = self.turn.wrapping_add(1);
            let easing = late.0.saturating_mul(EASING);
            self.next_far = self.now + Duration(easing.min(LONGEST_EASING.0 / u64::from(turns)));
        }
        for (rank, peer) in self.nearest().into_iter().enumerate() {
            let is_near = tells_near && rank < NEAR;
            if is_near || turn.is_some_and(|turn| turn % turns == peer % turns) {
                self.send_beacon(peer);
            }
        }
    }

    /// The number of rounds in which each of the other robots has its turn.
    fn turns(&self, tells_near: bool) -> u32 {
        match tells_near {
            true => TURNS,
            false => (self.peers.len() as u32 / STANDING).clamp(TURNS, MOST_TURNS),
        }
    }

    /// Whether it has moved lately, as far as it knows.
    fn has_moved(&mut self) -> bool {
        let Some((estimate, _)) = self.localiser.estimate() else {
            return false;
        };
        let place = estimate.pose.position;
        if self.stand.0.distance(place) > SAME_PLACE {
            self.stand = (place, self.now);
        }
        self.now.since(self.stand.1) < SETTLED
    }

    /// The other robots, the nearest first; those whose place is unknown last.
    fn nearest(&self) -> Vec<Member> {
        let me = self.setup.id.index();
        let here = self.localiser.estimate().map(|(own, _)| own.pose.position);
        let distance = |peer: &Peer| {
            let both = here.zip(peer.place);
            both.map_or(f64::INFINITY, |(here, there)| here.distance(there))
        };
        let peers = self.peers.iter().enumerate();
        let others = peers.filter(|(index, _)| *index != me);
        let mut ranked: Vec<(f64, Member)> = others
            .map(|(index, peer)| (distance(peer), index as Member))
            .collect();
        if ranked.len() > NEAR {
            ranked.sort_by(|one, other| one.0.total_cmp(&other.0));
        }
        ranked.into_iter().map(|(_, member)| member).collect()
    }

    fn send_beacon(&mut self, to: Member) {
        let estimate = self.localiser.estimate();
        let mut peer = self.peers.get_mut(to as usize);
        let number = peer.as_mut().map_or(0, |peer| {
            peer.beacons = peer.beacons.wrapping_add(1);
            peer.beacons
        });
        let beacon = Beacon {
            number,
            sent: self.now,
            pose: estimate.map(|(estimate, _)| estimate.pose),
            velocity: estimate.map_or(starl_core::Point::ZERO, |(e, _)| e.twist.linear),
            echo: peer.and_then(|peer| peer.latest),
        };
        self.send(to, &Frame::Beacon(beacon));
    }

    /// Tells the operators that watch what has happened.
    pub(super) fn tell_operators(&mut self) {
        let due = self.recorder.due(self.now, self.node.program());
        self.tell(due);
    }

    /// Tells the operators that watch everything that they have not heard, because the robot ends.
    pub(super) fn tell_operators_the_rest(&mut self) {
        let rest = self.recorder.rest(self.now, self.node.program());
        self.tell(rest);
    }

    fn tell(&mut self, (operators, told): (Vec<Member>, Vec<Seen>)) {
        for seen in told {
            let frame = Frame::Seen(Box::new(seen));
            for &operator in &operators {
                self.send(operator, &frame);
            }
        }
    }

    /// Whether a packet left.
    fn send(&mut self, to: Member, frame: &Frame) -> bool {
        let content = starl_core::message::encode(frame);
        let sealed = self.channel.seal(to, &content);
        sealed.is_some_and(|packet| self.equipment.send(to, &packet).is_ok())
    }

    pub(super) fn transmit(&mut self, datagram: Datagram) {
        let me = self.setup.id;
        let to: Vec<RobotId> = match datagram.destination {
            Destination::All => self.fleet.iter().copied().filter(|to| *to != me).collect(),
            Destination::Robot(to) if to == me => {
                self.to_self.push(datagram);
                return;
            }
            Destination::Robot(to) => vec![to],
        };
        let Datagram {
            sequence, message, ..
        } = datagram;
        let frame = Frame::Datagram {
            sequence,
            port: message.port,
            payload: message.payload,
        };
        let content = starl_core::message::encode(&frame);
        for to in to {
            let reason = if content.len() > channel::LONGEST {
                DropReason::Size
            } else {
                let packet = self.channel.seal(to.0, &content);
                match packet.map(|packet| self.equipment.send(to.0, &packet)) {
                    Some(Ok(())) => continue,
                    _ => DropReason::Loss,
                }
            };
            let event = Event::Dropped {
                from: me,
                to: Some(to),
                sequence,
                reason,
            };
            self.recorder.record(self.now, event);
        }
    }

    fn status(&self) -> Status {
        let estimate = self.localiser.estimate();
        let condition = self.node.condition();
        let links = self.peers.iter().enumerate();
        Status {
            now: self.now,
            up: self.now.since(self.begun),
            finished: condition.finished,
            failed: self.failure.clone(),
            pose: estimate.map(|(estimate, _)| estimate.pose),
            position_age: estimate.map_or(Duration(u64::MAX), |(_, at)| self.now.since(at)),
            stopped: self.hazard.as_ref().map(ToString::to_string),
            battery: self.battery,
            state: self.recorder.state(self.node.program()),
            links: links
                .filter(|(index, _)| *index != self.setup.id.index())
                .map(|(index, peer)| (index as u32, peer.quality))
                .collect(),
            refused: self.channel.refusals(),
        }
    }
}
