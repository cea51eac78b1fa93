//! Another device on the bus, by script: says what it is told, byte by byte, and waits for answers.

use std::io;
use std::time::Duration;

use socketcan::{CanSocket, Socket};

use super::guest::SECOND;
use super::tap::{Heard, Tap};

/// The flag of identifiers of 29 bits, and of frames of the controller.
const EXTENDED: u32 = 0x8000_0000;
const ERROR: u32 = 0x2000_0000;

pub(crate) const CLAIM: u32 = 60_928;
pub(crate) const PRODUCT: u32 = 126_996;
pub(crate) const CONFIGURATION: u32 = 126_998;
pub(crate) const LISTS: u32 = 126_464;
pub(crate) const REFUSAL: u32 = 59_392;
const REQUEST: u32 = 59_904;
const MANAGEMENT: u32 = 60_416;
const PACKET: u32 = 60_160;
/// Number of the last frame of its 134 bytes.
const LAST_OF_PRODUCT: u8 = 19;
pub(crate) const EVERYBODY: u8 = 255;

/// A device with an address, on a socket of its own.
pub(crate) struct Peer {
    socket: CanSocket,
    pub(crate) address: u8,
}

impl Peer {
    pub(crate) fn on(name: &str, address: u8) -> Self {
        Peer { socket: CanSocket::open(name).unwrap(), address }
    }

    pub(crate) fn try_say(&self, id: u32, data: &[u8]) -> io::Result<()> {
        let mut bytes = [0; 16];
        bytes[..4].copy_from_slice(&id.to_ne_bytes());
        bytes[4] = data.len() as u8;
        bytes[8..8 + data.len()].copy_from_slice(data);
        rustix::io::write(self.socket.as_raw_socket(), &bytes)?;
        Ok(())
    }

    /// Sends a frame of a group to an address.
    pub(crate) fn send(&self, priority: u8, pgn: u32, to: u8, source: u8, data: &[u8]) {
        let group = if pgn >> 8 & 0xFF < 240 { pgn | u32::from(to) } else { pgn };
        let id = EXTENDED | u32::from(priority) << 26 | group << 8 | u32::from(source);
        self.try_say(id, data).unwrap();
    }

    /// Claims an address.
    pub(crate) fn claim(&self, address: u8, name: u64) {
        self.send(6, CLAIM, EVERYBODY, address, &name.to_le_bytes());
    }

    pub(crate) fn request(&self, pgn: u32, to: u8) {
        self.send(6, REQUEST, to, self.address, &pgn.to_le_bytes()[..3]);
    }

    /// What the controller would say.
    pub(crate) fn controller(&self, class: u32) {
        self.try_say(ERROR | class, &[0; 8]).unwrap();
    }

    /// Commands the node of a NAME to an address, by an announcement to everybody and two packets.
    pub(crate) fn command(&self, name: u64, address: u8) {
        let announce = [32, 9, 0, 2, 255, 0xD8, 0xFE, 0];
        self.send(7, MANAGEMENT, EVERYBODY, self.address, &announce);
        for packet in commanded(name, address) {
            std::thread::sleep(Duration::from_millis(60));
            self.send(7, PACKET, EVERYBODY, self.address, &packet);
        }
    }

    /// The same to one address, as that allows. True if it acknowledges the end.
    pub(crate) fn command_one(&self, name: u64, address: u8, to: u8, tap: &Tap) -> bool {
        let since = tap.now();
        let says = |what: u8| {
            tap.wait(since, SECOND, |frame| {
                frame.pgn() == MANAGEMENT
                    && frame.source() == to
                    && frame.destination() == self.address
                    && frame.data()[0] == what
            })
        };
        self.send(7, MANAGEMENT, to, self.address, &[16, 9, 0, 2, 255, 0xD8, 0xFE, 0]);
        if says(17).is_none() {
            return false;
        }
        for packet in commanded(name, address) {
            self.send(7, PACKET, to, self.address, &packet);
        }
        says(19).is_some()
    }

    /// Asks an address for a group of many frames. Gives how long it took to the last frame of the answer,
    /// s, and its contents.
    pub(crate) fn ask(&self, pgn: u32, to: u8, tap: &Tap) -> Option<(f64, Vec<u8>)> {
        let since = tap.now();
        self.request(pgn, to);
        let (mut length, mut data) = (usize::MAX, Vec::new());
        let last = tap.wait(since, SECOND, |frame| {
            if frame.pgn() == pgn && frame.source() == to {
                let first = frame.data()[0] & 31 == 0;
                if first {
                    (length, data) = (frame.data()[1].into(), Vec::new());
                }
                data.extend_from_slice(&frame.data()[if first { 2 } else { 1 }..]);
            }
            data.len() >= length
        })?;
        data.truncate(length);
        Some((last.at - since, data))
    }

    /// Asks an address for its product information again and again until it answers, as after trouble.
    /// Gives how long it took to the last frame of the answer, s.
    pub(crate) fn insist(&self, to: u8, tap: &Tap, patience: Duration) -> Option<f64> {
        let since = tap.now();
        let id = EXTENDED | 0x18EA_0000 | u32::from(to) << 8 | u32::from(self.address);
        let is_last = |frame: &Heard| {
            (frame.pgn(), frame.source(), frame.data()[0] & 31) == (PRODUCT, to, LAST_OF_PRODUCT)
        };
        while tap.now() - since < patience.as_secs_f64() {
            // the interface need not be there yet
            let _ = self.try_say(id, &PRODUCT.to_le_bytes()[..3]);
            if let Some(frame) = tap.wait(since, SECOND / 20, is_last) {
                return Some(frame.at - since);
            }
        }
        None
    }
}

fn commanded(name: u64, address: u8) -> [[u8; 8]; 2] {
    let mut packets = [[255; 8]; 2];
    let [first, second] = &mut packets;
    first[0] = 1;
    first[1..].copy_from_slice(&name.to_le_bytes()[..7]);
    second[..3].copy_from_slice(&[2, name.to_le_bytes()[7], address]);
    packets
}
