//! Parts that every diagram has.

use super::story::Story;
use super::*;
use starl_core::event::{DropReason, Fault, MutexEvent};
use starl_core::{Destination, Event, Payload, Port, Record, RobotId};
use starl_sim::Scenario;

const PORT: Port = Port::named("lock");

struct Teller(Story);

impl Teller {
    fn tell(&mut self, millis: u64, robot: Option<u32>, event: Event) -> &mut Teller {
        self.0.observe(&Record {
            at: Time::ZERO + Duration::from_millis(millis),
            robot: robot.map(RobotId),
            event,
        });
        self
    }

    fn sent(&mut self, millis: u64, robot: u32, sequence: u32) -> &mut Teller {
        let event = Event::Sent {
            sequence,
            destination: Destination::All,
            port: PORT,
            payload: Payload::new(),
        };
        self.tell(millis, Some(robot), event)
    }

    fn dropped(&mut self, millis: u64, to: u32, reason: DropReason) -> &mut Teller {
        let event = Event::Dropped {
            from: RobotId(0),
            to: Some(RobotId(to)),
            sequence: 0,
            reason,
        };
        self.tell(millis, Some(0), event)
    }
}

fn story() -> Teller {
    let mut teller = Teller(Story::of(&Scenario::default()));
    teller.0.robots = ["a", "b", "c"].map(str::to_string).to_vec();
    let delivered = |sequence| Event::Delivered {
        from: RobotId(0),
        sequence,
    };
    let resource = "door".into();
    let acquire = Event::Primitive {
        port: PORT,
        event: MutexEvent::Acquire { resource }.into(),
    };
    teller
        .tell(10, Some(0), acquire)
        .sent(10, 0, 0)
        .dropped(10, 2, DropReason::Loss)
        .tell(30, Some(1), delivered(0))
        .tell(500, Some(2), Event::Fault(Fault::Crash))
        .tell(900, Some(2), Event::Fault(Fault::Restart))
        .tell(1000, None, Event::Fault(Fault::Partition))
        .tell(2000, None, Event::Fault(Fault::Heal));
    teller
}

fn svg(story: &Story, extent: &Extent) -> String {
    let diagram = Diagram(scene::draw(story, extent));
    String::from_utf8(diagram.svg()).expect("SVG is text")
}

#[test]
fn everything_that_happened_is_on_it() {
    let mut teller = story();
    let violated = Event::Violated {
        property: "mutex.safety".into(),
        text: "a and b both hold <door>".into(),
    };
    teller.tell(2500, Some(1), violated);
    let text = svg(&teller.0, &Extent::default());
    for shown in [
        ">acquire door<",
        ">crash<",
        ">restart<",
        ">network partitioned<",
        ">mutex<",
        "mutex.safety: a and b both hold &lt;door&gt;",
        ">2.5000 s<",
    ] {
        assert!(text.contains(shown), "{shown} is missing in\n{text}");
    }
    assert!(text.contains("stroke-dasharray"), "no message is lost");
}

#[test]
fn only_the_last_part_is_shown_if_that_is_asked_for() {
    let teller = story();
    let extent = Extent {
        last: Some(Duration::from_millis(600)),
        until: Some(Time::ZERO + Duration::from_millis(1000)),
    };
    let text = svg(&teller.0, &extent);
    assert!(!text.contains(">acquire door<"), "{text}");
    assert!(text.contains(">crash<"), "{text}");
    assert!(text.contains("from 0.400 s to 1.000 s"), "{text}");
}

#[test]
fn the_drawing_ends_at_the_first_violation() {
    let mut teller = story();
    let extent = Extent::default();
    assert!(!teller.0.is_past(&extent));
    let violated = Event::Violated {
        property: "p".into(),
        text: "t".into(),
    };
    teller.tell(2500, None, violated);
    assert!(
        !teller.0.is_past(&extent),
        "others of the same time may come"
    );
    teller.tell(2525, Some(0), Event::Finished);
    assert!(teller.0.is_past(&extent));
}

#[test]
fn a_run_in_which_nothing_happens_can_be_drawn() {
    let story = Story::of(&Scenario::default());
    assert!(svg(&story, &Extent::default()).contains("</svg>"));
}

#[test]
fn a_busy_run_is_drawn_from_where_it_is_easy_to_read() {
    let mut teller = story();
    for millis in 0..5000 {
        teller.tell(3000 + millis, Some(0), Event::Action("step".into()));
    }
    let drawing = scene::draw(&teller.0, &Extent::default());
    assert!(drawing.size.0 < 4000.0, "{:?}", drawing.size);
}
