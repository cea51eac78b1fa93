//! PIXSE: the set of sentences of a Phins ("PHINS STANDARD").
//!
//! ```text
//! $PIXSE,ATITUD,x.xxx,y.yyy*hh           roll, pitch, deg
//! $PIXSE,POSITI,x.xxxxxxxx,y.yyyyyyyy,z.zzz*hh  latitude, longitude in [0, 360), deg; altitude, m
//! $PIXSE,SPEED_,x.xxx,y.yyy,z.zzz*hh     speed to the east, to the north, upward, m/s
//! $PIXSE,UTMWGS,c,nn,x.xxx,y.yyy,z.zzz*hh  letter of the band, zone, easting, northing, altitude, m
//! $PIXSE,HEAVE_,x.xxx,y.yyy,z.zzz*hh     surge, sway, heave, m
//! $PIXSE,TIME__,hhmmss.ssssss*hh         UTC, or the unit's own time
//! $PIXSE,STDHRP,x.xxx,y.yyy,z.zzz*hh     1-sigma of heading, roll, pitch, deg
//! $PIXSE,STDPOS,x.xx,y.yy,z.zz*hh        1-sigma of latitude, longitude, altitude, m
//! $PIXSE,STDSPD,x.xxx,y.yyy,z.zzz*hh     1-sigma of the speed to the east, to the north, upward, m/s
//! $PIXSE,ALGSTS,hhhhhhhh,llllllll*hh     status of the filter, low half first
//! $PIXSE,STATUS,hhhhhhhh,llllllll*hh     status of the system, low half first
//! $PIXSE,HT_STS,hhhhhhhh*hh              status in short
//! ```
//! The heading is the `HEHDT` that a unit sends before them. Receivers want the complete set, in the order
//! in which a unit sends it: HEHDT, ATITUD, POSITI, SPEED_, UTMWGS, HEAVE_, TIME__, STDHRP, STDPOS, STDSPD,
//! ALGSTS, STATUS, HT_STS (record in rock-drivers; page of the Qinsy driver).
//!
//! Signs: roll is positive with port up (comment in `ds_msgs`), pitch with the bow **down**. No document
//! that could be read states that of pitch; it follows from the published record of a vehicle that climbs
//! at 15.8 deg while its ATITUD says -15.7 (test `the_pitch_of_a_climbing_vehicle_is_up`), and is the
//! maker's convention in PHOCT. Sway to **port** and heave up are the maker's axes, as in PHLIN; in HEAVE_
//! they are not verified.
//!
//! Layouts from `ds_msgs`, rock-drivers and others who quote the maker's manual, verified against records
//! of four units, to the byte.

mod status;

use insd_base::units::wrap_pi;
use insd_base::utm::Utm;

pub use status::{PixseAlgorithmStatus, PixseHighLevelStatus, PixseSystemStatus};

use super::civil::TimeOfDay;
use super::decimal::Form;
use super::fault::NmeaFault;
use super::fields::Fields;
use super::frame::Frame;
use super::line::{Composer, NmeaLine};
use super::parts::{degrees, negated, read_degrees, read_within, read_word, word};
use super::position::Position;

const ROLL: Form = Form { decimals: 3, width: 1, limit: 180.0 };
const PITCH: Form = Form { decimals: 3, width: 1, limit: 90.0 };
/// Degrees of latitude and longitude: 1 mm.
const PLACE: Form = Form { decimals: 8, width: 1, limit: 90.0 };
const GRID: Form = Form { decimals: 3, width: 1, limit: 10_000_000.0 };
const ALTITUDE: Form = Form { decimals: 3, width: 1, limit: 99_999.0 };
const SPEED: Form = Form { decimals: 3, width: 1, limit: 999.999 };
const MOTION: Form = Form { decimals: 3, width: 1, limit: 999.999 };
const SIGMA: Form = Form { decimals: 3, width: 1, limit: 999.999 };
const SIGMA_PLACE: Form = Form { decimals: 2, width: 1, limit: 9_999_999.0 };

/// One of the PIXSE sentences.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Pixse {
    /// ATITUD.
    Attitude {
        /// Roll, rad, starboard down positive.
        roll: Option<f64>,
        /// Pitch, rad, **bow up** positive; the sentence has it the other way.
        pitch: Option<f64>,
    },
    /// POSITI.
    Position {
        /// Latitude and longitude.
        position: Option<Position>,
        /// Altitude, m, up positive, above what the unit is set to.
        altitude: Option<f64>,
    },
    /// SPEED_.
    Velocity {
        /// To the north, m/s.
        north: Option<f64>,
        /// To the east, m/s.
        east: Option<f64>,
        /// **Downward**, m/s; the sentence has it the other way.
        down: Option<f64>,
    },
    /// UTMWGS.
    Grid {
        /// Grid position; unknown beyond 84 deg N and 80 deg S.
        utm: Option<Utm>,
        /// Altitude, m, up positive.
        altitude: Option<f64>,
    },
    /// HEAVE_.
    Motion {
        /// Surge, m, forward positive.
        surge: Option<f64>,
        /// Sway, m, to **starboard** positive; the sentence has it the other way.
        sway: Option<f64>,
        /// Heave, m, up positive.
        heave: Option<f64>,
    },
    /// TIME__.
    Time(Option<TimeOfDay>),
    /// STDHRP: 1-sigma, rad.
    AttitudeSigma {
        /// Of the heading.
        heading: Option<f64>,
        /// Of the roll.
        roll: Option<f64>,
        /// Of the pitch.
        pitch: Option<f64>,
    },
    /// STDPOS: 1-sigma, m.
    PositionSigma {
        /// To the north.
        north: Option<f64>,
        /// To the east.
        east: Option<f64>,
        /// Of the altitude.
        altitude: Option<f64>,
    },
    /// STDSPD: 1-sigma, m/s.
    VelocitySigma {
        /// To the north.
        north: Option<f64>,
        /// To the east.
        east: Option<f64>,
        /// Downward.
        down: Option<f64>,
    },
    /// ALGSTS.
    Algorithm(Option<PixseAlgorithmStatus>),
    /// STATUS.
    System(Option<PixseSystemStatus>),
    /// HT_STS.
    HighLevel(Option<PixseHighLevelStatus>),
}

impl Pixse {
    /// All before the first comma.
    pub const ADDRESS: &'static str = "PIXSE";

    /// Greatest length of any of them, bytes with CR LF; see [`Pixse::longest`].
    pub const LONGEST: usize = 57;

    /// Greatest length of a sentence of this kind, bytes with CR LF: within 10 km of sea level, for less
    /// than 100 m/s and less than 100 m of motion, and a 1-sigma of less than 1000 km.
    #[must_use]
    pub const fn longest(&self) -> usize {
        match self {
            Pixse::Attitude { .. } => 35,
            Pixse::Position { .. } => 54,
            Pixse::Grid { .. } => 57,
            Pixse::Velocity { .. } | Pixse::Motion { .. } => 42,
            Pixse::Time(_) => 32,
            Pixse::AttitudeSigma { .. } => 42,
            Pixse::PositionSigma { .. } => 48,
            Pixse::VelocitySigma { .. } => 39,
            Pixse::Algorithm(_) | Pixse::System(_) => 36,
            Pixse::HighLevel(_) => 27,
        }
    }

    /// The word after the address.
    #[must_use]
    pub const fn name(&self) -> &'static str {
        match self {
            Pixse::Attitude { .. } => "ATITUD",
            Pixse::Position { .. } => "POSITI",
            Pixse::Velocity { .. } => "SPEED_",
            Pixse::Grid { .. } => "UTMWGS",
            Pixse::Motion { .. } => "HEAVE_",
            Pixse::Time(_) => "TIME__",
            Pixse::AttitudeSigma { .. } => "STDHRP",
            Pixse::PositionSigma { .. } => "STDPOS",
            Pixse::VelocitySigma { .. } => "STDSPD",
            Pixse::Algorithm(_) => "ALGSTS",
            Pixse::System(_) => "STATUS",
            Pixse::HighLevel(_) => "HT_STS",
        }
    }

    /// Writes the sentence: angles to 0.001 deg, latitude and longitude to 1e-8 deg, lengths and speeds to
    /// 1 mm and 1 mm/s, sigmas of the position to 1 cm, time truncated to 1 us.
    #[must_use]
    pub fn write(&self) -> NmeaLine {
        NmeaLine::compose_own(Self::ADDRESS, |line| {
            line.text(self.name());
            self.write_fields(line);
        })
    }

    fn write_fields(&self, line: &mut Composer) {
        match *self {
            Pixse::Attitude { roll, pitch } => {
                degrees(line, roll, ROLL);
                degrees(line, negated(pitch), PITCH);
            }
            Pixse::Position { position, altitude } => {
                place(line, position);
                line.number(altitude, ALTITUDE);
            }
            Pixse::Velocity { north, east, down } => {
                numbers(line, [east, north, negated(down)], SPEED);
            }
            Pixse::Grid { utm, altitude } => {
                grid(line, utm);
                line.number(altitude, ALTITUDE);
            }
            Pixse::Motion { surge, sway, heave } => {
                numbers(line, [surge, negated(sway), heave], MOTION);
            }
            Pixse::Time(time) => line.time_of_day_to(time, 6),
            Pixse::AttitudeSigma { heading, roll, pitch } => {
                sigmas(line, [heading, roll, pitch].map(|sigma| sigma.map(f64::to_degrees)), SIGMA);
            }
            Pixse::PositionSigma { north, east, altitude } => {
                sigmas(line, [north, east, altitude], SIGMA_PLACE);
            }
            Pixse::VelocitySigma { north, east, down } => sigmas(line, [east, north, down], SIGMA),
            Pixse::Algorithm(status) => halves(line, status.map(|status| status.0)),
            Pixse::System(status) => halves(line, status.map(|status| status.0)),
            Pixse::HighLevel(status) => word(line, status.map(|status| status.0)),
        }
    }

    /// Reads the sentence.
    ///
    /// # Errors
    /// The first [`NmeaFault`] of its fields; [`NmeaFault::OtherSentence`] for words that are not in the list.
    pub fn read(frame: &Frame<'_>) -> Result<Self, NmeaFault> {
        let mut fields = frame.fields_of_own(Self::ADDRESS)?;
        let name = fields.text()?;
        read_state(name, &mut fields)
            .or_else(|| read_sigma_or_status(name, &mut fields))
            .unwrap_or(Err(NmeaFault::OtherSentence))
    }
}

/// The sentences that say where the unit is and how it moves; `None` for others.
fn read_state(name: &str, fields: &mut Fields<'_>) -> Option<Result<Pixse, NmeaFault>> {
    Some(match name {
        "ATITUD" => read_attitude(fields),
        "POSITI" => read_position(fields),
        "SPEED_" => three(fields, SPEED).map(|[east, north, up]| Pixse::Velocity {
            north,
            east,
            down: negated(up),
        }),
        "UTMWGS" => read_grid(fields),
        "HEAVE_" => three(fields, MOTION).map(|[surge, sway, heave]| Pixse::Motion {
            surge,
            sway: negated(sway),
            heave,
        }),
        "TIME__" => fields.time_of_day().map(Pixse::Time),
        _ => return None,
    })
}

/// The others.
fn read_sigma_or_status(name: &str, fields: &mut Fields<'_>) -> Option<Result<Pixse, NmeaFault>> {
    Some(match name {
        "STDHRP" => three_sigmas(fields, SIGMA).map(|sigmas| {
            let [heading, roll, pitch] = sigmas.map(|sigma| sigma.map(f64::to_radians));
            Pixse::AttitudeSigma { heading, roll, pitch }
        }),
        "STDPOS" => three_sigmas(fields, SIGMA_PLACE)
            .map(|[north, east, altitude]| Pixse::PositionSigma { north, east, altitude }),
        "STDSPD" => three_sigmas(fields, SIGMA).map(|[east, north, down]| Pixse::VelocitySigma {
            north,
            east,
            down,
        }),
        "ALGSTS" => {
            read_halves(fields).map(|status| Pixse::Algorithm(status.map(PixseAlgorithmStatus)))
        }
        "STATUS" => read_halves(fields).map(|status| Pixse::System(status.map(PixseSystemStatus))),
        "HT_STS" => {
            read_word(fields).map(|status| Pixse::HighLevel(status.map(PixseHighLevelStatus)))
        }
        _ => return None,
    })
}

fn numbers(line: &mut Composer, values: [Option<f64>; 3], form: Form) {
    values.into_iter().for_each(|value| line.number(value, form));
}

fn sigmas(line: &mut Composer, values: [Option<f64>; 3], form: Form) {
    values.into_iter().for_each(|value| line.magnitude(value, form));
}

fn place(line: &mut Composer, position: Option<Position>) {
    let good = |place: &Position| {
        place.latitude.to_degrees().abs() <= PLACE.limit && place.longitude.is_finite()
    };
    match position.filter(good) {
        Some(position) => {
            degrees(line, Some(position.latitude), PLACE);
            line.degrees(Some(wrap_pi(position.longitude)), PLACE.decimals);
        }
        None => (0..2).for_each(|_| line.empty()),
    }
}

fn grid(line: &mut Composer, utm: Option<Utm>) {
    let good = |utm: &Utm| {
        let metres = [utm.easting, utm.northing];
        is_band(utm.band)
            && (1..=60).contains(&utm.zone)
            && metres.iter().all(|value| (0.0..=GRID.limit).contains(value))
    };
    match utm.filter(good) {
        Some(utm) => {
            line.letter(utm.band);
            line.whole(Some(utm.zone.into()), 1, 60);
            line.number(Some(utm.easting), GRID);
            line.number(Some(utm.northing), GRID);
        }
        None => (0..4).for_each(|_| line.empty()),
    }
}

/// Whether a letter is that of a band of latitude.
fn is_band(letter: u8) -> bool {
    matches!(letter, b'C'..=b'H' | b'J'..=b'N' | b'P'..=b'X')
}

/// Writes the low half and the high half of a status.
fn halves(line: &mut Composer, status: Option<u64>) {
    word(line, status.map(|status| status as u32));
    word(line, status.map(|status| (status >> 32) as u32));
}

fn three(fields: &mut Fields<'_>, form: Form) -> Result<[Option<f64>; 3], NmeaFault> {
    let mut next = || read_within(fields, form.limit);
    Ok([next()?, next()?, next()?])
}

fn three_sigmas(fields: &mut Fields<'_>, form: Form) -> Result<[Option<f64>; 3], NmeaFault> {
    let mut next = || fields.number_in(0.0..=form.limit);
    Ok([next()?, next()?, next()?])
}

fn read_attitude(fields: &mut Fields<'_>) -> Result<Pixse, NmeaFault> {
    let roll = read_degrees(fields, ROLL.limit)?;
    Ok(Pixse::Attitude { roll, pitch: negated(read_degrees(fields, PITCH.limit)?) })
}

fn read_position(fields: &mut Fields<'_>) -> Result<Pixse, NmeaFault> {
    let latitude = read_degrees(fields, PLACE.limit)?;
    let longitude = fields.number_in(-180.0..=360.0)?;
    let longitude = longitude.map(|longitude| wrap_pi(longitude.to_radians()));
    let position = match (latitude, longitude) {
        (Some(latitude), Some(longitude)) => Some(Position { latitude, longitude }),
        (None, None) => None,
        _ => return Err(fields.malformed()),
    };
    Ok(Pixse::Position { position, altitude: read_within(fields, ALTITUDE.limit)? })
}

fn read_grid(fields: &mut Fields<'_>) -> Result<Pixse, NmeaFault> {
    let band = fields.convert(|text| match text.as_bytes() {
        [letter] if is_band(*letter) => Some(*letter),
        _ => None,
    })?;
    let zone = fields.whole(60)?.filter(|zone| *zone > 0);
    let easting = fields.number_in(0.0..=GRID.limit)?;
    let northing = fields.number_in(0.0..=GRID.limit)?;
    let zone = zone.and_then(|zone| u8::try_from(zone).ok());
    let utm = match (band, zone, easting, northing) {
        (Some(band), Some(zone), Some(easting), Some(northing)) => {
            Some(Utm { zone, band, easting, northing })
        }
        (None, None, None, None) => None,
        _ => return Err(fields.malformed()),
    };
    Ok(Pixse::Grid { utm, altitude: read_within(fields, ALTITUDE.limit)? })
}

/// Reads the low half and the high half of a status; both are there or none.
fn read_halves(fields: &mut Fields<'_>) -> Result<Option<u64>, NmeaFault> {
    match (read_word(fields)?, read_word(fields)?) {
        (Some(low), Some(high)) => Ok(Some(u64::from(high) << 32 | u64::from(low))),
        (None, None) => Ok(None),
        _ => Err(fields.malformed()),
    }
}
