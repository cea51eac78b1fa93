//! PHOCT: attitude and motion with time, by Octans, Phins and the units that speak like them ("TAH").
//!
//! From the makers' manuals (INS Interface Library MU-INSIII-AN-001, as quoted by open parsers, and SBG
//! Systems `nmeaMessages.md`), and the layout verified against records.

use super::civil::TimeOfDay;
use super::fault::NmeaFault;
use super::fields::Fields;
use super::kinds::{Clock, Decimal, Flag, Kind, Needed, Turn, Whole, letter};
use super::line::Composer;
use super::mode::letters;
use super::table::sentence;

const ROLL: Decimal = Decimal::signed(3, 180.0).degrees().width(3).with_sign();
const PITCH: Decimal = Decimal::signed(3, 90.0).degrees().width(2).with_sign().reversed();
const METRES: Decimal = Decimal::signed(3, 99.999).width(2).with_sign();
const TURN: Decimal = Decimal::signed(2, 9999.994).minutes().width(4).with_sign();

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
pub struct SurgeSwayHeave {
    /// Heave, m or m/s, up positive.
    pub heave: Option<f64>,
    /// Surge, m or m/s, forward positive.
    pub surge: Option<f64>,
    /// Sway, m or m/s, to **starboard** positive; the sentence has it the other way.
    pub sway: Option<f64>,
}

sentence! {
    /// Attitude and motion. Signs are always shown, and digits are fixed; the line is longer than the
    /// standard allows. Field 1 is the version of the layout.
    own Phoct "PHOCT" "01", longest 128: Default, written as honest, read as honest;
    /// UTC.
    2 time: Option<TimeOfDay> = Clock(3);
    /// Whether it is synchronised; never so if unknown.
    3 time_valid: bool = Flag(b'T', b'E');
    /// Latency of heading, roll and pitch, ms, at most 99.
    4 latency_ms: Option<u8> = Whole::of(2, 99);
    /// Heading, rad, clockwise from true north.
    5 heading: Marked = WithState(Turn::of(3).full_width());
    /// Roll, rad, starboard down positive.
    7 roll: Marked = WithState(ROLL);
    /// Pitch, rad, **bow up** positive; the sentence has it the other way.
    9 pitch: Marked = WithState(PITCH);
    /// Heave at the primary lever arm, m, up positive. Its state is that of all motion.
    11 heave: Marked = WithState(METRES);
    /// Motion at the chosen lever arm: heave, surge, sway, m.
    13 motion: SurgeSwayHeave = Waves;
    /// Its rates, m/s.
    16 rates: SurgeSwayHeave = Waves;
    /// Rate of turn, rad/s, bow to starboard positive; deg/min in the sentence.
    19 rate_of_turn: Option<f64> = TURN;
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
}

impl Phoct {
    fn honest(&self) -> Self {
        let known = self.time.is_some_and(TimeOfDay::is_valid);
        Phoct { time_valid: self.time_valid && known, ..*self }
    }
}

/// A quantity and the letter of its state, which is not that of a valid one if it is empty.
pub(super) struct WithState<K>(pub(super) K);

impl<K: Kind<Value = Option<f64>>> Kind for WithState<K> {
    type Value = Marked;

    fn write(&self, line: &mut Composer, marked: &Marked) {
        let written = line.filled(|line| self.0.write(line, &marked.value));
        let state = if written { marked.state } else { Marked::unknown(marked.state).state };
        line.letter(state.letter());
    }

    fn read(&self, fields: &mut Fields<'_>) -> Result<Marked, NmeaFault> {
        let value = self.0.read(fields)?;
        let state = Needed(letter()).read(fields)?;
        Ok(if value.is_some() { Marked { value, state } } else { Marked::unknown(state) })
    }
}

/// Heave (up), surge (forward), sway (to **port**).
pub(super) struct Waves;

impl Kind for Waves {
    type Value = SurgeSwayHeave;

    fn write(&self, line: &mut Composer, motion: &SurgeSwayHeave) {
        METRES.write(line, &motion.heave);
        METRES.write(line, &motion.surge);
        METRES.reversed().write(line, &motion.sway);
    }

    fn read(&self, fields: &mut Fields<'_>) -> Result<SurgeSwayHeave, NmeaFault> {
        let (heave, surge) = (METRES.read(fields)?, METRES.read(fields)?);
        Ok(SurgeSwayHeave { heave, surge, sway: METRES.reversed().read(fields)? })
    }
}
