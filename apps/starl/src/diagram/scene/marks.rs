//! Actions of robots, faults, and the first violation.

use super::super::story::{MarkKind, Violation};
use super::layout::Lanes;
use super::{LABEL, LANE, Scene, WRONG};
use crate::plot::drawing::{Anchor, Fill, Shape, Stroke};
use crate::plot::palette::{BLACK, INK, WHITE};

impl Scene<'_> {
    pub(super) fn marks(&mut self, lanes: &Lanes<'_>) {
        for &(mark, lane) in lanes {
            let (x, y) = (self.axis.place(mark.at), self.row(mark.robot));
            let color = match mark.kind {
                MarkKind::Primitive(port) => self.colors.get(&port).copied().unwrap_or(INK),
                MarkKind::Program => INK,
                MarkKind::Fault => WRONG,
                MarkKind::End => BLACK,
            };
            if let Some(lane) = lane {
                let foot = y - 13.0 - lane as f64 * LANE;
                let thread = Stroke {
                    opacity: 0.5,
                    ..Stroke::solid(color, 0.8)
                };
                self.drawing.line(vec![(x, y), (x, foot + 2.0)], thread);
                self.drawing.push(Shape::Text {
                    at: (x + 2.0, foot),
                    anchor: Anchor::Start,
                    text: mark.text.clone(),
                    size: LABEL,
                    color,
                    rim: true,
                });
            }
            self.drawing.push(Shape::Circle {
                center: (x, y),
                radius: 3.2,
                fill: Some(Fill::solid(color)),
                stroke: Some(Stroke::solid(WHITE, 0.8)),
            });
        }
    }

    /// The first violation: a line through that moment, and a ring round the robot.
    pub(super) fn violation(&mut self) {
        let shown = |violation: &&Violation| self.axis.shows(violation.at);
        let Some(violation) = self.story.violations.iter().find(shown) else {
            return;
        };
        let x = self.axis.place(violation.at);
        let (top, bottom) = (self.top(), self.bottom());
        self.drawing
            .line(vec![(x, top), (x, bottom)], Stroke::solid(WRONG, 1.8));
        if let Some(robot) = violation.robot {
            self.drawing.push(Shape::Circle {
                center: (x, self.row(robot)),
                radius: 8.0,
                fill: None,
                stroke: Some(Stroke::solid(WRONG, 2.2)),
            });
        }
    }
}
