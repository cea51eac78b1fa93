//! Prints one JSON line for each frame in the files of a folder, for other programs to compare:
//! `frames FOLDER`. Each file is cut with all protocols mixed and with each one alone. Values are in
//! SI units and radians under the names that the makers' documents give the fields.

mod novatel;
mod owners;
mod sbf;
mod ubx;

use std::fs;
use std::io::{self, Write as _};
use std::path::{Path, PathBuf};

use insd_wire::gnss::rtcm;
use insd_wire::stream::{Cut, Cutter, Protocol};
use serde_json::{Value, json};

fn main() -> io::Result<()> {
    let folder = std::env::args().nth(1).ok_or_else(|| io::Error::other("usage: frames FOLDER"))?;
    let mut files: Vec<PathBuf> = fs::read_dir(folder)?
        .map(|entry| entry.map(|entry| entry.path()))
        .collect::<Result<_, _>>()?;
    files.sort();
    for file in files.iter().filter(|file| file.is_file()) {
        cut(file)?;
    }
    Ok(())
}

/// Cuts one file in every way.
fn cut(file: &Path) -> io::Result<()> {
    let bytes = fs::read(file)?;
    let name = file.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
    print(&name, "mixed", &Protocol::ALL, &bytes)?;
    for protocol in Protocol::ALL {
        print(&name, "alone", &[protocol], &bytes)?;
    }
    Ok(())
}

/// Prints the frames of some protocols.
fn print(file: &str, way: &str, protocols: &[Protocol], bytes: &[u8]) -> io::Result<()> {
    let mut out = io::stdout().lock();
    let mut cutter = Cutter::new(protocols);
    for chunk in bytes.chunks(100) {
        cutter.push(chunk);
        while let Some(cut) = cutter.cut() {
            writeln!(out, "{}", line(file, way, &cut))?;
        }
    }
    while cutter.is_waiting() {
        cutter.give_up();
        while let Some(cut) = cutter.cut() {
            writeln!(out, "{}", line(file, way, &cut))?;
        }
    }
    Ok(())
}

fn line(file: &str, way: &str, cut: &Cut<'_>) -> Value {
    let (name, fields) = match cut.protocol {
        Protocol::Ubx => ubx::describe(cut.bytes),
        Protocol::Sbf => sbf::describe(cut.bytes),
        Protocol::Novatel => novatel::describe(cut.bytes),
        Protocol::Gsof => owners::gsof(cut.bytes),
        Protocol::VectorNav => owners::vectornav(cut.bytes),
        Protocol::Ad2cp => owners::ad2cp(cut.bytes),
        Protocol::Rtcm => {
            let number = rtcm::Frame::open(cut.bytes).ok().and_then(|frame| frame.number());
            (number.map_or_else(|| "filler".to_owned(), |number| number.to_string()), Value::Null)
        }
        _ => (String::from_utf8_lossy(cut.bytes).into_owned(), Value::Null),
    };
    let start = cut.end - cut.bytes.len() as u64;
    json!({
        "file": file, "way": way, "protocol": cut.protocol.name(), "start": start,
        "length": cut.bytes.len(), "name": name, "fields": fields,
    })
}
