//! The plot of a sweep: a metric against the first axis, one line for each value of the other axes, with the 95 %
//! intervals as bands.

use super::metrics::Shown;
use super::report::{Report, interval};
use crate::picture::Picture;
use crate::plot::drawing::{Anchor, Color, Drawing, Fill, Shape, Spot, Stroke};
use crate::plot::palette::{GRID, INK, color};
use crate::plot::{self, label, step_for, text_width, ticks};
use starl_sweep::{Plan, Scale};

/// The upper left corner of the field of the plot.
const CORNER: Spot = (64.0, 78.0);
/// Width and height of the field.
const FIELD: (f64, f64) = (560.0, 360.0);
/// Height of a line of the legend.
const ROW: f64 = 20.0;
/// More lines cannot be distinguished.
const MOST_LINES: usize = 24;

/// A point of a line: the place on the first axis, the estimate and the ends of its interval.
struct Mark {
    x: f64,
    y: f64,
    low: f64,
    high: f64,
}

/// A line, with the values of the other axes.
struct Line {
    name: String,
    marks: Vec<Mark>,
}

/// The plot as a file.
pub fn file(plan: &Plan, report: &Report, metric: Shown, picture: Picture) -> Vec<u8> {
    plot::file(&draw(plan, report, metric), picture)
}

fn draw(plan: &Plan, report: &Report, metric: Shown) -> Drawing {
    let scale = plan.axes()[0].scale();
    let mut lines = lines(plan, report, metric, &scale);
    let omitted = lines.len().saturating_sub(MOST_LINES);
    lines.truncate(MOST_LINES);
    let frame = Frame::around(&lines, metric);
    let mut drawing = Drawing::default();
    heading(&mut drawing, plan, report, metric);
    frame.draw_axes(&mut drawing, plan, &scale);
    let colored = || {
        (0..)
            .zip(&lines)
            .map(|(index, line)| (line, color(index, lines.len())))
    };
    // No band covers a line.
    for (line, color) in colored() {
        frame.draw_band(&mut drawing, line, color);
    }
    for (line, color) in colored() {
        frame.draw_line(&mut drawing, line, color);
    }
    let right = match plan.axes().len() {
        1 => CORNER.0 + FIELD.0,
        _ => legend(&mut drawing, &lines, omitted),
    };
    let rows = CORNER.1 + (lines.len() + 1) as f64 * ROW;
    drawing.size = (right + 24.0, rows.max(CORNER.1 + FIELD.1 + 56.0));
    drawing
}

/// The lines in the order of the plan, each from left to right.
fn lines(plan: &Plan, report: &Report, metric: Shown, scale: &Scale) -> Vec<Line> {
    let mut lines: Vec<(Vec<usize>, Line)> = Vec::new();
    for (number, combination) in (0..).zip(&report.summary.combinations) {
        let indices = plan.indices(number);
        let (first, others) = (indices[0], indices[1..].to_vec());
        let place = match lines.iter().position(|(known, _)| *known == others) {
            Some(place) => place,
            None => {
                let values = plan.axes()[1..].iter().zip(&others);
                let named =
                    values.map(|(axis, index)| format!("{} = {}", axis.field, axis.values[*index]));
                let name = named.collect::<Vec<_>>().join(", ");
                let marks = Vec::new();
                lines.push((others, Line { name, marks }));
                lines.len() - 1
            }
        };
        if let Some(interval) = interval(combination, metric) {
            lines[place].1.marks.push(Mark {
                x: match scale {
                    Scale::Numbers { values, .. } => values[first],
                    Scale::Texts => first as f64,
                },
                y: interval.estimate,
                low: interval.low.unwrap_or(interval.estimate),
                high: interval.high.unwrap_or(interval.estimate),
            });
        }
    }
    let sorted = lines.into_iter().map(|(_, mut line)| {
        line.marks.sort_by(|a, b| a.x.total_cmp(&b.x));
        line
    });
    sorted.collect()
}

fn heading(drawing: &mut Drawing, plan: &Plan, report: &Report, metric: Shown) {
    let seeds = crate::console::counted(report.seeds as usize, "seed");
    let what = match metric {
        Shown::Goal => "share",
        Shown::Mean(_) => "mean",
    };
    let faults = plan
        .profile()
        .map_or(String::new(), |name| format!(", profile {name}"));
    let subtitle = format!("{what} over {seeds}{faults}; bands: 95 % intervals");
    drawing.text((CORNER.0, 26.0), Anchor::Start, &*report.title, 16.0, INK);
    drawing.text((CORNER.0, 44.0), Anchor::Start, subtitle, 12.5, INK);
    drawing.text(
        (CORNER.0 - 44.0, CORNER.1 - 12.0),
        Anchor::Start,
        metric.label(),
        12.0,
        INK,
    );
}

/// The part of the plane that is shown.
struct Frame {
    low: Spot,
    high: Spot,
}

impl Frame {
    fn around(lines: &[Line], metric: Shown) -> Frame {
        let marks = || lines.iter().flat_map(|line| &line.marks);
        let span = |low: f64, high: f64, room: f64| match high - low {
            _ if low > high => (0.0, 1.0),
            0.0 => (low - 0.5, high + 0.5),
            length => (low - room * length, high + room * length),
        };
        let least = |of: fn(&Mark) -> f64| marks().map(of).fold(f64::INFINITY, f64::min);
        let most = |of: fn(&Mark) -> f64| marks().map(of).fold(f64::NEG_INFINITY, f64::max);
        let x = span(least(|mark| mark.x), most(|mark| mark.x), 0.03);
        let y = match metric {
            Shown::Goal => (-3.0, 103.0),
            // Zero is shown unless the values are far from it.
            Shown::Mean(_) => match (least(|mark| mark.low), most(|mark| mark.high)) {
                (low, high) if 0.0 < low && low < 0.5 * high => span(0.0, high, 0.05),
                (low, high) => span(low, high, 0.05),
            },
        };
        Frame {
            low: (x.0, y.0),
            high: (x.1, y.1),
        }
    }

    fn spot(&self, x: f64, y: f64) -> Spot {
        let part = |value: f64, low: f64, high: f64| (value - low) / (high - low);
        (
            CORNER.0 + part(x, self.low.0, self.high.0) * FIELD.0,
            CORNER.1 + (1.0 - part(y, self.low.1, self.high.1)) * FIELD.1,
        )
    }

    fn draw_axes(&self, drawing: &mut Drawing, plan: &Plan, scale: &Scale) {
        let (left, top) = CORNER;
        let (right, bottom) = (left + FIELD.0, top + FIELD.1);
        let (thin, ink) = (Stroke::solid(GRID, 1.0), Stroke::solid(INK, 1.0));
        let axis = &plan.axes()[0];
        let numbers: Vec<(f64, String)> = match scale {
            Scale::Numbers { .. } => {
                let step = step_for(self.high.0 - self.low.0);
                let all = ticks(self.low.0, self.high.0, step);
                all.map(|x| (x, label(x, step))).collect()
            }
            Scale::Texts => {
                let texts = axis.values.iter().enumerate();
                texts
                    .map(|(index, text)| (index as f64, text.clone()))
                    .collect()
            }
        };
        for (x, text) in numbers {
            let at = self.spot(x, 0.0).0;
            drawing.line(vec![(at, top), (at, bottom)], thin);
            drawing.line(vec![(at, bottom), (at, bottom + 4.0)], ink);
            drawing.text((at, bottom + 17.0), Anchor::Middle, text, 12.0, INK);
        }
        let step = step_for(self.high.1 - self.low.1);
        for y in ticks(self.low.1, self.high.1, step) {
            let at = self.spot(0.0, y).1;
            drawing.line(vec![(left, at), (right, at)], thin);
            drawing.line(vec![(left - 4.0, at), (left, at)], ink);
            drawing.text(
                (left - 8.0, at + 4.0),
                Anchor::End,
                label(y, step),
                12.0,
                INK,
            );
        }
        let name = match scale {
            Scale::Numbers { unit, .. } if !unit.is_empty() => format!("{} in {unit}", axis.field),
            _ if axis.field == starl_sweep::FLEET => "robots".to_string(),
            _ => axis.field.clone(),
        };
        let middle = ((left + right) / 2.0, bottom + 38.0);
        drawing.text(middle, Anchor::Middle, name, 12.0, INK);
        drawing.push(Shape::Line {
            points: vec![(left, top), (right, top), (right, bottom), (left, bottom)],
            closed: true,
            fill: None,
            stroke: Some(ink),
        });
    }

    fn draw_band(&self, drawing: &mut Drawing, line: &Line, color: Color) {
        let highs = self.spots(line, |mark| mark.high);
        let lows = self.spots(line, |mark| mark.low);
        drawing.push(Shape::Line {
            points: highs.chain(lows.rev()).collect(),
            closed: true,
            fill: Some(Fill {
                color,
                opacity: 0.18,
            }),
            stroke: None,
        });
    }

    fn draw_line(&self, drawing: &mut Drawing, line: &Line, color: Color) {
        let spots = || self.spots(line, |mark| mark.y);
        drawing.line(spots().collect(), Stroke::solid(color, 2.0));
        for center in spots() {
            drawing.push(Shape::Circle {
                center,
                radius: 3.0,
                fill: Some(Fill::solid(color)),
                stroke: None,
            });
        }
    }

    fn spots(&self, line: &Line, of: fn(&Mark) -> f64) -> impl DoubleEndedIterator<Item = Spot> {
        let marks = line.marks.iter();
        marks.map(move |mark| self.spot(mark.x, of(mark)))
    }
}

/// Names the lines, to the right of the field; returns the right end of the names.
fn legend(drawing: &mut Drawing, lines: &[Line], omitted: usize) -> f64 {
    let left = CORNER.0 + FIELD.0 + 20.0;
    let mut right = left;
    let mut write = |row: usize, text: &str, drawing: &mut Drawing| {
        let y = CORNER.1 + (row as f64 + 0.5) * ROW;
        drawing.text((left + 30.0, y + 4.0), Anchor::Start, text, 12.5, INK);
        right = right.max(left + 30.0 + text_width(text, 12.5));
        y
    };
    for (row, line) in lines.iter().enumerate() {
        let y = write(row, &line.name, drawing);
        let stroke = Stroke::solid(color(row, lines.len()), 2.0);
        drawing.line(vec![(left, y), (left + 22.0, y)], stroke);
    }
    if omitted > 0 {
        write(
            lines.len(),
            &format!("{omitted} more are not shown"),
            drawing,
        );
    }
    right
}
