//! Events of primitives are typed in programs and by name in traces: neither way loses anything.

use starl_core::event::agreement::{Algorithm, ListId, Suspicion};
use starl_core::event::messaging::{LeaveReason, MessageNumber, Order};
use starl_core::event::moving::Trouble;
use starl_core::event::storing::{Operation, Written};
use starl_core::event::{
    BarrierEvent, BroadcastEvent, ElectionEvent, FailureDetectorEvent, Fault, Fields, GeocastEvent,
    MutexEvent, Name, PrimitiveEvent, ReachAvoidEvent, RegisterEvent, RegistrationEvent,
    SharedMemoryEvent, TransferEvent, UnicastEvent, Value,
};
use starl_core::{Area, Duration, Event, Obstacle, Point, Port, RobotId, Time, message};

fn fields(fields: &[(&'static str, Value)]) -> Fields {
    let named = |(name, value): &(&'static str, Value)| (Name::from(*name), value.clone());
    fields.iter().map(named).collect()
}

/// An event of each kind, with each field that may be left out both ways.
fn events() -> Vec<PrimitiveEvent> {
    let here = Point::new(0.1, 0.2, 0.3);
    let (peer, robots) = (RobotId(3), vec![RobotId(0), RobotId(3)]);
    let message = MessageNumber {
        number: 7,
        incarnation: u32::MAX,
    };
    let retry_span = Duration::from_millis(3300);
    let area = Area::Circle {
        center: here,
        radius: 2.0,
    };
    let resource = || "door".into();
    let written = || Written {
        variable: "x".into(),
        single_writer: true,
        time: Time(5),
        count: 2,
        writer: peer,
        incarnation: 9,
        value: i64::MIN,
    };
    let operation = || Operation {
        operation: 4,
        register: "r".into(),
    };
    let list = ListId {
        time: Time(8),
        coordinator: peer,
        incarnation: 2,
    };
    let transfers = [
        TransferEvent::Retransmit { message, to: peer },
        TransferEvent::Acknowledged {
            message,
            to: Some(peer),
        },
        TransferEvent::Acknowledged { message, to: None },
        TransferEvent::Fail {
            message,
            to: robots.clone(),
        },
        TransferEvent::Deliver {
            from: peer,
            message,
        },
    ];
    let mut events: Vec<PrimitiveEvent> = Vec::new();
    for transfer in transfers {
        events.push(UnicastEvent::from(transfer.clone()).into());
        events.push(BroadcastEvent::from(transfer.clone()).into());
        events.push(GeocastEvent::from(transfer).into());
    }
    let reason = Trouble::NoPath;
    events.extend([
        ReachAvoidEvent::Start {
            target: here,
            vicinity: 0.1,
            unsafe_set: [Obstacle::circle(here, 1.0)].into(),
        }
        .into(),
        ReachAvoidEvent::Path {
            path: vec![here, Point::ZERO],
        }
        .into(),
        ReachAvoidEvent::Replan { reason }.into(),
        ReachAvoidEvent::Done { position: here }.into(),
        ReachAvoidEvent::Failed { position: here }.into(),
        ReachAvoidEvent::GiveUp { reason }.into(),
        PrimitiveEvent::from(ReachAvoidEvent::Stop),
        UnicastEvent::Send {
            message,
            retry_span,
            to: peer,
        }
        .into(),
        GeocastEvent::Geocast {
            message,
            retry_span,
            area: Box::new(area.clone()),
        }
        .into(),
        GeocastEvent::Outside {
            from: peer,
            message,
        }
        .into(),
    ]);
    for order in [
        None,
        Some(Order::Fifo),
        Some(Order::Causal),
        Some(Order::Total),
    ] {
        let broadcast = BroadcastEvent::Broadcast {
            message,
            retry_span,
            order,
        };
        events.push(broadcast.into());
    }
    let from = peer;
    let broadcasts = [
        BroadcastEvent::Late { from, message },
        BroadcastEvent::PassOver { from, message },
        BroadcastEvent::Join { group: 2 },
        BroadcastEvent::Voter,
        BroadcastEvent::Leave {
            reason: LeaveReason::Obsolete,
        },
        BroadcastEvent::Lead { term: 3 },
        BroadcastEvent::Gap,
        BroadcastEvent::Unavailable,
        BroadcastEvent::Available,
    ];
    events.extend(broadcasts.map(PrimitiveEvent::from));
    let memories = [
        SharedMemoryEvent::Start,
        SharedMemoryEvent::Initialize {
            variable: "x".into(),
            single_writer: false,
            value: -1,
        },
        SharedMemoryEvent::Causal {
            variable: "x".into(),
        },
        SharedMemoryEvent::Write { written: written() },
        SharedMemoryEvent::WriteAgain { written: written() },
        SharedMemoryEvent::Update { written: written() },
    ];
    events.extend(memories.map(PrimitiveEvent::from));
    events.push(RegisterEvent::Up { life: 1 }.into());
    for value in [None, Some(5)] {
        let operation = operation();
        events.push(RegisterEvent::Done { operation, value }.into());
    }
    let registers = [
        RegisterEvent::Read {
            operation: operation(),
        },
        RegisterEvent::Write {
            operation: operation(),
            value: 1,
        },
        RegisterEvent::Claim {
            operation: operation(),
        },
        RegisterEvent::Update {
            operation: operation(),
            found: Some(1),
            value: 2,
        },
        RegisterEvent::Lost {
            operation: operation(),
            value: None,
        },
        RegisterEvent::Refused {
            operation: operation(),
            value: None,
        },
        RegisterEvent::Withdraw {
            operation: operation(),
        },
        RegisterEvent::NoQuorum {
            operation: operation(),
        },
    ];
    events.extend(registers.map(PrimitiveEvent::from));
    for area in [None, Some(Box::new(area))] {
        let apart = Duration(1);
        events.push(RegistrationEvent::Register { apart, area }.into());
    }
    let registrations = [
        RegistrationEvent::Unregister,
        RegistrationEvent::Propose {
            list,
            members: robots.clone(),
        },
        RegistrationEvent::Accept { list },
        RegistrationEvent::Agree {
            list,
            members: robots.clone(),
        },
        RegistrationEvent::Lose,
        RegistrationEvent::Fail,
    ];
    events.extend(registrations.map(PrimitiveEvent::from));
    for (epoch, ballot) in [(None, Some(u32::MAX)), (Some(u64::MAX), None)] {
        events.push(
            ElectionEvent::Leader {
                leader: peer,
                epoch,
                round: ballot.map(u64::from),
                ballot,
            }
            .into(),
        );
    }
    let elections = [
        ElectionEvent::Start {
            algorithm: Algorithm::Bully,
            participants: robots.clone(),
        },
        ElectionEvent::Elect,
        ElectionEvent::Resign,
        ElectionEvent::Vote { anew: true },
        ElectionEvent::Lost,
        ElectionEvent::Fail,
    ];
    events.extend(elections.map(PrimitiveEvent::from));
    for (fencing, drift) in [(None, None), (Some(3), Some(0.01))] {
        let enter = MutexEvent::Enter {
            resource: resource(),
            fencing,
            drift,
        };
        events.push(enter.into());
    }
    let mutexes = [
        MutexEvent::Acquire {
            resource: resource(),
        },
        MutexEvent::Withdraw {
            resource: resource(),
        },
        MutexEvent::Release {
            resource: resource(),
        },
        MutexEvent::Expire {
            resource: resource(),
        },
        MutexEvent::Ready {
            participants: 3,
            needed: 2,
            anew: true,
        },
    ];
    events.extend(mutexes.map(PrimitiveEvent::from));
    let barriers = [
        BarrierEvent::Arrive {
            participants: robots.clone(),
        },
        BarrierEvent::Wait { generation: 1 },
        BarrierEvent::Pass {
            generation: 1,
            participants: robots,
        },
    ];
    events.extend(barriers.map(PrimitiveEvent::from));
    let reason = Suspicion::Restart;
    events.push(FailureDetectorEvent::Suspect { peer, reason }.into());
    events.push(FailureDetectorEvent::Trust { peer }.into());
    events
}

#[test]
fn an_event_by_name_is_the_typed_event_again() {
    for event in events() {
        let owned = |(name, value): (&str, _)| (Name::from(name.to_string()), Value::from(value));
        let fields: Fields = event.fields().into_iter().map(owned).collect();
        let (primitive, name) = (event.primitive().to_string(), event.name().to_string());
        assert!(!matches!(event, PrimitiveEvent::Other(_)), "{event:?}");
        assert_eq!(PrimitiveEvent::named(primitive, name, fields), event);
    }
}

#[test]
fn encodings_are_of_names_and_values() {
    // The form that digests are of: an event's place among the kinds of events, primitive, port, name, fields.
    let named = (
        8u32,
        "mutex",
        Port(5),
        "enter",
        fields(&[
            ("resource", "door".into()),
            ("fencing", 3i64.into()),
            ("drift", 0.01.into()),
        ]),
    );
    let typed = Event::Primitive {
        port: Port(5),
        event: MutexEvent::Enter {
            resource: "door".into(),
            fencing: Some(3),
            drift: Some(0.01),
        }
        .into(),
    };
    assert_eq!(message::encode(&typed), message::encode(&named));
    let fault = Event::Fault(Fault::StuckMotor);
    assert_eq!(
        message::encode(&fault),
        message::encode(&(11u32, "stuck motor"))
    );
    for event in events() {
        let event = Event::Primitive {
            port: Port(5),
            event,
        };
        assert_eq!(message::decode(&message::encode(&event)), Some(event));
    }
}

#[test]
fn records_that_are_not_typed_events_stay_as_they_are() {
    let missing = fields(&[("resource", "door".into()), ("drift", "much".into())]);
    let more = fields(&[("resource", "door".into()), ("colour", "red".into())]);
    let other_order = fields(&[("to", RobotId(1).into()), ("number", 1u32.into())]);
    for (primitive, name, fields) in [
        ("mutex", "enter", missing),
        ("mutex", "acquire", more),
        ("mutex", "polish", Fields::new()),
        ("unicast", "retransmit", other_order),
        ("elevator", "start", Fields::new()),
    ] {
        let event = PrimitiveEvent::named(primitive, name, fields.clone());
        let PrimitiveEvent::Other(other) = &event else {
            panic!("{event:?}");
        };
        assert_eq!((&*other.primitive, &*other.name), (primitive, name));
        assert_eq!(other.fields, fields);
    }
}

#[test]
fn faults_have_the_names_of_traces() {
    for name in [
        "crash",
        "restart",
        "partition",
        "heal",
        "stuck motor",
        "frozen sensor",
        "repair",
        "corrupt state",
    ] {
        let fault = Fault::named(name.into());
        assert!(!matches!(fault, Fault::Other(_)), "{name}");
        assert_eq!(fault.name(), name);
    }
    let other = Fault::named("flat battery".into());
    assert_eq!(other, Fault::Other("flat battery".into()));
}

#[test]
fn events_are_small() {
    // Millions of them are made, copied and dropped in a run.
    assert!(size_of::<PrimitiveEvent>() <= 72);
    assert!(size_of::<Event>() <= 144);
}
