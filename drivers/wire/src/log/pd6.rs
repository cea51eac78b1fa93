//! PD6: the text of Teledyne RDI's Doppler logs, and of others that imitate them.
//!
//! ```text
//! :SA,+PP.PP,+RR.RR,HHH.HH                     pitch, roll, heading, deg
//! :TS,YYMMDDHHmmsshh,SS.S,+TT.T,DDDD.D,CCCC.C,BBB
//!                                              clock, salinity ppt, deg C, depth m, sound m/s, test
//! :BI,+XXXXX,+YYYYY,+ZZZZZ,+EEEEE,S            instrument: x, y, z, error, mm/s
//! :BS,+TTTTT,+LLLLL,+NNNNN,S                   ship: to starboard, forward, up, mm/s
//! :BE,+EEEEE,+NNNNN,+UUUUU,S                   earth: east, north, up, mm/s
//! :BD,+EEEEEEEE.EE,+NNNNNNNN.NN,+UUUUUUUU.UU,DDDD.DD,TTT.TT
//!                                              distance made good m, range m, time since good s
//! ```
//!
//! `B` is over the bottom, `W` (`:WI :WS :WE :WD`) through a layer of water. Each line ends with CR LF.
//! Numbers may have a sign and be padded with blanks or zeros. Velocities are those of the ship with
//! respect to bottom or water (PD0 is the other way round). S is A when the velocity is good; V, or I
//! in an imitation, when it is bad, and then it is left out, whatever the numbers. -32768 is bad too.
//!
//! There is no checksum: [`look`] takes a line only if it has the fields of its kind and each is in its
//! range. Lines of other kinds (`:RA` of PD13, `:HM`) are taken by their shape alone. The clock is set
//! by hand, so that readings have no UTC.
//!
//! Sources: Teledyne RDI WorkHorse H-ADCP Operation Manual (May 2015), table 49, and Pathfinder DVL
//! Guide (April 2018), table 50. Not in them: -32768; the built-in test is read as hexadecimal.

use insd_base::units::{DEG, wrap_two_pi};
use insd_base::{LogReference, UtcTime};

use super::{LogFrame, LogReading};
use crate::binary::{BinaryFault, scaled};
use crate::stream::Look;

/// Longest line that is taken, bytes without its end.
const LONGEST: usize = 128;
/// Greatest magnitude of a velocity, mm/s.
const FASTEST: f64 = 32_767.0;
/// A velocity that is not known.
const BAD: f64 = -32_768.0;

/// One line.
#[derive(Clone, Debug, PartialEq)]
pub enum Pd6 {
    /// `:SA`.
    Attitude {
        /// Pitch, rad.
        pitch: f64,
        /// Roll, rad.
        roll: f64,
        /// Heading, rad in [0, 2 pi).
        heading: f64,
    },
    /// `:TS`.
    Scaling {
        /// The instrument's clock, taken as UTC; years are 1980 to 2079.
        clock: Option<UtcTime>,
        /// Salinity, parts per thousand.
        salinity: f64,
        /// Temperature, deg C.
        temperature: f64,
        /// Depth of the transducer, m.
        depth: f64,
        /// Speed of sound, m/s.
        sound: f64,
        /// Result of the built-in test; zero when all is well.
        self_test: u16,
    },
    /// `:BI :BS :BE :WI :WS :WE`.
    Velocity {
        /// `B` or `W`.
        reference: LogReference,
        /// `I`, `S` or `E`.
        frame: LogFrame,
        /// x, y, z, error; or starboard, forward, up; or east, north, up; m/s.
        velocity: [Option<f64>; 4],
    },
    /// `:BD :WD`.
    Distance {
        /// `B` or `W`.
        reference: LogReference,
        /// Distance made good east, north, up, m.
        made_good: [f64; 3],
        /// Range to the bottom or to the middle of the water layer, m.
        range: f64,
        /// Time since the last good velocity, s.
        age: f64,
    },
    /// Any other line.
    Other(String),
}

/// What stands at the start of some bytes: a line with its CR LF.
#[must_use]
pub fn look(bytes: &[u8]) -> Look {
    for (at, byte) in bytes.iter().take(LONGEST + 2).enumerate() {
        let fits = match at {
            0 => *byte == b':',
            1 | 2 => byte.is_ascii_uppercase(),
            3 => *byte == b',',
            _ if *byte == b'\r' => return line_end(bytes, at),
            _ => matches!(byte, b' '..=b'~') && !matches!(byte, b':' | b'$'),
        };
        if !fits || at >= LONGEST {
            return Look::Nothing;
        }
    }
    Look::More(bytes.len() + 1)
}

fn line_end(bytes: &[u8], at: usize) -> Look {
    match bytes.get(at + 1) {
        None => Look::More(at + 2),
        Some(b'\n') => {
            let line = bytes.get(..at).and_then(|line| std::str::from_utf8(line).ok());
            match line.map(Pd6::parse) {
                Some(Ok(_)) => Look::Frame(at + 2),
                _ => Look::Damaged,
            }
        }
        Some(_) => Look::Nothing,
    }
}

impl Pd6 {
    /// Reads a line with its CR LF.
    ///
    /// # Errors
    /// [`BinaryFault::Frame`] if it is not a line, [`BinaryFault::Range`] if a field is missing or out of its range.
    pub fn read(frame: &[u8]) -> Result<Self, BinaryFault> {
        let text = std::str::from_utf8(frame).map_err(|_| BinaryFault::Frame)?;
        let line = text.strip_suffix("\r\n").ok_or(BinaryFault::Frame)?;
        if line.len() > LONGEST || line.contains(|c: char| c.is_control()) {
            return Err(BinaryFault::Frame);
        }
        Pd6::parse(line)
    }

    fn parse(line: &str) -> Result<Self, BinaryFault> {
        let text = line.strip_prefix(':').ok_or(BinaryFault::Frame)?;
        let (id, rest) = text.split_once(',').ok_or(BinaryFault::Frame)?;
        let fields: Vec<&str> = rest.split(',').map(str::trim).collect();
        let reference = match id.as_bytes().first() {
            Some(b'B') => LogReference::Bottom,
            _ => LogReference::Water,
        };
        match id {
            "SA" => attitude(&fields),
            "TS" => scaling(&fields),
            "BI" | "WI" => velocity(&fields, reference, LogFrame::Instrument),
            "BS" | "WS" => velocity(&fields, reference, LogFrame::Ship),
            "BE" | "WE" => velocity(&fields, reference, LogFrame::Earth),
            "BD" | "WD" => distance(&fields, reference),
            _ => Ok(Pd6::Other(text.to_owned())),
        }
    }

    /// Writes the line with its CR LF.
    #[must_use]
    pub fn write(&self) -> Vec<u8> {
        let text = match self {
            Pd6::Attitude { pitch, roll, heading } => {
                let heading = scaled(wrap_two_pi(*heading), 0.01 * DEG).rem_euclid(36_000);
                let heading = heading as f64 * 0.01;
                format!("SA,{:+06.2},{:+06.2},{heading:06.2}", pitch / DEG, roll / DEG)
            }
            Pd6::Scaling { clock, salinity, temperature, depth, sound, self_test } => {
                let clock = clock.map_or_else(|| "0".repeat(14), clock_text);
                format!(
                    "TS,{clock},{salinity:04.1},{temperature:+05.1},{depth:06.1},{sound:06.1},\
                     {self_test:03X}"
                )
            }
            Pd6::Velocity { reference, frame, velocity } => {
                velocity_text(*reference, *frame, *velocity)
            }
            Pd6::Distance { reference, made_good: [east, north, up], range, age } => format!(
                "{}D,{east:+012.2},{north:+012.2},{up:+012.2},{range:07.2},{age:06.2}",
                letter(*reference)
            ),
            Pd6::Other(text) => text.chars().filter(|c| (' '..='~').contains(c)).collect(),
        };
        format!(":{text}\r\n").into_bytes()
    }

    /// Velocity of the ship; `None` for other lines, and if not one component is good.
    #[must_use]
    pub fn reading(&self) -> Option<LogReading> {
        let Pd6::Velocity { reference, frame, velocity: [a, b, c, _] } = self else { return None };
        let velocity = match frame {
            LogFrame::Ship => [*b, *a, c.map(|up| -up), None],
            _ => [*a, *b, *c, None],
        };
        let (frame, reference) = (*frame, *reference);
        let some = velocity.iter().any(Option::is_some);
        some.then_some(LogReading { velocity, frame, reference, std: None, utc: None, age: None })
    }
}

fn attitude(fields: &[&str]) -> Result<Pd6, BinaryFault> {
    let &[pitch, roll, heading] = fields else { return Err(wrong("fields of SA")) };
    Ok(Pd6::Attitude {
        pitch: number(pitch, 90.0, "pitch")? * DEG,
        roll: number(roll, 180.0, "roll")? * DEG,
        heading: wrap_two_pi(number(heading, 360.0, "heading")? * DEG),
    })
}

fn scaling(fields: &[&str]) -> Result<Pd6, BinaryFault> {
    let &[clock, salinity, temperature, depth, sound, self_test] = fields else {
        return Err(wrong("fields of TS"));
    };
    if clock.len() != 14 || !clock.bytes().all(|byte| byte.is_ascii_digit()) {
        return Err(wrong("clock"));
    }
    Ok(Pd6::Scaling {
        clock: clock_of(clock),
        salinity: number(salinity, 100.0, "salinity")?,
        temperature: number(temperature, 100.0, "temperature")?,
        depth: number(depth, 10_000.0, "depth")?,
        sound: number(sound, 3000.0, "speed of sound")?,
        self_test: u16::from_str_radix(self_test, 16).map_err(|_| wrong("built-in test"))?,
    })
}

fn velocity(fields: &[&str], reference: LogReference, frame: LogFrame) -> Result<Pd6, BinaryFault> {
    let count = if frame == LogFrame::Instrument { 4 } else { 3 };
    let (status, components) = fields.split_last().ok_or(wrong("status"))?;
    if components.len() != count {
        return Err(wrong("fields of a velocity"));
    }
    let good = match *status {
        "A" => true,
        "V" | "I" => false,
        _ => return Err(wrong("status")),
    };
    let mut velocity = [None; 4];
    for (value, component) in velocity.iter_mut().zip(components) {
        // five digits stand in a field; what is bad may hold any
        let count = number(component, 99_999.0, "velocity")?;
        if good && count != BAD {
            let in_range = count.abs() <= FASTEST;
            *value = Some(in_range.then_some(count * 1e-3).ok_or(wrong("velocity"))?);
        }
    }
    Ok(Pd6::Velocity { reference, frame, velocity })
}

fn distance(fields: &[&str], reference: LogReference) -> Result<Pd6, BinaryFault> {
    let &[east, north, up, range, age] = fields else { return Err(wrong("fields of BD")) };
    let metres = |text| number(text, 1e8, "distance");
    Ok(Pd6::Distance {
        reference,
        made_good: [metres(east)?, metres(north)?, metres(up)?],
        range: number(range, 1e5, "range")?,
        age: number(age, 1e5, "time since good")?,
    })
}

fn wrong(field: &'static str) -> BinaryFault {
    BinaryFault::Range { field }
}

/// Digits with sign and point, at most `limit` in magnitude.
fn number(text: &str, limit: f64, field: &'static str) -> Result<f64, BinaryFault> {
    let plain = text.bytes().all(|byte| matches!(byte, b'0'..=b'9' | b'+' | b'-' | b'.'));
    let value = text.parse::<f64>().ok().filter(|value| plain && value.abs() <= limit);
    value.ok_or(BinaryFault::Range { field })
}

fn letter(reference: LogReference) -> char {
    match reference {
        LogReference::Bottom => 'B',
        LogReference::Water => 'W',
    }
}

/// Good only if all components of the frame but the error are known.
fn velocity_text(reference: LogReference, frame: LogFrame, velocity: [Option<f64>; 4]) -> String {
    let (kind, count) = match frame {
        LogFrame::Ship => ('S', 3),
        LogFrame::Earth => ('E', 3),
        LogFrame::Instrument | LogFrame::Beam => ('I', 4),
    };
    let known = velocity.map(|component| component.filter(|value| value.is_finite()));
    let mut text = format!("{}{kind}", letter(reference));
    for component in known.iter().take(count) {
        let count = component.map_or(BAD, |value| (value * 1e3).clamp(-FASTEST, FASTEST));
        text += &format!(",{:+06}", count.round() as i32);
    }
    let good = known.iter().take(3).all(Option::is_some);
    text + if good { ",A" } else { ",V" }
}

fn clock_of(digits: &str) -> Option<UtcTime> {
    let mut parts = [0; 7];
    for (part, at) in parts.iter_mut().zip((0..14).step_by(2)) {
        *part = digits.get(at..at + 2)?.parse().ok()?;
    }
    let [year, month, day, hour, minute, second, hundredth] = parts;
    let century = if year < 80 { 2000 } else { 1900 };
    let nanosecond = u32::from(hundredth) * 10_000_000;
    UtcTime::from_civil((century + i32::from(year), month, day), (hour, minute, second), nanosecond)
}

fn clock_text(clock: UtcTime) -> String {
    let ((year, month, day), nanos) = clock.to_civil();
    let hundredths = nanos / 10_000_000;
    let (second, minute) = (hundredths / 100 % 60, hundredths / 6_000 % 60);
    let hour = hundredths / 360_000;
    let year = year.rem_euclid(100);
    format!("{year:02}{month:02}{day:02}{hour:02}{minute:02}{second:02}{:02}", hundredths % 100)
}
