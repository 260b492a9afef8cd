//! Compares robots of the same state: see [`crate::doubt`].

use crate::code::Code;
use crate::robot::Local;
use crate::robots::Robots;

impl Robots {
    /// Gives twins the input that a robot in this state has just handled, and new twins all inputs that were handled in
    /// their states before.
    pub fn compare_twins(&mut self, local: u32, code: Code) {
        let Some(doubt) = &mut self.doubt else { return };
        doubt.tried.entry(local).or_default().push(code);
        let twins = doubt.twins.get(&local).cloned().unwrap_or_default();
        for twin in &twins {
            self.compare(local, twin, code);
        }
        // Twins lead to twins.
        while let Some(doubt) = &mut self.doubt
            && let Some((local, twin)) = doubt.new.pop()
        {
            let tried = doubt.tried.get(&local).cloned().unwrap_or_default();
            for code in tried {
                self.compare(local, &twin, code);
            }
        }
    }

    fn compare(&mut self, local: u32, twin: &Local, code: Code) {
        let happening = self.happening(local, code);
        let mine = self.state(local).turn(&happening, &self.surroundings);
        let its = twin.turn(&happening, &self.surroundings);
        let robot = twin.robot();
        let is_same = mine.sent == its.sent && mine.events == its.events;
        let motions = self.motions;
        let (mine, its) = (self.enter(mine), self.enter(its));
        self.motions = motions;
        let Some(doubt) = &mut self.doubt else { return };
        doubt.compared += 1;
        if !is_same || mine.local != its.local {
            doubt.contradiction.get_or_insert_with(|| {
                format!(
                    "robot {robot} reached one state on two paths and then behaved in two ways \
                     ({happening:?}): its program does not write all of its state"
                )
            });
        }
    }
}
