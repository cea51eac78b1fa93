//! A long recording in a bounded number of bins: when they are used up, each two become one.

use insd_base::{Span, Time};

/// Bins at most: a chart has no more points across.
pub(crate) const LIMIT: usize = 1200;

/// What a bin holds.
pub(crate) trait Merge: Clone + Default {
    /// Takes in the bin after this one.
    fn merge(&mut self, later: &Self);
}

/// Equal bins from a start on.
#[derive(Clone, Debug)]
pub(crate) struct Bins<T> {
    start: Time,
    width: Span,
    limit: usize,
    bins: Vec<T>,
}

impl<T: Merge> Bins<T> {
    /// No bins yet; `width` is that of the first.
    pub(crate) fn new(start: Time, width: Span, limit: usize) -> Self {
        Bins { start, width: width.max(Span::from_nanos(1)), limit: limit.max(2), bins: Vec::new() }
    }

    /// Changes the bin of an instant. What was before the start belongs to the first bin.
    pub(crate) fn change(&mut self, time: Time, change: impl FnOnce(&mut T)) {
        let index = self.make_room(time);
        if let Some(bin) = self.bins.get_mut(index) {
            change(bin);
        }
    }

    /// Changes all bins that a span of time touches.
    pub(crate) fn change_all(&mut self, from: Time, to: Time, mut change: impl FnMut(&mut T)) {
        let last = self.make_room(to.max(from));
        let first = self.index(from).min(last);
        for bin in self.bins.iter_mut().take(last + 1).skip(first) {
            change(bin);
        }
    }

    /// Width of a bin.
    pub(crate) fn width(&self) -> Span {
        self.width
    }

    /// Each bin with its beginning.
    pub(crate) fn iter(&self) -> impl Iterator<Item = (Time, &T)> {
        (0..).map(|index| self.begin(index)).zip(&self.bins)
    }

    fn begin(&self, index: i64) -> Time {
        self.start + Span::from_nanos(self.width.as_nanos().saturating_mul(index))
    }

    fn index(&self, time: Time) -> usize {
        let since = (time - self.start).as_nanos().max(0);
        usize::try_from(since / self.width.as_nanos()).unwrap_or(usize::MAX)
    }

    /// Widens the bins until an instant has one; gives its index.
    fn make_room(&mut self, time: Time) -> usize {
        while self.index(time) >= self.limit {
            self.widen();
        }
        let index = self.index(time);
        if index >= self.bins.len() {
            self.bins.resize(index + 1, T::default());
        }
        index
    }

    fn widen(&mut self) {
        self.width = Span::from_nanos(self.width.as_nanos().saturating_mul(2));
        let pairs = self.bins.chunks(2).map(|pair| {
            let mut bins = pair.iter().cloned();
            let mut one = bins.next().unwrap_or_default();
            bins.for_each(|later| one.merge(&later));
            one
        });
        self.bins = pairs.collect();
    }
}

/// Least, greatest and sum of the values of a bin.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub(crate) struct Extent {
    count: u64,
    sum: f64,
    least: f64,
    greatest: f64,
}

impl Extent {
    /// Takes a value in; one that is no number says nothing.
    pub(crate) fn add(&mut self, value: f64) {
        if value.is_finite() {
            self.merge(&Extent { count: 1, sum: value, least: value, greatest: value });
        }
    }

    /// Mean, least, greatest; `None` of an empty bin.
    pub(crate) fn values(&self) -> Option<[f64; 3]> {
        let mean = self.sum / self.count as f64;
        (self.count > 0).then_some([mean, self.least, self.greatest])
    }
}

impl Merge for Extent {
    fn merge(&mut self, later: &Self) {
        if self.count == 0 {
            *self = *later;
        } else if later.count > 0 {
            self.count += later.count;
            self.sum += later.sum;
            self.least = self.least.min(later.least);
            self.greatest = self.greatest.max(later.greatest);
        }
    }
}

/// What was the case at some time in a bin, one bit each.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub(crate) struct Flags(pub(crate) u16);

impl Merge for Flags {
    fn merge(&mut self, later: &Self) {
        self.0 |= later.0;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bins<T: Merge>() -> Bins<T> {
        Bins::new(Time::from_seconds(100.0), Span::from_seconds(1.0), 8)
    }

    #[test]
    fn a_long_recording_needs_no_more_bins_and_loses_no_extreme() {
        let mut bins = bins::<Extent>();
        for second in 0..100_000 {
            let value = if second == 77_777 { -5.0 } else { f64::from(second % 3) };
            bins.change(Time::from_seconds(100.0 + f64::from(second)), |bin| bin.add(value));
        }
        assert!((5..=8).contains(&bins.iter().count()));
        let values: Vec<[f64; 3]> = bins.iter().filter_map(|(_, bin)| bin.values()).collect();
        let least = values.iter().map(|value| value[1]).fold(f64::MAX, f64::min);
        let greatest = values.iter().map(|value| value[2]).fold(f64::MIN, f64::max);
        assert_eq!((least, greatest), (-5.0, 2.0));
        assert!(values.iter().all(|value| (value[0] - 1.0).abs() < 1e-3));
        let count: u64 = bins.iter().map(|(_, bin)| bin.count).sum();
        assert_eq!(count, 100_000);
    }

    #[test]
    fn bins_begin_where_they_should_after_they_were_widened() {
        let mut bins = bins::<Flags>();
        for second in [100.0, 103.5, 119.9] {
            bins.change(Time::from_seconds(second), |bin| bin.0 |= 1);
        }
        assert_eq!(bins.width(), Span::from_seconds(4.0));
        let set = bins.iter().filter(|(_, bin)| bin.0 > 0);
        let begins: Vec<f64> = set.map(|(begin, _)| begin.as_seconds()).collect();
        assert_eq!(begins, [100.0, 116.0]);
    }

    #[test]
    fn what_lasts_is_in_every_bin_that_it_touches() {
        let mut bins = bins::<Flags>();
        let (from, to) = (Time::from_seconds(101.5), Time::from_seconds(103.5));
        bins.change_all(from, to, |bin| bin.0 |= 2);
        bins.change(Time::from_seconds(99.0), |bin| bin.0 |= 4);
        let flags: Vec<u16> = bins.iter().map(|(_, bin)| bin.0).collect();
        assert_eq!(flags, [4, 2, 2, 2]);
    }

    #[test]
    fn no_value_at_all_is_not_zero() {
        let mut bin = Extent::default();
        bin.add(f64::NAN);
        assert_eq!(bin.values(), None);
        bin.merge(&Extent::default());
        assert_eq!(bin.values(), None);
        bin.add(-2.0);
        assert_eq!(bin.values(), Some([-2.0, -2.0, -2.0]));
    }
}
