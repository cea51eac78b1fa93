//! `insd camera track`: the tracks of images as a table, or as sentences for a ship that listens.

use std::fs;
use std::path::PathBuf;

use anyhow::Context;
use insd_capture::TimedImage;
use insd_drivers::recording::{FEATURES_HEAD, feature_rows};
use insd_vision::{Hints, Tracked};

use super::album::Album;
use super::options::CameraOptions;
use super::sender::TrackSender;
use super::source::SourceOptions;

/// Options of `insd camera track`.
#[derive(Clone, Debug, clap::Args)]
pub(super) struct TrackArgs {
    #[command(flatten)]
    source: SourceOptions,
    #[command(flatten)]
    camera: CameraOptions,
    /// Where the table goes: t_s,id,u_px,v_px, points without the distortion of the lens
    #[arg(long, value_name = "CSV", required_unless_present_any = ["send", "sentences"])]
    out: Option<PathBuf>,
    /// Send each image at once as $PINSD,TRK by UDP, to a port of kind camera
    #[arg(long, value_name = "HOST:PORT")]
    send: Option<String>,
    /// Write a picture of what is seen every two seconds, over the one before, for the status page
    #[arg(long, value_name = "PNG")]
    picture: Option<PathBuf>,
    /// Write the same sentences to a file
    #[arg(long, value_name = "FILE")]
    sentences: Option<PathBuf>,
}

/// Runs the command.
pub(super) fn run(args: &TrackArgs) -> anyhow::Result<()> {
    let camera = args.camera.camera()?;
    let mut table = format!("{FEATURES_HEAD}\n");
    let mut sender = TrackSender::open(args.send.as_deref(), args.sentences.as_deref())?;
    let mut album = args.picture.as_deref().map(Album::new);
    let seen = |image: TimedImage, tracked: &Tracked, hints: &Hints| {
        if args.out.is_some() {
            table.push_str(&feature_rows(&tracked.frame));
        }
        sender.tell(&tracked.frame);
        let outcome = album.as_mut().map(|album| album.add(&camera, image, tracked, hints));
        if let Some(Err(fault)) = outcome {
            eprintln!("insd: {fault}; no more pictures");
            album = None;
        }
    };
    let (counts, _) = args.source.follow(&args.camera, &camera, seen)?;
    if let Some(out) = &args.out {
        fs::write(out, table).with_context(|| out.display().to_string())?;
    }
    for (reason, count) in &counts.refused {
        eprintln!("insd: {count} images not used: {}", reason.text());
    }
    sender.finish()
}
