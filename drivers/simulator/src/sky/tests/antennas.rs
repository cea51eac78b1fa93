//! Several antennas: where they are, what they share and what is their own, and what is wrong with their installation.

use nalgebra::Matrix3;

use super::*;

/// A square of 10 cm with a fourth antenna far from it.
const LEVERS: [[f64; 3]; 4] =
    [[-5.95, -0.85, -14.0], [-5.95, -0.75, -14.0], [-6.05, -0.75, -14.0], [12.0, 4.0, -9.0]];
const ONE_CLOCK: &str = "common_clock = [1, 2, 3, 4]\n";

fn array(table: &str, seed: u64) -> (Scenario, RawGnss) {
    made(&format!("antennas_m = {LEVERS:?}\n{table}"), seed)
}

/// `PERFECT` with clocks that are off and wander.
fn wandering() -> String {
    PERFECT
        .replace("clock_bias_walk_m_sqrt_s = 0.0", "clock_bias_walk_m_sqrt_s = 0.1")
        .replace("clock_drift_walk_mps_sqrt_s = 0.0", "clock_drift_walk_mps_sqrt_s = 0.1")
        .replace("clock_offset_ms = 0.0", "clock_offset_ms = 0.9")
        .replace("clock_drift_mps = 0.0", "clock_drift_mps = 100.0")
}

/// Of each signal that two antennas (by index) hear at an instant, s: satellite and band, code and phase of the second less the
/// first's, m.
fn differences(
    scenario: &Scenario,
    raw: &RawGnss,
    pair: [usize; 2],
    t: f64,
) -> BTreeMap<(SatelliteId, u8), [f64; 2]> {
    let of = |antenna: usize| {
        let epoch = raw.antennas[antenna].iter().find(|epoch| seconds(scenario, epoch) == t);
        let signals = epoch.unwrap().signals.iter();
        signals.map(|own| ((own.satellite, own.signal.band), *own)).collect::<BTreeMap<_, _>>()
    };
    let [first, second] = pair.map(of);
    let both = first.iter().filter_map(|(key, own)| Some((*key, own, second.get(key)?)));
    let difference = |one: &SignalObservation, other: &SignalObservation| {
        let phase = |own: &SignalObservation| own.phase.unwrap() * own.wavelength().unwrap();
        [other.code.unwrap() - one.code.unwrap(), phase(other) - phase(one)]
    };
    both.map(|(key, one, other)| (key, difference(one, other))).collect()
}

/// Turn from body to ECEF axes when the epoch of tag `t`, s, was sampled, by the bias of its clock, s.
fn turn(track: &Track, t: f64, bias: f64) -> Matrix3<f64> {
    track.at(t - bias).c_eb
}

/// Holds the differences of all pairs against levers and lines of sight: of codes as they are, of phases as they change.
fn held_against_geometry(scenario: &Scenario, raw: &RawGnss, seed: u64) {
    let track = Track::new(scenario, seed);
    let start = raw.antennas[0][0].tag;
    for (other, lever) in LEVERS.iter().enumerate().skip(1) {
        let lever = Vector3::from(*lever) - Vector3::from(LEVERS[0]);
        let first = differences(scenario, raw, [0, other], 1.0);
        for t in [1.0, 20.0, 57.0, 119.0] {
            for (key, [code, phase]) in differences(scenario, raw, [0, other], t) {
                let way = |t: f64| {
                    let tag = start.plus(insd_base::Span::from_seconds(t - 1.0));
                    let record = nearest(raw, key.0, tag);
                    let (place, _) = by_the_book(&record, tag, 0.08);
                    let turned = Rotation3::from_axis_angle(&Vector3::z_axis(), -EARTH_RATE * 0.08);
                    // a clock that is off by a millisecond moves neither line of sight nor hull by a tenth of a millimetre
                    let to = (turned * place - track.at(t).position).normalize();
                    -to.dot(&(turn(&track, t, 0.0) * lever))
                };
                assert!((code - way(t)).abs() < 3e-4, "{key:?} {t}: {code} {}", way(t));
                let changed = (phase - first[&key][1]) - (way(t) - way(1.0));
                assert!(changed.abs() < 3e-4, "{key:?} {t}: {changed}");
            }
        }
    }
}

#[test]
fn phases_of_two_antennas_differ_by_the_line_of_sight_along_the_lever_between_them() {
    let (scenario, raw) = array(&format!("{PERFECT}{CLEAR}"), 1);
    held_against_geometry(&scenario, &raw, 1);
}

#[test]
fn a_clock_that_is_shared_leaves_no_trace_in_differences_however_it_wanders() {
    let (scenario, raw) = array(&format!("{ONE_CLOCK}{}{CLEAR}", wandering()), 1);
    let (_, still) = array(&format!("{ONE_CLOCK}{PERFECT}{CLEAR}"), 1);
    let off = |t: usize| {
        let code = |raw: &RawGnss| raw.antennas[0][t].signals[0].code.unwrap();
        code(&raw) - code(&still)
    };
    assert!((off(100) - off(0)).abs() > 100.0, "the clock does not wander");
    held_against_geometry(&scenario, &raw, 1);
}

#[test]
fn receivers_on_clocks_of_their_own_drift_apart_by_what_is_one_for_all_satellites() {
    let (scenario, raw) = array(&format!("common_clock = [1, 2]\n{}{CLEAR}", wandering()), 2);
    let spread = |other: usize| {
        let now = differences(&scenario, &raw, [0, other], 100.0);
        let codes = now.values().map(|own| own[0]);
        codes.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], own| {
            [low.min(own), high.max(own)]
        })
    };
    let [low, high] = spread(1);
    assert!(low.abs() < 0.2 && high.abs() < 0.2);
    let [low, high] = spread(2);
    // satellites move by up to a kilometre a second along the line of sight, by metres in a millisecond
    assert!(low.abs() > 100.0 && high - low < 3.0, "{low} {high}");
}

#[test]
fn noise_reflections_integers_and_offsets_of_systems_are_each_antennas_own() {
    let (scenario, raw) = array(&format!("{ONE_CLOCK}slips_per_hour = 0.0\n{CLEAR}"), 3);
    let first = differences(&scenario, &raw, [0, 1], 1.0);
    let mut squares = [0.0; 2];
    let mut count = 0.0;
    for t in 2..119 {
        for (key, own) in differences(&scenario, &raw, [0, 1], f64::from(t)) {
            (0..2).for_each(|kind| squares[kind] += (own[kind] - first[&key][kind]).powi(2));
            count += 1.0;
        }
    }
    let rms = squares.map(|sum: f64| (sum / count).sqrt());
    // four times code of 0.3 m and 0.4 m, phase of 1.5 mm and 2 mm, the levers, and the weight of low satellites
    assert!((0.8..2.5).contains(&rms[0]) && (0.003..0.08).contains(&rms[1]), "{rms:?}");
    let integers: BTreeSet<i64> = first.values().map(|own| own[1].round() as i64).collect();
    assert!(integers.len() + 1 >= first.len());
    let mean = |letter: char| {
        let own = first.iter().filter(|((id, _), _)| id.constellation.letter() == letter);
        let own: Vec<f64> = own.map(|(_, own)| own[0]).collect();
        own.iter().sum::<f64>() / own.len() as f64
    };
    assert!(mean('G').abs() < 1.0 && mean('J').abs() < 1.5, "{} {}", mean('G'), mean('J'));
    assert!(mean('E').abs() > 2.0 && mean('C').abs() > 2.0, "{} {}", mean('E'), mean('C'));
}

#[test]
fn the_line_of_an_antenna_wanders_for_all_satellites_alike_and_in_the_phase_alone() {
    let lines = PERFECT.replace("line_bias_walk_m_sqrt_s = 0.0", "line_bias_walk_m_sqrt_s = 0.01");
    let (scenario, with) = array(&format!("{lines}{CLEAR}"), 4);
    let (_, without) = array(&format!("{PERFECT}{CLEAR}"), 4);
    let wandered = |t: f64| {
        let still = differences(&scenario, &without, [0, 2], t);
        let own = differences(&scenario, &with, [0, 2], t).into_iter();
        own.map(|(key, own)| [own[0] - still[&key][0], own[1] - still[&key][1]]).collect::<Vec<_>>()
    };
    let (begin, end) = (wandered(1.0), wandered(100.0));
    let moved = end[0][1] - begin[0][1];
    assert!((0.01..0.5).contains(&moved.abs()), "{moved}");
    for (begin, end) in begin.iter().zip(&end) {
        assert!((end[1] - begin[1] - moved).abs() < 1e-6);
        assert!(end[0].abs() < 1e-6);
    }
}

#[test]
fn a_broken_cable_brings_nothing_and_a_bad_one_less_and_noisier() {
    let faults = "[[raw.antenna_fault]]\nantenna = 2\nt0_s = 30.0\nt1_s = 60.0\nbroken = true\n\
                  [[raw.antenna_fault]]\nantenna = 3\nt0_s = 40.0\nweaker_db = 18.0\n";
    let (scenario, raw) = array(&format!("{ONE_CLOCK}{faults}"), 5);
    let (_, sound) = array(ONE_CLOCK, 5);
    assert_eq!((&raw.antennas[0], &raw.antennas[3]), (&sound.antennas[0], &sound.antennas[3]));
    let heard: Vec<f64> = raw.antennas[1].iter().map(|epoch| seconds(&scenario, epoch)).collect();
    assert!(!heard.iter().any(|t| (30.0..60.0).contains(t)) && heard.contains(&60.0));
    let (mut sums, mut count, mut lost) = ([0.0; 2], 0.0, 0);
    for (own, sound) in raw.antennas[2].iter().zip(&sound.antennas[2]) {
        if seconds(&scenario, own) < 40.0 {
            assert_eq!(own, sound);
            continue;
        }
        lost += sound.signals.len() - own.signals.len();
        for signal in &own.signals {
            let strength = sound.signals.iter().find(|s| s.satellite == signal.satellite).unwrap();
            sums[0] += strength.cn0.unwrap() - signal.cn0.unwrap();
            sums[1] += (strength.code.unwrap() - signal.code.unwrap()).powi(2);
            count += 1.0;
        }
    }
    assert_relative_eq!(sums[0] / count, 18.0, epsilon = 0.2);
    assert!((2.0..6.0).contains(&(sums[1] / count).sqrt()), "{}", (sums[1] / count).sqrt());
    assert!(lost > 100, "{lost}");
    let told: Vec<_> =
        raw.truth.antenna_faults.iter().map(|f| (f.antenna, f.kind.as_str(), f.size)).collect();
    assert_eq!(told, [(2, "broken", 0.0), (3, "weaker_db", 18.0)]);
}

#[test]
fn a_receiver_that_leaves_the_shared_clock_runs_away_at_its_rate() {
    let fault = "[[raw.antenna_fault]]\nantenna = 4\nt0_s = 50.0\nown_clock_mps = 0.3\n";
    let (scenario, raw) = array(&format!("{ONE_CLOCK}{PERFECT}{fault}{CLEAR}"), 6);
    let (_, sound) = array(&format!("{ONE_CLOCK}{PERFECT}{CLEAR}"), 6);
    for t in [50.0, 51.0, 80.0, 119.0] {
        let honest = differences(&scenario, &sound, [0, 3], t);
        for (key, own) in differences(&scenario, &raw, [0, 3], t) {
            let away = 0.3 * (t - 50.0);
            assert_relative_eq!(own[0] - honest[&key][0], away, epsilon = 1e-4);
        }
    }
}

#[test]
fn of_exchanged_antennas_the_voyage_tells_the_place_of_the_other() {
    let (_, raw) = array("swapped = [2, 4]\n", 7);
    let (_, sound) = array("", 7);
    assert_eq!(raw.antennas, sound.antennas);
    assert_eq!(raw.spec.antennas_m, [LEVERS[0], LEVERS[3], LEVERS[2], LEVERS[1]]);
    assert_eq!((raw.truth.swapped, sound.truth.swapped), (Some([2, 4]), None));
}

#[test]
fn what_no_installation_can_be_is_refused() {
    for (bad, told) in [
        ("swapped = [1, 1]\n", "raw.swapped: expected numbers of two antennas"),
        ("swapped = [1, 5]\n", "raw.swapped: expected numbers of two antennas"),
        ("[[raw.antenna_fault]]\nantenna = 5\nbroken = true\n", "raw.antenna_fault[0].antenna"),
        ("[[raw.antenna_fault]]\nantenna = 1\n", "raw.antenna_fault[0]: expected one of"),
        (
            "[[raw.antenna_fault]]\nantenna = 1\nbroken = true\nweaker_db = 3.0\n",
            "raw.antenna_fault[0]: expected one of",
        ),
        (
            "[[raw.antenna_fault]]\nantenna = 1\nt1_s = 9.0\nown_clock_mps = 3.0\n",
            "raw.antenna_fault[0].t1_s: expected no end",
        ),
    ] {
        let text = format!(
            "name = \"a\"\nmode = \"underway\"\n[start]\nlat_deg = 35.0\nlon_deg = 139.0\n\
             [[route.legs]]\nheading_deg = 10.0\nspeed_kn = 8.0\nduration_s = 60.0\n[imu]\n[raw]\nantennas_m = {LEVERS:?}\n{bad}"
        );
        let message = Scenario::from_toml(&text).unwrap_err().to_string();
        assert!(message.contains(told), "{message}");
    }
}
