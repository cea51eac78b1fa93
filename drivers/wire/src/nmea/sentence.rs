//! Any sentence that this crate reads.

use super::fault::Fault;
use super::frame::Frame;
use super::line::{Line, Talker};
use super::{Gga, Hdt, Rot, Ths, Vtg, Zda};

/// A sentence of any kind.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Sentence {
    /// Position fix.
    Gga(Gga),
    /// Heading.
    Hdt(Hdt),
    /// Rate of turn.
    Rot(Rot),
    /// Heading and status.
    Ths(Ths),
    /// Course and speed over ground.
    Vtg(Vtg),
    /// Date and time.
    Zda(Zda),
}

impl Sentence {
    /// Reads a line and says who sent it.
    ///
    /// # Errors
    /// The first [`Fault`] of frame or fields; [`Fault::OtherSentence`] for a good frame of an
    /// unknown formatter.
    pub fn read(line: &[u8]) -> Result<(Talker, Self), Fault> {
        let frame = Frame::parse(line)?;
        let (talker, formatter) = frame.approved()?;
        let sentence = match formatter {
            Gga::FORMATTER => Sentence::Gga(Gga::read(&frame)?),
            Hdt::FORMATTER => Sentence::Hdt(Hdt::read(&frame)?),
            Rot::FORMATTER => Sentence::Rot(Rot::read(&frame)?),
            Ths::FORMATTER => Sentence::Ths(Ths::read(&frame)?),
            Vtg::FORMATTER => Sentence::Vtg(Vtg::read(&frame)?),
            Zda::FORMATTER => Sentence::Zda(Zda::read(&frame)?),
            _ => return Err(Fault::OtherSentence),
        };
        Ok((talker, sentence))
    }

    /// Writes the sentence.
    #[must_use]
    pub fn write(&self, talker: Talker) -> Line {
        match self {
            Sentence::Gga(sentence) => sentence.write(talker),
            Sentence::Hdt(sentence) => sentence.write(talker),
            Sentence::Rot(sentence) => sentence.write(talker),
            Sentence::Ths(sentence) => sentence.write(talker),
            Sentence::Vtg(sentence) => sentence.write(talker),
            Sentence::Zda(sentence) => sentence.write(talker),
        }
    }
}
