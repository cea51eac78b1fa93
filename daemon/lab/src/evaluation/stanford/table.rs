//! The report on integrity for people.

use std::fmt;

use super::{IntegrityReport, LevelsOfAxis, Tally};
use crate::table::{Align, Table, significant};

/// What may mislead: 1e-5 in three hours (IMO A.915(22)).
const RISK: f64 = 1e-5;
const EXPOSURE: f64 = 3.0 * 3600.0;

impl fmt::Display for IntegrityReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (epochs, from, to) = (self.horizontal.epochs, self.from_s, self.to_s);
        writeln!(f, "{} against {}: {epochs} epochs, {from} s to {to} s", self.nav, self.truth)?;
        if let Some(requirement) = self.alert_limit.requirement {
            writeln!(f, "{requirement}: alert limit {} m", self.alert_limit.limit_m)?;
        }
        axis(f, "horizontal", &self.horizontal, self.alert_limit.accuracy_m)?;
        if let Some(vertical) = &self.vertical {
            axis(f, "vertical", vertical, None)?;
        } else {
            writeln!(f, "\nvertical levels are not in the file")?;
        }
        writeln!(
            f,
            "\nThe intervals hold the true share with 95 % confidence (Clopper and Pearson), for as many independent \
             samples\nas the epochs are worth by the autocorrelation of the errors; 0 of n allows 3 / n."
        )
    }
}

fn axis(
    f: &mut fmt::Formatter<'_>,
    name: &str,
    own: &LevelsOfAxis,
    accuracy_m: Option<f64>,
) -> fmt::Result {
    write!(f, "\n{}", tallies(name, own))?;
    let besides = [
        (own.without_level, "without a level"),
        (own.not_to_be_used, "told not to be used"),
        (own.exceeded_unavailable, "with an error beyond the level all the same"),
    ];
    let besides = besides.iter().filter(|(count, _)| *count > 0);
    let besides: Vec<String> = besides.map(|(count, what)| format!("{count} {what}")).collect();
    if !besides.is_empty() {
        writeln!(f, "of the unavailable epochs {}", besides.join(", "))?;
    }
    let metres = |value: Option<f64>| value.map_or("-".to_owned(), |value| significant(value, 3));
    write!(f, "95 % of errors within {} m", metres(own.error_p95_m))?;
    if let Some((asked, found)) = accuracy_m.zip(own.error_p95_m) {
        let word = if found <= asked { "met" } else { "not met" };
        write!(f, " (asked: {asked} m, {word})")?;
    }
    write!(f, ", median level {} m", metres(own.level_median_m))?;
    let times = own.level_over_error().map(|ratio| significant(ratio, 3));
    writeln!(f, "{}", times.map_or(String::new(), |ratio| format!(", {ratio} times that error")))?;
    if let Some((ratio, at)) = own.worst_ratio.zip(own.worst_at_s) {
        writeln!(f, "largest error over level: {} at {at:.1} s", significant(ratio, 3))?;
    }
    worth(f, own)
}

/// What the sample is worth, beside what would have to be proven.
fn worth(f: &mut fmt::Formatter<'_>, own: &LevelsOfAxis) -> fmt::Result {
    let Some(worth) = own.independence else {
        return writeln!(f, "no level is known: nothing to judge");
    };
    let (time, samples) = (worth.correlation_time_s, worth.samples);
    let risk = RISK * time / EXPOSURE;
    writeln!(
        f,
        "errors are independent after {} s: the epochs are worth {} samples; 1e-5 in 3 h is {risk:.0e} for each of \
         them,\nwhich takes {:.0e} without an error beyond the level to show",
        significant(time, 3),
        significant(samples, 3),
        3.0 / risk,
    )
}

fn tallies(name: &str, own: &LevelsOfAxis) -> Table {
    let right = |name| (name, Align::Right);
    let title = format!("{name} at {} m", own.limit_m);
    let mut table = Table::new(&[
        (&title, Align::Left),
        right("epochs"),
        right("%"),
        ("95 % interval", Align::Left),
        right("pieces"),
        right("longest s"),
        right("first s"),
    ]);
    let mut row = |what: &str, tally: &Tally| {
        table.push(vec![
            what.to_owned(),
            tally.epochs.to_string(),
            percent(tally.share),
            format!("{} to {}", percent(tally.low), percent(tally.high)),
            tally.pieces.to_string(),
            format!("{:.1}", tally.longest_s),
            tally.first_s.map_or("-".to_owned(), |first| format!("{first:.1}")),
        ]);
    };
    row("available", &own.available);
    row("  nominal", &own.nominal);
    row("  misleading", &own.misleading);
    row("  hazardous", &own.hazardous);
    row("unavailable", &own.unavailable);
    row("error beyond level", &own.exceeded);
    table
}

/// A share in percent; two digits of what is small, and of what lacks little to all.
fn percent(share: f64) -> String {
    let percent = 100.0 * share;
    let small = percent.min(100.0 - percent);
    if !percent.is_finite() {
        "-".to_owned()
    } else if small < 1e-6 {
        format!("{percent:.0}")
    } else {
        let places = (1.0 - small.log10().floor()).clamp(1.0, 6.0) as usize;
        format!("{percent:.places$}")
    }
}

#[cfg(test)]
mod tests {
    use super::percent;

    #[test]
    fn a_share_keeps_two_digits_of_what_is_small() {
        let told = [0.0, 1.0, 1e-9, 0.5, 0.012_34, 0.000_012_34, 0.999_87, f64::NAN].map(percent);
        assert_eq!(told, ["0", "100", "0", "50.0", "1.2", "0.0012", "99.987", "-"]);
    }
}
