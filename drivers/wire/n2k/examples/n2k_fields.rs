//! Prints what this crate reads in whole messages, one JSON object on a line, for the comparison with
//! other decoders in `tests/conformance/n2k.py`.
//!
//! Messages come on standard input as canboat writes them: time, priority, group, source,
//! destination, length, bytes in hexadecimal, all with commas between. Every line that is a message has
//! its line in the output, in the same order: the group, and the fields, or the fault, or neither if the
//! group is not one of ours.

#[path = "fields/mod.rs"]
mod fields;

use std::error::Error;
use std::io::{BufRead, BufWriter, Write};

use insd_n2k::pgn::Known;
use serde_json::json;

fn main() -> Result<(), Box<dyn Error>> {
    let mut out = BufWriter::new(std::io::stdout().lock());
    for line in std::io::stdin().lock().lines() {
        let line = line?;
        let Some((pgn, data)) = message(&line) else { continue };
        let object = match Known::read(pgn, &data) {
            Some(Ok(known)) => json!({ "pgn": pgn, "fields": fields::fields(&known) }),
            Some(Err(fault)) => json!({ "pgn": pgn, "fault": fault.to_string() }),
            None => json!({ "pgn": pgn }),
        };
        writeln!(out, "{object}")?;
    }
    Ok(())
}

/// Group and contents of a line.
fn message(line: &str) -> Option<(u32, Vec<u8>)> {
    let mut parts = line.trim().split(',').skip(2);
    let pgn = parts.next()?.parse().ok()?;
    let bytes = parts.skip(3).map(|byte| u8::from_str_radix(byte, 16));
    Some((pgn, bytes.collect::<Result<_, _>>().ok()?))
}
