//! A receiver's epochs made ready for a filter: when they were sampled, what each satellite tells with all that is known taken out, and what follows
//! without a filter.

mod combined;
mod heard;
mod place;

use insd_base::satellites::{
    AntennaDisplacement, HeardSatellite, RangeRefusal, SPEED_OF_LIGHT, SatelliteRange,
    SatelliteRanges,
};
use insd_base::{GpsTime, SatelliteEpoch, Span, Time};
use nalgebra::Vector3;

use crate::budget::LOWEST;
use crate::carrier::{CarrierDisplacement, CarrierTracker};
use crate::context::Context;
use crate::signals::{first_band, inflation, range_rate};
use crate::single_point::{NoPosition, SinglePoint};
use crate::velocity::DopplerVelocity;
use combined::{Combined, combined_code};
use heard::Heard;
use place::Place;

/// What is made of an epoch.
#[derive(Clone, Debug, PartialEq)]
pub struct Ranged {
    /// When it was sampled: the tag less what the receiver's clock was ahead.
    pub sampled: GpsTime,
    /// The receiver's clock ahead and its drift, m and m/s, where this epoch tells them.
    pub clock: Option<(f64, f64)>,
    /// What each satellite tells.
    pub ranges: Vec<SatelliteRange>,
    /// Every satellite of the epoch, and why it tells no range if it does not.
    pub heard: Vec<HeardSatellite>,
    /// The position that the codes alone make.
    pub point: Result<SinglePoint, NoPosition>,
    /// The velocity that the Doppler shifts alone make.
    pub velocity: Option<DopplerVelocity>,
    /// The displacement since the epoch before that the phases alone make, and how long ago that was sampled.
    pub moved: Option<(Span, CarrierDisplacement)>,
}

impl Ranged {
    /// What of it goes to a filter and to those who look on, sampled at an instant of the ship's time line.
    #[must_use]
    pub fn told(self, time: Time) -> SatelliteRanges {
        let displacement = self.moved.map(|(lasted, own)| AntennaDisplacement {
            since: time - lasted,
            by: own.displacement,
            covariance: own.covariance,
        });
        let Ranged { clock, ranges, heard, .. } = self;
        SatelliteRanges { time, clock, ranges, displacement, heard }
    }
}

/// Where the antenna is and how it turns, by whoever knows it better than an epoch alone.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Guess {
    /// Position of the antenna, ECEF, m, to some ten metres.
    pub antenna: Option<Vector3<f64>>,
    /// By what it has turned so far, from wherever that is counted, rad, clockwise as seen from above.
    pub turned: f64,
}

/// A receiver that is followed from epoch to epoch.
#[derive(Clone, Debug, Default)]
pub struct Ranging {
    tracker: CarrierTracker,
    known: Option<Known>,
    /// When the epoch before was sampled, and where the antenna was.
    before: Option<(GpsTime, Vector3<f64>)>,
}

/// What an epoch told of place and clock.
#[derive(Clone, Copy, Debug)]
struct Known {
    tag: GpsTime,
    place: Place,
    clock: f64,
    drift: f64,
}

impl Ranging {
    /// Takes an epoch. Without a position, known or guessed, nothing can be made of it but the reason why; with one, each satellite counts for itself.
    pub fn take(&mut self, context: &Context, epoch: &SatelliteEpoch, guess: Guess) -> Ranged {
        let near = guess.antenna.or(self.known.map(|known| known.place.at));
        let point = SinglePoint::solve(context, epoch, near);
        let found = point.as_ref().ok();
        let place = self.place(epoch.tag, found);
        let antenna = guess.antenna.or(place.map(|place| place.at));
        let velocity = antenna.and_then(|at| DopplerVelocity::solve(context, epoch, &at));
        let clock = found.zip(velocity.as_ref()).and_then(|(point, velocity)| {
            let (_, clock) = point.clocks.first()?;
            Some((*clock, velocity.clock_drift))
        });
        if let Some((place, (clock, drift))) = place.zip(clock) {
            self.known = Some(Known { tag: epoch.tag, place, clock, drift });
        }
        let sampled = self.sampled(epoch.tag);
        let moved = antenna.and_then(|at| {
            let changes = self.tracker.advance(context, epoch, &at, guess.turned);
            let (before, was) = self.before.replace((sampled, at))?;
            let mut moved = CarrierDisplacement::solve(&changes, &was)?;
            moved.covariance *= self.tracker.scatter();
            Some((sampled.since(before), moved))
        });
        let (mut ranges, mut heard) = (Vec::new(), Vec::new());
        for signals in epoch.signals.chunk_by(|a, b| a.satellite == b.satellite) {
            let Some(own) = Heard::new(context, epoch.tag, signals) else { continue };
            let range = self.range(context, epoch.tag, &own, antenna.as_ref());
            heard.push(own.told(antenna.as_ref(), range.as_ref().err().copied(), found));
            ranges.extend(range);
        }
        Ranged { sampled, clock, ranges, heard, point, velocity, moved }
    }

    /// By what was known before and by this epoch.
    fn place(&self, tag: GpsTime, found: Option<&SinglePoint>) -> Option<Place> {
        let Some(known) = self.known else { return found.map(Place::of) };
        let elapsed = tag.since(known.tag).as_seconds();
        Some(found.map_or(known.place, |point| known.place.then(elapsed, point)))
    }

    /// By the clock as it was told last, carried on by its drift.
    fn sampled(&self, tag: GpsTime) -> GpsTime {
        let ahead = self.known.map_or(0.0, |known| {
            let elapsed = tag.since(known.tag).as_seconds();
            (known.clock + known.drift * elapsed) / SPEED_OF_LIGHT
        });
        tag.plus(Span::from_seconds(-ahead))
    }

    fn range(
        &self,
        context: &Context,
        tag: GpsTime,
        heard: &Heard<'_>,
        antenna: Option<&Vector3<f64>>,
    ) -> Result<SatelliteRange, RangeRefusal> {
        let (satellite, best) = (heard.satellite, &heard.best);
        if best.is_empty() {
            return Err(RangeRefusal::NoCode);
        }
        let (record, sight) = heard.orbit.as_ref().map_err(|why| RangeRefusal::NoOrbit(*why))?;
        let antenna = antenna.ok_or(RangeRefusal::NoPlace)?;
        let direction = sight.direction(antenna);
        if direction.elevation < LOWEST {
            return Err(RangeRefusal::Low { lowest: LOWEST });
        }
        let first = first_band(satellite.constellation);
        let shift = best.iter().find(|signal| signal.signal.band == first);
        let Combined { code, slow_std, by_ionosphere } =
            combined_code(context, tag, (record, sight, best), (antenna, direction))
                .ok_or(RangeRefusal::NoDelay)?;
        Ok(SatelliteRange {
            satellite,
            offset: Vector3::zeros(),
            transmitter: sight.transmitter(),
            elevation: direction.elevation,
            code: Some(code),
            rate: shift.and_then(|shift| {
                range_rate(context.noise, shift, &sight.satellite, direction.elevation)
            }),
            phase: self.tracker.phase(satellite),
            slow_std,
            by_ionosphere,
            multipath_std: context.noise.multipath * inflation(direction.elevation, None).sqrt(),
        })
    }
}
