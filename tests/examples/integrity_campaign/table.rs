//! The voyages of a kind as a row of the table.

use insd_lab::evaluation::share_of_independent;

use crate::outcome::Outcome;

/// Its head.
pub(crate) const HEAD: &str = "| what is wrong | voyages | hazardous: voyages (up to, %), longest in all, s | misleading: voyages (up to, %), longest in all, s \
| error over level | told after, s: median, last | available, % | error, 95 % of voyages, m | false alerts, h |\n|---|---|---|---|---|---|---|---|---|\n";

/// One row.
pub(crate) fn row(name: &str, all: &[&Outcome]) -> String {
    let part = |of: fn(&Outcome) -> usize| {
        let voyages = all.iter().filter(|own| of(own) > 0).count();
        let longest = all.iter().map(|own| of(own) as f64 * own.step).fold(0.0, f64::max);
        let (_, high) = share_of_independent(voyages as f64 / all.len() as f64, all.len() as f64);
        format!("{voyages} ({:.0}), {longest:.0}", 100.0 * high)
    };
    let sum = |of: fn(&Outcome) -> usize| all.iter().map(|own| of(own)).sum::<usize>();
    let mut told: Vec<f64> = all.iter().flat_map(|own| own.told.iter().copied()).collect();
    told.sort_by(f64::total_cmp);
    let told = match (told.get(told.len() / 2), told.last()) {
        (Some(median), Some(last)) => format!("{median:.1}, {last:.1} ({})", told.len()),
        _ => "-".to_owned(),
    };
    let mut errors: Vec<f64> = all.iter().map(|own| own.error).collect();
    errors.sort_by(f64::total_cmp);
    let error = errors.get((0.95 * errors.len() as f64) as usize).copied().unwrap_or_default();
    let hours = all.iter().map(|own| own.honest).sum::<f64>() / 3600.0;
    format!(
        "| {name} | {} | {} | {} | {:.2} | {told} | {:.0} | {error:.1} | {} in {hours:.1} |\n",
        all.len(),
        part(|own| own.hazardous),
        part(|own| own.misleading),
        all.iter().map(|own| own.ratio.0).fold(0.0, f64::max),
        100.0 * sum(|own| own.available) as f64 / sum(|own| own.epochs).max(1) as f64,
        sum(|own| own.alerts),
    )
}
