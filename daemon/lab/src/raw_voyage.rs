//! Raw GNSS of a voyage directory on its way into the engine.

use std::collections::VecDeque;
use std::path::Path;
use std::sync::Arc;

use anyhow::Context as _;
use insd_base::{BaseEpoch, Ecef, GpsTime, Message, Received, SatelliteEpoch, Source, Time, earth};
use insd_config::{BadInput, VoyageCalendar};
use insd_drivers::recording::{RawTexts, read_raw, read_raw_base};
use insd_gnss::Context;
use insd_rinex::{ObservationReader, expand, is_compact, read_navigation};

use crate::ranges::{Epochs, GnssUse, RangeMaker, SatelliteMask};
use crate::raw_table::RawTable;

/// The messages that raw GNSS makes, in the order in which they are received.
#[derive(Debug, Default)]
pub(crate) struct RawVoyage {
    maker: Option<RangeMaker>,
    gnss: Option<GnssUse>,
    masks: Vec<SatelliteMask>,
}

impl RawVoyage {
    /// Reads the raw GNSS of all antennas of a voyage, if it is there and wanted: where `gnss` leaves the choice it is.
    ///
    /// # Errors
    /// A file that is there cannot be read, or it is missing where it was asked for.
    pub(crate) fn open(
        dir: &Path,
        gnss: Option<GnssUse>,
        masks: &[SatelliteMask],
        table: &RawTable,
        start_utc: &str,
    ) -> anyhow::Result<Self> {
        let own = RawVoyage { maker: None, gnss, masks: masks.to_vec() };
        if matches!(gnss, Some(GnssUse::Loose | GnssUse::None)) {
            return Ok(own);
        }
        let Some(texts) = read_raw(dir, 1)? else {
            if gnss.is_some() || !masks.is_empty() {
                let dir = dir.join("raw").display().to_string();
                return Err(BadInput(format!(
                    "{dir}: no a1.obs, which --gnss tight, --gnss phase-rates and --mask need"
                ))
                .into());
            }
            return Ok(own);
        };
        let calendar = VoyageCalendar::new(start_utc).context("start_utc")?;
        let start = calendar.utc(Time::START).to_gps();
        let told = read_raw_base(dir)?;
        let told = told.map(|(path, text)| base(&path, &text, table, start)).transpose()?;
        let mut rover = vec![observed(&texts)?];
        for antenna in 2..=table.antennas() {
            let own = read_raw(dir, antenna)?;
            rover.push(own.map(|texts| observed(&texts)).transpose()?.unwrap_or_default());
        }
        let epochs = Epochs {
            start,
            context: Context { noise: table.noise(), ..context(&texts.navigation)? },
            rover,
            array: table.array(),
            base: told.unwrap_or_default(),
            masks: masks.to_vec(),
        };
        let maker = RangeMaker::new(epochs);
        let maker = if gnss == Some(GnssUse::PhaseRates) { maker.as_rates() } else { maker };
        Ok(RawVoyage { maker: Some(maker), ..own })
    }

    /// What is received up to an instant.
    pub(crate) fn until(&mut self, receipt: Time) -> impl Iterator<Item = Received> + '_ {
        std::iter::from_fn(move || self.maker.as_mut()?.next_until(receipt))
    }

    /// What else is received: ranges take account of how the ship turns.
    pub(crate) fn hear(&mut self, received: &Received) {
        self.maker.iter_mut().for_each(|maker| maker.hear(received));
    }

    /// Whether a message is not wanted: a receiver that hears too few satellites has no fix.
    pub(crate) fn replaces(&self, received: &Received) -> bool {
        let time = received.message.time();
        let is_blind = || self.masks.iter().any(|mask| mask.leaves_no_fix(time));
        let is_unwanted = self.gnss == Some(GnssUse::None) || is_blind();
        is_unwanted && matches!(received.source, Source::Gnss(_))
    }
}

fn observed(texts: &RawTexts) -> anyhow::Result<VecDeque<SatelliteEpoch>> {
    let (path, text) = &texts.observations;
    let plain = plain(text)?;
    let fault = |error| BadInput(format!("{}: {error}", path.display()));
    Ok(ObservationReader::new(&plain).map_err(fault)?.flatten().collect())
}

/// What the base measured, at the place that the voyage or else its own file says; of one that moves, where it was at each epoch.
fn base(
    path: &Path,
    text: &[u8],
    table: &RawTable,
    start: GpsTime,
) -> anyhow::Result<VecDeque<Received>> {
    let plain = plain(text)?;
    let fault = |error| BadInput(format!("{}: {error}", path.display()));
    let mut reader = ObservationReader::new(&plain).map_err(fault)?;
    let surveyed = table.base().map(|place| earth::ecef(&place));
    let (mut all, mut is_known) = (VecDeque::new(), true);
    while let Some(read) = reader.next() {
        let Ok(epoch) = read else { continue };
        let header = reader.header();
        let is_moving = header.is_moving;
        let by_file = header.position.map(|place| Ecef(place.into()));
        // what was surveyed is the place of one that stands
        let by_survey = surveyed.filter(|_| !is_moving);
        let (position, is_surveyed) = (by_survey.or(by_file), by_survey.is_some());
        is_known &= position.is_some();
        let time = Time::START + epoch.tag.since(start);
        let told = BaseEpoch { time, station: None, position, is_surveyed, is_moving, epoch };
        let message = Message::Base(Arc::new(told));
        all.push_back(Received { receipt: time, source: Source::Base(0), message });
    }
    if !is_known {
        eprintln!("{}: nobody says where the base is", path.display());
    }
    Ok(all)
}

fn plain(text: &[u8]) -> anyhow::Result<Vec<u8>> {
    Ok(if is_compact(text) { expand(text)?.text.into_bytes() } else { text.to_vec() })
}

fn context((path, text): &(impl AsRef<Path>, Vec<u8>)) -> anyhow::Result<Context> {
    let path = path.as_ref().display();
    let told = read_navigation(text).map_err(|error| BadInput(format!("{path}: {error}")))?;
    let mut context = Context::default();
    for record in told.records {
        if let Err(refusal) = context.ephemerides.insert(record) {
            eprintln!("{path}: {}: {refusal}", record.satellite());
        }
    }
    context.ionosphere.extend(told.ionosphere);
    Ok(context)
}
