//! Latitude and longitude as degrees and decimal minutes.

use insd_base::units::wrap_pi;

use super::decimal::{parse, parse_digits, scaled};

/// A point on the ellipsoid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Position {
    /// Geodetic latitude, rad, north positive.
    pub latitude: f64,
    /// Longitude, rad, east positive.
    pub longitude: f64,
}

impl Position {
    /// Both angles in minutes of arc times 10^`decimals`, so that 59.999999' carries into the
    /// degree; `None` if one of them is no angle. Longitudes of any number of turns are wrapped.
    pub(crate) fn to_minutes(self, decimals: u8) -> Option<(i64, i64)> {
        let latitude = scaled(self.latitude.to_degrees() * 60.0, decimals, 90.0 * 60.0 + 1e-9)?;
        let longitude = wrap_pi(self.longitude).to_degrees() * 60.0;
        Some((latitude, scaled(longitude, decimals, 180.0 * 60.0 + 1e-9)?))
    }

    /// Whether a writer can write it.
    pub(crate) fn is_writable(self) -> bool {
        self.to_minutes(5).is_some()
    }

    /// Degrees of `dd..mm.mm` with `width` digits of degrees.
    pub(crate) fn parse_angle(text: &str, width: usize) -> Option<f64> {
        let (degrees, minutes) = text.split_at_checked(width)?;
        let whole_minutes = minutes.split('.').next()?;
        let minutes = parse(minutes).filter(|m| (0.0..60.0).contains(m))?;
        let degrees = parse_digits(degrees).filter(|_| whole_minutes.len() == 2)?;
        Some(f64::from(degrees) + minutes / 60.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn minutes_that_round_to_sixty_carry_into_the_degree() {
        let position = Position {
            latitude: (35.0_f64 + 59.999_999_9 / 60.0).to_radians(),
            longitude: (-179.999_999_999_f64).to_radians(),
        };
        assert_eq!(position.to_minutes(3), Some((36 * 60_000, -180 * 60_000)));
    }

    #[test]
    fn angles_need_their_full_width() {
        assert_eq!(Position::parse_angle("3530.5", 2), Some(35.0 + 30.5 / 60.0));
        for text in ["", "3", "353", "35.5", "355.0", "35-1.0", "3560.0", "+530.0", "35é"] {
            assert_eq!(Position::parse_angle(text, 2), None, "{text}");
        }
    }
}
