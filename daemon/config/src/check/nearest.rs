//! What a word was probably meant to be.

/// The known word that a mistyped one is nearest to, if it is near.
#[must_use]
pub fn nearest<'a>(word: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let plain = |word: &str| word.to_lowercase().replace('-', "_");
    let word = plain(word);
    let far = word.chars().count().div_ceil(3).max(1);
    let steps = |known: &str| strsim::damerau_levenshtein(&word, &plain(known));
    let begun = |known: &str| {
        let known = plain(known);
        word.len() >= 3 && (known.starts_with(&word) || word.starts_with(&known))
    };
    known
        .into_iter()
        .map(|known| (if begun(known) { 1 } else { steps(known) }, known))
        .filter(|(steps, _)| *steps <= far)
        .min_by_key(|(steps, _)| *steps)
        .map(|(_, known)| known)
}

/// The nearest of some words as a question, or all of them if none is near.
#[must_use]
pub(super) fn advice(word: &str, known: &[&str]) -> Option<String> {
    if let Some(near) = nearest(word, known.iter().copied()) {
        return Some(format!("did you mean `{near}`?"));
    }
    (!known.is_empty()).then(|| format!("there are: {}", known.join(", ")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_slip_of_the_finger_is_known_and_another_word_is_not() {
        let keys = ["name", "rate_hz", "patience_s", "heading_std_deg", "kind"];
        for (word, meant) in [
            ("rate_herz", Some("rate_hz")),
            ("rate", Some("rate_hz")),
            ("patiense_s", Some("patience_s")),
            ("Heading-std-deg", Some("heading_std_deg")),
            ("weather", None),
            ("colour", None),
        ] {
            assert_eq!(nearest(word, keys), meant, "{word}");
        }
    }
}
