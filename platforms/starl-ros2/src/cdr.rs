//! Common Data Representation: plain CDR, little-endian, behind four bytes that say so.
//!
//! Values are aligned to their size, measured from the end of those four bytes. A reader never reads beyond the end,
//! and reserves no more memory than the bytes that are there.

/// The four bytes that plain little-endian CDR begins with.
const HEADER: [u8; 4] = [0, 1, 0, 0];

/// Writes a message.
#[derive(Debug)]
pub struct Writer {
    bytes: Vec<u8>,
}

impl Default for Writer {
    fn default() -> Writer {
        Writer {
            bytes: HEADER.to_vec(),
        }
    }
}

impl Writer {
    /// The bytes of the message.
    pub fn finish(self) -> Vec<u8> {
        self.bytes
    }

    fn put<const SIZE: usize>(&mut self, value: [u8; SIZE]) {
        while !(self.bytes.len() - HEADER.len()).is_multiple_of(SIZE) {
            self.bytes.push(0);
        }
        self.bytes.extend(value);
    }

    /// A whole number without sign.
    pub fn u32(&mut self, value: u32) {
        self.put(value.to_le_bytes());
    }

    /// A whole number.
    pub fn i32(&mut self, value: i32) {
        self.put(value.to_le_bytes());
    }

    /// Numbers, one after the other.
    pub fn f64s(&mut self, values: &[f64]) {
        for value in values {
            self.put(value.to_le_bytes());
        }
    }

    /// Numbers, one after the other.
    pub fn f32s(&mut self, values: &[f32]) {
        for value in values {
            self.put(value.to_le_bytes());
        }
    }

    /// A list of numbers, with its length before it.
    pub fn f32_list(&mut self, values: &[f32]) {
        self.u32(values.len() as u32);
        self.f32s(values);
    }

    /// A text.
    pub fn text(&mut self, text: &str) {
        self.u32(text.len() as u32 + 1);
        self.bytes.extend(text.as_bytes());
        self.bytes.push(0);
    }
}

/// Reads a message. Its functions return `None` where the bytes end too early or make no sense.
#[derive(Clone, Copy, Debug)]
pub struct Reader<'a> {
    /// The message without its first four bytes.
    body: &'a [u8],
    at: usize,
}

impl<'a> Reader<'a> {
    /// A reader of a message; `None` if it is not plain little-endian CDR.
    pub fn new(bytes: &'a [u8]) -> Option<Reader<'a>> {
        let (header, body) = bytes.split_at_checked(HEADER.len())?;
        // The last two bytes are options, which say nothing about plain CDR.
        (header[..2] == HEADER[..2]).then_some(Reader { body, at: 0 })
    }

    fn take(&mut self, count: usize) -> Option<&'a [u8]> {
        let end = self.at.checked_add(count)?;
        let bytes = self.body.get(self.at..end)?;
        self.at = end;
        Some(bytes)
    }

    fn get<const SIZE: usize>(&mut self) -> Option<[u8; SIZE]> {
        self.at = self.at.next_multiple_of(SIZE);
        self.take(SIZE)?.try_into().ok()
    }

    /// A whole number without sign.
    pub fn u32(&mut self) -> Option<u32> {
        self.get().map(u32::from_le_bytes)
    }

    /// A whole number.
    pub fn i32(&mut self) -> Option<i32> {
        self.get().map(i32::from_le_bytes)
    }

    /// A number.
    pub fn f64(&mut self) -> Option<f64> {
        self.get().map(f64::from_le_bytes)
    }

    /// A number.
    pub fn f32(&mut self) -> Option<f32> {
        self.get().map(f32::from_le_bytes)
    }

    /// The given number of numbers, one after the other.
    pub fn f64s<const COUNT: usize>(&mut self) -> Option<[f64; COUNT]> {
        let mut values = [0.0; COUNT];
        for value in &mut values {
            *value = self.f64()?;
        }
        Some(values)
    }

    /// The length of a list whose items take `size` bytes at least. A length that the rest of the message has no room
    /// for makes no sense.
    pub fn length(&mut self, size: usize) -> Option<usize> {
        let length = self.u32()? as usize;
        let room = self.body.len() - self.at;
        (length <= room / size).then_some(length)
    }

    /// A list of numbers.
    pub fn f32_list(&mut self) -> Option<Vec<f32>> {
        let length = self.length(size_of::<f32>())?;
        (0..length).map(|_| self.f32()).collect()
    }

    /// A text.
    pub fn text(&mut self) -> Option<String> {
        let length = self.length(1)?;
        let bytes = self.take(length)?;
        // Some writers leave out the zero of an empty text.
        let text = bytes.strip_suffix(&[0]).unwrap_or(bytes);
        str::from_utf8(text).ok().map(str::to_string)
    }
}
