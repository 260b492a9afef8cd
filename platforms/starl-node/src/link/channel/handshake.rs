//! The messages of a Noise handshake.

use super::{INITIATION, Key, Member, Session};
use snow::{Builder, HandshakeState};
use std::collections::BTreeMap;

const PATTERN: &str = "Noise_NNpsk0_25519_ChaChaPoly_BLAKE2s";

/// A number for a session that cannot be guessed and is free.
pub(super) fn fresh_index(sessions: &BTreeMap<u32, Session>) -> Option<u32> {
    (0..16)
        .filter_map(|_| getrandom::u32().ok())
        .find(|index| !sessions.contains_key(index))
}

pub(super) fn initiate(
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

/// The values, besides the key, on which both ends must agree.
pub(super) fn prologue(fleet: &str, initiator: Member, responder: Member) -> Vec<u8> {
    let mut prologue = b"starl fleet 1\0".to_vec();
    prologue.extend(initiator.to_le_bytes());
    prologue.extend(responder.to_le_bytes());
    prologue.extend(fleet.as_bytes());
    prologue
}

pub(super) fn builder<'a>(prologue: &'a [u8], key: &'a Key) -> Option<Builder<'a>> {
    let builder = Builder::new(PATTERN.parse().ok()?);
    builder.prologue(prologue).ok()?.psk(0, key).ok()
}
