//! What a configuration may say: every section and key with its type, default and meaning, taken from the
//! types that read it and their documentation.
//!
//! One description, many uses: unknown keys and wrong types are told by it, all at once; the manual page
//! `insd.toml(5)` is written from it.

use schemars::generate::SchemaSettings;
use serde_json::{Map, Value};

use crate::Config;

/// What a value may be.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// Anything: its reader tells.
    Any,
    /// A text.
    Text(Form),
    /// A whole number within limits.
    Whole(Option<f64>, Option<f64>),
    /// Any number.
    Number,
    /// `true` or `false`.
    Flag,
    /// A list, of so many if that is fixed.
    List(Box<Shape>, Option<u64>),
    /// One of some words.
    Word(Vec<Word>),
    /// A table.
    Table(Vec<ConfigKey>),
    /// A table whose keys depend on what one of them says.
    Kinds(String, Vec<(Word, Vec<ConfigKey>)>),
    /// A table with any keys.
    Map(Box<Shape>),
    /// One or the other.
    Either(Vec<Shape>),
}

/// What a text must be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// Anything.
    Free,
    /// An address of IPv4.
    Ipv4,
    /// An address of the internet protocol.
    Ip,
    /// An address with a port.
    Socket,
    /// An address, or a network.
    Host,
}

/// A word that a key may say.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Word {
    /// The word.
    pub name: String,
    /// What it means.
    pub doc: String,
}

/// A key.
#[derive(Clone, Debug, PartialEq)]
pub struct ConfigKey {
    /// Its name.
    pub name: String,
    /// Another name for it, from earlier versions.
    pub alias: Option<String>,
    /// What it means.
    pub doc: String,
    /// Whether it must be there.
    pub required: bool,
    /// What holds without it, if that is one value.
    pub default: Option<Value>,
    /// What it may be.
    pub shape: Shape,
}

/// Units by the end of a key's name; the longest that fits counts.
const UNITS: [(&str, &str); 16] = [
    ("_deg_sqrt_h", "deg/sqrt(h)"),
    ("_mps_sqrt_h", "(m/s)/sqrt(h)"),
    ("_deg_h", "deg/h"),
    ("_deg", "deg"),
    ("_ppm", "ppm"),
    ("_ug", "micro-g"),
    ("_mps", "m/s"),
    ("_hz", "Hz"),
    ("_mb", "MB"),
    ("_ms", "ms"),
    ("_m", "m"),
    ("_s", "s"),
    ("_g", "g"),
    ("_bytes_h", "bytes/h"),
    ("_bytes", "bytes"),
    ("baud", "baud"),
];

impl ConfigKey {
    /// Its unit, which stands in its name.
    #[must_use]
    pub fn unit(&self) -> Option<&'static str> {
        UNITS.iter().find(|(end, _)| self.name.ends_with(end)).map(|(_, unit)| *unit)
    }
}

/// The sections of a configuration.
#[must_use]
pub fn sections() -> Vec<ConfigKey> {
    let settings =
        SchemaSettings::draft2020_12().with(|settings| settings.inline_subschemas = true);
    let schema = settings.into_generator().into_root_schema_for::<Config>();
    match schema.as_object().map(shape) {
        Some(Shape::Table(keys)) => keys,
        _ => Vec::new(),
    }
}

fn shape(schema: &Map<String, Value>) -> Shape {
    for key in ["oneOf", "anyOf"] {
        if let Some(list) = schema.get(key).and_then(Value::as_array) {
            return either(list);
        }
    }
    if let Some(words) = schema.get("enum").and_then(Value::as_array) {
        return Shape::Word(words.iter().filter_map(Value::as_str).map(word).collect());
    }
    if let Some(name) = schema.get("const").and_then(Value::as_str) {
        return Shape::Word(vec![Word { doc: doc(schema), ..word(name) }]);
    }
    match kind(schema) {
        Some("string") => Shape::Text(form(schema)),
        Some("integer") => {
            let limit = |key: &str| schema.get(key).and_then(Value::as_f64);
            Shape::Whole(limit("minimum"), limit("maximum"))
        }
        Some("number") => Shape::Number,
        Some("boolean") => Shape::Flag,
        Some("array") => {
            let items = schema.get("items").and_then(Value::as_object);
            let length = schema.get("minItems").and_then(Value::as_u64);
            let fixed = length.filter(|_| schema.get("minItems") == schema.get("maxItems"));
            Shape::List(Box::new(items.map_or(Shape::Any, shape)), fixed)
        }
        Some("object") => match schema.get("additionalProperties").and_then(Value::as_object) {
            Some(values) if !schema.contains_key("properties") => {
                Shape::Map(Box::new(shape(values)))
            }
            _ => Shape::Table(keys(schema)),
        },
        _ => Shape::Any,
    }
}

/// The type; that a value may also be left out is told elsewhere.
fn kind(schema: &Map<String, Value>) -> Option<&str> {
    match schema.get("type")? {
        Value::String(kind) => Some(kind),
        Value::Array(kinds) => kinds.iter().filter_map(Value::as_str).find(|kind| *kind != "null"),
        _ => None,
    }
}

fn form(schema: &Map<String, Value>) -> Form {
    match schema.get("format").and_then(Value::as_str) {
        Some("ipv4") => Form::Ipv4,
        Some("ip") => Form::Ip,
        Some("socket") => Form::Socket,
        Some("host") => Form::Host,
        _ => Form::Free,
    }
}

fn either(list: &[Value]) -> Shape {
    let objects = list.iter().filter_map(Value::as_object);
    let some: Vec<&Map<String, Value>> =
        objects.filter(|own| own.get("type") != Some(&Value::from("null"))).collect();
    if let Some(kinds) = tagged(&some) {
        return kinds;
    }
    let mut shapes: Vec<Shape> = some.iter().map(|own| shape(own)).collect();
    if shapes.iter().all(|own| matches!(own, Shape::Word(_))) {
        let words = shapes.into_iter().flat_map(|own| match own {
            Shape::Word(words) => words,
            _ => Vec::new(),
        });
        return Shape::Word(words.collect());
    }
    match shapes.len() {
        1 => shapes.remove(0),
        _ => Shape::Either(shapes),
    }
}

/// Tables that are told apart by the word of one key.
fn tagged(list: &[&Map<String, Value>]) -> Option<Shape> {
    let tag_of = |own: &Map<String, Value>| {
        let properties = own.get("properties")?.as_object()?;
        let (tag, value) = properties.iter().find(|(_, own)| own.get("const").is_some())?;
        Some((tag.clone(), value.get("const")?.as_str()?.to_owned()))
    };
    let mut kinds = Vec::new();
    let mut name = None;
    for own in list {
        let (tag, value) = tag_of(own)?;
        let keys: Vec<ConfigKey> = keys(own).into_iter().filter(|key| key.name != tag).collect();
        kinds.push((Word { doc: doc(own), ..word(&value) }, keys));
        name = Some(tag);
    }
    Some(Shape::Kinds(name?, kinds))
}

fn keys(schema: &Map<String, Value>) -> Vec<ConfigKey> {
    let required: Vec<&str> = schema
        .get("required")
        .and_then(Value::as_array)
        .map_or_else(Vec::new, |list| list.iter().filter_map(Value::as_str).collect());
    let properties = schema.get("properties").and_then(Value::as_object);
    let key = |(name, own): (&String, &Value)| {
        let own = own.as_object()?;
        let default = own.get("default").filter(|value| !value.is_null());
        Some(ConfigKey {
            name: name.clone(),
            alias: own.get("x-alias").and_then(Value::as_str).map(str::to_owned),
            doc: doc(own),
            required: required.contains(&name.as_str()),
            default: default.cloned(),
            shape: shape(own),
        })
    };
    let mut keys: Vec<ConfigKey> = properties.into_iter().flatten().filter_map(key).collect();
    keys.sort_by_key(|key| !key.required);
    keys
}

fn doc(schema: &Map<String, Value>) -> String {
    let text = schema.get("description").and_then(Value::as_str).unwrap_or_default();
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

fn word(name: &str) -> Word {
    Word { name: name.to_owned(), doc: String::new() }
}
