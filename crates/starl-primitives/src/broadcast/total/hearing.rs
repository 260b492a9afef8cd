//! Routes arrived messages to the parts that need them.

use super::early::Part;
use super::election::Claim;
use super::followers::Answer;
use super::following::Continuation;
use super::life::Life;
use super::packet::{Body, Generation, Question, Said};
use super::snapshots::Place;
use super::{FURTHEST, Total};
use starl_core::event::messaging::LeaveReason;
use starl_core::{Destination, Message, Robot, RobotId};

impl Total {
    /// Takes a datagram.
    pub(super) fn receive(&mut self, robot: &mut Robot<'_>, message: &Message) {
        let Some(said) = message.read::<Said>() else {
            return;
        };
        if !robot.is_peer(message.from) {
            return;
        }
        self.note_heard(message.from);
        match said.body {
            Body::Relay { from, to, said } => {
                self.pass_on(robot, message.from, from, &to, *said);
            }
            _ => self.hear(robot, message.from, said),
        }
    }

    /// A robot says something, directly or by others that pass it on.
    pub(super) fn hear(&mut self, robot: &mut Robot<'_>, from: RobotId, said: Said) {
        let Said {
            life,
            generation,
            body,
        } = said;
        if !robot.is_peer(from) {
            return;
        }
        self.arm(robot);
        if let Some(generation) = generation
            && !self.learn(generation)
            && !self.is_invitation(robot, &body)
        {
            return;
        }
        let from = Life {
            robot: from,
            name: life,
        };
        self.note_signs(from.robot, &body);
        match body {
            Body::Unheard => self.take_detour(from.robot),
            Body::Hello { bound_to, answer } => {
                self.greeted(robot, from, generation, (bound_to, answer));
            }
            Body::Found {
                generation,
                quorum,
                voters,
            } => self.founded(robot, generation, quorum, voters),
            Body::Snapshot {
                to,
                call,
                quorum,
                term,
                index,
                index_term,
                base,
                roll,
            } => {
                let place = Place {
                    to,
                    call,
                    quorum,
                    term,
                    index,
                    index_term,
                    base,
                    roll,
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

    /// Stores the counter of a group, unless it is impossible.
    pub(super) fn learn(&mut self, generation: Generation) -> bool {
        let is_possible = generation.counter <= self.highest.saturating_add(FURTHEST);
        if is_possible {
            self.highest = self.highest.max(generation.counter);
        }
        is_possible
    }

    /// Whether this very life is invited to a group, whatever its counter: a robot that has just started
    /// knows of none.
    fn is_invitation(&mut self, robot: &mut Robot<'_>, body: &Body) -> bool {
        let me = self.life(robot);
        match body {
            Body::Snapshot { to, .. } => *to == me.name,
            Body::Found { voters, .. } => voters.contains(&me),
            _ => false,
        }
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
            Body::Ask { number, .. } => {
                let question = Question {
                    asker: from.name,
                    number: *number,
                };
                self.greet(robot, to, Some(question));
            }
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
                question,
                term,
                is_granted,
            } => self.answered(robot, from, question, (term, is_granted)),
            Body::Append {
                term,
                round,
                previous,
                previous_term,
                entries,
                commit,
                floor,
                is_beat,
            } => {
                let part = Part {
                    previous,
                    previous_term,
                    entries,
                };
                let next = Continuation {
                    term,
                    round,
                    part,
                    commit,
                    floor,
                    is_beat,
                };
                self.append(robot, from, next);
            }
            Body::Taken {
                term,
                round,
                through,
                lacks,
                applied,
                call,
            } => {
                let answer = Answer {
                    term,
                    round,
                    through,
                    lacks,
                    applied,
                    call,
                };
                self.hear_answer(robot, from, answer);
            }
            Body::Call { to, term, call } => {
                if to == self.life(robot).name {
                    self.called(robot, from, (term, call));
                }
            }
            Body::Propose { oldest, messages } => self.put_messages(robot, from, oldest, messages),
            Body::Hello { .. }
            | Body::Found { .. }
            | Body::Snapshot { .. }
            | Body::Unheard
            | Body::Relay { .. } => {}
        }
    }
}
