//! A transport that is worse than the network: it loses and delays packets, for rehearsals.

use super::{Member, Origin, Transport};
use starl_core::{Duration, Random};
use std::collections::BTreeMap;
use std::io;
use std::sync::mpsc::{self, RecvTimeoutError, Sender};
use std::thread;
use std::time::Instant;

/// The impairment of sent packets.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Impairment {
    /// The probability that a packet is lost.
    pub loss: f64,
    /// The probability that a packet arrives twice.
    pub duplication: f64,
    /// How long a packet takes, at least.
    pub delay: Duration,
    /// How much longer it may take; so packets overtake each other.
    pub jitter: Duration,
}

/// A transport behind an impairment.
#[derive(Debug)]
pub struct Impaired(Sender<Job>);

#[derive(Debug)]
enum Job {
    Send(Member, Vec<u8>),
    Learn(Member, Origin),
}

impl Impaired {
    /// Puts an impairment before a transport. `seed` decides the losses and delays.
    ///
    /// # Errors
    /// If the system gives no thread.
    pub fn new(
        mut transport: Box<dyn Transport>,
        impairment: Impairment,
        seed: u64,
    ) -> io::Result<Impaired> {
        let (sender, jobs) = mpsc::channel();
        let mut random = Random::keyed(seed, &[]);
        thread::Builder::new()
            .name("impairment".to_string())
            .spawn(move || {
                let mut waiting: BTreeMap<(Instant, u64), (Member, Vec<u8>)> = BTreeMap::new();
                let mut count = 0;
                loop {
                    let now = Instant::now();
                    while let Some(first) =
                        waiting.first_entry().filter(|entry| entry.key().0 <= now)
                    {
                        let (to, packet) = first.remove();
                        // The sender does not learn of the loss, as with any packet.
                        let _ = transport.send(to, &packet);
                    }
                    let next = waiting.first_key_value().map(|((at, _), _)| *at);
                    let wait = next.map_or(std::time::Duration::from_secs(1), |at| {
                        at.saturating_duration_since(now)
                    });
                    match jobs.recv_timeout(wait) {
                        Ok(Job::Learn(member, origin)) => transport.learn(member, origin),
                        Ok(Job::Send(to, packet)) => {
                            let copies = 1 + u32::from(random.chance(impairment.duplication));
                            for _ in 0..copies {
                                let extra = random.between(0.0, impairment.jitter.seconds());
                                let delay = impairment.delay.seconds() + extra;
                                if !random.chance(impairment.loss) {
                                    let at =
                                        Instant::now() + Duration::from_seconds_f64(delay).into();
                                    count += 1;
                                    waiting.insert((at, count), (to, packet.clone()));
                                }
                            }
                        }
                        Err(RecvTimeoutError::Timeout) => {}
                        Err(RecvTimeoutError::Disconnected) => return,
                    }
                }
            })?;
        Ok(Impaired(sender))
    }
}

impl Transport for Impaired {
    fn send(&mut self, to: Member, packet: &[u8]) -> io::Result<()> {
        let job = Job::Send(to, packet.to_vec());
        self.0
            .send(job)
            .map_err(|_| io::ErrorKind::NotConnected.into())
    }

    fn learn(&mut self, member: Member, origin: Origin) {
        let _ = self.0.send(Job::Learn(member, origin));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::time::Duration as Span;

    struct Sink(Sender<Instant>);

    impl Transport for Sink {
        fn send(&mut self, _: Member, _: &[u8]) -> io::Result<()> {
            let _ = self.0.send(Instant::now());
            Ok(())
        }

        fn learn(&mut self, _: Member, _: Origin) {}
    }

    #[test]
    fn packets_are_lost_and_late_at_the_set_rates() {
        let (sender, arrived) = mpsc::channel();
        let impairment = Impairment {
            loss: 0.25,
            duplication: 0.5,
            delay: Duration::from_millis(20),
            jitter: Duration::from_millis(10),
        };
        let mut link = Impaired::new(Box::new(Sink(sender)), impairment, 1).unwrap();
        let begun = Instant::now();
        for _ in 0..4000 {
            link.send(1, b"packet").unwrap();
        }
        let mut times = Vec::new();
        while let Ok(at) = arrived.recv_timeout(Span::from_millis(500)) {
            times.push(at);
        }
        let expected = 4000.0 * 1.5 * 0.75;
        assert!(
            (times.len() as f64 - expected).abs() < 0.05 * expected,
            "{}",
            times.len()
        );
        assert!(times[0] - begun >= Span::from_millis(20));
    }
}
