//! Reads world files: drawings in SVG, and those of StarL 1.5: waypoints, starts, things and obstacles, a
//! line for each.
//!
//! Lengths are in millimetres, headings in degrees, times in milliseconds; see
//! `docs/reference/world-files.md`. Errors name the line and the column of the value.

mod drawing;
mod word;

use super::contents::Contents;
use super::names::Names;
use super::obstacle::explain;
use super::report::{Origin, Report};
use super::{Placed, suggest};
use crate::scenario::{Thing, WorldObstacle};
use starl_core::{ConvexPolygon, Duration, Obstacle, Point, Pose, Time, WayPoint, math};
use word::{Word, words};

/// Adds the contents of a file to the world.
pub(super) fn read(
    name: &str,
    bytes: &[u8],
    names: &Names,
    contents: &mut Contents,
    report: &Report,
) {
    let text = match std::str::from_utf8(bytes) {
        Ok(text) => text,
        Err(error) => {
            let valid = String::from_utf8_lossy(&bytes[..error.valid_up_to()]);
            let origin = report.file(name, &valid);
            let end = Origin {
                offset: valid.len() as u32,
                ..origin
            };
            let help = "save the file as UTF-8";
            report.problem_with_help(end, "", "this is not text", help);
            return;
        }
    };
    let start = report.file(name, text);
    if text
        .trim_start_matches(['\u{feff}', ' ', '\t', '\r', '\n'])
        .starts_with('<')
    {
        return drawing::read(text, start, contents, report);
    }
    let mut file = File {
        names,
        first_stroke: drawing::next_group(contents),
        contents,
        report,
    };
    let mut offset = 0;
    for line in text.split('\n') {
        let begin = Origin {
            offset: offset as u32,
            ..start
        };
        let without_comment = line.split("//").next().unwrap_or_default();
        let line_of_fields = without_comment.trim_start_matches('\u{feff}');
        let skipped = without_comment.len() - line_of_fields.len();
        let begin = Origin {
            offset: begin.offset + skipped as u32,
            ..begin
        };
        // `Obstacles_square.wpt` of StarL 1.5 ends with a lifetime without an obstacle.
        if !matches!(line_of_fields.trim(), "" | "-1") {
            // The error was reported; the next line may be correct.
            let _ = file.line(line_of_fields, begin);
        }
        offset += line.len() + 1;
    }
}

/// The polygon of corners that are listed in another order than once round, as those of some worlds of StarL
/// 1.5 are (`Obstacles_square.wpt` has them crosswise); none if they are not the corners of a convex polygon in any
/// order.
fn in_order(points: &[Point]) -> Option<ConvexPolygon> {
    let center = points.iter().fold(Point::ZERO, |sum, &point| sum + point) / points.len() as f64;
    let mut sorted = points.to_vec();
    sorted.sort_by(|&a, &b| (a - center).heading().total_cmp(&(b - center).heading()));
    ConvexPolygon::new(&sorted).ok()
}

/// The number of a stroke, where the name of a waypoint says that it is one of the two ends: `12-A`, or `12-A_5`. The
/// drawings of StarL 1.5 for light painting name their points so.
fn stroke(name: &str) -> Option<u32> {
    let (number, end) = name.split_once('-')?;
    let suffix = end.strip_prefix(['A', 'B'])?;
    let is_number = |text: &str| !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit());
    let is_end = suffix.is_empty() || suffix.strip_prefix('_').is_some_and(is_number);
    number.parse().ok().filter(|_| is_end && is_number(number))
}

struct File<'a> {
    names: &'a Names,
    /// The group of the first stroke of a drawing.
    first_stroke: u32,
    contents: &'a mut Contents,
    report: &'a Report,
}

const KEYWORDS: [&str; 4] = ["WAY", "SENSE", "Obstacle", "Hidden"];

impl File<'_> {
    fn line(&mut self, line: &str, begin: Origin) -> Option<()> {
        let end = line.find([',', ';']).unwrap_or(line.len());
        let keyword = line[..end].trim();
        let separator = if line[end..].starts_with(';') {
            ';'
        } else {
            ','
        };
        let words = words(line, begin, separator);
        match (keyword, separator) {
            ("WAY", ',') => self.way(&words),
            ("SENSE", ',') => self.sense(&words),
            ("Obstacle", ';') => self.obstacle(&words, false),
            ("Hidden", ';') => self.obstacle(&words, true),
            _ if KEYWORDS.contains(&keyword) => {
                let separator = if separator == ';' {
                    "commas"
                } else {
                    "semicolons"
                };
                let message = format!("the values after {keyword} are separated by {separator}");
                self.complain(
                    words[0].origin,
                    message,
                    "see docs/reference/world-files.md",
                )
            }
            _ => {
                let help = suggest::help(keyword, &KEYWORDS, "a line begins with one of");
                let message = format!("there is no kind of line {keyword:?}");
                self.complain(words[0].origin, message, help.unwrap_or_default())
            }
        }
    }

    fn complain<T>(&self, origin: Origin, message: String, help: impl ToString) -> Option<T> {
        self.report
            .problem_with_help(origin, "", message, help.to_string());
        None
    }

    /// A finite number; millimetres and the like are all written plainly.
    fn number(&self, word: Word<'_>, what: &str) -> Option<f64> {
        match word.text.parse::<f64>() {
            Ok(number) if number.is_finite() && number.abs() <= 1e12 => Some(number),
            _ => {
                let message = format!("{:?} is not a number", word.text);
                self.complain(word.origin, message, format!("give {what}"))
            }
        }
    }

    /// A length in millimetres, as metres.
    fn length(&self, word: Word<'_>) -> Option<f64> {
        Some(self.number(word, "millimetres, without a unit")? / 1000.0)
    }

    fn point(&self, words: &[Word<'_>]) -> Option<Point> {
        let (x, y, z) = (
            self.length(words[0]),
            self.length(words[1]),
            self.length(words[2]),
        );
        Some(Point::new(x?, y?, z?))
    }

    fn name(&self, word: Word<'_>) -> Option<String> {
        if word.text.is_empty() {
            return self.complain(word.origin, "the name is missing".to_string(), "write one");
        }
        Some(word.text.to_string())
    }

    fn way(&mut self, words: &[Word<'_>]) -> Option<()> {
        if !matches!(words.len(), 5 | 6) {
            let message = format!("there are {} values after WAY", words.len() - 1);
            let help = "write WAY,x,y,z,NAME or WAY,x,y,z,NAME,number";
            return self.complain(words[0].origin, message, help);
        }
        let (position, name) = (self.point(&words[1..4]), self.name(words[4]));
        let (position, name) = (position?, name?);
        let origin = words[1].origin;
        if self.names.is_robot(&name) {
            let degrees = match words.get(5) {
                Some(word) => self.number(*word, "the heading in degrees")?,
                None => 0.0,
            };
            let heading = math::wrap_angle(math::radians(degrees));
            let value = (name, Pose::level(position, heading));
            self.contents.starts.push(Placed::in_file(origin, value));
            return Some(());
        }
        let group = match words.get(5).map(|word| word.text.parse::<u32>()) {
            None => 0,
            Some(Ok(group)) => group,
            Some(Err(_)) => {
                let message = format!("{:?} is not a group of waypoints", words[5].text);
                let help = "give a whole number, at least 0";
                return self.complain(words[5].origin, message, help);
            }
        };
        let value = match stroke(&name).filter(|_| words.len() == 5) {
            // The third value is the colour.
            Some(number) => WayPoint {
                name,
                position: position.at_height(0.0),
                group: self.first_stroke.saturating_add(number),
            },
            None => WayPoint {
                name,
                position,
                group,
            },
        };
        self.contents
            .way_points
            .push(Placed::in_file(origin, value));
        Some(())
    }

    fn sense(&mut self, words: &[Word<'_>]) -> Option<()> {
        if words.len() != 5 {
            let message = format!("there are {} values after SENSE", words.len() - 1);
            return self.complain(words[0].origin, message, "write SENSE,x,y,z,NAME");
        }
        let (position, name) = (self.point(&words[1..4]), self.name(words[4]));
        let value = Thing {
            name: name?,
            position: position?,
        };
        let placed = Placed::in_file(words[1].origin, value);
        self.contents.things.push(placed);
        Some(())
    }

    fn obstacle(&mut self, words: &[Word<'_>], hidden: bool) -> Option<()> {
        let keyword = words[0];
        let (lifetime, corners) = match words[1..].split_last() {
            Some((last, _)) if last.text.contains(',') => {
                let message = "the lifetime is missing at the end of the line".to_string();
                return self.complain(last.origin, message, "add ;-1 to keep it for ever");
            }
            Some(parts) => parts,
            None => (&keyword, &[][..]),
        };
        let points: Vec<Option<Point>> = corners.iter().map(|word| self.corner(*word)).collect();
        let mut points = points.into_iter().collect::<Option<Vec<Point>>>()?;
        if points.len() > 3 && points.first() == points.last() {
            points.pop();
        }
        let outline = ConvexPolygon::new(&points);
        let base = match outline.or_else(|error| in_order(&points).ok_or(error)) {
            Ok(base) => base,
            Err(error) => {
                let (message, help) = explain(error);
                return self.complain(keyword.origin, message, help);
            }
        };
        let expires = self.expiry(*lifetime)?;
        self.contents.obstacles.push(WorldObstacle {
            obstacle: Obstacle::polygon(base),
            hidden,
            expires,
        });
        Some(())
    }

    fn corner(&self, word: Word<'_>) -> Option<Point> {
        match words(word.text, word.origin, ',').as_slice() {
            [x, y] => {
                let (x, y) = (self.length(*x), self.length(*y));
                Some(Point::planar(x?, y?))
            }
            _ => {
                let message = format!("{:?} is not a corner", word.text);
                self.complain(word.origin, message, "write x,y in millimetres")
            }
        }
    }

    fn expiry(&self, word: Word<'_>) -> Option<Time> {
        match word.text.parse::<i64>() {
            Ok(-1) => Some(Time::NEVER),
            Ok(millis @ 1..=1_000_000_000_000) => {
                Some(Time::ZERO + Duration::from_millis(millis as u64))
            }
            _ => {
                let message = format!("{:?} is not a lifetime", word.text);
                let help = "give milliseconds, above 0, or -1 for ever";
                self.complain(word.origin, message, help)
            }
        }
    }
}
