//! The mistakes of an installer that only the sea shows.

use insd_base::{Body, Span, Voyage};
use nalgebra::{Matrix3, Rotation3, Vector3};

/// A configuration that is wrong, or a device that is not what it is said to be.
pub(crate) struct Mistake {
    pub(crate) name: &'static str,
    /// Short name of the finding that tells it; none where nothing is wrong.
    pub(crate) cause: &'static str,
    pub(crate) make: fn(&mut Voyage),
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
const LOG: &str = "log_mounting";

/// All of them; the first is none.
pub(crate) const MISTAKES: [Mistake; 27] = [
    Mistake { name: "as configured", cause: "", make: |_| {} },
    Mistake { name: "down sign", cause: LEVER, make: |v| lever(v, |[x, y, z]| [x, y, -z]) },
    Mistake { name: "forward sign", cause: LEVER, make: |v| lever(v, |[x, y, z]| [-x, y, z]) },
    Mistake { name: "all signs", cause: LEVER, make: |v| lever(v, |[x, y, z]| [-x, -y, -z]) },
    Mistake { name: "ten times", cause: LEVER, make: |v| lever(v, |arm| arm.map(|m| 10.0 * m)) },
    Mistake { name: "axes swapped", cause: LEVER, make: |v| lever(v, |[x, y, z]| [y, x, z]) },
    Mistake { name: "up for forward", cause: LEVER, make: |v| lever(v, |[x, y, z]| [-z, y, x]) },
    Mistake {
        name: "feet for metres",
        cause: LEVER,
        make: |v| lever(v, |arm| arm.map(|m| 3.28 * m)),
    },
    Mistake {
        name: "from the keel",
        cause: LEVER,
        make: |v| lever(v, |[x, y, z]| [x, y, z - 9.0]),
    },
    Mistake {
        name: "from the stern",
        cause: LEVER,
        make: |v| lever(v, |[x, y, z]| [x + 60.0, y, z]),
    },
    Mistake {
        name: "not measured",
        cause: "gnss_lever_unmeasured",
        make: |v| lever(v, |_| [0.0; 3]),
    },
    Mistake {
        name: "log lever sign",
        cause: "log_lever",
        make: |v| v.header.lever_arms.log.0 = -v.header.lever_arms.log.0,
    },
    Mistake { name: "IMU upside down", cause: TILTED, make: |v| turn(v, [180.0, 0.0, 0.0]) },
    Mistake { name: "IMU down, aft", cause: TILTED, make: |v| turn(v, [0.0, 180.0, 0.0]) },
    Mistake { name: "IMU on its side", cause: TILTED, make: |v| turn(v, [90.0, 0.0, 0.0]) },
    Mistake { name: "IMU on its nose", cause: TILTED, make: |v| turn(v, [0.0, -90.0, 0.0]) },
    Mistake { name: "IMU turned 90", cause: TURNED, make: |v| turn(v, [0.0, 0.0, 90.0]) },
    Mistake { name: "IMU turned 180", cause: TURNED, make: |v| turn(v, [0.0, 0.0, 180.0]) },
    Mistake { name: "IMU turned 270", cause: TURNED, make: |v| turn(v, [0.0, 0.0, 270.0]) },
    Mistake { name: "accel in g", cause: "imu_force", make: |v| scale_imu(v, 1.0, 1.0 / 9.80665) },
    Mistake { name: "gyro in deg", cause: "imu_rate", make: |v| scale_imu(v, 57.295_78, 1.0) },
    Mistake { name: "log reversed", cause: LOG, make: |v| log(v, |u| -u) },
    Mistake {
        name: "log quarter turn",
        cause: LOG,
        make: |v| log(v, |u| Vector3::new(-u.y, u.x, u.z)),
    },
    Mistake { name: "log in knots", cause: LOG, make: |v| log(v, |u| u / 0.514_444) },
    Mistake { name: "log in km/h", cause: LOG, make: |v| log(v, |u| u * 3.6) },
    Mistake { name: "GNSS 0.5 s late", cause: "gnss_delay", make: |v| late(v, 0.5) },
    Mistake { name: "GNSS 0.2 s late", cause: "gnss_delay", make: |v| late(v, 0.2) },
];
