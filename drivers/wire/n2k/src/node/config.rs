//! What a node is told about itself.

use super::Transmit;
use crate::Name;
use crate::groups::{Configuration, ProductInfo};

/// What a node is, and what it sends and reads.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NodeConfig {
    /// Its NAME.
    pub name: Name,
    /// The address to claim first: the last one held, or the one configured. 0 to 251.
    pub address: u8,
    /// What it says of its product.
    pub product: ProductInfo,
    /// What the installer wrote about it.
    pub installation: [String; 2],
    /// What the manufacturer wrote about it.
    pub manufacturer_info: String,
    /// What it sends by itself.
    pub transmit: Vec<Transmit>,
    /// Groups that it reads, beside those of network management.
    pub receive: Vec<u32>,
    /// Whether others may command it: its address, its texts, and what it sends when.
    pub commands: bool,
}

impl NodeConfig {
    /// The contents of group 126998.
    pub(crate) fn configuration(&self) -> Configuration {
        Configuration {
            installation: self.installation.clone(),
            manufacturer: self.manufacturer_info.clone(),
        }
    }
}
