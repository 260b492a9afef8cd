//! Storage that survives a crash.

use super::{
    Act, Cue, DELAY, Host, Log, Need, ONE, Outcome, Probe, WRITE_TIME, ZERO, ms, need, span, start,
    start_with_storage,
};
use starl_core::Event;

/// A restarted robot finds the last value that it has saved under a key.
pub fn saved_values_are_found_after_a_restart<H: Host>() -> Outcome {
    need::<H>(Need::Storage)?;
    let robot = Probe::new()
        .after(span(100), [Act::Save(7)])
        .after(span(200), [Act::Save(8)]);
    let mut host: H = start_with_storage([robot.clone(), robot]);
    host.run_before(ms(190));
    host.crash(ZERO);
    host.run_before(ms(250));
    host.restart(ZERO);
    host.run_before(ms(600));
    host.crash(ZERO);
    host.restart(ZERO);
    host.run_before(ms(650));
    let log = Log::of(&host);
    assert_eq!(log.found(ZERO), [(ms(250), 7), (ms(600), 8)]);
    assert_eq!(log.found(ONE), []);
    Ok(())
}

/// All effects of an input wait until its saved values are written, and so do all later effects. Timers run from then
/// on.
pub fn effects_wait_for_the_write<H: Host>() -> Outcome {
    need::<H>(Need::Storage)?;
    need::<H>(Need::WriteTime)?;
    let robot = Probe::new()
        .after(
            span(110),
            [Act::Send(ONE, 1), Act::Save(7), Act::Arm(1, span(40))],
        )
        .after(span(120), [Act::Send(ONE, 2)])
        .after(span(210), [Act::Send(ONE, 3)]);
    let mut host: H = start_with_storage([robot, Probe::new()]);
    host.run_before(ms(300));
    let log = Log::of(&host);
    let written = ms(110) + WRITE_TIME;
    let sent = log
        .events(ZERO)
        .filter(|(_, event)| matches!(event, Event::Sent { .. }));
    assert!(sent.map(|(at, _)| at).eq([written, written, ms(210)]));
    log.check_heard(
        ONE,
        &[
            Cue::Start,
            Cue::Message(1),
            Cue::Message(2),
            Cue::Message(3),
        ],
    );
    log.check_times(ONE, Cue::Message(1), &[written + DELAY]);
    log.check_times(ZERO, Cue::Timer(1), &[written + span(40)]);
    Ok(())
}

/// A crash before the end of a write undoes the inputs since.
pub fn a_crash_undoes_a_write_and_its_effects<H: Host>() -> Outcome {
    need::<H>(Need::Storage)?;
    need::<H>(Need::WriteTime)?;
    let robot = Probe::new()
        .after(span(110), [Act::Save(7)])
        .after(span(210), [Act::Save(8), Act::Send(ONE, 1), Act::Finish])
        .after(span(220), [Act::Send(ONE, 2)]);
    let mut host: H = start_with_storage([robot, Probe::new()]);
    host.run_before(ms(230));
    host.crash(ZERO);
    host.run_before(ms(350));
    host.restart(ZERO);
    host.run_before(ms(400));
    let log = Log::of(&host);
    assert_eq!(log.found(ZERO), [(ms(350), 7)]);
    log.check_heard(ONE, &[Cue::Start]);
    let is_outcome = |event: &Event| matches!(event, Event::Sent { .. } | Event::Finished);
    assert_eq!(log.count(ZERO, is_outcome), 0);
    assert!(
        log.times(ZERO, Cue::Activate)
            .iter()
            .all(|&at| at != ms(220))
    );
    Ok(())
}

/// Values saved during a write wait for the next one, which takes as long.
pub fn writes_are_batched<H: Host>() -> Outcome {
    need::<H>(Need::Storage)?;
    need::<H>(Need::WriteTime)?;
    let robot = Probe::new()
        .after(span(110), [Act::Save(1), Act::Send(ONE, 1)])
        .after(span(120), [Act::Save(2), Act::Send(ONE, 2)])
        .after(span(130), [Act::Save(3), Act::Send(ONE, 3)]);
    let mut host: H = start_with_storage([robot, Probe::new()]);
    host.run_before(ms(300));
    host.crash(ZERO);
    host.restart(ZERO);
    host.run_before(ms(350));
    let log = Log::of(&host);
    let first = ms(110) + WRITE_TIME + DELAY;
    let second = first + WRITE_TIME;
    log.check_times(ONE, Cue::Message(1), &[first]);
    log.check_times(ONE, Cue::Message(2), &[second]);
    log.check_times(ONE, Cue::Message(3), &[second]);
    assert_eq!(log.found(ZERO), [(ms(300), 3)]);
    Ok(())
}

/// Without storage, saving takes no time and has no effect.
pub fn robots_without_storage_find_nothing<H: Host>() -> Outcome {
    let robot = Probe::new().after(span(110), [Act::Save(7), Act::Send(ONE, 1)]);
    let mut host: H = start([robot, Probe::new()]);
    host.run_before(ms(200));
    host.crash(ZERO);
    host.restart(ZERO);
    host.run_before(ms(250));
    let log = Log::of(&host);
    assert_eq!(log.found(ZERO), []);
    log.check_times(ONE, Cue::Message(1), &[ms(110) + DELAY]);
    Ok(())
}
