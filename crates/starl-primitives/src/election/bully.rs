//! The bully algorithm (Garcia-Molina 1982, "Elections in a distributed computing system"): of the candidates that are
//! up, the one with the greatest number leads.
//!
//! A robot asks all greater ones whether they are there. If none answers, it leads and tells all. A robot that answers
//! does the same itself.
//!
//! Where it differs: failures are found by the program's failure detector and by time-outs, both of which may be wrong;
//! questions are repeated; a leader announces itself repeatedly, and a greater robot that hears a smaller leader
//! contradicts it. So robots with different leaders agree when they hear each other.

use super::options::no_later;
use super::packet::Packet;
use super::rules::{Leadership, Rules, Scene};
use alloc::vec::Vec;
use starl_core::{Random, RobotId, Time};

/// See the [module](self).
#[derive(Clone, Debug, Default)]
pub(super) struct Bully {
    leader: Option<RobotId>,
    /// As leader: when to say so again. Else: when the leader has been silent for too long.
    due: Time,
    question: Option<Question>,
}

/// Greater robots have been asked whether they are there.
#[derive(Clone, Copy, Debug)]
struct Question {
    /// Whether one is.
    is_answered: bool,
    /// When the answer, or the leader, is no longer waited for.
    until: Time,
    repeat_at: Time,
    repetitions: u32,
}

impl Bully {
    fn begin(&mut self, scene: &mut Scene<'_, '_>) {
        (self.leader, self.question) = (None, None);
        let greater = greater(scene);
        if greater.is_empty() {
            self.lead(scene);
            return;
        }
        let now = scene.now();
        self.question = Some(Question {
            is_answered: false,
            until: now + scene.options.answer_timeout,
            repeat_at: now + scene.options.timeout(0),
            repetitions: 0,
        });
        scene.tell(&greater, Packet::Election);
    }

    /// Takes the lead, or says again that it has it.
    fn lead(&mut self, scene: &mut Scene<'_, '_>) {
        (self.leader, self.question) = (Some(scene.me()), None);
        self.due = scene.now() + scene.options.period();
        scene.tell_all(Packet::Lead);
    }

    fn lose(&mut self, scene: &mut Scene<'_, '_>) {
        self.leader = None;
        if scene.stands {
            self.begin(scene);
        }
    }

    /// A robot says that it leads.
    fn hear(&mut self, scene: &mut Scene<'_, '_>, from: RobotId) {
        let me = scene.me();
        if scene.stands && me > from {
            match self.leader {
                Some(leader) if leader == me => scene.send(from, Packet::Lead),
                None if self.question.is_none() => self.begin(scene),
                _ => {}
            }
        } else if self.leader.is_none_or(|leader| leader <= from) {
            (self.leader, self.question) = (Some(from), None);
            self.due = scene.now() + scene.options.patience;
        }
    }

    /// Asks again, or stops waiting.
    fn go_on(&mut self, scene: &mut Scene<'_, '_>) {
        let now = scene.now();
        let Some(question) = &mut self.question else {
            return;
        };
        if now >= question.until {
            if question.is_answered {
                self.begin(scene);
            } else {
                self.lead(scene);
            }
        } else if now >= question.repeat_at {
            question.repetitions = question.repetitions.saturating_add(1);
            question.repeat_at = now + scene.options.timeout(question.repetitions);
            let greater = greater(scene);
            scene.tell(&greater, Packet::Election);
        }
    }

    /// Makes sense of what a corruption may have left.
    fn make_plausible(&mut self, scene: &Scene<'_, '_>) {
        let (now, options, me) = (scene.now(), scene.options, scene.me());
        self.leader.take_if(|leader| {
            if *leader == me {
                !scene.stands
            } else {
                !scene.others.contains(leader) || scene.stands && *leader < me
            }
        });
        if !scene.stands || self.leader.is_some() {
            self.question = None;
        }
        if let Some(question) = &mut self.question {
            let longest = options.patience.max(options.answer_timeout);
            no_later(&mut question.until, now + longest);
            no_later(&mut question.repeat_at, now + options.timeout(u32::MAX));
        }
        no_later(&mut self.due, now + options.patience.max(options.period()));
    }
}

/// The greater participants that are not suspected.
fn greater(scene: &Scene<'_, '_>) -> Vec<RobotId> {
    let me = scene.me();
    let others = scene.others.iter().copied();
    others
        .filter(|&peer| peer > me && !scene.is_suspected(peer))
        .collect()
}

impl Rules for Bully {
    fn elect(&mut self, scene: &mut Scene<'_, '_>) {
        if self.question.is_none() {
            self.begin(scene);
        }
    }

    fn resign(&mut self, scene: &mut Scene<'_, '_>) {
        self.question = None;
        if self.leader == Some(scene.me()) {
            self.leader = None;
            scene.tell_all(Packet::Resign);
        }
    }

    fn receive(&mut self, scene: &mut Scene<'_, '_>, from: RobotId, packet: Packet) {
        match packet {
            Packet::Election if scene.stands && from < scene.me() => {
                if self.leader == Some(scene.me()) {
                    scene.send(from, Packet::Lead);
                    return;
                }
                scene.send(from, Packet::Answer);
                if self.leader.is_none() && self.question.is_none() {
                    self.begin(scene);
                }
            }
            Packet::Answer if from > scene.me() => {
                if let Some(question) = &mut self.question
                    && !question.is_answered
                {
                    let until = scene.now() + scene.options.patience;
                    (question.is_answered, question.until) = (true, until);
                    question.repeat_at = until;
                }
            }
            Packet::Lead => self.hear(scene, from),
            Packet::Resign if self.leader == Some(from) => self.lose(scene),
            _ => {}
        }
    }

    fn suspect(&mut self, scene: &mut Scene<'_, '_>, peer: RobotId) {
        if self.leader == Some(peer) {
            self.lose(scene);
        } else if self.question.is_some() && greater(scene).is_empty() {
            self.lead(scene);
        }
    }

    fn settle(&mut self, scene: &mut Scene<'_, '_>) {
        self.make_plausible(scene);
        match self.leader {
            Some(_) if scene.now() < self.due => {}
            Some(leader) if leader == scene.me() => self.lead(scene),
            Some(_) => self.lose(scene),
            None if self.question.is_some() => self.go_on(scene),
            None if scene.stands => self.begin(scene),
            None => {}
        }
    }

    fn due(&self, _: &Scene<'_, '_>) -> Time {
        match (&self.question, self.leader) {
            (Some(question), _) => question.repeat_at.min(question.until),
            (None, Some(_)) => self.due,
            (None, None) => Time::NEVER,
        }
    }

    fn leadership(&self, _: RobotId) -> Option<Leadership> {
        let leader = self.leader?;
        Some(Leadership {
            leader,
            epoch: None,
        })
    }

    fn corrupt(&mut self, random: &mut Random) {
        self.leader = random.chance(0.5).then(|| RobotId(random.below(8)));
        self.due = Time(random.magnitude());
        self.question = random.chance(0.5).then(|| Question {
            is_answered: random.chance(0.5),
            until: Time(random.magnitude()),
            repeat_at: Time(random.magnitude()),
            repetitions: random.bits(),
        });
    }
}
