//! Texts beside the things that they name: none lies over another.

use super::drawing::{Anchor, Color, Drawing, Shape, Spot};

/// A rectangle of the picture: its upper left and its lower right corner.
type Area = (Spot, Spot);

/// The longest name that is written in full.
const LONGEST: usize = 40;

/// The width of a text at the most: exact widths depend on the viewer's font. Measured on DejaVu Sans and Verdana.
pub fn text_width(text: &str, size: f64) -> f64 {
    let width = |letter: char| match letter {
        ' ' | '.' | ',' | ':' | ';' | '\'' | '|' | '(' | ')' | '[' | ']' | '/' | '-' | 'i'
        | 'j' | 'l' | 'f' | 't' | 'r' | 'I' | 'J' => 0.46,
        'm' | 'w' | 'M' | 'W' | '@' | '%' => 1.08,
        'a'..='z' | '0'..='9' | '_' => 0.65,
        letter if letter.is_ascii() => 0.85,
        _ => 1.08,
    };
    text.chars().map(width).sum::<f64>() * size
}

/// A name, shortened if it is very long.
pub fn short_name(name: &str) -> String {
    match name.char_indices().nth(LONGEST) {
        Some((end, _)) => format!("{}\u{2026}", &name[..end]),
        None => name.into(),
    }
}

/// The look of a label.
#[derive(Clone, Copy)]
pub struct Style {
    /// Height of a line.
    pub size: f64,
    pub color: Color,
    /// Whether it is written even without free space.
    pub needed: bool,
}

/// The room for labels.
pub struct Labels {
    /// The part of the picture that labels may use.
    within: Area,
    /// The places that are taken.
    taken: Vec<Area>,
}

impl Labels {
    pub fn new(within: Area) -> Labels {
        let taken = Vec::new();
        Labels { within, taken }
    }

    /// Keeps labels off a disc.
    pub fn keep_off(&mut self, (x, y): Spot, radius: f64) {
        let corner = |sign: f64| (x + sign * radius, y + sign * radius);
        self.taken.push((corner(-1.0), corner(1.0)));
    }

    /// Keeps labels off a text that begins at a spot.
    pub fn keep_off_text(&mut self, (x, y): Spot, text: &str, size: f64) {
        let right = x + text_width(text, size);
        self.taken
            .push(((x, y - size * 0.8), (right, y + size * 0.2)));
    }

    /// Writes a label at the first free place around a spot, `gap` away from it.
    pub fn write(&mut self, drawing: &mut Drawing, at: Spot, gap: f64, text: &str, style: Style) {
        let (width, height) = (text_width(text, style.size), style.size);
        let left_and_base = |(dx, dy): (f64, f64)| {
            let x = at.0 + dx * gap + (dx - 1.0) / 2.0 * width;
            let y = at.1 + dy * gap + (dy + 1.0) / 2.0 * height * 0.75;
            (x, y)
        };
        let area = |(x, y): Spot| ((x, y - height * 0.8), (x + width, y + height * 0.2));
        let mut places = AROUND.into_iter().map(left_and_base);
        let found = places.find(|&place| self.is_free(area(place)));
        let Some(place) = found.or(style.needed.then(|| left_and_base(AROUND[0]))) else {
            return;
        };
        self.taken.push(area(place));
        drawing.push(Shape::Text {
            at: place,
            anchor: Anchor::Start,
            text: text.into(),
            size: style.size,
            color: style.color,
            rim: true,
        });
    }

    fn is_free(&self, (low, high): Area) -> bool {
        let (least, most) = self.within;
        let is_within = low.0 > least.0 && low.1 > least.1 && high.0 < most.0 && high.1 < most.1;
        let meets =
            |(from, to): &Area| low.0 < to.0 && from.0 < high.0 && low.1 < to.1 && from.1 < high.1;
        is_within && !self.taken.iter().any(meets)
    }
}

/// Directions from a spot to its label, x to the right and y down, the best ones first.
const AROUND: [(f64, f64); 8] = [
    (1.0, -1.0),
    (1.0, 0.0),
    (1.0, 1.0),
    (-1.0, -1.0),
    (-1.0, 0.0),
    (-1.0, 1.0),
    (0.0, -1.0),
    (0.0, 1.0),
];
