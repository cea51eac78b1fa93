//! The normal datagram.

use super::{StimFormat, crc, groups_of, id_of, is_sound};
use crate::binary::{BinaryFault, Reader, Writer};
use crate::imu::{ImuReading, Wrapping};

/// Degrees Celsius of the least bit of a temperature.
const TEMPERATURE: f64 = 1.0 / 256.0;

/// Counts of one kind of sensor about or along x, y, z.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub struct StimGroup {
    /// Counts, of 24 bits; 16 for temperatures.
    pub counts: [i32; 3],
    /// Status byte; zero when all is well.
    pub status: u8,
}

/// The input for signals from outside.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct StimInput {
    /// Whether it is set to PPS, else to AUX.
    pub pps: bool,
    /// Counts of 24 bits: of AUX 5 V / 2^24; of PPS as it is set in the device.
    pub counts: i32,
    /// Status byte.
    pub status: u8,
}

/// A normal datagram, in the units of the wire.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub struct StimDatagram {
    /// Gyroscopes.
    pub rate: StimGroup,
    /// Accelerometers.
    pub acceleration: Option<StimGroup>,
    /// Inclinometers.
    pub inclination: Option<StimGroup>,
    /// Temperatures of gyroscopes, accelerometers and inclinometers; those of a group that is not
    /// there are not there either.
    pub temperatures: Option<[StimGroup; 3]>,
    /// The further input.
    pub input: Option<StimInput>,
    /// Number of the sample.
    pub counter: u8,
    /// Time from the measurement to the datagram's first bit, us.
    pub latency: u16,
}

impl StimDatagram {
    /// Reads a whole datagram.
    ///
    /// # Errors
    /// [`BinaryFault::Frame`] if length or CRC are wrong, [`BinaryFault::OtherMessage`] for other datagrams.
    pub fn read(frame: &[u8]) -> Result<Self, BinaryFault> {
        if !is_sound(frame) {
            return Err(BinaryFault::Frame);
        }
        let mut reader = Reader::new(frame);
        let groups = groups_of(reader.u8()?).ok_or(BinaryFault::OtherMessage)?;
        let [acceleration, inclination, temperatures, aux, pps] = groups;
        let mut group = |there: bool, short: bool| -> Result<Option<StimGroup>, BinaryFault> {
            there.then(|| StimGroup::read(&mut reader, short)).transpose()
        };
        let rate = group(true, false)?.unwrap_or_default();
        let acceleration_group = group(acceleration, false)?;
        let inclination_group = group(inclination, false)?;
        let mut temperature = |there: bool| group(temperatures && there, true);
        let warmth = [true, acceleration, inclination].map(&mut temperature);
        let warmth = [warmth[0]?, warmth[1]?, warmth[2]?].map(Option::unwrap_or_default);
        let input = if aux || pps {
            Some(StimInput { pps, counts: i24(&mut reader)?, status: reader.u8()? })
        } else {
            None
        };
        let (counter, latency) = (reader.u8()?, reader.be_u16()?);
        if reader.rest().len() != 4 {
            return Err(BinaryFault::Frame);
        }
        Ok(StimDatagram {
            rate,
            acceleration: acceleration_group,
            inclination: inclination_group,
            temperatures: temperatures.then_some(warmth),
            input,
            counter,
            latency,
        })
    }

    /// Writes the datagram, counts saturated, without CR LF.
    #[must_use]
    pub fn write(&self) -> Vec<u8> {
        let there = [self.acceleration.is_some(), self.inclination.is_some()];
        let pps = self.input.is_some_and(|input| input.pps);
        let temperatures = self.temperatures.is_some();
        let id = id_of([there[0], there[1], temperatures, self.input.is_some(), pps]);
        let mut frame = Writer::new();
        frame.u8(id);
        for group in [Some(self.rate), self.acceleration, self.inclination].into_iter().flatten() {
            group.write(&mut frame, false);
        }
        let temperatures = self.temperatures.into_iter().flatten();
        for (group, there) in temperatures.zip([true, there[0], there[1]]) {
            if there {
                group.write(&mut frame, true);
            }
        }
        if let Some(input) = self.input {
            put_i24(&mut frame, input.counts);
            frame.u8(input.status);
        }
        frame.u8(self.counter).be_u16(self.latency);
        let sum = crc(frame.bytes());
        frame.be_u32(sum);
        frame.into_bytes()
    }

    /// What was measured, about and along the axes of the device's drawing. `None` without
    /// accelerometers, if the device sends sums since its start (integrated angle or velocity), or if
    /// the interval is needed and not known.
    #[must_use]
    pub fn reading(&self, format: &StimFormat) -> Option<ImuReading> {
        let acceleration = self.acceleration?;
        let motion = format.motion(self.rate.counts, acceleration.counts)?;
        let inclination = self.inclination.map_or(0, |group| group.status);
        let words = [self.rate.status, acceleration.status, inclination];
        let status = words.iter().rev().fold(0, |sum, status| sum << 8 | u32::from(*status));
        let warmth = self.temperatures.map(|[gyroscopes, ..]| gyroscopes);
        let warmth = warmth.filter(|group| group.status == 0);
        let mean = |group: StimGroup| group.counts.iter().map(|c| f64::from(*c)).sum::<f64>() / 3.0;
        Some(ImuReading {
            counter: Some(Wrapping { value: self.counter.into(), modulus: 256 }),
            latency: Some(f64::from(self.latency) * 1e-6),
            temperature: warmth.map(|group| mean(group) * TEMPERATURE),
            valid: self.rate.status == 0 && acceleration.status == 0,
            status,
            ..ImuReading::bare(motion)
        })
    }
}

impl StimGroup {
    fn read(reader: &mut Reader<'_>, short: bool) -> Result<Self, BinaryFault> {
        let mut counts = [0; 3];
        for count in &mut counts {
            *count = if short { reader.be_i16()?.into() } else { i24(reader)? };
        }
        Ok(StimGroup { counts, status: reader.u8()? })
    }

    fn write(self, frame: &mut Writer, short: bool) {
        for count in self.counts {
            if short {
                frame.be_i16(count.clamp(i16::MIN.into(), i16::MAX.into()) as i16);
            } else {
                put_i24(frame, count);
            }
        }
        frame.u8(self.status);
    }
}

fn i24(reader: &mut Reader<'_>) -> Result<i32, BinaryFault> {
    let [high, middle, low] = reader.array()?;
    Ok(i32::from_be_bytes([high, middle, low, 0]) >> 8)
}

fn put_i24(frame: &mut Writer, count: i32) {
    let [_, bytes @ ..] = count.clamp(-(1 << 23), (1 << 23) - 1).to_be_bytes();
    frame.put(&bytes);
}
