//! One sensor at work.

use std::collections::VecDeque;

use insd_base::Time;
use insd_wire::gnss::GnssPart;

use super::QUANTITIES;
use super::sky::Sky;
use crate::base::Base;
use crate::camera::CameraIntake;
use crate::choice::Quantity;
use crate::config::{IntakeConfig, Kind, Role, SensorConfig};
use crate::decode::Decoder;
use crate::device::DeviceChoice;
use crate::port::Link;
use crate::sensor::{Epoch, EpochBuilder, Gravity, ImuIntake, ImuSettings, Pace, Warmth};
use crate::status::SensorStatus;

/// One sensor at work.
#[derive(Clone, Debug)]
pub(crate) struct Sensor {
    pub(crate) config: SensorConfig,
    pub(crate) port: usize,
    pub(crate) status: SensorStatus,
    pub(super) decoder: Decoder,
    /// Which of the devices of a bus it is.
    pub(super) device: DeviceChoice,
    pub(super) imu: Option<ImuIntake>,
    pub(super) epochs: EpochBuilder,
    pub(super) waiting: VecDeque<Epoch>,
    /// Parts of epochs, with the times of their first and last bytes, before a date was known.
    pub(super) undated: Vec<(GnssPart, (Time, Time))>,
    /// How often it gives each quantity that is timed by its receipt.
    pub(super) paces: [Pace; QUANTITIES.len()],
    /// What is made of its raw messages, from the first one on.
    pub(super) sky: Option<Box<Sky>>,
    /// What is made of a base's messages.
    pub(super) base: Option<Box<Base>>,
    /// What is made of what a camera's front end tells.
    pub(super) camera: Option<Box<CameraIntake>>,
    /// When it told a fix of its own last, or that it has none.
    pub(super) fixed: Option<Time>,
    /// What it says is new, and not read from a file.
    pub(super) live: bool,
    /// Whether an IMU's specific force is gravity, in the mean.
    pub(super) gravity: Gravity,
    /// How warm an IMU is.
    pub(super) warmth: Warmth,
    /// Its number among the sensors of its role.
    pub(super) number: u8,
    /// Whether it is watched, and not used.
    pub(super) watched: bool,
}

impl Sensor {
    pub(super) fn new(config: &SensorConfig, intake: &IntakeConfig, number: u8) -> Self {
        let port = intake.ports.iter().position(|port| port.name == config.port);
        let settings = config.mounting.c_bd().map(|c_bd| ImuSettings {
            period: 1.0 / config.rate_hz,
            latency: config.latency_s,
            time_base: config.time,
            c_bd,
        });
        let is_imu = config.kind.role() == Role::Imu;
        Sensor {
            config: config.clone(),
            port: port.unwrap_or(usize::MAX),
            status: SensorStatus { name: config.name.clone(), ..SensorStatus::default() },
            decoder: Decoder::new(config),
            device: DeviceChoice::new(config.device, config.patience_s),
            imu: settings.filter(|_| is_imu).map(ImuIntake::new),
            epochs: EpochBuilder::default(),
            waiting: VecDeque::new(),
            undated: Vec::new(),
            sky: None,
            base: (config.kind.role() == Role::Base).then(|| Box::new(Base::new(config.base))),
            camera: (config.kind.role() == Role::Camera).then(Box::default),
            fixed: None,
            paces: [Pace::default(); QUANTITIES.len()],
            live: port.is_none_or(|port| intake.ports[port].link != Link::File),
            gravity: Gravity::default(),
            warmth: Warmth::default(),
            number,
            watched: intake.watched.contains(&config.name),
        }
    }

    /// What it may be chosen for.
    pub(super) fn quantities(&self) -> &'static [Quantity] {
        match self.config.kind.role() {
            _ if self.watched => &[],
            Role::Imu => &[Quantity::Inertial],
            Role::Gnss if self.config.heading => &[Quantity::Gnss, Quantity::Heading],
            Role::Gnss => &[Quantity::Gnss],
            Role::Ranging if self.config.kind == Kind::Rls => &[Quantity::Heading],
            Role::Base | Role::Ranging | Role::Camera | Role::Attitude => &[],
            Role::Log => &[Quantity::BottomVelocity, Quantity::WaterVelocity],
            Role::Heading => &[Quantity::Heading],
            Role::Position if self.config.kind == Kind::Manual => {
                &[Quantity::Position, Quantity::Heading]
            }
            Role::Position => &[Quantity::Position],
        }
    }
}
