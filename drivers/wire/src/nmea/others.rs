//! Sentences that the navigator does not need (MWV, DPT, MTW ...): is there such a sentence,
//! and does the `nmea` crate understand it? For people who want to know what comes in at a port;
//! its values go nowhere.
//!
//! Guarded against what the crate is known for. It is asked only about approved sentences whose frame
//! is good and that are not read here, which spares us its faults with GNS; lines beyond its 102 bytes
//! are not handed over; and as it refuses all real GBS (negative biases, empty fields), its word on
//! them is not taken. A refusal is no proof that a sentence is wrong.

use nmea::{Error, ParseResult, SENTENCE_MAX_LEN, SentenceType};

use super::fault::NmeaFault;
use super::fields::LeftOut;
use super::frame::Frame;
use super::sentence::Sentence;

/// What kind of sentence a line is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SentenceKind<'a> {
    /// Formatter of an approved sentence (`MWV`), or the address of a maker's own (`PGRME`).
    pub name: &'a str,
    /// How far it is understood.
    pub understood: Understood,
}

/// How far a sentence is understood.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Understood {
    /// The navigator reads it; what was bad in it is left out.
    Read(LeftOut),
    /// The navigator reads such sentences, but not this one.
    Refused(NmeaFault),
    /// The navigator does not need it; it has the form that the `nmea` crate knows.
    Recognised,
    /// The navigator does not need it; the `nmea` crate knows such sentences, but not this form.
    Odd,
    /// Nobody here knows it.
    Unknown,
}

/// The kind of a line's sentence.
///
/// # Errors
/// The [`NmeaFault`] of its frame.
pub fn kind(line: &[u8]) -> Result<SentenceKind<'_>, NmeaFault> {
    let frame = Frame::parse(line)?;
    Ok(kind_of(line, &frame))
}

/// The kind of the sentence of a frame, which is that of a line.
#[must_use]
pub fn kind_of<'a>(line: &[u8], frame: &Frame<'a>) -> SentenceKind<'a> {
    let name = frame.approved().map_or(frame.address(), |(_, formatter)| formatter);
    let understood = match Sentence::read_frame(frame) {
        Ok(_) => Understood::Read(frame.left_out()),
        Err(NmeaFault::OtherSentence) if frame.talker().is_some() => ask(line, name),
        Err(NmeaFault::OtherSentence | NmeaFault::Address) => Understood::Unknown,
        Err(fault) => Understood::Refused(fault),
    };
    SentenceKind { name, understood }
}

/// Asks the `nmea` crate about a line whose frame is good.
fn ask(line: &[u8], name: &str) -> Understood {
    if SentenceType::try_from(name).is_err() {
        return Understood::Unknown;
    }
    let start = line.iter().rposition(|byte| *byte == b'$').unwrap_or(0);
    let bare = line.get(start..).unwrap_or_default().trim_ascii_end();
    let Some(text) = std::str::from_utf8(bare).ok().filter(|text| text.len() <= SENTENCE_MAX_LEN)
    else {
        return Understood::Odd;
    };
    match nmea::parse_str(text) {
        Ok(ParseResult::Unsupported(_)) => Understood::Unknown,
        Ok(_) => Understood::Recognised,
        Err(Error::Unsupported(_) | Error::Unknown(_) | Error::DisabledSentence) => {
            Understood::Unknown
        }
        Err(_) => Understood::Odd,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn understood(text: &str) -> Understood {
        let sum = super::super::checksum(text.as_bytes());
        kind(format!("${text}*{sum:02X}\r\n").as_bytes()).unwrap().understood
    }

    #[test]
    fn sentences_are_told_apart_by_how_far_they_are_understood() {
        assert_eq!(understood("HEHDT,1.0,T"), Understood::Read(LeftOut::default()));
        assert_eq!(
            understood("HEHDT,1.0,M"),
            Understood::Refused(NmeaFault::Malformed { field: 2 })
        );
        assert_eq!(understood("WIMWV,41.1,R,1.0,N,A"), Understood::Recognised);
        assert_eq!(understood("WIMWV,x,R"), Understood::Odd);
        assert_eq!(understood("IIRSA,1.0,A,,V"), Understood::Unknown);
        assert_eq!(understood("IIQQQ,1"), Understood::Unknown);
        let ais = "!AIVDM,1,1,,B,177KQJ5000G?tO`K>RA1wUbN0TKH,0*5C";
        assert_eq!(kind(ais.as_bytes()).map(|kind| kind.name), Ok("AIVDM"));
        assert_eq!(understood("PGRME,15.0,M,45.0,M,25.0,M"), Understood::Unknown);
        let long = format!("WIMWV,41.1,R,1.0,N,A,{}", "x".repeat(200));
        assert_eq!(understood(&long), Understood::Odd);
        assert_eq!(
            kind(b"$WIMWV,41.1,R,1.0,N,A*00"),
            Err(NmeaFault::WrongChecksum { stated: 0, computed: 0x16 })
        );
    }
}
