//! Live observation of a robot by operators.

use crate::link::Member;
use crate::link::frame::Seen;
use crate::recorder::Recorder;
use starl_core::event::Level;
use starl_core::{Duration, Event, Program, Time};
use starl_host::Observed;
use std::collections::BTreeMap;
use std::mem;

/// The time after which an operator that does not ask again receives no more.
const INTEREST: Duration = Duration::from_millis(3000);

/// How often operators receive the state.
const PERIOD: Duration = Duration::from_millis(50);

/// A packet of events is about as long, bytes: what a network carries in one piece.
const PACKET: usize = 1200;

/// The greatest number of events that wait; later ones are only counted, so that a robot that floods its operators
/// continues.
const MOST_EVENTS: usize = 4096;

/// A recorder whose events operators see too.
pub(super) struct Watched<R> {
    pub recorder: R,
    /// The watching operators, with the time until which each watches.
    watchers: BTreeMap<Member, Time>,
    fresh: Vec<(Time, Event)>,
    /// How many events there were.
    count: u64,
    told: Time,
    begun: Time,
}

impl<R: Recorder> Watched<R> {
    /// Takes the place of a recorder in a life that begins now.
    pub fn new(recorder: R, begun: Time) -> Watched<R> {
        Watched {
            recorder,
            watchers: BTreeMap::new(),
            fresh: Vec::new(),
            count: 0,
            told: Time::ZERO,
            begun,
        }
    }

    /// An operator asks for reports for some time from now on.
    pub fn watch(&mut self, now: Time, operator: Member) {
        self.watchers.insert(operator, now + INTEREST);
    }

    /// The observers to notify now, with the frames for them.
    pub fn due(&mut self, now: Time, program: &dyn Program) -> (Vec<Member>, Vec<Seen>) {
        match now.since(self.told) < PERIOD {
            true => (Vec::new(), Vec::new()),
            false => self.rest(now, program),
        }
    }

    /// The observers of now, with the frames for them, although a report has just been sent: what a robot that ends
    /// has still to say.
    pub fn rest(&mut self, now: Time, program: &dyn Program) -> (Vec<Member>, Vec<Seen>) {
        self.watchers.retain(|_, until| *until > now);
        if self.watchers.is_empty() {
            return (Vec::new(), Vec::new());
        }
        self.told = now;
        let state = self.recorder.state(program);
        let events = mem::take(&mut self.fresh);
        let mut first = self.count - events.len() as u64;
        let begun = self.begun;
        let pack = |events: Vec<(Time, Event)>| {
            let seen = Seen {
                now,
                begun,
                first,
                state: state.clone(),
                events,
            };
            first += seen.events.len() as u64;
            seen
        };
        let told = packets(events).into_iter().map(pack).collect();
        (self.watchers.keys().copied().collect(), told)
    }

    fn keep(&mut self, at: Time, event: impl FnOnce() -> Event) {
        self.count += 1;
        if self.watchers.is_empty() {
            return;
        }
        if self.fresh.len() == MOST_EVENTS {
            self.fresh.clear();
        }
        self.fresh.push((at, event()));
    }
}

/// Events in groups that fit into packets.
fn packets(events: Vec<(Time, Event)>) -> Vec<Vec<(Time, Event)>> {
    let mut packets = vec![Vec::new()];
    let mut length = 0;
    for event in events {
        let size = starl_core::message::encode(&event).len();
        if length + size > PACKET && length > 0 {
            packets.push(Vec::new());
            length = 0;
        }
        length += size;
        if let Some(last) = packets.last_mut() {
            last.push(event);
        }
    }
    packets
}

impl<R: Recorder> Recorder for Watched<R> {
    fn record(&mut self, at: Time, event: Event) {
        self.keep(at, || event.clone());
        self.recorder.record(at, event);
    }

    fn observe(&mut self, at: Time, observed: Observed<'_>) {
        self.recorder.observe(at, observed);
    }

    fn advance(&mut self, now: Time) {
        self.recorder.advance(now);
    }

    fn commit(&mut self) {
        self.recorder.commit();
    }

    fn notice(&mut self, at: Time, text: &str) {
        self.keep(at, || Event::Log {
            level: Level::Warning,
            text: text.to_string().into(),
        });
        self.recorder.notice(at, text);
    }

    fn state(&self, program: &dyn Program) -> Option<String> {
        self.recorder.state(program)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    struct Nothing;

    impl Recorder for Nothing {
        fn record(&mut self, _: Time, _: Event) {}
        fn observe(&mut self, _: Time, _: Observed<'_>) {}
        fn advance(&mut self, _: Time) {}
        fn notice(&mut self, _: Time, _: &str) {}
    }

    #[derive(Clone, starl_core::Primitives)]
    struct Idle;

    impl Program for Idle {
        fn activate(&mut self, _: &mut starl_core::Robot<'_>) {}
    }

    fn ms(millis: u64) -> Time {
        Time::ZERO + Duration::from_millis(millis)
    }

    #[test]
    fn an_operator_gets_all_events_in_packets_until_it_stops_watching() {
        let mut watched = Watched::new(Nothing, Time::ZERO);
        watched.record(ms(1), Event::Finished);
        watched.watch(ms(10), 7);
        for count in 0..1000 {
            watched.record(ms(20), Event::Action(format!("step {count}").into()));
        }
        let (to, told) = watched.due(ms(60), &Idle);
        assert_eq!(to, [7]);
        let mut next = 1;
        for seen in &told {
            let packet = starl_core::message::encode(seen);
            assert!(packet.len() < 2 * PACKET);
            assert_eq!(starl_core::message::decode(&packet).as_ref(), Some(seen));
            assert_eq!(seen.first, next);
            next += seen.events.len() as u64;
        }
        assert_eq!(next, 1001);
        assert!(watched.due(ms(100), &Idle).0.is_empty(), "it is too early");
        assert_eq!(watched.due(ms(110), &Idle).0, [7]);
        assert!(
            watched.due(ms(3011), &Idle).0.is_empty(),
            "the observer did not renew its request"
        );
    }
}
