//! Probes: handshakes that find out why members of a fleet cannot connect to each other by TLS.
//!
//! Zenoh retries a connection for ever, and does not tell that the other end refuses it or has no TLS. A probe makes the
//! same handshake (RFC 8446, by rustls) with each other member once, and reports the reason if it fails. Members start in any
//! order, so a member that is not there is tried again.

use crate::tls::{Tls, TlsError, text};
use rustls::pki_types::ServerName;
use rustls::{CertificateError, ClientConfig, ClientConnection, Error};
use std::io::{self, ErrorKind};
use std::net::{TcpStream, ToSocketAddrs};
use std::sync::Arc;
use std::sync::mpsc::{self, RecvTimeoutError, Sender};
use std::thread;
use std::time::Duration;

/// How often a member that is not there is tried again.
const PERIOD: Duration = Duration::from_secs(1);
/// A member that does not accept a connection within this time is not there.
const ABSENCE: Duration = Duration::from_secs(1);
/// A member that accepts a connection and is silent for so long has no TLS: it waits for another protocol's message.
const SILENCE: Duration = Duration::from_secs(5);

/// A member to be probed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Probed {
    /// Its name in messages.
    pub name: String,
    /// Its host and port, e.g. `192.168.0.1:7447`.
    pub address: String,
}

/// The result of a probe.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Answer {
    /// No process listens there.
    Absent,
    /// Both ends accept each other.
    Accepted,
    /// The problem, and what to do.
    Refused(String),
}

/// Probes members until each has answered, or this is dropped.
#[derive(Debug)]
pub struct Probes {
    _end: Sender<()>,
}

impl Probes {
    /// Starts to probe `members` with these certificates, and tells each problem once.
    ///
    /// # Errors
    /// If a file cannot be used.
    pub fn start(
        tls: &Tls,
        members: Vec<Probed>,
        tell: impl Fn(&str) + Send + 'static,
    ) -> Result<Probes, TlsError> {
        let config = Arc::new(tls.client()?);
        let (tls, mut waiting) = (tls.clone(), members);
        let (end, ended) = mpsc::channel();
        thread::spawn(move || {
            while !waiting.is_empty() {
                waiting.retain(|member| match probe(&tls, &config, member) {
                    Answer::Absent => true,
                    Answer::Accepted => false,
                    Answer::Refused(problem) => {
                        tell(&problem);
                        false
                    }
                });
                if ended.recv_timeout(PERIOD) != Err(RecvTimeoutError::Timeout) {
                    return;
                }
            }
        });
        Ok(Probes { _end: end })
    }
}

impl Tls {
    /// Makes the handshake with a member that listens at an address.
    ///
    /// # Errors
    /// If a file cannot be used.
    pub fn probe(&self, member: &Probed) -> Result<Answer, TlsError> {
        Ok(probe(self, &Arc::new(self.client()?), member))
    }
}

fn probe(tls: &Tls, config: &Arc<ClientConfig>, member: &Probed) -> Answer {
    let Probed { name, address } = member;
    let Ok(Some(place)) = address.to_socket_addrs().map(|mut places| places.next()) else {
        return Answer::Absent;
    };
    let Ok(mut stream) = TcpStream::connect_timeout(&place, ABSENCE) else {
        return Answer::Absent;
    };
    let host = address.rsplit_once(':').map_or("", |(host, _)| host);
    let host = host.trim_matches(['[', ']']);
    let server = ServerName::try_from(host.to_string()).unwrap_or_else(|_| place.ip().into());
    let begun = ClientConnection::new(config.clone(), server).map_err(Failed::Tls);
    let shaken = begun.and_then(|mut session| shake_hands(&mut session, &mut stream));
    let problem = match shaken {
        Ok(()) => return Answer::Accepted,
        Err(Failed::Network) => return Answer::Absent,
        Err(Failed::Silent) => {
            "does not answer by TLS; give `link.tls` to all members or to none".to_string()
        }
        Err(Failed::Tls(Error::AlertReceived(alert))) => format!(
            "refuses this member's certificate {} ({alert:?}); all members need certificates of one authority",
            tls.certificate.display()
        ),
        Err(Failed::Tls(Error::InvalidCertificate(
            CertificateError::UnknownIssuer | CertificateError::BadSignature,
        ))) => format!(
            "has a certificate that is not signed by the authority {}; all members need certificates of one authority",
            tls.authority.display()
        ),
        Err(Failed::Tls(error @ Error::InvalidCertificate(_))) => {
            format!("has a certificate that {}", text(&error))
        }
        Err(Failed::Tls(error)) => format!("does not speak TLS as this member does: {error}"),
    };
    Answer::Refused(format!("{name} at {address} {problem}"))
}

/// Why a handshake does not succeed.
enum Failed {
    /// The other end went away.
    Network,
    /// It said nothing.
    Silent,
    /// One end refuses the other.
    Tls(Error),
}

impl From<io::Error> for Failed {
    fn from(error: io::Error) -> Failed {
        match error.kind() {
            ErrorKind::WouldBlock | ErrorKind::TimedOut => Failed::Silent,
            _ => Failed::Network,
        }
    }
}

/// The other end checks the certificate only after this end has finished. It sends session tickets then, or an alert.
fn shake_hands(session: &mut ClientConnection, stream: &mut TcpStream) -> Result<(), Failed> {
    stream.set_read_timeout(Some(SILENCE))?;
    stream.set_write_timeout(Some(SILENCE))?;
    loop {
        while session.wants_write() {
            session.write_tls(stream)?;
        }
        let has_finished = !session.is_handshaking();
        if session.read_tls(stream)? == 0 {
            return Err(Failed::Network);
        }
        if let Err(error) = session.process_new_packets() {
            // The other end gets its alert.
            let _ = session.write_tls(stream);
            return Err(Failed::Tls(error));
        }
        if has_finished {
            session.send_close_notify();
            let _ = session.write_tls(stream);
            return Ok(());
        }
    }
}
