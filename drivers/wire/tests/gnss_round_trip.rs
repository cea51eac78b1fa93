//! UBX messages and SBF blocks: what is written is read back, for every value a field can carry.

#![allow(clippy::unwrap_used)] // helpers of tests are not seen as tests

use insd_base::Geodetic;
use insd_base::units::{DEG, wrap_pi};
use insd_wire::gnss::sbf::{
    AttCovEuler, AttEuler, PosCovGeodetic, PvtAccuracy, PvtGeodetic, ReceiverTime, SbfCovariance,
    SbfMode, SbfSolution, SbfStamp, VelCovGeodetic, XppsOffset,
};
use insd_wire::gnss::ubx::{
    Carrier, FixType, LeapEvent, NavCov, NavDop, NavHpPosLlh, NavPvt, NavTimeGps, NavTimeLs,
    PvtTime, RawMeasurement, RxmRawx, RxmSfrbx, Signal, TimTp,
};
use insd_wire::nmea::{CivilTime, Date, TimeOfDay};
use proptest::option::of;
use proptest::prelude::*;

/// Whether two numbers are as close as a step allows.
fn near(written: f64, read: f64, step: f64) -> bool {
    (written - read).abs() <= step * (0.5 + 1e-6) + written.abs() * 1e-15
}

fn both(written: Option<f64>, read: Option<f64>, step: f64) -> bool {
    match (written, read) {
        (Some(written), Some(read)) => near(written, read, step),
        (None, None) => true,
        _ => false,
    }
}

fn angle(written: f64, read: f64, step: f64) -> bool {
    near(wrap_pi(written - read), 0.0, step)
}

fn place(written: Option<Geodetic>, read: Option<Geodetic>, step: f64, height: f64) -> bool {
    written.zip(read).map_or(written.is_none() && read.is_none(), |(written, read)| {
        near(written.latitude, read.latitude, step)
            && angle(written.longitude, read.longitude, step)
            && near(written.height, read.height, height)
    })
}

fn position() -> impl Strategy<Value = Geodetic> {
    (-90.0..=90.0, -180.0..180.0, -1e4..1e5).prop_map(|(latitude, longitude, height)| {
        Geodetic::from_degrees(latitude, longitude, height)
    })
}

fn time_of_week() -> impl Strategy<Value = i64> {
    (0..604_800_000_i64).prop_map(|milliseconds| milliseconds * 1_000_000)
}

fn vector(size: f64) -> impl Strategy<Value = [f64; 3]> {
    prop::array::uniform3(-size..size)
}

prop_compose! {
    fn pvt_time()(
        (year, month, day) in (any::<u16>(), any::<u8>(), any::<u8>()), clock: (u8, u8, u8),
        nanosecond: i32, date_valid: bool, clock_valid: bool, resolved: bool,
        accuracy in of(0.0..4.0),
    ) -> PvtTime {
        let date = Date { year, month, day };
        PvtTime { date, clock, nanosecond, date_valid, clock_valid, resolved, accuracy }
    }
}

prop_compose! {
    fn pvt()(
        time_of_week in time_of_week(), time in pvt_time(), fix in 0..8_u8,
        carrier in prop::sample::select(vec![
            Carrier::None, Carrier::Float, Carrier::Fixed, Carrier::Reserved]),
        (fix_ok, differential, satellites) in any::<(bool, bool, u8)>(),
        position in of(position()), velocity in vector(1e3), course in 0.0..std::f64::consts::TAU,
        (height_msl, ground_speed) in (-1e4..1e5, 0.0..1e3),
        accuracies in prop::array::uniform4(of(0.0..1e4)), heading_accuracy in of(0.0..3.0),
        pdop in of(0.0..99.0), heading in of(0.0..std::f64::consts::TAU),
        declination in of((-3.0..3.0, 0.0..3.0)),
    ) -> NavPvt {
        let fix = [
            FixType::None, FixType::DeadReckoning, FixType::TwoDimensional,
            FixType::ThreeDimensional, FixType::Combined, FixType::TimeOnly, FixType::Other(6),
            FixType::Other(255),
        ][usize::from(fix)];
        let [horizontal_accuracy, vertical_accuracy, speed_accuracy, _] = accuracies;
        NavPvt {
            time_of_week, time, fix, fix_ok, differential, carrier, satellites, position,
            height_msl, horizontal_accuracy, vertical_accuracy, velocity, ground_speed, course,
            speed_accuracy, heading_accuracy, pdop, heading, declination,
        }
    }
}

fn stamp() -> impl Strategy<Value = SbfStamp> {
    (of(time_of_week()), of(0..u16::MAX))
        .prop_map(|(time_of_week, week)| SbfStamp { time_of_week, week })
}

fn mode() -> impl Strategy<Value = SbfMode> {
    let solution = prop::sample::select(vec![
        SbfSolution::None,
        SbfSolution::StandAlone,
        SbfSolution::FixedLocation,
        SbfSolution::Sbas,
        SbfSolution::MovingBaseFloat,
        SbfSolution::Reserved(9),
        SbfSolution::PrecisePoint,
        SbfSolution::Reserved(15),
    ]);
    (solution, any::<(bool, bool, u8)>()).prop_map(
        |(solution, (determining, two_dimensional, error))| SbfMode {
            solution,
            determining,
            two_dimensional,
            error,
        },
    )
}

fn covariance() -> impl Strategy<Value = SbfCovariance> {
    let variances = prop::array::uniform4(of(0.0..1e6_f32));
    let covariances = prop::array::uniform6(of(-1e6..1e6_f32));
    (stamp(), mode(), variances, covariances).prop_map(|(stamp, mode, variances, covariances)| {
        SbfCovariance { stamp, mode, variances, covariances }
    })
}

prop_compose! {
    fn geodetic()(
        stamp in stamp(), mode in mode(), position in of(position()),
        undulation in of(-100.0..100.0_f32),
        velocity in prop::array::uniform3(of(-600.0..600.0_f32)),
        (course, clock_bias, clock_drift) in (of(0.0..6.0), of(-1e-3..1e-3), of(-1e-5..1e-5)),
        (time_system, datum, satellites) in (of(0..255_u8), of(0..255_u8), of(0..255_u8)),
        (reference, signals, alert) in any::<(u16, u32, u8)>(),
        correction_age in of(0.0..655.0), bases: u8,
        extra in of((of(0.0..6.5), of(0.0..655.0), of(0.0..655.0))),
    ) -> PvtGeodetic {
        let extra = extra.map(|(latency, horizontal, vertical)| {
            PvtAccuracy { bases, latency, horizontal, vertical }
        });
        PvtGeodetic {
            stamp, mode, position, undulation, velocity, course, clock_bias, clock_drift,
            time_system, datum, satellites, reference, correction_age, signals, alert, extra,
        }
    }
}

proptest! {
    #[test]
    fn nav_pvt_comes_back(pvt in pvt()) {
        let back = NavPvt::read(&pvt.write()).unwrap();
        let exact = |pvt: &NavPvt| (
            pvt.time_of_week, pvt.fix, pvt.fix_ok, pvt.differential, pvt.carrier, pvt.satellites,
            PvtTime { accuracy: None, ..pvt.time },
        );
        prop_assert_eq!(exact(&pvt), exact(&back));
        prop_assert!(both(pvt.time.accuracy, back.time.accuracy, 1e-9));
        prop_assert!(place(pvt.position, back.position, 1e-7 * DEG, 1e-3));
        let millis = [
            (pvt.height_msl, back.height_msl), (pvt.ground_speed, back.ground_speed),
            (pvt.velocity[0], back.velocity[0]), (pvt.velocity[1], back.velocity[1]),
            (pvt.velocity[2], back.velocity[2]),
        ];
        prop_assert!(millis.iter().all(|(written, read)| near(*written, *read, 1e-3)));
        prop_assert!(both(pvt.horizontal_accuracy, back.horizontal_accuracy, 1e-3));
        prop_assert!(both(pvt.vertical_accuracy, back.vertical_accuracy, 1e-3));
        prop_assert!(both(pvt.speed_accuracy, back.speed_accuracy, 1e-3));
        prop_assert!(both(pvt.heading_accuracy, back.heading_accuracy, 1e-5 * DEG));
        prop_assert!(angle(pvt.course, back.course, 1e-5 * DEG));
        prop_assert_eq!(pvt.heading.is_some(), back.heading.is_some());
        prop_assert!(angle(pvt.heading.unwrap_or(0.0), back.heading.unwrap_or(0.0), 1e-5 * DEG));
        prop_assert!(both(pvt.pdop, back.pdop, 0.01));
        let (here, there) = (pvt.declination.unzip(), back.declination.unzip());
        prop_assert!(both(here.0, there.0, 0.01 * DEG) && both(here.1, there.1, 0.01 * DEG));
    }

    #[test]
    fn covariances_and_dilutions_come_back(
        time_of_week in time_of_week(), elements: ([f32; 3], [f32; 2], f32), known: (bool, bool),
        dilutions in prop::array::uniform7(of(0.0..99.0)),
    ) {
        let (north, east, down) = elements;
        let covariance = insd_wire::gnss::ubx::UbxCovariance { north, east, down };
        let position = known.0.then_some(covariance);
        let velocity = known.1.then_some(covariance);
        let cov = NavCov { time_of_week, position, velocity };
        // NaN is not equal to itself
        prop_assert_eq!(NavCov::read(&cov.write()).unwrap().write(), cov.write());
        let [geometric, position, time, vertical, horizontal, north, east] = dilutions;
        let dop =
            NavDop { time_of_week, geometric, position, time, vertical, horizontal, north, east };
        let back = NavDop::read(&dop.write()).unwrap();
        let all = |dop: &NavDop| [
            dop.geometric, dop.position, dop.time, dop.vertical, dop.horizontal, dop.north, dop.east,
        ];
        let pairs = all(&dop).into_iter().zip(all(&back));
        prop_assert!(pairs.clone().all(|(written, read)| both(written, read, 0.01)));
    }

    #[test]
    fn positions_of_high_precision_come_back(
        time_of_week in time_of_week(), position in of(position()), height_msl in -1e4..1e5,
        horizontal_accuracy in of(0.0..1e5), vertical_accuracy in of(0.0..1e5),
    ) {
        let llh = NavHpPosLlh {
            time_of_week, position, height_msl, horizontal_accuracy, vertical_accuracy,
        };
        let back = NavHpPosLlh::read(&llh.write()).unwrap();
        prop_assert!(place(position, back.position, 1e-9 * DEG, 1e-4));
        prop_assert!(near(height_msl, back.height_msl, 1e-4));
        prop_assert!(both(horizontal_accuracy, back.horizontal_accuracy, 1e-4));
        prop_assert!(both(vertical_accuracy, back.vertical_accuracy, 1e-4));
    }

    #[test]
    fn times_come_back(
        time_of_week in time_of_week(), (fraction, week, time_of_week_valid, week_valid) in
            any::<(i32, i16, bool, bool)>(),
        leap_seconds in of(any::<i8>()), accuracy in of(0.0..4.0), source: u8,
        event in of(any::<(i8, u8, i32, u16, u16)>()),
    ) {
        let time = NavTimeGps {
            time_of_week, fraction, week, leap_seconds, time_of_week_valid, week_valid, accuracy,
        };
        let back = NavTimeGps::read(&time.write()).unwrap();
        prop_assert!(both(accuracy, back.accuracy, 1e-9));
        prop_assert_eq!(NavTimeGps { accuracy, ..back }, time);
        let event = event.map(|(change, source, wait, week, day)| {
            LeapEvent { change, source, wait, week, day }
        });
        let leaps = NavTimeLs { time_of_week, leap_seconds, source, event };
        prop_assert_eq!(NavTimeLs::read(&leaps.write()).unwrap(), leaps);
    }

    #[test]
    fn pulses_come_back(
        time_of_week in time_of_week(), fraction in 0.0..1e-3, quantization in of(-2e-3..2e-3),
        week: u16, (utc_base, utc_available) in any::<(bool, bool)>(), raim in 0..4_u8,
        system in 0..16_u8, utc_standard in 0..16_u8,
    ) {
        let pulse = TimTp {
            time_of_week, fraction, quantization, week, utc_base, utc_available, raim, system,
            utc_standard,
        };
        let back = TimTp::read(&pulse.write()).unwrap();
        prop_assert!(near(fraction, back.fraction, 1e-3 / 4_294_967_296.0));
        prop_assert!(both(quantization, back.quantization, 1e-12));
        prop_assert_eq!(TimTp { fraction, quantization, ..back }, pulse);
    }

    #[test]
    fn raw_measurements_come_back(
        (time_of_week, week, leap_seconds) in (0.0..604_800.0, any::<u16>(), any::<i8>()),
        (leap_seconds_valid, clock_reset) in any::<(bool, bool)>(),
        ranges in prop::collection::vec((of(1e7..5e7), of(-1e9..1e9), -1e4..1e4_f32), 0..8),
        numbers: (u8, u8, u8, u8), (lock_time, carrier_phase_std) in (0.0..64.5, of(0.0..0.056)),
        words: Vec<u32>,
    ) {
        let (system, satellite, signal, slot) = numbers;
        let signal = Signal { system, satellite, signal, slot };
        let measurement = |(pseudorange, carrier_phase, doppler)| RawMeasurement {
            pseudorange, carrier_phase, doppler, signal, lock_time, carrier_to_noise: 45,
            pseudorange_exponent: 5, carrier_phase_std, doppler_exponent: 15,
            half_cycle_valid: true, half_cycle_subtracted: false,
        };
        let measurements = ranges.into_iter().map(measurement).collect();
        let raw = RxmRawx {
            time_of_week, week, leap_seconds, leap_seconds_valid, clock_reset, measurements,
        };
        let mut back = RxmRawx::read(&raw.write()).unwrap();
        for one in &mut back.measurements {
            prop_assert!(near(lock_time, one.lock_time, 1e-3));
            prop_assert!(both(carrier_phase_std, one.carrier_phase_std, 0.004));
            (one.lock_time, one.carrier_phase_std) = (lock_time, carrier_phase_std);
        }
        prop_assert_eq!(back, raw);
        let subframe = RxmSfrbx { signal, channel: 3, version: 2, words };
        prop_assert_eq!(RxmSfrbx::read(&subframe.write()).unwrap(), subframe);
    }

    #[test]
    fn pvt_geodetic_comes_back_in_both_lengths(pvt in geodetic()) {
        let back = PvtGeodetic::read(&pvt.write()).unwrap();
        prop_assert!(both(pvt.course, back.course, 1e-6));
        prop_assert!(both(pvt.clock_bias, back.clock_bias, 1e-15));
        prop_assert!(both(pvt.clock_drift, back.clock_drift, 1e-12));
        prop_assert!(both(pvt.correction_age, back.correction_age, 0.01));
        let (here, there) = (pvt.extra, back.extra);
        prop_assert_eq!(here.is_some(), there.is_some());
        for (here, there) in here.into_iter().zip(there) {
            prop_assert_eq!(here.bases, there.bases);
            prop_assert!(both(here.latency, there.latency, 1e-4));
            prop_assert!(both(here.horizontal, there.horizontal, 0.01));
            prop_assert!(both(here.vertical, there.vertical, 0.01));
        }
        let rounded = PvtGeodetic {
            course: pvt.course, clock_bias: pvt.clock_bias, clock_drift: pvt.clock_drift,
            correction_age: pvt.correction_age, extra: pvt.extra, ..back
        };
        prop_assert_eq!(rounded, pvt);
    }

    #[test]
    fn covariances_of_sbf_come_back(covariance in covariance()) {
        let position = PosCovGeodetic(covariance);
        prop_assert_eq!(PosCovGeodetic::read(&position.write()).unwrap(), position);
        let velocity = VelCovGeodetic(covariance);
        prop_assert_eq!(VelCovGeodetic::read(&velocity.write()).unwrap(), velocity);
    }

    #[test]
    fn attitudes_come_back(
        stamp in stamp(), satellites in of(0..255_u8), error: u8, mode: u16,
        angles in prop::array::uniform6(of(-6.0..6.0)),
    ) {
        let [heading, pitch, roll, rates @ ..] = angles;
        let attitude = AttEuler { stamp, satellites, error, mode, heading, pitch, roll, rates };
        let back = AttEuler::read(&attitude.write()).unwrap();
        let pairs = [(heading, back.heading), (pitch, back.pitch), (roll, back.roll)];
        for (written, read) in pairs.into_iter().chain(rates.into_iter().zip(back.rates)) {
            prop_assert!(both(written, read, 2e-6));
        }
        prop_assert_eq!(AttEuler { heading, pitch, roll, rates, ..back }, attitude);
        let (variances, covariances) = ([heading, pitch, roll], rates);
        let cov = AttCovEuler { stamp, error, variances, covariances };
        let back = AttCovEuler::read(&cov.write()).unwrap();
        let read = back.variances.into_iter().chain(back.covariances);
        prop_assert!(angles.into_iter().zip(read).all(|(written, read)| both(written, read, 2e-6)));
    }

    #[test]
    fn receiver_time_and_pulses_of_sbf_come_back(
        stamp in stamp(), (year, month, day) in (2000..2100_u16, 1..=12_u8, 1..=28_u8),
        (hour, minute, second) in (0..24_u8, 0..60_u8, 0..=60_u8), known: bool,
        leap_seconds in of(-127..=127_i8), (sync, age, scale) in any::<(u8, u8, u8)>(),
        offset in of(-1e-6..1e-6),
    ) {
        let date = Date { year, month, day };
        let time = TimeOfDay { hour, minute, second, nanosecond: 0 };
        let utc = known.then_some(CivilTime { date, time });
        let time = ReceiverTime { stamp, utc, leap_seconds, sync };
        prop_assert_eq!(ReceiverTime::read(&time.write()).unwrap(), time);
        let pulse = XppsOffset { stamp, age, scale, offset };
        let back = XppsOffset::read(&pulse.write()).unwrap();
        prop_assert!(both(offset, back.offset, 1e-13));
        prop_assert_eq!(XppsOffset { offset, ..back }, pulse);
    }
}
