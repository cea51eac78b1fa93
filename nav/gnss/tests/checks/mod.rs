//! What must hold of any epochs and any records, for the tests here and for the fuzz target.
//!
//! The bytes are orders: each damages a sound sky of GPS, Galileo, BeiDou and GLONASS, or the epochs that a receiver at a berth takes of it. What is ordered
//! stands in [`Orders`]; a fuzzer without a sound sky would never get past the first check.

#![allow(clippy::unwrap_used)] // helpers of tests are not seen as tests

mod sky;

use insd_base::satellites::{Measured, SatelliteRange};
use insd_base::{GpsTime, SatelliteEpoch, Span};
use insd_gnss::{
    AttitudePrior, CarrierDisplacement, CarrierTracker, CompassArray, CompassPrior,
    CompassSettings, CompassTracker, Context, Guess, PlacedEpoch, Ranged, Ranging, RtkSettings,
    RtkTracker,
};
use nalgebra::{Matrix3, Vector3};

/// Reads orders out of bytes; of what is not there every number is zero.
pub(crate) struct Orders<'a>(&'a [u8]);

impl Orders<'_> {
    /// One byte.
    pub(crate) fn byte(&mut self) -> u8 {
        let Some((first, rest)) = self.0.split_first() else { return 0 };
        self.0 = rest;
        *first
    }

    fn word(&mut self) -> u64 {
        (0..8).fold(0, |word, _| word << 8 | u64::from(self.byte()))
    }

    /// Any number at all, a sound one that is a little off, or one of those that break things.
    pub(crate) fn number(&mut self, sound: f64) -> f64 {
        let how = self.byte();
        match how % 8 {
            0 => f64::from_bits(self.word()),
            1 => [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 0.0, -0.0, f64::MAX, 1e-300, -1.0]
                [usize::from(how / 8) % 8],
            2 => -sound,
            3 => sound * f64::from(self.byte()),
            4 => sound + (f64::from(self.byte()) - 128.0) * 1e6,
            5 => sound + (f64::from(self.byte()) - 128.0) * 30.0,
            _ => sound + (f64::from(self.byte()) - 128.0) * 0.1,
        }
    }

    /// Any instant, or one near a sound one.
    pub(crate) fn instant(&mut self, sound: GpsTime) -> GpsTime {
        let how = self.byte();
        match how % 4 {
            0 => GpsTime::from_nanos(self.word() as i64),
            1 => [GpsTime::from_nanos(i64::MIN), GpsTime::from_nanos(i64::MAX)]
                [usize::from(how / 4) % 2],
            2 => sound.plus(Span::from_seconds(f64::from(self.byte()) * 3600.0 - 460_800.0)),
            _ => sound.plus(Span::from_seconds(f64::from(self.byte()) * 0.25 - 32.0)),
        }
    }
}

/// Takes epochs as the bytes order. No panic, whatever they say, and nothing comes out that is not finite. Gives how many ranges came out.
pub(crate) fn everything(bytes: &[u8]) -> usize {
    let mut orders = Orders(bytes);
    let context = sky::context(&mut orders);
    let (mut ranging, mut tracker) = (Ranging::default(), CarrierTracker::default());
    let settings = RtkSettings::default();
    let mut rtk = [RtkTracker::continuous(settings), RtkTracker::continuous(settings)];
    let corner = |x: f64, y: f64| Vector3::new(x, y, 0.0);
    let corners = vec![corner(0.05, -0.05), corner(0.05, 0.05), corner(-0.05, 0.05)];
    let mut compass =
        CompassTracker::new(CompassArray::on_one_clock(corners), CompassSettings::default());
    let mut counted = 0;
    for second in 0..orders.byte() % 8 {
        let epoch = sky::epoch(&context, f64::from(second), &mut orders);
        let guess = guess(&mut orders);
        let ranged = ranging.take(&context, &epoch, guess);
        check(&ranged);
        counted += ranged.ranges.len();
        check_carrier(&mut tracker, &context, &epoch, guess);
        check_rtk(&mut rtk, &context, (&epoch, f64::from(second)));
        // the search for what fits to nothing is slow
        if second < 2 {
            check_compass(&mut compass, &context, (&epoch, f64::from(second)));
        }
    }
    counted
}

/// None, or the berth to some hundred metres: a guess is of who knows better, and never wild.
fn guess(orders: &mut Orders<'_>) -> Guess {
    let antenna = match orders.byte() % 4 {
        0 => None,
        1 => Some(sky::berth().map(|x| x + f64::from(orders.byte()))),
        _ => Some(sky::berth()),
    };
    Guess { antenna, turned: f64::from(orders.byte()) * 0.01 }
}

/// A damaged rover against a sound base, and the other way round.
fn check_rtk(
    trackers: &mut [RtkTracker; 2],
    context: &Context,
    (damaged, second): (&SatelliteEpoch, f64),
) {
    let sound = sky::epoch(context, second, &mut Orders(&[]));
    let [forth, back] = trackers;
    for (tracker, rover, base) in [(forth, damaged, &sound), (back, &sound, damaged)] {
        let base = PlacedEpoch { epoch: base, position: sky::berth() };
        let Ok(told) = tracker.take(context, rover, &base, None) else { continue };
        assert!(is_finite(&told.float) && is_finite(&told.position()), "{told:?}");
        assert!(told.covariance().iter().all(|value| value.is_finite()), "{told:?}");
    }
}

/// A damaged antenna between two that are sound.
fn check_compass(
    compass: &mut CompassTracker,
    context: &Context,
    (damaged, second): (&SatelliteEpoch, f64),
) {
    let sound = sky::epoch(context, second, &mut Orders(&[]));
    let level = Vector3::repeat(0.02);
    let attitude = Some(AttitudePrior { c_nb: Matrix3::identity(), std: level });
    let prior = CompassPrior { attitude, ..CompassPrior::default() };
    let epoch = compass.take(context, &[Some(&sound), Some(damaged), Some(&sound)], &prior);
    if let Ok(fix) = epoch.told {
        let phases = fix.signals.iter().flat_map(|signal| &signal.phases);
        let phases = phases.flat_map(|own| [own.phase, own.variance]);
        let all = fix.covariance.iter().copied().chain(phases).all(f64::is_finite);
        assert!(all && fix.doubt.is_finite() && fix.success.is_finite(), "{fix:?}");
    }
}

fn check_carrier(
    tracker: &mut CarrierTracker,
    context: &Context,
    epoch: &SatelliteEpoch,
    guess: Guess,
) {
    let antenna = guess.antenna.unwrap_or_else(sky::berth);
    let changes = tracker.advance(context, epoch, &antenna, guess.turned);
    if let Some(moved) = CarrierDisplacement::solve(&changes, &antenna) {
        assert!(is_finite(&moved.displacement), "{moved:?}");
    }
}

fn check(ranged: &Ranged) {
    for range in &ranged.ranges {
        check_range(range);
    }
    if let Some((clock, drift)) = ranged.clock {
        assert!(clock.is_finite() && drift.is_finite(), "clock {clock} {drift}");
    }
    if let Ok(point) = &ranged.point {
        let covariance = point.covariance.iter().all(|value| value.is_finite());
        assert!(is_finite(&point.position) && covariance, "{point:?}");
    }
    if let Some(velocity) = &ranged.velocity {
        let covariance = velocity.covariance.iter().all(|value| value.is_finite());
        assert!(is_finite(&velocity.velocity) && covariance, "{velocity:?}");
    }
}

fn check_range(range: &SatelliteRange) {
    let measured = |measured: Measured| {
        measured.value.is_finite() && measured.variance > 0.0 && measured.variance.is_finite()
    };
    let numbers = [range.elevation, range.slow_std, range.by_ionosphere, range.multipath_std];
    let sound = numbers.iter().all(|number| number.is_finite())
        && is_finite(&range.transmitter.position)
        && is_finite(&range.transmitter.velocity)
        && range.code.is_none_or(measured)
        && range.rate.is_none_or(measured)
        && range.phase.is_none_or(|phase| measured(phase.phase));
    assert!(sound, "{range:?}");
}

fn is_finite(vector: &Vector3<f64>) -> bool {
    vector.iter().all(|value| value.is_finite())
}
