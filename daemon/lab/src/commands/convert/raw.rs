//! Raw GNSS of a recording, as the files of a voyage directory.

use std::collections::BTreeMap;

use insd_base::satellites::BroadcastRecord;
use insd_base::{BaseEpoch, Body, Message, Received, Source};
use insd_drivers::recording::RawFiles;
use insd_gnss::Ephemerides;
use insd_rinex::{ObservationHeader, write_moving, write_navigation, write_observations};
use serde::Serialize;

use crate::raw_receivers::RawReceiver;

/// Antennas that a voyage directory holds.
const ANTENNAS: usize = 9;

/// What of `voyage.toml` is known of receivers that were not simulated: their noise is not.
#[derive(Debug, Serialize)]
struct Tables {
    raw: Table,
}

#[derive(Debug, Serialize)]
struct Table {
    #[serde(skip_serializing_if = "Option::is_none")]
    rate_hz: Option<f64>,
    antennas_m: Vec<[f64; 3]>,
    common_clock: [u8; 0],
}

/// Those whose ranges the ship may have used, the first of the fixes' order first.
pub(super) fn antennas<'a>(told: impl Iterator<Item = &'a RawReceiver>) -> Vec<&'a RawReceiver> {
    let mut own: Vec<_> = told.filter(|own| own.is_used && !own.epochs.is_empty()).collect();
    own.sort_by_key(|own| own.priority);
    own.truncate(ANTENNAS);
    own
}

/// The files of these receivers, and of a base. `lever` is that of a receiver that has none of its own.
///
/// # Errors
/// The table cannot be written as TOML.
pub(super) fn files(
    antennas: &[&RawReceiver],
    lever: Body,
    measured: &[Received],
) -> anyhow::Result<RawFiles> {
    let interval = antennas.first().and_then(|own| own.interval()).filter(|own| *own > 0.0);
    let arm = |own: &&RawReceiver| own.lever.unwrap_or(lever).0.into();
    let raw = Table {
        rate_hz: interval.map(|interval| 1.0 / interval),
        antennas_m: antennas.iter().map(arm).collect(),
        common_clock: [],
    };
    let observations = |own: &&RawReceiver| write_observations(&own.header(), &own.epochs);
    Ok(RawFiles {
        antennas: antennas.iter().map(observations).collect(),
        base: base(measured),
        navigation: navigation(antennas),
        truth: None,
        tables: toml::to_string(&Tables { raw })?,
    })
}

/// What the satellites told any of them, each record once.
fn navigation(antennas: &[&RawReceiver]) -> String {
    let mut known = Ephemerides::default();
    let all = antennas.iter().flat_map(|own| &own.records).copied();
    let records: Vec<BroadcastRecord> =
        all.filter(|record| matches!(known.insert(*record), Ok(true))).collect();
    let mut models = BTreeMap::new();
    let mut leap_seconds = None;
    for own in antennas.iter().rev() {
        models.extend(own.ionosphere.iter().map(|(whose, model)| (*whose, *model)));
        leap_seconds = own.leap_seconds.or(leap_seconds);
    }
    write_navigation(&records, &models.into_iter().collect::<Vec<_>>(), leap_seconds)
}

/// Epochs of the first base.
pub(super) fn of_base(measured: &[Received]) -> Vec<&BaseEpoch> {
    let of_it = measured.iter().filter_map(|received| match &received.message {
        Message::Base(told) if received.source == Source::Base(0) => Some(told.as_ref()),
        _ => None,
    });
    of_it.collect()
}

/// What the first base measured; of one that moves with where it was at each epoch.
fn base(measured: &[Received]) -> Option<String> {
    let told = of_base(measured);
    let first = told.first()?;
    let epochs: Vec<_> = told.iter().map(|told| told.epoch.clone()).collect();
    let places: Vec<_> =
        told.iter().map(|told| told.position.map(|place| place.0.into())).collect();
    let of_place = |position: Option<[f64; 3]>| ObservationHeader {
        position,
        is_moving: first.is_moving,
        ..ObservationHeader::of_marker("base")
    };
    Some(if first.is_moving {
        write_moving(&of_place(places[0]), &epochs, &places)
    } else {
        let newest = places.iter().rev().copied().flatten().next();
        write_observations(&of_place(newest), &epochs)
    })
}
