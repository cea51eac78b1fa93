//! Signal K: what a server sends over TCP, one JSON object a line.
//!
//! The first line after a call says which ship is the server's own, `{"name":..,"self":"vessels.urn:mrn:..",..}`; then come
//! deltas, of this ship and, unless only its own were asked for, of all that AIS hears:
//!
//! ```text
//! {"context":"vessels.urn:mrn:..","updates":[{"$source":"n2k.115","timestamp":"2026-01-02T03:04:05.100Z",
//!   "values":[{"path":"navigation.headingTrue","value":1.5708}, ...]}]}
//! ```
//! Read are the paths of [`ServerValue`]; `null` is a value that is known no longer. After the Signal K specification
//! 1.7 (delta format, streaming API) and what signalk-server 2.32 sends.

use serde::Deserialize;
use serde_json::Value;

use crate::binary::BinaryFault;
use crate::nmea::Position;
use crate::stream::Look;

/// The longest line that is waited for, bytes.
const LONGEST: usize = 16 * 1024;
/// How every line begins.
const START: &[u8] = b"{\"";
/// Speeds through the water beyond this are no ship's, m/s.
const FASTEST: f64 = 60.0;

/// A line of a server.
#[derive(Clone, Debug, PartialEq)]
pub enum ServerLine {
    /// The greeting: the context of the server's own ship.
    Hello {
        /// `vessels.urn:mrn:...`
        own: String,
    },
    /// Values.
    Delta {
        /// The ship of whose they are; the server's own if it is left out.
        context: Option<String>,
        /// Values of one source and time each.
        updates: Vec<ServerUpdate>,
    },
}

/// Values that one source told together.
#[derive(Clone, Debug, PartialEq)]
pub struct ServerUpdate {
    /// Who told it to the server: `$source`, else the label of `source`, else nothing.
    pub source: String,
    /// When, as the server has it.
    pub timestamp: Option<String>,
    /// Those of them that are read here.
    pub values: Vec<ServerValue>,
}

/// A value; `None` is one that is known no longer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ServerValue {
    /// `navigation.headingTrue`, rad.
    HeadingTrue(Option<f64>),
    /// `navigation.headingMagnetic`, rad.
    HeadingMagnetic(Option<f64>),
    /// `navigation.speedThroughWater`, along the keel, ahead positive, m/s.
    SpeedThroughWater(Option<f64>),
    /// `navigation.position`.
    Position(Option<Position>),
    /// A value of one of these paths that is none, and its path.
    Bad(&'static str),
}

impl ServerValue {
    /// The path that it is of.
    #[must_use]
    pub fn path(&self) -> &'static str {
        match self {
            ServerValue::HeadingTrue(_) => HEADING_TRUE,
            ServerValue::HeadingMagnetic(_) => HEADING_MAGNETIC,
            ServerValue::SpeedThroughWater(_) => SPEED_THROUGH_WATER,
            ServerValue::Position(_) => POSITION,
            ServerValue::Bad(path) => path,
        }
    }
}

const HEADING_TRUE: &str = "navigation.headingTrue";
const HEADING_MAGNETIC: &str = "navigation.headingMagnetic";
const SPEED_THROUGH_WATER: &str = "navigation.speedThroughWater";
const POSITION: &str = "navigation.position";

/// A line as JSON has it.
#[derive(Deserialize)]
struct Line {
    #[serde(rename = "self")]
    own: Option<String>,
    context: Option<String>,
    updates: Option<Vec<Update>>,
}

#[derive(Deserialize)]
struct Update {
    #[serde(rename = "$source")]
    reference: Option<String>,
    source: Option<Source>,
    timestamp: Option<String>,
    #[serde(default)]
    values: Vec<Told>,
}

#[derive(Deserialize)]
struct Source {
    label: Option<String>,
}

#[derive(Deserialize)]
struct Told {
    path: String,
    #[serde(default)]
    value: Value,
}

impl ServerLine {
    /// Reads a line, with or without its end.
    ///
    /// # Errors
    /// What does not fit: no JSON, or a line that is neither greeting nor delta.
    pub fn read(line: &[u8]) -> Result<Self, BinaryFault> {
        let line: Line = serde_json::from_slice(line).map_err(|_| BinaryFault::Frame)?;
        match (line.updates, line.own) {
            (Some(updates), _) => Ok(ServerLine::Delta {
                context: line.context,
                updates: updates.into_iter().map(ServerUpdate::of).collect(),
            }),
            (None, Some(own)) => Ok(ServerLine::Hello { own }),
            (None, None) => Err(BinaryFault::OtherMessage),
        }
    }

    /// The path of the first value that is read of it, and who told it; of a greeting, and of a delta without any, nothing.
    #[must_use]
    pub fn first(&self) -> Option<(&'static str, &str)> {
        let ServerLine::Delta { updates, .. } = self else { return None };
        updates.iter().find_map(|own| Some((own.values.first()?.path(), own.source.as_str())))
    }
}

impl ServerUpdate {
    fn of(update: Update) -> Self {
        let label = update.source.and_then(|source| source.label);
        ServerUpdate {
            source: update.reference.or(label).unwrap_or_default(),
            timestamp: update.timestamp,
            values: update.values.iter().filter_map(value).collect(),
        }
    }
}

fn value(told: &Told) -> Option<ServerValue> {
    let number = |wrap: fn(Option<f64>) -> ServerValue, path, most: f64| match &told.value {
        Value::Null => wrap(None),
        value => match value.as_f64().filter(|value| value.abs() <= most) {
            Some(number) => wrap(Some(number)),
            None => ServerValue::Bad(path),
        },
    };
    let turn = std::f64::consts::TAU;
    Some(match told.path.as_str() {
        HEADING_TRUE => number(ServerValue::HeadingTrue, HEADING_TRUE, turn),
        HEADING_MAGNETIC => number(ServerValue::HeadingMagnetic, HEADING_MAGNETIC, turn),
        SPEED_THROUGH_WATER => number(ServerValue::SpeedThroughWater, SPEED_THROUGH_WATER, FASTEST),
        POSITION if told.value.is_null() => ServerValue::Position(None),
        POSITION => match position(&told.value) {
            Some(position) => ServerValue::Position(Some(position)),
            None => ServerValue::Bad(POSITION),
        },
        _ => return None,
    })
}

fn position(value: &Value) -> Option<Position> {
    let angle = |name, most: f64| {
        let degrees = value.get(name)?.as_f64().filter(|degrees| degrees.abs() <= most)?;
        Some(degrees.to_radians())
    };
    Some(Position { latitude: angle("latitude", 90.0)?, longitude: angle("longitude", 180.0)? })
}

/// What stands at the start of some bytes: a line by its first characters and its end, of text alone; and by its JSON, as there is no
/// checksum.
#[must_use]
pub fn look(bytes: &[u8]) -> Look {
    let begins = bytes.iter().zip(START).all(|(own, expected)| own == expected);
    if !begins {
        return Look::Nothing;
    }
    let is_text = |byte: &u8| *byte >= b' ' && *byte != 0x7F;
    let text = bytes.iter().take(LONGEST).take_while(|byte| is_text(byte)).count();
    match bytes.get(text..) {
        _ if text == LONGEST => Look::Nothing,
        None | Some([]) => Look::More(text + 1),
        Some([b'\r']) => Look::More(text + 2),
        Some([b'\r', b'\n', ..]) => framed(bytes, text, 2),
        Some([b'\n', ..]) => framed(bytes, text, 1),
        Some(_) => Look::Nothing,
    }
}

fn framed(bytes: &[u8], text: usize, end: usize) -> Look {
    match bytes.get(..text).map(ServerLine::read) {
        Some(Ok(_) | Err(BinaryFault::OtherMessage)) => Look::Frame(text + end),
        _ => Look::Damaged,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const HELLO: &[u8] = br#"{"name":"signalk-server","version":"2.32.0","self":"vessels.urn:mrn:signalk:uuid:c0d79334-4e25-4245-8892-54e8ccc8021d","roles":["master","main"],"timestamp":"2026-11-28T20:00:00.000Z"}"#;

    fn values(line: &str) -> Vec<ServerValue> {
        match ServerLine::read(line.as_bytes()) {
            Ok(ServerLine::Delta { updates, .. }) => {
                updates.into_iter().flat_map(|update| update.values).collect()
            }
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn a_greeting_tells_the_own_ship() {
        let ServerLine::Hello { own } = ServerLine::read(HELLO).unwrap() else { panic!() };
        assert_eq!(own, "vessels.urn:mrn:signalk:uuid:c0d79334-4e25-4245-8892-54e8ccc8021d");
    }

    #[test]
    fn a_delta_tells_who_told_what_and_null_is_no_zero() {
        let line = r#"{"context":"vessels.self","updates":[
            {"$source":"n2k.115","timestamp":"2026-01-02T03:04:05.100Z","values":[
                {"path":"navigation.headingTrue","value":1.5},
                {"path":"environment.depth.belowKeel","value":12.0},
                {"path":"navigation.speedThroughWater","value":null}]},
            {"source":{"label":"gps","talker":"GP"},"values":[
                {"path":"navigation.position","value":{"latitude":60.0,"longitude":-25.0,"altitude":3.1}}]},
            {"meta":[{"path":"navigation.headingTrue","value":{"units":"rad"}}]}]}"#;
        let read = ServerLine::read(line.as_bytes()).unwrap();
        assert_eq!(read.first(), Some(("navigation.headingTrue", "n2k.115")));
        let ServerLine::Delta { context, updates } = read else { panic!() };
        assert_eq!(context.as_deref(), Some("vessels.self"));
        assert_eq!((updates[0].source.as_str(), updates[1].source.as_str()), ("n2k.115", "gps"));
        assert_eq!(updates[0].timestamp.as_deref(), Some("2026-01-02T03:04:05.100Z"));
        let expected = [ServerValue::HeadingTrue(Some(1.5)), ServerValue::SpeedThroughWater(None)];
        assert_eq!(updates[0].values, expected);
        let ServerValue::Position(Some(place)) = updates[1].values[0] else { panic!() };
        assert!((place.latitude.to_degrees() - 60.0).abs() < 1e-12);
        assert!((place.longitude.to_degrees() + 25.0).abs() < 1e-12);
        assert!(updates[2].values.is_empty());
    }

    #[test]
    fn a_value_that_is_none_is_told_apart_and_costs_no_other() {
        for bad in ["\"90\"", "7.5", "{}", "[1.0]", "true"] {
            let line = format!(
                r#"{{"updates":[{{"values":[{{"path":"navigation.headingTrue","value":{bad}}},
                    {{"path":"navigation.speedThroughWater","value":5}}]}}]}}"#
            );
            let expected = [
                ServerValue::Bad("navigation.headingTrue"),
                ServerValue::SpeedThroughWater(Some(5.0)),
            ];
            assert_eq!(values(&line), expected, "{bad}");
        }
        for bad in [r#"{"latitude":91,"longitude":0}"#, r#"{"latitude":9}"#, "[60,25]"] {
            let line = format!(
                r#"{{"updates":[{{"values":[{{"path":"navigation.position","value":{bad}}}]}}]}}"#
            );
            assert_eq!(values(&line), [ServerValue::Bad("navigation.position")], "{bad}");
        }
    }

    #[test]
    fn what_insd_writes_is_read() {
        let delta = crate::signalk::Delta { heading: Some(2.0), ..Default::default() };
        let written = delta.write();
        let read = values(&written);
        assert!(read.contains(&ServerValue::HeadingTrue(Some(2.0))), "{read:?}");
        assert!(read.contains(&ServerValue::Position(None)), "{read:?}");
        assert_eq!(look(written.as_bytes()), Look::Frame(written.len()));
    }

    #[test]
    fn lines_are_found_by_their_ends_and_their_json() {
        let line = [HELLO, b"\r\n"].concat();
        assert_eq!(look(&line), Look::Frame(line.len()));
        assert_eq!(look(&[HELLO, b"\n{"].concat()), Look::Frame(HELLO.len() + 1));
        for length in 1..line.len() {
            assert!(matches!(look(&line[..length]), Look::More(_)), "{length}");
        }
        assert_eq!(look(b"{\"a\":}\n"), Look::Damaged);
        let reply = b"{\"requestId\":\"7\",\"state\":\"COMPLETED\"}\n";
        assert_eq!(look(reply), Look::Frame(reply.len()));
        assert_eq!(look(b"{\"a\x02"), Look::Nothing);
        assert_eq!(look(b"{a"), Look::Nothing);
        assert_eq!(look(&[b"{\"".as_slice(), &[b'x'; LONGEST]].concat()), Look::Nothing);
    }
}
