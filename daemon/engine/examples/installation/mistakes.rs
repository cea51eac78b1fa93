//! The mistakes of an installer that only the sea shows.

use insd_base::{Body, Span, Voyage};
use nalgebra::{Matrix3, Rotation3, Vector3};

/// A configuration that is wrong, or a device that is not what it is said to be.
#[derive(Clone, Copy)]
pub(crate) struct Mistake {
    pub(crate) name: &'static str,
    /// Short name of the finding that tells it; none where nothing is wrong.
    pub(crate) cause: &'static str,
    pub(crate) make: fn(&mut Voyage),
    /// What of the scenario is another, `KEY=VALUE`.
    pub(crate) ship: Option<&'static str>,
}

const fn mistake(name: &'static str, cause: &'static str, make: fn(&mut Voyage)) -> Mistake {
    Mistake { name, cause, make, ship: None }
}

/// The same on a ship whose antenna is 33 m above her IMU.
const fn high(mistake: Mistake) -> Mistake {
    Mistake { ship: Some("gnss.lever_arm_m=[-6.0, -0.8, -33.0]"), ..mistake }
}

fn lever(voyage: &mut Voyage, change: impl Fn([f64; 3]) -> [f64; 3]) {
    let [forward, starboard, down] = change(voyage.header.lever_arms.gnss.0.into());
    voyage.header.lever_arms.gnss = Body::new(forward, starboard, down);
}

/// The IMU turned in the ship by roll, pitch and yaw, deg, and not said to be.
fn turn(voyage: &mut Voyage, angles: [f64; 3]) {
    let [roll, pitch, yaw] = angles.map(f64::to_radians);
    let c: Matrix3<f64> = Rotation3::from_euler_angles(roll, pitch, yaw).inverse().into_inner();
    for sample in &mut voyage.imu {
        sample.message.delta_theta.0 = c * sample.message.delta_theta.0;
        sample.message.delta_velocity.0 = c * sample.message.delta_velocity.0;
    }
}

fn scale_imu(voyage: &mut Voyage, rotation: f64, velocity: f64) {
    for sample in &mut voyage.imu {
        sample.message.delta_theta.0 *= rotation;
        sample.message.delta_velocity.0 *= velocity;
    }
}

/// An axis of the gyros, and of the accelerometers as well if their factor is -1, of the wrong sign.
fn mirror(voyage: &mut Voyage, axis: usize, accel: f64) {
    for sample in &mut voyage.imu {
        sample.message.delta_theta.0[axis] *= -1.0;
        sample.message.delta_velocity.0[axis] *= accel;
    }
}

/// Forward is told as starboard, and starboard as forward.
fn swap(voyage: &mut Voyage) {
    for sample in &mut voyage.imu {
        sample.message.delta_theta.0.swap_rows(0, 1);
        sample.message.delta_velocity.0.swap_rows(0, 1);
    }
}

fn log(voyage: &mut Voyage, change: impl Fn(Vector3<f64>) -> Vector3<f64>) {
    for log in &mut voyage.log {
        let told = [log.message.u, log.message.v, log.message.w].map(Option::unwrap_or_default);
        let changed = change(Vector3::from(told));
        log.message.u = log.message.u.map(|_| changed.x);
        log.message.v = log.message.v.map(|_| changed.y);
        log.message.w = log.message.w.map(|_| changed.z);
    }
}

fn late(voyage: &mut Voyage, by: f64) {
    for fix in &mut voyage.gnss {
        fix.message.time = fix.message.time + Span::from_seconds(by);
        fix.arrival = Some(fix.message.time);
    }
}

const LEVER: &str = "gnss_lever";
const TILTED: &str = "mounting_tilted";
const TURNED: &str = "mounting_turned";
const AXES: &str = "imu_axes";
const LOG: &str = "log_mounting";

/// All of them; the first is none.
pub(crate) const MISTAKES: [Mistake; 35] = [
    mistake("as configured", "", |_| {}),
    mistake("down sign", LEVER, |v| lever(v, |[x, y, z]| [x, y, -z])),
    mistake("forward sign", LEVER, |v| lever(v, |[x, y, z]| [-x, y, z])),
    mistake("all signs", LEVER, |v| lever(v, |[x, y, z]| [-x, -y, -z])),
    mistake("ten times", LEVER, |v| lever(v, |arm| arm.map(|m| 10.0 * m))),
    mistake("axes swapped", LEVER, |v| lever(v, |[x, y, z]| [y, x, z])),
    mistake("up for forward", LEVER, |v| lever(v, |[x, y, z]| [-z, y, x])),
    mistake("feet for metres", LEVER, |v| lever(v, |arm| arm.map(|m| 3.28 * m))),
    mistake("from the keel", LEVER, |v| lever(v, |[x, y, z]| [x, y, z - 9.0])),
    mistake("from the stern", LEVER, |v| lever(v, |[x, y, z]| [x + 60.0, y, z])),
    mistake("not measured", "gnss_lever_unmeasured", |v| lever(v, |_| [0.0; 3])),
    high(mistake("high mast", "", |_| {})),
    high(mistake("high mast, sign", LEVER, |v| lever(v, |[x, y, z]| [x, y, -z]))),
    high(mistake("high mast, zeros", "gnss_lever_unmeasured", |v| lever(v, |_| [0.0; 3]))),
    mistake("log lever sign", "log_lever", |v| {
        v.header.lever_arms.log.0 = -v.header.lever_arms.log.0;
    }),
    mistake("IMU upside down", TILTED, |v| turn(v, [180.0, 0.0, 0.0])),
    mistake("IMU down, aft", TILTED, |v| turn(v, [0.0, 180.0, 0.0])),
    mistake("IMU on its side", TILTED, |v| turn(v, [90.0, 0.0, 0.0])),
    mistake("IMU on its nose", TILTED, |v| turn(v, [0.0, -90.0, 0.0])),
    mistake("IMU turned 90", TURNED, |v| turn(v, [0.0, 0.0, 90.0])),
    mistake("IMU turned 180", TURNED, |v| turn(v, [0.0, 0.0, 180.0])),
    mistake("IMU turned 270", TURNED, |v| turn(v, [0.0, 0.0, 270.0])),
    mistake("accel in g", "imu_force", |v| scale_imu(v, 1.0, 1.0 / 9.80665)),
    mistake("gyro in deg", "imu_rate", |v| scale_imu(v, 57.295_78, 1.0)),
    mistake("gyro x mirrored", AXES, |v| mirror(v, 0, 1.0)),
    mistake("gyro y mirrored", AXES, |v| mirror(v, 1, 1.0)),
    mistake("gyro z mirrored", "imu_turns", |v| mirror(v, 2, 1.0)),
    mistake("y mirrored", AXES, |v| mirror(v, 1, -1.0)),
    mistake("x, y swapped", AXES, swap),
    mistake("log reversed", LOG, |v| log(v, |u| -u)),
    mistake("log quarter turn", LOG, |v| log(v, |u| Vector3::new(-u.y, u.x, u.z))),
    mistake("log in knots", LOG, |v| log(v, |u| u / 0.514_444)),
    mistake("log in km/h", LOG, |v| log(v, |u| u * 3.6)),
    mistake("GNSS 0.5 s late", "gnss_delay", |v| late(v, 0.5)),
    mistake("GNSS 0.2 s late", "gnss_delay", |v| late(v, 0.2)),
];
