//! What there is to know of ports, sensors, choices and time.

use std::collections::BTreeMap;

use insd_base::can::BusEvent;
use insd_base::{PortState, Time, UtcTime};
use insd_n2k::Name;

use crate::base::BaseStatus;
use crate::choice::{Quantity, Why};
use crate::clock::TimeQuality;
use crate::device::Device;
use crate::event::Refusal;
use crate::port::PortCounts;

/// What a controller told of its bus.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub struct BusCounts {
    /// Errors on the wire.
    pub errors: u64,
    /// Times that the controller left the bus.
    pub offs: u64,
    /// Frames that the kernel dropped.
    pub dropped: u64,
    /// What it said last of its state; errors and drops are none.
    pub state: Option<BusEvent>,
}

/// One port.
#[derive(Clone, Debug, PartialEq)]
pub struct PortStatus {
    /// Its name.
    pub name: String,
    /// What it told of itself.
    pub told: PortTold,
    /// Its counters.
    pub counts: PortCounts,
    /// When bytes or frames came last.
    pub heard: Option<Time>,
    /// What its controller told of its CAN bus.
    pub bus: BusCounts,
    /// Devices of NMEA 2000 that are known by a claim: addresses and NAMEs.
    pub nodes: Vec<(u8, Name)>,
}

/// What a port told of itself.
#[derive(Clone, Debug, PartialEq, Eq, Default)]
pub struct PortTold {
    /// Its last state; `None` before it told one.
    pub state: Option<PortState>,
    /// What was opened last: device and baud rate, address, file.
    pub what: Option<String>,
    /// What the system said last when something was wrong.
    pub trouble: Option<String>,
    /// Bytes dropped because more came than could be taken.
    pub overrun: u64,
    /// Datagrams and calls of hosts that were not let in.
    pub refused: u64,
}

impl PortTold {
    /// Takes note of a state.
    pub(crate) fn note(&mut self, state: &PortState) {
        match state {
            PortState::Open { what } => self.what = Some(what.clone()),
            PortState::Absent { reason } | PortState::Lost { reason } => {
                self.trouble = Some(reason.clone());
            }
            PortState::Overrun { bytes } => {
                self.overrun = self.overrun.saturating_add(*bytes);
                return;
            }
            PortState::Refused { count, .. } => {
                self.refused = self.refused.saturating_add(*count);
                return;
            }
            PortState::Silent { .. } | PortState::Speaking | PortState::Ended => {}
        }
        self.state = Some(state.clone());
    }
}

/// One sensor.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct SensorStatus {
    /// Its name.
    pub name: String,
    /// When it spoke last.
    pub heard: Option<Time>,
    /// Whether it has been silent for longer than its patience.
    pub silent: bool,
    /// Whether it stands behind what it says; `None` before it has said anything.
    pub valid: Option<bool>,
    /// Its status word, if its format has one.
    pub status: u32,
    /// Temperature, deg C, if it tells.
    pub temperature: Option<f64>,
    /// Measurements passed on.
    pub passed: u64,
    /// Measurements and frames not passed on, by reason.
    pub refused: BTreeMap<Refusal, u64>,
    /// Samples missing by its counter.
    pub lost: u64,
    /// Which device of a bus it is.
    pub device: Option<Device>,
    /// Of a base station: what is known of it.
    pub base: Option<BaseStatus>,
    /// What it tells and the navigator has no use for.
    pub shown: Shown,
}

/// What is shown and not used: the last that was told.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Shown {
    /// Rate of turn, rad/s, bow to starboard positive.
    pub rate_of_turn: Option<f64>,
    /// Roll, rad, starboard side down positive.
    pub roll: Option<f64>,
    /// Pitch, rad, bow up positive.
    pub pitch: Option<f64>,
    /// Distance in all, m.
    pub distance: Option<f64>,
    /// Distance since the last reset, m.
    pub trip: Option<f64>,
}

impl Shown {
    /// Enters what one message tells.
    pub(crate) fn enter(&mut self, part: ShownPart) {
        match part {
            ShownPart::RateOfTurn(rate) => self.rate_of_turn = rate,
            ShownPart::Tilt { roll, pitch } => (self.roll, self.pitch) = (roll, pitch),
            ShownPart::Distance { log, trip } => (self.distance, self.trip) = (log, trip),
        }
    }
}

/// What one message tells of it; what is not available is `None`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ShownPart {
    /// Rate of turn, rad/s.
    RateOfTurn(Option<f64>),
    /// Roll and pitch, rad.
    Tilt {
        /// Roll.
        roll: Option<f64>,
        /// Pitch.
        pitch: Option<f64>,
    },
    /// Distances, m.
    Distance {
        /// In all.
        log: Option<f64>,
        /// Since the last reset.
        trip: Option<f64>,
    },
}

/// The source of one quantity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ChoiceStatus {
    /// Of what.
    pub quantity: Quantity,
    /// Index of the sensor in use; `None` where there is none.
    pub sensor: Option<usize>,
    /// Why that one; `None` before any has been valid.
    pub why: Option<Why>,
}

/// Time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TimeStatus {
    /// UTC now, if it is known.
    pub utc: Option<UtcTime>,
    /// How it is known.
    pub quality: TimeQuality,
    /// 1-sigma, s, apart from the least delay of messages.
    pub sigma: Option<f64>,
}

/// Everything at once.
#[derive(Clone, Debug, PartialEq)]
pub struct IntakeStatus {
    /// Ports, in their order.
    pub ports: Vec<PortStatus>,
    /// Sensors, in their order.
    pub sensors: Vec<SensorStatus>,
    /// Which sensor is used for what, and why.
    pub choices: Vec<ChoiceStatus>,
    /// Time.
    pub time: TimeStatus,
}
