//! When things happen, and in which order.

use super::{
    Act, Cue, Fleet, Host, Log, Need, ONE, Outcome, PERIOD, Probe, ZERO, ms, need, span, start,
};
use crate::Clock;
use alloc::format;
use alloc::string::String;
use alloc::vec;
use alloc::vec::Vec;
use starl_core::Duration;

/// Inputs due at one moment happen in this order: start, path, estimate, datagrams, timers, activation.
pub fn things_due_at_once_happen_in_order<H: Host>() -> Outcome {
    need::<H>(Need::Order)?;
    need::<H>(Need::Paths)?;
    let sender = Probe::new().after(span(180), [Act::Send(ONE, 1), Act::Send(ONE, 2)]);
    let robot = Probe::new()
        .after(span(190), [Act::Plan(5)])
        .on(Cue::Start, [Act::Arm(1, span(200)), Act::Arm(2, span(200))]);
    let mut host: H = start([sender, robot]);
    host.run_before(ms(250));
    let told = Log::of(&host).told(ONE);
    assert!(told[0].is(Cue::Start), "{told:?}");
    let moment = told.iter().filter(|told| told.at == ms(200));
    let moment: Vec<&str> = moment.map(|told| &*told.what).collect();
    let wanted = [
        Cue::Path(5),
        Cue::Located,
        Cue::Message(1),
        Cue::Message(2),
        Cue::Timer(1),
        Cue::Timer(2),
        Cue::Activate,
    ];
    let wanted: Vec<String> = wanted.iter().map(|cue| format!("{cue:?}")).collect();
    assert_eq!(moment, wanted);
    Ok(())
}

/// Arming a timer that is armed moves it; a timer that is cancelled does not fire; one that has fired is removed.
pub fn timers_are_moved_and_cancelled<H: Host>() -> Outcome {
    let arm = |timer, millis| Act::Arm(timer, span(millis));
    let robot = Probe::new()
        .on(
            Cue::Start,
            [
                arm(1, 300),
                arm(2, 200),
                arm(3, 200),
                arm(4, 100),
                arm(5, 400),
            ],
        )
        .on(
            Cue::Timer(4),
            [arm(1, 400), Act::Cancel(2), Act::Cancel(9), arm(5, 50)],
        );
    let mut host: H = start([robot]);
    host.run_before(ms(900));
    let log = Log::of(&host);
    for (timer, wanted) in [
        (1, vec![ms(500)]),
        (2, vec![]),
        (3, vec![ms(200)]),
        (4, vec![ms(100)]),
        (5, vec![ms(150)]),
    ] {
        log.check_times(ZERO, Cue::Timer(timer), &wanted);
    }
    Ok(())
}

/// The order in which timers were armed does not matter.
pub fn timers_due_at_once_fire_in_the_order_of_their_keys<H: Host>() -> Outcome {
    need::<H>(Need::Order)?;
    let timers = [3, 1, 4, 2].map(|timer| Act::Arm(timer, span(130)));
    let mut host: H = start([Probe::new().on(Cue::Start, timers)]);
    host.run_before(ms(200));
    let timers = [1, 2, 3, 4].map(Cue::Timer);
    Log::of(&host).check_heard(ZERO, &[&[Cue::Start][..], &timers].concat());
    Ok(())
}

/// A timer with zero delay fires after a millisecond, so that no program can stop time.
pub fn the_shortest_timer_takes_a_millisecond<H: Host>() -> Outcome {
    need::<H>(Need::Milliseconds)?;
    let arm = |timer| [Act::Arm(timer, Duration::ZERO)];
    let mut robot = Probe::new().on(Cue::Start, arm(1));
    for timer in 1..9 {
        robot = robot.on(Cue::Timer(timer), arm(timer + 1));
    }
    let mut host: H = start([robot]);
    host.run_before(ms(20));
    let log = Log::of(&host);
    for timer in 1..10 {
        log.check_times(ZERO, Cue::Timer(timer), &[ms(timer.into())]);
    }
    Ok(())
}

/// A robot knows only its own clock, which has an offset and another rate. Its inputs and timers use that clock;
/// activations use the host's.
pub fn clocks_run_wrong<H: Host>() -> Outcome {
    need::<H>(Need::Clocks)?;
    let robot = Probe::new().on(Cue::Start, [Act::Arm(1, span(10_000))]);
    let clock = Clock {
        offset: 3_600_000_000_000,
        rate: 1.05,
    };
    let mut host = H::start(Fleet {
        robots: vec![robot.clone(), robot],
        clock,
        has_storage: false,
    });
    host.run_before(ms(12_000));
    let log = Log::of(&host);
    for id in [ZERO, ONE] {
        let activations: Vec<_> = (0..120).map(|count| ms(0) + PERIOD * count).collect();
        log.check_times(id, Cue::Activate, &activations);
        let told = log.told(id);
        let first = &told[0];
        assert!(first.now.0 > 1_000_000, "{first:?}");
        let own = |index: usize| told[index].now.since(first.now).0 as f64;
        let last = told.len() - 1;
        let rate = own(last) / told[last].at.since(first.at).0 as f64;
        assert!(
            (rate - 1.0).abs() > 1e-4 && (rate - 1.0).abs() < 0.051,
            "{rate}"
        );
        for (index, told) in told.iter().enumerate() {
            let error = own(index) - rate * told.at.since(first.at).0 as f64;
            assert!(error.abs() < 1000.0, "{told:?}");
        }
        let timer = told.iter().position(|told| told.is(Cue::Timer(1)));
        let fired = timer.map_or(0.0, own);
        let late = host.lateness().0 as f64 * rate;
        assert!(fired > 10e9 - 1e3 && fired < 10e9 + late + 1e3, "{fired}");
    }
    Ok(())
}

/// A host that is late passes on all timers, and one activation for those that it missed.
pub fn a_late_host_activates_once<H: Host>() -> Outcome {
    need::<H>(Need::Stalls)?;
    let robot = Probe::new().on(Cue::Start, [Act::Arm(1, span(260)), Act::Arm(2, span(410))]);
    let mut host: H = start([robot]);
    host.run_before(ms(150));
    host.stall(ms(550));
    host.run_before(ms(800));
    let log = Log::of(&host);
    let activations = [0, 100, 550, 650, 750].map(ms);
    log.check_times(ZERO, Cue::Activate, &activations);
    log.check_times(ZERO, Cue::Timer(1), &[ms(550)]);
    log.check_times(ZERO, Cue::Timer(2), &[ms(550)]);
    Ok(())
}
