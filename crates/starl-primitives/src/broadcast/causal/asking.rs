//! Questions to other robots about their messages, and the consequences of the answers.

use super::vector::{After, Process, Rank, Standing};
use super::{Causal, Look};
use starl_core::{Robot, RobotId};

/// A question to a robot.
#[derive(Clone, Copy, Debug)]
pub(super) struct Doubt {
    ticket: u32,
    /// The life that was heard then, and how much of it had been taken.
    taken: Option<(u32, u32)>,
    /// How many messages had arrived when it was asked.
    since: u64,
    /// The count of looks then.
    looks: Look,
}

/// The answer to it.
pub(super) struct Answer {
    /// The life that gives it.
    pub process: Process,
    /// No message before this one will arrive.
    pub before: u32,
    /// The number of the next one that will be sent.
    pub next: u32,
    pub ticket: u32,
}

impl Causal {
    /// Asks a robot which of its messages may still arrive, unless this was done recently.
    pub(super) fn ask(&mut self, robot: &mut Robot<'_>, peer: RobotId) {
        let before = self.doubts.get(&peer);
        if before.is_some_and(|doubt| doubt.looks == self.looks) {
            return;
        }
        let ticket = self.channel.reliable.ask(robot, peer);
        let present = self.vector.present(peer);
        let taken = present.map(|life| (life.incarnation, life.taken));
        let doubt = Doubt {
            ticket,
            taken,
            since: self.arrivals,
            looks: self.looks,
        };
        self.doubts.insert(peer, doubt);
    }

    /// A robot has said how far it is.
    pub(super) fn answered(&mut self, robot: &mut Robot<'_>, answer: &Answer) {
        let &Answer {
            process,
            before,
            next,
            ticket,
        } = answer;
        let last = next.saturating_sub(1);
        let peer = process.robot;
        self.hear(robot, process);
        let doubt = self.doubts.get(&peer).copied();
        let doubt = doubt.filter(|doubt| doubt.ticket == ticket);
        let Some(life) = self.vector.present(peer) else {
            return;
        };
        life.settled = life.settled.max(before.saturating_sub(1));
        let Some(doubt) = doubt else { return };
        self.doubts.remove(&peer);
        // More cannot have been taken, when the robot was asked, than it had sent when it answered, nor
        // settled: only a corruption can have left such numbers.
        if doubt
            .taken
            .is_some_and(|(life, taken)| life == process.incarnation && taken > last)
        {
            life.taken = last;
        }
        life.settled = life.settled.min(last);
        // Messages that had arrived before the question name no later messages than that, and any other life
        // that they name is over.
        for held in self.held.values_mut().flatten() {
            let about = held
                .after
                .iter_mut()
                .filter(|need| need.after.process.robot == peer);
            for need in about.filter(|_| held.place <= doubt.since) {
                match need.after.process == process {
                    true => need.after.number = need.after.number.min(last),
                    false => need.is_over = true,
                }
            }
        }
        if self.vector.forget_unheard(peer, doubt.since) {
            self.give_up_earlier(robot, peer, Rank::Present);
        }
    }

    /// This life of a robot is heard from now on.
    pub(super) fn hear(&mut self, robot: &mut Robot<'_>, process: Process) {
        let over = self.vector.hear(process);
        let present = self.vector.present(process.robot);
        if present.is_some_and(|life| !life.is_joined && life.taken > 0) {
            // Others spoke of this life before it was heard, and messages of it were passed over.
            self.give_up_earlier(robot, process.robot, Rank::Present);
        }
        let Some(over) = over else { return };
        for held in self.held.values_mut().flatten() {
            let about = held.after.iter_mut();
            about
                .filter(|need| need.after.process == over)
                .for_each(|need| need.is_over = true);
        }
    }

    /// Whether the robot has to be asked which of its lives this is.
    pub(super) fn is_unknown(&self, after: &After) -> bool {
        matches!(self.vector.standing(after.process), Standing::Unknown(_))
    }
}
