//! A recording with raw messages of a receiver, as a voyage directory.

use std::path::Path;

use insd_drivers::recording::{read_raw, read_raw_base};
use insd_lab::commands::convert::{self, ConvertArgs};
use insd_lab::report::VoyageReport;
use insd_rinex::{ObservationReader, read_navigation};
use insd_simulator::{raw_gnss, simulate};
use insd_tests::feed::{Calendar, Encoding};
use insd_tests::raw_feed;
use insd_tests::recorded::Recorded;
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
    let desk = tempfile::tempdir().unwrap();
    recorded.write(&desk.path().join("recording"));
    let args = ConvertArgs {
        recording: desk.path().join("recording"),
        out: Some(desk.path().join("voyage")),
        rinex: None,
        config: None,
        run: 1,
    };
    convert::run(&args).unwrap();
    (desk, raw.antennas[0].len())
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

    let page = VoyageReport::of_voyage(&voyage).unwrap().html();
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
        let page = VoyageReport::of_voyage(&voyage).unwrap().html();
        assert!(page.contains("GNSS position") && !page.contains("atellite code"));
        assert!(!page.contains("Satellites in use"));
    }
}
