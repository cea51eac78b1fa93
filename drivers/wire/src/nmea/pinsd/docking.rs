//! BTH and DOK: how the ship stands to the quay of a berth.

use crate::nmea::civil::TimeOfDay;
use crate::nmea::kinds::{Clock, Decimal, Needed, Significant, Whole, letter};
use crate::nmea::mode::letters;
use crate::nmea::table::sentence;

const METRES: Decimal = Decimal::signed(2, 9999.99);
const PLACE: Decimal = Decimal::signed(1, 9999.9);
const SIGMA_METRES: Significant = Significant(Decimal::magnitude(2, 9999.0));
const SPEED: Decimal = Decimal::signed(3, 9.999);
const SIGMA_SPEED: Significant = Significant(Decimal::magnitude(3, 99.9));
const ANGLE: Decimal = Decimal::signed(2, 90.0).degrees();
const SIGMA_ANGLE: Significant = Significant(Decimal::magnitude(3, 180.0).degrees());
const SECONDS: Decimal = Decimal::magnitude(1, 9999.9);
const SIGMA_SECONDS: Significant = Significant(Decimal::magnitude(1, 9999.0));

/// How far what is told of a berth may be relied on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Default)]
pub enum PinsdDocking {
    /// A: nothing speaks against it.
    Valid,
    /// D: it is told, and something speaks against it.
    Doubtful,
    /// V: nothing is told.
    #[default]
    NotValid,
}

letters! {
    PinsdDocking { Valid b'A', Doubtful b'D', NotValid b'V' }
}

/// How a berth came to be the one that is told of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum PinsdChoice {
    /// C: somebody chose it.
    Chosen,
    /// N: it is the nearest.
    Nearest,
}

letters! {
    PinsdChoice { Chosen b'C', Nearest b'N' }
}

/// Which side of the ship lies to the quay.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum PinsdSide {
    /// P.
    Port,
    /// S: starboard.
    Starboard,
}

letters! {
    PinsdSide { Port b'P', Starboard b'S' }
}

/// Which part of the ship.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum PinsdPart {
    /// B.
    Bow,
    /// S: stern.
    Stern,
    /// M: where she takes and gives her cargo; of a contact: between bow and stern.
    Manifold,
}

letters! {
    PinsdPart { Bow b'B', Stern b'S', Manifold b'M' }
}

sentence! {
    /// How the ship stands to a berth.
    part PinsdBerth "PINSD" "BTH", longest 74: Default;
    /// UTC.
    1 time: Option<TimeOfDay> = Clock(2);
    /// How far all may be relied on.
    2 state: PinsdDocking = Needed(letter());
    /// The berth, by its place in the configuration, from 1; none if none is chosen or near.
    3 berth: Option<u32> = Whole::of(1, 999);
    /// How it came to be this one.
    4 choice: Option<PinsdChoice> = letter();
    /// Which side of her lies to the quay.
    5 side: Option<PinsdSide> = letter();
    /// Angle between her and the quay, rad, positive with the bow nearer.
    6 angle: Option<f64> = ANGLE;
    /// Its 1-sigma, rad.
    7 angle_sigma: Option<f64> = SIGMA_ANGLE;
    /// What touches first; none where she does not come surely nearer.
    8 first: Option<PinsdPart> = letter();
    /// How fast it then moves towards the fenders, m/s.
    9 contact_speed: Option<f64> = SPEED;
    /// Its 1-sigma, m/s.
    10 contact_speed_sigma: Option<f64> = SIGMA_SPEED;
    /// Until then, s.
    11 seconds: Option<f64> = SECONDS;
    /// 1-sigma of that, s.
    12 seconds_sigma: Option<f64> = SIGMA_SECONDS;
}

sentence! {
    /// How one part of the ship stands to the berth of the BTH before it.
    part PinsdPartOfShip "PINSD" "DOK", longest 82;
    /// UTC.
    1 time: Option<TimeOfDay> = Clock(2);
    /// Which part.
    2 part: PinsdPart = Needed(letter());
    /// How far it may be relied on.
    3 state: PinsdDocking = Needed(letter());
    /// From the hull to the face of the fenders, m, negative beyond them.
    4 distance: Option<f64> = METRES;
    /// Its 1-sigma, m.
    5 distance_sigma: Option<f64> = SIGMA_METRES;
    /// Its protection level, m.
    6 level: Option<f64> = SIGMA_METRES;
    /// Speed towards the fenders, m/s.
    7 closing: Option<f64> = SPEED;
    /// Its 1-sigma, m/s.
    8 closing_sigma: Option<f64> = SIGMA_SPEED;
    /// Speed along the quay, m/s, positive ahead as she lies.
    9 along: Option<f64> = SPEED;
    /// Its 1-sigma, m/s.
    10 along_sigma: Option<f64> = SIGMA_SPEED;
    /// Where it is along the quay, m from the first point of its line.
    11 place: Option<f64> = PLACE;
}
