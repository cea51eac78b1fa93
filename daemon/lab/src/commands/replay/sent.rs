//! What the ports were sent, or would be: a file for each, and what was meant.

use std::fs;
use std::io::Write;
use std::path::Path;

use anyhow::Context;
use insd_config::{Config, OutputFile};
use insd_output::OutputEpoch;
use insd_vessel::Spoken;
use serde::Serialize;

use crate::evaluation::RowWriter;

/// The files of a folder.
pub(super) struct Sent {
    ports: Vec<OutputFile>,
    epochs: RowWriter<EpochRow, OutputFile>,
}

/// What is known of the IMU at an epoch of the ports; what is not is empty.
#[derive(Clone, Debug, Serialize)]
struct EpochRow {
    utc_s: Option<f64>,
    t_s: f64,
    lat_deg: Option<f64>,
    lon_deg: Option<f64>,
    height_m: Option<f64>,
    heading_deg: Option<f64>,
    roll_deg: Option<f64>,
    pitch_deg: Option<f64>,
    heave_m: Option<f64>,
    sog_mps: Option<f64>,
    cog_deg: Option<f64>,
    rot_deg_min: Option<f64>,
    vn: Option<f64>,
    ve: Option<f64>,
    vd: Option<f64>,
}

impl Sent {
    /// Files `NAME.sent` for the ports of a configuration and `epochs.csv`.
    pub(super) fn create(folder: &Path, config: &Config) -> anyhow::Result<Self> {
        fs::create_dir_all(folder)
            .with_context(|| format!("{}: cannot be made", folder.display()))?;
        let port = |name: &str| OutputFile::create(&folder.join(format!("{name}.sent")));
        let ports = config.outputs.iter().map(|output| port(&output.name));
        let epochs = RowWriter::new(OutputFile::create(&folder.join("epochs.csv"))?);
        Ok(Sent { ports: ports.collect::<anyhow::Result<_>>()?, epochs })
    }

    /// Writes what was said.
    pub(super) fn take(&mut self, spoken: &Spoken) -> std::io::Result<()> {
        match spoken {
            Spoken::Messages(port, messages) => {
                let Some(file) = self.ports.get_mut(*port) else { return Ok(()) };
                messages.iter().try_for_each(|message| file.write_all(&message.content.to_bytes()))
            }
            Spoken::Epochs(epochs) => match epochs.first() {
                Some(epoch) => self.epochs.write(&EpochRow::of(epoch)),
                None => Ok(()),
            },
        }
    }

    /// Moves the files to their places.
    pub(super) fn finish(self) -> anyhow::Result<()> {
        self.ports.into_iter().try_for_each(OutputFile::finish)?;
        self.epochs.finish()?.finish()
    }
}

impl EpochRow {
    fn of(epoch: &OutputEpoch) -> Self {
        let solution = epoch.solution.as_ref();
        let value = |pick: fn(&insd_base::Solution) -> f64| solution.map(pick);
        EpochRow {
            utc_s: epoch.utc.map(|utc| utc.as_nanos() as f64 * 1e-9),
            t_s: epoch.time.as_seconds(),
            lat_deg: value(|s| s.position.latitude.to_degrees()),
            lon_deg: value(|s| s.position.longitude.to_degrees()),
            height_m: value(|s| s.position.height),
            heading_deg: value(|s| s.attitude.heading.to_degrees()),
            roll_deg: value(|s| s.attitude.roll.to_degrees()),
            pitch_deg: value(|s| s.attitude.pitch.to_degrees()),
            heave_m: epoch.heave.map(|heave| heave.heave),
            sog_mps: value(insd_base::Solution::speed),
            cog_deg: value(|s| s.course().to_degrees()),
            rot_deg_min: value(|s| s.rate_of_turn().to_degrees() * 60.0),
            vn: value(|s| s.velocity.0.x),
            ve: value(|s| s.velocity.0.y),
            vd: value(|s| s.velocity.0.z),
        }
    }
}
