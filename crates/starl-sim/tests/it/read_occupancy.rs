//! Dark pixels of a map become rectangles at the right place: from PGM, plain and raw, and from PNG.

use crate::reading::{self, Files};
use starl_core::{Obstacle, Point};
use starl_sim::read;

/// Four by three, dark at `#`: a block of two by two at the top left, and a pixel at the lower right.
const DARK: [&str; 3] = ["##..", "##..", "...#"];

fn obstacles(name: &str, bytes: Vec<u8>, more: &str) -> Vec<Obstacle> {
    let text = format!(
        "program = \"race\"\n[[world.occupancy]]\nimage = \"{name}\"\nresolution = \"500mm\"\n\
         origin = [10, 20]\n{more}\n[[robots]]\nmodel = \"create\"\nstart = [{{ position = [0, 0] }}]\n"
    );
    let mut files = Files::default();
    files.0.insert(name.to_string(), bytes);
    let read = read::scenario(&reading::request(&text, &[]), &files);
    let read = read
        .unwrap_or_else(|problems| panic!("{problems}"))
        .scenario;
    read.world
        .obstacles
        .into_iter()
        .map(|obstacle| obstacle.obstacle)
        .collect()
}

/// The pixels, row by row from the top: `dark` where there is a `#`, else `light`.
fn pixels(dark: u8, light: u8) -> Vec<u8> {
    DARK.iter()
        .flat_map(|row| row.bytes())
        .map(|c| if c == b'#' { dark } else { light })
        .collect()
}

fn check(obstacles: &[Obstacle]) {
    let corners: Vec<(Point, Point)> = obstacles
        .iter()
        .map(|obstacle| {
            let bounds = obstacle.bounds();
            (bounds.low.at_height(0.0), bounds.high.at_height(0.0))
        })
        .collect();
    let at = Point::planar;
    assert_eq!(
        corners,
        [
            (at(10.0, 20.5), at(11.0, 21.5)),
            (at(11.5, 20.0), at(12.0, 20.5))
        ]
    );
}

#[test]
fn plain_pgm_with_comments() {
    let values: Vec<String> = pixels(0, 9).iter().map(u8::to_string).collect();
    let text = format!("P2 # a map\n4 3\n# greatest\n9\n{}\n", values.join(" "));
    check(&obstacles("map.pgm", text.into_bytes(), ""));
}

#[test]
fn raw_pgm_of_one_and_of_two_bytes() {
    let mut bytes = b"P5\n4 3\n255\n".to_vec();
    bytes.extend(pixels(20, 254));
    check(&obstacles("map.pgm", bytes, ""));
    let mut bytes = b"P5 4 3 1000\n".to_vec();
    for dark in pixels(1, 0) {
        bytes.extend(if dark == 1 { [0, 10] } else { [3, 0xe8] });
    }
    check(&obstacles("map.pgm", bytes, ""));
}

#[test]
fn png_grey_coloured_and_transparent() {
    for (colour, samples) in [
        (png::ColorType::Grayscale, 1),
        (png::ColorType::Rgb, 3),
        (png::ColorType::Rgba, 4),
    ] {
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, 4, 3);
        encoder.set_color(colour);
        encoder.set_depth(png::BitDepth::Eight);
        let data: Vec<u8> = pixels(5, 250)
            .iter()
            .flat_map(|&grey| vec![grey; samples])
            .collect();
        let data: Vec<u8> = match samples {
            // Light pixels are given as black that cannot be seen.
            4 => pixels(255, 0)
                .iter()
                .flat_map(|&alpha| [0, 0, 0, alpha])
                .collect(),
            _ => data,
        };
        encoder
            .write_header()
            .unwrap()
            .write_image_data(&data)
            .unwrap();
        check(&obstacles("map.png", bytes, ""));
    }
}

#[test]
fn the_threshold_decides_and_white_is_never_an_obstacle() {
    let grey = b"P2 3 1 100 0 50 100".to_vec();
    assert_eq!(
        obstacles("map.pgm", grey.clone(), "threshold = 0.51").len(),
        1
    );
    let both = obstacles("map.pgm", grey.clone(), "threshold = 0.5");
    assert_eq!(both[0].bounds().high.x - both[0].bounds().low.x, 1.0);
    let all = obstacles("map.pgm", grey, "threshold = 0\nheight = [0, 1]");
    assert_eq!((all.len(), all[0].bounds().high.x), (1, 11.0));
    assert_eq!(all[0].bounds().high.z, 1.0);
}
