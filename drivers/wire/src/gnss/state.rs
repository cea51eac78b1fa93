//! Where a state of GLONASS stands in a message.

use insd_base::satellites::{GlonassRecord, SatelliteId};
use insd_base::{GpsTime, Span};

use super::bits::{Bits, Field};
use super::kepler::{SECOND, half};

/// Metres of a kilometre.
const KILO: f64 = 1e3;

/// Nanoseconds of a day.
pub(super) const DAY: i64 = 86_400 * SECOND;

/// Moscow's time - UTC, ns.
pub(super) const MOSCOW: i64 = 10_800 * SECOND;

/// The fields of one message; each number with a sign has it in its first bit.
pub(super) struct StateLayout {
    pub(super) position: [Field; 3],
    pub(super) velocity: [Field; 3],
    pub(super) acceleration: [Field; 3],
    /// The first bit of B_n: it alone says that the satellite is not to be used.
    pub(super) health: Field,
    /// l_n: the same.
    pub(super) unhealthy: Field,
    /// t_b: reference time in Moscow's day, s.
    pub(super) reference: Field,
    pub(super) gamma: Field,
    pub(super) tau: Field,
    pub(super) age: Field,
}

/// Coordinates whose first bits stand so, of so many bits each and with this scale in kilometres.
pub(super) const fn vector(at: [usize; 3], width: usize, scale: i32) -> [Field; 3] {
    let [x, y, z] = at;
    [
        Field::magnitude(x, width, half(scale) * KILO),
        Field::magnitude(y, width, half(scale) * KILO),
        Field::magnitude(z, width, half(scale) * KILO),
    ]
}

impl StateLayout {
    /// The record, with the reference time that is nearest to the reception.
    pub(super) fn record(
        &self,
        satellite: SatelliteId,
        channel: i8,
        bits: &Bits,
        (received, leap): (GpsTime, i8),
    ) -> GlonassRecord {
        let vector = |fields: [Field; 3]| fields.map(|field| field.value(bits));
        let reference = self.reference.value(bits) as i64 * SECOND;
        GlonassRecord {
            satellite,
            channel,
            reference: nearest_time_of_day(reference, received, leap),
            position: vector(self.position),
            velocity: vector(self.velocity),
            acceleration: vector(self.acceleration),
            clock_offset: -self.tau.value(bits),
            clock_drift: self.gamma.value(bits),
            health: (self.health.raw(bits) | self.unhealthy.raw(bits) << 1) as u8,
            age_days: self.age.value(bits),
        }
    }
}

impl StateLayout {
    /// Writes a record, whose reference time is told by Moscow's day with these leap seconds.
    pub(super) fn put(&self, bits: &mut Bits, record: &GlonassRecord, leap: i8) {
        let groups = [
            (self.position, record.position),
            (self.velocity, record.velocity),
            (self.acceleration, record.acceleration),
        ];
        for (fields, values) in groups {
            fields.iter().zip(values).for_each(|(field, value)| field.put(bits, value));
        }
        self.reference.put(bits, (time_of_day(record.reference, leap) / SECOND) as f64);
        self.tau.put(bits, -record.clock_offset);
        self.gamma.put(bits, record.clock_drift);
        self.age.put(bits, record.age_days);
        self.health.put_raw(bits, u64::from(record.health));
        self.unhealthy.put_raw(bits, u64::from(record.health) >> 1);
    }
}

/// Moscow's time of day of an instant, ns.
pub(super) fn time_of_day(at: GpsTime, leap: i8) -> i64 {
    at.as_nanos().saturating_add(MOSCOW - i64::from(leap) * SECOND).rem_euclid(DAY)
}

/// The instant nearest to another at which Moscow has a time of day.
pub(super) fn nearest_time_of_day(time_of_day: i64, near: GpsTime, leap: i8) -> GpsTime {
    let ahead = time_of_day.saturating_sub(self::time_of_day(near, leap)).rem_euclid(DAY);
    near.plus(Span::from_nanos(if ahead > DAY / 2 { ahead - DAY } else { ahead }))
}
