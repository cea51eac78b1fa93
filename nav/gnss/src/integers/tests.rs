use nalgebra::{DMatrix, DVector};
use proptest::prelude::*;
use serde_json::Value;

use super::{IntegerRefusal, IntegerSearch};

/// Cases that exact rational arithmetic has proved by complete enumeration, and their ratios.
fn prove(text: &str) -> usize {
    let cases: Value = serde_json::from_str(text).unwrap();
    let number = |value: &Value| value.as_str().unwrap().parse::<f64>().unwrap();
    let integers = |value: &Value| -> Vec<i64> {
        value.as_array().unwrap().iter().map(|x| x.as_i64().unwrap()).collect()
    };
    let cases = cases["vectors"].as_array().unwrap();
    for case in cases {
        let name = &case["name"];
        let measured: Vec<f64> =
            case["float_ambiguities"].as_array().unwrap().iter().map(number).collect();
        let rows = case["covariance"].as_array().unwrap();
        let covariance = DMatrix::from_fn(rows.len(), rows.len(), |i, j| number(&rows[i][j]));
        let search = IntegerSearch::new(&DVector::from_vec(measured), &covariance).unwrap();
        let found = search.nearest(2).unwrap();
        assert_eq!(found[0].integers, integers(&case["best"]), "{name}");
        assert_eq!(found[1].integers, integers(&case["second"]), "{name}");
        for (own, key) in found.iter().zip(["squared_norm_best", "squared_norm_second"]) {
            let proved = case[key].as_f64().unwrap();
            // phases of 1e9 cycles keep 1e-7 of one
            assert!(
                (own.distance / proved - 1.0).abs() < 1e-5,
                "{name}: {} {proved}",
                own.distance
            );
        }
    }
    cases.len()
}

#[test]
fn the_nearest_integers_are_those_of_complete_enumeration() {
    assert_eq!(prove(include_str!("../../tests/data/integers.json")), 6);
}

#[test]
fn all_proved_cases_hold_where_their_folder_is_named() {
    let Some(folder) = std::env::var_os("INSD_RAW_GNSS") else {
        println!("skipped: INSD_RAW_GNSS names no folder");
        return;
    };
    let path = std::path::Path::new(&folder).join("vectors/lambda.json");
    assert!(prove(&std::fs::read_to_string(path).unwrap()) >= 15);
}

#[test]
fn what_is_no_covariance_is_refused_with_its_reason() {
    let measured = DVector::from_vec(vec![0.2, 0.4]);
    let refused =
        |covariance: &DMatrix<f64>| IntegerSearch::new(&measured, covariance).unwrap_err();
    assert_eq!(refused(&DMatrix::zeros(2, 2)), IntegerRefusal::NotDefinite);
    assert_eq!(refused(&DMatrix::identity(3, 3)), IntegerRefusal::Malformed);
    assert_eq!(refused(&DMatrix::from_element(2, 2, f64::NAN)), IntegerRefusal::Malformed);
    assert_eq!(refused(&DMatrix::from_element(2, 2, 1.0)), IntegerRefusal::NotDefinite);
    let none = IntegerSearch::new(&DVector::zeros(0), &DMatrix::zeros(0, 0));
    assert_eq!(none.unwrap_err(), IntegerRefusal::Malformed);
}

#[test]
fn a_number_without_precision_has_no_success() {
    let measured = DVector::from_vec(vec![0.2]);
    let success = |variance: f64| {
        IntegerSearch::new(&measured, &DMatrix::from_element(1, 1, variance)).unwrap().success()
    };
    assert!(success(1e-4) > 1.0 - 1e-12);
    // 2 Phi(1/2 / 0.5) - 1
    assert!((success(0.25) - 0.682_689).abs() < 1e-6);
    assert!(success(1e6) < 1e-3);
}

/// A covariance as double differences make it: one strong direction, the others alike; of so many numbers.
fn covariance(count: usize, entries: &[f64]) -> DMatrix<f64> {
    let factor = DMatrix::from_fn(count, count, |i, j| entries[i * 6 + j]);
    let weak = DVector::from_fn(count, |i, _| entries[36 + i] * 3.0);
    &factor * factor.transpose() * 0.02
        + &weak * weak.transpose()
        + DMatrix::identity(count, count) * 0.003
}

/// By what share rounding moves distances that a covariance measures: the resolution of a number times the condition.
fn rounding(covariance: &DMatrix<f64>) -> f64 {
    let variances = covariance.symmetric_eigenvalues();
    f64::EPSILON * variances.max() / variances.min().max(f64::MIN_POSITIVE)
}

/// The least distance of any integers within some cycles of the measured ones.
fn enumerated(measured: &DVector<f64>, covariance: &DMatrix<f64>, reach: i64) -> f64 {
    let inverse = covariance.clone().try_inverse().unwrap();
    let width = 2 * reach + 1;
    let count = measured.len() as u32;
    let vector = |code: i64| {
        let digit = |i: usize| (code / width.pow(i as u32) % width - reach) as f64;
        DVector::from_fn(measured.len(), |i, _| measured[i] - measured[i].round() - digit(i))
    };
    let distance = |code: i64| {
        let off = vector(code);
        (off.transpose() * &inverse * &off)[0]
    };
    (0..width.pow(count)).map(distance).fold(f64::INFINITY, f64::min)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn a_scrambled_problem_has_the_scrambled_integers(
        count in 2_usize..=6,
        entries in prop::collection::vec(-1.0_f64..1.0, 48),
        steps in prop::collection::vec((0_usize..6, 0_usize..6, -3_i64..=3), 0..12),
    ) {
        let q = covariance(count, &entries);
        let a = DVector::from_fn(count, |i, _| entries[42 + i] * 50.0);
        // products of elementary integer steps, whose inverse is integer
        let mut scramble = DMatrix::<f64>::identity(count, count);
        for (i, j, multiple) in steps {
            let (i, j) = (i % count, j % count);
            if i != j {
                let row = scramble.row(j) * multiple as f64;
                let sum = scramble.row(i) + row;
                scramble.set_row(i, &sum);
            }
        }
        let scrambled = &scramble * &q * scramble.transpose();
        // a scramble whose rounding alone moves distances by what is asked for below is another problem
        prop_assume!(rounding(&scrambled) < 1e-7);
        let straight = IntegerSearch::new(&a, &q).unwrap();
        let crooked = IntegerSearch::new(&(&scramble * &a), &scrambled).unwrap();
        let (own, other) = (straight.nearest(2).unwrap(), crooked.nearest(2).unwrap());
        prop_assert!((own[0].distance - other[0].distance).abs() < 1e-6 * (1.0 + own[0].distance));
        prop_assert!((own[1].distance - other[1].distance).abs() < 1e-6 * (1.0 + own[1].distance));
        if own[1].distance - own[0].distance > 1e-6 {
            let z = DVector::from_iterator(count, own[0].integers.iter().map(|x| *x as f64));
            let mapped: Vec<i64> = (scramble * z).iter().map(|x| x.round() as i64).collect();
            prop_assert_eq!(mapped, other[0].integers.clone());
        }
    }

    #[test]
    fn nothing_is_nearer_than_what_is_found(
        count in 1_usize..=4,
        entries in prop::collection::vec(-1.0_f64..1.0, 48),
    ) {
        let q = covariance(count, &entries);
        let a = DVector::from_fn(count, |i, _| entries[42 + i] * 50.0);
        let search = IntegerSearch::new(&a, &q).unwrap();
        let found = search.nearest(3).unwrap();
        prop_assert!(found.is_sorted_by(|one, other| one.distance <= other.distance));
        let inverse = q.clone().try_inverse().unwrap();
        for vector in &found {
            let off = DVector::from_fn(count, |i, _| a[i] - vector.integers[i] as f64);
            let distance = (off.transpose() * &inverse * &off)[0];
            prop_assert!((distance - vector.distance).abs() < 1e-6 * (1.0 + distance));
        }
        let least = enumerated(&a, &q, 4);
        prop_assert!(found[0].distance <= least * (1.0 + 1e-6) + 1e-9, "{} {}", found[0].distance, least);
    }
}
