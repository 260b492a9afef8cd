//! A robot that gets one command for its drive and nothing else, so that its motion can be compared with a closed form
//! (`docs/reference/validation.md`).

use crate::parameters::Parameters;
use starl_core::{Command, Point, Primitives, Program, Robot};

/// The program of one robot.
#[derive(Clone, Copy, Debug, Primitives)]
pub struct Drive {
    command: Command,
}

impl Drive {
    /// The command that the parameters describe: lengths in metres, angles in radians.
    pub fn new(parameters: &mut Parameters<'_>) -> Drive {
        let mut number = |name| parameters.number(name, 0.0);
        let (speed, angle) = (number("speed"), number("angle"));
        let (left, right) = (number("left"), number("right"));
        let (pitch, roll, climb) = (number("pitch"), number("roll"), number("climb"));
        let yaw_rate = number("yaw_rate");
        let attitude = Command::Attitude {
            yaw_rate,
            pitch,
            roll,
            gaz: climb,
        };
        let velocity = Point::planar(speed, 0.0);
        let choices = [
            ("stop", Command::Stop),
            ("wheels", Command::Wheels { left, right }),
            ("steer", Command::Steer { speed, angle }),
            ("velocity", Command::Velocity { velocity, yaw_rate }),
            ("attitude", attitude),
        ];
        Drive {
            command: parameters.choice("command", Command::Stop, &choices),
        }
    }
}

impl Program for Drive {
    fn activate(&mut self, robot: &mut Robot<'_>) {
        robot.drive(self.command);
    }
}
