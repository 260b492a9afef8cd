//! Writes a picture as PNG: shapes by tiny-skia, letters from the outlines of DejaVu Sans.
//!
//! The font is part of the program because a machine that runs simulations often has none. Letters
//! are set one after the other by their widths; scripts that need more than that are legible at best.

use super::drawing::{Anchor, Color, DASH, Drawing, Fill, Shape, Spot, Stroke};
use super::palette::WHITE;
use tiny_skia::{
    FillRule, LineCap, LineJoin, Mask, Paint, Path, PathBuilder, Pixmap, Rect, StrokeDash,
    Transform,
};
use ttf_parser::{Face, OutlineBuilder};

/// The whole file, `scale` pixels for each unit of the drawing.
pub fn png(drawing: &Drawing, scale: f32) -> Vec<u8> {
    let side = |length: f64| (length.ceil().clamp(1.0, 8000.0) as f32 * scale) as u32;
    let pixels = Pixmap::new(side(drawing.size.0), side(drawing.size.1));
    let pixels = pixels.expect("no side is zero or too long");
    let face = Face::parse(dejavu::sans::regular(), 0).expect("the font is whole");
    let mut canvas = Canvas {
        pixels,
        scale,
        clip: None,
        face,
    };
    canvas.pixels.fill(tiny_skia::Color::WHITE);
    for shape in &drawing.shapes {
        canvas.draw(shape);
    }
    canvas.pixels.encode_png().expect("memory takes every byte")
}

struct Canvas<'a> {
    pixels: Pixmap,
    scale: f32,
    clip: Option<Mask>,
    face: Face<'a>,
}

impl Canvas<'_> {
    fn draw(&mut self, shape: &Shape) {
        match shape {
            Shape::Line {
                points,
                closed,
                fill,
                stroke,
            } => {
                if let Some(path) = polygon(points, *closed) {
                    self.path(&path, *fill, *stroke);
                }
            }
            Shape::Circle {
                center,
                radius,
                fill,
                stroke,
            } => {
                let (x, y) = (center.0 as f32, center.1 as f32);
                if let Some(path) = PathBuilder::from_circle(x, y, *radius as f32) {
                    self.path(&path, *fill, *stroke);
                }
            }
            Shape::Text {
                at,
                anchor,
                text,
                size,
                color,
                rim,
            } => {
                if let Some(path) = self.letters(*at, *anchor, text, *size) {
                    if *rim {
                        self.path(&path, None, Some(Stroke::solid(WHITE, 4.0)));
                    }
                    self.path(&path, Some(Fill::solid(*color)), None);
                }
            }
            Shape::Clip(None) => self.clip = None,
            Shape::Clip(Some((from, to))) => self.clip = self.mask(*from, *to),
        }
    }

    fn path(&mut self, path: &Path, fill: Option<Fill>, stroke: Option<Stroke>) {
        let transform = Transform::from_scale(self.scale, self.scale);
        let (pixels, clip) = (&mut self.pixels, self.clip.as_ref());
        if let Some(Fill { color, opacity }) = fill {
            pixels.fill_path(
                path,
                &paint(color, opacity),
                FillRule::Winding,
                transform,
                clip,
            );
        }
        if let Some(Stroke {
            color,
            width,
            opacity,
            dashed,
        }) = stroke
        {
            let dash =
                dashed.then(|| StrokeDash::new(DASH.map(|length| length as f32).to_vec(), 0.0));
            let line = tiny_skia::Stroke {
                width: width as f32,
                line_join: LineJoin::Round,
                line_cap: LineCap::Butt,
                dash: dash.flatten(),
                ..tiny_skia::Stroke::default()
            };
            pixels.stroke_path(path, &paint(color, opacity), &line, transform, clip);
        }
    }

    fn mask(&self, from: Spot, to: Spot) -> Option<Mask> {
        let mut mask = Mask::new(self.pixels.width(), self.pixels.height())?;
        let rect = Rect::from_ltrb(from.0 as f32, from.1 as f32, to.0 as f32, to.1 as f32)?;
        let transform = Transform::from_scale(self.scale, self.scale);
        mask.fill_path(
            &PathBuilder::from_rect(rect),
            FillRule::Winding,
            true,
            transform,
        );
        Some(mask)
    }

    /// The outlines of a text's letters.
    fn letters(&self, at: Spot, anchor: Anchor, text: &str, size: f64) -> Option<Path> {
        let face = &self.face;
        let unit = size as f32 / f32::from(face.units_per_em());
        let glyphs: Vec<_> = (text.chars())
            .map(|letter| face.glyph_index(letter).unwrap_or_default())
            .map(|glyph| {
                (
                    glyph,
                    f32::from(face.glyph_hor_advance(glyph).unwrap_or(0)) * unit,
                )
            })
            .collect();
        let width: f32 = glyphs.iter().map(|(_, advance)| advance).sum();
        let before = match anchor {
            Anchor::Start => 0.0,
            Anchor::Middle => width / 2.0,
            Anchor::End => width,
        };
        let mut outline = Outline {
            builder: PathBuilder::new(),
            x: at.0 as f32 - before,
            y: at.1 as f32,
            unit,
        };
        for (glyph, advance) in glyphs {
            face.outline_glyph(glyph, &mut outline);
            outline.x += advance;
        }
        outline.builder.finish()
    }
}

/// The width of a text.
#[cfg(test)]
pub fn width(text: &str, size: f64) -> f64 {
    let face = Face::parse(dejavu::sans::regular(), 0).expect("the font is whole");
    let unit = size / f64::from(face.units_per_em());
    let advance = |letter| {
        let glyph = face.glyph_index(letter).unwrap_or_default();
        f64::from(face.glyph_hor_advance(glyph).unwrap_or(0)) * unit
    };
    text.chars().map(advance).sum()
}

fn paint(color: Color, opacity: f64) -> Paint<'static> {
    let mut paint = Paint {
        anti_alias: true,
        ..Paint::default()
    };
    paint.set_color_rgba8(
        color[0],
        color[1],
        color[2],
        (opacity * 255.0).round() as u8,
    );
    paint
}

fn polygon(points: &[Spot], closed: bool) -> Option<Path> {
    let mut builder = PathBuilder::new();
    for (index, &(x, y)) in points.iter().enumerate() {
        match index {
            0 => builder.move_to(x as f32, y as f32),
            _ => builder.line_to(x as f32, y as f32),
        }
    }
    if closed {
        builder.close();
    }
    builder.finish()
}

/// Puts a letter's outline, whose y axis points up, at its place.
struct Outline {
    builder: PathBuilder,
    x: f32,
    y: f32,
    unit: f32,
}

impl Outline {
    fn place(&self, x: f32, y: f32) -> (f32, f32) {
        (self.x + x * self.unit, self.y - y * self.unit)
    }
}

impl OutlineBuilder for Outline {
    fn move_to(&mut self, x: f32, y: f32) {
        let (x, y) = self.place(x, y);
        self.builder.move_to(x, y);
    }

    fn line_to(&mut self, x: f32, y: f32) {
        let (x, y) = self.place(x, y);
        self.builder.line_to(x, y);
    }

    fn quad_to(&mut self, x1: f32, y1: f32, x: f32, y: f32) {
        let ((x1, y1), (x, y)) = (self.place(x1, y1), self.place(x, y));
        self.builder.quad_to(x1, y1, x, y);
    }

    fn curve_to(&mut self, x1: f32, y1: f32, x2: f32, y2: f32, x: f32, y: f32) {
        let ((x1, y1), (x2, y2), (x, y)) =
            (self.place(x1, y1), self.place(x2, y2), self.place(x, y));
        self.builder.cubic_to(x1, y1, x2, y2, x, y);
    }

    fn close(&mut self) {
        self.builder.close();
    }
}
