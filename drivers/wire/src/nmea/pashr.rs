//! PASHR: attitude, in one layout with six meanings.
//!
//! ```text
//! $PASHR,hhmmss.sss,hhh.hh,T,rrr.rr,ppp.pp,xxx.xx,r.rrr,p.ppp,h.hhh,q,i*hh
//!        1          2      3 4      5      6      7     8     9     10 11
//! 1    UTC
//! 2, 3 heading, deg true
//! 4, 5 roll and pitch, deg; signs always shown
//! 6    heave, m: the sign is the dialect's
//! 7..9 1-sigma of roll, pitch and heading, deg
//! 10   quality of the aiding: the digit is the dialect's
//! 11   status of the IMU or INS: the digit is the dialect's; absent in old firmware
//! ```
//! Roll is positive with port up, pitch with the bow up. Nothing in the sentence tells who made it,
//! so the reader has to be told the [`PashrDialect`]; [`Pashr`] keeps what the dialect decides as
//! it was sent until then.
//!
//! Ashtech receivers send sentences of their own under the same address (`$PASHR,POS,...`): their
//! first field begins with a letter, and they are refused as other sentences.
//!
//! The dialects differ in their digits too: see [`Pashr::write_as`].
//!
//! From the makers' manuals (the published examples of SBG Systems and `NovAtel` are written by tests,
//! to the byte); not verified against devices.

use insd_base::FixQuality;

use super::civil::TimeOfDay;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::decimal::Form;
use super::fault::NmeaFault;
use super::fields::Fields;
use super::frame::Frame;
use super::line::NmeaLine;

const ANGLE_LIMIT: f64 = 360.0;
const HEAVE: Form = Form { decimals: 2, width: 3, limit: 999.9 };
const SIGMA: Form = Form { decimals: 3, width: 1, limit: 360.0 };

/// Whose PASHR it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum PashrDialect {
    /// SBG Systems: heave down; quality 0 none, 1 fix without RTK, 2 RTK; status 0 good, 1 error.
    Sbg,
    /// SBG Systems for WASSP sounders: as SBG, but heave up.
    SbgWassp,
    /// iXblue (TECHSAS): heave down; quality 1 for GNSS received and valid; status 1 for an error of
    /// an accelerometer or gyro.
    Ixblue,
    /// `NovAtel`: direction of heave not stated, so unknown; quality as SBG; status of the INS not
    /// stated.
    Novatel,
    /// Trimble: no heave; quality as GGA; status 0 GNSS only, 1 coarse levelling, 2 degraded, 3
    /// aligned, 4 full navigation.
    Trimble,
    /// Applanix and `OxTS`: direction of heave not stated, so unknown; quality 0 none, 1 GNSS, 2 GNSS
    /// with heading; status 0 good, 1 IMU out.
    Applanix,
}

/// What the last field says.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum PashrStatus {
    /// The inertial unit works.
    Good,
    /// It does not.
    Error,
    /// There is no inertial solution, only that of the receiver.
    GnssOnly,
    /// Coarse levelling.
    Levelling,
    /// Attitude found, accuracy not yet full.
    Degraded,
    /// Aligned.
    Aligned,
    /// Full navigation.
    Full,
}

/// Attitude as it was sent, before a dialect gives it its meaning.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Pashr {
    /// UTC.
    pub time: Option<TimeOfDay>,
    /// Heading, rad, clockwise from true north.
    pub heading: Option<f64>,
    /// Roll, rad, starboard down positive.
    pub roll: Option<f64>,
    /// Pitch, rad, bow up positive.
    pub pitch: Option<f64>,
    /// Heave as it stands in the sentence, m; see [`Pashr::heave_down`].
    pub heave_as_sent: Option<f64>,
    /// 1-sigma of the roll, rad.
    pub roll_std: Option<f64>,
    /// 1-sigma of the pitch, rad.
    pub pitch_std: Option<f64>,
    /// 1-sigma of the heading, rad.
    pub heading_std: Option<f64>,
    /// Digit of the quality, at most 9; see [`Pashr::quality`].
    pub quality_digit: Option<u8>,
    /// Digit of the status, at most 9; see [`Pashr::status`].
    pub status_digit: Option<u8>,
}

/// How many digits a dialect has.
#[derive(Clone, Copy)]
struct Digits {
    /// Of the time, behind the point.
    time: u8,
    /// Of angles and heave, before the point, at least.
    whole: u8,
    /// Of the heave, behind the point.
    heave: u8,
}

impl Pashr {
    /// All before the first comma.
    pub const ADDRESS: &'static str = "PASHR";

    /// Bytes of the longest sentence with a ship's values, CR LF included.
    pub const LONGEST: usize = 83;

    /// Heave, m, **down** positive, if the dialect states a direction.
    #[must_use]
    pub fn heave_down(&self, dialect: PashrDialect) -> Option<f64> {
        match dialect {
            PashrDialect::Sbg | PashrDialect::Ixblue => self.heave_as_sent,
            PashrDialect::SbgWassp => self.heave_as_sent.map(|heave| -heave),
            PashrDialect::Novatel | PashrDialect::Trimble | PashrDialect::Applanix => None,
        }
    }

    /// Sets the heave, m, **down** positive, in the way of the dialect; empty if it states none.
    pub fn set_heave_down(&mut self, heave: Option<f64>, dialect: PashrDialect) {
        self.heave_as_sent = heave;
        self.heave_as_sent = self.heave_down(dialect);
    }

    /// Quality of the satellite fix that aids the attitude; a digit that the dialect lacks is unknown.
    #[must_use]
    pub fn quality(&self, dialect: PashrDialect) -> Option<FixQuality> {
        let digit = self.quality_digit?;
        match (dialect, digit) {
            (PashrDialect::Trimble, _) => FixQuality::from_gga(digit).filter(|_| digit <= 6),
            (_, 0) => Some(FixQuality::Invalid),
            (_, 1) | (PashrDialect::Applanix, 2) => Some(FixQuality::Autonomous),
            (PashrDialect::Sbg | PashrDialect::SbgWassp | PashrDialect::Novatel, 2) => {
                Some(FixQuality::RtkFixed)
            }
            _ => None,
        }
    }

    /// State of the inertial unit; a digit that the dialect lacks is unknown.
    #[must_use]
    pub fn status(&self, dialect: PashrDialect) -> Option<PashrStatus> {
        match (dialect, self.status_digit?) {
            (PashrDialect::Novatel, _) => None,
            (PashrDialect::Trimble, 0) => Some(PashrStatus::GnssOnly),
            (PashrDialect::Trimble, 1) => Some(PashrStatus::Levelling),
            (PashrDialect::Trimble, 2) => Some(PashrStatus::Degraded),
            (PashrDialect::Trimble, 3) => Some(PashrStatus::Aligned),
            (PashrDialect::Trimble, 4) => Some(PashrStatus::Full),
            (PashrDialect::Trimble, _) => None,
            (_, 0) => Some(PashrStatus::Good),
            (_, 1) => Some(PashrStatus::Error),
            _ => None,
        }
    }

    /// Writes the sentence: time truncated to 1 ms, angles to 0.01 deg, heave to 1 cm, three digits
    /// before the point, sigmas to 0.001 deg. An unknown status is left out with its comma.
    #[must_use]
    pub fn write(&self) -> NmeaLine {
        self.write_in(Digits { time: 3, whole: 3, heave: 2 })
    }

    /// Writes the sentence with the digits of a dialect: SBG Systems have 2 decimals of the time, and
    /// for WASSP sounders 3 of the heave; `NovAtel` has no zeros before a number. Of the other dialects
    /// no real sentence was seen; they are written as by [`Pashr::write`].
    #[must_use]
    pub fn write_as(&self, dialect: PashrDialect) -> NmeaLine {
        self.write_in(match dialect {
            PashrDialect::Sbg => Digits { time: 2, whole: 3, heave: 2 },
            PashrDialect::SbgWassp => Digits { time: 2, whole: 3, heave: 3 },
            PashrDialect::Novatel => Digits { time: 3, whole: 1, heave: 2 },
            PashrDialect::Ixblue | PashrDialect::Trimble | PashrDialect::Applanix => {
                return self.write();
            }
        })
    }

    fn write_in(&self, digits: Digits) -> NmeaLine {
        let heading = self.heading.map(|heading| heading.to_degrees().rem_euclid(360.0));
        let heading = heading.map(|degrees| if degrees >= 359.995 { 0.0 } else { degrees });
        let angle = Form { decimals: 2, width: digits.whole, limit: ANGLE_LIMIT };
        let heave = Form { decimals: digits.heave, width: digits.whole, ..HEAVE };
        NmeaLine::compose_own(Self::ADDRESS, |line| {
            line.time_of_day_to(self.time, digits.time);
            line.number(heading, angle);
            line.letter(b'T');
            line.with_sign(self.roll.map(f64::to_degrees), angle);
            line.with_sign(self.pitch.map(f64::to_degrees), angle);
            line.with_sign(self.heave_as_sent, heave);
            for sigma in [self.roll_std, self.pitch_std, self.heading_std] {
                line.magnitude(sigma.map(f64::to_degrees), SIGMA);
            }
            line.whole(self.quality_digit.map(u32::from), 1, 9);
            if self.status_digit.is_some() {
                line.whole(self.status_digit.map(u32::from), 1, 9);
            }
        })
    }

    /// Reads the sentence.
    ///
    /// # Errors
    /// The first [`NmeaFault`] of its fields; [`NmeaFault::OtherSentence`] for those of Ashtech receivers.
    pub fn read(frame: &Frame<'_>) -> Result<Self, NmeaFault> {
        let mut fields = frame.fields_of_own(Self::ADDRESS)?;
        if fields.clone().text()?.starts_with(|first: char| first.is_ascii_alphabetic()) {
            return Err(NmeaFault::OtherSentence);
        }
        let time = fields.time_of_day()?;
        let heading = fields.degrees()?;
        fields.fixed("T")?;
        Ok(Pashr {
            time,
            heading,
            roll: angle(&mut fields, -180.0)?,
            pitch: angle(&mut fields, -180.0)?,
            heave_as_sent: fields.optional(|own| own.number_in(-HEAVE.limit..=HEAVE.limit))?,
            roll_std: angle(&mut fields, 0.0)?,
            pitch_std: angle(&mut fields, 0.0)?,
            heading_std: angle(&mut fields, 0.0)?,
            quality_digit: digit(&mut fields)?,
            status_digit: if fields.has_more() { digit(&mut fields)? } else { None },
        })
    }
}

/// An angle of at least `min` and at most 360 deg; another one is left out.
fn angle(fields: &mut Fields<'_>, min: f64) -> Result<Option<f64>, NmeaFault> {
    let degrees = fields.optional(|own| own.number_in(min..=SIGMA.limit))?;
    Ok(degrees.map(f64::to_radians))
}

fn digit(fields: &mut Fields<'_>) -> Result<Option<u8>, NmeaFault> {
    Ok(fields.whole(9)?.and_then(|digit| u8::try_from(digit).ok()))
}

#[cfg(test)]
mod tests {
    use super::*;

    const PUBLISHED: &[u8] =
        b"$PASHR,123816.80,312.95,T,-000.83,-000.42,-000.01,0.234,0.224,0.298,1,0*09";

    #[test]
    fn the_dialect_decides_about_heave_quality_and_status() {
        let pashr = Pashr::read(&Frame::parse(PUBLISHED).unwrap()).unwrap();
        assert_eq!(pashr.heave_down(PashrDialect::Sbg), Some(-0.01));
        assert_eq!(pashr.heave_down(PashrDialect::SbgWassp), Some(0.01));
        assert_eq!(pashr.heave_down(PashrDialect::Trimble), None);
        assert_eq!(pashr.quality(PashrDialect::Ixblue), Some(FixQuality::Autonomous));
        assert_eq!(pashr.status(PashrDialect::Sbg), Some(PashrStatus::Good));
        assert_eq!(pashr.status(PashrDialect::Trimble), Some(PashrStatus::GnssOnly));
    }

    #[test]
    fn a_published_sentence_is_written_byte_for_byte_in_its_dialect() {
        let wassp = b"$PASHR,002258.15,320.99,T,+032.46,-008.15,-012.239,0.454,0.095,1.070,1,0*39";
        let novatel = b"$PASHR,163029.000,158.09,T,-0.30,+0.31,+0.01,0.029,0.029,0.059,1,1*3B";
        for (bytes, dialect) in [
            (PUBLISHED, PashrDialect::Sbg),
            (b"$PASHR,,,T,,,,,,,0,1*21", PashrDialect::Sbg),
            (wassp, PashrDialect::SbgWassp),
            (novatel, PashrDialect::Novatel),
        ] {
            let pashr = Pashr::read(&Frame::parse(bytes).unwrap()).unwrap();
            assert_eq!(pashr.write_as(dialect).as_str().as_bytes(), bytes);
        }
        let pashr = Pashr::read(&Frame::parse(PUBLISHED).unwrap()).unwrap();
        let text = "$PASHR,123816.800,312.95,T,-000.83,-000.42,-000.01,0.234,0.224,0.298,1,0*";
        assert!(pashr.write().as_str().starts_with(text), "{:?}", pashr.write());
    }

    #[test]
    fn a_position_of_an_ashtech_receiver_is_another_sentence() {
        let line = b"$PASHR,POS,0,06,204132.00,4205.7337,N,08802.0410,W,+00221.92,,,,,,,,,*";
        let sum = super::super::checksum(&line[1..line.len() - 1]);
        let framed = [line.as_slice(), format!("{sum:02X}").as_bytes()].concat();
        assert_eq!(Pashr::read(&Frame::parse(&framed).unwrap()), Err(NmeaFault::OtherSentence));
    }
}
