//! Lives of robots: crashes, restarts and corruption.

use super::{Act, Cue, Host, Log, Need, ONE, Outcome, Probe, ZERO, ms, need, span, start};
use alloc::vec::Vec;
use starl_core::Event;

/// A robot starts at once and runs until it crashes; it restarts on command, with a fresh copy of its program, and is
/// activated from then on.
pub fn a_robot_restarts_with_a_fresh_copy<H: Host>() -> Outcome {
    let mut host: H = start([Probe::new()]);
    host.run_before(ms(250));
    host.crash(ZERO);
    host.run_before(ms(430));
    host.restart(ZERO);
    host.run_before(ms(650));
    let log = Log::of(&host);
    log.check_times(ZERO, Cue::Start, &[ms(0), ms(430)]);
    let activations = [0, 100, 200, 430, 530, 630].map(ms);
    log.check_times(ZERO, Cue::Activate, &activations);
    let told = log.told(ZERO);
    let starts = told.iter().filter(|told| told.is(Cue::Start));
    assert!(starts.clone().all(|told| told.count == 1), "{told:?}");
    let first = told.iter().position(|told| told.at >= ms(430));
    assert!(
        first.is_some_and(|first| told[first].is(Cue::Start)),
        "{told:?}"
    );
    Ok(())
}

/// Timers that a robot armed in a life do not fire in the next, nor while it is down.
pub fn nothing_of_an_earlier_life_comes_later<H: Host>() -> Outcome {
    let sender = Probe::new()
        .after(span(100), [Act::Send(ONE, 1)])
        .after(span(600), [Act::Send(ONE, 2)]);
    let robot = Probe::new()
        .on(Cue::Message(1), [Act::Arm(1, span(300))])
        .on(Cue::Message(2), [Act::Arm(2, span(200))]);
    let mut host: H = start([sender, robot]);
    host.run_before(ms(200));
    host.crash(ONE);
    host.restart(ONE);
    host.run_before(ms(700));
    host.crash(ONE);
    host.run_before(ms(1000));
    let log = Log::of(&host);
    let heard = [Cue::Start, Cue::Message(1), Cue::Start, Cue::Message(2)];
    log.check_heard(ONE, &heard);
    assert!(log.told(ONE).iter().all(|told| told.at < ms(700)));
    Ok(())
}

/// The sequence numbers of a robot's datagrams grow, even over crashes.
pub fn no_sequence_number_is_used_twice<H: Host>() -> Outcome {
    let numbers = numbers_over_restarts::<H>();
    assert_eq!(numbers.len(), 22);
    assert!(numbers.is_sorted_by(|one, next| one < next), "{numbers:?}");
    Ok(())
}

/// A robot numbers its datagrams consecutively, even over crashes.
pub fn the_next_life_continues_the_numbers<H: Host>() -> Outcome {
    need::<H>(Need::Count)?;
    assert!(numbers_over_restarts::<H>().into_iter().eq(0..22));
    Ok(())
}

/// The numbers of the datagrams that a robot sends in four lives.
fn numbers_over_restarts<H: Host>() -> Vec<u32> {
    let robot = Probe::new().on(Cue::Activate, [Act::Send(ONE, 7), Act::Send(ONE, 8)]);
    let mut host: H = start([robot, Probe::new()]);
    for round in 1..4 {
        host.run_before(ms(round * 300 - 50));
        host.crash(ZERO);
        host.run_before(ms(round * 300));
        host.restart(ZERO);
    }
    host.run_before(ms(1050));
    let log = Log::of(&host);
    let numbers = log.events(ZERO).filter_map(|(_, event)| match event {
        Event::Sent { sequence, .. } => Some(*sequence),
        _ => None,
    });
    numbers.collect()
}

/// Corrupted state stays corrupted until the robot restarts, and the robot continues with it.
pub fn a_corrupted_robot_continues_until_it_restarts<H: Host>() -> Outcome {
    need::<H>(Need::Corruption)?;
    let mut host: H = start([Probe::new(), Probe::new()]);
    host.run_before(ms(250));
    host.corrupt(ZERO);
    host.run_before(ms(550));
    host.crash(ZERO);
    host.restart(ZERO);
    host.run_before(ms(750));
    let log = Log::of(&host);
    let is_corrupted = |told: &super::Told| told.count > 1_000_000;
    for told in log.told(ZERO) {
        assert_eq!(is_corrupted(&told), (ms(250)..ms(550)).contains(&told.at));
    }
    assert!(!log.told(ONE).iter().any(is_corrupted));
    let activations = [0, 100, 200, 300, 400, 500, 550, 650].map(ms);
    log.check_times(ZERO, Cue::Activate, &activations);
    Ok(())
}
