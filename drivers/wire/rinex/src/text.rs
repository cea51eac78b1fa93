//! Lines and columns of a text, by bytes: RINEX is ASCII in fixed columns, and what is not must not matter.

/// The lines of a text, counted.
#[derive(Clone, Debug)]
pub(crate) struct Lines<'a> {
    rest: &'a [u8],
    number: usize,
}

impl<'a> Lines<'a> {
    pub(crate) fn new(text: &'a [u8]) -> Self {
        Self { rest: text, number: 0 }
    }

    /// Number of the line that was taken last, from 1.
    pub(crate) fn number(&self) -> usize {
        self.number
    }

    /// What has not been taken.
    pub(crate) fn rest(&self) -> &'a [u8] {
        self.rest
    }

    /// The next line without its end, which stays.
    pub(crate) fn peek(&self) -> Option<&'a [u8]> {
        self.clone().next()
    }
}

impl<'a> Iterator for Lines<'a> {
    type Item = &'a [u8];

    fn next(&mut self) -> Option<&'a [u8]> {
        if self.rest.is_empty() {
            return None;
        }
        let end = self.rest.iter().position(|byte| *byte == b'\n');
        let line = &self.rest[..end.unwrap_or(self.rest.len())];
        self.rest = &self.rest[end.map_or(self.rest.len(), |end| end + 1)..];
        self.number += 1;
        Some(line.strip_suffix(b"\r").unwrap_or(line))
    }
}

/// The columns from the first, counted from 0, up to the second, as far as the line reaches.
pub(crate) fn columns(line: &[u8], from: usize, to: usize) -> &[u8] {
    line.get(from..to.min(line.len())).unwrap_or_default()
}

/// Text of some columns without blanks around it.
pub(crate) fn words(line: &[u8], from: usize, to: usize) -> String {
    String::from_utf8_lossy(columns(line, from, to).trim_ascii()).into_owned()
}

/// The label of a line of a header, columns 61 to 80.
pub(crate) fn label(line: &[u8]) -> &[u8] {
    columns(line, 60, 80).trim_ascii()
}

/// Whether there is nothing but blanks.
pub(crate) fn is_blank(line: &[u8]) -> bool {
    line.trim_ascii().is_empty()
}

/// Writes a line of a header: contents padded to 60 columns, then the label.
pub(crate) fn push_header(out: &mut String, contents: &str, label: &str) {
    // one byte a character, or the label leaves its columns
    let plain = |c: char| if c == ' ' || c.is_ascii_graphic() { c } else { '?' };
    let contents: String = contents.chars().map(plain).take(60).collect();
    out.push_str(&format!("{contents:<60}{label}\n"));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_end_with_or_without_a_carriage_return_and_the_last_needs_none() {
        let mut lines = Lines::new(b"a\r\n\nb");
        assert_eq!(lines.peek(), Some(&b"a"[..]));
        assert_eq!(lines.by_ref().collect::<Vec<_>>(), [&b"a"[..], b"", b"b"]);
        assert_eq!(lines.number(), 3);
    }

    #[test]
    fn a_label_stays_in_its_columns_whatever_the_name() {
        let mut line = String::new();
        push_header(&mut line, "Z\u{fc}rich\n", "MARKER NAME");
        assert_eq!(label(line.as_bytes()), b"MARKER NAME");
        assert!(line.starts_with("Z?rich? "));
    }

    #[test]
    fn columns_beyond_the_end_of_a_line_are_empty() {
        assert_eq!(columns(b"abc", 1, 9), b"bc");
        assert_eq!(columns(b"abc", 5, 9), b"");
        assert_eq!(columns(b"abc", 3, 2), b"");
    }
}
