//! The heading, the legend, and the words of the first violation.

use super::layout::Lanes;
use super::{DOWN, LABEL, MARGIN, Scene, WRONG};
use crate::plot::drawing::{Anchor, Drawing, Stroke};
use crate::plot::palette::{BLACK, INK};
use crate::plot::text_width;
use starl_core::Port;

impl Scene<'_> {
    /// The heading and the legend; gives the whole drawing.
    pub(super) fn foot(mut self, lanes: &Lanes<'_>) -> Drawing {
        let story = self.story;
        let part = format!(
            "from {:.3} s to {:.3} s; silences are drawn with logarithmic length",
            self.axis.start().seconds(),
            self.axis.end().seconds()
        );
        let mut right = (self.axis.right() + 24.0).max(MARGIN + text_width(&part, 11.0));
        let labels = lanes.iter().filter(|(_, lane)| lane.is_some());
        for (mark, _) in labels {
            right = right.max(self.axis.place(mark.at) + text_width(&mark.text, LABEL));
        }
        let mut y = self.bottom() + 40.0;
        let mut x = MARGIN;
        for (port, color) in &self.colors {
            let name = match story.ports.get(port) {
                Some(name) => name.clone(),
                None if *port == Port::PROGRAM => "program".to_string(),
                None => "other messages".to_string(),
            };
            self.drawing.line(
                vec![(x, y - 4.0), (x + 22.0, y - 4.0)],
                Stroke::solid(*color, 2.0),
            );
            self.drawing
                .text((x + 27.0, y), Anchor::Start, &name, 11.0, INK);
            x += 45.0 + text_width(&name, 11.0);
        }
        self.drawing
            .cross((x + 5.0, y - 4.0), 3.0, Stroke::solid(WRONG, 1.5));
        self.drawing
            .text((x + 14.0, y), Anchor::Start, "lost", 11.0, INK);
        x += 55.0;
        self.shade((x, y - 10.0), (x + 22.0, y + 1.0), DOWN, 0.55);
        self.drawing
            .text((x + 27.0, y), Anchor::Start, "down", 11.0, INK);
        right = right.max(x + 70.0);
        for violation in story.violations.iter().take(1) {
            let text = format!("{}: {}", violation.property, violation.text);
            for line in wrapped(&text, ((right - MARGIN) / 7.2) as usize) {
                y += 17.0;
                self.drawing
                    .text((MARGIN, y), Anchor::Start, line, 12.0, WRONG);
            }
        }
        let heading = Anchor::Start;
        self.drawing
            .text((MARGIN, 20.0), heading, story.title.clone(), 15.0, BLACK);
        self.drawing.text((MARGIN, 36.0), heading, part, 11.0, INK);
        right = right.max(MARGIN + text_width(&story.title, 15.0));
        self.drawing.size = (right + MARGIN, y + MARGIN);
        self.drawing
    }
}

/// Lines of at most so many letters.
fn wrapped(text: &str, width: usize) -> Vec<String> {
    let mut lines: Vec<String> = vec![String::new()];
    for word in text.split_whitespace() {
        let line = lines.last_mut().filter(|line| {
            line.is_empty() || line.chars().count() + 1 + word.chars().count() <= width
        });
        match line {
            Some(line) if line.is_empty() => line.push_str(word),
            Some(line) => {
                line.push(' ');
                line.push_str(word);
            }
            None => lines.push(word.to_string()),
        }
    }
    lines
}
