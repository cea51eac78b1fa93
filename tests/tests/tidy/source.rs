//! A rough reading of Rust sources: enough to tell code from comments, strings and tests.

use std::fs;
use std::path::Path;

use crate::manifest::root;

/// A source file.
#[derive(Debug)]
pub(crate) struct Source {
    /// Path from the root of the workspace.
    pub(crate) path: String,
    /// As it stands.
    pub(crate) text: String,
    /// With comments, strings and test code blanked; the line breaks stay.
    pub(crate) code: String,
}

/// All Rust files below a folder.
pub(crate) fn rust_sources(folder: &Path) -> Vec<Source> {
    let files = text_files(folder).into_iter().filter(|(path, _)| path.ends_with(".rs"));
    files.map(|(path, text)| Source::new(path, text)).collect()
}

/// Path and text of all files below a folder that people write, in a fixed order.
pub(crate) fn text_files(folder: &Path) -> Vec<(String, String)> {
    let mut files = Vec::new();
    let mut folders = vec![folder.to_owned()];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(&folder).into_iter().flatten().flatten() {
            let path = entry.path();
            let name = entry.file_name().to_string_lossy().into_owned();
            if path.is_dir() && name != "target" && name != ".git" {
                folders.push(path);
            } else if ["rs", "toml", "md"].iter().any(|end| name.ends_with(&format!(".{end}"))) {
                let relative = path.strip_prefix(root()).unwrap_or(&path).display().to_string();
                files.push((relative, fs::read_to_string(&path).unwrap()));
            }
        }
    }
    files.sort();
    files
}

impl Source {
    pub(crate) fn new(path: String, text: String) -> Self {
        let bare = blank_text(&text);
        let mut source = Source { path, text, code: String::new() };
        if !source.is_test() {
            source.code = blank_tests(&bare);
        }
        source
    }

    /// Whether it is compiled for tests only.
    pub(crate) fn is_test(&self) -> bool {
        self.path.contains("tests/") || self.path.ends_with("tests.rs")
    }

    /// Name, line and length of every function with a body, tests included.
    pub(crate) fn functions(&self) -> Vec<(String, usize, usize)> {
        let bare = blank_text(&self.text);
        let starts = bare.match_indices("fn ").filter(|(at, _)| {
            !bare[..*at].ends_with(|before: char| before.is_alphanumeric() || before == '_')
        });
        starts.filter_map(|(at, _)| function(&bare, at)).collect()
    }
}

/// The function whose `fn` stands here, unless it is a mere declaration or a function type.
fn function(bare: &str, at: usize) -> Option<(String, usize, usize)> {
    let rest = &bare[at + 3..];
    let name: String = rest.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect();
    let brace = rest.find('{').filter(|_| !name.is_empty())?;
    // a semicolon before the body ends a declaration, except inside an array type
    let head = &rest[..brace];
    let declared = head.match_indices(';').any(|(semicolon, _)| {
        let open = head[..semicolon].matches('[').count();
        open == head[..semicolon].matches(']').count()
    });
    if declared {
        return None;
    }
    let end = at + 3 + brace + closing_brace(&rest[brace..])?;
    let line = bare[..at].matches('\n').count() + 1;
    Some((name, line, bare[at..end].matches('\n').count() + 1))
}

/// Offset of the brace that closes the one at the start.
fn closing_brace(text: &str) -> Option<usize> {
    let mut depth = 0_usize;
    for (at, byte) in text.bytes().enumerate() {
        match byte {
            b'{' => depth += 1,
            b'}' if depth <= 1 => return Some(at),
            b'}' => depth -= 1,
            _ => {}
        }
    }
    None
}

/// Blanks every item that is compiled for tests only.
fn blank_tests(bare: &str) -> String {
    const MARK: &str = "#[cfg(test)]";
    let mut code = bare.to_owned();
    while let Some(at) = code.find(MARK) {
        let rest = &code[at..];
        let semicolon = rest.find(';').unwrap_or(rest.len());
        let brace = rest.find('{').unwrap_or(rest.len());
        let length = if semicolon < brace {
            semicolon
        } else {
            brace + closing_brace(&rest[brace..]).unwrap_or(rest.len() - brace)
        };
        let blank = blanked(&rest[..length]);
        code.replace_range(at..at + length, &blank);
    }
    code
}

fn blanked(text: &str) -> String {
    text.chars().map(|c| if c == '\n' { '\n' } else { ' ' }).collect()
}

/// Blanks comments, strings and characters.
fn blank_text(text: &str) -> String {
    let mut bare = String::with_capacity(text.len());
    let mut rest = text;
    while !rest.is_empty() {
        match literal(rest) {
            Some(length) => {
                bare.push_str(&blanked(&rest[..length]));
                rest = &rest[length..];
            }
            None => {
                let length = step(rest);
                bare.push_str(&rest[..length]);
                rest = &rest[length..];
            }
        }
    }
    bare
}

/// Length of a word or of one other character, so that `r"` is not looked for inside a word.
fn step(rest: &str) -> usize {
    let word = rest.find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(rest.len());
    if word > 0 { word } else { rest.chars().next().map_or(1, char::len_utf8) }
}

/// Length of the comment, string or character that begins here.
fn literal(rest: &str) -> Option<usize> {
    if rest.starts_with("//") {
        return Some(rest.find('\n').unwrap_or(rest.len()));
    }
    if rest.starts_with("/*") {
        return Some(rest.find("*/").map_or(rest.len(), |end| end + 2));
    }
    let body = rest.strip_prefix('b').unwrap_or(rest);
    let prefix = rest.len() - body.len();
    if let Some(raw) = body.strip_prefix('r') {
        let hashes = raw.len() - raw.trim_start_matches('#').len();
        let inside = raw[hashes..].strip_prefix('"')?;
        let end = format!("\"{}", "#".repeat(hashes));
        let length = inside.find(&end).map_or(inside.len(), |at| at + end.len());
        return Some(prefix + 1 + hashes + 1 + length);
    }
    if let Some(inside) = body.strip_prefix('"') {
        return Some(prefix + 1 + until(inside, '"'));
    }
    let inside = body.strip_prefix('\'')?;
    let mut chars = inside.chars();
    let is_character = chars.next() == Some('\\') || chars.next() == Some('\'');
    is_character.then(|| prefix + 1 + until(inside, '\''))
}

/// Length up to and with the closing mark, leaving escaped ones out.
fn until(inside: &str, mark: char) -> usize {
    let mut escaped = false;
    for (at, c) in inside.char_indices() {
        if c == mark && !escaped {
            return at + c.len_utf8();
        }
        escaped = c == '\\' && !escaped;
    }
    inside.len()
}

#[test]
fn comments_strings_and_tests_are_not_code() {
    let text = "let a = \"x.unwrap()\"; // .unwrap()\nlet q = '\"'; let l: &'a str = r#\"{\"\"#;\n\
                #[cfg(test)]\nmod tests {\n fn f() { x.unwrap() }\n}\nb.unwrap()\n";
    let source = Source::new("src/a.rs".to_owned(), text.to_owned());
    let hits: Vec<usize> = source
        .code
        .lines()
        .enumerate()
        .filter(|(_, line)| line.contains(".unwrap()"))
        .map(|(index, _)| index + 1)
        .collect();
    assert_eq!(hits, [7]);
}

#[test]
fn functions_are_measured_from_signature_to_brace() {
    let text = "trait T { fn declared(&self); }\nfn short() {}\nfn long(a: [u8; 3])\n{\n  {}\n}\n";
    let source = Source::new("src/a.rs".to_owned(), text.to_owned());
    let expected = [("short".to_owned(), 2, 1), ("long".to_owned(), 3, 4)];
    assert_eq!(source.functions(), expected);
}
