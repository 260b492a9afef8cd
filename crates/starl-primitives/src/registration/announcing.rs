//! How participants become known to each other, and find out that they disagree.
//!
//! A robot without a list announces itself repeatedly. Of those with the same list one announces it now and
//! then, because robots that hear it stay silent (similar to Trickle: Levis et al. 2004). So separated robots
//! hear of each other, robots that are listed by mistake object, and a robot with an outdated list learns it.

use super::packet::{Announcement, Packet, Roll, View};
use super::ticket::Ticket;
use super::{Alarm, LATEST, Registration, Stage};
use starl_core::{Area, Destination, Duration, Message, Robot, RobotId, Time};

/// A robot that has announced itself so often without getting into a list is reported to the coordinator
/// by others.
const OFTEN: u32 = 2;

impl Registration {
    pub(super) fn receive(&mut self, robot: &mut Robot<'_>, message: &Message) {
        let from = message.from;
        if from == robot.id() || robot.fleet().binary_search(&from).is_err() {
            return;
        }
        let Some(packet) = message.read::<Packet>() else {
            return;
        };
        let knows_me = self.is_answer(robot.id(), &packet);
        match packet {
            Packet::Leave { ticket } => self.end(robot, from, ticket),
            Packet::Announce(said) => self.hear(robot, from, &said),
            Packet::Propose(view) => self.consider(robot, from, view),
            Packet::Over { ticket } => self.register_anew(robot, ticket),
            _ if self.own.is_none() => {}
            Packet::Accept { id, also } => self.accepted(robot, from, id, &also),
            Packet::Refuse { id, promised, also } => {
                self.refused(robot, from, id, promised, &also);
            }
            Packet::Commit(id) => self.committed(robot, from, id),
        }
        if let Some(peer) = self.peers.get_mut(&from) {
            peer.hears |= knows_me;
        }
    }

    /// Whether only a robot that knows of this one's registration sends this.
    fn is_answer(&self, me: RobotId, packet: &Packet) -> bool {
        let ticket = self.own.as_ref().map(|own| own.ticket);
        let lists = |view: &View| ticket.is_some() && view.roll.get(&me).copied() == ticket;
        match packet {
            Packet::Announce(said) => {
                said.view.as_ref().is_some_and(lists)
                    || said
                        .waits_for
                        .is_some_and(|(robot, named)| robot == me && Some(named) == ticket)
            }
            Packet::Propose(view) => lists(view),
            Packet::Accept { id, .. } | Packet::Refuse { id, .. } => id.coordinator == me,
            Packet::Over { ticket: over } => Some(*over) == ticket,
            Packet::Commit(_) | Packet::Leave { .. } => false,
        }
    }

    /// Makes this robot known, and arranges for the next time.
    pub(super) fn announce(&mut self, robot: &mut Robot<'_>) {
        let Some(own) = &self.own else { return };
        let leader = match &self.stage {
            Stage::Accepted { view, .. } => view.id.coordinator,
            _ => self.leader(robot.id()),
        };
        let view = match &mut self.stage {
            Stage::Agreed { view, heard, .. } => {
                *heard = false;
                Some(view.clone())
            }
            _ => None,
        };
        let waits_for = self.peers.get(&leader).map(|peer| (leader, peer.ticket));
        let said = Announcement {
            ticket: own.ticket,
            area: own.area.clone(),
            here: robot.position(),
            promised: self.promised,
            count: own.announcements,
            waits_for: waits_for.filter(|_| view.is_none()),
            view,
        };
        robot.transmit(Destination::All, self.port, &Packet::Announce(said));
        self.announce_later(robot);
    }

    fn announce_later(&mut self, robot: &mut Robot<'_>) {
        let Some(own) = &mut self.own else { return };
        let shows = matches!(self.stage, Stage::Agreed { .. });
        let interval = self.options.interval(own.announcements, shows);
        own.announcements = own.announcements.saturating_add(1);
        // Robots that changed together do not speak together.
        let stretch = 1.0 + robot.random().uniform() / 4.0;
        self.announce_after(
            robot,
            Duration::from_seconds_f64(interval.seconds() * stretch),
        );
    }

    fn announce_after(&mut self, robot: &mut Robot<'_>, after: Duration) {
        self.announces_at = robot.now() + after;
        self.set(robot, Alarm::Announcement, after);
    }

    /// A list was gained or lost: announcements become frequent again.
    pub(super) fn begin_announcing(&mut self, robot: &mut Robot<'_>, soon: bool) {
        for peer in self.peers.values_mut() {
            peer.hears = false;
        }
        if let Some(own) = &mut self.own {
            own.announcements = 0;
            if soon {
                let after = self.options.settle.seconds() * robot.random().uniform();
                self.announce_after(robot, Duration::from_seconds_f64(after));
            } else {
                self.announce_later(robot);
            }
        }
    }

    /// Announces this robot again, and checks whether it waits for a robot that does not answer.
    pub(super) fn announce_again(&mut self, robot: &mut Robot<'_>) {
        let Some(own) = &self.own else { return };
        let announcements = own.announcements;
        let fleet = robot.fleet();
        self.peers
            .retain(|peer, _| fleet.binary_search(peer).is_ok());
        self.set_list_right(robot);
        match &mut self.stage {
            Stage::Agreed { heard, .. } if *heard => {
                *heard = false;
                self.announce_later(robot);
            }
            _ => self.announce(robot),
        }
        let leader = self.leader(robot.id());
        match &self.stage {
            Stage::Open | Stage::Proposed { .. }
                if announcements > self.options.repetitions + 1 =>
            {
                self.shun_deaf(robot);
            }
            Stage::Open if leader != robot.id() && announcements > self.options.repetitions => {
                self.shun(robot, leader);
                self.look_within(robot, self.options.settle);
            }
            Stage::Open | Stage::Agreed { .. } => self.look_within(robot, self.options.settle),
            _ => {}
        }
    }

    /// Hears an announcement.
    fn hear(&mut self, robot: &mut Robot<'_>, from: RobotId, said: &Announcement) {
        let me = robot.id();
        let listed = said.view.as_ref().and_then(|view| view.roll.get(&me));
        let awaited = said.waits_for.filter(|(robot, _)| *robot == me);
        let ticket = self.own.as_ref().map(|own| own.ticket);
        let wrong = |named: &Ticket| Some(*named) != ticket;
        if let Some(&over) = listed.filter(|named| wrong(named)) {
            self.deny(robot, Destination::All, over);
        } else if let Some((_, over)) = awaited.filter(|(_, named)| wrong(named)) {
            self.deny(robot, Destination::Robot(from), over);
        }
        if let Some(view) = &said.view {
            self.is_gone(robot, view.id, &view.roll);
        }
        if self.own.is_none() {
            return;
        }
        if self.past.is_over(from, said.ticket) {
            let ticket = said.ticket;
            let over = Packet::Over { ticket };
            return robot.transmit(Destination::Robot(from), self.port, &over);
        }
        // A robot that sends has not failed, unless the message was in transit for long.
        self.suspects.remove(&from);
        self.hear_time(said.promised.time);
        let known = self.peers.get(&from).map(|peer| peer.ticket);
        if known != Some(said.ticket) {
            if known.is_some() {
                // It has registered again.
                self.drop_peer(robot, from);
            }
            if !self.is_neighbour(robot, said) {
                return;
            }
        }
        let led_by = said.view.as_ref().map(|view| view.id.coordinator);
        let mut is_news = self.meet(robot, from, said.ticket, led_by);
        if let Some(view) = &said.view {
            is_news |= self.hear_of(robot, &view.roll);
        }
        if let Some(view) = &said.view
            && view.roll.get(&me).copied() == ticket
            && view.id < self.promised
        {
            // It shows a list that this robot has left behind.
            let refusal = Packet::Refuse {
                id: view.id,
                promised: self.promised,
                also: Roll::new(),
            };
            robot.transmit(Destination::Robot(from), self.port, &refusal);
        }
        self.compare(robot, from, said);
        if is_news || matches!(self.stage, Stage::Open) {
            self.look_within(robot, self.options.settle);
        }
    }

    /// Whether one is in the other's area.
    fn is_neighbour(&self, robot: &Robot<'_>, said: &Announcement) -> bool {
        let holds = |area: &Option<Area>, place| match area {
            None => true,
            Some(area) => area.is_valid() && area.contains(place),
        };
        let own = self.own.as_ref().map(|own| &own.area);
        holds(&said.area, robot.position()) || own.is_some_and(|area| holds(area, said.here))
    }

    /// Compares what another participant shows with what this one shows.
    fn compare(&mut self, robot: &mut Robot<'_>, from: RobotId, said: &Announcement) {
        let own_area = self.own.as_ref().map(|own| &own.area);
        let same_area = own_area == Some(&said.area);
        let Stage::Agreed { view, heard, .. } = &mut self.stage else {
            return;
        };
        let is_in_it = view.roll.get(&from) == Some(&said.ticket);
        let coordinator = view.id.coordinator;
        match &said.view {
            Some(other) if other.id == view.id => {
                // Two lists of one name: only a corruption can have brought that about.
                if other.roll != view.roll {
                    self.lose(robot);
                } else if same_area {
                    *heard = true;
                }
            }
            _ if is_in_it && said.promised > view.id => self.lose(robot),
            // Two groups have met.
            Some(_) if !is_in_it => self.begin_announcing(robot, true),
            _ if said.count < OFTEN => {}
            // It has not heard that all have accepted, or has given up on it.
            _ if is_in_it && coordinator == robot.id() => {
                let proposal = Packet::Propose(view.clone());
                robot.transmit(Destination::Robot(from), self.port, &proposal);
            }
            _ if !is_in_it && coordinator != robot.id() => {
                let tell = Packet::Accept {
                    id: view.id,
                    also: Roll::from([(from, said.ticket)]),
                };
                robot.transmit(Destination::Robot(coordinator), self.port, &tell);
            }
            _ => {}
        }
    }

    /// Learns the time of a list.
    pub(super) fn hear_time(&mut self, time: Time) {
        if time <= LATEST {
            self.latest = self.latest.max(time);
        }
    }

    /// A list that others have left behind is shown no longer.
    pub(super) fn lose(&mut self, robot: &mut Robot<'_>) {
        if let Stage::Agreed { .. } = self.stage {
            self.open(robot, self.options.settle);
        }
    }
}

/// Whether a list could have been made by a robot.
pub(super) fn is_possible(view: &View, from: RobotId, most: u32) -> bool {
    let View { id, roll } = view;
    id.coordinator == from
        && id.time <= LATEST
        && roll.contains_key(&from)
        && roll.len() <= most as usize
}
