//! A text with placeholders, and the values that another text has in their places.

/// A part of a text: itself, or the name of what stands there.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Part {
    Plain(String),
    Place(String),
}

/// The parts of a text.
pub(crate) fn parts(text: &str) -> Vec<Part> {
    let mut parts = Vec::new();
    let mut rest = text;
    while let Some((before, name, after)) = next_place(rest) {
        if !before.is_empty() {
            parts.push(Part::Plain(before.to_owned()));
        }
        parts.push(Part::Place(name.to_owned()));
        rest = after;
    }
    if !rest.is_empty() {
        parts.push(Part::Plain(rest.to_owned()));
    }
    parts
}

/// What stands before the first placeholder, its name, and what comes behind it.
fn next_place(text: &str) -> Option<(&str, &str, &str)> {
    let (before, rest) = text.split_once('{')?;
    let (name, after) = rest.split_once('}')?;
    Some((before, name, after))
}

/// An English text, ready to be found again.
#[derive(Clone, Debug)]
pub(crate) struct Pattern {
    pub(crate) key: String,
    parts: Vec<Part>,
    /// Characters that stand in it as they are: the more, the surer it is the right one.
    pub(crate) plain: usize,
}

impl Pattern {
    pub(crate) fn new(key: &str, text: &str) -> Self {
        let parts = parts(text);
        let length =
            |part: &Part| if let Part::Plain(text) = part { text.chars().count() } else { 0 };
        let plain = parts.iter().map(length).sum();
        Pattern { key: key.to_owned(), parts, plain }
    }

    /// The values in the places of a text, if it is this one. What stands in a place is what `taken` makes of it, by the name of
    /// the place; where that is nothing, the text is another one.
    pub(crate) fn values(
        &self,
        text: &str,
        taken: &dyn Fn(&str, &str) -> Option<String>,
    ) -> Option<Vec<(String, String)>> {
        let mut values = Vec::new();
        fits(&self.parts, text, taken, &mut values).then_some(values)
    }
}

fn fits(
    parts: &[Part],
    text: &str,
    taken: &dyn Fn(&str, &str) -> Option<String>,
    values: &mut Vec<(String, String)>,
) -> bool {
    match parts {
        [] => text.is_empty(),
        [Part::Plain(plain), rest @ ..] => {
            text.strip_prefix(plain.as_str()).is_some_and(|text| fits(rest, text, taken, values))
        }
        [Part::Place(name), rest @ ..] => ends(rest, text).into_iter().any(|end| {
            let (own, after) = text.split_at(end);
            let Some(value) = taken(name, own) else { return false };
            values.push((name.clone(), value));
            let is_whole = fits(rest, after, taken, values);
            if !is_whole {
                values.pop();
            }
            is_whole
        }),
    }
}

/// Where what stands in a place may end, given what follows; it is never empty.
fn ends(rest: &[Part], text: &str) -> Vec<usize> {
    match rest.first() {
        Some(Part::Plain(plain)) => {
            text.match_indices(plain.as_str()).map(|(at, _)| at).filter(|at| *at > 0).collect()
        }
        _ if text.is_empty() => Vec::new(),
        _ => vec![text.len()],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn any(_: &str, value: &str) -> Option<String> {
        Some(value.to_owned())
    }

    #[test]
    fn the_values_of_a_text_are_found_again() {
        let pattern = Pattern::new("k", "{sensor}: silent for {time} s");
        let values = pattern.values("a: b: silent for 3.0 s", &any).unwrap();
        assert_eq!(values[0], ("sensor".to_owned(), "a: b".to_owned()));
        assert_eq!(values[1], ("time".to_owned(), "3.0".to_owned()));
        for other in ["", ": silent for 3 s", "gnss: silent for 3 m", "gnss: silent for  s."] {
            assert_eq!(pattern.values(other, &any), None, "{other}");
        }
    }

    #[test]
    fn a_value_that_is_refused_makes_it_another_text() {
        let pattern = Pattern::new("k", "{what}: {why}");
        let taken =
            |name: &str, value: &str| (name != "why" || value == "good").then(|| value.to_owned());
        assert_eq!(pattern.values("a: b: good", &taken).unwrap()[0].1, "a: b");
        assert_eq!(pattern.values("a: bad", &taken), None);
    }
}
