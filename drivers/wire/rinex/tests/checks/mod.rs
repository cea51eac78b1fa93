//! What must hold of any bytes, for the tests here and for the fuzz target.

#![allow(dead_code)] // each user needs some of it
#![allow(clippy::unwrap_used)] // helpers of tests are not seen as tests

use insd_base::{SatelliteEpoch, SignalObservation};
use insd_rinex::{
    Flaw, ObservationHeader, ObservationReader, expand, is_compact, read_navigation,
    write_navigation, write_observations,
};

/// Everything that is read of a file of observations: its header at the end, its epochs, and its flaws.
pub(crate) fn observations(
    bytes: &[u8],
) -> Option<(ObservationHeader, Vec<SatelliteEpoch>, Vec<Flaw>)> {
    let mut reader = ObservationReader::new(bytes).ok()?;
    let (mut epochs, mut flaws) = (Vec::new(), Vec::new());
    for item in reader.by_ref() {
        match item {
            Ok(epoch) => epochs.push(epoch),
            Err(flaw) => flaws.push(flaw),
        }
    }
    Some((reader.header().clone(), epochs, flaws))
}

/// No panic whatever the bytes; numbers are finite; what is read, written and read again is the same.
pub(crate) fn everything(bytes: &[u8]) {
    if let Some((header, epochs, _)) = observations(bytes) {
        assert!(epochs.iter().flat_map(|epoch| &epoch.signals).all(is_finite));
        observations_come_back(&header, &epochs);
    }
    navigation_comes_back(bytes);
    let plain = expand(bytes);
    assert!(is_compact(bytes) || plain.is_err());
    if let Ok(plain) = plain {
        observations(plain.text.as_bytes());
    }
}

fn numbers(own: &SignalObservation) -> impl Iterator<Item = f64> {
    [own.code, own.phase, own.doppler, own.cn0].into_iter().flatten()
}

fn is_finite(own: &SignalObservation) -> bool {
    numbers(own).all(f64::is_finite)
}

/// Whether version 3.05 holds all of it: an event may have changed the order of signals, and a fuzzer finds more digits.
fn is_held(header: &ObservationHeader, epochs: &[SatelliteEpoch]) -> bool {
    let is_short =
        |number: f64| (number * 1000.0).round() / 1000.0 == number && number < 9e9 && number > -9e8;
    let place = |own: &SignalObservation| {
        let system = own.satellite.constellation;
        let (_, signals) = header.signals.iter().find(|(other, _)| *other == system)?;
        signals.iter().position(|signal| *signal == own.signal)
    };
    let is_ordered = |epoch: &SatelliteEpoch| {
        epoch
            .signals
            .windows(2)
            .all(|pair| pair[0].satellite != pair[1].satellite || place(&pair[0]) < place(&pair[1]))
    };
    epochs.windows(2).all(|pair| pair[0].tag < pair[1].tag)
        && epochs.iter().all(|epoch| {
            epoch.tag.as_nanos() % 100 == 0
                && epoch.leap_seconds == header.leap_seconds
                && is_ordered(epoch)
                && epoch
                    .signals
                    .iter()
                    .all(|own| place(own).is_some() && numbers(own).all(is_short))
        })
}

/// Writes and reads; where the format holds it all, it is the same.
pub(crate) fn observations_come_back(header: &ObservationHeader, epochs: &[SatelliteEpoch]) {
    let text = write_observations(header, epochs);
    let Some((again, back, flaws)) = observations(text.as_bytes()) else {
        assert!(epochs.iter().all(|epoch| epoch.signals.is_empty()), "it was written in vain");
        return;
    };
    if is_held(header, epochs) {
        assert!(flaws.is_empty(), "{flaws:?}");
        assert!(back == epochs, "other epochs of\n{text}");
        assert!(write_observations(&again, &back) == text, "written otherwise than\n{text}");
    }
}

/// The same for messages: after one round nothing changes any more.
pub(crate) fn navigation_comes_back(bytes: &[u8]) {
    let Ok(first) = read_navigation(bytes) else { return };
    let write = |bytes: &[u8]| {
        let read = read_navigation(bytes).unwrap();
        (read.records.len(), write_navigation(&read.records, &read.ionosphere, read.leap_seconds))
    };
    let (count, once) = write(bytes);
    assert_eq!(count, first.records.len());
    let (count, twice) = write(once.as_bytes());
    let (third, thrice) = write(twice.as_bytes());
    if count == first.records.len() && third == count {
        assert!(twice == thrice, "written otherwise than\n{twice}");
    }
}
