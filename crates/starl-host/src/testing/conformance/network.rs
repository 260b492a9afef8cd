//! Datagrams and robots that are not there.

use super::{Act, Cue, Host, Log, ONE, Outcome, Probe, ms, span, start};
use starl_core::Event;
use starl_core::event::DropReason;

/// A datagram that arrives while its receiver is down is dropped, and this is recorded; later ones arrive.
pub fn datagrams_to_a_robot_that_is_down_are_dropped<H: Host>() -> Outcome {
    let sender = Probe::new()
        .after(span(100), [Act::Send(ONE, 1)])
        .after(span(200), [Act::Send(ONE, 2)])
        .after(span(450), [Act::Send(ONE, 3)]);
    let mut host: H = start([sender, Probe::new()]);
    host.run_before(ms(150));
    host.crash(ONE);
    host.run_before(ms(400));
    host.restart(ONE);
    host.run_before(ms(600));
    let log = Log::of(&host);
    log.check_heard(
        ONE,
        &[Cue::Start, Cue::Message(1), Cue::Start, Cue::Message(3)],
    );
    let fates = log.events(ONE).filter_map(|(_, event)| match event {
        Event::Delivered { sequence, .. } => Some((*sequence, None)),
        Event::Dropped {
            sequence, reason, ..
        } => Some((*sequence, Some(*reason))),
        _ => None,
    });
    assert!(fates.eq([(0, None), (1, Some(DropReason::Down)), (2, None)]));
    Ok(())
}

/// A datagram that was sent while its receiver was down reaches it if it is up when the datagram arrives.
pub fn a_datagram_may_arrive_in_a_later_life<H: Host>() -> Outcome {
    let sender = Probe::new()
        .after(span(90), [Act::Send(ONE, 1)])
        .after(span(190), [Act::Send(ONE, 2)]);
    let mut host: H = start([sender, Probe::new()]);
    host.run_before(ms(100));
    host.crash(ONE);
    host.restart(ONE);
    host.run_before(ms(150));
    host.crash(ONE);
    host.run_before(ms(200));
    host.restart(ONE);
    host.run_before(ms(400));
    let log = Log::of(&host);
    let heard = [
        Cue::Start,
        Cue::Start,
        Cue::Message(1),
        Cue::Start,
        Cue::Message(2),
    ];
    log.check_heard(ONE, &heard);
    log.check_times(ONE, Cue::Message(2), &[ms(210)]);
    Ok(())
}
