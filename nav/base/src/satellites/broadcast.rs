//! What satellites broadcast of their orbits, their clocks and the ionosphere.

use serde::{Deserialize, Serialize};

use super::signal::SatelliteId;
use crate::utc::GpsTime;

/// The message that a record was broadcast in. It says which combination of signals the clock refers to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub enum BroadcastKind {
    /// GPS and QZSS L1 C/A; also NavIC and SBAS in files.
    Lnav,
    /// Galileo E1-B and E5b-I: clock of E1 and E5b.
    Inav,
    /// Galileo E5a-I: clock of E1 and E5a.
    Fnav,
    /// BeiDou D1, satellites in medium and inclined orbits: clock of B3I.
    D1,
    /// BeiDou D2, geostationary satellites: clock of B3I.
    D2,
    /// GLONASS strings.
    Fdma,
}

/// Clock of a satellite against its system's time: `a0 + a1 t + a2 t^2`, t since the reference time.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ClockPolynomial {
    /// Reference time.
    pub reference: GpsTime,
    /// Offset, s: positive when ahead.
    pub a0: f64,
    /// Drift, s/s.
    pub a1: f64,
    /// Ageing, s/s^2.
    pub a2: f64,
}

/// Keplerian elements with their rates and harmonic corrections (IS-GPS-200N, table 20-II); radians, seconds, metres.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct KeplerOrbit {
    /// Reference time.
    pub reference: GpsTime,
    /// Square root of the semi-major axis, m^1/2.
    pub sqrt_a: f64,
    /// Eccentricity.
    pub eccentricity: f64,
    /// Mean anomaly at the reference time.
    pub m0: f64,
    /// Correction of the mean motion, rad/s.
    pub delta_n: f64,
    /// Argument of perigee.
    pub omega: f64,
    /// Longitude of the ascending node at the start of the week.
    pub omega0: f64,
    /// Its rate, rad/s.
    pub omega_dot: f64,
    /// Inclination at the reference time.
    pub i0: f64,
    /// Its rate, rad/s.
    pub i_dot: f64,
    /// Cosine and sine terms of the argument of latitude, rad.
    pub cuc: f64,
    /// See `cuc`.
    pub cus: f64,
    /// Cosine and sine terms of the radius, m.
    pub crc: f64,
    /// See `crc`.
    pub crs: f64,
    /// Cosine and sine terms of the inclination, rad.
    pub cic: f64,
    /// See `cic`.
    pub cis: f64,
}

/// A record of GPS, Galileo, QZSS, BeiDou or NavIC. All times are GPS time.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct KeplerRecord {
    /// The satellite.
    pub satellite: SatelliteId,
    /// The message it came in.
    pub kind: BroadcastKind,
    /// Issue of the orbit: IODE, IODnav or AODE.
    pub issue: u16,
    /// Issue of the clock: IODC, IODnav or AODC.
    pub clock_issue: u16,
    /// Health as broadcast, zero when healthy; Galileo: the nine bits of RINEX.
    pub health: u16,
    /// Its claimed accuracy (URA, SISA), m; `None` where none is promised.
    pub accuracy: Option<f64>,
    /// Group delays, s: T_GD; BGD(E1,E5a) and BGD(E1,E5b); TGD1 (B1I) and TGD2 (B2I).
    pub group_delays: [f64; 2],
    /// The orbit.
    pub orbit: KeplerOrbit,
    /// The clock, without its relativistic term.
    pub clock: ClockPolynomial,
    /// When it was transmitted, where that is known.
    pub transmitted: Option<GpsTime>,
}

/// A record of GLONASS: a state to be integrated from (ICD L1, L2, edition 5.1, table 4.5). Axes of PZ-90.11, which are
/// those of WGS-84 to centimetres. All times are GPS time.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct GlonassRecord {
    /// The satellite.
    pub satellite: SatelliteId,
    /// Frequency channel, -7 to 6.
    pub channel: i8,
    /// Reference time.
    pub reference: GpsTime,
    /// Position, m.
    pub position: [f64; 3],
    /// Velocity, m/s.
    pub velocity: [f64; 3],
    /// Acceleration by sun and moon, m/s^2.
    pub acceleration: [f64; 3],
    /// Clock offset -tau_n, s: positive when ahead of the system's time.
    pub clock_offset: f64,
    /// Relative frequency deviation gamma_n.
    pub clock_drift: f64,
    /// Health as broadcast, zero when healthy.
    pub health: u8,
    /// Age of the data, days.
    pub age_days: f64,
}

/// One record of whatever satellite.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum BroadcastRecord {
    /// Keplerian elements.
    Kepler(KeplerRecord),
    /// A state of GLONASS.
    Glonass(GlonassRecord),
}

impl BroadcastRecord {
    /// The satellite it is of.
    #[must_use]
    pub fn satellite(&self) -> SatelliteId {
        match self {
            Self::Kepler(record) => record.satellite,
            Self::Glonass(record) => record.satellite,
        }
    }

    /// The instant its orbit refers to.
    #[must_use]
    pub fn reference(&self) -> GpsTime {
        match self {
            Self::Kepler(record) => record.orbit.reference,
            Self::Glonass(record) => record.reference,
        }
    }
}

/// The coefficients of a model of the ionosphere.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum IonosphereModel {
    /// Klobuchar's eight of GPS (IS-GPS-200N, 20.3.3.5.1.7): s, s/semicircle, ...
    Klobuchar {
        /// Amplitude.
        alpha: [f64; 4],
        /// Period.
        beta: [f64; 4],
    },
    /// Effective ionisation level of Galileo's NeQuick-G (OS SIS ICD 2.1, 5.1.6): sfu, sfu/deg, sfu/deg^2.
    NeQuickG {
        /// a_i0, a_i1, a_i2.
        ionisation: [f64; 3],
    },
}
