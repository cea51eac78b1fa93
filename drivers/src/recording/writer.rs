//! A voyage in memory as a directory of the exchange format.

use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::Path;

use insd_base::{
    ExternalReference, GnssFix, ImuSample, LogReference, LogVelocity, Ned, Stamped, Time, Truth,
    Voyage,
};

use super::error::RecordingError;
use super::header::FILE_NAME;
use super::header_text::header_text;
use super::input::compressed_form;
use super::number::{Zeros, push_fixed, push_time};
use super::table::Row;

/// Decimal places of angles in degrees: 1e-11 deg is a micrometre.
const DEGREES: usize = 11;
/// Decimal places of metres and metres per second.
const METRES: usize = 9;
/// Decimal places of angle increments, rad.
const DELTA_THETA: usize = 12;
/// Decimal places of velocity increments, m/s.
const DELTA_VELOCITY: usize = 11;
/// zstd's own default.
const LEVEL: i32 = 3;

/// How the large files, `imu.csv`, `truth.csv`, those of raw GNSS and of a camera, are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Compression {
    /// As text.
    #[default]
    None,
    /// As `NAME.csv.zst`.
    Zstd,
}

/// Writes a voyage directory, making it if need be. Sensors without messages get no file; files of
/// an older voyage in the same directory are removed.
///
/// Angles keep 11 decimal places of a degree, velocities 9 of a metre per second, increments 12 of
/// a radian and 11 of a metre per second, times all nanoseconds.
///
/// # Errors
/// The directory or a file cannot be written.
pub fn write_voyage(
    dir: &Path,
    voyage: &Voyage,
    compression: Compression,
) -> Result<(), RecordingError> {
    guard(dir, fs::create_dir_all(dir))?;
    for name in ["imu.csv", "gnss.csv", "log.csv", "reference.csv", "truth.csv"] {
        remove_both(&dir.join(name))?;
    }
    let toml = dir.join(FILE_NAME);
    guard(&toml, fs::write(&toml, header_text(&voyage.header)))?;
    write_stamped(&dir.join("imu.csv"), &voyage.imu, compression, push_imu)?;
    write_stamped(&dir.join("gnss.csv"), &voyage.gnss, Compression::None, push_gnss)?;
    write_stamped(&dir.join("log.csv"), &voyage.log, Compression::None, push_log)?;
    let reference = &voyage.reference;
    write_stamped(&dir.join("reference.csv"), reference, Compression::None, push_reference)?;
    write_rows(&dir.join("truth.csv"), Truth::COLUMNS, &voyage.truth, compression, push_truth)
}

/// Removes a file of an older voyage, plain or compressed.
pub(super) fn remove_both(path: &Path) -> Result<(), RecordingError> {
    remove(path)?;
    remove(&compressed_form(path))
}

/// Removes a file, if it is there.
pub(super) fn remove(path: &Path) -> Result<(), RecordingError> {
    match fs::remove_file(path) {
        Err(fault) if fault.kind() != io::ErrorKind::NotFound => guard(path, Err(fault)),
        _ => Ok(()),
    }
}

/// What failed, with the file at which it did.
pub(super) fn guard<T>(path: &Path, result: io::Result<T>) -> Result<T, RecordingError> {
    result.map_err(|source| RecordingError::Write { file: path.to_owned(), source })
}

/// Writes the messages of one sensor, with `arrival_s` if any came late.
fn write_stamped<T>(
    path: &Path,
    rows: &[Stamped<T>],
    compression: Compression,
    push: impl Fn(&mut Line<'_>, &T),
) -> Result<(), RecordingError>
where
    Stamped<T>: Row,
{
    let is_late = rows.iter().any(|row| row.arrival.is_some());
    let columns = <Stamped<T> as Row>::COLUMNS;
    let columns = if is_late { columns } else { &columns[..columns.len() - 1] };
    write_rows(path, columns, rows, compression, |line, row| {
        push(line, &row.message);
        if is_late {
            line.time(row.arrival.unwrap_or(row.time()));
        }
    })
}

fn write_rows<T>(
    path: &Path,
    columns: &[&str],
    rows: &[T],
    compression: Compression,
    push: impl Fn(&mut Line<'_>, &T),
) -> Result<(), RecordingError> {
    if rows.is_empty() {
        return Ok(());
    }
    let write = |target: &mut dyn Write| -> io::Result<()> {
        writeln!(target, "{}", columns.join(","))?;
        let mut text = Vec::with_capacity(256);
        for row in rows {
            text.clear();
            push(&mut Line(&mut text), row);
            // every field begins with a comma
            target.write_all(&text[1..])?;
            target.write_all(b"\n")?;
        }
        Ok(())
    };
    guard(path, to_file(path, compression, write))
}

/// Writes a file, compressed or not.
pub(super) fn to_file(
    path: &Path,
    compression: Compression,
    write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> io::Result<()> {
    match compression {
        Compression::None => {
            let mut file = BufWriter::new(File::create(path)?);
            write(&mut file)?;
            file.flush()
        }
        Compression::Zstd => {
            let file = File::create(compressed_form(path))?;
            let mut encoder = BufWriter::new(zstd::stream::write::Encoder::new(file, LEVEL)?);
            write(&mut encoder)?;
            encoder.into_inner().map_err(io::IntoInnerError::into_error)?.finish().map(drop)
        }
    }
}

/// A row in the making: fields, each after a comma.
struct Line<'a>(&'a mut Vec<u8>);

impl Line<'_> {
    fn time(&mut self, time: Time) {
        self.0.push(b',');
        push_time(self.0, time);
    }

    fn number(&mut self, value: f64, places: usize) {
        self.0.push(b',');
        push_fixed(self.0, value, places, Zeros::Trimmed);
    }

    fn optional(&mut self, value: Option<f64>, places: usize) {
        self.number(value.unwrap_or(f64::NAN), places);
    }

    fn vector(&mut self, vector: Option<Ned>, places: usize) {
        for axis in 0..3 {
            self.optional(vector.map(|vector| vector.0[axis]), places);
        }
    }

    fn word(&mut self, word: &str) {
        self.0.push(b',');
        self.0.extend_from_slice(word.as_bytes());
    }
}

fn push_imu(line: &mut Line<'_>, sample: &ImuSample) {
    line.time(sample.time);
    for angle in &sample.delta_theta.0 {
        line.number(*angle, DELTA_THETA);
    }
    for velocity in &sample.delta_velocity.0 {
        line.number(*velocity, DELTA_VELOCITY);
    }
}

fn push_gnss(line: &mut Line<'_>, fix: &GnssFix) {
    line.time(fix.time);
    line.optional(fix.position.map(|p| p.latitude.to_degrees()), DEGREES);
    line.optional(fix.position.map(|p| p.longitude.to_degrees()), DEGREES);
    line.optional(fix.position.map(|p| told(p.height, fix.position_std)), METRES);
    let velocity = fix.velocity.map(|v| Ned::new(v.0.x, v.0.y, told(v.0.z, fix.velocity_std)));
    line.vector(velocity, METRES);
    line.vector(fix.position_std, METRES);
    line.vector(fix.velocity_std, METRES);
    line.optional(fix.hdop, METRES);
    line.optional(fix.satellites.map(f64::from), 0);
    line.number(f64::from(fix.quality.as_gga()), 0);
}

/// A vertical component; not a number, which is written as an empty field, if its sigma is infinite.
fn told(value: f64, std: Option<Ned>) -> f64 {
    if std.is_some_and(|std| std.0.z.is_infinite()) { f64::NAN } else { value }
}

fn push_log(line: &mut Line<'_>, velocity: &LogVelocity) {
    line.time(velocity.time);
    for value in [velocity.u, velocity.v, velocity.w, velocity.std] {
        line.optional(value, METRES);
    }
    line.word(match velocity.reference {
        LogReference::Bottom => "bottom",
        LogReference::Water => "water",
    });
}

fn push_reference(line: &mut Line<'_>, reference: &ExternalReference) {
    line.time(reference.time);
    line.optional(reference.v_north, METRES);
    line.optional(reference.v_east, METRES);
    line.optional(reference.position.map(|p| p.latitude.to_degrees()), DEGREES);
    line.optional(reference.position.map(|p| p.longitude.to_degrees()), DEGREES);
    line.optional(reference.heading.map(f64::to_degrees), DEGREES);
    line.optional(reference.velocity_std, METRES);
    line.optional(reference.position_std, METRES);
    line.optional(reference.heading_std.map(f64::to_degrees), DEGREES);
}

fn push_truth(line: &mut Line<'_>, truth: &Truth) {
    line.time(truth.time);
    line.number(truth.position.latitude.to_degrees(), DEGREES);
    line.number(truth.position.longitude.to_degrees(), DEGREES);
    line.number(truth.position.height, METRES);
    line.vector(truth.velocity, METRES);
    let attitude = truth.attitude.map(|a| Ned::new(a.roll, a.pitch, a.heading));
    line.vector(attitude.map(|Ned(angles)| Ned(angles.map(f64::to_degrees))), DEGREES);
}
