//! The components of a solution, by name.

use std::f64::consts::PI;
use std::fmt;

use serde::{Deserialize, Serialize};

/// Unit of a component as people read it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Unit {
    /// Metres.
    #[serde(rename = "m")]
    Metre,
    /// Metres per second.
    #[serde(rename = "m/s")]
    MetrePerSecond,
    /// Degrees.
    #[serde(rename = "deg")]
    Degree,
}

impl Unit {
    /// As it is written.
    #[must_use]
    pub fn as_str(self) -> &'static str {
        match self {
            Unit::Metre => "m",
            Unit::MetrePerSecond => "m/s",
            Unit::Degree => "deg",
        }
    }
}

impl fmt::Display for Unit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.as_str())
    }
}

/// One component of position, velocity or attitude.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Component {
    /// Position, north.
    North,
    /// Position, east.
    East,
    /// Position, down.
    Down,
    /// Velocity, north.
    VelocityNorth,
    /// Velocity, east.
    VelocityEast,
    /// Velocity, down.
    VelocityDown,
    /// Roll.
    Roll,
    /// Pitch.
    Pitch,
    /// Heading.
    Heading,
}

impl Component {
    /// All of them, in the order of the arrays of [`super::EpochError`].
    pub const ALL: [Component; 9] = [
        Component::North,
        Component::East,
        Component::Down,
        Component::VelocityNorth,
        Component::VelocityEast,
        Component::VelocityDown,
        Component::Roll,
        Component::Pitch,
        Component::Heading,
    ];

    /// Key in JSON and first column of tables.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Component::North => "north",
            Component::East => "east",
            Component::Down => "down",
            Component::VelocityNorth => "velocity_north",
            Component::VelocityEast => "velocity_east",
            Component::VelocityDown => "velocity_down",
            Component::Roll => "roll",
            Component::Pitch => "pitch",
            Component::Heading => "heading",
        }
    }

    /// Unit in which people read it.
    #[must_use]
    pub fn unit(self) -> Unit {
        match self {
            Component::North | Component::East | Component::Down => Unit::Metre,
            Component::VelocityNorth | Component::VelocityEast | Component::VelocityDown => {
                Unit::MetrePerSecond
            }
            Component::Roll | Component::Pitch | Component::Heading => Unit::Degree,
        }
    }

    /// Multiplies an SI value to bring it to [`Component::unit`].
    #[must_use]
    pub fn scale(self) -> f64 {
        if self.unit() == Unit::Degree { 180.0 / PI } else { 1.0 }
    }

    /// Place in the arrays of [`super::EpochError`].
    #[must_use]
    pub fn index(self) -> usize {
        self as usize
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_component_stands_at_its_own_index() {
        for (place, component) in Component::ALL.into_iter().enumerate() {
            assert_eq!(component.index(), place);
        }
    }
}
