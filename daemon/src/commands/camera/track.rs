//! `insd camera track`: the tracks of images as a table.

use std::fs;
use std::path::PathBuf;

use anyhow::Context;
use insd_capture::TimedImage;
use insd_drivers::recording::{FEATURES_HEAD, feature_rows};
use insd_vision::{Hints, Tracked};

use super::options::CameraOptions;
use super::source::SourceOptions;

/// Options of `insd camera track`.
#[derive(Clone, Debug, clap::Args)]
pub(super) struct TrackArgs {
    #[command(flatten)]
    source: SourceOptions,
    #[command(flatten)]
    camera: CameraOptions,
    /// Where the table goes: t_s,id,u_px,v_px, points without the distortion of the lens
    #[arg(long, value_name = "CSV")]
    out: PathBuf,
}

/// Runs the command.
pub(super) fn run(args: &TrackArgs) -> anyhow::Result<()> {
    let camera = args.camera.camera()?;
    let mut table = format!("{FEATURES_HEAD}\n");
    let seen = |_: TimedImage, tracked: &Tracked, _: &Hints| {
        table.push_str(&feature_rows(&tracked.frame));
    };
    let (counts, _) = args.source.follow(&args.camera, &camera, seen)?;
    fs::write(&args.out, table).with_context(|| args.out.display().to_string())?;
    for (reason, count) in &counts.refused {
        eprintln!("insd: {count} images not used: {}", reason.text());
    }
    Ok(())
}
