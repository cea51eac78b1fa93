//! The table of a campaign.

use std::fmt::Write as _;

use crate::outages::{End, LENGTHS};

/// Its head.
pub(crate) const HEAD: &str = "| ships | outage | without: median, 95 %, RMS, m | with | ratio | NEES without, with | largest in sigmas without, with |\n\
     |---|---|---|---|---|---|---|\n";

/// Median, 95th percentile and RMS, mean of the normalised squares, and the largest error in sigmas.
struct Figures {
    errors: [f64; 3],
    nees: f64,
    largest: f64,
}

impl Figures {
    fn of(ends: &[&End]) -> Self {
        let mut errors: Vec<f64> = ends.iter().map(|end| end.error).collect();
        errors.sort_by(f64::total_cmp);
        let quantile = |share: f64| {
            let at = ((errors.len().saturating_sub(1)) as f64 * share).round() as usize;
            errors.get(at).copied().unwrap_or(f64::NAN)
        };
        let n = errors.len() as f64;
        let rms = (errors.iter().map(|error| error * error).sum::<f64>() / n).sqrt();
        let largest = ends.iter().map(|end| end.square).fold(0.0, f64::max).sqrt();
        let nees = ends.iter().map(|end| end.square / 2.0).sum::<f64>() / n;
        Figures { errors: [quantile(0.5), quantile(0.95), rms], nees, largest }
    }

    fn errors(&self) -> String {
        self.errors.map(|error| format!("{error:.2}")).join(", ")
    }
}

/// The rows of ships, one for each length.
pub(crate) fn rows(name: &str, without: &[End], with: &[End]) -> String {
    let mut text = String::new();
    for (i, length) in LENGTHS.iter().enumerate() {
        let of = |ends: &[End]| -> (usize, Figures) {
            let own: Vec<&End> = ends.iter().filter(|end| end.length == i).collect();
            (own.len(), Figures::of(&own))
        };
        let ((n, a), (_, b)) = (of(without), of(with));
        let ratio: Vec<String> =
            a.errors.iter().zip(b.errors).map(|(a, b)| format!("{:.2}", b / a)).collect();
        let _ = writeln!(
            text,
            "| {name} | {length:.0} s ({n}) | {} | {} | {} | {:.2}, {:.2} | {:.1}, {:.1} |",
            a.errors(),
            b.errors(),
            ratio.join(", "),
            a.nees,
            b.nees,
            a.largest,
            b.largest
        );
    }
    text
}
