//! The table.

use insd_base::can::CanId;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// All frames of a device.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CanLayout {
    /// In the order in which the device sends those of one sample.
    pub frames: Vec<FrameLayout>,
}

/// One frame.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FrameLayout {
    /// Its identifier.
    pub id: u32,
    /// Whether the identifier has 29 bits, else 11.
    #[serde(default)]
    pub extended: bool,
    /// Whether a sample is complete without it. A frame with motion or time never is.
    #[serde(default)]
    pub optional: bool,
    /// Its fields.
    pub fields: Vec<Field>,
}

/// One number in a frame. Its value is `(number * scale + offset) / 2^exponent`.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Field {
    /// What it tells.
    pub what: What,
    /// Its first bit. In `little` order bits count from the lowest of byte 0, and `start` is the
    /// number's lowest bit; in `big` order they count from the highest of byte 0, and `start` is the
    /// number's highest bit. A number that fills whole bytes starts at 8 times its first byte in both.
    pub start: u8,
    /// Its number of bits.
    pub width: u8,
    /// Whether its highest bit is a sign.
    #[serde(default)]
    pub signed: bool,
    /// The order of its bytes.
    #[serde(default)]
    pub order: ByteOrder,
    /// What one count is, in the unit of [`What`].
    #[serde(default = "one")]
    pub scale: f64,
    /// What zero counts are, in that unit; of no meaning for time, counter and status.
    #[serde(default)]
    pub offset: f64,
    /// First bit of an unsigned byte of the same frame whose number is a negative power of two.
    #[serde(default)]
    pub exponent: Option<u8>,
    /// Number, as its bits, that stands for "not available": a sample with it is not valid.
    #[serde(default)]
    pub missing: Option<u64>,
    /// Values before a time or counter starts again; two to the power of its width if left out.
    #[serde(default)]
    pub modulus: Option<u64>,
    /// Bits of a status that are looked at; all if left out.
    #[serde(default)]
    pub mask: Option<u64>,
    /// What those bits are in a sample that may be used; a status without it is only shown.
    #[serde(default)]
    pub expected: Option<u64>,
}

/// The order of the bytes of a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum ByteOrder {
    /// The lowest first (Intel).
    #[default]
    Little,
    /// The highest first (Motorola).
    Big,
}

/// What a field tells. Axes are the device's own.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum What {
    /// Angular rate about x, rad/s.
    RateX,
    /// Angular rate about y, rad/s.
    RateY,
    /// Angular rate about z, rad/s.
    RateZ,
    /// Angle about x since the sample before, rad.
    AngleX,
    /// Angle about y since the sample before, rad.
    AngleY,
    /// Angle about z since the sample before, rad.
    AngleZ,
    /// Scalar part of the quaternion of the turn since the sample before.
    TurnW,
    /// Its part along x.
    TurnX,
    /// Its part along y.
    TurnY,
    /// Its part along z.
    TurnZ,
    /// Specific force along x, m/s^2.
    AccelX,
    /// Specific force along y, m/s^2.
    AccelY,
    /// Specific force along z, m/s^2.
    AccelZ,
    /// Integral of specific force along x since the sample before, m/s.
    VelocityX,
    /// Integral of specific force along y since the sample before, m/s.
    VelocityY,
    /// Integral of specific force along z since the sample before, m/s.
    VelocityZ,
    /// The device's clock at the end of the sample's interval, s.
    Time,
    /// Number of the sample.
    Counter,
    /// Temperature, deg C.
    Temperature,
    /// Status word.
    Status,
    /// Year of UTC of the end of the interval; all parts of a time must come with the sample.
    Year,
    /// Month, 1 to 12.
    Month,
    /// Day of the month.
    Day,
    /// Hour.
    Hour,
    /// Minute.
    Minute,
    /// Second.
    Second,
    /// Part of a second, s.
    Fraction,
}

/// Components in the order of their axes.
pub(super) const RATE: [What; 3] = [What::RateX, What::RateY, What::RateZ];
pub(super) const ANGLE: [What; 3] = [What::AngleX, What::AngleY, What::AngleZ];
pub(super) const TURN: [What; 4] = [What::TurnW, What::TurnX, What::TurnY, What::TurnZ];
pub(super) const ACCEL: [What; 3] = [What::AccelX, What::AccelY, What::AccelZ];
pub(super) const VELOCITY: [What; 3] = [What::VelocityX, What::VelocityY, What::VelocityZ];
/// All parts of UTC.
pub(super) const UTC: [What; 7] =
    [What::Year, What::Month, What::Day, What::Hour, What::Minute, What::Second, What::Fraction];

fn one() -> f64 {
    1.0
}

impl Field {
    /// An unsigned number with its lowest byte first, whose counts are units.
    #[must_use]
    pub fn new(what: What, start: u8, width: u8) -> Self {
        let none = None;
        Field {
            what,
            start,
            width,
            signed: false,
            order: ByteOrder::Little,
            scale: 1.0,
            offset: 0.0,
            exponent: None,
            missing: None,
            modulus: None,
            mask: none,
            expected: none,
        }
    }

    /// Values before it starts again.
    pub(super) fn modulus(&self) -> u64 {
        self.modulus.unwrap_or(if self.width < 64 { 1 << self.width } else { u64::MAX })
    }

    /// Bits that it takes with its exponent.
    fn end(&self) -> u32 {
        let own = u32::from(self.start) + u32::from(self.width);
        own.max(self.exponent.map_or(0, |start| u32::from(start) + 8))
    }
}

impl FrameLayout {
    /// The identifier; `None` if it has too many bits.
    #[must_use]
    pub fn can_id(&self) -> Option<CanId> {
        let id = if self.extended {
            CanId::Extended(self.id)
        } else {
            CanId::Standard(u16::try_from(self.id).ok()?)
        };
        id.is_valid().then_some(id)
    }

    /// Bytes that its fields take.
    pub(super) fn length(&self) -> usize {
        self.fields.iter().map(Field::end).max().unwrap_or(0).div_ceil(8) as usize
    }

    /// Whether no sample is complete without it.
    pub(super) fn is_needed(&self) -> bool {
        !self.optional
    }
}

impl CanLayout {
    /// What is wrong with the table, in words; none if it can be used.
    #[must_use]
    pub fn faults(&self) -> Vec<String> {
        let mut faults = Vec::new();
        for (index, frame) in self.frames.iter().enumerate() {
            frame.look(&mut faults);
            if self.frames.iter().take(index).any(|other| other.can_id() == frame.can_id()) {
                faults.push(format!("frame 0x{:X}: an identifier that no other has", frame.id));
            }
        }
        let count = |what: What| self.fields().filter(|field| field.what == what).count();
        let whole = |parts: &[What]| parts.iter().all(|part| count(*part) == 1);
        let turns = [whole(&RATE), whole(&ANGLE), whole(&TURN)];
        if turns.iter().filter(|own| **own).count() != 1 {
            faults.push("one of rate, angle (x, y, z) and turn (w, x, y, z), once".to_owned());
        }
        if whole(&ACCEL) == whole(&VELOCITY) {
            faults.push("one of accel and velocity (x, y, z), once".to_owned());
        }
        let motion = RATE.iter().chain(&ANGLE).chain(&TURN).chain(&ACCEL).chain(&VELOCITY);
        let told = motion.filter(|what| count(**what) > 0).count();
        let used = 6 + usize::from(turns[2]);
        if faults.is_empty() && told != used {
            faults.push("no other parts of motion beside the whole ones".to_owned());
        }
        if count(What::Time) > 1 {
            faults.push("one field of time at most".to_owned());
        }
        faults
    }

    /// All fields of all frames.
    pub(super) fn fields(&self) -> impl Iterator<Item = &Field> {
        self.frames.iter().flat_map(|frame| &frame.fields)
    }
}

impl FrameLayout {
    fn look(&self, faults: &mut Vec<String>) {
        let mut expect = |good: bool, expected: &str| {
            if !good {
                faults.push(format!("frame 0x{:X}: {expected}", self.id));
            }
        };
        expect(self.can_id().is_some(), "an identifier of 11 bits, or 29 with extended = true");
        expect(self.length() <= 8, "fields within its eight bytes");
        for field in &self.fields {
            expect((1..=64).contains(&field.width), "a width of 1 to 64 bits");
            let scaled = field.scale.is_finite() && field.scale != 0.0 && field.offset.is_finite();
            expect(scaled, "a scale other than 0 and a finite offset");
            expect(field.modulus.is_none_or(|own| own > 1), "a modulus above 1");
            let clock = field.what == What::Time && (field.signed || field.scale < 0.0);
            expect(!clock, "a time that is neither signed nor runs backwards");
            expect(!(self.optional && field.is_vital()), "motion and time in frames not optional");
        }
    }
}

impl Field {
    /// Whether no sample can be without it.
    fn is_vital(&self) -> bool {
        let rare = [What::Counter, What::Temperature, What::Status];
        !rare.contains(&self.what) && !UTC.contains(&self.what)
    }
}
