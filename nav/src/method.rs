//! The methods of holding a ship at her berth, by name.

/// How the motion of a moored ship is kept apart from the errors of her navigator.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Method {
    /// Zero velocity with the sea as white noise: the plain Kalman filter, for comparison.
    WhiteNoise,
    /// The prefilter as JP3375720B2 has it: an autoregressive model of the velocity in a sliding
    /// window takes the sea out before the Kalman filter ([`crate::disturbance`]).
    AsPublished,
    /// What an autoregressive model in a sliding window does not foretell of her displacement
    /// ([`crate::berth::Whitened`]).
    #[default]
    Autoregressive,
    /// The ship's swaying on her moorings as states of the Kalman filter, observed by her
    /// displacement from the berth ([`crate::berth::Moorings`]).
    Moorings,
}

impl Method {
    /// All of them, in the order of their age.
    pub const ALL: [Method; 4] =
        [Method::WhiteNoise, Method::AsPublished, Method::Autoregressive, Method::Moorings];

    /// Its name in configuration: `white_noise`, `autoregressive`, `moorings`.
    #[must_use]
    pub fn as_str(self) -> &'static str {
        match self {
            Method::WhiteNoise => "white_noise",
            Method::AsPublished => "as_published",
            Method::Autoregressive => "autoregressive",
            Method::Moorings => "moorings",
        }
    }

    /// The method of a name.
    #[must_use]
    pub fn from_word(word: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|method| method.as_str() == word)
    }
}
