//! What a replay is asked for.

use std::path::PathBuf;

use insd_vessel::{Names, Product};

use super::super::alignment::AlignmentArgs;
use super::super::outage::SensorOutage;
use super::without::Without;
use crate::camera_voyage::CameraWay;
use crate::ranges::{GnssUse, SatelliteMask};

/// Tells the journal of a product as the daemon does.
pub type Tell = fn(&Names, &Product);

/// Options of `insd replay`.
#[derive(Clone, Debug, clap::Args)]
pub struct ReplayArgs {
    /// File to write the solution to
    #[arg(long, value_name = "NAV.csv")]
    pub(super) out: PathBuf,
    #[command(flatten)]
    pub(super) options: ReplayOptions,
}

/// What is replayed, and how; where the solution goes is another matter.
#[derive(Clone, Debug, clap::Args)]
pub struct ReplayOptions {
    /// Voyage directory, or a raw recording: one of its files, or its folder
    pub(super) dir: PathBuf,
    /// Solutions per second [default: 10; of a raw recording, those of its configuration]
    #[arg(long, value_name = "HZ", value_parser = super::super::rate)]
    pub(super) rate: Option<f64>,
    /// For a raw recording: another configuration than the one it was made with. For a voyage: where
    /// the ports for --sent are
    #[arg(long, value_name = "FILE")]
    pub(super) config: Option<PathBuf>,
    /// Also write what each port is sent, to NAME.sent, and what is known at its epochs, to epochs.csv
    #[arg(long, value_name = "FOLDER")]
    pub(super) sent: Option<PathBuf>,
    /// For a raw recording that spans restarts of the program: which run, from 1
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub(super) run: u32,
    /// Take a sensor (imu, gnss, log, reference, camera) away while FROM <= t_s < TO; may be repeated
    #[arg(long = "outage", value_name = "SENSOR:FROM..TO")]
    pub(super) outages: Vec<SensorOutage>,
    /// What raw GNSS is made of: a fix of each epoch, or ranges; `none` leaves GNSS out [default: tight where raw GNSS is there]
    #[arg(long, value_enum)]
    pub(super) gnss: Option<GnssUse>,
    /// What is made of a camera: tracks of its points, or the steps of a visual odometry [default: tracks where features.csv is there]
    #[arg(long, value_enum)]
    pub(super) camera: Option<CameraWay>,
    /// Leave N satellites of the raw GNSS while FROM <= t_s < TO, those that stand highest, and no fix where N
    /// is less than four; may be repeated
    #[arg(long = "mask", value_name = "FROM..TO:N")]
    pub(super) masks: Vec<SatelliteMask>,
    /// Leave out what is named, between commas, to see what it gives
    #[arg(long, value_name = "WHAT", value_enum, value_delimiter = ',')]
    pub(super) without: Vec<Without>,
    /// What was learnt of log and IMU on earlier voyages (`insd learn`)
    #[arg(long, value_name = "FILE.toml")]
    pub(super) log_model: Option<PathBuf>,
    #[command(flatten)]
    pub(super) alignment: AlignmentArgs,
    /// Start warm: the state stored at the last shutdown, believed once the sensors confirm it
    #[arg(long, value_name = "FILE")]
    pub(super) stored_state: Option<PathBuf>,
    /// Store the state at the end for the next start, if the ship is aligned and lies at her berth
    #[arg(long, value_name = "FILE")]
    pub(super) save_state: Option<PathBuf>,
    /// Also write the innovations of all aids and satellites
    #[arg(long, value_name = "FILE.csv")]
    pub(super) innovations: Option<PathBuf>,
    /// Also write where each satellite of raw GNSS stood, and what became of it
    #[arg(long, value_name = "FILE.csv")]
    pub(super) sky: Option<PathBuf>,
    /// Also write every error state that is carried, once a second: name, unit, axes, value and sigma
    #[arg(long, value_name = "FILE.csv")]
    pub(super) states: Option<PathBuf>,
    /// Also write what the alignment says of itself: phase, sigmas, forecast, sea
    #[arg(long, value_name = "FILE.csv")]
    pub(super) alignment_log: Option<PathBuf>,
}
