//! Authenticated and encrypted packets between the members of a fleet, over any link that carries datagrams.
//!
//! Two members agree on a session by a Noise handshake (Perrin 2018, "The Noise Protocol Framework", pattern NNpsk0)
//! with the fleet's key, so that a stranger cannot begin one, and sessions of different lives have different keys:
//! what was recorded of one session means nothing in another. Within a session each packet has a number, and no number
//! is taken twice. Neither ids nor the name of the fleet can be changed on the way, since both go into the handshake.
//!
//! A [`Channel`] touches no socket: it makes packets of contents and contents of packets.

use super::window::ReplayWindow;
use snow::{Builder, HandshakeState, StatelessTransportState};
use starl_core::{Duration, Time};
use std::collections::BTreeMap;

/// The number of a member: a robot's own, or an operator's, which is `OPERATORS` or more.
pub type Member = u32;

/// Members from this number on are operators, not robots.
pub const OPERATORS: Member = 1 << 31;

/// The secret that all members of a fleet know.
pub type Key = [u8; 32];

const PATTERN: &str = "Noise_NNpsk0_25519_ChaChaPoly_BLAKE2s";
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

/// A session is replaced by one with another key after this long.
const RENEWAL: Duration = Duration::from_millis(600_000);

/// A session in which nothing has come from the other member for so long is replaced.
const SILENCE: Duration = Duration::from_millis(2_000);

/// What a packet turned out to be.
#[derive(Debug, PartialEq)]
pub enum Opened {
    /// Content from a member.
    Content {
        /// The sender.
        from: Member,
        /// What it says.
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

/// Why a packet was refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Refusal {
    /// It is no packet of this protocol.
    Malformed,
    /// It belongs to a session that this process does not know, perhaps one of an earlier life.
    UnknownSession,
    /// Its sender does not know the fleet's key, or it was changed on the way.
    NotAuthentic,
    /// It was taken before, or is too old to tell.
    Replayed,
}

/// How many packets were refused, by reason.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub struct Refusals {
    /// No packets of this protocol.
    pub malformed: u64,
    /// Of unknown sessions.
    pub unknown_session: u64,
    /// Not authentic.
    pub not_authentic: u64,
    /// Replayed.
    pub replayed: u64,
}

impl Refusals {
    fn count(&mut self, refusal: Refusal) {
        *match refusal {
            Refusal::Malformed => &mut self.malformed,
            Refusal::UnknownSession => &mut self.unknown_session,
            Refusal::NotAuthentic => &mut self.not_authentic,
            Refusal::Replayed => &mut self.replayed,
        } += 1;
    }

    /// All of them.
    pub fn total(&self) -> u64 {
        self.malformed + self.unknown_session + self.not_authentic + self.replayed
    }
}

/// One member's end of the sessions with all others.
pub struct Channel {
    me: Member,
    fleet: String,
    /// The keys that a handshake may use, the preferred one first; none where packets are not protected.
    keys: Vec<Key>,
    sessions: BTreeMap<u32, Session>,
    peers: BTreeMap<Member, Peer>,
    refusals: Refusals,
}

/// What is kept of another member.
#[derive(Default)]
struct Peer {
    /// The session to send in.
    current: Option<u32>,
    /// The one before it, in which packets may still come.
    previous: Option<u32>,
    /// A session that this end has answered to, and that the other end has not used yet.
    answered: Option<u32>,
    /// An initiation that waits for its response.
    pending: Option<Pending>,
    /// When the last initiation was sent.
    tried: Option<Time>,
    /// How many were sent since there was a session.
    attempts: u32,
    /// Whether this end makes sure that there is a session.
    is_wanted: bool,
}

struct Pending {
    index: u32,
    handshake: Box<HandshakeState>,
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
    /// The end of `me`. The first of `keys` is used, the others are accepted too while a fleet changes its key.
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

    /// Puts other keys in the place of the present ones. Sessions that exist go on until they are renewed.
    pub fn set_keys(&mut self, keys: Vec<Key>) {
        self.keys = keys;
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

    /// The initiations that are due, each for a member. To be called a few times a second.
    pub fn due(&mut self, now: Time) -> Vec<(Member, Vec<u8>)> {
        let Some(key) = self.keys.first().copied() else {
            return Vec::new();
        };
        let mut due = Vec::new();
        for (&member, peer) in &mut self.peers {
            let session = peer.current.and_then(|index| self.sessions.get(&index));
            let is_good = session.is_some_and(|session| {
                now.since(session.heard) < SILENCE && now.since(session.begun) < RENEWAL
            });
            let patience = Duration(PATIENCE.0 << peer.attempts.saturating_sub(1).min(DOUBLINGS));
            let waits = peer.tried.is_some_and(|at| now.since(at) < patience);
            if !peer.is_wanted || is_good || waits {
                continue;
            }
            peer.tried = Some(now);
            peer.attempts = peer.attempts.saturating_add(1);
            let Some(index) = fresh_index(&self.sessions) else {
                continue;
            };
            if let Ok((handshake, packet)) = initiate(&self.fleet, self.me, member, &key, index) {
                peer.pending = Some(Pending { index, handshake });
                due.push((member, packet));
            }
        }
        due
    }

    /// Answers to an initiation.
    fn answer(&mut self, now: Time, packet: &[u8]) -> Result<Opened, Refusal> {
        let (from, rest) = number(packet)?;
        let (remote, message) = number(rest)?;
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
        if let Some(unused) = peer.answered.replace(fresh) {
            self.sessions.remove(&unused);
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
        let awaited = self.peers.iter_mut().find(|(_, peer)| {
            let pending = peer.pending.as_ref();
            pending.is_some_and(|pending| pending.index == index)
        });
        let (&from, peer) = awaited.ok_or(Refusal::UnknownSession)?;
        let Some(Pending { mut handshake, .. }) = peer.pending.take() else {
            return Err(Refusal::UnknownSession);
        };
        if handshake.read_message(message, &mut [0; 64]).is_err() {
            // The next initiation is due anyway.
            return Err(Refusal::NotAuthentic);
        }
        let session = Session::new(now, from, remote, *handshake)?;
        self.sessions.insert(index, session);
        self.promote(from, index);
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
        if peer.answered == Some(index) {
            peer.answered = None;
            self.promote(from, index);
        }
        Ok(Opened::Content { from, content })
    }

    /// Uses a session for sending from now on.
    fn promote(&mut self, with: Member, index: u32) {
        let peer = self.peers.entry(with).or_default();
        peer.attempts = 0;
        let before = peer.current.replace(index);
        let oldest = std::mem::replace(&mut peer.previous, before);
        if let Some(oldest) = oldest {
            self.sessions.remove(&oldest);
        }
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

fn plain(packet: &[u8]) -> Result<Opened, Refusal> {
    let (from, content) = number(packet)?;
    let content = content.to_vec();
    Ok(Opened::Content { from, content })
}

fn number(packet: &[u8]) -> Result<(u32, &[u8]), Refusal> {
    let (bytes, rest) = packet.split_first_chunk().ok_or(Refusal::Malformed)?;
    Ok((u32::from_le_bytes(*bytes), rest))
}

/// A number for a session that cannot be guessed and is free.
fn fresh_index(sessions: &BTreeMap<u32, Session>) -> Option<u32> {
    (0..16)
        .filter_map(|_| getrandom::u32().ok())
        .find(|index| !sessions.contains_key(index))
}

fn initiate(
    fleet: &str,
    me: Member,
    peer: Member,
    key: &Key,
    index: u32,
) -> Result<(Box<HandshakeState>, Vec<u8>), snow::Error> {
    let prologue = prologue(fleet, me, peer);
    let builder = builder(&prologue, key).ok_or(snow::Error::Input)?;
    let mut handshake = builder.build_initiator()?;
    let mut packet = vec![0; 128];
    packet[0] = INITIATION;
    packet[1..5].copy_from_slice(&me.to_le_bytes());
    packet[5..9].copy_from_slice(&index.to_le_bytes());
    let written = handshake.write_message(&[], &mut packet[9..])?;
    packet.truncate(9 + written);
    Ok((Box::new(handshake), packet))
}

/// What both ends have to agree on beside the key.
fn prologue(fleet: &str, initiator: Member, responder: Member) -> Vec<u8> {
    let mut prologue = b"starl fleet 1\0".to_vec();
    prologue.extend(initiator.to_le_bytes());
    prologue.extend(responder.to_le_bytes());
    prologue.extend(fleet.as_bytes());
    prologue
}

fn builder<'a>(prologue: &'a [u8], key: &'a Key) -> Option<Builder<'a>> {
    let builder = Builder::new(PATTERN.parse().ok()?);
    builder.prologue(prologue).ok()?.psk(0, key).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    const KEY: Key = [7; 32];

    fn member(id: Member, key: Key) -> Channel {
        Channel::new(id, "race", vec![key])
    }

    /// Carries packets between two members until none is left; gives what was refused.
    fn connect(a: &mut Channel, b: &mut Channel, now: Time) -> Vec<Refusal> {
        a.want(b.me);
        let mut refused = Vec::new();
        for (to, packet) in a.due(now) {
            assert_eq!(to, b.me);
            match b.open(now, &packet) {
                Opened::Handshake {
                    answer: Some(answer),
                    ..
                } => {
                    if let Opened::Refused(refusal) = a.open(now, &answer) {
                        refused.push(refusal);
                    }
                }
                Opened::Refused(refusal) => refused.push(refusal),
                other => panic!("{other:?}"),
            }
        }
        refused
    }

    fn pair() -> (Channel, Channel) {
        let (mut a, mut b) = (member(0, KEY), member(1, KEY));
        assert_eq!(connect(&mut a, &mut b, Time::ZERO), []);
        let hello = a.seal(1, b"hello").unwrap();
        assert!(matches!(
            b.open(Time::ZERO, &hello),
            Opened::Content { from: 0, .. }
        ));
        (a, b)
    }

    #[test]
    fn members_with_the_same_key_hear_each_other() {
        let (mut a, mut b) = pair();
        for round in 0..2000u32 {
            let packet = b.seal(0, &round.to_le_bytes()).unwrap();
            let content = round.to_le_bytes().to_vec();
            assert_eq!(
                a.open(Time::ZERO, &packet),
                Opened::Content { from: 1, content }
            );
        }
        assert_eq!(a.refusals().total() + b.refusals().total(), 0);
    }

    #[test]
    fn a_stranger_is_refused() {
        let (mut a, mut b) = (member(0, [1; 32]), member(1, KEY));
        assert_eq!(connect(&mut a, &mut b, Time::ZERO), [Refusal::NotAuthentic]);
        assert_eq!(a.seal(1, b"hello"), None);
    }

    #[test]
    fn a_member_of_another_fleet_with_the_same_key_is_refused() {
        let (mut a, mut b) = (member(0, KEY), Channel::new(1, "search", vec![KEY]));
        assert_eq!(connect(&mut a, &mut b, Time::ZERO), [Refusal::NotAuthentic]);
    }

    #[test]
    fn a_packet_is_taken_once() {
        let (mut a, mut b) = pair();
        let packet = a.seal(1, b"move").unwrap();
        assert!(matches!(
            b.open(Time::ZERO, &packet),
            Opened::Content { .. }
        ));
        assert_eq!(
            b.open(Time::ZERO, &packet),
            Opened::Refused(Refusal::Replayed)
        );
        assert_eq!(b.refusals().replayed, 1);
    }

    #[test]
    fn a_packet_that_was_changed_anywhere_is_refused() {
        let (mut a, mut b) = pair();
        let packet = a.seal(1, b"move").unwrap();
        for place in 0..packet.len() {
            for bit in 0..8 {
                let mut changed = packet.clone();
                changed[place] ^= 1 << bit;
                assert!(
                    matches!(b.open(Time::ZERO, &changed), Opened::Refused(_)),
                    "{place}"
                );
            }
        }
        for length in 0..packet.len() {
            assert!(matches!(
                b.open(Time::ZERO, &packet[..length]),
                Opened::Refused(_)
            ));
        }
        assert!(matches!(
            b.open(Time::ZERO, &packet),
            Opened::Content { .. }
        ));
    }

    #[test]
    fn packets_of_an_earlier_life_are_refused() {
        let (mut a, b) = pair();
        let old = a.seal(1, b"move").unwrap();
        drop(b);
        let mut b = member(1, KEY);
        assert_eq!(
            b.open(Time::ZERO, &old),
            Opened::Refused(Refusal::UnknownSession)
        );
        // The robot that has restarted begins a session, and both hear each other again.
        assert_eq!(connect(&mut b, &mut a, Time::ZERO), []);
        let packet = b.seal(0, b"here").unwrap();
        assert!(matches!(
            a.open(Time::ZERO, &packet),
            Opened::Content { .. }
        ));
        let packet = a.seal(1, b"there").unwrap();
        assert!(matches!(
            b.open(Time::ZERO, &packet),
            Opened::Content { .. }
        ));
        assert!(matches!(b.open(Time::ZERO, &old), Opened::Refused(_)));
    }

    #[test]
    fn a_repeated_initiation_ends_no_session() {
        let (mut a, mut b) = (member(0, KEY), member(1, KEY));
        a.want(1);
        let (_, initiation) = a.due(Time::ZERO).remove(0);
        let Opened::Handshake { answer, .. } = b.open(Time::ZERO, &initiation) else {
            panic!();
        };
        a.open(Time::ZERO, &answer.unwrap());
        let hello = a.seal(1, b"hello").unwrap();
        b.open(Time::ZERO, &hello);
        for _ in 0..100 {
            assert!(matches!(
                b.open(Time::ZERO, &initiation),
                Opened::Handshake { .. }
            ));
        }
        assert!(b.sessions.len() <= 2);
        let packet = b.seal(0, b"still here").unwrap();
        assert!(matches!(
            a.open(Time::ZERO, &packet),
            Opened::Content { .. }
        ));
    }

    #[test]
    fn a_key_is_changed_while_the_fleet_runs() {
        let (mut a, mut b) = pair();
        let new = [9; 32];
        b.set_keys(vec![new, KEY]);
        a.set_keys(vec![new, KEY]);
        let later = Time::ZERO + RENEWAL;
        assert_eq!(connect(&mut a, &mut b, later), []);
        let packet = a.seal(1, b"new").unwrap();
        assert!(matches!(b.open(later, &packet), Opened::Content { .. }));
        b.set_keys(vec![new]);
        a.set_keys(vec![new]);
        assert_eq!(connect(&mut a, &mut b, later + RENEWAL), []);
    }

    #[test]
    fn a_handshake_ends_where_packets_take_long() {
        let (mut a, mut b) = (member(0, KEY), member(1, KEY));
        a.want(1);
        let delay = Duration::from_millis(700);
        // What is on its way: when it arrives, whether at `b`, and the packet.
        let mut flying: Vec<(Time, bool, Vec<u8>)> = Vec::new();
        for tick in 0..100 {
            let now = Time::ZERO + Duration::from_millis(100 * tick);
            let initiations = a.due(now).into_iter();
            flying.extend(initiations.map(|(_, packet)| (now + delay, true, packet)));
            let (due, rest) = flying.into_iter().partition(|packet| packet.0 <= now);
            flying = rest;
            let due: Vec<(Time, bool, Vec<u8>)> = due;
            for (_, at_b, packet) in due {
                let end = if at_b { &mut b } else { &mut a };
                if let Opened::Handshake {
                    answer: Some(answer),
                    ..
                } = end.open(now, &packet)
                {
                    flying.push((now + delay, !at_b, answer));
                }
            }
            if a.seal(1, b"hello").is_some() {
                return;
            }
        }
        panic!("there is no session after ten seconds");
    }

    #[test]
    fn garbage_changes_nothing() {
        let (mut a, mut b) = pair();
        let mut state = 1u64;
        for _ in 0..50_000 {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1);
            let length = (state >> 40) as usize % 200;
            let garbage: Vec<u8> = (0..length)
                .map(|i| (state >> (i % 50)) as u8 ^ i as u8)
                .collect();
            assert!(matches!(b.open(Time::ZERO, &garbage), Opened::Refused(_)));
        }
        let packet = a.seal(1, b"move").unwrap();
        assert!(matches!(
            b.open(Time::ZERO, &packet),
            Opened::Content { .. }
        ));
    }
}
