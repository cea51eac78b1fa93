//! Every kind of lie, with what it draws and what is asked.

use insd_base::units::DEG;
use nalgebra::{Vector2, Vector3};

use super::draw::Draw;
use super::evidence::heading_shown_after;
use super::{Class, CompassLie, GnssLie, Grade, ImuLie, Lie, LogLie, Suite, Told, Window};

/// A kind of lie.
pub struct LieKind {
    /// Its name.
    pub name: &'static str,
    /// With which sensors it is told.
    pub suites: &'static [Suite],
    pub(super) draw: fn(&mut Draw) -> Strike,
}

/// What was drawn.
pub(super) struct Strike {
    pub(super) told: Vec<Told>,
    pub(super) size: String,
    pub(super) asked: Asked,
    pub(super) judged_from: f64,
    pub(super) is_moored: bool,
}

/// What is asked.
pub(super) enum Asked {
    /// By what the others can show of a position that is so far off after so many seconds, m.
    ByEvidence {
        /// How far off.
        off: Box<dyn Fn(f64) -> f64>,
        /// Whether the receiver's own velocity is honest.
        velocity_is_honest: bool,
    },
    /// That the liar is named once the others can show it, and not used.
    After {
        /// So many seconds after the lie began.
        seconds: f64,
    },
    /// That sigma and level cover what she follows, as nobody can show it.
    Unshown,
    /// This.
    Of {
        /// What.
        class: Class,
        /// Whether the liar must be named.
        is_named: bool,
    },
}

const ALL: &[Suite] = &[Suite::Gnss, Suite::Log, Suite::Compass, Suite::Both];
const LOG: &[Suite] = &[Suite::Log, Suite::Both];
const COMPASS: &[Suite] = &[Suite::Compass, Suite::Both];
const BOTH: &[Suite] = &[Suite::Both];
const TWO: &[Suite] = &[Suite::Two, Suite::TwoAndLog];
/// From when on a compass that was wrong from the start is judged, s.
const STARTED: f64 = 900.0;
/// Degrees an hour, rad/s.
const PER_HOUR: f64 = DEG / 3600.0;
/// When she has left the berth and made way, s.
const UNDER_WAY_FROM: f64 = 380.0;
/// Speed of a position that is told to stand still while she makes 12 kn, m/s.
const UNDER_WAY: f64 = 6.17;

macro_rules! kinds {
    ($($name:literal $suites:ident $draw:expr;)*) => {
        &[$(LieKind { name: $name, suites: $suites, draw: $draw }),*]
    };
}

/// All kinds.
#[must_use]
pub fn catalogue() -> &'static [LieKind] {
    CATALOGUE
}

const CATALOGUE: &[LieKind] = kinds! {
    "gnss jump" ALL |d| jump(d, 5.0, 1e5);
    "gnss drag" ALL |d| drag(d, 0.3, 3.0, true);
    "gnss drag slow" ALL |d| drag(d, 0.05, 0.3, true);
    "gnss drag of position" ALL |d| drag(d, 0.05, 3.0, false);
    "gnss creep" ALL creep;
    "gnss frozen position" ALL |d| frozen(d, GnssLie::FrozenPosition, true);
    "gnss frozen" ALL |d| frozen(d, GnssLie::FrozenAll, true);
    "gnss frozen still" ALL |d| frozen(d, GnssLie::FrozenStill, false);
    "gnss velocity sign" ALL |d| velocity(d, GnssLie::VelocitySign);
    "gnss velocity swapped" ALL |d| velocity(d, GnssLie::VelocitySwapped);
    "gnss velocity scale" ALL |d| { let by = 1.0 + d.signed(0.1, 0.5); velocity(d, GnssLie::VelocityScale(by)) };
    "gnss velocity stuck" ALL |d| velocity(d, GnssLie::VelocityStuck);
    "gnss sigmas small" ALL |d| { let by = 1.0 / d.size(20.0, 1e4); gnss(d, GnssLie::Sigmas(by), Class::Bounded) };
    "gnss sigmas large" ALL |d| { let by = d.size(20.0, 1e4); gnss(d, GnssLie::Sigmas(by), Class::Bounded) };
    "gnss claims rtk" ALL |d| gnss(d, GnssLie::ClaimsRtk, Class::Bounded);
    "gnss noise" ALL |d| { let std = d.size(5.0, 30.0); gnss(d, GnssLie::Noise(std), Class::Bounded) };
    "gnss dated late" ALL |d| { let by = d.between(0.2, 0.8); gnss(d, GnssLie::Dated(by), Class::Bounded) };
    "gnss lever" ALL |d| { let by = d.along(3.0, 30.0); gnss(d, GnssLie::Lever(by), Class::Bounded) };
    "gnss dated very late" ALL |d| { let by = d.between(2.0, 5.0); unnamed_gnss(d, GnssLie::Dated(by)) };
    "gnss arrives late" ALL |d| { let by = d.between(1.0, 5.0); unnamed_gnss(d, GnssLie::Arrives(by)) };
    "gnss doubled" ALL |d| unnamed_gnss(d, GnssLie::Doubled);
    "gnss height" ALL height;
    "second receiver drag" TWO second_drag;
    "first of two drag" TWO |d| drag(d, 0.3, 3.0, true);
    "log frozen" LOG |d| log(d, LogLie::Frozen);
    "log zero" LOG |d| log(d, LogLie::Zero);
    "log scale" LOG |d| { let by = 1.0 + d.signed(0.05, 0.5); log(d, LogLie::Scale(by)) };
    "log turned" LOG |d| { let by = if d.axis() == 0 { 180.0 } else { 90.0 }; log(d, LogLie::Turned(by * DEG)) };
    "log askew" LOG |d| { let by = d.signed(5.0, 30.0); log(d, LogLie::Turned(by * DEG)) };
    "log athwart" LOG |d| { let by = d.signed(0.5, 3.0); log(d, LogLie::Athwart(by)) };
    "log water as bottom" LOG |d| { let by = d.vector(0.5, 1.5); log(d, LogLie::WaterAsBottom(by)) };
    "log swapping" LOG |d| { let by = d.vector(0.5, 1.5); log(d, LogLie::Swapping(by)) };
    "log spikes" LOG |d| { let by = d.size(2.0, 20.0); unnamed(d, Lie::Log(LogLie::Spikes(by))) };
    "log dropouts" LOG |d| { let by = d.between(0.3, 0.9); unnamed(d, Lie::Log(LogLie::Dropouts(by))) };
    "log flood" LOG |d| unnamed(d, Lie::Log(LogLie::Flood(200)));
    "log of water" LOG |d| unnamed(d, Lie::Log(LogLie::Water(Vector2::new(1.2, 0.9))));
    "compass 180 at the start" COMPASS |d| start_offset(d, 180.0, 180.0);
    "compass off at the start" COMPASS |d| start_offset(d, 5.0, 90.0);
    "compass step" COMPASS |d| { let by = d.signed(5.0, 90.0); compass(d, CompassLie::Offset(by * DEG)) };
    "compass drift" COMPASS |d| compass_drift(d);
    "compass frozen" COMPASS |d| compass(d, CompassLie::Frozen);
    "compass mirrored" COMPASS |d| compass(d, CompassLie::Mirrored);
    "compass tiny sigma" COMPASS |d| { let by = d.size(5.0, 100.0); bounded(d, Lie::Compass(CompassLie::TinySigma(by))) };
    "compass noise" COMPASS |d| { let by = d.size(1.0, 5.0); unnamed(d, Lie::Compass(CompassLie::Noise(by * DEG))) };
    "compass spikes" COMPASS |d| unnamed(d, Lie::Compass(CompassLie::Spikes));
    "compass wander" COMPASS |d| bounded(d, Lie::Compass(CompassLie::Wander { std: 0.3 * DEG, time: 600.0 }));
    "gyro stuck" ALL |d| { let axis = d.axis(); imu(d, ImuLie::GyroStuck(axis)) };
    "gyro zero" ALL |d| { let axis = d.axis(); imu(d, ImuLie::GyroZero(axis)) };
    "accelerometer stuck" ALL |d| { let axis = d.axis(); imu(d, ImuLie::AccelStuck(axis)) };
    "imu stuck" ALL |d| imu(d, ImuLie::AllStuck);
    "imu swapped" ALL |d| { let axis = d.axis(); imu(d, ImuLie::Swapped(axis, (axis + 1) % 3)) };
    "gyro sign" ALL |d| { let axis = d.axis(); imu(d, ImuLie::GyroSign(axis)) };
    "gyro step" ALL |d| { let by = d.along(0.1, 1.0); imu(d, ImuLie::GyroStep(by * DEG)) };
    "accelerometer step" ALL |d| { let by = d.along(0.3, 2.0); imu(d, ImuLie::AccelStep(by)) };
    "imu clock" ALL |d| { let by = d.between(0.5, 5.0); imu(d, ImuLie::ClockStep(by)) };
    "imu turned" ALL |d| { let by = if d.axis() == 0 { 180.0 } else { 90.0 }; imu(d, ImuLie::Turned(by * DEG)) };
    "gyro bias" ALL |d| { let by = small_gyro(d); bounded(d, Lie::Imu(ImuLie::GyroStep(by))) };
    "accelerometer bias" ALL |d| { let by = d.along(0.005, 0.05); bounded(d, Lie::Imu(ImuLie::AccelStep(by))) };
    "imu scale" ALL |d| { let [gyro, accel] = [d.signed(0.01, 0.1), d.signed(0.001, 0.01)]; bounded(d, Lie::Imu(ImuLie::Scale { gyro: 1.0 + gyro, accel: 1.0 + accel })) };
    "imu spikes" ALL |d| bounded(d, Lie::Imu(ImuLie::Spikes));
    "imu clipped" ALL |d| { let by = d.between(0.1, 1.0); bounded(d, Lie::Imu(ImuLie::Clipped(by * DEG))) };
    "imu lost" ALL |d| { let by = d.between(0.01, 0.4); bounded(d, Lie::Imu(ImuLie::Lost(by))) };
    "imu gap" ALL |d| { let by = d.size(0.2, 5.0); bounded(d, Lie::Imu(ImuLie::Gap(by))) };
    "imu not a number" ALL |d| { let by = d.between(0.01, 0.2); bounded(d, Lie::Imu(ImuLie::NotANumber(by))) };
    "imu noise" ALL |d| { let by = noise(d.grade); bounded(d, Lie::Imu(by)) };
    "gyro ramp" ALL |d| { let by = small_gyro(d) / 600.0; bounded(d, Lie::Imu(ImuLie::GyroRamp(by))) };
    "imu doubled" ALL |d| bounded(d, Lie::Imu(ImuLie::Doubled));
    "heals: gnss jump" ALL |d| healing(d, |d| Lie::Gnss(GnssLie::Jump(d.vector(30.0, 1e4))), Class::Told);
    "heals: gnss drag" LOG |d| healing(d, |d| Lie::Gnss(GnssLie::Drag { velocity: d.vector(0.5, 3.0), consistent: true }), Class::Required);
    "heals: log frozen" LOG |d| healing(d, |_| Lie::Log(LogLie::Frozen), Class::Required);
    "heals: compass step" COMPASS |d| healing(d, |d| Lie::Compass(CompassLie::Offset(d.signed(5.0, 90.0) * DEG)), Class::Required);
    "heals: gyro step" ALL |d| healing(d, |d| Lie::Imu(ImuLie::GyroStep(d.along(0.1, 1.0) * DEG)), Class::Told);
    "heals: imu stuck" ALL |d| healing(d, |_| Lie::Imu(ImuLie::AllStuck), Class::Told);
    "berth: gnss jump" ALL |d| jump_at_berth(d);
    "berth: log turned" LOG |d| { let by = if d.axis() == 0 { 180.0 } else { 90.0 }; log_at_berth(d, LogLie::Turned(by * DEG)) };
    "berth: log zero" LOG |d| log_at_berth(d, LogLie::Zero);
    "moored: gnss jump" ALL |d| Strike { is_moored: true, ..jump_at_berth(d) };
    "moored: log turned" LOG |d| Strike { is_moored: true, ..log_at_berth(d, LogLie::Turned(180.0 * DEG)) };
    "outage: log" LOG |d| in_outage(d, |_| Lie::Log(LogLie::Frozen));
    "outage: compass" COMPASS |d| in_outage(d, |d| Lie::Compass(CompassLie::Offset(d.signed(10.0, 90.0) * DEG)));
    "outage: gyro" ALL |d| in_outage(d, |d| Lie::Imu(ImuLie::GyroStep(d.along(0.1, 1.0) * DEG)));
    "pair: gnss and log" LOG |d| pair(d, |d| [Lie::Gnss(GnssLie::Jump(d.vector(100.0, 1e4))), Lie::Log(LogLie::Frozen)]);
    "pair: gnss and compass" BOTH |d| pair(d, |d| [Lie::Gnss(GnssLie::Jump(d.vector(100.0, 1e4))), Lie::Compass(CompassLie::Offset(d.signed(10.0, 90.0) * DEG))]);
    "pair: log and compass" BOTH |d| pair(d, |d| [Lie::Log(LogLie::Frozen), Lie::Compass(CompassLie::Offset(d.signed(10.0, 90.0) * DEG))]);
    "pair: gnss and log fast" LOG both_fast;
};

fn strike(told: Vec<Told>, asked: Asked) -> Strike {
    let words: Vec<String> = told.iter().map(|told| format!("{:?}", told.lie)).collect();
    Strike { told, size: words.join(" and "), asked, judged_from: 0.0, is_moored: false }
}

fn of(d: &mut Draw, lie: Lie, class: Class, is_named: bool) -> Strike {
    let window = d.onset();
    strike(vec![Told { lie, window }], Asked::Of { class, is_named })
}

fn bounded(d: &mut Draw, lie: Lie) -> Strike {
    of(d, lie, Class::Bounded, false)
}

fn unnamed(d: &mut Draw, lie: Lie) -> Strike {
    of(d, lie, Class::Required, false)
}

fn gnss(d: &mut Draw, lie: GnssLie, class: Class) -> Strike {
    of(d, Lie::Gnss(lie), class, false)
}

fn unnamed_gnss(d: &mut Draw, lie: GnssLie) -> Strike {
    let class = if d.suite.has_log() { Class::Required } else { Class::Told };
    of(d, Lie::Gnss(lie), class, false)
}

fn log(d: &mut Draw, lie: LogLie) -> Strike {
    of(d, Lie::Log(lie), Class::Required, true)
}

fn compass(d: &mut Draw, lie: CompassLie) -> Strike {
    of(d, Lie::Compass(lie), Class::Required, true)
}

fn compass_drift(d: &mut Draw) -> Strike {
    let rate = d.signed(10.0, 60.0) * PER_HOUR;
    let window = d.onset();
    let told = vec![Told { lie: Lie::Compass(CompassLie::Drift(rate)), window }];
    strike(told, Asked::After { seconds: heading_shown_after(d.grade, d.suite, rate) })
}

fn imu(d: &mut Draw, lie: ImuLie) -> Strike {
    of(d, Lie::Imu(lie), Class::Told, false)
}

fn by_evidence(
    d: &mut Draw,
    lie: GnssLie,
    velocity_is_honest: bool,
    off: impl Fn(f64) -> f64 + 'static,
) -> Strike {
    let window = d.onset();
    let told = vec![Told { lie: Lie::Gnss(lie), window }];
    strike(told, Asked::ByEvidence { off: Box::new(off), velocity_is_honest })
}

fn jump(d: &mut Draw, least: f64, greatest: f64) -> Strike {
    let by = d.vector(least, greatest);
    by_evidence(d, GnssLie::Jump(by), true, move |_| by.norm())
}

fn drag(d: &mut Draw, least: f64, greatest: f64, consistent: bool) -> Strike {
    let velocity = d.vector(least, greatest);
    let speed = velocity.norm();
    by_evidence(d, GnssLie::Drag { velocity, consistent }, !consistent, move |t| speed * t)
}

fn creep(d: &mut Draw) -> Strike {
    let by = d.vector(5e-4, 1e-2);
    let size = by.norm();
    by_evidence(d, GnssLie::Creep(by), false, move |t| 0.5 * size * t * t)
}

fn frozen(d: &mut Draw, lie: GnssLie, velocity_is_honest: bool) -> Strike {
    by_evidence(d, lie, velocity_is_honest, |t| UNDER_WAY * t)
}

fn velocity(d: &mut Draw, lie: GnssLie) -> Strike {
    let proven = d.suite.has_log() || d.grade == Grade::Navigation;
    of(d, Lie::Gnss(lie), if proven { Class::Required } else { Class::Told }, true)
}

fn height(d: &mut Draw) -> Strike {
    let lie = Lie::Gnss(GnssLie::Height(d.signed(20.0, 500.0)));
    let class = if d.suite.has_log() { Class::Required } else { Class::Bounded };
    of(d, lie, class, false)
}

fn second_drag(d: &mut Draw) -> Strike {
    let lie = Lie::Gnss(GnssLie::SecondDrag(d.vector(0.3, 3.0)));
    let class = if d.suite.has_log() { Class::Required } else { Class::Told };
    of(d, lie, class, true)
}

fn start_offset(d: &mut Draw, least: f64, greatest: f64) -> Strike {
    let by = d.signed(least, greatest);
    let shown = d.suite.has_log() || d.grade == Grade::Navigation || by.abs() > 45.0;
    let class = if shown { Class::Required } else { Class::Bounded };
    let window = Window { from: 0.0, until: f64::INFINITY };
    let told = vec![Told { lie: Lie::Compass(CompassLie::Offset(by * DEG)), window }];
    Strike { judged_from: STARTED, ..strike(told, Asked::Of { class, is_named: true }) }
}

fn small_gyro(d: &mut Draw) -> Vector3<f64> {
    let [least, greatest] = match d.grade {
        Grade::Navigation => [0.05, 1.0],
        Grade::Mems => [20.0, 100.0],
    };
    d.along(least, greatest) * PER_HOUR
}

/// Fifty times the noise of the grade, of a sample at 100 Hz.
fn noise(grade: Grade) -> ImuLie {
    let [gyro, accel] = match grade {
        Grade::Navigation => [0.003, 0.005_884],
        Grade::Mems => [0.2, 0.058_84],
    };
    let of_sample = (0.01_f64 / 3600.0).sqrt() * 50.0;
    ImuLie::Noise { gyro: gyro * DEG * of_sample, accel: accel * of_sample }
}

fn healing(d: &mut Draw, lie: fn(&mut Draw) -> Lie, class: Class) -> Strike {
    let lie = lie(d);
    let window = d.moment();
    strike(vec![Told { lie, window }], Asked::Of { class, is_named: class == Class::Required })
}

/// While she aligns; where neither log nor compass carry a heading on, it is told.
fn jump_at_berth(d: &mut Draw) -> Strike {
    let lie = Lie::Gnss(GnssLie::Jump(d.vector(30.0, 1e5)));
    let carries_on = d.suite.has_log() && (d.grade == Grade::Navigation || d.suite.has_compass());
    let class = if carries_on { Class::Required } else { Class::Told };
    let window = d.at_berth();
    strike(vec![Told { lie, window }], Asked::Of { class, is_named: true })
}

/// While she aligns; it is shown when she makes way.
fn log_at_berth(d: &mut Draw, lie: LogLie) -> Strike {
    let window = d.at_berth();
    let asked = Asked::After { seconds: UNDER_WAY_FROM - window.from };
    strike(vec![Told { lie: Lie::Log(lie), window }], asked)
}

/// By the same share.
fn both_fast(d: &mut Draw) -> Strike {
    let share = d.signed(0.05, 0.5);
    let window = d.onset();
    let lies = [Lie::Gnss(GnssLie::Fast(share)), Lie::Log(LogLie::Scale(1.0 + share))];
    strike(lies.map(|lie| Told { lie, window }).to_vec(), Asked::Unshown)
}

fn in_outage(d: &mut Draw, lie: fn(&mut Draw) -> Lie) -> Strike {
    let lie = lie(d);
    let outage = d.moment();
    let window = Window { from: outage.from + 5.0, until: f64::INFINITY };
    let told = vec![Told { lie: Lie::Outage, window: outage }, Told { lie, window }];
    strike(told, Asked::Of { class: Class::Told, is_named: false })
}

fn pair(d: &mut Draw, lies: fn(&mut Draw) -> [Lie; 2]) -> Strike {
    let lies = lies(d);
    let window = d.onset();
    let told = lies.map(|lie| Told { lie, window }).to_vec();
    strike(told, Asked::Of { class: Class::Told, is_named: false })
}
