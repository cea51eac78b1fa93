//! Records of GLONASS (RINEX 2.11, table A11; RINEX 3.05, table A10): a state in kilometres, at a time in UTC.

use insd_base::satellites::GlonassRecord;

use crate::calendar::TimeSystem;
use crate::error::Flaw;
use crate::navigation::entry::{Entry, push_date, push_numbers};

/// Kilometres to metres, as a power of ten.
const KILO: i32 = 3;

const AXES: [[&str; 3]; 3] = [
    ["X", "X velocity", "X acceleration"],
    ["Y", "Y velocity", "Y acceleration"],
    ["Z", "Z velocity", "Z acceleration"],
];

const HEALTH: usize = 6;
const CHANNEL: usize = 10;
const AGE: usize = 14;
const FIELDS: usize = 15;

/// Index of position, velocity or acceleration of an axis: each axis has a line.
fn index(axis: usize, derivative: usize) -> usize {
    3 + 4 * axis + derivative
}

/// Reads a record; the fifth line of version 3.05, flags and delays, is passed over.
pub(crate) fn read(entry: &Entry<'_>) -> Result<GlonassRecord, Flaw> {
    let mut state = [[0.0; 3]; 3];
    for (axis, names) in AXES.iter().enumerate() {
        for (derivative, name) in names.iter().enumerate() {
            state[derivative][axis] = entry.required(index(axis, derivative), name, KILO)?;
        }
    }
    let channel: i64 = entry.count(CHANNEL, "frequency number")?;
    // a few writers tell negative numbers as those of eight bits
    let channel = if channel > 128 { channel - 256 } else { channel };
    let channel = i8::try_from(channel).ok().filter(|channel| (-7..=13).contains(channel));
    let expected = "a channel from -7 to 13";
    Ok(GlonassRecord {
        satellite: entry.satellite,
        channel: channel.ok_or_else(|| entry.flaw(CHANNEL, "frequency number", expected))?,
        reference: entry.date(TimeSystem::Glonass)?,
        position: state[0],
        velocity: state[1],
        acceleration: state[2],
        clock_offset: entry.required(0, "-TauN", 0)?,
        clock_drift: entry.required(1, "+GammaN", 0)?,
        health: entry.count(HEALTH, "health")?,
        age_days: entry.required(AGE, "age of information", 0)?,
    })
}

/// Writes a record of four lines; the time of the message frame is not known and stays blank.
pub(crate) fn push(out: &mut String, record: &GlonassRecord, leap_seconds: Option<i8>) {
    let civil = TimeSystem::Glonass.civil(record.reference, leap_seconds);
    push_date(out, record.satellite, civil);
    let mut fields = [(None, 0); FIELDS];
    fields[0].0 = Some(record.clock_offset);
    fields[1].0 = Some(record.clock_drift);
    for (derivative, state) in
        [record.position, record.velocity, record.acceleration].iter().enumerate()
    {
        for (axis, value) in state.iter().enumerate() {
            fields[index(axis, derivative)] = (Some(*value), KILO);
        }
    }
    fields[HEALTH].0 = Some(f64::from(record.health));
    fields[CHANNEL].0 = Some(f64::from(record.channel));
    fields[AGE].0 = Some(record.age_days);
    push_numbers(out, &fields);
}
