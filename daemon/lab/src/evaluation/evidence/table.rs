//! The evidence for people.

use std::fmt;

use super::{Evidence, Exclusion, PIECE, SUM, Share, Use};
use crate::table::{Align, Table, significant};

/// The sources that are told one by one.
const SOURCES: usize = 20;

impl fmt::Display for Evidence {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.use_table())?;
        writeln!(f, "{}", self.told())?;
        match self.excluded.as_deref() {
            None => writeln!(f, "who was left out is not in the file")?,
            Some([]) => writeln!(f, "nobody was left out")?,
            Some(all) => write!(f, "\n{}\n", exclusion_table(all))?,
        }
        if !self.has_levels {
            writeln!(f, "levels are not in the file: five horizontal sigmas are taken for them")?;
        }
        if let Some(worst) = &self.worst_horizontal {
            let (ratio, at) = (significant(worst.ratio, 3), seconds(worst.at_s));
            write!(f, "largest error over level: {ratio} horizontally at {at} s")?;
            if let Some(worst) = &self.worst_vertical {
                let (ratio, at) = (significant(worst.ratio, 3), seconds(worst.at_s));
                write!(f, ", {ratio} vertically at {at} s")?;
            }
            writeln!(f)?;
        }
        self.verdict(f)
    }
}

impl Evidence {
    fn use_table(&self) -> Table {
        let numbers = ["usable %", "misleading s", "longest piece s", "first s"];
        let mut columns = vec![("evidence", Align::Left)];
        columns.extend(numbers.map(|name| (name, Align::Right)));
        let mut table = Table::new(&columns);
        for own in self.position.iter().chain([&self.heading]) {
            let known = |value: Option<f64>| value.map_or("-".to_owned(), seconds);
            table.push(vec![
                name(own),
                percent(own.usable_share),
                known(own.misleading_s),
                known(own.longest_s),
                known(own.first_s),
            ]);
        }
        table
    }

    fn told(&self) -> String {
        let Some(states) = &self.integrity else {
            return "integrity is not in the file: nothing speaks against a row".to_owned();
        };
        let one = |(state, share): (&&str, &Share)| {
            format!("{state} {} % ({} s)", percent(share.share), seconds(share.total_s))
        };
        let all: Vec<String> = states.iter().map(one).collect();
        let all = if all.is_empty() { "not told".to_owned() } else { all.join(", ") };
        format!("integrity: {all}")
    }

    fn verdict(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (piece, sum) = (seconds(PIECE), seconds(SUM));
        if !self.hazardous {
            return writeln!(
                f,
                "not hazardous: never misleading for more than {piece} s in a piece or {sum} s in all"
            );
        }
        let all = self.position.iter().chain([&self.heading]);
        let names: Vec<String> = all.filter(|own| own.hazardous).map(name).collect();
        writeln!(
            f,
            "HAZARDOUS ({}): misleading for more than {piece} s in a piece or {sum} s in all",
            names.join(", ")
        )
    }
}

fn exclusion_table(all: &[Exclusion]) -> Table {
    let numbers = ["first s", "last s", "total s", "pieces"];
    let mut columns = vec![("left out", Align::Left)];
    columns.extend(numbers.map(|name| (name, Align::Right)));
    let mut table = Table::new(&columns);
    for own in all.iter().take(SOURCES) {
        table.push(vec![
            own.source.clone(),
            seconds(own.first_s),
            seconds(own.last_s),
            seconds(own.total_s),
            own.pieces.to_string(),
        ]);
    }
    if all.len() > SOURCES {
        table.push(vec![format!("and {} more", all.len() - SOURCES)]);
    }
    table
}

fn name(own: &Use) -> String {
    own.limit_m.map_or("heading".to_owned(), |limit| format!("position at {limit} m"))
}

/// A tenth of a second, unless it is a whole one.
fn seconds(value: f64) -> String {
    let text = format!("{value:.1}");
    text.strip_suffix(".0").map_or(text.clone(), str::to_owned)
}

fn percent(share: f64) -> String {
    if share.is_finite() { format!("{:.1}", 100.0 * share) } else { "-".to_owned() }
}
