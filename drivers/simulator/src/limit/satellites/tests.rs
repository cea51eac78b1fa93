//! What raw GNSS tells of a ship, and of which nothing is told.

use insd_base::units::DEG;

use super::*;
use crate::scenario::Override;
use crate::shipped;

/// A straight minute and a half under an open sky with these antennas, and a minute with as many satellites as told.
fn segments(antennas: &str, satellites: usize) -> Vec<SegmentLimit> {
    let text = format!(
        "name = \"a\"\nmode = \"underway\"\n[start]\nlat_deg = 35.0\nlon_deg = 139.0\n[[route.legs]]\nheading_deg = 10.0\nspeed_kn = 3.0\n\
         duration_s = 150.0\n[imu]\ngrade = \"mems\"\n[raw]\n{antennas}sky = {{ constellations = \"GE\" }}\n\
         [[raw.segment]]\nt0_s = 30.0\nt1_s = 90.0\nlabel = \"open\"\n\
         [[raw.segment]]\nt0_s = 90.0\nt1_s = 150.0\nlabel = \"few\"\nsatellites = {satellites}\n"
    );
    satellite_limit(&Scenario::from_toml(&text).unwrap(), 1).unwrap()
}

const PAIR: &str = "antennas_m = [[-5.0, -0.5, -14.0], [-5.0, 0.5, -14.0]]\n";

#[test]
fn phases_tell_the_way_of_a_minute_to_centimetres_and_nothing_tells_it_without_satellites() {
    // above the IMU, as the heading of a ship that does not turn is unknown
    let found = segments("antennas_m = [[0.0, 0.0, -14.0]]\n", 0);
    let [open, none] = &found[..] else { panic!("{found:?}") };
    assert!((0.001..0.05).contains(&open.relative_rms), "{}", open.relative_rms);
    assert!(none.relative_rms > 0.5, "{}", none.relative_rms);
    assert!(open.position_end < 3.0 && open.velocity_end < 0.02, "{open:?}");
}

#[test]
fn a_second_antenna_on_the_same_clock_tells_the_heading_of_a_ship_that_does_not_turn() {
    let heading = |antennas: &str| segments(antennas, 5)[1].attitude_rms[0] / DEG;
    let (one, own, shared) =
        (heading(""), heading(PAIR), heading(&format!("{PAIR}common_clock = [1, 2]\n")));
    assert!(one > 10.0 && own < 0.5, "{one} {own}");
    assert!(shared <= own, "{shared} {own}");
}

#[test]
fn what_is_not_modelled_gives_no_number() {
    for (number, sets, told) in [
        (7, &[][..], "no raw GNSS"),
        (27, &[], "faults of satellites"),
        (29, &["raw.frequencies=2"], "two frequencies"),
        (29, &["raw.swapped=[1, 2]"], "faults of antennas"),
        (29, &["imu.grade=perfect"], "an IMU without errors"),
    ] {
        let sets: Vec<Override> = sets.iter().map(|set| set.parse().unwrap()).collect();
        let scenario = Scenario::with_overrides(shipped()[number - 1].1, &sets).unwrap();
        let message = satellite_limit(&scenario, 1).unwrap_err().to_string();
        assert!(message.contains(told), "{number} {sets:?}: {message}");
    }
}

#[test]
fn a_camera_tells_the_way_of_a_minute_without_satellites() {
    let text = shipped().iter().find(|(file, _)| file.starts_with("30")).unwrap().1;
    let sets = [
        "raw.antennas_m=[[-5.95, -0.85, -14.0]]",
        "raw.common_clock=[]",
        "raw.sky.constellations=G",
        "raw.segment=[{ t0_s = 60.0, t1_s = 100.0, label = \"0\", satellites = 0 }]",
        "camera.tracks=20",
    ];
    let with = |more: &[&str]| {
        let sets = sets.iter().chain(more).map(|set| set.parse().unwrap());
        let sets: Vec<Override> = sets.collect();
        Scenario::with_overrides(text, &sets).unwrap().with_duration(100.0)
    };
    let scenario = with(&[]);
    let without = satellite_limit(&scenario, 1).unwrap()[0].relative_rms;
    let of = |by| camera_limit(&scenario, 1, by).unwrap()[0].relative_rms;
    let (steps, tracks) = (of(CameraUse::Odometry), of(CameraUse::Tracks));
    assert!(without > 0.5 && steps < without / 2.0, "{without} {steps}");
    assert!(tracks < steps, "{tracks} {steps}");

    let told = camera_limit(&scenario, 1, CameraUse::Tracks).unwrap()[0].attitude_rms[0];
    let loose = with(&["camera.mounting_std_deg=1", "camera.time_offset_std_s=0.02"]);
    let loose = camera_limit(&loose, 1, CameraUse::Tracks).unwrap()[0].clone();
    assert!(loose.attitude_rms[0] > told && loose.relative_rms >= tracks, "{loose:?} {told}");

    let faulty = with(&["camera.fault=[{ noise = true }]"]);
    let message = camera_limit(&faulty, 1, CameraUse::Tracks).unwrap_err().to_string();
    assert!(message.contains("faults of the camera"), "{message}");
    let blind = Scenario::from_toml(shipped()[28].1).unwrap();
    let message = camera_limit(&blind, 1, CameraUse::Tracks).unwrap_err().to_string();
    assert!(message.contains("no camera"), "{message}");
}
