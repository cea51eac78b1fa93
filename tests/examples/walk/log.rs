//! The log of the receiver, and the records of the IMU.

use std::error::Error;
use std::fs;
use std::io::Read;
use std::path::Path;

use flate2::read::GzDecoder;
use insd_base::{
    Body, BroadcastRecord, Constellation, GpsTime, ImuSample, IonosphereModel, SatelliteEpoch,
    Stamped, Time, earth,
};
use insd_wire::gnss::Locks;
use insd_wire::gnss::navigation::{Broadcast, NavigationAssembler};
use insd_wire::gnss::ubx::UbxMessage;
use insd_wire::stream::{Cutter, Protocol};

/// GPS week of the walk.
pub(crate) const WEEK: u16 = 2381;
/// Start of the voyage that is made of it, seconds of that week.
pub(crate) const START: i64 = 408_640;
/// The same in UTC.
pub(crate) const START_UTC: &str = "2025-08-28T17:30:22Z";
/// What the times of the file of the filtered IMU are ahead of seconds of the week.
const COUNTED_AHEAD: f64 = 1_755_993_600.0;
/// The acceleration that the IMU's data sheet calls one g, m/s^2.
const STANDARD_GRAVITY: f64 = 9.806_65;

/// Pairs of north and east, each with its seconds of the voyage.
pub(crate) type Instants = Vec<(f64, [f64; 2])>;

/// What the receiver told.
#[derive(Default)]
pub(crate) struct Heard {
    pub(crate) epochs: Vec<SatelliteEpoch>,
    pub(crate) records: Vec<BroadcastRecord>,
    pub(crate) ionosphere: Vec<(Constellation, IonosphereModel)>,
}

/// An instant of the voyage in GPS time.
pub(crate) fn start() -> GpsTime {
    GpsTime::from_week(WEEK, START * 1_000_000_000)
}

/// Reads the log of the receiver.
pub(crate) fn hear(folder: &Path) -> Result<Heard, Box<dyn Error>> {
    let bytes = unpacked(&folder.join("gnss_1730.ubx.gz"))?;
    let mut heard = Heard::default();
    let (mut cutter, mut locks) = (Cutter::new(&[Protocol::Ubx, Protocol::Nmea]), Locks::new());
    let mut assembler = NavigationAssembler::new();
    let mut now = start();
    cutter.push(&bytes);
    while let Some(cut) = cutter.cut() {
        if cut.protocol != Protocol::Ubx {
            continue;
        }
        match UbxMessage::read(cut.bytes) {
            Ok(UbxMessage::RxmRawx(raw)) => {
                let mut epoch = raw.epoch().ok_or("an epoch without a time")?;
                locks.mark(&mut epoch);
                now = epoch.tag;
                heard.epochs.push(epoch);
            }
            Ok(UbxMessage::RxmSfrbx(raw)) => {
                let Some(words) = raw.navigation() else { continue };
                let told = assembler.take(&words, now).map_err(|refusal| refusal.to_string())?;
                told.into_iter().for_each(|told| heard.note(told));
            }
            _ => {}
        }
    }
    heard.epochs.retain(|epoch| epoch.tag >= start());
    Ok(heard)
}

impl Heard {
    fn note(&mut self, told: Broadcast) {
        match told {
            Broadcast::Record(record) => self.records.push(record),
            Broadcast::Ionosphere(model) => {
                let whose = match model {
                    IonosphereModel::Klobuchar { .. } => Constellation::Gps,
                    IonosphereModel::NeQuickG { .. } => Constellation::Galileo,
                };
                self.ionosphere.retain(|(own, _)| *own != whose);
                self.ionosphere.push((whose, model));
            }
            Broadcast::LeapSeconds(_) => {}
        }
    }
}

/// Samples of the IMU as they were taken, at the times that their publisher worked out for them. The mounting is the published one: a half turn about the
/// first axis, then a quarter turn to port about the third.
pub(crate) fn imu(folder: &Path) -> Result<Vec<Stamped<ImuSample>>, Box<dyn Error>> {
    let raw = String::from_utf8(unpacked(&folder.join("imu_1730.csv.gz"))?)?;
    let dated = String::from_utf8(unpacked(&folder.join("imu_1730_sf.csv.gz"))?)?;
    let mut samples = Vec::new();
    let mut before: Option<f64> = None;
    // the first line of the raw file is cut
    for (raw, dated) in raw.lines().skip(1).zip(dated.lines()) {
        let raw = numbers(raw)?;
        let [ax, ay, az, gx, gy, gz, ..] = raw[..] else { return Err("a short row".into()) };
        let time = numbers(dated)?.first().ok_or("an empty row")? - COUNTED_AHEAD - START as f64;
        let interval = before.map_or(1.0 / RATE, |before| time - before);
        before = Some(time);
        let speed = STANDARD_GRAVITY * interval;
        let angle = interval.to_radians();
        let message = ImuSample {
            time: Time::from_seconds(time),
            delta_theta: Body::new(-gy * angle, -gx * angle, -gz * angle),
            delta_velocity: Body::new(-ay * speed, -ax * speed, -az * speed),
        };
        samples.push(Stamped { message, arrival: None });
    }
    Ok(samples)
}

/// Samples a second.
pub(crate) const RATE: f64 = 152.0;

fn numbers(row: &str) -> Result<Vec<f64>, Box<dyn Error>> {
    Ok(row.split(',').map(str::parse).collect::<Result<_, _>>()?)
}

/// Where the receiver with its corrections was, metres north and east of its first place: seconds of the voyage, and both.
pub(crate) fn reference(folder: &Path) -> Result<Instants, Box<dyn Error>> {
    let mut reader = csv::Reader::from_path(folder.join("reference.csv"))?;
    let head = reader.headers()?.clone();
    let mut rows = Vec::new();
    for row in reader.records() {
        let row = row?;
        let value = |name: &str| -> Result<f64, Box<dyn Error>> {
            let column = head.iter().position(|own| own == name);
            Ok(row[column.ok_or(format!("reference.csv: no {name}"))?].parse()?)
        };
        let seconds = value("tow_s")? - START as f64;
        rows.push((seconds, [value("lat_deg")?, value("lon_deg")?]));
    }
    let first = rows.first().ok_or("reference.csv: no rows")?.1;
    Ok(rows.into_iter().map(|(seconds, place)| (seconds, metres(first, place))).collect())
}

/// Metres north and east from one place, degrees, to another near by.
pub(crate) fn metres([latitude, longitude]: [f64; 2], to: [f64; 2]) -> [f64; 2] {
    let (meridian, normal) = earth::radii(latitude.to_radians());
    let north = (to[0] - latitude).to_radians() * (meridian + HEIGHT);
    let east = (to[1] - longitude).to_radians() * (normal + HEIGHT) * latitude.to_radians().cos();
    [north, east]
}

/// Height of the garden, m.
const HEIGHT: f64 = 1580.0;

fn unpacked(path: &Path) -> Result<Vec<u8>, Box<dyn Error>> {
    let bytes = fs::read(path).map_err(|error| format!("{}: {error}", path.display()))?;
    let mut text = Vec::new();
    GzDecoder::new(bytes.as_slice()).read_to_end(&mut text)?;
    Ok(text)
}
