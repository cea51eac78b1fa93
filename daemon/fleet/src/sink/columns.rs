//! What of a row has a column of its own: one table for the schema, for what is written and for the documentation.

use serde_json::Value;

/// A column.
#[derive(Clone, Copy, Debug)]
pub struct FleetColumn {
    /// Its name: that of the interface, with its unit.
    pub name: &'static str,
    /// Where it stands in a record, as of RFC 6901.
    pub pointer: &'static str,
    /// Whether it is a number, else a text.
    pub is_number: bool,
}

const fn number(name: &'static str, pointer: &'static str) -> FleetColumn {
    FleetColumn { name, pointer, is_number: true }
}

const fn text(name: &'static str, pointer: &'static str) -> FleetColumn {
    FleetColumn { name, pointer, is_number: false }
}

/// Those of state and history.
pub const SHIP: [FleetColumn; 15] = [
    text("mode", "/mode/name"),
    number("lat_deg", "/motion/lat_deg"),
    number("lon_deg", "/motion/lon_deg"),
    number("height_m", "/motion/height_m"),
    number("speed_kn", "/motion/speed_kn"),
    number("course_deg", "/motion/course_deg"),
    number("heading_deg", "/motion/heading_deg"),
    number("roll_deg", "/motion/roll_deg"),
    number("pitch_deg", "/motion/pitch_deg"),
    number("sigma_north_m", "/motion/sigma_north_m"),
    number("sigma_east_m", "/motion/sigma_east_m"),
    number("sigma_heading_deg", "/motion/sigma_heading_deg"),
    number("hpl_m", "/motion/hpl_m"),
    text("integrity", "/motion/integrity"),
    text("source", "/motion/source/name"),
];

/// Those of alerts.
pub const ALERT: [FleetColumn; 5] = [
    number("id", "/alert/id"),
    number("instance", "/alert/instance"),
    text("title", "/alert/title"),
    text("priority", "/alert/priority"),
    text("state", "/alert/state"),
];

impl FleetColumn {
    /// Its value in a record; `None` if it is not known, or of another kind.
    #[must_use]
    pub fn of<'a>(&self, told: &'a Value) -> Option<&'a Value> {
        told.pointer(self.pointer).filter(|own| {
            if self.is_number { own.as_f64().is_some_and(f64::is_finite) } else { own.is_string() }
        })
    }
}
