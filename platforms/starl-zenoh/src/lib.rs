//! Zenoh as the network of a fleet (Eclipse Zenoh, <https://zenoh.io>).
//!
//! Each member of a fleet `F` subscribes to the key `starl/F/NUMBER`, and a packet for a member is put there. Members
//! are peers that connect to each other, directly or by gossip, or clients of a router; the robots of a fleet may be in
//! several networks as long as routers join them. No multicast is used. Packets are protected by
//! [`starl_node::link::Channel`] as on any link; TLS comes beneath that where it is configured.

mod probe;
mod tls;

pub use probe::{Answer, Probed, Probes};
pub use tls::{Tls, TlsError};

use starl_node::link::{Arrival, Member, Origin, Transport};
use std::io;
use std::path::PathBuf;
use std::sync::mpsc::{self, SyncSender, TrySendError};
use std::thread;
use std::time::Instant;
use thiserror::Error;
use zenoh::config::Config;
use zenoh::qos::CongestionControl;
use zenoh::{Session, Wait};

/// The number of packets that may wait to be sent. More are lost.
const QUEUE: usize = 4096;

/// How a member joins the network.
#[derive(Clone, Debug, Default)]
pub struct ZenohOptions {
    /// Where it listens, e.g. `tcp/0.0.0.0:7447`.
    pub listen: Vec<String>,
    /// The endpoints to connect to, e.g. `tcp/192.168.0.1:7447`. Unreachable ones are retried for ever.
    pub connect: Vec<String>,
    /// Whether each two members have an endpoint of each other in `connect`. Otherwise members tell each other of further
    /// members (gossip), and all hear of each new connection, which takes the cube of their number.
    pub is_complete: bool,
    /// Its part in the network.
    pub mode: Mode,
    /// The certificates for links whose endpoints begin with `tls/`.
    pub tls: Option<Tls>,
}

/// The part of a member in the network.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Mode {
    /// It connects to other peers.
    #[default]
    Peer,
    /// All of its packets go by a router.
    Client,
    /// It is a router.
    Router,
}

impl Mode {
    fn name(self) -> &'static str {
        match self {
            Mode::Peer => "peer",
            Mode::Client => "client",
            Mode::Router => "router",
        }
    }
}

/// Why a member cannot join.
#[derive(Debug, Error)]
#[error("{0}")]
pub struct ZenohError(String);

impl From<zenoh::Error> for ZenohError {
    fn from(error: zenoh::Error) -> ZenohError {
        ZenohError(error.to_string())
    }
}

/// Opens a session. A client waits until its router is there.
///
/// # Errors
/// If an endpoint is malformed or cannot be listened on, or certificates cannot be read.
pub fn session(options: &ZenohOptions) -> Result<Session, ZenohError> {
    Ok(zenoh::open(config(options)?).wait()?)
}

/// A member's connection to the network, which ends when this is dropped.
pub struct Zenoh {
    packets: SyncSender<(Member, Vec<u8>)>,
    // Kept so that packets arrive.
    _session: Session,
    // Kept so that it reports problems with other members.
    _probes: Option<Probes>,
}

impl Zenoh {
    /// Joins the network as `me`, and hands what arrives to `deliver`.
    ///
    /// # Errors
    /// If an endpoint is malformed or cannot be listened on, or certificates cannot be read.
    pub fn open(
        fleet: &str,
        me: Member,
        options: &ZenohOptions,
        deliver: impl Fn(Arrival) -> bool + Send + Sync + 'static,
    ) -> Result<Zenoh, ZenohError> {
        let session = session(options)?;
        session
            .declare_subscriber(format!("{}{me}", prefix(fleet)))
            .callback(move |sample| {
                deliver(Arrival {
                    at: Instant::now(),
                    origin: Origin::Named,
                    packet: sample.payload().to_bytes().into_owned(),
                });
            })
            .background()
            .wait()?;
        let (packets, queue) = mpsc::sync_channel::<(Member, Vec<u8>)>(QUEUE);
        let (sender, prefix) = (session.clone(), prefix(fleet));
        // A congested link holds up this thread alone.
        thread::Builder::new()
            .name("zenoh".to_string())
            .spawn(move || {
                for (to, packet) in queue {
                    // Programs tolerate unreachable members.
                    let _ = sender
                        .put(format!("{prefix}{to}"), packet)
                        .congestion_control(CongestionControl::Drop)
                        .wait();
                }
            })
            .map_err(|error| ZenohError(error.to_string()))?;
        Ok(Zenoh {
            packets,
            _session: session,
            _probes: None,
        })
    }

    /// Keeps these probes for as long as the connection.
    #[must_use]
    pub fn with_probes(mut self, probes: Option<Probes>) -> Zenoh {
        self._probes = probes;
        self
    }
}

impl Transport for Zenoh {
    fn send(&mut self, to: Member, packet: &[u8]) -> io::Result<()> {
        match self.packets.try_send((to, packet.to_vec())) {
            Ok(()) => Ok(()),
            Err(TrySendError::Full(_)) => Err(io::ErrorKind::WouldBlock.into()),
            Err(TrySendError::Disconnected(_)) => Err(io::ErrorKind::NotConnected.into()),
        }
    }

    fn learn(&mut self, _: Member, _: Origin) {}
}

/// The first part of the keys under which the members of a fleet are reached. Names may hold what keys may not.
fn prefix(fleet: &str) -> String {
    let name: String = fleet
        .bytes()
        .map(|byte| match byte.is_ascii_alphanumeric() {
            true => char::from(byte).to_string(),
            false => format!("-{byte:02x}"),
        })
        .collect();
    format!("starl/{name}/")
}

/// The configuration of a session.
///
/// # Errors
/// If an endpoint is malformed.
pub fn config(options: &ZenohOptions) -> Result<Config, ZenohError> {
    let mut config = Config::default();
    let list = |items: &[String]| {
        let quoted: Vec<String> = items.iter().map(|item| format!("{item:?}")).collect();
        format!("[{}]", quoted.join(","))
    };
    let mut set = |key: &str, value: &str| {
        let done = config.insert_json5(key, value);
        done.map_err(|error| ZenohError(format!("{key} = {value}: {error}")))
    };
    set("mode", &format!("{:?}", options.mode.name()))?;
    set("listen/endpoints", &list(&options.listen))?;
    set("connect/endpoints", &list(&options.connect))?;
    // Robots start in any order.
    set("connect/timeout_ms", "-1")?;
    set("connect/exit_on_failure", "false")?;
    set("scouting/multicast/enabled", "false")?;
    set(
        "scouting/gossip/enabled",
        &(!options.is_complete).to_string(),
    )?;
    set("transport/link/tx/queue/size/data", "16")?;
    // Microseconds that a packet waits for room, before it is dropped.
    set(
        "transport/link/tx/queue/congestion_control/drop/wait_before_drop",
        "50000",
    )?;
    if let Some(tls) = &options.tls {
        let path = |path: &PathBuf| format!("{:?}", path.display().to_string());
        set(
            "transport/link/tls/root_ca_certificate",
            &path(&tls.authority),
        )?;
        set("transport/link/tls/enable_mtls", "true")?;
        for side in ["listen", "connect"] {
            set(
                &format!("transport/link/tls/{side}_certificate"),
                &path(&tls.certificate),
            )?;
            set(
                &format!("transport/link/tls/{side}_private_key"),
                &path(&tls.key),
            )?;
        }
    }
    Ok(config)
}
