//! GLC: time differences of a Loran chain, as its receiver has them. They are shown and not used: its position is told by GLL or RMC.

use super::kinds::{Decimal, Lettered, letter};
use super::table::sentence;

/// A microsecond, s.
const MICRO: f64 = 1e-6;

/// A time of a signal, s, in tenths of a microsecond.
const TIME: Decimal = Decimal::magnitude(1, 99_999.9).of(MICRO);

/// What a receiver says of a signal.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum LoranSignal {
    /// A: valid.
    Valid,
    /// B: its station warns that it must not be used.
    Blink,
    /// C: the cycle that is tracked may be a wrong one, 3 km off.
    Cycle,
    /// S: too weak.
    Weak,
}

sentence! {
    /// Time differences of Loran.
    approved Glc "GLC", longest 76: Default;
    /// Group repetition interval of the chain, s.
    1 interval: Option<f64> = Decimal::magnitude(0, 9999.0).width(4).of(10.0 * MICRO);
    /// Time of arrival of the master, s.
    2 master: Option<f64> = TIME, lenient;
    /// Its signal.
    3 master_signal: Option<LoranSignal> = letter(), lenient;
    /// Time difference of the first secondary, s.
    4 first: Option<f64> = TIME, lenient;
    /// Its signal.
    5 first_signal: Option<LoranSignal> = letter(), lenient;
    /// Of the second.
    6 second: Option<f64> = TIME, lenient;
    /// Its signal.
    7 second_signal: Option<LoranSignal> = letter(), lenient;
    /// Of the third.
    8 third: Option<f64> = TIME, lenient;
    /// Its signal.
    9 third_signal: Option<LoranSignal> = letter(), lenient;
    /// Of the fourth.
    10 fourth: Option<f64> = TIME, lenient;
    /// Its signal.
    11 fourth_signal: Option<LoranSignal> = letter(), lenient;
    /// Of the fifth.
    12 fifth: Option<f64> = TIME, lenient;
    /// Its signal.
    13 fifth_signal: Option<LoranSignal> = letter(), lenient;
}

impl Lettered for LoranSignal {
    fn to_letter(self) -> u8 {
        match self {
            LoranSignal::Valid => b'A',
            LoranSignal::Blink => b'B',
            LoranSignal::Cycle => b'C',
            LoranSignal::Weak => b'S',
        }
    }

    fn of_letter(letter: u8) -> Option<Self> {
        use LoranSignal::{Blink, Cycle, Valid, Weak};
        [Valid, Blink, Cycle, Weak].into_iter().find(|signal| signal.to_letter() == letter)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::nmea::{Sentence, Talker};

    #[test]
    fn time_differences_are_read_in_seconds_and_written_to_the_byte() {
        let line = "$LCGLC,9960,,A,15148.2,A,26999.7,S,44100.4,B,,,,*56";
        let (talker, read) = Sentence::read(line.as_bytes()).unwrap();
        assert_eq!(talker.unwrap().as_str(), "LC");
        let Sentence::Glc(glc) = read else { panic!("{read:?}") };
        assert!((glc.interval.unwrap() - 0.0996).abs() < 1e-12);
        assert!((glc.first.unwrap() - 0.015_148_2).abs() < 1e-12);
        assert_eq!(
            (glc.second_signal, glc.third_signal),
            (Some(LoranSignal::Weak), Some(LoranSignal::Blink))
        );
        assert_eq!((glc.master, glc.fourth, glc.fourth_signal), (None, None, None));
        assert_eq!(read.write(Talker::new("LC").unwrap()).as_str(), line);
    }
}
