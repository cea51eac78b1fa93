//! Lines of text as frames, and frames as lines: what all buses have in common that speak text.

use std::collections::{BTreeMap, VecDeque};

use insd_base::{CanFrame, Stamp};
use insd_n2k::fast_packet::{Sequences, split};
use insd_n2k::text::{actisense, canboat, candump, slcan, ydwg};
use insd_n2k::{Assembler, BusMessage, N2kId};

use super::config::GatewayFormat;

/// Longest line that is read, bytes: the longest message in the wordiest format has 800.
const LONGEST: usize = 1024;

/// The interface that lines of a log name when we write them.
const INTERFACE: &str = "can0";

/// Who speaks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Tongue {
    /// An adapter at a serial line.
    Slcan,
    /// A gateway.
    Gateway(GatewayFormat),
    /// A log, in which frames count that the logging computer has sent, too.
    Log,
}

/// Puts lines together and reads them.
#[derive(Debug)]
pub(super) struct Words {
    tongue: Tongue,
    line: Vec<u8>,
    /// The line is too long: all up to its end is left out.
    skipping: bool,
    /// Frames that were read and not taken yet.
    frames: VecDeque<CanFrame>,
    /// Counters of the fast packets that whole messages are made of again, for each sender.
    sequences: BTreeMap<u8, Sequences>,
    /// Puts together what is sent where only whole messages are.
    sent: Assembler,
}

impl Words {
    pub(super) fn new(tongue: Tongue) -> Self {
        Words {
            tongue,
            line: Vec::new(),
            skipping: false,
            frames: VecDeque::new(),
            sequences: BTreeMap::new(),
            sent: Assembler::new(),
        }
    }

    /// Takes what was read, the end of a line wherever it is.
    pub(super) fn take(&mut self, bytes: &[u8]) {
        for byte in bytes {
            match *byte {
                b'\n' | slcan::END | slcan::BELL => self.end(),
                _ if self.line.len() < LONGEST => self.line.push(*byte),
                _ => self.skipping = true,
            }
        }
    }

    /// The line is at its end: also at that of a datagram or a log.
    pub(super) fn end(&mut self) {
        if !std::mem::take(&mut self.skipping) {
            let frames = match self.message() {
                Some(message) => self.frames_of(&message),
                None => self.frame().into_iter().collect(),
            };
            self.frames.extend(frames);
        }
        self.line.clear();
    }

    /// The next frame that was read.
    pub(super) fn next(&mut self) -> Option<CanFrame> {
        self.frames.pop_front()
    }

    /// Whether frames wait to be taken.
    pub(super) fn has_more(&self) -> bool {
        !self.frames.is_empty()
    }

    fn frame(&self) -> Option<CanFrame> {
        let line = &self.line;
        match self.tongue {
            Tongue::Slcan => slcan::parse(line),
            Tongue::Log => candump::parse(line).map(|line| line.frame),
            Tongue::Gateway(GatewayFormat::Candump) => {
                candump::parse(line).filter(|line| !line.sent).map(|line| line.frame)
            }
            Tongue::Gateway(GatewayFormat::Ydwg) => {
                ydwg::parse(line).filter(|line| !line.sent).map(|line| line.frame)
            }
            Tongue::Gateway(GatewayFormat::CanboatPlain) => canboat::parse_frame(line),
            Tongue::Gateway(GatewayFormat::Actisense | GatewayFormat::CanboatFast) => None,
        }
    }

    /// The message of a line that holds a whole one.
    fn message(&self) -> Option<BusMessage> {
        match self.tongue {
            Tongue::Gateway(GatewayFormat::Actisense) => actisense::parse(&self.line),
            Tongue::Gateway(GatewayFormat::CanboatFast) => canboat::parse(&self.line),
            _ => None,
        }
    }

    /// The frames of a message as its sender has most likely sent them; none of what a fast packet cannot
    /// carry.
    fn frames_of(&mut self, message: &BusMessage) -> Vec<CanFrame> {
        let BusMessage { priority, pgn, source, destination, ref data } = *message;
        let sequence = self.sequences.entry(source).or_default().next(pgn);
        split(N2kId { priority, pgn, source, destination }, data, sequence).unwrap_or_default()
    }

    /// The line by which a frame is sent, if the other end can send such a frame; of a whole message it
    /// is the last one that is.
    pub(super) fn write(&mut self, frame: &CanFrame, now: Stamp) -> Option<String> {
        let Tongue::Gateway(format) = self.tongue else {
            return (self.tongue == Tongue::Slcan).then(|| slcan::write(frame));
        };
        let mut whole = || self.sent.take(frame, now.monotonic).map(|whole| whole.message);
        match format {
            GatewayFormat::Candump => Some(candump::write(now.system, INTERFACE, frame)),
            GatewayFormat::Ydwg => ydwg::write(frame),
            GatewayFormat::Actisense => whole().map(|message| actisense::write(&message)),
            GatewayFormat::CanboatFast => {
                whole().map(|message| canboat::write(now.system, &message))
            }
            GatewayFormat::CanboatPlain => canboat::write_frame(now.system, frame),
        }
    }
}
