//! Faults that may be.

use insd_base::{Fault, Party, Time};
use nalgebra::Vector2;

use super::docket::NO_LIE;
use super::lie::growth;
use super::onset::Sized;
use super::rows::{OF_FALSE_PUSHES, OF_FALSE_TURNS};

/// Logarithm of the odds against nobody lying beyond which it is in doubt, and against all others beyond which one
/// is found to.
pub(super) const DOUBT: f64 = 6.9;
pub(super) const CERTAIN: f64 = 6.9;
/// Somebody is likely to lie from such odds on, as a logarithm.
pub(super) const LIKELY: f64 = 2.3;
/// A height that changes by more at once leaps, m.
const LEAP: f64 = 5.0;
/// A place that changes by more at once does, m.
const FAR: f64 = 10.0;

/// What kind of a fault it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Kind {
    /// One of a group, sized, that began then.
    Shaped { group: usize, since: Time, sized: Sized },
    /// Of no known shape.
    Shapeless,
}

/// A fault that may be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Charge {
    pub(super) fault: Fault,
    /// Logarithm of its weight; that of there being none is zero.
    pub(super) weight: f64,
    /// What of it the innovations tell, as if they were all as sure as stated.
    pub(super) evidence: f64,
    /// When it began, or began to show.
    pub(super) begun: Time,
    /// It is how somebody contradicts himself: no model of the ship stands between his words.
    pub(super) is_own_word: bool,
    /// It is a mistake that was there when somebody was heard first: nobody has borne him out since, and nothing is lost where he is left out.
    pub(super) is_mistake: bool,
    pub(super) kind: Kind,
}

/// What a look gave.
#[derive(Clone, Debug, Default)]
pub(super) struct Assessment {
    /// The likeliest fault of each group, likeliest first.
    pub(super) charges: Vec<Charge>,
    /// Logarithm of the weight of everything together.
    pub(super) total: f64,
    /// Whether the claims are to cover what may be.
    pub(super) is_covered: bool,
    /// Whether somebody is likely to lie.
    pub(super) is_likely: bool,
}

impl Charge {
    /// How likely it must be to be taken for so, as a logarithm.
    pub(super) fn needed(&self) -> f64 {
        if self.is_mistake { LIKELY } else { DOUBT }
    }

    pub(super) fn party(&self) -> Party {
        self.fault.party()
    }

    /// Whether a mistake of the installation is nearly as likely, or likelier: an antenna that sits elsewhere makes a receiver
    /// creep away in a turn, or gyros count it wrongly.
    pub(super) fn may_be_a_mistake(&self, mistake: f64) -> bool {
        matches!(self.party(), Party::Gnss | Party::Imu) && self.evidence < mistake + CERTAIN
    }

    /// Somebody is wrong in whatever way.
    pub(super) fn shapeless(whom: Party, weight: f64) -> Self {
        let fault = match whom {
            Party::Imu => Fault::ImuUseless,
            Party::Gnss => Fault::GnssNoise,
            Party::Gnss2 | Party::Gnss3 => Fault::SpareNoise,
            Party::Log => Fault::LogNoise,
            Party::Heading => Fault::HeadingNoise,
            Party::Reference => Fault::ReferenceNoise,
            Party::Antennas => Fault::AntennasNoise,
            Party::Docking => Fault::DockingNoise,
        };
        let (evidence, begun, is_own_word) = (0.0, Time::START, false);
        let (is_mistake, kind) = (false, Kind::Shapeless);
        Charge { fault, weight, evidence, begun, is_own_word, is_mistake, kind }
    }

    /// What it explains of the normalised squares, where that can be said.
    pub(super) fn explained(&self) -> Option<f64> {
        match self.kind {
            Kind::Shaped { sized, .. } => Some(sized.explained),
            Kind::Shapeless => None,
        }
    }

    /// How large it is, in the unit of its group; zero where it has no shape.
    pub(super) fn size(&self) -> f64 {
        match self.kind {
            Kind::Shaped { sized, .. } => sized.value.norm(),
            Kind::Shapeless => 0.0,
        }
    }

    /// Whether it is of antennas that are moved, or of a docking aid that meets something else, which happens so much more often than anything else that explains
    /// as much that being likelier is enough.
    pub(super) fn is_sudden(&self) -> bool {
        let is_it = matches!(
            self.fault,
            Fault::AntennasOffset | Fault::DockingJump(_) | Fault::DockingMark(_)
        );
        is_it && self.kind != Kind::Shapeless
    }

    pub(super) fn is_false_turn(&self) -> bool {
        matches!(self.kind, Kind::Shaped { group: OF_FALSE_TURNS, .. })
    }

    pub(super) fn is_false_push(&self) -> bool {
        matches!(self.kind, Kind::Shaped { group: OF_FALSE_PUSHES, .. })
    }

    pub(super) fn is_far(&self) -> bool {
        let Kind::Shaped { sized, .. } = self.kind else { return false };
        self.fault == Fault::Jump && sized.value.xy().norm() > FAR
    }

    pub(super) fn is_leap(&self) -> bool {
        let Kind::Shaped { sized, .. } = self.kind else { return false };
        match self.fault {
            Fault::Jump => sized.value.z.abs() > LEAP,
            Fault::Height => sized.value.x.abs() > LEAP,
            _ => false,
        }
    }

    /// Since when, as far as is known.
    pub(super) fn since(&self, now: Time) -> Time {
        match self.kind {
            Kind::Shaped { since, .. } => since,
            Kind::Shapeless => now,
        }
    }

    /// By how much a receiver is found to be late, s.
    pub(super) fn lateness(&self) -> Option<f64> {
        match self.kind {
            Kind::Shaped { sized, .. } if self.fault == Fault::Delay => Some(sized.value.x),
            _ => None,
        }
    }

    /// What a receiver is off by after such an age, s: m, and how fast that grows, m/s; of a log with another gain what that is.
    pub(super) fn lie_of_gnss(&self, age: f64) -> (Vector2<f64>, f64) {
        let Kind::Shaped { sized, .. } = self.kind else { return NO_LIE };
        let value = Vector2::new(sized.value.x, sized.value.y);
        match self.fault {
            Fault::AntennasOffset
            | Fault::DockingJump(_)
            | Fault::DockingMark(_)
            | Fault::LogGain => return (value, 0.0),
            Fault::AntennasDrift | Fault::DockingDrift(_) => return (value * age, value.x.abs()),
            _ => {}
        }
        growth(self.fault, age).map_or(NO_LIE, |(size, rate)| (value * size, value.norm() * rate))
    }
}
