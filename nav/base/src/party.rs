//! Who may be wrong, and how far each is believed.

use std::fmt;

use serde::{Deserialize, Serialize};

use crate::time::Time;

/// A sensor, or several that fall together.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Party {
    /// The first GNSS receiver of the configuration.
    Gnss,
    /// The second one.
    Gnss2,
    /// The third one, and any other.
    Gnss3,
    /// The velocity log.
    Log,
    /// A heading reference: gyrocompass, dual antenna.
    Heading,
    /// Another reference of position or velocity.
    Reference,
    /// The IMU.
    Imu,
    /// Several antennas of the hull that are a compass.
    Antennas,
    /// Docking aids: lasers, radios, local position references.
    Docking,
}

impl Party {
    /// All of them.
    pub const ALL: [Party; 9] = [
        Party::Gnss,
        Party::Gnss2,
        Party::Gnss3,
        Party::Log,
        Party::Heading,
        Party::Reference,
        Party::Imu,
        Party::Antennas,
        Party::Docking,
    ];

    /// The receivers, in the order of the configuration.
    pub const RECEIVERS: [Party; 3] = [Party::Gnss, Party::Gnss2, Party::Gnss3];

    /// The receiver of a number, from 0.
    #[must_use]
    pub fn receiver(number: u8) -> Party {
        let last = Party::RECEIVERS.len() - 1;
        Party::RECEIVERS[usize::from(number).min(last)]
    }

    /// Whether it is a receiver.
    #[must_use]
    pub fn is_receiver(self) -> bool {
        Party::RECEIVERS.contains(&self)
    }

    /// Its word, as in the column `excluded` of `nav.csv`.
    #[must_use]
    pub fn as_str(self) -> &'static str {
        match self {
            Party::Gnss => "gnss",
            Party::Gnss2 => "gnss2",
            Party::Gnss3 => "gnss3",
            Party::Log => "log",
            Party::Heading => "heading",
            Party::Reference => "reference",
            Party::Imu => "imu",
            Party::Antennas => "antennas",
            Party::Docking => "docking",
        }
    }
}

impl fmt::Display for Party {
    /// The same in words.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Party::Gnss => "GNSS",
            Party::Gnss2 => "the second GNSS receiver",
            Party::Gnss3 => "the third GNSS receiver",
            Party::Log => "the log",
            Party::Heading => "the heading reference",
            Party::Reference => "the other reference",
            Party::Imu => "the IMU",
            Party::Antennas => "the compass of antennas",
            Party::Docking => "a docking aid",
        })
    }
}

/// How far somebody is believed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
pub enum Standing {
    /// As it says.
    Trusted,
    /// Something contradicts it, and it is not known who is wrong: not used meanwhile.
    Doubtful,
    /// It contradicts the others and is left out.
    Excluded,
    /// It was excluded and agrees again, but nothing has shown that it is right: used, not vouched for.
    Probation,
}

impl Standing {
    /// Its word: `trusted`, ...
    #[must_use]
    pub fn as_str(self) -> &'static str {
        match self {
            Standing::Trusted => "trusted",
            Standing::Doubtful => "doubtful",
            Standing::Excluded => "excluded",
            Standing::Probation => "probation",
        }
    }
}

/// What somebody is found to do.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum Fault {
    /// The receiver's position jumped.
    Jump,
    /// Its position and velocity are dragged away together.
    Drag,
    /// Its position drifts, its velocity does not.
    Slide,
    /// It is dragged away faster and faster.
    Creep,
    /// Its velocity is wrong.
    Velocity,
    /// Its height is wrong.
    Height,
    /// Its fixes come later than they say.
    Delay,
    /// It scatters by more than it says.
    GnssNoise,
    /// The log has another scale, or is turned.
    LogGain,
    /// The log is off along or athwart.
    LogOffset,
    /// The log is off to the same side of the world, as if it tracked the water.
    LogFlow,
    /// It scatters by more than it says.
    LogNoise,
    /// The heading is off.
    HeadingOffset,
    /// The heading drifts.
    HeadingDrift,
    /// It scatters by more than it says.
    HeadingNoise,
    /// The other position jumped.
    ReferenceJump,
    /// The other position is dragged away.
    ReferenceDrag,
    /// It scatters by more than it says.
    ReferenceNoise,
    /// A receiver that is only compared jumped.
    SpareJump,
    /// It is dragged away.
    SpareDrag,
    /// It is wrong in a way that has no shape.
    SpareNoise,
    /// What antennas tell of the heading is off.
    AntennasOffset,
    /// It drifts.
    AntennasDrift,
    /// It scatters by more than it says.
    AntennasNoise,
    /// A docking aid, by its number, tells distances that are off.
    DockingJump(u8),
    /// Its distances drift away.
    DockingDrift(u8),
    /// What docking aids measure to, by its place, is elsewhere than surveyed.
    DockingMark(u8),
    /// A docking aid scatters by more than it says.
    DockingNoise,
    /// A gyro has another bias.
    GyroBias,
    /// An accelerometer has another bias.
    AccelBias,
    /// A gyro has another scale.
    GyroScale,
    /// What the IMU says has nothing to do with how the ship moves.
    ImuUseless,
    /// The IMU is worse than its data sheet.
    ImuWorse,
}

impl Fault {
    /// Who does so, of receivers [`Party::Gnss`] for the one in use and [`Party::Gnss2`] for the one that is compared
    /// with it.
    #[must_use]
    pub fn party(self) -> Party {
        match self {
            Fault::Jump | Fault::Drag | Fault::Slide | Fault::Creep => Party::Gnss,
            Fault::Velocity | Fault::Height | Fault::Delay | Fault::GnssNoise => Party::Gnss,
            Fault::SpareJump | Fault::SpareDrag | Fault::SpareNoise => Party::Gnss2,
            Fault::LogGain | Fault::LogOffset | Fault::LogFlow | Fault::LogNoise => Party::Log,
            Fault::HeadingOffset | Fault::HeadingDrift | Fault::HeadingNoise => Party::Heading,
            Fault::ReferenceJump | Fault::ReferenceDrag | Fault::ReferenceNoise => Party::Reference,
            Fault::AntennasOffset | Fault::AntennasDrift | Fault::AntennasNoise => Party::Antennas,
            Fault::DockingJump(_) | Fault::DockingDrift(_) => Party::Docking,
            Fault::DockingMark(_) | Fault::DockingNoise => Party::Docking,
            Fault::GyroBias | Fault::AccelBias | Fault::GyroScale => Party::Imu,
            Fault::ImuUseless | Fault::ImuWorse => Party::Imu,
        }
    }

    /// Whether somebody goes away from the others little by little.
    #[must_use]
    pub fn is_drift(self) -> bool {
        matches!(
            self,
            Fault::Drag
                | Fault::Slide
                | Fault::Creep
                | Fault::HeadingDrift
                | Fault::ReferenceDrag
                | Fault::SpareDrag
                | Fault::AntennasDrift
                | Fault::DockingDrift(_)
        )
    }

    /// Whether it is merely that somebody scatters by more than he says.
    #[must_use]
    pub fn is_noise(self) -> bool {
        matches!(
            self,
            Fault::GnssNoise
                | Fault::SpareNoise
                | Fault::LogNoise
                | Fault::HeadingNoise
                | Fault::ReferenceNoise
                | Fault::AntennasNoise
                | Fault::DockingNoise
        )
    }

    /// A short name: `jump`, `log_gain`, ...
    #[must_use]
    pub fn as_str(self) -> &'static str {
        match self {
            Fault::Jump => "jump",
            Fault::Drag => "drag",
            Fault::Slide => "slide",
            Fault::Creep => "creep",
            Fault::Velocity => "velocity",
            Fault::Height => "height",
            Fault::Delay => "delay",
            Fault::GnssNoise => "gnss_noise",
            Fault::LogNoise => "log_noise",
            Fault::HeadingNoise => "heading_noise",
            Fault::ReferenceNoise => "reference_noise",
            Fault::LogGain => "log_gain",
            Fault::LogOffset => "log_offset",
            Fault::LogFlow => "log_flow",
            Fault::HeadingOffset => "heading_offset",
            Fault::HeadingDrift => "heading_drift",
            Fault::ReferenceJump => "reference_jump",
            Fault::ReferenceDrag => "reference_drag",
            Fault::SpareJump => "spare_jump",
            Fault::SpareDrag => "spare_drag",
            Fault::SpareNoise => "spare_noise",
            Fault::AntennasOffset => "antennas_offset",
            Fault::AntennasDrift => "antennas_drift",
            Fault::AntennasNoise => "antennas_noise",
            Fault::DockingJump(_) => "docking_jump",
            Fault::DockingDrift(_) => "docking_drift",
            Fault::DockingMark(_) => "docking_mark",
            Fault::DockingNoise => "docking_noise",
            Fault::GyroBias => "gyro_bias",
            Fault::AccelBias => "accel_bias",
            Fault::GyroScale => "gyro_scale",
            Fault::ImuUseless => "imu_useless",
            Fault::ImuWorse => "imu_worse",
        }
    }
}

impl fmt::Display for Fault {
    /// The same in words, to be read after the name of who does so.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Fault::Jump | Fault::ReferenceJump | Fault::SpareJump => "has jumped to another place",
            Fault::Drag | Fault::ReferenceDrag | Fault::SpareDrag => "drifts away",
            Fault::Slide => "drifts away, and its velocity says that it does not",
            Fault::Creep => "drifts away faster and faster",
            Fault::Velocity => "tells a wrong velocity",
            Fault::Height => "tells a wrong height",
            Fault::Delay => "tells fixes that are older than it says",
            Fault::GnssNoise | Fault::LogNoise | Fault::HeadingNoise | Fault::ReferenceNoise => {
                "scatters by more than it says"
            }
            Fault::AntennasNoise | Fault::DockingNoise => "scatters by more than it says",
            Fault::SpareNoise => "is elsewhere than the one in use",
            Fault::LogGain => "has another scale than before, or is turned",
            Fault::LogOffset => "is off along or athwart",
            Fault::LogFlow => "is off as if it tracked the water",
            Fault::HeadingOffset | Fault::AntennasOffset => "is off by an angle",
            Fault::HeadingDrift | Fault::AntennasDrift => "drifts",
            Fault::DockingJump(number) => {
                return write!(f, "(number {}) is off by a distance", u16::from(*number) + 1);
            }
            Fault::DockingDrift(number) => {
                return write!(f, "(number {}) drifts away", u16::from(*number) + 1);
            }
            Fault::DockingMark(_) => "measures to a line or point that is elsewhere than surveyed",
            Fault::GyroBias => "has a gyro with another bias than before",
            Fault::AccelBias => "has an accelerometer with another bias than before",
            Fault::GyroScale => "has a gyro with another scale than before",
            Fault::ImuUseless => "does not tell how the ship moves",
            Fault::ImuWorse => "is worse than its data sheet",
        })
    }
}

/// How somebody stands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stands {
    /// Who.
    pub party: Party,
    /// How far he is believed.
    pub standing: Standing,
    /// Since when.
    pub since: Time,
    /// What he was found to do, or is suspected of.
    pub fault: Option<Fault>,
}

impl fmt::Display for Stands {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Stands { party, standing, fault, .. } = self;
        match (standing, fault) {
            (Standing::Trusted, _) => write!(f, "{party} is believed again"),
            (Standing::Excluded, Some(fault)) => {
                write!(f, "{party} {fault}, as the others show, and is left out")
            }
            (Standing::Excluded, None) => {
                write!(f, "{party} contradicts the others and is left out")
            }
            (Standing::Doubtful, Some(fault)) if *party == Party::Imu => {
                write!(f, "{party} {fault}: use another heading, roll and pitch")
            }
            (Standing::Doubtful, _) => {
                write!(
                    f,
                    "{party} and the others contradict each other, and it is not known who is wrong"
                )
            }
            (Standing::Probation, _) => {
                write!(f, "{party} is used again, but nothing shows that it is right")
            }
        }
    }
}

/// Another receiver is used than before, though the intake would use the one before, or would have used this one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ReceiverChange {
    /// The one before.
    pub from: Party,
    /// The one that is used now.
    pub to: Party,
    /// Whether the one before is left out for what it told.
    pub is_for_lie: bool,
}

impl fmt::Display for ReceiverChange {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let ordinal = |party| match party {
            Party::Gnss2 => "second",
            Party::Gnss3 => "third",
            _ => "first",
        };
        let why = if self.is_for_lie { ", which is left out" } else { "" };
        let (from, to) = (ordinal(self.from), ordinal(self.to));
        write!(f, "the {to} GNSS receiver is used in place of the {from} one{why}")
    }
}

/// Some of them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, Hash)]
pub struct Parties(u16);

impl Parties {
    /// With one more.
    #[must_use]
    pub fn with(self, party: Party) -> Self {
        Parties(self.0 | 1 << party as u8)
    }

    /// Those of either.
    #[must_use]
    pub fn and(self, other: Parties) -> Self {
        Parties(self.0 | other.0)
    }

    /// Whether one is among them.
    #[must_use]
    pub fn contains(self, party: Party) -> bool {
        self.0 & 1 << party as u8 != 0
    }

    /// Whether there are none.
    #[must_use]
    pub fn is_empty(self) -> bool {
        self.0 == 0
    }

    /// Each of them.
    pub fn iter(self) -> impl Iterator<Item = Party> {
        Party::ALL.into_iter().filter(move |party| self.contains(*party))
    }
}

impl FromIterator<Party> for Parties {
    fn from_iter<I: IntoIterator<Item = Party>>(parties: I) -> Self {
        parties.into_iter().fold(Parties::default(), Parties::with)
    }
}

/// Whether the sensors bear out what is told.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, Hash)]
pub enum Integrity {
    /// Nobody compares them: before she navigates, at the berth, and while receivers and compass pass through.
    #[default]
    Unwatched,
    /// Those that are used agree with each other.
    Consistent,
    /// A receiver is used that was found to lie, and nothing shows that it does not any more.
    Unproven,
    /// They contradict each other, and it is not known who is wrong.
    Contradiction,
}

/// What is made of the sensors' words.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, Hash)]
pub struct Judgement {
    /// Whether those that are used bear out what is told.
    pub integrity: Integrity,
    /// Who is left out, or is doubted and cannot be.
    pub excluded: Parties,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_set_holds_what_was_put_in() {
        let some: Parties = [Party::Imu, Party::Gnss].into_iter().collect();
        assert_eq!(some.iter().collect::<Vec<_>>(), [Party::Gnss, Party::Imu]);
        assert!(!some.contains(Party::Log) && Parties::default().is_empty());
        assert_eq!(Parties::default().with(Party::Gnss).with(Party::Imu), some.and(some));
    }
}
