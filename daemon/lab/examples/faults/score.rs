//! The definitions by which a voyage with a liar is judged.
//!
//! Usable at an alert limit (10 m, 100 m): told, and the level is within the limit. Misleading: usable
//! while the error is beyond the limit, and beyond what the lie itself is allowed until it was shown and ten seconds
//! more; or a heading of a sigma below 2 deg that is off by more than 3 deg and three sigmas. HMI:
//! misleading for more than 10 s in one piece, or 60 s in all.

use std::fmt;

use insd_simulator::lies::{Case, Class, Culprit, Grade, ImuLie, Lie, Told};

use serde::{Deserialize, Serialize};

use crate::sail::Row;

const LIMITS: [f64; 2] = [10.0, 100.0];
/// Longest piece and longest sum of misleading, s.
const PIECE: f64 = 10.0;
const SUM: f64 = 60.0;
/// What a position is off by beside a lie that it follows, m.
const OWN: f64 = 3.0;
/// What a heading may be off by, rad, and for how long, s, where side-slip is its only witness.
const BLIND: (f64, f64) = (10.0 * DEG, 60.0);
/// A lie is told, and named, so long after it was shown, s.
const TOLD: f64 = 10.0;
const NAMED: f64 = 60.0;
/// An innocent may be named for so long, s.
const WRONGLY: f64 = 30.0;
/// After it has healed she is back within this, m, after so long, s.
const BACK: (f64, f64) = (10.0, 300.0);
const DEG: f64 = std::f64::consts::PI / 180.0;

/// What came of a case.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Score {
    pub(crate) held: bool,
    hmi: bool,
    /// The longest misleading piece, s.
    longest: f64,
    /// Whether the liar was named, where that is asked.
    named: Option<bool>,
    innocent: bool,
    worst: f64,
}

/// Judges a voyage.
pub(crate) fn score(case: &Case, rows: &[Row]) -> Score {
    let first = case.told.iter().map(|told| told.window.from).fold(f64::INFINITY, f64::min);
    let from = first.max(case.judged_from);
    let judged: Vec<&Row> = rows.iter().filter(|row| row.time >= from).collect();
    let allowed_until = case.shown_at.map_or(f64::INFINITY, |at| at + TOLD);
    let allowed = |row: &Row| match row.lie {
        lie if lie > 0.0 && row.time <= allowed_until => lie + OWN,
        _ => 0.0,
    };
    let beyond = |limit: f64| {
        pieces(&judged, |row| row.told && row.level <= limit && row.off > limit.max(allowed(row)))
    };
    let (far, piece) = if only_slip_shows(case) { BLIND } else { (3.0 * DEG, PIECE) };
    let heading = pieces(&judged, |row| {
        let (off, sigma) = row.heading;
        row.told && sigma < 2.0 * DEG && off > far.max(3.0 * sigma)
    });
    let all = [beyond(LIMITS[0]), beyond(LIMITS[1]), heading];
    let hmi = [PIECE, PIECE, piece]
        .iter()
        .zip(all)
        .any(|(piece, (longest, sum))| longest > *piece || sum > SUM);
    let longest = all.iter().map(|(longest, _)| *longest).fold(0.0, f64::max);
    let (named, innocent) = (named(case, &judged), innocent(case, &judged));
    let is_right = match case.class {
        Class::Required => named != Some(false) && carries_on(case, &judged, first),
        Class::Told => true,
        Class::Bounded => covers(case, &judged),
    };
    let worst = judged.iter().filter(|row| row.told).map(|row| row.off).fold(0.0, f64::max);
    Score { held: !hmi && !innocent && is_right, hmi, longest, named, innocent, worst }
}

/// Whether a gyro lies and neither log nor compass sees it.
fn only_slip_shows(case: &Case) -> bool {
    let is_stuck =
        |told: &Told| matches!(told.lie, Lie::Imu(ImuLie::GyroStuck(_) | ImuLie::AllStuck));
    let is_blind = !case.suite.has_log() && !case.suite.has_compass();
    is_blind && case.culprits().contains(&Culprit::Imu) && !case.told.iter().any(is_stuck)
}

/// Longest piece and sum of the rows of which something holds, s.
fn pieces(rows: &[&Row], holds: impl Fn(&Row) -> bool) -> (f64, f64) {
    let (mut longest, mut sum, mut run) = (0.0_f64, 0.0, 0.0);
    for row in rows {
        run = if holds(row) { run + 1.0 } else { 0.0 };
        sum += f64::from(u8::from(run > 0.0));
        longest = longest.max(run);
    }
    (longest, sum)
}

/// Whether the liar was named in time; `None` where that is not asked.
fn named(case: &Case, rows: &[&Row]) -> Option<bool> {
    let shown = case.shown_at.filter(|_| case.is_named && case.class == Class::Required)?;
    let shown = shown.max(case.judged_from);
    let in_time = rows.iter().filter(|row| row.time <= shown + NAMED);
    let culprits = case.culprits();
    let names =
        |row: &&Row, culprit: &Culprit| row.excluded.iter().any(|word| culprit.is_meant_by(word));
    let rows: Vec<&Row> = in_time.copied().collect();
    Some(culprits.iter().all(|culprit| rows.iter().any(|row| names(row, culprit))))
}

/// Whether somebody honest was named for long.
fn innocent(case: &Case, rows: &[&Row]) -> bool {
    let culprits = case.culprits();
    let is_honest = |word: &str| !culprits.iter().any(|culprit| culprit.is_meant_by(word));
    pieces(rows, |row| row.excluded.iter().any(|word| is_honest(word))).0 > WRONGLY
}

/// Whether she navigates with the rest, within the budget, and is back after it healed.
fn carries_on(case: &Case, rows: &[&Row], first: f64) -> bool {
    let Some(begun) = rows.iter().find(|row| row.time >= first).map(|row| row.run) else {
        return false;
    };
    let budget = |row: &Row| {
        let without_gnss = case.culprits().contains(&Culprit::Gnss);
        let share = match case.grade {
            Grade::Navigation => 0.007,
            Grade::Mems if case.suite.has_compass() => 0.015,
            Grade::Mems => 0.03,
        };
        if without_gnss { 20.0 + share * (row.run - begun) } else { 10.0 }
    };
    let until = case.shown_at.map_or(f64::INFINITY, |at| at + TOLD);
    let of = |holds: &dyn Fn(&Row) -> bool| {
        rows.iter().filter(|row| holds(row)).count() as f64 / rows.len().max(1) as f64
    };
    let usable = of(&|row| row.told && row.level <= (3.0 * budget(row)).max(100.0));
    let within =
        of(&|row| row.off <= budget(row).max(if row.time <= until { row.lie } else { 0.0 }));
    let is_back = case.healed_at().is_none_or(|healed| {
        let late = rows.iter().filter(|row| row.time > healed + BACK.1);
        late.clone().all(|row| row.off <= BACK.0)
    });
    usable >= 0.95 && within >= 0.99 && is_back
}

/// Whether level and sigma cover the errors.
fn covers(case: &Case, rows: &[&Row]) -> bool {
    let least = if case.grade == Grade::Mems { 1.0 } else { 0.3 } * DEG;
    let told: Vec<&&Row> = rows.iter().filter(|row| row.told).collect();
    let covered = told.iter().filter(|row| {
        let (off, sigma) = row.heading;
        let lie = if case.shown_at.is_none() { row.lie } else { 0.0 };
        let allowed = if lie > 0.0 { lie + OWN } else { OWN };
        row.off <= row.level.max(allowed) && off <= (5.0 * sigma).max(least)
    });
    told.is_empty() || covered.count() as f64 >= 0.99 * told.len() as f64
}

/// What came of an hour in which nobody lies.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Honest {
    /// How often somebody is named.
    pub(crate) alarms: f64,
    /// The share of the rows after ten minutes that are usable at 100 m.
    pub(crate) usable: f64,
}

/// Judges a voyage without a liar.
pub(crate) fn honest(rows: &[Row]) -> Honest {
    let raised = rows.windows(2).filter(|two| two[0].excluded.len() < two[1].excluded.len());
    let late: Vec<&Row> = rows.iter().filter(|row| row.time > 600.0).collect();
    let usable = late.iter().filter(|row| row.told && row.level <= LIMITS[1]).count() as f64;
    Honest { alarms: raised.count() as f64, usable: usable / late.len().max(1) as f64 }
}

/// Scores of many cases.
#[derive(Clone, Debug, Default)]
pub(crate) struct Sum {
    cases: f64,
    held: f64,
    hmi: f64,
    innocent: f64,
    asked: f64,
    named: f64,
    longest: Vec<f64>,
    worst: f64,
}

impl Sum {
    pub(crate) const HEAD: &'static str = "kind                        cases   held    HMI  named       innocent  told within s (median, 95 %)  worst m";

    pub(crate) fn extend(&mut self, other: &Sum) {
        self.cases += other.cases;
        self.held += other.held;
        self.hmi += other.hmi;
        self.innocent += other.innocent;
        self.asked += other.asked;
        self.named += other.named;
        self.longest.extend(&other.longest);
        self.worst = self.worst.max(other.worst);
    }
}

impl<'a> FromIterator<&'a Score> for Sum {
    fn from_iter<I: IntoIterator<Item = &'a Score>>(scores: I) -> Self {
        let mut sum = Sum::default();
        for score in scores {
            let one = |holds: bool| f64::from(u8::from(holds));
            sum.extend(&Sum {
                cases: 1.0,
                held: one(score.held),
                hmi: one(score.hmi),
                innocent: one(score.innocent),
                asked: one(score.named.is_some()),
                named: one(score.named == Some(true)),
                longest: vec![score.longest],
                worst: score.worst,
            });
        }
        sum
    }
}

impl fmt::Display for Sum {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let share = |of: f64| of / self.cases.max(1.0);
        let mut longest = self.longest.clone();
        longest.sort_by(f64::total_cmp);
        let at = |share: f64| {
            let last = longest.len().saturating_sub(1) as f64;
            longest.get((share * last).round() as usize).copied().unwrap_or_default()
        };
        write!(
            f,
            "{:>5} {:>6.2} {:>6.2} {:>5}/{:<5} {:>9.2} {:>14.0} {:>14.0} {:>9.0}",
            self.cases,
            share(self.held),
            share(self.hmi),
            self.named,
            self.asked,
            share(self.innocent),
            at(0.5),
            at(0.95),
            self.worst
        )
    }
}

impl fmt::Display for Score {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let word = |holds: bool, word: &'static str| if holds { word } else { "" };
        write!(
            f,
            "{:<5}{:<4}{:<9}{:<9} {:>6.0} s {:>9.0} m ",
            word(self.held, "held"),
            word(self.hmi, "HMI"),
            self.named.map_or("", |named| if named { "named" } else { "unnamed" }),
            word(self.innocent, "innocent"),
            self.longest,
            self.worst
        )
    }
}
