//! Epochs of a receiver, put together from its messages.
//!
//! Messages with the same time belong together; one that tells no time (VTG) belongs to the messages
//! it came with. An epoch is complete when everything has come that came with the last one, or when
//! the next one begins.

use std::collections::BTreeSet;

use insd_base::{FixQuality, Geodetic, GnssFix, GpsTime, Ned, Time};
use insd_wire::gnss::GnssPart;
use insd_wire::nmea::Position;

/// Instants that are no farther apart than this are one epoch, ns: receivers round the time of some of
/// their messages to a millisecond.
const SAME: i64 = 5_000_000;
/// A message without a time that comes this long after the one before it belongs to the next epoch, as
/// a share of the interval between epochs.
const NEXT: f64 = 0.4;

/// An epoch as far as it has been told.
#[derive(Clone, Debug, PartialEq)]
pub struct Epoch {
    /// Its instant.
    pub gps: GpsTime,
    /// When the first byte of its first message came.
    pub begun: Time,
    /// When the last byte of its last message came.
    pub ended: Time,
    /// What its messages say together.
    pub part: GnssPart,
    kinds: BTreeSet<&'static str>,
}

/// Puts epochs together.
#[derive(Clone, Debug, Default)]
pub struct EpochBuilder {
    current: Option<Epoch>,
    /// Came without a time, after a pause: they wait for the next epoch.
    early: Vec<GnssPart>,
    usual: BTreeSet<&'static str>,
    sent: Option<GpsTime>,
    last: Option<(GpsTime, Time)>,
    interval: Option<f64>,
}

impl EpochBuilder {
    /// Takes what a message says; `gps`: its resolved time, if it tells one. Gives the epoch that it
    /// completes, or that it ends by beginning the next.
    pub fn take(
        &mut self,
        part: &GnssPart,
        gps: Option<GpsTime>,
        begun: Time,
        ended: Time,
    ) -> Option<Epoch> {
        let Some(gps) = gps else { return self.take_timeless(part, ended) };
        if self.sent.is_some_and(|sent| is_same(sent, gps)) {
            // a kind that usually does not come: the epoch has gone, and next time it is waited for
            self.usual.insert(part.kind);
            return None;
        }
        let ended_by_next = self.current.as_ref().is_some_and(|epoch| !is_same(epoch.gps, gps));
        let before = if ended_by_next { self.finish() } else { None };
        if self.current.is_none() {
            self.begin(gps, begun, ended);
        }
        self.add(part, ended);
        before.or_else(|| self.complete())
    }

    fn take_timeless(&mut self, part: &GnssPart, ended: Time) -> Option<Epoch> {
        let pause = self.interval.map_or(0.5, |interval| NEXT * interval);
        let since = self.last.map(|(_, last)| (ended - last).as_seconds());
        if since.is_none_or(|since| since > pause) {
            self.early.retain(|early| early.kind != part.kind);
            self.early.push(*part);
            return None;
        }
        if self.current.is_some() {
            self.add(part, ended);
            return self.complete();
        }
        self.usual.insert(part.kind);
        None
    }

    fn begin(&mut self, gps: GpsTime, begun: Time, ended: Time) {
        if let Some((before, _)) = self.last {
            let interval = (gps.as_nanos() - before.as_nanos()) as f64 * 1e-9;
            if interval > 0.0 {
                self.interval = Some(self.interval.map_or(interval, |own| own.min(interval)));
            }
        }
        self.last = Some((gps, ended));
        let part = GnssPart::default();
        self.current = Some(Epoch { gps, begun, ended, part, kinds: BTreeSet::new() });
        for early in std::mem::take(&mut self.early) {
            self.add(&early, ended);
        }
    }

    fn add(&mut self, part: &GnssPart, ended: Time) {
        if let Some(epoch) = &mut self.current {
            merge(&mut epoch.part, part);
            epoch.kinds.insert(part.kind);
            epoch.ended = ended;
            self.last = Some((epoch.gps, ended));
        }
    }

    /// The epoch, if nothing is missing that came with the one before.
    fn complete(&mut self) -> Option<Epoch> {
        let epoch = self.current.as_ref()?;
        let all = !self.usual.is_empty() && self.usual.is_subset(&epoch.kinds);
        if all { self.finish() } else { None }
    }

    /// Ends the epoch; one of which nothing but sigmas or a date has come is none.
    fn finish(&mut self) -> Option<Epoch> {
        let epoch = self.current.take()?;
        self.usual.clone_from(&epoch.kinds);
        self.sent = Some(epoch.gps);
        Some(epoch).filter(|epoch| tells_something(&epoch.part))
    }
}

fn is_same(a: GpsTime, b: GpsTime) -> bool {
    (a.as_nanos() - b.as_nanos()).abs() <= SAME
}

/// Enters what a message says into what others have said; of two that say the same the first stays, but
/// a message that tells nothing but sigmas (a covariance) knows them better than one that tells a value.
fn merge(into: &mut GnssPart, part: &GnssPart) {
    fn keep<T: Copy>(own: &mut Option<T>, new: Option<T>) {
        *own = own.or(new);
    }
    fn each(own: &mut [Option<f64>; 3], new: &[Option<f64>; 3]) {
        for (own, new) in own.iter_mut().zip(new) {
            keep(own, *new);
        }
    }
    let bare = part.position.is_none()
        && part.horizontal.is_none()
        && part.velocity.iter().all(Option::is_none);
    let sigmas = |own: &mut [Option<f64>; 3], new: &[Option<f64>; 3]| {
        let told = *own;
        if bare {
            *own = *new;
            each(own, &told);
        } else {
            each(own, new);
        }
    };
    keep(&mut into.position, part.position);
    keep(&mut into.horizontal, part.horizontal);
    sigmas(&mut into.position_std, &part.position_std);
    each(&mut into.velocity, &part.velocity);
    sigmas(&mut into.velocity_std, &part.velocity_std);
    keep(&mut into.heading, part.heading);
    keep(&mut into.heading_std, part.heading_std);
    keep(&mut into.hdop, part.hdop);
    keep(&mut into.satellites, part.satellites);
    keep(&mut into.quality, part.quality);
    into.invalid |= part.invalid;
}

impl Epoch {
    /// Whether the receiver stands behind this epoch.
    #[must_use]
    pub fn is_valid(&self) -> bool {
        !self.part.invalid && self.quality().is_measured()
    }

    /// Whether it tells a heading and nothing beside, as receivers do that were told to be a compass and no more.
    #[must_use]
    pub fn is_compass(&self) -> bool {
        let part = &self.part;
        let moves = part.velocity.iter().any(Option::is_some);
        let told =
            part.position.is_some() || part.horizontal.is_some() || moves || part.quality.is_some();
        part.heading.is_some() && !told && !part.invalid
    }

    /// What the receiver says of its fix: autonomous if it gives a position and says nothing.
    #[must_use]
    pub fn quality(&self) -> FixQuality {
        let placed = self.part.position.is_some() || self.part.horizontal.is_some();
        let silent = if placed { FixQuality::Autonomous } else { FixQuality::Invalid };
        self.part.quality.unwrap_or(silent)
    }

    /// The fix at an instant of the ship's time line. A component that the receiver does not tell has an
    /// infinite sigma.
    #[must_use]
    pub fn fix(&self, time: Time) -> GnssFix {
        let part = &self.part;
        let [north, east, down] = part.velocity;
        let velocity = north.zip(east).map(|(n, e)| Ned::new(n, e, down.unwrap_or(0.0)));
        let mut velocity_std = sigmas(&part.velocity_std);
        if velocity.is_some() && down.is_none() {
            let [n, e, _] = part.velocity_std.map(|std| std.unwrap_or(f64::NAN));
            velocity_std = Some(Ned::new(n, e, f64::INFINITY));
        }
        let (position, position_std) = self.place();
        GnssFix {
            time,
            position,
            velocity,
            position_std,
            velocity_std,
            hdop: part.hdop,
            satellites: part.satellites,
            quality: if self.is_valid() { self.quality() } else { FixQuality::Invalid },
            lever: None,
            redated: 0.0,
            rank: 0,
        }
    }
}

impl Epoch {
    /// Position and its sigmas: where the height is not told, that of the ellipsoid with an infinite one.
    fn place(&self) -> (Option<Geodetic>, Option<Ned>) {
        let std = sigmas(&self.part.position_std);
        if self.part.position.is_some() {
            return (self.part.position, std);
        }
        let Some(Position { latitude, longitude }) = self.part.horizontal else {
            return (None, std);
        };
        let [n, e, _] = self.part.position_std.map(|std| std.unwrap_or(f64::NAN));
        let place = Geodetic { latitude, longitude, height: 0.0 };
        (Some(place), Some(Ned::new(n, e, f64::INFINITY)))
    }
}

/// Whether there is more in it than sigmas and a date.
fn tells_something(part: &GnssPart) -> bool {
    let place = part.position.is_some() || part.horizontal.is_some();
    let motion = part.velocity.iter().any(Option::is_some) || part.heading.is_some();
    place || motion || part.quality.is_some() || part.invalid
}

fn sigmas(std: &[Option<f64>; 3]) -> Option<Ned> {
    let any = std.iter().any(Option::is_some);
    any.then(|| {
        let [n, e, d] = std.map(|std| std.unwrap_or(f64::NAN));
        Ned::new(n, e, d)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The epochs of messages: kind, second, and what they say.
    fn epochs(messages: &[(&'static str, i64, GnssPart)]) -> Vec<Epoch> {
        let mut builder = EpochBuilder::default();
        let built = messages.iter().filter_map(|(kind, second, part)| {
            let gps = GpsTime::from_nanos(second * 1_000_000_000);
            let now = Time::from_seconds(*second as f64 + 0.1);
            builder.take(&GnssPart { kind, ..*part }, Some(gps), now, now)
        });
        built.collect()
    }

    fn value() -> GnssPart {
        let position = Some(Geodetic::default());
        let (position_std, velocity) = ([Some(9.0); 3], [Some(1.0); 3]);
        GnssPart { position, position_std, velocity, ..GnssPart::default() }
    }

    fn covariance() -> GnssPart {
        let position_std = [Some(1.0), Some(2.0), None];
        GnssPart { position_std, velocity_std: [Some(0.1); 3], ..GnssPart::default() }
    }

    #[test]
    fn a_covariance_knows_sigmas_better_than_the_message_of_the_value() {
        for order in [[("A", value()), ("B", covariance())], [("B", covariance()), ("A", value())]]
        {
            let messages = (1..4).flat_map(|second| order.map(|(kind, part)| (kind, second, part)));
            let messages: Vec<_> = messages.collect();
            let last = epochs(&messages).pop().unwrap();
            assert_eq!(last.part.position_std, [Some(1.0), Some(2.0), Some(9.0)]);
            assert_eq!(last.part.velocity_std, [Some(0.1); 3]);
        }
    }

    #[test]
    fn an_epoch_of_which_nothing_but_sigmas_came_is_none() {
        let (a, b) = (("A", value()), ("B", covariance()));
        let messages = [a, b, a, b, b, a, b, a, b].into_iter().zip([1, 1, 2, 2, 3, 4, 4, 5, 5]);
        let messages: Vec<_> = messages.map(|((kind, part), at)| (kind, at, part)).collect();
        let seconds: Vec<i64> =
            epochs(&messages).iter().map(|epoch| epoch.gps.as_nanos() / 1_000_000_000).collect();
        assert_eq!(seconds, [1, 2, 4, 5]);
    }
}
