//! The stream of sensor packets: byte 19, a length, pairs of packet number and value, and a checksum that makes the
//! sum of all bytes a multiple of 256.

use crate::sensor;
use std::collections::VecDeque;

const HEADER: u8 = 19;

/// Appends a frame. `content` is packet numbers with their values, at most 255 bytes.
pub fn encode_frame(content: &[u8], out: &mut Vec<u8>) {
    let start = out.len();
    out.extend([HEADER, content.len() as u8]);
    out.extend(content);
    let sum = out[start..]
        .iter()
        .fold(0u8, |sum, byte| sum.wrapping_add(*byte));
    out.push(sum.wrapping_neg());
}

/// Finds frames in the bytes that arrive. Only a frame of exactly the packets asked for is taken, since one byte of
/// checksum alone passes every 256th run of noise.
#[derive(Clone, Debug)]
pub struct FrameDecoder {
    packets: Vec<u8>,
    bytes: VecDeque<u8>,
    length: usize,
}

impl FrameDecoder {
    /// A decoder of frames with these packets, none of them a group, in this order.
    pub fn new(packets: &[u8]) -> FrameDecoder {
        let lengths = packets.iter().filter_map(|&packet| sensor::length(packet));
        FrameDecoder {
            packets: packets.to_vec(),
            bytes: VecDeque::new(),
            length: lengths.map(|length| 1 + length).sum(),
        }
    }

    /// Takes bytes that have arrived.
    pub fn push(&mut self, bytes: &[u8]) {
        self.bytes.extend(bytes);
    }

    /// The values of the next frame, in the order of the packets.
    pub fn pop(&mut self) -> Option<Vec<i32>> {
        while self.bytes.len() >= self.length + 3 {
            if let Some(values) = self.frame() {
                self.bytes.drain(..self.length + 3);
                return Some(values);
            }
            self.bytes.pop_front();
        }
        None
    }

    /// The values of the frame with which the bytes begin.
    fn frame(&self) -> Option<Vec<i32>> {
        let byte = |at: usize| self.bytes[at];
        if byte(0) != HEADER || usize::from(byte(1)) != self.length {
            return None;
        }
        let sum = (0..self.length + 3).fold(0u8, |sum, at| sum.wrapping_add(byte(at)));
        if sum != 0 {
            return None;
        }
        let mut at = 2;
        let mut values = Vec::with_capacity(self.packets.len());
        for &packet in &self.packets {
            let length = sensor::length(packet)?;
            if byte(at) != packet {
                return None;
            }
            let bytes: Vec<u8> = (at + 1..=at + length).map(byte).collect();
            values.push(sensor::value(packet, &bytes)?);
            at += 1 + length;
        }
        Some(values)
    }
}
