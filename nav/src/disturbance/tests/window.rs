//! What the window keeps, loses and forgets.

use approx::assert_relative_eq;
use insd_base::{Span, Time};
use nalgebra::Vector2;

use super::super::window::Window;
use super::super::{ModelOrder, Prefilter, PrefilterConfig, PrefilterRefusal, Push};
use super::sea::{Dice, waves};
use super::{at, coupled, free, prefilter, push_all, slow, with_slow};

#[test]
fn the_memory_of_the_window_is_bounded() {
    let mut window = Window::new(Span::from_seconds(1.0), 120);
    let reserved = window.capacity();
    for k in 0..10_000 {
        let _ = window.push(at(k * 3), Vector2::zeros());
        assert!(window.slots().len() <= 120);
    }
    assert_eq!(window.capacity(), reserved);
    assert_eq!(size_of::<Option<Vector2<f64>>>(), 24);
}

#[test]
fn samples_older_than_the_window_are_forgotten() {
    let disturbance = waves(&mut Dice::new(1), 400);
    let (mut long, mut short) =
        (prefilter(ModelOrder::Chosen { max: 8 }), prefilter(ModelOrder::Chosen { max: 8 }));
    for (k, d) in disturbance.iter().enumerate() {
        let _ = long.push(at(k), d);
        if k >= 280 {
            let _ = short.push(at(k), d);
        }
    }
    assert_eq!(long.estimate().unwrap(), short.estimate().unwrap());
}

#[test]
fn rows_that_span_a_gap_are_left_out() {
    let mut prefilter = prefilter(ModelOrder::Fixed(2));
    let samples = with_slow(&free(&coupled(), 120));
    for (k, sample) in samples.iter().enumerate() {
        if ![20, 50, 51, 52, 53, 90].contains(&k) {
            assert_eq!(prefilter.push(at(k), sample), Push::Kept);
        }
    }
    let found = prefilter.estimate().unwrap();
    // a lost sample costs its own row and the two after it
    assert_eq!(found.rows, 118 - 3 - 6 - 3);
    assert_relative_eq!(found.value, slow(119), epsilon = 1e-8);
}

#[test]
fn a_sample_that_is_not_finite_counts_as_lost() {
    let samples = with_slow(&free(&coupled(), 120));
    let (mut broken, mut lossy) =
        (prefilter(ModelOrder::Fixed(2)), prefilter(ModelOrder::Fixed(2)));
    for (k, sample) in samples.iter().enumerate() {
        match k {
            40 | 70 => {
                let wrong = if k == 40 { f64::NAN } else { f64::INFINITY };
                assert_eq!(broken.push(at(k), &Vector2::new(0.0, wrong)), Push::NotFinite);
            }
            _ => {
                let _ = broken.push(at(k), sample);
                let _ = lossy.push(at(k), sample);
            }
        }
    }
    assert_eq!(broken.estimate().unwrap(), lossy.estimate().unwrap());
}

#[test]
fn a_gap_as_long_as_the_window_or_off_the_grid_begins_it_anew() {
    for later in [239.0, 120.4, 125.5, 1e9] {
        let mut prefilter = prefilter(ModelOrder::Fixed(2));
        push_all(&mut prefilter, waves(&mut Dice::new(2), 120));
        assert!(prefilter.estimate().is_ok());
        let push = prefilter.push(Time::from_seconds(later), &Vector2::zeros());
        assert_eq!(push, Push::Restarted);
        assert!(matches!(prefilter.estimate(), Err(PrefilterRefusal::TooFew { rows: 0, .. })));
    }
}

#[test]
fn early_and_repeated_and_past_samples_are_left_out() {
    let mut prefilter = prefilter(ModelOrder::Fixed(2));
    push_all(&mut prefilter, waves(&mut Dice::new(2), 120));
    let before = prefilter.estimate().unwrap();
    for early in [119.0, 119.5, 60.0, -1e9] {
        let push = prefilter.push(Time::from_seconds(early), &Vector2::new(9.0, 9.0));
        assert_eq!(push, Push::Early);
    }
    assert_eq!(prefilter.estimate().unwrap(), before);
}

#[test]
fn too_few_samples_are_refused_with_their_number() {
    let mut prefilter = prefilter(ModelOrder::Fixed(4));
    assert_eq!(prefilter.estimate().unwrap_err(), PrefilterRefusal::TooFew { rows: 0, needed: 33 });
    for (k, d) in waves(&mut Dice::new(4), 36).iter().enumerate() {
        let _ = prefilter.push(at(k), d);
        assert!(matches!(prefilter.estimate(), Err(PrefilterRefusal::TooFew { .. })));
    }
    assert_eq!(
        prefilter.estimate().unwrap_err(),
        PrefilterRefusal::TooFew { rows: 32, needed: 33 }
    );
}

#[test]
fn a_shift_that_is_not_finite_empties_the_window() {
    let mut prefilter = prefilter(ModelOrder::Fixed(2));
    push_all(&mut prefilter, waves(&mut Dice::new(2), 120));
    prefilter.shift(&[Vector2::zeros(), Vector2::new(f64::NAN, 0.0)]);
    assert!(matches!(prefilter.estimate(), Err(PrefilterRefusal::TooFew { .. })));
}

#[test]
fn settings_out_of_range_are_brought_into_it() {
    let wild = PrefilterConfig {
        interval: Span::from_seconds(-1.0),
        window: Span::from_seconds(1e9),
        order: ModelOrder::Fixed(usize::MAX),
    };
    let mut prefilter = Prefilter::new(&wild);
    let _ = prefilter.push(Time::START, &Vector2::zeros());
    assert!(matches!(prefilter.estimate(), Err(PrefilterRefusal::TooFew { needed: 105, .. })));
}
