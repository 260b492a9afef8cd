//! How robots look.

use super::RobotPath;
use super::drawing::{Fill, Stroke};
use super::palette;

/// Larger fleets are coloured by model: more colours cannot be distinguished.
pub const MOST_COLORS: usize = 24;

/// The look of the robots.
pub struct Looks {
    /// The models in the order of their first robots.
    pub models: Vec<String>,
    /// Whether robots of a model share a colour.
    pub by_model: bool,
    count: usize,
}

impl Looks {
    /// The looks of this fleet.
    pub fn of(robots: &[RobotPath]) -> Looks {
        let mut models: Vec<String> = Vec::new();
        for robot in robots {
            if !models.contains(&robot.model) {
                models.push(robot.model.clone());
            }
        }
        Looks {
            models,
            by_model: robots.len() > MOST_COLORS,
            count: robots.len(),
        }
    }

    /// The line with which a robot's path is drawn.
    pub fn stroke(&self, index: usize, robot: &RobotPath) -> Stroke {
        let color = if self.by_model {
            let model = self.models.iter().position(|model| *model == robot.model);
            palette::color(model.unwrap_or(0), self.models.len())
        } else {
            palette::color(index, self.count)
        };
        let (width, opacity) = match self.count {
            count if count <= MOST_COLORS => (1.8, 1.0),
            count if count <= 300 => (1.2, 0.7),
            _ => (0.8, 0.5),
        };
        Stroke {
            color,
            width,
            opacity,
            dashed: robot.flies,
        }
    }
}

/// How a body is filled at the end, and its outline.
pub fn body_look(stroke: Stroke) -> (Fill, Stroke) {
    let outline = Stroke {
        width: stroke.width.min(1.5),
        dashed: false,
        ..stroke
    };
    (
        Fill {
            color: stroke.color,
            opacity: stroke.opacity * 0.3,
        },
        outline,
    )
}
