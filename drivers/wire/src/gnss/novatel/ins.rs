//! INSPVA, INSPVAS and INSPVAX: what a SPAN system says of the ship.

use insd_base::units::{DEG, wrap_two_pi};

use super::as_body;
use crate::layout::{Each, layout, le};

layout! {
    /// INSPVA, and INSPVAS, which has the short header.
    InsPva, 88 bytes;
    /// GPS week, without rollover.
    0 week: u32 = le();
    /// Time of the week, s.
    4 time_of_week: Option<f64> = le::<f64>().unless(f64::NAN, 1.0);
    /// Latitude, rad.
    12 latitude: f64 = le::<f64>().steps(DEG).within(90.0 * DEG, "lat");
    /// Longitude, rad.
    20 longitude: f64 = le::<f64>().steps(DEG).within(180.0 * DEG, "lon");
    /// Height above the ellipsoid, m.
    28 height: Option<f64> = le::<f64>().unless(f64::NAN, 1.0);
    /// Velocity to the north, the east and **up**, m/s.
    36 velocity: [Option<f64>; 3] = Each(le::<f64>().unless(f64::NAN, 1.0));
    /// Roll, rad, about the axis forward, as it stands.
    60 roll: Option<f64> = le::<f64>().unless(f64::NAN, DEG);
    /// Pitch, rad, about the axis to starboard, as it stands.
    68 pitch: Option<f64> = le::<f64>().unless(f64::NAN, DEG);
    /// Heading, rad clockwise from true north, as it stands.
    76 azimuth: Option<f64> = le::<f64>().unless(f64::NAN, DEG);
    /// Status: 3 good, 6 free of satellites, 7 aligned and not yet moved, 2 high variance, others not ready.
    84 status: u32 = le();
}
as_body!(InsPva);

layout! {
    /// INSPVAX.
    InsPvax, 126 bytes;
    /// Status as in INSPVA.
    0 status: u32 = le();
    /// Position type.
    4 kind: u32 = le();
    /// Latitude, rad.
    8 latitude: f64 = le::<f64>().steps(DEG).within(90.0 * DEG, "lat");
    /// Longitude, rad.
    16 longitude: f64 = le::<f64>().steps(DEG).within(180.0 * DEG, "long");
    /// Height above mean sea level, m.
    24 height_msl: Option<f64> = le::<f64>().unless(f64::NAN, 1.0);
    /// Height of the geoid above the ellipsoid, m.
    32 undulation: Option<f64> = le::<f32>().unless(f32::NAN, 1.0);
    /// Velocity to the north, the east and **up**, m/s.
    36 velocity: [Option<f64>; 3] = Each(le::<f64>().unless(f64::NAN, 1.0));
    /// Roll, pitch and heading, rad, as in INSPVA.
    60 attitude: [Option<f64>; 3] = Each(le::<f64>().unless(f64::NAN, DEG));
    /// 1-sigma of latitude, longitude and height, m.
    84 position_std: [Option<f64>; 3] = Each(le::<f32>().unless(f32::NAN, 1.0));
    /// 1-sigma of the velocity, m/s.
    96 velocity_std: [Option<f64>; 3] = Each(le::<f32>().unless(f32::NAN, 1.0));
    /// 1-sigma of roll, pitch and heading, rad.
    108 attitude_std: [Option<f64>; 3] = Each(le::<f32>().unless(f32::NAN, DEG));
    /// Extended solution status.
    120 extended: u32 = le();
    /// Seconds since the last update.
    124 since_update: u16 = le();
}
as_body!(InsPvax);

/// Whether the inertial system stands behind its heading: good, good and free of satellites, or aligned.
fn is_good(status: u32) -> bool {
    matches!(status, 3 | 6 | 7)
}

impl InsPva {
    /// True heading, rad, unless the system is not aligned.
    #[must_use]
    pub fn heading(&self) -> Option<f64> {
        self.azimuth.filter(|_| is_good(self.status)).map(wrap_two_pi)
    }
}

impl InsPvax {
    /// True heading, rad, unless the system is not aligned.
    #[must_use]
    pub fn heading(&self) -> Option<f64> {
        self.attitude[2].filter(|_| is_good(self.status)).map(wrap_two_pi)
    }

    /// Its 1-sigma, rad.
    #[must_use]
    pub fn heading_std(&self) -> Option<f64> {
        self.attitude_std[2].filter(|std| *std > 0.0)
    }
}
