//! Timers: a state machine names its own as an enum, a host sees opaque keys.
//!
//! ```
//! use starl_core::{Port, TimerKey, timers};
//!
//! timers! {
//!     /// The timers of a courier.
//!     pub enum Alarm {
//!         /// A message is to be sent again, by its number.
//!         Resend(u32),
//!         /// The mailbox is to be looked at.
//!         Look,
//!     }
//! }
//!
//! let port = Port::named("courier");
//! let key = TimerKey::new(port, Alarm::Resend(7));
//! assert_eq!(key.read(), Some(Alarm::Resend(7)));
//! assert!(key < TimerKey::new(port, Alarm::Look));
//! ```

use crate::Port;
use core::fmt;
use serde::{Deserialize, Serialize};

/// The purpose of a timer. Its owner makes it from a [`Timer`] and reads it back; to all others it is
/// opaque.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Token {
    kind: u16,
    number: u32,
}

impl Token {
    /// A token from the two parts that [`Token::parts`] gives back. Tokens are ordered by `kind`, then by
    /// `number`.
    pub const fn new(kind: u16, number: u32) -> Token {
        Token { kind, number }
    }

    /// Its parts: `kind` and `number`.
    pub const fn parts(self) -> (u16, u32) {
        (self.kind, self.number)
    }
}

impl fmt::Display for Token {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}.{}", self.kind, self.number)
    }
}

/// The timers of one owner; [`timers!`](crate::timers) implements it for enums.
pub trait Timer: Sized {
    /// Its token, different for different timers.
    fn token(self) -> Token;

    /// The timer with this token; `None` if the owner has no such timer.
    fn from_token(token: Token) -> Option<Self>;
}

/// Names a timer of one robot. Arming a key that is armed already moves it. Timers that are due at the same
/// moment fire in the order of their keys.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(from = "Flat", into = "Flat")]
pub struct TimerKey {
    /// The owner: a program or a primitive.
    pub port: Port,
    /// The owner's use of it.
    pub token: Token,
}

impl TimerKey {
    /// The key of a timer of the owner of this port.
    pub fn new(port: Port, timer: impl Timer) -> TimerKey {
        TimerKey {
            port,
            token: timer.token(),
        }
    }

    /// The timer of the port's owner; `None` if the type has no such timer.
    pub fn read<T: Timer>(&self) -> Option<T> {
        T::from_token(self.token)
    }
}

/// A key as files hold it.
#[derive(Serialize, Deserialize)]
struct Flat {
    port: Port,
    kind: u16,
    number: u32,
}

impl From<TimerKey> for Flat {
    fn from(TimerKey { port, token }: TimerKey) -> Flat {
        let (kind, number) = token.parts();
        Flat { port, kind, number }
    }
}

impl From<Flat> for TimerKey {
    fn from(Flat { port, kind, number }: Flat) -> TimerKey {
        let token = Token::new(kind, number);
        TimerKey { port, token }
    }
}

/// Defines an enum and implements [`Timer`] for it. A variant may hold one number, of a type that converts
/// to `u32` and back. Timers are ordered as their variants are written, then by their numbers.
#[macro_export]
macro_rules! timers {
    (
        $(#[$meta:meta])*
        $visibility:vis enum $name:ident {
            $($(#[$note:meta])* $variant:ident $(($number:ty))?),+ $(,)?
        }
    ) => {
        $(#[$meta])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        $visibility enum $name { $($(#[$note])* $variant $(($number))?),+ }

        const _: () = {
            /// The place of each variant.
            #[repr(u16)]
            enum Kind { $($variant),+ }

            impl $crate::timer::Timer for $name {
                fn token(self) -> $crate::timer::Token {
                    let (kind, number) = match self {
                        $($name::$variant { $(0: number @ $crate::timers!(@any $number))? } => {
                            (Kind::$variant, [$(<u32 as From<$number>>::from(number),)? 0][0])
                        })+
                    };
                    $crate::timer::Token::new(kind as u16, number)
                }

                fn from_token(token: $crate::timer::Token) -> Option<$name> {
                    let (kind, number) = token.parts();
                    $(if kind == Kind::$variant as u16 {
                        return $crate::timers!(@timer number, $name::$variant $(($number))?);
                    })+
                    None
                }
            }
        };
    };
    (@any $number:ty) => { _ };
    (@timer $found:ident, $name:ident::$variant:ident) => {
        ($found == 0).then_some($name::$variant)
    };
    (@timer $found:ident, $name:ident::$variant:ident($number:ty)) => {
        <$number>::try_from($found).ok().map($name::$variant)
    };
}
