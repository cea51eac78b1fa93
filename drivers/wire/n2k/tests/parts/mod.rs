//! Any contents of the groups, and the contents taken apart for comparison.

use std::f64::consts::{FRAC_PI_2, PI, TAU};
use std::fmt::Debug;

use insd_n2k::pgn::{
    Attitude, CourseSpeed, Direction, DistanceLog, Dops, FixMethod, FixMode, GnssPosition,
    GnssSystem, Heading, Heave, Integrity, Known, MagneticVariation, North, PositionRapid,
    PseudorangeNoise, RateOfTurn, SetDrift, Speed, SpeedComponents, SpeedKind, Station, SystemTime,
    TimeDate, TimeSource, VariationSource,
};
use proptest::option;
use proptest::prelude::*;
use proptest::sample::select;

/// The largest signed angle that is written, rad.
const LAST_ANGLE: f64 = 31_415.0 / 1e4;

/// A number of a group.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Part {
    pub(crate) value: Option<f64>,
    /// One step of its field, in its unit.
    pub(crate) step: f64,
    /// Whether full turns do not count.
    pub(crate) turns: bool,
}

impl Part {
    /// Whether two numbers are within half a step, or within what a double loses on the way to degrees
    /// and back; a signed angle of half a turn is written as a step below.
    pub(crate) fn near(&self, other: &Part) -> bool {
        let (Some(a), Some(b)) = (self.value, other.value) else {
            return self.value == other.value;
        };
        let apart = if self.turns { (a - b + PI).rem_euclid(TAU) - PI } else { a - b };
        let steps = if b.abs() == LAST_ANGLE { 0.93 } else { 0.500_001 };
        apart.abs() <= self.step * steps + a.abs() * 1e-15
    }
}

/// The contents of a group, taken apart: its numbers, and the rest of it as text.
#[derive(Debug, Default)]
pub(crate) struct Parts {
    pub(crate) numbers: Vec<Part>,
    pub(crate) rest: String,
}

impl Parts {
    fn of(rest: &impl Debug) -> Self {
        Parts { numbers: Vec::new(), rest: format!("{rest:?}") }
    }

    /// Numbers with this step.
    fn with(mut self, step: f64, values: &[Option<f64>]) -> Self {
        self.numbers.extend(values.iter().map(|value| Part { value: *value, step, turns: false }));
        self
    }

    /// A direction.
    fn turn(mut self, value: Option<f64>) -> Self {
        self.numbers.push(Part { value, step: 1e-4, turns: true });
        self
    }
}

/// Takes contents apart.
pub(crate) fn parts(known: &Known) -> Parts {
    match known {
        Known::Heading(x) => {
            Parts::of(&(x.sid, x.reference)).turn(x.heading).with(1e-4, &[x.deviation, x.variation])
        }
        Known::RateOfTurn(x) => Parts::of(&x.sid).with(1.0 / 32e6, &[x.rate]),
        Known::Heave(x) => Parts::of(&x.sid).with(0.01, &[x.heave]),
        Known::Attitude(x) => Parts::of(&x.sid).turn(x.yaw).with(1e-4, &[x.pitch, x.roll]),
        Known::MagneticVariation(x) => {
            Parts::of(&(x.sid, x.source, x.date)).with(1e-4, &[x.variation])
        }
        Known::TimeDate(x) => Parts::of(&(x.date, x.local_offset)).with(1e-4, &[x.time]),
        Known::SystemTime(x) => Parts::of(&(x.sid, x.source, x.date)).with(1e-4, &[x.time]),
        Known::GnssPosition(x) => parts_of_fix(x),
        Known::Dops(x) => {
            Parts::of(&(x.sid, x.desired, x.actual)).with(0.01, &[x.hdop, x.vdop, x.tdop])
        }
        Known::PseudorangeNoise(x) => Parts::of(&x.sid)
            .with(0.01, &[x.range_rms, x.major, x.minor])
            .turn(x.orientation)
            .with(0.01, &[x.latitude_std, x.longitude_std, x.altitude_std]),
        motion => parts_of_motion(motion),
    }
}

fn parts_of_motion(known: &Known) -> Parts {
    match known {
        Known::Speed(x) => {
            Parts::of(&(x.sid, x.kind, x.direction)).with(0.01, &[x.water, x.ground])
        }
        Known::DistanceLog(x) => {
            Parts::of(&x.date).with(1e-4, &[x.time]).with(1.0, &[x.log, x.trip])
        }
        Known::PositionRapid(x) => {
            Parts::default().with(1e-7_f64.to_radians(), &[x.latitude, x.longitude])
        }
        Known::CourseSpeed(x) => {
            Parts::of(&(x.sid, x.reference)).turn(x.course).with(0.01, &[x.speed])
        }
        Known::SetDrift(x) => Parts::of(&(x.sid, x.reference)).turn(x.set).with(0.01, &[x.drift]),
        Known::SpeedComponents(x) => Parts::default()
            .with(0.001, &[x.forward_water, x.starboard_water, x.forward_ground])
            .with(0.001, &[x.starboard_ground, x.stern_starboard_water, x.stern_starboard_ground]),
        other => unreachable!("no parts of {other:?}"),
    }
}

fn parts_of_fix(fix: &GnssPosition) -> Parts {
    let stations: Vec<_> =
        fix.stations.iter().map(|station| (station.system, station.id)).collect();
    let ages: Vec<_> = fix.stations.iter().map(|station| station.age).collect();
    let codes = (fix.system, fix.method, fix.integrity);
    Parts::of(&(fix.sid, fix.date, codes, fix.satellites, stations))
        .with(1e-4, &[fix.time])
        .with(1e-16_f64.to_radians(), &[fix.latitude, fix.longitude])
        .with(1e-6, &[fix.altitude])
        .with(0.01, &[fix.hdop, fix.pdop, fix.geoid])
        .with(0.01, &ages)
}

type Any<T> = BoxedStrategy<Option<T>>;

/// Any number of a range, often one of its ends, often unknown.
fn number(least: f64, most: f64) -> Any<f64> {
    let values = prop_oneof![8 => least..=most, 1 => Just(least), 1 => Just(most), 1 => Just(0.0)];
    option::of(values.prop_filter("in the range", move |x| (least..=most).contains(x))).boxed()
}

fn turn() -> Any<f64> {
    let wild = prop_oneof![0.0..TAU, -20.0..20.0, Just(0.0), Just(TAU), Just(6.283_15)];
    option::of(wild).boxed()
}

fn sid() -> Any<u8> {
    option::of(0..=252_u8).boxed()
}

fn date() -> Any<u16> {
    option::of(0..=65_532_u16).boxed()
}

fn time() -> Any<f64> {
    number(0.0, 86_401.0)
}

fn any_of<T: Clone + Debug + 'static>(list: &[T]) -> Any<T> {
    option::of(select(list.to_vec())).boxed()
}

fn north() -> Any<North> {
    any_of(&[North::True, North::Magnetic])
}

fn system() -> Any<GnssSystem> {
    use GnssSystem::*;
    let named = [Gps, Glonass, GpsGlonass, GpsSbas, GpsSbasGlonass, Chayka, Integrated, Surveyed];
    any_of(&[&named[..], &[Galileo, Other(9), Other(13)]].concat())
}

fn fix_method() -> Any<FixMethod> {
    use FixMethod::*;
    let named = [NoFix, Gnss, Differential, Precise, RtkFixed, RtkFloat, DeadReckoning, Manual];
    any_of(&[&named[..], &[Simulated, Other(9), Other(13)]].concat())
}

fn fix_mode() -> Any<FixMode> {
    use FixMode::*;
    any_of(&[OneD, TwoD, ThreeD, Auto, Other(4), Other(6)])
}

fn station() -> impl Strategy<Value = Station> {
    (system(), option::of(0..=4092_u16), number(0.0, 655.32))
        .prop_map(|(system, id, age)| Station { system, id, age })
}

/// Any contents within the ranges of the fields.
pub(crate) fn any_known() -> impl Strategy<Value = Known> {
    prop_oneof![gnss_position(), gnss_others(), attitudes(), times(), speeds(), places()]
}

fn attitudes() -> impl Strategy<Value = Known> {
    let angle = || number(-PI, PI);
    let source = {
        use VariationSource::*;
        let models = [2000, 2005, 2010, 2015, 2020, 2025].map(Wmm);
        any_of(&[&[Manual, Chart, Table, Calculation], &models[..]].concat())
    };
    prop_oneof![
        (sid(), turn(), angle(), angle(), north()).prop_map(
            |(sid, heading, deviation, variation, reference)| {
                Heading { sid, heading, deviation, variation, reference }.into()
            }
        ),
        (sid(), number(-67.108_863, 67.108_863))
            .prop_map(|(sid, rate)| RateOfTurn { sid, rate }.into()),
        (sid(), number(-327.67, 327.64)).prop_map(|(sid, heave)| Heave { sid, heave }.into()),
        (sid(), turn(), angle(), angle()).prop_map(|(sid, yaw, pitch, roll)| Attitude {
            sid,
            yaw,
            pitch,
            roll
        }
        .into()),
        (sid(), source, date(), angle()).prop_map(|(sid, source, date, variation)| {
            MagneticVariation { sid, source, date, variation }.into()
        }),
    ]
}

fn times() -> impl Strategy<Value = Known> {
    use TimeSource::*;
    let source = any_of(&[Gps, Glonass, RadioStation, LocalCesium, LocalRubidium, LocalCrystal]);
    let offset = option::of(-32_767..=32_764_i16);
    prop_oneof![
        (date(), time(), offset).prop_map(|(date, time, local_offset)| {
            TimeDate { date, time, local_offset }.into()
        }),
        (sid(), source, date(), time()).prop_map(|(sid, source, date, time)| {
            SystemTime { sid, source, date, time }.into()
        }),
    ]
}

fn speeds() -> impl Strategy<Value = Known> {
    use SpeedKind::*;
    let kind = any_of(&[PaddleWheel, PitotTube, Doppler, Correlation, Electromagnetic]);
    let way = any_of(&[Direction::Forward, Direction::Reverse]);
    let speed = || number(0.0, 655.32);
    let distance = || number(0.0, 4_294_967_292.0);
    let fine = || number(-32.767, 32.764);
    prop_oneof![
        (sid(), speed(), speed(), kind, way).prop_map(|(sid, water, ground, kind, direction)| {
            Speed { sid, water, ground, kind, direction }.into()
        }),
        (date(), time(), distance(), distance()).prop_map(|(date, time, log, trip)| DistanceLog {
            date,
            time,
            log,
            trip
        }
        .into()),
        (sid(), north(), turn(), speed()).prop_map(|(sid, reference, set, drift)| {
            SetDrift { sid, reference, set, drift }.into()
        }),
        [fine(), fine(), fine(), fine(), fine(), fine()].prop_map(|[a, b, c, d, e, f]| {
            SpeedComponents {
                forward_water: a,
                starboard_water: b,
                forward_ground: c,
                starboard_ground: d,
                stern_starboard_water: e,
                stern_starboard_ground: f,
            }
            .into()
        }),
    ]
}

fn places() -> impl Strategy<Value = Known> {
    prop_oneof![
        (number(-FRAC_PI_2, FRAC_PI_2), number(-PI, PI))
            .prop_map(|(latitude, longitude)| PositionRapid { latitude, longitude }.into()),
        (sid(), north(), turn(), number(0.0, 655.32)).prop_map(
            |(sid, reference, course, speed)| {
                CourseSpeed { sid, reference, course, speed }.into()
            }
        ),
    ]
}

fn gnss_position() -> impl Strategy<Value = Known> {
    use Integrity::*;
    let dop = || number(-327.67, 327.64);
    let integrity = select(vec![NoChecking, Safe, Caution, Unsafe]).prop_map(Some);
    let place = (number(-FRAC_PI_2, FRAC_PI_2), number(-PI, PI), number(-9.2e12, 9.2e12));
    let kind = (system(), fix_method(), integrity, sid());
    let dilutions = (dop(), dop(), number(-21_474_836.47, 21_474_836.44));
    let stations = proptest::collection::vec(station(), 0..=45);
    (sid(), date(), time(), place, kind, dilutions, stations).prop_map(
        |(
            sid,
            date,
            time,
            (latitude, longitude, altitude),
            kind,
            (hdop, pdop, geoid),
            stations,
        )| {
            let (system, method, integrity, satellites) = kind;
            let fix = GnssPosition {
                sid,
                date,
                time,
                latitude,
                longitude,
                altitude,
                system,
                method,
                integrity,
                satellites,
                hdop,
                pdop,
                geoid,
                stations,
            };
            fix.into()
        },
    )
}

fn gnss_others() -> impl Strategy<Value = Known> {
    let dop = || number(-327.67, 327.64);
    let deviation = || number(0.0, 655.32);
    let three = || [deviation(), deviation(), deviation()];
    prop_oneof![
        (sid(), fix_mode(), fix_mode(), dop(), dop(), dop()).prop_map(
            |(sid, desired, actual, hdop, vdop, tdop)| {
                Dops { sid, desired, actual, hdop, vdop, tdop }.into()
            }
        ),
        (sid(), three(), turn(), three()).prop_map(|(sid, ellipse, orientation, errors)| {
            let [range_rms, major, minor] = ellipse;
            let [latitude_std, longitude_std, altitude_std] = errors;
            let noise = PseudorangeNoise {
                sid,
                range_rms,
                major,
                minor,
                orientation,
                latitude_std,
                longitude_std,
                altitude_std,
            };
            noise.into()
        }),
    ]
}
