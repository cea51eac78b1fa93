//! Types of observations: which signal a column is of, and what of it.

use insd_base::{Constellation, SignalCode};

/// What a column tells of a signal (RINEX 3.05, table A2, `SYS / # / OBS TYPES`).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Quantity {
    /// `C`: pseudorange, m.
    Code,
    /// `L`: carrier phase, cycles.
    Phase,
    /// `D`: Doppler shift, Hz.
    Doppler,
    /// `S`: signal strength.
    Strength,
}

impl Quantity {
    /// All of them, as the writer orders them.
    pub(crate) const ALL: [Self; 4] = [Self::Code, Self::Phase, Self::Doppler, Self::Strength];

    /// Its letter.
    pub(crate) fn letter(self) -> char {
        match self {
            Self::Code => 'C',
            Self::Phase => 'L',
            Self::Doppler => 'D',
            Self::Strength => 'S',
        }
    }

    fn from_letter(letter: u8) -> Option<Self> {
        Self::ALL.into_iter().find(|quantity| quantity.letter() == char::from(letter))
    }
}

/// A signal and what of it.
pub(crate) type ObservationType = (SignalCode, Quantity);

/// A type of RINEX 3 and 4, such as `C1C`. `None` for what is no measurement of a signal (`X1` channel, `I` ionosphere) or unknown.
///
/// BeiDou's B1I was `1I` in version 3.02 and is band 2 before and after; `1I` and `1Q` exist nowhere else, and `1X` is B1C from 3.03 on.
pub(crate) fn modern(
    constellation: Constellation,
    code: [u8; 3],
    version: u16,
) -> Option<ObservationType> {
    let [kind, band, attribute] = code;
    let quantity = Quantity::from_letter(kind)?;
    if !band.is_ascii_digit() || band == b'0' || !attribute.is_ascii_uppercase() {
        return None;
    }
    let old = attribute == b'I' || attribute == b'Q' || attribute == b'X' && version <= 302;
    let moved = constellation == Constellation::BeiDou && band == b'1' && old;
    Some((SignalCode::new(if moved { 2 } else { band - b'0' }, attribute), quantity))
}

/// A type of RINEX 2, such as `C1` or `L2` (RINEX 2.11, table A1), as a signal of RINEX 3. `has_p` tells whether
/// the file has `P1` and `P2`.
///
/// | constellation | C1 | P1 | C2 | P2 | L1 D1 S1 | L2 D2 S2 | band 5 6 7 8 |
/// |---|---|---|---|---|---|---|---|
/// | GPS | 1C | 1W | 2X | 2W | 1C | 2W, without P2 2X | 5X |
/// | GLONASS | 1C | 1P | 2C | 2P | 1C | 2P, without P2 2C | 3X for band 3 |
/// | Galileo | 1X | | | | 1X | | 5X 6X 7X 8X |
/// | QZSS | 1C | | 2X | | 1C | 2X | 5X 6X |
/// | SBAS | 1C | | | | 1C | | 5X |
/// | BeiDou | 2I | | 2I | | 2I | 2I | 5X 6I 7I |
/// | NavIC | | | | | | | 5A |
///
/// Version 2 does not tell how a phase was tracked: with both `C1` and `P1` it goes with the former, as
/// receivers do. BeiDou came after version 2: files call B1I by band 1 or 2.
pub(crate) fn early(
    constellation: Constellation,
    code: [u8; 2],
    listed: &[[u8; 2]],
) -> Option<ObservationType> {
    use Constellation as C;
    let [kind, band] = code;
    let precise = kind == b'P';
    let quantity = if precise { Quantity::Code } else { Quantity::from_letter(kind)? };
    // whether what is not told goes with the precise code of its band
    let by_precise = |both: bool| {
        let has = |kind| listed.contains(&[kind, band]);
        kind != b'C' && has(b'P') && (both || !has(b'C'))
    };
    let signal = match (constellation, band) {
        (C::Gps, b'1') if precise || by_precise(false) => (1, b'W'),
        (C::Gps, b'2') if precise || by_precise(true) => (2, b'W'),
        (C::Glonass, b'1') if precise || by_precise(false) => (1, b'P'),
        (C::Glonass, b'2') if precise || by_precise(true) => (2, b'P'),
        _ if precise => return None,
        (C::Gps | C::Glonass | C::Qzss | C::Sbas, b'1') => (1, b'C'),
        (C::Gps | C::Qzss, b'2') => (2, b'X'),
        (C::Glonass, b'2') => (2, b'C'),
        (C::Glonass, b'3') => (3, b'X'),
        (C::Gps | C::Qzss | C::Galileo | C::Sbas | C::BeiDou, b'5') => (5, b'X'),
        (C::Galileo, b'1') => (1, b'X'),
        (C::Galileo | C::Qzss, b'6') => (6, b'X'),
        (C::Galileo, b'7') => (7, b'X'),
        (C::Galileo, b'8') => (8, b'X'),
        (C::BeiDou, b'1' | b'2') => (2, b'I'),
        (C::BeiDou, b'6') => (6, b'I'),
        (C::BeiDou, b'7') => (7, b'I'),
        (C::Navic, b'5') => (5, b'A'),
        _ => return None,
    };
    Some((SignalCode::new(signal.0, signal.1), quantity))
}

/// The columns of one constellation.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Layout {
    /// The signals, in the order of their first columns.
    pub(crate) signals: Vec<SignalCode>,
    /// For each column the signal's place in `signals` and what of it; `None` for a column that is passed over.
    pub(crate) columns: Vec<Option<(usize, Quantity)>>,
}

impl Layout {
    /// Puts columns together; of several columns of one kind the first counts.
    pub(crate) fn new(types: impl Iterator<Item = Option<ObservationType>>) -> Self {
        let mut layout = Self::default();
        for kind in types {
            let column = kind.map(|(signal, quantity)| (layout.place(signal), quantity));
            let known = column.is_some() && layout.columns.contains(&column);
            layout.columns.push(column.filter(|_| !known));
        }
        layout
    }

    fn place(&mut self, signal: SignalCode) -> usize {
        self.signals.iter().position(|own| *own == signal).unwrap_or_else(|| {
            self.signals.push(signal);
            self.signals.len() - 1
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn name(kind: Option<ObservationType>) -> String {
        kind.map_or("none".to_owned(), |(signal, quantity)| {
            format!("{}{signal}", quantity.letter())
        })
    }

    #[test]
    fn types_of_version_three_are_taken_as_they_stand() {
        let modern = |system, code: &[u8; 3], version| name(modern(system, *code, version));
        assert_eq!(modern(Constellation::Gps, b"L2W", 304), "L2W");
        for other in [b"X1 ", b"I1 ", b"C1 ", b"C0C", b"N1C", b"C1c"] {
            assert_eq!(modern(Constellation::Gps, other, 304), "none");
        }
    }

    #[test]
    fn the_first_signal_of_beidou_is_of_band_two_whatever_the_version() {
        let modern = |code: &[u8; 3], version| name(modern(Constellation::BeiDou, *code, version));
        assert_eq!(modern(b"C1I", 302), "C2I");
        assert_eq!(modern(b"L1X", 302), "L2X");
        assert_eq!(modern(b"L1X", 304), "L1X");
        assert_eq!(modern(b"C2I", 305), "C2I");
    }

    #[test]
    fn types_of_version_two_become_signals_by_the_table() {
        let all = |system, listed: &[[u8; 2]]| {
            let names: Vec<String> =
                listed.iter().map(|code| name(early(system, *code, listed))).collect();
            names.join(" ")
        };
        let list = [*b"C1", *b"P1", *b"L1", *b"C2", *b"P2", *b"L2", *b"S2", *b"C5", *b"T1"];
        assert_eq!(all(Constellation::Gps, &list), "C1C C1W L1C C2X C2W L2W S2W C5X none");
        assert_eq!(all(Constellation::Glonass, &list), "C1C C1P L1C C2C C2P L2P S2P none none");
        assert_eq!(all(Constellation::Galileo, &list), "C1X none L1X none none none none C5X none");
        assert_eq!(all(Constellation::Gps, &[*b"P1", *b"L1", *b"D1"]), "C1W L1W D1W");
        assert_eq!(all(Constellation::Gps, &[*b"C2", *b"L2"]), "C2X L2X");
    }

    #[test]
    fn a_column_that_comes_twice_counts_once() {
        let kinds = [*b"X1 ", *b"C1C", *b"L1C", *b"C1C", *b"C5X"];
        let layout =
            Layout::new(kinds.into_iter().map(|code| modern(Constellation::Gps, code, 304)));
        assert_eq!(layout.signals.len(), 2);
        let places: Vec<_> = layout.columns.iter().map(|c| c.map(|(place, _)| place)).collect();
        assert_eq!(places, [None, Some(0), Some(0), None, Some(1)]);
    }
}
