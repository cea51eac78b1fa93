//! Files in which gateways and loggers of NMEA 2000 have written: which one it was, what to do with it.

use std::collections::BTreeMap;

use insd_base::CanFrame;
use insd_n2k::fast_packet::{Sequences, is_fast, split};
use insd_n2k::text::{actisense, canboat, ydwg};
use insd_n2k::{BusMessage, N2kId};

/// Lines of a file that are looked at to find out what it is.
const LINES: usize = 200;
/// Share of the lines that must be of a format.
const MOST: f64 = 0.5;
/// Bytes of a frame.
const FRAME: usize = 8;

/// What has written a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BusFile {
    /// A gateway of Yacht Devices, as text ("RAW"): a frame in each line.
    Ydwg,
    /// A gateway of Actisense, as text ("N2K ASCII"): a message in each line.
    Actisense,
    /// A program of canboat, a frame in each line ("PLAIN").
    CanboatPlain,
    /// A program of canboat, a message in each line ("FAST").
    CanboatFast,
    /// An iKonvert of Digital Yacht.
    IKonvert,
    /// NMEA Reader or EBL Reader of Actisense: a binary log.
    Ebl,
    /// An NGT-1 of Actisense: the bytes of its serial line.
    Ngt1,
    /// A voyage recorder of Yacht Devices.
    Ydvr,
}

impl BusFile {
    /// What has written a file that begins like this, if it is one of these.
    #[must_use]
    pub fn recognise(head: &[u8]) -> Option<Self> {
        binary(head).or_else(|| text(head))
    }

    /// What it is, and how to use it, in words.
    #[must_use]
    pub fn advice(self) -> &'static str {
        match self {
            BusFile::Ydwg => {
                "frames as text of a Yacht Devices gateway (YDWG RAW). On board insd reads the gateway \
                 itself (gateway-tcp or gateway-udp, format ydwg); this file is played to the port \
                 below by `nc -l -p 2597 < FILE`"
            }
            BusFile::Actisense => {
                "messages as text of an Actisense gateway (N2K ASCII). On board insd reads the gateway \
                 itself (gateway-tcp or gateway-udp, format actisense); this file is played to the \
                 port below by `nc -l -p 2597 < FILE`"
            }
            BusFile::CanboatPlain => {
                "frames as text of canboat (PLAIN), with fast packets in pieces. This file is played \
                 to the port below by `nc -l -p 2597 < FILE`"
            }
            BusFile::CanboatFast => {
                "messages as text of canboat (FAST). This file is played to the port below by \
                 `nc -l -p 2597 < FILE`"
            }
            BusFile::IKonvert => {
                "lines of a Digital Yacht iKonvert (!PDGY). insd does not read them: let `ikonvert-serial` \
                 of canboat make canboat lines of them, which insd does"
            }
            BusFile::Ebl => {
                "a binary log of Actisense (EBL). insd does not read it: let `actisense-serial -r` of \
                 canboat, or EBL Reader of Actisense, make text of it"
            }
            BusFile::Ngt1 => {
                "the bytes of an Actisense NGT-1. insd does not read them: let `actisense-serial -r` of \
                 canboat make canboat lines of them, which insd does"
            }
            BusFile::Ydvr => {
                "a log of a Yacht Devices voyage recorder (YDVR, DAT). insd does not read it: let YDVR \
                 Converter of Yacht Devices make a CAN log of it"
            }
        }
    }

    /// The transport of a port that reads such lines where they come live, TOML.
    #[must_use]
    pub fn transport(self) -> Option<&'static str> {
        Some(match self {
            BusFile::Ydwg => {
                "{ kind = \"gateway-tcp\", address = \"127.0.0.1:2597\", format = \"ydwg\" }"
            }
            BusFile::Actisense => {
                "{ kind = \"gateway-tcp\", address = \"127.0.0.1:2597\", format = \"actisense\" }"
            }
            BusFile::CanboatPlain => {
                "{ kind = \"gateway-tcp\", address = \"127.0.0.1:2597\", format = \"canboat-plain\" }"
            }
            BusFile::CanboatFast => {
                "{ kind = \"gateway-tcp\", address = \"127.0.0.1:2597\", format = \"canboat-fast\" }"
            }
            BusFile::IKonvert | BusFile::Ebl | BusFile::Ngt1 | BusFile::Ydvr => return None,
        })
    }
}

fn binary(head: &[u8]) -> Option<BusFile> {
    let holds = |piece: &[u8]| head.windows(piece.len()).any(|own| own == piece);
    // escape, start of a record, and its end; DLE STX and what was received or sent, and DLE ETX
    let ngt1 = (holds(&[0x10, 2, 0x93]) || holds(&[0x10, 2, 0x94])) && holds(&[0x10, 3]);
    if head.starts_with(&[0x1B, 1]) && holds(&[0x1B, 0x0A]) {
        Some(BusFile::Ebl)
    } else if head.get(..64).unwrap_or(head).windows(6).any(|own| own == b"YDVR v") {
        Some(BusFile::Ydvr)
    } else {
        ngt1.then_some(BusFile::Ngt1)
    }
}

fn text(head: &[u8]) -> Option<BusFile> {
    let whole = head.iter().rposition(|byte| *byte == b'\n').unwrap_or(head.len());
    let lines = head.get(..whole).unwrap_or(head).split(|byte| *byte == b'\n');
    let lines = lines.map(<[u8]>::trim_ascii).filter(|line| !line.is_empty() && line[0] != b'#');
    let lines: Vec<&[u8]> = lines.take(LINES).collect();
    let mostly = |is: &dyn Fn(&[u8]) -> bool| {
        let count = lines.iter().filter(|line| is(line)).count();
        count > 0 && count as f64 >= MOST * lines.len() as f64
    };
    if mostly(&|line| line.starts_with(b"!PDGY,")) {
        Some(BusFile::IKonvert)
    } else if mostly(&|line| ydwg::parse(line).is_some()) {
        Some(BusFile::Ydwg)
    } else if mostly(&|line| actisense::parse(line).is_some()) {
        Some(BusFile::Actisense)
    } else if mostly(&|line| canboat::parse(line).is_some()) {
        let messages: Vec<BusMessage> =
            lines.iter().filter_map(|line| canboat::parse(line)).collect();
        Some(canboat_of(&messages))
    } else {
        None
    }
}

/// Of canboat's two formats the one in which fast packets are whole: some are longer than a frame, or
/// none is as long as one.
fn canboat_of(messages: &[BusMessage]) -> BusFile {
    let mut fast = messages.iter().filter(|message| is_fast(message.pgn));
    let long = messages.iter().any(|message| message.data.len() > FRAME);
    let whole = fast.clone().next().is_some() && fast.all(|message| message.data.len() != FRAME);
    if long || whole { BusFile::CanboatFast } else { BusFile::CanboatPlain }
}

/// The frames of a file's lines.
#[derive(Debug)]
pub struct Frames {
    format: BusFile,
    /// Counters of the fast packets that whole messages are made of again, for each sender.
    sequences: BTreeMap<u8, Sequences>,
}

impl Frames {
    /// Frames of a format; `None` if it is one that is not read.
    #[must_use]
    pub fn of(format: BusFile) -> Option<Self> {
        format.transport().map(|_| Frames { format, sequences: BTreeMap::new() })
    }

    /// The frames of a line, as its sender has most likely sent them.
    pub fn of_line(&mut self, line: &[u8]) -> Vec<CanFrame> {
        match self.format {
            BusFile::Ydwg => ydwg::parse(line).map(|line| line.frame).into_iter().collect(),
            BusFile::CanboatPlain => canboat::parse_frame(line).into_iter().collect(),
            BusFile::Actisense => self.split(actisense::parse(line)),
            _ => self.split(canboat::parse(line)),
        }
    }

    fn split(&mut self, message: Option<BusMessage>) -> Vec<CanFrame> {
        let Some(BusMessage { priority, pgn, source, destination, data }) = message else {
            return Vec::new();
        };
        let sequence = self.sequences.entry(source).or_default().next(pgn);
        split(N2kId { priority, pgn, source, destination }, &data, sequence).unwrap_or_default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_gateway_is_known_by_what_it_has_written() {
        // lines and bytes of the samples of canboat and canboatjs (Apache-2.0)
        let plain = b"2016-02-28T19:57:02.364Z,2,127250,7,255,8,ff,10,3b,ff,7f,ce,f5,fc\n\
            2016-02-28T19:57:02.400Z,3,129029,7,255,8,00,2b,ff,10,3b,ff,7f,ce\n";
        let fast = b"# format=FAST\n2014-08-15T19:00:00.042Z,3,129029,160,255,43,87,a9,3f,fc,ed,c4,28,\
            00,58,67,11,cf,db,49,08,00,f4,15,47,c4,d2,6e,03,80,66,23,00,00,00,00,00,10,fc,0a,50,00,\
            ff,7f,ff,ff,ff,7f,00\n2014-08-15T19:00:00.048Z,2,128259,115,255,8,00,4e,01,ff,ff,00,ff,ff\n";
        let cases: [(&[u8], BusFile); 8] = [
            (b"00:29:58.617 R 0DFF180D A2 8C 50 C0 FF FF FF FF\r\n", BusFile::Ydwg),
            (b"A000057.055 09FF7 0FF00 3F9FDCFFFFFFFFFF\n", BusFile::Actisense),
            (plain, BusFile::CanboatPlain),
            (fast, BusFile::CanboatFast),
            (b"!PDGY,126992,3,4,255,481.711,BfANRoBVlyM\n!PDGY,000000,0,0,2,28830,0,0\n", BusFile::IKonvert),
            (b"\x1B\x01\x03\xAD\x59\x96\x2C\xAF\xB2\xDB\x01\x1B\x0A\x1B\x01\x01\xEA\x03\0\0\x1B\x0A", BusFile::Ebl),
            (b"\x10\x02\x93\x13\x02\x00\xF2\x01\xFF\x4B\x2E\xC1\x15\x00\x08\0\0\0\0\0\xD0\xFF\xFF\x41\x10\x03", BusFile::Ngt1),
            (b"\x12\x4A\xFF\xFF\xFF\xFFYDVR v04\x12\x4A\x05\x0D\xF1\x09", BusFile::Ydvr),
        ];
        for (head, format) in cases {
            assert_eq!(BusFile::recognise(head), Some(format), "{}", String::from_utf8_lossy(head));
            assert!(!format.advice().is_empty());
        }
        for head in [&b"$HETHS,316.70,E*1A\r\n"[..], b"", b"\xB5\x62\x01\x07", b"1,2,3\n4,5,6\n"] {
            assert_eq!(BusFile::recognise(head), None);
        }
    }

    #[test]
    fn whole_messages_become_the_frames_of_a_bus() {
        let line =
            b"2014-08-15T19:00:00.042Z,3,129029,160,255,43,87,a9,3f,fc,ed,c4,28,00,58,67,11,cf,\
            db,49,08,00,f4,15,47,c4,d2,6e,03,80,66,23,00,00,00,00,00,10,fc,0a,50,00,ff,7f,ff,ff,ff,\
            7f,00";
        assert_eq!(Frames::of(BusFile::CanboatFast).unwrap().of_line(line).len(), 7);
        assert!(Frames::of(BusFile::Ebl).is_none());
    }
}
