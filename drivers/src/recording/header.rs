//! `voyage.toml`: raw TOML to checked values, all faults reported together with their place.

use std::fs::File;
use std::io::Read;
use std::ops::{Range, RangeInclusive};
use std::path::Path;

use insd_base::{
    Body, Geodetic, ImuSpec, LeverArms, StartCondition, Triad, VesselKind, VoyageHeader,
};
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::error::RecordingError;

/// Name of the file in a voyage directory.
pub(super) const FILE_NAME: &str = "voyage.toml";
/// Longest file that is read, bytes.
const MAX_LENGTH: u64 = 1 << 20;
/// Longest lever arm, m.
const MAX_LEVER_ARM: f64 = 1000.0;
const SIGMA: RangeInclusive<f64> = 0.0..=1e12;
const TIME_CONSTANT: RangeInclusive<f64> = 1e-3..=1e12;

/// Reads the `voyage.toml` of a voyage directory.
///
/// Keys that the format does not know are ignored, as it may grow.
///
/// # Errors
/// The file is missing, is not TOML, lacks required keys, or holds values of the wrong type or out
/// of range.
pub fn read_header(dir: &Path) -> Result<VoyageHeader, RecordingError> {
    let file = dir.join(FILE_NAME);
    if !file.is_file() {
        return Err(RecordingError::Missing { file, or_compressed: false });
    }
    let mut bytes = Vec::new();
    let opened = File::open(&file).and_then(|f| f.take(MAX_LENGTH).read_to_end(&mut bytes));
    if let Err(source) = opened {
        return Err(RecordingError::Read { file, line: 0, source });
    }
    let Ok(text) = String::from_utf8(bytes) else {
        return Err(RecordingError::Toml { file, message: "not UTF-8 text".to_owned() });
    };
    parse_header(&file, &text)
}

/// Parses the text of a `voyage.toml`; `file` is for messages.
pub(super) fn parse_header(file: &Path, text: &str) -> Result<VoyageHeader, RecordingError> {
    let root = DeTable::parse(text).map_err(|fault| RecordingError::Toml {
        file: file.to_owned(),
        message: fault.to_string(),
    })?;
    let mut faults = Vec::new();
    let root = Section { name: "", table: root.get_ref(), at: 0..0, text };
    let header = header(&root, &mut faults);
    match header {
        Some(header) if faults.is_empty() => Ok(header),
        _ => {
            let name = file.display();
            let faults = faults.iter().map(|fault| format!("  {name}:{fault}")).collect();
            Err(RecordingError::Header { file: file.to_owned(), faults })
        }
    }
}

fn header(root: &Section<'_, '_>, faults: &mut Vec<String>) -> Option<VoyageHeader> {
    // every part is read before any is judged, so that all faults are found
    let start_utc = start_utc(root, faults);
    let start = start_condition(root, faults);
    let initial = root.section("initial", faults).map(|section| initial(&section, faults));
    let imu = match root.section("imu", faults) {
        Some(section) => imu(&section, faults),
        None => {
            if root.get("imu").is_none() {
                faults.push("1: missing section [imu]".to_owned());
            }
            None
        }
    };
    let ship = root.section("ship", faults);
    let vessel = ship.as_ref().and_then(|section| vessel(section, faults));
    let time_std = ship.and_then(|section| time_std(&section, faults));
    let arms = root.section("lever_arms_m", faults);
    let lever_arms = arms.map(|section| LeverArms {
        gnss: section.lever_arm("gnss", faults),
        log: section.lever_arm("log", faults),
    });
    Some(VoyageHeader {
        start_utc: start_utc?,
        start: start?,
        initial: initial.flatten(),
        imu: imu?,
        lever_arms: lever_arms.unwrap_or_default(),
        vessel: vessel.unwrap_or_default(),
        time_std,
    })
}

fn vessel(section: &Section<'_, '_>, faults: &mut Vec<String>) -> Option<VesselKind> {
    section.get("kind")?;
    let kind = VesselKind::of_word(&section.word("kind", faults)?);
    if kind.is_none() {
        faults.push(section.fault("kind", "expected \"ship\", \"boat\" or \"car\""));
    }
    kind
}

fn time_std(section: &Section<'_, '_>, faults: &mut Vec<String>) -> Option<f64> {
    section.get("gnss_delay_std_s")?;
    section.number("gnss_delay_std_s", 1e-9..=1.0, faults)
}

fn start_utc(root: &Section<'_, '_>, faults: &mut Vec<String>) -> Option<String> {
    let word = root.word("start_utc", faults)?;
    if word.parse::<jiff::Timestamp>().is_err() {
        let expected = "expected a UTC time such as \"2026-01-01T00:00:00Z\"";
        faults.push(root.fault("start_utc", expected));
    }
    Some(word)
}

fn start_condition(root: &Section<'_, '_>, faults: &mut Vec<String>) -> Option<StartCondition> {
    match root.word("mode", faults)?.as_str() {
        "moored" => Some(StartCondition::Moored),
        "underway" => Some(StartCondition::Underway),
        _ => {
            faults.push(root.fault("mode", "expected \"moored\" or \"underway\""));
            None
        }
    }
}

fn initial(section: &Section<'_, '_>, faults: &mut Vec<String>) -> Option<Geodetic> {
    let latitude = section.number("lat_deg", -90.0..=90.0, faults);
    let longitude = section.number("lon_deg", -180.0..=180.0, faults);
    let height = section.number("height_m", -12_000.0..=100_000.0, faults);
    Some(Geodetic::from_degrees(latitude?, longitude?, height?))
}

fn imu(section: &Section<'_, '_>, faults: &mut Vec<String>) -> Option<ImuSpec> {
    let mut number = |key, range| section.number(key, range, faults);
    let rate = number("rate_hz", 1.0..=10_000.0);
    let gyro_bias = number("gyro_bias_std_deg_h", SIGMA);
    let gyro_instability = number("gyro_bias_instability_deg_h", SIGMA);
    let gyro_time = number("gyro_bias_time_constant_s", TIME_CONSTANT);
    let angle_random_walk = number("angle_random_walk_deg_sqrt_h", SIGMA);
    let gyro_scale = number("gyro_scale_factor_std_ppm", SIGMA);
    let accel_bias = number("accel_bias_std_ug", SIGMA);
    let accel_instability = number("accel_bias_instability_ug", SIGMA);
    let accel_time = number("accel_bias_time_constant_s", TIME_CONSTANT);
    let velocity_random_walk = number("velocity_random_walk_mps_sqrt_h", SIGMA);
    let accel_scale = number("accel_scale_factor_std_ppm", SIGMA);
    Some(ImuSpec {
        rate: rate?,
        gyro: Triad::of_gyros([
            gyro_bias?,
            gyro_instability?,
            gyro_time?,
            angle_random_walk?,
            gyro_scale?,
        ]),
        accel: Triad::of_accelerometers([
            accel_bias?,
            accel_instability?,
            accel_time?,
            velocity_random_walk?,
            accel_scale?,
        ]),
    })
}

/// One table of the file, and where it stands in the text.
struct Section<'a, 'i> {
    name: &'a str,
    table: &'a DeTable<'i>,
    at: Range<usize>,
    text: &'a str,
}

impl<'a, 'i> Section<'a, 'i> {
    fn get(&self, key: &str) -> Option<&'a Spanned<DeValue<'i>>> {
        self.table.iter().find(|(name, _)| name.get_ref() == key).map(|(_, value)| value)
    }

    /// A table in this one; `None` if it is not there or is no table.
    fn section(&self, name: &'a str, faults: &mut Vec<String>) -> Option<Section<'a, 'i>> {
        let value = self.get(name)?;
        let Some(table) = value.get_ref().as_table() else {
            faults.push(self.fault(name, "expected a section"));
            return None;
        };
        Some(Section { name, table, at: value.span(), text: self.text })
    }

    /// A required text.
    fn word(&self, key: &str, faults: &mut Vec<String>) -> Option<String> {
        let word = self.get(key).and_then(|value| value.get_ref().as_str());
        if word.is_none() {
            faults.push(self.fault(key, "expected a text in quotes"));
        }
        word.map(str::to_owned)
    }

    /// A required number in a range.
    fn number(
        &self,
        key: &str,
        range: RangeInclusive<f64>,
        faults: &mut Vec<String>,
    ) -> Option<f64> {
        let number = self.get(key).and_then(|value| as_number(value.get_ref()));
        let valid = number.filter(|number| range.contains(number));
        if valid.is_none() {
            let (from, to) = (range.start(), range.end());
            faults.push(self.fault(key, &format!("expected a number from {from} to {to}")));
        }
        valid
    }

    /// An optional lever arm, zero if it is not there.
    fn lever_arm(&self, key: &str, faults: &mut Vec<String>) -> Body {
        let Some(value) = self.get(key) else { return Body::default() };
        let numbers: Vec<f64> = match value.get_ref().as_array() {
            Some(array) => array.iter().filter_map(|item| as_number(item.get_ref())).collect(),
            None => Vec::new(),
        };
        let is_sound = value.get_ref().as_array().is_some_and(|array| array.len() == 3)
            && numbers.len() == 3
            && numbers.iter().all(|number| number.abs() <= MAX_LEVER_ARM);
        if is_sound {
            return Body::new(numbers[0], numbers[1], numbers[2]);
        }
        let expected = "expected [forward, starboard, down] in m, each within +-1000";
        faults.push(self.fault(key, expected));
        Body::default()
    }

    /// `line:column: key: what was expected`, with the line and a caret below its value; for a
    /// missing key the place of the section.
    fn fault(&self, key: &str, expected: &str) -> String {
        let dot = if self.name.is_empty() { "" } else { "." };
        let Some(value) = self.get(key) else {
            let (line, column, _) = place(self.text, self.at.start);
            return format!("{line}:{column}: missing key {}{dot}{key}: {expected}", self.name);
        };
        let (line, column, source) = place(self.text, value.span().start);
        let number = line.to_string();
        let (margin, indent) = (" ".repeat(number.len()), " ".repeat(column - 1));
        format!(
            "{line}:{column}: {}{dot}{key}: {expected}\n  {number} | {source}\n  {margin} | {indent}^",
            self.name
        )
    }
}

/// Line, column (both from 1, columns in characters) and text of the line at a byte of a text.
fn place(text: &str, byte: usize) -> (usize, usize, &str) {
    let before = text.get(..byte).unwrap_or(text);
    let start = before.rfind('\n').map_or(0, |end| end + 1);
    let line = before.matches('\n').count() + 1;
    let column = before[start..].chars().count() + 1;
    (line, column, text[start..].lines().next().unwrap_or(""))
}

/// A finite number; whole numbers serve as well.
fn as_number(value: &DeValue<'_>) -> Option<f64> {
    let number = match value {
        DeValue::Float(float) => float.as_str().parse::<f64>().ok()?,
        DeValue::Integer(integer) if integer.radix() == 10 => integer.as_str().parse().ok()?,
        _ => return None,
    };
    number.is_finite().then_some(number)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::recording::header_text::header_text;
    use insd_base::units::DEG_PER_HOUR;
    use proptest::prelude::*;

    const CAR: &str = r#"# Recorded on a car
start_utc = "2025-07-08T19:34:18Z"
mode = "underway"
future_key = true
[imu]
rate_hz = 100
gyro_bias_std_deg_h = 1000.0
gyro_bias_instability_deg_h = 20.0
gyro_bias_time_constant_s = 300.0
angle_random_walk_deg_sqrt_h = 0.3
gyro_scale_factor_std_ppm = 3000.0
accel_bias_std_ug = 20000.0
accel_bias_instability_ug = 200.0
accel_bias_time_constant_s = 300.0
velocity_random_walk_mps_sqrt_h = 0.15
accel_scale_factor_std_ppm = 3000.0
"#;

    fn parse(text: &str) -> Result<VoyageHeader, RecordingError> {
        parse_header(Path::new("voyage.toml"), text)
    }

    #[test]
    fn comments_unknown_keys_and_absent_optional_sections_are_fine() {
        let header = parse(CAR).unwrap();
        assert_eq!(header.start, StartCondition::Underway);
        assert_eq!(header.initial, None);
        assert_eq!(header.lever_arms, LeverArms::default());
        assert!((header.imu.gyro.bias_std - 1000.0 * DEG_PER_HOUR).abs() < 1e-18);
        assert_eq!(header.imu.rate, 100.0);
    }

    #[test]
    fn a_written_header_reads_back() {
        let with_all = format!(
            "{CAR}[lever_arms_m]\ngnss=[1, -2.5, 3]\n[initial]\nlat_deg=-33.1\nlon_deg=151.2\nheight_m=0\n"
        );
        let header = parse(&with_all).unwrap();
        let back = parse(&header_text(&header)).unwrap();
        assert_eq!(header.initial, back.initial);
        assert_eq!(header.lever_arms, back.lever_arms);
        assert!((header.imu.accel.random_walk / back.imu.accel.random_walk - 1.0).abs() < 1e-12);
    }

    #[test]
    fn all_faults_are_told_together_each_with_its_place() {
        let text = CAR
            .replace("\"underway\"", "\"anchored\"")
            .replace("rate_hz = 100", "rate_hz = \"fast\"")
            .replace("accel_bias_std_ug = 20000.0", "")
            .replace("gyro_bias_time_constant_s = 300.0", "gyro_bias_time_constant_s = -1");
        let message = parse(&text).unwrap_err().to_string();
        assert!(message.contains("voyage.toml:3:8: mode"), "{message}");
        assert!(message.contains("voyage.toml:6:11: imu.rate_hz"), "{message}");
        assert!(message.contains("9:29: imu.gyro_bias_time_constant_s"), "{message}");
        assert!(message.contains("missing key imu.accel_bias_std_ug"), "{message}");
        assert!(message.contains("4 faults"), "{message}");
    }

    #[test]
    fn broken_toml_is_shown_with_line_and_caret() {
        let message = parse("start_utc = \n").unwrap_err().to_string();
        assert!(message.contains("line 1") && message.contains('^'), "{message}");
    }

    proptest! {
        #[test]
        fn no_text_makes_the_parser_panic(text in ".{0,300}") {
            let _ = parse(&text);
        }

        #[test]
        fn no_change_of_a_sound_header_makes_the_parser_panic(
            at in 0..CAR.len(), length in 0..40_usize, insert in "[\\[\\]\"=a-z0-9é.\n-]{0,8}",
        ) {
            let end = (at + length).min(CAR.len());
            let _ = parse(&format!("{}{insert}{}", &CAR[..at], &CAR[end..]));
        }
    }
}
