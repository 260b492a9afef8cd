//! Packets that a channel opens, and packets that it rejects.

use super::*;

const KEY: Key = [7; 32];

fn member(id: Member, key: Key) -> Channel {
    Channel::new(id, "race", vec![key])
}

/// Carries packets between two members until none is left; gives what was refused.
fn connect(a: &mut Channel, b: &mut Channel, now: Time) -> Vec<Refusal> {
    a.want(b.me);
    let mut refused = Vec::new();
    for (to, packet) in a.due(now) {
        assert_eq!(to, b.me);
        match b.open(now, &packet) {
            Opened::Handshake {
                answer: Some(answer),
                ..
            } => {
                if let Opened::Refused(refusal) = a.open(now, &answer) {
                    refused.push(refusal);
                }
            }
            Opened::Refused(refusal) => refused.push(refusal),
            other => panic!("{other:?}"),
        }
    }
    refused
}

fn pair() -> (Channel, Channel) {
    let (mut a, mut b) = (member(0, KEY), member(1, KEY));
    assert_eq!(connect(&mut a, &mut b, Time::ZERO), []);
    let hello = a.seal(1, b"hello").unwrap();
    assert!(matches!(
        b.open(Time::ZERO, &hello),
        Opened::Content { from: 0, .. }
    ));
    (a, b)
}

#[test]
fn members_with_the_same_key_hear_each_other() {
    let (mut a, mut b) = pair();
    for round in 0..2000u32 {
        let packet = b.seal(0, &round.to_le_bytes()).unwrap();
        let content = round.to_le_bytes().to_vec();
        assert_eq!(
            a.open(Time::ZERO, &packet),
            Opened::Content { from: 1, content }
        );
    }
    assert_eq!(a.refusals().total() + b.refusals().total(), 0);
}

#[test]
fn a_stranger_is_refused() {
    let (mut a, mut b) = (member(0, [1; 32]), member(1, KEY));
    assert_eq!(connect(&mut a, &mut b, Time::ZERO), [Refusal::NotAuthentic]);
    assert_eq!(a.seal(1, b"hello"), None);
}

#[test]
fn a_member_of_another_fleet_with_the_same_key_is_refused() {
    let (mut a, mut b) = (member(0, KEY), Channel::new(1, "search", vec![KEY]));
    assert_eq!(connect(&mut a, &mut b, Time::ZERO), [Refusal::NotAuthentic]);
}

#[test]
fn a_packet_is_taken_once() {
    let (mut a, mut b) = pair();
    let packet = a.seal(1, b"move").unwrap();
    assert!(matches!(
        b.open(Time::ZERO, &packet),
        Opened::Content { .. }
    ));
    assert_eq!(
        b.open(Time::ZERO, &packet),
        Opened::Refused(Refusal::Replayed)
    );
    assert_eq!(b.refusals().replayed, 1);
}

#[test]
fn a_packet_that_was_changed_anywhere_is_refused() {
    let (mut a, mut b) = pair();
    let packet = a.seal(1, b"move").unwrap();
    for place in 0..packet.len() {
        for bit in 0..8 {
            let mut changed = packet.clone();
            changed[place] ^= 1 << bit;
            assert!(
                matches!(b.open(Time::ZERO, &changed), Opened::Refused(_)),
                "{place}"
            );
        }
    }
    for length in 0..packet.len() {
        assert!(matches!(
            b.open(Time::ZERO, &packet[..length]),
            Opened::Refused(_)
        ));
    }
    assert!(matches!(
        b.open(Time::ZERO, &packet),
        Opened::Content { .. }
    ));
}

#[test]
fn packets_of_an_earlier_life_are_refused() {
    let (mut a, b) = pair();
    let old = a.seal(1, b"move").unwrap();
    drop(b);
    let mut b = member(1, KEY);
    assert_eq!(
        b.open(Time::ZERO, &old),
        Opened::Refused(Refusal::UnknownSession)
    );
    // The robot that has restarted begins a session, and both hear each other again.
    assert_eq!(connect(&mut b, &mut a, Time::ZERO), []);
    let packet = b.seal(0, b"here").unwrap();
    assert!(matches!(
        a.open(Time::ZERO, &packet),
        Opened::Content { .. }
    ));
    let packet = a.seal(1, b"there").unwrap();
    assert!(matches!(
        b.open(Time::ZERO, &packet),
        Opened::Content { .. }
    ));
    assert!(matches!(b.open(Time::ZERO, &old), Opened::Refused(_)));
}

#[test]
fn a_repeated_initiation_ends_no_session() {
    let (mut a, mut b) = (member(0, KEY), member(1, KEY));
    a.want(1);
    let (_, initiation) = a.due(Time::ZERO).remove(0);
    let Opened::Handshake { answer, .. } = b.open(Time::ZERO, &initiation) else {
        panic!();
    };
    a.open(Time::ZERO, &answer.unwrap());
    let hello = a.seal(1, b"hello").unwrap();
    b.open(Time::ZERO, &hello);
    for _ in 0..100 {
        assert!(matches!(
            b.open(Time::ZERO, &initiation),
            Opened::Handshake { .. }
        ));
    }
    assert!(b.sessions.len() <= 2);
    let packet = b.seal(0, b"still here").unwrap();
    assert!(matches!(
        a.open(Time::ZERO, &packet),
        Opened::Content { .. }
    ));
}

#[test]
fn an_initiation_that_is_sent_again_gets_the_same_answer() {
    let at = |ms| Time::ZERO + Duration::from_millis(ms);
    let (mut a, mut b) = (member(0, KEY), member(1, KEY));
    a.want(1);
    let mut answers = Vec::new();
    for ms in [0, 300] {
        for (_, packet) in a.due(at(ms)) {
            answers.push(b.open(at(ms), &packet));
        }
    }
    assert_eq!(answers.len(), 2);
    assert_eq!(answers[0], answers[1]);
    let Opened::Handshake {
        answer: Some(answer),
        ..
    } = &answers[0]
    else {
        panic!("{answers:?}");
    };
    assert_eq!(
        a.open(at(400), answer),
        Opened::Handshake {
            from: 1,
            answer: None
        }
    );
    // The second answer is late, and changes nothing.
    assert_eq!(
        a.open(at(500), answer),
        Opened::Refused(Refusal::UnknownSession)
    );
    let hello = a.seal(1, b"hello").expect("there is a session");
    assert!(matches!(
        b.open(at(500), &hello),
        Opened::Content { from: 0, .. }
    ));
}

#[test]
fn a_member_does_not_begin_a_session_while_another_one_begins_it() {
    let at = |ms| Time::ZERO + Duration::from_millis(ms);
    let (mut a, mut b) = (member(0, KEY), member(1, KEY));
    b.want(0);
    // The answer is on its way.
    a.want(1);
    for (_, packet) in a.due(at(0)) {
        b.open(at(0), &packet);
    }
    assert_eq!(b.due(at(200)), []);
    assert_eq!(b.due(at(300)).len(), 1, "the answer was lost");
}

/// Members that have both begun a session before either heard of the other's, so that each sends in its own.
fn pair_that_began_at_once() -> (Channel, Channel) {
    let (mut a, mut b) = (member(0, KEY), member(1, KEY));
    a.want(1);
    b.want(0);
    let (from_a, from_b) = (a.due(Time::ZERO), b.due(Time::ZERO));
    let answer = |end: &mut Channel, packet: &[u8]| match end.open(Time::ZERO, packet) {
        Opened::Handshake { answer, .. } => answer.unwrap(),
        other => panic!("{other:?}"),
    };
    let (to_a, to_b) = (answer(&mut b, &from_a[0].1), answer(&mut a, &from_b[0].1));
    a.open(Time::ZERO, &to_a);
    b.open(Time::ZERO, &to_b);
    (a, b)
}

/// Each sends something once a second for so many seconds, and gets everything that the other has sent.
fn talk(a: &mut Channel, b: &mut Channel, seconds: u64) {
    for second in 0..seconds {
        let now = Time::ZERO + Duration::from_millis(1000 * second);
        // Both are on their way while a session is begun.
        let (to_a, to_b) = (b.seal(0, b"b").unwrap(), a.seal(1, b"a").unwrap());
        connect(a, b, now);
        connect(b, a, now);
        for (end, packet) in [(&mut *a, to_a), (&mut *b, to_b)] {
            let opened = end.open(now, &packet);
            assert!(
                matches!(opened, Opened::Content { .. }),
                "{second} s: {opened:?}"
            );
        }
    }
    assert_eq!(a.refusals().total() + b.refusals().total(), 0);
}

#[test]
fn members_that_began_sessions_at_once_need_no_further_ones() {
    let (mut a, mut b) = pair_that_began_at_once();
    let sessions = a.sessions.len() + b.sessions.len();
    talk(&mut a, &mut b, 100);
    assert_eq!(a.sessions.len() + b.sessions.len(), sessions);
}

#[test]
fn nothing_is_lost_while_a_session_is_renewed() {
    let (mut a, mut b) = pair_that_began_at_once();
    talk(&mut a, &mut b, 2000);
}

#[test]
fn a_silent_session_is_used_until_another_one_takes_its_place() {
    let (mut a, mut b) = pair();
    let at = |ms| Time::ZERO + Duration::from_millis(ms);
    assert_eq!(
        a.due(at(10_000)),
        [],
        "members may say nothing for some seconds"
    );
    assert_eq!(a.due(at(16_000)).len(), 1);
    let hello = a.seal(1, b"hello").expect("there is a session");
    assert!(matches!(
        b.open(at(16_000), &hello),
        Opened::Content { from: 0, .. }
    ));
}

#[test]
fn an_operator_begins_a_session_with_a_robot_that_has_restarted() {
    let at = |ms| Time::ZERO + Duration::from_millis(ms);
    let (mut operator, mut robot) = (member(OPERATORS, KEY), member(0, KEY));
    assert_eq!(connect(&mut operator, &mut robot, at(0)), []);
    // The robot does not know the operator any more.
    let mut robot = member(0, KEY);
    assert_eq!(connect(&mut operator, &mut robot, at(2100)), []);
    let hello = operator.seal(0, b"hello").expect("there is a session");
    assert!(matches!(
        robot.open(at(2100), &hello),
        Opened::Content { .. }
    ));
}

#[test]
fn operators_that_have_gone_are_forgotten() {
    let at = |ms| Time::ZERO + Duration::from_millis(ms);
    let mut robot = member(0, KEY);
    robot.want(1);
    for guest in 0..100u32 {
        let mut operator = member(OPERATORS + guest, KEY);
        let now = at(60_000 * u64::from(guest));
        assert_eq!(connect(&mut operator, &mut robot, now), []);
        let hello = operator.seal(0, b"hello").expect("there is a session");
        assert!(matches!(robot.open(now, &hello), Opened::Content { .. }));
        robot.due(now);
    }
    // Those of the last ten minutes, and the other robot.
    assert_eq!((robot.peers.len(), robot.sessions.len()), (11, 10));
}

#[test]
fn a_key_is_changed_while_the_fleet_runs() {
    let (mut a, mut b) = pair();
    let new = [9; 32];
    b.set_keys(vec![new, KEY]);
    a.set_keys(vec![new, KEY]);
    let later = Time::ZERO + RENEWAL;
    assert_eq!(connect(&mut a, &mut b, later), []);
    let packet = a.seal(1, b"new").unwrap();
    assert!(matches!(b.open(later, &packet), Opened::Content { .. }));
    b.set_keys(vec![new]);
    a.set_keys(vec![new]);
    assert_eq!(connect(&mut a, &mut b, later + RENEWAL), []);
}

#[test]
fn a_member_with_both_keys_begins_sessions_with_members_that_have_one_of_them() {
    let new = [9; 32];
    for theirs in [KEY, new] {
        let (mut a, mut b) = (Channel::new(0, "race", vec![new, KEY]), member(1, theirs));
        let mut now = Time::ZERO;
        while a.seal(1, b"hello").is_none() {
            connect(&mut a, &mut b, now);
            now += PATIENCE;
            assert!(now < Time::ZERO + PATIENCE * 4, "no session");
        }
        let hello = a.seal(1, b"hello").unwrap();
        assert!(matches!(b.open(now, &hello), Opened::Content { .. }));
    }
}

#[test]
fn a_handshake_ends_where_packets_take_long() {
    let (mut a, mut b) = (member(0, KEY), member(1, KEY));
    a.want(1);
    let delay = Duration::from_millis(700);
    // The packets in flight: the time of arrival, whether at `b`, and the packet.
    let mut flying: Vec<(Time, bool, Vec<u8>)> = Vec::new();
    for tick in 0..100 {
        let now = Time::ZERO + Duration::from_millis(100 * tick);
        let initiations = a.due(now).into_iter();
        flying.extend(initiations.map(|(_, packet)| (now + delay, true, packet)));
        let (due, rest) = flying.into_iter().partition(|packet| packet.0 <= now);
        flying = rest;
        let due: Vec<(Time, bool, Vec<u8>)> = due;
        for (_, at_b, packet) in due {
            let end = if at_b { &mut b } else { &mut a };
            if let Opened::Handshake {
                answer: Some(answer),
                ..
            } = end.open(now, &packet)
            {
                flying.push((now + delay, !at_b, answer));
            }
        }
        if a.seal(1, b"hello").is_some() {
            return;
        }
    }
    panic!("there is no session after ten seconds");
}

#[test]
fn garbage_changes_nothing() {
    let (mut a, mut b) = pair();
    let mut state = 1u64;
    for _ in 0..50_000 {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1);
        let length = (state >> 40) as usize % 200;
        let garbage: Vec<u8> = (0..length)
            .map(|i| (state >> (i % 50)) as u8 ^ i as u8)
            .collect();
        assert!(matches!(b.open(Time::ZERO, &garbage), Opened::Refused(_)));
    }
    let packet = a.seal(1, b"move").unwrap();
    assert!(matches!(
        b.open(Time::ZERO, &packet),
        Opened::Content { .. }
    ));
}
