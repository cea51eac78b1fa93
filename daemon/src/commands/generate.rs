//! `insd generate`: manual pages and completions for shells, from the command line's own description. For
//! who makes packages.

use std::fs;
use std::path::{Path, PathBuf};

use anyhow::Context;
use clap::{Command, ValueEnum};
use clap_complete::Shell;
use insd_config::reference;

/// Options of `insd generate`.
#[derive(Clone, Debug, clap::Args)]
pub struct GenerateArgs {
    /// What to write
    what: What,
    /// Where to, one file for each
    #[arg(value_name = "DIR")]
    folder: PathBuf,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum What {
    /// A manual page for the program, for each of its commands, and for its configuration
    Man,
    /// Completions for bash, zsh and fish
    Completions,
}

/// Runs the command.
///
/// # Errors
/// A file cannot be written.
pub fn run(args: &GenerateArgs, program: &Command) -> anyhow::Result<()> {
    fs::create_dir_all(&args.folder).with_context(|| format!("{}", args.folder.display()))?;
    match args.what {
        What::Man => clap_mangen::generate_to(program.clone(), &args.folder)
            .and_then(|()| fs::write(args.folder.join("insd.toml.5"), reference::manual_page()))
            .with_context(|| format!("{}", args.folder.display())),
        What::Completions => [Shell::Bash, Shell::Zsh, Shell::Fish]
            .into_iter()
            .try_for_each(|shell| completions(shell, program, &args.folder)),
    }
}

fn completions(shell: Shell, program: &Command, folder: &Path) -> anyhow::Result<()> {
    clap_complete::generate_to(shell, &mut program.clone(), "insd", folder)
        .with_context(|| format!("{}", folder.display()))
        .map(drop)
}
