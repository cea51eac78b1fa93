//! A replay as counts and sums: for archives, whose solutions nobody keeps.

use std::collections::BTreeMap;

use insd_base::{Counts, Time};
use insd_drivers::raw::RawRead;
use insd_drivers::recording::{FileReport, NavRow};
use serde::{Deserialize, Serialize};

use crate::evaluation::is_told;

/// Solutions that lie further apart are not joined, s.
const APART: f64 = 10.0;

/// What a replay comes to. Divided by their counts the sums are means, and sums of several recordings may be added.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ReplaySums {
    /// From the first message to the last one, s.
    pub duration_s: f64,
    /// Solutions.
    pub solutions: u64,
    /// Solutions that were left out because they were not finite.
    pub left_out: u64,
    /// Solutions that may be used, for all that mode and integrity say.
    pub told: u64,
    /// Of those: the horizontal protection level is known and within the alert limit.
    pub available: u64,
    /// Solutions by their mode.
    pub modes: BTreeMap<String, u64>,
    /// Way made over ground by the solutions that may be used, m.
    pub way_m: f64,
    /// Sum over those of the claimed variance of the horizontal position, north and east together, m^2.
    pub sum_horizontal_m2: f64,
    /// Sum over those of the claimed variance of the heading, rad^2.
    pub sum_heading_rad2: f64,
    /// Samples of the IMU that were used.
    pub imu_samples: u64,
    /// Gaps in the IMU data that were bridged.
    pub imu_gaps: u64,
    /// Measurements used, by aid.
    pub used: BTreeMap<String, u64>,
    /// Measurements not used, by aid and reason with a colon between them.
    pub rejected: BTreeMap<String, u64>,
}

impl ReplaySums {
    /// Adds those of another one.
    pub(in crate::commands) fn add(&mut self, other: &ReplaySums) {
        self.duration_s += other.duration_s;
        self.solutions += other.solutions;
        self.left_out += other.left_out;
        self.told += other.told;
        self.available += other.available;
        self.way_m += other.way_m;
        self.sum_horizontal_m2 += other.sum_horizontal_m2;
        self.sum_heading_rad2 += other.sum_heading_rad2;
        self.imu_samples += other.imu_samples;
        self.imu_gaps += other.imu_gaps;
        let counts = [
            (&mut self.modes, &other.modes),
            (&mut self.used, &other.used),
            (&mut self.rejected, &other.rejected),
        ];
        for (own, others) in counts {
            for (word, count) in others {
                *own.entry(word.clone()).or_default() += count;
            }
        }
    }
}

/// A replay that is over.
#[derive(Debug, Default)]
pub(in crate::commands) struct Summed {
    /// Counts and sums.
    pub(in crate::commands) sums: ReplaySums,
    /// Rows of a voyage that could not be read.
    pub(in crate::commands) faulty_rows: u64,
    /// What the reader of a raw recording met, all runs together.
    pub(in crate::commands) read: RawRead,
    /// Runs of the program in a raw recording; none in a voyage.
    pub(in crate::commands) runs: u32,
    /// The program that recorded it.
    pub(in crate::commands) program: Option<String>,
}

/// The sums of a replay that goes on.
pub(in crate::commands) struct Summing {
    /// Alert limit of the horizontal position, m.
    alert_limit: f64,
    summed: Summed,
    /// First and last message.
    heard: Option<(Time, Time)>,
    /// Time and speed over ground, m/s, of the last solution that may be used.
    last: Option<(Time, f64)>,
}

impl Summing {
    /// Before the first message.
    pub(in crate::commands) fn new(alert_limit: f64) -> Self {
        Summing { alert_limit, summed: Summed::default(), heard: None, last: None }
    }

    /// A message was received.
    pub(super) fn hear(&mut self, at: Time) {
        let first = self.heard.map_or(at, |(first, _)| first);
        self.heard = Some((first, at));
    }

    /// A solution came out.
    pub(super) fn take(&mut self, row: &NavRow) {
        let sums = &mut self.summed.sums;
        sums.solutions += 1;
        *sums.modes.entry(row.solution.mode.as_str().to_owned()).or_default() += 1;
        if !is_told(row) {
            self.last = None;
            return;
        }
        sums.told += 1;
        let is_within = row.horizontal_level.is_some_and(|level| level < self.alert_limit);
        sums.available += u64::from(is_within);
        sums.sum_horizontal_m2 += row.solution.sigma.position.0.xy().norm_squared();
        sums.sum_heading_rad2 += row.solution.sigma.heading.powi(2);
        let (time, speed) = (row.solution.time, row.solution.velocity.0.xy().norm());
        let before = self.last.replace((time, speed));
        let apart = before.map(|(then, own)| ((time - then).as_seconds(), own));
        if let Some((apart, own)) = apart.filter(|(apart, _)| (0.0..=APART).contains(apart)) {
            sums.way_m += apart * 0.5 * (own + speed);
        }
    }

    /// The replay is over: what the engine counted, and what the files lacked.
    pub(super) fn end(&mut self, counts: &Counts, left_out: u64, files: &[&FileReport]) {
        let sums = &mut self.summed.sums;
        sums.left_out = left_out;
        sums.imu_samples = counts.imu_samples;
        sums.imu_gaps = counts.imu_gaps;
        let used = counts.accepted.iter();
        sums.used = used.map(|(aid, count)| ((*aid).to_owned(), *count)).collect();
        let rejected = counts.rejected.iter();
        sums.rejected =
            rejected.map(|((aid, why), n)| (format!("{aid}: {}", why.as_str()), *n)).collect();
        sums.duration_s = self.heard.map_or(0.0, |(first, last)| (last - first).as_seconds());
        self.summed.faulty_rows = files.iter().map(|file| file.faulty()).sum();
    }

    /// A raw recording was read, with so many runs, of a program.
    pub(super) fn read(&mut self, read: RawRead, runs: u32, program: Option<&String>) {
        let summed = &mut self.summed;
        (summed.read, summed.runs, summed.program) = (read, runs, program.cloned());
    }

    /// All of it.
    pub(super) fn finish(self) -> Summed {
        self.summed
    }
}
