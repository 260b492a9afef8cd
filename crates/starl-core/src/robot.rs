//! The handle through which a program sees and moves its robot (the thesis's global variable holder).

use crate::effect::Effects;
use crate::event::{Fields, Level, Mark, MarkShape, Name, PrimitiveEvent, Value};
use crate::message::{self, Message, Payload};
use crate::motion::{Body, Obstacles, PlanRequest};
use crate::{
    Command, Destination, Duration, Effect, Estimate, Event, Input, MotionRequest, Point, Port,
    Random, RobotId, Save, Saved, Sensors, Time, TimerKey, WayPoint,
};
use alloc::boxed::Box;
use alloc::vec::Vec;
use core::any::Any;
use serde::Serialize;

/// A robot's knowledge at one moment. The host fills it before each input.
#[derive(Clone, Copy, Debug)]
pub struct View<'a> {
    /// Which robot this is.
    pub id: RobotId,
    /// The robot's own clock.
    pub now: Time,
    /// The latest estimate of the positioning system.
    pub estimate: Estimate,
    /// The space the robot takes.
    pub body: Body,
    /// Current readings.
    pub sensors: Sensors<'a>,
    /// All robots of the application, this one too, in the order of their numbers.
    pub fleet: &'a [RobotId],
    /// The application's waypoints.
    pub way_points: &'a [WayPoint],
    /// The obstacles this robot knows.
    pub obstacles: &'a Obstacles,
}

/// A program's handle to its robot: the robot's knowledge, and requests to its host.
pub struct Robot<'a> {
    view: &'a View<'a>,
    effects: &'a mut Effects,
    random: &'a mut Random,
    saved: Option<&'a Saved>,
}

impl<'a> Robot<'a> {
    /// A handle on `view` that collects into `effects`.
    pub fn new(view: &'a View<'a>, effects: &'a mut Effects, random: &'a mut Random) -> Robot<'a> {
        Robot {
            view,
            effects,
            random,
            saved: None,
        }
    }

    /// The same with the content of the robot's storage when its software started; none without storage.
    pub fn with_saved(self, saved: Option<&'a Saved>) -> Robot<'a> {
        Robot { saved, ..self }
    }

    /// This robot's number.
    pub fn id(&self) -> RobotId {
        self.view.id
    }

    /// All robots of the application, this one too.
    pub fn fleet(&self) -> &'a [RobotId] {
        self.view.fleet
    }

    /// Whether this is another robot of the application.
    pub fn is_peer(&self, robot: RobotId) -> bool {
        robot != self.view.id && self.view.fleet.binary_search(&robot).is_ok()
    }

    /// The other robots of the application.
    pub fn peers(&self) -> impl Iterator<Item = RobotId> + use<'a> {
        let id = self.view.id;
        self.view
            .fleet
            .iter()
            .copied()
            .filter(move |&peer| peer != id)
    }

    /// The robot's own clock.
    pub fn now(&self) -> Time {
        self.view.now
    }

    /// Estimated position of the centre of the body's base, metres.
    pub fn position(&self) -> Point {
        self.view.estimate.pose.position
    }

    /// Estimated velocity, metres per second.
    pub fn velocity(&self) -> Point {
        self.view.estimate.twist.linear
    }

    /// Estimated heading, radians from the x axis.
    pub fn heading(&self) -> f64 {
        self.view.estimate.pose.yaw
    }

    /// The whole estimate of the positioning system.
    pub fn estimate(&self) -> &Estimate {
        &self.view.estimate
    }

    /// The space the robot takes.
    pub fn body(&self) -> &'a Body {
        &self.view.body
    }

    /// Current sensor readings.
    pub fn sensors(&self) -> &'a Sensors<'a> {
        &self.view.sensors
    }

    /// The application's waypoints (the thesis's getInput).
    pub fn way_points(&self) -> &'a [WayPoint] {
        self.view.way_points
    }

    /// The obstacles this robot knows (the thesis's getObstacles).
    pub fn obstacles(&self) -> Obstacles {
        self.view.obstacles.clone()
    }

    /// The same by reference.
    pub fn known_obstacles(&self) -> &'a Obstacles {
        self.view.obstacles
    }

    /// This robot's random stream.
    pub fn random(&mut self) -> &mut Random {
        self.random
    }

    /// Hands a datagram to the network, which may lose it: [`Effect::Transmit`].
    pub fn transmit<T: Serialize>(&mut self, destination: Destination, port: Port, content: &T) {
        self.transmit_bytes(destination, port, message::encode(content));
    }

    /// [`Robot::transmit`] of bytes that are encoded already.
    pub fn transmit_bytes(&mut self, destination: Destination, port: Port, payload: Payload) {
        self.push(Effect::Transmit {
            destination,
            port,
            payload,
        });
    }

    /// Arms a timer, or moves it if it is armed.
    pub fn set_timer(&mut self, key: TimerKey, after: Duration) {
        self.push(Effect::SetTimer { key, after });
    }

    /// Forgets a timer.
    pub fn cancel_timer(&mut self, key: TimerKey) {
        self.push(Effect::CancelTimer(key));
    }

    /// Sends a command to the robot's model.
    pub fn drive(&mut self, command: Command) {
        self.push(Effect::Move(MotionRequest::Drive(command)));
    }

    /// Asks for a path.
    pub fn plan(&mut self, request: PlanRequest) {
        self.push(Effect::Move(MotionRequest::Plan(request)));
    }

    /// Tracks a waypoint: [`MotionRequest::Track`].
    pub fn track(&mut self, target: Point, next: Option<Point>) {
        self.push(Effect::Move(MotionRequest::Track { target, next }));
    }

    /// Stops the robot.
    pub fn halt(&mut self) {
        self.push(Effect::Move(MotionRequest::Halt));
    }

    /// Notes that a guarded action fired.
    pub fn action(&mut self, name: impl Into<Name>) {
        self.push(Effect::Record(Event::Action(name.into())));
    }

    /// Reports an event of the program.
    pub fn emit<const N: usize>(
        &mut self,
        name: impl Into<Name>,
        fields: [(&'static str, Value); N],
    ) {
        self.emit_fields(name, named(fields));
    }

    /// [`Robot::emit`] for field names that are not known at compile time.
    pub fn emit_fields(&mut self, name: impl Into<Name>, fields: Fields) {
        let name = name.into();
        self.push(Effect::Record(Event::Program { name, fields }));
    }

    /// For primitives: reports a command to, or an outcome of, the instance at `port`. A primitive that is not the
    /// platform's makes its events by [`PrimitiveEvent::named`].
    pub fn report(&mut self, port: Port, event: impl Into<PrimitiveEvent>) {
        let event = event.into();
        self.push(Effect::Record(Event::Primitive { port, event }));
    }

    /// Writes a line to the robot's log.
    pub fn log(&mut self, level: Level, text: impl Into<Name>) {
        self.push(Effect::Record(Event::Log {
            level,
            text: text.into(),
        }));
    }

    /// Draws for the viewer.
    pub fn draw(&mut self, label: impl Into<Name>, shape: MarkShape) {
        self.push(Effect::Record(Event::Draw(Mark {
            label: label.into(),
            shape,
        })));
    }

    /// Takes hold of a thing: [`Effect::Take`].
    pub fn take(&mut self, thing: u32) {
        self.push(Effect::Take(thing));
    }

    /// Puts down what the robot holds.
    pub fn put_down(&mut self) {
        self.push(Effect::PutDown);
    }

    /// Whether saved values survive a crash.
    pub fn has_storage(&self) -> bool {
        self.saved.is_some()
    }

    /// Saves a value of a primitive or, under [`Port::PROGRAM`], of the program: see the module [`crate::storage`].
    /// Without storage this has no effect.
    pub fn save<T: Serialize>(&mut self, port: Port, key: impl Into<Name>, value: &T) {
        if self.has_storage() {
            self.save_bytes(port, key, message::encode(value));
        }
    }

    /// [`Robot::save`] of bytes that are encoded already.
    pub fn save_bytes(&mut self, port: Port, key: impl Into<Name>, value: Payload) {
        if self.has_storage() {
            let (key, value) = (key.into(), Some(value));
            self.push(Effect::Save(Save { port, key, value }));
        }
    }

    /// The contents of storage when this robot's software started; none if it has no storage.
    pub fn saved(&self) -> Option<&'a Saved> {
        self.saved
    }

    /// Says that the program has reached its goal.
    pub fn finish(&mut self) {
        self.push(Effect::Finish);
    }

    /// Says that the program cannot continue, and why.
    pub fn fail(&mut self, reason: impl Into<Name>) {
        self.push(Effect::Fail(reason.into()));
    }

    /// For primitives: hands a message up to this robot's own program.
    pub fn deliver(&mut self, from: RobotId, port: Port, payload: Payload) {
        self.effects.upcalls.push(Message {
            from,
            port,
            payload,
        });
    }

    /// How many effects there are by now.
    pub fn asked(&self) -> usize {
        self.effects.list.len()
    }

    /// Adds the effects collected by another handle of the same robot, for software that cannot borrow this one.
    pub fn absorb(&mut self, effects: Effects) {
        self.effects.list.extend(effects.list);
        self.effects.upcalls.extend(effects.upcalls);
        self.effects.verdicts.extend(effects.verdicts);
    }

    /// Runs something and discards its effects. Its random draws are kept.
    pub fn rehearse<T>(&mut self, run: impl FnOnce(&mut Robot<'_>) -> T) -> T {
        let mut effects = Effects::default();
        run(&mut Robot {
            view: self.view,
            effects: &mut effects,
            random: self.random,
            saved: self.saved,
        })
    }

    /// Working memory of this type: the value left by [`Robot::return_scratch`], possibly by another
    /// robot, or a new one. It saves an allocation for each input. Its content must not influence the
    /// program.
    pub fn take_scratch<T: Any + Default + Send + Sync>(&mut self) -> Box<T> {
        self.effects.scratch.take().unwrap_or_default()
    }

    /// Leaves working memory for the next input.
    pub fn return_scratch<T: Any + Send + Sync>(&mut self, scratch: Box<T>) {
        self.effects.scratch.keep(scratch);
    }

    /// For failure detectors: tells all primitives of this robot's own program that they should
    /// suspect a robot ([`Input::Suspected`]).
    pub fn suspect(&mut self, peer: RobotId) {
        self.effects.verdicts.push(Input::Suspected(peer));
    }

    /// For failure detectors: tells all primitives of this robot's own program that they can trust a
    /// robot again ([`Input::Trusted`]).
    pub fn trust(&mut self, peer: RobotId) {
        self.effects.verdicts.push(Input::Trusted(peer));
    }

    pub(crate) fn verdicts(&mut self) -> Vec<Input> {
        core::mem::take(&mut self.effects.verdicts)
    }

    pub(crate) fn has_upcalls(&self) -> bool {
        !self.effects.upcalls.is_empty()
    }

    pub(crate) fn upcalls(&mut self) -> &mut Vec<Message> {
        &mut self.effects.upcalls
    }

    fn push(&mut self, effect: Effect) {
        self.effects.list.push(effect);
    }
}

fn named<const N: usize>(fields: [(&'static str, Value); N]) -> Fields {
    fields
        .into_iter()
        .map(|(name, value)| (name.into(), value))
        .collect()
}
