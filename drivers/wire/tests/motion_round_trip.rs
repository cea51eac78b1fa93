//! Telegrams of motion sensors: what is written is read, over the whole range; and any bytes.

#![allow(clippy::unwrap_used)] // helpers of tests are not seen as tests

#[path = "checks/motion.rs"]
mod checks;
mod motion_samples;

use std::f64::consts::{FRAC_PI_2, PI, TAU};
use std::fs;
use std::path::Path;

use insd_base::UtcTime;
use insd_base::units::DEG;
use insd_wire::motion::em::EmAttitude;
use insd_wire::motion::kmb::{Kmb, KmbSigma};
use insd_wire::motion::seapath::{Seapath23, Seapath26};
use insd_wire::motion::tss1::Tss1;
use insd_wire::motion::{Rated, SensorDelayedHeave, SensorPlace, Tilt, Vertical};
use motion_samples::*;
use proptest::prelude::*;

fn rated<T: std::fmt::Debug + 'static>(
    value: impl Strategy<Value = T> + 'static,
) -> BoxedStrategy<Option<Rated<T>>> {
    let rated = (value, any::<bool>()).prop_map(|(value, reduced)| Rated { value, reduced });
    proptest::option::of(rated).boxed()
}

fn places() -> impl Strategy<Value = SensorPlace> {
    let place = (-FRAC_PI_2..=FRAC_PI_2, -PI..=PI, -500.0..9000.0);
    (place, -300.0..300.0, -300.0..300.0).prop_map(
        |((latitude, longitude, height), north_velocity, east_velocity)| SensorPlace {
            latitude,
            longitude,
            height,
            north_velocity,
            east_velocity,
        },
    )
}

prop_compose! {
    fn motions()(
        seconds in 0..=i64::from(i32::MAX) - 1,
        nanos in 0..SECOND,
        place in rated(places()),
        tilt in rated((-PI..=PI, -FRAC_PI_2..=FRAC_PI_2).prop_map(|(roll, pitch)| Tilt { roll, pitch })),
        heading in rated(0.0..TAU),
        vertical in rated((-320.0..320.0, -320.0..320.0)
            .prop_map(|(heave, down_velocity)| Vertical { heave, down_velocity })),
        rates in prop::array::uniform3(-3.1..3.1),
    ) -> Seapath23 {
        let time = UtcTime::from_nanos(seconds * SECOND + nanos);
        Seapath23 { time, place, tilt, heading, vertical, rates }
    }
}

/// How far two angles are from each other, either way round.
fn apart(left: f64, right: f64) -> f64 {
    let apart = (left - right).rem_euclid(TAU);
    apart.min(TAU - apart)
}

/// Compares two groups, of which both or none are known.
fn same<T: Copy>(
    left: Option<Rated<T>>,
    right: Option<Rated<T>>,
    near: impl Fn(T, T) -> bool,
) -> Result<(), TestCaseError> {
    let marks = [left, right].map(|group| group.map(|group| group.reduced));
    prop_assert_eq!(marks[0], marks[1]);
    let both = left.zip(right);
    prop_assert!(both.is_none_or(|(left, right)| near(left.value, right.value)));
    Ok(())
}

/// Compares what both binary formats have, with tolerances for position and angles, rad, and for metres.
fn same_motion(
    left: &Seapath23,
    right: &Seapath23,
    (position, angle, length): (f64, f64, f64),
) -> Result<(), TestCaseError> {
    same(left.place, right.place, |left, right| {
        near(left.latitude, right.latitude, position)
            && apart(left.longitude, right.longitude) <= position
            && near(left.height, right.height, length)
            && near(left.north_velocity, right.north_velocity, length)
            && near(left.east_velocity, right.east_velocity, length)
    })?;
    same(left.tilt, right.tilt, |left, right| {
        apart(left.roll, right.roll) <= angle && near(left.pitch, right.pitch, angle)
    })?;
    same(left.heading, right.heading, |left, right| apart(left, right) <= angle)?;
    same(left.vertical, right.vertical, |left, right| {
        near(left.heave, right.heave, length)
            && near(left.down_velocity, right.down_velocity, length)
    })?;
    for (left, right) in left.rates.iter().zip(right.rates) {
        prop_assert!(near(*left, right, angle));
    }
    Ok(())
}

#[test]
fn the_seeds_of_the_fuzz_target_are_telegrams_and_do_no_harm() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fuzz/corpus/motion");
    let mut read = [false; 5];
    for entry in fs::read_dir(folder).unwrap() {
        let bytes = fs::read(entry.unwrap().path()).unwrap();
        checks::everything(&bytes);
        read[0] |= Tss1::read(&bytes).is_ok();
        read[1] |= EmAttitude::read(&bytes).is_ok();
        read[2] |= Kmb::read(&bytes).is_ok();
        read[3] |= Seapath23::read(&bytes).is_ok();
        read[4] |= Seapath26::read(&bytes).is_ok();
    }
    assert_eq!(read, [true; 5], "TSS1, EM, KM binary, Seapath 23, 26");
}

proptest! {
    #[test]
    fn tss1_reads_what_it_writes(
        horizontal_acceleration in 0.0..9.79,
        vertical_acceleration in -20.48..20.4796,
        heave in -99.99..99.99,
        (roll, pitch) in (-99.99..99.99, -99.99..99.99),
        settled in any::<bool>(),
    ) {
        let (roll, pitch) = (roll * DEG, pitch * DEG);
        let telegram = Tss1 {
            horizontal_acceleration, vertical_acceleration, heave, roll, pitch, settled, ..LEVEL
        };
        let read = Tss1::read(&telegram.write().unwrap()).unwrap();
        prop_assert!(near(read.horizontal_acceleration, horizontal_acceleration, 0.019_18));
        prop_assert!(near(read.vertical_acceleration, vertical_acceleration, 0.000_313));
        prop_assert!(near(read.heave, heave, 0.005_001));
        prop_assert!(near(read.roll, roll, 0.005_001 * DEG) && near(read.pitch, pitch, 0.005_001 * DEG));
        prop_assert_eq!(read.settled, settled);
    }

    #[test]
    fn em_reads_what_it_writes(
        (roll, pitch) in (-179.99..179.99, -179.99..179.99),
        heave in -9.99..9.99,
        heading in -360.0..720.0,
    ) {
        let [roll, pitch, heading] = [roll, pitch, heading].map(|angle: f64| angle * DEG);
        let telegram = EmAttitude {
            roll: Some(roll), pitch: Some(pitch), heave: Some(heave), heading: Some(heading), ..EM
        };
        let read = EmAttitude::read(&telegram.write()).unwrap();
        prop_assert!(near(read.roll.unwrap(), roll, 0.005_001 * DEG));
        prop_assert!(near(read.pitch.unwrap(), pitch, 0.005_001 * DEG));
        prop_assert!(near(read.heave.unwrap(), heave, 0.005_001));
        prop_assert!(apart(read.heading.unwrap(), heading) <= 0.005_001 * DEG);
        prop_assert!((0.0..TAU).contains(&read.heading.unwrap()));
    }

    #[test]
    fn seapath_reads_what_it_writes(
        motion in motions(),
        late in 0..i64::from(i32::MAX),
        heave in -327.0..327.0,
    ) {
        let time = UtcTime::from_nanos(late * SECOND);
        let telegram = Seapath26 { motion, delayed_heave: Some(SensorDelayedHeave { time, heave }) };
        let read = Seapath26::read(&telegram.write().unwrap()).unwrap();
        prop_assert_eq!(Seapath23::read(&motion.write().unwrap()), Ok(read.motion));
        let tolerances = (7.4e-10, 4.8e-5, 0.005_001);
        same_motion(&motion, &read.motion, tolerances)?;
        let off = read.motion.time.as_nanos() - motion.time.as_nanos();
        prop_assert!((-50_000..=50_000).contains(&off), "{off} ns");
        let delayed = read.delayed_heave.unwrap();
        prop_assert_eq!(delayed.time, time);
        prop_assert!(near(delayed.heave, heave, 0.005_001));
    }

    #[test]
    fn km_binary_reads_what_it_writes(
        motion in motions(),
        delayed_heave in rated((0..i64::from(u32::MAX) * SECOND, -50.0..50.0).prop_map(|(nanos, heave)| {
            SensorDelayedHeave { time: UtcTime::from_nanos(nanos), heave }
        })),
        acceleration in rated(prop::array::uniform3(-30.0..30.0)),
        sigma in prop::option::of(0.0..1e6),
    ) {
        let Seapath23 { time, place, tilt, heading, vertical, rates } = motion;
        let sigma = KmbSigma { east: sigma, heading: sigma, ..KmbSigma::default() };
        let telegram = Kmb {
            time, place, tilt, heading, vertical, rates, acceleration, delayed_heave, sigma
        };
        let read = Kmb::read(&telegram.write().unwrap()).unwrap();
        let Kmb { time, place, tilt, heading, vertical, rates, .. } = read;
        prop_assert_eq!(time, motion.time);
        let back = Seapath23 { time, place, tilt, heading, vertical, rates };
        same_motion(&motion, &back, (1e-15, 3e-7, 5e-4))?;
        same(acceleration, read.acceleration, |left, right| {
            left.iter().zip(right).all(|(left, right)| near(*left, right, 1e-6))
        })?;
        same(delayed_heave, read.delayed_heave, |left, right| {
            left.time == right.time && near(left.heave, right.heave, 2e-6)
        })?;
        prop_assert_eq!(read.sigma.north, None);
        for (left, right) in [(sigma.east, read.sigma.east), (sigma.heading, read.sigma.heading)] {
            prop_assert_eq!(left.is_some(), right.is_some());
            prop_assert!(left.zip(right).is_none_or(|(left, right)| near(left, right, 0.04)));
        }
    }

    #[test]
    fn any_bytes_are_read_or_refused(bytes in prop::collection::vec(any::<u8>(), 0..150)) {
        checks::everything(&bytes);
    }

    #[test]
    fn telegrams_that_are_cut_or_damaged_do_no_harm(
        motion in motions(),
        at in 0_usize..200,
        with in any::<u8>(),
    ) {
        let Seapath23 { time, place, tilt, heading, vertical, rates } = motion;
        let kmb = Kmb { time, place, tilt, heading, vertical, rates, ..oslo_fjord() };
        let telegrams = [
            LEVEL.write().unwrap().to_vec(),
            EM.write().to_vec(),
            kmb.write().unwrap().to_vec(),
            motion.write().unwrap().to_vec(),
            Seapath26 { motion, delayed_heave: None }.write().unwrap().to_vec(),
        ];
        for mut telegram in telegrams {
            let at = at % telegram.len();
            checks::everything(&telegram[..at]);
            telegram[at] = with;
            checks::everything(&telegram);
        }
    }
}
