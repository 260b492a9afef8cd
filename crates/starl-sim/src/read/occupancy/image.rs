//! Decodes grey images: PGM by hand, PNG by the `png` crate.

use thiserror::Error;

/// A grey image, rows from the top.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Image {
    pub columns: usize,
    pub rows: usize,
    /// How dark each pixel is, from 0 (white) to 1 (black).
    pub darkness: Vec<f64>,
}

/// An image of more pixels is refused; it would be a map of a town at a pixel a centimetre.
const MOST_PIXELS: usize = 1 << 26;

/// Why an image cannot be read.
#[derive(Debug, Error)]
pub(super) enum ImageError {
    #[error("it begins like neither a PGM nor a PNG")]
    Unknown,
    #[error("it has no pixels")]
    Empty,
    #[error("{columns} by {rows} pixels are too many")]
    TooLarge { columns: usize, rows: usize },
    #[error("its {0} is missing or not a number")]
    Header(&'static str),
    #[error("its greatest value is {0}, not 1 to 65535")]
    Greatest(usize),
    #[error("it ends after {found} of {pixels} pixels")]
    Short { found: usize, pixels: usize },
    #[error("it has a pixel of {value}, above its greatest value {greatest}")]
    TooBright { value: usize, greatest: usize },
    #[error(transparent)]
    Png(#[from] png::DecodingError),
}

/// The image in a file.
pub(super) fn decode(bytes: &[u8]) -> Result<Image, ImageError> {
    if bytes.starts_with(b"P2") || bytes.starts_with(b"P5") {
        return pgm(bytes);
    }
    if bytes.starts_with(b"\x89PNG") {
        return png(bytes);
    }
    Err(ImageError::Unknown)
}

fn size(columns: usize, rows: usize) -> Result<usize, ImageError> {
    match columns.checked_mul(rows) {
        Some(0) => Err(ImageError::Empty),
        Some(pixels) if pixels <= MOST_PIXELS => Ok(pixels),
        _ => Err(ImageError::TooLarge { columns, rows }),
    }
}

/// Netpbm's PGM: magic, width, height, greatest value, then the values, from black to white; in P2 as
/// decimal numbers, in P5 as one or two bytes each, the high one first.
fn pgm(bytes: &[u8]) -> Result<Image, ImageError> {
    let mut reader = Numbers { bytes, at: 2 };
    let mut header = |what| reader.next().ok_or(ImageError::Header(what));
    let (columns, rows) = (header("width")?, header("height")?);
    let greatest = header("greatest value")?;
    if !(1..=65_535).contains(&greatest) {
        return Err(ImageError::Greatest(greatest));
    }
    let pixels = size(columns, rows)?;
    let values: Vec<usize> = if bytes[1] == b'2' {
        // Not more than there can be, whatever the header says.
        (&mut reader).take(pixels).collect()
    } else {
        let data = bytes.get(reader.at + 1..).unwrap_or_default();
        match greatest {
            ..=255 => data
                .iter()
                .take(pixels)
                .map(|&value| value.into())
                .collect(),
            _ => {
                let value = |pair: &[u8]| usize::from(pair[0]) << 8 | usize::from(pair[1]);
                data.chunks_exact(2).take(pixels).map(value).collect()
            }
        }
    };
    if values.len() < pixels {
        let found = values.len();
        return Err(ImageError::Short { found, pixels });
    }
    if let Some(&value) = values.iter().find(|&&value| value > greatest) {
        return Err(ImageError::TooBright { value, greatest });
    }
    let darkness = values
        .iter()
        .map(|&value| 1.0 - value as f64 / greatest as f64)
        .collect();
    Ok(Image {
        columns,
        rows,
        darkness,
    })
}

/// Decimal numbers between white space and comments.
struct Numbers<'a> {
    bytes: &'a [u8],
    at: usize,
}

impl Iterator for Numbers<'_> {
    type Item = usize;

    fn next(&mut self) -> Option<usize> {
        loop {
            match self.bytes.get(self.at)? {
                b'#' => {
                    let rest = &self.bytes[self.at..];
                    self.at += rest
                        .iter()
                        .position(|&byte| byte == b'\n')
                        .unwrap_or(rest.len());
                }
                byte if byte.is_ascii_whitespace() => self.at += 1,
                _ => break,
            }
        }
        let rest = &self.bytes[self.at..];
        let digits = rest.iter().take_while(|byte| byte.is_ascii_digit()).count();
        self.at += digits;
        std::str::from_utf8(&rest[..digits]).ok()?.parse().ok()
    }
}

fn png(bytes: &[u8]) -> Result<Image, ImageError> {
    let limits = png::Limits {
        bytes: 16 * MOST_PIXELS,
    };
    let mut decoder = png::Decoder::new_with_limits(std::io::Cursor::new(bytes), limits);
    decoder.set_transformations(png::Transformations::normalize_to_color8());
    let mut reader = decoder.read_info()?;
    let (columns, rows) = (reader.info().width as usize, reader.info().height as usize);
    let pixels = size(columns, rows)?;
    let length = reader
        .output_buffer_size()
        .ok_or(ImageError::TooLarge { columns, rows })?;
    let mut data = vec![0; length];
    let frame = reader.next_frame(&mut data)?;
    let samples = frame.color_type.samples();
    let colours = if samples >= 3 { 3 } else { 1 };
    let transparency = matches!(samples, 2 | 4);
    let darkness = |pixel: &[u8]| {
        let sum: f64 = pixel[..colours].iter().map(|&value| f64::from(value)).sum();
        let dark = 1.0 - sum / (255.0 * colours as f64);
        // Transparent pixels count as white.
        if transparency {
            dark * f64::from(pixel[samples - 1]) / 255.0
        } else {
            dark
        }
    };
    let darkness: Vec<f64> = data[..frame.buffer_size()]
        .chunks_exact(samples)
        .map(darkness)
        .collect();
    if darkness.len() != pixels {
        let found = darkness.len();
        return Err(ImageError::Short { found, pixels });
    }
    Ok(Image {
        columns,
        rows,
        darkness,
    })
}
