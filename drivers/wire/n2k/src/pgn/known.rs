//! All groups of this module in one type, for those who take messages as they come.

use super::{
    Attitude, CourseSpeed, DistanceLog, Dops, GnssPosition, Group, Heading, Heave,
    MagneticVariation, PositionRapid, PseudorangeNoise, RateOfTurn, Row, SetDrift, Short, Speed,
    SpeedComponents, SystemTime, TimeDate,
};

macro_rules! known {
    ($($group:ident: $title:literal),* $(,)?) => {
        /// The contents of a message of one of the groups that are understood.
        #[derive(Clone, Debug, PartialEq)]
        pub enum Known {
            $(#[doc = $title]
            $group($group),)*
        }

        impl Known {
            /// The numbers of the groups that are understood, in rising order.
            pub const PGNS: &[u32] = &[$($group::PGN),*];

            /// Title and fields of each of them.
            #[must_use]
            pub fn tables() -> Vec<(&'static str, Vec<Row>)> {
                vec![$(($title, $group::rows())),*]
            }

            /// Reads the contents of a message of any group; `None` if the group is none of these.
            #[must_use]
            pub fn read(pgn: u32, data: &[u8]) -> Option<Result<Self, Short>> {
                match pgn {
                    $($group::PGN => Some($group::read(data).map(Known::$group)),)*
                    _ => None,
                }
            }

            /// The number of the group.
            #[must_use]
            pub fn pgn(&self) -> u32 {
                match self {
                    $(Known::$group(_) => $group::PGN,)*
                }
            }

            /// The priority of the group where nothing else is said.
            #[must_use]
            pub fn priority(&self) -> u8 {
                match self {
                    $(Known::$group(_) => $group::PRIORITY,)*
                }
            }

            /// The contents of a message, see [`Group::write`].
            #[must_use]
            pub fn write(&self) -> Vec<u8> {
                match self {
                    $(Known::$group(group) => group.write(),)*
                }
            }
        }

        $(impl From<$group> for Known {
            fn from(group: $group) -> Self {
                Known::$group(group)
            }
        })*
    };
}

known! {
    SystemTime: "126992 System time.",
    Heading: "127250 Vessel heading.",
    RateOfTurn: "127251 Rate of turn.",
    Heave: "127252 Heave.",
    Attitude: "127257 Attitude.",
    MagneticVariation: "127258 Magnetic variation.",
    Speed: "128259 Speed, water referenced.",
    DistanceLog: "128275 Distance log.",
    PositionRapid: "129025 Position, rapid update.",
    CourseSpeed: "129026 Course and speed over ground.",
    GnssPosition: "129029 GNSS position data.",
    TimeDate: "129033 Time and date.",
    SetDrift: "129291 Set and drift.",
    Dops: "129539 GNSS dilutions of precision.",
    PseudorangeNoise: "129542 GNSS pseudorange noise statistics.",
    SpeedComponents: "130578 Vessel speed components.",
}
