//! What sentences of NMEA 0183 say of an epoch.
//!
//! - A sentence that says of itself that it is not valid gives no position and no velocity.
//! - The height above the ellipsoid is altitude plus geoid separation. Where one is missing the
//!   position goes to [`GnssPart::horizontal`] without a height.
//! - Speed and course over ground are the horizontal velocity; its vertical part is unknown.
//! - The navigational status of GNS and RMC is not heeded: nearly all receivers send V.

use insd_base::{FixQuality, Geodetic};

use super::{EpochTime, GnssPart};
use crate::nmea::{
    CivilTime, Gga, Gll, Gns, Gsa, Gst, Hdt, HeadingMode, Position, PositionMode, Rmc, Sentence,
    Ths, TimeOfDay, Vtg, Zda,
};

/// The part of an epoch that a sentence tells, if it comes from a receiver. HDT and THS do not say
/// that they do: the caller must know it from the port.
#[must_use]
pub fn part(sentence: &Sentence) -> Option<GnssPart> {
    Some(match sentence {
        Sentence::Gga(gga) => of_gga(gga),
        Sentence::Gll(gll) => of_gll(gll),
        Sentence::Gns(gns) => of_gns(gns),
        Sentence::Gsa(gsa) => of_gsa(gsa),
        Sentence::Gst(gst) => of_gst(gst),
        Sentence::Hdt(hdt) => of_hdt(*hdt),
        Sentence::Rmc(rmc) => of_rmc(rmc),
        Sentence::Ths(ths) => of_ths(*ths),
        Sentence::Vtg(vtg) => of_vtg(vtg),
        Sentence::Zda(zda) => of_zda(zda),
        _ => return None,
    })
}

fn of_gga(gga: &Gga) -> GnssPart {
    let part = GnssPart {
        kind: Gga::FORMATTER,
        epoch: gga.time.map(EpochTime::TimeOfDay),
        hdop: gga.hdop,
        satellites: gga.satellites.map(u16::from),
        ..with_quality(gga.quality)
    };
    with_position(part, gga.position, gga.altitude.zip(gga.geoid_separation))
}

fn of_gns(gns: &Gns) -> GnssPart {
    let part = GnssPart {
        kind: Gns::FORMATTER,
        epoch: gns.time.map(EpochTime::TimeOfDay),
        hdop: gns.hdop,
        satellites: gns.satellites.map(u16::from),
        ..with_quality(gns.quality())
    };
    with_position(part, gns.position, gns.altitude.zip(gns.geoid_separation))
}

fn of_gll(gll: &Gll) -> GnssPart {
    let quality = gll.mode.map(PositionMode::quality);
    let part = GnssPart {
        kind: Gll::FORMATTER,
        epoch: gll.time.map(EpochTime::TimeOfDay),
        quality,
        invalid: !gll.valid || quality == Some(FixQuality::Invalid),
        ..GnssPart::default()
    };
    with_position(part, gll.position, None)
}

fn of_rmc(rmc: &Rmc) -> GnssPart {
    let quality = rmc.mode.map(PositionMode::quality);
    let part = GnssPart {
        kind: Rmc::FORMATTER,
        epoch: epoch(rmc),
        quality,
        invalid: !rmc.valid || quality == Some(FixQuality::Invalid),
        ..GnssPart::default()
    };
    let velocity = if part.invalid { [None; 3] } else { velocity(rmc.speed, rmc.course) };
    with_position(GnssPart { velocity, ..part }, rmc.position, None)
}

/// Date and time of day; of the two the time alone if the date is unknown.
fn epoch(rmc: &Rmc) -> Option<EpochTime> {
    let time: TimeOfDay = rmc.time?;
    let dated = rmc.date.and_then(|date| of_civil(CivilTime { date, time }));
    Some(dated.unwrap_or(EpochTime::TimeOfDay(time)))
}

/// Second 60 has no place in a count of seconds without leap seconds: it is told as a time of day.
fn of_civil(civil: CivilTime) -> Option<EpochTime> {
    let leaping = civil.time.second == 60;
    let utc = civil.to_utc()?;
    Some(if leaping { EpochTime::TimeOfDay(civil.time) } else { EpochTime::Utc(utc) })
}

fn of_vtg(vtg: &Vtg) -> GnssPart {
    let quality = vtg.mode.map(PositionMode::quality);
    let valid = quality != Some(FixQuality::Invalid);
    let velocity = if valid { velocity(vtg.speed, vtg.course) } else { [None; 3] };
    GnssPart { kind: Vtg::FORMATTER, velocity, quality, invalid: !valid, ..GnssPart::default() }
}

fn of_gst(gst: &Gst) -> GnssPart {
    GnssPart {
        kind: Gst::FORMATTER,
        epoch: gst.time.map(EpochTime::TimeOfDay),
        position_std: [gst.latitude_std, gst.longitude_std, gst.altitude_std],
        ..GnssPart::default()
    }
}

fn of_gsa(gsa: &Gsa) -> GnssPart {
    GnssPart { kind: Gsa::FORMATTER, hdop: gsa.hdop, ..GnssPart::default() }
}

fn of_zda(zda: &Zda) -> GnssPart {
    let epoch = zda.utc.and_then(of_civil);
    GnssPart { kind: Zda::FORMATTER, epoch, ..GnssPart::default() }
}

fn of_hdt(hdt: Hdt) -> GnssPart {
    GnssPart { kind: Hdt::FORMATTER, heading: hdt.heading, ..GnssPart::default() }
}

fn of_ths(ths: Ths) -> GnssPart {
    let heading = ths.heading.filter(|_| ths.mode != HeadingMode::NotValid);
    GnssPart { kind: Ths::FORMATTER, heading, ..GnssPart::default() }
}

fn with_quality(quality: FixQuality) -> GnssPart {
    let invalid = quality == FixQuality::Invalid;
    GnssPart { quality: Some(quality), invalid, ..GnssPart::default() }
}

/// Puts in the position, with its height if altitude and geoid separation are known.
fn with_position(
    part: GnssPart,
    position: Option<Position>,
    altitude_and_separation: Option<(f64, f64)>,
) -> GnssPart {
    let horizontal = position.filter(|_| !part.invalid);
    let full = horizontal.zip(altitude_and_separation).map(|(position, (altitude, separation))| {
        let Position { latitude, longitude } = position;
        Geodetic { latitude, longitude, height: altitude + separation }
    });
    GnssPart { position: full, horizontal, ..part }
}

/// North and east velocity of a speed and course over ground. A receiver at rest sends no course:
/// its velocity is then unknown, unless the speed is zero.
fn velocity(speed: Option<f64>, course: Option<f64>) -> [Option<f64>; 3] {
    match (speed, course) {
        (Some(speed), Some(course)) => {
            [Some(speed * course.cos()), Some(speed * course.sin()), None]
        }
        (Some(0.0), None) => [Some(0.0), Some(0.0), None],
        _ => [None; 3],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn part_of(line: &str) -> GnssPart {
        let sum = crate::nmea::checksum(&line.as_bytes()[1..]);
        let line = format!("{line}*{sum:02X}");
        part(&Sentence::read(line.as_bytes()).unwrap().1).unwrap()
    }

    #[test]
    fn the_height_is_altitude_plus_separation_or_unknown() {
        let full = part_of("$GPGGA,120000,3500.0,N,13900.0,E,4,12,0.8,-1.5,M,36.0,M,,");
        assert!((full.position.unwrap().height - 34.5).abs() < 1e-9);
        assert_eq!(full.quality, Some(FixQuality::RtkFixed));
        let flat = part_of("$GPGGA,120000,3500.0,N,13900.0,E,1,12,0.8,-1.5,M,,M,,");
        assert_eq!(flat.position, None);
        assert!((flat.horizontal.unwrap().latitude - 35_f64.to_radians()).abs() < 1e-12);
    }

    #[test]
    fn what_says_that_it_is_not_valid_gives_no_position_and_no_velocity() {
        for line in [
            "$GPRMC,120000,V,3500.0,N,13900.0,E,5.0,90.0,280226,,,A",
            "$GPRMC,120000,A,3500.0,N,13900.0,E,5.0,90.0,280226,,,N",
            "$GPGLL,3500.0,N,13900.0,E,120000,V,A",
            "$GPGGA,120000,3500.0,N,13900.0,E,0,12,0.8,-1.5,M,36.0,M,,",
            "$GPVTG,90.0,T,,M,5.0,N,9.3,K,N",
        ] {
            let part = part_of(line);
            assert!(part.invalid, "{line}");
            assert_eq!((part.position, part.horizontal, part.velocity), (None, None, [None; 3]));
        }
    }

    #[test]
    fn the_year_of_rmc_has_a_century() {
        for (date, year) in [("280226", 2026), ("280280", 1980), ("280299", 1999), ("280279", 2079)]
        {
            let part = part_of(&format!("$GPRMC,120000,A,3500.0,N,13900.0,E,5.0,90.0,{date},,,A"));
            let Some(EpochTime::Utc(utc)) = part.epoch else { panic!("{date}") };
            assert_eq!(utc.to_civil().0, (year, 2, 28));
        }
    }

    #[test]
    fn a_leap_second_is_told_as_a_time_of_day() {
        for line in [
            "$GPRMC,235960.4,A,3500.0,N,13900.0,E,5.0,90.0,311226,,,A",
            "$GPZDA,235960.4,31,12,2026,,",
        ] {
            let time = TimeOfDay { hour: 23, minute: 59, second: 60, nanosecond: 400_000_000 };
            assert_eq!(part_of(line).epoch, Some(EpochTime::TimeOfDay(time)), "{line}");
        }
    }

    #[test]
    fn course_and_speed_are_the_horizontal_velocity() {
        let part = part_of("$GPVTG,90.0,T,,M,10.0,N,18.52,K,A");
        let [north, east, down] = part.velocity;
        assert!(north.unwrap().abs() < 1e-12 && (east.unwrap() - 18_520.0 / 3600.0).abs() < 1e-12);
        assert_eq!(down, None);
        assert_eq!(part_of("$GPVTG,,T,,M,0.05,N,0.1,K,A").velocity, [None; 3]);
    }
}
