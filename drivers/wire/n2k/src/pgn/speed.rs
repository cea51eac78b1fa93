//! Speed, distance and current.

use insd_base::Span;

use super::bits::{FINE_SPEED, Number, Reader, SPEED, TIME, Writer, place_of};
use super::{Group, North, Short, Sid, millis};

/// How a log measures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SpeedKind {
    /// A paddle wheel.
    PaddleWheel,
    /// A pitot tube.
    PitotTube,
    /// Doppler.
    Doppler,
    /// Correlation of ultrasound.
    Correlation,
    /// Electromagnetic.
    Electromagnetic,
}

/// The way a ship goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Direction {
    /// Ahead.
    Forward,
    /// Astern.
    Reverse,
}

/// 128259 Speed, water referenced.
///
/// | bit | field |
/// |---:|---|
/// | 0 | SID, u8 |
/// | 8 | speed through water, u16, 0.01 m/s |
/// | 24 | speed over ground, u16, 0.01 m/s |
/// | 40 | kind, u8: 0 paddle wheel, 1 pitot tube, 2 Doppler, 3 correlation, 4 electromagnetic |
/// | 48 | direction, 4 bits: 0 forward, 1 reverse |
/// | 52 | reserved, 12 bits |
///
/// canboat.json 8 names the direction but not its numbers, and the field table of 2009 has reserved
/// bits in its place: the numbers are not verified, and no log at hand has anything but "not
/// available" here.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Speed {
    /// Links the messages of one epoch.
    pub sid: Sid,
    /// Through the water, m/s, not negative.
    pub water: Option<f64>,
    /// Over ground, m/s, not negative.
    pub ground: Option<f64>,
    /// How the speed through the water is measured.
    pub kind: Option<SpeedKind>,
    /// The way the ship goes; many devices do not tell.
    pub direction: Option<Direction>,
}

/// 128275 Distance log.
///
/// | bit | field |
/// |---:|---|
/// | 0 | date, u16, days |
/// | 16 | time, u32, 1e-4 s |
/// | 48 | log, u32, m |
/// | 80 | trip, u32, m |
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DistanceLog {
    /// Days since 1970-01-01.
    pub date: Option<u16>,
    /// UTC, seconds of the day.
    pub time: Option<f64>,
    /// Distance in all, m.
    pub log: Option<f64>,
    /// Distance since the last reset, m.
    pub trip: Option<f64>,
}

/// 129291 Set and drift, rapid update.
///
/// | bit | field |
/// |---:|---|
/// | 0 | SID, u8 |
/// | 8 | reference of the set, 2 bits: 0 true, 1 magnetic, 2 error |
/// | 10 | reserved, 6 bits |
/// | 16 | set, u16, 1e-4 rad |
/// | 32 | drift, u16, 0.01 m/s |
/// | 48 | reserved, 16 bits |
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SetDrift {
    /// Links the messages of one epoch.
    pub sid: Sid,
    /// Which north the set counts from.
    pub reference: Option<North>,
    /// Whither the current flows, rad, 0 to 2 pi.
    pub set: Option<f64>,
    /// Its speed, m/s.
    pub drift: Option<f64>,
}

/// 130578 Vessel speed components: forward and starboard positive, m/s.
///
/// Six fields of i16, 0.001 m/s, in the order of this struct; there is no SID.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct SpeedComponents {
    /// Forward, through the water.
    pub forward_water: Option<f64>,
    /// To starboard, through the water.
    pub starboard_water: Option<f64>,
    /// Forward, over ground.
    pub forward_ground: Option<f64>,
    /// To starboard, over ground.
    pub starboard_ground: Option<f64>,
    /// The stern's to starboard, through the water.
    pub stern_starboard_water: Option<f64>,
    /// The stern's to starboard, over ground.
    pub stern_starboard_ground: Option<f64>,
}

/// A distance, m.
const DISTANCE: Number = Number::unsigned(32, 1.0);

impl SpeedKind {
    /// By their codes.
    const LIST: [SpeedKind; 5] = [
        SpeedKind::PaddleWheel,
        SpeedKind::PitotTube,
        SpeedKind::Doppler,
        SpeedKind::Correlation,
        SpeedKind::Electromagnetic,
    ];
}

impl Direction {
    /// By their codes.
    const LIST: [Direction; 2] = [Direction::Forward, Direction::Reverse];
}

impl Group for Speed {
    const PGN: u32 = 128_259;
    const PRIORITY: u8 = 2;
    const INTERVAL: Option<Span> = millis(1000);

    fn read(data: &[u8]) -> Result<Self, Short> {
        let mut fields = Reader::new(data, 3)?;
        Ok(Speed {
            sid: fields.byte(),
            water: fields.number(SPEED),
            ground: fields.number(SPEED),
            kind: fields.choice(8, &SpeedKind::LIST, |_| None),
            direction: fields.choice(4, &Direction::LIST, |_| None),
        })
    }

    fn write(&self) -> Vec<u8> {
        let kind = self.kind.and_then(|kind| place_of(&SpeedKind::LIST, &kind));
        let direction = self.direction.and_then(|way| place_of(&Direction::LIST, &way));
        let mut fields = Writer::default();
        fields.byte(self.sid).number(SPEED, self.water).number(SPEED, self.ground);
        fields.code(8, kind).code(4, direction).reserved(12);
        fields.done()
    }
}

impl Group for DistanceLog {
    const PGN: u32 = 128_275;
    const PRIORITY: u8 = 6;
    const INTERVAL: Option<Span> = millis(1000);

    fn read(data: &[u8]) -> Result<Self, Short> {
        let mut fields = Reader::new(data, 2)?;
        Ok(DistanceLog {
            date: fields.short(16),
            time: fields.number(TIME),
            log: fields.number(DISTANCE),
            trip: fields.number(DISTANCE),
        })
    }

    fn write(&self) -> Vec<u8> {
        let mut fields = Writer::default();
        fields.short(16, self.date).number(TIME, self.time);
        fields.number(DISTANCE, self.log).number(DISTANCE, self.trip);
        fields.done()
    }
}

impl Group for SetDrift {
    const PGN: u32 = 129_291;
    const PRIORITY: u8 = 3;
    const INTERVAL: Option<Span> = millis(1000);

    fn read(data: &[u8]) -> Result<Self, Short> {
        let mut fields = Reader::new(data, 4)?;
        let sid = fields.byte();
        let reference = North::read(&mut fields);
        fields.skip(6);
        Ok(SetDrift { sid, reference, set: fields.direction(), drift: fields.number(SPEED) })
    }

    fn write(&self) -> Vec<u8> {
        let mut fields = Writer::default();
        fields.byte(self.sid).code(2, self.reference.and_then(North::code)).reserved(6);
        fields.direction(self.set).number(SPEED, self.drift).reserved(16);
        fields.done()
    }
}

impl Group for SpeedComponents {
    const PGN: u32 = 130_578;
    const PRIORITY: u8 = 2;
    const INTERVAL: Option<Span> = millis(250);

    fn read(data: &[u8]) -> Result<Self, Short> {
        let mut fields = Reader::new(data, 2)?;
        Ok(SpeedComponents {
            forward_water: fields.number(FINE_SPEED),
            starboard_water: fields.number(FINE_SPEED),
            forward_ground: fields.number(FINE_SPEED),
            starboard_ground: fields.number(FINE_SPEED),
            stern_starboard_water: fields.number(FINE_SPEED),
            stern_starboard_ground: fields.number(FINE_SPEED),
        })
    }

    fn write(&self) -> Vec<u8> {
        let mut fields = Writer::default();
        fields.number(FINE_SPEED, self.forward_water).number(FINE_SPEED, self.starboard_water);
        fields.number(FINE_SPEED, self.forward_ground).number(FINE_SPEED, self.starboard_ground);
        fields.number(FINE_SPEED, self.stern_starboard_water);
        fields.number(FINE_SPEED, self.stern_starboard_ground);
        fields.done()
    }
}
