//! `--raw` and `--follow`: each frame as it comes, as text or as an object of JSON.

use std::fmt::Write as _;
use std::io::{self, Write as _};

use insd_base::UtcTime;
use insd_lab::sniff::text::printable;
use insd_lab::sniff::{Follower, Seen, SeenWhat};
use insd_wire::describe::ReadOutcome;

/// Bytes of one line of a dump.
const ROW: usize = 16;

/// Bytes of one frame that are printed.
const MOST: usize = 1024;

/// In which form what is seen is printed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Form {
    /// Not at all.
    Nothing,
    /// As text.
    Text,
    /// As objects of JSON, one a line.
    Json,
}

/// Prints what is seen, until that fails.
#[derive(Debug)]
pub(super) struct Printer {
    form: Form,
    follower: Follower,
    failed: Option<io::Error>,
}

impl Printer {
    /// A printer that prints in a form.
    pub(super) fn new(form: Form) -> Self {
        Printer { form, follower: Follower::default(), failed: None }
    }

    /// Prints it.
    pub(super) fn show(&mut self, seen: &Seen<'_>) {
        if self.failed.is_some() {
            return;
        }
        let text = match self.form {
            Form::Nothing => return,
            Form::Text => lines(seen),
            Form::Json => format!("{}\n", self.follower.object(seen)),
        };
        self.failed = io::stdout().lock().write_all(text.as_bytes()).err();
    }

    /// Whether its reader has seen enough.
    ///
    /// # Errors
    /// Any other failure.
    pub(super) fn outcome(&mut self) -> io::Result<bool> {
        match self.failed.take() {
            None => Ok(false),
            Some(error) if error.kind() == io::ErrorKind::BrokenPipe => Ok(true),
            Some(error) => Err(error),
        }
    }
}

/// Time, port and message in one line with the text; a dump below if it is no text.
fn lines(seen: &Seen<'_>) -> String {
    let mut text = format!("{} {} ", time_of_day(seen.stamp.system), seen.port);
    match seen.what {
        SeenWhat::Frame { protocol, name, read, reason, bytes } => {
            let _ = write!(text, "{} {name}", protocol.name());
            if read == ReadOutcome::Refused {
                let _ = write!(text, " refused ({})", reason.unwrap_or("not what it says"));
            }
            append(&mut text, bytes);
        }
        SeenWhat::Stray { count, bytes } => {
            let _ = write!(text, "- {count} bytes of no frame");
            // with good frames among them those would be shown a second time
            if count >= bytes.len() as u64 / 2 {
                text.push_str(", among these");
                append(&mut text, bytes);
            } else {
                text.push('\n');
            }
        }
        SeenWhat::Can(frame) => {
            let _ = write!(text, "{} [{}]", frame.id(), frame.data().len());
            for byte in frame.data() {
                let _ = write!(text, " {byte:02X}");
            }
            text.push('\n');
        }
        SeenWhat::Bus(event) => {
            let _ = writeln!(text, "- {event}");
        }
        SeenWhat::Pulse { sequence } => {
            let _ = writeln!(text, "pulse {sequence}");
        }
        SeenWhat::State(state) => {
            let _ = writeln!(text, "- {state}");
        }
    }
    printable(&text)
}

/// Hours, minutes, seconds of UTC, as the computer believes.
fn time_of_day(time: UtcTime) -> String {
    let (_, nanos) = time.to_civil();
    let (seconds, micros) = (nanos / 1_000_000_000, nanos % 1_000_000_000 / 1000);
    let (hours, minutes) = (seconds / 3600, seconds / 60 % 60);
    format!("{hours:02}:{minutes:02}:{:02}.{micros:06}", seconds % 60)
}

fn append(text: &mut String, bytes: &[u8]) {
    let is_text = bytes.trim_ascii_end().iter().all(|byte| (b' '..=b'~').contains(byte));
    if is_text {
        let _ = writeln!(text, "  {}", String::from_utf8_lossy(bytes.trim_ascii_end()));
        return;
    }
    let _ = writeln!(text, " ({} bytes)", bytes.len());
    for row in bytes.get(..MOST).unwrap_or(bytes).chunks(ROW) {
        let digits: Vec<String> = row.iter().map(|byte| format!("{byte:02X}")).collect();
        let printable = |byte: &u8| if (b' '..=b'~').contains(byte) { *byte as char } else { '.' };
        let letters: String = row.iter().map(printable).collect();
        let _ = writeln!(text, "    {:<47}  {letters}", digits.join(" "));
    }
    if bytes.len() > MOST {
        text.push_str("    ...\n");
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use insd_base::{Stamp, Time};
    use insd_wire::stream::Protocol;

    fn shown(what: SeenWhat<'_>) -> String {
        let stamp = Stamp {
            monotonic: Time::from_seconds(1.5),
            system: UtcTime::from_nanos(3_723_500_000_000),
        };
        lines(&Seen { port: "gnss", timed: true, stamp, what })
    }

    #[test]
    fn text_is_shown_as_text_and_the_rest_as_digits_and_letters() {
        let frame = |protocol, bytes: &'static [u8]| SeenWhat::Frame {
            protocol,
            name: "X",
            read: ReadOutcome::Used,
            reason: None,
            bytes,
        };
        let sentence = shown(frame(Protocol::Nmea, b"$HETHS,316.70,E*1A"));
        assert_eq!(sentence, "01:02:03.500000 gnss nmea X  $HETHS,316.70,E*1A\n");
        let binary = shown(frame(Protocol::Ubx, b"\xB5bA\0"));
        assert!(binary.contains("ubx X (4 bytes)\n    B5 62 41 00 "), "{binary}");
        assert!(binary.ends_with("  .bA.\n"), "{binary}");
    }

    #[test]
    fn a_long_frame_is_cut() {
        let text = shown(SeenWhat::Stray { count: 5000, bytes: &[0; 5000] });
        assert!(text.ends_with("...\n") && text.lines().count() == MOST / ROW + 2);
        let few = shown(SeenWhat::Stray { count: 5, bytes: &[0; 100] });
        assert_eq!(few.lines().count(), 1);
    }
}
