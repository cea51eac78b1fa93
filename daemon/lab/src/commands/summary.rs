//! What a replay tells on standard error.

use std::fmt;

use insd_base::{
    AlignmentStatus, Counts, Event, Finding, Forecast, Mode, SatelliteId, Stands, Time,
};
use insd_drivers::recording::FileReport;

use crate::table::{Align, Table};

/// Changes of mode that are told one by one.
const MODES_TOLD: usize = 40;

/// The forecast of this time into the voyage is told, s.
const TOLD: f64 = 120.0;

/// Everything that was used, rejected, floored, bridged and skipped.
pub(super) struct Summary<'a> {
    pub(super) solutions: u64,
    pub(super) left_out: u64,
    pub(super) alignment: &'a [AlignmentStatus],
    pub(super) modes: &'a [(Time, Mode)],
    pub(super) departures: &'a [Time],
    pub(super) resets: &'a [Time],
    pub(super) findings: &'a [(Time, Finding)],
    pub(super) standings: &'a [Stands],
    pub(super) satellites: &'a [(Time, SatelliteId, bool)],
    pub(super) stored: Option<&'a Event>,
    pub(super) counts: &'a Counts,
    pub(super) dropped: u64,
    pub(super) files: Vec<&'a FileReport>,
}

impl fmt::Display for Summary<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let imu = self.counts.imu_samples;
        writeln!(f, "{} solutions from {imu} IMU samples", self.solutions)?;
        for (count, what) in [
            (self.left_out, "solutions left out: not finite"),
            (self.counts.imu_gaps, "gaps in the IMU data bridged"),
            (self.counts.imu_duplicates, "IMU samples repeated"),
            (self.counts.imu_out_of_order, "IMU samples out of order"),
            (self.counts.imu_out_of_range, "IMU samples out of range"),
            (self.dropped, "messages dropped by --outage"),
        ] {
            if count > 0 {
                writeln!(f, "{count} {what}")?;
            }
        }
        for (counts, what) in [
            (&self.counts.unranged, "satellites without a range"),
            (&self.counts.rtk, "epochs against the base"),
        ] {
            if !counts.is_empty() {
                let told: Vec<String> =
                    counts.iter().map(|(word, count)| format!("{count} {word}")).collect();
                writeln!(f, "{what}: {}", told.join(", "))?;
            }
        }
        self.files.iter().try_for_each(|report| write_report(f, report))?;
        self.write_modes(f)?;
        self.write_alignment(f)?;
        let aids = aid_table(self.counts);
        if let Some(aids) = aids {
            write!(f, "\n{aids}")?;
        }
        Ok(())
    }
}

impl Summary<'_> {
    fn write_modes(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{} mode changes", self.modes.len())?;
        for (time, mode) in self.modes.iter().take(MODES_TOLD) {
            writeln!(f, "  {:>10.1} s  {}", time.as_seconds(), mode.as_str())?;
        }
        if self.modes.len() > MODES_TOLD {
            writeln!(f, "  ... and {} more", self.modes.len() - MODES_TOLD)?;
        }
        for time in self.departures.iter().take(MODES_TOLD) {
            writeln!(f, "  {:>10.1} s  left the berth", time.as_seconds())?;
        }
        for time in self.resets.iter().take(MODES_TOLD) {
            writeln!(f, "  {:>10.1} s  position set anew", time.as_seconds())?;
        }
        for (time, finding) in self.findings {
            writeln!(f, "  {:>10.1} s  {finding}", time.as_seconds())?;
        }
        for stands in self.standings.iter().take(MODES_TOLD) {
            writeln!(f, "  {:>10.1} s  {stands}", stands.since.as_seconds())?;
        }
        if self.standings.len() > MODES_TOLD {
            writeln!(f, "  ... and {} more of the sensors", self.standings.len() - MODES_TOLD)?;
        }
        for (time, satellite, is_excluded) in self.satellites.iter().take(MODES_TOLD) {
            let what = if *is_excluded { "is left out" } else { "is used again" };
            writeln!(f, "  {:>10.1} s  {satellite} {what}", time.as_seconds())?;
        }
        if self.satellites.len() > MODES_TOLD {
            writeln!(f, "  ... and {} more of the satellites", self.satellites.len() - MODES_TOLD)?;
        }
        match self.stored {
            Some(Event::StoredStateUsed { time }) => {
                writeln!(f, "  {:>10.1} s  stored heading confirmed", time.as_seconds())
            }
            Some(Event::StoredStateDropped { time, reason }) => {
                let (time, reason) = (time.as_seconds(), reason.as_str());
                writeln!(f, "  {time:>10.1} s  stored state dropped: {reason}")
            }
            _ => Ok(()),
        }
    }

    /// What the alignment said after two minutes, what came of it, and the sea.
    fn write_alignment(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Some(last) = self.alignment.last() else { return Ok(()) };
        let told = Time::from_seconds(TOLD);
        let early = self.alignment.iter().find(|status| status.time >= told);
        writeln!(f, "alignment")?;
        for status in early.filter(|early| early.time < last.time).into_iter().chain([last]) {
            writeln!(f, "  {:>10.1} s  {status}", status.time.as_seconds())?;
        }
        let is_reached = |status: &AlignmentStatus| {
            let sigma = status.sigma.map(|sigma| sigma.heading);
            sigma.zip(status.target).is_some_and(|(sigma, target)| sigma <= target)
        };
        let unforeseen =
            matches!(last.ready, Forecast::Unreachable { .. } | Forecast::Unknown { .. });
        if unforeseen && !self.alignment.iter().any(is_reached) {
            writeln!(f, "  the heading never was as good as is asked for")?;
        }
        if let Some(sea) = last.sea {
            let period = sea.period.map_or("no period".to_owned(), |t| format!("every {t:.1} s"));
            let (heave, level) = (sea.significant_heave, sea.significant_horizontal);
            writeln!(f, "  heave {heave:.2} m {period}, {level:.2} m horizontally (significant)")?;
        }
        if let Some(fit) = last.fit {
            writeln!(f, "  model of the sea {fit}")?;
        }
        Ok(())
    }
}

fn write_report(f: &mut fmt::Formatter<'_>, report: &FileReport) -> fmt::Result {
    let (file, rows) = (&report.file, report.rows);
    if !report.absent.is_empty() {
        writeln!(f, "{file}: no column {}: not available", report.absent.join(", "))?;
    }
    if report.faulty() == 0 {
        return Ok(());
    }
    let reasons = report.skipped.iter().map(|(fault, count)| (fault.as_str(), *count));
    let unsorted = (report.unsorted > 0).then_some(("unsorted, passed on", report.unsorted));
    let reasons: Vec<String> =
        reasons.chain(unsorted).map(|(reason, count)| format!("{count} {reason}")).collect();
    writeln!(
        f,
        "{file}: {} of {rows} rows skipped ({})",
        report.skipped_total(),
        reasons.join(", ")
    )?;
    report.examples.iter().try_for_each(|row| writeln!(f, "  {file}:{row}"))
}

/// Measurements by aid: used, floored, rejected with the reason. `None` if there were none.
fn aid_table(counts: &Counts) -> Option<Table> {
    let mut aids: Vec<&str> = counts.accepted.keys().copied().collect();
    aids.extend(counts.rejected.keys().map(|(aid, _)| *aid));
    aids.extend(counts.floored.keys().copied());
    aids.sort_unstable();
    aids.dedup();
    let (left, right) = (Align::Left, Align::Right);
    let columns = [
        ("aid", left),
        ("used", right),
        ("floored", right),
        ("rejected", right),
        ("because", left),
    ];
    let mut table = Table::new(&columns);
    for aid in &aids {
        let rejected = counts.rejected.iter().filter(|((of, _), _)| of == aid);
        let reasons: Vec<String> =
            rejected.clone().map(|((_, why), count)| format!("{count} {}", why.as_str())).collect();
        table.push(vec![
            (*aid).to_owned(),
            counts.accepted.get(aid).copied().unwrap_or(0).to_string(),
            counts.floored.get(aid).copied().unwrap_or(0).to_string(),
            rejected.map(|(_, count)| count).sum::<u64>().to_string(),
            reasons.join(", "),
        ]);
    }
    (!aids.is_empty()).then_some(table)
}

#[cfg(test)]
mod tests {
    use super::*;
    use insd_base::Rejection;

    #[test]
    fn rejections_stand_beside_their_aid_with_their_reason() {
        let mut counts = Counts::default();
        counts.accepted.insert("gnss_position", 90);
        counts.rejected.insert(("gnss_position", Rejection::ChiSquare), 7);
        counts.rejected.insert(("gnss_position", Rejection::DopTest), 3);
        counts.rejected.insert(("log_bottom", Rejection::NotUsable), 1);
        counts.unranged.extend([("low", 41), ("no_orbit", 2)]);
        let text = Summary {
            solutions: 5,
            left_out: 0,
            alignment: &[],
            modes: &[(Time::from_seconds(12.0), Mode::Aided)],
            departures: &[Time::from_seconds(77.0)],
            resets: &[],
            findings: &[],
            standings: &[],
            satellites: &[],
            stored: None,
            counts: &counts,
            dropped: 2,
            files: Vec::new(),
        }
        .to_string();
        assert!(text.contains("90        0        10  7 chi_square, 3 dop_test"), "{text}");
        assert!(text.contains("77.0 s  left the berth"), "{text}");
        assert!(text.contains("satellites without a range: 41 low, 2 no_orbit\n"), "{text}");
        assert!(text.contains("12.0 s  aided") && text.contains("2 messages dropped"), "{text}");
    }
}
