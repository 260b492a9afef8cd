//! One packet: a port and a channel, which define its kind, and up to 30 bytes.

/// The longest content of a packet, bytes.
pub const LONGEST: usize = 30;

/// The ports that are used here.
pub mod port {
    /// Parameters.
    pub const PARAMETERS: u8 = 0x02;
    /// The memories of decks.
    pub const MEMORY: u8 = 0x04;
    /// Variables that are sent again and again.
    pub const LOG: u8 = 0x05;
    /// Set-points of all kinds.
    pub const COMMANDER: u8 = 0x07;
    /// Manoeuvres that the Crazyflie flies by itself.
    pub const HIGH_LEVEL: u8 = 0x08;
    /// The Crazyflie itself: its version, and whether it is armed.
    pub const PLATFORM: u8 = 0x0D;
    /// The link.
    pub const LINK: u8 = 0x0F;
}

/// A packet.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Packet {
    /// The port, 0 to 15: each service of the Crazyflie has its own.
    pub port: u8,
    /// The channel of the port, 0 to 3.
    pub channel: u8,
    /// The content, up to [`LONGEST`] bytes.
    pub content: Vec<u8>,
}

impl Packet {
    /// A packet. Content beyond [`LONGEST`] bytes is cut off.
    pub fn new(port: u8, channel: u8, content: &[u8]) -> Packet {
        Packet {
            port: port & 15,
            channel: channel & 3,
            content: content[..content.len().min(LONGEST)].to_vec(),
        }
    }

    /// The datagram.
    pub fn encode(&self) -> Vec<u8> {
        // The two bits between port and channel are of the link, and set by all clients.
        let mut datagram = vec![self.port << 4 | 3 << 2 | self.channel];
        datagram.extend(&self.content);
        datagram
    }

    /// The packet in a datagram; none if it is too long or empty, or a null packet, which says nothing.
    pub fn decode(datagram: &[u8]) -> Option<Packet> {
        let (&header, content) = datagram.split_first()?;
        let is_null = header & 0xF3 == 0xF3;
        let packet = Packet::new(header >> 4, header, content);
        (content.len() <= LONGEST && !is_null).then_some(packet)
    }
}

/// Reads numbers from a content, little-endian.
pub(crate) struct Numbers<'a>(pub &'a [u8]);

impl Numbers<'_> {
    fn next<const N: usize>(&mut self) -> Option<[u8; N]> {
        let (bytes, rest) = self.0.split_first_chunk()?;
        self.0 = rest;
        Some(*bytes)
    }

    pub fn u8(&mut self) -> Option<u8> {
        Some(self.next::<1>()?[0])
    }

    pub fn u16(&mut self) -> Option<u16> {
        self.next().map(u16::from_le_bytes)
    }

    pub fn i16(&mut self) -> Option<i16> {
        self.next().map(i16::from_le_bytes)
    }

    /// None if it is not finite.
    pub fn f32(&mut self) -> Option<f32> {
        self.next()
            .map(f32::from_le_bytes)
            .filter(|n| n.is_finite())
    }
}
