//! Answers to what programs ask for, and how programs end.

use super::{Act, Cue, Host, Log, Need, ONE, Outcome, Probe, ZERO, ms, need, span, start};
use starl_core::Event;

/// Each request for a path is answered once, with its ticket.
pub fn a_path_answers_its_request<H: Host>() -> Outcome {
    need::<H>(Need::Paths)?;
    let robot = Probe::new()
        .after(span(50), [Act::Plan(7), Act::Plan(3)])
        .after(span(100), [Act::Plan(7)]);
    let mut host: H = start([robot]);
    host.run_before(ms(300));
    let log = Log::of(&host);
    log.check_times(ZERO, Cue::Path(7), &[ms(60), ms(110)]);
    log.check_times(ZERO, Cue::Path(3), &[ms(60)]);
    Ok(())
}

/// A restarted robot does not get the path that it requested before the crash, even if it requests one with the same
/// ticket.
pub fn a_path_for_an_earlier_life_is_ignored<H: Host>() -> Outcome {
    need::<H>(Need::Paths)?;
    let robot = Probe::new().after(span(100), [Act::Plan(7)]);
    let mut host: H = start([robot]);
    host.run_before(ms(110));
    host.crash(ZERO);
    host.restart(ZERO);
    host.run_before(ms(400));
    Log::of(&host).check_times(ZERO, Cue::Path(7), &[ms(220)]);
    Ok(())
}

/// A path that is found after a crash is discarded.
pub fn a_path_for_a_robot_that_is_down_is_ignored<H: Host>() -> Outcome {
    need::<H>(Need::Paths)?;
    let robot = Probe::new().after(span(100), [Act::Plan(7)]);
    let mut host: H = start([robot]);
    host.run_before(ms(110));
    host.crash(ZERO);
    host.run_before(ms(200));
    let log = Log::of(&host);
    log.check_times(ZERO, Cue::Path(7), &[]);
    assert!(log.told(ZERO).iter().all(|told| told.at < ms(110)));
    Ok(())
}

/// A failed program is not called again and sends nothing, although datagrams reach its robot; after a restart it runs
/// again.
pub fn a_failed_program_is_not_called_again<H: Host>() -> Outcome {
    let sender = Probe::new().on(Cue::Activate, [Act::Send(ONE, 1)]);
    let robot = Probe::new()
        .after(span(250), [Act::Fail])
        .on(Cue::Start, [Act::Arm(1, span(400))])
        .on(Cue::Timer(1), [Act::Send(ZERO, 2)])
        .on(Cue::Activate, [Act::Send(ZERO, 3)])
        .on(Cue::Message(1), [Act::Send(ZERO, 4)]);
    let mut host: H = start([sender, robot]);
    host.run_before(ms(1000));
    let log = Log::of(&host);
    let told = log.told(ONE);
    assert!(
        told.iter().all(|told| told.at <= ms(250) + host.lateness()),
        "{told:?}"
    );
    assert!(
        told.last()
            .is_some_and(|told| told.what.starts_with("Timer"))
    );
    assert_eq!(log.count(ONE, |event| matches!(event, Event::Failed(_))), 1);
    let late = log
        .events(ONE)
        .filter(|(at, _)| *at > ms(250) + host.lateness());
    let (mut sent, mut delivered) = (0, 0);
    for (_, event) in late {
        sent += usize::from(matches!(event, Event::Sent { .. }));
        delivered += usize::from(matches!(event, Event::Delivered { .. }));
    }
    assert_eq!((sent, delivered), (0, 7));
    host.crash(ONE);
    host.restart(ONE);
    host.run_before(ms(1050));
    let starts = Log::of(&host);
    starts.check_times(ONE, Cue::Start, &[ms(0), ms(1000)]);
    Ok(())
}

/// A program that has reached its goal reports it once, and continues to answer.
pub fn a_finished_program_still_answers<H: Host>() -> Outcome {
    let sender = Probe::new().after(span(350), [Act::Send(ONE, 1)]);
    let robot = Probe::new()
        .on(Cue::Activate, [Act::Finish])
        .on(Cue::Message(1), [Act::Finish, Act::Send(ZERO, 2)])
        .after(span(450), [Act::Send(ZERO, 3)]);
    let mut host: H = start([sender, robot]);
    host.run_before(ms(600));
    let log = Log::of(&host);
    assert_eq!(log.count(ONE, |event| *event == Event::Finished), 1);
    log.check_times(ONE, Cue::Activate, &[0, 100, 200, 300, 400, 500].map(ms));
    let heard = [
        Cue::Start,
        Cue::Timer(1000),
        Cue::Message(2),
        Cue::Message(3),
    ];
    log.check_heard(ZERO, &heard);
    Ok(())
}
