//! What holds of the documents: their links lead somewhere, and the book has all pages of `docs`.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use crate::manifest::root;
use crate::none;
use crate::source::text_files;

/// A link to something in the repository.
#[derive(Debug, PartialEq)]
struct Link {
    line: usize,
    /// As written, empty for the document itself.
    path: String,
    /// Its heading, if it names one.
    heading: Option<String>,
}

fn documents() -> Vec<(String, String)> {
    text_files(&root()).into_iter().filter(|(path, _)| path.ends_with(".md")).collect()
}

/// Number and text of the lines that are not code: neither fenced nor indented.
fn prose(text: &str) -> impl Iterator<Item = (usize, &str)> {
    let mut fenced = false;
    text.lines().enumerate().filter_map(move |(index, line)| {
        let fence = line.trim_start().starts_with("```");
        fenced ^= fence;
        let code =
            fenced || fence || line.starts_with("    ") && !line.trim_start().starts_with('-');
        (!code).then_some((index + 1, line))
    })
}

fn links(text: &str) -> Vec<Link> {
    let mut found = Vec::new();
    for (line, text) in prose(text) {
        let targets = text.split("](").skip(1).filter_map(|rest| Some(rest.split_once(')')?.0));
        for target in targets.filter(|target| !target.is_empty() && !target.contains(':')) {
            let (path, heading) = match target.split_once('#') {
                Some((path, heading)) => (path, Some(heading.to_owned())),
                None => (target, None),
            };
            found.push(Link { line, path: path.to_owned(), heading });
        }
    }
    found
}

/// The names by which headings of a document are linked: lower case, without punctuation, with dashes for spaces.
fn headings(text: &str) -> BTreeSet<String> {
    let titles = prose(text).filter(|(_, line)| line.starts_with('#'));
    let name = |title: &str| {
        let kept = title.trim_start_matches('#').trim().chars();
        let kept = kept.filter(|c| c.is_alphanumeric() || [' ', '-', '_'].contains(c));
        kept.collect::<String>().to_lowercase().replace(' ', "-")
    };
    titles.map(|(_, line)| name(line)).collect()
}

/// What is wrong with a link of a document in this folder.
fn fault(folder: &Path, own: &str, link: &Link) -> Option<String> {
    let target = folder.join(&link.path);
    if !target.exists() {
        return Some(format!("{} is not there", link.path));
    }
    let heading = link.heading.as_ref()?;
    let other = (!link.path.is_empty()).then(|| fs::read_to_string(&target).unwrap());
    let known = headings(other.as_deref().unwrap_or(own)).contains(heading);
    (!known).then(|| format!("{} has no heading {heading}", link.path))
}

#[test]
fn every_link_of_a_document_leads_somewhere() {
    let mut complaints = Vec::new();
    for (path, text) in documents() {
        let file = root().join(&path);
        let folder = file.parent().unwrap();
        complaints.extend(links(&text).iter().filter_map(|link| {
            fault(folder, &text, link).map(|fault| format!("{path}:{}: {fault}", link.line))
        }));
    }
    none("a link leads nowhere", &complaints);
}

#[test]
fn the_book_has_every_page_once() {
    let summary = fs::read_to_string(root().join("docs/SUMMARY.md")).unwrap();
    let mut listed: Vec<String> = links(&summary).into_iter().map(|link| link.path).collect();
    listed.sort();
    let own = |path: &str| path.strip_prefix("docs/").map(str::to_owned);
    let pages: Vec<String> = documents()
        .iter()
        .filter_map(|(path, _)| own(path))
        .filter(|page| page != "SUMMARY.md")
        .collect();
    assert_eq!(listed, pages);
}

#[test]
fn links_and_headings_are_found_outside_code() {
    let text =
        "# A `b`, c\n[x](y.md#z) and [w](https://w.org)\n```\n[no](n.md)\n```\n    [no](n.md)\n";
    let link = Link { line: 2, path: "y.md".to_owned(), heading: Some("z".to_owned()) };
    assert_eq!(links(text), [link]);
    assert_eq!(headings(text), BTreeSet::from(["a-b-c".to_owned()]));
}
