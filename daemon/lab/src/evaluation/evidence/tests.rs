use insd_base::{Geodetic, Solution, Truth};
use insd_drivers::recording::FileReport;

use super::super::errors::errors;
use super::super::testing::{solution, truth};
use super::*;

const FURTHER: [&str; 4] = ["hpl_m", "vpl_m", "integrity", "excluded"];
/// Latitude of a metre to the north of the equator, deg.
const METRE: f64 = 1.0 / 110_574.0;

/// A row that is so far to the north of where she is, m, and claims a level, m.
fn row(seconds: f64, off: f64, level: f64) -> NavRow {
    NavRow {
        solution: solution(seconds, Geodetic::from_degrees(off * METRE, 0.0, 0.0)),
        horizontal_level: Some(level),
        vertical_level: Some(4.0),
        integrity: Some(Availability::Available),
        excluded: Vec::new(),
        satellites: None,
    }
}

fn file(rows: Vec<NavRow>, columns: &[&'static str]) -> Rows<NavRow> {
    Rows { rows, report: FileReport::default(), columns: columns.to_vec() }
}

/// Where she is, once a second, all the time.
fn still() -> Vec<Truth> {
    (0..1000).map(|at| truth(f64::from(at), Geodetic::default())).collect()
}

fn evidence_with(nav: &Rows<NavRow>, truth: &[Truth], from: Option<Time>) -> Evidence {
    let solutions: Vec<Solution> = nav.rows.iter().map(|row| row.solution).collect();
    Evidence::new(nav, &errors(&solutions, truth, from), from)
}

fn evidence(nav: &Rows<NavRow>) -> Evidence {
    evidence_with(nav, &still(), None)
}

/// A hundred seconds, of which some are otherwise.
fn hundred(otherwise: impl Fn(u32, &mut NavRow)) -> Vec<NavRow> {
    let one = |at: u32| {
        let mut row = row(f64::from(at), 1.0, 8.0);
        otherwise(at, &mut row);
        row
    };
    (0..100).map(one).collect()
}

fn off(metres: f64) -> Geodetic {
    Geodetic::from_degrees(metres * METRE, 0.0, 0.0)
}

#[test]
fn a_sound_voyage_is_told_in_eight_lines() {
    let found = evidence(&file(hundred(|_, _| {}), &FURTHER));
    assert!(!found.hazardous);
    assert_eq!((found.told_s, found.position[0].usable_share), (100.0, 1.0));
    let text = found.to_string();
    assert_eq!(text.lines().count(), 8, "{text}");
    assert!(text.contains("position at 10 m      100.0             0"), "{text}");
    assert!(text.contains("integrity: available 100.0 % (100 s)\nnobody was left out"), "{text}");
    assert!(text.contains("largest error over level: 0.125 horizontally"), "{text}");
    assert!(text.contains("not hazardous"), "{text}");
}

#[test]
fn an_error_beyond_the_limit_under_a_small_level_misleads_and_is_hazardous_after_ten_seconds() {
    let lying = |until: u32| {
        let rows = hundred(|at, row| {
            if (20..until).contains(&at) {
                row.solution.position = off(50.0);
            }
        });
        evidence(&file(rows, &FURTHER))
    };
    let brief = lying(30);
    let [harbour, ocean] = [brief.position[0], brief.position[1]];
    assert_eq!((harbour.misleading_s, harbour.longest_s), (Some(10.0), Some(10.0)));
    assert_eq!((harbour.first_s, harbour.hazardous), (Some(20.0), false));
    assert_eq!((ocean.misleading_s, ocean.first_s), (Some(0.0), None));
    let worst = brief.worst_horizontal.unwrap();
    assert!((worst.ratio - 50.0 / 8.0).abs() < 1e-3 && worst.at_s >= 20.0, "{worst:?}");
    let long = lying(31);
    assert!(long.hazardous && long.position[0].hazardous && !long.position[1].hazardous);
    assert!(long.to_string().contains("HAZARDOUS (position at 10 m)"), "{long}");
}

#[test]
fn many_brief_pieces_are_hazardous_together() {
    let rows = |misled: u32| {
        let one = |at: u32| {
            let lies = at % 10 < 5 && at < misled * 2;
            row(f64::from(at), if lies { 12.0 } else { 1.0 }, 8.0)
        };
        file((0..200).map(one).collect(), &FURTHER)
    };
    assert!(!evidence(&rows(60)).hazardous);
    let found = evidence(&rows(65));
    assert_eq!(found.position[0].longest_s, Some(5.0));
    assert!(found.hazardous);
}

#[test]
fn whoever_says_that_it_cannot_be_used_does_not_mislead() {
    let ways: [fn(&mut NavRow); 6] = [
        |row| row.integrity = Some(Availability::Fault),
        |row| row.solution.mode = Mode::Fault,
        |row| row.solution.mode = Mode::CoarseAlignment,
        |row| row.solution.mode = Mode::Standby,
        |row| row.horizontal_level = Some(300.0),
        |row| row.horizontal_level = None,
    ];
    for way in ways {
        let rows = hundred(|at, row| {
            if at >= 20 {
                row.solution.position = off(250.0);
                way(row);
            }
        });
        let found = evidence(&file(rows, &FURTHER));
        let [harbour, ocean] = [found.position[0], found.position[1]];
        assert_eq!((harbour.usable_s, ocean.usable_s), (20.0, 20.0));
        assert!(!found.hazardous && harbour.misleading_s == Some(0.0), "{found:?}");
    }
    // a level beyond the limit is one, whatever is unavailable
    let rows = hundred(|_, row| row.integrity = Some(Availability::Unavailable));
    assert_eq!(evidence(&file(rows, &FURTHER)).position[0].usable_s, 100.0);
}

#[test]
fn without_levels_in_the_file_five_sigmas_are_one() {
    let rows = hundred(|_, row| {
        // 1 m to the north and to the east: a level of 7.07 m
        (row.horizontal_level, row.vertical_level, row.integrity) = (None, None, None);
        row.solution.position = off(12.0);
    });
    let found = evidence(&file(rows, &[]));
    assert_eq!((found.integrity.as_ref(), found.excluded.as_ref()), (None, None));
    assert_eq!((found.has_levels, found.worst_vertical), (false, None));
    assert_eq!((found.position[0].usable_s, found.position[0].misleading_s), (100.0, Some(100.0)));
    let text = found.to_string();
    for part in ["integrity is not in the file", "who was left out is not", "five horizontal"] {
        assert!(text.contains(part), "{text}");
    }
}

#[test]
fn a_heading_misleads_beyond_three_degrees_and_three_sigmas_while_it_claims_less_than_two() {
    let found = |off: f64, sigma: f64| {
        let rows = hundred(|_, row| {
            row.solution.attitude.heading = off * DEG;
            row.solution.sigma.heading = sigma * DEG;
        });
        evidence(&file(rows, &FURTHER)).heading
    };
    for (off, sigma, misleads) in [
        (3.1, 0.5, true),
        (2.9, 0.5, false),
        (4.0, 1.5, false),
        (-5.0, 1.5, true),
        (90.0, 2.1, false),
    ] {
        let own = found(off, sigma);
        let seconds = if misleads { 100.0 } else { 0.0 };
        assert_eq!(own.misleading_s, Some(seconds), "{off} {sigma}");
        assert_eq!(own.hazardous, misleads, "{off} {sigma}");
    }
    assert_eq!(found(0.0, 2.1).usable_s, 0.0);
}

#[test]
fn what_truth_does_not_know_is_not_judged() {
    let mut truth = still();
    truth.iter_mut().for_each(|row| row.attitude = None);
    let found = evidence_with(&file(hundred(|_, _| {}), &FURTHER), &truth, None);
    assert_eq!((found.heading.misleading_s, found.heading.usable_s), (None, 100.0));
    let json = serde_json::to_value(&found).unwrap();
    assert!(json["heading"]["misleading_s"].is_null());
}

#[test]
fn states_and_sources_are_told_from_the_beginning_that_is_asked_for() {
    let rows = hundred(|at, row| {
        if (30..70).contains(&at) {
            row.excluded = vec!["gnss".to_owned(), "G07".to_owned()];
        }
        if at >= 90 {
            row.integrity = Some(Availability::Fault);
        }
    });
    let found = evidence_with(&file(rows, &FURTHER), &still(), Some(Time::from_seconds(50.0)));
    let states = found.integrity.as_ref().unwrap();
    assert_eq!((states["available"].total_s, states["fault"].share), (40.0, 0.2));
    let gnss = found.excluded.as_ref().unwrap().iter().find(|own| own.source == "gnss").unwrap();
    assert_eq!((gnss.first_s, gnss.last_s, gnss.total_s, gnss.pieces), (50.0, 69.0, 20.0, 1));
    let text = found.to_string();
    assert!(text.contains("integrity: available 80.0 % (40 s), fault 20.0 % (10 s)"), "{text}");
    assert!(text.contains("gnss           50      69       20       1"), "{text}");
}

#[test]
fn rows_faster_than_truth_are_judged_at_its_instants() {
    let fast: Vec<NavRow> = (0..1000).map(|at| row(f64::from(at) / 10.0, 12.0, 8.0)).collect();
    let found = evidence(&file(fast, &FURTHER));
    assert_eq!(found.told_s, 100.0);
    assert_eq!(found.position[0].misleading_s, Some(100.0));
}
