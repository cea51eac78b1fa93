//! `insd example-config`: commented configurations to start from.

use insd_config::BadInput;
use insd_lab::terminal::print;

/// Options of `insd example-config`.
#[derive(Clone, Debug, clap::Args)]
pub struct ExampleConfigArgs {
    /// Which one
    #[arg(value_name = "PROFILE", default_value = "ship")]
    profile: String,
    /// Tell which there are
    #[arg(long, conflicts_with = "profile")]
    list: bool,
}

/// A configuration to start from.
#[derive(Clone, Copy, Debug)]
pub struct Example {
    /// Its name.
    pub name: &'static str,
    /// What it is for.
    pub what: &'static str,
    /// The file.
    pub text: &'static str,
}

/// All of them; the first is what the package installs.
pub const EXAMPLES: [Example; 5] = [
    Example {
        name: "ship",
        what: "what the package installs: IMU and receiver on serial lines, the rest as comments",
        text: include_str!("../../../systemd/insd.toml"),
    },
    Example {
        name: "minimal",
        what: "an IMU, a receiver, one output",
        text: include_str!("../../../systemd/examples/minimal.toml"),
    },
    Example {
        name: "simulated",
        what: "the sensors of `insd feed`: to try it without hardware",
        text: include_str!("../../../systemd/examples/simulated.toml"),
    },
    Example {
        name: "survey",
        what: "pulses, log, monitoring point, multibeam, IEC 61162-450, recording",
        text: include_str!("../../../systemd/examples/survey.toml"),
    },
    Example {
        name: "nmea2000",
        what: "receiver, compass and log on an NMEA 2000 backbone, and a node that tells it all",
        text: include_str!("../../../systemd/examples/nmea2000.toml"),
    },
];

/// Runs the command.
///
/// # Errors
/// [`BadInput`] if there is no such profile, or what standard output says.
pub fn run(args: &ExampleConfigArgs) -> anyhow::Result<()> {
    if args.list {
        let line = |example: Example| format!("{:<10} {}\n", example.name, example.what);
        return Ok(print(&EXAMPLES.map(line).concat())?);
    }
    let found = EXAMPLES.iter().find(|example| example.name == args.profile);
    let example = found.ok_or_else(|| {
        let names = EXAMPLES.map(|example| example.name).join(", ");
        BadInput(format!("{}: expected one of {names}", args.profile))
    })?;
    Ok(print(example.text)?)
}
