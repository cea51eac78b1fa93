//! Fields that several blocks have in common: numbers that may say "do not use", mode and error.

use insd_base::FixQuality;

use crate::binary::{BinaryFault, Reader, Writer};

/// The number that says that there is none.
const NONE: f32 = -2e10;

/// The next number, unless it is the one that must not be used or none at all.
pub(super) fn f32(reader: &mut Reader<'_>) -> Result<Option<f32>, BinaryFault> {
    let value = reader.le_f32()?;
    Ok((value.is_finite() && value != NONE).then_some(value))
}

/// The same with double precision.
pub(super) fn f64(reader: &mut Reader<'_>) -> Result<Option<f64>, BinaryFault> {
    let value = reader.le_f64()?;
    Ok((value.is_finite() && value != f64::from(NONE)).then_some(value))
}

/// Appends a number or that there is none.
pub(super) fn put_f32(writer: &mut Writer, value: Option<f32>) {
    writer.le_f32(value.unwrap_or(NONE));
}

/// Appends a number of double precision or that there is none.
pub(super) fn put_f64(writer: &mut Writer, value: Option<f64>) {
    writer.le_f64(value.unwrap_or(NONE.into()));
}

/// A count in hundredths or the like; all ones says that there is none.
pub(super) fn u16(reader: &mut Reader<'_>, unit: f64) -> Result<Option<f64>, BinaryFault> {
    let raw = reader.le_u16()?;
    Ok((raw != u16::MAX).then(|| f64::from(raw) * unit))
}

/// Appends such a count, saturated below the value that says none.
pub(super) fn put_u16(writer: &mut Writer, value: Option<f64>, unit: f64) {
    let steps = |value: f64| ((value / unit).round() as u16).min(u16::MAX - 1);
    writer.le_u16(value.map_or(u16::MAX, steps));
}

/// Bits 0 to 3 of `Mode`: how the position was computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum SbfSolution {
    /// None; the error tells why (0).
    None,
    /// Stand-alone (1).
    StandAlone,
    /// Differential (2).
    Differential,
    /// Fixed location, typed in or averaged (3).
    FixedLocation,
    /// RTK with fixed ambiguities (4).
    RtkFixed,
    /// RTK with float ambiguities (5).
    RtkFloat,
    /// Aided by SBAS (6).
    Sbas,
    /// RTK with fixed ambiguities from a base that moves (7).
    MovingBaseFixed,
    /// RTK with float ambiguities from a base that moves (8).
    MovingBaseFloat,
    /// Precise point positioning (10).
    PrecisePoint,
    /// A value that the document does not define: 9, or beyond 10.
    Reserved(u8),
}

/// `Mode` and `Error` of the PVT blocks.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct SbfMode {
    /// Type of the solution.
    pub solution: SbfSolution,
    /// Bit 6: a fixed location is still being determined.
    pub determining: bool,
    /// Bit 7: height is held, not computed.
    pub two_dimensional: bool,
    /// `Error`: 0, or why there is no solution. 1 measurements, 2 ephemerides, 3 dilution of
    /// precision, 4 residuals, 5 no convergence, 6 outliers, 7 export laws, 8 corrections, 9 base
    /// coordinates, 10 ambiguities not fixed.
    pub error: u8,
}

/// The solutions by their value.
const SOLUTIONS: [SbfSolution; 11] = [
    SbfSolution::None,
    SbfSolution::StandAlone,
    SbfSolution::Differential,
    SbfSolution::FixedLocation,
    SbfSolution::RtkFixed,
    SbfSolution::RtkFloat,
    SbfSolution::Sbas,
    SbfSolution::MovingBaseFixed,
    SbfSolution::MovingBaseFloat,
    SbfSolution::Reserved(9),
    SbfSolution::PrecisePoint,
];

impl SbfSolution {
    fn from_raw(raw: u8) -> Self {
        SOLUTIONS.get(usize::from(raw)).copied().unwrap_or(SbfSolution::Reserved(raw))
    }

    /// The value on the wire.
    #[must_use]
    pub fn raw(self) -> u8 {
        match self {
            SbfSolution::Reserved(raw) => raw & 15,
            known => (0..).zip(SOLUTIONS).find(|(_, one)| *one == known).map_or(0, |(raw, _)| raw),
        }
    }
}

impl SbfMode {
    /// The mode of a three-dimensional solution without error, or of none.
    #[must_use]
    pub fn of(quality: FixQuality) -> Self {
        let solution = match quality {
            FixQuality::Invalid | FixQuality::Estimated => SbfSolution::None,
            FixQuality::Autonomous | FixQuality::Simulated => SbfSolution::StandAlone,
            FixQuality::Differential => SbfSolution::Differential,
            FixQuality::Precise => SbfSolution::PrecisePoint,
            FixQuality::RtkFixed => SbfSolution::RtkFixed,
            FixQuality::RtkFloat => SbfSolution::RtkFloat,
            FixQuality::Manual => SbfSolution::FixedLocation,
        };
        let error = u8::from(solution == SbfSolution::None);
        SbfMode { solution, determining: false, two_dimensional: false, error }
    }

    /// Whether there is a solution.
    #[must_use]
    pub fn is_valid(self) -> bool {
        self.error == 0 && self.solution != SbfSolution::None
    }

    /// What the receiver says of its fix; `None` for a solution that the document does not define.
    ///
    /// A position by a moving base is no better than the base's own, so that it counts as
    /// differential; so does precise point positioning, as [`FixQuality::Precise`] is the military
    /// service.
    #[must_use]
    pub fn quality(self) -> Option<FixQuality> {
        Some(match self.solution {
            _ if !self.is_valid() => FixQuality::Invalid,
            SbfSolution::StandAlone => FixQuality::Autonomous,
            SbfSolution::FixedLocation => FixQuality::Manual,
            SbfSolution::RtkFixed => FixQuality::RtkFixed,
            SbfSolution::RtkFloat => FixQuality::RtkFloat,
            SbfSolution::Reserved(_) => return None,
            _ => FixQuality::Differential,
        })
    }

    pub(super) fn read(reader: &mut Reader<'_>) -> Result<Self, BinaryFault> {
        Ok(SbfMode::of_bytes(reader.array()?))
    }

    /// By the bytes of mode and error.
    pub(super) fn of_bytes([mode, error]: [u8; 2]) -> Self {
        SbfMode {
            solution: SbfSolution::from_raw(mode & 15),
            determining: mode & 0x40 != 0,
            two_dimensional: mode & 0x80 != 0,
            error,
        }
    }

    pub(super) fn write(self, writer: &mut Writer) {
        writer.put(&self.bytes());
    }

    /// The bytes of mode and error.
    pub(super) fn bytes(self) -> [u8; 2] {
        let flags = u8::from(self.determining) << 6 | u8::from(self.two_dimensional) << 7;
        [self.solution.raw() | flags, self.error]
    }
}
