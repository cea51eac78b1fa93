//! Antennas against each other: real pairs, a made-up square of four and a made-up berthing: the tables of docs/compass.md.
//!
//! ```text
//! INSD_RAW_GNSS=... INSD_VOYAGES=... cargo run --release -p insd-gnss --example compass [-- docs/compass.md [real]]
//! ```

#![allow(clippy::unwrap_used)] // a file that is missing ends it

#[path = "../../tests/array/mod.rs"]
mod array;
#[path = "../../src/tests/random.rs"]
mod random;
#[path = "../../tests/sets/mod.rs"]
mod sets;

mod berthing;
mod real;
mod square;

fn main() {
    let page = std::env::args().nth(1);
    let wanted = std::env::args().nth(2);
    type Table = fn() -> String;
    let tables: [(&str, Table); 5] = [
        ("real", real::table),
        ("errors", square::errors_table),
        ("cold", square::cold_table),
        ("faults", square::faults_table),
        ("berthing", berthing::table),
    ];
    for (name, table) in tables {
        if wanted.as_ref().is_none_or(|wanted| wanted == name) {
            put(page.as_deref().filter(|page| *page != "-"), name, &table());
        }
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
