//! What may be wrong at a port, in words for whoever stands before it with a screwdriver.

use insd_wire::stream::{Cutter, Protocol};

use super::bus::report::BusReport;
use super::message::excerpt;
use super::named::{UNNAMED, is_proof};
use super::report::{MessageReport, PortReport, RefusedMessage, State};

/// Fewer bytes say nothing of a line, and fewer frames nothing of its checksums.
const BYTES: u64 = 64;
const FRAMES: u64 = 20;

/// Share of bytes of no frame from which it is told, from which checksums tell nothing, and from which
/// the line as a whole is in doubt.
const SOME: f64 = 0.02;
const MOST: f64 = 0.5;
const MOSTLY: f64 = 0.9;

/// Share of frames with a wrong checksum from which it is told.
const DAMAGED: f64 = 0.01;

/// Bytes that are shown of what cannot be read.
const SAMPLE: usize = 20;

/// Shares of what a line can carry.
const NEARLY_FULL: f64 = 0.9;
const TOO_FULL: f64 = 1.05;

/// Share of what a CAN bus can carry from which it is told.
const BUSY: f64 = 0.6;

/// All that is worth telling of a port. `tail` are the bytes that came last, `unreadable` the number
/// of bytes heard while no baud rate fitted.
pub(super) fn hints(
    port: &PortReport,
    tail: &[u8],
    unreadable: u64,
    protocols: &[Protocol],
) -> Vec<String> {
    let mut hints = Vec::new();
    match &port.state {
        State::Absent { reason } => hints.extend(absent(reason, unreadable)),
        State::Silent { .. } if port.is_mute() => {
            hints.push(nothing(port));
        }
        State::Silent { .. } => {
            hints.push("it has spoken and is silent now: power, plug or sender".to_owned());
        }
        _ => {}
    }
    hints.extend(stray(port, tail, protocols));
    hints.extend(checksums(port));
    hints.extend(load(port));
    hints.extend(port.bus.as_ref().map(bus).into_iter().flatten());
    if port.losses > 0 {
        let times =
            if port.losses == 1 { "once".to_owned() } else { format!("{} times", port.losses) };
        hints.push(format!("lost {times}: a loose plug, or a sender that hangs up"));
    }
    if port.dropped > 0 {
        hints.push(format!("{} bytes came too fast to be counted", port.dropped));
    }
    hints
}

fn absent(reason: &str, unreadable: u64) -> Option<String> {
    let has = |part: &str| reason.to_lowercase().contains(part);
    if has("nothing readable") {
        return Some(if unreadable > 0 {
            format!(
                "{unreadable} bytes were heard, but no known format at any usual rate: another rate \
                 or format, or a line whose A and B are swapped"
            )
        } else {
            format!("not one byte at any usual rate: {CABLE}")
        });
    }
    let hint = if has("no such file") || has("no such device") {
        "`insd ports` lists what this computer has"
    } else if has("permission denied") {
        "the user needs the group of the device, often `dialout`: `insd ports` tells"
    } else if has("busy") || has("locked") {
        "another program has it open: `fuser -v DEVICE` tells which"
    } else if has("refused") {
        "the computer is there, but nothing listens at that port: is the number right?"
    } else if has("not a typewriter") || has("inappropriate ioctl") {
        "this is no serial line"
    } else {
        return None;
    };
    Some(hint.to_owned())
}

/// What to look at when a line is dead.
const CABLE: &str = "is the sensor powered, is this its cable, are transmit and receive (A and B) \
                     the right way round? Some send only when asked; insd sniff never asks";

fn nothing(port: &PortReport) -> String {
    let what = port.what.as_deref().unwrap_or_default();
    if what.starts_with("udp ") {
        "no datagram: is the sender in this network, is its address and port this one, does a \
         firewall drop it? For a group, name the interface: udp://IFACE@GROUP:PORT"
            .to_owned()
    } else if what.starts_with("tcp server") {
        "nobody has called and spoken".to_owned()
    } else if what.starts_with("can ") {
        "not one frame: is the backbone powered and terminated, has the interface its bitrate \
         (`ip -details link show`: 250000 for NMEA 2000), are CAN-H and CAN-L the right way round?"
            .to_owned()
    } else if what.contains("/pps") {
        "no pulse: has the receiver a fix, and is its pulse switched on?".to_owned()
    } else if port.baud.is_some() {
        format!("not one byte: {CABLE}")
    } else {
        "not one byte: does the sender run?".to_owned()
    }
}

fn stray(port: &PortReport, tail: &[u8], protocols: &[Protocol]) -> Vec<String> {
    let share = port.stray_share();
    if port.stray < BYTES || share < SOME {
        return Vec::new();
    }
    if protocols.len() < Protocol::ALL.len() {
        let names: Vec<&str> = protocols.iter().map(|protocol| protocol.name()).collect();
        return vec![format!("only {} was looked for", names.join(", "))];
    }
    if port.frames > 0 && share < MOSTLY {
        let percent = share * 100.0;
        return vec![format!(
            "{percent:.1} % of the bytes belong to no frame: comments or another format in between, \
             or bytes lost on the way"
        )];
    }
    vec![suspicion(port, tail), format!("what came last: {}", sample(tail))]
}

/// What bytes may be of which most belong to no frame.
fn suspicion(port: &PortReport, tail: &[u8]) -> String {
    let share = |good: fn(&u8) -> bool| {
        tail.iter().filter(|byte| good(byte)).count() as f64 / tail.len().max(1) as f64
    };
    if let Some(protocol) = behind_parity(tail) {
        return format!(
            "without the eighth bit this reads as {}: the line has 7 data bits and a parity bit",
            protocol.name()
        );
    }
    if is_text(tail) {
        return "text, but no sentences: a console, or a format that insd does not know".to_owned();
    }
    let Some(baud) = port.baud else {
        return "a format that insd does not know".to_owned();
    };
    let inverted = if share(|byte| matches!(byte, 0 | 0xFF)) > 0.3 {
        "nearly all 00 and FF: a wrong baud rate, or an inverted line (A and B swapped)"
    } else {
        "a wrong baud rate is likeliest; else an inverted line (A and B swapped), or a format that \
         insd does not know"
    };
    format!("{inverted}. {baud} baud was listened at: try `,auto`")
}

fn is_text(bytes: &[u8]) -> bool {
    let printable = |byte: &&u8| byte.is_ascii_graphic() || byte.is_ascii_whitespace();
    bytes.iter().filter(printable).count() as f64 > 0.95 * bytes.len() as f64
}

/// Some of the bytes: a line of text, or digits.
fn sample(tail: &[u8]) -> String {
    if is_text(tail) {
        let lines = tail.split(|byte| matches!(byte, b'\r' | b'\n'));
        let longest = lines.max_by_key(|line| line.len().min(80)).unwrap_or_default();
        return excerpt(longest);
    }
    excerpt(tail.get(tail.len().saturating_sub(SAMPLE)..).unwrap_or_default())
}

/// The protocol that shows when the highest bit of all bytes is taken away, if it was used.
fn behind_parity(tail: &[u8]) -> Option<Protocol> {
    let stripped: Vec<u8> = tail.iter().map(|byte| byte & 0x7F).collect();
    let mut cutter = Cutter::new(&[Protocol::Nmea, Protocol::Pd6]);
    cutter.push(&stripped);
    let (mut first, mut count) = (None, 0);
    while let Some(cut) = cutter.cut() {
        if is_proof(cut.protocol, cut.bytes) {
            first = first.or(Some(cut.protocol));
            count += 1;
        }
    }
    first.filter(|_| count > 1 && tail != stripped.as_slice())
}

fn checksums(port: &PortReport) -> Vec<String> {
    let mut hints = Vec::new();
    let share = port.damaged_share();
    if port.frames >= FRAMES && share > DAMAGED && port.stray_share() < MOST {
        hints.push(format!(
            "{:.1} % of the frames have a wrong checksum: noise on the line (shield, termination, a \
             common ground), or bytes lost on the way",
            share * 100.0
        ));
    }
    let bare = |message: &MessageReport| {
        let is_bare = |refusal: &RefusedMessage| refusal.reason == "no checksum";
        message.name != UNNAMED && message.refusal.as_ref().is_some_and(is_bare)
    };
    if port.messages.iter().any(bare) {
        hints.push(
            "lines without a checksum are refused: switch it on in the device, or set \
             `no_checksum = true` for the sensor (what is damaged on the line is then believed)"
                .to_owned(),
        );
    }
    let flawed: u64 = port.messages.iter().map(|message| message.flawed).sum();
    if flawed > 0 {
        hints.push(format!(
            "{flawed} sentences have a field that is none: it is left out, and the rest is used"
        ));
    }
    let is_used = port.messages.iter().any(|message| message.used + message.bare > 0);
    if port.frames >= FRAMES && !is_used && port.stray_share() < MOSTLY {
        hints.push(
            "nothing of this is used by insd: choose other messages in the device".to_owned(),
        );
    }
    hints
}

/// What may be wrong on a CAN bus.
fn bus(bus: &BusReport) -> Vec<String> {
    let mut hints = Vec::new();
    if !bus.events.is_empty() {
        hints.push(
            "errors on the bus: two terminators of 120 ohms, one bitrate for all, sound plugs?"
                .to_owned(),
        );
    }
    if bus.load.is_some_and(|load| load > BUSY) {
        hints.push("the bus is busy: what has low priority comes late".to_owned());
    }
    let nameless = bus.devices.iter().filter(|device| device.name.is_none()).count();
    if nameless > 0 {
        hints.push(format!(
            "{nameless} devices have not told their NAMEs: most do only when they are asked, see \
             `--ask`"
        ));
    }
    hints
}

fn load(port: &PortReport) -> Option<String> {
    let (load, baud) = port.load.zip(port.baud)?;
    if load > TOO_FULL {
        Some(format!("more than {baud} baud can carry: a USB device, whose rate means nothing"))
    } else if load > NEARLY_FULL {
        Some(format!(
            "the line is full, and messages come late: less of them, or more than {baud} baud"
        ))
    } else {
        None
    }
}
