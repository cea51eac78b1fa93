//! What is told of a ship that goes alongside.

use insd_base::{Estimate, Time};

/// Which part of the ship.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum HullPart {
    /// Where her side begins forward.
    Bow,
    /// Where it ends aft.
    Stern,
    /// Where she takes and gives her cargo; of a first contact: between bow and stern.
    Manifold,
}

impl HullPart {
    /// All of them, in the order in which they are told.
    pub const ALL: [HullPart; 3] = [HullPart::Bow, HullPart::Stern, HullPart::Manifold];

    /// The word for it.
    #[must_use]
    pub fn as_str(self) -> &'static str {
        match self {
            HullPart::Bow => "bow",
            HullPart::Stern => "stern",
            HullPart::Manifold => "manifold",
        }
    }
}

/// How far what is told may be relied on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum DockingState {
    /// Nothing speaks against it.
    Valid,
    /// It is told, and something speaks against it.
    Doubtful(DockingDoubt),
    /// Nothing is told.
    NotValid(NotDocking),
}

/// What speaks against it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum DockingDoubt {
    /// It rests on a receiver that was found to lie and is on trial.
    Unproven,
    /// The protection level of a distance is beyond the limit that is set.
    Level,
}

/// Why nothing is told.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum NotDocking {
    /// There is no solution, or it is no number.
    NoSolution,
    /// The heading is not known yet, or nobody but receivers and compass tells it.
    NotNavigating,
    /// The solution must not be used.
    Fault,
    /// The sensors contradict each other, and it is not known who is wrong.
    Contradiction,
    /// The ship is too far from the quay for a plane to do.
    Away,
    /// The whole ship is on the land side of the quay.
    Ashore,
    /// The whole ship is behind the line, but beyond its ends.
    Behind,
}

impl DockingState {
    /// Its word: `valid`, `doubtful`, `not_valid`.
    #[must_use]
    pub fn as_str(self) -> &'static str {
        match self {
            DockingState::Valid => "valid",
            DockingState::Doubtful(_) => "doubtful",
            DockingState::NotValid(_) => "not_valid",
        }
    }

    /// What is wrong, in words.
    #[must_use]
    pub fn why(self) -> Option<&'static str> {
        Some(match self {
            DockingState::Valid => return None,
            DockingState::Doubtful(DockingDoubt::Unproven) => {
                "a receiver is used that was found to lie"
            }
            DockingState::Doubtful(DockingDoubt::Level) => {
                "the error may exceed the limit that is set"
            }
            DockingState::NotValid(why) => match why {
                NotDocking::NoSolution => "no solution",
                NotDocking::NotNavigating => "the heading is not known yet",
                NotDocking::Fault => "fault: the solution must not be used",
                NotDocking::Contradiction => "the sensors contradict each other",
                NotDocking::Away => "too far from the berth",
                NotDocking::Ashore => "the ship is on the land side of the quay line",
                NotDocking::Behind => "the ship is behind the quay line, beyond its ends",
            },
        })
    }
}

/// Which side of her lies to the quay.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum DockingSide {
    /// Port.
    Port,
    /// Starboard.
    Starboard,
}

impl DockingSide {
    /// The word for it.
    #[must_use]
    pub fn as_str(self) -> &'static str {
        match self {
            DockingSide::Port => "port",
            DockingSide::Starboard => "starboard",
        }
    }
}

/// How one part of the ship stands to the quay; all sigmas are 1-sigma.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DockingPoint {
    /// From the hull to the fenders, m, across the quay; negative beyond them.
    pub distance: Estimate,
    /// Protection level of the distance, m: the error is below it but for the risk.
    pub level: f64,
    /// Speed towards the fenders, m/s.
    pub closing: Estimate,
    /// Speed along the quay, m/s, positive ahead as she lies.
    pub along: Estimate,
    /// Where it is along the quay, m from the first point of the line.
    pub place: f64,
    /// Height above the edge of the quay, m, where that of the quay is known.
    pub above: Option<Estimate>,
}

/// The first contact, if she goes on as she goes now.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact {
    /// What touches first.
    pub part: HullPart,
    /// Its speed towards the fenders, m/s.
    pub speed: Estimate,
    /// Until then, s.
    pub seconds: Estimate,
}

/// How the berth came to be the one that is told of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum BerthChoice {
    /// By somebody.
    Chosen,
    /// It is the nearest.
    Nearest,
}

impl BerthChoice {
    /// The word for it.
    #[must_use]
    pub fn as_str(self) -> &'static str {
        match self {
            BerthChoice::Chosen => "chosen",
            BerthChoice::Nearest => "nearest",
        }
    }
}

/// How the ship stands to a berth at an instant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Docking {
    /// Time of validity.
    pub time: Time,
    /// The berth, by its place in the configuration.
    pub berth: usize,
    /// How it came to be this one.
    pub choice: BerthChoice,
    /// How far all this may be relied on.
    pub state: DockingState,
    /// Bow, stern and manifold in the order of [`HullPart::ALL`]; none of those that she has not, and none at all where the
    /// state is not valid.
    pub points: [Option<DockingPoint>; 3],
    /// Which side of her lies to the quay.
    pub side: Option<DockingSide>,
    /// Angle between her and the quay, rad, -pi/2 to pi/2, positive with the bow nearer to it.
    pub angle: Option<Estimate>,
    /// The first contact; `None` where she does not come surely nearer.
    pub contact: Option<Contact>,
}

impl Docking {
    /// A berth of which nothing else can be told.
    #[must_use]
    pub fn not_valid(time: Time, (berth, choice): (usize, BerthChoice), why: NotDocking) -> Self {
        let state = DockingState::NotValid(why);
        Docking {
            time,
            berth,
            choice,
            state,
            points: [None; 3],
            side: None,
            angle: None,
            contact: None,
        }
    }

    /// How a part stands to the quay.
    #[must_use]
    pub fn point(&self, part: HullPart) -> Option<&DockingPoint> {
        let index = HullPart::ALL.iter().position(|own| *own == part)?;
        self.points.get(index)?.as_ref()
    }

    /// The least of the distances, m.
    #[must_use]
    pub fn nearest(&self) -> Option<&DockingPoint> {
        let all = self.points.iter().flatten();
        all.min_by(|one, other| one.distance.value.total_cmp(&other.distance.value))
    }
}
