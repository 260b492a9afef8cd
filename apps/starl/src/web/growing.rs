//! A trace that grows while it is served: each page gets all of it, and new parts when they are written.

use crate::failure::Failure;
use axum::body::Body;
use axum::http::header::CONTENT_TYPE;
use axum::response::{IntoResponse, Response};
use starl_catalog::disk::reason;
use std::fs::{self, File};
use std::io::{self, Write};
use std::path::PathBuf;
use tokio::io::{AsyncReadExt, AsyncWriteExt, DuplexStream};
use tokio::sync::watch;
use tokio_util::io::ReaderStream;

/// Bytes that are on their way to a page at most.
const CHUNK: usize = 64 * 1024;

/// The file of the trace, which is there as long as this is.
pub struct Growing {
    path: PathBuf,
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
        let path = std::env::temp_dir().join(format!("starl-view-{}.mcap", std::process::id()));
        let file = File::create(&path).map_err(|error| Failure::file(&path, reason(&error)))?;
        let (sender, size) = watch::channel(0);
        Ok((Growing { path, size }, Writer { file, size: sender }))
    }

    /// Answers with the trace, which ends when its writer is dropped.
    pub async fn answer(&self) -> Response {
        let (sender, receiver) = tokio::io::duplex(CHUNK);
        let (path, size) = (self.path.clone(), self.size.clone());
        // A page that goes away ends its task by the next write.
        tokio::spawn(async move { hand_on(path, size, sender).await });
        let content = Body::from_stream(ReaderStream::with_capacity(receiver, CHUNK));
        ([(CONTENT_TYPE, "application/octet-stream")], content).into_response()
    }
}

impl Drop for Growing {
    fn drop(&mut self) {
        let _ = fs::remove_file(&self.path);
    }
}

impl Writer {
    /// Adds to it. Fails when it is not served any more.
    pub fn append(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.file.write_all(bytes)?;
        if self.size.is_closed() {
            return Err(io::ErrorKind::BrokenPipe.into());
        }
        self.size.send_modify(|size| *size += bytes.len() as u64);
        Ok(())
    }
}

async fn hand_on(
    path: PathBuf,
    mut size: watch::Receiver<u64>,
    mut to: DuplexStream,
) -> io::Result<()> {
    let mut file = tokio::fs::File::open(path).await?;
    let mut sent = 0;
    loop {
        let end = *size.borrow_and_update();
        let mut part = (&mut file).take(end - sent);
        sent += tokio::io::copy(&mut part, &mut to).await?;
        to.flush().await?;
        if size.changed().await.is_err() {
            return Ok(());
        }
    }
}
