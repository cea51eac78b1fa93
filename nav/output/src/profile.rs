//! Ready-made ports for the usual consumers.

use crate::manner::Manner;
use crate::messages::MessageKind;
use crate::policy::Policy;
use crate::port::OutputPortConfig;
use crate::schedule::Rate;

/// A ready-made port.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Profile {
    /// Its name in the configuration.
    pub name: &'static str,
    /// What it is for.
    pub about: &'static str,
    messages: &'static [(&'static str, f64)],
    turn_damping: f64,
    estimated_is_valid: bool,
}

/// All profiles. Rates in Hz.
static PROFILES: [Profile; 12] = [
    Profile {
        name: "bridge",
        about: "the least that a bridge needs: heading, rate of turn, position, course, speed, time",
        messages: &[
            ("ZDA", 1.0),
            ("GGA", 1.0),
            ("RMC", 1.0),
            ("VTG", 1.0),
            ("HDT", 10.0),
            ("THS", 10.0),
            ("ROT", 10.0),
        ],
        turn_damping: 0.0,
        estimated_is_valid: false,
    },
    Profile {
        name: "ecdis",
        about: "chart display: position, course, speeds, heading, rate of turn, time, and that we are alive",
        messages: &[
            ("ZDA", 1.0),
            ("DTM", 0.1),
            ("GGA", 1.0),
            ("GNS", 1.0),
            ("RMC", 1.0),
            ("GBS", 1.0),
            ("VTG", 1.0),
            ("VBW", 1.0),
            ("HDT", 10.0),
            ("THS", 10.0),
            ("ROT", 10.0),
            ("HBT", 0.1),
            ("ALC", 0.033333),
            ("ALF", 1.0),
        ],
        turn_damping: 0.0,
        estimated_is_valid: false,
    },
    Profile {
        name: "autopilot",
        about: "steering: heading and rate of turn fast and damped little, speed and track slowly",
        messages: &[
            ("VTG", 2.0),
            ("VBW", 2.0),
            ("RMC", 1.0),
            ("HDT", 20.0),
            ("THS", 20.0),
            ("ROT", 20.0),
        ],
        turn_damping: 0.5,
        estimated_is_valid: false,
    },
    Profile {
        name: "radar-arpa",
        about: "radar: heading at antenna speed, speed through the water and over ground",
        messages: &[
            ("ZDA", 1.0),
            ("GLL", 1.0),
            ("GGA", 1.0),
            ("VTG", 2.0),
            ("VBW", 2.0),
            ("HDT", 40.0),
            ("THS", 40.0),
            ("ROT", 10.0),
        ],
        turn_damping: 0.0,
        estimated_is_valid: false,
    },
    Profile {
        name: "ais",
        about: "transponder: the sentences of IEC 61993-2, rate of turn by talker TI",
        messages: &[
            ("DTM", 0.1),
            ("GNS", 1.0),
            ("GLL", 1.0),
            ("GBS", 1.0),
            ("VTG", 1.0),
            ("VBW", 1.0),
            ("HDT", 5.0),
            ("THS", 5.0),
            ("ROT", 5.0),
        ],
        turn_damping: 1.0,
        estimated_is_valid: false,
    },
    Profile {
        name: "vdr",
        about: "voyage recorder: all that is shown to the bridge, each with its quality",
        messages: &[
            ("ZDA", 1.0),
            ("DTM", 0.1),
            ("GNS", 1.0),
            ("RMC", 1.0),
            ("GST", 1.0),
            ("GBS", 1.0),
            ("VTG", 1.0),
            ("VBW", 1.0),
            ("VHW", 1.0),
            ("VLW", 0.1),
            ("THS", 1.0),
            ("ROT", 1.0),
            ("HDG", 1.0),
            ("XDR", 1.0),
            ("HBT", 0.1),
            ("ALC", 0.033333),
            ("ALF", 1.0),
            ("PINSD.STA", 1.0),
            ("PINSD.SIG", 1.0),
            ("PINSD.PRO", 1.0),
        ],
        turn_damping: 0.0,
        estimated_is_valid: false,
    },
    Profile {
        name: "multibeam",
        about: "motion for an echo sounder: EM3000 at 100 Hz and nothing beside it",
        messages: &[("EM3000", 100.0)],
        turn_damping: 0.0,
        estimated_is_valid: false,
    },
    Profile {
        name: "seapath",
        about: "what follows a Seapath: PSXN with its quality, position, course, heading, time",
        messages: &[
            ("ZDA", 1.0),
            ("GGA", 1.0),
            ("GST", 1.0),
            ("VTG", 1.0),
            ("HDT", 10.0),
            ("ROT", 10.0),
            ("PSXN.20", 1.0),
            ("PSXN.23", 10.0),
            ("PSXN.24", 10.0),
        ],
        turn_damping: 0.0,
        estimated_is_valid: false,
    },
    Profile {
        name: "phins",
        about: "what follows a Phins: the whole PIXSE set behind the heading",
        messages: &[("HDT", 10.0), ("PIXSE", 10.0)],
        turn_damping: 0.0,
        estimated_is_valid: false,
    },
    Profile {
        name: "octans",
        about: "what follows an Octans: heading, PHTRO, PHLIN, PHSPD, PHCMP, PHINF",
        messages: &[
            ("HDT", 10.0),
            ("ROT", 10.0),
            ("PHTRO", 10.0),
            ("PHLIN", 10.0),
            ("PHSPD", 10.0),
            ("PHCMP", 1.0),
            ("PHINF", 10.0),
        ],
        turn_damping: 0.0,
        estimated_is_valid: false,
    },
    Profile {
        name: "signalk",
        about: "Signal K server: all it has paths for, as deltas",
        messages: &[("SIGNALK", 5.0)],
        turn_damping: 0.0,
        estimated_is_valid: false,
    },
    Profile {
        name: "gpsd",
        // neither PASHR nor GST: of the one gpsd 3.22 gives no fix, after the other no attitude that can be read
        about: "gpsd and chart programs on computers: all that they read",
        messages: &[
            ("ZDA", 1.0),
            ("GGA", 1.0),
            ("RMC", 1.0),
            ("VTG", 1.0),
            ("VHW", 1.0),
            ("HDT", 10.0),
            ("ROT", 10.0),
            ("XDR", 1.0),
            ("PTNTHTM", 10.0),
        ],
        turn_damping: 0.0,
        estimated_is_valid: true,
    },
];

impl Profile {
    /// All there are.
    pub fn all() -> impl Iterator<Item = &'static Profile> {
        PROFILES.iter()
    }

    /// The profile of a name.
    #[must_use]
    pub fn named(name: &str) -> Option<&'static Profile> {
        Self::all().find(|profile| profile.name == name)
    }

    /// Names of its messages.
    pub fn names(&self) -> impl Iterator<Item = &'static str> {
        self.messages.iter().map(|(name, _)| *name)
    }

    /// A port with it.
    #[must_use]
    pub fn port(&self) -> OutputPortConfig {
        let kind = |(name, hertz): &(&str, f64)| {
            Some((MessageKind::named(name)?, Rate::from_hertz(*hertz)))
        };
        OutputPortConfig {
            messages: self.messages.iter().filter_map(kind).collect(),
            turn_damping: self.turn_damping,
            manner: Manner {
                policy: Policy { estimated_is_valid: self.estimated_is_valid, ..Policy::default() },
                ..Manner::default()
            },
            ..OutputPortConfig::default()
        }
    }
}
