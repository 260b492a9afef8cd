//! Walks through the records of an MCAP file, those inside chunks included.
//!
//! Written for files that may be damaged or forged: every length is checked before it is used,
//! memory grows only with bytes that are really there, every checksum is compared, and the file must
//! end as MCAP files do. Source: the MCAP specification, format version 0. Compressed chunks are
//! refused.

use crate::TraceError;
use crate::error::Progress;
use crate::fields::Fields;
use mcap::MAGIC;
use mcap::records::op;
use std::io::{ErrorKind, Read};

/// No record outside a chunk, and no chunk, may be longer, bytes: ours are about a mebibyte.
const LONGEST: u64 = 1 << 30;

/// A record's kind and the bytes of its body.
pub(crate) struct RawRecord<'a> {
    pub opcode: u8,
    pub body: &'a [u8],
}

/// Reads records one after the other; holds one chunk at a time.
pub(crate) struct Container<R> {
    source: R,
    /// The progress of reading; the decoder of records counts them here.
    pub progress: Progress,
    /// The body of the record outside chunks that was read last.
    body: Vec<u8>,
    /// The rest of the chunk in `body`, if that is a chunk.
    chunk: core::ops::Range<usize>,
    /// Checksum of the section that is being read.
    checksum: crc32fast::Hasher,
    /// Whether the data section has ended.
    in_summary: bool,
}

impl<R: Read> Container<R> {
    /// Checks how the file begins.
    pub fn new(source: R) -> Result<Container<R>, TraceError> {
        let mut container = Container {
            source,
            progress: Progress::default(),
            body: Vec::new(),
            chunk: 0..0,
            checksum: crc32fast::Hasher::new(),
            in_summary: false,
        };
        match container.take(MAGIC.len() as u64) {
            Ok(()) if container.body == MAGIC => {
                container.checksum.update(MAGIC);
                Ok(container)
            }
            Err(error @ TraceError::Input { .. }) => Err(error),
            Ok(()) => Err(TraceError::NotMcap),
            Err(_) if MAGIC.starts_with(&container.body) && !container.body.is_empty() => {
                Err(TraceError::Truncated(container.progress))
            }
            Err(_) => Err(TraceError::NotMcap),
        }
    }

    /// The next record, or none at the end of a whole file.
    pub fn next(&mut self) -> Result<Option<RawRecord<'_>>, TraceError> {
        loop {
            if !self.chunk.is_empty() {
                return self.next_in_chunk().map(Some);
            }
            let opcode = self.next_in_file()?;
            match opcode {
                op::CHUNK => self.open_chunk()?,
                op::DATA_END => {}
                op::FOOTER => {
                    self.finish()?;
                    return Ok(None);
                }
                _ => {
                    let body = &self.body;
                    return Ok(Some(RawRecord { opcode, body }));
                }
            }
        }
    }

    /// An error about the bytes here.
    pub fn damaged(&self, what: impl Into<String>) -> TraceError {
        TraceError::Damaged {
            progress: self.progress,
            what: what.into(),
        }
    }

    /// Reads a record outside chunks into `body`, the checksums of its section compared.
    fn next_in_file(&mut self) -> Result<u8, TraceError> {
        let start = self.progress.offset;
        self.take(9)?;
        let head: [u8; 9] = self.body.as_slice().try_into().unwrap_or_default();
        let opcode = head[0];
        let length = u64::from_le_bytes([
            head[1], head[2], head[3], head[4], head[5], head[6], head[7], head[8],
        ]);
        if length > LONGEST {
            self.progress.offset = start;
            return Err(TraceError::TooLong {
                progress: self.progress,
                length,
            });
        }
        if opcode == op::DATA_END {
            let section = core::mem::take(&mut self.checksum);
            self.take(length)?;
            self.compare(section, &mut Fields(&self.body).u32(), "the data section")?;
            if core::mem::replace(&mut self.in_summary, true) {
                return Err(self.damaged("the data section ends twice"));
            }
            return Ok(opcode);
        }
        self.checksum.update(&head);
        self.take(length)?;
        // The last four bytes of the footer are the checksum of what is before them.
        let own = if opcode == op::FOOTER {
            self.body.len().saturating_sub(4)
        } else {
            self.body.len()
        };
        self.checksum.update(&self.body[..own]);
        Ok(opcode)
    }

    /// Compares the checksum of what follows the data section, and how the file ends.
    fn finish(&mut self) -> Result<(), TraceError> {
        let section = core::mem::take(&mut self.checksum);
        let mut fields = Fields(&self.body);
        let (start, _) = (fields.u64(), fields.u64());
        let mut saved = fields.u32();
        if !self.in_summary {
            return Err(self.damaged("the footer precedes the end of the data section"));
        }
        if start.is_none() {
            return Err(self.damaged("the footer is too short"));
        }
        self.compare(section, &mut saved, "the summary section")?;
        self.take(MAGIC.len() as u64)?;
        if self.body != MAGIC {
            return Err(self.damaged("the file does not end as an MCAP file does"));
        }
        let mut more = [0];
        match self.source.read(&mut more) {
            Ok(0) => Ok(()),
            Ok(_) => Err(self.damaged("there are more bytes after the end")),
            Err(error) => Err(self.input(&error)),
        }
    }

    /// Compares a checksum; a saved one of zero means that none was made.
    fn compare(
        &self,
        section: crc32fast::Hasher,
        saved: &mut Option<u32>,
        name: &str,
    ) -> Result<(), TraceError> {
        let saved = saved.ok_or_else(|| self.damaged(format!("{name} has no checksum")))?;
        if saved != 0 && saved != section.finalize() {
            return Err(self.damaged(format!("the checksum of {name} does not match")));
        }
        Ok(())
    }

    fn open_chunk(&mut self) -> Result<(), TraceError> {
        if self.in_summary {
            return Err(self.damaged("a chunk follows the end of the data section"));
        }
        let mut fields = Fields(&self.body);
        let header = (|| {
            let (_start, _end, size) = (fields.u64()?, fields.u64()?, fields.u64()?);
            Some((size, fields.u32()?, fields.text()?, fields.u64()?))
        })();
        let Some((size, checksum, compression, length)) = header else {
            return Err(self.damaged("a chunk's header is cut short"));
        };
        if !compression.is_empty() {
            let method = compression.to_string();
            return Err(TraceError::Compressed {
                progress: self.progress,
                method,
            });
        }
        let records = fields.0;
        if length != records.len() as u64 || size != length {
            return Err(self.damaged("a chunk's lengths do not agree"));
        }
        if checksum != 0 && checksum != crc32fast::hash(records) {
            return Err(self.damaged("the checksum of a chunk does not match"));
        }
        self.chunk = self.body.len() - records.len()..self.body.len();
        Ok(())
    }

    fn next_in_chunk(&mut self) -> Result<RawRecord<'_>, TraceError> {
        let mut fields = Fields(&self.body[self.chunk.clone()]);
        let head = fields.bytes(1).zip(fields.u64());
        let body = head.and_then(|(head, length)| Some((head[0], fields.bytes(length)?.len())));
        let Some((opcode, length)) = body else {
            return Err(self.damaged("a record reaches beyond its chunk"));
        };
        let start = self.chunk.start + 9;
        self.chunk.start = start + length;
        Ok(RawRecord {
            opcode,
            body: &self.body[start..start + length],
        })
    }

    /// Reads exactly so many bytes into `body`.
    fn take(&mut self, length: u64) -> Result<(), TraceError> {
        self.body.clear();
        // Grows as bytes arrive: a forged length alone costs nothing.
        match self
            .source
            .by_ref()
            .take(length)
            .read_to_end(&mut self.body)
        {
            Ok(read) if read as u64 == length => {
                self.progress.offset += length;
                Ok(())
            }
            Ok(read) => {
                self.progress.offset += read as u64;
                Err(TraceError::Truncated(self.progress))
            }
            Err(error) if error.kind() == ErrorKind::UnexpectedEof => {
                Err(TraceError::Truncated(self.progress))
            }
            Err(error) => Err(self.input(&error)),
        }
    }

    fn input(&self, error: &std::io::Error) -> TraceError {
        TraceError::Input {
            progress: self.progress,
            what: error.to_string(),
        }
    }
}
