//! Writes JSON text into one buffer that is used again for every message.
//!
//! Numbers are written in the shortest form that reads back as the same bits, so a trace loses
//! nothing. JSON has no word for infinity or not-a-number: writing one is remembered in
//! [`Json::is_finite`] instead of passing unnoticed.

use starl_core::{Point, Time};

const DIGITS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

/// A JSON text in the making. Commas are put between members by [`Json::key`] and [`Json::item`].
#[derive(Debug, Default)]
pub(crate) struct Json {
    text: Vec<u8>,
    not_finite: bool,
}

impl Json {
    /// Starts a new text, keeping the memory.
    pub fn clear(&mut self) {
        self.text.clear();
        self.not_finite = false;
    }

    /// The text so far.
    pub fn bytes(&self) -> &[u8] {
        &self.text
    }

    /// Whether all numbers so far could be written.
    pub fn is_finite(&self) -> bool {
        !self.not_finite
    }

    /// Opens or closes an object or array: one of `{`, `}`, `[`, `]`.
    #[inline]
    pub fn mark(&mut self, bracket: u8) -> &mut Json {
        self.text.push(bracket);
        self
    }

    /// Puts a comma where an item of an array follows another.
    #[inline]
    pub fn item(&mut self) -> &mut Json {
        if !matches!(self.text.last(), None | Some(b'[' | b'{' | b':')) {
            self.text.push(b',');
        }
        self
    }

    /// A member's name, which needs no escapes.
    #[inline]
    pub fn key(&mut self, name: &'static str) -> &mut Json {
        self.item();
        self.text.push(b'"');
        self.text.extend_from_slice(name.as_bytes());
        self.text.extend_from_slice(b"\":");
        self
    }

    /// Text that is JSON already.
    pub fn raw(&mut self, json: &str) -> &mut Json {
        self.text.extend_from_slice(json.as_bytes());
        self
    }

    /// A whole number.
    #[inline]
    pub fn integer(&mut self, number: impl itoa::Integer) -> &mut Json {
        self.text
            .extend_from_slice(itoa::Buffer::new().format(number).as_bytes());
        self
    }

    /// A number, exactly.
    #[inline]
    pub fn number(&mut self, number: f64) -> &mut Json {
        if number.to_bits() == 0 {
            self.text.push(b'0');
        } else if number.is_finite() {
            let mut buffer = zmij::Buffer::new();
            self.text
                .extend_from_slice(buffer.format_finite(number).as_bytes());
        } else {
            self.not_finite = true;
            self.text.extend_from_slice(b"null");
        }
        self
    }

    /// A number to the nearest millionth, for views.
    #[inline]
    pub fn rounded(&mut self, number: f64) -> &mut Json {
        let rounded = (number * 1e6).round() / 1e6;
        // Too large to have millionths.
        self.number(if rounded.is_finite() { rounded } else { number })
    }

    /// True or false.
    pub fn boolean(&mut self, value: bool) -> &mut Json {
        self.raw(if value { "true" } else { "false" })
    }

    /// A text, with escapes where JSON wants them.
    pub fn string(&mut self, text: &str) -> &mut Json {
        self.text.push(b'"');
        let mut rest = text.as_bytes();
        while let Some(at) = rest
            .iter()
            .position(|&b| b < 0x20 || b == b'"' || b == b'\\')
        {
            self.text.extend_from_slice(&rest[..at]);
            match rest[at] {
                quoted @ (b'"' | b'\\') => self.text.extend_from_slice(&[b'\\', quoted]),
                b'\n' => self.text.extend_from_slice(b"\\n"),
                control => {
                    let hexadecimal = |nibble: u8| b"0123456789abcdef"[usize::from(nibble)];
                    self.text.extend_from_slice(b"\\u00");
                    self.text.push(hexadecimal(control >> 4));
                    self.text.push(hexadecimal(control & 15));
                }
            }
            rest = &rest[at + 1..];
        }
        self.text.extend_from_slice(rest);
        self.text.push(b'"');
        self
    }

    /// Bytes as a text in base 64 (RFC 4648, section 4).
    pub fn base64(&mut self, bytes: &[u8]) -> &mut Json {
        self.text.push(b'"');
        for chunk in bytes.chunks(3) {
            let byte = |at: usize| u32::from(chunk.get(at).copied().unwrap_or(0));
            let bits = byte(0) << 16 | byte(1) << 8 | byte(2);
            let digit = |shift: u32| DIGITS[(bits >> shift & 63) as usize];
            let mut text = [digit(18), digit(12), digit(6), digit(0)];
            for padding in &mut text[chunk.len() + 1..] {
                *padding = b'=';
            }
            self.text.extend_from_slice(&text);
        }
        self.text.push(b'"');
        self
    }

    /// A point as an object, exactly.
    #[inline]
    pub fn point(&mut self, point: Point) -> &mut Json {
        self.raw("{\"x\":").number(point.x);
        self.raw(",\"y\":").number(point.y);
        self.raw(",\"z\":").number(point.z);
        self.mark(b'}')
    }

    /// Points as an array of objects, exactly.
    pub fn points(&mut self, points: &[Point]) -> &mut Json {
        self.mark(b'[');
        for &point in points {
            self.item().point(point);
        }
        self.mark(b']')
    }

    /// A point or size as an object, to the nearest micrometre.
    pub fn rounded_point(&mut self, point: Point) -> &mut Json {
        self.raw("{\"x\":").rounded(point.x);
        self.raw(",\"y\":").rounded(point.y);
        self.raw(",\"z\":").rounded(point.z);
        self.mark(b'}')
    }

    /// A moment as Foxglove's schemas have it.
    pub fn time(&mut self, at: Time) -> &mut Json {
        self.raw("{\"sec\":").integer(at.0 / 1_000_000_000);
        self.raw(",\"nsec\":").integer(at.0 % 1_000_000_000);
        self.mark(b'}')
    }
}

/// The bytes of a text in base 64; none where it is not one.
pub(crate) fn from_base64(text: &str) -> Option<Vec<u8>> {
    let text = text.as_bytes();
    if !text.len().is_multiple_of(4) {
        return None;
    }
    let mut bytes = Vec::with_capacity(text.len() / 4 * 3);
    let groups = text.len() / 4;
    for (index, group) in text.chunks_exact(4).enumerate() {
        let padding = group
            .iter()
            .rev()
            .take_while(|&&digit| digit == b'=')
            .count();
        if padding > 2 || (padding > 0 && index + 1 < groups) {
            return None;
        }
        let mut bits = 0u32;
        for &digit in &group[..4 - padding] {
            let value = DIGITS.iter().position(|&known| known == digit)?;
            bits = bits << 6 | value as u32;
        }
        bits <<= 6 * padding as u32;
        bytes.extend_from_slice(&bits.to_be_bytes()[1..4 - padding]);
    }
    Some(bytes)
}
