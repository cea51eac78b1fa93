//! GNSS receivers.

use insd_base::{FixQuality, GnssFix, Voyage};
use insd_wire::gnss::GnssEpoch;
use insd_wire::gnss::sbf::{PosCovGeodetic, PvtGeodetic, VelCovGeodetic};
use insd_wire::gnss::ubx::{NavCov, NavPvt};
use insd_wire::nmea::{
    Gga, Gst, NmeaLine as Sentence, Position, PositionMode, Rmc, Talker, Vtg, Zda,
};

use super::calendar::Calendar;
use super::line::Line;
use super::sensor::{Encoding, SensorFeed};

/// Height of the geoid above the ellipsoid, m.
const UNDULATION: f64 = 36.0;
/// GPS - UTC, s, in 2026.
const LEAP_SECONDS: i8 = 18;

pub(super) fn encode(voyage: &Voyage, sensor: &SensorFeed, line: &mut Line) {
    for stamped in &voyage.gnss {
        let fix = &stamped.message;
        let epoch = epoch(fix, &sensor.calendar);
        match sensor.encoding {
            Encoding::Sbf => {
                line.send(fix.time, &PvtGeodetic::of(&epoch).write());
                line.send(fix.time, &PosCovGeodetic::of(&epoch).write());
                line.send(fix.time, &VelCovGeodetic::of(&epoch).write());
            }
            Encoding::NmeaGnss => {
                for sentence in sentences(fix, &epoch, &sensor.calendar) {
                    line.send(fix.time, sentence.as_bytes());
                }
            }
            _ => {
                line.send(fix.time, &pvt(fix, &epoch, &sensor.calendar).write());
                line.send(fix.time, &NavCov::of(&epoch).write());
            }
        }
    }
}

fn epoch(fix: &GnssFix, calendar: &Calendar) -> GnssEpoch {
    let sigma = |std: Option<insd_base::Ned>| std.map_or([0.0; 3], |std| std.0.into());
    GnssEpoch {
        time: calendar.told_gps(fix.time),
        leap_seconds: LEAP_SECONDS,
        time_std: 3e-8,
        position: fix.position.unwrap_or_default(),
        position_std: sigma(fix.position_std),
        undulation: UNDULATION,
        velocity: fix.velocity.unwrap_or_default().0.into(),
        velocity_std: sigma(fix.velocity_std),
        satellites: fix.satellites.and_then(|count| u8::try_from(count).ok()).unwrap_or(0),
        pdop: fix.hdop.unwrap_or(9.9) * 1.5,
        hdop: fix.hdop.unwrap_or(9.9),
        quality: fix.quality,
    }
}

fn pvt(fix: &GnssFix, epoch: &GnssEpoch, calendar: &Calendar) -> NavPvt {
    let mut pvt = NavPvt::of(epoch);
    let civil = calendar.civil(fix.time);
    pvt.time.date = civil.date;
    pvt.time.clock = (civil.time.hour, civil.time.minute, civil.time.second);
    pvt.time.nanosecond = civil.time.nanosecond as i32;
    pvt
}

fn sentences(fix: &GnssFix, epoch: &GnssEpoch, calendar: &Calendar) -> [Sentence; 5] {
    let civil = calendar.civil(fix.time);
    let [north, east, up] = epoch.position_std.map(Some);
    let place = fix.position.map(|at| Position { latitude: at.latitude, longitude: at.longitude });
    let fixed = fix.quality != FixQuality::Invalid;
    let mode = if fixed { PositionMode::Differential } else { PositionMode::NotValid };
    let (speed, course) = (Some(epoch.ground_speed()), Some(epoch.course()));
    let gga = Gga {
        time: Some(civil.time),
        position: place,
        quality: fix.quality,
        satellites: Some(epoch.satellites),
        hdop: fix.hdop,
        altitude: fix.position.map(|at| at.height - UNDULATION),
        geoid_separation: Some(UNDULATION),
        ..Gga::default()
    };
    let gst = Gst {
        time: Some(civil.time),
        latitude_std: north,
        longitude_std: east,
        altitude_std: up,
        ..Gst::default()
    };
    let vtg = Vtg { course, course_magnetic: None, speed, mode: Some(mode) };
    let rmc = Rmc {
        time: Some(civil.time),
        valid: fixed,
        position: place,
        speed,
        course,
        date: Some(civil.date),
        mode: Some(mode),
        ..Rmc::default()
    };
    let zda = Zda { utc: Some(civil), zone: None };
    let talker = Talker::GN;
    [gga.write(talker), gst.write(talker), vtg.write(talker), zda.write(talker), rmc.write(talker)]
}
