//! From magnetic to true north.

use insd_base::units::{DEG, wrap_two_pi};
use insd_base::{Geodetic, UtcTime};
use kinavis_kernel::{Distance, GeodeticPoint, Height, Position};
use kinavis_wmm::{DecimalYear, Wmm};

use crate::decode::{HeadingReading, North};

/// The least that a magnetic compass is off on a steel ship, 1-sigma, rad.
const COMPASS_STD: f64 = 2.0 * DEG;

/// Knows the place and the day for which a variation is asked.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Variation {
    here: Option<(Geodetic, UtcTime)>,
}

impl Variation {
    /// The ship is here, now.
    pub(crate) fn here(&mut self, place: Geodetic, utc: Option<UtcTime>) {
        self.here = utc.map(|utc| (place, utc)).or(self.here);
    }

    /// A heading from true north and its 1-sigma, rad; a magnetic one by the world magnetic model, for
    /// which place and day must be known. A magnetic compass is never believed better than 2 deg.
    pub(crate) fn to_true(self, told: &HeadingReading, std: f64) -> Option<(f64, f64)> {
        match told.north {
            North::True => Some((told.heading, std)),
            North::Corrected => Some((told.heading, std.max(COMPASS_STD))),
            North::Magnetic => {
                let (place, utc) = self.here?;
                let variation = variation(&place, utc)?;
                Some((wrap_two_pi(told.heading + variation), std.max(COMPASS_STD)))
            }
        }
    }
}

/// Magnetic variation, rad, east positive, by the model of its time: the World Magnetic Model 2025
/// (NOAA/NCEI and BGS) from 2025 on, for recordings of 1900 to 2024 the International Geomagnetic
/// Reference Field 13 (IAGA). `None` before and after, from 2030 on, and at the poles.
#[must_use]
pub fn variation(place: &Geodetic, utc: UtcTime) -> Option<f64> {
    let (latitude, longitude) = (place.latitude.to_degrees(), place.longitude.to_degrees());
    if utc < UtcTime::from_civil((2025, 1, 1), (0, 0, 0), 0)? {
        return of_the_past(latitude, longitude, utc);
    }
    let position = Position::from_degrees(latitude, longitude).ok()?;
    let height = Height::above_mean_sea_level(Distance::ZERO);
    let year = DecimalYear::new(decimal_year(utc)?).ok()?;
    let field = Wmm::WMM2025.field_in(GeodeticPoint::new(position, height), year).ok()?;
    Some(field.declination().degrees().to_radians())
}

/// Variation by the International Geomagnetic Reference Field, rad; degrees in.
fn of_the_past(latitude: f64, longitude: f64, utc: UtcTime) -> Option<f64> {
    let ((year, month, day), _) = utc.to_civil();
    let month = time::Month::try_from(month).ok()?;
    let date = time::Date::from_calendar_date(year, month, day).ok()?;
    let field = igrf::declination(latitude, longitude, 0, date).ok()?;
    Some(field.d.to_radians()).filter(|variation| variation.is_finite())
}

fn decimal_year(utc: UtcTime) -> Option<f64> {
    let ((year, _, _), _) = utc.to_civil();
    let new_year = |year| UtcTime::from_civil((year, 1, 1), (0, 0, 0), 0);
    let (begun, ends) = (new_year(year)?, new_year(year + 1)?);
    Some(f64::from(year) + utc.since(begun).as_seconds() / ends.since(begun).as_seconds())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn midsummer(year: i32) -> UtcTime {
        UtcTime::from_civil((year, 7, 2), (12, 0, 0), 0).unwrap()
    }

    #[test]
    fn the_variation_is_that_of_the_model_while_it_is_valid() {
        // off Ushant in June 2026: 0.4 deg west, as the documentation of kinavis-wmm has it
        let west = variation(&Geodetic::from_degrees(48.5, -5.5, 0.0), midsummer(2026)).unwrap();
        assert!((west.to_degrees() + 0.4).abs() < 0.06, "{}", west.to_degrees());
        assert_eq!(variation(&Geodetic::from_degrees(48.5, -5.5, 0.0), midsummer(2031)), None);
    }

    #[test]
    fn the_variation_of_a_recording_is_that_of_its_time() {
        // the position of the R/V Nathaniel B. Palmer with the variation of her own Seapath's RMC
        let palmer = Geodetic::from_degrees(-22.001_848, -17.939_324, 0.0);
        let day = UtcTime::from_civil((2014, 8, 1), (0, 0, 0), 0).unwrap();
        let told = variation(&palmer, day).unwrap().to_degrees();
        assert!((told + 24.7).abs() < 0.3, "{told}");
        // it moves: London was 24 deg west in 1820, 16 in 1900, and nearly 0 in 2024
        let london = Geodetic::from_degrees(51.5, -0.1, 0.0);
        let of = |year| variation(&london, midsummer(year)).unwrap().to_degrees();
        assert!((of(1900) + 16.5).abs() < 0.5 && (of(2024) - 0.9).abs() < 0.5);
        let step = variation(&london, midsummer(2025)).unwrap().to_degrees() - of(2024);
        assert!((step - 0.19).abs() < 0.15, "the models meet: {step}");
        assert_eq!(variation(&london, midsummer(1899)), None);
        assert_eq!(variation(&Geodetic::from_degrees(90.0, 0.0, 0.0), midsummer(2014)), None);
    }

    #[test]
    fn a_magnetic_heading_is_corrected_only_where_place_and_day_are_known() {
        let told = HeadingReading { heading: 1.0, std: None, north: North::Magnetic, valid: true };
        let mut own = Variation::default();
        assert_eq!(own.to_true(&told, 0.001), None);
        own.here(Geodetic::from_degrees(48.5, -5.5, 0.0), Some(midsummer(2026)));
        let (heading, std) = own.to_true(&told, 0.001).unwrap();
        assert!((heading - 1.0 + 0.4 * DEG).abs() < 0.1 * DEG);
        assert_eq!(std, COMPASS_STD);
    }
}
