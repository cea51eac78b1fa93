//! Puts frames together to messages: single frames, fast packets, and the transport protocol of ISO
//! 11783-3 as far as it can be overheard.
//!
//! Strict, so that no message is ever made of two: frames must come in order, and one that is
//! missing costs the message. Memory is bounded whatever is heard.

use insd_base::can::CanFrame;
use insd_base::{Span, Time};

use crate::fast_packet::{self, MAX_FRAMES, MAX_LENGTH};
use crate::transport::{MANAGEMENT, Management, PACKET, Packet, SILENCE, Transfer};
use crate::{BROADCAST, BusMessage, N2kId};

/// The longest silence within a fast packet.
const FAST_SILENCE: Span = Span::from_nanos(750_000_000);
/// Fast packets under way at once.
const MAX_OPEN: usize = 64;
/// Transfers under way at once.
const MAX_TRANSFERS: usize = 16;

/// A message that is complete.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Assembled {
    /// The message.
    pub message: BusMessage,
    /// When its first frame was received.
    pub begun: Time,
}

/// What has been taken, and why some of it gave no message.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct AssemblerCounts {
    /// Frames taken.
    pub frames: u64,
    /// Messages completed.
    pub messages: u64,
    /// Frames with an identifier of 11 bits: not NMEA 2000.
    pub foreign: u64,
    /// Frames of a fast packet whose beginning was not heard, or whose message was given up.
    pub orphans: u64,
    /// Messages given up because a frame was missing, out of order or too short.
    pub gaps: u64,
    /// Messages given up because their sender began another under the same counter.
    pub superseded: u64,
    /// Messages given up because nothing more came of them.
    pub stale: u64,
    /// Messages given up because too many were under way.
    pub crowded: u64,
    /// Beginnings that announced an impossible length.
    pub bad_length: u64,
    /// Transfers that their sender or receiver gave up.
    pub aborted: u64,
}

impl AssemblerCounts {
    /// Messages of which not every frame came.
    #[must_use]
    pub fn incomplete(&self) -> u64 {
        self.gaps + self.superseded + self.stale + self.crowded
    }
}

/// A fast packet under way.
#[derive(Clone, Debug)]
struct Open {
    id: N2kId,
    sequence: u8,
    length: usize,
    next: u8,
    begun: Time,
    heard: Time,
    data: Vec<u8>,
}

/// From frames to messages.
#[derive(Clone, Debug, Default)]
pub struct Assembler {
    open: Vec<Open>,
    transfers: Vec<Transfer>,
    counts: AssemblerCounts,
}

impl Assembler {
    /// One that has heard nothing.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Takes a frame; the message, if the frame completes one. Never panics.
    pub fn take(&mut self, frame: &CanFrame, now: Time) -> Option<Assembled> {
        self.counts.frames += 1;
        let Some(id) = N2kId::parse(frame.id()) else {
            self.counts.foreign += 1;
            return None;
        };
        let assembled = match id.pgn {
            MANAGEMENT => self.manage(id, frame.data(), now),
            PACKET => self.take_packet(id, frame.data(), now),
            pgn if fast_packet::is_fast(pgn) => self.take_fast(id, frame.data(), now),
            _ => Some(Assembled { message: message(id, frame.data().to_vec()), begun: now }),
        };
        self.counts.messages += u64::from(assembled.is_some());
        assembled
    }

    /// Gives up all that is under way, as when the bus is gone.
    pub fn forget(&mut self) {
        self.open.clear();
        self.transfers.clear();
    }

    /// What has been taken since the beginning.
    #[must_use]
    pub fn counts(&self) -> AssemblerCounts {
        self.counts
    }

    /// Messages under way.
    #[must_use]
    pub fn under_way(&self) -> usize {
        self.open.len() + self.transfers.len()
    }

    fn take_fast(&mut self, id: N2kId, bytes: &[u8], now: Time) -> Option<Assembled> {
        let Some((head, rest)) = bytes.split_first() else {
            self.counts.bad_length += 1;
            return None;
        };
        let (sequence, index) = (head >> 5, head & (MAX_FRAMES - 1));
        let key = |open: &Open| {
            (open.id.pgn, open.id.source, open.id.destination, open.sequence)
                == (id.pgn, id.source, id.destination, sequence)
        };
        let known = self.open.iter().position(key);
        if index == 0 {
            if let Some(at) = known {
                self.open.swap_remove(at);
                self.counts.superseded += 1;
            }
            return self.begin(id, sequence, rest, now);
        }
        let Some(at) = known else {
            self.counts.orphans += 1;
            return None;
        };
        let mut open = self.open.swap_remove(at);
        if now - open.heard > FAST_SILENCE {
            self.counts.stale += 1;
            return None;
        }
        if index != open.next || !open.append(rest) {
            self.counts.gaps += 1;
            return None;
        }
        open.heard = now;
        self.keep_or_finish(open)
    }

    fn begin(&mut self, id: N2kId, sequence: u8, rest: &[u8], now: Time) -> Option<Assembled> {
        let fitting = |(length, rest): (&u8, _)| {
            let length = usize::from(*length);
            (1..=MAX_LENGTH).contains(&length).then_some((length, rest))
        };
        let Some((length, rest)) = rest.split_first().and_then(fitting) else {
            self.counts.bad_length += 1;
            return None;
        };
        let data = Vec::with_capacity(length);
        let mut open = Open { id, sequence, length, next: 0, begun: now, heard: now, data };
        if !open.append(rest) {
            self.counts.gaps += 1;
            return None;
        }
        if self.open.len() >= MAX_OPEN {
            self.make_room(now);
        }
        self.keep_or_finish(open)
    }

    /// Gives up all that are silent for too long, or else the one that is silent for longest.
    fn make_room(&mut self, now: Time) {
        let before = self.open.len();
        self.open.retain(|open| now - open.heard <= FAST_SILENCE);
        self.counts.stale += (before - self.open.len()) as u64;
        let oldest = self.open.iter().enumerate().min_by_key(|(_, open)| open.heard);
        if let Some(at) = oldest.map(|(at, _)| at).filter(|_| self.open.len() == before) {
            self.open.swap_remove(at);
            self.counts.crowded += 1;
        }
    }

    fn keep_or_finish(&mut self, open: Open) -> Option<Assembled> {
        if open.data.len() < open.length {
            self.open.push(open);
            return None;
        }
        Some(Assembled { message: message(open.id, open.data), begun: open.begun })
    }

    fn manage(&mut self, id: N2kId, bytes: &[u8], now: Time) -> Option<Assembled> {
        match Management::read(bytes)? {
            Management::Announce(announced) if id.destination == BROADCAST => {
                self.announce(Transfer::begin(id, announced, now), id, now);
            }
            Management::Request { announced, .. } if id.destination != BROADCAST => {
                self.announce(Transfer::begin(id, announced, now), id, now);
            }
            Management::Clear { .. } => {
                let awaited = self.find(id.destination, id.source);
                if let Some(transfer) = awaited.and_then(|at| self.transfers.get_mut(at)) {
                    transfer.heard = now;
                }
            }
            Management::Abort { .. } => {
                let of_sender = self.find(id.source, id.destination);
                let of_receiver = self.find(id.destination, id.source);
                if let Some(at) = of_sender.or(of_receiver) {
                    self.transfers.swap_remove(at);
                    self.counts.aborted += 1;
                }
            }
            _ => {}
        }
        None
    }

    fn announce(&mut self, transfer: Option<Transfer>, id: N2kId, now: Time) {
        if let Some(at) = self.find(id.source, id.destination) {
            self.transfers.swap_remove(at);
            self.counts.superseded += 1;
        }
        let Some(transfer) = transfer else {
            self.counts.bad_length += 1;
            return;
        };
        let before = self.transfers.len();
        self.transfers.retain(|transfer| now - transfer.heard <= SILENCE);
        self.counts.stale += (before - self.transfers.len()) as u64;
        if self.transfers.len() >= MAX_TRANSFERS {
            self.counts.crowded += 1;
            return;
        }
        self.transfers.push(transfer);
    }

    fn take_packet(&mut self, id: N2kId, bytes: &[u8], now: Time) -> Option<Assembled> {
        let Some(at) = self.find(id.source, id.destination) else {
            self.counts.orphans += 1;
            return None;
        };
        let transfer = self.transfers.get_mut(at)?;
        if now - transfer.heard > SILENCE {
            self.transfers.swap_remove(at);
            self.counts.stale += 1;
            return None;
        }
        match transfer.take(bytes, now) {
            Packet::Last => {
                let transfer = self.transfers.swap_remove(at);
                Some(Assembled { begun: transfer.begun, message: transfer.finish() })
            }
            // The receiver of a transfer asks again for what it missed; nobody does so for all.
            Packet::Gap if id.destination == BROADCAST => {
                self.transfers.swap_remove(at);
                self.counts.gaps += 1;
                None
            }
            Packet::Taken | Packet::Repeated | Packet::Gap => None,
        }
    }

    fn find(&self, source: u8, destination: u8) -> Option<usize> {
        self.transfers.iter().position(|transfer| transfer.is_between(source, destination))
    }
}

impl Open {
    /// Takes the bytes of the next frame; false if they are too few.
    fn append(&mut self, bytes: &[u8]) -> bool {
        let (_, count) = fast_packet::piece(self.next, self.length);
        let Some(bytes) = bytes.get(..count) else { return false };
        self.data.extend_from_slice(bytes);
        self.next += 1;
        true
    }
}

fn message(id: N2kId, data: Vec<u8>) -> BusMessage {
    let N2kId { priority, pgn, source, destination } = id;
    BusMessage { priority, pgn, source, destination, data }
}
