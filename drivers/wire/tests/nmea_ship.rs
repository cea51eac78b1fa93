//! Sentences of compasses, logs and motion units: what is written is read back.

#![allow(clippy::unwrap_used, clippy::panic)] // helpers of tests are not seen as tests

mod common;

use common::{angle, close, perhaps, read, same_angle, time_of_day};
use insd_base::UtcTime;
use insd_base::units::KNOT;
use insd_wire::nmea::{
    Hdg, Hdm, NortekBeam, NortekBottomTrack, NortekGroundSpeed, NortekSensors, Pashr, PashrDialect,
    Psxn, PsxnQuality, Sentence, Talker, TimeOfDay, Vbw, VbwStern, VbwVelocity, Vdr, Vhw, Vlw,
};
use proptest::prelude::*;

const HUNDREDTH_DEG: f64 = 0.005 * std::f64::consts::PI / 180.0;

fn all_close(written: &[Option<f64>], read: &[Option<f64>], half_digit: f64) -> bool {
    written.len() == read.len()
        && written.iter().zip(read).all(|(written, read)| close(*written, *read, half_digit))
}

fn velocity() -> impl Strategy<Value = VbwVelocity> {
    (perhaps(-500.0..500.0), perhaps(-500.0..500.0), any::<bool>()).prop_map(
        |(longitudinal, transverse, valid)| VbwVelocity { longitudinal, transverse, valid },
    )
}

fn stern() -> impl Strategy<Value = VbwStern> {
    (perhaps(-500.0..500.0), any::<bool>())
        .prop_map(|(transverse, valid)| VbwStern { transverse, valid })
}

fn quality() -> impl Strategy<Value = Option<PsxnQuality>> {
    prop::sample::select(vec![PsxnQuality::Normal, PsxnQuality::Reduced, PsxnQuality::Invalid])
        .prop_map(Some)
}

proptest! {
    #[test]
    fn magnetic_headings_come_back(
        reading in angle(), deviation in perhaps(-3.1..3.1), variation in perhaps(-3.1..3.1),
    ) {
        let hdg = Hdg { reading, deviation, variation };
        let Sentence::Hdg(back) = read(&hdg.write(Talker::HE)) else { panic!() };
        prop_assert!(same_angle(reading, back.reading, HUNDREDTH_DEG));
        prop_assert!(close(deviation, back.deviation, 10.0 * HUNDREDTH_DEG));
        prop_assert!(close(variation, back.variation, 10.0 * HUNDREDTH_DEG));
        let Sentence::Hdm(back) = read(&Hdm { heading: reading }.write(Talker::HE)) else { panic!() };
        prop_assert!(same_angle(reading, back.heading, HUNDREDTH_DEG));
    }

    #[test]
    fn speeds_over_ground_and_through_the_water_come_back(
        water in velocity(), ground in velocity(), stern_water in stern(), stern_ground in stern(),
    ) {
        let vbw = Vbw { water, ground, stern_water, stern_ground, without_stern: false };
        let Sentence::Vbw(back) = read(&vbw.write(Talker::VD)) else { panic!() };
        for (written, back) in [(water, back.water), (ground, back.ground)] {
            prop_assert!(close(written.longitudinal, back.longitudinal, 0.000_5 * KNOT));
            prop_assert!(close(written.transverse, back.transverse, 0.000_5 * KNOT));
            let known = written.longitudinal.is_some() || written.transverse.is_some();
            prop_assert_eq!(back.valid, written.valid && known);
        }
        for (written, back) in [(stern_water, back.stern_water), (stern_ground, back.stern_ground)] {
            prop_assert!(close(written.transverse, back.transverse, 0.000_5 * KNOT));
            prop_assert_eq!(back.valid, written.valid && written.transverse.is_some());
        }
        let short = Vbw { without_stern: true, ..vbw };
        let Sentence::Vbw(short) = read(&short.write(Talker::VD)) else { panic!() };
        let none = VbwStern::default();
        prop_assert_eq!(short, Vbw { without_stern: true, stern_water: none, stern_ground: none, ..back });
    }

    #[test]
    fn water_speed_distance_and_drift_come_back(
        heading in angle(), heading_magnetic in angle(), speed in perhaps(-250.0..250.0),
        drift in perhaps(0.0..50.0), distances in prop::array::uniform4(perhaps(0.0..9e9)),
    ) {
        let vhw = Vhw { heading, heading_magnetic, speed };
        let Sentence::Vhw(back) = read(&vhw.write(Talker::VD)) else { panic!() };
        prop_assert!(same_angle(heading, back.heading, HUNDREDTH_DEG));
        prop_assert!(same_angle(heading_magnetic, back.heading_magnetic, HUNDREDTH_DEG));
        prop_assert!(close(speed, back.speed, 0.005 * KNOT));
        let vdr = Vdr { set: heading, set_magnetic: heading_magnetic, drift };
        let Sentence::Vdr(back) = read(&vdr.write(Talker::VD)) else { panic!() };
        prop_assert!(same_angle(heading, back.set, HUNDREDTH_DEG));
        prop_assert!(close(drift, back.drift, 0.005 * KNOT));
        let [water, water_trip, ground, ground_trip] = distances;
        let vlw = Vlw { water, water_trip, ground, ground_trip };
        let Sentence::Vlw(back) = read(&vlw.write(Talker::VD)) else { panic!() };
        let back = [back.water, back.water_trip, back.ground, back.ground_trip];
        prop_assert!(all_close(&distances, &back, 0.000_5 * 1852.0 + 1e-6));
    }

    #[test]
    fn seatex_sentences_come_back(
        qualities in [quality(), quality(), quality(), quality()], heading in angle(),
        event in 0..=9999_u32, angles in prop::array::uniform3(perhaps(-6.2..6.2)),
        heave in perhaps(-99.0..99.0),
    ) {
        let [horizontal, height, heading_quality, attitude] = qualities;
        let quality = Psxn::Quality { horizontal, height, heading: heading_quality, attitude };
        prop_assert_eq!(read(&quality.write()), Sentence::Psxn(quality));
        let event = Psxn::Event { event };
        prop_assert_eq!(read(&event.write()), Sentence::Psxn(event));
        let [roll, pitch, yaw] = angles;
        let motion = Psxn::Motion { roll, pitch, heading, heave };
        let Sentence::Psxn(Psxn::Motion { roll: r, pitch: p, heading: h, heave: d }) =
            read(&motion.write()) else { panic!() };
        prop_assert!(all_close(&[roll, pitch], &[r, p], HUNDREDTH_DEG));
        prop_assert!(same_angle(heading, h, HUNDREDTH_DEG) && close(heave, d, 0.005));
        let rates = Psxn::Rates {
            roll_rate: roll, pitch_rate: pitch, yaw_rate: yaw, down_velocity: heave,
        };
        let Sentence::Psxn(Psxn::Rates { roll_rate: r, pitch_rate: p, yaw_rate: y, down_velocity: d })
            = read(&rates.write()) else { panic!() };
        prop_assert!(all_close(&[roll, pitch, yaw], &[r, p, y], HUNDREDTH_DEG));
        prop_assert!(close(heave, d, 0.005));
        let offsets = Psxn::GyroOffsets { calibration: roll, offset: pitch };
        let Sentence::Psxn(Psxn::GyroOffsets { calibration: r, offset: p }) =
            read(&offsets.write()) else { panic!() };
        prop_assert!(all_close(&[roll, pitch], &[r, p], HUNDREDTH_DEG));
    }

    #[test]
    fn attitude_in_a_dialect_comes_back(
        time in prop::option::of(time_of_day()), heading in angle(),
        roll in perhaps(-3.1..3.1), pitch in perhaps(-1.5..1.5), heave in perhaps(-99.0..99.0),
        sigmas in prop::array::uniform3(perhaps(0.0..3.1)),
        digits in (prop::option::of(0..=9_u8), prop::option::of(0..=9_u8)), up: bool,
    ) {
        let dialect = if up { PashrDialect::SbgWassp } else { PashrDialect::Sbg };
        let [roll_std, pitch_std, heading_std] = sigmas;
        let mut pashr = Pashr {
            time, heading, roll, pitch, roll_std, pitch_std, heading_std, heave_as_sent: None,
            quality_digit: digits.0, status_digit: digits.1,
        };
        pashr.set_heave_down(heave, dialect);
        let Sentence::Pashr(back) = read(&pashr.write()) else { panic!() };
        prop_assert_eq!((back.time, back.quality_digit, back.status_digit), (time, digits.0, digits.1));
        prop_assert!(same_angle(heading, back.heading, HUNDREDTH_DEG));
        prop_assert!(all_close(&[roll, pitch], &[back.roll, back.pitch], HUNDREDTH_DEG));
        prop_assert!(close(heave, back.heave_down(dialect), 0.005));
        let back = [back.roll_std, back.pitch_std, back.heading_std];
        prop_assert!(all_close(&sigmas, &back, 0.1 * HUNDREDTH_DEG));
    }

    #[test]
    fn bottom_tracks_come_back(
        tagged: bool, with_sensors: bool, tenths in prop::option::of(0..40_000_000_000_000_i64),
        delays in prop::array::uniform2(perhaps(-9.0..9.0)),
        velocity in prop::array::uniform3(perhaps(-32.76..32.76)),
        figure_of_merit in perhaps(0.0..9.99),
        distances in prop::array::uniform4(perhaps(0.01..999.0)),
        sensors in prop::array::uniform4(perhaps(0.0..9999.0)), status: u32,
    ) {
        let [voltage, sound_speed, pressure, temperature] = sensors;
        let status = Some(status);
        let sensors = NortekSensors { voltage, sound_speed, pressure, temperature, status };
        let track = NortekBottomTrack {
            tagged, time: tenths.map(|tenths| UtcTime::from_nanos(tenths * 100_000)),
            trigger_to_echo: delays[0], echo_to_output: delays[1], velocity, figure_of_merit,
            distances, sensors: with_sensors.then_some(sensors),
        };
        let Sentence::NortekBottomTrack(back) = read(&track.write()) else { panic!() };
        prop_assert_eq!((back.tagged, back.time), (track.tagged, track.time));
        prop_assert!(all_close(&delays, &[back.trigger_to_echo, back.echo_to_output], 5e-7));
        prop_assert!(all_close(&velocity, &back.velocity, 5e-6));
        prop_assert!(close(figure_of_merit, back.figure_of_merit, 5e-6));
        prop_assert!(all_close(&distances, &back.distances, 0.005));
        prop_assert_eq!(back.sensors.and_then(|s| s.status), track.sensors.and_then(|s| s.status));
        if let Some(back) = back.sensors {
            prop_assert!(close(voltage, back.voltage, 0.005));
            prop_assert!(close(pressure, back.pressure, 50.0));
        }
    }

    #[test]
    fn single_beams_and_ground_speeds_of_nortek_come_back(
        beam in prop::option::of(0..=99_u8), date in prop::option::of(prop::array::uniform3(0..100_u8)),
        time in prop::option::of(time_of_day()), velocity in perhaps(-32.76..32.76),
        figure_of_merit in perhaps(0.0..9.99), distance in perhaps(0.01..999.0), course in angle(),
        status in prop::option::of(any::<u32>()),
    ) {
        let one = NortekBeam {
            beam, date_as_sent: date, time, trigger_to_echo: Some(0.02), echo_to_output: None,
            velocity, figure_of_merit, distance, status,
        };
        let Sentence::NortekBeam(back) = read(&one.write()) else { panic!() };
        prop_assert_eq!((back.beam, back.date_as_sent, back.time, back.status),
            (beam, date, time, status));
        prop_assert!(close(velocity, back.velocity, 5e-6) && close(distance, back.distance, 0.005));
        let over_ground = NortekGroundSpeed {
            trigger_to_echo: None, echo_to_output: Some(-0.01), speed: velocity, course,
            figure_of_merit, distance,
        };
        let Sentence::NortekGroundSpeed(back) = read(&over_ground.write()) else { panic!() };
        prop_assert!(close(velocity, back.speed, 5e-6));
        prop_assert!(same_angle(course, back.course, HUNDREDTH_DEG));
        prop_assert!(close(figure_of_merit, back.figure_of_merit, 5e-6));
    }

    #[test]
    fn no_value_whatever_makes_a_line_too_long_or_unreadable(
        a: f64, b: f64, c: f64, digit: u8, status: u32, nanos: i64,
    ) {
        let (x, y, z) = (Some(a), Some(b), Some(c));
        let time = TimeOfDay { hour: digit, minute: digit, second: digit, nanosecond: status };
        let velocity = VbwVelocity { longitudinal: x, transverse: y, valid: true };
        let stern = VbwStern { transverse: z, valid: true };
        let track = NortekBottomTrack {
            tagged: true, time: Some(UtcTime::from_nanos(nanos)), trigger_to_echo: x,
            echo_to_output: y, velocity: [x, y, z], figure_of_merit: x,
            distances: [x, y, z, x],
            sensors: Some(NortekSensors {
                voltage: x, sound_speed: y, pressure: z, temperature: x, status: Some(status),
            }),
        };
        let pashr = Pashr {
            time: Some(time), heading: x, roll: y.map(|y| y % 3.0), pitch: z.map(|z| z % 3.0),
            heave_as_sent: x, roll_std: y, pitch_std: z,
            heading_std: x, quality_digit: Some(digit), status_digit: Some(digit),
        };
        for line in [
            Vbw {
                water: velocity, ground: velocity, stern_water: stern, stern_ground: stern,
                without_stern: false,
            }
            .write(Talker::VD),
            Hdg { reading: x, deviation: y, variation: z }.write(Talker::HE),
            Vhw { heading: x, heading_magnetic: y, speed: z }.write(Talker::VD),
            Vlw { water: x, ..Vlw::default() }.write(Talker::VD),
            Vdr { set: x, set_magnetic: y, drift: z }.write(Talker::VD),
            Psxn::Motion { roll: x, pitch: y, heading: z, heave: x }.write(),
            track.write(),
            pashr.write(),
        ] {
            read(&line);
        }
    }
}
