//! The simulations of a page that shows a run: requests and answers over a WebSocket.
//!
//! Each connection has its own simulations, and starts with a copy of the run at its start. So pages do not disturb
//! each other, and a reloaded page starts again. Requests are handled one after the other, in a thread beside the
//! server's. When a client disconnects, its requests are cancelled.
//!
//! A text message `{"id": 1, "request": {...}}` is answered by `{"id": 1, "ok": ...}` or `{"id": 1, "error": {...}}`.
//! `{"id": 2, "poses": 0}` and `{"id": 3, "frames": 0}` are answered by a binary message, little-endian: the id in 4
//! bytes, 4 bytes that are zero, then the numbers of [`Service::poses`] or [`Service::frames`], 8 bytes each; or by an
//! error as above.

use axum::body::Bytes;
use axum::extract::ws::{CloseCode, CloseFrame, Message, WebSocket, WebSocketUpgrade, close_code};
use axum::response::Response;
use rayon::ThreadPool;
use serde::Deserialize;
use serde_json::json;
use serde_json::value::RawValue;
use starl_catalog::programs::Registry;
use starl_catalog::service::Service;
use starl_catalog::session::Session;
use std::collections::VecDeque;
use std::sync::atomic::Ordering;
use std::sync::{Arc, Mutex, PoisonError};
use tokio::task;

/// Longer requests are answered by an error.
const MOST_BYTES: usize = 16 << 20;

/// Messages beyond this end the connection.
const MOST_MESSAGE_BYTES: usize = 64 << 20;

/// The number of requests that may wait for their turn; one more ends the connection.
const MOST_WAITING: usize = 256;

/// The simulation that every page is given at first.
pub struct Origin {
    /// The run at its start.
    session: Mutex<Session>,
    registry: Registry,
    /// Where robots step on several threads.
    pool: Option<Arc<ThreadPool>>,
}

impl Origin {
    /// Pages get copies of the session; its run steps on the threads of the pool.
    pub fn new(session: Session, registry: Registry, pool: Option<ThreadPool>) -> Origin {
        Origin {
            session: Mutex::new(session),
            registry,
            pool: pool.map(Arc::new),
        }
    }

    fn engine(&self) -> Engine {
        let mut service = Service::new(self.registry.clone());
        let session = self.session.lock().unwrap_or_else(PoisonError::into_inner);
        service.adopt(session.clone());
        Engine {
            service,
            pool: self.pool.clone(),
        }
    }
}

/// The simulations of one page.
struct Engine {
    service: Service,
    pool: Option<Arc<ThreadPool>>,
}

/// A message of a page.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Asked {
    id: u32,
    request: Option<Box<RawValue>>,
    poses: Option<u32>,
    frames: Option<u32>,
}

/// Connects a page to simulations of its own.
pub fn connect(origin: &Origin, upgrade: WebSocketUpgrade) -> Response {
    let engine = origin.engine();
    upgrade
        .max_message_size(MOST_MESSAGE_BYTES)
        .max_frame_size(MOST_MESSAGE_BYTES)
        .on_upgrade(move |mut socket| async move {
            if let Some((code, reason)) = talk(&mut socket, engine).await {
                let reason = reason.into();
                // Without a listener there is no answer.
                let _ = socket
                    .send(Message::Close(Some(CloseFrame { code, reason })))
                    .await;
            }
        })
}

/// Why a connection is closed.
type Reason = (CloseCode, &'static str);

/// Answers messages until the page goes away. Returns the reason if the server ends the connection.
async fn talk(socket: &mut WebSocket, mut engine: Engine) -> Option<Reason> {
    let mut waiting = VecDeque::new();
    loop {
        let message = match waiting.pop_front() {
            Some(message) => message,
            None => match socket.recv().await {
                Some(Ok(message)) => message,
                gone => return end(gone),
            },
        };
        let text = match message {
            Message::Text(text) => text,
            Message::Ping(_) | Message::Pong(_) => continue,
            Message::Binary(_) => return Some((close_code::UNSUPPORTED, "send text messages")),
            Message::Close(_) => return None,
        };
        let Ok(asked) = serde_json::from_str::<Asked>(&text) else {
            let reason = "send {\"id\": number, \"request\": {...}}";
            return Some((close_code::POLICY, reason));
        };
        let id = asked.id;
        if text.len() > MOST_BYTES {
            let message = format!(
                "the request has {} bytes; it may have at most {MOST_BYTES}",
                text.len()
            );
            socket.send(refusal(id, &message)).await.ok()?;
            continue;
        }
        drop(text);
        let interrupt = engine.service.interrupt();
        let mut job = task::spawn_blocking(move || {
            let answer = engine.answer(asked);
            (engine, answer)
        });
        let done = loop {
            tokio::select! {
                done = &mut job => break done,
                next = socket.recv() => {
                    let reason = match next {
                        Some(Ok(message)) if !matches!(message, Message::Close(_)) => {
                            waiting.push_back(message);
                            if waiting.len() <= MOST_WAITING {
                                continue;
                            }
                            Some((close_code::AGAIN, "more than 256 requests are waiting; wait for answers first"))
                        }
                        gone => end(gone),
                    };
                    interrupt.store(true, Ordering::Relaxed);
                    return reason;
                }
            }
        };
        let answer;
        (engine, answer) = match done {
            Ok(done) => done,
            Err(panic) => {
                let message = format!(
                    "the simulator has failed, which is a fault of StarL or of a program in Rust: {}; load the page \
                     again to restart",
                    text_of(panic)
                );
                socket.send(refusal(id, &message)).await.ok()?;
                return Some((close_code::ERROR, "the simulator has failed"));
            }
        };
        socket.send(answer).await.ok()?;
    }
}

/// The reason to end a connection of which no more can be read; none if the page has gone away.
fn end(received: Option<Result<Message, axum::Error>>) -> Option<Reason> {
    received?.err()?;
    let reason = "a message must be text in UTF-8, of at most 16 MiB";
    Some((close_code::SIZE, reason))
}

impl Engine {
    fn answer(&mut self, asked: Asked) -> Message {
        let pool = self.pool.clone();
        let mut answer = || self.carry_out(&asked);
        match pool {
            Some(pool) => pool.install(answer),
            None => answer(),
        }
    }

    fn carry_out(&mut self, asked: &Asked) -> Message {
        let id = asked.id;
        let mut numbers = Vec::new();
        let (simulation, is_there) = match (&asked.request, asked.poses, asked.frames) {
            (Some(request), None, None) => {
                let answer = self.service.answer(request.get().as_bytes());
                let answer = String::from_utf8(answer)
                    .unwrap_or_else(|error| unreachable!("answers are JSON: {error}"));
                // An answer is an object with one member; the id goes before that.
                return Message::Text(format!("{{\"id\":{id},{}", &answer[1..]).into());
            }
            (None, Some(simulation), None) => {
                (simulation, self.service.poses(simulation, &mut numbers))
            }
            (None, None, Some(simulation)) => {
                (simulation, self.service.frames(simulation, &mut numbers))
            }
            _ => return refusal(id, "send one of `request`, `poses` and `frames`"),
        };
        match is_there {
            true => Message::Binary(binary(id, &numbers)),
            false => refusal(id, &format!("there is no simulation {simulation}")),
        }
    }
}

/// Numbers as they are sent.
fn binary(id: u32, numbers: &[f64]) -> Bytes {
    let mut bytes = Vec::with_capacity(8 + 8 * numbers.len());
    bytes.extend(id.to_le_bytes());
    bytes.extend([0; 4]);
    bytes.extend(numbers.iter().flat_map(|number| number.to_le_bytes()));
    bytes.into()
}

fn refusal(id: u32, message: &str) -> Message {
    let error = json!({ "message": message, "diagnostics": [] });
    Message::Text(json!({ "id": id, "error": error }).to_string().into())
}

/// The message of a panic.
fn text_of(panic: task::JoinError) -> String {
    let payload = match panic.try_into_panic() {
        Ok(payload) => payload,
        Err(error) => return error.to_string(),
    };
    let text = payload.downcast_ref::<String>().cloned();
    let text = text.or_else(|| payload.downcast_ref::<&str>().map(|text| text.to_string()));
    text.unwrap_or_else(|| "no reason was given".to_string())
}
