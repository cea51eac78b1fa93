//! What a frame is called, for whoever looks at a port.

use crate::gnss::{gsof, novatel, rtcm, sbf, ubx};
use crate::imu::{kvh, mip, sbg, stdbin, stim, vectornav, xbus};
use crate::log::{ad2cp, pd0, pd6};
use crate::motion::{em, kmb, tss1};
use crate::ngt1::NgtFrame;
use crate::nmea::others::{self, Understood};
use crate::signalk::ServerLine;
use crate::stream::Protocol;

/// A frame's name and what became of it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Described {
    /// The message: `HETHS`, `NAV-PVT`, `SBF 4007`, `IMU_SHORT`.
    pub name: String,
    /// What the readers of this crate say of it.
    pub read: Reading,
}

/// What the readers of this crate say of a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Reading {
    /// It is read, and its contents are used.
    Used,
    /// It is a good frame of a message that is not used.
    Other,
    /// Its contents are not what its format says.
    Refused,
}

/// Reads a frame of a protocol with its reader.
#[must_use]
pub fn describe(protocol: Protocol, frame: &[u8]) -> Described {
    match protocol {
        Protocol::Nmea => nmea(frame),
        Protocol::Ubx => ubx(frame),
        Protocol::Sbf => sbf(frame),
        Protocol::Rtcm => {
            let number = rtcm::Frame::open(frame).ok().and_then(|frame| frame.number());
            let name = number.map_or("RTCM".to_owned(), |number| format!("RTCM {number}"));
            let is_read = number.is_some_and(rtcm::is_of_satellites);
            Described { name, read: if is_read { Reading::Used } else { Reading::Other } }
        }
        Protocol::Sbg => sbg(frame),
        Protocol::StdBin => plain("StdBin", &stdbin::Telegram::read(frame)),
        Protocol::Mip => mip(frame),
        Protocol::Xbus => xbus(frame),
        Protocol::Kvh => plain("KVH", &kvh::KvhMessage::read(frame)),
        Protocol::Stim => stim(frame),
        Protocol::Pd0 => plain("PD0", &pd0::Ensemble::read(frame)),
        Protocol::Pd6 => pd6(frame),
        Protocol::Novatel => novatel(frame),
        Protocol::Kmb => plain("KMB", &kmb::Kmb::read(frame)),
        Protocol::Em3000 => plain("EM3000", &em::EmAttitude::read(frame)),
        Protocol::Tss1 => plain("TSS1", &tss1::Tss1::read(frame)),
        Protocol::Ngt1 => adapter(frame),
        Protocol::Gsof => gsof(frame),
        Protocol::VectorNav => or_other("VectorNav", &vectornav::VnMessage::read(frame)),
        Protocol::Ad2cp => {
            let id = frame.get(2).copied().unwrap_or_default();
            or_other(&format!("AD2CP {id:02X}"), &ad2cp::Ad2cpBottomTrack::read(frame))
        }
        Protocol::SignalK => server_line(frame),
    }
}

fn described(name: impl Into<String>, read: Reading) -> Described {
    Described { name: name.into(), read }
}

/// A message of the bus goes by its parameter group.
fn adapter(frame: &[u8]) -> Described {
    match NgtFrame::read(frame) {
        Ok(NgtFrame::Received(message)) => described(format!("PGN {}", message.pgn), Reading::Used),
        Ok(NgtFrame::Other(command)) => described(format!("NGT {command:02X}"), Reading::Other),
        Err(_) => described("NGT", Reading::Refused),
    }
}

/// A delta goes by the first of its paths that is read, and who told it.
fn server_line(frame: &[u8]) -> Described {
    match ServerLine::read(frame) {
        Ok(line @ ServerLine::Delta { .. }) => match line.first() {
            Some((path, source)) => described(format!("SIGNALK {path} {source}"), Reading::Used),
            None => described("SIGNALK", Reading::Other),
        },
        Ok(ServerLine::Hello { .. }) => described("SIGNALK hello", Reading::Used),
        Err(crate::binary::Fault::OtherMessage) => described("SIGNALK", Reading::Other),
        Err(_) => described("SIGNALK", Reading::Refused),
    }
}

fn plain<T, E>(name: &str, read: &Result<T, E>) -> Described {
    described(name, if read.is_ok() { Reading::Used } else { Reading::Refused })
}

/// A message of a protocol that has others too.
fn or_other<T>(name: &str, read: &Result<T, crate::binary::Fault>) -> Described {
    let other = matches!(read, Err(crate::binary::Fault::OtherMessage));
    if other { described(name, Reading::Other) } else { plain(name, read) }
}

/// A report of one page goes by whether its records are read; a page of several is used to put it together.
fn gsof(frame: &[u8]) -> Described {
    let Ok(page) = gsof::Page::open(frame) else { return described("GSOF", Reading::Refused) };
    if page.last > 0 {
        return described("GSOF", Reading::Used);
    }
    match gsof::GsofReport::read(&page.records) {
        Ok(report) if report.is_read() => described("GSOF", Reading::Used),
        Ok(_) => described("GSOF", Reading::Other),
        Err(_) => described("GSOF", Reading::Refused),
    }
}

fn nmea(frame: &[u8]) -> Described {
    match others::kind(frame) {
        Ok(kind) => {
            let read = match kind.understood {
                Understood::Read(_) => Reading::Used,
                Understood::Refused(_) | Understood::Odd => Reading::Refused,
                Understood::Recognised | Understood::Unknown => Reading::Other,
            };
            described(kind.name, read)
        }
        Err(_) => described("NMEA", Reading::Refused),
    }
}

fn ubx(frame: &[u8]) -> Described {
    use ubx::Message;
    let used = |name| described(name, Reading::Used);
    match Message::read(frame) {
        Ok(Message::NavPvt(_)) => used("NAV-PVT"),
        Ok(Message::NavDop(_)) => used("NAV-DOP"),
        Ok(Message::NavCov(_)) => used("NAV-COV"),
        Ok(Message::NavHpPosLlh(_)) => used("NAV-HPPOSLLH"),
        Ok(Message::NavPosLlh(_)) => used("NAV-POSLLH"),
        Ok(Message::NavVelNed(_)) => used("NAV-VELNED"),
        Ok(Message::NavSol(_)) => used("NAV-SOL"),
        Ok(Message::NavStatus(_)) => used("NAV-STATUS"),
        Ok(Message::NavTimeUtc(_)) => used("NAV-TIMEUTC"),
        Ok(Message::NavRelPosNed(_)) => used("NAV-RELPOSNED"),
        Ok(Message::NavTimeGps(_)) => used("NAV-TIMEGPS"),
        Ok(Message::NavTimeLs(_)) => used("NAV-TIMELS"),
        Ok(Message::TimTp(_)) => used("TIM-TP"),
        Ok(Message::RxmRawx(_)) => used("RXM-RAWX"),
        Ok(Message::RxmSfrbx(_)) => used("RXM-SFRBX"),
        Ok(Message::Other { class, id }) => {
            described(format!("UBX {class:02X}-{id:02X}"), Reading::Other)
        }
        Err(_) => described("UBX", Reading::Refused),
    }
}

fn sbf(frame: &[u8]) -> Described {
    let name = match sbf::Frame::open(frame) {
        Ok(open) => format!("SBF {}", open.id),
        Err(_) => "SBF".to_owned(),
    };
    match sbf::Message::read(frame) {
        Ok(sbf::Message::Other { .. }) => described(name, Reading::Other),
        Ok(_) => described(name, Reading::Used),
        Err(_) => described(name, Reading::Refused),
    }
}

fn sbg(frame: &[u8]) -> Described {
    use sbg::Message;
    match Message::read(frame) {
        Ok(Message::ImuShort(_)) => described("IMU_SHORT", Reading::Used),
        Ok(Message::ImuData(_)) => described("IMU_DATA", Reading::Used),
        Ok(Message::Time(_)) => described("UTC_TIME", Reading::Used),
        Ok(Message::Euler(_)) => described("EKF_EULER", Reading::Other),
        Ok(Message::Other { class, id }) => {
            described(format!("SBG {class:02X}-{id:02X}"), Reading::Other)
        }
        Err(_) => described("SBG", Reading::Refused),
    }
}

fn mip(frame: &[u8]) -> Described {
    let set = frame.get(2).copied().unwrap_or_default();
    match mip::Packet::read(frame) {
        Ok(_) => described("MIP 80", Reading::Used),
        Err(crate::binary::Fault::OtherMessage) => {
            described(format!("MIP {set:02X}"), Reading::Other)
        }
        Err(_) => described(format!("MIP {set:02X}"), Reading::Refused),
    }
}

fn xbus(frame: &[u8]) -> Described {
    let id = frame.get(2).copied().unwrap_or_default();
    match xbus::MtData2::read(frame) {
        Ok(_) => described("MTData2", Reading::Used),
        Err(crate::binary::Fault::OtherMessage) => {
            described(format!("Xbus {id:02X}"), Reading::Other)
        }
        Err(_) => described(format!("Xbus {id:02X}"), Reading::Refused),
    }
}

fn stim(frame: &[u8]) -> Described {
    if stim::StimConfiguration::read(frame).is_ok() {
        return described("STIM configuration", Reading::Used);
    }
    let id = frame.first().copied().unwrap_or_default();
    match stim::StimDatagram::read(frame) {
        Ok(_) => described(format!("STIM {id:02X}"), Reading::Used),
        Err(crate::binary::Fault::OtherMessage) => {
            described(format!("STIM {id:02X}"), Reading::Other)
        }
        Err(_) => described(format!("STIM {id:02X}"), Reading::Refused),
    }
}

fn novatel(frame: &[u8]) -> Described {
    match novatel::OemLog::read(frame) {
        Ok(log) => match log.name() {
            Some(name) => described(name, Reading::Used),
            None => described(format!("NovAtel {}", log.header.id), Reading::Other),
        },
        Err(_) => described("NovAtel", Reading::Refused),
    }
}

fn pd6(frame: &[u8]) -> Described {
    let name = frame.get(1..3).and_then(|name| std::str::from_utf8(name).ok()).unwrap_or("");
    match pd6::Pd6::read(frame) {
        Ok(pd6::Pd6::Other(_)) => described(format!("PD6 :{name}"), Reading::Other),
        Ok(_) => described(format!("PD6 :{name}"), Reading::Used),
        Err(_) => described(format!("PD6 :{name}"), Reading::Refused),
    }
}
