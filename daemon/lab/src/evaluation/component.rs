//! The components of a solution, by name.

use std::f64::consts::PI;

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
    pub fn unit(self) -> &'static str {
        match self {
            Component::North | Component::East | Component::Down => "m",
            Component::VelocityNorth | Component::VelocityEast | Component::VelocityDown => "m/s",
            Component::Roll | Component::Pitch | Component::Heading => "deg",
        }
    }

    /// Multiplies an SI value to bring it to [`Component::unit`].
    #[must_use]
    pub fn scale(self) -> f64 {
        if self.unit() == "deg" { 180.0 / PI } else { 1.0 }
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
