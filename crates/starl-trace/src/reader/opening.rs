//! Reads what stands before the records: metadata and attachments.

use crate::container::{Container, RawRecord};
use crate::fields::Fields;
use crate::{FORMAT_VERSION, Header, TraceError, header, topic};
use mcap::records::op;
use std::io::Read;

/// Reads the header. The world is its last part; no other record may precede it.
pub fn read<R: Read>(container: &mut Container<R>) -> Result<Header, TraceError> {
    let mut header = Header::default();
    let mut versioned = false;
    loop {
        let Some(RawRecord { opcode, body }) = container.next()? else {
            return Err(TraceError::NotStarl);
        };
        let done = match opcode {
            op::METADATA => metadata(body, &mut header, &mut versioned),
            op::ATTACHMENT if versioned => attachment(body, &mut header),
            op::SCHEMA | op::CHANNEL | op::MESSAGE if !versioned => {
                return Err(TraceError::NotStarl);
            }
            op::SCHEMA | op::CHANNEL | op::MESSAGE => Err(Fault::Damaged(
                "the world is missing before the messages".into(),
            )),
            _ => Ok(false),
        };
        match done {
            Ok(false) => {}
            Ok(true) => return Ok(header),
            Err(Fault::Version(found)) => return Err(TraceError::Version { found }),
            Err(Fault::Damaged(what)) => return Err(container.damaged(what)),
        }
    }
}

/// Problems of a record of the header.
enum Fault {
    Damaged(String),
    Version(String),
}

/// Takes the metadata record `starl`.
fn metadata(body: &[u8], header: &mut Header, versioned: &mut bool) -> Result<bool, Fault> {
    let damaged = |what: &str| Fault::Damaged(what.into());
    let mut fields = Fields(body);
    let Some((name, pairs)) = fields.text().zip(fields.pairs()) else {
        return Err(damaged("a metadata record is cut short"));
    };
    if name != topic::METADATA {
        return Ok(false);
    }
    let get = |wanted: &str| {
        pairs
            .iter()
            .find(|(key, _)| *key == wanted)
            .map(|(_, value)| *value)
    };
    let version = get("format_version").ok_or_else(|| damaged("`format_version` is missing"))?;
    if version != FORMAT_VERSION.to_string() {
        return Err(Fault::Version(version.into()));
    }
    let seed = get("seed").and_then(|seed| seed.parse().ok());
    header.seed = seed.ok_or_else(|| damaged("`seed` is missing or not a number"))?;
    header.program = get("program").unwrap_or_default().into();
    header.starl_version = get("starl_version").unwrap_or_default().into();
    *versioned = true;
    Ok(false)
}

/// Takes an attachment; the world is the last.
fn attachment(body: &[u8], header: &mut Header) -> Result<bool, Fault> {
    let damaged = |what: String| Fault::Damaged(what);
    let mut fields = Fields(body);
    let parts = (|| {
        let (_logged, _created) = (fields.u64()?, fields.u64()?);
        let (name, _media) = (fields.text()?, fields.text()?);
        let length = fields.u64()?;
        Some((name, fields.bytes(length)?, fields.u32()?))
    })();
    let Some((name, data, saved)) = parts else {
        return Err(damaged("an attachment is cut short".into()));
    };
    if saved != 0 && saved != crc32fast::hash(&body[..body.len() - 4]) {
        return Err(damaged(format!(
            "the checksum of the attachment `{name}` does not match"
        )));
    }
    let text = || {
        let text = core::str::from_utf8(data).map(String::from);
        text.map_err(|_| damaged(format!("the attachment `{name}` is not text")))
    };
    if name == topic::WORLD {
        header::decode_world(data, header)
            .map_err(|what| damaged(format!("the attachment `{name}`: {what}")))?;
        return Ok(true);
    }
    if name == topic::SCENARIO {
        header.scenario = text()?;
    } else if name == topic::SETTING {
        header.setting = text()?;
    } else if let Some(file) = name.strip_prefix(topic::FILES) {
        header.files.insert(file.into(), text()?);
    }
    Ok(false)
}
