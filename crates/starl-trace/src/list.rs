//! Records and whole traces as one JSON text, for hosts that show a running run.

use crate::json::Json;
use crate::{Topic, encode};
use starl_core::Record;

/// The records as a JSON array. Each is an object with `time_ns`, the `topic`, and the `message` as in a trace.
/// Infinite numbers and NaN are null; a trace does not accept them.
pub fn json_list<'a>(records: impl IntoIterator<Item = &'a Record>) -> Vec<u8> {
    let mut json = Json::default();
    json.mark(b'[');
    for record in records {
        json.item().mark(b'{');
        json.key("time_ns").integer(record.at.0);
        json.key("topic").string(Topic::of(&record.event).name());
        json.key("message");
        encode::event(&mut json, record.robot, &record.event);
        json.mark(b'}');
    }
    json.mark(b']');
    json.bytes().to_vec()
}

/// Bytes as a JSON text in base 64 (RFC 4648, section 4).
pub fn json_bytes(bytes: &[u8]) -> Vec<u8> {
    let mut json = Json::default();
    json.base64(bytes);
    json.bytes().to_vec()
}
