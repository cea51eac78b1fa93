//! MeasEpoch: what the receiver measured, the first signal of each satellite in full, the others as differences from it.
//!
//! Layout: mosaic-X5 Reference Guide 4.14.10, 4.2.1, revisions 0 and 1. Numbers stay as they stand on the wire, since those of other signals mean nothing
//! without those of the first; [`MeasEpoch::epoch`] makes measurements of them.

use insd_base::satellites::{SatelliteEpoch, SatelliteId, SignalCode, SignalObservation};

use super::frame::{SbfStamp, begun, body, framed};
use super::signal::{channel, satellite, signal};
use crate::binary::{BinaryFault, Reader, Writer};

/// Number of the block.
pub(super) const ID: u16 = 4027;

/// Bytes of the sub-blocks; those of later revisions may be longer.
const FIRST: usize = 20;
const OTHER: usize = 12;

/// One step of pseudoranges, m, and of phases, cycles.
const MILLI: f64 = 1e-3;

/// One step of Doppler shifts, Hz.
const DOPPLER: f64 = 1e-4;

/// Longest lock that is told of every signal, s. The first one tells more; a signal that is the first for a while and another again
/// would seem to have slipped.
const LONGEST_LOCK: f64 = 254.0;

/// `CommonFlags`, bit 6: the signal of E6 is E6-B, not E6-C.
const E6B: u8 = 1 << 6;

/// `ObsInfo`, bit 2: the phase may be half a cycle off.
const HALF_CYCLE: u8 = 1 << 2;

/// The number in bits 0 to 4 of `Type` that says that the number of the signal is in `ObsInfo`.
const ELSEWHERE: u8 = 31;

/// MeasEpochChannelType1: the first signal of a satellite at one antenna.
#[derive(Clone, Debug, PartialEq, Eq, Default)]
pub struct MeasChannel {
    /// `RxChannel`.
    pub receiver_channel: u8,
    /// `Type`: bits 0-4 the number of the signal, 5-7 the antenna, 0 for the main one.
    pub kind: u8,
    /// `SVID`.
    pub satellite: u8,
    /// `Misc`: bits 0-3 the upper part of the pseudorange, in 2^32 mm.
    pub misc: u8,
    /// `CodeLSB`: the lower part of the pseudorange, mm; both zero if there is none.
    pub code: u32,
    /// `Doppler`: 0.1 mHz, positive when the satellite approaches; the least number if there is none.
    pub doppler: i32,
    /// `CarrierLSB`: phase - pseudorange / wavelength, the lower part, 0.001 cycles.
    pub carrier_low: u16,
    /// `CarrierMSB`: the upper part, in 65.536 cycles; -128 with a lower part of zero if there is none.
    pub carrier_high: i8,
    /// `CN0`: quarters of dB Hz, above 10 dB Hz but for P(Y); 255 if there is none.
    pub density: u8,
    /// `LockTime`: s, at most 65534; 65535 if it is not known.
    pub lock_time: u16,
    /// `ObsInfo`: bit 0 smoothed, bit 2 half cycle not resolved, bits 3-7 frequency number of GLONASS + 8, or the number of the signal - 32.
    pub info: u8,
    /// The other signals.
    pub others: Vec<MeasOther>,
}

/// MeasEpochChannelType2: another signal of the same satellite and antenna.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub struct MeasOther {
    /// `Type`, as in [`MeasChannel`].
    pub kind: u8,
    /// `LockTime`: s, at most 254; 255 if it is not known.
    pub lock_time: u8,
    /// `CN0`, as in [`MeasChannel`].
    pub density: u8,
    /// `OffsetMSB`: bits 0-2 the upper part of the difference of pseudoranges, 3-7 of that of Doppler shifts, with their signs.
    pub high: u8,
    /// `CarrierMSB`, as in [`MeasChannel`], with this signal's own pseudorange and wavelength.
    pub carrier_high: i8,
    /// `ObsInfo`, as in [`MeasChannel`].
    pub info: u8,
    /// `CodeOffsetLSB`: the lower part of the difference of pseudoranges, mm; zero with an upper part of -4 if there is none.
    pub code_low: u16,
    /// `CarrierLSB`.
    pub carrier_low: u16,
    /// `DopplerOffsetLSB`: the lower part of the shift beyond the first one scaled by the frequencies, 0.1 mHz; zero with
    /// an upper part of -16 if there is none.
    pub doppler_low: u16,
}

/// MeasEpoch.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MeasEpoch {
    /// When, by the receiver's clock.
    pub stamp: SbfStamp,
    /// `CommonFlags`.
    pub flags: u8,
    /// `CumClkJumps` of revision 1: jumps of the clock so far, ms, modulo 256.
    pub clock_jumps: Option<u8>,
    /// At most 255.
    pub channels: Vec<MeasChannel>,
}

impl MeasOther {
    fn read(bytes: &[u8]) -> Result<Self, BinaryFault> {
        let mut reader = Reader::new(bytes);
        let [kind, lock_time, density, high] = reader.array()?;
        Ok(MeasOther {
            kind,
            lock_time,
            density,
            high,
            carrier_high: reader.i8()?,
            info: reader.u8()?,
            code_low: reader.le_u16()?,
            carrier_low: reader.le_u16()?,
            doppler_low: reader.le_u16()?,
        })
    }

    fn write(&self, writer: &mut Writer) {
        writer.put(&[self.kind, self.lock_time, self.density, self.high]);
        writer.put(&self.carrier_high.to_le_bytes()).u8(self.info);
        writer.le_u16(self.code_low).le_u16(self.carrier_low).le_u16(self.doppler_low);
    }
}

impl MeasChannel {
    /// What is read, and how many others follow.
    fn read(bytes: &[u8]) -> Result<(Self, u8), BinaryFault> {
        let mut reader = Reader::new(bytes);
        let [receiver_channel, kind, satellite, misc] = reader.array()?;
        let channel = MeasChannel {
            receiver_channel,
            kind,
            satellite,
            misc,
            code: reader.le_u32()?,
            doppler: reader.le_i32()?,
            carrier_low: reader.le_u16()?,
            carrier_high: reader.i8()?,
            density: reader.u8()?,
            lock_time: reader.le_u16()?,
            info: reader.u8()?,
            others: Vec::new(),
        };
        Ok((channel, reader.u8()?))
    }

    fn write(&self, writer: &mut Writer) {
        let others = self.others.get(..255).unwrap_or(&self.others);
        writer.put(&[self.receiver_channel, self.kind, self.satellite, self.misc]);
        writer.le_u32(self.code).le_i32(self.doppler).le_u16(self.carrier_low);
        writer.put(&self.carrier_high.to_le_bytes()).u8(self.density).le_u16(self.lock_time);
        writer.u8(self.info).u8(others.len() as u8);
        others.iter().for_each(|other| other.write(writer));
    }
}

impl MeasEpoch {
    /// Reads a block.
    ///
    /// # Errors
    /// What is wrong with the bytes.
    pub fn read(block: &[u8]) -> Result<Self, BinaryFault> {
        let (stamp, mut reader, revision) = body(block, ID)?;
        let [count, first, other, flags, clock_jumps, _] = reader.array()?;
        let (first, other) = (usize::from(first), usize::from(other));
        if first < FIRST || other < OTHER {
            return Err(BinaryFault::Range { field: "SB1Length, SB2Length" });
        }
        let mut channels = Vec::new();
        for _ in 0..count {
            let (mut channel, others) = MeasChannel::read(reader.take(first)?)?;
            for _ in 0..others {
                channel.others.push(MeasOther::read(reader.take(other)?)?);
            }
            channels.push(channel);
        }
        let clock_jumps = (revision >= 1).then_some(clock_jumps);
        Ok(MeasEpoch { stamp, flags, clock_jumps, channels })
    }

    /// The block. Channels beyond the 255th are left out.
    #[must_use]
    pub fn write(&self) -> Vec<u8> {
        let channels = self.channels.get(..255).unwrap_or(&self.channels);
        let mut writer = begun(self.stamp);
        writer.put(&[channels.len() as u8, FIRST as u8, OTHER as u8, self.flags]);
        writer.put(&[self.clock_jumps.unwrap_or(0), 0]);
        channels.iter().for_each(|channel| channel.write(&mut writer));
        framed((ID, u8::from(self.clock_jumps.is_some())), &writer)
    }

    /// What the main antenna measured of signals that are known; `None` if the time is not. Whether the clock was set is found by
    /// the count of its jumps in the epoch before. Slips are for [`crate::gnss::Locks`].
    #[must_use]
    pub fn epoch(&self, jumps_before: Option<u8>) -> Option<SatelliteEpoch> {
        let jumps = self.clock_jumps.zip(jumps_before);
        Some(SatelliteEpoch {
            tag: self.stamp.gps()?,
            signals: self.channels.iter().flat_map(|channel| self.signals(channel)).collect(),
            leap_seconds: None,
            clock_reset: jumps.is_some_and(|(now, before)| now != before),
        })
    }

    fn signals(&self, channel: &MeasChannel) -> Vec<SignalObservation> {
        let Some(first) = First::of(channel) else { return Vec::new() };
        let own = self.code(first.satellite, channel.kind, channel.info);
        let own = own.map(|code| first.own(channel, code));
        let others = channel.others.iter().filter_map(|other| {
            let code = self.code(first.satellite, other.kind, other.info)?;
            Some(first.other(other, code))
        });
        own.into_iter().chain(others).collect()
    }

    /// The signal of a sub-block of the main antenna.
    fn code(&self, satellite: SatelliteId, kind: u8, info: u8) -> Option<SignalCode> {
        let code = signal(satellite, number(kind, info)).filter(|_| kind >> 5 == 0)?;
        let e6b = code == SignalCode::new(6, b'C') && self.flags & E6B != 0;
        Some(if e6b { SignalCode::new(6, b'B') } else { code })
    }
}

/// Number of the signal of a sub-block.
fn number(kind: u8, info: u8) -> u8 {
    if kind & 31 == ELSEWHERE { (info >> 3) + 32 } else { kind & 31 }
}

/// The first signal's part in the others.
struct First {
    satellite: SatelliteId,
    channel: Option<i8>,
    range: Option<f64>,
    doppler: Option<f64>,
    frequency: Option<f64>,
}

impl First {
    fn of(own: &MeasChannel) -> Option<Self> {
        let satellite = satellite(own.satellite)?;
        let channel = channel(satellite, own.info >> 3);
        let millimetres = u64::from(own.misc & 15) << 32 | u64::from(own.code);
        let code = signal(satellite, number(own.kind, own.info));
        Some(First {
            satellite,
            channel,
            range: (millimetres != 0).then_some(millimetres as f64 * MILLI),
            doppler: (own.doppler != i32::MIN).then(|| f64::from(own.doppler) * DOPPLER),
            frequency: code.and_then(|code| code.frequency(satellite.constellation, channel)),
        })
    }

    fn own(&self, own: &MeasChannel, code: SignalCode) -> SignalObservation {
        let carrier = carrier(own.carrier_high, own.carrier_low);
        let lock = (own.lock_time != u16::MAX).then(|| f64::from(own.lock_time).min(LONGEST_LOCK));
        let common = self.common(code, (self.range, carrier), own.density, own.info);
        SignalObservation { doppler: self.doppler, lock, ..common }
    }

    fn other(&self, own: &MeasOther, code: SignalCode) -> SignalObservation {
        // three and five bits with their signs
        let code_high = (own.high << 5) as i8 >> 5;
        let doppler_high = own.high as i8 >> 3;
        let difference = joined(code_high, own.code_low, -4).map(|steps| steps * MILLI);
        let range = self.range.zip(difference).map(|(first, difference)| first + difference);
        let beyond = joined(doppler_high, own.doppler_low, -16).map(|steps| steps * DOPPLER);
        let frequency = code.frequency(self.satellite.constellation, self.channel);
        let ratio = frequency.zip(self.frequency).map(|(own, first)| own / first);
        let scaled = self.doppler.zip(ratio).map(|(first, ratio)| first * ratio);
        let carrier = carrier(own.carrier_high, own.carrier_low);
        let lock = (own.lock_time != u8::MAX).then(|| f64::from(own.lock_time));
        let common = self.common(code, (range, carrier), own.density, own.info);
        SignalObservation {
            doppler: scaled.zip(beyond).map(|(scaled, beyond)| scaled + beyond),
            lock,
            ..common
        }
    }

    /// All but Doppler shift and lock.
    fn common(
        &self,
        code: SignalCode,
        (range, carrier): (Option<f64>, Option<f64>),
        density: u8,
        info: u8,
    ) -> SignalObservation {
        let unknown = SignalObservation::unknown(self.satellite, code);
        let unknown = SignalObservation { channel: self.channel, ..unknown };
        let cycles = range.zip(unknown.wavelength()).map(|(range, wavelength)| range / wavelength);
        let phase = cycles.zip(carrier).map(|(cycles, carrier)| cycles + carrier);
        let above = if code.attribute == b'W' { 0.0 } else { 10.0 };
        SignalObservation {
            code: range,
            phase,
            cn0: (density != u8::MAX).then(|| f64::from(density) * 0.25 + above),
            half_cycle: phase.is_some() && info & HALF_CYCLE != 0,
            ..unknown
        }
    }
}

/// Phase beyond the pseudorange, cycles.
fn carrier(high: i8, low: u16) -> Option<f64> {
    joined(high, low, i8::MIN).map(|steps| steps * MILLI)
}

/// An upper part and a lower one of sixteen bits; `None` where the upper one is the least and the lower one zero.
fn joined(high: i8, low: u16, none: i8) -> Option<f64> {
    (high != none || low != 0).then(|| f64::from(high) * 65_536.0 + f64::from(low))
}
