//! A trace whose messages can be read as soon as they are written.

use starl_core::Record;
use starl_trace::{Header, ViewOptions, WriteError, Writer};
use std::io::{self, Write};
use std::mem;
use std::sync::{Arc, Mutex, PoisonError};

/// A trace in the making. Its messages are not in chunks, since a chunk can be read only once it is whole.
pub struct Stream {
    writer: Writer<Chunks>,
    chunks: Chunks,
    /// The bytes that were not taken yet.
    fresh: Vec<u8>,
    /// How much of the writer's unfinished chunk is in `fresh` or was taken.
    known: usize,
}

/// The bytes of the writer: first the header, later chunks, whose messages are known then.
#[derive(Clone, Default)]
struct Chunks(Arc<Mutex<Vec<u8>>>);

impl Chunks {
    fn take(&self) -> Vec<u8> {
        mem::take(&mut *self.0.lock().unwrap_or_else(PoisonError::into_inner))
    }
}

impl Write for Chunks {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let mut all = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        all.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

impl Stream {
    /// A trace with this header.
    pub fn new(header: &Header) -> Result<Stream, WriteError> {
        let chunks = Chunks::default();
        // Without views each record is one message, so that none is in a chunk before it is known.
        let writer = Writer::new(chunks.clone(), header, &ViewOptions::none())?;
        Ok(Stream {
            fresh: chunks.take(),
            writer,
            chunks,
            known: 0,
        })
    }

    /// Adds a record; times do not go back. Records with numbers that are not finite are left out.
    pub fn write(&mut self, record: &Record) {
        if self.writer.write(record).is_err() {
            return;
        }
        if !self.chunks.take().is_empty() {
            self.known = 0;
        }
        let unfinished = self.writer.unfinished();
        self.fresh.extend_from_slice(&unfinished[self.known..]);
        self.known = unfinished.len();
    }

    /// The bytes added since the last time.
    pub fn take(&mut self) -> Vec<u8> {
        mem::take(&mut self.fresh)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use starl_core::{Event, Pose, RobotId, Time};

    #[test]
    fn an_unfinished_stream_is_a_readable_trace() {
        let mut stream = Stream::new(&Header::default()).unwrap();
        let mut bytes = stream.take();
        // More than a chunk.
        for count in 0..30_000 {
            stream.write(&Record {
                at: Time(count),
                robot: Some(RobotId(0)),
                event: Event::Moved(Pose::default()),
            });
            bytes.extend(stream.take());
        }
        let reader = starl_trace::Reader::new(&bytes[..]).unwrap();
        let mut count = 0;
        for record in reader {
            match record {
                Ok(record) => assert_eq!(record.at, Time(count)),
                Err(error) => {
                    assert!(error.is_missing_end(), "{error}");
                    break;
                }
            }
            count += 1;
        }
        assert_eq!(count, 30_000);
    }
}
