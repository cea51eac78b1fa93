//! Draws the pictures and fills in the tables of `docs/alignment.md`: the same bytes every time.
//!
//! ```text
//! cargo run --release -p insd-tests --example alignment_page -- docs
//! ```

mod campaigns;
mod spectra;
mod svg;

use std::error::Error;
use std::path::PathBuf;

use insd_simulator::simulate;
use insd_tests::pages::filled;
use insd_tests::scenario;

use campaigns::{Comparison, INSTANTS};

/// Voyage of the pictures.
const SEED: u64 = 1;
/// Colours of the methods at the berth and under way.
const MOORED: [&str; 4] = ["orange", "blue", "purple", "green"];
const IN_MOTION: [&str; 2] = ["blue", "green"];

const HEAD: &str = "| voyage | method | 300 s | 600 s | 900 s | 1800 s | NEES | error below bar, \
    middle voyage, s | 9 of 10, s | claim below bar, all, s |\n\
    |---|---|---|---|---|---|---|---|---|---|\n";

fn main() -> Result<(), Box<dyn Error>> {
    let docs = PathBuf::from(std::env::args().nth(1).unwrap_or_else(|| "docs".to_owned()));
    let pictures = docs.join("alignment");
    std::fs::create_dir_all(&pictures)?;
    let (above, below) = spectra::panels(&simulate(&scenario(7), SEED));
    let rows = [
        ("What is measured, and what each method takes it for".to_owned(), above),
        (
            "What is left once the method has had its say: white if the model holds".to_owned(),
            below,
        ),
    ];
    std::fs::write(pictures.join("spectra.svg"), svg::picture("Spectra of the sea", &rows))?;

    let calm = campaigns::moored("calm", scenario(17));
    let slight = campaigns::moored("sea state 3", scenario(7));
    let rough = campaigns::moored("sea state 5", scenario(8));
    let tactical = campaigns::moored("tactical", scenario(9));
    let at_berth = [&calm, &slight, &rough, &tactical];
    draw_errors(&pictures, &slight, &rough)?;
    let rms = |comparison: &&Comparison| comparison.rms_panel(&MOORED, (0.03, 100.0));
    let rows = [
        ("RMS of 24 voyages beside the limit".to_owned(), at_berth[..2].iter().map(rms).collect()),
        (String::new(), at_berth[2..].iter().map(rms).collect()),
    ];
    std::fs::write(
        pictures.join("rms.svg"),
        svg::picture("RMS heading error at the berth", &rows),
    )?;

    let restart = campaigns::in_motion("restart under way", scenario(10));
    let panels = vec![restart.rms_panel(&IN_MOTION, (0.01, 2.0))];
    let rows = [("RMS of 24 voyages under way".to_owned(), panels)];
    std::fs::write(
        pictures.join("in_motion.svg"),
        svg::picture("RMS heading error under way", &rows),
    )?;

    let page = docs.join("alignment.md");
    let table = |of: &[&Comparison]| {
        of.iter().fold(HEAD.to_owned(), |table, comparison| table + &comparison.rows(&INSTANTS))
    };
    let text = std::fs::read_to_string(&page)?;
    let text = filled(&text, "berth", &table(&at_berth))?;
    let text = filled(&text, "under-way", &table(&[&restart]))?;
    std::fs::write(&page, text)?;
    Ok(())
}

/// One voyage in each of two seas.
fn draw_errors(
    pictures: &std::path::Path,
    slight: &Comparison,
    rough: &Comparison,
) -> Result<(), Box<dyn Error>> {
    let row = |comparison: &Comparison| {
        let headline = format!("{}, seed {SEED}", comparison.label);
        (headline, comparison.voyage(SEED as usize - 1, &MOORED))
    };
    let picture = svg::picture("Heading errors of two voyages", &[row(slight), row(rough)]);
    std::fs::write(pictures.join("errors.svg"), picture)?;
    Ok(())
}
