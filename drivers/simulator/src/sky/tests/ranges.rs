//! Ranges, phases, shifts, noise and slips.

use super::*;

/// Code less phase, m.
fn code_minus_phase(signal: &SignalObservation) -> f64 {
    signal.code.unwrap() - signal.phase.unwrap() * signal.wavelength().unwrap()
}

#[test]
fn without_errors_the_code_is_the_geometric_range_to_the_millimetre() {
    let (scenario, raw) = made(&format!("{PERFECT}{CLEAR}"), 1);
    let track = Track::new(&scenario, 1);
    let mut seen = BTreeSet::new();
    for epoch in raw.antennas[0].iter().step_by(17) {
        let ship = track.at(seconds(&scenario, epoch));
        let antenna = ship.at_lever(&Body::new(-6.0, -0.8, -14.0)).0.0;
        for signal in &epoch.signals {
            let error = signal.code.unwrap() - expected(&raw, signal, epoch.tag, antenna);
            assert!(error.abs() < 1e-3, "{} {}: {error}", signal.satellite, signal.signal);
            seen.insert((signal.satellite.constellation, signal.signal));
        }
    }
    assert_eq!(seen.len(), 8);
}

#[test]
fn the_ionosphere_delays_the_code_and_advances_the_phase_by_the_square_of_the_wavelength() {
    let sky = CLEAR.replace("[0.0, 0.0]", "[1.0, 1.0]");
    let (_, with) = made(&format!("{PERFECT}{sky}"), 1);
    let (_, without) = made(&format!("{PERFECT}{CLEAR}"), 1);
    let mut all = BTreeMap::new();
    for (a, b) in with.antennas[0].iter().zip(&without.antennas[0]) {
        for (a, b) in a.signals.iter().zip(&b.signals) {
            let wavelength = a.wavelength().unwrap();
            let delay = a.code.unwrap() - b.code.unwrap();
            let advance = (b.phase.unwrap() - a.phase.unwrap()) * wavelength;
            assert!((1.0..60.0).contains(&delay), "{delay}");
            assert_relative_eq!(delay, advance, epsilon = 1e-6);
            assert_relative_eq!(
                code_minus_phase(a) - code_minus_phase(b),
                2.0 * delay,
                epsilon = 1e-6
            );
            all.insert((a.satellite, a.signal.band), delay / wavelength.powi(2));
        }
    }
    for ((id, _), l1) in all.iter().filter(|((_, band), _)| *band == 1) {
        let second = if id.constellation == Constellation::Gps { 2 } else { 5 };
        assert_relative_eq!(all[&(*id, second)], *l1, max_relative = 1e-6);
    }
}

#[test]
fn the_doppler_shift_is_minus_the_derivative_of_the_phase() {
    let (scenario, raw) = made(
        &format!("rate_hz = 20.0\n{PERFECT}")
            .replace("clock_drift_mps = 0.0", "clock_drift_mps = 30.0"),
        3,
    );
    for arc in arcs(&scenario, &raw.antennas[0]).values() {
        for three in arc.windows(3).step_by(101) {
            let rate =
                (three[2].1.phase.unwrap() - three[0].1.phase.unwrap()) / (three[2].0 - three[0].0);
            let doppler = three[1].1.doppler.unwrap();
            assert!((doppler + rate).abs() < 2e-2, "{} {doppler} {rate}", three[1].1.satellite);
        }
    }
}

#[test]
fn without_errors_the_doppler_shift_is_the_rate_of_the_range_by_velocities() {
    let (scenario, raw) = made(&format!("{PERFECT}{CLEAR}"), 2);
    let track = Track::new(&scenario, 2);
    let epoch = &raw.antennas[0][60];
    let ship = track.at(seconds(&scenario, epoch));
    let (antenna, velocity) = ship.at_lever(&Body::new(-6.0, -0.8, -14.0));
    let omega = Vector3::z() * EARTH_RATE;
    for signal in &epoch.signals {
        let record = nearest(&raw, signal.satellite, epoch.tag);
        let travel = expected(&raw, signal, epoch.tag, antenna.0) / SPEED_OF_LIGHT;
        let at = |early: f64| by_the_book(&record, epoch.tag, travel + early);
        let h = 0.5;
        let turn = Rotation3::from_axis_angle(&Vector3::z_axis(), -EARTH_RATE * travel);
        let satellite = turn * at(0.0).0;
        let satellite_velocity = turn * (at(-h).0 - at(h).0) / (2.0 * h) + omega.cross(&satellite);
        let e = (satellite - antenna.0).normalize();
        // both in axes that do not turn; what is received later was sent later, too
        let relative = satellite_velocity - velocity - omega.cross(&antenna.0);
        let sent = 1.0 + e.dot(&satellite_velocity) / SPEED_OF_LIGHT;
        let clock = (at(-h).1 - at(h).1) / (2.0 * h) * SPEED_OF_LIGHT;
        let range = e.dot(&relative) / sent;
        let rate = -signal.doppler.unwrap() * signal.wavelength().unwrap();
        assert!(
            (rate - (range - clock)).abs() < 1e-4,
            "{} {rate} {}",
            signal.satellite,
            range - clock
        );
    }
}

#[test]
fn noise_has_the_size_that_the_table_says() {
    let only = |raw: &str, key: &str, value: &str| {
        raw.replace(&format!("\n{key} = 0.0"), &format!("\n{key} = {value}"))
    };
    let noisy = only(
        &only(&only(PERFECT, "code_std_m", "0.3"), "phase_std_m", "0.002"),
        "doppler_std_mps",
        "0.03",
    );
    let (scenario, raw) = made(&format!("{noisy}{CLEAR}"), 4);
    let (_, perfect) = made(&format!("{PERFECT}{CLEAR}"), 4);
    let track = Track::new(&scenario, 4);
    let mut sums = [0.0; 3];
    let mut count = 0.0;
    for (a, b) in raw.antennas[0].iter().zip(&perfect.antennas[0]) {
        let antenna = track.at(seconds(&scenario, a)).point;
        let up = insd_base::earth::c_ne(&antenna).row(2).transpose() * -1.0;
        for (a, b) in a.signals.iter().zip(&b.signals) {
            let record = nearest(&raw, a.satellite, raw.antennas[0][0].tag);
            let place = by_the_book(&record, raw.antennas[0][60].tag, 0.08).0;
            let sine = (place - ecef(&antenna).0).normalize().dot(&up);
            let weight = ((1.0 + 1.0 / sine.powi(2)) / 2.0).sqrt();
            let wavelength = a.wavelength().unwrap();
            let ratio = [
                (a.code.unwrap() - b.code.unwrap()) / 0.3,
                (a.phase.unwrap() - b.phase.unwrap()) * wavelength / 0.002,
                (a.doppler.unwrap() - b.doppler.unwrap()) * wavelength / 0.03,
            ];
            (0..3).for_each(|kind| sums[kind] += (ratio[kind] / weight).powi(2));
            count += 1.0;
        }
    }
    for sum in sums {
        assert_relative_eq!((sum / count).sqrt(), 1.0, max_relative = 0.04);
    }
}

#[test]
fn receivers_on_one_oscillator_share_its_bias_and_others_have_their_own() {
    let table = format!(
        "antennas_m = [[0.0, 0.0, -10.0], [0.0, 0.1, -10.0], [0.1, 0.0, -10.0]]\ncommon_clock = [1, 2]\n{PERFECT}"
    )
    .replace("clock_offset_ms = 0.0", "clock_offset_ms = 0.3");
    let (_, raw) = made(&table, 1);
    let code = |antenna: usize| raw.antennas[antenna][9].signals[0].code.unwrap();
    assert!((code(0) - code(1)).abs() < 0.2);
    assert!((code(0) - code(2)).abs() > 10.0);
}

#[test]
fn slips_are_integers_where_the_truth_says_and_the_receiver_tells_some() {
    let slipping = PERFECT.replace("slips_per_hour = 0.0", "slips_per_hour = 20.0");
    let (scenario, raw) = made(&format!("{slipping}{CLEAR}"), 6);
    let (_, without) = made(&format!("{PERFECT}{CLEAR}"), 6);
    let steady = arcs(&scenario, &without.antennas[0]);
    let mut found = BTreeMap::new();
    for ((id, band), arc) in arcs(&scenario, &raw.antennas[0]) {
        let mut offset = arc[0].1.phase.unwrap() - steady[&(id, band)][0].1.phase.unwrap();
        for (own, other) in arc.iter().zip(&steady[&(id, band)]) {
            let now = own.1.phase.unwrap() - other.1.phase.unwrap();
            assert!((now - now.round()).abs() < 1e-6);
            if (now - offset).abs() > 0.5 {
                found.insert((own.0 as i64, id), ((now - offset).round() as i32, own.1.slip));
            }
            offset = now;
        }
    }
    let injected: BTreeMap<_, _> =
        raw.truth.slips.iter().map(|s| ((s.t_s as i64, s.satellite), (s.cycles, s.told))).collect();
    assert_eq!(found, injected);
    let told = injected.values().filter(|(_, told)| *told).count();
    assert!(injected.len() > 10 && told > 0 && told < injected.len());
}

#[test]
fn half_a_cycle_is_told_until_it_is_resolved() {
    let (scenario, raw) = made(&format!("half_cycle_s = 20.0\n{PERFECT}{CLEAR}"), 1);
    let (_, whole) = made(&format!("{PERFECT}{CLEAR}"), 1);
    let whole = arcs(&scenario, &whole.antennas[0]);
    let mut off = BTreeSet::new();
    for (key, arc) in arcs(&scenario, &raw.antennas[0]) {
        for ((t, own), (_, other)) in arc.iter().zip(&whole[&key]) {
            let half = own.phase.unwrap() - other.phase.unwrap();
            assert!(
                half.abs() < 1e-6 || (own.half_cycle && (half - 0.5).abs() < 1e-6),
                "{t} {half}"
            );
            off.insert(own.half_cycle && half > 0.4);
        }
    }
    assert_eq!(off.len(), 2);
}

#[test]
fn the_same_seed_gives_the_same_raw_gnss_and_another_seed_another() {
    let scenario = scenario("");
    let raw = raw_gnss(&scenario, 7);
    assert_eq!(raw, raw_gnss(&scenario, 7));
    assert_ne!(raw, raw_gnss(&scenario, 8));
    assert_eq!(format!("{raw:?}"), format!("{:?}", raw_gnss(&scenario, 7)));
}

#[test]
fn raw_gnss_leaves_the_voyage_as_it_was() {
    let text = crate::shipped()[25].1;
    let with = Scenario::from_toml(text).unwrap().with_duration(60.0);
    let without =
        Scenario::from_toml(&text[..text.find("[raw]").unwrap()]).unwrap().with_duration(60.0);
    assert_eq!(raw_gnss(&without, 5), None);
    assert_eq!(simulate(&with, 5), simulate(&without, 5));
}
