//! Ports, sensors, sources and time, as they changed.

use std::collections::BTreeMap;

use insd_base::{PortId, PortState, Span, Stamp, Time, UtcTime};
use insd_intake::choice::Chosen;
use insd_intake::clock::{TimeChange, TimeQuality};
use insd_intake::event::{Happening, IntakeEvent};

use super::lane::Lane;
use crate::report::bounded::Bounded;
use crate::report::statistics::Statistics;

/// Bits in a lane: as it should be; not quite; not at all.
pub(crate) const GOOD: u16 = 1;
/// See [`GOOD`].
pub(crate) const POOR: u16 = 2;
/// See [`GOOD`].
pub(crate) const BAD: u16 = 4;
/// Changes kept at each end of the recording.
const KEPT: usize = 50;

/// One port or sensor.
#[derive(Clone, Debug)]
pub(crate) struct Line {
    pub(crate) lane: Lane,
    /// Lengths of the silences that ended, s.
    pub(crate) silences: Statistics,
    silent: Option<Time>,
    invalid: bool,
}

/// All that comes in.
#[derive(Clone, Debug)]
pub(crate) struct Border {
    start: Time,
    pub(crate) ports: BTreeMap<PortId, Line>,
    pub(crate) sensors: BTreeMap<usize, Line>,
    pub(crate) chosen: Bounded<(Time, Chosen)>,
    pub(crate) clock: Lane,
    pub(crate) time_changes: Bounded<(Time, TimeChange)>,
    /// When UTC was known first.
    pub(crate) utc_since: Option<Time>,
    /// System clock minus UTC at the end.
    pub(crate) system_error: Option<Span>,
}

impl Line {
    fn new(start: Time) -> Self {
        let silences = Statistics::default();
        Line { lane: Lane::new(start), silences, silent: None, invalid: false }
    }

    fn silent(&mut self, now: Time) {
        self.silent.get_or_insert(now);
        self.lane.last(now, BAD);
    }

    fn speaks(&mut self, now: Time) {
        if let Some(since) = self.silent.take() {
            self.silences.add((now - since).as_seconds());
        }
        self.lane.last(now, if self.invalid { POOR } else { GOOD });
    }

    fn finish(&mut self, now: Time) {
        self.lane.finish(now);
        if let Some(since) = self.silent.take() {
            self.silences.add((now - since).as_seconds());
        }
    }
}

impl Border {
    pub(crate) fn new(start: Time) -> Self {
        let mut clock = Lane::new(start);
        clock.last(start, quality_bit(TimeQuality::Unknown));
        Border {
            start,
            ports: BTreeMap::new(),
            sensors: BTreeMap::new(),
            chosen: Bounded::new(KEPT),
            clock,
            time_changes: Bounded::new(KEPT),
            utc_since: None,
            system_error: None,
        }
    }

    /// What the two clocks of the computer and UTC say.
    pub(crate) fn clocks(&mut self, stamp: &Stamp, utc: Option<UtcTime>) {
        if let Some(utc) = utc {
            self.utc_since.get_or_insert(stamp.monotonic);
            self.system_error = Some(stamp.system.since(utc));
        }
    }

    /// Takes an event.
    pub(crate) fn event(&mut self, event: &IntakeEvent) {
        let now = event.time;
        match &event.what {
            Happening::Port { port, state } => self.port(now, *port, state),
            Happening::SensorSpeaks { sensor } => self.sensor(*sensor).speaks(now),
            Happening::SensorSilent { sensor } => self.sensor(*sensor).silent(now),
            Happening::SensorValid { sensor, valid, .. } => {
                let line = self.sensor(*sensor);
                line.invalid = !valid;
                line.speaks(now);
            }
            Happening::Chosen(chosen) => self.chosen.push((now, *chosen)),
            Happening::Time(change) => {
                if let TimeChange::Quality(quality) = change {
                    self.clock.last(now, quality_bit(*quality));
                }
                self.time_changes.push((now, *change));
            }
            _ => {}
        }
    }

    fn port(&mut self, now: Time, port: PortId, state: &PortState) {
        let start = self.start;
        let line = self.ports.entry(port).or_insert_with(|| Line::new(start));
        match state {
            PortState::Open { .. } | PortState::Speaking => line.speaks(now),
            PortState::Silent { .. } | PortState::Absent { .. } | PortState::Lost { .. } => {
                line.silent(now);
            }
            PortState::Overrun { .. } => line.lane.mark(now, POOR),
            PortState::Ended => line.lane.last(now, 0),
            // others are heard as before
            PortState::Refused { .. } => {}
        }
    }

    fn sensor(&mut self, sensor: usize) -> &mut Line {
        let start = self.start;
        self.sensors.entry(sensor).or_insert_with(|| Line::new(start))
    }

    /// The recording ends.
    pub(crate) fn finish(&mut self, now: Time) {
        self.ports.values_mut().chain(self.sensors.values_mut()).for_each(|line| line.finish(now));
        self.clock.finish(now);
    }
}

fn quality_bit(quality: TimeQuality) -> u16 {
    match quality {
        TimeQuality::Pulses => GOOD,
        TimeQuality::Messages => POOR,
        TimeQuality::Unknown => BAD,
    }
}
