//! From frames to samples.

use insd_base::can::CanFrame;
use insd_base::{Time, UtcTime};

use super::bits;
use super::group::Group;
use super::layout::{ACCEL, ANGLE, CanLayout, Field, FrameLayout, RATE, TURN, UTC, VELOCITY, What};
use crate::binary::BinaryFault;
use crate::imu::rotation::delta_theta_of;
use crate::imu::{DeviceTime, ImuMotion, ImuReading, Wrapping};

/// What a frame is to a device.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CanPart {
    /// It is from another one.
    Other,
    /// It is a part of a sample that is not complete, or of one that has gone.
    Part,
    /// It completes a sample. `begun`: when the first frame of the sample was received.
    Sample {
        /// The sample.
        reading: ImuReading,
        /// When its first frame was received.
        begun: Time,
    },
}

/// Puts the frames of a device together.
#[derive(Clone, Debug)]
pub struct CanImu {
    layout: CanLayout,
    interval: f64,
    group: Option<Group>,
    /// Bits of each status field, in the order of the table, as told last.
    statuses: Vec<Option<u64>>,
    temperature: Option<f64>,
    incomplete: u64,
}

impl CanImu {
    /// A device that has not spoken yet. `interval`: time from sample to sample, s. A table with faults
    /// is used as far as it goes; look at [`CanLayout::faults`] first.
    #[must_use]
    pub fn new(layout: &CanLayout, interval: f64) -> Self {
        let statuses = layout.fields().filter(|field| field.what == What::Status);
        CanImu {
            statuses: vec![None; statuses.count()],
            layout: layout.clone(),
            interval,
            group: None,
            temperature: None,
            incomplete: 0,
        }
    }

    /// Takes a frame that was received at an instant.
    ///
    /// # Errors
    /// [`BinaryFault::Short`] if the frame is too short for its fields; its sample will be incomplete.
    pub fn take(&mut self, frame: &CanFrame, at: Time) -> Result<CanPart, BinaryFault> {
        let known = |own: &FrameLayout| own.can_id() == Some(frame.id());
        let Some(index) = self.layout.frames.iter().position(known) else {
            return Ok(CanPart::Other);
        };
        let own = &self.layout.frames[index];
        let data = frame.data();
        if data.len() < own.length() {
            return Err(BinaryFault::Short { needed: own.length(), found: data.len() });
        }
        let mut all = [0; 8];
        all.iter_mut().zip(data).for_each(|(own, byte)| *own = *byte);
        if self.group.as_ref().is_some_and(|group| group.is_repetition(index, &all)) {
            return Ok(CanPart::Part);
        }
        let mut group = match self.group.take() {
            Some(group) if group.takes(index, own, data, at, self.interval) => group,
            before => {
                let lost = before.is_some_and(|group| group.is_begun() && !group.sent);
                self.incomplete += u64::from(lost);
                Group::new(at)
            }
        };
        group.enter(index, own, data, &all);
        self.temperature = group
            .parts([What::Temperature])
            .map_or(self.temperature, |[own]| Some(own).filter(|own| own.is_finite()));
        self.latch(index, data);
        Ok(self.look(group))
    }

    /// Samples so far of which a frame was missing.
    #[must_use]
    pub fn incomplete(&self) -> u64 {
        self.incomplete
    }

    fn look(&mut self, mut group: Group) -> CanPart {
        let needed = self.layout.frames.iter().filter(|frame| frame.is_needed()).count();
        let complete = group.is_complete(needed) && !group.sent;
        let reading = if complete { self.reading(&group) } else { None };
        group.sent |= complete;
        let begun = group.begun;
        self.group = Some(group);
        reading.map_or(CanPart::Part, |reading| CanPart::Sample { reading, begun })
    }

    /// Keeps the status, which holds until it is told again.
    fn latch(&mut self, index: usize, data: &[u8]) {
        let before = self.layout.frames.iter().take(index);
        let is_status = |field: &&Field| field.what == What::Status;
        let mut number = before.flat_map(|frame| &frame.fields).filter(is_status).count();
        let Some(frame) = self.layout.frames.get(index) else { return };
        for field in &frame.fields {
            let bits = bits::get(data, field);
            if field.what == What::Status {
                if let Some(own) = self.statuses.get_mut(number) {
                    *own = bits;
                }
                number += 1;
            }
        }
    }

    fn reading(&self, group: &Group) -> Option<ImuReading> {
        let motion = self.motion(group)?;
        Some(ImuReading {
            device_time: self.device_time(group),
            counter: self.counter(group),
            utc: utc(group),
            temperature: self.temperature,
            valid: self.is_valid() && motion.is_finite(),
            status: self.statuses.iter().flatten().next().map_or(0, |bits| *bits as u32),
            ..ImuReading::bare(motion)
        })
    }

    /// Where one of rotation and force is a difference, both become differences.
    fn motion(&self, group: &Group) -> Option<ImuMotion> {
        let turn = group.parts(TURN).map(delta_theta_of);
        let angle = group.parts(ANGLE).or(turn);
        let (rate, accel) = (group.parts(RATE), group.parts(ACCEL));
        let velocity = group.parts(VELOCITY);
        if let (Some(gyro), Some(accel)) = (rate, accel) {
            return Some(ImuMotion::Rates { gyro, accel });
        }
        let over = |rates: [f64; 3]| rates.map(|own| own * self.interval);
        let delta_theta = angle.or(rate.map(over))?;
        let delta_velocity = velocity.or(accel.map(over))?;
        Some(ImuMotion::Increments { delta_theta, delta_velocity })
    }

    fn device_time(&self, group: &Group) -> Option<DeviceTime> {
        let field = self.layout.fields().find(|field| field.what == What::Time)?;
        let ticks = Wrapping { value: group.ticks?, modulus: field.modulus() };
        Some(DeviceTime { ticks, tick: field.scale })
    }

    fn counter(&self, group: &Group) -> Option<Wrapping> {
        let field = self.layout.fields().find(|field| field.what == What::Counter)?;
        Some(Wrapping { value: group.counter?, modulus: field.modulus() })
    }

    /// Whether every status that was told is as it should be.
    fn is_valid(&self) -> bool {
        let fields = self.layout.fields().filter(|field| field.what == What::Status);
        fields.zip(&self.statuses).all(|(field, bits)| {
            let masked = bits.map(|bits| bits & field.mask.unwrap_or(u64::MAX));
            masked.zip(field.expected).is_none_or(|(own, expected)| own == expected)
        })
    }
}

fn utc(group: &Group) -> Option<UtcTime> {
    let [year, month, day, hour, minute, second, fraction] = group.parts(UTC)?;
    let byte = |value: f64| (0.0..256.0).contains(&value).then_some(value as u8);
    let date = (year as i32, byte(month)?, byte(day)?);
    let clock = (byte(hour)?, byte(minute)?, byte(second)?);
    let nanos = (0.0..1.0).contains(&fraction).then_some((fraction * 1e9).round() as u32)?;
    UtcTime::from_civil(date, clock, nanos)
}
