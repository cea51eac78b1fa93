use insd_base::{Availability, Geodetic, Solution};
use insd_drivers::recording::FileReport;

use super::super::errors::errors;
use super::super::testing::{solution, truth};
use super::*;

const LIMIT: AlertLimit = AlertLimit { limit_m: 10.0, requirement: None, accuracy_m: None };

/// Rows a second apart that are so far north of truth, and below it, with these levels, m.
fn report(rows: &[(f64, f64, f64, f64)], columns: Vec<&'static str>) -> IntegrityReport {
    let point = Geodetic::from_degrees(40.0, 5.0, 0.0);
    let (meridian, _) = insd_base::earth::radii(point.latitude);
    let row = |(at, (north, down, horizontal, vertical)): (usize, &(f64, f64, f64, f64))| {
        let mut position = point;
        position.latitude += north / meridian;
        position.height -= down;
        NavRow {
            solution: solution(at as f64, position),
            horizontal_level: Some(*horizontal),
            vertical_level: Some(*vertical),
            integrity: None,
            excluded: Vec::new(),
            satellites: None,
        }
    };
    judged(rows.iter().enumerate().map(row).collect(), columns)
}

fn judged(rows: Vec<NavRow>, columns: Vec<&'static str>) -> IntegrityReport {
    let point = Geodetic::from_degrees(40.0, 5.0, 0.0);
    let solutions: Vec<Solution> = rows.iter().map(|row| row.solution).collect();
    let true_rows: Vec<_> = (0..rows.len()).map(|at| truth(at as f64, point)).collect();
    let nav = Rows { rows, report: FileReport::default(), columns };
    let found = errors(&solutions, &true_rows, None);
    IntegrityReport::new(&nav, &found, LIMIT, 10.0)
}

#[test]
fn each_epoch_stands_where_the_chart_has_it() {
    let point =
        |error, level| StanfordPoint { time: Time::from_seconds(0.0), error, level, is_told: true };
    let class = |error, level| point(error, Some(level)).class(10.0);
    assert_eq!(class(2.0, 5.0), StanfordClass::Nominal);
    assert_eq!(class(5.0, 5.0), StanfordClass::Nominal);
    assert_eq!(class(5.1, 5.0), StanfordClass::Misleading);
    assert_eq!(class(10.0, 5.0), StanfordClass::Misleading);
    assert_eq!(class(10.1, 5.0), StanfordClass::Hazardous);
    assert_eq!(class(10.1, 10.0), StanfordClass::Unavailable);
    assert_eq!(class(1.0, 10.0), StanfordClass::Unavailable);
    assert_eq!(point(1.0, None).class(10.0), StanfordClass::Unavailable);
    let refused = StanfordPoint { is_told: false, ..point(20.0, Some(5.0)) };
    assert_eq!(refused.class(10.0), StanfordClass::Unavailable);
    assert!(refused.is_exceeded() && !point(1.0, None).is_exceeded());
}

#[test]
fn what_is_counted_adds_up_in_both_axes() {
    let mut rows = vec![(1.0, 0.5, 5.0, 7.0); 20];
    rows[3] = (6.0, 0.5, 5.0, 7.0);
    rows[4] = (6.0, 12.0, 5.0, 7.0);
    rows[9] = (11.0, 0.5, 5.0, 7.0);
    rows[15] = (40.0, 0.5, 30.0, 40.0);
    rows[16] = (20.0, 0.5, 30.0, 40.0);
    let told = report(&rows, vec!["hpl_m", "vpl_m"]);
    let own = &told.horizontal;
    let counts = [&own.nominal, &own.misleading, &own.hazardous, &own.unavailable];
    assert_eq!(counts.map(|tally| tally.epochs), [15, 2, 1, 2]);
    assert_eq!((own.available.epochs, own.exceeded.epochs, own.exceeded_unavailable), (18, 4, 1));
    assert_eq!((own.misleading.pieces, own.misleading.first_s), (1, Some(3.0)));
    assert!((own.worst_ratio.unwrap() - 2.2).abs() < 1e-3, "{:?}", own.worst_ratio);
    let vertical = told.vertical.as_ref().unwrap();
    assert_eq!((vertical.hazardous.epochs, vertical.unavailable.epochs), (1, 2));
    assert_eq!(told.hazardous(), 2);
    let share = own.hazardous.share;
    assert!(own.hazardous.low < share && share < own.hazardous.high);
}

#[test]
fn a_row_that_says_it_is_not_to_be_used_misleads_nobody() {
    let mut told = report(&[(20.0, 0.0, 5.0, 5.0); 12], vec!["hpl_m", "vpl_m"]);
    assert_eq!(told.horizontal.hazardous.epochs, 12);
    let row = NavRow {
        solution: solution(0.0, Geodetic::from_degrees(40.001, 5.0, 0.0)),
        horizontal_level: Some(5.0),
        vertical_level: None,
        integrity: Some(Availability::Fault),
        excluded: Vec::new(),
        satellites: None,
    };
    told = judged(vec![row], vec!["hpl_m", "integrity"]);
    assert_eq!(told.hazardous(), 0);
    assert_eq!(told.horizontal.not_to_be_used, 1);
    assert!(told.vertical.is_none());
}

#[test]
fn people_and_programs_are_told_the_same() {
    let told = report(&[(1.0, 0.5, 5.0, 7.0); 40], vec!["hpl_m", "vpl_m"]);
    let text = told.to_string();
    for word in ["horizontal at 10 m", "vertical at 10 m", "hazardous", "samples", "0 of n"] {
        assert!(text.contains(word), "{text}");
    }
    let json = serde_json::to_value(&told).unwrap();
    assert_eq!(json["horizontal"]["nominal"]["epochs"], 40);
    // an error that never changes is one sample or two: it proves next to nothing
    assert!(json["horizontal"]["hazardous"]["high"].as_f64().unwrap() > 0.7, "{json}");
    assert_eq!(json["alert_limit"]["limit_m"], 10.0);
}
