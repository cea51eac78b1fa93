//! `insd report`: one HTML page that tells what a recording holds.

use std::io::Write;
use std::path::PathBuf;

use anyhow::Context;
use insd_config::{BadInput, OutputFile};
use insd_languages::Language;

use crate::background;
use crate::raw_run::is_recording;
use crate::report::VoyageReport;

/// Options of `insd report`.
#[derive(Clone, Debug, clap::Args)]
pub struct ReportArgs {
    /// Raw recording: one of its files, or its folder; or a voyage directory
    recording: PathBuf,
    /// File to write the page to
    #[arg(long, value_name = "FILE.html", default_value = "report.html")]
    out: PathBuf,
    /// Of a recording that spans restarts of the program: which run, from 1
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..))]
    run: u32,
    /// Another configuration than the one it was made with
    #[arg(long, value_name = "FILE")]
    config: Option<PathBuf>,
    /// Language of the page: en or ja. Left out: the one that its configuration tells
    #[arg(long, value_name = "CODE")]
    language: Option<Language>,
    /// Give way to everything else on this computer
    #[arg(long)]
    background: bool,
}

/// Runs the command. The page is a function of the recording and the options alone.
///
/// # Errors
/// The recording cannot be read or holds nothing, or the page cannot be written.
pub fn run(args: &ReportArgs) -> anyhow::Result<()> {
    if args.background {
        background::give_way();
    }
    let path = &args.recording;
    let report = if path.join("voyage.toml").exists() {
        if args.config.is_some() {
            return Err(BadInput("--config is for raw recordings".to_owned()).into());
        }
        VoyageReport::of_voyage(path)?
    } else if path.is_dir() && !is_recording(path) {
        let what = "neither a raw recording nor a voyage directory";
        return Err(BadInput(format!("{}: {what}", path.display())).into());
    } else {
        VoyageReport::of_recording(path, args.config.as_deref(), args.run)?
    };
    let language = args.language.unwrap_or_else(|| report.language());
    let mut file = OutputFile::create(&args.out)?;
    let written = file.write_all(report.html(language).as_bytes());
    written.with_context(|| format!("{}: cannot be written", args.out.display()))?;
    file.finish()
}
