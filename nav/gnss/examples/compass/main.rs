//! Antennas against each other: real pairs, a made-up square of four and a made-up berthing: the tables of docs/compass.md.
//!
//! ```text
//! INSD_RAW_GNSS=... INSD_VOYAGES=... cargo run --release -p insd-gnss --example compass [-- docs/compass.md]
//! ```

#![allow(clippy::unwrap_used)] // a file that is missing ends it

#[path = "../../tests/array/mod.rs"]
mod array;
#[path = "../../src/tests/random.rs"]
mod random;
#[path = "../../tests/sets/mod.rs"]
mod sets;

mod real;
mod square;

fn main() {
    let page = std::env::args().nth(1);
    put(page.as_deref(), "real", &real::table());
    let w = std::env::var("WHAT").unwrap_or_default();
    if w.is_empty() || w.contains('e') {
        put(page.as_deref(), "errors", &square::errors_table());
    }
    if w.is_empty() || w.contains('c') {
        put(page.as_deref(), "cold", &square::cold_table());
    }
    if w.is_empty() || w.contains('f') {
        put(page.as_deref(), "faults", &square::faults_table());
    }
}

/// Puts a table between its marks of a page; without a page it is printed.
fn put(page: Option<&str>, name: &str, table: &str) {
    let Some(page) = page else { return print!("{table}") };
    let text = std::fs::read_to_string(page).unwrap();
    let (begin, end) = (format!("<!-- table {name} -->\n"), "<!-- end of table -->");
    let (before, rest) = text.split_once(&begin).unwrap();
    let (_, after) = rest.split_once(end).unwrap();
    std::fs::write(page, format!("{before}{begin}{table}{end}{after}")).unwrap();
}
