//! Text and tables as HTML. Whatever comes from outside goes through [`escape`].

use std::fmt::Write as _;

/// What is said of what is not known.
pub(crate) const UNKNOWN: &str = "not known";

/// Text that no browser takes for anything else, in an element and in a quoted attribute. Characters that
/// cannot be printed are shown as a replacement.
pub(crate) fn escape(text: &str) -> String {
    let mut safe = String::with_capacity(text.len());
    for character in text.chars() {
        match character {
            '&' => safe.push_str("&amp;"),
            '<' => safe.push_str("&lt;"),
            '>' => safe.push_str("&gt;"),
            '"' => safe.push_str("&quot;"),
            '\'' => safe.push_str("&#39;"),
            '\n' | '\t' => safe.push(character),
            '\r' => {}
            own if own.is_control() || is_turning(own) => safe.push('\u{FFFD}'),
            own => safe.push(own),
        }
    }
    safe
}

/// Characters that change the direction of what follows, so that it reads as something else.
fn is_turning(character: char) -> bool {
    matches!(character, '\u{202A}'..='\u{202E}' | '\u{2066}'..='\u{2069}' | '\u{200E}' | '\u{200F}')
}

/// A number with so many decimals, or that it is not known.
pub(crate) fn number(value: Option<f64>, decimals: usize) -> String {
    let value = value.filter(|value| value.is_finite());
    // no minus before a zero
    let text = value.map(|value| format!("{value:.decimals$}")).map(|text| {
        let is_zero = text.chars().all(|own| matches!(own, '-' | '0' | '.'));
        if is_zero { text.replace('-', "") } else { text.replace('-', "−") }
    });
    text.unwrap_or_else(|| UNKNOWN.to_owned())
}

/// A number with its unit, or that it is not known.
pub(crate) fn quantity(value: Option<f64>, decimals: usize, unit: &str) -> String {
    match value.filter(|value| value.is_finite()) {
        Some(_) => format!("{} {unit}", number(value, decimals)),
        None => UNKNOWN.to_owned(),
    }
}

/// Something in words, or that it is not known.
pub(crate) fn known(words: Option<impl Into<String>>) -> String {
    words.map_or_else(|| UNKNOWN.to_owned(), Into::into)
}

/// A count with thin spaces between its thousands.
pub(crate) fn count(value: u64) -> String {
    let digits = value.to_string();
    let mut text = String::new();
    for (index, digit) in digits.chars().enumerate() {
        if index > 0 && (digits.len() - index).is_multiple_of(3) {
            text.push('\u{202F}');
        }
        text.push(digit);
    }
    text
}

/// How a column is set.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Column {
    /// Words.
    Text(&'static str),
    /// Numbers, to the right.
    Number(&'static str),
}

/// A table; each cell is text and is escaped.
#[derive(Clone, Debug)]
pub(crate) struct Table {
    columns: Vec<Column>,
    rows: Vec<Vec<String>>,
}

impl Table {
    /// A table without rows.
    pub(crate) fn new(columns: &[Column]) -> Self {
        Table { columns: columns.to_vec(), rows: Vec::new() }
    }

    /// Adds a row.
    pub(crate) fn row<const N: usize>(&mut self, cells: [String; N]) {
        self.rows.push(cells.into());
    }

    /// The table, or in words that there is nothing to show.
    pub(crate) fn or(&self, nothing: &str) -> String {
        if self.rows.is_empty() {
            return format!("<p class=\"unknown\">{}</p>\n", escape(nothing));
        }
        let mut html = "<table><thead><tr>".to_owned();
        for column in &self.columns {
            let (name, class) = match column {
                Column::Text(name) => (name, ""),
                Column::Number(name) => (name, " class=\"n\""),
            };
            let _ = write!(html, "<th{class}>{}</th>", escape(name));
        }
        html.push_str("</tr></thead><tbody>\n");
        for row in &self.rows {
            self.draw_row(&mut html, row);
        }
        html.push_str("</tbody></table>\n");
        html
    }

    fn draw_row(&self, html: &mut String, row: &[String]) {
        html.push_str("<tr>");
        for (column, cell) in self.columns.iter().zip(row) {
            let is_number = matches!(column, Column::Number(_));
            let class = match (is_number, cell == UNKNOWN) {
                (true, false) => " class=\"n\"",
                (true, true) => " class=\"n unknown\"",
                (false, true) => " class=\"unknown\"",
                (false, false) => "",
            };
            let _ = write!(html, "<td{class}>{}</td>", escape(cell));
        }
        html.push_str("</tr>\n");
    }
}

/// A section with its heading; the content is HTML.
pub(crate) fn section(id: &str, title: &str, content: &str) -> String {
    format!("<section id=\"{id}\"><h2>{}</h2>\n{content}</section>\n", escape(title))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_from_outside_becomes_markup() {
        let evil = "<script>alert('x')</script>\" onload=\"&amp;\u{202E}\u{0}";
        let safe = escape(evil);
        assert!(!safe.contains(['<', '>', '"', '\'', '\u{202E}', '\u{0}']), "{safe}");
        assert!(safe.starts_with("&lt;script&gt;alert(&#39;x&#39;)"), "{safe}");
        let mut table = Table::new(&[Column::Text("a<b")]);
        table.row([evil.to_owned()]);
        assert!(!table.or("").contains("<script"));
        assert!(table.or("").contains("a&lt;b"));
    }

    #[test]
    fn what_is_not_known_is_never_a_number() {
        assert_eq!((number(None, 1), number(Some(f64::NAN), 1)), (UNKNOWN.into(), UNKNOWN.into()));
        assert_eq!(quantity(Some(f64::INFINITY), 1, "m"), UNKNOWN);
        assert_eq!((number(Some(-0.01), 1), number(Some(-1.26), 1)), ("0.0".into(), "−1.3".into()));
        assert_eq!(Table::new(&[]).or("none & none"), "<p class=\"unknown\">none &amp; none</p>\n");
    }

    #[test]
    fn thousands_are_set_apart() {
        assert_eq!((count(0), count(999)), ("0".into(), "999".into()));
        assert_eq!(count(1_234_567), "1\u{202F}234\u{202F}567");
    }
}
