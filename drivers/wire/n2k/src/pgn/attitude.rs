//! Heading, rate of turn, heave, attitude and magnetic variation.

use insd_base::Span;
use insd_base::units::wrap_pi;

use super::bits::{Number, Reader, Writer, place_of};
use super::{Group, Short, Sid, millis};

/// Which north a direction counts from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum North {
    /// Geographic north.
    True,
    /// Magnetic north.
    Magnetic,
}

impl North {
    const LIST: [North; 2] = [North::True, North::Magnetic];

    pub(super) fn read(fields: &mut Reader<'_>) -> Option<Self> {
        fields.choice(2, &Self::LIST, |_| None)
    }

    pub(super) fn code(self) -> Option<u8> {
        place_of(&Self::LIST, &self)
    }
}

/// 127250 Vessel heading.
///
/// | bit | field |
/// |---:|---|
/// | 0 | SID, u8 |
/// | 8 | heading, u16, 1e-4 rad |
/// | 24 | deviation, i16, 1e-4 rad |
/// | 40 | variation, i16, 1e-4 rad |
/// | 56 | reference, 2 bits: 0 true, 1 magnetic, 2 error |
/// | 58 | reserved, 6 bits |
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Heading {
    /// Links the messages of one epoch.
    pub sid: Sid,
    /// Clockwise from north, rad, 0 to 2 pi.
    pub heading: Option<f64>,
    /// Deviation of a magnetic compass, east positive, rad.
    pub deviation: Option<f64>,
    /// Variation of the place, east positive, rad.
    pub variation: Option<f64>,
    /// Which north; `None` if not told, or an error.
    pub reference: Option<North>,
}

/// 127251 Rate of turn.
///
/// | bit | field |
/// |---:|---|
/// | 0 | SID, u8 |
/// | 8 | rate, i32, 3.125e-8 rad/s |
/// | 40 | reserved, 24 bits |
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RateOfTurn {
    /// Links the messages of one epoch.
    pub sid: Sid,
    /// Change of heading, rad/s, bow to starboard positive.
    pub rate: Option<f64>,
}

/// 127252 Heave.
///
/// | bit | field |
/// |---:|---|
/// | 0 | SID, u8 |
/// | 8 | heave, i16, 0.01 m |
/// | 24 | reserved, 40 bits; a later edition is said to have a delay here, which is not read |
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Heave {
    /// Links the messages of one epoch.
    pub sid: Sid,
    /// Displacement from the mean, m, up positive.
    pub heave: Option<f64>,
}

/// 127257 Attitude. Many devices leave the yaw out.
///
/// | bit | field |
/// |---:|---|
/// | 0 | SID, u8 |
/// | 8 | yaw, i16, 1e-4 rad |
/// | 24 | pitch, i16, 1e-4 rad |
/// | 40 | roll, i16, 1e-4 rad |
/// | 56 | reserved, 8 bits |
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Attitude {
    /// Links the messages of one epoch.
    pub sid: Sid,
    /// Yaw: heading, rad, -pi to pi.
    pub yaw: Option<f64>,
    /// Pitch, bow up positive, rad.
    pub pitch: Option<f64>,
    /// Roll, starboard side down positive, rad.
    pub roll: Option<f64>,
}

/// Where a variation comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum VariationSource {
    /// Typed in.
    Manual,
    /// A chart.
    Chart,
    /// A table.
    Table,
    /// A calculation that is not named.
    Calculation,
    /// World Magnetic Model of this year: 2000, 2005, 2010, 2015, 2020 or 2025.
    Wmm(u16),
}

/// 127258 Magnetic variation.
///
/// | bit | field |
/// |---:|---|
/// | 0 | SID, u8 |
/// | 8 | source, 4 bits: 0 manual, 1 chart, 2 table, 3 calculation, 4 to 9 WMM 2000 to 2025 |
/// | 12 | reserved, 4 bits |
/// | 16 | date, u16, days |
/// | 32 | variation, i16, 1e-4 rad |
/// | 48 | reserved, 16 bits |
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MagneticVariation {
    /// Links the messages of one epoch.
    pub sid: Sid,
    /// Where it comes from.
    pub source: Option<VariationSource>,
    /// Day for which it holds ("age of service"), days since 1970-01-01.
    pub date: Option<u16>,
    /// Variation, east positive, rad.
    pub variation: Option<f64>,
}

/// Rate of turn, 1/32 of 1e-6 rad/s.
const RATE: Number = Number::signed(32, 3.2e7);
/// Heave, 0.01 m.
const HEAVE: Number = Number::signed(16, 100.0);

impl Group for Heading {
    const PGN: u32 = 127_250;
    const PRIORITY: u8 = 2;
    const INTERVAL: Option<Span> = millis(100);

    fn read(data: &[u8]) -> Result<Self, Short> {
        let mut fields = Reader::new(data, 3)?;
        Ok(Heading {
            sid: fields.byte(),
            heading: fields.direction(),
            deviation: fields.angle(),
            variation: fields.angle(),
            reference: North::read(&mut fields),
        })
    }

    fn write(&self) -> Vec<u8> {
        let mut fields = Writer::default();
        fields.byte(self.sid).direction(self.heading);
        fields.angle(self.deviation).angle(self.variation);
        fields.code(2, self.reference.and_then(North::code)).reserved(6);
        fields.done()
    }
}

impl Group for RateOfTurn {
    const PGN: u32 = 127_251;
    const PRIORITY: u8 = 2;
    const INTERVAL: Option<Span> = millis(100);

    fn read(data: &[u8]) -> Result<Self, Short> {
        let mut fields = Reader::new(data, 5)?;
        Ok(RateOfTurn { sid: fields.byte(), rate: fields.number(RATE) })
    }

    fn write(&self) -> Vec<u8> {
        let mut fields = Writer::default();
        fields.byte(self.sid).number(RATE, self.rate).reserved(24);
        fields.done()
    }
}

impl Group for Heave {
    const PGN: u32 = 127_252;
    const PRIORITY: u8 = 3;
    const INTERVAL: Option<Span> = None;

    fn read(data: &[u8]) -> Result<Self, Short> {
        let mut fields = Reader::new(data, 3)?;
        Ok(Heave { sid: fields.byte(), heave: fields.number(HEAVE) })
    }

    fn write(&self) -> Vec<u8> {
        let mut fields = Writer::default();
        fields.byte(self.sid).number(HEAVE, self.heave).reserved(40);
        fields.done()
    }
}

impl Group for Attitude {
    const PGN: u32 = 127_257;
    const PRIORITY: u8 = 3;
    const INTERVAL: Option<Span> = millis(1000);

    fn read(data: &[u8]) -> Result<Self, Short> {
        let mut fields = Reader::new(data, 3)?;
        Ok(Attitude {
            sid: fields.byte(),
            yaw: fields.angle(),
            pitch: fields.angle(),
            roll: fields.angle(),
        })
    }

    /// The yaw may be any angle, as a heading.
    fn write(&self) -> Vec<u8> {
        let mut fields = Writer::default();
        fields.byte(self.sid).angle(self.yaw.map(wrap_pi));
        fields.angle(self.pitch).angle(self.roll).reserved(8);
        fields.done()
    }
}

impl VariationSource {
    /// By their codes.
    const LIST: [VariationSource; 10] = [
        VariationSource::Manual,
        VariationSource::Chart,
        VariationSource::Table,
        VariationSource::Calculation,
        VariationSource::Wmm(2000),
        VariationSource::Wmm(2005),
        VariationSource::Wmm(2010),
        VariationSource::Wmm(2015),
        VariationSource::Wmm(2020),
        VariationSource::Wmm(2025),
    ];
}

impl Group for MagneticVariation {
    const PGN: u32 = 127_258;
    const PRIORITY: u8 = 7;
    const INTERVAL: Option<Span> = millis(1000);

    fn read(data: &[u8]) -> Result<Self, Short> {
        let mut fields = Reader::new(data, 4)?;
        let sid = fields.byte();
        let source = fields.choice(4, &VariationSource::LIST, |_| None);
        fields.skip(4);
        let date = fields.short(16);
        Ok(MagneticVariation { sid, source, date, variation: fields.angle() })
    }

    fn write(&self) -> Vec<u8> {
        let source = self.source.and_then(|source| place_of(&VariationSource::LIST, &source));
        let mut fields = Writer::default();
        fields.byte(self.sid).code(4, source).reserved(4);
        fields.short(16, self.date).angle(self.variation).reserved(16);
        fields.done()
    }
}
