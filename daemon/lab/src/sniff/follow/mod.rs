//! What came as a stream of JSON, an object for each thing that came. The keys are told in docs/sniff.md.

mod values;

use std::collections::BTreeMap;

use insd_config::calendar;
use insd_intake::config::{Kind, SensorConfig};
use insd_intake::decode::Decoder;
use insd_wire::describe::ReadOutcome;
use insd_wire::stream::Protocol;
use serde_json::{Value, json};

use super::seen::{Seen, SeenWhat};

/// Ports whose decoders are kept.
const PORTS: usize = 64;

/// Makes objects of what is seen. Some formats tell a thing in several frames, so what came before is kept.
#[derive(Clone, Debug, Default)]
pub struct Follower {
    decoders: BTreeMap<(String, &'static str), Vec<Decoder>>,
}

impl Follower {
    /// What was seen, as an object.
    pub fn object(&mut self, seen: &Seen<'_>) -> Value {
        let received = seen.timed.then(|| calendar::rfc3339_millis(seen.stamp.system));
        let monotonic = seen.timed.then(|| seen.stamp.monotonic.as_seconds());
        let mut object =
            json!({ "port": seen.port, "received": received, "monotonic_s": monotonic });
        let own = match seen.what {
            SeenWhat::Frame { protocol, name, read, reason, bytes } => json!({
                "type": "frame",
                "protocol": protocol.name(),
                "name": name,
                "read": word(read),
                "reason": reason,
                "bytes": bytes.len(),
                "data": self.data(seen.port, protocol, bytes),
            }),
            SeenWhat::Stray { count, .. } => json!({ "type": "stray", "bytes": count }),
            SeenWhat::Can(frame) => {
                let data = frame.data().iter().map(|byte| format!("{byte:02X}"));
                let data = data.collect::<String>();
                json!({ "type": "can", "id": frame.id().to_string(), "data": data })
            }
            SeenWhat::Bus(event) => json!({ "type": "bus", "event": event.to_string() }),
            SeenWhat::Pulse { sequence } => json!({ "type": "pulse", "sequence": sequence }),
            SeenWhat::State(state) => json!({ "type": "state", "state": state.to_string() }),
        };
        if let (Some(object), Value::Object(own)) = (object.as_object_mut(), own) {
            object.extend(own);
        }
        object
    }

    /// What a frame says, as the readers of insd have it.
    fn data(&mut self, port: &str, protocol: Protocol, bytes: &[u8]) -> Vec<Value> {
        let key = (port.to_owned(), protocol.name());
        if self.decoders.len() >= PORTS && !self.decoders.contains_key(&key) {
            return Vec::new();
        }
        let make = || kinds(protocol).iter().map(|kind| Decoder::new(&described(*kind))).collect();
        let decoders = self.decoders.entry(key).or_insert_with(make);
        let mut data = Vec::new();
        for decoder in decoders {
            let readings = decoder.read(bytes).unwrap_or_default();
            data.extend(readings.iter().filter_map(values::object));
            // a sentence is one thing; a binary frame may be an IMU's sample and a heading
            if protocol == Protocol::Nmea && !data.is_empty() {
                break;
            }
        }
        data
    }
}

fn word(read: ReadOutcome) -> &'static str {
    match read {
        ReadOutcome::Used => "used",
        ReadOutcome::Other => "other",
        ReadOutcome::Refused => "refused",
    }
}

/// The sensors as which frames are read, in their order. Those whose units are not visible on the wire, or that must be told what they
/// mean, are none of them.
fn kinds(protocol: Protocol) -> &'static [Kind] {
    match protocol {
        Protocol::Nmea => &[
            Kind::Compass,
            Kind::NmeaLog,
            Kind::Nortek,
            Kind::Psxn,
            Kind::Psat,
            Kind::Ptnl,
            Kind::Pfec,
            Kind::Rls,
            Kind::NmeaGnss,
        ],
        Protocol::Ubx => &[Kind::Ubx],
        Protocol::Sbf => &[Kind::Sbf],
        Protocol::Sbg => &[Kind::Sbg],
        Protocol::StdBin => &[Kind::Stdbin, Kind::StdbinIns],
        Protocol::Mip => &[Kind::Mip],
        Protocol::Xbus => &[Kind::Xbus],
        Protocol::Pd0 => &[Kind::Pd0],
        Protocol::Pd6 => &[Kind::Pd6],
        Protocol::Novatel => &[Kind::Novatel, Kind::NovatelImu, Kind::NovatelIns],
        Protocol::Kmb => &[Kind::Kmb],
        Protocol::Em3000 => &[Kind::Em3000],
        Protocol::Tss1 => &[Kind::Tss1],
        Protocol::Gsof => &[Kind::Gsof],
        Protocol::VectorNav => &[Kind::Vectornav, Kind::VectornavIns],
        Protocol::Ad2cp => &[Kind::Ad2cp],
        Protocol::SignalK => &[Kind::SignalkHeading, Kind::SignalkLog, Kind::SignalkPosition],
        Protocol::Rtcm | Protocol::Kvh | Protocol::Stim | Protocol::Ngt1 => &[],
    }
}

/// A sensor that takes whatever can be taken.
fn described(kind: Kind) -> SensorConfig {
    let (magnetic, heading) = (true, true);
    SensorConfig { magnetic, heading, ..SensorConfig::new("seen", "seen", kind) }
}
