//! Quantiles of ages in bounded memory: bins that are equally wide up to half a millisecond, and then a
//! 32nd of each power of two.

use insd_base::Span;

/// Nanoseconds of the narrowest bin, as a power of two: 16.4 microseconds.
const UNIT: u32 = 14;

/// Bins of a power of two, as a power of two.
const FINE: u32 = 5;

/// Enough for a minute; what is longer is in the last bin.
const BINS: usize = 18 << FINE;

/// When so many have been counted all counts are halved, so that what is long ago fades.
const FADING: u32 = 1 << 16;

/// Counts of lengths of time.
#[derive(Debug)]
pub(super) struct Histogram {
    bins: Box<[u32; BINS]>,
    total: u32,
}

impl Default for Histogram {
    fn default() -> Self {
        Histogram { bins: Box::new([0; BINS]), total: 0 }
    }
}

impl Histogram {
    /// Counts one; a negative one as zero.
    pub(super) fn count(&mut self, span: Span) {
        if let Some(bin) = self.bins.get_mut(bin_of(span)) {
            *bin += 1;
            self.total += 1;
        }
        if self.total >= FADING {
            self.bins.iter_mut().for_each(|bin| *bin /= 2);
            self.total = self.bins.iter().sum();
        }
    }

    /// The upper edge of the bin below whose end this part of all is, 0 to 1; zero if nothing was counted.
    pub(super) fn quantile(&self, part: f64) -> Span {
        let wanted = (f64::from(self.total) * part).ceil() as u32;
        let mut below = 0;
        for (bin, count) in self.bins.iter().enumerate() {
            below += count;
            if below > 0 && below >= wanted {
                return upper_edge(bin);
            }
        }
        Span::ZERO
    }
}

fn bin_of(span: Span) -> usize {
    let units = span.as_nanos().max(0).unsigned_abs() >> UNIT;
    let shift = units.checked_ilog2().unwrap_or(0).saturating_sub(FINE);
    let bin = (u64::from(shift) << FINE) + (units >> shift);
    (bin as usize).min(BINS - 1)
}

fn upper_edge(bin: usize) -> Span {
    let bin = bin as i64;
    let shift = ((bin >> FINE) - 1).max(0);
    let units = (bin - (shift << FINE) + 1) << shift;
    Span::from_nanos(units << UNIT)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_length_is_below_the_edge_of_its_bin_by_3_percent_at_most() {
        let mut nanos = 1_i64;
        while nanos < 60_000_000_000 {
            let edge = upper_edge(bin_of(Span::from_nanos(nanos))).as_nanos();
            let slack = (1 << UNIT).max(nanos / 32 + 1);
            assert!(nanos < edge && edge <= nanos + slack, "{nanos} {edge}");
            nanos += nanos / 57 + 1;
        }
        assert_eq!(bin_of(Span::from_nanos(i64::MAX)), BINS - 1);
    }

    #[test]
    fn the_median_and_the_tail_are_found() {
        let mut histogram = Histogram::default();
        assert_eq!(histogram.quantile(0.5), Span::ZERO);
        for millis in 1..=1000 {
            histogram.count(Span::from_nanos(millis * 1_000_000));
        }
        for (part, seconds) in [(0.5, 0.5), (0.99, 0.99)] {
            let quantile = histogram.quantile(part).as_seconds();
            assert!(quantile >= seconds && quantile < seconds * 1.032, "{quantile}");
        }
    }

    #[test]
    fn what_is_long_ago_fades() {
        let mut histogram = Histogram::default();
        for span in [Span::from_seconds(1.0), Span::from_seconds(0.01)] {
            (0..4 * FADING).for_each(|_| histogram.count(span));
        }
        assert!(histogram.quantile(0.5).as_seconds() < 0.011);
        assert!(histogram.total < FADING);
    }
}
