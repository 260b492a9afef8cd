//! Who is to be told what has arrived.

use super::election::Claim;
use super::following::{Continuation, Place};
use super::packet::{Body, Generation, Life, Said};
use super::{FURTHEST, Total};
use starl_core::event::messaging::LeaveReason;
use starl_core::{Destination, Message, Robot};

impl Total {
    /// Takes a datagram.
    pub(super) fn receive(&mut self, robot: &mut Robot<'_>, message: &Message) {
        let Some(said) = message.read::<Said>() else {
            return;
        };
        let Said {
            life,
            generation,
            body,
        } = said;
        let is_peer = robot.fleet().binary_search(&message.from).is_ok();
        if !is_peer || message.from == robot.id() {
            return;
        }
        self.arm(robot);
        if let Some(generation) = generation {
            if generation.counter > self.highest.saturating_add(FURTHEST) {
                return;
            }
            self.highest = self.highest.max(generation.counter);
        }
        let from = Life {
            robot: message.from,
            number: life,
        };
        match body {
            Body::Hello { bound_to, answer } => {
                self.greeted(robot, from, generation, (bound_to, answer));
            }
            Body::Found {
                generation,
                quorum,
                voters,
            } => self.founded(robot, generation, quorum, voters),
            Body::Snapshot {
                quorum,
                term,
                index,
                index_term,
                voters,
                senders,
            } => {
                let place = Place {
                    quorum,
                    term,
                    index,
                    index_term,
                    voters,
                    senders,
                };
                if let Some(generation) = generation {
                    self.go_on(robot, from, generation, place);
                }
            }
            body => match (&self.member, generation) {
                (Some(member), Some(generation)) if member.generation == generation => {
                    self.converse(robot, from, body);
                }
                (_, generation) => self.overhear(robot, from, generation, &body),
            },
        }
        self.note_contact(robot);
    }

    /// A member of another group speaks to its members.
    fn overhear(
        &mut self,
        robot: &mut Robot<'_>,
        from: Life,
        generation: Option<Generation>,
        body: &Body,
    ) {
        let to = Destination::Robot(from.robot);
        match body {
            Body::Ask { number, .. } => self.greet(robot, to, Some(*number)),
            Body::Append { .. } => {
                let is_obsolete = self
                    .member
                    .as_ref()
                    .is_some_and(|member| generation > Some(member.generation));
                if is_obsolete {
                    self.leave(robot, LeaveReason::Obsolete);
                }
                if self.member.is_none() || generation < self.member.as_ref().map(|m| m.generation)
                {
                    self.greet(robot, to, None);
                }
            }
            _ => {}
        }
    }

    /// Another member of this robot's group speaks.
    fn converse(&mut self, robot: &mut Robot<'_>, from: Life, body: Body) {
        match body {
            Body::Ask {
                number,
                trial,
                term,
                last_term,
                last,
            } => {
                let claim = Claim {
                    number,
                    trial,
                    term,
                    last_term,
                    last,
                };
                self.consider(robot, from, claim);
            }
            Body::Vote {
                number,
                term,
                is_granted,
            } => self.answered(robot, from, (number, term, is_granted)),
            Body::Append {
                term,
                previous,
                previous_term,
                entries,
                commit,
                floor,
                is_beat,
            } => {
                let next = Continuation {
                    term,
                    previous,
                    previous_term,
                    entries,
                    commit,
                    floor,
                    is_beat,
                };
                self.append(robot, from, next);
            }
            Body::Taken {
                term,
                through,
                is_whole,
                applied,
            } => {
                let Some(member) = &mut self.member else {
                    return;
                };
                if term == member.term {
                    self.taken_by(robot, from, (through, is_whole, applied));
                } else if term <= member.term.saturating_add(FURTHEST) {
                    member.hear_of(term);
                }
            }
            Body::Propose {
                incarnation,
                messages,
            } => self.put_messages(robot, (from.robot, incarnation), messages),
            Body::Hello { .. } | Body::Found { .. } | Body::Snapshot { .. } => {}
        }
    }
}
