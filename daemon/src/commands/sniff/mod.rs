//! `insd sniff`: what comes in at a port. It listens, and writes nothing unless told to ask
//! the devices of a CAN bus who they are.

mod address;
mod asker;
mod can;
mod captured;
mod frames;
mod live;
mod recorded;
mod screen;

use std::io::{self, IsTerminal, Write};

use anyhow::Context;
use insd_drivers::ports::PortConfig;
use insd_lab::sniff::report::PortReport;
use insd_lab::sniff::{SniffReport, text};
use insd_wire::stream::Protocol;

pub use address::{Address, Source, parse};

/// Options of `insd sniff`.
#[derive(Clone, Debug, clap::Args)]
#[command(after_help = PORTS)]
pub struct SniffArgs {
    /// What to listen to: see below
    #[arg(value_name = "PORT", required = true, value_parser = parse)]
    pub ports: Vec<Address>,

    /// Listen for so long, once the ports are open; 0 until Ctrl-C [default: 10; with --follow 0]
    #[arg(long, value_name = "S", value_parser = seconds)]
    pub seconds: Option<f64>,

    /// Only one report at the end, in a terminal too
    #[arg(long)]
    pub once: bool,

    /// The report as JSON
    #[arg(long)]
    pub json: bool,

    /// Instead of a report what comes, decoded, an object of JSON a line (docs/sniff.md)
    #[arg(long, requires = "json")]
    pub follow: bool,

    /// Look for this protocol only; may be given several times
    #[arg(long, value_name = "NAME", value_parser = protocol)]
    pub protocol: Vec<Protocol>,

    /// Of a CAN bus: ask all devices who they are. This is the only way in which sniff ever writes
    #[arg(long)]
    pub ask: bool,

    /// Also print each frame as it comes, with its time of receipt
    #[arg(long, conflicts_with = "json")]
    pub raw: bool,
}

impl SniffArgs {
    /// For how long is listened, s; zero without end.
    fn listening(&self) -> f64 {
        self.seconds.unwrap_or(if self.follow { 0.0 } else { 10.0 })
    }

    /// In which form what comes is printed at once.
    fn form(&self) -> frames::Form {
        match (self.follow, self.raw) {
            (true, _) => frames::Form::Json,
            (false, true) => frames::Form::Text,
            (false, false) => frames::Form::Nothing,
        }
    }
}

const PORTS: &str = "\
PORT is one of
  /dev/ttyUSB0,115200          a serial line and its baud rate (8 bits, no parity)
  /dev/ttyUSB0                 the baud rate is found by listening at the usual ones
  udp://[IFACE@]ADDRESS:PORT   datagrams; a multicast group is joined on the interface
  tcp://HOST:PORT              a server that is called
  tcp-listen://[ADDRESS]:PORT  a server to be
  pps:///dev/pps0              a pulse per second
  can0                         a CAN bus: devices by NAME, product and messages
  can+tcp://FORMAT@HOST:PORT   a CAN gateway that speaks text: candump, ydwg, actisense,
  can+udp://FORMAT@ADDR:PORT   canboat-plain
  -                            standard input, to its end
  capture.log                  a named pipe, or a file: what a device has said, a log of candump,
                               of canboat, of a gateway of NMEA 2000
  voyage.insdraw               a raw recording, or a folder with one

Exit status
  0  something that insd reads came from every PORT
  1  a PORT cannot be opened, or nothing came from it that insd reads
  2  the command line is wrong, or a recording is none";

/// Listens and reports.
///
/// # Errors
/// A recording that cannot be read, or an output that fails. A port that cannot be opened, or from which
/// nothing comes that insd reads, is part of the report, and an error behind it.
pub fn run(args: &SniffArgs) -> anyhow::Result<()> {
    let protocols = if args.protocol.is_empty() { &Protocol::ALL[..] } else { &args.protocol[..] };
    let form = args.form();
    let mut ports = Vec::new();
    let mut report = SniffReport { ports: Vec::new() };
    let mut mutes = Vec::new();
    for address in &args.ports {
        match &address.source {
            Source::Port(config) => ports.push(live::Opening {
                plan: address.plan.clone(),
                config: PortConfig::clone(config),
                search_s: address.search_s(),
            }),
            Source::Captured(path, format) => {
                let read = captured::read(path, *format, &address.plan, protocols, form)?;
                mutes.extend(mute(&address.plan.name, &read.ports));
                report.ports.extend(read.ports);
            }
            Source::Recording(path) => {
                let read = recorded::read(path, &address.plan.name, protocols, form)?;
                mutes.extend(mute(&address.plan.name, &read.ports));
                report.ports.extend(read.ports);
            }
        }
    }
    if !ports.is_empty() {
        let is_live = !(args.once || args.json || args.raw) && io::stdout().is_terminal();
        let style =
            live::Style { seconds: args.listening(), redraw: is_live, frames: form, ask: args.ask };
        let heard = live::listen(ports, protocols, style)?.ports;
        mutes.extend(heard.iter().filter_map(|port| mute(&port.name, std::slice::from_ref(port))));
        report.ports.extend(heard);
    }
    let text = if args.follow {
        String::new()
    } else if args.json {
        serde_json::to_string_pretty(&report)? + "\n"
    } else if args.raw {
        format!("\n{}", text::report(&report))
    } else {
        text::report(&report)
    };
    print(&text)?;
    anyhow::ensure!(mutes.is_empty(), "nothing that insd reads came from {}", mutes.join(", "));
    Ok(())
}

/// The argument, if nothing that insd reads came from any of its ports.
fn mute(name: &str, ports: &[PortReport]) -> Option<String> {
    (!ports.iter().any(PortReport::is_readable)).then(|| name.to_owned())
}

/// Prints, and takes no offence at a reader that has seen enough.
fn print(text: &str) -> anyhow::Result<()> {
    let mut out = io::stdout().lock();
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => {
            Err(error).context("cannot print")
        }
        _ => Ok(()),
    }
}

fn protocol(text: &str) -> Result<Protocol, String> {
    let known = || Protocol::ALL.into_iter().chain(Protocol::ASKED_FOR);
    let found = known().find(|protocol| protocol.name() == text);
    let names = || known().map(Protocol::name).collect::<Vec<_>>().join(", ");
    found.ok_or_else(|| format!("expected one of {}", names()))
}

fn seconds(text: &str) -> Result<f64, String> {
    let seconds = text.parse().ok().filter(|seconds| (0.0..=86_400.0).contains(seconds));
    seconds.ok_or_else(|| "expected a number of seconds from 0 to 86400".to_owned())
}
