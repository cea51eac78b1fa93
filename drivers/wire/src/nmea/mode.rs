//! The letters by which a sentence says how far it may be trusted.

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

/// Positioning-system mode of VTG.
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

impl HeadingMode {
    const LETTERS: [(HeadingMode, u8); 5] = [
        (HeadingMode::Autonomous, b'A'),
        (HeadingMode::Estimated, b'E'),
        (HeadingMode::Manual, b'M'),
        (HeadingMode::Simulator, b'S'),
        (HeadingMode::NotValid, b'V'),
    ];

    /// Its letter.
    #[must_use]
    pub fn letter(self) -> u8 {
        letter_of(&Self::LETTERS, self, b'V')
    }

    /// The mode of a letter.
    #[must_use]
    pub fn from_letter(letter: u8) -> Option<Self> {
        of_letter(&Self::LETTERS, letter)
    }
}

impl PositionMode {
    const LETTERS: [(PositionMode, u8); 9] = [
        (PositionMode::Autonomous, b'A'),
        (PositionMode::Differential, b'D'),
        (PositionMode::Estimated, b'E'),
        (PositionMode::RtkFloat, b'F'),
        (PositionMode::Manual, b'M'),
        (PositionMode::NotValid, b'N'),
        (PositionMode::Precise, b'P'),
        (PositionMode::RtkFixed, b'R'),
        (PositionMode::Simulator, b'S'),
    ];

    /// Its letter.
    #[must_use]
    pub fn letter(self) -> u8 {
        letter_of(&Self::LETTERS, self, b'N')
    }

    /// The mode of a letter.
    #[must_use]
    pub fn from_letter(letter: u8) -> Option<Self> {
        of_letter(&Self::LETTERS, letter)
    }
}

fn letter_of<M: Copy + PartialEq>(letters: &[(M, u8)], mode: M, otherwise: u8) -> u8 {
    letters.iter().find(|(own, _)| *own == mode).map_or(otherwise, |(_, letter)| *letter)
}

fn of_letter<M: Copy>(letters: &[(M, u8)], letter: u8) -> Option<M> {
    letters.iter().find(|(_, own)| *own == letter).map(|(mode, _)| *mode)
}
