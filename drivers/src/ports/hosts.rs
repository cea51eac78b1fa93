//! Hosts on the network, as a configuration lists them: addresses, and networks like `10.0.0.0/24`.

use std::borrow::Cow;
use std::fmt;
use std::net::IpAddr;
use std::str::FromStr;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{Deserialize, Deserializer, de};

/// Some hosts.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Hosts(Vec<Network>);

/// All addresses that begin with the same bits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Network {
    address: IpAddr,
    bits: u8,
}

/// What is no address and no network.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("expected an address like 192.168.1.20, or a network like 10.0.0.0/24")]
pub struct NoNetwork;

impl Hosts {
    /// Whether a host is one of them.
    #[must_use]
    pub fn contains(&self, host: IpAddr) -> bool {
        let host = Network::of(host);
        self.0.iter().any(|own| own.covers(&host))
    }

    /// Whether all of these are among them.
    #[must_use]
    pub fn covers(&self, others: &Hosts) -> bool {
        others.0.iter().all(|other| self.0.iter().any(|own| own.covers(other)))
    }

    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }
}

impl FromIterator<Network> for Hosts {
    fn from_iter<T: IntoIterator<Item = Network>>(networks: T) -> Self {
        Hosts(networks.into_iter().collect())
    }
}

impl From<IpAddr> for Hosts {
    fn from(host: IpAddr) -> Self {
        Hosts(vec![Network::of(host)])
    }
}

impl Network {
    /// One address; one of IPv4 in the disguise of IPv6 is one of IPv4.
    fn of(host: IpAddr) -> Self {
        let address = host.to_canonical();
        Network { address, bits: length(address) }
    }

    /// Whether all addresses of the other are addresses of this one.
    fn covers(&self, other: &Network) -> bool {
        let is_same_kind = self.address.is_ipv4() == other.address.is_ipv4();
        let rest = u32::from(length(self.address) - self.bits);
        let differing = number(self.address) ^ number(other.address);
        is_same_kind && self.bits <= other.bits && differing.checked_shr(rest).unwrap_or(0) == 0
    }
}

impl FromStr for Network {
    type Err = NoNetwork;

    fn from_str(text: &str) -> Result<Self, NoNetwork> {
        let (address, bits) = match text.split_once('/') {
            Some((address, bits)) => (address, Some(bits.parse::<u8>().map_err(|_| NoNetwork)?)),
            None => (text, None),
        };
        let address: IpAddr = address.parse().map_err(|_| NoNetwork)?;
        match bits {
            None => Ok(Network::of(address)),
            Some(bits) if bits <= length(address) => Ok(Network { address, bits }),
            Some(_) => Err(NoNetwork),
        }
    }
}

impl fmt::Display for Network {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Network { address, bits } = self;
        if *bits == length(*address) {
            write!(f, "{address}")
        } else {
            write!(f, "{address}/{bits}")
        }
    }
}

/// Bits of an address.
fn length(address: IpAddr) -> u8 {
    if address.is_ipv4() { 32 } else { 128 }
}

fn number(address: IpAddr) -> u128 {
    match address {
        IpAddr::V4(address) => u32::from(address).into(),
        IpAddr::V6(address) => address.into(),
    }
}

impl<'de> Deserialize<'de> for Hosts {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        /// One may stand for a list of one.
        #[derive(Deserialize)]
        #[serde(
            untagged,
            expecting = "expected addresses like \"192.168.1.20\" or \"10.0.0.0/24\""
        )]
        enum Text {
            One(String),
            Some(Vec<String>),
        }
        let texts = match Text::deserialize(deserializer)? {
            Text::One(text) => vec![text],
            Text::Some(texts) => texts,
        };
        texts.iter().map(|text| text.parse().map_err(de::Error::custom)).collect()
    }
}

impl JsonSchema for Hosts {
    fn schema_name() -> Cow<'static, str> {
        "Hosts".into()
    }

    fn inline_schema() -> bool {
        true
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({ "anyOf": [
            { "type": "array", "items": { "type": "string", "format": "host" } },
            { "type": "string", "format": "host" },
        ] })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn hosts(texts: &[&str]) -> Hosts {
        texts.iter().map(|text| text.parse::<Network>().unwrap()).collect()
    }

    #[test]
    fn a_list_has_its_addresses_and_those_of_its_networks_and_no_others() {
        let list = hosts(&["192.168.1.20", "10.0.0.0/24", "fd00:1::/32", "172.16.5.0/23"]);
        let is_in = |text: &str| list.contains(text.parse().unwrap());
        for host in
            ["192.168.1.20", "10.0.0.255", "fd00:1:ffff::1", "172.16.4.9", "::ffff:10.0.0.7"]
        {
            assert!(is_in(host), "{host}");
        }
        for host in ["192.168.1.21", "10.0.1.0", "fd00:2::1", "172.16.6.1", "::a00:7"] {
            assert!(!is_in(host), "{host}");
        }
        assert!(hosts(&["0.0.0.0/0"]).contains("8.8.8.8".parse().unwrap()));
        assert!(!hosts(&["0.0.0.0/0"]).contains("::1".parse().unwrap()));
        assert!(!hosts(&[]).contains("127.0.0.1".parse().unwrap()));
    }

    #[test]
    fn a_network_covers_its_parts_and_no_part_covers_it() {
        let net = hosts(&["10.0.0.0/16"]);
        assert!(net.covers(&hosts(&["10.0.0.0/24", "10.0.77.1"])));
        assert!(!hosts(&["10.0.0.0/24"]).covers(&net));
        assert!(net.covers(&hosts(&[])));
    }

    #[test]
    fn what_is_no_address_is_refused_and_what_is_one_is_written_as_it_was_read() {
        for text in
            ["", "bridge", "10.0.0.0/33", "10.0.0.0/", "10.0.0/24", "fd00::/129", "1.2.3.4:5"]
        {
            assert_eq!(text.parse::<Network>(), Err(NoNetwork), "{text}");
        }
        for text in ["10.0.0.0/24", "192.168.1.20", "fd00::/8", "fd00::20", "0.0.0.0/0"] {
            assert_eq!(text.parse::<Network>().unwrap().to_string(), text);
        }
    }

    #[test]
    fn one_address_may_stand_for_a_list() {
        #[derive(Deserialize)]
        struct Own {
            from: Hosts,
        }
        let read = |text: &str| toml::from_str::<Own>(text).map(|own| own.from);
        assert_eq!(read("from = \"10.0.0.7\"").unwrap(), hosts(&["10.0.0.7"]));
        assert_eq!(
            read("from = [\"10.0.0.7\", \"fd00::/8\"]").unwrap(),
            hosts(&["10.0.0.7", "fd00::/8"])
        );
        assert!(read("from = [\"bridge\"]").unwrap_err().to_string().contains("10.0.0.0/24"));
    }
}
