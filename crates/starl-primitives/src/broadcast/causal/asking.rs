//! What other robots are asked of their messages, and what follows from their answers.

use super::Causal;
use super::vector::Process;
use starl_core::Robot;

/// What a robot was asked.
#[derive(Clone, Copy, Debug)]
pub(super) struct Doubt {
    ticket: u32,
    /// What it was about.
    process: Process,
    /// How much of it had been taken then.
    taken: u32,
    /// The count of looks then.
    looks: u32,
}

impl Causal {
    /// Messages of this process before a number will not come; and it is the only life of its robot.
    pub(super) fn settle(&mut self, process: Process, before: u32) {
        // Its other lives are over, those included that were only heard of.
        let after = self.held.iter().flat_map(|held| &held.after);
        for other in after.map(|after| after.process) {
            if other.robot == process.robot && other != process {
                let known = self.vector.note(other);
                known.into_iter().for_each(|known| known.settled = u32::MAX);
            }
        }
        let known = self.vector.hear(process);
        known.settled = known.settled.max(before.saturating_sub(1));
    }

    /// Asks a robot what may still come of it.
    pub(super) fn ask(&mut self, robot: &mut Robot<'_>, process: Process) {
        self.questions = self.questions.wrapping_add(1);
        // Answers to what an earlier life asked are none to this one.
        let incarnation = self.channel.reliable.next_to_all(robot).incarnation;
        let ticket = incarnation.wrapping_add(self.questions);
        let taken = self.vector.get(process).map_or(0, |known| known.taken);
        let doubt = Doubt {
            ticket,
            process,
            taken,
            looks: self.looks,
        };
        self.doubts.insert(process.robot, doubt);
        self.channel.reliable.ask(robot, process.robot, ticket);
    }

    /// More cannot have been taken, when a robot was asked, than it had sent when it answered: only a
    /// corruption can have left such a number.
    pub(super) fn clear_doubt(&mut self, process: Process, next: u32, ticket: u32) {
        let Some(&doubt) = self.doubts.get(&process.robot) else {
            return;
        };
        if doubt.ticket != ticket || doubt.process != process {
            return;
        }
        self.doubts.remove(&process.robot);
        let last = next.saturating_sub(1);
        if doubt.taken > last {
            self.vector.hear(process).taken = last;
        }
        // Nor can what had arrived by then come after more.
        for held in &mut self.held {
            let had_arrived = self.looks.wrapping_sub(held.looks) < doubt.looks;
            let about = held.after.iter_mut().filter(|a| a.process == process);
            for after in about.filter(|_| had_arrived) {
                after.number = after.number.min(last);
            }
        }
    }
}
