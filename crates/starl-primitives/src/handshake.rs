//! Which life of another robot is listened to.
//!
//! A datagram does not show whether its sender is still alive: copies may have any age. So a receiver listens to an
//! incarnation only after that incarnation has answered a token that the receiver drew, and draws another token for
//! the next. Then the incarnation was alive after the token was drawn, that is, after the receiver listened to the
//! previous incarnation. So a receiver moves from each incarnation only to later ones, and needs to remember no past
//! ones. This is the three-way handshake by which transport protocols distinguish connections (Tomlinson 1975,
//! "Selecting sequence numbers"; Attiya and Rappoport 1997, "The level of handshake required for managing a
//! connection").

use starl_core::Robot;
use starl_core::random::hash_key;

/// The accepted life of one peer, its state, and the token that identifies the next life.
#[derive(Clone, Debug)]
pub(crate) struct Handshake<T> {
    /// The accepted incarnation, and its state.
    pub heard: Option<(u32, T)>,
    /// The token that the next incarnation must answer; none if it is not asked.
    token: Option<u32>,
}

impl<T> Default for Handshake<T> {
    fn default() -> Handshake<T> {
        Handshake {
            heard: None,
            token: None,
        }
    }
}

impl<T> Handshake<T> {
    /// Does not listen to any incarnation yet; the first must answer this token.
    pub fn asking(token: u32) -> Handshake<T> {
        Handshake {
            heard: None,
            token: Some(token),
        }
    }

    /// Listens to an incarnation, of which this is known, and asks for no other.
    pub fn hearing(incarnation: u32, known: T) -> Handshake<T> {
        Handshake {
            heard: Some((incarnation, known)),
            token: None,
        }
    }

    /// The token that the next incarnation must answer, drawn if there is none.
    pub fn token(&mut self, robot: &mut Robot<'_>) -> u32 {
        // The clock is mixed in so that a robot whose random stream starts over draws another one.
        *self.token.get_or_insert_with(|| {
            let bits = u64::from(robot.random().bits());
            hash_key(robot.now().0, &[bits, 1]) as u32
        })
    }

    /// The token that the next incarnation has to answer, if it is asked for.
    pub fn asked(&self) -> Option<u32> {
        self.token
    }

    /// From now on only answers to a new token count.
    pub fn renew_token(&mut self) {
        self.token = None;
    }

    /// An incarnation answers a token: from now on it is listened to, and `new` is known of it if it was not before.
    /// False if the token is not the present one.
    pub fn begin(&mut self, incarnation: u32, token: u32, new: impl FnOnce() -> T) -> bool {
        let is_fresh = self.token == Some(token);
        if is_fresh {
            self.token = None;
            if self.of(incarnation).is_none() {
                self.heard = Some((incarnation, new()));
            }
        }
        is_fresh
    }

    /// The state of an incarnation, if it is the current one.
    pub fn of(&mut self, incarnation: u32) -> Option<&mut T> {
        let heard = self.heard.as_mut().filter(|heard| heard.0 == incarnation)?;
        Some(&mut heard.1)
    }

    /// The state of the current incarnation.
    pub fn known(&self) -> Option<&T> {
        self.heard.as_ref().map(|(_, known)| known)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_life_that_answers_an_earlier_token_is_not_heard() {
        let mut lives = Handshake::asking(3);
        assert!(lives.begin(7, 3, || ()));
        assert!(!lives.begin(6, 3, || ()), "the token was answered before");
        assert!(lives.of(6).is_none() && lives.of(7).is_some());
    }
}
