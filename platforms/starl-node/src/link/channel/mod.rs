//! Authenticated and encrypted packets between the members of a fleet, over any link that carries datagrams.
//!
//! Two members agree on a session by a Noise handshake (Perrin 2018, "The Noise Protocol Framework", pattern NNpsk0)
//! with the fleet's key, so that a stranger cannot begin one. Sessions of different lives have different keys: a
//! packet recorded in one session is invalid in another. Within a session each packet has a number, and each number is
//! accepted once. Neither ids nor the name of the fleet can be changed on the way, since both go into the handshake.
//!
//! A [`Channel`] does not use a socket: it only seals and opens packets.

mod handshake;
mod refusal;
#[cfg(test)]
mod tests;

pub use refusal::{Refusal, Refusals};

use super::window::ReplayWindow;
use handshake::{builder, fresh_index, initiate, prologue};
use snow::{HandshakeState, StatelessTransportState};
use starl_core::{Duration, Time};
use std::collections::BTreeMap;

/// The number of a member: a robot's own, or an operator's, which is `OPERATORS` or more.
pub type Member = u32;

/// Members from this number on are operators, not robots.
pub const OPERATORS: Member = 1 << 31;

/// The secret that all members of a fleet know.
pub type Key = [u8; 32];

const INITIATION: u8 = 1;
const RESPONSE: u8 = 2;
const SEALED: u8 = 3;
const OPEN: u8 = 4;

/// Kind, index and number before a sealed content, and the tag behind it.
const OVERHEAD: usize = 1 + 4 + 8 + 16;

/// The longest packet that UDP over IP version 4 carries, bytes.
const LONGEST_PACKET: usize = 65_507;

/// The longest content of a packet, bytes.
pub const LONGEST: usize = LONGEST_PACKET - OVERHEAD;

/// How long the first initiation waits for its response before another one is sent. Each further one waits twice as
/// long, so that a handshake ends also where packets take longer.
const PATIENCE: Duration = Duration::from_millis(250);

/// How often the wait is doubled at most.
const DOUBLINGS: u32 = 3;

/// How many sessions before the current one are kept: two, as both ends may begin one at the same time, and a third
/// replaces both while packets are on their way in either.
const EARLIER: usize = 2;

/// A session is replaced by one with another key after this long.
const RENEWAL: Duration = Duration::from_millis(600_000);

/// When nothing has come from the other member for so long, the session is replaced. A robot that restarts begins new
/// sessions with robots itself, and robots of a large fleet that stand say nothing for up to 10 s. It begins none with
/// operators, which robots answer more often.
const SILENCE: Duration = Duration::from_millis(15_000);
const SILENCE_OF_OPERATORS: Duration = Duration::from_millis(2_000);

/// The result of opening a packet.
#[derive(Debug, PartialEq)]
pub enum Opened {
    /// Content from a member.
    Content {
        /// The sender.
        from: Member,
        /// The decrypted content.
        content: Vec<u8>,
    },
    /// A part of a handshake; the answer, if there is one, goes back to where the packet came from.
    Handshake {
        /// The member at the other end.
        from: Member,
        /// The answer.
        answer: Option<Vec<u8>>,
    },
    /// Nothing that a program may see.
    Refused(Refusal),
}

/// One member's end of the sessions with all others.
pub struct Channel {
    me: Member,
    fleet: String,
    /// The keys that a handshake may use, in the order in which they are tried; none where packets are not protected.
    keys: Vec<Key>,
    sessions: BTreeMap<u32, Session>,
    peers: BTreeMap<Member, Peer>,
    refusals: Refusals,
}

/// The state kept for another member.
#[derive(Default)]
struct Peer {
    /// The session to send in.
    current: Option<u32>,
    /// Those before it, the latest first, in which packets may still come.
    earlier: Vec<u32>,
    /// A session that this end has answered to, and that the other end has not used yet.
    answered: Option<Answered>,
    /// The initiations that wait for a response, one for each key, as far as they have been sent.
    pending: Vec<Pending>,
    /// When the last initiation was sent.
    tried: Option<Time>,
    /// How many were sent since there was a session.
    attempts: u32,
    /// Whether this end makes sure that there is a session.
    is_wanted: bool,
}

struct Answered {
    index: u32,
    /// The initiation, which the other end repeats until it has the answer.
    initiation: Vec<u8>,
    answer: Vec<u8>,
}

struct Pending {
    key: Key,
    index: u32,
    handshake: Box<HandshakeState>,
    /// The initiation, which is sent again until there is a response.
    packet: Vec<u8>,
}

struct Session {
    with: Member,
    /// The other end's number of it.
    remote: u32,
    cipher: StatelessTransportState,
    sent: u64,
    window: ReplayWindow,
    begun: Time,
    heard: Time,
}

impl Channel {
    /// The end of `me`, which tries these keys in turn: while a fleet changes its key, there are two.
    /// Without keys packets are neither protected nor checked.
    pub fn new(me: Member, fleet: &str, keys: Vec<Key>) -> Channel {
        Channel {
            me,
            fleet: fleet.to_string(),
            keys,
            sessions: BTreeMap::new(),
            peers: BTreeMap::new(),
            refusals: Refusals::default(),
        }
    }

    /// Replaces the keys. Existing sessions continue until they are renewed.
    pub fn set_keys(&mut self, keys: Vec<Key>) {
        self.keys = keys;
        for peer in self.peers.values_mut() {
            peer.pending.clear();
        }
    }

    /// How many packets were refused.
    pub fn refusals(&self) -> Refusals {
        self.refusals
    }

    /// Makes sure from now on that there is a session with a member: see [`Channel::due`].
    pub fn want(&mut self, peer: Member) {
        self.peers.entry(peer).or_default().is_wanted = true;
    }

    /// The packet with this content for a member; none while there is no session with it. The content must not be
    /// longer than [`LONGEST`].
    pub fn seal(&mut self, to: Member, content: &[u8]) -> Option<Vec<u8>> {
        if self.keys.is_empty() {
            let mut packet = vec![OPEN];
            packet.extend(self.me.to_le_bytes());
            packet.extend(content);
            return Some(packet);
        }
        let index = self.peers.get(&to)?.current?;
        let session = self.sessions.get_mut(&index)?;
        let number = session.sent;
        session.sent += 1;
        let mut packet = vec![0; OVERHEAD + content.len()];
        packet[0] = SEALED;
        packet[1..5].copy_from_slice(&session.remote.to_le_bytes());
        packet[5..13].copy_from_slice(&number.to_le_bytes());
        let written = session
            .cipher
            .write_message(number, content, &mut packet[13..]);
        packet.truncate(13 + written.ok()?);
        Some(packet)
    }

    /// Takes a packet that has arrived.
    pub fn open(&mut self, now: Time, packet: &[u8]) -> Opened {
        let opened = match packet.split_first() {
            Some((&OPEN, rest)) if self.keys.is_empty() => plain(rest),
            Some((&INITIATION, rest)) if !self.keys.is_empty() => self.answer(now, rest),
            Some((&RESPONSE, rest)) if !self.keys.is_empty() => self.complete(now, rest),
            Some((&SEALED, rest)) if !self.keys.is_empty() => self.unseal(now, rest),
            Some((&OPEN, _)) => Err(Refusal::NotAuthentic),
            _ => Err(Refusal::Malformed),
        };
        opened.unwrap_or_else(|refusal| {
            self.refusals.count(refusal);
            Opened::Refused(refusal)
        })
    }

    /// The initiations that are due, each for a member. Call it a few times a second.
    pub fn due(&mut self, now: Time) -> Vec<(Member, Vec<u8>)> {
        if self.keys.is_empty() {
            return Vec::new();
        }
        self.forget_guests(now);
        let silence = match self.me < OPERATORS {
            true => SILENCE,
            false => SILENCE_OF_OPERATORS,
        };
        let mut due = Vec::new();
        for (&member, peer) in &mut self.peers {
            let session = peer.current.and_then(|index| self.sessions.get(&index));
            let is_young = session.is_some_and(|session| now.since(session.begun) < RENEWAL);
            let is_good = is_young && peer.is_heard(&self.sessions, now, silence);
            // The other end has begun one, and is about to use it. Only the first attempt waits for that, as anyone can
            // repeat what the other end has sent.
            let answered = peer.answered.as_ref();
            let answered = answered.and_then(|answered| self.sessions.get(&answered.index));
            let is_coming = peer.attempts == 0
                && answered.is_some_and(|session| now.since(session.begun) < PATIENCE);
            let patience = Duration(PATIENCE.0 << peer.attempts.saturating_sub(1).min(DOUBLINGS));
            let waits = peer.tried.is_some_and(|at| now.since(at) < patience);
            if !peer.is_wanted || is_good || is_coming || waits {
                continue;
            }
            peer.tried = Some(now);
            peer.attempts = peer.attempts.saturating_add(1);
            // While the fleet changes its key, the other end may have only one of them.
            let turn = (peer.attempts as usize - 1) % self.keys.len();
            let key = &self.keys[turn];
            if !peer.pending.iter().any(|pending| pending.key == *key) {
                let pending = initiation(&self.fleet, self.me, member, key, &self.sessions);
                peer.pending.extend(pending);
            }
            let pending = peer.pending.iter().find(|pending| pending.key == *key);
            due.extend(pending.map(|pending| (member, pending.packet.clone())));
        }
        due
    }

    /// Forgets members that have begun a session of their own accord, as operators do, and are silent for long.
    fn forget_guests(&mut self, now: Time) {
        let sessions = &self.sessions;
        self.peers.retain(|_, peer| {
            let answered = peer.answered.as_ref();
            let answered = answered.and_then(|answered| sessions.get(&answered.index));
            peer.is_wanted
                || peer.is_heard(sessions, now, RENEWAL)
                || answered.is_some_and(|session| now.since(session.begun) < RENEWAL)
        });
        let peers = &self.peers;
        self.sessions
            .retain(|_, session| peers.contains_key(&session.with));
    }

    /// Answers to an initiation.
    fn answer(&mut self, now: Time, packet: &[u8]) -> Result<Opened, Refusal> {
        let (from, rest) = number(packet)?;
        let (remote, message) = number(rest)?;
        let answered = self
            .peers
            .get(&from)
            .and_then(|peer| peer.answered.as_ref());
        if let Some(answered) = answered.filter(|answered| answered.initiation == packet) {
            let answer = Some(answered.answer.clone());
            return Ok(Opened::Handshake { from, answer });
        }
        let fresh = fresh_index(&self.sessions).ok_or(Refusal::Malformed)?;
        let prologue = prologue(&self.fleet, from, self.me);
        let handshake = self.keys.iter().find_map(|key| {
            let mut handshake = builder(&prologue, key)?.build_responder().ok()?;
            handshake.read_message(message, &mut [0; 64]).ok()?;
            Some(handshake)
        });
        let mut handshake = handshake.ok_or(Refusal::NotAuthentic)?;
        let mut answer = vec![0; 128];
        answer[0] = RESPONSE;
        answer[1..5].copy_from_slice(&remote.to_le_bytes());
        answer[5..9].copy_from_slice(&fresh.to_le_bytes());
        let written = handshake.write_message(&[], &mut answer[9..]);
        answer.truncate(9 + written.map_err(|_| Refusal::NotAuthentic)?);
        let session = Session::new(now, from, remote, handshake)?;
        let peer = self.peers.entry(from).or_default();
        // Only what the other end uses takes the place of a session: an initiation that someone has recorded and
        // sends again changes nothing.
        let answered = Answered {
            index: fresh,
            initiation: packet.to_vec(),
            answer: answer.clone(),
        };
        if let Some(unused) = peer.answered.replace(answered) {
            self.sessions.remove(&unused.index);
        }
        self.sessions.insert(fresh, session);
        Ok(Opened::Handshake {
            from,
            answer: Some(answer),
        })
    }

    /// Takes the response to an initiation of this end.
    fn complete(&mut self, now: Time, packet: &[u8]) -> Result<Opened, Refusal> {
        let (index, rest) = number(packet)?;
        let (remote, message) = number(rest)?;
        let awaited = self.peers.iter_mut().find_map(|(&from, peer)| {
            let mut pending = peer.pending.iter();
            let place = pending.position(|pending| pending.index == index)?;
            Some((from, peer.pending.remove(place)))
        });
        let (from, Pending { mut handshake, .. }) = awaited.ok_or(Refusal::UnknownSession)?;
        if handshake.read_message(message, &mut [0; 64]).is_err() {
            // The next initiation is due anyway.
            return Err(Refusal::NotAuthentic);
        }
        let session = Session::new(now, from, remote, *handshake)?;
        self.sessions.insert(index, session);
        self.promote(from, index);
        if let Some(peer) = self.peers.get_mut(&from) {
            peer.pending.clear();
        }
        Ok(Opened::Handshake { from, answer: None })
    }

    fn unseal(&mut self, now: Time, packet: &[u8]) -> Result<Opened, Refusal> {
        let (index, rest) = number(packet)?;
        let (count, sealed) = rest.split_first_chunk::<8>().ok_or(Refusal::Malformed)?;
        let count = u64::from_le_bytes(*count);
        let session = self.sessions.get_mut(&index);
        let session = session.ok_or(Refusal::UnknownSession)?;
        if !session.window.is_new(count) {
            return Err(Refusal::Replayed);
        }
        let mut content = vec![0; sealed.len()];
        let read = session.cipher.read_message(count, sealed, &mut content);
        content.truncate(read.map_err(|_| Refusal::NotAuthentic)?);
        session.window.take(count);
        session.heard = now;
        let from = session.with;
        let peer = self.peers.entry(from).or_default();
        if peer
            .answered
            .as_ref()
            .is_some_and(|answered| answered.index == index)
        {
            peer.answered = None;
            self.promote(from, index);
        }
        Ok(Opened::Content { from, content })
    }

    /// Uses a session for sending from now on.
    fn promote(&mut self, with: Member, index: u32) {
        let peer = self.peers.entry(with).or_default();
        peer.attempts = 0;
        if let Some(before) = peer.current.replace(index) {
            peer.earlier.insert(0, before);
        }
        for oldest in peer.earlier.drain(EARLIER.min(peer.earlier.len())..) {
            self.sessions.remove(&oldest);
        }
    }
}

impl Peer {
    /// Whether something has come from it in any session within this time. When both ends begin a session, each may
    /// use the other's for ever, and hears nothing in the one that it uses itself.
    fn is_heard(&self, sessions: &BTreeMap<u32, Session>, now: Time, within: Duration) -> bool {
        let used = self.current.iter().chain(&self.earlier);
        used.filter_map(|index| sessions.get(index))
            .any(|session| now.since(session.heard) < within)
    }
}

impl Session {
    fn new(
        now: Time,
        with: Member,
        remote: u32,
        state: HandshakeState,
    ) -> Result<Session, Refusal> {
        let cipher = state.into_stateless_transport_mode();
        Ok(Session {
            with,
            remote,
            cipher: cipher.map_err(|_| Refusal::NotAuthentic)?,
            sent: 0,
            window: ReplayWindow::default(),
            begun: now,
            heard: now,
        })
    }
}

/// A new initiation with this key; none if none can be made.
fn initiation(
    fleet: &str,
    me: Member,
    to: Member,
    key: &Key,
    sessions: &BTreeMap<u32, Session>,
) -> Option<Pending> {
    let index = fresh_index(sessions)?;
    let (handshake, packet) = initiate(fleet, me, to, key, index).ok()?;
    Some(Pending {
        key: *key,
        index,
        handshake,
        packet,
    })
}

fn plain(packet: &[u8]) -> Result<Opened, Refusal> {
    let (from, content) = number(packet)?;
    let content = content.to_vec();
    Ok(Opened::Content { from, content })
}

fn number(packet: &[u8]) -> Result<(u32, &[u8]), Refusal> {
    let (bytes, rest) = packet.split_first_chunk().ok_or(Refusal::Malformed)?;
    Ok((u32::from_le_bytes(*bytes), rest))
}
