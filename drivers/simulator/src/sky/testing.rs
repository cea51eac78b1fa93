//! What the tests of the sky have in common.

use insd_base::GpsTime;
use insd_base::satellites::KeplerOrbit;

/// An orbit like one of GPS.
pub(crate) fn orbit() -> KeplerOrbit {
    KeplerOrbit {
        reference: GpsTime::from_week(2399, 345_600_000_000_000),
        sqrt_a: 5153.6,
        eccentricity: 0.012,
        m0: 1.0,
        delta_n: 4.5e-9,
        omega: 0.7,
        omega0: -2.0,
        omega_dot: -8e-9,
        i0: 0.96,
        i_dot: 1e-10,
        cuc: 1e-6,
        cus: 8e-6,
        crc: 200.0,
        crs: -30.0,
        cic: 1e-7,
        cis: -5e-8,
    }
}
