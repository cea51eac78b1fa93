//! How long approved sentences can be with the values that a ship has: `Sentence::LONGEST`, by which
//! the daemon plans what goes through a line.

#![allow(clippy::unwrap_used, clippy::panic)] // helpers of tests are not seen as tests

mod common;

use common::{angle, date, perhaps, position, time_of_day};
use insd_base::FixQuality;
use insd_base::units::KNOT;
use insd_wire::nmea::{
    Acn, Alc, AlertCommand, AlertEntry, AlertId, AlertState, Alf, Arc, CivilTime, Date, Datum, Dtm,
    Frame, Gbs, Gga, Glc, Gll, Gns, Gsa, Gst, Gsv, Hbt, Hcr, Hdg, Hdm, Hdt, HeadingCorrections,
    HeadingMode, Lcd, LoranSignal, MAX_LEN, MAX_USED, Manufacturer, Pashr, PashrDialect, Position,
    PositionMode, Psxn, Rmc, Rot, SatelliteInView, Sentence, Talker, Text, Ths, TimeOfDay, Txt,
    Vbw, VbwStern, VbwVelocity, Vdr, Vhw, Vlw, Vtg, Xdr, XdrMeasurement, Zda, Zone,
};
use proptest::prelude::*;

/// The longest of all, of a formatter.
fn longest(formatter: &str) -> usize {
    let mut table = Sentence::LONGEST.iter();
    table.find(|(name, _)| *name == formatter).map(|(_, longest)| *longest).unwrap()
}

/// The formatter of a sentence, and how many bytes it has.
fn measured(sentence: &Sentence) -> (String, usize) {
    let line = sentence.write(Talker::IN);
    let formatter = Frame::parse(line.as_bytes()).unwrap().approved().unwrap().1.to_owned();
    (formatter, line.as_bytes().len())
}

/// Something from each range of numbers that a ship has.
#[derive(Clone, Debug)]
struct Ship {
    time: Option<TimeOfDay>,
    date: Date,
    position: Option<Position>,
    /// rad.
    angles: [Option<f64>; 2],
    /// m/s, below 99.9 kn.
    speeds: [Option<f64>; 6],
    /// m, below 1000 m.
    height: Option<f64>,
    /// m, as on Earth.
    geoid: Option<f64>,
    /// Below 100.
    dops: [Option<f64>; 3],
    /// s, below 1000 s.
    age: Option<f64>,
    /// m, below 1000 m.
    sigmas: [Option<f64>; 6],
    /// m, below a million miles.
    distances: [Option<f64>; 4],
    /// Below 1000.
    number: Option<u16>,
    /// rad/s, below 100 deg/s.
    rate: Option<f64>,
    /// rad, up to half a turn.
    correction: Option<f64>,
}

prop_compose! {
    fn ship()(
        time in prop::option::of(time_of_day()), date in date(),
        position in prop::option::of(position()), angles in [angle(), angle()],
        speeds in prop::array::uniform6(perhaps(-99.9 * KNOT..99.9 * KNOT)),
        height in perhaps(-999.99..999.99), geoid in perhaps(-107.0..86.0),
        dops in prop::array::uniform3(perhaps(0.0..99.9)), age in perhaps(0.0..999.9),
        sigmas in prop::array::uniform6(perhaps(0.0..999.99)),
        distances in prop::array::uniform4(perhaps(0.0..999_999.0 * 1852.0)),
        number in prop::option::of(0..=999_u16), rate in perhaps(-1.7..1.7),
        correction in perhaps(-3.1..3.1),
    ) -> Ship {
        Ship {
            time, date, position, angles, speeds, height, geoid, dops, age, sigmas, distances, number,
            rate, correction,
        }
    }
}

/// The values that take most digits.
fn worst() -> Ship {
    let nanosecond = 990_000_000;
    Ship {
        time: Some(TimeOfDay { hour: 23, minute: 59, second: 59, nanosecond }),
        date: Date { year: 2026, month: 12, day: 31 },
        position: Some(Position { latitude: -1.0, longitude: -3.0 }),
        angles: [Some(359.44_f64.to_radians()); 2],
        speeds: [Some(-99.89 * KNOT); 6],
        height: Some(-999.99),
        geoid: Some(-106.99),
        dops: [Some(99.9); 3],
        age: Some(999.9),
        sigmas: [Some(999.99); 6],
        distances: [Some(999_999.0 * 1852.0); 4],
        number: Some(999),
        rate: Some(-99.9_f64.to_radians()),
        correction: Some(-179.9_f64.to_radians()),
    }
}

/// Every approved sentence with these values.
fn sentences(ship: &Ship) -> Vec<Sentence> {
    let mut all = fixes(ship);
    all.extend(loran(ship));
    all.extend(receivers(ship));
    all.extend(motion(ship));
    all.extend(texts(ship));
    all
}

fn loran(ship: &Ship) -> Vec<Sentence> {
    let age = ship.age;
    let (loran, signal) = (age.map(|_| 0.099_999_8), Some(LoranSignal::Weak));
    let interval = age.map(|_| 0.0999);
    let relative = age.map(|_| 999.0);
    vec![
        Sentence::Glc(Glc {
            interval,
            master: loran,
            master_signal: signal,
            first: loran,
            first_signal: signal,
            second: loran,
            second_signal: signal,
            third: loran,
            third_signal: signal,
            fourth: loran,
            fourth_signal: signal,
            fifth: loran,
            fifth_signal: signal,
        }),
        Sentence::Lcd(Lcd {
            interval,
            master_snr: relative,
            master_ecd: relative,
            first_snr: relative,
            first_ecd: relative,
            second_snr: relative,
            second_ecd: relative,
            third_snr: relative,
            third_ecd: relative,
            fourth_snr: relative,
            fourth_ecd: relative,
            fifth_snr: relative,
            fifth_ecd: relative,
        }),
    ]
}

fn fixes(ship: &Ship) -> Vec<Sentence> {
    let Ship { time, position, height, geoid, age, .. } = *ship;
    let speed = ship.speeds[0].map(f64::abs);
    let mode = Some(PositionMode::Estimated);
    let mut gns = Gns {
        time,
        position,
        satellites: Some(99),
        hdop: ship.dops[0],
        altitude: height,
        geoid_separation: geoid,
        age,
        station: Some(4095),
        ..Gns::default()
    };
    gns.modes[..6].copy_from_slice(&[mode; 6]);
    vec![
        Sentence::Gga(Gga {
            time,
            position,
            quality: FixQuality::Estimated,
            satellites: Some(99),
            hdop: ship.dops[0],
            altitude: height,
            geoid_separation: geoid,
            age,
            station: Some(4095),
        }),
        Sentence::Gns(gns),
        Sentence::Gll(Gll { position, time, valid: true, mode }),
        Sentence::Rmc(Rmc {
            time,
            valid: true,
            position,
            speed,
            course: ship.angles[0],
            date: Some(ship.date),
            variation: ship.correction,
            mode,
            nav_status: None,
        }),
        Sentence::Vtg(Vtg { course: ship.angles[0], course_magnetic: ship.angles[1], speed, mode }),
        Sentence::Zda(Zda {
            utc: time.map(|time| CivilTime { date: ship.date, time }),
            zone: Some(Zone { hours: -13, minutes: -59 }),
        }),
        Sentence::Dtm(Dtm {
            datum: Datum::new("P90"),
            subdivision: Some(b'A'),
            latitude_offset: ship.correction.map(|angle| angle / 180.0),
            longitude_offset: ship.correction.map(|angle| angle / 180.0),
            altitude_offset: height,
            reference: Datum::new("W84"),
        }),
    ]
}

fn receivers(ship: &Ship) -> Vec<Sentence> {
    let [range_rms, major_std, minor_std, latitude_std, longitude_std, altitude_std] = ship.sigmas;
    let [pdop, hdop, vdop] = ship.dops;
    let satellite = SatelliteInView {
        id: ship.number,
        elevation: Some(1.5),
        azimuth: ship.angles[0],
        noise_density: ship.dops[0].map(|noise| (noise - 1.0).max(0.0)),
    };
    vec![
        Sentence::Gbs(Gbs {
            time: ship.time,
            latitude_error: ship.height,
            longitude_error: ship.height,
            altitude_error: ship.height,
            satellite: ship.number,
            missed_detection: Some(1.0),
            bias: ship.height,
            bias_std: range_rms,
            system: Some(15),
            signal: Some(15),
        }),
        Sentence::Gsa(Gsa {
            satellites: [ship.number; MAX_USED],
            pdop,
            hdop,
            vdop,
            system: Some(1),
            ..Gsa::default()
        }),
        Sentence::Gst(Gst {
            time: ship.time,
            range_rms,
            major_std,
            minor_std,
            orientation: ship.angles[0],
            latitude_std,
            longitude_std,
            altitude_std,
        }),
        Sentence::Gsv(Gsv {
            sentences: 9,
            number: 9,
            in_view: Some(36),
            satellites: [Some(satellite); 4],
            signal: Some(15),
        }),
    ]
}

fn motion(ship: &Ship) -> Vec<Sentence> {
    let [heading, heading_magnetic] = ship.angles;
    let [a, b, c, d, e, f] = ship.speeds;
    let velocity = |longitudinal, transverse| VbwVelocity { longitudinal, transverse, valid: true };
    let stern = |transverse| VbwStern { transverse, valid: true };
    let [water, water_trip, ground, ground_trip] = ship.distances;
    vec![
        Sentence::Hdt(Hdt { heading }),
        Sentence::Hdm(Hdm { heading }),
        Sentence::Ths(Ths { heading, mode: HeadingMode::Autonomous }),
        Sentence::Hdg(Hdg {
            reading: heading,
            deviation: ship.correction,
            variation: ship.correction,
        }),
        Sentence::Hcr(Hcr {
            heading,
            mode: HeadingMode::Autonomous,
            corrections: HeadingCorrections::Both,
            correction: ship.correction.map(|angle| angle / 2.0),
        }),
        Sentence::Rot(Rot { rate: ship.rate, valid: true }),
        Sentence::Vbw(Vbw {
            water: velocity(a, b),
            ground: velocity(c, d),
            stern_water: stern(e),
            stern_ground: stern(f),
            without_stern: false,
        }),
        Sentence::Vdr(Vdr { set: heading, set_magnetic: heading_magnetic, drift: a.map(f64::abs) }),
        Sentence::Vhw(Vhw { heading, heading_magnetic, speed: a }),
        Sentence::Vlw(Vlw { water, water_trip, ground, ground_trip }),
    ]
}

fn texts(ship: &Ship) -> Vec<Sentence> {
    let instance = ship.number.map(|number| u32::from(number) * 1001);
    let alert = AlertId { manufacturer: Manufacturer::new("XYZ"), identifier: 9_999_999, instance };
    let entry = Some(AlertEntry { alert, revision: Some(99) });
    let command = AlertCommand::Acknowledge;
    let angle = |name| XdrMeasurement::of_angle(Text::new(name).unwrap(), ship.correction, 2);
    let heave = XdrMeasurement::of_displacement(Text::new("HEAVE").unwrap(), ship.height, 2);
    let text = Text::new(&"x".repeat(64)).unwrap();
    let mut xdr = Xdr::default();
    xdr.measurements[..3].copy_from_slice(&[
        Some(angle("PITCH")),
        Some(angle("ROLL")),
        Some(heave),
    ]);
    let mut alc = Alc { sentences: 1, number: 1, ..Alc::default() };
    alc.entries[..2].copy_from_slice(&[entry; 2]);
    vec![
        Sentence::Acn(Acn { time: ship.time, alert, command }),
        Sentence::Arc(Arc { time: ship.time, alert, command }),
        Sentence::Alc(alc),
        Sentence::Alf(Alf {
            sentences: 1,
            number: 1,
            message: 9,
            time: ship.time,
            category: None,
            priority: None,
            state: Some(AlertState::Normal),
            alert,
            revision: Some(99),
            escalation: Some(9),
            text,
        }),
        Sentence::Hbt(Hbt {
            interval: ship.age.map(|age| age - 1.0),
            normal: true,
            sequence: Some(9),
        }),
        Sentence::Txt(Txt { sentences: 1, number: 1, kind: Some(9), text }),
        Sentence::Xdr(xdr),
    ]
}

#[test]
fn the_longest_sentence_of_a_ship_is_as_long_as_the_table_says() {
    let mut seen = Vec::new();
    for sentence in sentences(&worst()) {
        let (formatter, bytes) = measured(&sentence);
        let longest = longest(&formatter);
        println!("{formatter} {bytes} of {longest}: {}", sentence.write(Talker::IN).as_str());
        // where the limit of 82 bytes cuts, the longest form is not that of the longest values
        assert!(bytes == longest || bytes < longest && longest == MAX_LEN, "{formatter}");
        seen.push(formatter);
    }
    seen.sort();
    let all: Vec<_> = Sentence::LONGEST.iter().map(|(name, _)| (*name).to_owned()).collect();
    assert_eq!(seen, all);
}

#[test]
fn the_longest_sentences_of_makers_are_as_long_as_they_say() {
    let angle = |degrees: f64| Some(degrees.to_radians());
    let motion = Psxn::Motion {
        roll: angle(-179.99),
        pitch: angle(-89.99),
        heading: angle(359.44),
        heave: Some(-99.99),
    };
    assert_eq!(motion.write().as_bytes().len(), Psxn::LONGEST);
    let rate = angle(-99.99);
    let rates = Psxn::Rates {
        roll_rate: rate,
        pitch_rate: rate,
        yaw_rate: rate,
        down_velocity: Some(-99.99),
    };
    assert!(rates.write().as_bytes().len() <= Psxn::LONGEST);
    let std = angle(179.99);
    let pashr = Pashr {
        time: worst().time,
        heading: angle(359.44),
        roll: angle(-179.99),
        pitch: angle(-89.99),
        heave_as_sent: Some(-99.99),
        roll_std: std,
        pitch_std: std,
        heading_std: std,
        quality_digit: Some(2),
        status_digit: Some(1),
    };
    assert_eq!(pashr.write().as_bytes().len(), Pashr::LONGEST);
    for dialect in [PashrDialect::Sbg, PashrDialect::SbgWassp, PashrDialect::Novatel] {
        assert!(pashr.write_as(dialect).as_bytes().len() <= Pashr::LONGEST, "{dialect:?}");
    }
}

proptest! {
    #[test]
    fn no_sentence_of_a_ship_is_longer_than_the_table_says(ship in ship()) {
        for sentence in sentences(&ship) {
            let (formatter, bytes) = measured(&sentence);
            prop_assert!(bytes <= longest(&formatter), "{}", sentence.write(Talker::IN).as_str());
        }
    }
}
