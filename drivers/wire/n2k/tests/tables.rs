//! The tables of the groups: no field is at a wrong bit, and `docs/n2k.md` shows them as they are.

use std::fmt::Write;
use std::fs;
use std::path::Path;

use insd_n2k::pgn::Known;

/// The heading above the tables of the page.
const HEADING: &str = "## Bit by bit\n";

#[test]
fn each_field_begins_where_the_one_before_ends_and_all_fill_whole_bytes() {
    for (title, rows) in Known::tables() {
        let mut end = 0;
        for row in rows {
            assert_eq!(row.at, end, "{title} {}", row.field);
            end += row.bits + row.reserved;
        }
        assert_eq!(end % 8, 0, "{title}");
    }
}

#[test]
fn the_page_shows_the_fields_of_each_group() {
    let mut tables = String::new();
    for (title, rows) in Known::tables() {
        let _ = write!(tables, "\n### {title}\n\n| bit | field | form | |\n|---:|---|---|---|\n");
        for row in rows {
            let _ =
                writeln!(tables, "| {} | `{}` | {} | {} |", row.at, row.field, row.form, row.about);
        }
    }
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../docs/n2k.md");
    let page = fs::read_to_string(path).unwrap();
    let shown = page.split_once(HEADING).map_or("", |(_, shown)| shown);
    let shown = shown.find("\n### ").map_or("", |start| &shown[start..]);
    assert_eq!(shown, tables, "what stands below the heading and its words must be\n{tables}");
}
