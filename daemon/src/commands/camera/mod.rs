//! `insd camera`: what a camera sees, and the tracks of its images for a recording.

mod album;
mod attitude;
mod check;
mod options;
mod scene;
mod sender;
mod source;
mod summary;
mod track;

/// Options of `insd camera`.
#[derive(Clone, Debug, clap::Args)]
pub struct CameraArgs {
    #[command(subcommand)]
    what: What,
}

#[derive(Clone, Debug, clap::Subcommand)]
enum What {
    /// Tell how well points are followed, how sharp and bright images are, and draw tracks and horizon over one
    Check(check::CheckArgs),
    /// Write the tracks of points (t_s,id,u_px,v_px), which is what a recording holds of a camera, or send them to a ship that listens
    Track(track::TrackArgs),
}

/// Runs the command.
///
/// # Errors
/// Images, calibration or attitude cannot be read, or a file cannot be written.
pub fn run(args: &CameraArgs) -> anyhow::Result<()> {
    match &args.what {
        What::Check(args) => check::run(args),
        What::Track(args) => track::run(args),
    }
}
