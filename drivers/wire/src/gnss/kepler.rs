//! Where the elements of an orbit and a clock stand in the pages of a message, put end to end.

use insd_base::GpsTime;
use insd_base::satellites::{ClockPolynomial, KeplerOrbit};

use super::bits::{Bits, Field};

/// Nanoseconds of a second.
pub(super) const SECOND: i64 = 1_000_000_000;

/// Seconds of a week.
const WEEK: f64 = 604_800.0;

/// Least root of a semi-major axis, m^1/2: that of an orbit of 16 000 km, below all satellites of navigation.
const LEAST_ROOT: f64 = 4000.0;

/// Greatest eccentricity; the two Galileo satellites that missed their orbit have 0.16.
const GREATEST_ECCENTRICITY: f64 = 0.5;

/// Two to the power of minus so much.
pub(super) const fn half(power: i32) -> f64 {
    f64::from_bits(((1023 - power as i64) as u64) << 52)
}

/// The same in semicircles, as rad.
pub(super) const fn semi(power: i32) -> f64 {
    half(power) * std::f64::consts::PI
}

/// The fields of one message.
pub(super) struct Layout {
    /// Of the week, s.
    pub(super) toe: Field,
    pub(super) sqrt_a: Field,
    pub(super) eccentricity: Field,
    pub(super) m0: Field,
    pub(super) delta_n: Field,
    pub(super) omega: Field,
    pub(super) omega0: Field,
    pub(super) omega_dot: Field,
    pub(super) i0: Field,
    pub(super) i_dot: Field,
    /// C_uc and C_us.
    pub(super) latitude: [Field; 2],
    /// C_rc and C_rs.
    pub(super) radius: [Field; 2],
    /// C_ic and C_is.
    pub(super) inclination: [Field; 2],
    /// Of the week, s.
    pub(super) toc: Field,
    /// a_f0, a_f1, a_f2.
    pub(super) clock: [Field; 3],
    /// How far the system's time is behind GPS time, s.
    pub(super) behind: i64,
}

impl Layout {
    /// The orbit, with the reference time that is nearest to the transmission; `None` if it is none of a satellite of navigation.
    pub(super) fn orbit(&self, bits: &Bits, sent: GpsTime) -> Option<KeplerOrbit> {
        let value = |field: &Field| field.value(bits);
        let [[cuc, cus], [crc, crs], [cic, cis]] =
            [&self.latitude, &self.radius, &self.inclination]
                .map(|pair| [value(&pair[0]), value(&pair[1])]);
        let orbit = KeplerOrbit {
            reference: self.time(&self.toe, bits, sent),
            sqrt_a: value(&self.sqrt_a),
            eccentricity: value(&self.eccentricity),
            m0: value(&self.m0),
            delta_n: value(&self.delta_n),
            omega: value(&self.omega),
            omega0: value(&self.omega0),
            omega_dot: value(&self.omega_dot),
            i0: value(&self.i0),
            i_dot: value(&self.i_dot),
            cuc,
            cus,
            crc,
            crs,
            cic,
            cis,
        };
        let is_of_week = [&self.toe, &self.toc].iter().all(|time| value(time) < WEEK);
        let plausible = orbit.sqrt_a >= LEAST_ROOT && orbit.eccentricity <= GREATEST_ECCENTRICITY;
        (is_of_week && plausible).then_some(orbit)
    }

    /// The clock.
    pub(super) fn clock(&self, bits: &Bits, sent: GpsTime) -> ClockPolynomial {
        let [a0, a1, a2] = self.clock.map(|field| field.value(bits));
        ClockPolynomial { reference: self.time(&self.toc, bits, sent), a0, a1, a2 }
    }

    fn time(&self, field: &Field, bits: &Bits, sent: GpsTime) -> GpsTime {
        sent.nearest_with_tow((field.value(bits) as i64 + self.behind) * SECOND)
    }

    /// Writes orbit and clock.
    pub(super) fn put(&self, bits: &mut Bits, orbit: &KeplerOrbit, clock: &ClockPolynomial) {
        let of_week =
            |time: GpsTime| (time.to_week().1 / SECOND - self.behind).rem_euclid(604_800) as f64;
        let fields = [
            (&self.toe, of_week(orbit.reference)),
            (&self.sqrt_a, orbit.sqrt_a),
            (&self.eccentricity, orbit.eccentricity),
            (&self.m0, orbit.m0),
            (&self.delta_n, orbit.delta_n),
            (&self.omega, orbit.omega),
            (&self.omega0, orbit.omega0),
            (&self.omega_dot, orbit.omega_dot),
            (&self.i0, orbit.i0),
            (&self.i_dot, orbit.i_dot),
            (&self.latitude[0], orbit.cuc),
            (&self.latitude[1], orbit.cus),
            (&self.radius[0], orbit.crc),
            (&self.radius[1], orbit.crs),
            (&self.inclination[0], orbit.cic),
            (&self.inclination[1], orbit.cis),
            (&self.toc, of_week(clock.reference)),
            (&self.clock[0], clock.a0),
            (&self.clock[1], clock.a1),
            (&self.clock[2], clock.a2),
        ];
        for (field, value) in fields {
            field.put(bits, value);
        }
    }
}

/// Accuracy of an index of GPS, QZSS or BeiDou, m (IS-GPS-200N, 20.3.3.3.1.3; BDS-SIS-ICD-B1I 3.0, 5.2.4, URAI): the nominal value.
pub(super) fn range_accuracy(index: i64) -> Option<f64> {
    const NOMINAL: [f64; 15] = [
        2.0, 2.8, 4.0, 5.7, 8.0, 11.3, 16.0, 32.0, 64.0, 128.0, 256.0, 512.0, 1024.0, 2048.0,
        4096.0,
    ];
    usize::try_from(index).ok().and_then(|index| NOMINAL.get(index)).copied()
}

/// Accuracy of an index of Galileo, m (OS SIS ICD 2.1, 5.1, SISA).
pub(super) fn signal_in_space_accuracy(index: i64) -> Option<f64> {
    Some(match index {
        0..=49 => index as f64 * 0.01,
        50..=74 => 0.5 + (index - 50) as f64 * 0.02,
        75..=99 => 1.0 + (index - 75) as f64 * 0.04,
        100..=125 => 2.0 + (index - 100) as f64 * 0.16,
        _ => return None,
    })
}
