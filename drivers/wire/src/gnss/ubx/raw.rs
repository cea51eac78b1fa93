//! RXM-RAWX and RXM-SFRBX: what the receiver measured and what the satellites sent, to be passed on.
//!
//! Layouts: u-blox ZED-F9P Interface Description (UBX-18010854).

use insd_base::satellites::{SatelliteEpoch, SignalObservation};

use super::field::bit;
use super::frame::{Frame, framed};
use super::signal::Signal;
use crate::binary::{BinaryFault, Reader, Writer};
use crate::gnss::{NavigationWords, gps_time};

/// Class and id of RXM-RAWX.
pub(super) const RAWX: (u8, u8) = (0x02, 0x15);

/// Class and id of RXM-SFRBX.
pub(super) const SFRBX: (u8, u8) = (0x02, 0x13);

/// Longest lock that is told, s.
const LONGEST_LOCK: f64 = 64.5;

/// Seconds of a week.
const WEEK: f64 = 604_800.0;

/// One measurement of RXM-RAWX.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RawMeasurement {
    /// `prMes`: pseudorange, m; `None` unless `prValid`.
    pub pseudorange: Option<f64>,
    /// `cpMes`: carrier phase, cycles; `None` unless `cpValid`.
    pub carrier_phase: Option<f64>,
    /// `doMes`: Doppler shift, Hz, positive when the satellite approaches.
    pub doppler: f32,
    /// Of which signal.
    pub signal: Signal,
    /// `locktime`: how long the carrier is locked, s, at most 64.5.
    pub lock_time: f64,
    /// `cno`: carrier to noise density, dB-Hz.
    pub carrier_to_noise: u8,
    /// `prStdev`: its exponent n, 0 to 15; 1-sigma is 0.01 m * 2^n.
    pub pseudorange_exponent: u8,
    /// `cpStdev`: 1-sigma of the carrier phase, cycles, steps of 0.004, at most 0.056.
    pub carrier_phase_std: Option<f64>,
    /// `doStdev`: its exponent n, 0 to 15; 1-sigma is 0.002 Hz * 2^n.
    pub doppler_exponent: u8,
    /// `halfCyc`: the half cycle is resolved.
    pub half_cycle_valid: bool,
    /// `subHalfCyc`: a half cycle was subtracted.
    pub half_cycle_subtracted: bool,
}

/// RXM-RAWX.
#[derive(Clone, Debug, PartialEq)]
pub struct RxmRawx {
    /// `rcvTow`: time of the week by the receiver's clock, s.
    pub time_of_week: f64,
    /// `week`: GPS week, without rollover.
    pub week: u16,
    /// `leapS`: GPS - UTC, s, at best knowledge.
    pub leap_seconds: i8,
    /// `leapSec`: that they are certain.
    pub leap_seconds_valid: bool,
    /// `clkReset`: the receiver's clock was reset.
    pub clock_reset: bool,
    /// At most 255.
    pub measurements: Vec<RawMeasurement>,
}

impl RawMeasurement {
    fn read(reader: &mut Reader<'_>) -> Result<Self, BinaryFault> {
        let (pseudorange, carrier_phase) = (reader.le_f64()?, reader.le_f64()?);
        let doppler = reader.le_f32()?;
        let [system, satellite, signal, slot] = reader.array()?;
        let lock_time = f64::from(reader.le_u16()?) * 1e-3;
        let [carrier_to_noise, range_std, phase_std, doppler_std, status, _] = reader.array()?;
        let phase_std = phase_std & 15;
        Ok(RawMeasurement {
            pseudorange: bit(status, 0).then_some(pseudorange),
            carrier_phase: bit(status, 1).then_some(carrier_phase),
            doppler,
            signal: Signal { system, satellite, signal, slot },
            lock_time,
            carrier_to_noise,
            pseudorange_exponent: range_std & 15,
            carrier_phase_std: (phase_std != 15).then(|| f64::from(phase_std) * 0.004),
            doppler_exponent: doppler_std & 15,
            half_cycle_valid: bit(status, 2),
            half_cycle_subtracted: bit(status, 3),
        })
    }

    fn write(&self, writer: &mut Writer) {
        let status = u8::from(self.pseudorange.is_some())
            | u8::from(self.carrier_phase.is_some()) << 1
            | u8::from(self.half_cycle_valid) << 2
            | u8::from(self.half_cycle_subtracted) << 3;
        let Signal { system, satellite, signal, slot } = self.signal;
        let phase_std =
            self.carrier_phase_std.map_or(15, |std| ((std / 0.004).round() as u8).min(14));
        writer.le_f64(self.pseudorange.unwrap_or_default());
        writer.le_f64(self.carrier_phase.unwrap_or_default()).le_f32(self.doppler);
        writer.put(&[system, satellite, signal, slot]);
        writer.le_u16((self.lock_time / 1e-3).round() as u16);
        writer.u8(self.carrier_to_noise).u8(self.pseudorange_exponent & 15).u8(phase_std);
        writer.put(&[self.doppler_exponent & 15, status, 0]);
    }

    /// As u-blox tells a signal that it has a number of. A lock time that is not known is long, or none after a slip.
    fn of(observation: &SignalObservation) -> Option<Self> {
        let SignalObservation { satellite, signal, channel, .. } = *observation;
        let untold = if observation.slip { 0.0 } else { LONGEST_LOCK };
        Some(RawMeasurement {
            pseudorange: observation.code,
            carrier_phase: observation.phase,
            doppler: observation.doppler.unwrap_or_default() as f32,
            signal: Signal::of(satellite, signal, channel)?,
            lock_time: observation.lock.unwrap_or(untold).clamp(0.0, LONGEST_LOCK),
            carrier_to_noise: observation.cn0.map_or(0, |density| density.round() as u8),
            pseudorange_exponent: 5,
            carrier_phase_std: Some(0.004),
            doppler_exponent: 5,
            half_cycle_valid: !observation.half_cycle,
            half_cycle_subtracted: false,
        })
    }

    /// The measurement of a signal that is known; that a half cycle was subtracted does no harm.
    fn observation(&self) -> Option<SignalObservation> {
        let (satellite, signal) = self.signal.known()?;
        let finite = |value: &f64| value.is_finite();
        let phase = self.carrier_phase.filter(finite);
        Some(SignalObservation {
            channel: self.signal.channel(),
            code: self.pseudorange.filter(finite),
            phase,
            doppler: Some(f64::from(self.doppler)).filter(finite),
            cn0: Some(f64::from(self.carrier_to_noise)),
            lock: Some(self.lock_time),
            half_cycle: phase.is_some() && !self.half_cycle_valid,
            ..SignalObservation::unknown(satellite, signal)
        })
    }
}

impl RxmRawx {
    /// Reads a frame. Version 0 and 1 differ in nothing else.
    ///
    /// # Errors
    /// What is wrong with the bytes.
    pub fn read(frame: &[u8]) -> Result<Self, BinaryFault> {
        let mut reader = Reader::new(Frame::payload_of(frame, RAWX)?);
        let (time_of_week, week) = (reader.le_f64()?, reader.le_u16()?);
        let leap_seconds = reader.i8()?;
        let [count, status, _, _, _] = reader.array()?;
        let measurements = (0..count).map(|_| RawMeasurement::read(&mut reader));
        Ok(RxmRawx {
            time_of_week,
            week,
            leap_seconds,
            leap_seconds_valid: bit(status, 0),
            clock_reset: bit(status, 1),
            measurements: measurements.collect::<Result<_, _>>()?,
        })
    }

    /// The frame, version 1. Measurements beyond the 255th are left out.
    #[must_use]
    pub fn write(&self) -> Vec<u8> {
        let measurements = self.measurements.get(..255).unwrap_or(&self.measurements);
        let status = u8::from(self.leap_seconds_valid) | u8::from(self.clock_reset) << 1;
        let mut writer = Writer::new();
        writer.le_f64(self.time_of_week).le_u16(self.week).put(&self.leap_seconds.to_le_bytes());
        writer.put(&[measurements.len() as u8, status, 1, 0, 0]);
        for measurement in measurements {
            measurement.write(&mut writer);
        }
        framed(RAWX, &writer)
    }

    /// The message of an epoch. Signals that u-blox has no number of are left out.
    #[must_use]
    pub fn of(epoch: &SatelliteEpoch) -> Self {
        let (week, time_of_week) = epoch.tag.to_week();
        RxmRawx {
            time_of_week: time_of_week as f64 * 1e-9,
            week: u16::try_from(week).unwrap_or_default(),
            leap_seconds: epoch.leap_seconds.unwrap_or_default(),
            leap_seconds_valid: epoch.leap_seconds.is_some(),
            clock_reset: epoch.clock_reset,
            measurements: epoch.signals.iter().filter_map(RawMeasurement::of).collect(),
        }
    }

    /// What was measured of signals that are known; `None` if the time is no time. Slips are for [`crate::gnss::Locks`].
    #[must_use]
    pub fn epoch(&self) -> Option<SatelliteEpoch> {
        let time_of_week = Some(self.time_of_week).filter(|time| (0.0..WEEK).contains(time))?;
        Some(SatelliteEpoch {
            tag: gps_time(self.week, (time_of_week * 1e9).round() as i64)?,
            signals: self.measurements.iter().filter_map(RawMeasurement::observation).collect(),
            leap_seconds: self.leap_seconds_valid.then_some(self.leap_seconds),
            clock_reset: self.clock_reset,
        })
    }
}

/// RXM-SFRBX: words of a navigation message.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RxmSfrbx {
    /// Of which signal.
    pub signal: Signal,
    /// `chn`: the receiver's channel.
    pub channel: u8,
    /// `version` of the message.
    pub version: u8,
    /// `dwrd`: at most 255 words, as the satellite's document numbers their bits.
    pub words: Vec<u32>,
}

impl RxmSfrbx {
    /// Reads a frame.
    ///
    /// # Errors
    /// What is wrong with the bytes.
    pub fn read(frame: &[u8]) -> Result<Self, BinaryFault> {
        let mut reader = Reader::new(Frame::payload_of(frame, SFRBX)?);
        let [system, satellite, signal, slot, count, channel, version, _] = reader.array()?;
        let words = (0..count).map(|_| reader.le_u32()).collect::<Result<_, _>>()?;
        Ok(RxmSfrbx { signal: Signal { system, satellite, signal, slot }, channel, version, words })
    }

    /// The frame. Words beyond the 255th are left out.
    #[must_use]
    pub fn write(&self) -> Vec<u8> {
        let words = self.words.get(..255).unwrap_or(&self.words);
        let Signal { system, satellite, signal, slot } = self.signal;
        let mut writer = Writer::new();
        writer.put(&[system, satellite, signal, slot, words.len() as u8, self.channel]);
        writer.put(&[self.version, 0]);
        for word in words {
            writer.le_u32(*word);
        }
        framed(SFRBX, &writer)
    }

    /// The words of a signal that is known, for [`crate::gnss::navigation::NavigationAssembler`].
    #[must_use]
    pub fn navigation(&self) -> Option<NavigationWords> {
        let (satellite, signal) = self.signal.known()?;
        let channel = self.signal.channel();
        Some(NavigationWords { satellite, signal, channel, words: self.words.clone() })
    }
}
