//! `insd check-config`: what is wrong with a configuration, and what it amounts to.

use std::fmt::Write as _;
use std::path::PathBuf;

use insd_drivers::ports::{Destination, Transport};

use crate::config::{Config, OutputSection};

/// Options of `insd check-config`.
#[derive(Clone, Debug, clap::Args)]
pub struct CheckConfigArgs {
    /// Configuration file
    #[arg(value_name = "FILE", default_value = "/etc/insd/insd.toml")]
    file: PathBuf,
}

/// Runs the command.
///
/// # Errors
/// [`crate::cli::BadInput`] with all faults, and if the file cannot be read.
pub fn run(args: &CheckConfigArgs) -> anyhow::Result<()> {
    let (config, _) = Config::load(&args.file)?;
    print!("{}: no faults\n{}", args.file.display(), summary(&config));
    Ok(())
}

/// What a configuration amounts to, a line for each thing in it.
fn summary(config: &Config) -> String {
    let mut text = String::new();
    let mut line = |kind: &str, name: &str, what: &str| {
        let _ = writeln!(text, "  {kind:<9} {name}: {what}");
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
    for node in &config.nodes {
        line("node", &node.port, &format!("NMEA 2000, address {} first", node.address));
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
