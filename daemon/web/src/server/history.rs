//! What is plotted, so that a page that is loaded anew has plots: ten minutes finely, two hours coarsely.

use std::collections::VecDeque;

use axum::body::Bytes;
use serde_json::{Map, Value, json};

use crate::snapshot::{ShownMotion, Snapshot};

/// Most rows: ten minutes at one a second, or two hours at one in ten seconds.
const ROWS: [usize; 2] = [600, 720];
/// Least time between two rows, s; snapshots come when they come.
const STEPS: [f64; 2] = [0.95, 9.95];

/// Time that goes back by more than this is that of another start, s. By less it goes back where the last
/// snapshot was shown again, older, before the next one came.
pub(super) const BACK: f64 = -2.0;

/// A column: its name, and where it is found.
type Column = (&'static str, fn(&ShownMotion) -> Option<f64>);

/// What is kept.
const COLUMNS: [Column; 10] = [
    ("heading_deg", |motion| motion.heading_deg),
    ("sigma_heading_deg", |motion| motion.sigma_heading_deg),
    ("roll_deg", |motion| motion.roll_deg),
    ("pitch_deg", |motion| motion.pitch_deg),
    ("rate_of_turn_deg_min", |motion| motion.rate_of_turn_deg_min),
    ("heave_m", |motion| motion.heave.as_ref()?.heave_m),
    ("speed_kn", |motion| motion.speed_kn),
    ("course_deg", |motion| motion.course_deg),
    ("current_speed_kn", |motion| motion.current_speed_kn),
    ("ellipse_major_m", |motion| motion.ellipse_major_m),
];

/// The last minutes, or hours.
#[derive(Debug)]
pub(super) struct History {
    most: usize,
    step: f64,
    rows: VecDeque<(f64, [Option<f64>; COLUMNS.len()])>,
    json: Option<Bytes>,
}

impl History {
    /// The finer one and the coarser one.
    pub(super) fn both() -> [Self; 2] {
        let [fine, coarse] = STEPS;
        let own = |most, step| History { most, step, rows: VecDeque::new(), json: None };
        [own(ROWS[0], fine), own(ROWS[1], coarse)]
    }

    /// Takes note of a snapshot, once in each step.
    pub(super) fn note(&mut self, snapshot: &Snapshot) {
        let at = snapshot.time.at_s;
        let passed = self.rows.back().map(|(last, _)| at - last);
        if passed.is_some_and(|passed| (BACK..self.step).contains(&passed)) {
            return;
        }
        if passed.is_some_and(|passed| passed < BACK) {
            self.rows.clear();
        }
        if self.rows.len() == self.most {
            self.rows.pop_front();
        }
        let motion = snapshot.present();
        self.rows.push_back((at, COLUMNS.map(|(_, of)| motion.and_then(of))));
        self.json = None;
    }

    /// All rows as JSON, one list for each column, the oldest first.
    pub(super) fn json(&mut self) -> Bytes {
        let rows = &self.rows;
        let make = || {
            let mut columns = Map::new();
            let at: Vec<f64> = rows.iter().map(|(at, _)| round(*at, 100.0)).collect();
            columns.insert("version".to_owned(), json!(crate::snapshot::VERSION));
            columns.insert("at_s".to_owned(), json!(at));
            for (index, (name, _)) in COLUMNS.iter().enumerate() {
                let value = |values: &[Option<f64>]| values.get(index).copied().flatten();
                let column = rows.iter().map(|(_, values)| value(values).map(|v| round(v, 1e5)));
                columns.insert((*name).to_owned(), json!(column.collect::<Vec<_>>()));
            }
            Bytes::from(Value::Object(columns).to_string())
        };
        self.json.get_or_insert_with(make).clone()
    }
}

fn round(value: f64, unit: f64) -> f64 {
    (value * unit).round() / unit
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_snapshot_that_was_shown_again_before_the_next_one_costs_no_history() {
        let [mut history, _] = History::both();
        for tick in 0..100 {
            let mut snapshot = Snapshot::default();
            snapshot.time.at_s = f64::from(tick);
            history.note(&snapshot);
            history.note(&snapshot.after(1.1));
        }
        assert!(history.rows.len() >= 100, "{}", history.rows.len());
        history.note(&Snapshot::default());
        assert_eq!(history.rows.len(), 1, "another start");
    }

    #[test]
    fn ten_minutes_are_kept_finely_two_hours_coarsely_and_unknown_stays_unknown() {
        let [mut history, mut coarse] = History::both();
        for tick in 0..7000 {
            let roll_deg = (tick % 2 == 0).then_some(f64::from(tick));
            let motion = ShownMotion { roll_deg, ..ShownMotion::default() };
            let mut snapshot = Snapshot { motion: Some(motion), ..Snapshot::default() };
            snapshot.time.at_s = f64::from(tick) * 0.1;
            history.note(&snapshot);
            coarse.note(&snapshot);
        }
        let json: Value = serde_json::from_slice(&history.json()).unwrap();
        assert_eq!((json["at_s"].as_array().unwrap().len(), coarse.rows.len()), (600, 70));
        assert_eq!(json["roll_deg"][599], 6990.0);
        assert_eq!(json["heading_deg"][599], Value::Null);
    }
}
