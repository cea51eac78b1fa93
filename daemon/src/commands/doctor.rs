//! `insd doctor`: what is wrong with a configuration and with the computer it is meant for.

use std::io::Write as _;
use std::path::PathBuf;
use std::time::Duration;

use insd_config::{BadInput, Config};
use insd_languages::Language;

use super::check_config::{Outcome, read};
use crate::doctor::{Diagnosis, Extent, Person};

/// The service's own file and user.
const INSTALLED: &str = "/etc/insd/insd.toml";
const SERVICE: &str = "insd";

/// Options of `insd doctor`.
#[derive(Clone, Debug, clap::Args)]
#[command(
    after_help = "Ends with 0, with 2 if there are errors, and with 1 if there are warnings and --strict is given."
)]
pub struct DoctorArgs {
    /// Configuration file
    #[arg(value_name = "FILE", default_value = INSTALLED)]
    file: PathBuf,
    /// Listen at the ports for so long; 0 for not at all
    #[arg(long, value_name = "S", default_value_t = 5.0, value_parser = insd_lab::commands::seconds)]
    seconds: f64,
    /// As which user the daemon runs [default: insd for the installed file, else who asks]
    #[arg(long, value_name = "NAME")]
    user: Option<String>,
    /// As JSON
    #[arg(long)]
    json: bool,
    /// Warnings count as errors do
    #[arg(long)]
    strict: bool,
    /// Language of what is told: en or ja. Left out: the one that the file tells
    #[arg(long, value_name = "CODE")]
    language: Option<Language>,
}

/// Runs the command.
///
/// # Errors
/// [`BadInput`] if there are errors, or if the file cannot be read.
pub fn run(args: &DoctorArgs) -> anyhow::Result<()> {
    let text = read(&args.file)?;
    let person = match &args.user {
        Some(name) => {
            Person::named(name).ok_or_else(|| BadInput(format!("there is no user {name}")))?
        }
        None if args.file == std::path::Path::new(INSTALLED) => {
            Person::named(SERVICE).unwrap_or_else(Person::here)
        }
        None => Person::here(),
    };
    let listen = Duration::from_secs_f64(args.seconds.max(0.0));
    if !args.json && !listen.is_zero() {
        writeln!(
            std::io::stderr(),
            "looking as {}, listening for {} s",
            person.name,
            args.seconds
        )?;
    }
    let extent = Extent { listen, person, file: Some(args.file.clone()) };
    let diagnosis = Diagnosis::of_ship(&text, &extent)?;
    let language = args.language.unwrap_or_else(|| Config::language_of(&text));
    let outcome = Outcome { file: &args.file, json: args.json, strict: args.strict, language };
    outcome.tell(&diagnosis, "")
}
