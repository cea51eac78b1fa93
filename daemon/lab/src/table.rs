//! Plain text tables with aligned columns.

use std::fmt;

/// On which side of its column a text stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Align {
    /// Words.
    Left,
    /// Numbers.
    Right,
}

/// Rows of text under headings, each column as wide as its widest cell.
#[derive(Clone, Debug)]
pub struct Table {
    columns: Vec<(String, Align)>,
    rows: Vec<Vec<String>>,
}

impl Table {
    /// A table with these headings.
    #[must_use]
    pub fn new(columns: &[(&str, Align)]) -> Self {
        let columns = columns.iter().map(|(name, align)| ((*name).to_owned(), *align)).collect();
        Table { columns, rows: Vec::new() }
    }

    /// Adds a row; missing cells stay empty.
    pub fn push(&mut self, row: Vec<String>) {
        self.rows.push(row);
    }

    fn width(&self, column: usize) -> usize {
        let cells = self.rows.iter().filter_map(|row| row.get(column));
        let widest = cells.map(|cell| cell.chars().count()).max().unwrap_or(0);
        widest.max(self.columns[column].0.chars().count())
    }

    fn line(&self, widths: &[usize], cells: &[String]) -> String {
        let mut line = String::new();
        for (column, width) in widths.iter().enumerate() {
            let cell = cells.get(column).map_or("", String::as_str);
            if column > 0 {
                line.push_str("  ");
            }
            match self.columns[column].1 {
                Align::Left => line.push_str(&format!("{cell:<width$}")),
                Align::Right => line.push_str(&format!("{cell:>width$}")),
            }
        }
        line.trim_end().to_owned()
    }
}

impl fmt::Display for Table {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let widths: Vec<usize> = (0..self.columns.len()).map(|column| self.width(column)).collect();
        let headings: Vec<String> = self.columns.iter().map(|(name, _)| name.clone()).collect();
        writeln!(f, "{}", self.line(&widths, &headings))?;
        for row in &self.rows {
            writeln!(f, "{}", self.line(&widths, row))?;
        }
        Ok(())
    }
}

/// A number with so many significant digits and no exponent; `-` for NaN and infinity.
#[must_use]
pub fn significant(value: f64, digits: usize) -> String {
    if !value.is_finite() {
        return "-".to_owned();
    }
    if value == 0.0 {
        return "0".to_owned();
    }
    let magnitude = value.abs().log10().floor() as i64;
    let places = (digits as i64 - 1 - magnitude).clamp(0, 9) as usize;
    format!("{value:.places$}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_keep_their_significant_digits() {
        assert_eq!(significant(1234.56, 4), "1235");
        assert_eq!(significant(0.012_345, 4), "0.01235");
        assert_eq!(significant(-1.5, 3), "-1.50");
        assert_eq!(significant(f64::NAN, 3), "-");
    }

    #[test]
    fn columns_line_up() {
        let mut table = Table::new(&[("what", Align::Left), ("m", Align::Right)]);
        table.push(vec!["north".into(), "1.25".into()]);
        table.push(vec!["σ".into(), "10.00".into()]);
        assert_eq!(table.to_string(), "what       m\nnorth   1.25\nσ      10.00\n");
    }
}
