//! From what reaches the computer to what was measured when.
//!
//! [`Intake::handle`] takes what arrives at the ports in the order of arrival; then
//! [`Intake::poll_output`] is drained: measurements for the engine, on the ship's time line, and what
//! is worth telling. The daemon and the replay of a raw recording run this very same code.
//!
//! Pure: no I/O, no clock, no thread, no log.

pub mod base;
mod camera;
pub mod can;
pub mod choice;
pub mod clock;
pub mod config;
pub mod decode;
pub mod device;
pub mod event;
mod intaken;
mod kind;
pub mod mounting;
pub mod port;
pub mod ranging;
pub mod satellites;
pub mod sensor;
pub mod status;
pub mod watched;

mod core;
mod inertial;
mod magnetic;

pub use intaken::Intaken;
pub use magnetic::variation;

use insd_wire::stream::Protocol;

use insd_base::{Arrival, Input, PortState, Sent, Stamp, Time, UtcTime};

use crate::can::CanIntake;
use crate::choice::Quantity;
use crate::config::IntakeConfig;
use crate::core::Core;
use crate::event::Happening;
use crate::port::PortIntake;
use crate::status::{ChoiceStatus, IntakeStatus, PortStatus, PortTold, SensorStatus, TimeStatus};

/// Time between looks for silences, s.
const TICK: f64 = 0.1;

/// All ports and sensors of a ship.
#[derive(Clone, Debug)]
pub struct Intake {
    ports: Vec<Port>,
    core: Core,
    ticked: Option<Time>,
}

#[derive(Clone, Debug)]
struct Port {
    name: String,
    intake: PortIntake,
    can: CanIntake,
    told: PortTold,
    heard: Option<Time>,
}

impl Intake {
    /// An intake for what is plugged in. Descriptions with faults are taken as far as they go; look at
    /// [`IntakeConfig::faults`] first.
    #[must_use]
    pub fn new(config: &IntakeConfig) -> Self {
        let ports = config.ports.iter().map(|port| Port {
            name: port.name.clone(),
            intake: PortIntake::new(port.link, &config.protocols(&port.name)),
            can: CanIntake::new(port.link, config.speaks_n2k(&port.name)),
            told: PortTold::default(),
            heard: None,
        });
        Intake { ports: ports.collect(), core: Core::new(config), ticked: None }
    }

    /// Takes what arrived, in order of arrival. A port that is not in the configuration is ignored.
    pub fn handle(&mut self, arrival: &Arrival) {
        let index = usize::from(arrival.port.0);
        let stamp = &arrival.stamp;
        if let Some(port) = self.ports.get_mut(index) {
            let core = &mut self.core;
            match &arrival.input {
                Input::Bytes(bytes) | Input::Sent(Sent { bytes, .. }) => {
                    port.heard = Some(stamp.monotonic);
                    let Port { intake, can, .. } = port;
                    intake.take(stamp, bytes, |frame| match frame.protocol {
                        Protocol::Ngt1 => can.adapted(index, stamp, frame, core),
                        _ => core.frame(index, stamp, frame),
                    });
                }
                Input::Can(frame) => {
                    port.heard = Some(stamp.monotonic);
                    port.can.take(index, stamp, frame, core);
                }
                Input::Bus(event) => {
                    port.can.hear(*event);
                    core.bus(arrival.port, stamp.monotonic, *event);
                }
                Input::Pulse(pulse) => {
                    port.heard = Some(stamp.monotonic);
                    core.utc.pulse(*pulse);
                }
                Input::Tick | Input::Order(_) | Input::Storage(_) => {}
                Input::State(state) => {
                    if matches!(state, PortState::Lost { .. } | PortState::Ended) {
                        port.intake.interrupt(stamp, |frame| core.frame(index, stamp, frame));
                    }
                    port.told.note(state);
                    let (port, state) = (arrival.port, state.clone());
                    core.tell(stamp.monotonic, Happening::Port { port, state });
                }
            }
        }
        self.tick(stamp);
    }

    /// The next measurement or event, until there is none.
    pub fn poll_output(&mut self) -> Option<Intaken> {
        self.core.outputs.pop_front()
    }

    /// UTC at an instant of the ship's time line, if it is known.
    #[must_use]
    pub fn utc_at(&self, time: Time) -> Option<UtcTime> {
        self.core.utc.utc_at(time)
    }

    /// Name of a port; empty if there is none of this number.
    #[must_use]
    pub fn port_name(&self, port: insd_base::PortId) -> &str {
        self.ports.get(usize::from(port.0)).map_or("", |port| &port.name)
    }

    /// Name of a sensor by its index in events.
    #[must_use]
    pub fn sensor_name(&self, sensor: usize) -> &str {
        self.core.sensors.get(sensor).map_or("", |sensor| &sensor.config.name)
    }

    /// What is known of the sensor in use for a quantity, if there is one.
    #[must_use]
    pub fn in_use(&self, quantity: Quantity) -> Option<&SensorStatus> {
        let choice = self.core.choices.iter().find(|choice| choice.quantity() == quantity)?;
        Some(&self.core.sensors.get(choice.current()?)?.status)
    }

    /// When each sensor spoke last, in the order of the configuration.
    pub fn heard(&self) -> impl Iterator<Item = Option<Time>> + '_ {
        self.core.sensors.iter().map(|sensor| sensor.status.heard)
    }

    /// Everything there is to know of ports, sensors, choices and time.
    #[must_use]
    pub fn status(&self) -> IntakeStatus {
        let ports = self.ports.iter().map(|port| PortStatus {
            name: port.name.clone(),
            told: port.told.clone(),
            counts: port.can.counts(port.intake.counts()),
            heard: port.heard,
            bus: port.can.bus(),
            nodes: port.can.nodes(),
        });
        let sensors = self.core.sensors.iter().map(|sensor| sensor.status.clone());
        let choices = self.core.choices.iter();
        let now = self.ticked;
        IntakeStatus {
            ports: ports.collect(),
            sensors: sensors.collect(),
            choices: choices
                .map(|choice| ChoiceStatus {
                    quantity: choice.quantity(),
                    sensor: choice.current(),
                    why: choice.why(),
                })
                .collect(),
            time: TimeStatus {
                utc: now.and_then(|now| self.utc_at(now)),
                quality: self.core.utc.quality(),
                sigma: self.core.utc.sigma(),
            },
        }
    }

    fn tick(&mut self, stamp: &Stamp) {
        let now = stamp.monotonic;
        let due = self.ticked.is_none_or(|last| (now - last).as_seconds() >= TICK);
        if due {
            self.ticked = Some(now);
            self.core.tick(stamp);
        }
    }
}
