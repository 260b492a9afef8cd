//! Messages: arrows from senders to receivers, and crosses where they were lost.

use super::super::story::Message;
use super::{Scene, WRONG};
use crate::plot::drawing::{Fill, Shape, Spot, Stroke};
use crate::plot::palette::INK;
use starl_core::event::DropReason;

impl Scene<'_> {
    pub(super) fn messages(&mut self) {
        let story = self.story;
        for message in &story.messages {
            if message.at >= self.axis.start() && message.sent <= self.axis.end() {
                self.message(message);
            }
        }
    }

    fn message(&mut self, message: &Message) {
        let color = self.colors.get(&message.port).copied().unwrap_or(INK);
        let start = (self.axis.place(message.sent), self.row(message.from));
        let Some(to) = message.to else {
            // Too large, or the queue was full: it never left.
            let cross = (start.0, start.1 - 7.0);
            return self.drawing.cross(cross, 3.0, Stroke::solid(WRONG, 1.4));
        };
        let end = (self.axis.place(message.at), self.row(to));
        let stroke = Stroke {
            color,
            width: 1.1,
            opacity: 0.85,
            dashed: message.lost.is_some(),
        };
        match message.lost {
            Some(DropReason::Down) => {
                self.arrow(start, end, stroke);
                self.drawing.cross(end, 3.5, Stroke::solid(WRONG, 1.6));
            }
            // Its fate is known when it is sent; the line only shows its receivers.
            Some(_) => {
                let down = if end.1 > start.1 { 1.0 } else { -1.0 };
                let stop = (start.0 + 7.0, start.1 + down * 21.0);
                self.drawing.line(vec![start, stop], stroke);
                self.drawing.cross(stop, 3.0, Stroke::solid(WRONG, 1.5));
            }
            None if message.at > self.axis.end() => self.drawing.line(vec![start, end], stroke),
            None => self.arrow(start, end, stroke),
        }
    }

    fn arrow(&mut self, start: Spot, end: Spot, stroke: Stroke) {
        self.drawing.line(vec![start, end], stroke);
        let (dx, dy) = (end.0 - start.0, end.1 - start.1);
        let length = (dx * dx + dy * dy).sqrt();
        if length < 1.0 {
            return;
        }
        let (ux, uy) = (dx / length, dy / length);
        let back = |along: f64, aside: f64| {
            (
                end.0 - ux * along - uy * aside,
                end.1 - uy * along + ux * aside,
            )
        };
        self.drawing.push(Shape::Line {
            points: vec![end, back(7.0, 2.8), back(7.0, -2.8)],
            closed: true,
            fill: Some(Fill::solid(stroke.color)),
            stroke: None,
        });
    }
}
