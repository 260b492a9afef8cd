//! Late copies of numbered messages.

/// Numbers that are further apart are not those of copies: a corruption has left one of them.
const FURTHEST: u32 = 64;

/// Whether a message with this number is a copy, since one with the number `latest` has come. Counts begin again after 2^32.
pub(crate) fn is_copy(number: u32, latest: u32) -> bool {
    latest.wrapping_sub(number) < FURTHEST
}
