//! From four beams to the axes of the instrument.

use std::f64::consts::SQRT_2;

use crate::log::{LogFrame, LogReading};

/// How the beams of an instrument stand: four of them, each inclined by the same angle, beams 1 and 2
/// in one plane and 3 and 4 in the plane across.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Geometry {
    /// Angle between a beam and the axis of the instrument, rad.
    pub angle: f64,
    /// Whether the transducers face apart (convex); else they face each other.
    pub convex: bool,
    /// Whether the instrument looks up.
    pub up: bool,
}

/// Velocity in the axes of the instrument: x from beam 1 to beam 2, y from beam 4 to beam 3, z towards
/// the face of the transducers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Janus {
    /// Along x, m/s.
    pub x: f64,
    /// Along y, m/s.
    pub y: f64,
    /// Along z, m/s.
    pub z: f64,
    /// How much the beams disagree, scaled so that its noise is that of x and y, m/s; `None` if one
    /// beam was missing.
    pub error: Option<f64>,
}

impl Geometry {
    /// Velocity of what reflects the sound, from its components along the beams, positive towards the
    /// transducer. With theta the angle of the beams and c = 1 for convex, -1 for concave transducers:
    ///
    /// ```text
    /// x = c a (b1 - b2)   y = c a (b4 - b3)   z = b (b1 + b2 + b3 + b4)   e = d (b1 + b2 - b3 - b4)
    /// a = 1 / (2 sin theta)   b = 1 / (4 cos theta)   d = a / sqrt 2
    /// ```
    ///
    /// One missing beam is replaced by what makes the error zero, as the pairs of beams see the same z:
    /// b1 = b3 + b4 - b2. Two missing beams give nothing. Assumes that the velocity is the same where
    /// all beams end.
    ///
    /// Source: Teledyne RDI, ADCP Coordinate Transformation: Formulas and Calculations (951-6079-00,
    /// January 2010), sections 3 and 4; formulas as quoted by the R package oce, but for z, which is
    /// positive away from the face there.
    ///
    /// Tests: `the_beams_of_any_velocity_give_it_back`, `three_beams_give_the_same_as_four`.
    #[must_use]
    pub fn instrument(&self, beams: [Option<f64>; 4]) -> Option<Janus> {
        let (beams, complete) = match beams {
            [Some(b1), Some(b2), Some(b3), Some(b4)] => ([b1, b2, b3, b4], true),
            [None, Some(b2), Some(b3), Some(b4)] => ([b3 + b4 - b2, b2, b3, b4], false),
            [Some(b1), None, Some(b3), Some(b4)] => ([b1, b3 + b4 - b1, b3, b4], false),
            [Some(b1), Some(b2), None, Some(b4)] => ([b1, b2, b1 + b2 - b4, b4], false),
            [Some(b1), Some(b2), Some(b3), None] => ([b1, b2, b3, b1 + b2 - b3], false),
            _ => return None,
        };
        let [b1, b2, b3, b4] = beams;
        let c = if self.convex { 1.0 } else { -1.0 };
        let a = 1.0 / (2.0 * self.angle.sin());
        let b = 1.0 / (4.0 * self.angle.cos());
        let d = a / SQRT_2;
        Some(Janus {
            x: c * a * (b1 - b2),
            y: c * a * (b4 - b3),
            z: b * (b1 + b2 + b3 + b4),
            error: complete.then_some(d * (b1 + b2 - b3 - b4)),
        })
    }

    /// A reading along the beams as one in the axes of the instrument: the velocity of the ship, while
    /// beams tell that of the bottom. `None` for other frames, and with less than three beams.
    #[must_use]
    pub fn instrument_reading(&self, reading: &LogReading) -> Option<LogReading> {
        if reading.frame != LogFrame::Beam {
            return None;
        }
        let Janus { x, y, z, .. } = self.instrument(reading.velocity)?;
        let velocity = [Some(-x), Some(-y), Some(-z), None];
        Some(LogReading { velocity, frame: LogFrame::Instrument, ..*reading })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::FRAC_PI_6;

    const GEOMETRY: Geometry = Geometry { angle: FRAC_PI_6, convex: true, up: false };
    const VELOCITY: [f64; 3] = [1.2, -3.4, 0.5];

    /// Components towards the transducer: a beam that leaves along n sees -n.v.
    fn beams(geometry: Geometry) -> [f64; 4] {
        let (sin, cos) = geometry.angle.sin_cos();
        let c = if geometry.convex { 1.0 } else { -1.0 };
        let leaves = [[-c, 0.0], [c, 0.0], [0.0, c], [0.0, -c]];
        let [x, y, z] = VELOCITY;
        leaves.map(|[nx, ny]| -(sin * (nx * x + ny * y) - cos * z))
    }

    fn is_velocity(janus: Janus) {
        for (found, expected) in [janus.x, janus.y, janus.z].iter().zip(VELOCITY) {
            assert!((found - expected).abs() < 1e-12, "{janus:?}");
        }
    }

    #[test]
    fn the_beams_of_any_velocity_give_it_back() {
        for convex in [true, false] {
            let geometry = Geometry { convex, angle: 0.35, ..GEOMETRY };
            let janus = geometry.instrument(beams(geometry).map(Some)).unwrap();
            is_velocity(janus);
            assert!(janus.error.unwrap().abs() < 1e-12);
        }
    }

    #[test]
    fn three_beams_give_the_same_as_four() {
        for missing in 0..4 {
            let mut beams = beams(GEOMETRY).map(Some);
            beams[missing] = None;
            let janus = GEOMETRY.instrument(beams).unwrap();
            is_velocity(janus);
            assert_eq!(janus.error, None);
            beams[(missing + 1) % 4] = None;
            assert_eq!(GEOMETRY.instrument(beams), None);
        }
    }

    #[test]
    fn a_beam_that_disagrees_shows_in_the_error() {
        let [b1, b2, b3, b4] = beams(GEOMETRY);
        let janus = GEOMETRY.instrument([b1 + 0.1, b2, b3, b4].map(Some)).unwrap();
        assert!((janus.error.unwrap() - 0.1 / SQRT_2).abs() < 1e-12);
    }
}
