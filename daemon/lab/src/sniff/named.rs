//! What a frame is called on the wire, who sent it, and why it is refused.

use insd_wire::describe::{ReadOutcome, describe};
use insd_wire::gnss::{gsof, novatel, sbf, ubx};
use insd_wire::imu::{kvh, mip, sbg, stdbin, stim, vectornav, xbus};
use insd_wire::log::{ad2cp, pd0, pd6};
use insd_wire::motion::{em, kmb, tss1};
use insd_wire::ngt1::NgtFrame;
use insd_wire::nmea::others::{self, Understood};
use insd_wire::nmea::{ChecksumPolicy, Frame, Pinsd, Sentence, Talker};
use insd_wire::signalk::ServerLine;
use insd_wire::stream::Protocol;

use super::report::LogAxes;

/// Longest name of a message that is kept, bytes.
const LONGEST: usize = 24;

/// Name of lines that have neither a checksum nor a known form.
pub(super) const UNNAMED: &str = "NMEA";

/// What is known of a frame.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Named<'a> {
    pub(super) name: String,
    pub(super) read: ReadOutcome,
    /// Why it is refused, or what was left out of it.
    pub(super) reason: Option<String>,
    /// It would be read if lines without a checksum were taken.
    pub(super) bare: bool,
    /// Axes of a Doppler log's velocities.
    pub(super) axes: Option<LogAxes>,
    pub(super) talker: Option<Talker>,
    /// Whom a TAG block names.
    pub(super) source: Option<&'a str>,
}

/// Names a frame.
pub(super) fn named(protocol: Protocol, frame: &[u8]) -> Named<'_> {
    if protocol == Protocol::Nmea {
        return sentence(frame);
    }
    let described = describe(protocol, frame);
    let reason = (described.read == ReadOutcome::Refused)
        .then(|| fault(protocol, frame).unwrap_or_else(|| "not what its format says".to_owned()));
    let axes = (protocol == Protocol::Pd0).then(|| axes(frame)).flatten();
    let (talker, source) = (None, None);
    Named { name: described.name, read: described.read, reason, bare: false, axes, talker, source }
}

/// Axes of an ensemble's velocities.
fn axes(frame: &[u8]) -> Option<LogAxes> {
    let fixed = pd0::Ensemble::read(frame).ok()?.fixed;
    Some(LogAxes {
        frame: match fixed.transformation.coordinates {
            pd0::Coordinates::Beam => "beam",
            pd0::Coordinates::Instrument => "instrument",
            pd0::Coordinates::Ship => "ship",
            pd0::Coordinates::Earth => "earth",
        },
        up: fixed.geometry.is_some_and(|geometry| geometry.up),
        alignment_deg: (fixed.heading_alignment.to_degrees() * 100.0).round() / 100.0,
    })
}

/// Whether a frame proves that its protocol is spoken. A line without a checksum does not: there is
/// one in any noise.
pub fn is_proof(protocol: Protocol, frame: &[u8]) -> bool {
    match protocol {
        Protocol::Nmea => Frame::parse(frame).is_ok(),
        _ => describe(protocol, frame).read != ReadOutcome::Refused,
    }
}

/// A sentence goes by its whole address, as two receivers on one line differ in the talker only.
fn sentence(line: &[u8]) -> Named<'_> {
    let (read, reason) = match others::kind(line) {
        Ok(kind) => match kind.understood {
            Understood::Read(left_out) => {
                (ReadOutcome::Used, left_out.first.map(|fault| format!("{fault}, and left out")))
            }
            Understood::Refused(fault) => (ReadOutcome::Refused, Some(fault.to_string())),
            // of a sentence that nobody needs an odd form harms nobody
            Understood::Odd | Understood::Recognised | Understood::Unknown => {
                (ReadOutcome::Other, None)
            }
        },
        Err(fault) => (ReadOutcome::Refused, Some(fault.to_string())),
    };
    let frame = Frame::parse_with(line, ChecksumPolicy::Optional).ok();
    let frame = frame.as_ref();
    let talker = frame.and_then(Frame::talker);
    // what has neither a checksum nor a known form may be anything
    let is_sound = talker.is_some() || read != ReadOutcome::Refused;
    let address = frame.filter(|_| is_sound).map_or(UNNAMED.to_owned(), address);
    let reads =
        |frame: &&Frame<'_>| matches!(others::kind_of(line, frame).understood, Understood::Read(_));
    Named {
        name: address.chars().take(LONGEST).collect(),
        read,
        reason,
        bare: read == ReadOutcome::Refused && frame.filter(reads).is_some(),
        axes: None,
        talker,
        source: frame.and_then(Frame::tag).and_then(|tag| tag.source),
    }
}

/// The parts of PINSD are of different sensors: one goes by `PINSD,TRK`.
fn address(frame: &Frame<'_>) -> String {
    let part = |part: &str| format!("{},{part}", frame.address());
    match Sentence::read_frame(frame) {
        Ok(Sentence::Pinsd(Pinsd::Tracks(_))) => part("TRK"),
        Ok(Sentence::Pinsd(Pinsd::Step(_))) => part("VO"),
        _ => frame.address().to_owned(),
    }
}

/// What its reader says of a frame that it refuses.
fn fault(protocol: Protocol, frame: &[u8]) -> Option<String> {
    fn told<T, E: std::fmt::Display>(read: Result<T, E>) -> Option<String> {
        read.err().map(|fault| fault.to_string())
    }
    match protocol {
        Protocol::Nmea | Protocol::Rtcm => None,
        Protocol::Ubx => told(ubx::UbxMessage::read(frame)),
        Protocol::Sbf => told(sbf::SbfMessage::read(frame)),
        Protocol::Sbg => told(sbg::SbgMessage::read(frame)),
        Protocol::StdBin => told(stdbin::Telegram::read(frame)),
        Protocol::Mip => told(mip::Packet::read(frame)),
        Protocol::Xbus => told(xbus::MtData2::read(frame)),
        Protocol::Kvh => told(kvh::KvhMessage::read(frame)),
        Protocol::Stim => told(stim::StimDatagram::read(frame)),
        Protocol::Pd0 => told(pd0::Ensemble::read(frame)),
        Protocol::Pd6 => told(pd6::Pd6::read(frame)),
        Protocol::Novatel => told(novatel::OemLog::read(frame)),
        Protocol::Kmb => told(kmb::Kmb::read(frame)),
        Protocol::Em3000 => told(em::EmAttitude::read(frame)),
        Protocol::Tss1 => told(tss1::Tss1::read(frame)),
        Protocol::Ngt1 => told(NgtFrame::read(frame)),
        Protocol::Gsof => {
            told(gsof::Page::open(frame).and_then(|page| gsof::GsofReport::read(&page.records)))
        }
        Protocol::VectorNav => told(vectornav::VnMessage::read(frame)),
        Protocol::Ad2cp => told(ad2cp::Ad2cpBottomTrack::read(frame)),
        Protocol::SignalK => told(ServerLine::read(frame)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sentence_goes_by_its_whole_address_and_tells_talker_and_source() {
        let named = named(Protocol::Nmea, b"\\s:IN0001*4F\\$HETHS,316.70,E*1A");
        assert_eq!((named.name.as_str(), named.read), ("HETHS", ReadOutcome::Used));
        assert_eq!((named.talker, named.source), (Some(Talker::HE), Some("IN0001")));
    }

    #[test]
    fn a_refused_sentence_has_its_reason() {
        let without = named(Protocol::Nmea, b"$HETHS,316.70,E");
        assert_eq!((without.name.as_str(), without.read), ("HETHS", ReadOutcome::Refused));
        assert_eq!(without.reason.as_deref(), Some("no checksum"));
        let odd = named(Protocol::Nmea, b"$junk without end");
        assert_eq!(odd.name, "NMEA");
    }

    #[test]
    fn a_line_that_a_port_may_allow_is_told_from_one_that_is_good_for_nothing() {
        for (line, bare) in [
            (&b"$GPZDA,000000,01,08,2014,7"[..], true),
            (b"$GPGLL,2200.097,S,01756.346,W", true),
            (b"$GPGLL,2200.097,S,01756.346,W*00", false),
            (b"$GPZDA,000000,01,08", false),
            (b"$PUHAW,UVH,-4.87,-6.04,219.2", false),
        ] {
            assert_eq!(named(Protocol::Nmea, line).bare, bare);
        }
    }

    #[test]
    fn a_sentence_without_its_bad_field_is_used_and_says_what_is_left_out() {
        let named = named(Protocol::Nmea, b"$GPGST,213122.000,15.7,22.8,11.6,-1.1,0.4,0.6,1.3*76");
        assert_eq!(named.read, ReadOutcome::Used);
        assert_eq!(named.reason.as_deref(), Some("field 5 is malformed, and left out"));
    }

    #[test]
    fn a_refused_binary_frame_has_its_reason() {
        let short = [0xB5, 0x62, 0x01, 0x07, 4, 0, 0, 0, 0, 0, 0x0C, 0x51];
        let named = named(Protocol::Ubx, &short);
        assert_eq!(named.read, ReadOutcome::Refused);
        assert!(named.reason.unwrap().contains("bytes expected"));
    }
}
