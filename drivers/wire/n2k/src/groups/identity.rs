//! What a node says of itself: product, configuration, heartbeat.

use insd_base::Span;

use super::requests::short;
use super::text::{padded, plain, take_text, write_text};
use crate::bytes::Bytes;
use crate::pgn::{Group, Short};

/// Length of a text of the product information, bytes.
const TEXT: usize = 32;

/// 126996 Product information.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ProductInfo {
    /// Version of NMEA 2000, thousandths: 2100 is 2.100.
    pub n2k_version: u16,
    /// Number of the product, given by NMEA.
    pub product_code: u16,
    /// Model, up to 32 characters of ASCII, as are the next three.
    pub model: String,
    /// Version of the software.
    pub software: String,
    /// Version of the hardware.
    pub hardware: String,
    /// Serial number.
    pub serial: String,
    /// Level of certification: 0 is A, 1 is B; 255 is none.
    pub certification: u8,
    /// Load of the bus's supply, in units of 50 mA.
    pub load: u8,
}

impl Group for ProductInfo {
    const PGN: u32 = 126_996;
    const PRIORITY: u8 = 6;
    const INTERVAL: Option<Span> = None;

    fn read(data: &[u8]) -> Result<Self, Short> {
        let mut bytes = Bytes(data);
        let (Some(n2k_version), Some(product_code)) = (bytes.word(), bytes.word()) else {
            return Err(short(data, 4));
        };
        let mut text = || bytes.take(TEXT).map(plain).unwrap_or_default();
        let [model, software, hardware, serial] = [text(), text(), text(), text()];
        let certification = bytes.byte().unwrap_or(255);
        let load = bytes.byte().unwrap_or(255);
        Ok(ProductInfo {
            n2k_version,
            product_code,
            model,
            software,
            hardware,
            serial,
            certification,
            load,
        })
    }

    fn write(&self) -> Vec<u8> {
        self.fields().concat()
    }
}

impl ProductInfo {
    /// Its fields, one by one, as they stand in the message.
    pub(crate) fn fields(&self) -> Vec<Vec<u8>> {
        vec![
            self.n2k_version.to_le_bytes().to_vec(),
            self.product_code.to_le_bytes().to_vec(),
            padded(&self.model, TEXT),
            padded(&self.software, TEXT),
            padded(&self.hardware, TEXT),
            padded(&self.serial, TEXT),
            vec![self.certification],
            vec![self.load],
        ]
    }
}

/// 126998 Configuration information.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Configuration {
    /// What the installer wrote.
    pub installation: [String; 2],
    /// What the manufacturer wrote.
    pub manufacturer: String,
}

impl Group for Configuration {
    const PGN: u32 = 126_998;
    const PRIORITY: u8 = 6;
    const INTERVAL: Option<Span> = None;

    /// Texts that are missing or cut are empty.
    fn read(data: &[u8]) -> Result<Self, Short> {
        let mut bytes = Bytes(data);
        let mut text = || take_text(&mut bytes);
        let first = text().ok_or_else(|| short(data, 2))?;
        let (second, manufacturer) = (text().unwrap_or_default(), text().unwrap_or_default());
        Ok(Configuration { installation: [first, second], manufacturer })
    }

    fn write(&self) -> Vec<u8> {
        self.fields().concat()
    }
}

impl Configuration {
    /// Its fields, one by one, as they stand in the message.
    pub(crate) fn fields(&self) -> Vec<Vec<u8>> {
        let [first, second] = &self.installation;
        let field = |text: &String| {
            let mut data = Vec::new();
            write_text(&mut data, text);
            data
        };
        [first, second, &self.manufacturer].into_iter().map(field).collect()
    }
}

/// State of a CAN controller.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Controller {
    /// Error active: all is well.
    Active,
    /// Error passive.
    Passive,
    /// It was off the bus.
    BusOff,
}

/// 126993 Heartbeat.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Heartbeat {
    /// Time from one to the next, whole milliseconds up to 65.532 s.
    pub interval: Option<Span>,
    /// 0 to 252, and again.
    pub sequence: Option<u8>,
    /// The first controller.
    pub first: Option<Controller>,
    /// The second controller.
    pub second: Option<Controller>,
    /// Whether the equipment has a fault.
    pub fault: Option<bool>,
}

const MILLISECOND: i64 = 1_000_000;

impl Group for Heartbeat {
    const PGN: u32 = 126_993;
    const PRIORITY: u8 = 7;
    const INTERVAL: Option<Span> = Some(Span::from_nanos(60_000 * MILLISECOND));

    fn read(data: &[u8]) -> Result<Self, Short> {
        let mut bytes = Bytes(data);
        let (Some(interval), Some(sequence)) = (bytes.word(), bytes.byte()) else {
            return Err(short(data, 3));
        };
        let states = bytes.byte().unwrap_or(255);
        let controller = |bits: u8| match bits & 3 {
            0 => Some(Controller::Active),
            1 => Some(Controller::Passive),
            2 => Some(Controller::BusOff),
            _ => None,
        };
        Ok(Heartbeat {
            interval: (interval <= 65_532)
                .then(|| Span::from_nanos(i64::from(interval) * MILLISECOND)),
            sequence: (sequence <= 252).then_some(sequence),
            first: controller(states),
            second: controller(states >> 2),
            fault: [Some(false), Some(true)].get(usize::from(states >> 4 & 3)).copied().flatten(),
        })
    }

    fn write(&self) -> Vec<u8> {
        let milliseconds = self.interval.map(|interval| interval.as_nanos() / MILLISECOND);
        let interval = milliseconds.and_then(|number| u16::try_from(number).ok());
        let interval = interval.filter(|number| *number <= 65_532).unwrap_or(u16::MAX);
        let sequence = self.sequence.filter(|sequence| *sequence <= 252).unwrap_or(255);
        let controller = |state| match state {
            Some(Controller::Active) => 0,
            Some(Controller::Passive) => 1,
            Some(Controller::BusOff) => 2,
            None => 3,
        };
        let fault = self.fault.map_or(3, u8::from);
        let states = controller(self.first) | controller(self.second) << 2 | fault << 4 | 0xC0;
        let [low, high] = interval.to_le_bytes();
        vec![low, high, sequence, states, 255, 255, 255, 255]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_recorded_heartbeat_is_read_and_written() {
        // canboat's sample raymarine-ev1.raw
        let recorded = [0x60, 0xEA, 0x43, 0xFC, 255, 255, 255, 255];
        let heartbeat = Heartbeat::read(&recorded).unwrap();
        assert_eq!(heartbeat.interval, Some(Span::from_seconds(60.0)));
        assert_eq!((heartbeat.sequence, heartbeat.first), (Some(0x43), Some(Controller::Active)));
        assert_eq!((heartbeat.second, heartbeat.fault), (None, None));
        assert_eq!(heartbeat.write(), recorded);
    }

    #[test]
    fn all_states_of_a_heartbeat_survive_the_round_trip() {
        let controllers =
            [None, Some(Controller::Active), Some(Controller::Passive), Some(Controller::BusOff)];
        for first in controllers {
            for second in controllers {
                for fault in [None, Some(false), Some(true)] {
                    let (interval, sequence) = (None, None);
                    let heartbeat = Heartbeat { interval, sequence, first, second, fault };
                    assert_eq!(Heartbeat::read(&heartbeat.write()), Ok(heartbeat));
                }
            }
        }
    }

    #[test]
    fn product_and_configuration_survive_the_round_trip() {
        let product = ProductInfo {
            n2k_version: 2100,
            product_code: 667,
            model: "insd".to_owned(),
            software: "0.1.0".to_owned(),
            hardware: String::new(),
            serial: "1234".to_owned(),
            certification: 255,
            load: 0,
        };
        assert_eq!(product.write().len(), 134);
        assert_eq!(ProductInfo::read(&product.write()), Ok(product));
        let installation = ["bridge".to_owned(), String::new()];
        let configuration = Configuration { installation, manufacturer: "insd".to_owned() };
        let expected = b"\x08\x01bridge\x02\x01\x06\x01insd";
        assert_eq!(configuration.write(), expected);
        assert_eq!(Configuration::read(expected), Ok(configuration));
    }

    #[test]
    fn the_longest_configuration_fits_in_a_fast_packet() {
        let long = "x".repeat(300);
        let installation = [long.clone(), long.clone()];
        let configuration = Configuration { installation, manufacturer: long };
        assert!(configuration.write().len() <= 223);
    }

    #[test]
    fn a_recorded_configuration_that_is_all_padding_is_empty() {
        // canboat's sample h5000_pilot_126998.raw: two fields of 40 bytes, all 0xFF, and an empty text
        let mut data = vec![255; 82];
        (data[0], data[40], data[80], data[81]) = (0x28, 0x28, 2, 1);
        assert_eq!(Configuration::read(&data), Ok(Configuration::default()));
    }
}
