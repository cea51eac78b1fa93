//! PHOCT: attitude and motion with time, by Octans, Phins and the units that speak like them ("TAH").
//!
//! ```text
//! $PHOCT,01,hhmmss.sss,G,AA,HHH.HHH,N,eRRR.RRR,L,ePP.PPP,K,eFF.FFF,M,
//!        1  2          3 4  5       6 7        8 9       10 11     12
//!   eHH.HHH,eSS.SSS,eWW.WWW,eZZ.ZZZ,eYY.YYY,eXX.XXX,eQQQQ.QQ*hh
//!   13      14      15      16      17      18      19
//! 1      version of the layout: 01
//! 2, 3   UTC; T valid, E invalid
//! 4      latency of heading, roll and pitch, ms
//! 5, 6   heading, deg true
//! 7, 8   roll, deg, positive with port up
//! 9, 10  pitch, deg, positive with the bow **down**
//! 11     heave at the primary lever arm, m, positive **up**
//! 12     state of 11 and of 13 to 18
//! 13..15 heave (up), surge (forward), sway (to **port**) at the chosen lever arm, m
//! 16..18 rates of the same, m/s
//! 19     rate of turn, deg/min, positive to starboard
//! ```
//! States: T valid, E invalid, I initialising. Signs (`e`) are always shown, and digits are fixed; the
//! line, of 128 bytes, is longer than the standard allows.
//!
//! From the makers' manuals (INS Interface Library MU-INSIII-AN-001, as quoted by open parsers, and SBG
//! Systems `nmeaMessages.md`), and the layout verified against records.

use super::civil::TimeOfDay;
use super::decimal::Form;
use super::fault::Fault;
use super::fields::Fields;
use super::frame::Frame;
use super::line::{Composer, Line};
use super::mode::letters;
use super::parts::{degrees_with_sign, heading, negated, read_degrees, read_within};

const HEADING: Form = Form { decimals: 3, width: 3, limit: 360.0 };
const ROLL: Form = Form { decimals: 3, width: 3, limit: 180.0 };
const PITCH: Form = Form { decimals: 3, width: 2, limit: 90.0 };
const METRES: Form = Form { decimals: 3, width: 2, limit: 99.999 };
const TURN: Form = Form { decimals: 2, width: 4, limit: 9999.994 };

/// Greatest rate of turn that is read, deg/min.
const MAX_TURN: f64 = 9999.99;

/// State of a quantity.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Default)]
pub enum PhoctState {
    /// T.
    Valid,
    /// E.
    #[default]
    Invalid,
    /// I: not yet valid, after the start.
    Initialising,
}

letters! {
    PhoctState { Valid b'T', Invalid b'E', Initialising b'I' }
}

/// A quantity and its state. One that is unknown is written empty and never as valid.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Marked {
    /// The value, SI or rad; it may be known and invalid.
    pub value: Option<f64>,
    /// Its state.
    pub state: PhoctState,
}

/// Surge, sway and heave, or their rates.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct WaveMotion {
    /// Heave, m or m/s, up positive.
    pub heave: Option<f64>,
    /// Surge, m or m/s, forward positive.
    pub surge: Option<f64>,
    /// Sway, m or m/s, to **starboard** positive; the sentence has it the other way.
    pub sway: Option<f64>,
}

/// Attitude and motion.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Phoct {
    /// UTC.
    pub time: Option<TimeOfDay>,
    /// Whether it is synchronised; never so if unknown.
    pub time_valid: bool,
    /// Latency of heading, roll and pitch, ms, at most 99.
    pub latency_ms: Option<u8>,
    /// Heading, rad, clockwise from true north.
    pub heading: Marked,
    /// Roll, rad, starboard down positive.
    pub roll: Marked,
    /// Pitch, rad, **bow up** positive; the sentence has it the other way.
    pub pitch: Marked,
    /// Heave at the primary lever arm, m, up positive. Its state is that of all motion.
    pub heave: Marked,
    /// Motion at the chosen lever arm.
    pub motion: WaveMotion,
    /// Its rates.
    pub rates: WaveMotion,
    /// Rate of turn, rad/s, bow to starboard positive.
    pub rate_of_turn: Option<f64>,
}

impl Marked {
    /// A valid value; invalid if unknown.
    #[must_use]
    pub fn valid(value: Option<f64>) -> Self {
        let state = if value.is_some() { PhoctState::Valid } else { PhoctState::Invalid };
        Marked { value, state }
    }

    /// An unknown value, which is not valid whatever is said of it.
    fn unknown(state: PhoctState) -> Self {
        let valid = state == PhoctState::Valid;
        Marked { value: None, state: if valid { PhoctState::Invalid } else { state } }
    }

    /// Writes the letter, which is not that of a valid value if nothing stands before it.
    fn write_state(self, line: &mut Composer, written: bool) {
        let state = if written { self.state } else { Marked::unknown(self.state).state };
        line.letter(state.letter());
    }
}

impl Phoct {
    /// All before the first comma.
    pub const ADDRESS: &'static str = "PHOCT";

    /// Greatest length, bytes with CR LF.
    pub const LONGEST: usize = 128;

    /// Writes the sentence: time truncated to 1 ms, angles to 0.001 deg, motion to 1 mm, rate of turn to
    /// 0.01 deg/min.
    #[must_use]
    pub fn write(&self) -> Line {
        let turn = self.rate_of_turn.map(|rate| rate.to_degrees() * 60.0);
        let pitch = Marked { value: negated(self.pitch.value), ..self.pitch };
        Line::compose_own(Self::ADDRESS, |line| {
            line.text("01");
            let known = line.filled(|line| line.time_of_day_to(self.time, 3));
            line.letter(if known && self.time_valid { b'T' } else { b'E' });
            line.whole(self.latency_ms.map(u32::from), 2, 99);
            let known = line.filled(|line| heading(line, self.heading.value, HEADING));
            self.heading.write_state(line, known);
            for (angle, form) in [(self.roll, ROLL), (pitch, PITCH)] {
                let known = line.filled(|line| degrees_with_sign(line, angle.value, form));
                angle.write_state(line, known);
            }
            let known = line.filled(|line| line.with_sign(self.heave.value, METRES));
            self.heave.write_state(line, known);
            self.motion.write(line);
            self.rates.write(line);
            line.with_sign(turn, TURN);
        })
    }

    /// Reads the sentence.
    ///
    /// # Errors
    /// The first [`Fault`] of its fields; [`Fault::OtherSentence`] for another version than 01.
    pub fn read(frame: &Frame<'_>) -> Result<Self, Fault> {
        let mut fields = frame.fields_of_own(Self::ADDRESS)?;
        if fields.text()? != "01" {
            return Err(Fault::OtherSentence);
        }
        let time = fields.time_of_day()?;
        let time_valid = match fields.text()? {
            "T" => true,
            "E" => false,
            _ => return Err(fields.malformed()),
        };
        let latency_ms = fields.whole(99)?.and_then(|latency| u8::try_from(latency).ok());
        let heading = marked(&mut fields, Fields::degrees)?;
        let roll = marked(&mut fields, |fields| read_degrees(fields, ROLL.limit))?;
        let pitch = marked(&mut fields, |fields| read_degrees(fields, PITCH.limit).map(negated))?;
        let heave = marked(&mut fields, |fields| read_within(fields, METRES.limit))?;
        let motion = WaveMotion::read(&mut fields)?;
        let rates = WaveMotion::read(&mut fields)?;
        let turn = read_within(&mut fields, MAX_TURN)?;
        let rate_of_turn = turn.map(|turn| (turn / 60.0).to_radians());
        let time_valid = time_valid && time.is_some();
        Ok(Phoct {
            time,
            time_valid,
            latency_ms,
            heading,
            roll,
            pitch,
            heave,
            motion,
            rates,
            rate_of_turn,
        })
    }
}

impl WaveMotion {
    fn write(&self, line: &mut Composer) {
        line.with_sign(self.heave, METRES);
        line.with_sign(self.surge, METRES);
        line.with_sign(negated(self.sway), METRES);
    }

    fn read(fields: &mut Fields<'_>) -> Result<Self, Fault> {
        let heave = read_within(fields, METRES.limit)?;
        let surge = read_within(fields, METRES.limit)?;
        let sway = negated(read_within(fields, METRES.limit)?);
        Ok(WaveMotion { heave, surge, sway })
    }
}

fn marked<'a>(
    fields: &mut Fields<'a>,
    read: impl FnOnce(&mut Fields<'a>) -> Result<Option<f64>, Fault>,
) -> Result<Marked, Fault> {
    let value = read(fields)?;
    let letter = fields.letter()?.and_then(PhoctState::from_letter);
    let state = letter.ok_or_else(|| fields.malformed())?;
    Ok(if value.is_some() { Marked { value, state } } else { Marked::unknown(state) })
}
