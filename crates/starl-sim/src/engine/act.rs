//! One robot's turn in a slot of time: its node handles the robot's inputs in the order of time.

use super::inbox::{Delivery, Transmission};
use super::outlet::SimulatorOutlet;
use super::shared::{Kind, Shared, Window};
use super::simulated_robot::{Account, Frozen, Senses, SimulatedRobot};
use super::{discover, position};
use starl_core::{Event, Input, Message, Payload, Sensors, Time};
use starl_host::{Node, NodeInput, Outlet, Snapshot};
use starl_motion::sensing::Readings;

/// The state used by one robot's turn.
pub struct Turn<'a> {
    /// The slot of time under way.
    pub window: Window,
    /// When the step began.
    pub step: Time,
    pub node: &'a mut Node,
    pub next_estimate: &'a mut Time,
    pub senses: &'a mut Senses,
    pub readings: &'a mut Readings,
    /// Whether `readings` are this robot's.
    pub sensed: bool,
    pub outlet: SimulatorOutlet<'a>,
}

impl Turn<'_> {
    /// Handles all inputs of this slot. `arrivals` is scratch memory.
    pub fn run(&mut self, arrivals: &mut Vec<Delivery>) {
        if self.window.from == Time::ZERO {
            let pose = self.outlet.state.pose;
            self.outlet.record(Time::ZERO, Event::Moved(pose));
        }
        self.outlet.shared.inboxes.of(self.node.id(), arrivals);
        if !self.node.condition().down {
            self.begin();
        }
        self.take_in_order(arrivals);
    }

    /// The first inputs: the start, paths that planners have found, and readings.
    fn begin(&mut self) {
        if !self.node.condition().started && self.node.next_timeout() < self.window.to {
            let from = self.window.from.max(self.node.next_timeout());
            self.locate(from);
            self.handle(from, NodeInput::Start);
        }
        if self.window.from == self.step && !self.outlet.account.plans.is_empty() {
            let from = self.step;
            for (job, path) in std::mem::take(&mut self.outlet.account.plans) {
                self.handle(from, NodeInput::Planned { job, path });
            }
        }
        if self.node.next_activation() < self.window.to {
            self.sense();
            self.sensed = true;
        }
    }

    /// The inputs by time. At equal times estimates come before completed writes, then messages, then
    /// orders, then the node's own timeouts.
    fn take_in_order(&mut self, mut arrivals: &[Delivery]) {
        let is_down = self.node.condition().down;
        loop {
            let estimate = if is_down {
                Time::NEVER
            } else {
                *self.next_estimate
            };
            let end = estimate.min(self.window.to);
            if due(self.node, self.outlet.account, arrivals).min() < end {
                self.take_until(end, &mut arrivals);
            }
            if estimate >= self.window.to {
                return;
            }
            *self.next_estimate += self.outlet.shared.scenario.positioning.period;
            self.locate(estimate);
            self.handle(estimate, NodeInput::Located);
        }
    }

    /// The inputs before `end`, while the robot senses nothing new.
    fn take_until(&mut self, end: Time, arrivals: &mut &[Delivery]) {
        let readings = self.sensed.then_some(&*self.readings);
        let snapshot = snapshot(self.outlet.shared, self.outlet.kind, self.senses, readings);
        loop {
            let due = due(self.node, self.outlet.account, arrivals);
            let at = due.min();
            if at >= end {
                return;
            }
            let happening = if at == due.stored {
                let store = self.outlet.account.store.as_mut();
                let Some(job) = store.and_then(|store| store.finish()) else {
                    return;
                };
                NodeInput::Stored { job }
            } else if at == due.message {
                let Some((delivery, rest)) = arrivals.split_first() else {
                    return;
                };
                *arrivals = rest;
                datagram(self.outlet.shared.inboxes.transmission(delivery))
            } else if at == due.order {
                let (_, order) = self.outlet.account.orders.remove(0);
                NodeInput::Input(Input::Order(order))
            } else {
                NodeInput::Timeout
            };
            self.node.handle(at, happening, &snapshot, &mut self.outlet);
        }
    }

    /// Takes a new position estimate, and meets hidden obstacles.
    fn locate(&mut self, at: Time) {
        if self.senses.are_frozen {
            return;
        }
        let SimulatorOutlet { shared, state, .. } = self.outlet;
        let estimate = position::estimate(shared, self.node.id(), state, self.step, at);
        self.node.locate(at, estimate, &mut self.outlet);
        if !shared.hidden.is_empty() {
            let range = self.outlet.kind.sensors.discovery_range;
            let found = discover::discover(shared, self.node.id(), range, self.senses);
            for obstacle in found {
                self.outlet.record(at, Event::Discovered(obstacle));
            }
        }
    }

    /// Reads the sensors that the robot carries.
    fn sense(&mut self) {
        let SimulatorOutlet {
            shared,
            state,
            kind,
            robot,
            ..
        } = self.outlet;
        let readings = &mut *self.readings;
        if let Some(frozen) = &self.senses.frozen {
            readings.clear();
            readings.proximity.extend_from_slice(&frozen.proximity);
            readings.detections.extend_from_slice(&frozen.detections);
            return;
        }
        let (scene, things) = (shared.scene(), shared.things.lying());
        readings.read(&kind.sensors, &scene, things, robot, state.pose.yaw);
        if self.senses.are_frozen {
            self.senses.frozen = Some(Box::new(Frozen {
                bumper: self.senses.contact,
                proximity: readings.proximity.clone(),
                detections: readings.detections.clone(),
            }));
        }
    }

    fn handle(&mut self, at: Time, happening: NodeInput) {
        let Turn { node, outlet, .. } = self;
        let readings = self.sensed.then_some(&*self.readings);
        let snapshot = snapshot(outlet.shared, outlet.kind, self.senses, readings);
        node.handle(at, happening, &snapshot, outlet);
    }
}

/// When the next of each is due.
struct Due {
    stored: Time,
    message: Time,
    order: Time,
    timeout: Time,
}

impl Due {
    fn min(&self) -> Time {
        let heard = self.message.min(self.order);
        self.stored.min(heard).min(self.timeout)
    }
}

impl SimulatedRobot {
    /// The time of its next input, without arrivals of datagrams. Finished plans reach it at `plans`.
    #[inline]
    pub fn next_due(&self, plans: Time) -> Time {
        if self.is_gone {
            return Time::NEVER;
        }
        let account = &self.account;
        let next = due(&self.node, account, &[]).min();
        let plans = if account.plans.is_empty() {
            Time::NEVER
        } else {
            plans
        };
        let estimate = match self.node.condition().down {
            true => Time::NEVER,
            false => self.next_estimate,
        };
        next.min(plans).min(estimate)
    }
}

#[inline]
fn due(node: &Node, account: &Account, arrivals: &[Delivery]) -> Due {
    let order = account.orders.first();
    let store = account.store.as_ref();
    Due {
        stored: store.map_or(Time::NEVER, |store| store.due()),
        message: arrivals.first().map_or(Time::NEVER, |delivery| delivery.at),
        order: order.map_or(Time::NEVER, |order| order.0),
        timeout: node.next_timeout(),
    }
}

fn datagram(transmission: &Transmission) -> NodeInput {
    NodeInput::Datagram {
        sequence: transmission.sequence,
        message: Message {
            from: transmission.from,
            port: transmission.port,
            payload: Payload::from_slice(&transmission.payload),
        },
    }
}

/// The robot's current knowledge; without readings it has only that of its bumper.
pub fn snapshot<'a>(
    shared: &'a Shared,
    kind: &'a Kind,
    senses: &'a Senses,
    readings: Option<&'a Readings>,
) -> Snapshot<'a> {
    Snapshot {
        hardware: &kind.hardware,
        sensors: Sensors {
            bumper: match &senses.frozen {
                Some(frozen) => frozen.bumper,
                None => senses.contact.filter(|_| kind.sensors.bumper),
            },
            proximity: readings.map_or(&[], |readings| &readings.proximity),
            detections: readings.map_or(&[], |readings| &readings.detections),
            holding: senses.holding,
            thing_names: &shared.things.names,
        },
        fleet: &shared.fleet,
        way_points: &shared.way_points,
        obstacles: match &senses.knowledge {
            Some(knowledge) => &knowledge.obstacles,
            None => &shared.known,
        },
    }
}
