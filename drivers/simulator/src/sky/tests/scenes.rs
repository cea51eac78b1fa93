//! What is hidden, reflected, faulty or false.

use super::*;

#[test]
fn a_segment_leaves_exactly_its_satellites_and_all_come_back_after_it() {
    let scenario = Scenario::from_toml(crate::shipped()[25].1).unwrap();
    let raw = raw_gnss(&scenario, 11).unwrap();
    let mut counts = Vec::new();
    for segment in &raw.truth.segments {
        let Some(left) = &segment.satellites else { continue };
        let left: BTreeSet<SatelliteId> = left.iter().copied().collect();
        for t in [segment.t0_s, segment.t1_s - 1.0] {
            let epoch = raw.antennas[0].iter().find(|epoch| seconds(&scenario, epoch) == t);
            let seen =
                epoch.into_iter().flat_map(|epoch| &epoch.signals).map(|signal| signal.satellite);
            assert_eq!(seen.collect::<BTreeSet<_>>(), left, "{t}");
        }
        let after = raw.antennas[0].iter().find(|epoch| seconds(&scenario, epoch) == segment.t1_s);
        assert!(after.unwrap().signals.len() > 10);
        counts.push(left.len());
    }
    assert_eq!(counts, [3, 2, 1, 0]);
}

#[test]
fn a_crane_hides_what_is_behind_it() {
    let crane = "[[raw.crane]]\nazimuth_deg = [300.0, 60.0]\nelevation_deg = 60.0\nt1_s = 50.0\n";
    let (scenario, raw) = made(crane, 1);
    let count = |t: f64| {
        raw.antennas[0].iter().find(|epoch| seconds(&scenario, epoch) == t).unwrap().signals.len()
    };
    assert!(count(49.0) + 2 < count(50.0));
}

#[test]
fn a_reflection_is_longer_weaker_and_of_broken_phase() {
    let segment = "[[raw.segment]]\nt0_s = 50.0\nt1_s = 90.0\nlabel = \"nlos\"\nreflected = 2\n";
    let (scenario, with) = made(&format!("{PERFECT}{CLEAR}{segment}"), 1);
    let (_, without) = made(&format!("{PERFECT}{CLEAR}"), 1);
    let (mut late, mut lost) = (BTreeSet::new(), 0);
    for (a, b) in with.antennas[0].iter().zip(&without.antennas[0]) {
        for (a_signal, b_signal) in a.signals.iter().zip(&b.signals) {
            let detour = a_signal.code.unwrap() - b_signal.code.unwrap();
            if (50.0..90.0).contains(&seconds(&scenario, a)) && detour.abs() > 1.0 {
                assert!((4.999..60.001).contains(&detour), "{detour}");
                assert_relative_eq!(
                    b_signal.cn0.unwrap() - a_signal.cn0.unwrap(),
                    10.0,
                    epsilon = 1e-9
                );
                late.insert(a_signal.satellite);
                lost += u32::from(a_signal.slip);
            } else {
                assert!(detour.abs() < 1e-6);
            }
        }
    }
    assert_eq!(late.len(), 2);
    assert!(lost > 20, "{lost}");
}

#[test]
fn faults_of_satellites_have_their_sizes_and_only_their_satellites() {
    let table = "[[raw.fault]]\nt0_s = 20.0\nt1_s = 60.0\nramp_mps = 0.5\n[[raw.fault]]\nt0_s = 70.0\nt1_s = 80.0\njump_m = 20.0\n\
                 [[raw.fault]]\nt0_s = 85.0\nt1_s = 90.0\nclock_jump_m = 100.0\n[[raw.fault]]\nt0_s = 95.0\nstale_mps2 = 0.1\n";
    let (scenario, with) = made(&format!("{PERFECT}{CLEAR}{table}"), 1);
    let (_, without) = made(&format!("{PERFECT}{CLEAR}"), 1);
    let faults = &with.truth.satellite_faults;
    assert_eq!(faults.iter().map(|f| f.satellite).collect::<BTreeSet<_>>().len(), 4);
    // the last fault ends with the voyage, whose last epoch it is in
    for (a, b) in with.antennas[0].iter().zip(&without.antennas[0]).take(119) {
        let t = seconds(&scenario, a);
        for (a, b) in a.signals.iter().zip(&b.signals) {
            let own =
                faults.iter().find(|f| f.satellite == a.satellite && (f.t0_s..f.t1_s).contains(&t));
            let code = a.code.unwrap() - b.code.unwrap();
            let phase = (a.phase.unwrap() - b.phase.unwrap()) * a.wavelength().unwrap();
            let expected = match own.map(|own| own.kind.as_str()) {
                Some("ramp_mps") => [0.5 * (t - 20.0); 2],
                Some("jump_m") => [20.0, 0.0],
                Some("clock_jump_m") => [100.0; 2],
                Some(_) => {
                    assert!(code.abs() <= 0.05 * (t - 95.0).powi(2) + 1e-6);
                    [code; 2]
                }
                None => [0.0; 2],
            };
            assert_relative_eq!(code, expected[0], epsilon = 1e-6);
            assert_relative_eq!(phase, expected[1], epsilon = 1e-6);
        }
    }
}

#[test]
fn a_spoofer_pulls_all_ranges_to_one_false_place() {
    let spoof = "[[raw.spoof]]\nt0_s = 40.0\nt1_s = 100.0\nspeed_mps = 0.5\ndirection_deg = 90.0\nclock_m = 3.0\n";
    let (scenario, raw) = made(&format!("{PERFECT}{CLEAR}{spoof}"), 1);
    let track = Track::new(&scenario, 1);
    let epoch = raw.antennas[0].iter().find(|epoch| seconds(&scenario, epoch) == 90.0).unwrap();
    let ship = track.at(90.0);
    let east = insd_base::earth::c_ne(&ship.point).row(1).transpose();
    let place = ship.at_lever(&Body::new(-6.0, -0.8, -14.0)).0.0 + east * 25.0;
    for signal in &epoch.signals {
        let error = signal.code.unwrap() - expected(&raw, signal, epoch.tag, place) - 3.0;
        assert!(error.abs() < 2e-3, "{error}");
        assert!(!signal.slip);
    }
    let back = raw.antennas[0].iter().find(|epoch| seconds(&scenario, epoch) == 100.0).unwrap();
    assert!(back.signals.iter().all(|signal| signal.slip));
}

#[test]
fn a_base_station_stands_still_and_is_neither_hidden_nor_spoofed() {
    let table = "[raw.base]\nlat_deg = 35.01\nlon_deg = 139.0\nheight_m = 40.0\n[[raw.segment]]\nt0_s = 20.0\nt1_s = 30.0\nlabel = \"0\"\nsatellites = 0\n";
    let (_, raw) = made(&format!("{PERFECT}{CLEAR}{table}"), 1);
    let base = raw.base.as_ref().unwrap();
    assert_eq!((base.epochs.len(), raw.antennas[0].len()), (120, 110));
    let place = ecef(&base.position).0;
    for signal in &base.epochs[25].signals {
        let error = signal.code.unwrap() - expected(&raw, signal, base.epochs[25].tag, place);
        assert!(error.abs() < 1e-3, "{error}");
    }
}

#[test]
fn a_base_may_say_that_it_is_elsewhere_and_measures_where_it_is() {
    let table = "[raw.base]\nlat_deg = 35.01\nlon_deg = 139.0\nheight_m = 40.0\n";
    let (_, honest) = made(&format!("{PERFECT}{CLEAR}{table}"), 1);
    let (_, wrong) = made(&format!("{PERFECT}{CLEAR}{table}told_off_m = [3.0, 4.0, -12.0]\n"), 1);
    let [honest, wrong] = [honest, wrong].map(|raw| raw.base.unwrap());
    assert_eq!(honest.epochs, wrong.epochs);
    let off = (ecef(&wrong.position).0 - ecef(&honest.position).0).norm();
    assert_relative_eq!(off, 13.0, epsilon = 1e-6);
    assert_relative_eq!(wrong.position.height - honest.position.height, 12.0, epsilon = 1e-4);
}

#[test]
fn multipath_is_so_many_times_as_large_in_a_segment_and_nowhere_else() {
    let part = |times: f64| {
        let segment = "t0_s = 50.0\nt1_s = 90.0\nlabel = \"multipath\"";
        let sizes = "multipath_code_std_m = 1.0\nmultipath_phase_std_m = 0.01\n";
        let perfect =
            PERFECT.replace("multipath_code_std_m = 0.0\nmultipath_phase_std_m = 0.0\n", sizes);
        made(&format!("{perfect}{CLEAR}[[raw.segment]]\n{segment}\nmultipath = {times}\n"), 1)
    };
    let [(scenario, none), (_, once), (_, often)] = [0.0, 1.0, 5.0].map(part);
    for ((none, once), often) in
        none.antennas[0].iter().zip(&once.antennas[0]).zip(&often.antennas[0])
    {
        let times = if (50.0..90.0).contains(&seconds(&scenario, none)) { 5.0 } else { 1.0 };
        for ((none, once), often) in none.signals.iter().zip(&once.signals).zip(&often.signals) {
            let off = |of: &SignalObservation| of.code.unwrap() - none.code.unwrap();
            if times > 1.0 {
                assert_relative_eq!(off(often), times * off(once), epsilon = 1e-6);
            } else {
                assert_relative_eq!(once.code.unwrap(), often.code.unwrap(), epsilon = 1e-6);
            }
        }
    }
}

#[test]
fn an_unknown_key_or_a_fault_of_no_or_two_sizes_is_refused() {
    for (bad, told) in [
        ("rate_khz = 1.0\n", "rate_khz"),
        ("[raw.sky]\nmoon = 1.0\n", "moon"),
        ("[[raw.segment]]\nt0_s = 1.0\nt1_s = 2.0\nlabel = \"a\"\nsats = 3\n", "sats"),
        ("[[raw.fault]]\nt0_s = 1.0\n", "raw.fault[0]: expected one of"),
        (
            "[[raw.fault]]\nt0_s = 1.0\njump_m = 1.0\nramp_mps = 1.0\n",
            "raw.fault[0]: expected one of",
        ),
        ("[[raw.fault]]\nt0_s = 1.0\nstale_mps2 = 1.0\nt1_s = 2.0\n", "raw.fault[0].t1_s"),
        ("[[raw.fault]]\nt0_s = 1.0\njump_m = 1.0\nsatellite = \"X1\"\n", "expected a satellite"),
        ("common_clock = [2]\n", "raw.common_clock"),
    ] {
        let text = format!(
            "name = \"a\"\nmode = \"underway\"\n[start]\nlat_deg = 35.0\nlon_deg = 139.0\n\
             [[route.legs]]\nheading_deg = 10.0\nspeed_kn = 8.0\nduration_s = 60.0\n[imu]\n[raw]\n{bad}"
        );
        let message = Scenario::from_toml(&text).unwrap_err().to_string();
        assert!(message.contains(told), "{message}");
    }
}
