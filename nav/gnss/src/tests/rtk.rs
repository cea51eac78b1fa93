//! A rover against a base under the made-up sky, sound and broken.

use insd_base::{SatelliteEpoch, SatelliteId, Span};
use nalgebra::{Matrix3, Vector3};

use super::random::Random;
use super::sky::{berth, context, epoch, start};
use crate::context::Context;
use crate::rtk::{
    PlacedEpoch, RoverPrior, RtkFix, RtkRefusal, RtkSettings, RtkSolution, RtkTracker,
};

fn rover_at() -> Vector3<f64> {
    berth() + Vector3::new(300.0, -450.0, 120.0)
}

/// An epoch with the noise of a receiver for surveying, its phases counted from elsewhere.
fn noisy(context: &Context, after: f64, at: &Vector3<f64>, seed: u64) -> SatelliteEpoch {
    let mut epoch = epoch(context, after, at, &Vector3::zeros());
    let mut noise = Random(seed.wrapping_mul(1000).wrapping_add(after as u64));
    for signal in &mut epoch.signals {
        let wavelength = signal.wavelength().unwrap();
        let counted = f64::from(signal.satellite.number % 7) * seed as f64;
        signal.code = signal.code.map(|code| code + 0.3 * noise.gauss());
        signal.phase = signal.phase.map(|p| p + counted + 0.003 / wavelength * noise.gauss());
        signal.lock = Some(100.0 + after);
    }
    epoch
}

fn pair(context: &Context, after: f64) -> (SatelliteEpoch, SatelliteEpoch) {
    (noisy(context, after, &rover_at(), 2), noisy(context, after, &berth(), 5))
}

fn solved(
    context: &Context,
    rover: &SatelliteEpoch,
    base: &SatelliteEpoch,
) -> Result<RtkSolution, RtkRefusal> {
    let base = PlacedEpoch { epoch: base, position: berth() };
    RtkSolution::single_epoch(context, &RtkSettings::default(), rover, &base, None)
}

fn is_right(fix: &RtkFix) -> bool {
    (fix.position - rover_at()).norm() < 0.06
}

fn first(epoch: &SatelliteEpoch) -> SatelliteId {
    epoch.signals[0].satellite
}

#[test]
fn a_single_epoch_finds_the_rover_to_centimetres_and_says_so() {
    let context = context();
    for after in [0.0, 100.0, 200.0, 300.0] {
        let (rover, base) = pair(&context, after);
        let told = solved(&context, &rover, &base).unwrap();
        let fix = told.fixed.unwrap();
        assert!(is_right(&fix), "{}", (fix.position - rover_at()).norm());
        assert!(fix.doubt < 1e-6 && fix.ratio > 2.0, "{fix:?}");
        assert!((fix.runner_up - fix.position).norm() > 1e-4);
        assert!((told.float - rover_at()).norm() < 2.0);
        let off = fix.position - rover_at();
        let squared = (off.transpose() * fix.covariance.try_inverse().unwrap() * off)[0];
        assert!(squared < 30.0, "{squared}");
    }
}

#[test]
fn ambiguities_that_are_carried_on_hold_through_a_slip_that_nobody_tells() {
    let context = context();
    let mut tracker = RtkTracker::continuous(RtkSettings::default());
    let mut slipped = 0.0;
    for second in 0..40 {
        let (mut rover, base) = pair(&context, f64::from(second));
        if second == 20 {
            slipped = 1.0;
        }
        let which = first(&rover);
        for signal in rover.signals.iter_mut().filter(|signal| signal.satellite == which) {
            signal.phase = signal.phase.map(|phase| phase + slipped);
        }
        let base = PlacedEpoch { epoch: &base, position: berth() };
        let told = tracker.take(&context, &rover, &base, None).unwrap();
        assert!(is_right(&told.fixed.unwrap()), "{second}");
    }
    assert_eq!(tracker.withdrawals(), 0);
}

#[test]
fn a_code_that_jumps_moves_nothing() {
    let context = context();
    let (honest, base) = pair(&context, 7.0);
    for jump in [5.0, 50.0, 3000.0] {
        let mut rover = honest.clone();
        rover.signals[0].code = rover.signals[0].code.map(|code| code + jump);
        let told = solved(&context, &rover, &base).unwrap();
        let fix = told.fixed.unwrap();
        assert!(is_right(&fix), "{jump}");
    }
}

#[test]
fn a_phase_that_may_be_wrong_by_half_a_cycle_is_not_fixed_and_counted() {
    let context = context();
    let (mut rover, base) = pair(&context, 0.0);
    let which = first(&rover);
    for signal in rover.signals.iter_mut().filter(|signal| signal.satellite == which) {
        signal.half_cycle = true;
        signal.phase = signal.phase.map(|phase| phase + 0.5);
    }
    let told = solved(&context, &rover, &base).unwrap();
    assert_eq!(told.half_cycles, 2);
    let fix = told.fixed.unwrap();
    assert!(is_right(&fix));
    let of_it = |(ambiguity, _): &(crate::PairAmbiguity, i64)| {
        ambiguity.pair.satellite == which || ambiguity.reference == which
    };
    assert!(!fix.integers.iter().any(of_it));
}

#[test]
fn half_cycles_that_nobody_tells_are_refused_or_left_out() {
    let context = context();
    for wrong in 1..6 {
        let (mut rover, base) = pair(&context, f64::from(wrong));
        for signal in rover.signals.iter_mut().take(2 * wrong as usize) {
            signal.phase = signal.phase.map(|phase| phase + 0.5);
        }
        let told = solved(&context, &rover, &base).unwrap();
        assert!(told.fixed.is_err() || is_right(&told.fixed.clone().unwrap()), "{wrong}: {told:?}");
    }
}

#[test]
fn an_epoch_that_is_cut_gives_a_reason_or_what_is_right() {
    let context = context();
    let (whole, base) = pair(&context, 0.0);
    for kept in 0..whole.signals.len() {
        let mut rover = whole.clone();
        rover.signals.truncate(kept);
        match solved(&context, &rover, &base) {
            Ok(told) => assert!(told.fixed.is_err() || is_right(&told.fixed.unwrap()), "{kept}"),
            Err(why) => assert!(!why.to_string().is_empty()),
        }
    }
}

#[test]
fn a_base_that_is_late_is_used_and_told_and_one_that_is_too_late_refused() {
    let context = context();
    let rover = noisy(&context, 30.0, &rover_at(), 2);
    let base = noisy(&context, 22.0, &berth(), 5);
    let told = solved(&context, &rover, &base).unwrap();
    assert!((told.age - 8.0).abs() < 1e-9);
    let fix = told.fixed.unwrap();
    assert!(is_right(&fix), "{:?} {fix:?}", fix.position - rover_at());
    let mut old = base.clone();
    old.tag = start().plus(Span::from_seconds(-1.0));
    let refused = solved(&context, &rover, &old).unwrap_err();
    assert_eq!(refused, RtkRefusal::Age { age: 31.0, limit: 30.0 });
}

#[test]
fn a_base_that_is_taken_for_the_rover_is_found_by_its_codes() {
    let context = context();
    let (rover, base) = pair(&context, 0.0);
    let swapped = PlacedEpoch { epoch: &rover, position: berth() };
    let told = RtkSolution::single_epoch(&context, &RtkSettings::default(), &base, &swapped, None);
    assert!(matches!(told, Err(RtkRefusal::BasePlace { off, .. }) if off > 500.0), "{told:?}");
}

#[test]
fn a_base_coordinate_that_is_a_metre_off_contradicts_a_prior_that_knows_better() {
    let context = context();
    let (rover, base) = pair(&context, 0.0);
    let wrong = Vector3::new(0.8, -0.6, 0.0);
    let base = PlacedEpoch { epoch: &base, position: berth() + wrong };
    let settings = RtkSettings::default();
    // against the base it is right, and nothing else is known
    let told = RtkSolution::single_epoch(&context, &settings, &rover, &base, None).unwrap();
    let fix = told.fixed.unwrap();
    assert!((fix.position - rover_at() - wrong).norm() < 0.03);
    let prior = RoverPrior {
        position: rover_at(),
        covariance: Some(Matrix3::identity() * 0.1_f64.powi(2)),
    };
    let told = RtkSolution::single_epoch(&context, &settings, &rover, &base, Some(&prior)).unwrap();
    assert!(told.fixed.is_err(), "{:?}", told.fixed);
}

#[test]
fn a_prior_fixes_what_codes_alone_cannot() {
    let context = context();
    let (mut rover, base) = pair(&context, 0.0);
    // one band, and few satellites
    rover.signals.retain(|signal| signal.signal.band == 1);
    rover.signals.retain(|signal| signal.satellite.constellation.letter() == 'G');
    let alone = solved(&context, &rover, &base).unwrap();
    let position = rover_at() + Vector3::new(0.05, 0.02, -0.04);
    let prior = RoverPrior { position, covariance: Some(Matrix3::identity() * 0.05_f64.powi(2)) };
    let base = PlacedEpoch { epoch: &base, position: berth() };
    let settings = RtkSettings::default();
    let told = RtkSolution::single_epoch(&context, &settings, &rover, &base, Some(&prior)).unwrap();
    let fix = told.fixed.unwrap();
    assert!(is_right(&fix), "{:?} {fix:?}", fix.position - rover_at());
    let doubt = alone.fixed.map_or(1.0, |fix| fix.doubt);
    assert!(fix.doubt < doubt / 100.0, "{} {doubt}", fix.doubt);
}

#[test]
fn a_base_that_moves_is_followed_where_it_tells_where_it_is() {
    let context = context();
    let mut tracker = RtkTracker::continuous(RtkSettings::default());
    for second in 0..20 {
        let after = f64::from(second);
        let at = berth() + Vector3::new(3.0, 1.0, -2.0) * after;
        let (rover, base) =
            (noisy(&context, after, &rover_at(), 2), noisy(&context, after, &at, 5));
        let base = PlacedEpoch { epoch: &base, position: at };
        let told = tracker.take(&context, &rover, &base, None).unwrap();
        assert!(is_right(&told.fixed.unwrap()), "{second}");
    }
}
