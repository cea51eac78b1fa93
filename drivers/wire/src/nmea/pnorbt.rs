//! PNORBT: bottom track of Nortek logs.
//!
//! ```text
//! $PNORBT7,s.ssss,d,d,vx,vy,vz,fom,d1,d2,d3,d4*hh                      and tagged PNORBT6
//! $PNORBT9,s.ssss,d,d,vx,vy,vz,fom,d1,d2,d3,d4,V,c,p,t,0xhhhhhhhh*hh   and tagged PNORBT8
//!          1      2 3 4  5  6  7   8  9  10 11 12 13 14 15 16
//! 1      UTC of the ping, seconds since 1970
//! 2, 3   time from the trigger to the echo, and from the echo to the output, ms
//! 4..6   velocity along x, y, z of the instrument, m/s; -32.768 is invalid
//! 7      figure of merit of the velocity, m/s; 10 is invalid
//! 8..11  vertical distance of each beam, m; 0 is invalid
//! 12..15 battery, V; speed of sound, m/s; pressure, dbar; temperature, deg C
//! 16     status, hexadecimal
//!
//! $PNORBT0,n,nnnnnn,hhmmss.ssss,d,d,v,fom,dist,0xhhhhhhhh*hh           one beam
//! $PNORBT4,d,d,v,dir,fom,dist*hh                                      speed and course over ground
//! ```
//! The tagged sentences have a key before each value: `TIME DT1 DT2 VX VY VZ FOM D1 D2 D3 D4 BATT SS
//! PRESS TEMP STAT`. The tagged forms of 0 and 4 (PNORBT1, PNORBT3) and PNORBT2 and 5 are not
//! documented where we could look, and are other sentences here.
//!
//! Sources: Nortek Signature VM manual; the layouts and examples in pynmea2 (`types/proprietary/nor`)
//! and in drivers that read the tagged form; not verified against a device. Open: whether the times
//! are milliseconds (the one real sentence known has 23.961 for the way of the echo); the unit of the
//! figure of merit and of the pressure; the order of day and month in PNORBT0, whose date is therefore
//! kept as its three numbers.

use insd_base::UtcTime;

use super::civil::{TimeOfDay, nanoseconds};
use super::decimal::{Form, parse, parse_digits};
use super::fault::NmeaFault;
use super::fields::Fields;
use super::frame::Frame;
use super::line::{Composer, NmeaLine};

/// Seconds in the unit of the times.
const MILLISECOND: f64 = 1e-3;

const INVALID_VELOCITY: f64 = -32.768;
const INVALID_MERIT: f64 = 10.0;

const DELAY: Form = Form { decimals: 3, width: 1, limit: 99_999.9 };
const VELOCITY: Form = Form { decimals: 5, width: 1, limit: 32.767 };
const MERIT: Form = Form { decimals: 5, width: 1, limit: 9999.9 };
const DISTANCE: Form = Form { decimals: 2, width: 1, limit: 99_999.9 };
const SENSOR: Form = Form { decimals: 2, width: 1, limit: 99_999.9 };

/// Keys of the tagged sentences, in the order of the fields.
const KEYS: [&str; 16] = [
    "TIME", "DT1", "DT2", "VX", "VY", "VZ", "FOM", "D1", "D2", "D3", "D4", "BATT", "SS", "PRESS",
    "TEMP", "STAT",
];

/// Bottom track along the instrument's axes: PNORBT6 to PNORBT9.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct NortekBottomTrack {
    /// Whether it is written with keys: PNORBT6 or 8.
    pub tagged: bool,
    /// UTC of the ping, to 0.1 ms.
    pub time: Option<UtcTime>,
    /// Time from the trigger to the echo, s.
    pub trigger_to_echo: Option<f64>,
    /// Time from the echo to the output, s; negative as some units send it.
    pub echo_to_output: Option<f64>,
    /// Velocity over ground along x, y and z of the instrument, m/s.
    pub velocity: [Option<f64>; 3],
    /// Figure of merit of the velocity: its expected error, m/s.
    pub figure_of_merit: Option<f64>,
    /// Vertical distance to the sea bed of each beam, m.
    pub distances: [Option<f64>; 4],
    /// What PNORBT8 and 9 tell beside.
    pub sensors: Option<NortekSensors>,
}

/// Sensors of a Nortek log.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct NortekSensors {
    /// Voltage of the battery, V.
    pub voltage: Option<f64>,
    /// Speed of sound, m/s.
    pub sound_speed: Option<f64>,
    /// Pressure, Pa.
    pub pressure: Option<f64>,
    /// Temperature of the water, deg C.
    pub temperature: Option<f64>,
    /// Status bits.
    pub status: Option<u32>,
}

/// Bottom track of one beam: PNORBT0.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct NortekBeam {
    /// Number of the beam.
    pub beam: Option<u8>,
    /// The three numbers of the date as sent; which is the day and which the month is not verified.
    pub date_as_sent: Option<[u8; 3]>,
    /// Time of day, UTC.
    pub time: Option<TimeOfDay>,
    /// Time from the trigger to the echo, s.
    pub trigger_to_echo: Option<f64>,
    /// Time from the echo to the output, s.
    pub echo_to_output: Option<f64>,
    /// Velocity along the beam, m/s.
    pub velocity: Option<f64>,
    /// Figure of merit of the velocity, m/s.
    pub figure_of_merit: Option<f64>,
    /// Vertical distance to the sea bed, m.
    pub distance: Option<f64>,
    /// Status bits.
    pub status: Option<u32>,
}

/// Speed and course over ground: PNORBT4.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct NortekGroundSpeed {
    /// Time from the trigger to the echo, s.
    pub trigger_to_echo: Option<f64>,
    /// Time from the echo to the output, s.
    pub echo_to_output: Option<f64>,
    /// Speed over ground, m/s.
    pub speed: Option<f64>,
    /// Course over ground, rad, clockwise from true north.
    pub course: Option<f64>,
    /// Figure of merit of the velocity, m/s.
    pub figure_of_merit: Option<f64>,
    /// Distance to the sea bed, m.
    pub distance: Option<f64>,
}

impl NortekBottomTrack {
    /// Writes the sentence: time to 0.1 ms, velocities to 0.01 mm/s, distances to 1 cm.
    #[must_use]
    pub fn write(&self) -> NmeaLine {
        let address = match (self.sensors.is_some(), self.tagged) {
            (false, true) => "PNORBT6",
            (false, false) => "PNORBT7",
            (true, true) => "PNORBT8",
            (true, false) => "PNORBT9",
        };
        NmeaLine::compose_own(address, |line| self.fill(line))
    }

    fn fill(&self, line: &mut Composer) {
        let key = |field: usize| KEYS.get(field).copied().filter(|_| self.tagged);
        line.key(key(0));
        let nanos = self.time.map(UtcTime::as_nanos).filter(|nanos| *nanos >= 0);
        let seconds = nanos.and_then(|nanos| u32::try_from(nanos / 1_000_000_000).ok());
        if let Some((seconds, nanos)) = seconds.zip(nanos) {
            let rest = nanos % 1_000_000_000 / 100_000;
            line.push_all(format!("{seconds}.{rest:04}").as_bytes());
        }
        let delays = [self.trigger_to_echo, self.echo_to_output];
        for (field, delay) in (1..).zip(delays) {
            line.tagged(key(field), delay.map(|delay| delay / MILLISECOND), DELAY);
        }
        for (field, velocity) in (3..).zip(self.velocity) {
            line.tagged(key(field), velocity_or_invalid(velocity), WITH_INVALID);
        }
        line.tagged(
            key(6),
            Some(known(self.figure_of_merit, MERIT).unwrap_or(INVALID_MERIT)),
            MERIT,
        );
        for (field, distance) in (7..).zip(self.distances) {
            line.tagged(key(field), Some(known(distance, DISTANCE).unwrap_or(0.0)), DISTANCE);
        }
        let Some(sensors) = self.sensors else { return };
        let pressure = sensors.pressure.map(|pascal| pascal / 1e4);
        let values = [sensors.voltage, sensors.sound_speed, pressure, sensors.temperature];
        for (field, value) in (11..).zip(values) {
            line.tagged(key(field), value, SENSOR);
        }
        line.key(key(15));
        if let Some(status) = sensors.status {
            line.push_all(format!("0x{status:08X}").as_bytes());
        }
    }

    /// Reads the sentence.
    ///
    /// # Errors
    /// The first [`NmeaFault`] of its fields.
    pub fn read(frame: &Frame<'_>) -> Result<Self, NmeaFault> {
        let (tagged, with_sensors) = match frame.address() {
            "PNORBT6" => (true, false),
            "PNORBT7" => (false, false),
            "PNORBT8" => (true, true),
            "PNORBT9" => (false, true),
            _ => return Err(NmeaFault::OtherSentence),
        };
        let mut values = Values { fields: frame.fields(), keys: KEYS.iter().copied(), tagged };
        let mut track = NortekBottomTrack {
            tagged,
            time: values.convert(unix_time)?,
            trigger_to_echo: values.number()?.map(|ms| ms * MILLISECOND),
            echo_to_output: values.number()?.map(|ms| ms * MILLISECOND),
            velocity: [velocity(&mut values)?, velocity(&mut values)?, velocity(&mut values)?],
            figure_of_merit: merit(&mut values)?,
            ..NortekBottomTrack::default()
        };
        for distance in &mut track.distances {
            *distance = range(&mut values)?;
        }
        if with_sensors {
            track.sensors = Some(NortekSensors {
                voltage: values.optional(parse)?,
                sound_speed: values.optional(parse)?,
                pressure: values.optional(parse)?.map(|dbar| dbar * 1e4),
                temperature: values.optional(parse)?,
                status: values.optional(hexadecimal)?,
            });
        }
        Ok(track)
    }
}

impl NortekBeam {
    /// Writes the sentence.
    #[must_use]
    pub fn write(&self) -> NmeaLine {
        NmeaLine::compose_own("PNORBT0", |line| {
            line.whole(self.beam.map(u32::from), 1, 99);
            match self.date_as_sent.filter(|parts| parts.iter().all(|part| *part < 100)) {
                Some(parts) => line.digits(&parts.map(|part| (part.into(), 2))),
                None => line.empty(),
            }
            line.time_of_day_to(self.time, 4);
            for delay in [self.trigger_to_echo, self.echo_to_output] {
                line.number(delay.map(|delay| delay / MILLISECOND), DELAY);
            }
            line.number(velocity_or_invalid(self.velocity), WITH_INVALID);
            line.number(Some(known(self.figure_of_merit, MERIT).unwrap_or(INVALID_MERIT)), MERIT);
            line.number(Some(known(self.distance, DISTANCE).unwrap_or(0.0)), DISTANCE);
            line.empty();
            if let Some(status) = self.status {
                line.push_all(format!("0x{status:08X}").as_bytes());
            }
        })
    }

    /// Reads the sentence.
    ///
    /// # Errors
    /// The first [`NmeaFault`] of its fields.
    pub fn read(frame: &Frame<'_>) -> Result<Self, NmeaFault> {
        let fields = frame.fields_of_own("PNORBT0")?;
        let mut values = Values { fields, keys: KEYS.iter().copied(), tagged: false };
        Ok(NortekBeam {
            beam: values.convert(|text| parse_digits(text)?.try_into().ok())?,
            date_as_sent: values.convert(three_numbers)?,
            time: values.convert(TimeOfDay::parse)?,
            trigger_to_echo: values.number()?.map(|ms| ms * MILLISECOND),
            echo_to_output: values.number()?.map(|ms| ms * MILLISECOND),
            velocity: velocity(&mut values)?,
            figure_of_merit: merit(&mut values)?,
            distance: range(&mut values)?,
            status: values.convert(hexadecimal)?,
        })
    }
}

impl NortekGroundSpeed {
    /// Writes the sentence.
    #[must_use]
    pub fn write(&self) -> NmeaLine {
        NmeaLine::compose_own("PNORBT4", |line| {
            for delay in [self.trigger_to_echo, self.echo_to_output] {
                line.number(delay.map(|delay| delay / MILLISECOND), DELAY);
            }
            line.number(velocity_or_invalid(self.speed), WITH_INVALID);
            line.degrees(self.course, 2);
            line.number(Some(known(self.figure_of_merit, MERIT).unwrap_or(INVALID_MERIT)), MERIT);
            line.number(Some(known(self.distance, DISTANCE).unwrap_or(0.0)), DISTANCE);
        })
    }

    /// Reads the sentence.
    ///
    /// # Errors
    /// The first [`NmeaFault`] of its fields.
    pub fn read(frame: &Frame<'_>) -> Result<Self, NmeaFault> {
        let fields = frame.fields_of_own("PNORBT4")?;
        let mut values = Values { fields, keys: KEYS.iter().copied(), tagged: false };
        let trigger_to_echo = values.number()?.map(|ms| ms * MILLISECOND);
        let echo_to_output = values.number()?.map(|ms| ms * MILLISECOND);
        let speed = velocity(&mut values)?;
        let course = values.fields.degrees()?;
        Ok(NortekGroundSpeed {
            trigger_to_echo,
            echo_to_output,
            speed,
            course,
            figure_of_merit: merit(&mut values)?,
            distance: range(&mut values)?,
        })
    }
}

/// Form of a velocity that may be the invalid one.
const WITH_INVALID: Form = Form { limit: 32.768, ..VELOCITY };

fn velocity_or_invalid(velocity: Option<f64>) -> Option<f64> {
    Some(velocity.filter(|v| v.abs() <= VELOCITY.limit).unwrap_or(INVALID_VELOCITY))
}

/// A value that is not negative and that its field can carry.
fn known(value: Option<f64>, form: Form) -> Option<f64> {
    value.filter(|value| (0.0..=form.limit).contains(value))
}

/// Values of the fields, with their keys taken off.
struct Values<'a> {
    fields: Fields<'a>,
    keys: std::iter::Copied<std::slice::Iter<'static, &'static str>>,
    tagged: bool,
}

impl<'a> Values<'a> {
    fn convert<T>(
        &mut self,
        to: impl FnOnce(&'a str) -> Option<T>,
    ) -> Result<Option<T>, NmeaFault> {
        let key = self.keys.next().unwrap_or_default();
        let text = self.fields.text()?;
        let value = match (self.tagged, text.split_once('=')) {
            (true, Some((own, value))) if own == key => Some(value),
            (false, _) => Some(text),
            _ => None,
        };
        match value.ok_or_else(|| self.fields.malformed())? {
            "" => Ok(None),
            value => to(value).map(Some).ok_or_else(|| self.fields.malformed()),
        }
    }

    fn number(&mut self) -> Result<Option<f64>, NmeaFault> {
        self.convert(parse)
    }

    /// As [`Values::convert`], but what is malformed is left out. A wrong key is a fault.
    fn optional<T>(
        &mut self,
        to: impl FnOnce(&'a str) -> Option<T>,
    ) -> Result<Option<T>, NmeaFault> {
        let text = self.convert(Some)?;
        let value = text.map(|text| to(text).ok_or_else(|| self.fields.malformed())).transpose();
        self.fields.optional(|_| value)
    }
}

fn velocity(values: &mut Values<'_>) -> Result<Option<f64>, NmeaFault> {
    let velocity = values.convert(|text| parse(text).filter(|v| v.abs() < 32.769))?;
    Ok(velocity.filter(|velocity| (velocity - INVALID_VELOCITY).abs() > 5e-4))
}

fn merit(values: &mut Values<'_>) -> Result<Option<f64>, NmeaFault> {
    let merit = values.optional(|text| parse(text).filter(|merit| *merit >= 0.0))?;
    Ok(merit.filter(|merit| (merit - INVALID_MERIT).abs() > 5e-6))
}

fn range(values: &mut Values<'_>) -> Result<Option<f64>, NmeaFault> {
    let range = values.optional(|text| parse(text).filter(|range| *range >= 0.0))?;
    Ok(range.filter(|range| *range > 0.0))
}

fn unix_time(text: &str) -> Option<UtcTime> {
    let (whole, fraction) = text.split_once('.').unwrap_or((text, "0"));
    let seconds = parse_digits(whole)?;
    let nanos = i64::from(seconds) * 1_000_000_000 + i64::from(nanoseconds(fraction)?);
    Some(UtcTime::from_nanos(nanos))
}

fn three_numbers(text: &str) -> Option<[u8; 3]> {
    let part = |from: usize| parse_digits(text.get(from..from + 2)?)?.try_into().ok();
    Some([part(0)?, part(2)?, part(4).filter(|_| text.len() == 6)?])
}

fn hexadecimal(text: &str) -> Option<u32> {
    let digits = text.strip_prefix("0x").or_else(|| text.strip_prefix("0X")).unwrap_or(text);
    let plain = digits.bytes().all(|byte| byte.is_ascii_hexdigit());
    u32::from_str_radix(digits, 16).ok().filter(|_| plain)
}
