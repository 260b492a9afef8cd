//! The fields of which the bodies of MCAP records are made.

/// Takes little-endian fields off the front of a record's body; none once it is too short.
pub(crate) struct Fields<'a>(pub &'a [u8]);

impl<'a> Fields<'a> {
    pub fn bytes(&mut self, length: u64) -> Option<&'a [u8]> {
        let (head, rest) = self.0.split_at_checked(usize::try_from(length).ok()?)?;
        self.0 = rest;
        Some(head)
    }

    pub fn u16(&mut self) -> Option<u16> {
        Some(u16::from_le_bytes(self.bytes(2)?.try_into().ok()?))
    }

    pub fn u32(&mut self) -> Option<u32> {
        Some(u32::from_le_bytes(self.bytes(4)?.try_into().ok()?))
    }

    pub fn u64(&mut self) -> Option<u64> {
        Some(u64::from_le_bytes(self.bytes(8)?.try_into().ok()?))
    }

    /// A text with its length before it.
    pub fn text(&mut self) -> Option<&'a str> {
        let length = self.u32()?;
        core::str::from_utf8(self.bytes(length.into())?).ok()
    }

    /// Pairs of texts with their length in bytes before them.
    pub fn pairs(&mut self) -> Option<Vec<(&'a str, &'a str)>> {
        let length = self.u32()?;
        let mut inner = Fields(self.bytes(length.into())?);
        let mut pairs = Vec::new();
        while !inner.0.is_empty() {
            pairs.push((inner.text()?, inner.text()?));
        }
        Some(pairs)
    }
}
