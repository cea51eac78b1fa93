//! From `$` to checksum: the frame that every sentence shares.

use std::cell::Cell;

use super::checksum::{checksum, stated_checksum};
use super::fault::NmeaFault;
use super::fields::{Fields, LeftOut};
use super::line::Talker;
use super::tag::TagBlock;

/// A line whose frame and checksum are good; its fields are still text.
///
/// Lines longer than 82 bytes are taken: several makers exceed the standard in their own sentences.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Frame<'a> {
    tag: Option<&'a str>,
    encapsulated: bool,
    address: &'a str,
    body: Option<&'a str>,
    left_out: Cell<LeftOut>,
}

/// What becomes of a line without a checksum. A wrong one is always refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Default)]
pub enum ChecksumPolicy {
    /// It is refused.
    #[default]
    Required,
    /// It is taken: there are ships' devices that send none.
    Optional,
}

impl<'a> Frame<'a> {
    /// Reads `$address,field,...*hh` with or without a TAG block before it and CR LF behind it. A
    /// line of AIS, which begins with `!`, is framed too, but it is no approved sentence here.
    ///
    /// # Errors
    /// The first [`NmeaFault`] of the frame; fields are not looked at.
    pub fn parse(line: &'a [u8]) -> Result<Self, NmeaFault> {
        Frame::parse_with(line, ChecksumPolicy::Required)
    }

    /// As [`Frame::parse`], but the policy decides about a line without a checksum.
    ///
    /// # Errors
    /// The first [`NmeaFault`] of the frame; fields are not looked at.
    pub fn parse_with(line: &'a [u8], policy: ChecksumPolicy) -> Result<Self, NmeaFault> {
        let line = line.strip_suffix(b"\n").unwrap_or(line);
        let line = line.strip_suffix(b"\r").unwrap_or(line);
        let (tag, sentence) = split_tag(line)?;
        let (encapsulated, content) = match sentence {
            [b'$', content @ ..] => (false, content),
            [b'!', content @ ..] => (true, content),
            _ => return Err(NmeaFault::NoStart),
        };
        if let Some(at) = line.iter().position(|byte| !(b' '..=b'~').contains(byte)) {
            return Err(NmeaFault::IllegalByte { at });
        }
        let text = checked(content, policy)?;
        let text = std::str::from_utf8(text).map_err(|_| NmeaFault::Address)?;
        let (address, body) = match text.split_once(',') {
            Some((address, body)) => (address, Some(body)),
            None => (text, None),
        };
        Ok(Frame { tag, encapsulated, address, body, left_out: Cell::default() })
    }

    /// The TAG block that stood before the sentence.
    #[must_use]
    pub fn tag(&self) -> Option<TagBlock<'a>> {
        self.tag.map(TagBlock::read)
    }

    /// All before the first comma: `HETHS`, `PSXN`.
    #[must_use]
    pub fn address(&self) -> &'a str {
        self.address
    }

    /// Talker and formatter of an approved sentence: `HE` and `THS`.
    ///
    /// # Errors
    /// [`NmeaFault::Address`] for proprietary and unknown forms.
    pub fn approved(&self) -> Result<(Talker, &'a str), NmeaFault> {
        let form = self.address.len() == 5
            && self.address.bytes().all(|b| b.is_ascii_uppercase() || b.is_ascii_digit())
            && !self.address.starts_with('P')
            && !self.encapsulated;
        if !form {
            return Err(NmeaFault::Address);
        }
        let (talker, formatter) = self.address.split_at(2);
        Talker::new(talker).map(|talker| (talker, formatter)).ok_or(NmeaFault::Address)
    }

    /// Who sent an approved sentence; `None` for makers' own.
    #[must_use]
    pub fn talker(&self) -> Option<Talker> {
        self.approved().ok().map(|(talker, _)| talker)
    }

    /// The fields, from the first after the address.
    #[must_use]
    pub fn fields(&self) -> Fields<'_> {
        Fields::new(self.body, &self.left_out)
    }

    /// What the readers of this frame have left out so far: fields that were bad, and that the
    /// sentence is good without.
    #[must_use]
    pub fn left_out(&self) -> LeftOut {
        self.left_out.get()
    }

    /// The fields of a sentence of this formatter.
    ///
    /// # Errors
    /// [`NmeaFault::Address`] or [`NmeaFault::OtherSentence`].
    pub fn fields_of(&self, formatter: &str) -> Result<Fields<'_>, NmeaFault> {
        let (_, own) = self.approved()?;
        if own == formatter { Ok(self.fields()) } else { Err(NmeaFault::OtherSentence) }
    }

    /// The fields of a maker's own sentence of this address.
    ///
    /// # Errors
    /// [`NmeaFault::OtherSentence`].
    pub fn fields_of_own(&self, address: &str) -> Result<Fields<'_>, NmeaFault> {
        if self.address == address && !self.encapsulated {
            Ok(self.fields())
        } else {
            Err(NmeaFault::OtherSentence)
        }
    }
}

/// The inside of a TAG block whose checksum is good, and the sentence behind it.
fn split_tag(line: &[u8]) -> Result<(Option<&str>, &[u8]), NmeaFault> {
    let Some(rest) = line.strip_prefix(b"\\") else {
        return Ok((None, line));
    };
    let end = rest.iter().position(|byte| *byte == b'\\').ok_or(NmeaFault::TagBlock)?;
    let (inside, sentence) = rest.split_at(end);
    let content = TagBlock::check(inside).ok_or(NmeaFault::TagBlock)?;
    Ok((Some(content), sentence.get(1..).unwrap_or_default()))
}

/// The text before the checksum, which is good or, if the policy allows it, missing.
fn checked(content: &[u8], policy: ChecksumPolicy) -> Result<&[u8], NmeaFault> {
    let star = content.iter().rposition(|byte| *byte == b'*');
    let (text, tail) = content.split_at(star.unwrap_or(content.len()));
    if tail.is_empty() && policy == ChecksumPolicy::Optional {
        return Ok(text);
    }
    let stated = tail.get(1..).and_then(stated_checksum).ok_or(NmeaFault::NoChecksum)?;
    let computed = checksum(text);
    if stated == computed { Ok(text) } else { Err(NmeaFault::WrongChecksum { stated, computed }) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_frame_is_read_with_any_line_ending() {
        for ending in ["", "\n", "\r\n"] {
            let line = format!("$HETHS,316.70,E*1A{ending}");
            let frame = Frame::parse(line.as_bytes()).unwrap();
            assert_eq!(frame.approved().unwrap(), (Talker::HE, "THS"));
        }
    }

    #[test]
    fn each_fault_of_the_frame_has_its_own_name() {
        let fault = |line: &[u8]| Frame::parse(line).unwrap_err();
        assert_eq!(fault(b""), NmeaFault::NoStart);
        assert_eq!(fault(b"HETHS,316.70,E*1A"), NmeaFault::NoStart);
        assert_eq!(fault(b"$"), NmeaFault::NoChecksum);
        assert_eq!(fault(b"$HETHS,316.70,E"), NmeaFault::NoChecksum);
        assert_eq!(fault(b"$HETHS,316.70,E*1G"), NmeaFault::NoChecksum);
        assert_eq!(fault(b"$HETHS,3\xFF6.70,E*1A"), NmeaFault::IllegalByte { at: 8 });
        assert_eq!(
            fault(b"$HETHS,316.71,E*1A"),
            NmeaFault::WrongChecksum { stated: 0x1A, computed: 0x1B }
        );
    }

    #[test]
    fn a_missing_checksum_is_for_the_port_to_judge_and_a_wrong_one_is_not() {
        let optional = |line: &'static [u8]| Frame::parse_with(line, ChecksumPolicy::Optional);
        assert_eq!(optional(b"$HETHS,316.70,E\r\n").map(|frame| frame.address()), Ok("HETHS"));
        assert!(matches!(optional(b"$HETHS,316.70,E*1B"), Err(NmeaFault::WrongChecksum { .. })));
        assert_eq!(optional(b"$HETHS,316.70,E*1"), Err(NmeaFault::NoChecksum));
    }

    #[test]
    fn zero_is_a_checksum_like_any_other() {
        assert_eq!(Frame::parse(b"$AA,,*00").map(|frame| frame.address()), Ok("AA"));
    }

    #[test]
    fn a_proprietary_address_is_framed_but_not_approved() {
        let frame = Frame::parse(b"$PSXN,20,0,0,0,0*3B\r\n").unwrap();
        assert_eq!(frame.address(), "PSXN");
        assert_eq!(frame.approved(), Err(NmeaFault::Address));
    }
}
