//! Messages as bytes: JSON-RPC 2.0 with a header for the length of each message (protocol 3.17, "Base Protocol").
//!
//! Written here rather than taken from `lsp-server`, whose reader ends at the first message that is not JSON and
//! allocates as many bytes as the header claims.

use serde_json::{Value, json};
use std::io::{self, BufRead, Read, Write};
use std::sync::mpsc::{self, Receiver};
use std::thread;
use thiserror::Error;

/// The longest message that is read, in bytes.
const LONGEST: usize = 256 << 20;

/// How many messages may wait.
const MOST_WAITING: usize = 64;

/// The number of an error in an answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fault {
    /// The message is not JSON.
    Parse = -32700,
    /// The message is not a request, or not one that is possible now.
    InvalidRequest = -32600,
    /// There is no such request.
    MethodNotFound = -32601,
    /// The request's parameters are invalid.
    InvalidParams = -32602,
    /// The server is at fault.
    Internal = -32603,
    /// `initialize` must come first.
    NotInitialized = -32002,
    /// The request was understood and cannot be fulfilled.
    Failed = -32803,
}

/// An incoming message.
#[derive(Debug)]
pub enum Incoming {
    /// A message.
    Message(Value),
    /// A malformed message, with the problem.
    Malformed(Malformed),
}

/// Why a message is malformed.
#[derive(Debug, Error)]
pub enum Malformed {
    #[error("a message of {0} bytes is too long")]
    TooLong(usize),
    #[error(transparent)]
    Json(#[from] serde_json::Error),
    #[error("a header without Content-Length")]
    NoLength,
    #[error("a header with the line {0:?}")]
    Header(String),
    #[error("a message of the length {0:?}")]
    Length(String),
}

/// Reads messages from standard input in a thread of its own, until that ends.
pub fn listen() -> Receiver<Incoming> {
    let (sender, receiver) = mpsc::sync_channel(MOST_WAITING);
    thread::spawn(move || {
        let mut input = io::stdin().lock();
        while let Some(message) = read(&mut input) {
            if sender.send(message).is_err() {
                break;
            }
        }
    });
    receiver
}

/// The next message; none at the end of the input.
fn read(input: &mut impl BufRead) -> Option<Incoming> {
    let length = match header(input)? {
        Ok(length) => length,
        Err(problem) => return Some(Incoming::Malformed(problem)),
    };
    if length > LONGEST {
        io::copy(&mut input.take(length as u64), &mut io::sink()).ok()?;
        return Some(Incoming::Malformed(Malformed::TooLong(length)));
    }
    let mut bytes = Vec::new();
    input.take(length as u64).read_to_end(&mut bytes).ok()?;
    if bytes.len() < length {
        return None;
    }
    Some(match serde_json::from_slice(&bytes) {
        Ok(message) => Incoming::Message(message),
        Err(error) => Incoming::Malformed(error.into()),
    })
}

/// The length that the header says; none at the end of the input.
fn header(input: &mut impl BufRead) -> Option<Result<usize, Malformed>> {
    let mut length = None;
    loop {
        let mut line = Vec::new();
        // No line of a header is long; what has no end is read in pieces.
        let read = input.take(4096).read_until(b'\n', &mut line).ok()?;
        if read == 0 {
            return None;
        }
        let line = String::from_utf8_lossy(&line);
        let line = line.trim_end_matches(['\r', '\n']);
        if line.is_empty() {
            return Some(length.ok_or(Malformed::NoLength));
        }
        let Some((name, value)) = line.split_once(':') else {
            return Some(Err(Malformed::Header(line.into())));
        };
        if name.trim().eq_ignore_ascii_case("Content-Length") {
            match value.trim().parse() {
                Ok(value) => length = Some(value),
                Err(_) => return Some(Err(Malformed::Length(value.into()))),
            }
        }
    }
}

/// Where messages go.
pub struct Output(pub Box<dyn Write>);

impl Output {
    /// Sends a message.
    fn send(&mut self, message: &Value) -> io::Result<()> {
        let text = message.to_string();
        write!(self.0, "Content-Length: {}\r\n\r\n{text}", text.len())?;
        self.0.flush()
    }

    /// Answers a request.
    pub fn answer(&mut self, id: &Value, result: Result<Value, (Fault, String)>) -> io::Result<()> {
        self.send(&match result {
            Ok(result) => json!({"jsonrpc": "2.0", "id": id, "result": result}),
            Err((fault, message)) => json!({
                "jsonrpc": "2.0",
                "id": id,
                "error": {"code": fault as i32, "message": message},
            }),
        })
    }

    /// Sends the editor a notification.
    pub fn notify(&mut self, method: &str, params: &Value) -> io::Result<()> {
        self.send(&json!({"jsonrpc": "2.0", "method": method, "params": params}))
    }

    /// Sends the editor a request; the answer is ignored.
    pub fn request(&mut self, id: &str, method: &str, params: &Value) -> io::Result<()> {
        self.send(&json!({"jsonrpc": "2.0", "id": id, "method": method, "params": params}))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn all(mut bytes: &[u8]) -> Vec<Result<Value, String>> {
        std::iter::from_fn(|| read(&mut bytes))
            .map(|incoming| match incoming {
                Incoming::Message(message) => Ok(message),
                Incoming::Malformed(problem) => Err(problem.to_string()),
            })
            .collect()
    }

    #[test]
    fn messages_are_read_in_order() {
        let found = all(b"Content-Length: 2\r\n\r\n{}content-length:1\r\nX: y\r\n\r\n7");
        assert_eq!(found, [Ok(json!({})), Ok(json!(7))]);
    }

    #[test]
    fn a_malformed_message_is_reported_and_the_next_is_read() {
        let found = all(b"Content-Length: 3\r\n\r\n{,}Content-Length: 2\r\n\r\n[]");
        assert!(found[0].is_err());
        assert_eq!(found[1], Ok(json!([])));
        let found = all(b"nonsense\r\nContent-Length: x\r\n\r\nContent-Length: 1\r\n\r\n1");
        assert_eq!(found.last(), Some(&Ok(json!(1))));
        assert!(found[..found.len() - 1].iter().all(Result::is_err));
    }

    #[test]
    fn an_input_that_breaks_off_is_at_its_end() {
        assert!(all(b"Content-Length: 5\r\n\r\n{}").is_empty());
        assert!(all(b"Content-Length: 99999999999999").is_empty());
        let too_long = all(b"Content-Length: 9999999999999999\r\n\r\n{}");
        assert_eq!(too_long.len(), 1);
        assert!(too_long[0].is_err());
    }
}
