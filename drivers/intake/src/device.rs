//! Which of the devices of a bus is a sensor.
//!
//! Devices are told apart by their NAME, so one that changes its address is still the same, and one
//! that takes over its address is another. A device of which no claim was heard goes by its address
//! until one is. Of several devices that fit a sensor the first that says something is listened to,
//! until it has said nothing for the sensor's patience.

use insd_base::{Span, Time};
use insd_n2k::Name;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What a message of a bus is to a sensor.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Role {
    /// It tells what the sensor is for.
    Says,
    /// It would, but what it tells is not available.
    SaysNothing,
    /// It tells something beside.
    Beside,
}

/// What the NAME of a sensor's device must be, as far as it is told.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct DeviceFilter {
    /// The whole NAME, 16 hexadecimal digits.
    #[schemars(with = "Option<String>")]
    pub name: Option<Name>,
    /// Unique number.
    pub unique: Option<u32>,
    /// Code of the manufacturer.
    pub manufacturer: Option<u16>,
    /// Instance of the device, 0 to 255.
    pub instance: Option<u8>,
    /// What the device does, by its class.
    pub function: Option<u8>,
    /// Class of the device.
    pub class: Option<u8>,
    /// Which of several networks of the ship.
    pub system_instance: Option<u8>,
}

/// A device of a bus.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Device {
    /// Its NAME, if it claimed an address while somebody listened.
    pub name: Option<Name>,
    /// Its address when it spoke last.
    pub address: u8,
}

/// What a message's sender is to a sensor.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Heard {
    /// The sensor's device; `chosen`: from this message on.
    Own {
        /// It was not before.
        chosen: bool,
    },
    /// Another one.
    Other,
    /// No device is chosen yet, and this message is no reason to choose one.
    Nobody,
}

/// The device of one sensor.
#[derive(Clone, Copy, Debug)]
pub(crate) struct DeviceChoice {
    filter: Option<DeviceFilter>,
    patience: Span,
    /// The device, and when it said something.
    chosen: Option<(Device, Time)>,
}

impl DeviceFilter {
    /// Whether a NAME fits.
    #[must_use]
    pub fn fits(&self, name: Name) -> bool {
        let parts = name.parts();
        self.name.is_none_or(|own| own == name)
            && self.unique.is_none_or(|own| own == parts.unique_number)
            && self.manufacturer.is_none_or(|own| own == parts.manufacturer)
            && self.instance.is_none_or(|own| own == parts.instance())
            && self.function.is_none_or(|own| own == parts.function)
            && self.class.is_none_or(|own| own == parts.class)
            && self.system_instance.is_none_or(|own| own == parts.system_instance)
    }
}

impl Device {
    /// Whether it is the same, as far as can be known.
    fn is(&self, other: &Device) -> bool {
        match (self.name, other.name) {
            (Some(own), Some(other)) => own == other,
            (None, _) => self.address == other.address,
            (Some(_), None) => false,
        }
    }
}

impl DeviceChoice {
    /// A sensor that is any device, or one that fits; it is left after a silence of `patience`, s.
    pub(crate) fn new(filter: Option<DeviceFilter>, patience: f64) -> Self {
        DeviceChoice { filter, patience: Span::from_seconds(patience), chosen: None }
    }

    /// Whether what a device says is for the sensor.
    pub(crate) fn hear(&mut self, from: Device, role: Role, now: Time) -> Heard {
        let fits = |filter: DeviceFilter| from.name.is_some_and(|name| filter.fits(name));
        if !self.filter.is_none_or(fits) {
            return Heard::Other;
        }
        let known = self.chosen.filter(|(own, _)| own.is(&from));
        let says = role == Role::Says;
        match (self.chosen, known) {
            (_, Some((_, heard))) => {
                self.chosen = Some((from, if says { now } else { heard }));
                Heard::Own { chosen: false }
            }
            (Some((_, heard)), None) if !says || now - heard <= self.patience => Heard::Other,
            _ if says => {
                self.chosen = Some((from, now));
                Heard::Own { chosen: true }
            }
            _ if role == Role::SaysNothing => Heard::Own { chosen: false },
            _ => Heard::Nobody,
        }
    }

    /// The sensor's device.
    pub(crate) fn current(&self) -> Option<Device> {
        self.chosen.map(|(device, _)| device)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use insd_n2k::NameParts;

    fn device(name: Option<u64>, address: u8) -> Device {
        Device { name: name.map(Name::new), address }
    }

    fn hear(choice: &mut DeviceChoice, from: Device, role: Role, seconds: f64) -> Heard {
        choice.hear(from, role, Time::from_seconds(seconds))
    }

    const CHOSEN: Heard = Heard::Own { chosen: true };
    const OWN: Heard = Heard::Own { chosen: false };

    #[test]
    fn the_first_that_says_something_is_listened_to_until_it_says_nothing_for_too_long() {
        let mut choice = DeviceChoice::new(None, 2.0);
        let (first, second) = (device(Some(1), 10), device(Some(2), 11));
        assert_eq!(hear(&mut choice, second, Role::Beside, 0.0), Heard::Nobody);
        assert_eq!(hear(&mut choice, second, Role::SaysNothing, 0.0), OWN);
        assert_eq!(hear(&mut choice, first, Role::Says, 0.1), CHOSEN);
        assert_eq!(hear(&mut choice, second, Role::Says, 0.2), Heard::Other);
        // it goes on, but says nothing any more
        assert_eq!(hear(&mut choice, first, Role::SaysNothing, 2.0), OWN);
        assert_eq!(hear(&mut choice, second, Role::Beside, 2.2), Heard::Other);
        assert_eq!(hear(&mut choice, second, Role::Says, 2.2), CHOSEN);
        assert_eq!(hear(&mut choice, first, Role::Says, 2.3), Heard::Other);
    }

    #[test]
    fn a_device_is_known_by_its_name_wherever_it_sits() {
        let mut choice = DeviceChoice::new(None, 2.0);
        assert_eq!(hear(&mut choice, device(None, 10), Role::Says, 0.0), CHOSEN);
        assert_eq!(hear(&mut choice, device(Some(1), 10), Role::Says, 0.1), OWN);
        assert_eq!(hear(&mut choice, device(Some(1), 44), Role::Says, 0.2), OWN);
        assert_eq!(hear(&mut choice, device(Some(9), 44), Role::Says, 0.3), Heard::Other);
        assert_eq!(hear(&mut choice, device(None, 44), Role::Says, 0.3), Heard::Other);
        assert_eq!(choice.current(), Some(device(Some(1), 44)));
    }

    #[test]
    fn a_filter_lets_only_names_through_that_fit_it() {
        let parts = NameParts {
            unique_number: 77,
            manufacturer: 275,
            instance_lower: 1,
            instance_upper: 2,
            function: 145,
            class: 60,
            system_instance: 0,
            industry: 4,
            arbitrary_address: true,
        };
        let name = parts.name().unwrap();
        let none = DeviceFilter::default();
        let fitting = [
            none,
            DeviceFilter { name: Some(name), ..none },
            DeviceFilter { manufacturer: Some(275), instance: Some(17), ..none },
            DeviceFilter { unique: Some(77), class: Some(60), function: Some(145), ..none },
        ];
        assert!(fitting.iter().all(|filter| filter.fits(name)));
        let wrong = [
            DeviceFilter { name: Some(Name::new(1)), ..none },
            DeviceFilter { manufacturer: Some(275), instance: Some(1), ..none },
            DeviceFilter { system_instance: Some(1), ..none },
        ];
        assert!(!wrong.iter().any(|filter| filter.fits(name)));
        let mut choice = DeviceChoice::new(Some(fitting[2]), 2.0);
        let own = Device { name: Some(name), address: 3 };
        assert_eq!(hear(&mut choice, device(None, 3), Role::Says, 0.0), Heard::Other);
        assert_eq!(hear(&mut choice, own, Role::Says, 0.0), CHOSEN);
    }
}
