//! Prints messages as this crate writes them beside the values that were meant, one JSON object on a
//! line, for the comparison with other decoders in `tests/conformance/n2k.py`.
//!
//! Every field goes through its whole range: its ends, values on and between steps, values just
//! outside, which are meant to be not available, and none at all.

#[path = "fields/mod.rs"]
mod fields;

use std::error::Error;
use std::f64::consts::{FRAC_PI_2, PI, TAU};
use std::io::{BufWriter, Write};

use insd_n2k::pgn::{
    Attitude, CourseSpeed, Direction, DistanceLog, Dops, FixMethod, FixMode, GnssPosition,
    GnssSystem, Group, Heading, Heave, Integrity, Known, MagneticVariation, North, PositionRapid,
    PseudorangeNoise, RateOfTurn, SetDrift, Speed, SpeedComponents, SpeedKind, Station, SystemTime,
    TimeDate, TimeSource, VariationSource,
};
use serde_json::json;

/// Messages of each group.
const ROUNDS: usize = 500;

fn main() -> Result<(), Box<dyn Error>> {
    let mut out = BufWriter::new(std::io::stdout().lock());
    for pgn in Known::PGNS {
        for round in 0..ROUNDS {
            let written = group(*pgn, &mut Draw { round, place: 0, meant: false });
            let meant = group(*pgn, &mut Draw { round, place: 0, meant: true });
            let (Some(written), Some(meant)) = (written, meant) else { continue };
            let data = written.write();
            let hex: Vec<String> = data.iter().map(|byte| format!("{byte:02x}")).collect();
            let second = format!("2026-01-01T00:{:02}:{:02}.000Z", round / 60, round % 60);
            let head = format!("{second},{},{pgn},35,255,{}", written.priority(), data.len());
            let line = format!("{head},{}", hex.join(","));
            writeln!(out, "{}", json!({ "line": line, "meant": fields::fields(&meant) }))?;
        }
    }
    Ok(())
}

/// Values for the fields of a message, one after the other.
struct Draw {
    round: usize,
    place: usize,
    /// Whether to tell what is meant instead of what is handed to the writer.
    meant: bool,
}

impl Draw {
    /// One of a list; another field takes another way through its list.
    fn pick<T: Copy>(&mut self, list: &[T]) -> Option<T> {
        self.place += 1;
        let strides = [1, 3, 7, 9, 11, 13, 17, 19, 21, 23, 27];
        let stride = strides.get(self.place % strides.len()).copied().unwrap_or(1);
        list.get((self.round * stride + self.place * 5) % list.len().max(1)).copied()
    }

    /// One of a list, or not available.
    fn code<T: Copy>(&mut self, list: &[T]) -> Option<T> {
        let mut all: Vec<Option<T>> = list.iter().copied().map(Some).collect();
        all.push(None);
        self.pick(&all).flatten()
    }

    /// A number between two limits, with a step.
    fn number(&mut self, least: f64, most: f64, step: f64) -> Option<f64> {
        let mut values = vec![None, Some(least), Some(most), Some(0.0_f64.max(least))];
        let grid = (0..=96).map(|part| least + (most - least) * (f64::from(part) / 96.0));
        values.extend(grid.map(Some));
        let between = [0.49, 0.51, 1.0, 99.49, 1000.51].map(|steps| Some(least + steps * step));
        values.extend(between.into_iter().filter(|value| *value <= Some(most)));
        let known = values.len();
        let beyond = |limit: f64| limit.abs() * 1e-5 + 0.6 * step;
        let outside = [least - beyond(least), most + beyond(most), f64::NAN, f64::INFINITY, -1e20];
        values.extend(outside.map(Some));
        let places: Vec<usize> = (0..values.len()).collect();
        let place = self.pick(&places)?;
        if self.meant && place >= known { None } else { values.get(place).copied().flatten() }
    }

    /// A direction, also one that is not wrapped.
    fn turn(&mut self) -> Option<f64> {
        let angles = (0..=200).map(|part| -7.0 + f64::from(part) * 0.1);
        let edges = [0.0, TAU - 0.51e-4, TAU - 0.3e-4, -1e-8, PI + 1e-5];
        let values: Vec<f64> = angles.chain(edges).collect();
        let written = self.code(&values)?;
        Some(if self.meant { written.rem_euclid(TAU) } else { written })
    }

    fn angle(&mut self) -> Option<f64> {
        self.number(-PI, PI, 1e-4)
    }

    fn speed(&mut self) -> Option<f64> {
        self.number(0.0, 655.32, 0.01)
    }

    fn fine(&mut self) -> Option<f64> {
        self.number(-32.767, 32.764, 0.001)
    }

    fn dilution(&mut self) -> Option<f64> {
        self.number(-327.67, 327.64, 0.01)
    }

    fn byte(&mut self) -> Option<u8> {
        self.small(&[0, 1, 2, 100, 200, 251, 252], &[253, 254, 255])
    }

    fn date(&mut self) -> Option<u16> {
        self.small(&[0, 1, 59, 365, 11_016, 20_778, 24_855, 24_856, 65_532], &[65_533, 65_535])
    }

    fn station(&mut self) -> Option<u16> {
        self.small(&[0, 1, 1023, 2048, 4092], &[4093, 4095, 4096, 65_535])
    }

    /// One of the numbers that fit, one that does not, or none.
    fn small<T: Copy>(&mut self, good: &[T], bad: &[T]) -> Option<T> {
        let places: Vec<usize> = (0..good.len() + bad.len()).collect();
        let place = self.code(&places)?;
        let outside = bad.get(place.wrapping_sub(good.len())).copied();
        good.get(place).copied().or(outside.filter(|_| !self.meant))
    }

    fn time(&mut self) -> Option<f64> {
        self.number(0.0, 86_401.0, 1e-4)
    }

    fn north(&mut self) -> Option<North> {
        self.code(&[North::True, North::Magnetic])
    }

    fn system(&mut self) -> Option<GnssSystem> {
        use GnssSystem::*;
        let named =
            [Gps, Glonass, GpsGlonass, GpsSbas, GpsSbasGlonass, Chayka, Integrated, Surveyed];
        self.code(&[&named[..], &[Galileo, Other(9), Other(12)]].concat())
    }

    fn mode(&mut self) -> Option<FixMode> {
        self.code(&[
            FixMode::OneD,
            FixMode::TwoD,
            FixMode::ThreeD,
            FixMode::Auto,
            FixMode::Other(4),
        ])
    }
}

/// A group with values for all its fields.
fn group(pgn: u32, d: &mut Draw) -> Option<Known> {
    use TimeSource::*;
    Some(match pgn {
        SystemTime::PGN => {
            let sources = [Gps, Glonass, RadioStation, LocalCesium, LocalRubidium, LocalCrystal];
            SystemTime { sid: d.byte(), source: d.code(&sources), date: d.date(), time: d.time() }
                .into()
        }
        Heading::PGN => Heading {
            sid: d.byte(),
            heading: d.turn(),
            deviation: d.angle(),
            variation: d.angle(),
            reference: d.north(),
        }
        .into(),
        RateOfTurn::PGN => {
            let rate = d.number(-67.108_863_968_75, 67.108_863_875, 1.0 / 32e6);
            RateOfTurn { sid: d.byte(), rate }.into()
        }
        Heave::PGN => Heave { sid: d.byte(), heave: d.dilution() }.into(),
        Attitude::PGN => {
            let yaw = d.turn().map(|yaw| if d.meant && yaw > PI { yaw - TAU } else { yaw });
            Attitude { sid: d.byte(), yaw, pitch: d.angle(), roll: d.angle() }.into()
        }
        MagneticVariation::PGN => magnetic_variation(d).into(),
        GnssPosition::PGN => gnss_position(d).into(),
        TimeDate::PGN => {
            let offset =
                d.small(&[-32_767, -720, 0, 60, 840, 32_764], &[i16::MIN, 32_765, i16::MAX]);
            TimeDate { date: d.date(), time: d.time(), local_offset: offset }.into()
        }
        Dops::PGN => Dops {
            sid: d.byte(),
            desired: d.mode(),
            actual: d.mode(),
            hdop: d.dilution(),
            vdop: d.dilution(),
            tdop: d.dilution(),
        }
        .into(),
        PseudorangeNoise::PGN => PseudorangeNoise {
            sid: d.byte(),
            range_rms: d.speed(),
            major: d.speed(),
            minor: d.speed(),
            orientation: d.turn(),
            latitude_std: d.speed(),
            longitude_std: d.speed(),
            altitude_std: d.speed(),
        }
        .into(),
        _ => return motion(pgn, d),
    })
}

fn motion(pgn: u32, d: &mut Draw) -> Option<Known> {
    use SpeedKind::*;
    Some(match pgn {
        Speed::PGN => Speed {
            sid: d.byte(),
            water: d.speed(),
            ground: d.speed(),
            kind: d.code(&[PaddleWheel, PitotTube, Doppler, Correlation, Electromagnetic]),
            direction: d.code(&[Direction::Forward, Direction::Reverse]),
        }
        .into(),
        DistanceLog::PGN => {
            let mut distance = || d.number(0.0, 4_294_967_292.0, 1.0);
            let (log, trip) = (distance(), distance());
            DistanceLog { date: d.date(), time: d.time(), log, trip }.into()
        }
        PositionRapid::PGN => {
            let step = 1e-7_f64.to_radians();
            let latitude = d.number(-FRAC_PI_2, FRAC_PI_2, step);
            PositionRapid { latitude, longitude: d.number(-PI, PI, step) }.into()
        }
        CourseSpeed::PGN => {
            let (sid, reference) = (d.byte(), d.north());
            CourseSpeed { sid, reference, course: d.turn(), speed: d.speed() }.into()
        }
        SetDrift::PGN => {
            let (sid, reference) = (d.byte(), d.north());
            SetDrift { sid, reference, set: d.turn(), drift: d.speed() }.into()
        }
        SpeedComponents::PGN => SpeedComponents {
            forward_water: d.fine(),
            starboard_water: d.fine(),
            forward_ground: d.fine(),
            starboard_ground: d.fine(),
            stern_starboard_water: d.fine(),
            stern_starboard_ground: d.fine(),
        }
        .into(),
        _ => return None,
    })
}

fn magnetic_variation(d: &mut Draw) -> MagneticVariation {
    use VariationSource::*;
    let models = [2000, 2005, 2010, 2015, 2020, 2025].map(Wmm);
    let source = d.code(&[&[Manual, Chart, Table, Calculation], &models[..]].concat());
    MagneticVariation { sid: d.byte(), source, date: d.date(), variation: d.angle() }
}

fn gnss_position(d: &mut Draw) -> GnssPosition {
    use FixMethod::*;
    let named = [NoFix, Gnss, Differential, Precise, RtkFixed, RtkFloat, DeadReckoning, Manual];
    let methods = [&named[..], &[Simulated, Other(9), Other(12)]].concat();
    let step = 1e-16_f64.to_radians();
    let mut stations = Vec::new();
    for _ in 0..d.round % 4 {
        stations.push(Station { system: d.system(), id: d.station(), age: d.speed() });
    }
    GnssPosition {
        sid: d.byte(),
        date: d.date(),
        time: d.time(),
        latitude: d.number(-FRAC_PI_2, FRAC_PI_2, step),
        longitude: d.number(-PI, PI, step),
        altitude: d.number(-9.223_372e12, 9.223_372e12, 1e-6),
        system: d.system(),
        method: d.code(&methods),
        integrity: d.pick(&[
            Integrity::NoChecking,
            Integrity::Safe,
            Integrity::Caution,
            Integrity::Unsafe,
        ]),
        satellites: d.byte(),
        hdop: d.dilution(),
        pdop: d.dilution(),
        geoid: d.number(-21_474_836.47, 21_474_836.44, 0.01),
        stations,
    }
}
