//! The report of a recording: complete, self-contained, the same each time, honest about what is missing.

#![allow(clippy::unwrap_used)] // helpers of tests are not seen as tests

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use insd_base::{Input, PortState};
use insd_lab::report::VoyageReport;
use insd_languages::Language;
use insd_simulator::{Scenario, simulate};
use insd_tests::feed::{Encoding, noise};
use insd_tests::recorded::{Recorded, alert};
use tempfile::TempDir;

/// Four minutes under way: a minute of zigzag, straight on, half a minute without GNSS.
const VOYAGE: &str = r#"
name = "short"
description = "four minutes"
mode = "underway"
[start]
lat_deg = 54.0
lon_deg = 179.99
height_m = 30.0
[[route.legs]]
heading_deg = 60.0
speed_kn = 12.0
duration_s = 60.0
[[route.legs]]
heading_deg = 120.0
speed_kn = 12.0
duration_s = 60.0
turn_rate_deg_s = 3.0
[[route.legs]]
heading_deg = 90.0
speed_kn = 12.0
duration_s = 120.0
turn_rate_deg_s = 3.0
[sea]
state = 4
from_deg = 250.0
[imu]
grade = "navigation"
[gnss]
[[gnss.outages]]
when = { at_s = [150.0] }
duration_s = 30.0
[log]
"#;

/// A port whose name tries to be a script.
const MORE: &str = r#"
[[output]]
name = "<script>alert(1)</script>"
profile = "ecdis"
simulated = true
destination = { kind = "file", path = "/var/lib/insd/ecdis" }
"#;

const HEADINGS: [&str; 15] = [
    "Key figures",
    "Modes",
    "Track",
    "Attitude and motion",
    "Errors claimed",
    "Whom she believed",
    "Aids used and rejected",
    "Alerts",
    "Ports and sensors",
    "Sources",
    "Time",
    "Outputs",
    "Events",
    "Recording",
    "Configuration",
];

fn voyage(encodings: &[Encoding], more: &str) -> Recorded {
    let voyage = simulate(&Scenario::from_toml(VOYAGE).unwrap(), 1);
    Recorded::new(&voyage, encodings, more)
}

/// A recording with everything that can go wrong on the way, and its page.
fn eventful() -> &'static (TempDir, String) {
    static MADE: OnceLock<(TempDir, String)> = OnceLock::new();
    MADE.get_or_init(|| {
        let mut recorded = voyage(&[Encoding::Sbg, Encoding::Ubx, Encoding::Vbw], MORE);
        recorded.silence(0, 200.0, 212.0);
        recorded.acknowledge(209.0, alert(3062));
        let reason = "<img src=x onerror=alert(1)>".to_owned();
        recorded.state(190.0, 2, PortState::Lost { reason });
        recorded.insert(195.0, 2, Input::Bytes(noise(1, 60)));
        let folder = tempfile::tempdir().unwrap();
        recorded.write(&folder.path().join("recording"));
        let page = page(&folder.path().join("recording"));
        (folder, page)
    })
}

fn page(recording: &Path) -> String {
    VoyageReport::of_recording(recording, None, 1).unwrap().html(Language::English)
}

fn file_of(folder: &Path) -> PathBuf {
    fs::read_dir(folder).unwrap().next().unwrap().unwrap().path()
}

/// The part of a page under a heading.
fn section<'a>(page: &'a str, heading: &str) -> &'a str {
    let (_, rest) = page.split_once(&format!("<h2>{heading}</h2>")).unwrap();
    rest.split_once("</section>").unwrap().0
}

/// What must hold of every page.
fn assert_sound(page: &str) {
    for heading in HEADINGS {
        assert!(!section(page, heading).trim().is_empty(), "{heading} is empty");
    }
    for word in ["NaN", "inf ", "inf\"", "inf<", "-inf", "http:", "https:", "<script", "<img"] {
        assert!(!page.contains(word), "{word} in the page");
    }
    for tag in ["svg", "table", "figure", "section", "g", "rect"] {
        let opened =
            page.matches(&format!("<{tag} ")).count() + page.matches(&format!("<{tag}>")).count();
        let closed = page.matches(&format!("</{tag}>")).count();
        let own = if tag == "rect" { opened.max(closed) } else { closed };
        assert_eq!(opened, own, "{tag}");
    }
    assert!(page.starts_with("<!DOCTYPE html>") && page.ends_with("</html>\n"));
}

#[test]
fn a_report_has_all_sections_and_needs_nothing_else() {
    let (_, page) = eventful();
    assert_sound(page);
    assert!(page.contains("<h1>recording</h1>"));
    assert!(page.contains(&format!("Recorded by insd {}", env!("CARGO_PKG_VERSION"))));
    assert!(section(page, "Configuration").contains("[[sensor]]"));
    assert!(section(page, "Track").contains("179°") && section(page, "Track").contains("W"));
}

#[test]
fn what_happened_is_in_its_section() {
    let (_, page) = eventful();
    let modes = section(page, "Modes");
    assert!(modes.contains("it is known which way is down"), "{modes}");
    assert!(modes.contains("GNSS is not used any more"), "{modes}");
    let alerts = section(page, "Alerts");
    assert!(alerts.contains("3062 System fault") && alerts.contains("10006 Simulated data"));
    assert!(section(page, "Aids used and rejected").contains("GNSS position"));
    assert!(section(page, "Events").contains("12.000 s of IMU data were missing"));
    assert!(section(page, "Recording").contains("The recording is whole."));
    assert!(section(page, "Outputs").contains("GGA"));
}

#[test]
fn names_and_reasons_from_outside_stay_text() {
    let (_, page) = eventful();
    assert!(section(page, "Outputs").contains("&lt;script&gt;alert(1)&lt;/script&gt;"));
    assert!(section(page, "Events").contains("&lt;img src=x onerror=alert(1)&gt;"));
}

#[test]
fn the_same_recording_gives_the_same_page_wherever_it_lies() {
    let (folder, page) = eventful();
    let elsewhere = tempfile::tempdir().unwrap();
    let copy = elsewhere.path().join("recording");
    fs::create_dir(&copy).unwrap();
    let file = file_of(&folder.path().join("recording"));
    fs::copy(&file, copy.join(file.file_name().unwrap())).unwrap();
    assert!(self::page(&copy) == *page, "another page");
}

#[test]
fn a_damaged_recording_gives_a_report_that_says_what_is_missing() {
    let (folder, _) = eventful();
    let file = file_of(&folder.path().join("recording"));
    let mut bytes = fs::read(&file).unwrap();
    let third = bytes.len() / 3;
    bytes[third..third + 20_000].fill(0xA5);
    bytes.truncate(third * 2 + 7);
    let damaged = tempfile::tempdir().unwrap();
    let path = damaged.path().join("damaged-000001.insdraw");
    fs::write(&path, bytes).unwrap();
    let page = page(&path);
    assert_sound(&page);
    assert!(page.contains("The recording is not whole"));
    let recording = section(&page, "Recording");
    for words in ["damaged bytes at byte", "records are missing before", "ends within the block"] {
        assert!(recording.contains(words), "{words}: {recording}");
    }
    assert!(!page.contains(&damaged.path().display().to_string()), "a folder's name in the page");
}

#[test]
fn what_is_not_known_is_said_to_be_so() {
    // an IMU that knows no UTC, nothing to write to: no position, no heave, no alerts
    let mut recorded = voyage(&[Encoding::Mip], "");
    recorded.arrivals.truncate(3000);
    let folder = tempfile::tempdir().unwrap();
    recorded.write(folder.path());
    let page = page(folder.path());
    assert_sound(&page);
    assert!(section(&page, "Track").contains("not known"));
    assert!(section(&page, "Alerts").contains("not known: alerts are kept where there is a port"));
    assert!(section(&page, "Key figures").matches("not known").count() > 8);
    assert!(page.contains("since the start of the recording, as UTC is not known"));
}

#[test]
fn a_recording_without_arrivals_is_refused() {
    let (folder, _) = eventful();
    let mut bytes = fs::read(file_of(&folder.path().join("recording"))).unwrap();
    // magic, version, length of the body: `docs/recording.md`
    let body = u32::from_le_bytes(bytes[12..16].try_into().unwrap());
    bytes.truncate(20 + body as usize);
    for (bytes, words) in [(bytes, "no arrivals in it"), (Vec::new(), "empty")] {
        let empty = tempfile::tempdir().unwrap();
        let path = empty.path().join("none-000001.insdraw");
        fs::write(&path, bytes).unwrap();
        let fault = VoyageReport::of_recording(&path, None, 1).unwrap_err();
        assert!(fault.is::<insd_config::BadInput>(), "{fault:?}");
        assert!(fault.to_string().contains(words), "{fault}");
    }
}

/// English words in headings, heads of tables, captions and notes of a page.
fn english_in_its_frame(page: &str) -> Vec<String> {
    let framed = ["h2>", "h3>", "th>", "th ", "b>", "p class=\"note\"", "p class=\"unknown\""];
    let texts = page.split('<').filter(|own| framed.iter().any(|tag| own.starts_with(tag)));
    let texts = texts.filter_map(|own| Some(own.split_once('>')?.1));
    let words = texts.flat_map(|text| text.split(|c: char| !c.is_ascii_lowercase()));
    words.filter(|word| word.len() > 2).map(str::to_owned).collect()
}

#[test]
fn the_page_is_japanese_where_that_is_asked_for_and_holds_the_same() {
    let (folder, english) = eventful();
    let recording = folder.path().join("recording");
    let report = VoyageReport::of_recording(&recording, None, 1).unwrap();
    assert_eq!(report.language(), Language::English);
    let japanese = report.html(Language::Japanese);
    for text in ["<html lang=\"ja\">", "<h2>主要諸元</h2>", "装置異常", "測位", "不明"]
    {
        assert!(japanese.contains(text), "{text}");
    }
    for tag in ["<td", "<svg", "<rect", "<p", "<tr", "<path"] {
        assert_eq!(japanese.matches(tag).count(), english.matches(tag).count(), "{tag}");
    }
    assert!(!english_in_its_frame(english).is_empty());
    assert_eq!(english_in_its_frame(&japanese), Vec::<String>::new());
    assert!(!japanese.contains("<img") && japanese.contains("&lt;img src=x"));
}
