//! Serves a trace in parts, so that a page need not load all of it (RFC 9110, section 14).

use axum::body::Body;
use axum::http::StatusCode;
use axum::http::header::{
    ACCEPT_RANGES, CONTENT_LENGTH, CONTENT_RANGE, CONTENT_TYPE, HeaderMap, IF_RANGE, RANGE,
};
use axum::response::{IntoResponse, Response};
use starl_catalog::disk::reason;
use std::io::{self, SeekFrom};
use std::ops::Range;
use std::path::Path;
use tokio::fs::File;
use tokio::io::{AsyncReadExt, AsyncSeekExt};
use tokio_util::io::ReaderStream;

/// Bytes that are read at once.
const CHUNK: usize = 64 * 1024;

/// The part of a file that a request asks for.
#[derive(Debug, PartialEq, Eq)]
enum Wanted {
    All,
    Part(Range<u64>),
    /// A part that the file does not have.
    Nothing,
}

/// Answers with the file, or with the part of it that is asked for.
pub async fn answer(path: &Path, headers: &HeaderMap) -> Response {
    match part(path, headers).await {
        Ok(response) => response,
        Err(error) => {
            let text = format!("{}: cannot be read: {}\n", path.display(), reason(&error));
            (StatusCode::INTERNAL_SERVER_ERROR, text).into_response()
        }
    }
}

async fn part(path: &Path, headers: &HeaderMap) -> io::Result<Response> {
    let mut file = File::open(path).await?;
    let size = file.metadata().await?.len();
    let asked = headers.get(RANGE).and_then(|value| value.to_str().ok());
    // This asks for a part of a certain version of the file, and versions have no names here.
    let asked = asked.filter(|_| !headers.contains_key(IF_RANGE));
    let (status, range, place) = match asked.map_or(Wanted::All, |asked| wanted(asked, size)) {
        Wanted::All => (StatusCode::OK, 0..size, None),
        Wanted::Part(range) => {
            let place = format!("bytes {}-{}/{size}", range.start, range.end - 1);
            (StatusCode::PARTIAL_CONTENT, range, Some(place))
        }
        Wanted::Nothing => {
            let place = [(CONTENT_RANGE, format!("bytes */{size}"))];
            return Ok((StatusCode::RANGE_NOT_SATISFIABLE, place).into_response());
        }
    };
    file.seek(SeekFrom::Start(range.start)).await?;
    let length = range.end - range.start;
    let content = ReaderStream::with_capacity(file.take(length), CHUNK);
    let headers = [
        (CONTENT_TYPE, "application/octet-stream".to_string()),
        (CONTENT_LENGTH, length.to_string()),
        (ACCEPT_RANGES, "bytes".to_string()),
    ];
    let place = place.map(|place| [(CONTENT_RANGE, place)]);
    Ok((status, headers, place, Body::from_stream(content)).into_response())
}

/// Reads the header `Range`. All of the file is meant where it cannot be understood, and where it asks for several
/// parts.
fn wanted(header: &str, size: u64) -> Wanted {
    let bytes = header.strip_prefix("bytes=").map(str::trim);
    let Some((first, last)) = bytes.and_then(|range| range.split_once('-')) else {
        return Wanted::All;
    };
    let is_number = |text: &str| text.bytes().all(|byte| byte.is_ascii_digit());
    if !is_number(first) || !is_number(last) {
        return Wanted::All;
    }
    // Numbers of more digits than that lie beyond the end of any file.
    let number = |text: &str| text.parse().unwrap_or(u64::MAX);
    let range = match (first, last) {
        ("", "") => return Wanted::All,
        ("", length) => size.saturating_sub(number(length))..size,
        (first, "") => number(first)..size,
        (first, last) if number(first) > number(last) => return Wanted::All,
        (first, last) => number(first)..size.min(number(last).saturating_add(1)),
    };
    match range.is_empty() {
        true => Wanted::Nothing,
        false => Wanted::Part(range),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_are_read_as_rfc_9110_says() {
        let cases = [
            ("bytes=0-0", Wanted::Part(0..1)),
            ("bytes=2-5", Wanted::Part(2..6)),
            ("bytes=2-", Wanted::Part(2..10)),
            ("bytes=-3", Wanted::Part(7..10)),
            ("bytes=-30", Wanted::Part(0..10)),
            ("bytes=5-99999999999999999999", Wanted::Part(5..10)),
            ("bytes=10-", Wanted::Nothing),
            ("bytes=10-12", Wanted::Nothing),
            ("bytes=-0", Wanted::Nothing),
            ("bytes=99999999999999999999-", Wanted::Nothing),
            ("bytes=5-2", Wanted::All),
            ("bytes=0-1,4-5", Wanted::All),
            ("bytes=-", Wanted::All),
            ("bytes=+1-2", Wanted::All),
            ("bytes=a-b", Wanted::All),
            ("lines=0-1", Wanted::All),
        ];
        for (header, expected) in cases {
            assert_eq!(wanted(header, 10), expected, "{header}");
        }
        assert_eq!(wanted("bytes=0-", 0), Wanted::Nothing);
    }
}
