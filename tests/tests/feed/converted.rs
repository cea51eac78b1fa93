//! A recording with raw messages of a receiver, as a voyage directory.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use insd_base::{GpsTime, Input, earth};
use insd_drivers::recording::{read_raw, read_raw_base};
use insd_lab::commands::convert::{self, ConvertArgs};
use insd_lab::report::VoyageReport;
use insd_rinex::{ObservationReader, read_navigation};
use insd_simulator::{raw_gnss, simulate};
use insd_tests::feed::{Calendar, Encoding};
use insd_tests::raw_feed;
use insd_tests::recorded::Recorded;
use insd_wire::gnss::rtcm::{Correction, MsmCollector};
use insd_wire::stream::{Cutter, Protocol};
use tempfile::TempDir;

/// Length of the voyage, s.
const DURATION: f64 = 120.0;

/// A voyage directory out of a recording of a ship with an IMU and a u-blox receiver, that sends raw messages or not, and how many epochs it sent.
fn converted(sends_raw: bool, change: impl FnOnce(String) -> String) -> (TempDir, usize) {
    let text = [("grade = \"mems\"", "grade = \"navigation\"")];
    let scenario = insd_tests::variant(26, &text).with_duration(DURATION);
    let (voyage, raw) = (simulate(&scenario, 3), raw_gnss(&scenario, 3).unwrap());
    let mut recorded = Recorded::new(&voyage, &[Encoding::Sbg, Encoding::Ubx], "");
    let start = Calendar::new(&voyage.header.start_utc).unwrap().start.to_gps();
    if sends_raw {
        for sending in raw_feed::ubx(&raw, start, 1) {
            recorded.insert(sending.at.as_seconds(), 1, sending.input);
        }
    }
    recorded.config = change(recorded.config);
    (converted_of(&recorded).0, raw.antennas[0].len())
}

/// The same of a recording, with the path of the voyage.
fn converted_of(recorded: &Recorded) -> (TempDir, PathBuf) {
    let desk = tempfile::tempdir().unwrap();
    recorded.write(&desk.path().join("recording"));
    let voyage = desk.path().join("voyage");
    let args = ConvertArgs {
        recording: desk.path().join("recording"),
        out: Some(voyage.clone()),
        rinex: None,
        config: None,
        run: 1,
        to: None,
        imu: false,
        start_utc: None,
    };
    convert::run(&args).unwrap();
    (desk, voyage)
}

/// The table of a voyage's header.
fn header(voyage: &Path) -> toml::Table {
    std::fs::read_to_string(voyage.join("voyage.toml")).unwrap().parse().unwrap()
}

#[test]
fn raw_messages_of_a_recording_become_files_of_its_voyage_which_sails_by_satellites() {
    let (desk, epochs) = converted(true, |config| config);
    let voyage = desk.path().join("voyage");
    let texts = read_raw(&voyage, 1).unwrap().unwrap();
    let read = ObservationReader::new(&texts.observations.1).unwrap();
    assert_eq!(read.map(Result::unwrap).count(), epochs);
    assert!(read_navigation(&texts.navigation.1).unwrap().records.len() >= 6);
    assert_eq!(read_raw(&voyage, 2).unwrap(), None);
    assert_eq!(read_raw_base(&voyage).unwrap(), None);
    assert!(!voyage.join("truth.json").exists(), "nobody knows what was done to it");
    let header = header(&voyage);
    assert_eq!(header["raw"]["rate_hz"].as_float(), Some(1.0));
    assert_eq!(header["raw"]["antennas_m"][0], header["lever_arms_m"]["gnss"]);

    let page = VoyageReport::of_voyage(&voyage).unwrap().html(insd_languages::Language::English);
    let row = |aid: &str| {
        let (_, rest) = page.split_once(&format!("<td>{aid}</td>")).unwrap();
        let digits = rest
            .split("</td>")
            .next()
            .unwrap()
            .chars()
            .filter(char::is_ascii_digit)
            .collect::<String>();
        digits.parse::<u64>().unwrap()
    };
    assert!(row("satellite code") > 40, "{}", row("satellite code"));
    assert!(page.contains("Satellites in use"), "no key figure of satellites");
}

#[test]
fn a_voyage_has_no_raw_gnss_where_none_was_sent_or_the_ship_did_not_read_it() {
    // the receiver's table is the last
    let off = |config: String| {
        let (before, after) = config.rsplit_once("raw = \"tight\"").unwrap();
        format!("{before}raw = \"off\"{after}")
    };
    for (desk, _) in [converted(false, |config| config), converted(true, off)] {
        let voyage = desk.path().join("voyage");
        assert_eq!(read_raw(&voyage, 1).unwrap(), None);
        assert!(!header(&voyage).contains_key("raw"));
        let page =
            VoyageReport::of_voyage(&voyage).unwrap().html(insd_languages::Language::English);
        assert!(page.contains("GNSS position") && !page.contains("atellite code"));
        assert!(!page.contains("Satellites in use"));
    }
}

/// Adds 8 m of way to the north for each second to where the base says that it is.
fn under_way(bytes: &[u8], place: &mut usize) -> Vec<u8> {
    let mut cutter = Cutter::new(&[Protocol::Rtcm]);
    cutter.push(bytes);
    let mut told = Vec::new();
    while let Some(cut) = cutter.cut() {
        let read = MsmCollector::new().take(cut.bytes, GpsTime::from_nanos(0));
        match read.as_deref() {
            Ok([Correction::Base(own)]) => {
                let mut own = *own;
                own.position[2] += 8.0 * *place as f64;
                *place += 1;
                told.extend(own.write());
            }
            _ => told.extend_from_slice(cut.bytes),
        }
    }
    told
}

#[test]
fn a_base_of_a_recording_is_read_back_where_it_was_whether_it_stands_or_moves() {
    let text = [("grade = \"mems\"", "grade = \"navigation\"")];
    let scenario = insd_tests::port_with_base(&text).with_duration(DURATION);
    let (voyage, raw) = (simulate(&scenario, 3), raw_gnss(&scenario, 3).unwrap());
    let start = Calendar::new(&voyage.header.start_utc).unwrap().start.to_gps();
    for is_moving in [false, true] {
        let more = format!(
            "[[port]]\nname = \"caster\"\ntransport = {{ kind = \"tcp-client\", address = \"127.0.0.1:2101\" }}\n\
             [[sensor]]\nname = \"base\"\nport = \"caster\"\nkind = \"rtcm_base\"\nbase = {{ moving = {is_moving} }}\n"
        );
        let mut recorded = Recorded::new(&voyage, &[Encoding::Sbg, Encoding::Ubx], &more);
        let port = recorded.bridge() + 1;
        for sending in raw_feed::ubx(&raw, start, 1) {
            recorded.insert(sending.at.as_seconds(), 1, sending.input);
        }
        let mut places = 0;
        for sending in raw_feed::rtcm(&raw, start, port.into()) {
            let bytes = sending.bytes();
            let bytes = if is_moving { under_way(bytes, &mut places) } else { bytes.to_vec() };
            recorded.insert(sending.at.as_seconds(), port, Input::Bytes(bytes));
        }
        let (_desk, voyage) = converted_of(&recorded);
        let (_, text) = read_raw_base(&voyage).unwrap().unwrap();
        let mut reader = ObservationReader::new(&text).unwrap();
        let true_place = earth::ecef(&raw.base.as_ref().unwrap().position).0;
        let (mut epochs, mut ways) = (0, BTreeSet::new());
        while let Some(epoch) = reader.next() {
            assert!(!epoch.unwrap().signals.is_empty());
            epochs += 1;
            let header = reader.header();
            assert_eq!(header.is_moving, is_moving);
            if let Some(place) = header.position {
                let way = place[2] - true_place.z;
                assert!((way / 8.0 - (way / 8.0).round()).abs() < 1e-4, "{way}");
                ways.insert((way / 8.0).round() as i64);
            }
        }
        assert!(epochs > 100, "{epochs}");
        assert_eq!(ways.len() > 15, is_moving, "{ways:?}");
    }
}
