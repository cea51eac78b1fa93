//! What the tests of sentences share.

#![allow(dead_code)] // no test file needs all of it

use insd_base::units::wrap_pi;
use insd_wire::nmea::{Date, MAX_LEN, MAX_LEN_OWN, NmeaLine, Position, Sentence, TimeOfDay};
use proptest::prelude::*;

/// Reads a line back after checking that it keeps its length.
pub(crate) fn read(line: &NmeaLine) -> Sentence {
    let limit = if line.as_str().starts_with("$P") { MAX_LEN_OWN } else { MAX_LEN };
    assert!(line.as_bytes().len() <= limit, "{line:?}");
    assert!(line.as_bytes().ends_with(b"\r\n"));
    Sentence::read(line.as_bytes()).unwrap_or_else(|fault| panic!("{line:?}: {fault}")).1
}

/// Whether both are unknown, or both known and as close as the last digit allows.
pub(crate) fn close(written: Option<f64>, read: Option<f64>, half_digit: f64) -> bool {
    match (written, read) {
        (Some(a), Some(b)) => (a - b).abs() <= half_digit * (1.0 + 1e-6) + 1e-12,
        (None, None) => true,
        _ => false,
    }
}

/// As [`close`], for angles of any number of turns.
pub(crate) fn same_angle(written: Option<f64>, read: Option<f64>, half_digit: f64) -> bool {
    let difference = written.zip(read).map(|(a, b)| wrap_pi(a - b));
    match difference {
        Some(difference) => difference.abs() <= half_digit * (1.0 + 1e-6) + 1e-12,
        None => written.is_none() && read.is_none(),
    }
}

/// Whether two positions agree to half of the last digit of their minutes.
pub(crate) fn same_position(written: Option<Position>, read: Option<Position>) -> bool {
    let half_digit = (0.000_005_f64 / 60.0).to_radians();
    let latitude = |position: Option<Position>| position.map(|position| position.latitude);
    let longitude = |position: Option<Position>| position.map(|position| position.longitude);
    close(latitude(written), latitude(read), half_digit)
        && same_angle(longitude(written), longitude(read), half_digit)
}

pub(crate) fn angle() -> impl Strategy<Value = Option<f64>> {
    prop::option::of(0.0..std::f64::consts::TAU)
}

/// A number of some range, or none.
pub(crate) fn perhaps(range: std::ops::Range<f64>) -> impl Strategy<Value = Option<f64>> {
    prop::option::of(range)
}

pub(crate) fn time_of_day() -> impl Strategy<Value = TimeOfDay> {
    (0..24_u8, 0..60_u8, 0..=60_u8, 0..100_u32).prop_map(|(hour, minute, second, hundredths)| {
        TimeOfDay { hour, minute, second, nanosecond: hundredths * 10_000_000 }
    })
}

pub(crate) fn date() -> impl Strategy<Value = Date> {
    (0..=9999_u16, 1..=12_u8, 1..=31_u8)
        .prop_map(|(year, month, day)| Date { year, month, day })
        .prop_filter("the calendar has this day", |date| date.is_valid())
}

pub(crate) fn position() -> impl Strategy<Value = Position> {
    (-90.0..=90.0_f64, -180.0..=180.0_f64).prop_map(|(latitude, longitude)| Position {
        latitude: latitude.to_radians(),
        longitude: longitude.to_radians(),
    })
}
