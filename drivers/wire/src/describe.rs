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
    pub read: ReadOutcome,
}

/// What the readers of this crate say of a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ReadOutcome {
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
            Described { name, read: if is_read { ReadOutcome::Used } else { ReadOutcome::Other } }
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

fn described(name: impl Into<String>, read: ReadOutcome) -> Described {
    Described { name: name.into(), read }
}

/// A message of the bus goes by its parameter group.
fn adapter(frame: &[u8]) -> Described {
    match NgtFrame::read(frame) {
        Ok(NgtFrame::Received(message)) => {
            described(format!("PGN {}", message.pgn), ReadOutcome::Used)
        }
        Ok(NgtFrame::Other(command)) => described(format!("NGT {command:02X}"), ReadOutcome::Other),
        Err(_) => described("NGT", ReadOutcome::Refused),
    }
}

/// A delta goes by the first of its paths that is read, and who told it.
fn server_line(frame: &[u8]) -> Described {
    match ServerLine::read(frame) {
        Ok(line @ ServerLine::Delta { .. }) => match line.first() {
            Some((path, source)) => {
                described(format!("SIGNALK {path} {source}"), ReadOutcome::Used)
            }
            None => described("SIGNALK", ReadOutcome::Other),
        },
        Ok(ServerLine::Hello { .. }) => described("SIGNALK hello", ReadOutcome::Used),
        Err(crate::binary::BinaryFault::OtherMessage) => described("SIGNALK", ReadOutcome::Other),
        Err(_) => described("SIGNALK", ReadOutcome::Refused),
    }
}

fn plain<T, E>(name: &str, read: &Result<T, E>) -> Described {
    described(name, if read.is_ok() { ReadOutcome::Used } else { ReadOutcome::Refused })
}

/// A message of a protocol that has others too.
fn or_other<T>(name: &str, read: &Result<T, crate::binary::BinaryFault>) -> Described {
    let other = matches!(read, Err(crate::binary::BinaryFault::OtherMessage));
    if other { described(name, ReadOutcome::Other) } else { plain(name, read) }
}

/// A report of one page goes by whether its records are read; a page of several is used to put it together.
fn gsof(frame: &[u8]) -> Described {
    let Ok(page) = gsof::Page::open(frame) else { return described("GSOF", ReadOutcome::Refused) };
    if page.last > 0 {
        return described("GSOF", ReadOutcome::Used);
    }
    match gsof::GsofReport::read(&page.records) {
        Ok(report) if report.is_read() => described("GSOF", ReadOutcome::Used),
        Ok(_) => described("GSOF", ReadOutcome::Other),
        Err(_) => described("GSOF", ReadOutcome::Refused),
    }
}

fn nmea(frame: &[u8]) -> Described {
    match others::kind(frame) {
        Ok(kind) => {
            let read = match kind.understood {
                Understood::Read(_) => ReadOutcome::Used,
                Understood::Refused(_) | Understood::Odd => ReadOutcome::Refused,
                Understood::Recognised | Understood::Unknown => ReadOutcome::Other,
            };
            described(kind.name, read)
        }
        Err(_) => described("NMEA", ReadOutcome::Refused),
    }
}

fn ubx(frame: &[u8]) -> Described {
    use ubx::UbxMessage;
    let used = |name| described(name, ReadOutcome::Used);
    match UbxMessage::read(frame) {
        Ok(UbxMessage::NavPvt(_)) => used("NAV-PVT"),
        Ok(UbxMessage::NavDop(_)) => used("NAV-DOP"),
        Ok(UbxMessage::NavCov(_)) => used("NAV-COV"),
        Ok(UbxMessage::NavHpPosLlh(_)) => used("NAV-HPPOSLLH"),
        Ok(UbxMessage::NavPosLlh(_)) => used("NAV-POSLLH"),
        Ok(UbxMessage::NavVelNed(_)) => used("NAV-VELNED"),
        Ok(UbxMessage::NavSol(_)) => used("NAV-SOL"),
        Ok(UbxMessage::NavStatus(_)) => used("NAV-STATUS"),
        Ok(UbxMessage::NavTimeUtc(_)) => used("NAV-TIMEUTC"),
        Ok(UbxMessage::NavRelPosNed(_)) => used("NAV-RELPOSNED"),
        Ok(UbxMessage::NavTimeGps(_)) => used("NAV-TIMEGPS"),
        Ok(UbxMessage::NavTimeLs(_)) => used("NAV-TIMELS"),
        Ok(UbxMessage::TimTp(_)) => used("TIM-TP"),
        Ok(UbxMessage::RxmRawx(_)) => used("RXM-RAWX"),
        Ok(UbxMessage::RxmSfrbx(_)) => used("RXM-SFRBX"),
        Ok(UbxMessage::Other { class, id }) => {
            described(format!("UBX {class:02X}-{id:02X}"), ReadOutcome::Other)
        }
        Err(_) => described("UBX", ReadOutcome::Refused),
    }
}

fn sbf(frame: &[u8]) -> Described {
    let name = match sbf::Frame::open(frame) {
        Ok(open) => format!("SBF {}", open.id),
        Err(_) => "SBF".to_owned(),
    };
    match sbf::SbfMessage::read(frame) {
        Ok(sbf::SbfMessage::Other { .. }) => described(name, ReadOutcome::Other),
        Ok(_) => described(name, ReadOutcome::Used),
        Err(_) => described(name, ReadOutcome::Refused),
    }
}

fn sbg(frame: &[u8]) -> Described {
    use sbg::SbgMessage;
    match SbgMessage::read(frame) {
        Ok(SbgMessage::ImuShort(_)) => described("IMU_SHORT", ReadOutcome::Used),
        Ok(SbgMessage::ImuData(_)) => described("IMU_DATA", ReadOutcome::Used),
        Ok(SbgMessage::Time(_)) => described("UTC_TIME", ReadOutcome::Used),
        Ok(SbgMessage::Euler(_)) => described("EKF_EULER", ReadOutcome::Other),
        Ok(SbgMessage::Other { class, id }) => {
            described(format!("SBG {class:02X}-{id:02X}"), ReadOutcome::Other)
        }
        Err(_) => described("SBG", ReadOutcome::Refused),
    }
}

fn mip(frame: &[u8]) -> Described {
    let set = frame.get(2).copied().unwrap_or_default();
    match mip::Packet::read(frame) {
        Ok(_) => described("MIP 80", ReadOutcome::Used),
        Err(crate::binary::BinaryFault::OtherMessage) => {
            described(format!("MIP {set:02X}"), ReadOutcome::Other)
        }
        Err(_) => described(format!("MIP {set:02X}"), ReadOutcome::Refused),
    }
}

fn xbus(frame: &[u8]) -> Described {
    let id = frame.get(2).copied().unwrap_or_default();
    match xbus::MtData2::read(frame) {
        Ok(_) => described("MTData2", ReadOutcome::Used),
        Err(crate::binary::BinaryFault::OtherMessage) => {
            described(format!("Xbus {id:02X}"), ReadOutcome::Other)
        }
        Err(_) => described(format!("Xbus {id:02X}"), ReadOutcome::Refused),
    }
}

fn stim(frame: &[u8]) -> Described {
    if stim::StimConfiguration::read(frame).is_ok() {
        return described("STIM configuration", ReadOutcome::Used);
    }
    let id = frame.first().copied().unwrap_or_default();
    match stim::StimDatagram::read(frame) {
        Ok(_) => described(format!("STIM {id:02X}"), ReadOutcome::Used),
        Err(crate::binary::BinaryFault::OtherMessage) => {
            described(format!("STIM {id:02X}"), ReadOutcome::Other)
        }
        Err(_) => described(format!("STIM {id:02X}"), ReadOutcome::Refused),
    }
}

fn novatel(frame: &[u8]) -> Described {
    match novatel::OemLog::read(frame) {
        Ok(log) => match log.name() {
            Some(name) => described(name, ReadOutcome::Used),
            None => described(format!("NovAtel {}", log.header.id), ReadOutcome::Other),
        },
        Err(_) => described("NovAtel", ReadOutcome::Refused),
    }
}

fn pd6(frame: &[u8]) -> Described {
    let name = frame.get(1..3).and_then(|name| std::str::from_utf8(name).ok()).unwrap_or("");
    match pd6::Pd6::read(frame) {
        Ok(pd6::Pd6::Other(_)) => described(format!("PD6 :{name}"), ReadOutcome::Other),
        Ok(_) => described(format!("PD6 :{name}"), ReadOutcome::Used),
        Err(_) => described(format!("PD6 :{name}"), ReadOutcome::Refused),
    }
}
