//! PRDID: attitude, as current profilers of RD Instruments take it.
//!
//! ```text
//! $PRDID,sPPP.PP,sRRR.RR,hhh.hh*hh   digits fixed, signs always shown
//! $PRDID,sPPP.PP,sRRR.RR,hhh.hh      the same without a checksum
//! $PRDID,p.pp,r.rr,h.hh*hh           a minus where there is one, no leading zeros
//!        1       2       3
//! 1 pitch, deg, positive with the bow up
//! 2 roll, deg, positive with port up
//! 3 heading, deg true
//! ```
//! From the makers' pages (SBG Systems `nmeaMessages.md`; Norwegian Subsea, without checksum; the Qinsy
//! driver, for the signs); not verified against a device. The example that SBG prints has a heading of
//! 366.91 deg, which is refused here.

use super::decimal::Form;
use super::fault::NmeaFault;
use super::frame::Frame;
use super::line::NmeaLine;
use super::parts::{degrees, degrees_with_sign, heading, read_degrees};

const WIDTH: u8 = 3;
const ROLL: Form = Form { decimals: 2, width: WIDTH, limit: 180.0 };
const PITCH: Form = Form { decimals: 2, width: WIDTH, limit: 90.0 };
const HEADING: Form = Form { decimals: 2, width: WIDTH, limit: 360.0 };

/// Which of its forms the sentence has.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Default)]
pub enum PrdidForm {
    /// Fixed digits and signs, with a checksum.
    #[default]
    Fixed,
    /// Fixed digits and signs, without a checksum.
    FixedWithoutChecksum,
    /// As few digits as there are, with a checksum.
    Plain,
}

/// Attitude.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Prdid {
    /// Roll, rad, starboard down positive.
    pub roll: Option<f64>,
    /// Pitch, rad, bow up positive.
    pub pitch: Option<f64>,
    /// Heading, rad, clockwise from true north.
    pub heading: Option<f64>,
}

impl Prdid {
    /// All before the first comma.
    pub const ADDRESS: &'static str = "PRDID";

    /// Greatest length, bytes with CR LF, of any form.
    pub const LONGEST: usize = 34;

    /// Writes the sentence in its first form, to 0.01 deg.
    #[must_use]
    pub fn write(&self) -> NmeaLine {
        self.write_as(PrdidForm::Fixed)
    }

    /// Writes the sentence in a form, to 0.01 deg.
    #[must_use]
    pub fn write_as(&self, form: PrdidForm) -> NmeaLine {
        let line = NmeaLine::compose_own(Self::ADDRESS, |line| match form {
            PrdidForm::Fixed | PrdidForm::FixedWithoutChecksum => {
                degrees_with_sign(line, self.pitch, PITCH);
                degrees_with_sign(line, self.roll, ROLL);
                heading(line, self.heading, HEADING);
            }
            PrdidForm::Plain => {
                degrees(line, self.pitch, Form { width: 1, ..PITCH });
                degrees(line, self.roll, Form { width: 1, ..ROLL });
                heading(line, self.heading, Form { width: 1, ..HEADING });
            }
        });
        if form == PrdidForm::FixedWithoutChecksum { line.without_checksum() } else { line }
    }

    /// Reads the sentence in any form.
    ///
    /// # Errors
    /// The first [`NmeaFault`] of its fields.
    pub fn read(frame: &Frame<'_>) -> Result<Self, NmeaFault> {
        let mut fields = frame.fields_of_own(Self::ADDRESS)?;
        let pitch = read_degrees(&mut fields, PITCH.limit)?;
        let roll = read_degrees(&mut fields, ROLL.limit)?;
        Ok(Prdid { roll, pitch, heading: fields.degrees()? })
    }
}
