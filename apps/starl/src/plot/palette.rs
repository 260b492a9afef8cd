//! Colours that people with and without colour blindness tell apart.

use super::drawing::Color;

pub const BLACK: Color = [0, 0, 0];
pub const WHITE: Color = [255, 255, 255];
/// Text and axes.
pub const INK: Color = [51, 51, 51];
/// Lines that help the eye.
pub const GRID: Color = [232, 232, 232];
/// Obstacles.
pub const OBSTACLE: Color = [176, 176, 176];
/// Outlines of obstacles.
pub const OBSTACLE_EDGE: Color = [110, 110, 110];
/// Waypoints; no robot has it.
pub const WAY_POINT: Color = [214, 20, 20];

/// Things to find; no robot has it.
pub const THING: Color = [150, 0, 110];
/// Crashes; no robot has it.
pub const CRASH: Color = [150, 20, 20];

/// Okabe and Ito (2008), "Color Universal Design", without black, and without its vermilion, which
/// would be mistaken for a waypoint; the yellow is darker, to stand out on white.
const EIGHT: [Color; 8] = [
    [0, 114, 178],
    [230, 159, 0],
    [0, 158, 115],
    [204, 121, 167],
    [86, 180, 233],
    [120, 94, 40],
    [90, 60, 160],
    [190, 175, 0],
];

/// The colour of one among this number.
pub fn color(index: usize, of: usize) -> Color {
    if of <= EIGHT.len() {
        return EIGHT[index % EIGHT.len()];
    }
    // Hues spread by the golden ratio, so that neighbours in the order differ most; three
    // lightnesses, which colour blindness leaves alone.
    let hue = (0.58 + index as f64 * 0.618_033_988_749_895).fract();
    let lightness = [0.36, 0.52, 0.66][index % 3];
    from_hsl(hue, 0.75, lightness)
}

/// The colour with this hue (0 to 1 once round, from red over green), saturation and lightness.
fn from_hsl(hue: f64, saturation: f64, lightness: f64) -> Color {
    let reach = saturation * lightness.min(1.0 - lightness);
    let channel = |offset: f64| {
        let k = (offset + hue * 12.0) % 12.0;
        let value = lightness - reach * (k - 3.0).min(9.0 - k).clamp(-1.0, 1.0);
        (value * 255.0).round() as u8
    };
    [channel(0.0), channel(8.0), channel(4.0)]
}
