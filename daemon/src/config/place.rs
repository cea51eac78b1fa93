//! Where in a text a fault is.

/// The fault, which begins with its section (`[ship]`, `[[sensor]] "gnss"`) and mostly its key, with the
/// number of the line in front; as it is where the text does not show it.
pub(super) fn with_line(text: &str, fault: &str) -> String {
    match line(text, fault) {
        Some(number) => format!("line {number}: {fault}"),
        None => fault.to_owned(),
    }
}

fn line(text: &str, fault: &str) -> Option<usize> {
    let (header, rest) = fault.split_at(fault.find(": ")?);
    let (header, name) = match header.split_once(" \"") {
        Some((header, name)) => (header, name.strip_suffix('"')),
        None => (header, None),
    };
    let key = rest.strip_prefix(": ")?.split([':', ',']).next()?;
    let sections = sections(text);
    let own = |section: &&Vec<(usize, &str)>| {
        let is_header = section.first().is_some_and(|(_, first)| *first == header);
        is_header && name.is_none_or(|name| section.iter().any(|(_, line)| is_named(line, name)))
    };
    let section = sections.iter().find(own)?;
    let holds = |line: &&(usize, &str)| key_of(line.1) == Some(key);
    section.iter().find(holds).or(section.first()).map(|(number, _)| *number)
}

/// Lines with their numbers, cut before each header.
fn sections(text: &str) -> Vec<Vec<(usize, &str)>> {
    let mut sections = vec![Vec::new()];
    for (number, line) in (1..).zip(text.lines()) {
        let line = line.split('#').next().unwrap_or_default().trim();
        if line.starts_with('[') {
            sections.push(Vec::new());
        }
        sections.last_mut().into_iter().for_each(|section| section.push((number, line)));
    }
    sections
}

fn key_of(line: &str) -> Option<&str> {
    line.split_once('=').map(|(key, _)| key.trim())
}

fn is_named(line: &str, name: &str) -> bool {
    let value = line.split_once('=').map(|(_, value)| value.trim().trim_matches('"'));
    matches!(key_of(line), Some("name" | "port")) && value == Some(name)
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "# a ship\n[ship]\nlat_deg = 100 # north\n\n[[port]]\nname = \"a\"\n\
        baud = 1\n[[port]]\nname = \"b\"\nbaud = 2\n";

    #[test]
    fn a_fault_is_given_the_line_of_its_key_or_of_its_section() {
        for (fault, line) in [
            ("[ship]: lat_deg: expected -90 to 90", "line 3: "),
            ("[ship]: lat_deg, lon_deg: expected both", "line 3: "),
            ("[ship]: rate_hz: expected more", "line 2: "),
            ("[[port]] \"b\": baud: expected more", "line 10: "),
            ("[[port]] \"c\": baud: expected more", ""),
            ("something else", ""),
        ] {
            assert_eq!(with_line(TEXT, fault), format!("{line}{fault}"));
        }
    }
}
