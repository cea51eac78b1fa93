//! PTNL,AVR: the line between two antennas of a Trimble receiver.
//!
//! ```text
//! $PTNL,AVR,hhmmss.ss,+y.yyyy,Yaw,+t.tttt,Tilt,+r.rrrr,Roll,m.mmm,q,p.p,n*hh
//!           2         3       4   5       6    7       8    9     10 11 12
//! 2     UTC
//! 3, 4  direction of the line, deg true; the word
//! 5, 6  how it rises along the ship, deg; the word, both empty if it is told athwart
//! 7, 8  the same athwart
//! 9     its length, m
//! 10    0 none, 1 autonomous, 2 RTK float, 3 RTK fixed, 4 differential
//! 11    dilution of precision; 12 satellites used
//! ```
//! From the maker's receiver help (R750), verified against its published lines. It does not state the signs of tilt and roll.

use super::civil::TimeOfDay;
use super::decimal::Form;
use super::fault::NmeaFault;
use super::fields::Fields;
use super::frame::Frame;
use super::kinds::{Clock, Decimal, Kind};
use super::line::{Composer, NmeaLine};

const YAW: Decimal = Decimal::signed(4, 360.0).degrees().with_sign();
const TILT: Decimal = Decimal::signed(4, 90.0).degrees().with_sign();
const CLOCK: Clock = Clock(2);
const LENGTH: Form = Form { decimals: 3, width: 1, limit: 9999.0 };
const DILUTION: Form = Form { decimals: 1, width: 1, limit: 99.0 };

/// How a line between antennas was found.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum PtnlQuality {
    /// 0: not at all.
    None,
    /// 1: without differences.
    Autonomous,
    /// 2: with float ambiguities.
    Float,
    /// 3: with fixed ones.
    Fixed,
    /// 4: by codes.
    Differential,
}

/// A line between two antennas.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PtnlAvr {
    /// UTC.
    pub time: Option<TimeOfDay>,
    /// Direction of the line, rad from true north, as it stands.
    pub yaw: Option<f64>,
    /// How it rises along the ship, rad.
    pub tilt: Option<f64>,
    /// How it rises athwart, rad.
    pub roll: Option<f64>,
    /// Its length, m.
    pub length: Option<f64>,
    /// How it was found.
    pub quality: PtnlQuality,
    /// Position dilution of precision.
    pub pdop: Option<f64>,
    /// Satellites used.
    pub satellites: Option<u8>,
}

impl PtnlAvr {
    /// All before the first comma.
    pub const ADDRESS: &'static str = "PTNL";

    /// Greatest length, bytes with CR LF.
    pub const LONGEST: usize = 79;

    /// Writes the sentence.
    #[must_use]
    pub fn write(&self) -> NmeaLine {
        NmeaLine::compose_own(Self::ADDRESS, |line| {
            line.text("AVR");
            CLOCK.write(line, &self.time);
            YAW.write(line, &self.yaw);
            line.text("Yaw");
            rise(line, self.tilt, "Tilt");
            rise(line, self.roll, "Roll");
            line.number(self.length, LENGTH);
            line.letter(b'0' + self.quality as u8);
            line.number(self.pdop, DILUTION);
            line.whole(self.satellites.map(u32::from), 1, 255);
        })
    }

    /// Reads the sentence. Time, direction and quality must be good.
    ///
    /// # Errors
    /// The first [`NmeaFault`] of its fields; [`NmeaFault::OtherSentence`] of other sentences of Trimble.
    pub fn read(frame: &Frame<'_>) -> Result<Self, NmeaFault> {
        let mut fields = frame.fields_of_own(Self::ADDRESS)?;
        if fields.text()? != "AVR" {
            return Err(NmeaFault::OtherSentence);
        }
        let time = CLOCK.read(&mut fields)?;
        let yaw = YAW.read(&mut fields)?;
        fields.fixed("Yaw")?;
        let tilt = risen(&mut fields, "Tilt")?;
        let roll = risen(&mut fields, "Roll")?;
        let length = fields.optional(|own| own.number_in(0.0..=LENGTH.limit))?;
        let quality = fields.convert(quality)?.ok_or_else(|| fields.malformed())?;
        let pdop = fields.optional(|own| own.number_in(0.0..=DILUTION.limit))?;
        let satellites = fields.optional(|own| own.whole(255))?;
        let satellites = satellites.and_then(|count| u8::try_from(count).ok());
        Ok(PtnlAvr { time, yaw, tilt, roll, length, quality, pdop, satellites })
    }

    /// Direction of the line, rad from true north, if its ambiguities are fixed.
    #[must_use]
    pub fn heading(&self) -> Option<f64> {
        let fixed = self.quality == PtnlQuality::Fixed;
        self.yaw.filter(|_| fixed).map(insd_base::units::wrap_two_pi)
    }
}

/// An angle and its word; without an angle both are empty.
fn rise(line: &mut Composer, angle: Option<f64>, word: &str) {
    let filled = line.filled(|line| TILT.write(line, &angle));
    if filled {
        line.text(word);
    } else {
        line.empty();
    }
}

fn risen(fields: &mut Fields<'_>, word: &str) -> Result<Option<f64>, NmeaFault> {
    let angle = fields.optional(|own| TILT.read(own))?;
    let told = fields.text()?;
    let good = told == word || told.is_empty() && angle.is_none();
    if good { Ok(angle) } else { Err(fields.malformed()) }
}

fn quality(text: &str) -> Option<PtnlQuality> {
    Some(match text {
        "0" => PtnlQuality::None,
        "1" => PtnlQuality::Autonomous,
        "2" => PtnlQuality::Float,
        "3" => PtnlQuality::Fixed,
        "4" => PtnlQuality::Differential,
        _ => return None,
    })
}
