//! One robot's turn in a step: it takes its inputs in the order of their times, and what it asks for
//! is carried out or passed on.

use super::inbox::Delivery;
use super::mind::{Knowledge, Mind, Outgoing};
use super::record::Log;
use super::shard::Scratch;
use super::shared::{Kind, Shared, Window};
use super::{Stream, position, stream};
use starl_core::event::{DropReason, Hit, Level};
use starl_core::event::{PrimitiveEvent, ReachAvoidEvent};
use starl_core::{
    Command, Destination, Duration, Effect, Event, Input, Message, MotionRequest, Payload, Port,
    Sensors, Time, View,
};
use starl_motion::avoidance;
use starl_motion::{Neighbour, Pilot, State, planning};

/// Timers are never shorter, so that a step holds only so many of them.
const SHORTEST_TIMER: Duration = Duration::from_millis(1);

/// Bytes that travel with a payload: addresses, port, sequence number and checksum, as in UDP over
/// IP version 4 over Wi-Fi, rounded.
const HEADER_BYTES: usize = 64;

/// Planners that are to go round robots see those this near, metres.
const SIGHT: f64 = 5.0;

/// Obstacles whose distance differs by less than this meet, metres.
const CORNER: f64 = 1e-3;

/// All that one robot's turn touches.
pub struct Turn<'a> {
    pub shared: &'a Shared,
    pub kind: &'a Kind,
    pub window: Window,
    pub state: &'a State,
    pub mind: &'a mut Mind,
    pub outbox: &'a mut Vec<Outgoing>,
    pub log: &'a mut Log,
    pub scratch: &'a mut Scratch,
    /// Whether `scratch` holds this robot's readings.
    pub sensed: bool,
}

impl Turn<'_> {
    /// Takes all inputs of this step.
    pub fn run(&mut self) {
        if self.window.from == Time::ZERO {
            self.note(Time::ZERO, Event::Moved(self.state.pose));
        }
        let mut arrivals = std::mem::take(&mut self.scratch.arrivals);
        self.shared.inboxes.of(self.mind.id, &mut arrivals);
        if self.mind.condition.down {
            for delivery in &arrivals {
                self.drop_arrival(delivery);
            }
        } else {
            let up_from = self.begin();
            let early = arrivals.partition_point(|delivery| delivery.at < up_from);
            for delivery in &arrivals[..early] {
                self.drop_arrival(delivery);
            }
            self.take_in_order(&arrivals[early..]);
        }
        self.scratch.arrivals = arrivals;
    }

    /// What comes before anything else: the start, paths that planners have found, and readings. Gives from
    /// when on the robot is up: one that restarts within this step was down before.
    fn begin(&mut self) -> Time {
        let mut from = self.window.from;
        if !self.mind.condition.started {
            from = from.max(self.mind.next_activation);
            self.mind.condition.started = true;
            self.locate(from);
            self.feed(from, &Input::Start);
        }
        for (ticket, path) in std::mem::take(&mut self.mind.plans) {
            self.feed(from, &Input::Planned { ticket, path });
        }
        if self.mind.next_activation < self.window.to {
            self.sense();
            self.sensed = true;
        }
        from
    }

    /// Inputs by time; at equal times estimates come before messages, then timers, then activations.
    fn take_in_order(&mut self, arrivals: &[Delivery]) {
        let mut arrivals = arrivals.iter().peekable();
        loop {
            let estimate = self.mind.next_estimate;
            let message = arrivals.peek().map_or(Time::NEVER, |delivery| delivery.at);
            let timer = self.mind.timers.next();
            let activation = self.mind.next_activation;
            let at = estimate.min(message).min(timer).min(activation);
            if at >= self.window.to {
                return;
            }
            if at == estimate {
                self.mind.next_estimate += self.shared.scenario.positioning.period;
                self.locate(at);
                self.feed(at, &Input::Estimate);
                self.steer(at);
            } else if at == message {
                if let Some(delivery) = arrivals.next() {
                    self.receive(delivery);
                }
            } else if at == timer {
                if let Some(key) = self.mind.timers.take() {
                    self.feed(at, &Input::Timer(key));
                }
            } else {
                self.mind.next_activation += self.kind.control_period;
                self.feed(at, &Input::Activate);
            }
        }
    }

    /// Takes a new position estimate, and meets hidden obstacles.
    fn locate(&mut self, at: Time) {
        if self.mind.condition.sensors_frozen {
            return;
        }
        let from = self.window.from;
        let estimate = position::estimate(self.shared, self.mind.id, self.state, from, at);
        let pose = estimate.pose;
        self.mind.estimate = estimate;
        self.mind.estimate.at = self.mind.clock.read(at);
        self.log.record(
            &mut self.mind.digest,
            self.mind.id,
            at,
            Event::Estimated(pose),
        );
        if !self.shared.hidden.is_empty() {
            self.discover(at);
        }
    }

    /// Hidden obstacles in range and line of sight, or touched, become known.
    fn discover(&mut self, at: Time) {
        let shared = self.shared;
        let body = &shared.bodies[self.mind.id.index()];
        for &index in &shared.hidden {
            let world_index = shared.standing[index as usize];
            if self
                .mind
                .knowledge
                .as_ref()
                .is_some_and(|known| known.met.contains(&world_index))
            {
                continue;
            }
            let obstacle = &shared.map.obstacles()[index as usize];
            let touched = self.mind.touching == Some(Hit::Obstacle(world_index));
            let gap = obstacle.body_gap(body.position, body.radius, body.height);
            if !touched && (gap > self.kind.sensors.discovery_range || !self.sees(index)) {
                continue;
            }
            let knowledge = self.mind.knowledge.get_or_insert_with(|| {
                Box::new(Knowledge {
                    met: Vec::new(),
                    obstacles: shared.known.clone(),
                })
            });
            knowledge.met.push(world_index);
            knowledge.obstacles = knowledge
                .obstacles
                .iter()
                .cloned()
                .chain([obstacle.clone()])
                .collect();
            let event = Event::Discovered(obstacle.clone());
            self.log
                .record(&mut self.mind.digest, self.mind.id, at, event);
        }
    }

    /// Whether nothing stands between the robot and the nearest point of an obstacle. Another one that meets it
    /// there, as walls do at a corner, hides nothing of it; so the nearest of all is always seen.
    fn sees(&self, index: u32) -> bool {
        let map = &self.shared.map;
        let eye = self.state.pose.position;
        let nearest = map.obstacles()[index as usize].nearest_point(eye);
        let Some(direction) = (nearest - eye).normalized() else {
            return true;
        };
        let target = nearest - direction * CORNER.min(eye.distance(nearest));
        let mut seen = true;
        map.any_near(
            &starl_core::geometry::Bounds::of_segment(eye, target),
            |other| {
                seen = other == index
                    || !map.obstacles()[other as usize].blocks_segment(eye, target, 0.0);
                !seen
            },
        );
        seen
    }

    /// Reads the sensors that the robot carries.
    fn sense(&mut self) {
        let (robot, readings) = (self.mind.id, &mut self.scratch.readings);
        if let Some(frozen) = &self.mind.frozen {
            readings.clear();
            readings.proximity.extend_from_slice(&frozen.proximity);
            readings.detections.extend_from_slice(&frozen.detections);
            return;
        }
        match &self.kind.sensors.proximity {
            Some(sensor) => readings.measure(self.shared, robot, &self.state.pose, sensor),
            None => readings.clear(),
        }
        match &self.kind.sensors.detector {
            Some(sensor) => readings.detect(self.shared, robot, sensor),
            None => readings.detections.clear(),
        }
        if self.mind.condition.sensors_frozen {
            self.mind.frozen = Some(Box::new(super::mind::Frozen {
                bumper: self.mind.contact,
                proximity: readings.proximity.clone(),
                detections: readings.detections.clone(),
            }));
        }
    }

    fn receive(&mut self, delivery: &Delivery) {
        let transmission = self.shared.inboxes.transmission(delivery);
        let event = Event::Delivered {
            from: transmission.from,
            sequence: transmission.sequence,
        };
        self.log
            .record(&mut self.mind.digest, self.mind.id, delivery.at, event);
        let message = Message {
            from: transmission.from,
            port: transmission.port,
            payload: Payload::from_slice(&transmission.payload),
        };
        self.feed(delivery.at, &Input::Message(message));
    }

    fn drop_arrival(&mut self, delivery: &Delivery) {
        let transmission = self.shared.inboxes.transmission(delivery);
        let event = Event::Dropped {
            from: transmission.from,
            to: Some(self.mind.id),
            sequence: transmission.sequence,
            reason: DropReason::Down,
        };
        self.log
            .record(&mut self.mind.digest, self.mind.id, delivery.at, event);
    }

    /// Hands an input to the robot's software and carries out what it asks for.
    fn feed(&mut self, at: Time, input: &Input) {
        if self.mind.condition.failed {
            return;
        }
        let mind = &mut *self.mind;
        let readings = &self.scratch.readings;
        let bumper = match &mind.frozen {
            Some(frozen) => frozen.bumper,
            None => mind.contact.filter(|_| self.kind.sensors.bumper),
        };
        let view = View {
            id: mind.id,
            now: mind.clock.read(at),
            estimate: mind.estimate,
            body: self.kind.body,
            sensors: match self.sensed {
                true => Sensors {
                    bumper,
                    proximity: &readings.proximity,
                    detections: &readings.detections,
                },
                false => Sensors {
                    bumper,
                    ..Sensors::default()
                },
            },
            fleet: &self.shared.fleet,
            way_points: &self.shared.scenario.world.way_points,
            obstacles: match &mind.knowledge {
                Some(knowledge) => &knowledge.obstacles,
                None => &self.shared.known,
            },
        };
        mind.agent.handle(input, &view, &mut self.scratch.effects);
        let mut effects = std::mem::take(&mut self.scratch.effects.list);
        for effect in effects.drain(..) {
            self.carry_out(at, effect);
        }
        self.scratch.effects.list = effects;
    }

    fn carry_out(&mut self, at: Time, effect: Effect) {
        match effect {
            Effect::Transmit {
                destination,
                port,
                payload,
            } => {
                self.transmit(at, destination, port, payload);
            }
            Effect::SetTimer { key, after } => {
                let after = self.mind.clock.real(after).max(SHORTEST_TIMER);
                self.mind.timers.set(at + after, key);
            }
            Effect::CancelTimer(key) => self.mind.timers.cancel(key),
            Effect::Move(request) => self.move_body(at, &request),
            Effect::Record(event) => self.note(at, event),
            Effect::Finish => {
                if !std::mem::replace(&mut self.mind.condition.finished, true) {
                    self.note(at, Event::Finished);
                }
            }
            Effect::Fail(reason) => {
                self.mind.condition.failed = true;
                self.mind.pilot = None;
                self.mind.command = Command::Stop;
                self.note(at, Event::Failed(reason));
            }
        }
    }

    fn note(&mut self, at: Time, event: Event) {
        if let Event::Primitive {
            event: PrimitiveEvent::ReachAvoid(ReachAvoidEvent::Done { .. }),
            ..
        } = &event
        {
            self.mind.way_points += 1;
        }
        self.log
            .record(&mut self.mind.digest, self.mind.id, at, event);
    }

    fn transmit(&mut self, at: Time, destination: Destination, port: Port, payload: Payload) {
        let sequence = self.mind.sequence;
        self.mind.sequence = sequence.wrapping_add(1);
        let (from, network) = (self.mind.id, &self.shared.scenario.network);
        let mut unsent = None;
        let mut leaves = at;
        if payload.len() > network.largest as usize {
            unsent = Some(DropReason::Size);
        } else if let Some(bandwidth) = network.bandwidth {
            let bits = ((payload.len() + HEADER_BYTES) * 8) as f64;
            let begins = self.mind.radio_free.max(at);
            if begins.since(at) > network.queue {
                unsent = Some(DropReason::Bandwidth);
            } else {
                leaves = begins + Duration::from_seconds_f64(bits / bandwidth);
                self.mind.radio_free = leaves;
            }
        }
        let event = Event::Sent {
            sequence,
            destination,
            port,
            payload: payload.clone(),
        };
        self.note(at, event);
        match unsent {
            Some(reason) => self.note(
                at,
                Event::Dropped {
                    from,
                    to: None,
                    sequence,
                    reason,
                },
            ),
            None => self.outbox.push(Outgoing {
                at: leaves,
                sequence,
                destination,
                message: Message {
                    from,
                    port,
                    payload,
                },
            }),
        }
    }

    fn move_body(&mut self, at: Time, request: &MotionRequest) {
        match request {
            MotionRequest::Plan(request) => {
                self.gather(if request.around_robots { SIGHT } else { 0.0 });
                let noise = self.shared.scenario.positioning.position_noise;
                let path = planning::plan_with(
                    &planning::Options::with_accuracy(noise),
                    &*self.kind.model,
                    &self.mind.estimate,
                    request,
                    &self.scratch.neighbours,
                );
                self.mind.plans.push((request.ticket, path));
            }
            MotionRequest::Drive(command) if !self.kind.model.accepts(command) => {
                let text = format!("a {} does not take {command:?}", self.kind.model.name());
                self.mind.command = Command::Stop;
                self.note(
                    at,
                    Event::Log {
                        level: Level::Warning,
                        text: text.into(),
                    },
                );
            }
            MotionRequest::Drive(command) => {
                self.mind.pilot = None;
                self.mind.command = *command;
            }
            MotionRequest::Track { .. } | MotionRequest::Halt => {
                let avoidance: Option<avoidance::Options> =
                    self.shared.scenario.motion.avoidance.clone();
                let pilot = self
                    .mind
                    .pilot
                    .get_or_insert_with(|| Box::new(Pilot::new(&*self.kind.model, avoidance)));
                pilot.request(request);
                self.steer(at);
            }
        }
    }

    /// Lets the pilot choose the command that follows from the present estimate.
    fn steer(&mut self, at: Time) {
        let Some(mut pilot) = self.mind.pilot.take() else {
            return;
        };
        self.gather(pilot.wants_neighbours().unwrap_or(0.0));
        let key = [u64::from(self.mind.id.0), at.0];
        let mut random = stream(self.shared.scenario.seed, Stream::Pilot, &key);
        let obstacles = match &self.mind.knowledge {
            Some(knowledge) => &knowledge.obstacles,
            None => &self.shared.known,
        };
        self.mind.command = pilot.command(
            &*self.kind.model,
            &self.mind.estimate,
            &self.scratch.neighbours,
            obstacles,
            &mut random,
        );
        self.mind.pilot = Some(pilot);
    }

    /// Collects the robots perceived within `reach`, none if it is 0.
    fn gather(&mut self, reach: f64) {
        let neighbours: &mut Vec<Neighbour> = &mut self.scratch.neighbours;
        neighbours.clear();
        if reach <= 0.0 {
            return;
        }
        let shared = self.shared;
        let shown = if shared.perceived.is_empty() {
            &shared.bodies
        } else {
            &shared.perceived
        };
        shared
            .grid
            .for_each_within(self.state.pose.position, reach, |entry| {
                if entry.robot != self.mind.id.0 {
                    neighbours.push(shown[entry.robot as usize]);
                }
            });
    }
}
