//! NeQuick-G: the ionosphere as Galileo broadcasts it.
//!
//! After "European GNSS (Galileo) Open Service - Ionospheric Correction Algorithm for Galileo Single Frequency Users"
//! (European Commission, issue 1.2, September 2016); numbers of sections and equations are those of that document. Three
//! broadcast coefficients tell how much the Sun ionises; the world maps of CCIR make critical frequencies of that,
//! these make a profile of electrons over each place, and the electrons along the ray to a satellite delay its signal.

mod ccir;
mod modip;
mod profile;
mod quadrature;
mod ray;
mod smooth;
mod sun;

use insd_base::{Geodetic, GpsTime};

use ccir::{Hour, Maps};
use modip::modip;
use profile::{Profile, Season};
use quadrature::integral;
use ray::{Place, Ray};
use sun::Sun;

/// Solar flux where nothing is broadcast (equation 17).
const DEFAULT_IONISATION: f64 = 63.7;
/// Heights at which the integral is divided, km, and its tolerance below the first and above (2.5.8).
const DIVISIONS_KM: [f64; 2] = [1000.0, 2000.0];
const TOLERANCES: [f64; 3] = [0.001, 0.01, 0.01];
/// (1e11 electrons per cubic metre) km, in TECU.
const TECU: f64 = 0.01;

/// The ionosphere of a month and an hour, ionised as the three broadcast coefficients tell.
#[derive(Clone, Debug)]
pub struct NeQuickG {
    coefficients: [f64; 3],
    month: u8,
    sun: Sun,
    maps: Hour,
}

/// The ionosphere of one hour with the activity of the Sun that a receiver is told.
struct Sky {
    ionisation: f64,
    season: Season,
    sun: Sun,
    maps: Maps,
}

impl NeQuickG {
    /// From the coefficients a_i0 (solar flux units), a_i1 (per degree), a_i2 (per degree squared) as broadcast, for
    /// the UTC month and hour of an instant.
    #[must_use]
    pub fn new(coefficients: [f64; 3], time: GpsTime) -> Self {
        const HOUR: f64 = 3600e9;
        let ((_, month, _), of_day) = time.to_utc(None).to_civil();
        let hour = of_day as f64 / HOUR;
        NeQuickG { coefficients, month, sun: Sun::new(month, hour), maps: Hour::new(month, hour) }
    }

    /// Electrons along the straight line from a receiver to a satellite above its horizon, TECU, that is 1e16 per square
    /// metre (2.5.8). NaN if a place or a coefficient is.
    #[must_use]
    pub fn slant_tec(&self, receiver: &Geodetic, satellite: &Geodetic) -> f64 {
        let sky = self.over(receiver);
        let (from, to) = (Place::from(receiver), Place::from(satellite));
        let ray = Ray::new(&from, &to);
        if ray.is_vertical() {
            let profile = sky.profile(&from);
            let density = |height: f64| profile.density(height);
            divided(&density, [from.height, to.height], DIVISIONS_KM)
        } else {
            let density = |distance: f64| {
                let place = ray.place(distance);
                sky.profile(&place).density(place.height)
            };
            divided(&density, ray.ends(), DIVISIONS_KM.map(|height| ray.at_height(height)))
        }
    }

    /// Delay of the code, and advance of the phase, from a satellite to a receiver on a frequency, Hz; m: the
    /// first order, 40.3e16 / f^2 for each TECU.
    #[must_use]
    pub fn delay(&self, receiver: &Geodetic, satellite: &Geodetic, frequency: f64) -> f64 {
        40.3e16 / (frequency * frequency) * self.slant_tec(receiver, satellite)
    }

    /// Effective ionisation level at a receiver, solar flux units, 0 to 400 (equations 17 and 18). It holds for all of
    /// the receiver's rays.
    fn ionisation(&self, receiver: &Geodetic) -> f64 {
        if self.coefficients == [0.0; 3] {
            return DEFAULT_IONISATION;
        }
        let [a0, a1, a2] = self.coefficients;
        let modip = modip(receiver.latitude, receiver.longitude);
        (a0 + modip * (a1 + modip * a2)).clamp(0.0, 400.0)
    }

    fn over(&self, receiver: &Geodetic) -> Sky {
        let ionisation = self.ionisation(receiver);
        // equation 19
        let sunspots = (167_273.0 + (ionisation - 63.7) * 1123.6).sqrt() - 408.99;
        Sky {
            ionisation,
            season: Season { month: self.month, sunspots },
            sun: self.sun,
            maps: self.maps.at_sunspots(sunspots),
        }
    }
}

impl Sky {
    fn profile(&self, place: &Place) -> Profile {
        let (latitude, longitude) = (place.latitude, place.longitude);
        let modip = modip(latitude, longitude).to_radians();
        let f2 = self.maps.at(modip, latitude, longitude);
        let e = self.sun.e_layer(latitude, longitude, self.ionisation);
        Profile::new(e, f2, self.season)
    }
}

/// Integral of a density along a path of which `at` are the divisions, TECU.
fn divided(density: &impl Fn(f64) -> f64, [from, to]: [f64; 2], at: [f64; 2]) -> f64 {
    let [first, second] = at.map(|division| division.max(from).min(to));
    let parts = [[from, first], [first, second], [second, to]];
    let of_tecu = |x: f64| TECU * density(x);
    let parts = parts.into_iter().zip(TOLERANCES).filter(|([from, to], _)| from != to);
    parts.map(|(part, tolerance)| integral(&of_tecu, part, tolerance)).sum()
}

#[cfg(test)]
mod tests;
