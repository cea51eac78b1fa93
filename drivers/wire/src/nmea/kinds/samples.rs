//! Any fields of each kind, as they stand in a line, and the tests that hold every table: its fields are
//! numbered as they stand, and what is read is written again to the byte.

use super::*;
use crate::nmea::alert::Alert;
use crate::nmea::phoct::{Waves, WithState};
use crate::nmea::table::Sampled;
use crate::nmea::{
    Acn, Arc, Dtm, Frame, Glc, Gst, Hbt, Hcr, Hdg, Hdm, Hdt, Lcd, MAX_LEN, NmeaLine, PfecAttitude,
    Phcmp, Phinf, Phlin, Phoct, Phspd, Phtro, PinsdAlignment, PinsdBerth, PinsdPartOfShip,
    PinsdProtection, PinsdRange, PinsdSigma, PinsdStatus, PinsdStep, PsatHpr, Rls, Rot, Sentence,
    Talker, Ths, Vdr, Vhw, Vlw, Vtg, checksum,
};

/// Numbers without pattern, and always the same ones (splitmix64).
pub(crate) struct Dice(u64);

impl Dice {
    fn below(&mut self, limit: u64) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mixed = (self.0 ^ self.0 >> 30).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let mixed = (mixed ^ mixed >> 27).wrapping_mul(0x94D0_49BB_1331_11EB);
        (mixed ^ mixed >> 31) % limit.max(1)
    }

    fn is_rare(&mut self) -> bool {
        self.below(4) == 0
    }
}

/// A kind of which there are samples: its fields as a writer would write them, each behind its comma.
pub(crate) trait Sample {
    fn sample(&self, dice: &mut Dice) -> String;
}

/// A sample of a kind of which the value is known.
pub(crate) fn text<V, K: Kind<Value = V> + Sample>(kind: &K, dice: &mut Dice) -> String {
    kind.sample(dice)
}

/// So many steps of so many decimals.
fn digits(steps: u64, form: Form, short: bool) -> String {
    let power = 10_u64.pow(form.decimals.into());
    let whole = format!("{:0width$}", steps / power, width = form.width.into());
    let fraction = format!("{:0width$}", steps % power, width = form.decimals.into());
    match if short { fraction.trim_end_matches('0') } else { &fraction } {
        _ if form.decimals == 0 => whole,
        "" => whole,
        fraction => format!("{whole}.{fraction}"),
    }
}

impl Sample for Decimal {
    fn sample(&self, dice: &mut Dice) -> String {
        let char = |letter: u8| char::from(letter);
        let known = !dice.is_rare();
        let power = 10_f64.powi(self.form.decimals.into());
        let steps = dice.below((self.form.limit * power) as u64 + 1);
        let negative = self.least < 0.0 && steps > 0 && dice.below(2) == 1;
        let number = digits(steps, self.form, self.short);
        let sign = if negative { "-" } else { "" };
        match self.beside {
            Beside::Letter(letter) if !known => format!(",,{}", char(letter)),
            Beside::Nothing | Beside::Sign if !known => ",".to_owned(),
            _ if !known => ",,".to_owned(),
            Beside::Nothing => format!(",{sign}{number}"),
            Beside::Sign => format!(",{}{number}", if negative { "-" } else { "+" }),
            Beside::Letter(letter) | Beside::LetterIfKnown(letter) => {
                format!(",{sign}{number},{}", char(letter))
            }
            Beside::SignLetter(letters) | Beside::RoundedSignLetter(letters) => {
                format!(",{number},{}", char(letters[usize::from(negative)]))
            }
        }
    }
}

impl Sample for Turn {
    fn sample(&self, dice: &mut Dice) -> String {
        let steps = dice.below(360 * 10_u64.pow(self.form.decimals.into()));
        let number = digits(steps, self.form, self.short);
        let number = if dice.is_rare() { String::new() } else { number };
        let letter = self.letter.map(|letter| format!(",{}", char::from(letter)));
        format!(",{number}{}", letter.unwrap_or_default())
    }
}

impl Sample for KnotsAndKmh {
    fn sample(&self, dice: &mut Dice) -> String {
        if dice.is_rare() {
            return ",,N,,K".to_owned();
        }
        // an even number of hundredths of a knot is no half of a hundredth of a km/h
        let knots = 2 * dice.below((self.0.form.limit * 25.0) as u64);
        let kmh = (knots * 1852 + 500) / 1000;
        let sign = if self.0.least < 0.0 && knots > 0 && dice.is_rare() { "-" } else { "" };
        let text = |steps| digits(steps, self.0.form, false);
        format!(",{sign}{},N,{sign}{},K", text(knots), text(kmh))
    }
}

impl Sample for Significant {
    fn sample(&self, dice: &mut Dice) -> String {
        if dice.is_rare() {
            return ",".to_owned();
        }
        let most = self.0.form.decimals;
        let decimals = dice.below(u64::from(most) + 1) as u8;
        let power = 10_f64.powi(decimals.into());
        let least = if decimals == most { 0 } else { 100 };
        let limit = if decimals == 0 { self.0.form.limit } else { 999.0 };
        let limit = limit.min(self.0.form.limit * power) as u64;
        let steps = least + dice.below((limit + 1).saturating_sub(least));
        // one more decimal where three digits do not fill the fewer ones
        let fits = steps <= limit;
        let form = Form { decimals, ..self.0.form };
        if fits { format!(",{}", digits(steps, form, false)) } else { ",".to_owned() }
    }
}

impl<T: Copy + Into<u32> + TryFrom<u32>> Sample for Whole<T> {
    fn sample(&self, dice: &mut Dice) -> String {
        let number =
            format!("{:0width$}", dice.below(u64::from(self.1) + 1), width = self.0.into());
        format!(",{}", if dice.is_rare() { String::new() } else { number })
    }
}

impl Sample for Clock {
    fn sample(&self, dice: &mut Dice) -> String {
        let [hour, minute, second] = [24, 60, 61].map(|limit| dice.below(limit));
        let fraction = dice.below(10_u64.pow(self.0.into()));
        let width = self.0.into();
        let time = format!("{hour:02}{minute:02}{second:02}.{fraction:0width$}");
        format!(",{}", if dice.is_rare() { String::new() } else { time })
    }
}

impl Sample for Latitude {
    fn sample(&self, dice: &mut Dice) -> String {
        let form = Form { decimals: self.0, width: 2, limit: 60.0 };
        let minutes = digits(1 + dice.below(60 * 10_u64.pow(self.0.into()) - 1), form, false);
        let hemisphere = if dice.below(2) == 1 { 'S' } else { 'N' };
        let latitude = format!(",{:02}{minutes},{hemisphere}", dice.below(90));
        if dice.is_rare() { ",,".to_owned() } else { latitude }
    }
}

impl<T: Copy> Field<T> {
    /// One of the texts that are read and written.
    fn text(&self, dice: &mut Dice) -> String {
        let letters = (b'0'..=b'9').chain(b'A'..=b'Z').map(|letter| char::from(letter).to_string());
        let longer = ["W84", "89ABCDEF", "1A2F"].map(str::to_owned);
        let is_taken = |text: &String| {
            let Some(value) = (self.read)(text) else { return false };
            let line = NmeaLine::compose_own("P", |line| (self.write)(line, value));
            line.as_str().starts_with(&format!("$P,{text}*"))
        };
        let taken: Vec<String> = letters.chain(longer).filter(is_taken).collect();
        taken[dice.below(taken.len() as u64) as usize].clone()
    }
}

impl<T: Copy> Sample for Field<T> {
    fn sample(&self, dice: &mut Dice) -> String {
        if dice.is_rare() { ",".to_owned() } else { format!(",{}", self.text(dice)) }
    }
}

impl<T: Copy> Sample for Needed<T> {
    fn sample(&self, dice: &mut Dice) -> String {
        format!(",{}", self.0.text(dice))
    }
}

impl<T: Copy> Sample for Otherwise<T> {
    fn sample(&self, dice: &mut Dice) -> String {
        format!(",{}", self.1.text(dice))
    }
}

impl Sample for Flag {
    fn sample(&self, dice: &mut Dice) -> String {
        format!(",{}", char::from(if dice.below(2) == 1 { self.0 } else { self.1 }))
    }
}

impl Sample for Alert {
    fn sample(&self, dice: &mut Dice) -> String {
        format!(",{},{:03},{}", ["", "XYZ"][dice.below(2) as usize], dice.below(9_999_999), 7)
    }
}

impl<K: Sample> Sample for Then<K> {
    fn sample(&self, dice: &mut Dice) -> String {
        format!("{},{}", self.0.sample(dice), char::from(self.1))
    }
}

impl<K: Sample> Sample for WithState<K> {
    fn sample(&self, dice: &mut Dice) -> String {
        let value = self.0.sample(dice);
        let states = if value == "," { ["E", "I"] } else { ["T", "I"] };
        format!("{value},{}", states[dice.below(2) as usize])
    }
}

impl Sample for Waves {
    fn sample(&self, dice: &mut Dice) -> String {
        let form = Decimal::signed(3, 99.999).width(2).with_sign();
        [0; 3].map(|_| form.sample(dice)).concat()
    }
}

impl<K: Sample> Sample for Three<K> {
    fn sample(&self, dice: &mut Dice) -> String {
        [0; 3].map(|_| self.0.sample(dice)).concat()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What all tables say of themselves.
    fn tables() -> Vec<fn(&mut Dice) -> Sampled> {
        vec![
            Acn::sample,
            Arc::sample,
            Dtm::sample,
            Gst::sample,
            Hbt::sample,
            Hcr::sample,
            Hdg::sample,
            Hdm::sample,
            Hdt::sample,
            PfecAttitude::sample,
            Phcmp::sample,
            Phinf::sample,
            Phlin::sample,
            Phoct::sample,
            Phspd::sample,
            Phtro::sample,
            PinsdAlignment::sample,
            PinsdBerth::sample,
            PinsdPartOfShip::sample,
            PinsdProtection::sample,
            PinsdRange::sample,
            PinsdSigma::sample,
            PinsdStatus::sample,
            PinsdStep::sample,
            PsatHpr::sample,
            Rls::sample,
            Rot::sample,
            Ths::sample,
            Glc::sample,
            Lcd::sample,
            Vdr::sample,
            Vhw::sample,
            Vlw::sample,
            Vtg::sample,
        ]
    }

    #[test]
    fn what_is_read_by_a_table_is_written_again_to_the_byte() {
        let mut dice = Dice(1);
        for table in tables() {
            for _ in 0..500 {
                let Sampled { start, fields } = table(&mut dice);
                let text: String = fields.iter().map(|(_, text)| text.as_str()).collect();
                let body = format!("{start}{text}");
                // no ship's values: decimals would be left out
                if start.starts_with("IN") && body.len() + 6 > MAX_LEN {
                    continue;
                }
                let line = format!("${body}*{:02X}", checksum(body.as_bytes()));
                let frame = Frame::parse(line.as_bytes()).unwrap();
                let read =
                    Sentence::read_frame(&frame).unwrap_or_else(|fault| panic!("{line}: {fault}"));
                // a rate of turn or a time that is not known is not valid, whatever is said of it
                if !["$INROT,,", "$PHOCT,01,,"].iter().any(|start| line.starts_with(start)) {
                    assert_eq!(read.write(Talker::IN).as_str(), line);
                }
                assert_eq!(frame.left_out().count, 0, "{line}");
            }
        }
    }

    #[test]
    fn the_fields_of_a_table_are_numbered_as_they_stand() {
        let mut dice = Dice(2);
        for table in tables() {
            let Sampled { start, fields } = table(&mut dice);
            let mut number = 1 + u8::from(start.contains(',') && !start.starts_with("PINSD"));
            for (told, text) in fields {
                assert_eq!(told, number, "{start}");
                number += text.matches(',').count() as u8;
            }
        }
    }
}
