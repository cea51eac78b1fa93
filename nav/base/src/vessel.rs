//! What kind of craft carries the sensors, and what follows from it: how fast she can be, and whether she can
//! move sideways.

/// The kind of craft.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum VesselKind {
    /// A displacement ship.
    #[default]
    Ship,
    /// A fast boat that planes.
    Boat,
    /// A car, on trials ashore.
    Car,
}

/// How a craft moves sideways where nothing tells it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sideways {
    /// On a straight course, 1-sigma, m/s.
    pub drift: f64,
    /// The drift changes within this time, s.
    pub time: f64,
    /// The point that goes straight ahead in a turn is so far from the IMU, 1-sigma, m.
    pub pivot: f64,
}

impl VesselKind {
    /// All of them.
    pub const ALL: [VesselKind; 3] = [VesselKind::Ship, VesselKind::Boat, VesselKind::Car];

    /// The word for it in files.
    #[must_use]
    pub fn as_str(self) -> &'static str {
        match self {
            VesselKind::Ship => "ship",
            VesselKind::Boat => "boat",
            VesselKind::Car => "car",
        }
    }

    /// The kind of which this is the word.
    #[must_use]
    pub fn of_word(word: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|kind| kind.as_str() == word)
    }

    /// No craft of this kind is faster, m/s.
    #[must_use]
    pub fn greatest_speed(self) -> f64 {
        match self {
            VesselKind::Ship => 60.0,
            VesselKind::Boat | VesselKind::Car => 100.0,
        }
    }

    /// How far an antenna of which the place was not measured may be from the IMU, 1-sigma of each component, m: as far
    /// as the bridge is, or the top of the mast.
    #[must_use]
    pub fn unmeasured_lever(self) -> f64 {
        match self {
            VesselKind::Ship => 20.0,
            VesselKind::Boat => 8.0,
            VesselKind::Car => 2.0,
        }
    }

    /// No craft of this kind changes her speed by so much within half a minute, m/s.
    #[must_use]
    pub fn greatest_spurt(self) -> f64 {
        match self {
            VesselKind::Ship => 10.0,
            VesselKind::Boat => 25.0,
            VesselKind::Car => 40.0,
        }
    }

    /// No craft of this kind changes how fast she moves athwart by so much within half a minute, m/s.
    #[must_use]
    pub fn greatest_lurch(self) -> f64 {
        match self {
            VesselKind::Ship => 3.0,
            VesselKind::Boat => 6.0,
            VesselKind::Car => 10.0,
        }
    }

    /// Whether she goes where her wheels let her.
    #[must_use]
    pub fn has_wheels(self) -> bool {
        self == VesselKind::Car
    }

    /// How she moves sideways.
    #[must_use]
    pub fn sideways(self) -> Sideways {
        match self {
            VesselKind::Ship => Sideways { drift: 0.3, time: 120.0, pivot: 40.0 },
            VesselKind::Boat => Sideways { drift: 1.0, time: 60.0, pivot: 20.0 },
            VesselKind::Car => Sideways { drift: 0.1, time: 10.0, pivot: 2.0 },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_kind_has_a_word_of_its_own() {
        for kind in VesselKind::ALL {
            assert_eq!(VesselKind::of_word(kind.as_str()), Some(kind));
        }
        assert_eq!(VesselKind::of_word("plane"), None);
    }
}
