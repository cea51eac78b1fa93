//! `insd camera check`: how well a camera sees.

use std::path::PathBuf;

use insd_capture::TimedImage;
use insd_lab::terminal::print;
use insd_vision::{Hints, Tracked};

use super::options::CameraOptions;
use super::scene::Scene;
use super::source::SourceOptions;
use super::summary::Summary;

/// Options of `insd camera check`.
#[derive(Clone, Debug, clap::Args)]
pub(super) struct CheckArgs {
    #[command(flatten)]
    source: SourceOptions,
    #[command(flatten)]
    camera: CameraOptions,
    /// Draw tracks and, where the attitude is known, the horizon over the last image
    #[arg(long, value_name = "PNG")]
    picture: Option<PathBuf>,
}

/// Runs the command.
pub(super) fn run(args: &CheckArgs) -> anyhow::Result<()> {
    let camera = args.camera.camera()?;
    let (mut summary, mut scene) = (Summary::default(), Scene::default());
    let seen = |image: TimedImage, tracked: &Tracked, hints: &Hints| {
        summary.add(tracked);
        scene.add(image, tracked, hints);
    };
    let (counts, dropped) = args.source.follow(&args.camera, &camera, seen)?;
    print(&summary.text(&counts, dropped))?;
    if let (Some(path), Some(sketch)) = (&args.picture, scene.draw(&camera)) {
        sketch.write(path)?;
    }
    Ok(())
}
