//! Makers' own sentences: what is written is read back, over the whole range, and unknown stays unknown.

#![allow(clippy::unwrap_used, clippy::panic)] // helpers of tests are not seen as tests

mod common;

use common::{angle, close, perhaps, position, read, same_angle, time_of_day};
use insd_base::units::{DEG, KNOT};
use insd_base::utm::Utm;
use insd_wire::nmea::{
    Marked, PfecAttitude, Phcmp, Phinf, Phlin, Phoct, PhoctState, Phspd, Phtro, Pixse,
    PixseAlgorithmStatus, PixseHighLevelStatus, PixseSystemStatus, Position, Prdid, PrdidForm,
    Ptnthtm, Sentence, SurgeSwayHeave, TimeOfDay,
};
use proptest::prelude::*;
use std::f64::consts::{FRAC_PI_2, PI};

fn all_close(written: &[Option<f64>], read: &[Option<f64>], half_digit: f64) -> bool {
    written.len() == read.len()
        && written.iter().zip(read).all(|(written, read)| close(*written, *read, half_digit))
}

fn three(limit: f64) -> impl Strategy<Value = [Option<f64>; 3]> {
    prop::array::uniform3(perhaps(-limit..limit))
}

fn roll() -> impl Strategy<Value = Option<f64>> {
    perhaps(-PI..PI)
}

fn pitch() -> impl Strategy<Value = Option<f64>> {
    perhaps(-FRAC_PI_2..FRAC_PI_2)
}

fn state() -> impl Strategy<Value = PhoctState> {
    let states = vec![PhoctState::Valid, PhoctState::Invalid, PhoctState::Initialising];
    prop::sample::select(states)
}

/// What a state becomes on the way.
fn kept(value: Option<f64>, state: PhoctState) -> PhoctState {
    if value.is_none() && state == PhoctState::Valid { PhoctState::Invalid } else { state }
}

fn motion() -> impl Strategy<Value = SurgeSwayHeave> {
    three(99.999).prop_map(|[heave, surge, sway]| SurgeSwayHeave { heave, surge, sway })
}

fn parts(motion: &SurgeSwayHeave) -> [Option<f64>; 3] {
    [motion.heave, motion.surge, motion.sway]
}

fn pixse(pixse: Pixse) -> Pixse {
    let Sentence::Pixse(back) = read(&pixse.write()) else { panic!() };
    back
}

prop_compose! {
    fn phoct()(
        time in prop::option::of(time_of_day()), time_valid: bool,
        latency_ms in prop::option::of(0..=99_u8), heading in angle(), roll in roll(),
        pitch in pitch(), heave in perhaps(-99.999..99.999), states in prop::array::uniform4(state()),
        motion in motion(), rates in motion(), rate_of_turn in perhaps(-2.9..2.9),
    ) -> Phoct {
        let marked = |value, state| Marked { value, state };
        Phoct {
            time, time_valid, latency_ms, heading: marked(heading, states[0]),
            roll: marked(roll, states[1]), pitch: marked(pitch, states[2]),
            heave: marked(heave, states[3]), motion, rates, rate_of_turn,
        }
    }
}

proptest! {
    #[test]
    fn the_octans_set_comes_back(
        roll in roll(), pitch in pitch(), waves in three(999.999), word in prop::option::of(any::<u32>()),
        latitude in pitch(), speed in perhaps(0.0..514.0),
    ) {
        let Sentence::Phtro(back) = read(&Phtro { roll, pitch }.write()) else { panic!() };
        prop_assert!(all_close(&[roll, pitch], &[back.roll, back.pitch], 0.005 * DEG));
        let [surge, sway, heave] = waves;
        let Sentence::Phlin(back) = read(&Phlin { surge, sway, heave }.write()) else { panic!() };
        prop_assert!(all_close(&waves, &[back.surge, back.sway, back.heave], 0.000_5));
        let Sentence::Phspd(back) = read(&Phspd { surge, sway, heave }.write()) else { panic!() };
        prop_assert!(all_close(&waves, &[back.surge, back.sway, back.heave], 0.000_5));
        let Sentence::Phcmp(back) = read(&Phcmp { latitude, speed }.write()) else { panic!() };
        prop_assert!(close(latitude, back.latitude, 0.005 / 60.0 * DEG));
        prop_assert!(close(speed, back.speed, 0.005 * KNOT));
        prop_assert_eq!(read(&Phinf { word }.write()), Sentence::Phinf(Phinf { word }));
    }

    #[test]
    fn attitude_and_motion_with_time_come_back(phoct in phoct()) {
        let Sentence::Phoct(back) = read(&phoct.write()) else { panic!() };
        prop_assert_eq!((back.time, back.latency_ms), (phoct.time, phoct.latency_ms));
        prop_assert_eq!(back.time_valid, phoct.time_valid && phoct.time.is_some());
        prop_assert!(same_angle(phoct.heading.value, back.heading.value, 0.000_5 * DEG));
        prop_assert!(close(phoct.roll.value, back.roll.value, 0.000_5 * DEG));
        prop_assert!(close(phoct.pitch.value, back.pitch.value, 0.000_5 * DEG));
        prop_assert!(close(phoct.heave.value, back.heave.value, 0.000_5));
        let (written, read) = (
            [phoct.heading, phoct.roll, phoct.pitch, phoct.heave],
            [back.heading, back.roll, back.pitch, back.heave],
        );
        for (written, read) in written.iter().zip(read) {
            prop_assert_eq!(read.state, kept(written.value, written.state));
        }
        prop_assert!(all_close(&parts(&phoct.motion), &parts(&back.motion), 0.000_5));
        prop_assert!(all_close(&parts(&phoct.rates), &parts(&back.rates), 0.000_5));
        prop_assert!(close(phoct.rate_of_turn, back.rate_of_turn, 0.005 / 60.0 * DEG));
    }

    #[test]
    fn attitude_place_and_speed_of_a_phins_come_back(
        roll in roll(), pitch in pitch(), place in prop::option::of(position()),
        altitude in perhaps(-99_999.0..99_999.0), waves in three(999.999),
        time in prop::option::of(time_of_day()),
    ) {
        let Pixse::Attitude { roll: r, pitch: p } = pixse(Pixse::Attitude { roll, pitch }) else {
            panic!()
        };
        prop_assert!(all_close(&[roll, pitch], &[r, p], 0.000_5 * DEG));
        let Pixse::Position { position, altitude: a } =
            pixse(Pixse::Position { position: place, altitude }) else { panic!() };
        prop_assert!(close(altitude, a, 0.000_5));
        let latitude = |place: Option<Position>| place.map(|place| place.latitude);
        let longitude = |place: Option<Position>| place.map(|place| place.longitude);
        prop_assert!(close(latitude(place), latitude(position), 5e-9 * DEG));
        prop_assert!(same_angle(longitude(place), longitude(position), 5e-9 * DEG));
        let [x, y, z] = waves;
        let Pixse::Velocity { north, east, down } =
            pixse(Pixse::Velocity { north: x, east: y, down: z }) else { panic!() };
        prop_assert!(all_close(&waves, &[north, east, down], 0.000_5));
        let Pixse::Motion { surge, sway, heave } =
            pixse(Pixse::Motion { surge: x, sway: y, heave: z }) else { panic!() };
        prop_assert!(all_close(&waves, &[surge, sway, heave], 0.000_5));
        prop_assert_eq!(pixse(Pixse::Time(time)), Pixse::Time(time));
    }

    #[test]
    fn the_grid_of_a_place_comes_back(place in position(), altitude in perhaps(-9e4..9e4)) {
        let utm = Utm::of(place.latitude, place.longitude);
        let Pixse::Grid { utm: back, altitude: a } = pixse(Pixse::Grid { utm, altitude }) else {
            panic!()
        };
        prop_assert!(close(altitude, a, 0.000_5));
        prop_assert_eq!(utm.map(|utm| (utm.zone, utm.band)), back.map(|utm| (utm.zone, utm.band)));
        prop_assert!(close(utm.map(|utm| utm.easting), back.map(|utm| utm.easting), 0.000_5));
        prop_assert!(close(utm.map(|utm| utm.northing), back.map(|utm| utm.northing), 0.000_5));
    }

    #[test]
    fn sigmas_and_status_of_a_phins_come_back(
        sigmas in prop::array::uniform3(perhaps(0.0..999.999)),
        angles in prop::array::uniform3(perhaps(0.0..PI)),
        status in prop::option::of(any::<u64>()), short in prop::option::of(any::<u32>()),
    ) {
        let [x, y, z] = angles;
        let Pixse::AttitudeSigma { heading, roll, pitch } =
            pixse(Pixse::AttitudeSigma { heading: x, roll: y, pitch: z }) else { panic!() };
        prop_assert!(all_close(&angles, &[heading, roll, pitch], 0.000_5 * DEG));
        let [x, y, z] = sigmas;
        let Pixse::PositionSigma { north, east, altitude } =
            pixse(Pixse::PositionSigma { north: x, east: y, altitude: z }) else { panic!() };
        prop_assert!(all_close(&sigmas, &[north, east, altitude], 0.005));
        let Pixse::VelocitySigma { north, east, down } =
            pixse(Pixse::VelocitySigma { north: x, east: y, down: z }) else { panic!() };
        prop_assert!(all_close(&sigmas, &[north, east, down], 0.000_5));
        for status in [
            Pixse::Algorithm(status.map(PixseAlgorithmStatus)),
            Pixse::System(status.map(PixseSystemStatus)),
            Pixse::HighLevel(short.map(PixseHighLevelStatus)),
        ] {
            prop_assert_eq!(pixse(status), status);
        }
    }

    #[test]
    fn attitude_for_profilers_and_sonars_comes_back(
        roll in roll(), pitch in pitch(), heading in angle(), plain: bool,
    ) {
        let form = if plain { PrdidForm::Plain } else { PrdidForm::Fixed };
        let prdid = Prdid { roll, pitch, heading };
        let Sentence::Prdid(back) = read(&prdid.write_as(form)) else { panic!() };
        prop_assert!(all_close(&[roll, pitch], &[back.roll, back.pitch], 0.005 * DEG));
        prop_assert!(same_angle(heading, back.heading, 0.005 * DEG));
        let ptnthtm = Ptnthtm { roll, pitch, heading, is_warned: plain && heading.is_some() };
        let Sentence::Ptnthtm(back) = read(&ptnthtm.write()) else { panic!() };
        prop_assert!(all_close(&[roll, pitch], &[back.roll, back.pitch], 0.005 * DEG));
        prop_assert!(same_angle(heading, back.heading, 0.005 * DEG));
        prop_assert_eq!(back.is_warned, ptnthtm.is_warned);
        let pfec = PfecAttitude { roll, pitch, heading };
        let Sentence::PfecAttitude(back) = read(&pfec.write()) else { panic!() };
        let upright = roll.filter(|roll| roll.abs() <= FRAC_PI_2);
        prop_assert!(all_close(&[upright, pitch], &[back.roll, back.pitch], 0.05 * DEG));
        prop_assert!(same_angle(heading, back.heading, 0.05 * DEG));
    }

    #[test]
    fn no_value_whatever_makes_a_line_too_long_or_unreadable(
        a: f64, b: f64, c: f64, small: u8, word: u32,
    ) {
        let (x, y, z) = (Some(a), Some(b), Some(c));
        let time = Some(TimeOfDay { hour: small, minute: small, second: small, nanosecond: word });
        let marked = |value| Marked { value, state: PhoctState::Valid };
        let motion = SurgeSwayHeave { heave: x, surge: y, sway: z };
        let phoct = Phoct {
            time, time_valid: true, latency_ms: Some(small), heading: marked(x), roll: marked(y),
            pitch: marked(z), heave: marked(x), motion, rates: motion, rate_of_turn: y,
        };
        let place = Some(Position { latitude: a, longitude: b });
        let utm = Utm::of(a, b).or(Some(Utm { zone: small, band: small, easting: a, northing: b }));
        for line in [
            Phtro { roll: x, pitch: y }.write(),
            Phlin { surge: x, sway: y, heave: z }.write(),
            Phcmp { latitude: x, speed: y }.write(),
            phoct.write(),
            Prdid { roll: x, pitch: y, heading: z }.write(),
            PfecAttitude { roll: x, pitch: y, heading: z }.write(),
            Ptnthtm { roll: x, pitch: y, heading: z, is_warned: true }.write(),
            Pixse::Attitude { roll: x, pitch: y }.write(),
            Pixse::Position { position: place, altitude: z }.write(),
            Pixse::Grid { utm, altitude: z }.write(),
            Pixse::Velocity { north: x, east: y, down: z }.write(),
            Pixse::Time(time).write(),
            Pixse::AttitudeSigma { heading: x, roll: y, pitch: z }.write(),
            Pixse::PositionSigma { north: x, east: y, altitude: z }.write(),
        ] {
            read(&line);
        }
        prop_assert!(phoct.write().as_bytes().len() <= Phoct::LONGEST);
    }
}
