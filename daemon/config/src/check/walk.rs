//! Holds what a text says against what it may say: unknown keys, wrong types, words that are none, keys
//! that are missing. What is wrong is taken out or replaced, so that the rest can be looked at, too.

use std::net::{IpAddr, Ipv4Addr, SocketAddr};

use insd_drivers::ports::Network;
use toml::{Table, Value};

use super::document::Document;
use super::finding::{ConfigFinding, ConfigPlace, Severity};
use super::nearest::{advice, nearest};
use super::shape::{ConfigKey, Form, Shape, Word};

/// A walk through a text.
pub(super) struct Walk<'a, 'b> {
    document: &'a Document<'b>,
    /// What was found.
    pub(super) findings: Vec<ConfigFinding>,
}

/// Where the walk is: the section for people, the path for the text.
#[derive(Clone)]
struct Spot {
    place: ConfigPlace,
    path: Vec<String>,
}

impl Spot {
    fn below(&self, step: &str) -> Spot {
        let mut below = self.clone();
        below.path.push(step.to_owned());
        let key = below.place.key.get_or_insert_default();
        if !key.is_empty() {
            key.push('.');
        }
        key.push_str(step);
        below
    }
}

impl<'a, 'b> Walk<'a, 'b> {
    pub(super) fn new(document: &'a Document<'b>) -> Self {
        Walk { document, findings: Vec::new() }
    }

    /// Looks at a whole file, and leaves of it what can be read.
    pub(super) fn sections(&mut self, table: &mut Table, sections: &[ConfigKey]) {
        let names: Vec<String> = table.keys().cloned().collect();
        for name in names {
            let Some(section) = sections.iter().find(|own| own.name == name) else {
                let known = sections.iter().map(|own| own.name.as_str());
                let near = nearest(&name, known);
                let all: Vec<&str> = sections.iter().map(|own| own.name.as_str()).collect();
                let hint = match near {
                    Some(near) => format!("did you mean `[{near}]`?"),
                    None => format!("there are: {}", all.join(", ")),
                };
                let spot =
                    Spot { place: ConfigPlace::default().key(&name), path: vec![name.clone()] };
                self.tell(&spot, "unknown-section", "no such section", Some(hint));
                table.remove(&name);
                continue;
            };
            if let Some(value) = table.get_mut(&name) {
                self.section(section, value);
            }
        }
        for section in sections.iter().filter(|own| own.required) {
            if !table.contains_key(&section.name) {
                let place = ConfigPlace::one(&section.name);
                let spot = Spot { place, path: vec![section.name.clone()] };
                let text = "expected this section, which must be there";
                self.tell(&spot, "missing-section", text, None);
                table.insert(section.name.clone(), stopgap(&section.shape));
            }
        }
    }

    fn section(&mut self, section: &ConfigKey, value: &mut Value) {
        let path = vec![section.name.clone()];
        let Shape::List(of, _) = &section.shape else {
            let spot = Spot { place: ConfigPlace::one(&section.name), path };
            if let Some(mended) = self.value(&spot, value, &section.shape) {
                *value = mended;
            }
            return;
        };
        let Value::Array(list) = value else {
            let spot = Spot { place: ConfigPlace::one(&section.name), path };
            let text =
                format!("expected [[{}]] with two brackets: there may be several", section.name);
            self.tell(&spot, "section-form", &text, None);
            *value = Value::Array(Vec::new());
            return;
        };
        for (index, own) in list.iter_mut().enumerate() {
            let name = ["name", "port"].iter().find_map(|key| own.get(key)?.as_str());
            let place = ConfigPlace {
                section: format!("[[{}]]", section.name),
                name: name.map(str::to_owned),
                ..ConfigPlace::default()
            };
            let path = vec![section.name.clone(), index.to_string()];
            if let Some(mended) = self.value(&Spot { place, path }, own, of) {
                *own = mended;
            }
        }
    }

    /// Looks at a value; gives what to read in its place if it is wrong.
    fn value(&mut self, spot: &Spot, value: &mut Value, shape: &Shape) -> Option<Value> {
        match (shape, value) {
            (Shape::Any, _) | (Shape::Flag, Value::Boolean(_)) => None,
            (Shape::Number, Value::Float(_) | Value::Integer(_)) => None,
            (Shape::Text(form), Value::String(text)) => self.text(spot, text, *form),
            (Shape::Whole(least, most), Value::Integer(number)) => {
                let number = *number as f64;
                let sound = least.is_none_or(|least| number >= least)
                    && most.is_none_or(|most| number <= most);
                (!sound).then(|| self.wrong(spot, "range", shape))
            }
            (Shape::Word(words), Value::String(text)) => self.word(spot, text, words),
            (Shape::Table(keys), Value::Table(table)) => {
                self.table(spot, table, keys);
                None
            }
            (Shape::Kinds(tag, kinds), Value::Table(table)) => self.kinds(spot, table, tag, kinds),
            (Shape::Map(of), Value::Table(table)) => {
                table.retain(|key, own| self.value(&spot.below(key), own, of).is_none());
                None
            }
            (Shape::List(of, length), Value::Array(list)) => {
                if length.is_some_and(|length| list.len() as u64 != length) {
                    return Some(self.wrong(spot, "length", shape));
                }
                for (index, own) in list.iter_mut().enumerate() {
                    let below = Spot {
                        path: [&spot.path[..], &[index.to_string()]].concat(),
                        ..spot.clone()
                    };
                    if let Some(mended) = self.value(&below, own, of) {
                        *own = mended;
                    }
                }
                None
            }
            (Shape::Either(shapes), value) => self.either(spot, value, shapes),
            _ => Some(self.wrong(spot, "type", shape)),
        }
    }

    fn either(&mut self, spot: &Spot, value: &mut Value, shapes: &[Shape]) -> Option<Value> {
        let fits = |shape: &&Shape| {
            matches!(
                (shape, &*value),
                (Shape::Word(_) | Shape::Text(_), Value::String(_))
                    | (Shape::Table(_) | Shape::Map(_) | Shape::Kinds(..), Value::Table(_))
                    | (Shape::Whole(..), Value::Integer(_))
                    | (Shape::Number, Value::Float(_) | Value::Integer(_))
                    | (Shape::Flag, Value::Boolean(_))
                    | (Shape::List(..), Value::Array(_))
            )
        };
        match shapes.iter().find(fits) {
            Some(shape) => self.value(spot, value, shape),
            None => Some(self.wrong(spot, "type", &Shape::Either(shapes.to_vec()))),
        }
    }

    fn text(&mut self, spot: &Spot, text: &str, form: Form) -> Option<Value> {
        let sound = match form {
            Form::Free => true,
            Form::Ipv4 => text.parse::<Ipv4Addr>().is_ok(),
            Form::Ip => text.parse::<IpAddr>().is_ok(),
            Form::Socket => text.parse::<SocketAddr>().is_ok(),
            Form::Host => text.parse::<Network>().is_ok(),
        };
        (!sound).then(|| self.wrong(spot, "address", &Shape::Text(form)))
    }

    fn word(&mut self, spot: &Spot, text: &str, words: &[Word]) -> Option<Value> {
        if words.iter().any(|word| word.name == text) {
            return None;
        }
        let names: Vec<&str> = words.iter().map(|word| word.name.as_str()).collect();
        let expected = format!("expected one of {}", names.join(", "));
        let near = nearest(text, names.iter().copied());
        let hint = near.map(|near| format!("did you mean `{near}`?"));
        self.tell(spot, "unknown-word", &expected, hint);
        Some(stopgap(&Shape::Word(words.to_vec())))
    }

    fn kinds(
        &mut self,
        spot: &Spot,
        table: &mut Table,
        tag: &str,
        kinds: &[(Word, Vec<ConfigKey>)],
    ) -> Option<Value> {
        let words: Vec<Word> = kinds.iter().map(|(word, _)| word.clone()).collect();
        let shape = Shape::Word(words.clone());
        let instead = || Some(stopgap(&Shape::Kinds(tag.to_owned(), kinds.to_vec())));
        let below = spot.below(tag);
        match table.get_mut(tag) {
            None => {
                let names: Vec<&str> = words.iter().map(|word| word.name.as_str()).collect();
                let text = format!("expected {tag}, one of {}", names.join(", "));
                self.tell(&below, "missing-key", &text, None);
                return instead();
            }
            Some(value) => {
                if self.value(&below, value, &shape).is_some() {
                    return instead();
                }
            }
        }
        let own = table.remove(tag)?;
        let keys = kinds.iter().find(|(word, _)| own.as_str() == Some(&word.name));
        self.table(spot, table, keys.map_or(&[], |(_, keys)| keys));
        table.insert(tag.to_owned(), own);
        None
    }

    fn table(&mut self, spot: &Spot, table: &mut Table, keys: &[ConfigKey]) {
        let names: Vec<String> = table.keys().cloned().collect();
        for name in names {
            let below = spot.below(&name);
            let is_it = |key: &&ConfigKey| key.name == name || key.alias.as_ref() == Some(&name);
            let Some(key) = keys.iter().find(is_it) else {
                let known: Vec<&str> = keys.iter().map(|key| key.name.as_str()).collect();
                self.tell(&below, "unknown-key", "no such key", advice(&name, &known));
                table.remove(&name);
                continue;
            };
            let Some(value) = table.get_mut(&name) else { continue };
            match self.value(&below, value, &key.shape) {
                Some(mended) if key.required => *value = mended,
                Some(_) => drop(table.remove(&name)),
                None => {}
            }
        }
        for key in keys.iter().filter(|key| key.required) {
            if !table.contains_key(&key.name) {
                let text = format!("expected this key, which must be there: {}", key.doc);
                let text = text.trim_end_matches('.');
                self.tell(&spot.below(&key.name), "missing-key", text, None);
                table.insert(key.name.clone(), stopgap(&key.shape));
            }
        }
    }

    /// Tells that a value is not what its shape says; gives one that is.
    fn wrong(&mut self, spot: &Spot, cause: &'static str, shape: &Shape) -> Value {
        self.tell(spot, cause, &format!("expected {}", words(shape)), None);
        stopgap(shape)
    }

    fn tell(&mut self, spot: &Spot, cause: &'static str, text: &str, hint: Option<String>) {
        let mut finding =
            ConfigFinding::new(Severity::Error, cause, spot.place.clone(), text).refused();
        finding.advice = hint;
        for length in (1..=spot.path.len()).rev() {
            if let Some(found) = spot.path.get(..length).and_then(|path| self.document.at(path)) {
                finding.place.line = found.line;
                finding.value = found.value.filter(|_| length == spot.path.len());
                break;
            }
        }
        self.findings.push(finding);
    }
}

/// What a shape is, in words.
pub(crate) fn words(shape: &Shape) -> String {
    match shape {
        Shape::Any => "a value".to_owned(),
        Shape::Text(Form::Free) => "a text in quotes".to_owned(),
        Shape::Text(Form::Ipv4) => "an address like \"192.168.1.20\"".to_owned(),
        Shape::Text(Form::Ip) => "an address like \"192.168.1.20\" or \"fd00::20\"".to_owned(),
        Shape::Text(Form::Socket) => "an address with its port, like \"127.0.0.1:8470\"".to_owned(),
        Shape::Text(Form::Host) => {
            "an address like \"192.168.1.20\" or a network like \"10.0.0.0/24\"".to_owned()
        }
        Shape::Whole(Some(least), Some(most)) => format!("a whole number, {least} to {most}"),
        Shape::Whole(Some(least), None) => format!("a whole number from {least}"),
        Shape::Whole(..) => "a whole number".to_owned(),
        Shape::Number => "a number".to_owned(),
        Shape::Flag => "true or false".to_owned(),
        Shape::List(of, Some(length)) => format!("a list of {length}, each {}", words(of)),
        Shape::List(of, None) => format!("a list, each {}", words(of)),
        Shape::Word(all) => {
            let names: Vec<&str> = all.iter().map(|word| word.name.as_str()).collect();
            format!("one of {}", names.join(", "))
        }
        Shape::Table(_) | Shape::Kinds(..) | Shape::Map(_) => "a table".to_owned(),
        Shape::Either(shapes) => shapes.iter().map(words).collect::<Vec<_>>().join(", or "),
    }
}

/// Something that reads as the shape, where the text has nothing of the kind.
fn stopgap(shape: &Shape) -> Value {
    match shape {
        Shape::Text(Form::Ipv4 | Form::Ip | Form::Host) => Value::from("127.0.0.1"),
        Shape::Text(Form::Socket) => Value::from("127.0.0.1:1"),
        Shape::Any | Shape::Text(Form::Free) => Value::from(""),
        Shape::Whole(least, _) => Value::from(least.map_or(1, |least| (least as i64).max(1))),
        Shape::Number => Value::from(1.0),
        Shape::Flag => Value::from(false),
        Shape::List(of, length) => {
            Value::Array((0..length.unwrap_or(0)).map(|_| stopgap(of)).collect())
        }
        Shape::Word(words) => Value::from(words.first().map_or("", |word| word.name.as_str())),
        Shape::Table(keys) => Value::Table(required(keys)),
        Shape::Kinds(tag, kinds) => {
            let Some((word, keys)) = kinds.first() else { return Value::Table(Table::new()) };
            let mut table = required(keys);
            table.insert(tag.clone(), Value::from(word.name.as_str()));
            Value::Table(table)
        }
        Shape::Map(_) => Value::Table(Table::new()),
        Shape::Either(shapes) => shapes.first().map_or(Value::from(""), stopgap),
    }
}

fn required(keys: &[ConfigKey]) -> Table {
    let required = keys.iter().filter(|key| key.required);
    required.map(|key| (key.name.clone(), stopgap(&key.shape))).collect()
}
