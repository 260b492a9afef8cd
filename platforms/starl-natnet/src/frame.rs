//! A frame: where all bodies are at one moment, between sections of markers, skeletons and devices.

use crate::bytes::Reader;
use crate::{Version, WITH_LENGTHS};

/// A frame of motion capture. Sections other than rigid bodies are passed over.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Frame {
    /// Counts frames.
    pub number: u32,
    /// The bodies, tracked or not.
    pub bodies: Vec<RigidBody>,
    /// Seconds since the server began.
    pub timestamp: f64,
    /// Ticks of the server's clock when the cameras' shutters were half way open.
    pub exposed: u64,
    /// Ticks of the server's clock when the frame was sent.
    pub sent: u64,
}

/// A rigid body in a frame.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RigidBody {
    /// Its number; its name is in the descriptions.
    pub number: u32,
    /// Metres, in the axes of the server.
    pub position: [f32; 3],
    /// Unit quaternion: x, y, z, w.
    pub rotation: [f32; 4],
    /// Mean error of its markers, metres.
    pub error: f32,
    /// Whether the cameras see it in this frame; otherwise the rest is old.
    pub tracked: bool,
}

/// Bytes of a rigid body, and of a labelled marker.
const BODY_LENGTH: usize = 38;
const MARKER_LENGTH: usize = 26;

impl Frame {
    pub(crate) fn encode(&self, version: Version, out: &mut Vec<u8>) {
        out.extend(self.number.to_le_bytes());
        let mut section = |count: usize, content: &[u8]| {
            out.extend((count as u32).to_le_bytes());
            if version >= WITH_LENGTHS {
                out.extend((content.len() as u32).to_le_bytes());
            }
            out.extend(content);
        };
        // Sets of markers, markers without a name.
        section(0, &[]);
        section(0, &[]);
        let mut bodies = Vec::with_capacity(BODY_LENGTH * self.bodies.len());
        for body in &self.bodies {
            bodies.extend(body.number.to_le_bytes());
            for value in body.position.iter().chain(&body.rotation) {
                bodies.extend(value.to_le_bytes());
            }
            bodies.extend(body.error.to_le_bytes());
            bodies.extend(u16::from(body.tracked).to_le_bytes());
        }
        section(self.bodies.len(), &bodies);
        // Skeletons, assets if the version has them, labelled markers, force plates, devices.
        for _ in 0..if version >= WITH_LENGTHS { 5 } else { 4 } {
            section(0, &[]);
        }
        // Time code, and what comes between its pictures.
        out.extend([0; 8]);
        out.extend(self.timestamp.to_le_bytes());
        for stamp in [self.exposed, self.exposed, self.sent] {
            out.extend(stamp.to_le_bytes());
        }
        if version >= WITH_LENGTHS {
            // The time of the precision time protocol: there is none.
            out.extend([0; 8]);
        }
        // Whether the server records, and the mark of the end.
        out.extend([0; 2 + 4]);
    }

    pub(crate) fn decode(body: &[u8], version: Version) -> Option<Frame> {
        let mut reader = Reader::new(body);
        let mut frame = Frame {
            number: reader.u32()?,
            ..Frame::default()
        };
        let lengths = version >= WITH_LENGTHS;
        section(&mut reader, lengths, 5, |reader| {
            reader.text()?;
            points(reader)
        })?;
        section(&mut reader, lengths, 12, |reader| reader.skip(12).map(drop))?;
        // Bodies are read in either case, so their section is not skipped by its length.
        let count = reader.count(BODY_LENGTH)?;
        if lengths {
            reader.u32()?;
        }
        for _ in 0..count {
            frame.bodies.push(RigidBody::decode(&mut reader)?);
        }
        section(&mut reader, lengths, 8, |reader| {
            reader.u32()?;
            let bodies = reader.count(BODY_LENGTH)?;
            reader.skip(BODY_LENGTH * bodies).map(drop)
        })?;
        if lengths {
            section(&mut reader, lengths, 0, |_| None)?;
        }
        section(&mut reader, lengths, MARKER_LENGTH, |reader| {
            reader.skip(MARKER_LENGTH).map(drop)
        })?;
        section(&mut reader, lengths, 8, channels)?;
        section(&mut reader, lengths, 8, channels)?;
        reader.skip(8)?;
        frame.timestamp = reader.f64()?;
        frame.exposed = reader.u64()?;
        reader.u64()?;
        frame.sent = reader.u64()?;
        Some(frame)
    }
}

impl RigidBody {
    fn decode(reader: &mut Reader<'_>) -> Option<RigidBody> {
        let number = reader.u32()?;
        let position = reader.f32s()?;
        let rotation = reader.f32s()?;
        let [error] = reader.f32s()?;
        Some(RigidBody {
            number,
            position,
            rotation,
            error,
            tracked: reader.u16()? & 1 != 0,
        })
    }
}

/// Passes over a section: by its length, or by its items of at least `least` bytes each.
fn section(
    reader: &mut Reader<'_>,
    lengths: bool,
    least: usize,
    mut item: impl FnMut(&mut Reader<'_>) -> Option<()>,
) -> Option<()> {
    if lengths {
        reader.u32()?;
        let length = reader.u32()? as usize;
        return reader.skip(length).map(drop);
    }
    for _ in 0..reader.count(least)? {
        item(reader)?;
    }
    Some(())
}

fn points(reader: &mut Reader<'_>) -> Option<()> {
    let count = reader.count(12)?;
    reader.skip(12 * count).map(drop)
}

/// A force plate or a device: a number, then channels of floats.
fn channels(reader: &mut Reader<'_>) -> Option<()> {
    reader.u32()?;
    for _ in 0..reader.count(4)? {
        let values = reader.count(4)?;
        reader.skip(4 * values)?;
    }
    Some(())
}
