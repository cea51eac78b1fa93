//! What is read of small files of navigation messages, good and bad, and what comes back of what is written.

use insd_base::satellites::{
    ClockPolynomial, GlonassRecord, KeplerOrbit, KeplerRecord, MessageKind,
};
use insd_base::{BroadcastRecord, Constellation, GpsTime, IonosphereModel, SatelliteId};
use proptest::prelude::*;

use super::{NavigationMessages, read_navigation, write_navigation};
use crate::calendar::SECOND;

const WEEK: i64 = 7 * 86_400 * SECOND;

fn header(version: &str, lines: &str) -> String {
    let first = format!("{version:>9}           N: GNSS NAV DATA    M: MIXED");
    format!("{first:<60}RINEX VERSION / TYPE\n{lines}{:60}END OF HEADER\n", "")
}

fn headed(contents: &str, label: &str) -> String {
    format!("{contents:<60}{label}\n")
}

/// A record whose orbit is fields 3 to 28 in lines of four.
fn record(first: &str, fields: [f64; 29]) -> String {
    let numbers = fields.map(|field| {
        let text = format!("{field:.12e}");
        let (mantissa, exponent) = text.split_once('e').unwrap();
        format!("{:>19}", format!("{mantissa}D{:+03}", exponent.parse::<i32>().unwrap()))
    });
    let mut text = format!("{first}{}\n", numbers[..3].concat());
    for line in numbers[3..].chunks(4) {
        text += &format!("    {}\n", line.concat());
    }
    text
}

/// An orbit with what differs among constellations: fields 20, 21 and from 23 on.
fn orbit(toe: f64, sources: f64, week: f64, last: [f64; 6]) -> [f64; 29] {
    let mut fields = [1e-9; 29];
    fields[3] = 61.0;
    fields[8] = 0.01;
    fields[10] = 5153.7;
    fields[11] = toe;
    (fields[20], fields[21]) = (sources, week);
    fields[23..29].copy_from_slice(&last);
    fields
}

fn read(text: &str) -> NavigationMessages {
    read_navigation(text).unwrap()
}

fn kepler(navigation: &NavigationMessages, index: usize) -> KeplerRecord {
    match navigation.records[index] {
        BroadcastRecord::Kepler(record) => record,
        BroadcastRecord::Glonass(_) => panic!("no Kepler record"),
    }
}

#[test]
fn each_constellation_has_its_own_week_accuracy_and_issue() {
    let text = header("3.04", "")
        + &record(
            "G01 2020 06 25 04 00 00",
            orbit(360_000.0, 0.0, 2111.0, [2.0, 63.0, 5e-9, 805.0, 352_800.0, 4.0]),
        )
        + &record(
            "E01 2020 06 25 04 00 00",
            orbit(360_000.0, 517.0, 2111.0, [3.12, 0.0, -1e-9, -2e-9, 360_665.0, 0.0]),
        )
        + &record(
            "E01 2020 06 25 04 00 00",
            orbit(360_000.0, 258.0, 2111.0, [-1.0, 455.0, -1e-9, 0.0, 0.9999e9, 0.0]),
        )
        + &record(
            "C05 2020 06 25 04 00 00",
            orbit(360_000.0, 0.0, 755.0, [2.0, 0.0, 1e-10, -9e-9, 360_027.6, 3.0]),
        )
        + &record(
            "C30 2020 06 25 04 00 00",
            orbit(360_000.0, 0.0, 755.0, [8192.0, 1.0, 1e-10, -9e-9, 360_027.6, 3.0]),
        )
        + &record(
            "J02 2020 06 25 04 00 00",
            orbit(360_000.0, 2.0, 2111.0, [2.8, 0.0, 5e-9, 805.0, 359_990.0, 0.0]),
        );
    let navigation = read(&text);
    assert_eq!(navigation.flaws.total, 0, "{:?}", navigation.flaws);
    let toe = GpsTime::from_week(2111, 360_000 * SECOND);
    let all: Vec<KeplerRecord> = (0..6).map(|index| kepler(&navigation, index)).collect();
    let kinds: Vec<_> = all.iter().map(|own| own.kind).collect();
    use MessageKind as M;
    assert_eq!(kinds, [M::Lnav, M::Inav, M::Fnav, M::D2, M::D1, M::Lnav]);
    let ahead: Vec<_> =
        all.iter().map(|own| own.orbit.reference.since(toe).as_nanos() / SECOND).collect();
    assert_eq!(ahead, [0, 0, 0, 14, 14, 0]);
    assert!(all.iter().all(|own| own.clock.reference == own.orbit.reference));
    let accuracies: Vec<_> = all.iter().map(|own| own.accuracy).collect();
    assert_eq!(accuracies, [Some(2.0), Some(3.12), None, Some(2.0), None, Some(2.8)]);
    let issues: Vec<_> = all.iter().map(|own| (own.issue, own.clock_issue)).collect();
    assert_eq!(issues, [(61, 805), (61, 61), (61, 61), (61, 3), (61, 3), (61, 805)]);
    let healths: Vec<_> = all.iter().map(|own| own.health).collect();
    assert_eq!(healths, [63, 0, 455, 0, 1, 0]);
    assert_eq!(all[1].group_delays, [-1e-9, -2e-9]);
    assert_eq!(all[3].transmitted, Some(GpsTime::from_week(2111, 360_041_600 * SECOND / 1000)));
    assert_eq!(all[2].transmitted, None);
    assert_eq!(all[5].transmitted, Some(GpsTime::from_week(2111, 359_990 * SECOND)));
    assert_eq!(read(&write_navigation(&navigation.records, &[], None)).records, navigation.records);
}

#[test]
fn the_week_is_that_of_the_clock_whatever_the_field_means() {
    for (week, sent) in [(2110.0, 604_700.0), (2111.0, -100.0), (1087.0, -100.0)] {
        let fields = orbit(0.0, 517.0, week, [3.12, 0.0, 0.0, 0.0, sent, 0.0]);
        let text = header("3.04", "") + &record("E01 2020 06 20 23 59 00", fields);
        let own = kepler(&read(&text), 0);
        assert_eq!(own.orbit.reference, GpsTime::from_week(2111, 0));
        assert_eq!(own.transmitted, Some(GpsTime::from_week(2110, 604_700 * SECOND)));
    }
}

const GLONASS: &str = " 1.000000000000e-05 0.000000000000e+00 3.420000000000e+05
     1.090894238281e+04 1.407806396484e+00-1.862645149231e-09 0.000000000000e+00
    -2.885726074219e+03 2.795855522156e+00-0.000000000000e+00-7.000000000000e+00
     2.288353955078e+04-3.169984817505e-01-2.793967723846e-09 1.000000000000e+00
";

#[test]
fn glonass_is_in_metres_and_gps_time_with_four_lines_or_five() {
    let fifth =
        "                         .999999999999e+09 1.500000000000e+01                   \n";
    let first = "R01 2020 06 24 23 15 00";
    let text = header("3.05", &headed("    18", "LEAP SECONDS"))
        + first
        + GLONASS
        + fifth
        + first
        + GLONASS;
    let navigation = read(&text);
    assert_eq!((navigation.records.len(), navigation.flaws.total), (2, 0));
    let BroadcastRecord::Glonass(own) = navigation.records[1] else { panic!("no GLONASS") };
    assert_eq!(own.position, [10_908_942.382_81, -2_885_726.074_219, 22_883_539.550_78]);
    assert_eq!(own.acceleration[2], -2.793_967_723_846e-6);
    assert_eq!((own.channel, own.health, own.age_days), (-7, 0, 1.0));
    let midnight = GpsTime::from_week(2111, 4 * 86_400 * SECOND);
    assert_eq!(own.reference.since(midnight).as_nanos() / SECOND, -2700 + 18);
}

#[test]
fn version_two_tells_gps_or_glonass_with_years_of_two_digits() {
    let record = |name: &str, numbers: &str| {
        let text = format!("{name} 20  6 24 23 15  0.0{numbers}");
        text.replace("\n    ", "\n   ").replace('e', "D")
    };
    let first = |kind: &str| headed(&format!("     2.11           {kind}"), "RINEX VERSION / TYPE");
    let head = headed("    1.1180D-08  1.4900D-08 -5.9600D-08 -5.9600D-08", "ION ALPHA")
        + &headed("    8.8060D+04  1.6380D+04 -1.9660D+05 -1.3110D+05", "ION BETA")
        + &headed("", "END OF HEADER");
    let navigation = read(&(first("G: GLONASS NAV DATA") + &head + &record(" 1", GLONASS)));
    assert_eq!(navigation.records[0].satellite().to_string(), "R01");
    let alpha = [1.118e-8, 1.49e-8, -5.96e-8, -5.96e-8];
    let beta = [88_060.0, 16_380.0, -196_600.0, -131_100.0];
    let model = IonosphereModel::Klobuchar { alpha, beta };
    assert_eq!(navigation.ionosphere, [(Constellation::Gps, model)]);
}

#[test]
fn version_four_marks_its_records_and_what_has_no_word_is_counted() {
    let fields = orbit(360_000.0, 0.0, 2111.0, [2.0, 0.0, 5e-9, 61.0, 352_800.0, 4.0]);
    let eph = record("G01 2020 06 25 04 00 00", fields);
    let ion = |date: &str, numbers: &[&str]| {
        let mut text = format!("    {date}");
        for (index, number) in numbers.iter().enumerate() {
            let line = if index == 3 || index == 7 { "\n    " } else { "" };
            text += &format!("{line}{number:>19}");
        }
        text + "\n"
    };
    let date = "2020 06 25 04 00 00";
    let eight = ["1.0e-8", "2.0e-8", "3.0e-8", "4.0e-8", "5.0e+4", "6.0e+4", "7.0e+4", "8.0e+4"];
    let text = header("4.00", "")
        + "> EPH G01 LNAV\n"
        + &eph
        + "> EPH G01 CNAV\n"
        + &eph
        + "> STO G01 LNAV\n    2020 06 25 04 00 00 GPUT\n    1.0 2.0\n"
        + "> EOP J01 CNAV\n    2020 06 25 04 00 00\n"
        + "> ION G01 LNAV\n"
        + &ion(date, &eight)
        + "> ION E12 IFNV\n"
        + &ion(date, &["4.1e+1", "5.0e-2", "1.3e-2"])
        + "> ION C19 CNVX\n"
        + &ion(date, &eight)
        + "> XYZ G01 LNAV\n";
    let navigation = read(&text);
    assert_eq!(navigation.records.len(), 1);
    assert_eq!(navigation.skipped, 4);
    assert_eq!(navigation.flaws.total, 1);
    let alpha = [1e-8, 2e-8, 3e-8, 4e-8];
    let model = IonosphereModel::Klobuchar { alpha, beta: [5e4, 6e4, 7e4, 8e4] };
    let galileo = IonosphereModel::NeQuickG { ionisation: [41.0, 0.05, 0.013] };
    let models = [(Constellation::Gps, model), (Constellation::Galileo, galileo)];
    assert_eq!(navigation.ionosphere, models);
}

#[test]
fn a_bad_record_is_left_out_and_its_neighbours_count() {
    let fields = orbit(360_000.0, 0.0, 2111.0, [2.0, 0.0, 5e-9, 61.0, 352_800.0, 4.0]);
    let good = record("G01 2020 06 25 04 00 00", fields);
    let broken = good.replacen("1.000000000000D-02", "1.0000x0000000D-02", 1);
    let round = good.replacen("1.000000000000D-02", "1.000000000000D+00", 1);
    let short: String = good.lines().take(4).map(|line| format!("{line}\n")).collect();
    let dated = good.replace("06 25", "13 25");
    let text =
        header("3.04", "") + &good + &broken + &round + &short + &dated + "rubbish\n" + &good;
    let navigation = read(&text);
    assert_eq!(navigation.records.len(), 2);
    let told: Vec<String> = navigation.flaws.first.iter().map(ToString::to_string).collect();
    let start = [
        "line 13: e: ",
        "line 21: e: ",
        "line 33: group delay: ",
        "line 31: epoch of clock: ",
        "line 39: satellite: ",
    ];
    assert_eq!(told.len(), start.len(), "{told:#?}");
    for (told, start) in told.iter().zip(start) {
        assert!(told.starts_with(start), "{told} is not {start}");
    }
}

#[test]
fn a_file_of_something_else_is_refused() {
    let why = |text: &str| read_navigation(text).unwrap_err().to_string();
    assert!(
        why(&header("3.04", "").replace("N: GNSS", "O: GNSS"))
            .contains("a file of navigation messages")
    );
    assert!(why("x").contains("this label"));
    assert!(why(&header("3.04", "").replace("END OF", "")).contains("END OF HEADER"));
}

/// Numbers of at most thirteen digits.
fn number() -> impl Strategy<Value = f64> {
    (-9_999_999_999_999_i64..=9_999_999_999_999, -40_i32..0)
        .prop_map(|(digits, exponent)| format!("{digits}e{exponent}").parse().unwrap())
}

fn satellite() -> impl Strategy<Value = SatelliteId> {
    use Constellation as C;
    let own = prop::sample::select(vec![C::Gps, C::Galileo, C::BeiDou, C::Qzss, C::Navic]);
    (own, 1_u8..=63).prop_map(|(own, number)| SatelliteId::new(own, number).unwrap())
}

prop_compose! {
    fn kepler_record()(
        satellite in satellite(),
        issues: [u8; 2], health in 0_u16..512, fnav: bool,
        accuracy in prop::option::of(0_u16..8000),
        week in 1500_i64..2600, seconds in 0..604_800_i64, apart in -7200..7200_i64,
        sent in prop::option::of(-864_000..864_000_i64),
        n in prop::collection::vec(number(), 18),
        eccentricity in 0..9_999_999_i32, sqrt_a in 1_i32..99_999,
    ) -> KeplerRecord {
        use Constellation as C;
        let reference = GpsTime::from_nanos(week * WEEK + seconds * SECOND);
        let at = |seconds: i64| GpsTime::from_nanos(reference.as_nanos() + seconds * SECOND);
        let (kind, clock_issue, second) = match satellite.constellation {
            C::Galileo if fnav => (MessageKind::Fnav, issues[0], n[17]),
            C::Galileo => (MessageKind::Inav, issues[0], n[17]),
            C::BeiDou if satellite.is_geostationary() => (MessageKind::D2, issues[1], n[17]),
            C::BeiDou => (MessageKind::D1, issues[1], n[17]),
            C::Navic => (MessageKind::Lnav, issues[0], 0.0),
            _ => (MessageKind::Lnav, issues[1], 0.0),
        };
        KeplerRecord {
            satellite, kind, issue: issues[0].into(), clock_issue: clock_issue.into(), health,
            accuracy: accuracy.map(|accuracy| f64::from(accuracy) / 8.0),
            group_delays: [n[16], second],
            orbit: KeplerOrbit {
                reference, sqrt_a: f64::from(sqrt_a) / 8.0,
                eccentricity: f64::from(eccentricity) / 1e7,
                m0: n[0], delta_n: n[1], omega: n[2], omega0: n[3], omega_dot: n[4], i0: n[5],
                i_dot: n[6], cuc: n[7], cus: n[8], crc: n[9], crs: n[10], cic: n[11], cis: n[12],
            },
            clock: ClockPolynomial { reference: at(apart), a0: n[13], a1: n[14], a2: n[15] },
            transmitted: sent.map(|tenths| GpsTime::from_nanos(at(0).as_nanos() + tenths * SECOND / 10)),
        }
    }
}

prop_compose! {
    fn glonass_record()(
        number in 1_u8..=27, channel in -7_i8..=6, health in 0_u8..8, n in prop::array::uniform12(number()),
        week in 1500_i64..2600, seconds in 0..604_800_i64,
    ) -> GlonassRecord {
        GlonassRecord {
            satellite: SatelliteId::new(Constellation::Glonass, number).unwrap(),
            channel, health, reference: GpsTime::from_nanos(week * WEEK + seconds * SECOND),
            position: [n[0], n[1], n[2]], velocity: [n[3], n[4], n[5]],
            acceleration: [n[6], n[7], n[8]], clock_offset: n[9], clock_drift: n[10], age_days: n[11],
        }
    }
}

proptest! {
    #[test]
    fn records_of_thirteen_digits_come_back_to_the_bit(
        keplers in prop::collection::vec(kepler_record(), 0..8),
        glonass in prop::collection::vec(glonass_record(), 0..4),
        leaps in 0_i8..30,
    ) {
        let mut records: Vec<_> = keplers.into_iter().map(BroadcastRecord::Kepler).collect();
        records.extend(glonass.into_iter().map(BroadcastRecord::Glonass));
        let text = write_navigation(&records, &[], Some(leaps));
        let read = read(&text);
        prop_assert_eq!(read.flaws.total, 0, "{:?}", read.flaws);
        prop_assert_eq!(&read.records, &records);
        prop_assert_eq!(read.leap_seconds, Some(leaps));
        prop_assert_eq!(write_navigation(&read.records, &[], Some(leaps)), text);
    }

    #[test]
    fn models_of_five_digits_come_back_to_the_bit(n in prop::array::uniform8(-99_999_i32..99_999)) {
        let n = n.map(|n| format!("{n}e-9").parse::<f64>().unwrap());
        prop_assume!(n[..3].iter().any(|n| *n != 0.0));
        let [a0, a1, a2, a3, b0, b1, b2, b3] = n;
        let klobuchar = IonosphereModel::Klobuchar { alpha: [a0, a1, a2, a3], beta: [b0, b1, b2, b3] };
        let models = [
            (Constellation::Gps, klobuchar),
            (Constellation::BeiDou, klobuchar),
            (Constellation::Qzss, klobuchar),
            (Constellation::Navic, klobuchar),
            (Constellation::Galileo, IonosphereModel::NeQuickG { ionisation: [a0, a1, a2] }),
        ];
        let read = read(&write_navigation(&[], &models, None));
        prop_assert_eq!(&read.ionosphere[..], &models[..]);
    }
}
