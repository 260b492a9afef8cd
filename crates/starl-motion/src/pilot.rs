//! The motion layer of one robot: turns what the program asks for into commands of the model.
//!
//! It is called at every new estimate. A waypoint that is tracked passes through avoidance, which may
//! put a nearer point and a limit of speed in its place; commands that the program drives itself, and
//! standing still, do not.

use crate::avoidance::{Avoidance, Driven, Options};
use crate::tracking::{Goal, Tracking};
use crate::{Model, Neighbour};
use alloc::boxed::Box;
use starl_core::motion::Estimate;
use starl_core::{Command, MotionRequest, Obstacle, Random};

/// The program's current request to the motion layer.
#[derive(Clone, Debug, Default)]
enum Wish {
    #[default]
    Halt,
    Drive(Command),
    Track(Goal),
}

/// The motion layer of one robot.
#[derive(Clone, Debug)]
pub struct Pilot {
    wish: Wish,
    tracking: Tracking,
    avoidance: Option<Box<Avoidance>>,
    /// How far avoidance needs to see, metres.
    sight: f64,
}

impl Pilot {
    /// A pilot for a robot of this model, which stands still; without options it does not avoid
    /// other robots.
    pub fn new(model: &dyn Model, avoidance: Option<Options>) -> Pilot {
        let avoidance = avoidance.map(|options| Box::new(Avoidance::new(options)));
        let sight = avoidance.as_ref().map_or(0.0, |avoidance| {
            avoidance.range(&model.body(), &model.limits())
        });
        Pilot {
            wish: Wish::Halt,
            tracking: Tracking::default(),
            avoidance,
            sight,
        }
    }

    /// Takes a request, which replaces the one before it. Planning is not the pilot's.
    pub fn request(&mut self, request: &MotionRequest) {
        self.wish = match *request {
            MotionRequest::Plan(_) => return,
            MotionRequest::Drive(command) => Wish::Drive(command),
            MotionRequest::Halt => Wish::Halt,
            MotionRequest::Track { target, next } => Wish::Track(Goal {
                target,
                next,
                speed_limit: f64::INFINITY,
            }),
        };
    }

    /// The distance in metres within which [`Pilot::command`] needs the positions of neighbours now;
    /// none if it needs none.
    pub fn wants_neighbours(&self) -> Option<f64> {
        let tracks = matches!(self.wish, Wish::Track(_));
        (tracks && self.avoidance.is_some()).then_some(self.sight)
    }

    /// The command to drive until the next estimate. `neighbours` are the robots within the distance
    /// that [`Pilot::wants_neighbours`] names, `obstacles` the obstacles known that near.
    pub fn command(
        &mut self,
        model: &dyn Model,
        estimate: &Estimate,
        neighbours: &[Neighbour],
        obstacles: &[Obstacle],
        random: &mut Random,
    ) -> Command {
        let goal = match self.wish {
            Wish::Track(goal) => goal,
            Wish::Drive(command) if model.accepts(&command) => {
                self.interrupt();
                return command;
            }
            Wish::Drive(_) | Wish::Halt => {
                if let Some(avoidance) = &mut self.avoidance {
                    avoidance.interrupt();
                }
                return model.rest(&mut self.tracking, estimate);
            }
        };
        let body = model.body();
        let goal = Goal {
            target: body.reachable(goal.target),
            ..goal
        };
        if !goal.target.is_finite() {
            return Command::Stop;
        }
        let goal = match &mut self.avoidance {
            None => goal,
            Some(avoidance) => {
                let driven = Driven {
                    model,
                    tracking: &self.tracking,
                };
                avoidance.guide(driven, estimate, &goal, neighbours, obstacles, random)
            }
        };
        model.track(&mut self.tracking, estimate, &goal)
    }

    /// Whether the robot has long been pushed harder than it can hold against, while it tracks a waypoint or stands
    /// still.
    pub fn is_overpowered(&self, model: &dyn Model) -> bool {
        !matches!(self.wish, Wish::Drive(_)) && model.is_overpowered(&self.tracking)
    }

    /// For a while tracking and avoidance do not drive the robot.
    fn interrupt(&mut self) {
        self.tracking.interrupt();
        if let Some(avoidance) = &mut self.avoidance {
            avoidance.interrupt();
        }
    }
}
