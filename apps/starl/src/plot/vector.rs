//! Writes a picture as SVG.

use super::drawing::{Anchor, Color, Drawing, Fill, Shape, Spot, Stroke};
use core::fmt::Write;

/// Fonts of viewers that look like the font of the PNG.
const FONTS: &str = "DejaVu Sans, Verdana, Helvetica, Arial, sans-serif";

/// The whole file.
pub fn svg(drawing: &Drawing) -> String {
    let mut text = String::new();
    let (width, height) = (drawing.size.0.ceil(), drawing.size.1.ceil());
    // Writing to a String cannot fail.
    let _ = write!(
        text,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {width} {height}\" font-family=\"{FONTS}\">\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n"
    );
    let mut clips = 0;
    for shape in &drawing.shapes {
        let _ = element(&mut text, shape, &mut clips);
    }
    text.push_str("</svg>\n");
    text
}

fn element(text: &mut String, shape: &Shape, clips: &mut u32) -> core::fmt::Result {
    match shape {
        Shape::Line {
            points,
            closed,
            fill,
            stroke,
        } => {
            text.push_str("<path d=\"");
            for (index, &(x, y)) in points.iter().enumerate() {
                write!(
                    text,
                    "{}{} {}",
                    if index == 0 { 'M' } else { 'L' },
                    short(x),
                    short(y)
                )?;
            }
            text.push_str(if *closed { "Z\"" } else { "\"" });
            look(text, *fill, *stroke)?;
            text.push_str("/>\n");
        }
        Shape::Circle {
            center: (x, y),
            radius,
            fill,
            stroke,
        } => {
            write!(
                text,
                "<circle cx=\"{}\" cy=\"{}\" r=\"{}\"",
                short(*x),
                short(*y),
                short(*radius)
            )?;
            look(text, *fill, *stroke)?;
            text.push_str("/>\n");
        }
        Shape::Text {
            at: (x, y),
            anchor,
            text: words,
            size,
            color,
            rim,
        } => {
            write!(
                text,
                "<text x=\"{}\" y=\"{}\" font-size=\"{size}\"",
                short(*x),
                short(*y)
            )?;
            match anchor {
                Anchor::Start => {}
                Anchor::Middle => text.push_str(" text-anchor=\"middle\""),
                Anchor::End => text.push_str(" text-anchor=\"end\""),
            }
            if *rim {
                text.push_str(" stroke=\"#fff\" stroke-width=\"4\" stroke-linejoin=\"round\" paint-order=\"stroke\"");
            }
            writeln!(
                text,
                " fill=\"{}\">{}</text>",
                hexadecimal(*color),
                escaped(words)
            )?;
        }
        Shape::Clip(Some((from, to))) => clip(text, *from, *to, clips)?,
        Shape::Clip(None) => text.push_str("</g>\n"),
    }
    Ok(())
}

fn clip(text: &mut String, from: Spot, to: Spot, clips: &mut u32) -> core::fmt::Result {
    *clips += 1;
    writeln!(
        text,
        "<clipPath id=\"c{clips}\"><rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"/></clipPath>\n<g clip-path=\"url(#c{clips})\">",
        short(from.0),
        short(from.1),
        short(to.0 - from.0),
        short(to.1 - from.1)
    )
}

fn look(text: &mut String, fill: Option<Fill>, stroke: Option<Stroke>) -> core::fmt::Result {
    match fill {
        None => text.push_str(" fill=\"none\""),
        Some(Fill { color, opacity }) => {
            write!(text, " fill=\"{}\"", hexadecimal(color))?;
            if opacity < 1.0 {
                write!(text, " fill-opacity=\"{}\"", short(opacity))?;
            }
        }
    }
    if let Some(Stroke {
        color,
        width,
        opacity,
        dashed,
    }) = stroke
    {
        write!(
            text,
            " stroke=\"{}\" stroke-width=\"{}\"",
            hexadecimal(color),
            short(width)
        )?;
        text.push_str(" stroke-linejoin=\"round\"");
        if opacity < 1.0 {
            write!(text, " stroke-opacity=\"{}\"", short(opacity))?;
        }
        if dashed {
            let [dash, gap] = super::drawing::DASH;
            write!(text, " stroke-dasharray=\"{dash} {gap}\"")?;
        }
    }
    Ok(())
}

/// A number to the hundredth, without needless zeros.
fn short(number: f64) -> String {
    let text = format!("{number:.2}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" {
        "0".into()
    } else {
        text.into()
    }
}

fn hexadecimal([red, green, blue]: Color) -> String {
    format!("#{red:02x}{green:02x}{blue:02x}")
}

/// A text as XML has it; characters that XML forbids become a replacement character.
fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for character in text.chars() {
        match character {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\u{0}'..='\u{1f}' | '\u{fffe}' | '\u{ffff}' => out.push('\u{fffd}'),
            other => out.push(other),
        }
    }
    out
}
