//! Epochs to text: RINEX 3.05.

use insd_base::{
    Constellation, GpsTime, SatelliteEpoch, SatelliteId, SignalCode, SignalObservation,
};

use crate::calendar::{SECOND, TimeSystem};
use crate::decimal::push_observation;
use crate::observation::codes::Quantity;
use crate::observation::header::{Equipment, ObservationHeader};
use crate::text::push_header;

/// Type of a marker that moves: what carries the antenna is a ship more likely than anything else.
const CRAFT: &str = "WATER_CRAFT";

/// The columns of one constellation, as they are written.
struct Columns {
    constellation: Constellation,
    /// Signal and what of it.
    types: Vec<(SignalCode, Quantity)>,
}

/// Writes a file of observations of version 3.05, mixed, in GPS time, that [`super::ObservationReader`] reads back to
/// the same epochs as far as the format holds them: times to 0.1 us, observations to 0.001, no duration of lock.
///
/// The order of a constellation's signals is that of `header.signals`; others follow by band and letter. Only
/// columns that hold something are written.
#[must_use]
pub fn write_observations(header: &ObservationHeader, epochs: &[SatelliteEpoch]) -> String {
    written(header, epochs, |_, _| ())
}

/// The same of an antenna that moves, with where it is at each epoch, ECEF, m, to 0.1 mm. A record of flag 2 says that it moves; one of flag 4 brings its place where that is
/// another than before, and zeros where nobody knows it (RINEX 3.05, table A3).
#[must_use]
pub fn write_moving(
    header: &ObservationHeader,
    epochs: &[SatelliteEpoch],
    places: &[Option<[f64; 3]>],
) -> String {
    let mut last = header.position;
    written(header, epochs, |out, number| {
        let (date, seconds) = date(epochs[number].tag, 3);
        let mut event = |flag, lines| {
            out.push_str(&format!("> {date}{seconds:>11}  {flag}{lines:3}\n"));
        };
        if number == 0 {
            event(2, 0);
        }
        let place = places.get(number).copied().flatten().filter(|own| triple(*own).is_some());
        if place != last {
            event(4, 1);
            let told = triple(place.unwrap_or_default()).unwrap_or_default();
            push_header(out, &told, "APPROX POSITION XYZ");
            last = place;
        }
    })
}

/// A whole file; `before` writes what stands before each epoch, by its number.
fn written(
    header: &ObservationHeader,
    epochs: &[SatelliteEpoch],
    mut before: impl FnMut(&mut String, usize),
) -> String {
    let columns = all_columns(header, epochs);
    let mut out = String::new();
    push_station(&mut out, header);
    for own in &columns {
        push_types(&mut out, own);
    }
    for own in &columns {
        // a letter alone: whether phases were aligned among signals is not known
        push_header(&mut out, &own.constellation.letter().to_string(), "SYS / PHASE SHIFT");
    }
    push_times(&mut out, header, epochs);
    push_channels(&mut out, header, epochs);
    push_header(&mut out, "", "END OF HEADER");
    for (number, epoch) in epochs.iter().enumerate() {
        before(&mut out, number);
        push_epoch(&mut out, epoch, &columns);
    }
    out
}

fn all_columns(header: &ObservationHeader, epochs: &[SatelliteEpoch]) -> Vec<Columns> {
    let all = Constellation::ALL.into_iter().map(|constellation| {
        let listed = header.signals.iter().find(|(own, _)| *own == constellation);
        let listed = listed.map_or(&[][..], |(_, signals)| signals);
        let mut types: Vec<(SignalCode, Quantity)> = Vec::new();
        let signals = epochs.iter().flat_map(|epoch| &epoch.signals);
        for own in signals.filter(|own| own.satellite.constellation == constellation) {
            for quantity in Quantity::ALL {
                let kind = (own.signal, quantity);
                if is_told(own, quantity) && !types.contains(&kind) {
                    types.push(kind);
                }
            }
        }
        let place = |signal| listed.iter().position(|own| *own == signal).unwrap_or(listed.len());
        types.sort_by_key(|(signal, quantity)| (place(*signal), *signal, *quantity as u8));
        Columns { constellation, types }
    });
    all.filter(|own| !own.types.is_empty()).collect()
}

fn value(own: &SignalObservation, quantity: Quantity) -> Option<f64> {
    match quantity {
        Quantity::Code => own.code,
        Quantity::Phase => own.phase,
        Quantity::Doppler => own.doppler,
        Quantity::Strength => own.cn0,
    }
}

/// Whether there is something to write, flags of the phase among it.
fn is_told(own: &SignalObservation, quantity: Quantity) -> bool {
    let flagged = quantity == Quantity::Phase && (own.slip || own.half_cycle);
    flagged || value(own, quantity).is_some()
}

fn push_station(out: &mut String, header: &ObservationHeader) {
    let contents = format!("{:>9}{:11}{:20}{:20}", "3.05", "", "OBSERVATION DATA", "M (MIXED)");
    push_header(out, &contents, "RINEX VERSION / TYPE");
    push_header(out, "insd", "PGM / RUN BY / DATE");
    push_header(out, &header.marker, "MARKER NAME");
    if header.is_moving {
        push_header(out, CRAFT, "MARKER TYPE");
    }
    push_header(out, "", "OBSERVER / AGENCY");
    push_header(out, &equipment(&header.receiver), "REC # / TYPE / VERS");
    push_header(out, &equipment(&header.antenna), "ANT # / TYPE");
    let told = |numbers: Option<[f64; 3]>| numbers.and_then(triple);
    if let Some(position) = told(header.position) {
        push_header(out, &position, "APPROX POSITION XYZ");
    }
    if let Some(delta) = told(header.antenna_delta) {
        push_header(out, &delta, "ANTENNA: DELTA H/E/N");
    }
}

fn equipment(equipment: &Equipment) -> String {
    let cut = |text: &str| text.chars().take(20).collect::<String>();
    let Equipment { number, kind, version } = equipment;
    format!("{:20}{:20}{:20}", cut(number), cut(kind), cut(version))
}

/// `3F14.4`, where the numbers have room.
fn triple(numbers: [f64; 3]) -> Option<String> {
    let text = numbers.map(|number| format!("{number:14.4}")).concat();
    (text.len() == 42 && numbers.iter().all(|number| number.is_finite())).then_some(text)
}

/// `A1,2X,I3,13(1X,A3)`.
fn push_types(out: &mut String, own: &Columns) {
    for (line, types) in own.types.chunks(13).enumerate() {
        let mut contents = if line == 0 {
            format!("{}{:5}", own.constellation.letter(), own.types.len())
        } else {
            " ".repeat(6)
        };
        for (signal, quantity) in types {
            contents.push_str(&format!(" {}{signal}", quantity.letter()));
        }
        push_header(out, &contents, "SYS / # / OBS TYPES");
    }
}

fn push_times(out: &mut String, header: &ObservationHeader, epochs: &[SatelliteEpoch]) {
    push_header(out, "DBHZ", "SIGNAL STRENGTH UNIT");
    let interval = header.interval.filter(|interval| (0.001..1e6).contains(interval));
    if let Some(interval) = interval {
        push_header(out, &format!("{interval:10.3}"), "INTERVAL");
    }
    let first = epochs.first();
    if let Some(first) = first {
        let (date, seconds) = date(first.tag, 6);
        let contents = format!("{date}{seconds:>13}{:>8}", "GPS");
        push_header(out, &contents, "TIME OF FIRST OBS");
    }
    if header.clock_offset_applied {
        push_header(out, &format!("{:6}", 1), "RCV CLOCK OFFS APPL");
    }
    if let Some(leaps) = header.leap_seconds.or(first.and_then(|first| first.leap_seconds)) {
        push_header(out, &format!("{leaps:6}"), "LEAP SECONDS");
    }
}

/// Channels of the header, and of satellites that bring their own.
fn push_channels(out: &mut String, header: &ObservationHeader, epochs: &[SatelliteEpoch]) {
    let mut channels = header.glonass_channels.clone();
    let signals = epochs.iter().flat_map(|epoch| &epoch.signals);
    for own in signals.filter(|own| own.satellite.constellation == Constellation::Glonass) {
        let known = channels.iter().any(|(slot, _)| *slot == own.satellite.number);
        if let Some(channel) = own.channel.filter(|_| !known) {
            channels.push((own.satellite.number, channel));
        }
    }
    for (line, pairs) in channels.chunks(8).enumerate() {
        let mut contents = if line == 0 { format!("{:3} ", channels.len()) } else { " ".repeat(4) };
        for (slot, channel) in pairs {
            contents.push_str(&format!("R{slot:02} {channel:2} "));
        }
        push_header(out, &contents, "GLONASS SLOT / FRQ #");
    }
    if !channels.is_empty() {
        // blank: biases between code and phase are not known
        push_header(out, "", "GLONASS COD/PHS/BIS");
    }
}

/// Year to minute as in the line of an epoch, fields of `width` columns, and seconds with seven decimals.
fn date(tag: GpsTime, width: usize) -> (String, String) {
    let rounded = tag.as_nanos().saturating_add(50).div_euclid(100).saturating_mul(100);
    let civil = TimeSystem::Gps.civil(GpsTime::from_nanos(rounded), None);
    let (year, month, day) = civil.date;
    let (hour, minute) = civil.clock;
    let date = if width == 6 {
        format!("{year:6}{month:6}{day:6}{hour:6}{minute:6}")
    } else {
        format!("{year:04} {month:02} {day:02} {hour:02} {minute:02}")
    };
    (date, format!("{:2}.{:07}", civil.nanos / SECOND, civil.nanos % SECOND / 100))
}

/// RINEX 3.05, table A3.
fn push_epoch(out: &mut String, epoch: &SatelliteEpoch, columns: &[Columns]) {
    let mut satellites: Vec<SatelliteId> = Vec::new();
    for own in &epoch.signals {
        if !satellites.contains(&own.satellite) {
            satellites.push(own.satellite);
        }
    }
    let (date, seconds) = date(epoch.tag, 3);
    out.push_str(&format!("> {date}{seconds:>11}  0{:3}\n", satellites.len()));
    for satellite in satellites {
        let is_its = |own: &SignalObservation| own.satellite == satellite;
        let from = epoch.signals.iter().position(is_its).unwrap_or(0);
        let to = epoch.signals.iter().rposition(is_its).map_or(0, |last| last + 1);
        let signals = &epoch.signals[from..to];
        let own = columns.iter().find(|own| own.constellation == satellite.constellation);
        let types = own.map_or(&[][..], |own| &own.types);
        out.push_str(&satellite.to_string());
        for (signal, quantity) in types {
            let is_it = |own: &&SignalObservation| own.signal == *signal && is_its(own);
            push_field(out, signals.iter().find(is_it), *quantity);
        }
        out.truncate(out.trim_end_matches(' ').len());
        out.push('\n');
    }
}

/// An observation with its loss-of-lock indicator: 1 for a slip, 2 for a doubtful half cycle.
fn push_field(out: &mut String, own: Option<&SignalObservation>, quantity: Quantity) {
    push_observation(out, own.and_then(|own| value(own, quantity)));
    let flags = own.filter(|_| quantity == Quantity::Phase);
    let lock = flags.map_or(0, |own| u8::from(own.slip) + 2 * u8::from(own.half_cycle));
    out.push(if lock == 0 { ' ' } else { char::from(b'0' + lock) });
    out.push(' ');
}
