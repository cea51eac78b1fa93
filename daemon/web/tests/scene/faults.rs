//! Twelve things that go wrong, each as it looks from its beginning on: what the daemon publishes then.

use insd_web::snapshot::{Sensor, SensorState, Snapshot};

/// What goes wrong.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Trouble {
    /// The IMU is silent: the engine stands still where it was.
    ImuSilent,
    /// The thread of the engine publishes no more.
    EngineStalled,
    GnssLost,
    LogLost,
    CompassLost,
    AllSensorsLost,
    /// The navigator waits for its IMU.
    Standby,
    /// The solution is not sound.
    InFault,
    /// The daemon was started again: its time begins anew, and nothing is known yet.
    Restart,
    /// The port of the IMU is gone, and with it all that comes from there.
    PortVanished,
    /// The page cannot be reached any more.
    ConnectionLost,
    /// UTC and the computer's clock leap by an hour.
    ClockJump,
}

impl Trouble {
    pub(crate) const ALL: [Trouble; 12] = [
        Trouble::ImuSilent,
        Trouble::EngineStalled,
        Trouble::GnssLost,
        Trouble::LogLost,
        Trouble::CompassLost,
        Trouble::AllSensorsLost,
        Trouble::Standby,
        Trouble::InFault,
        Trouble::Restart,
        Trouble::PortVanished,
        Trouble::ConnectionLost,
        Trouble::ClockJump,
    ];

    /// Whether the ship's motion is still known while it lasts.
    pub(crate) fn leaves_motion(self) -> bool {
        matches!(
            self,
            Trouble::GnssLost | Trouble::LogLost | Trouble::CompassLost | Trouble::ClockJump
        )
    }

    /// The sensor of the scene that is not heard any more.
    pub(crate) fn lost_sensor(self) -> Option<&'static str> {
        match self {
            Trouble::ImuSilent | Trouble::AllSensorsLost | Trouble::PortVanished => Some("imu"),
            Trouble::GnssLost => Some("gnss"),
            Trouble::CompassLost => Some("gyro-compass"),
            Trouble::LogLost => Some("doppler"),
            _ => None,
        }
    }

    /// What is published so long after it began, s, where `last` was published before; `None` for nothing.
    pub(crate) fn strike(
        self,
        mut now: Snapshot,
        last: &Snapshot,
        since_s: f64,
    ) -> Option<Snapshot> {
        match self {
            Trouble::EngineStalled => return None,
            Trouble::ImuSilent | Trouble::AllSensorsLost | Trouble::PortVanished => {
                now.motion.clone_from(&last.motion);
                now.alignment.clone_from(&last.alignment);
                now.engines.clone_from(&last.engines);
                if self == Trouble::PortVanished {
                    now.inputs.remove(0);
                }
            }
            Trouble::Standby | Trouble::InFault => {
                let name = if self == Trouble::Standby { "standby" } else { "fault" };
                name.clone_into(&mut now.mode.name);
                (now.motion, now.alignment) = (None, None);
                now.engines.clear();
            }
            Trouble::Restart => {
                "standby".clone_into(&mut now.mode.name);
                (now.motion, now.alignment) = (None, None);
                now.time.at_s = since_s;
                now.program.uptime_s = since_s;
                now.sensors.iter_mut().for_each(unheard);
            }
            Trouble::ClockJump => {
                let leap = |utc: &mut Option<String>| {
                    *utc = utc.take().map(|utc| utc.replace("T08:", "T09:"));
                };
                leap(&mut now.time.utc);
                leap(&mut now.time.system_utc);
            }
            _ => {}
        }
        let is_lost = |sensor: &Sensor| {
            self == Trouble::AllSensorsLost || self.lost_sensor() == Some(sensor.name.as_str())
        };
        for sensor in now.sensors.iter_mut().filter(|sensor| is_lost(sensor)) {
            // the intake has not noticed yet, which takes it some seconds
            sensor.age_s = sensor.age_s.map(|_| since_s);
        }
        Some(now)
    }
}

fn unheard(sensor: &mut Sensor) {
    sensor.state = SensorState::Waiting;
    (sensor.age_s, sensor.rate_hz, sensor.temperature_c) = (None, None, None);
    (sensor.status_word, sensor.fix, sensor.satellites) = (None, None, None);
    sensor.status.clear();
    sensor.used_for.clear();
}
