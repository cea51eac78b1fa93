//! The page in another language: what people read of it is said anew, text by text; names, numbers and the configuration stay.

use std::collections::HashMap;

use insd_languages::{Catalogue, Language};

use super::page::html::escape;

/// Elements whose texts are not for people, or are their own words.
const KEPT: [&str; 2] = ["style", "pre"];
/// A space that stands behind the caption of a chart.
const SPACE: &str = "&emsp;";
/// Attributes that are read out.
const LABEL: &str = "aria-label=\"";

/// The page in a language, from the English one.
pub(super) fn page(english: &str, language: Language) -> String {
    let mut texts = Texts { catalogue: language.catalogue(), known: HashMap::new() };
    let mut page = String::with_capacity(english.len());
    let mut kept = None;
    for piece in english.split_inclusive('>') {
        let (text, tag) = piece.split_at(piece.find('<').unwrap_or(piece.len()));
        match kept {
            None => page.push_str(&texts.said(text)),
            Some(_) => page.push_str(text),
        }
        let name = tag.trim_start_matches(['<', '/']);
        let is_of = |own: &&str| {
            name.starts_with(*own) && !name[own.len()..].starts_with(char::is_alphanumeric)
        };
        if let Some(own) = KEPT.into_iter().find(|own| is_of(own)) {
            kept = (!tag.starts_with("</")).then_some(own);
        }
        page.push_str(&texts.labelled(tag));
    }
    page.replacen("<html lang=\"en\">", &format!("<html lang=\"{language}\">"), 1)
}

struct Texts {
    catalogue: &'static Catalogue,
    known: HashMap<String, String>,
}

impl Texts {
    /// A text as HTML has it, with the space around it.
    fn said(&mut self, html: &str) -> String {
        let text = html.trim().trim_end_matches(SPACE);
        if !text.contains(|c: char| c.is_ascii_alphabetic()) {
            return html.to_owned();
        }
        if !self.known.contains_key(text) {
            let plain = unescaped(text);
            let own =
                self.catalogue.sentence(&plain).map_or_else(|| text.to_owned(), |own| escape(&own));
            self.known.insert(text.to_owned(), own);
        }
        self.known.get(text).map_or_else(|| html.to_owned(), |own| html.replacen(text, own, 1))
    }

    /// A tag with its label.
    fn labelled(&mut self, tag: &str) -> String {
        let parts =
            tag.split_once(LABEL).and_then(|(before, rest)| Some((before, rest.split_once('"')?)));
        parts.map_or_else(
            || tag.to_owned(),
            |(before, (label, after))| format!("{before}{LABEL}{}\"{after}", self.said(label)),
        )
    }
}

/// The inverse of [`escape`].
fn unescaped(html: &str) -> String {
    [("&lt;", "<"), ("&gt;", ">"), ("&quot;", "\""), ("&#39;", "'"), ("&amp;", "&")]
        .into_iter()
        .fold(html.to_owned(), |text, (from, to)| text.replace(from, to))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_people_read_is_japanese_and_names_and_the_configuration_stay() {
        let english = "<!DOCTYPE html>\n<html lang=\"en\"><style>p{color:red}</style>\
            <svg role=\"img\" aria-label=\"Modes\"><title>aligning at the berth, 12:00:01 to 12:03:04</title></svg>\
            <h2>Key figures</h2><td>Jack &amp; Jill&#39;s</td><td>not known</td>\n<pre>Key figures</pre><th>Sensor</th></html>";
        let page = page(english, Language::Japanese);
        assert_eq!(
            page,
            "<!DOCTYPE html>\n<html lang=\"ja\"><style>p{color:red}</style>\
            <svg role=\"img\" aria-label=\"航法モード\"><title>係留中アライメント、12:00:01 ～ 12:03:04</title></svg>\
            <h2>主要諸元</h2><td>Jack &amp; Jill&#39;s</td><td>不明</td>\n<pre>Key figures</pre><th>センサ</th></html>"
        );
    }

    #[test]
    fn what_comes_from_outside_stays_escaped() {
        let evil = "Nothing was sent to &lt;script&gt;alert(&#39;x&#39;)&lt;/script&gt;.";
        let said = page(&format!("<p>{evil}</p>"), Language::Japanese);
        assert!(said.contains("&lt;script&gt;") && !said.contains("<script"), "{said}");
    }
}
