//! What alignment is told.

use insd_nav::berth::Method;

/// How a ship under way finds her heading.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum InMotion {
    /// The reference method, of JAE's hybrid navigation: one filter of eight states, linear in the
    /// sine and cosine of the heading ([`crate::in_motion`]).
    #[default]
    EightState,
    /// A bank of full filters, one for each heading ([`crate::bank`]).
    Bank,
}

impl InMotion {
    /// Both of them.
    pub const ALL: [InMotion; 2] = [InMotion::EightState, InMotion::Bank];

    /// Its name in configuration: `eight_state`, `bank`.
    #[must_use]
    pub fn as_str(self) -> &'static str {
        match self {
            InMotion::EightState => "eight_state",
            InMotion::Bank => "bank",
        }
    }

    /// The method of a name.
    #[must_use]
    pub fn from_word(word: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|method| method.as_str() == word)
    }
}

/// Choices of alignment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AlignmentConfig {
    /// At the berth.
    pub moored: Method,
    /// Under way.
    pub in_motion: InMotion,
    /// Heading sigma on the equator that counts as aligned, rad; elsewhere
    /// [`insd_base::alignment::heading_target`].
    pub accuracy: f64,
    /// The IMU has stayed powered since the state that is offered was stored, so that its biases are
    /// still what they were. Otherwise they are drawn anew from the turn-on sigma of its data sheet
    /// and nothing stored is believed of them ([`crate::stored`]).
    pub same_power_up: bool,
}

impl Default for AlignmentConfig {
    fn default() -> Self {
        AlignmentConfig {
            moored: Method::default(),
            in_motion: InMotion::default(),
            accuracy: insd_base::alignment::ACCURACY,
            same_power_up: false,
        }
    }
}
