//! Bytes: the same for the same state, small, quick to make; damage of any kind is told with a reason.

use std::sync::OnceLock;

use insd_base::{Body, ResumeDoubt, Span, Time};
use insd_engine::{Engine, EngineConfig};
use proptest::prelude::*;

use crate::voyages::{Watched, Way, scenario, watch};

fn watched() -> &'static Watched {
    static WATCHED: OnceLock<Watched> = OnceLock::new();
    WATCHED.get_or_init(|| watch(&scenario(Way::Steady, 3, "navigation", 400.0), 1, 300.0, 30.0))
}

fn offered(config: &EngineConfig, bytes: &[u8], age: f64) -> Result<(), ResumeDoubt> {
    let now = Time::from_seconds(0.3);
    Engine::new(config.clone()).resume(bytes, now, Span::from_seconds(age))
}

#[test]
fn the_same_state_gives_the_same_bytes_and_they_are_few() {
    let again = watch(&scenario(Way::Steady, 3, "navigation", 400.0), 1, 300.0, 30.0);
    assert_eq!(again.kept, watched().kept);
    let lengths: Vec<usize> = again.kept.iter().map(|(_, _, bytes)| bytes.len()).collect();
    assert!(lengths.iter().all(|length| (10_000..20_000).contains(length)), "{lengths:?}");
}

#[test]
fn a_state_of_another_shape_has_another_version() {
    let moored = watch(&scenario(Way::Moored, 3, "navigation", 410.0), 1, 400.0, 30.0);
    let shape = |watched: &Watched| {
        let bytes = &watched.kept[0].2;
        (u16::from_le_bytes([bytes[4], bytes[5]]), bytes.len())
    };
    // who finds other numbers here raises the version: an older state would be read as what it is not
    assert_eq!([shape(watched()), shape(&moored)], [(25, 16_255), (25, 22_201)]);
}

#[test]
fn an_engine_that_is_at_work_another_imu_another_mounting_and_an_old_state_are_refused() {
    let watched = watched();
    let bytes = &watched.kept[0].2;
    let config = &watched.config;
    assert_eq!(offered(config, bytes, 1.0), Ok(()));
    for age in [-0.1, 60.1, f64::from(u32::MAX)] {
        assert_eq!(offered(config, bytes, age), Err(ResumeDoubt::TooOld), "{age}");
    }
    let mut other = config.clone();
    other.imu.gyro.bias_std *= 2.0;
    assert_eq!(offered(&other, bytes, 1.0), Err(ResumeDoubt::OtherImu));
    let mut other = config.clone();
    other.lever_arms.gnss = Body::new(1.0, 2.0, -3.0);
    assert_eq!(offered(&other, bytes, 1.0), Err(ResumeDoubt::OtherMounting));
    let mut engine = Engine::new(config.clone());
    let imu = watched.messages.iter().filter(|m| m.source.name() == "imu");
    imu.take(3).for_each(|message| engine.handle(message));
    let late = engine.resume(bytes, Time::START, Span::ZERO);
    assert_eq!(late, Err(ResumeDoubt::TooLate));
}

#[test]
fn while_the_heading_is_searched_for_there_is_no_checkpoint() {
    let mut engine = Engine::new(watched().config.clone());
    assert_eq!(engine.checkpoint(), None);
    for message in watched().messages.iter().take_while(|m| m.receipt < Time::from_seconds(5.0)) {
        engine.handle(message);
    }
    assert_eq!(engine.checkpoint(), None);
    let resumed = engine.resume(b"", Time::START, Span::ZERO);
    assert_eq!(resumed, Err(ResumeDoubt::TooLate));
}

#[test]
fn until_its_first_sample_a_resumed_engine_says_nothing_and_keeps_nothing() {
    let mut engine = Engine::new(watched().config.clone());
    engine.resume(&watched().kept[0].2, Time::START, Span::from_seconds(1.0)).unwrap();
    assert!(engine.motion().is_none() && engine.checkpoint().is_none());
    assert!(engine.estimates().is_none() && engine.poll_output().is_none());
    assert_eq!(engine.mode().as_str(), "standby");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn a_flipped_bit_is_found(place in 0..10_000_usize, bit in 0..8_u8) {
        let mut bytes = watched().kept[0].2.clone();
        bytes[place] ^= 1 << bit;
        prop_assert_eq!(offered(&watched().config, &bytes, 1.0), Err(ResumeDoubt::Damaged));
    }

    #[test]
    fn what_was_cut_off_is_found(length in 0..10_000_usize, tail in 0..100_usize) {
        let bytes = &watched().kept[0].2;
        let cut = offered(&watched().config, &bytes[..length], 1.0);
        prop_assert_eq!(cut, Err(ResumeDoubt::Damaged));
        let longer: Vec<u8> = bytes.iter().copied().chain((0..=tail).map(|i| i as u8)).collect();
        prop_assert_eq!(offered(&watched().config, &longer, 1.0), Err(ResumeDoubt::Damaged));
    }

    #[test]
    fn any_bytes_give_a_reason(bytes in prop::collection::vec(any::<u8>(), 0..2000)) {
        prop_assert!(offered(&watched().config, &bytes, 1.0).is_err());
    }
}
