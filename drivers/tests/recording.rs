//! Recordings written, read back, damaged and refused.

#![allow(clippy::unwrap_used)]

use std::fs;
use std::io::Write;
use std::path::Path;

use insd_base::{
    Attitude, Body, ExternalReference, FixQuality, Geodetic, GnssFix, ImuSample, ImuSpec,
    LeverArms, LogReference, LogVelocity, Message, Ned, Received, Source, Stamped, StartCondition,
    Time, Triad, Truth, Voyage, VoyageHeader,
};
use insd_drivers::recording::{
    Compression, RecordingError, RowFault, VoyageReader, read_truth, write_voyage,
};
use proptest::prelude::*;
use tempfile::TempDir;

const SECONDS: usize = 20;
const RATE: usize = 10;

fn header() -> VoyageHeader {
    VoyageHeader {
        start_utc: "2026-01-01T00:00:00Z".to_owned(),
        start: StartCondition::Moored,
        initial: Some(Geodetic::from_degrees(35.0, 139.0, 1.5)),
        imu: ImuSpec {
            rate: RATE as f64,
            gyro: Triad {
                bias_std: 1e-7,
                instability_std: 1e-8,
                instability_time: 3600.0,
                random_walk: 1e-6,
                scale_std: 1e-5,
            },
            accel: Triad {
                bias_std: 1e-4,
                instability_std: 1e-5,
                instability_time: 3600.0,
                random_walk: 1e-4,
                scale_std: 1e-5,
            },
        },
        lever_arms: LeverArms { gnss: Body::new(-6.0, 0.5, -14.0), log: Body::new(1.0, 2.0, 3.0) },
        vessel: insd_base::VesselKind::Boat,
        time_std: Some(0.02),
    }
}

fn imu(index: usize) -> Stamped<ImuSample> {
    let x = index as f64;
    Stamped::prompt(ImuSample {
        time: Time::from_seconds(x / RATE as f64),
        delta_theta: Body::new(1.234_567_89e-5 * x.sin(), -1e-6 * x.cos(), 7.7e-6),
        delta_velocity: Body::new(0.001 * x.cos(), -0.002, -0.098_066_5),
    })
}

/// Fixes that overtake each other on the way.
fn gnss(index: usize) -> Stamped<GnssFix> {
    let time = Time::from_seconds(index as f64);
    let delay = [0.25, 1.75, 0.5][index % 3];
    Stamped {
        message: GnssFix {
            time,
            position: Some(Geodetic::from_degrees(35.0 + 1e-5 * index as f64, -179.999, 30.0)),
            velocity: Some(Ned::new(0.1, -0.2, 0.3)),
            position_std: Some(Ned::new(1.0, 1.0, 2.0)),
            velocity_std: None,
            hdop: Some(0.9),
            satellites: Some(12),
            quality: FixQuality::RtkFixed,
            lever: None,
            redated: 0.0,
            rank: 0,
        },
        arrival: Some(Time::from_seconds(index as f64 + delay)),
    }
}

fn log(index: usize) -> Stamped<LogVelocity> {
    Stamped::prompt(LogVelocity {
        time: Time::from_seconds(index as f64),
        u: Some(5.0),
        v: Some(-0.123_456_789),
        w: None,
        std: Some(0.03),
        reference: if index < 10 { LogReference::Bottom } else { LogReference::Water },
    })
}

fn reference(index: usize) -> Stamped<ExternalReference> {
    Stamped::prompt(ExternalReference {
        time: Time::from_seconds(10.0 * index as f64),
        position: Some(Geodetic::from_degrees(35.0, 139.0, 0.0)),
        position_std: Some(0.5),
        heading: (index == 1).then_some(6.0),
        ..ExternalReference::default()
    })
}

fn truth(index: usize) -> Truth {
    Truth {
        time: Time::from_seconds(index as f64),
        position: Geodetic::from_degrees(35.0, 139.000_000_012_34, 1.5),
        velocity: (index > 1).then(|| Ned::new(0.1, 0.2, 0.3)),
        attitude: (index > 2).then_some(Attitude { roll: 0.1, pitch: -0.2, heading: 5.9 }),
    }
}

fn voyage() -> Voyage {
    Voyage {
        header: header(),
        imu: (1..=SECONDS * RATE).map(imu).collect(),
        gnss: (0..SECONDS).map(gnss).collect(),
        log: (0..SECONDS).map(log).collect(),
        reference: (0..2).map(reference).collect(),
        truth: (0..SECONDS).map(truth).collect(),
    }
}

fn written(compression: Compression) -> TempDir {
    let dir = tempfile::tempdir().unwrap();
    write_voyage(dir.path(), &voyage(), compression).unwrap();
    dir
}

/// A written voyage with one file changed.
fn damaged(name: &str, change: impl FnOnce(String) -> String) -> TempDir {
    let dir = written(Compression::None);
    let path = dir.path().join(name);
    let text = fs::read_to_string(&path).unwrap();
    fs::write(path, change(text)).unwrap();
    dir
}

/// A written voyage with one line of a file replaced, counted from 1 at the header.
fn with_line(name: &str, number: usize, line: &str) -> TempDir {
    damaged(name, |text| {
        let mut lines: Vec<&str> = text.lines().collect();
        lines[number - 1] = line;
        lines.join("\n")
    })
}

fn read(dir: &Path) -> Result<Vec<Received>, RecordingError> {
    VoyageReader::open(dir)?.collect()
}

fn message_of(dir: &Path) -> String {
    read(dir).unwrap_err().to_string()
}

/// Reads to the end and gives the faults counted in one file.
fn faults(dir: &Path, file: &str) -> Vec<(RowFault, u64)> {
    let mut reader = VoyageReader::open(dir).unwrap();
    for message in &mut reader {
        message.unwrap();
    }
    let report = reader.skipped().into_iter().find(|report| report.file == file).unwrap().clone();
    let unsorted = (report.unsorted > 0).then_some((RowFault::Unsorted, report.unsorted));
    report.skipped.into_iter().chain(unsorted).collect()
}

fn assert_close(a: &Message, b: &Message) {
    match (a, b) {
        (Message::Imu(a), Message::Imu(b)) => {
            assert!((a.delta_theta.0 - b.delta_theta.0).amax() < 1e-11);
            assert!((a.delta_velocity.0 - b.delta_velocity.0).amax() < 1e-9);
        }
        (Message::Gnss(a), Message::Gnss(b)) => {
            let (p, q) = (a.position.unwrap(), b.position.unwrap());
            assert!((p.latitude - q.latitude).to_degrees().abs() < 1e-11);
            assert!((p.longitude - q.longitude).to_degrees().abs() < 1e-11);
            let rest = |fix: &GnssFix| GnssFix { position: None, ..*fix };
            assert_eq!(rest(a), rest(b));
        }
        (Message::Reference(a), Message::Reference(b)) => {
            let (h, k) = (a.heading.unwrap_or(9.0), b.heading.unwrap_or(9.0));
            assert!((h - k).abs() < 1e-12);
            let rest = |m: &ExternalReference| ExternalReference { heading: None, ..*m };
            assert_eq!(rest(a), rest(b));
        }
        _ => assert_eq!(a, b),
    }
}

#[test]
fn a_written_voyage_reads_back_in_order_of_receipt() {
    for compression in [Compression::None, Compression::Zstd] {
        let dir = written(compression);
        let (back, expected) = (read(dir.path()).unwrap(), voyage().received());
        assert_eq!(back.len(), expected.len());
        for (a, b) in back.iter().zip(&expected) {
            assert_eq!(
                (a.receipt, a.source, a.message.time()),
                (b.receipt, b.source, b.message.time())
            );
            assert_close(&a.message, &b.message);
        }
    }
}

#[test]
fn truth_reads_back_with_its_gaps() {
    let dir = written(Compression::Zstd);
    let back = read_truth(&dir.path().join("truth.csv")).unwrap();
    assert_eq!(back.len(), SECONDS);
    for (a, b) in back.iter().zip(&voyage().truth) {
        assert_eq!(
            (a.time, a.velocity, a.attitude.is_some()),
            (b.time, b.velocity, b.attitude.is_some())
        );
        assert!((a.position.longitude - b.position.longitude).to_degrees().abs() < 1e-11);
    }
}

#[test]
fn a_new_voyage_leaves_nothing_of_the_old_one() {
    let dir = written(Compression::Zstd);
    let bare = Voyage { gnss: Vec::new(), ..voyage() };
    write_voyage(dir.path(), &bare, Compression::None).unwrap();
    assert!(dir.path().join("imu.csv").exists() && !dir.path().join("imu.csv.zst").exists());
    assert!(!read(dir.path()).unwrap().iter().any(|m| m.source == Source::Gnss(0)));
}

#[test]
fn columns_may_stand_in_any_order_beside_unknown_ones() {
    let dir = damaged("log.csv", |_| {
        "\u{feff}depth_m,reference, std_mps ,\"w_mps\",v_mps,u_mps,t_s\r\n7,water,0.1,,2,1,3\r\n"
            .into()
    });
    let messages = read(dir.path()).unwrap();
    let found = messages.iter().find_map(|received| match received.message {
        Message::Log(log) => Some(log),
        _ => None,
    });
    let log = found.unwrap();
    assert_eq!((log.u, log.v, log.w, log.std), (Some(1.0), Some(2.0), None, Some(0.1)));
    assert_eq!(log.reference, LogReference::Water);
}

#[test]
fn a_fix_without_height_keeps_its_horizontal_position_and_claims_no_height() {
    let row = "3,35,139,,1,2,,,,,,,,,,";
    let header = "t_s,lat_deg,lon_deg,height_m,vn_mps,ve_mps,vd_mps,std_n_m,std_e_m,std_d_m,std_vn_mps,std_ve_mps,std_vd_mps,hdop,satellites,quality";
    let dir = damaged("gnss.csv", |_| format!("{header}\n{row}\n"));
    let messages = read(dir.path()).unwrap();
    let fix = messages.iter().find_map(|received| match received.message {
        Message::Gnss(fix) => Some(fix),
        _ => None,
    });
    let fix = fix.unwrap();
    assert_eq!(fix.position, Some(Geodetic::from_degrees(35.0, 139.0, 0.0)));
    assert!(fix.position_std.unwrap().0.z >= 1e4 && fix.velocity_std.unwrap().0.z >= 100.0);
    assert_eq!(fix.quality, FixQuality::Autonomous);
}

#[test]
fn missing_files_are_named() {
    for name in ["voyage.toml", "imu.csv"] {
        let dir = written(Compression::None);
        fs::remove_file(dir.path().join(name)).unwrap();
        let message = message_of(dir.path());
        assert!(message.contains(name) && message.contains("no such file"), "{message}");
    }
    assert!(message_of(Path::new("/nowhere")).contains("not a directory"));
}

#[test]
fn a_wrong_header_names_the_columns_that_are_missing() {
    for (file, column) in [
        ("imu.csv", "dvel_y_mps"),
        ("gnss.csv", "lon_deg"),
        ("gnss.csv", "ve_mps"),
        ("log.csv", "t_s"),
        ("log.csv", "reference"),
    ] {
        let dir = damaged(file, |text| text.replacen(column, "wrong", 1));
        let message = message_of(dir.path());
        assert!(message.contains(&format!("{file}:1: missing column {column};")), "{message}");
    }
}

#[test]
fn a_column_that_no_receiver_tells_may_be_left_out_and_that_is_told() {
    let dir = damaged("gnss.csv", |text| {
        ["vn_mps", "ve_mps", "quality"]
            .iter()
            .fold(text.to_owned(), |text, column| text.replacen(column, "another", 1))
    });
    let mut reader = VoyageReader::open(dir.path()).unwrap();
    let messages: Vec<Message> = (&mut reader).map(|received| received.unwrap().message).collect();
    let of_fix = |message: &Message| match message {
        Message::Gnss(fix) => Some((fix.velocity, fix.quality)),
        _ => None,
    };
    let told: Vec<_> = messages.iter().filter_map(of_fix).collect();
    assert!(!told.is_empty() && told.iter().all(|it| *it == (None, FixQuality::Autonomous)));
    let report = reader.skipped().into_iter().find(|report| report.file == "gnss.csv").unwrap();
    assert_eq!(report.absent, ["vn_mps", "ve_mps", "quality"]);
}

#[test]
fn a_file_without_header_or_rows_is_refused() {
    let empty = damaged("imu.csv", |_| String::new());
    assert!(message_of(empty.path()).contains("missing columns t_s, dtheta_x_rad"));
    let no_rows = damaged("imu.csv", |text| text.lines().next().unwrap().to_owned());
    assert!(message_of(no_rows.path()).contains("no rows"), "{}", message_of(no_rows.path()));
}

#[test]
fn a_truncated_last_line_is_skipped_and_counted() {
    let dir = damaged("imu.csv", |text| text[..text.len() - 40].to_owned());
    assert_eq!(faults(dir.path(), "imu.csv"), [(RowFault::TooFewFields, 1)]);
}

#[test]
fn faulty_rows_are_skipped_and_counted_by_reason() {
    for (line, fault) in [
        ("1,nan,0,0,0,0,0", RowFault::NotFinite),
        ("1,0,-inf,0,0,0,0", RowFault::NotFinite),
        ("1,abc,0,0,0,0,0", RowFault::NotANumber),
        ("1,\0,0,0,0,0,0", RowFault::NotANumber),
        ("1,,0,0,0,0,0", RowFault::Empty),
        ("1e30,0,0,0,0,0,0", RowFault::OutOfRange),
        ("1,0,0,0,0,0,0,0", RowFault::TooManyFields),
        ("50.0,0,0,0,0,0,0", RowFault::TimeLeap),
        ("0.3,0,0,0,0,0,0", RowFault::Unsorted),
    ] {
        let dir = with_line("imu.csv", 11, line);
        assert_eq!(faults(dir.path(), "imu.csv"), [(fault, 1)], "{line:?}");
    }
    let far_north = damaged("gnss.csv", |text| text.replacen(",35.00005,", ",95.0,", 1));
    assert_eq!(faults(far_north.path(), "gnss.csv"), [(RowFault::OutOfRange, 1)]);
    let other_word = damaged("log.csv", |text| text.replacen("bottom", "mud", 1));
    assert_eq!(faults(other_word.path(), "log.csv"), [(RowFault::UnknownWord, 1)]);
}

#[test]
fn duplicated_and_swapped_imu_rows_reach_the_engine_as_they_are() {
    let dir = damaged("imu.csv", |text| {
        let mut lines: Vec<&str> = text.lines().collect();
        lines.insert(20, lines[20]);
        lines.swap(50, 51);
        lines.join("\n")
    });
    let times: Vec<Time> = read(dir.path())
        .unwrap()
        .iter()
        .filter(|received| received.source == Source::Imu(0))
        .map(|received| received.message.time())
        .collect();
    assert_eq!(times.len(), SECONDS * RATE + 1);
    assert_eq!(times.windows(2).filter(|pair| pair[0] == pair[1]).count(), 1);
    assert_eq!(times.windows(2).filter(|pair| pair[0] > pair[1]).count(), 1);
    assert_eq!(faults(dir.path(), "imu.csv"), [(RowFault::Unsorted, 1)]);
}

#[test]
fn a_file_with_many_bad_rows_is_refused_with_examples() {
    let nan_filled = damaged("imu.csv", |text| {
        let (header, rows) = text.split_once('\n').unwrap();
        format!("{header}\n{}", rows.replace("-0.002", "nan"))
    });
    let message = message_of(nan_filled.path());
    assert!(message.contains("200 of 200 rows are faulty"), "{message}");
    assert!(message.contains("imu.csv:2:dvel_y_mps: expected a finite number"), "{message}");
    let reversed = damaged("imu.csv", |text| {
        let (header, rows) = text.split_once('\n').unwrap();
        let reversed: Vec<&str> = rows.lines().rev().collect();
        format!("{header}\n{}", reversed.join("\n"))
    });
    assert!(message_of(reversed.path()).contains("time goes back"));
}

#[test]
fn a_line_without_end_is_refused_with_its_place() {
    let dir = damaged("imu.csv", |text| format!("{text}{}", "1".repeat(1_000_000)));
    let message = message_of(dir.path());
    assert!(message.contains(&format!("imu.csv:{}: line longer", SECONDS * RATE + 2)), "{message}");
    let one_line = damaged("imu.csv", |_| "x".repeat(1_000_000));
    assert!(message_of(one_line.path()).contains("imu.csv:1: line longer"));
}

#[test]
fn a_truncated_compressed_file_is_refused() {
    let dir = written(Compression::Zstd);
    let path = dir.path().join("imu.csv.zst");
    let bytes = fs::read(&path).unwrap();
    fs::write(&path, &bytes[..bytes.len() - 20]).unwrap();
    assert!(message_of(dir.path()).contains("imu.csv.zst"));
    fs::write(&path, b"t_s,not compressed").unwrap();
    assert!(message_of(dir.path()).contains("imu.csv.zst"));
}

#[test]
fn a_binary_file_is_not_taken_for_text() {
    let dir = damaged("imu.csv", |text| format!("\0{text}"));
    assert!(message_of(dir.path()).contains("imu.csv:1:1: not UTF-8 text"));
}

#[test]
fn after_an_error_the_reader_ends() {
    let dir = damaged("gnss.csv", |text| format!("{text}{}", "1".repeat(100_000)));
    let mut reader = VoyageReader::open(dir.path()).unwrap();
    assert!(reader.by_ref().any(|message| message.is_err()));
    assert!(reader.next().is_none());
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn arbitrary_bytes_never_panic(bytes in prop::collection::vec(any::<u8>(), 0..2000), which in 0..5_usize) {
        let dir = written(Compression::None);
        let names = ["imu.csv", "gnss.csv", "log.csv", "reference.csv", "voyage.toml"];
        fs::write(dir.path().join(names[which]), &bytes).unwrap();
        let _ = read(dir.path());
        fs::write(dir.path().join("imu.csv.zst"), &bytes).unwrap();
        let _ = fs::remove_file(dir.path().join("imu.csv"));
        let _ = read(dir.path());
    }

    #[test]
    fn mutated_voyages_never_panic_and_keep_the_order_of_receipt(
        which in 0..4_usize,
        cuts in prop::collection::vec((any::<prop::sample::Index>(), 0..60_usize, "[-0-9.,e\nn\u{e9}]{0,12}"), 1..12),
    ) {
        let dir = written(Compression::None);
        let path = dir.path().join(["imu.csv", "gnss.csv", "log.csv", "reference.csv"][which]);
        let mut bytes = fs::read(&path).unwrap();
        for (at, length, insert) in cuts {
            let start = at.index(bytes.len() + 1);
            let end = (start + length).min(bytes.len());
            bytes.splice(start..end, insert.bytes());
        }
        fs::File::create(&path).unwrap().write_all(&bytes).unwrap();
        if let Ok(messages) = read(dir.path()) {
            prop_assert!(messages.is_sorted_by_key(|received| received.receipt));
        }
    }
}
