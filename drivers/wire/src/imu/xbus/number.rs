//! The four formats of real numbers, chosen for each output in the device.

use crate::binary::{BinaryFault, Reader, Writer, scaled};

/// Steps per unit of a 12.20 number.
const FP1220: f64 = 1_048_576.0;
/// Steps per unit of a 16.32 number.
const FP1632: f64 = 4_294_967_296.0;
/// Last step of a 48-bit number.
const LAST_OF_48: i64 = (1 << 47) - 1;

/// Format of real numbers: the two lowest bits of a data identifier.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Precision {
    /// IEEE 754, 32 bits.
    Float32,
    /// Fixed point with steps of 2^-20, 32 bits. Coarse for a delta quaternion: a step is 2e-6 rad.
    Fp1220,
    /// Fixed point with steps of 2^-32, 48 bits.
    Fp1632,
    /// IEEE 754, 64 bits.
    Float64,
}

impl Precision {
    /// All of them.
    pub const ALL: [Precision; 4] =
        [Precision::Float32, Precision::Fp1220, Precision::Fp1632, Precision::Float64];

    pub(super) fn of_identifier(identifier: u16) -> Self {
        match identifier & 3 {
            0 => Precision::Float32,
            1 => Precision::Fp1220,
            2 => Precision::Fp1632,
            _ => Precision::Float64,
        }
    }

    pub(super) fn bits(self) -> u16 {
        match self {
            Precision::Float32 => 0,
            Precision::Fp1220 => 1,
            Precision::Fp1632 => 2,
            Precision::Float64 => 3,
        }
    }

    /// Bytes of a number.
    pub(super) fn size(self) -> u8 {
        match self {
            Precision::Float32 | Precision::Fp1220 => 4,
            Precision::Fp1632 => 6,
            Precision::Float64 => 8,
        }
    }

    pub(super) fn read(self, data: &mut Reader<'_>) -> Result<f64, BinaryFault> {
        Ok(match self {
            Precision::Float32 => data.be_f32()?.into(),
            Precision::Fp1220 => f64::from(data.be_i32()?) / FP1220,
            Precision::Fp1632 => {
                // the fraction stands before the whole part
                let fraction = f64::from(data.be_u32()?) / FP1632;
                f64::from(data.be_i16()?) + fraction
            }
            Precision::Float64 => data.be_f64()?,
        })
    }

    /// Fixed point numbers are saturated.
    pub(super) fn write(self, data: &mut Writer, value: f64) {
        match self {
            Precision::Float32 => data.be_f32(value as f32),
            Precision::Fp1220 => {
                let steps = scaled(value, 1.0 / FP1220);
                data.be_i32(steps.clamp(i32::MIN.into(), i32::MAX.into()) as i32)
            }
            Precision::Fp1632 => {
                let steps = scaled(value, 1.0 / FP1632).clamp(-LAST_OF_48 - 1, LAST_OF_48);
                data.be_u32(steps as u32).be_i16((steps >> 32) as i16)
            }
            Precision::Float64 => data.be_f64(value),
        };
    }
}
