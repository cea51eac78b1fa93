//! Nodes of NMEA 2000: what the ship's computer is on a CAN bus, and what it sends there.

use std::path::PathBuf;

use insd_n2k::groups::ProductInfo;
use insd_n2k::node::NodeConfig;
use insd_n2k::pgn::Known;
use insd_n2k::{LAST_ADDRESS, Name, NameParts};
use insd_output::Manner;
use insd_output::n2k::N2kGroups;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What a node keeps from one run to the next: what others on the bus have decided.
#[derive(Clone, Debug, Default, PartialEq, Eq, Deserialize, Serialize)]
pub struct NodeMemory {
    /// The address it had last.
    pub address: Option<u8>,
    /// Its NAME, with the instances that it was given.
    pub name: Option<Name>,
    /// The installer's texts.
    pub installation: Option<[String; 2]>,
}

/// Longest text of a description that fits into its message, bytes.
const TEXT: usize = 70;
/// Bits of the unique number of a NAME.
const UNIQUE_BITS: u32 = 21;
/// Version of NMEA 2000 that is spoken, in thousandths.
const VERSION: u16 = 2100;
/// No code of a product and no level of certification: NMEA gives them, and has not.
const NO_CODE: u16 = 0xFFFF;
const NO_LEVEL: u8 = 0xFF;

/// A node on a CAN port. Without one a port is only listened to.
#[derive(Clone, Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct NodeSection {
    /// Name of its port.
    pub port: String,
    /// The address that it tries first, unless it remembers another.
    #[serde(default = "address")]
    pub address: u8,
    /// What tells it from all others of its maker, 0 to 2097151. Left out: a number made from this
    /// computer's own.
    pub unique: Option<u32>,
    /// Its number among its like on the bus.
    #[serde(default)]
    pub instance: u8,
    /// Which of several networks of the ship this is, 0 to 15.
    #[serde(default)]
    pub system_instance: u8,
    /// Code of its maker, given by NMEA; 2046 is what software without a code uses.
    #[serde(default = "no_maker")]
    pub manufacturer: u16,
    /// What it is, by its class: 175 is an integrated navigation system.
    #[serde(default = "integrated_navigation")]
    pub function: u8,
    /// Class of the device: 60 is navigation.
    #[serde(default = "navigation")]
    pub class: u8,
    /// Where and how it is installed: two texts for whoever asks.
    #[serde(default)]
    pub installation: [String; 2],
    /// The file in which it remembers its address and what it was told by others on the bus.
    pub state: Option<PathBuf>,
    /// Name of the monitoring point that it speaks of; the IMU if left out.
    pub point: Option<String>,
    /// Height of the geoid above the ellipsoid where the ship sails, m, in place of that of EGM96.
    pub geoid_m: Option<f64>,
    /// Whether the data come from a simulator, and must say so.
    #[serde(default)]
    pub simulated: bool,
    /// What is sent otherwise than by default, by name or number of the parameter group.
    #[serde(default)]
    pub groups: N2kGroups,
}

fn address() -> u8 {
    35
}
fn no_maker() -> u16 {
    2046
}
fn integrated_navigation() -> u8 {
    175
}
fn navigation() -> u8 {
    60
}

impl NodeSection {
    /// The node, its NAME made unique by a number of this computer where no other is given, with what
    /// it remembers.
    #[must_use]
    pub fn node(&self, computer: u64, memory: &NodeMemory) -> NodeConfig {
        let name = self.name(computer);
        // another number, maker or function is another node, which has no past
        let is_same = |old: &Name| {
            let (old, new) = (old.parts(), name.parts());
            NameParts {
                instance_lower: new.instance_lower,
                instance_upper: new.instance_upper,
                system_instance: new.system_instance,
                ..old
            } == new
        };
        let past = memory.name.filter(is_same);
        let address = memory.address.filter(|own| past.is_some() && *own <= LAST_ADDRESS);
        let installation = memory.installation.clone().filter(|_| past.is_some());
        let name = past.unwrap_or(name);
        let product = ProductInfo {
            n2k_version: VERSION,
            product_code: NO_CODE,
            model: "insd".to_owned(),
            software: env!("CARGO_PKG_VERSION").to_owned(),
            hardware: String::new(),
            serial: name.parts().unique_number.to_string(),
            certification: NO_LEVEL,
            load: 0,
        };
        NodeConfig {
            name,
            address: address.unwrap_or(self.address),
            product,
            installation: installation.unwrap_or_else(|| self.installation.clone()),
            manufacturer_info: "insd, https://github.com/insd-marine/insd".to_owned(),
            transmit: self.groups.transmit(),
            receive: Known::PGNS.to_vec(),
            commands: true,
        }
    }

    /// How it speaks.
    #[must_use]
    pub fn voice(&self) -> Manner {
        Manner { simulated: self.simulated, ..Manner::default() }
    }

    fn name(&self, computer: u64) -> Name {
        // folded, so that every bit of the computer's number counts
        let folded = computer ^ computer >> UNIQUE_BITS ^ computer >> (2 * UNIQUE_BITS);
        let unique_number = self.unique.unwrap_or((folded & ((1 << UNIQUE_BITS) - 1)) as u32);
        let parts = NameParts {
            unique_number,
            manufacturer: self.manufacturer,
            instance_lower: self.instance & 7,
            instance_upper: self.instance >> 3,
            function: self.function,
            class: self.class,
            system_instance: self.system_instance,
            industry: 4,
            arbitrary_address: true,
        };
        parts.name().unwrap_or(Name::new(0))
    }

    /// All that is wrong with it, in words.
    #[must_use]
    pub fn faults(&self) -> Vec<String> {
        let mut faults = Vec::new();
        let mut expect = |good: bool, key: &str, expected: &str| {
            if !good {
                faults.push(format!("{key}: expected {expected}"));
            }
        };
        expect(self.address <= LAST_ADDRESS, "address", "0 to 251");
        expect(self.unique.is_none_or(|n| n >> UNIQUE_BITS == 0), "unique", "0 to 2097151");
        expect(self.system_instance < 16, "system_instance", "0 to 15");
        expect(self.manufacturer < 2048, "manufacturer", "0 to 2047");
        expect(self.class < 128, "class", "0 to 127");
        let short = self.installation.iter().all(|text| text.len() <= TEXT && text.is_ascii());
        expect(short, "installation", "two texts of up to 70 ASCII characters");
        let geoid = self.geoid_m.is_none_or(|geoid| geoid.abs() <= 120.0);
        expect(geoid, "geoid_m", "-120 to 120");
        faults.extend(self.groups.faults().into_iter().map(|fault| format!("groups: {fault}")));
        faults
    }
}
