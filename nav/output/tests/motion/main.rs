//! What the telegrams of motion sensors say of a ship, read back.

#![allow(clippy::unwrap_used)] // helpers of tests are not seen as tests

mod ship;
mod validity;

use insd_base::Span;
use insd_base::units::DEG;
use insd_output::{MessageKind, Port, Profile};
use insd_wire::motion::roll_from_horizon;

use ship::*;

#[test]
fn a_ship_leaned_either_way_has_the_roll_of_the_manuals_in_tss1_and_em() {
    for (roll, sign) in [(10.0 * DEG, 1.0), (-10.0 * DEG, -1.0)] {
        let leaned = with(|solution| solution.attitude.roll = roll);
        let told = tss1(&leaned).unwrap();
        near(told.roll, sign * roll_from_horizon(10.0 * DEG, 5.0 * DEG), HUNDREDTH);
        near(told.roll, sign * 9.96 * DEG, HUNDREDTH);
        near(told.pitch, 5.0 * DEG, HUNDREDTH);
        near(told.heave, 1.25, CENTI);
        for name in ["EM1000", "EM3000"] {
            let told = em(name, &leaned).unwrap();
            near(told.roll.unwrap(), sign * 9.96 * DEG, HUNDREDTH);
            near(told.pitch.unwrap(), 5.0 * DEG, HUNDREDTH);
            near(told.heave.unwrap(), 1.25, CENTI);
            near(told.heading.unwrap(), 90.0 * DEG, HUNDREDTH);
        }
    }
}

#[test]
fn a_ship_leaned_either_way_has_her_euler_angles_in_kmb_and_seapath() {
    for roll in [10.0 * DEG, -10.0 * DEG] {
        for told in status_formats(&with(|solution| solution.attitude.roll = roll)) {
            let tilt = told.tilt.unwrap().value;
            near(tilt.roll, roll, BINARY);
            near(tilt.pitch, 5.0 * DEG, BINARY);
            near(told.heading.unwrap().value, 90.0 * DEG, BINARY);
            for (rate, expected) in told.rates.iter().zip([1.0, -2.0, 3.0]) {
                near(*rate, expected * DEG, BINARY);
            }
        }
    }
}

#[test]
fn the_signs_are_those_of_the_wire() {
    // roll 10 deg and heave 1.25 m: up in TSS1 and EM, down in the others
    assert_eq!(said("TSS1", &epoch()).unwrap(), b":0DFB50  0125F 0996  0500\r\n");
    let le = |name: &str, at: usize| {
        let bytes = said(name, &epoch()).unwrap();
        i16::from_le_bytes([bytes[at], bytes[at + 1]])
    };
    assert_eq!([le("EM3000", 2), le("EM3000", 4), le("EM3000", 6)], [996, 500, 125]);
    let single = |at: usize| {
        let bytes = said("KMB", &epoch()).unwrap();
        f32::from_le_bytes(bytes[at..at + 4].try_into().unwrap())
    };
    assert_eq!([single(40), single(44), single(52), single(76)], [10.0, 5.0, -1.25, -0.5]);
    for name in ["SEAPATH.23", "SEAPATH.26"] {
        let bytes = said(name, &epoch()).unwrap();
        let be = |at: usize| i16::from_be_bytes([bytes[at], bytes[at + 1]]);
        assert_eq!([be(20), be(26), be(28), be(30)], [-125, -50, 1820, 910], "{name}");
    }
}

#[test]
fn a_wave_lifts_the_ship_in_every_telegram() {
    for told in status_formats(&epoch()) {
        let vertical = told.vertical.unwrap();
        near(vertical.value.heave, 1.25, CENTI);
        near(vertical.value.down_velocity, -0.5, CENTI);
        assert!(!vertical.reduced);
    }
}

#[test]
fn position_and_velocity_are_told_with_their_time() {
    for told in status_formats(&epoch()) {
        assert_eq!(told.time, utc());
        let place = told.place.unwrap();
        near(place.value.latitude, 35.5 * DEG, 1e-8);
        near(place.value.longitude, -139.25 * DEG, 1e-8);
        near(place.value.height, 40.0, CENTI);
        near(place.value.north_velocity, -0.5, CENTI);
        near(place.value.east_velocity, 5.0, CENTI);
        assert!(!place.reduced);
    }
}

#[test]
fn kmb_tells_acceleration_and_errors() {
    let told = kmb(&epoch()).unwrap();
    let acceleration = told.acceleration.unwrap();
    assert!(!acceleration.reduced);
    for (value, expected) in acceleration.value.iter().zip([0.4, 0.3, 0.75]) {
        near(*value, expected, 1e-6);
    }
    let sigma = told.sigma;
    let parts = [sigma.north, sigma.east, sigma.height, sigma.heave];
    for (part, expected) in parts.into_iter().zip([0.8, 0.6, 1.5, 0.04]) {
        near(part.unwrap(), expected, 1e-6);
    }
    for (part, expected) in [sigma.roll, sigma.pitch, sigma.heading].into_iter().zip([2, 3, 5]) {
        near(part.unwrap(), f64::from(expected) * 0.01 * DEG, 1e-8);
    }
}

#[test]
fn tss1_tells_the_magnitude_of_the_horizontal_acceleration_and_the_vertical_one_upward() {
    for heading in [0.0, 90.0 * DEG, 211.0 * DEG] {
        let told = tss1(&with(|solution| solution.attitude.heading = heading)).unwrap();
        near(told.horizontal_acceleration, 0.5, 0.038_35);
        near(told.vertical_acceleration, -0.75, 0.000_625);
    }
}

#[test]
fn the_delayed_heave_has_its_own_time_in_utc() {
    let expected = utc().plus(Span::from_seconds(-90.25));
    let by_kmb = kmb(&epoch()).unwrap().delayed_heave.unwrap();
    assert!(!by_kmb.reduced);
    let by_seapath = seapath_26(&epoch()).unwrap().delayed_heave.unwrap();
    for delayed in [by_kmb.value, by_seapath] {
        assert_eq!(delayed.time, expected);
        near(delayed.heave, -0.75, CENTI);
    }
}

#[test]
fn the_multibeam_profile_is_em3000_alone() {
    let port = Port::new(Profile::named("multibeam").unwrap().port());
    let names: Vec<&str> = port.kinds().map(MessageKind::name).collect();
    assert_eq!(names, ["EM3000"]);
    near(port.bytes_per_second(), 1000.0, 1e-6);
}
