//! As much of YAML as calibrations are written in: entries by indentation, lists by dashes or in brackets, tags passed over.

use super::fault::Reason;
use super::node::{Node, Value};

/// Lists in lists, and entries in entries.
const DEEPEST: usize = 16;

/// A line with something on it.
#[derive(Clone, Debug)]
struct Line<'a> {
    number: usize,
    indent: usize,
    text: &'a str,
}

/// Parses a file.
pub(crate) fn parse(text: &str) -> Result<Node, Reason> {
    let lines: Vec<Line<'_>> =
        text.lines().enumerate().filter_map(|(i, line)| content(i + 1, line)).collect();
    let mut rest = lines.as_slice();
    let Some(first) = rest.first() else { return Err(Reason::new(1, "file", "is empty")) };
    let root = block(&mut rest, first.indent, 0)?;
    match rest.first() {
        Some(line) => Err(Reason::new(line.number, line.text, "is not understood here")),
        None => Ok(root),
    }
}

fn content(number: usize, line: &str) -> Option<Line<'_>> {
    let comment = line
        .char_indices()
        .find(|(i, c)| *c == '#' && line[..*i].chars().next_back().is_none_or(char::is_whitespace));
    let line = comment.map_or(line, |(i, _)| &line[..i]).trim_end();
    let text = line.trim_start();
    let is_mark = text.starts_with('%') || line == "---" || line == "...";
    (!text.is_empty() && !is_mark).then(|| Line { number, indent: line.len() - text.len(), text })
}

/// The entries or items that begin at this indentation.
fn block(rest: &mut &[Line<'_>], indent: usize, depth: usize) -> Result<Node, Reason> {
    let number = rest.first().map_or(0, |line| line.number);
    if depth > DEEPEST {
        return Err(Reason::new(number, "file", "is nested too deep"));
    }
    // items may stand as far to the left as the name that they belong to
    let is_list = rest.first().is_some_and(|line| item(line).is_some());
    let (mut items, mut entries) = (Vec::new(), Vec::new());
    let belongs = |line: &&Line<'_>| line.indent == indent && item(line).is_some() == is_list;
    while let Some(line) = rest.first().filter(belongs).cloned() {
        *rest = &rest[1..];
        if let Some(item) = item(&line) {
            items.push(value(item, &line, rest, depth)?);
        } else {
            let wrong = || Reason::new(line.number, line.text, "wants `name: value`");
            let (name, text) = line.text.split_once(':').ok_or_else(wrong)?;
            entries.push((unquoted(name.trim()).to_owned(), value(text, &line, rest, depth)?));
        }
    }
    let value = if is_list { Value::List(items) } else { Value::Map(entries) };
    Ok(Node { line: number, value })
}

/// What stands behind the dash of an item.
fn item<'a>(line: &Line<'a>) -> Option<&'a str> {
    line.text.strip_prefix("- ").or((line.text == "-").then_some(""))
}

/// What stands behind a name or a dash: something on the line, or a block below it.
fn value(
    text: &str,
    line: &Line<'_>,
    rest: &mut &[Line<'_>],
    depth: usize,
) -> Result<Node, Reason> {
    let mut text = text.trim();
    if text.starts_with('!') {
        text = text.split_once(char::is_whitespace).map_or("", |(_, behind)| behind.trim());
    }
    if text.starts_with('[') {
        return brackets(text, line, rest);
    }
    let below = rest.first().filter(|next| {
        next.indent > line.indent
            || next.indent == line.indent && item(next).is_some() && item(line).is_none()
    });
    match below {
        Some(next) if text.is_empty() => block(rest, next.indent, depth + 1),
        _ => Ok(Node::text(line.number, unquoted(text))),
    }
}

/// A list in brackets, over as many lines as it takes.
fn brackets(first: &str, line: &Line<'_>, rest: &mut &[Line<'_>]) -> Result<Node, Reason> {
    let mut stack: Vec<Node> = Vec::new();
    let (mut text, mut number) = (first, line.number);
    loop {
        let mut word = String::new();
        for c in text.chars().chain(std::iter::once(' ')) {
            if !matches!(c, '[' | ']' | ',' | ' ' | '\t') {
                word.push(c);
                continue;
            }
            push_word(&mut stack, &mut word, number);
            match c {
                '[' if stack.len() > DEEPEST => {
                    return Err(Reason::new(number, text, "is nested too deep"));
                }
                '[' => stack.push(Node { line: number, value: Value::List(Vec::new()) }),
                ']' => {
                    let Some(closed) = stack.pop() else { break };
                    let Some(Node { value: Value::List(items), .. }) = stack.last_mut() else {
                        return Ok(closed);
                    };
                    items.push(closed);
                }
                _ => {}
            }
        }
        let Some((next, behind)) = rest.split_first() else {
            return Err(Reason::new(line.number, line.text, "has a bracket that is not closed"));
        };
        (text, number, *rest) = (next.text, next.number, behind);
    }
}

fn push_word(stack: &mut [Node], word: &mut String, line: usize) {
    if let Some(Node { value: Value::List(items), .. }) = stack.last_mut()
        && !word.is_empty()
    {
        items.push(Node::text(line, unquoted(word)));
    }
    word.clear();
}

fn unquoted(text: &str) -> &str {
    let inner = |quote: char| text.strip_prefix(quote)?.strip_suffix(quote);
    inner('"').or_else(|| inner('\'')).unwrap_or(text)
}
