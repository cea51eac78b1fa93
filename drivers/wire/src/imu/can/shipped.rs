//! Tables of makers.
//!
//! **Xsens** MTi 600, Avior and Sirius, XCDI messages under their default identifiers of 11 bits, big
//! endian. Source: the maker's database `xsens.dbc`, as published with its CAN driver for ROS
//! (github.com/jiminghe/Xsens_MTi_CAN_ROS_Driver), and MT CAN Protocol Documentation MT1604P. The
//! database gives the unit of SampleTime as us, as does MT1604P; the driver, which was tried with an
//! MTi-680, counts it in 0.1 ms like the item of Xbus that it stands for, and so does this table. It
//! must be switched on in the device; GroupCounter, StatusWord and Temperature may be. Not verified
//! against a device.
//!
//! | table | angular rate | specific force |
//! |---|---|---|
//! | `xsens` | RateOfTurn: 1/512 rad/s (0.11 deg/s), to +-63.9 rad/s | Acceleration: 1/256 m/s^2 (0.4 mg), to +-127.9 m/s^2 |
//! | `xsens_increments` | DeltaQ: 1/32767 of a half angle, 6.1e-5 rad a sample: at 100 Hz 0.35 deg/s | DeltaV: 2^-n m/s with n told in the frame, by the manual 8 at 1 Hz to 17 (7.6e-6 m/s, to +-0.25 m/s) at 400 Hz |
//!
//! **SBG** Systems, all products: IMU_INFO, IMU_ACCEL and IMU_GYRO under their default identifiers,
//! little endian. Source: `can/sbgCan.dbc` and `doc/canProtocol.md` of the maker's SDK
//! (github.com/SBG-Systems/sbgECom, MIT). All three must be sent at the rate of the IMU; they are
//! switched off as delivered. IMU_DELTA_VEL and IMU_DELTA_ANGLE are deprecated doubles of the latter
//! two. Their order, by identifier, is assumed. Not verified against a device.
//!
//! | table | angular rate | specific force |
//! |---|---|---|
//! | `sbg` | 0.001 rad/s (0.057 deg/s), to +-32.7 rad/s | 0.01 m/s^2 (1 mg), to +-327 m/s^2 |
//!
//! **These steps are coarse**: a step of 1 mg is a tilt of 0.06 deg, and a step of 0.057 deg/s is 200
//! deg/h, more than thirteen times the rotation of the Earth. Noise and motion smear the rounding, but a
//! heading from the rotation of the Earth is beyond it. The serial line of the same device has none of
//! it and is to be preferred; the maker of the latter says so too.

use schemars::JsonSchema;
use serde::de::value::MapAccessDeserializer;
use serde::de::{MapAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize, de};

use super::layout::{ACCEL, ByteOrder, CanLayout, Field, FrameLayout, RATE, TURN, VELOCITY, What};

/// A table of a maker.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Shipped {
    /// Xsens: SampleTime, RateOfTurn, Acceleration.
    Xsens,
    /// Xsens: SampleTime, DeltaV, DeltaQ.
    XsensIncrements,
    /// SBG Systems: IMU_INFO, IMU_ACCEL, IMU_GYRO.
    Sbg,
}

/// A table of a maker by its name, or one of one's own.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
#[serde(untagged)]
pub enum LayoutChoice {
    /// Of a maker.
    Shipped(Shipped),
    /// One's own.
    Own(CanLayout),
}

/// Bits 8 to 13 of the status word of Xsens: an accelerometer or gyro is out of its range.
const XSENS_CLIPPED: u64 = 0x3F00;
/// Bits of IMU_STATUS of SBG of which each must be set, as in the logs of the serial line.
const SBG_GOOD: u64 = 0x03FF;

impl Shipped {
    /// The table.
    #[must_use]
    pub fn layout(self) -> CanLayout {
        let frames = match self {
            Shipped::Xsens => {
                let rate = xsens(0x32, &RATE, 1.0 / 512.0);
                xsens_frames([rate, xsens(0x34, &ACCEL, 1.0 / 256.0)])
            }
            Shipped::XsensIncrements => {
                let mut velocity = xsens(0x31, &VELOCITY, 1.0);
                velocity.fields.iter_mut().for_each(|field| field.exponent = Some(48));
                xsens_frames([velocity, xsens(0x33, &TURN, 1.0 / 32767.0)])
            }
            Shipped::Sbg => vec![sbg_info(), sbg(0x121, ACCEL, 0.01), sbg(0x122, RATE, 0.001)],
        };
        CanLayout { frames }
    }
}

impl LayoutChoice {
    /// The table.
    #[must_use]
    pub fn layout(&self) -> CanLayout {
        match self {
            LayoutChoice::Shipped(shipped) => shipped.layout(),
            LayoutChoice::Own(layout) => layout.clone(),
        }
    }
}

fn frame(id: u32, optional: bool, fields: Vec<Field>) -> FrameLayout {
    FrameLayout { id, extended: false, optional, fields }
}

fn xsens_frames([first, second]: [FrameLayout; 2]) -> Vec<FrameLayout> {
    let field =
        |what, width, scale| Field { order: ByteOrder::Big, scale, ..Field::new(what, 0, width) };
    let status =
        Field { mask: Some(XSENS_CLIPPED), expected: Some(0), ..field(What::Status, 32, 1.0) };
    let temperature = Field { signed: true, ..field(What::Temperature, 16, 1.0 / 256.0) };
    vec![
        frame(0x05, false, vec![field(What::Time, 32, 1e-4)]),
        frame(0x06, true, vec![field(What::Counter, 16, 1.0)]),
        frame(0x11, true, vec![status]),
        first,
        second,
        frame(0x51, true, vec![temperature]),
    ]
}

fn xsens(id: u32, parts: &[What], scale: f64) -> FrameLayout {
    numbers(id, parts, scale, ByteOrder::Big)
}

fn sbg(id: u32, parts: [What; 3], scale: f64) -> FrameLayout {
    numbers(id, &parts, scale, ByteOrder::Little)
}

/// Signed numbers of 16 bits one after the other.
fn numbers(id: u32, parts: &[What], scale: f64, order: ByteOrder) -> FrameLayout {
    let fields = parts.iter().zip(0_u8..).map(|(what, index)| Field {
        signed: true,
        order,
        scale,
        ..Field::new(*what, 16 * index, 16)
    });
    frame(id, false, fields.collect())
}

fn sbg_info() -> FrameLayout {
    let time = Field { scale: 1e-6, ..Field::new(What::Time, 0, 32) };
    let good = Some(SBG_GOOD);
    let status = Field { mask: good, expected: good, ..Field::new(What::Status, 32, 16) };
    let temperature = Field { signed: true, scale: 0.01, ..Field::new(What::Temperature, 48, 16) };
    frame(0x120, false, vec![time, status, temperature])
}

impl<'de> Deserialize<'de> for LayoutChoice {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(Either)
    }
}

/// A name or a table, each with faults of its own.
struct Either;

impl<'de> Visitor<'de> for Either {
    type Value = LayoutChoice;

    fn expecting(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("the name of a table (xsens, xsens_increments, sbg), or a table")
    }

    fn visit_str<E: de::Error>(self, name: &str) -> Result<Self::Value, E> {
        let name = de::value::StrDeserializer::<E>::new(name);
        Shipped::deserialize(name).map(LayoutChoice::Shipped)
    }

    fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Self::Value, A::Error> {
        CanLayout::deserialize(MapAccessDeserializer::new(map)).map(LayoutChoice::Own)
    }
}
