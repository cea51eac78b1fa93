//! As much of XML as OpenCV writes calibrations in: elements in elements, with text; attributes passed over.

use super::fault::Reason;
use super::node::{Node, Value};

/// Elements in elements.
const DEEPEST: usize = 16;

/// An element whose end has not come yet.
struct Open<'a> {
    name: &'a str,
    line: usize,
    entries: Vec<(String, Node)>,
    text: String,
}

impl<'a> Open<'a> {
    fn new(name: &'a str, line: usize) -> Self {
        Open { name, line, entries: Vec::new(), text: String::new() }
    }

    fn closed(self) -> Node {
        let line = self.line;
        if self.entries.is_empty() {
            return Node::text(line, self.text.trim().trim_matches('"'));
        }
        Node { line, value: Value::Map(self.entries) }
    }
}

/// Parses a file: what its root element holds.
pub(crate) fn parse(text: &str) -> Result<Node, Reason> {
    let mut open = vec![Open::new("file", 1)];
    let (mut rest, mut line) = (text, 1);
    while let Some(at) = rest.find('<') {
        let (before, tag) = (&rest[..at], &rest[at..]);
        if let Some(element) = open.last_mut() {
            element.text.push_str(before);
        }
        line += before.matches('\n').count();
        let end = if tag.starts_with("<!--") { "-->" } else { ">" };
        let wrong = || Reason::new(line, tag.lines().next().unwrap_or_default(), "is not closed");
        let length = tag.find(end).ok_or_else(wrong)? + end.len();
        tag_of(&tag[..length], line, &mut open)?;
        line += tag[..length].matches('\n').count();
        rest = &tag[length..];
    }
    let unclosed = |element: &Open<'_>| Reason::new(element.line, element.name, "is not closed");
    let root = (open.len() == 1).then(|| open.pop()).flatten();
    let root = root.ok_or_else(|| {
        open.last().map_or_else(|| Reason::new(line, "file", "is not understood"), unclosed)
    })?;
    let mut entries = root.entries.into_iter();
    entries.next().map(|(_, node)| node).ok_or_else(|| Reason::new(1, "file", "holds nothing"))
}

fn tag_of<'a>(tag: &'a str, line: usize, open: &mut Vec<Open<'a>>) -> Result<(), Reason> {
    let inner = tag[1..].trim_end_matches('>');
    if inner.starts_with(['?', '!']) {
        return Ok(());
    }
    let name = inner
        .trim_start_matches('/')
        .split([' ', '\t', '\r', '\n', '/'])
        .next()
        .unwrap_or_default();
    if !inner.starts_with('/') {
        if open.len() > DEEPEST {
            return Err(Reason::new(line, name, "is nested too deep"));
        }
        open.push(Open::new(name, line));
        if !inner.ends_with('/') {
            return Ok(());
        }
    }
    let closes = open.len() > 1 && open.last().is_some_and(|element| element.name == name);
    let (true, Some(element)) = (closes, open.pop()) else {
        return Err(Reason::new(line, name, "closes what is not open"));
    };
    if let Some(outer) = open.last_mut() {
        outer.entries.push((name.to_owned(), element.closed()));
    }
    Ok(())
}
