//! A ship among cranes: ranges of satellites where there are too few for a fix.

use std::collections::VecDeque;

use insd_base::satellites::{SatelliteRanges, SatelliteUse, Sky, SkySatellite, time_keeper};
use insd_base::{
    Event, Geodetic, Message, Party, Received, Rejection, SatelliteId, Solution, Time, Truth,
    Voyage, earth,
};
use insd_config::VoyageCalendar;
use insd_engine::{Engine, EngineConfig, Output};
use insd_gnss::{ArrayRanging, Context, Noise};
use insd_lab::ranges::{Epochs, RangeMaker};
use insd_simulator::{RawGnss, Scenario, raw_gnss, simulate};
use insd_tests::sailing::sail_messages;
use nalgebra::{SMatrix, Vector2, Vector3};

use crate::figure;

/// The shipped scenario of a tight port, whose segments leave 3, 2, 1 and no satellites.
fn tight_port() -> Scenario {
    insd_lab::scenario::find("26", &[]).unwrap().scenario
}

fn context(raw: &RawGnss) -> Context {
    let spec = &raw.spec;
    let mut context = Context {
        noise: Noise {
            code: spec.code_std_m,
            phase: spec.phase_std_m,
            rate: spec.doppler_std_mps,
            multipath: spec.multipath_code_std_m,
        },
        ..Context::default()
    };
    for record in &raw.broadcast {
        context.ephemerides.insert(*record).unwrap();
    }
    context.ionosphere.insert(insd_base::Constellation::Gps, raw.ionosphere);
    context
}

/// All messages of a voyage in the order of their receipt, with ranges or without.
fn messages(voyage: &Voyage, raw: Option<&RawGnss>) -> Vec<Received> {
    let all = voyage.received();
    let Some(raw) = raw else { return all };
    RangeMaker::new(epochs(voyage, raw)).among(all)
}

/// What the first antenna measures on a voyage, without a base.
pub(crate) fn epochs(voyage: &Voyage, raw: &RawGnss) -> Epochs {
    let calendar = VoyageCalendar::new(&voyage.header.start_utc).unwrap();
    Epochs {
        start: calendar.utc(Time::START).to_gps(),
        context: context(raw),
        rover: vec![raw.antennas[0].iter().cloned().collect()],
        array: ArrayRanging::new(&[Vector3::zeros()], &[0]),
        base: VecDeque::new(),
        masks: Vec::new(),
    }
}

/// Horizontal errors against truth, north and east, m, with the claimed sigmas.
pub(crate) fn errors(
    solutions: &[Solution],
    truth: &[Truth],
) -> Vec<(f64, Vector2<f64>, Vector2<f64>)> {
    let mut errors = Vec::new();
    for solution in solutions {
        let Ok(place) = truth.binary_search_by_key(&solution.time, |truth| truth.time) else {
            continue;
        };
        let apart = earth::ecef(&solution.position).0 - earth::ecef(&truth[place].position).0;
        let off = earth::c_ne(&solution.position) * apart;
        let sigma = solution.sigma.position.0.xy();
        errors.push((solution.time.as_seconds(), off.xy(), sigma));
    }
    errors
}

/// RMS of the error against that at the begin of a segment, m, and the mean square of error by claim.
fn segment(errors: &[(f64, Vector2<f64>, Vector2<f64>)], from: f64, to: f64) -> (f64, f64) {
    let within: Vec<_> = errors.iter().filter(|(t, ..)| (from..to).contains(t)).collect();
    let first = within[0].1;
    let count = within.len() as f64;
    let moved = within.iter().map(|(_, error, _)| (error - first).norm_squared()).sum::<f64>();
    let nees =
        within.iter().map(|(_, error, sigma)| error.component_div(sigma).norm_squared() / 2.0);
    ((moved / count).sqrt(), nees.sum::<f64>() / count)
}

/// What the slow errors of all ranges of an epoch leave open of the place, north and east, 1-sigma, m, by least squares with a clock for each system.
fn left_open(ranges: &SatelliteRanges, at: &Geodetic) -> Vector2<f64> {
    let antenna = earth::ecef(at).0;
    let mut normal = SMatrix::<f64, 7, 7>::identity() * 1e-9;
    for range in &ranges.ranges {
        let mut row = SMatrix::<f64, 1, 7>::zeros();
        let line = earth::c_ne(at) * range.transmitter.line(&antenna);
        row.fixed_columns_mut::<3>(0).copy_from(&-line.transpose());
        row[3 + time_keeper(range.satellite.constellation) as usize % 4] = 1.0;
        normal += row.transpose() * row / range.slow_std.powi(2);
    }
    normal.try_inverse().unwrap().diagonal().xy().map(f64::sqrt)
}

#[test]
fn what_fixes_and_ranges_say_of_the_same_orbits_is_counted_once() {
    let scenario = tight_port();
    let (voyage, raw) = (simulate(&scenario, 1), raw_gnss(&scenario, 1).unwrap());
    let config = EngineConfig::for_voyage(&voyage.header, 1.0);
    let mut messages = messages(&voyage, Some(&raw));
    messages.retain(|received| received.receipt < Time::from_seconds(130.0));
    let ranges = messages.iter().rev().find_map(|received| match &received.message {
        Message::Ranges(ranges) => Some(ranges.clone()),
        _ => None,
    });
    let solutions = sail_messages(&config, &messages, 100).solutions;
    let last = solutions.last().unwrap();
    let (open, claimed) = (left_open(&ranges.unwrap(), &last.position), last.sigma.position.0);
    assert!(claimed.x > 0.85 * open.x && claimed.y > 0.85 * open.y, "{claimed} of {open}");
    let known = solutions.iter().filter(|solution| solution.time > Time::from_seconds(15.0));
    let widest = known.map(|solution| solution.sigma.position.0.xy().max()).fold(0.0, f64::max);
    assert!(
        widest < 5.0,
        "what the first ranges tell takes the place of what is forgotten: {widest}"
    );
}

#[test]
fn three_two_and_one_satellites_still_help() {
    let scenario = tight_port();
    let (voyage, raw) = (simulate(&scenario, 4), raw_gnss(&scenario, 4).unwrap());
    let config = EngineConfig::for_voyage(&voyage.header, 1.0);
    let sail = |raw: Option<&RawGnss>| {
        let log = sail_messages(&config, &messages(&voyage, raw), 100);
        errors(&log.solutions, &voyage.truth)
    };
    let (loose, tight) = (sail(None), sail(Some(&raw)));
    for (label, most) in [("3", 0.3), ("2", 4.0), ("1", 5.0)] {
        let own = raw.truth.segments.iter().find(|segment| segment.label == label).unwrap();
        let (of_fixes, _) = segment(&loose, own.t0_s, own.t1_s);
        let (of_ranges, nees) = segment(&tight, own.t0_s, own.t1_s);
        figure!("{label} satellites: {of_ranges:.2} m, by fixes {of_fixes:.2} m, NEES {nees:.2}");
        assert!(of_ranges < most, "{label}: {of_ranges}");
        // one satellite holds the clock and little else: which way the IMU errs is a draw
        assert!(of_ranges < of_fixes || label == "1", "{label}: {of_ranges} {of_fixes}");
        assert!(nees < 5.0, "{label}: {nees}");
    }
}

#[test]
fn reflected_signals_do_not_move_a_ship_that_uses_ranges() {
    let scenario = tight_port();
    let (voyage, raw) = (simulate(&scenario, 5), raw_gnss(&scenario, 5).unwrap());
    let config = EngineConfig::for_voyage(&voyage.header, 1.0);
    let log = sail_messages(&config, &messages(&voyage, Some(&raw)), 100);
    let tight = errors(&log.solutions, &voyage.truth);
    let reflected = raw.truth.segments.iter().filter(|segment| segment.label == "nlos");
    for own in reflected {
        let (moved, nees) = segment(&tight, own.t0_s, own.t1_s);
        figure!("reflections from {} s on: {moved:.2} m, NEES {nees:.2}", own.t0_s);
        assert!(moved < 0.4 && nees < 5.0, "{}: {moved} {nees}", own.t0_s);
    }
}

/// When a satellite is left out and used again, s.
fn judged(events: &[Event], satellite: SatelliteId) -> Vec<(f64, bool)> {
    let of_it = |event: &Event| match event {
        Event::SatelliteJudged { time, satellite: own, is_excluded } if *own == satellite => {
            Some((time.as_seconds(), *is_excluded))
        }
        _ => None,
    };
    events.iter().filter_map(of_it).collect()
}

#[test]
fn a_satellite_that_lies_is_named_before_it_moves_the_ship_and_used_again_afterwards() {
    let scenario = insd_lab::scenario::find("27", &[]).unwrap().scenario;
    let (voyage, raw) = (simulate(&scenario, 3), raw_gnss(&scenario, 3).unwrap());
    let config = EngineConfig::for_voyage(&voyage.header, 1.0);
    let log = sail_messages(&config, &messages(&voyage, Some(&raw)), 100);
    let errors = errors(&log.solutions, &voyage.truth);
    assert!(!raw.truth.satellite_faults.is_empty());
    for fault in &raw.truth.satellite_faults {
        let told = judged(&log.events, fault.satellite);
        // the tag less the receiver's clock, which is ahead
        let span = fault.t0_s - 1.0..fault.t1_s;
        let during = |(at, excluded): &&(f64, bool)| *excluded && span.contains(at);
        let named = told.iter().find(during).map(|(at, _)| *at - fault.t0_s);
        let again = told.iter().any(|(at, excluded)| !*excluded && *at >= fault.t1_s);
        let before = errors.iter().filter(|(t, ..)| (fault.t0_s..fault.t1_s).contains(t));
        let worst = before.map(|(_, error, _)| error.norm()).fold(0.0, f64::max);
        figure!("{fault:?}: named {named:?}, worst {worst:.2} m, {told:?}");
        assert!(worst < 1.0, "{fault:?}: {worst}");
        // what runs away by a millimetre a second is taken for the drift that real ones have
        if fault.kind != "stale_mps2" {
            assert!(named.is_some_and(|after| after < 10.0) && again, "{fault:?}: {told:?}");
        }
    }
}

/// What the engine tells of the sky after each epoch of ranges.
fn skies(voyage: &Voyage, raw: &RawGnss) -> (Vec<Sky>, insd_base::Counts) {
    let mut engine = Engine::new(EngineConfig::for_voyage(&voyage.header, 1.0));
    let mut skies: Vec<Sky> = Vec::new();
    for received in messages(voyage, Some(raw)) {
        engine.handle(&received);
        while engine.poll_output().is_some() {}
        if matches!(received.message, Message::Ranges(_)) {
            skies.extend(engine.sky());
        }
    }
    (skies, engine.counts().clone())
}

#[test]
fn the_sky_shows_a_satellite_that_lies_as_left_out_and_since_when_and_others_as_used() {
    let scenario = insd_lab::scenario::find("27", &[]).unwrap().scenario;
    let (voyage, raw) = (simulate(&scenario, 3), raw_gnss(&scenario, 3).unwrap());
    let (skies, counts) = skies(&voyage, &raw);
    let faults = raw.truth.satellite_faults.iter().filter(|fault| fault.kind != "stale_mps2");
    for fault in faults {
        let shown = |sky: &Sky| {
            let own = sky.satellites.iter().find(|own| own.satellite == fault.satellite)?;
            matches!(own.fate, SatelliteUse::LeftOut { .. }).then_some((sky.time, own.fate))
        };
        let within = |sky: &&Sky| (fault.t0_s..fault.t1_s).contains(&sky.time.as_seconds());
        let out: Vec<_> = skies.iter().filter(within).filter_map(shown).collect();
        let span = fault.t1_s - fault.t0_s;
        assert!(out.len() as f64 > 0.7 * span, "{fault:?}: {} of {span}", out.len());
        let SatelliteUse::LeftOut { since } = out[out.len() - 1].1 else { unreachable!() };
        let after = since.as_seconds() - fault.t0_s;
        figure!("{fault:?}: left out since {after:.1} s after its begin");
        assert!((-1.0..10.0).contains(&after), "{fault:?}: {after}");
    }
    let last = skies.last().unwrap();
    let used = last.satellites.iter().filter(|own| own.fate == SatelliteUse::Phase);
    assert!(used.clone().count() >= 6, "{last:?}");
    for own in used {
        assert!(own.direction.is_some_and(|at| at.elevation > 0.17), "{own:?}");
        assert!(own.signals.iter().all(|signal| signal.cn0.is_some()), "{own:?}");
    }
    // before she navigates nobody uses ranges, and says so
    let is_waiting = |sky: &Sky| sky.satellites.iter().any(|own| own.fate == SatelliteUse::Waiting);
    assert!(is_waiting(&skies[0]));
    // fixes give way to what they are made of, and are counted
    let passed_over = counts.rejected.get(&("gnss_position", Rejection::RangesInUse));
    figure!("{passed_over:?} fixes passed over, without ranges {:?}", counts.unranged);
    assert!(passed_over.is_some_and(|count| *count > 100), "{counts:?}");
}

/// Whether a satellite is as weak as the simulator makes what is reflected: by 10 dB.
fn is_reflected(own: &SkySatellite) -> bool {
    let direct = own.direction.map(|at| 36.0 + 12.0 * at.elevation.sin());
    let told = own.signals.first().and_then(|signal| signal.cn0);
    direct.zip(told).is_some_and(|(direct, told)| told < direct - 5.0)
}

#[test]
fn the_sky_shows_reflected_satellites_as_left_out_while_they_are() {
    let scenario = tight_port();
    let (voyage, raw) = (simulate(&scenario, 5), raw_gnss(&scenario, 5).unwrap());
    let (skies, _) = skies(&voyage, &raw);
    for own in raw.truth.segments.iter().filter(|segment| segment.label == "nlos") {
        let within = |sky: &&Sky| (own.t0_s + 1.0..own.t1_s).contains(&sky.time.as_seconds());
        let all = skies.iter().filter(within).flat_map(|sky| &sky.satellites);
        let reflected: Vec<_> = all.filter(|own| is_reflected(own)).collect();
        let is_out = |own: &&&SkySatellite| matches!(own.fate, SatelliteUse::LeftOut { .. });
        let out = reflected.iter().filter(is_out).count();
        figure!(
            "from {} s on: {out} of {} seconds of reflections left out",
            own.t0_s,
            reflected.len()
        );
        assert!(reflected.len() > 20 && out * 10 >= reflected.len() * 9, "{own:?}: {out}");
    }
}

#[test]
fn a_ship_without_ranges_has_no_sky() {
    let scenario = tight_port().with_duration(40.0);
    let voyage = simulate(&scenario, 1);
    let mut engine = Engine::new(EngineConfig::for_voyage(&voyage.header, 1.0));
    messages(&voyage, None).iter().for_each(|received| engine.handle(received));
    assert_eq!(engine.sky(), None);
}

#[test]
fn the_same_ranges_give_the_same_bits_and_nobody_is_moved_by_ranges_without_a_navigator() {
    let scenario = tight_port().with_duration(60.0);
    let (voyage, raw) = (simulate(&scenario, 1), raw_gnss(&scenario, 1).unwrap());
    let config = EngineConfig::for_voyage(&voyage.header, 1.0);
    let all = messages(&voyage, Some(&raw));
    let sail = || sail_messages(&config, &all, 7).solutions;
    assert_eq!(sail(), sail());
    let without: Vec<_> =
        all.iter().filter(|m| !matches!(m.message, Message::Ranges(_))).cloned().collect();
    assert_eq!(sail_messages(&config, &without, 7).solutions.len(), sail().len());
}

#[test]
fn a_ship_with_a_log_is_not_pulled_away_by_satellites_that_all_lie_alike() {
    let scenario = insd_lab::scenario::find("28", &[]).unwrap().scenario;
    for seed in [1, 2] {
        let (voyage, raw) = (simulate(&scenario, seed), raw_gnss(&scenario, seed).unwrap());
        let config = EngineConfig::for_voyage(&voyage.header, 1.0);
        let log = sail_messages(&config, &messages(&voyage, Some(&raw)), 100);
        let left_out = |solution: &&Solution| {
            solution.judgement.excluded.iter().any(|party| party == Party::Gnss)
        };
        let named = log.solutions.iter().find(left_out).unwrap().time.as_seconds();
        assert!((600.0..630.0).contains(&named), "{seed}: {named}");
        let errors = errors(&log.solutions, &voyage.truth);
        let sigmas = errors.iter().map(|(_, off, sigma)| off.norm() / sigma.norm());
        let (worst, off) = (
            sigmas.fold(0.0, f64::max),
            errors.iter().map(|(_, off, _)| off.norm()).fold(0.0, f64::max),
        );
        figure!(
            "spoofer, seed {seed}: named after {:.0} s, {off:.0} m and {worst:.1} sigmas off at the worst",
            named - 600.0
        );
        assert!(worst < 5.0 && off < 40.0, "{seed}: {worst} {off}");
    }
}

#[test]
fn the_ranges_of_a_receiver_found_to_lie_are_refused_and_do_not_move_the_ship() {
    const SPOOFER: &str = "[[gnss.spoofing]]\nwhen = { at_s = [599.5] }\nduration_s = 700.0\nspeed_mps = 0.5\ndirection_deg = 10.0\n";
    let spoofed = insd_tests::variant(28, &[]).with_duration(900.0);
    let honest = insd_tests::variant(28, &[(SPOOFER, "")]).with_duration(900.0);
    let (voyage, raw) = (simulate(&spoofed, 1), raw_gnss(&spoofed, 1).unwrap());
    let mut all = messages(&voyage, Some(&raw));
    // a second receiver on board, that nobody leads astray
    all.extend(simulate(&honest, 1).received().into_iter().filter_map(|own| {
        let Message::Gnss(fix) = own.message else { return None };
        let message = Message::Gnss(insd_base::GnssFix { rank: 1, ..fix });
        Some(Received { source: insd_base::Source::Gnss(1), message, ..own })
    }));
    all.sort_by_key(|received| received.receipt);
    let mut engine = Engine::new(EngineConfig::for_voyage(&voyage.header, 1.0));
    let used = |engine: &Engine| {
        ["satellite_code", "satellite_phase", "satellite_rate"]
            .map(|aid| engine.counts().accepted.get(aid).copied().unwrap_or(0))
    };
    let (mut left, mut solutions) = (None, Vec::new());
    for received in &all {
        engine.handle(received);
        while let Some(output) = engine.poll_output() {
            match output {
                Output::Event(Event::ReceiverUsed { time, .. }) if time.as_seconds() > 600.0 => {
                    left.get_or_insert((time, used(&engine)));
                }
                Output::Solution(solution) => solutions.push(solution),
                _ => {}
            }
        }
    }
    let (time, before) = left.unwrap();
    let refused = engine.counts().rejected.get(&("satellite_code", Rejection::SourceSuspect));
    let off = errors(&solutions, &voyage.truth);
    let worst = off.iter().filter(|(t, ..)| *t > 600.0).map(|(_, off, _)| off.norm());
    let worst = worst.fold(0.0, f64::max);
    figure!("left at {time:?}, {refused:?} epochs refused, {worst:.1} m off at the worst");
    assert!(time < Time::from_seconds(660.0), "{time:?}");
    assert!(refused.is_some_and(|count| *count > 200), "{:?}", engine.counts().rejected);
    assert_eq!(used(&engine), before);
    assert!(worst < 15.0, "{worst}");
}
