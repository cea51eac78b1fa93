//! Figures and states in the form that mariners read: degrees and minutes, knots, sides.

use insd_base::units::{DEG, KNOT};
use insd_base::{Mode, Ned, Time};
use insd_output::CivilTime;

/// 1-sigma to the half-width of a 95 % interval of one Gaussian quantity.
const TWO_SIDED_95: f64 = 1.96;

/// Latitude, rad, as `35°12.345' N`.
#[must_use]
pub fn latitude(angle: f64) -> String {
    degrees_minutes(angle, 2, ['N', 'S'])
}

/// Longitude, rad, as `139°45.678' E`.
#[must_use]
pub fn longitude(angle: f64) -> String {
    degrees_minutes(angle, 3, ['E', 'W'])
}

fn degrees_minutes(angle: f64, width: usize, sides: [char; 2]) -> String {
    if !angle.is_finite() {
        return "unknown".to_owned();
    }
    let thousandths = (angle.to_degrees() * 60_000.0).round() as i64;
    let side = sides[usize::from(thousandths < 0)];
    let (degrees, rest) = (thousandths.abs() / 60_000, thousandths.abs() % 60_000);
    format!("{degrees:0width$}°{:02}.{:03}' {side}", rest / 1000, rest % 1000)
}

/// Course or heading, rad, as `045.32°`, never `360.00°`.
#[must_use]
pub fn bearing(angle: f64) -> String {
    if !angle.is_finite() {
        return "unknown".to_owned();
    }
    let hundredths = ((angle.to_degrees() * 100.0).round() as i64).rem_euclid(36_000);
    format!("{:03}.{:02}°", hundredths / 100, hundredths % 100)
}

/// Speed, m/s, in knots.
#[must_use]
pub fn speed(speed: f64) -> String {
    format!("{:.2} kn", speed / KNOT)
}

/// A distance, m: decimetres near, metres farther, nautical miles beyond one.
#[must_use]
pub fn distance(metres: f64) -> String {
    match metres {
        m if !m.is_finite() => "unknown".to_owned(),
        m if m < 10.0 => format!("{m:.1} m"),
        m if m < 1852.0 => format!("{m:.0} m"),
        m => format!("{:.1} NM", m / 1852.0),
    }
}

/// Roll, rad, starboard down positive, with its side.
#[must_use]
pub fn roll(angle: f64) -> String {
    with_side(angle / DEG, "°", ["to stbd", "to port"])
}

/// Pitch, rad, bow up positive, with its side.
#[must_use]
pub fn pitch(angle: f64) -> String {
    with_side(angle / DEG, "°", ["bow up", "bow down"])
}

/// Rate of turn, rad/s, starboard positive, with its side.
#[must_use]
pub fn rate_of_turn(rate: f64) -> String {
    with_side(rate * 60.0 / DEG, "°/min", ["to stbd", "to port"])
}

fn with_side(value: f64, unit: &str, sides: [&str; 2]) -> String {
    let side = if value.abs() < 0.05 { "" } else { sides[usize::from(value < 0.0)] };
    format!("{:4.1}{unit} {side}", value.abs()).trim_end().to_owned()
}

/// Half-width of the 95 % interval of an angle with this 1-sigma, rad, as `± 0.02°`; half a turn
/// says nothing and is called so.
#[must_use]
pub fn angle_95(sigma: f64) -> String {
    let degrees = TWO_SIDED_95 * sigma / DEG;
    match degrees {
        d if d.is_nan() || d >= 180.0 => "unknown".to_owned(),
        d if d < 1.0 => format!("± {:.2}°", d.max(0.01)),
        d if d < 10.0 => format!("± {d:.1}°"),
        d => format!("± {d:.0}°"),
    }
}

/// Half-width of the 95 % interval of a speed with this 1-sigma, m/s, in knots.
#[must_use]
pub fn speed_95(sigma: f64) -> String {
    let knots = TWO_SIDED_95 * sigma / KNOT;
    if knots.is_finite() { format!("± {:.2} kn", knots.max(0.01)) } else { "unknown".to_owned() }
}

/// Radius of the circle that holds the ship with 95 %, m, from the 1-sigma north and east.
///
/// Leenhouts, On the computation of bi-normal radial error, Navigation 32 (1985): a cubic in the
/// ratio of the axes, exact to 0.5 % from a line (1.96 sigma) to a circle (2.45 sigma).
#[must_use]
pub fn radius_95(sigma: &Ned) -> f64 {
    let (long, short) = (sigma.0.x.max(sigma.0.y), sigma.0.x.min(sigma.0.y));
    let ratio = if long > 0.0 { short / long } else { 0.0 };
    let factor = 1.960_790 + ratio * (0.004_071 + ratio * (0.114_276 + ratio * 0.371_625));
    factor * long
}

/// What that means on the bridge.
#[must_use]
pub fn mode_advice(mode: Option<Mode>) -> &'static str {
    match mode {
        None => "WAITING  for the first solution",
        Some(Mode::Standby) => "WAITING  for the IMU: do not use",
        Some(Mode::CoarseAlignment) => "ALIGNING  levelling and seeking north: do not use",
        Some(Mode::FineAlignment) => "ALIGNING  at the berth, heading settling: do not use",
        Some(Mode::InMotionAlignment) => "ALIGNING  under way, finding the heading: do not use",
        Some(Mode::Aided) => "NAVIGATING  with GNSS",
        Some(Mode::DeadReckoning) => "NAVIGATING  without GNSS: dead reckoning",
        Some(Mode::Inertial) => "NAVIGATING  on the IMU alone: position drifts",
        Some(Mode::Fault) => "FAULT  do not use",
    }
}

/// Voyage time as `hh:mm:ss`.
#[must_use]
pub fn clock(time: Time) -> String {
    let seconds = time.as_nanos().div_euclid(1_000_000_000).max(0);
    format!("{:02}:{:02}:{:02}", seconds / 3600, seconds / 60 % 60, seconds % 60)
}

/// UTC as `2026-01-02 03:04:05 UTC`.
#[must_use]
pub fn utc(utc: CivilTime) -> String {
    let CivilTime { date, time } = utc;
    format!(
        "{:04}-{:02}-{:02} {:02}:{:02}:{:02} UTC",
        date.year, date.month, date.day, time.hour, time.minute, time.second
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn positions_read_as_on_a_chart() {
        assert_eq!(latitude((35.0 + 12.345_4 / 60.0) * DEG), "35°12.345' N");
        assert_eq!(latitude(-5.999_999_9 * DEG), "06°00.000' S");
        assert_eq!(longitude(-139.5 * DEG), "139°30.000' W");
        assert_eq!(longitude(f64::NAN), "unknown");
    }

    #[test]
    fn bearings_have_three_digits_and_no_360() {
        assert_eq!(bearing(5.0 * DEG), "005.00°");
        assert_eq!(bearing(359.996 * DEG), "000.00°");
    }

    #[test]
    fn sides_are_named_and_rest_has_none() {
        assert_eq!(roll(-2.34 * DEG), " 2.3° to port");
        assert_eq!(pitch(0.01 * DEG), " 0.0°");
        assert_eq!(rate_of_turn(12.0 * DEG / 60.0), "12.0°/min to stbd");
    }

    #[test]
    fn the_95_percent_circle_is_right_for_a_line_and_for_a_circle() {
        assert!((radius_95(&Ned::new(1.0, 0.0, 9.0)) - 1.960).abs() < 0.002);
        assert!((radius_95(&Ned::new(2.0, 2.0, 9.0)) - 2.0 * 2.4477).abs() < 0.01);
        assert_eq!(radius_95(&Ned::default()), 0.0);
    }

    #[test]
    fn an_angle_that_says_nothing_is_unknown() {
        assert_eq!(angle_95(104.0 * DEG), "unknown");
        assert_eq!(angle_95(f64::NAN), "unknown");
        assert_eq!(angle_95(0.1 * DEG), "± 0.20°");
    }
}
