//! How a robot that has just started becomes able to answer others.
//!
//! It cannot know whether it ran before, so it asks. In the first stage it learns the number of its last life from
//! others; in the second it sends them the number of its new life, one greater, and gets their copies. A stage ends
//! when it has heard
//! - a majority of all participants, among the others, that are up: one of them has each value that a majority had
//!   stored or promised, and robots that count this robot's acknowledgements from an earlier life hear of its new
//!   one from one of them; or
//! - all others, up or just started themselves: nothing more can be known; or
//! - for some time no robot that is up, nor a new one that has heard one, and so many new robots that they are a
//!   majority together. They were new in both stages, so there was a moment at which all of them were recovering. As
//!   long as no majority ever recovers later, it was the fleet's own start; or
//! - a robot that is up, and had heard this one at that moment, in its present life. Then it has acknowledged nothing
//!   since, and is as if it had been up from then on. Otherwise the robots that are up first could not help the
//!   others if some fail soon after the start.

use super::entering::{Heard, Standing};
use super::lives::FIRST;
use super::packet::{Content, Page, QuestionId};
use super::{Alarm, Register};
use crate::founders::Founders;
use alloc::string::String;
use alloc::vec::Vec;
use starl_core::event::RegisterEvent;
use starl_core::{Destination, Robot, RobotId};

impl Register {
    /// Another robot has just started.
    pub(super) fn welcome(
        &mut self,
        robot: &mut Robot<'_>,
        from: RobotId,
        id: QuestionId,
        life: Option<u64>,
        after: Option<String>,
    ) {
        let me = robot.id();
        if !self.is_member(robot, me) || !self.is_member(robot, from) {
            return;
        }
        // It has forgotten its earlier acknowledgements.
        if let Some(life) = life {
            self.lives.learn(from, life);
        }
        let is_up = self.is_up();
        let founders = self.founders.with(from, id.incarnation);
        let content = if life.is_some() && is_up && founders.is_empty() {
            let room = self.options.longest_datagram.saturating_sub(60);
            let page = self.replica.page(after, room);
            Content::State { id, page }
        } else {
            let known = self.lives.of(from);
            // A new robot may not know of the first life.
            let life = if is_up || known > FIRST { known } else { 0 };
            let hears_up = match &self.standing {
                Standing::New(entering) => entering.hears_up(robot.now()),
                Standing::Up(_) => true,
            };
            Content::Told {
                id,
                life,
                is_up,
                hears_up,
                founders,
            }
        };
        self.send(robot, Destination::Robot(from), content);
    }

    /// Whether this is what this robot asks now, having just started.
    pub(super) fn asks(&self, id: QuestionId) -> bool {
        let Standing::New(entering) = &self.standing else {
            return false;
        };
        let incarnation = self.incarnation.known();
        incarnation == Some(id.incarnation) && entering.stages == id.number
    }

    /// Another robot reports whether it is up, and the number of this robot's last life.
    pub(super) fn told(
        &mut self,
        robot: &mut Robot<'_>,
        from: RobotId,
        incarnation: u32,
        life: u64,
        (is_up, hears_up): (bool, bool),
        founders: Founders,
    ) {
        if !self.is_member(robot, from) {
            return;
        }
        let theirs = self.lives.of(from);
        let Standing::New(entering) = &mut self.standing else {
            return;
        };
        if hears_up {
            entering.told_up = Some(robot.now());
        }
        let is_founder = is_up && !founders.is_empty();
        if is_founder {
            entering.founders = founders;
        }
        let known = entering.heard.get(&from);
        let is_known = entering.life.is_some() || matches!(known, Some(Heard::Up { .. }));
        if is_up && is_known && !is_founder {
            return;
        }
        entering.told = entering.told.max(life);
        let heard = match is_up {
            false => Heard::New(incarnation),
            true => Heard::Up {
                life: theirs,
                after: None,
                is_done: true,
            },
        };
        entering.heard.insert(from, heard);
        self.go_on_entering(robot);
    }

    /// Another robot shows its copies.
    pub(super) fn take_page(
        &mut self,
        robot: &mut Robot<'_>,
        from: RobotId,
        their_life: u64,
        page: Page,
    ) {
        let is_member = self.is_member(robot, from);
        let Standing::New(entering) = &mut self.standing else {
            return;
        };
        if entering.life.is_none() || !is_member {
            return;
        }
        let begun = match entering.heard.get(&from) {
            Some(Heard::Up { life, after, .. }) if *life == their_life => after.clone(),
            _ => None, // in another life it may have other copies
        };
        if page.after != begun {
            return;
        }
        let after = page.entries.last().map(|entry| entry.register.clone());
        let after = after.or(begun);
        let heard = Heard::Up {
            life: their_life,
            after: after.clone(),
            is_done: page.is_last,
        };
        entering.heard.insert(from, heard);
        for entry in page.entries {
            self.take_over(robot, entry);
        }
        if page.is_last {
            self.go_on_entering(robot);
        } else {
            self.say_hello_to(robot, &[from], after);
        }
    }

    /// Ends this stage if enough is known.
    fn go_on_entering(&mut self, robot: &mut Robot<'_>) {
        let (me, majority) = (robot.id(), self.majority(robot));
        if !self.is_member(robot, me) {
            return;
        }
        let others = self.members(robot).len().saturating_sub(1);
        let (now, grace) = (robot.now(), self.options.grace);
        let known = self.lives.of(me);
        while let Standing::New(entering) = &mut self.standing {
            let lives = &self.lives;
            entering.heard.retain(|&peer, heard| match heard {
                Heard::New(_) => true,
                Heard::Up { life, .. } => *life >= lives.of(peer),
            });
            let begun = entering.begun.unwrap_or(now);
            let may_begin = now.since(begun) >= grace && entering.may_begin(now);
            if !entering.is_over(others, majority, may_begin) {
                return;
            }
            match entering.life {
                Some(life) if life >= known => {
                    self.founders = entering.founders();
                    self.standing = Standing::Up(life);
                    self.lives.learn(me, life);
                    robot.cancel_timer(self.timer(Alarm::Enter));
                    self.report_up(robot, life);
                    return self.ask_all(robot);
                }
                Some(_) => entering.next_stage(None),
                None => {
                    let last = entering.told.max(if known > FIRST { known } else { 0 });
                    entering.next_stage(Some(last + 1));
                }
            }
            self.say_hello(robot);
        }
    }

    /// Says that this robot answers others from now on.
    pub(super) fn report_up(&self, robot: &mut Robot<'_>, life: u64) {
        let life = life.min(i64::MAX as u64) as i64;
        robot.report(self.port, RegisterEvent::Up { life });
    }

    /// Asks the questions of operations that have begun already, this robot too.
    fn ask_all(&mut self, robot: &mut Robot<'_>) {
        let numbers: Vec<u32> = self.operations.keys().copied().collect();
        for number in numbers {
            self.answer_own(robot, number);
            self.advance(robot, number);
            self.ask(robot, number);
        }
    }

    /// Begins to enter.
    pub(super) fn enter(&mut self, robot: &mut Robot<'_>) {
        let me = robot.id();
        let is_member = self.is_member(robot, me);
        let Standing::New(entering) = &mut self.standing else {
            return;
        };
        if !is_member || entering.begun.is_some() {
            return;
        }
        entering.begun = Some(robot.now());
        self.say_hello(robot);
        self.go_on_entering(robot);
    }

    /// The time for answers is over.
    pub(super) fn enter_again(&mut self, robot: &mut Robot<'_>) {
        let now = robot.now();
        if let Standing::New(entering) = &mut self.standing {
            entering.begun = entering.begun.map(|begun| begun.min(now));
            let mut heard = entering.heard.iter();
            let hears_up = entering.hears_up(now);
            let is_mixed = heard.any(|(&peer, heard)| match heard {
                Heard::New(incarnation) => !entering.is_new(peer, *incarnation),
                Heard::Up { .. } => !hears_up,
            });
            // Robots that have started since are asked in both stages. Those that were up may have failed.
            if is_mixed {
                entering.next_stage(None);
            }
        }
        self.go_on_entering(robot);
        self.say_hello(robot);
    }

    /// Asks the robots that are still needed in this stage.
    fn say_hello(&mut self, robot: &mut Robot<'_>) {
        let (me, mut peers) = (robot.id(), self.members(robot));
        let Standing::New(entering) = &mut self.standing else {
            return;
        };
        peers.retain(|peer| *peer != me);
        let after = self.options.timeout(entering.repetitions);
        entering.repetitions = entering.repetitions.saturating_add(1);
        let (mut begun, mut unheard) = (Vec::new(), Vec::new());
        for peer in peers {
            match entering.heard.get(&peer) {
                Some(Heard::Up { is_done: true, .. }) => {}
                Some(Heard::Up { after, .. }) => begun.push((peer, after.clone())),
                // A robot that was new may be up by now.
                Some(Heard::New(_)) | None => unheard.push(peer),
            }
        }
        for (peer, after) in begun {
            self.say_hello_to(robot, &[peer], after);
        }
        if !unheard.is_empty() {
            self.say_hello_to(robot, &unheard, None);
        }
        robot.set_timer(self.timer(Alarm::Enter), after);
    }

    fn say_hello_to(&mut self, robot: &mut Robot<'_>, peers: &[RobotId], after: Option<String>) {
        let incarnation = self.incarnation.of(robot);
        let Standing::New(entering) = &self.standing else {
            return;
        };
        let id = QuestionId {
            incarnation,
            number: entering.stages,
        };
        let life = entering.life;
        self.send_each(robot, peers, &Content::Hello { id, life, after });
    }
}
