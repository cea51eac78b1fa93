//! The reference of all keys, `insd.toml(5)`, from the types that read them and their documentation.

use std::fmt::Write as _;

use super::check::shape::{ConfigKey, Shape, Word, sections};
use super::check::walk::words;

/// What stands before the sections.
const HEAD: &str = r#".TH insd.toml 5 "" "insd VERSION" "insd"
.SH NAME
insd.toml \- configuration of insd, the inertial navigation system of a ship
.SH SYNOPSIS
/etc/insd/insd.toml
.SH DESCRIPTION
One file in TOML says how the ship is fitted out: what is plugged in, how it sits, and whom to tell.
.B insd example\-config
prints commented files to start from,
.B insd check\-config
tells all faults of one at once, and
.B insd doctor
looks at the computer and at what arrives, too.
.PP
Sections with one bracket stand once:
.BR [ship] .
Those with two stand once for each thing:
.BR [[port]] .
The unit of a number stands at the end of its key: _s seconds, _m metres, _deg degrees, _hz per second.
Levers are from the IMU, in metres: forward, starboard, down; what is above the IMU has a negative third number.
A 1\-sigma is the standard deviation.
.PP
Any key can be overridden from the environment: INSD__SHIP__RATE_HZ=50.
"#;

/// What stands behind them.
const FOOT: &str = r".SH FILES
.TP
/etc/insd/insd.toml
the configuration of the service
.TP
/usr/share/doc/insd/examples
others to start from
.SH SEE ALSO
.BR insd (1),
.BR insd\-check\-config (1),
.BR insd\-doctor (1),
.BR insd\-example\-config (1),
/usr/share/doc/insd/docs
";

/// The manual page, in the language of man(7).
#[must_use]
pub fn manual_page() -> String {
    let mut page = HEAD.replace("VERSION", env!("CARGO_PKG_VERSION"));
    for section in sections() {
        let (title, keys) = match &section.shape {
            Shape::List(of, _) => (format!("[[{}]]", section.name), of.as_ref()),
            shape => (format!("[{}]", section.name), shape),
        };
        let _ = writeln!(page, ".SH {title}\n{}", escaped(&section.doc));
        if let Shape::Table(keys) = keys {
            keys.iter().for_each(|key| entry(&mut page, key, ""));
        }
    }
    page.push_str(FOOT);
    page
}

/// All keys, `section.key` and below, as the reference has them.
#[must_use]
pub fn keys() -> Vec<String> {
    let mut all = Vec::new();
    for section in sections() {
        collect(&mut all, &section.name, &section.shape);
    }
    all
}

fn collect(all: &mut Vec<String>, path: &str, shape: &Shape) {
    match shape {
        Shape::Table(keys) => {
            for key in keys {
                let path = format!("{path}.{}", key.name);
                all.push(path.clone());
                collect(all, &path, &key.shape);
            }
        }
        Shape::Kinds(tag, kinds) => {
            all.push(format!("{path}.{tag}"));
            for (word, keys) in kinds {
                collect(all, &format!("{path}.{}", word.name), &Shape::Table(keys.clone()));
            }
        }
        Shape::List(of, _) | Shape::Map(of) => collect(all, path, of),
        Shape::Either(shapes) => shapes.iter().for_each(|own| collect(all, path, own)),
        _ => {}
    }
}

/// A key, and what is below it.
fn entry(page: &mut String, key: &ConfigKey, inside: &str) {
    let name = format!("{inside}{}", key.name);
    let _ = writeln!(page, ".TP\n.B {}\n{}", escaped(&name), escaped(&key.doc));
    let mut facts = vec![short(&key.shape)];
    facts.extend(key.unit().map(str::to_owned));
    if key.required {
        facts.push("must be there".to_owned());
    }
    facts.extend(key.default.as_ref().and_then(default).map(|value| format!("default {value}")));
    facts.extend(key.alias.as_ref().map(|alias| format!("also called {alias}")));
    let _ = writeln!(page, ".br\n.I {}", escaped(&facts.join("; ")));
    below(page, &key.shape, &name);
}

fn below(page: &mut String, shape: &Shape, name: &str) {
    match shape {
        Shape::Table(keys) => keys.iter().for_each(|key| entry(page, key, &format!("{name}."))),
        Shape::List(of, _) => below(page, of, name),
        Shape::Map(of) => below(page, of, &format!("{name}.NAME")),
        Shape::Either(shapes) => shapes.iter().for_each(|own| below(page, own, name)),
        Shape::Word(all) => list(page, all),
        Shape::Kinds(tag, kinds) => {
            for (word, keys) in kinds {
                let doc = escaped(&word.doc);
                let _ = writeln!(
                    page,
                    ".TP\n.B {}, {tag} = \\(dq{}\\(dq\n{doc}",
                    escaped(name),
                    escaped(&word.name)
                );
                keys.iter().for_each(|key| entry(page, key, &format!("{name}.")));
            }
        }
        _ => {}
    }
}

/// Words that are explained.
fn list(page: &mut String, all: &[Word]) {
    for word in all.iter().filter(|word| !word.doc.is_empty()) {
        let _ = writeln!(page, ".br\n\\(dq{}\\(dq: {}", escaped(&word.name), escaped(&word.doc));
    }
}

/// The type in a few words.
fn short(shape: &Shape) -> String {
    match shape {
        Shape::Kinds(tag, kinds) => {
            let names: Vec<&str> = kinds.iter().map(|(word, _)| word.name.as_str()).collect();
            format!("a table with {tag}, one of {}", names.join(", "))
        }
        shape => words(shape),
    }
}

/// A default as the file would write it; none of a table that is empty.
fn default(value: &serde_json::Value) -> Option<String> {
    let empty =
        value.as_object().is_some_and(|table| table.values().all(serde_json::Value::is_null))
            || value.as_array().is_some_and(Vec::is_empty);
    (!empty && !value.is_object()).then(|| value.to_string())
}

/// Safe from being read as commands of the page.
fn escaped(text: &str) -> String {
    let text = text
        .replace('\\', "\\e")
        .replace('-', "\\-")
        .replace('"', "\\(dq")
        .replace("[`", "`")
        .replace("`]", "`");
    if text.starts_with(['.', '\'']) { format!("\\&{text}") } else { text }
}

#[cfg(test)]
mod tests {
    use super::super::Config;
    use super::*;

    /// The keys that the reader of a table knows, from what it says to one that it does not.
    fn read(text: &str) -> Vec<String> {
        let fault = toml::from_str::<Config>(text).unwrap_err().to_string();
        let (_, expected) =
            fault.split_once(", expected").unwrap_or_else(|| panic!("{text}: {fault}"));
        let mut keys: Vec<String> =
            expected.split('`').skip(1).step_by(2).map(str::to_owned).collect();
        keys.sort();
        keys
    }

    /// Holds every table below a shape against its reader; gives how many keys there were.
    fn hold(shape: &Shape, wrap: &dyn Fn(&str) -> String) -> usize {
        match shape {
            Shape::Table(keys) => {
                let names = keys.iter().flat_map(|key| [Some(&key.name), key.alias.as_ref()]);
                let mut names: Vec<String> = names.flatten().cloned().collect();
                names.sort();
                let text = wrap("no_such_key = 1");
                assert_eq!(read(&text), names, "{text}");
                let below = |key: &ConfigKey| {
                    hold(&key.shape, &|inner| match &key.shape {
                        Shape::List(..) => wrap(&format!("{} = [ {{ {inner} }} ]", key.name)),
                        _ => wrap(&format!("{} = {{ {inner} }}", key.name)),
                    })
                };
                names.len() + keys.iter().map(below).sum::<usize>()
            }
            Shape::Kinds(tag, kinds) => {
                let own = |(word, keys): &(Word, Vec<ConfigKey>)| {
                    let wrap = |inner: &str| wrap(&format!("{tag} = \"{}\", {inner}", word.name));
                    hold(&Shape::Table(keys.clone()), &wrap)
                };
                kinds.iter().map(own).sum()
            }
            Shape::Map(of) => hold(of, &|inner| wrap(&format!("attitude = {{ {inner} }}"))),
            Shape::List(of, _) => hold(of, wrap),
            Shape::Either(shapes) => shapes.iter().map(|own| hold(own, wrap)).sum(),
            _ => 0,
        }
    }

    #[test]
    fn the_reference_has_every_key_that_is_read_and_no_other() {
        let mut count = 0;
        for section in sections() {
            let brackets = match &section.shape {
                Shape::List(..) => format!("[[{}]]", section.name),
                _ => format!("[{}]", section.name),
            };
            count += hold(&section.shape, &|inner| {
                // the keys of a section stand on lines of their own
                format!("{brackets}\n{inner}\n")
            });
        }
        let mut names: Vec<String> = sections().into_iter().map(|own| own.name).collect();
        names.sort();
        assert_eq!(read("no_such_key = 1"), names);
        assert!(count > 150, "{count} keys");
    }

    #[test]
    fn every_key_and_section_says_what_it_means() {
        fn silent(keys: &[ConfigKey], path: &str, all: &mut Vec<String>) {
            for key in keys {
                let path = format!("{path}.{}", key.name);
                if key.doc.is_empty() {
                    all.push(path.clone());
                }
                match &key.shape {
                    Shape::Table(keys) => silent(keys, &path, all),
                    Shape::List(of, _) => {
                        if let Shape::Table(keys) = of.as_ref() {
                            silent(keys, &path, all);
                        }
                    }
                    Shape::Kinds(_, kinds) => {
                        kinds.iter().for_each(|(_, keys)| silent(keys, &path, all));
                    }
                    _ => {}
                }
            }
        }
        let mut all = Vec::new();
        silent(&sections(), "", &mut all);
        assert_eq!(all, Vec::<String>::new());
    }

    #[test]
    fn the_manual_page_has_keys_that_were_nowhere_told_with_unit_and_default() {
        let page = manual_page();
        for key in ["heading_std_deg", "position_std_m", "heading_offset_deg"] {
            let (_, entry) = page.split_once(&format!(".TP\n.B {key}\n")).unwrap();
            let entry = entry.split(".TP").next().unwrap();
            assert!(entry.contains("default") && entry.len() > 60, "{key}: {entry}");
        }
        assert!(keys().contains(&"sensor.mounting.rotation_deg".to_owned()));
        assert!(keys().contains(&"port.transport.serial.baud".to_owned()));
        assert!(page.contains(".SH [[sensor]]") && page.contains("deg; default 1.0"), "{page}");
    }
}
