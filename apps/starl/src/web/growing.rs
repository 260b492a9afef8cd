//! A trace that grows while it is served: each page gets all of it, and new parts when they are written.

use crate::failure::Failure;
use axum::body::Body;
use axum::http::header::CONTENT_TYPE;
use axum::response::{IntoResponse, Response};
use starl_catalog::disk::reason;
use std::fs;
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::sync::{Arc, Mutex, PoisonError};
use tokio::io::{AsyncWriteExt, DuplexStream};
use tokio::sync::watch;
use tokio_util::io::ReaderStream;

/// Bytes that are on their way to a page at most.
const CHUNK: usize = 64 * 1024;

/// A file without a name, so that nothing is left of it when the process ends in any way.
#[derive(Clone)]
struct File(Arc<Mutex<fs::File>>);

impl File {
    fn create() -> Result<File, Failure> {
        let file = tempfile::tempfile()
            .map_err(|error| Failure::file(&std::env::temp_dir(), reason(&error)))?;
        Ok(File(Arc::new(Mutex::new(file))))
    }

    /// Goes to this place in the file and does something there.
    fn at<T>(
        &self,
        place: SeekFrom,
        act: impl FnOnce(&mut fs::File) -> io::Result<T>,
    ) -> io::Result<T> {
        let mut file = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        file.seek(place)?;
        act(&mut file)
    }
}

/// The trace so far.
pub struct Growing {
    file: File,
    /// How many bytes are in the file; closed when it is complete.
    size: watch::Receiver<u64>,
}

/// The end at which it grows.
pub struct Writer {
    file: File,
    size: watch::Sender<u64>,
}

impl Growing {
    /// An empty one.
    pub fn create() -> Result<(Growing, Writer), Failure> {
        let file = File::create()?;
        let (sender, size) = watch::channel(0);
        let writer = Writer {
            file: file.clone(),
            size: sender,
        };
        Ok((Growing { file, size }, writer))
    }

    /// Answers with the trace, which ends when its writer is dropped.
    pub async fn answer(&self) -> Response {
        let (sender, receiver) = tokio::io::duplex(CHUNK);
        let (file, size) = (self.file.clone(), self.size.clone());
        // A page that goes away ends its task by the next write.
        tokio::spawn(async move { hand_on(file, size, sender).await });
        let content = Body::from_stream(ReaderStream::with_capacity(receiver, CHUNK));
        ([(CONTENT_TYPE, "application/octet-stream")], content).into_response()
    }
}

impl Writer {
    /// Adds to it. Fails when it is not served any more.
    pub fn append(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.file
            .at(SeekFrom::End(0), |file| file.write_all(bytes))?;
        if self.size.is_closed() {
            return Err(io::ErrorKind::BrokenPipe.into());
        }
        self.size.send_modify(|size| *size += bytes.len() as u64);
        Ok(())
    }
}

async fn hand_on(
    file: File,
    mut size: watch::Receiver<u64>,
    mut to: DuplexStream,
) -> io::Result<()> {
    let mut sent = 0;
    loop {
        let end = *size.borrow_and_update();
        while sent < end {
            let mut part = vec![0; CHUNK.min((end - sent) as usize)];
            let file = file.clone();
            let read = tokio::task::spawn_blocking(move || {
                file.at(SeekFrom::Start(sent), |file| file.read_exact(&mut part))?;
                io::Result::Ok(part)
            });
            let part = read.await??;
            to.write_all(&part).await?;
            sent += part.len() as u64;
        }
        to.flush().await?;
        if size.changed().await.is_err() {
            return Ok(());
        }
    }
}
