//! How long a message takes from one process's send to the handler of a robot's program, over UDP on this machine, and
//! how long a bare socket takes for the same packet.
//!
//! `cargo bench -p starl-node --bench latency`

use starl_core::motion::{Body, Workspace};
use starl_core::{
    Duration, Message, Payload, Port, Pose, Primitive, Primitives, Program, Random,
    Robot as Handle, RobotId,
};
use starl_host::{Hardware, Observed};
use starl_motion::sensing::SensorSuite;
use starl_node::link::channel::Opened;
use starl_node::link::frame::Frame;
use starl_node::link::udp::Udp;
use starl_node::link::{Arrival, Channel, Transport};
use starl_node::localise::Accuracy;
use starl_node::robot::{Connections, Incoming, Recorder, Robot, Setup, mailbox};
use starl_node::simulated::SimulatedBody;
use starl_node::{Safety, WallClock};
use std::collections::BTreeMap;
use std::net::{SocketAddr, UdpSocket};
use std::sync::mpsc::{self, Receiver, Sender};
use std::thread;
use std::time::{Duration as Span, Instant};

const ROUNDS: u32 = 20_000;
const PAUSE: Span = Span::from_micros(300);
const KEY: [u8; 32] = [3; 32];

/// Tells when its handler was called.
#[derive(Clone)]
struct Witness {
    handled: Sender<Instant>,
}

impl Primitives for Witness {
    fn primitives(&mut self, _: &mut dyn FnMut(&mut dyn Primitive)) {}
}

impl Program for Witness {
    fn activate(&mut self, _: &mut Handle<'_>) {}

    fn receive(&mut self, _: &mut Handle<'_>, _: &Message) {
        let _ = self.handled.send(Instant::now());
    }
}

/// Keeps nothing.
struct Silent;

impl Recorder for Silent {
    fn record(&mut self, _: starl_core::Time, _: starl_core::Event) {}
    fn observe(&mut self, _: starl_core::Time, _: Observed<'_>) {}
    fn advance(&mut self, _: starl_core::Time) {}
    fn notice(&mut self, _: starl_core::Time, text: &str) {
        eprintln!("{text}");
    }
}

fn main() {
    report("bare socket", &mut bare());
    report("robot, plain packets", &mut robot(Vec::new()));
    report("robot, protected packets", &mut robot(vec![KEY]));
}

fn report(name: &str, delays: &mut [Span]) {
    delays.sort();
    let at = |part: f64| delays[((delays.len() - 1) as f64 * part) as usize].as_secs_f64() * 1e6;
    println!(
        "{name:<26} p50 {:7.1} us   p99 {:7.1} us   p99.9 {:7.1} us   ({} messages)",
        at(0.5),
        at(0.99),
        at(0.999),
        delays.len()
    );
}

/// A packet of the usual size from one thread to another.
fn bare() -> Vec<Span> {
    let receiver = UdpSocket::bind("127.0.0.1:0").expect("a port is free");
    let place = receiver.local_addr().expect("it is bound");
    let sender = UdpSocket::bind("127.0.0.1:0").expect("a port is free");
    let reader = thread::spawn(move || {
        let mut room = [0; 2000];
        let receive = |_| {
            let _ = receiver.recv(&mut room);
            Instant::now()
        };
        (0..ROUNDS).map(receive).collect::<Vec<Instant>>()
    });
    let mut sent = Vec::new();
    for _ in 0..ROUNDS {
        thread::sleep(PAUSE);
        sent.push(Instant::now());
        let _ = sender.send_to(&[7; 80], place);
    }
    let received = reader.join().expect("it does not panic");
    sent.into_iter()
        .zip(received)
        .map(|(sent, received)| received - sent)
        .collect()
}

/// The other member of the fleet: a channel and a socket.
struct Peer {
    channel: Channel,
    transport: Udp,
    inbox: Receiver<Arrival>,
    clock: WallClock,
}

impl Peer {
    fn send(&mut self, frame: &Frame) -> bool {
        let content = starl_core::message::encode(frame);
        let sealed = self.channel.seal(0, &content);
        sealed.is_some_and(|packet| self.transport.send(0, &packet).is_ok())
    }

    /// Takes what has arrived, so that there is a session.
    fn settle(&mut self) {
        for (member, packet) in self.channel.due(self.clock.now()) {
            let _ = self.transport.send(member, &packet);
        }
        while let Ok(arrival) = self.inbox.try_recv() {
            if let Opened::Handshake {
                from,
                answer: Some(answer),
            } = self.channel.open(self.clock.now(), &arrival.packet)
            {
                let _ = self.transport.send(from, &answer);
            }
        }
    }
}

fn robot(keys: Vec<[u8; 32]>) -> Vec<Span> {
    let clock = WallClock::since(WallClock::system());
    let free = || UdpSocket::bind("127.0.0.1:0").and_then(|socket| socket.local_addr());
    let places: BTreeMap<u32, SocketAddr> = (0..2)
        .map(|member| (member, free().expect("a port is free")))
        .collect();
    let (post, inbox) = mailbox();
    let (arrivals, halt) = (post.clone(), post.clone());
    let deliver = move |arrival| arrivals.send(Incoming::Packet(arrival)).is_ok();
    let transport = Udp::open(places[&0], places.clone(), deliver).expect("the port is free");
    let (sender, handled) = mpsc::channel();
    let model = starl_motion::models::by_name("create").expect("there is such a model");
    let body = SimulatedBody::new(model.clone(), Pose::default());
    let size = Body {
        radius: 0.1,
        height: 0.1,
        workspace: Workspace::Ground,
    };
    let setup = Setup {
        id: RobotId(0),
        bodies: vec![size; 2],
        program: Box::new(Witness { handled: sender }),
        random: Random::keyed(1, &[]),
        hardware: Hardware {
            body: size,
            control_period: Duration::from_millis(100),
            drive: None,
        },
        sensors: SensorSuite::default(),
        things: Vec::new(),
        way_points: Vec::new(),
        obstacles: Vec::new(),
        positioning_period: Duration::from_millis(50),
        accuracy: Accuracy::default(),
        start: Some(Pose::default()),
        safety: Safety::default(),
    };
    let connections = Connections {
        device: Box::new(body.device()),
        positions: Some(Box::new(body.positions(Duration::from_millis(50)))),
        storage: None,
        transport: Box::new(transport),
        channel: Channel::new(0, "bench", keys.clone()),
    };
    let robot = thread::spawn(move || {
        let robot = Robot::start(setup, connections, clock, (post, inbox), Silent);
        robot.expect("there are threads").run();
    });
    let (sender, inbox) = mpsc::channel();
    let deliver = move |arrival| sender.send(arrival).is_ok();
    let mut peer = Peer {
        channel: Channel::new(1, "bench", keys),
        transport: Udp::open(places[&1], places, deliver).expect("the port is free"),
        inbox,
        clock,
    };
    peer.channel.want(0);
    let frame = |sequence| Frame::Datagram {
        sequence,
        port: Port::PROGRAM,
        payload: Payload::from_slice(&[7; 40]),
    };
    // Until the robot has started and there is a session.
    while handled.try_recv().is_err() {
        peer.settle();
        peer.send(&frame(0));
        thread::sleep(Span::from_millis(5));
    }
    thread::sleep(Span::from_millis(100));
    while handled.try_recv().is_ok() {}
    let mut delays = Vec::new();
    for sequence in 0..ROUNDS {
        thread::sleep(PAUSE);
        peer.settle();
        let sent = Instant::now();
        if peer.send(&frame(sequence))
            && let Ok(at) = handled.recv_timeout(Span::from_secs(1))
        {
            delays.push(at - sent);
        }
    }
    let _ = halt.send(Incoming::Halt);
    let _ = robot.join();
    delays
}
