//! One robot's turn in a step: its node is called for all that happens to it, in the order of time.

use super::inbox::Delivery;
use super::mind::{Frozen, Senses};
use super::outlet::Desk;
use super::sense::Readings;
use super::shared::Window;
use super::{discover, position};
use starl_core::{Event, Input, Message, Payload, Sensors, Time};
use starl_host::{Happening, Node, Outlet, Snapshot};

/// All that one robot's turn touches.
pub struct Turn<'a> {
    pub window: Window,
    pub node: &'a mut Node,
    pub next_estimate: &'a mut Time,
    pub senses: &'a mut Senses,
    pub readings: &'a mut Readings,
    /// Whether `readings` are this robot's.
    pub sensed: bool,
    pub desk: Desk<'a>,
}

impl Turn<'_> {
    /// Takes all that happens in this step. `arrivals` is room for work.
    pub fn run(&mut self, arrivals: &mut Vec<Delivery>) {
        if self.window.from == Time::ZERO {
            let pose = self.desk.state.pose;
            self.desk.record(Time::ZERO, Event::Moved(pose));
        }
        self.desk.shared.inboxes.of(self.node.id(), arrivals);
        if !self.node.condition().down {
            self.begin();
        }
        self.take_in_order(arrivals);
    }

    /// What comes before anything else: the start, paths that planners have found, and readings.
    fn begin(&mut self) {
        let mut from = self.window.from;
        if !self.node.condition().started {
            from = from.max(self.node.next_timeout());
            self.locate(from);
            self.handle(from, Happening::Start);
        }
        for (job, path) in std::mem::take(&mut self.desk.account.plans) {
            self.handle(from, Happening::Planned { job, path });
        }
        if self.node.next_activation() < self.window.to {
            self.sense();
            self.sensed = true;
        }
    }

    /// What happens, by time; at equal times estimates come before messages, then orders, then what the
    /// node waits for.
    fn take_in_order(&mut self, arrivals: &[Delivery]) {
        let is_down = self.node.condition().down;
        let mut arrivals = arrivals.iter().peekable();
        loop {
            let estimate = if is_down {
                Time::NEVER
            } else {
                *self.next_estimate
            };
            let message = arrivals.peek().map_or(Time::NEVER, |delivery| delivery.at);
            let order = self.desk.account.orders.first();
            let order = order.map_or(Time::NEVER, |order| order.0);
            let at = estimate
                .min(message)
                .min(order)
                .min(self.node.next_timeout());
            if at >= self.window.to {
                return;
            }
            if at == estimate {
                *self.next_estimate += self.desk.shared.scenario.positioning.period;
                self.locate(at);
                self.handle(at, Happening::Located);
            } else if at == message {
                if let Some(delivery) = arrivals.next() {
                    self.receive(delivery);
                }
            } else if at == order {
                let (_, order) = self.desk.account.orders.remove(0);
                self.handle(at, Happening::Input(Input::Order(order)));
            } else {
                self.handle(at, Happening::Timeout);
            }
        }
    }

    /// Takes a new position estimate, and meets hidden obstacles.
    fn locate(&mut self, at: Time) {
        if self.senses.are_frozen {
            return;
        }
        let Desk { shared, state, .. } = self.desk;
        let estimate = position::estimate(shared, self.node.id(), state, self.window.from, at);
        self.node.locate(at, estimate, &mut self.desk);
        if !shared.hidden.is_empty() {
            let range = self.desk.kind.sensors.discovery_range;
            let found = discover::discover(shared, self.node.id(), state, range, self.senses);
            for obstacle in found {
                self.desk.record(at, Event::Discovered(obstacle));
            }
        }
    }

    /// Reads the sensors that the robot carries.
    fn sense(&mut self) {
        let Desk {
            shared,
            state,
            kind,
            robot,
            ..
        } = self.desk;
        let readings = &mut *self.readings;
        if let Some(frozen) = &self.senses.frozen {
            readings.clear();
            readings.proximity.extend_from_slice(&frozen.proximity);
            readings.detections.extend_from_slice(&frozen.detections);
            return;
        }
        match &kind.sensors.proximity {
            Some(sensor) => readings.measure(shared, robot, &state.pose, sensor),
            None => readings.clear(),
        }
        match &kind.sensors.detector {
            Some(sensor) => readings.detect(shared, robot, sensor),
            None => readings.detections.clear(),
        }
        if self.senses.are_frozen {
            self.senses.frozen = Some(Box::new(Frozen {
                bumper: self.senses.contact,
                proximity: readings.proximity.clone(),
                detections: readings.detections.clone(),
            }));
        }
    }

    fn receive(&mut self, delivery: &Delivery) {
        let transmission = self.desk.shared.inboxes.transmission(delivery);
        let message = Message {
            from: transmission.from,
            port: transmission.port,
            payload: Payload::from_slice(&transmission.payload),
        };
        let sequence = transmission.sequence;
        self.handle(delivery.at, Happening::Datagram { sequence, message });
    }

    fn handle(&mut self, at: Time, happening: Happening) {
        let Desk { shared, kind, .. } = self.desk;
        let mut sensors = Sensors {
            bumper: match &self.senses.frozen {
                Some(frozen) => frozen.bumper,
                None => self.senses.contact.filter(|_| kind.sensors.bumper),
            },
            holding: self.senses.holding,
            thing_names: &shared.things.names,
            ..Sensors::default()
        };
        if self.sensed {
            sensors.proximity = &self.readings.proximity;
            sensors.detections = &self.readings.detections;
        }
        let snapshot = Snapshot {
            hardware: &kind.hardware,
            sensors,
            fleet: &shared.fleet,
            way_points: &shared.way_points,
            obstacles: match &self.senses.knowledge {
                Some(knowledge) => &knowledge.obstacles,
                None => &shared.known,
            },
        };
        self.node.handle(at, happening, &snapshot, &mut self.desk);
    }
}
