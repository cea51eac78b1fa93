//! What is read of small files of observations, good and bad.

use insd_base::{
    Constellation, GpsTime, SatelliteEpoch, SatelliteId, SignalCode, SignalObservation,
};

use super::{ObservationHeader, ObservationReader, write_moving};

/// A line of a header.
fn headed(contents: &str, label: &str) -> String {
    format!("{contents:<60}{label}\n")
}

fn modern(version: &str, types: &[&str], body: &str) -> String {
    let mut text =
        headed(&format!("{version:>9}           OBSERVATION DATA    M"), "RINEX VERSION / TYPE");
    for types in types {
        text += &headed(types, "SYS / # / OBS TYPES");
    }
    text + &headed("", "END OF HEADER") + body
}

const GPS: &str = "G    4 C1C L1C D1C S1C";

fn epoch(second: &str, rest: &str) -> String {
    format!("> 2021 09 22 06 30 {second}{rest}\n")
}

/// A satellite with a code of so many metres and a phase with flags.
fn line(name: &str, code: f64, flags: &str) -> String {
    format!("{name}{code:14.3}  {:14.3}{flags:2}\n", code * 5.0)
}

fn read(text: &str) -> (Vec<SatelliteEpoch>, Vec<String>) {
    let (mut epochs, mut flaws) = (Vec::new(), Vec::new());
    for item in ObservationReader::new(text).unwrap() {
        match item {
            Ok(epoch) => epochs.push(epoch),
            Err(flaw) => flaws.push(flaw.to_string()),
        }
    }
    (epochs, flaws)
}

#[test]
fn flags_of_the_phase_tell_slips_and_half_cycles() {
    let body = epoch(" 0.0000000", "  0  4")
        + &line("G01", 2e7, "1")
        + &line("G02", 2e7, "2")
        + &line("G03", 2e7, "3")
        + &line("G04", 2e7, "4");
    let (epochs, flaws) = read(&modern("3.04", &[GPS], &body));
    assert!(flaws.is_empty(), "{flaws:?}");
    let told: Vec<_> = epochs[0].signals.iter().map(|s| (s.slip, s.half_cycle)).collect();
    assert_eq!(told, [(true, false), (false, true), (true, true), (false, false)]);
}

#[test]
fn after_a_power_failure_every_phase_has_slipped() {
    let body = epoch(" 0.0000000", "  1  1") + &line("G01", 2e7, " ");
    assert!(read(&modern("3.04", &[GPS], &body)).0[0].signals[0].slip);
}

#[test]
fn a_repaired_slip_is_one_of_the_next_epoch_and_its_record_no_epoch() {
    let body = epoch(" 0.0000000", "  0  2")
        + &line("G01", 2e7, " ")
        + &line("G02", 2e7, " ")
        + &epoch(" 1.0000000", "  6  1")
        + "G02                         17.000\n"
        + &epoch(" 1.0000000", "  0  2")
        + &line("G01", 2e7, " ")
        + &line("G02", 2e7, " ");
    let (epochs, flaws) = read(&modern("3.04", &[GPS], &body));
    assert!(flaws.is_empty(), "{flaws:?}");
    let told: Vec<bool> = epochs.iter().flat_map(|e| &e.signals).map(|s| s.slip).collect();
    assert_eq!(told, [false, false, false, true]);
}

#[test]
fn events_are_no_epochs_and_may_change_the_header() {
    let event = format!("{:31}4  2\n", ">")
        + &headed("G    1 C5Q", "SYS / # / OBS TYPES")
        + &headed("moved", "MARKER NAME");
    let body = epoch(" 0.0000000", "  0  1")
        + &line("G01", 2e7, " ")
        + &event
        + &epoch(" 1.0000000", "  0  1")
        + "G01  20000000.000\n";
    let text = modern("3.04", &[GPS], &body);
    let mut reader = ObservationReader::new(&text).unwrap();
    let epochs: Vec<_> = reader.by_ref().map(Result::unwrap).collect();
    let names: Vec<_> = epochs.iter().map(|e| e.signals[0].signal.to_string()).collect();
    assert_eq!(names, ["1C", "5Q"]);
    assert_eq!(reader.header().marker, "moved");
}

#[test]
fn a_bad_line_is_left_out_and_its_neighbours_count() {
    let bad = "G02  2x000000.000\n";
    let body = epoch(" 0.0000000", "  0  5")
        + &line("G01", 2e7, " ")
        + bad
        + &line("G03", 2e7, " ")
        + &line("E03", 2e7, " ")
        + &line("G01", 2e7, " ");
    let (epochs, flaws) = read(&modern("3.04", &[GPS], &body));
    assert_eq!(epochs[0].signals.len(), 2);
    assert_eq!(
        flaws,
        [
            "line 6: observations: expected a number F14.3, found \"  2x000000.000\"",
            "line 8: observations: expected a constellation that the header has, found \"E03\"",
            "line 9: observations: expected each satellite once in an epoch, found \"G01\"",
        ]
    );
}

#[test]
fn a_wrong_number_of_satellites_costs_no_satellite_that_was_announced() {
    let body = epoch(" 0.0000000", "  0  3")
        + &line("G01", 2e7, " ")
        + &epoch(" 1.0000000", "  0  1")
        + &line("G01", 2e7, " ")
        + &line("G02", 2e7, " ")
        + &epoch(" 2.0000000", "  0  1")
        + &line("G01", 2e7, " ");
    let (epochs, flaws) = read(&modern("3.04", &[GPS], &body));
    assert_eq!(epochs.iter().map(|e| e.signals.len()).collect::<Vec<_>>(), [1, 1, 1]);
    assert_eq!(flaws.len(), 2);
    assert!(flaws.iter().all(|flaw| flaw.contains("number of satellites")), "{flaws:?}");
}

#[test]
fn epochs_that_repeat_or_go_back_are_left_out_but_their_slips_are_not() {
    let one = |second, flags| epoch(second, "  0  1") + &line("G01", 2e7, flags);
    let body = one(" 5.0000000", " ")
        + &one(" 5.0000000", "1")
        + &one(" 6.0000000", " ")
        + &one(" 3.0000000", " ")
        + &one(" 7.0000000", " ");
    let (epochs, flaws) = read(&modern("3.04", &[GPS], &body));
    let told: Vec<_> =
        epochs.iter().map(|e| (e.tag.since(epochs[0].tag).as_nanos(), e.signals[0].slip)).collect();
    assert_eq!(told, [(0, false), (1_000_000_000, true), (2_000_000_000, false)]);
    assert_eq!(flaws.len(), 2);
}

#[test]
fn zero_and_blank_are_nothing() {
    let body = epoch(" 0.0000000", "  0  2")
        + "G01  20000000.000           0.000                        0.000\n"
        + "G02\n";
    let (epochs, _) = read(&modern("3.04", &[GPS], &body));
    let own = epochs[0].signals[0];
    assert_eq!((own.code, own.phase, own.doppler, own.cn0), (Some(2e7), None, None, None));
    assert_eq!(epochs[0].signals.len(), 1);
}

#[test]
fn tags_keep_their_nanoseconds_and_follow_the_time_system() {
    let body = "> 2021 09 22 06 30 29.9980001  0  0\n";
    let text = modern("3.04", &[GPS], body);
    let tag = |name: &str, leaps: &str| {
        let lines = headed(&format!("{:48}{name}", ""), "TIME OF FIRST OBS") + leaps;
        let end = headed("", "END OF HEADER");
        read(&text.replace(&end, &(lines + &end))).0[0].tag.as_nanos()
    };
    let gps = tag("GPS", "");
    assert_eq!(gps % 1_000_000_000, 998_000_100);
    assert_eq!(tag("GAL", ""), gps);
    assert_eq!(tag("BDT", "") - gps, 14_000_000_000);
    assert_eq!(tag("GLO", "") - gps, 18_000_000_000);
    assert_eq!(tag("GLO", &headed("    17", "LEAP SECONDS")) - gps, 17_000_000_000);
}

#[test]
fn headers_that_cannot_be_used_say_why() {
    let why = |text: &str| ObservationReader::new(text).unwrap_err().to_string();
    assert_eq!(why(""), "the header has no line \"RINEX VERSION / TYPE\"");
    let text = modern("3.04", &[GPS], "");
    assert!(why(&text.replace("3.04", "5.04")).contains("expected a version from 2 to 4"));
    assert!(why(&text.replace("OBS", "NAV")).contains("O in column 21"));
    assert!(why(&text.replace("G    4", "G    x")).contains("a number of types"));
    assert!(why(&modern("3.04", &[], "")).contains("SYS / # / OBS TYPES"));
    assert!(why(text.split("END").next().unwrap()).contains("END OF HEADER"));
    let scaled = headed("G 1000", "SYS / SCALE FACTOR") + &headed("", "END OF HEADER");
    let scaled = text.replace(&headed("", "END OF HEADER"), &scaled);
    assert!(why(&scaled).contains("no factor but 1"));
}

#[test]
fn version_two_names_more_than_twelve_satellites_on_more_lines() {
    let mut text = headed("     2.11           OBSERVATION DATA    M", "RINEX VERSION / TYPE")
        + &headed("     6    C1    L1    L2    P2    S1    S2", "# / TYPES OF OBSERV")
        + &headed("", "END OF HEADER");
    let numbers: Vec<u8> = (1..=13).collect();
    let names = |part: &[u8]| part.iter().map(|n| format!("G{n:2}")).collect::<String>();
    text += &format!(" 99 12 31 23 59 59.9990000  0 13{}  .123456789\n", names(&numbers[..12]));
    text += &format!("{:32}R{:2}\n", "", 13);
    for _ in numbers {
        text +=
            "  20000000.123 8 105099999.123 8  81896103.123 8  20000001.456          45.000  \n";
        text += "        40.000  \n";
    }
    let (epochs, flaws) = read(&text);
    assert!(flaws.is_empty(), "{flaws:?}");
    let signals = &epochs[0].signals;
    assert_eq!(signals.len(), 26);
    assert_eq!(epochs[0].tag, GpsTime::from_week(1042, 518_399_999_000_000));
    let last: Vec<_> =
        signals[24..].iter().map(|s| format!("{} {}", s.satellite, s.signal)).collect();
    assert_eq!(last, ["R13 1C", "R13 2P"]);
    assert_eq!(signals[1].cn0, Some(40.0));
}

#[test]
fn headers_go_on_over_several_lines() {
    let types = [
        "C   15 X1  C1I L1I D1I S1I C7I L7I D7I S7I C6I L6I D6I S6I",
        "       C1X L1X",
        "R    1 C1C",
    ];
    let lines = headed(
        "  9 R01  1 R02 -4 R03  5 R11  0 R12 -1 R13 -2 R17  4 R18 -3",
        "GLONASS SLOT / FRQ #",
    ) + &headed("    R24  2", "GLONASS SLOT / FRQ #")
        + &headed(&format!("{:6}{:18}BDS", 4, ""), "LEAP SECONDS")
        + &headed("ARBITRARY", "SIGNAL STRENGTH UNIT")
        + &headed("     x", "INTERVAL")
        + &headed("", "END OF HEADER");
    let text = modern("3.02", &types, "").replace(&headed("", "END OF HEADER"), &lines);
    let mut reader = ObservationReader::new(&text).unwrap();
    let header = reader.header();
    assert_eq!(header.leap_seconds, Some(18));
    assert_eq!(header.glonass_channels.len(), 9);
    assert_eq!(header.glonass_channels[8], (24, 2));
    let names: Vec<String> = header.signals[0].1.iter().map(ToString::to_string).collect();
    assert_eq!(names, ["2I", "7I", "6I", "2X"]);
    let flaw = reader.next().unwrap().unwrap_err();
    assert_eq!((flaw.line, flaw.found.as_str()), (9, "     x"));
    assert!(reader.next().is_none());
}

#[test]
fn strengths_of_an_unknown_unit_are_not_taken_for_decibels() {
    let unit = headed("ARBITRARY", "SIGNAL STRENGTH UNIT") + &headed("", "END OF HEADER");
    let body = epoch(" 0.0000000", "  0  1")
        + "G01  20000000.000                                            7.000\n";
    let text = modern("3.04", &[GPS], &body);
    assert_eq!(read(&text).0[0].signals[0].cn0, Some(7.0));
    let text = text.replace(&headed("", "END OF HEADER"), &unit);
    assert_eq!(read(&text).0[0].signals[0].cn0, None);
}

#[test]
fn events_without_a_date_are_passed_over_in_version_two() {
    let text = headed("     2.10           OBSERVATION DATA", "RINEX VERSION / TYPE")
        + &headed("     2    C1    L1", "# / TYPES OF OBSERV")
        + &headed("", "END OF HEADER")
        + " 05  4  2  0  0  0.0000000  0  1  3\n  20000000.000   1000000.000\n"
        + &format!("{:28}4  2\n", "")
        + &headed("2", "COMMENT")
        + &headed("     1    C1", "# / TYPES OF OBSERV")
        + " 05  4  2  0  0 30.0000000  0  1G 3\n  20000000.000\n";
    let (epochs, flaws) = read(&text);
    assert!(flaws.is_empty(), "{flaws:?}");
    let told: Vec<_> =
        epochs.iter().map(|e| (e.signals[0].satellite.to_string(), e.signals[0].phase)).collect();
    assert_eq!(told, [("G03".to_owned(), Some(1e6)), ("G03".to_owned(), None)]);
}

#[test]
fn phases_of_receivers_that_square_are_ambiguous_by_half_cycles() {
    let text = headed("     2.10           OBSERVATION DATA", "RINEX VERSION / TYPE")
        + &headed("     1     2", "WAVELENGTH FACT L1/2")
        + &headed("     2    L1    L2", "# / TYPES OF OBSERV")
        + &headed("", "END OF HEADER")
        + " 05  4  2  0  0  0.0000000  0  2G 3G 4\n"
        + "   1000000.000     1000000.000\n   1000000.000     1000000.0002\n";
    let (epochs, flaws) = read(&text);
    assert!(flaws.is_empty(), "{flaws:?}");
    let told: Vec<_> = epochs[0].signals.iter().map(|own| own.half_cycle).collect();
    assert_eq!(told, [false, true, false, false]);
}

#[test]
fn the_places_of_an_antenna_that_moves_come_back_with_their_epochs() {
    let satellite = SatelliteId::new(Constellation::Gps, 7).unwrap();
    let own = |second: i64| SatelliteEpoch {
        tag: GpsTime::from_week(2300, second * 1_000_000_000),
        signals: vec![SignalObservation {
            code: Some(2.2e7 + second as f64),
            ..SignalObservation::unknown(satellite, SignalCode::new(1, b'C'))
        }],
        leap_seconds: Some(18),
        clock_reset: false,
    };
    let epochs: Vec<_> = (0..5).map(own).collect();
    let place = |east: f64| Some([-3_957_196.25, 3_310_200.125 + east, 3_737_710.5]);
    let places = [place(0.0), place(3.5), place(3.5), None, place(7.0)];
    let header = ObservationHeader {
        position: place(0.0),
        is_moving: true,
        leap_seconds: Some(18),
        ..ObservationHeader::of_marker("base")
    };
    let text = write_moving(&header, &epochs, &places);
    assert_eq!(text.matches("APPROX POSITION XYZ").count(), 4, "{text}");
    assert!(text.contains("WATER_CRAFT"), "{text}");
    let mut reader = ObservationReader::new(&text).unwrap();
    for (epoch, place) in epochs.iter().zip(places) {
        assert_eq!(reader.next().unwrap().unwrap(), *epoch);
        let told = reader.header();
        assert_eq!((told.is_moving, told.position), (true, place));
    }
    assert!(reader.next().is_none());
    // one that stands again, as another program says it
    let stands = text.replace("  2  0\n", "  3  0\n");
    let mut reader = ObservationReader::new(&stands).unwrap();
    assert!(reader.next().is_some() && !reader.header().is_moving);
}
