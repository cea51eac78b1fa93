//! MSM4 to MSM7: what a base or a caster's receiver measured, packed over masks.
//!
//! Layout: RTCM 10403.3, the contents of MSM (DF393 to DF408, DF416 to DF420). Masks tell which satellites and signals there are, and which cells of their product are filled;
//! a product of more than 64 cells has no mask, and is refused.

use std::collections::{BTreeMap, BTreeSet};

use insd_base::satellites::{
    Constellation, SPEED_OF_LIGHT, SatelliteId, SignalCode, SignalObservation,
};

use super::super::bits::{Bits, extended};
use super::frame::Frame;
use super::glonass::channel;
use super::signal;
use crate::binary::BinaryFault;

/// Greatest number of cells that the cell mask (DF396) can have.
pub(super) const MOST_CELLS: usize = 64;

/// Range of one millisecond of light, m.
const MILLISECOND: f64 = SPEED_OF_LIGHT * 1e-3;

/// How wide the fields of a cell are: fine range (DF400, DF405), fine phase (DF401, DF406), lock (DF402, DF407), density (DF403,
/// DF408), and how many of the fraction bits of a millisecond or dB Hz each has.
struct Widths {
    range: (usize, i32),
    phase: (usize, i32),
    lock: usize,
    density: (usize, i32),
}

const PLAIN: Widths = Widths { range: (15, 24), phase: (22, 29), lock: 4, density: (6, 0) };
const FINE: Widths = Widths { range: (20, 29), phase: (24, 31), lock: 10, density: (10, 4) };

/// A message.
#[derive(Clone, Debug, PartialEq)]
pub struct Msm {
    /// Whose satellites.
    pub constellation: Constellation,
    /// DF003: who measured.
    pub station: u16,
    /// The 30 bits of the time: ms of the week; GLONASS: day of the week in three bits, ms of Moscow's day in 27.
    pub time: u32,
    /// DF393: more messages of the same epoch follow.
    pub more: bool,
    /// The measurements.
    pub signals: Vec<SignalObservation>,
}

/// Takes bits one field after the other.
struct Fields<'a> {
    bits: &'a Bits,
    at: usize,
}

impl Fields<'_> {
    fn unsigned(&mut self, length: usize) -> Result<u64, BinaryFault> {
        let end = self.at + length;
        if end > self.bits.len() {
            return Err(BinaryFault::Short { needed: end.div_ceil(8), found: self.bits.len() / 8 });
        }
        let value = self.bits.get(self.at, length);
        self.at = end;
        Ok(value)
    }

    /// A number in two's complement; its least value says that there is none.
    fn signed(&mut self, length: usize) -> Result<Option<f64>, BinaryFault> {
        let value = extended(self.unsigned(length)?, length);
        Ok((value != -1 << (length - 1)).then_some(value as f64))
    }

    /// The places of ones in a mask, from 1.
    fn mask(&mut self, length: u8) -> Result<Vec<u8>, BinaryFault> {
        let mask = self.unsigned(length.into())?;
        Ok((1..=length).filter(|place| mask >> (length - place) & 1 == 1).collect())
    }

    fn each<T>(
        &mut self,
        count: usize,
        mut field: impl FnMut(&mut Self) -> Result<T, BinaryFault>,
    ) -> Result<Vec<T>, BinaryFault> {
        (0..count).map(|_| field(self)).collect()
    }
}

/// What a message says of a satellite as a whole.
struct Satellite {
    satellite: Option<SatelliteId>,
    /// DF397 and DF398, ms.
    range: Option<f64>,
    /// DF399: m/s.
    rate: Option<f64>,
    channel: Option<i8>,
}

/// One filled cell, still relative to its satellite.
#[derive(Clone, Copy, Default)]
struct Cell {
    range: Option<f64>,
    phase: Option<f64>,
    lock: f64,
    half_cycle: bool,
    density: Option<f64>,
    rate: Option<f64>,
}

impl Msm {
    /// Reads a message, with a channel of GLONASS' satellites for messages that do not tell it; `None` if it is none of MSM4 to MSM7.
    pub(super) fn read(
        number: u16,
        bits: &Bits,
        channel_of: impl Fn(SatelliteId) -> Option<i8>,
    ) -> Option<Result<Self, BinaryFault>> {
        let (constellation, variant) = signal::message(number)?;
        (variant >= 4).then(|| Self::of(constellation, variant, bits, channel_of))
    }

    fn of(
        constellation: Constellation,
        variant: u8,
        bits: &Bits,
        channel_of: impl Fn(SatelliteId) -> Option<i8>,
    ) -> Result<Self, BinaryFault> {
        let mut fields = Fields { bits, at: 12 };
        let station = fields.unsigned(12)? as u16;
        let time = fields.unsigned(30)? as u32;
        let more = fields.unsigned(1)? == 1;
        // issue of the station's data, reserved, steering, external clock, smoothing
        fields.unsigned(18)?;
        let places = fields.mask(64)?;
        let codes = fields.mask(32)?;
        if places.len() * codes.len() > MOST_CELLS {
            return Err(BinaryFault::Range { field: "DF396" });
        }
        let filled = fields.each(places.len() * codes.len(), |fields| fields.unsigned(1))?;
        let satellites = satellites(&mut fields, constellation, variant, &places, channel_of)?;
        let count = filled.iter().filter(|filled| **filled == 1).count();
        let mut cells = cells(&mut fields, variant, count)?.into_iter();
        let mut signals = Vec::new();
        for (number, _) in filled.iter().enumerate().filter(|(_, filled)| **filled == 1) {
            let code = signal::signal(constellation, codes[number % codes.len()]);
            let (satellite, cell) = (&satellites[number / codes.len()], cells.next());
            let known = satellite.satellite.zip(code).zip(cell);
            signals.extend(known.map(|((id, code), cell)| satellite.observation(id, code, &cell)));
        }
        Ok(Msm { constellation, station, time, more, signals })
    }
}

fn satellites(
    fields: &mut Fields<'_>,
    constellation: Constellation,
    variant: u8,
    places: &[u8],
    channel_of: impl Fn(SatelliteId) -> Option<i8>,
) -> Result<Vec<Satellite>, BinaryFault> {
    let count = places.len();
    let has_rate = variant == 5 || variant == 7;
    let whole = fields.each(count, |fields| fields.unsigned(8))?;
    // of GLONASS the channel, of others reserved
    let extended = fields.each(if has_rate { count } else { 0 }, |fields| fields.unsigned(4))?;
    let fraction = fields.each(count, |fields| fields.unsigned(10))?;
    let rates = fields.each(if has_rate { count } else { 0 }, |fields| fields.signed(14))?;
    let glonass = constellation == Constellation::Glonass;
    let satellite = |at: usize| {
        let satellite = signal::satellite(constellation, places[at]);
        let told = extended.get(at).and_then(|raw| channel(*raw));
        Satellite {
            satellite,
            range: (whole[at] != 255).then(|| whole[at] as f64 + fraction[at] as f64 / 1024.0),
            rate: rates.get(at).copied().flatten(),
            channel: told.or_else(|| channel_of(satellite?)).filter(|_| glonass),
        }
    };
    Ok((0..count).map(satellite).collect())
}

fn cells(fields: &mut Fields<'_>, variant: u8, count: usize) -> Result<Vec<Cell>, BinaryFault> {
    let widths = if variant >= 6 { FINE } else { PLAIN };
    let has_rate = variant == 5 || variant == 7;
    let mut cells = vec![Cell::default(); count];
    let fine = |value: Option<f64>, power: i32| value.map(|value| value * 2_f64.powi(-power));
    for cell in &mut cells {
        cell.range = fine(fields.signed(widths.range.0)?, widths.range.1);
    }
    for cell in &mut cells {
        cell.phase = fine(fields.signed(widths.phase.0)?, widths.phase.1);
    }
    for cell in &mut cells {
        let raw = fields.unsigned(widths.lock)?;
        cell.lock = if variant >= 6 { fine_lock(raw) } else { plain_lock(raw) };
    }
    for cell in &mut cells {
        cell.half_cycle = fields.unsigned(1)? == 1;
    }
    for cell in &mut cells {
        let raw = fields.unsigned(widths.density.0)?;
        cell.density = (raw != 0).then(|| raw as f64 * 2_f64.powi(-widths.density.1));
    }
    for cell in cells.iter_mut().filter(|_| has_rate) {
        cell.rate = fields.signed(15)?.map(|rate| rate * 1e-4);
    }
    Ok(cells)
}

impl Satellite {
    fn observation(&self, id: SatelliteId, code: SignalCode, cell: &Cell) -> SignalObservation {
        let wavelength = code.wavelength(id.constellation, self.channel);
        let range = |fine: Option<f64>| Some((self.range? + fine?) * MILLISECOND);
        let cycles = |metres: Option<f64>| Some(metres? / wavelength?);
        let rate = self.rate.zip(cell.rate).map(|(rough, fine)| rough + fine);
        let phase = cycles(range(cell.phase));
        SignalObservation {
            channel: self.channel,
            code: range(cell.range),
            phase,
            doppler: cycles(rate).map(|doppler| -doppler),
            cn0: cell.density,
            lock: Some(cell.lock),
            half_cycle: phase.is_some() && cell.half_cycle,
            ..SignalObservation::unknown(id, code)
        }
    }
}

impl Msm {
    /// The frame of an MSM7. What has no place in the masks, and satellites beyond the 64th cell, are left out; a code that is
    /// more than 290 m from the first one of its satellite, and a phase that is more than 1170 m from it, are not told:
    /// [`super::MsmWriter`] sees to both.
    #[must_use]
    pub fn write(&self) -> Vec<u8> {
        let mut filled = BTreeMap::<u8, BTreeMap<u8, &SignalObservation>>::new();
        for own in
            self.signals.iter().filter(|own| own.satellite.constellation == self.constellation)
        {
            if let Some((satellite, code)) = signal::places(own.satellite, own.signal) {
                filled.entry(satellite).or_default().insert(code, own);
            }
        }
        let codes: BTreeSet<u8> = filled.values().flat_map(BTreeMap::keys).copied().collect();
        let satellites: Vec<_> = filled.into_iter().take(MOST_CELLS / codes.len().max(1)).collect();
        let mut bits = self.head();
        let mask = |places: &mut dyn Iterator<Item = u8>, length: u8| {
            places.fold(0_u64, |mask, place| mask | 1 << (length - place))
        };
        bits.push(mask(&mut satellites.iter().map(|(place, _)| *place), 64), 64);
        bits.push(mask(&mut codes.iter().copied(), 32), 32);
        for (_, own) in &satellites {
            codes.iter().for_each(|code| _ = bits.push(own.contains_key(code).into(), 1));
        }
        put_satellites(&mut bits, self.constellation, satellites.iter().map(|(_, own)| own));
        Frame { message: bits.bytes() }.write()
    }

    /// What stands before the masks: nothing of steering, of the clock and of smoothing is told.
    fn head(&self) -> Bits {
        let mut bits = Bits::default();
        bits.push(signal::number(self.constellation, 7).into(), 12);
        bits.push(self.station.into(), 12).push(self.time.into(), 30).push(self.more.into(), 1);
        bits.push(0, 18);
        bits
    }
}

/// Writes what satellites have in common and then their cells, each field of all before the next.
fn put_satellites<'a>(
    bits: &mut Bits,
    constellation: Constellation,
    satellites: impl Iterator<Item = &'a BTreeMap<u8, &'a SignalObservation>>,
) {
    let (mut rough, mut cells) = (Vec::new(), Vec::new());
    for signals in satellites {
        let own = Rough::of(signals.values().copied());
        cells.extend(signals.values().map(|signal| own.cell(signal)));
        rough.push(own);
    }
    let whole = |range: Option<u64>| range.map_or(255, |range| range / 1024);
    rough.iter().for_each(|own| _ = bits.push(whole(own.range), 8));
    let is_glonass = constellation == Constellation::Glonass;
    let extended = |channel: Option<i8>| match channel {
        Some(channel) if is_glonass => (channel + 7) as u64,
        _ if is_glonass => 15,
        _ => 0,
    };
    rough.iter().for_each(|own| _ = bits.push(extended(own.channel), 4));
    rough.iter().for_each(|own| _ = bits.push(own.range.unwrap_or_default() % 1024, 10));
    rough.iter().for_each(|own| put_signed(bits, own.rate, 14));
    let fine = |value: Option<f64>, power: i32| value.map(|value| value * 2_f64.powi(power));
    let Widths { range, phase, lock, density } = FINE;
    cells.iter().for_each(|cell| put_signed(bits, fine(cell.range, range.1), range.0));
    cells.iter().for_each(|cell| put_signed(bits, fine(cell.phase, phase.1), phase.0));
    cells.iter().for_each(|cell| _ = bits.push(lock_indicator(cell.lock), lock));
    cells.iter().for_each(|cell| _ = bits.push(cell.half_cycle.into(), 1));
    let steps = |cell: &Cell| fine(cell.density, density.1).map_or(0, |own| own.round() as u64);
    cells.iter().for_each(|cell| _ = bits.push(steps(cell).min(1023), density.0));
    cells.iter().for_each(|cell| put_signed(bits, cell.rate.map(|rate| rate * 1e4), 15));
}

/// A number in two's complement; where there is none, or no room for it, the least one that there is.
fn put_signed(bits: &mut Bits, value: Option<f64>, length: usize) {
    let most = (1_i64 << (length - 1)) - 1;
    let steps = value.map(|value| value.round() as i64).filter(|steps| steps.abs() <= most);
    bits.push(steps.unwrap_or(-most - 1) as u64, length);
}

/// What all signals of a satellite are told against.
struct Rough {
    /// DF397 and DF398: 1/1024 ms.
    range: Option<u64>,
    /// DF399: m/s.
    rate: Option<f64>,
    channel: Option<i8>,
}

impl Rough {
    /// By the first signal that tells it.
    fn of<'a>(mut signals: impl Iterator<Item = &'a SignalObservation> + Clone) -> Self {
        let near = |own: &SignalObservation| own.code.or_else(|| phase_range(own));
        let range = signals.clone().find_map(near).map(|range| range / MILLISECOND * 1024.0);
        let range = range.map(f64::round).filter(|own| (0.0..255.0 * 1024.0).contains(own));
        let channel = signals.clone().find_map(|own| own.channel);
        let rate = signals.find_map(range_rate).map(f64::round);
        Rough { range: range.map(|range| range as u64), rate, channel }
    }

    fn cell(&self, own: &SignalObservation) -> Cell {
        let rough = self.range.map(|range| range as f64 / 1024.0);
        let fine = |range: Option<f64>| Some(range? / MILLISECOND - rough?);
        // a lock that is not known is long, or begins where it slipped
        let untold = if own.slip { 0.0 } else { f64::INFINITY };
        Cell {
            range: fine(own.code),
            phase: fine(phase_range(own)),
            lock: own.lock.unwrap_or(untold),
            half_cycle: own.half_cycle,
            density: own.cn0,
            rate: range_rate(own).zip(self.rate).map(|(rate, rough)| rate - rough),
        }
    }
}

/// The phase as a range, m.
fn phase_range(own: &SignalObservation) -> Option<f64> {
    Some(own.phase? * own.wavelength()?)
}

/// How fast the range grows by the Doppler shift, m/s.
fn range_rate(own: &SignalObservation) -> Option<f64> {
    Some(-own.doppler? * own.wavelength()?)
}

/// The last indicator of DF407 whose lock time is not beyond this one, s.
fn lock_indicator(lock: f64) -> u64 {
    (0..=704).rev().find(|own| fine_lock(*own) <= lock).unwrap_or_default()
}

/// The least lock time of DF402, s (table 3.5-74): nothing, then 32 ms, doubled with every step.
fn plain_lock(indicator: u64) -> f64 {
    if indicator == 0 { 0.0 } else { (1_u64 << (indicator.min(15) + 4)) as f64 * 1e-3 }
}

/// The least lock time of DF407, s (table 3.5-75): milliseconds, with steps doubled at 64 and every 32 from there; at 704 it ends.
fn fine_lock(indicator: u64) -> f64 {
    let indicator = indicator.min(704);
    let doublings = (indicator / 32).saturating_sub(1);
    ((indicator - 32 * doublings) << doublings) as f64 * 1e-3
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lock_times_are_those_of_the_tables() {
        let plain = [(0, 0.0), (1, 0.032), (2, 0.064), (15, 524.288)];
        assert!(plain.iter().all(|(indicator, time)| plain_lock(*indicator) == *time));
        let fine = [
            (0, 0.0),
            (63, 0.063),
            (64, 0.064),
            (65, 0.066),
            (96, 0.128),
            (352, 32.768),
            (704, 67_108.864),
            (1023, 67_108.864),
        ];
        assert!(fine.iter().all(|(indicator, time)| fine_lock(*indicator) == *time));
    }
}
