//! Position, course and speed, sent often.

use insd_base::Span;

use super::bits::{Number, Reader, SPEED, Writer};
use super::{Group, North, Short, Sid, millis};

/// 129025 Position, rapid update. It has neither a SID nor a time.
///
/// | bit | field |
/// |---:|---|
/// | 0 | latitude, i32, 1e-7 deg |
/// | 32 | longitude, i32, 1e-7 deg |
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PositionRapid {
    /// Geodetic latitude, rad, north positive.
    pub latitude: Option<f64>,
    /// Longitude, rad, east positive.
    pub longitude: Option<f64>,
}

/// 129026 Course and speed over ground, rapid update.
///
/// | bit | field |
/// |---:|---|
/// | 0 | SID, u8 |
/// | 8 | reference of the course, 2 bits: 0 true, 1 magnetic, 2 error |
/// | 10 | reserved, 6 bits |
/// | 16 | course, u16, 1e-4 rad |
/// | 32 | speed, u16, 0.01 m/s |
/// | 48 | reserved, 16 bits |
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CourseSpeed {
    /// Links the messages of one epoch.
    pub sid: Sid,
    /// Which north the course counts from.
    pub reference: Option<North>,
    /// Course over ground, rad, 0 to 2 pi.
    pub course: Option<f64>,
    /// Speed over ground, m/s.
    pub speed: Option<f64>,
}

/// Latitude, 1e-7 deg.
const LATITUDE: Number = Number::signed(32, 1e7).within(-900_000_000, 900_000_000);
/// Longitude, 1e-7 deg.
const LONGITUDE: Number = Number::signed(32, 1e7).within(-1_800_000_000, 1_800_000_000);

impl Group for PositionRapid {
    const PGN: u32 = 129_025;
    const PRIORITY: u8 = 2;
    const INTERVAL: Option<Span> = millis(100);

    fn read(data: &[u8]) -> Result<Self, Short> {
        let mut fields = Reader::new(data, 4)?;
        Ok(PositionRapid {
            latitude: fields.degrees(LATITUDE),
            longitude: fields.degrees(LONGITUDE),
        })
    }

    fn write(&self) -> Vec<u8> {
        let mut fields = Writer::default();
        fields.degrees(LATITUDE, self.latitude).degrees(LONGITUDE, self.longitude);
        fields.done()
    }
}

impl Group for CourseSpeed {
    const PGN: u32 = 129_026;
    const PRIORITY: u8 = 2;
    const INTERVAL: Option<Span> = millis(250);

    fn read(data: &[u8]) -> Result<Self, Short> {
        let mut fields = Reader::new(data, 4)?;
        let sid = fields.byte();
        let reference = North::read(&mut fields);
        fields.skip(6);
        Ok(CourseSpeed { sid, reference, course: fields.direction(), speed: fields.number(SPEED) })
    }

    fn write(&self) -> Vec<u8> {
        let mut fields = Writer::default();
        fields.byte(self.sid).code(2, self.reference.and_then(North::code)).reserved(6);
        fields.direction(self.course).number(SPEED, self.speed).reserved(16);
        fields.done()
    }
}
