//! `starl lsp`: a server for editors, over the Language Server Protocol 3.17 on standard input and output.
//!
//! The information comes from [`starl_editor`]; this module contains only the protocol, the open
//! texts, and the files beside them. A text is checked when its check is requested, and after every change
//! once no message is waiting, so that problems appear as you type. Only `exit` and the end of the input
//! end the server: messages that cannot be understood are answered with an error.

mod answer;
mod assist;
mod capabilities;
mod convert;
mod diagnostics;
mod documents;
mod location;
mod navigate;
mod rename;
mod session;
mod show;
mod transport;

use crate::failure::Failure;
use session::{Session, Step};
use starl_catalog::disk::reason;
use std::io;
use std::sync::mpsc::{Receiver, TryRecvError};
use transport::Incoming;

/// Serves an editor until it says `exit`. True if it said `shutdown` before.
pub fn run() -> Result<bool, Failure> {
    let incoming = transport::listen();
    let mut session = Session::new(Box::new(io::stdout()));
    let ended = serve(&incoming, &mut session);
    ended.map_err(|error| {
        let what = reason(&error);
        Failure(format!("standard output: cannot be written: {what}"))
    })
}

fn serve(incoming: &Receiver<Incoming>, session: &mut Session) -> io::Result<bool> {
    loop {
        let message = match incoming.try_recv() {
            Ok(message) => message,
            Err(TryRecvError::Disconnected) => return Ok(false),
            Err(TryRecvError::Empty) => {
                // No message is waiting: the diagnostics of the edited text are sent.
                session.publish()?;
                match incoming.recv() {
                    Ok(message) => message,
                    Err(_) => return Ok(false),
                }
            }
        };
        match session.take(message)? {
            Step::Continue => {}
            Step::Exit { after_shutdown } => return Ok(after_shutdown),
        }
    }
}
