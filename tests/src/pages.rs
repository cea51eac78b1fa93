//! Pages of the documentation that programs fill in.

use std::io;

/// Puts a table into a page, by its path, between the marks of that name; without a page it is printed.
///
/// # Errors
/// The page cannot be read or written, or has no such marks.
pub fn put(page: Option<String>, name: &str, table: &str) -> io::Result<()> {
    let Some(page) = page else { return insd_lab::terminal::print(table) };
    let text = std::fs::read_to_string(&page)?;
    std::fs::write(&page, filled(&text, name, table).map_err(io::Error::other)?)
}

/// The page with a table put between its marks, `<!-- table NAME -->` and `<!-- end of table -->`.
///
/// # Errors
/// The page has no such marks.
pub fn filled(text: &str, name: &str, table: &str) -> Result<String, String> {
    let (begin, end) = (format!("<!-- table {name} -->\n"), "<!-- end of table -->");
    let missing = || format!("the page has no table {name}");
    let (before, rest) = text.split_once(&begin).ok_or_else(missing)?;
    let (_, after) = rest.split_once(end).ok_or_else(missing)?;
    Ok(format!("{before}{begin}{table}{end}{after}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_table_is_put_between_its_marks_and_nowhere_else() {
        let page = "a\n<!-- table one -->\nold\n<!-- end of table -->\nb\n";
        let expected = "a\n<!-- table one -->\nnew\n<!-- end of table -->\nb\n";
        assert_eq!(filled(page, "one", "new\n").as_deref(), Ok(expected));
        assert!(filled(page, "two", "new\n").is_err());
    }
}
