//! Messages of devices, from the samples of canboat (Apache-2.0, (C) Kees Verruijt), with the values
//! that its analyzer finds in them.

use insd_n2k::pgn::{
    Attitude, FixMethod, GnssPosition, GnssSystem, Group, Heading, Heave, Integrity, North,
    RateOfTurn, utc,
};

fn bytes(hex: &str) -> Vec<u8> {
    hex.split(',').filter_map(|byte| u8::from_str_radix(byte, 16).ok()).collect()
}

fn close(value: Option<f64>, expected: f64, step: f64) -> bool {
    value.is_some_and(|value| (value - expected).abs() < step / 1000.0)
}

#[test]
fn a_heading_of_dirona_is_true_with_a_westerly_variation() {
    let heading = Heading::read(&bytes("ff,10,3b,ff,7f,ce,f5,fc")).unwrap();
    assert!(close(heading.heading, 1.5120, 1e-4), "{heading:?}");
    assert!(close(heading.variation, -0.2610, 1e-4), "{heading:?}");
    assert_eq!(heading.deviation, None);
    assert_eq!(heading.sid, None);
    assert_eq!(heading.reference, Some(North::True));
}

#[test]
fn a_slow_turn_to_port_keeps_its_sign() {
    let turn = RateOfTurn::read(&bytes("ff,dd,45,ff,ff,ff,ff,ff")).unwrap();
    assert!(close(turn.rate, -47_651.0 / 32e6, 3e-8), "{turn:?}");
}

#[test]
fn an_attitude_of_a_raymarine_sensor_has_all_three_angles() {
    let attitude = Attitude::read(&bytes("ff,db,f7,ce,00,c9,ff,ff")).unwrap();
    assert!(close(attitude.yaw, -0.2085, 1e-4), "{attitude:?}");
    assert!(close(attitude.pitch, 0.0206, 1e-4), "{attitude:?}");
    assert!(close(attitude.roll, -0.0055, 1e-4), "{attitude:?}");
}

#[test]
fn what_a_furuno_compass_puts_into_reserved_bits_of_heave_is_ignored() {
    let heave = Heave::read(&bytes("00,43,00,ff,ff,ff,7f,fd")).unwrap();
    assert_eq!(heave, Heave { sid: Some(0), heave: Some(0.67) });
}

#[test]
fn a_fix_at_harlingen_has_its_time_place_and_quality() {
    let data = "00,40,48,e0,3a,c7,1d,40,6f,16,41,06,28,61,07,a8,90,61,96,1b,0f,c1,00,d0,fb,01,00,00,00,\
                00,00,24,fc,00,3c,00,5a,00,34,12,00,00,00";
    let fix = GnssPosition::read(&bytes(data)).unwrap();
    let instant = utc(fix.date, fix.time).unwrap().to_civil();
    assert_eq!(instant, ((2020, 8, 22), 49_959_600_000_000));
    assert!(close(fix.latitude, 53.175_023_8_f64.to_radians(), 1e-6), "{fix:?}");
    assert!(close(fix.longitude, 5.434_128_2_f64.to_radians(), 1e-6), "{fix:?}");
    assert_eq!(fix.altitude, Some(0.13));
    assert_eq!(fix.system, Some(GnssSystem::GpsSbasGlonass));
    assert_eq!(fix.method, Some(FixMethod::Differential));
    assert_eq!(fix.integrity, Some(Integrity::NoChecking));
    assert_eq!((fix.hdop, fix.pdop, fix.geoid), (Some(0.6), Some(0.9), Some(46.6)));
    assert!(fix.stations.is_empty());
}
