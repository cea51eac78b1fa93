//! STA: what the system does, and how good that is.
//!
//! ```text
//! $PINSD,STA,hhmmss.ss,m,x,a,q,h,t,s,n*hh
//!            1         2 3 4 5 6 7 8 9
//! 1 UTC
//! 2 mode: S standby, C coarse alignment, F fine alignment at the berth, M alignment in motion, A aided by
//!   GNSS, D dead reckoning by log or reference, I inertial alone, X fault
//! 3 whole seconds in this mode
//! 4 heading, as THS has it: A good, E estimated, S simulated, V not valid (M: manual)
//! 5 position, as GGA has it: 0 not valid, 1 GNSS, 2 differential, 4 RTK, 5 RTK float, 6 estimated,
//!   8 simulated
//! 6 heave: 0 not settled, 1 reduced, 2 settled
//! 7 time: P by pulses, M by messages, U unknown
//! 8 1 if any of this comes from a simulator, else 0
//! 9 number of active alerts
//! ```

use insd_base::{FixQuality, HeaveQuality, Mode};

use super::{flag, read_flag, read_letter};
use crate::nmea::civil::TimeOfDay;
use crate::nmea::fault::Fault;
use crate::nmea::fields::Fields;
use crate::nmea::line::Composer;
use crate::nmea::mode::{HeadingMode, letters};

/// Greatest number of seconds and of alerts.
const MAX_SECONDS: u32 = 999_999_999;
const MAX_ALERTS: u32 = 999;

/// What the system does.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum PinsdMode {
    /// S: it waits for what it needs.
    Standby,
    /// C: levelling and first search for the heading.
    CoarseAlignment,
    /// F: at the berth.
    FineAlignment,
    /// M: under way, the heading is being found.
    InMotionAlignment,
    /// A: aligned, GNSS in use.
    Aided,
    /// D: aligned, log or reference in use, no GNSS.
    DeadReckoning,
    /// I: aligned, nothing but the IMU.
    Inertial,
    /// X: the solution must not be used.
    Fault,
}

/// How UTC is known.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum PinsdTime {
    /// P: by pulses, to microseconds.
    Pulses,
    /// M: by the receipt of messages, to milliseconds or tens of them.
    Messages,
    /// U: by the system clock alone, if at all.
    Unknown,
}

letters! {
    PinsdMode {
        Standby b'S', CoarseAlignment b'C', FineAlignment b'F', InMotionAlignment b'M',
        Aided b'A', DeadReckoning b'D', Inertial b'I', Fault b'X'
    }
    PinsdTime { Pulses b'P', Messages b'M', Unknown b'U' }
}

impl From<Mode> for PinsdMode {
    fn from(mode: Mode) -> Self {
        match mode {
            Mode::Standby => PinsdMode::Standby,
            Mode::CoarseAlignment => PinsdMode::CoarseAlignment,
            Mode::FineAlignment => PinsdMode::FineAlignment,
            Mode::InMotionAlignment => PinsdMode::InMotionAlignment,
            Mode::Aided => PinsdMode::Aided,
            Mode::DeadReckoning => PinsdMode::DeadReckoning,
            Mode::Inertial => PinsdMode::Inertial,
            Mode::Fault => PinsdMode::Fault,
        }
    }
}

/// What the system does, and how good that is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PinsdStatus {
    /// UTC.
    pub time: Option<TimeOfDay>,
    /// What it does.
    pub mode: PinsdMode,
    /// How long it has done so, whole s.
    pub seconds_in_mode: Option<u32>,
    /// How far the heading may be trusted.
    pub heading: HeadingMode,
    /// What the position stands on.
    pub position: FixQuality,
    /// How far the heave can be relied on.
    pub heave: Option<HeaveQuality>,
    /// How UTC is known.
    pub time_source: PinsdTime,
    /// Whether any of this comes from a simulator.
    pub simulated: bool,
    /// Number of active alerts.
    pub alerts: Option<u32>,
}

impl PinsdStatus {
    /// The word after the address.
    pub const NAME: &'static str = "STA";

    /// Greatest length, bytes with CR LF.
    pub const LONGEST: usize = 51;

    pub(super) fn write_fields(&self, line: &mut Composer) {
        line.text(Self::NAME);
        line.time_of_day(self.time);
        line.letter(self.mode.letter());
        line.whole(self.seconds_in_mode, 1, MAX_SECONDS);
        line.letter(self.heading.letter());
        line.letter(b'0' + self.position.as_gga());
        line.whole(self.heave.map(|heave| heave as u32), 1, 2);
        line.letter(self.time_source.letter());
        flag(line, self.simulated);
        line.whole(self.alerts, 1, MAX_ALERTS);
    }

    pub(super) fn read_fields(fields: &mut Fields<'_>) -> Result<Self, Fault> {
        let digit = |letter: u8| FixQuality::from_gga(letter.checked_sub(b'0')?);
        Ok(PinsdStatus {
            time: fields.time_of_day()?,
            mode: read_letter(fields, PinsdMode::from_letter)?,
            seconds_in_mode: fields.whole(MAX_SECONDS)?,
            heading: read_letter(fields, HeadingMode::from_letter)?,
            position: read_letter(fields, digit)?,
            heave: fields.convert(|text| match text {
                "0" => Some(HeaveQuality::Unsettled),
                "1" => Some(HeaveQuality::Reduced),
                "2" => Some(HeaveQuality::Settled),
                _ => None,
            })?,
            time_source: read_letter(fields, PinsdTime::from_letter)?,
            simulated: read_flag(fields)?,
            alerts: fields.whole(MAX_ALERTS)?,
        })
    }
}
