//! `insd camera track`: the tracks of images as a table.

use std::fs;
use std::path::PathBuf;

use anyhow::Context;
use insd_capture::on_one_core;
use insd_vision::{FEATURES_HEAD, feature_rows};

use super::attitude::Attitudes;
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
    let mut eyes = args.camera.front_end(&camera)?;
    let attitudes =
        args.camera.attitude.as_deref().map(|path| Attitudes::read(path, &args.camera.c_bc()));
    let attitudes = attitudes.transpose()?.unwrap_or_default();
    let mut table = format!("{FEATURES_HEAD}\n");
    on_one_core(|| {
        args.source.for_each(camera.size, |image| {
            let hints = attitudes.hints(image.time, eyes.newest());
            if let Ok(tracked) = eyes.take(&image.picture(), &hints) {
                table.push_str(&feature_rows(&tracked.frame));
            }
        })
    })?;
    fs::write(&args.out, table).with_context(|| args.out.display().to_string())?;
    for (reason, count) in &eyes.counts().refused {
        eprintln!("insd: {count} images not used: {}", reason.text());
    }
    Ok(())
}
