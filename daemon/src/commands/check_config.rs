//! `insd check-config`: what is wrong with a configuration, and what it amounts to.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use insd_config::{BadInput, Config, OutputSection, Severity, check};
use insd_drivers::ports::{Destination, Transport};
use insd_lab::terminal::print;
use insd_languages::{Language, filled};

use crate::doctor::{Diagnosis, text};

/// There are warnings, and they count: ends with exit status 1.
#[derive(Debug, thiserror::Error)]
#[error("{0}")]
pub struct Warned(pub String);

/// Options of `insd check-config`.
#[derive(Clone, Debug, clap::Args)]
#[command(
    after_help = "Ends with 0, with 2 if there are errors, and with 1 if there are warnings and --strict is given."
)]
pub struct CheckConfigArgs {
    /// Configuration file
    #[arg(value_name = "FILE", default_value = "/etc/insd/insd.toml")]
    file: PathBuf,
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
/// [`BadInput`] if there are errors, and if the file cannot be read.
pub fn run(args: &CheckConfigArgs) -> anyhow::Result<()> {
    let text = read(&args.file)?;
    let diagnosis = Diagnosis::of_text(&text);
    let config = check::examine(&text).config.filter(|_| diagnosis.accepted);
    let language = args.language.unwrap_or_else(|| Config::language_of(&text));
    let summary = config.map(|config| summary(&config, language)).unwrap_or_default();
    let outcome = Outcome { file: &args.file, json: args.json, strict: args.strict, language };
    outcome.tell(&diagnosis, &summary)
}

/// The text of a configuration, with the overrides of the environment.
///
/// # Errors
/// [`BadInput`] if it cannot be read.
pub(super) fn read(file: &Path) -> anyhow::Result<String> {
    let text = Config::text_of(file);
    text.map_err(|error| BadInput(format!("{}: cannot be read: {error}", file.display())).into())
}

/// How a diagnosis is told, and how the command ends.
pub(super) struct Outcome<'a> {
    pub(super) file: &'a Path,
    pub(super) json: bool,
    pub(super) strict: bool,
    pub(super) language: Language,
}

impl Outcome<'_> {
    /// Prints what was found and, for people, a summary below it.
    pub(super) fn tell(&self, diagnosis: &Diagnosis, summary: &str) -> anyhow::Result<()> {
        let (file, sum) = (self.file.display(), text::sum(diagnosis));
        let told = self.language.catalogue().said(&sum);
        // what was found counts, whether it is read or not
        let printed = print(&if self.json {
            serde_json::to_string_pretty(diagnosis)? + "\n"
        } else {
            format!("{}{file}: {told}\n{summary}", text::report(diagnosis, self.language))
        });
        if diagnosis.count(Severity::Error) > 0 {
            return Err(BadInput(format!("{file}: {sum}")).into());
        }
        if self.strict && diagnosis.count(Severity::Warning) > 0 {
            return Err(Warned(format!("{file}: {sum}")).into());
        }
        Ok(printed?)
    }
}

/// What a configuration amounts to, a line for each thing in it.
fn summary(config: &Config, language: Language) -> String {
    let (mut text, catalogue) = (String::new(), language.catalogue());
    let mut line = |kind: &str, name: &str, what: &str| {
        let _ = match language {
            Language::English => writeln!(text, "  {kind:<9} {name}: {what}"),
            _ => {
                let (own, what) = (format!("check.list_{kind}"), catalogue.said(what));
                let values = [("name", name), ("what_text", what.as_str())];
                writeln!(text, "  {}", filled(catalogue.text(&own), &values))
            }
        };
    };
    for port in &config.ports {
        line("port", &port.name, &input(&port.transport));
    }
    for sensor in &config.sensors {
        let kind = toml::Value::try_from(sensor.kind).ok();
        let kind = kind.as_ref().and_then(toml::Value::as_str).unwrap_or_default();
        line("sensor", &sensor.name, &format!("{kind} on {}", sensor.port));
    }
    for output in &config.outputs {
        line("output", &output.name, &outgoing(output));
    }
    for berth in &config.berths {
        line("berth", &berth.name, &format!("quay of {:.0} m", berth.quay().length()));
    }
    for node in &config.nodes {
        line("node", &node.port, &format!("NMEA 2000, address {} first", node.address));
    }
    for fleet in &config.fleets {
        let budget =
            fleet.budget_bytes_h.map_or("no limit".to_owned(), |own| format!("{own} bytes/h"));
        let to = format!("MQTT to {}:{} as {}, {budget}", fleet.host, fleet.port(), fleet.ship);
        line("fleet", &fleet.name, &to);
    }
    if let Some(recording) = &config.recording {
        let quota = recording.quota_mb.map_or("no quota".to_owned(), |mb| format!("{mb} MB"));
        line("recording", &recording.folder.display().to_string(), &quota);
    }
    if let Some(chrony) = &config.chrony {
        line("time", "chrony", &chrony.socket.display().to_string());
    }
    text
}

fn input(transport: &Transport) -> String {
    match transport {
        Transport::Serial(own) => format!("{}, {} baud", own.device.display(), own.baud),
        Transport::Udp(own) => match own.multicast {
            Some(group) => format!("UDP {} of {group}", own.bind),
            None => format!("UDP {}", own.bind),
        },
        Transport::TcpClient(own) => format!("TCP, calls {}", own.address),
        Transport::Ntrip(own) => format!("NTRIP, calls {}/{}", own.address, own.mount),
        Transport::TcpServer(own) => format!("TCP, called at {}", own.bind),
        Transport::File(own) | Transport::Pipe(own) => own.path.display().to_string(),
        Transport::Pps(own) => format!("pulses of {}", own.device.display()),
        Transport::Socketcan(own) => format!("CAN {}", own.interface),
        Transport::Slcan(own) => format!("CAN by {}", own.device.display()),
        Transport::GatewayTcp(own) => format!("CAN by a gateway, calls {}", own.address),
        Transport::GatewayUdp(own) => format!("CAN by a gateway, UDP {}", own.bind),
        Transport::Candump(own) => format!("CAN of {}", own.path.display()),
    }
}

fn outgoing(output: &OutputSection) -> String {
    let to = match (&output.destination, &output.lan) {
        (Some(Destination::Serial(own)), _) => {
            format!("{}, {} baud", own.device.display(), own.baud)
        }
        (Some(Destination::Udp(own)), _) => format!("UDP to {}", own.to),
        (Some(Destination::TcpServer(own)), _) => format!("TCP, called at {}", own.bind),
        (Some(Destination::File(own)), _) => own.path.display().to_string(),
        (Some(Destination::Pty(own)), _) => own.path.display().to_string(),
        (None, Some(lan)) => format!("IEC 61162-450 as {}", lan.source),
        (None, None) => String::new(),
    };
    let kinds = output.port(0).messages.len();
    let simulated = if output.simulated { ", marked as simulated" } else { "" };
    match output.overload() {
        Some(share) => {
            format!("{to}, {kinds} kinds of message, {:.0} % of the line{simulated}", share * 100.0)
        }
        None => format!("{to}, {kinds} kinds of message{simulated}"),
    }
}
