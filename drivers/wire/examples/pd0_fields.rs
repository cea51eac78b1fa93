//! Prints what this crate reads in each ensemble of PD0 in the files of a folder, one JSON object on a
//! line, in SI units and as it is on the wire; then how much of each file was read. For the comparison with
//! dolfyn in `tests/conformance/pd0.py`.

use std::error::Error;
use std::fs;
use std::path::PathBuf;

use insd_wire::log::pd0::Ensemble;
use insd_wire::stream::{Cutter, Protocol};
use serde_json::json;

fn main() -> Result<(), Box<dyn Error>> {
    let folder = std::env::args().nth(1).ok_or("which folder?")?;
    let entries = fs::read_dir(folder)?.map(|entry| entry.map(|entry| entry.path()));
    let mut paths: Vec<PathBuf> = entries.collect::<Result<_, _>>()?;
    paths.sort();
    for path in paths {
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let mut cutter = Cutter::new(&[Protocol::Pd0]);
        cutter.push(&fs::read(&path)?);
        let (mut read, mut refused) = (0, 0);
        while let Some(cut) = cutter.cut() {
            let Ok(Ensemble { fixed, variable, bottom }) = Ensemble::read(cut.bytes) else {
                refused += 1;
                continue;
            };
            read += 1;
            let bottom = bottom.map(|own| json!({ "velocity": own.velocity, "range": own.range }));
            let frame = format!("{:?}", fixed.transformation.coordinates);
            let clock = variable.clock.map(|clock| clock.as_nanos() as f64 * 1e-9);
            println!(
                "{}",
                json!({
                    "file": name, "number": variable.number, "clock": clock, "frame": frame,
                    "heading": variable.heading.to_degrees(), "pitch": variable.pitch.to_degrees(),
                    "roll": variable.roll.to_degrees(), "temperature": variable.temperature,
                    "alignment": fixed.heading_alignment.to_degrees(), "bottom": bottom,
                })
            );
        }
        let damaged = cutter.damaged();
        println!(
            "{}",
            json!({ "file": name, "read": read, "refused": refused, "damaged": damaged })
        );
    }
    Ok(())
}
