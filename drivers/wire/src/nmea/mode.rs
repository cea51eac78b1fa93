//! The letters by which a sentence says how far it may be trusted.

use insd_base::FixQuality;

/// Mode of THS. Consumers take A fully, E and M with a warning, S and V not at all.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum HeadingMode {
    /// A.
    Autonomous,
    /// E: estimated, dead reckoning.
    Estimated,
    /// M: manual input.
    Manual,
    /// S: simulator.
    Simulator,
    /// V: not valid, standby included.
    NotValid,
}

/// Positioning-system mode of GLL, GNS, RMC and VTG.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum PositionMode {
    /// A.
    Autonomous,
    /// D.
    Differential,
    /// E: estimated, dead reckoning.
    Estimated,
    /// F: RTK with float ambiguities.
    RtkFloat,
    /// M: manual input.
    Manual,
    /// N.
    NotValid,
    /// P.
    Precise,
    /// R: RTK with fixed ambiguities.
    RtkFixed,
    /// S: simulator.
    Simulator,
}

/// What a talker says of the safety of its position for navigation (GNS, RMC since NMEA 4.1).
///
/// Nearly all receivers send V without a word on safety meant, so it says little of the fix.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum NavStatus {
    /// S: within the selected accuracy, integrity checked.
    Safe,
    /// C: integrity not available.
    Caution,
    /// U: beyond the selected accuracy.
    Unsafe,
    /// V: no such status is provided.
    NotProvided,
}

/// Letters both ways.
macro_rules! letters {
    ($($mode:ident { $($variant:ident $letter:literal),* $(,)? })*) => {$(
        impl $mode {
            /// Its letter.
            #[must_use]
            pub fn letter(self) -> u8 {
                match self { $($mode::$variant => $letter),* }
            }

            /// What a letter stands for.
            #[must_use]
            pub fn from_letter(letter: u8) -> Option<Self> {
                match letter { $($letter => Some($mode::$variant),)* _ => None }
            }
        }

        impl $crate::nmea::kinds::Lettered for $mode {
            fn to_letter(self) -> u8 {
                self.letter()
            }

            fn of_letter(letter: u8) -> Option<Self> {
                $mode::from_letter(letter)
            }
        }
    )*};
}

pub(crate) use letters;

letters! {
    HeadingMode {
        Autonomous b'A', Estimated b'E', Manual b'M', Simulator b'S', NotValid b'V'
    }
    PositionMode {
        Autonomous b'A', Differential b'D', Estimated b'E', RtkFloat b'F', Manual b'M',
        NotValid b'N', Precise b'P', RtkFixed b'R', Simulator b'S'
    }
    NavStatus {
        Safe b'S', Caution b'C', Unsafe b'U', NotProvided b'V'
    }
}

impl PositionMode {
    /// The quality of fix that the mode stands for.
    #[must_use]
    pub fn quality(self) -> FixQuality {
        match self {
            PositionMode::Autonomous => FixQuality::Autonomous,
            PositionMode::Differential => FixQuality::Differential,
            PositionMode::Estimated => FixQuality::Estimated,
            PositionMode::RtkFloat => FixQuality::RtkFloat,
            PositionMode::Manual => FixQuality::Manual,
            PositionMode::NotValid => FixQuality::Invalid,
            PositionMode::Precise => FixQuality::Precise,
            PositionMode::RtkFixed => FixQuality::RtkFixed,
            PositionMode::Simulator => FixQuality::Simulated,
        }
    }
}
