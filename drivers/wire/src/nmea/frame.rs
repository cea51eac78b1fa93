//! From `$` to checksum: the frame that every sentence shares.

use super::fault::Fault;
use super::fields::Fields;
use super::line::Talker;

/// A line whose frame and checksum are good; its fields are still text.
///
/// Lines longer than 82 bytes are taken: several makers exceed the standard in their own sentences.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Frame<'a> {
    address: &'a str,
    body: Option<&'a str>,
}

/// Exclusive or of all bytes, as between `$` and `*`.
#[must_use]
pub fn checksum(bytes: &[u8]) -> u8 {
    bytes.iter().fold(0, |sum, byte| sum ^ byte)
}

impl<'a> Frame<'a> {
    /// Reads `$address,field,...*hh` with or without the closing CR LF.
    ///
    /// # Errors
    /// The first [`Fault`] of the frame; fields are not looked at.
    pub fn parse(line: &'a [u8]) -> Result<Self, Fault> {
        let line = line.strip_suffix(b"\n").unwrap_or(line);
        let line = line.strip_suffix(b"\r").unwrap_or(line);
        let content = line.strip_prefix(b"$").ok_or(Fault::NoStart)?;
        if let Some(at) = line.iter().position(|byte| !(b' '..=b'~').contains(byte)) {
            return Err(Fault::IllegalByte { at });
        }
        let (text, stated) = split_checksum(content)?;
        let computed = checksum(text);
        if stated != computed {
            return Err(Fault::WrongChecksum { stated, computed });
        }
        let text = std::str::from_utf8(text).map_err(|_| Fault::Address)?;
        let (address, body) = match text.split_once(',') {
            Some((address, body)) => (address, Some(body)),
            None => (text, None),
        };
        Ok(Frame { address, body })
    }

    /// All before the first comma: `HETHS`, `PSXN`.
    #[must_use]
    pub fn address(&self) -> &'a str {
        self.address
    }

    /// Talker and formatter of an approved sentence: `HE` and `THS`.
    ///
    /// # Errors
    /// [`Fault::Address`] for proprietary and unknown forms.
    pub fn approved(&self) -> Result<(Talker, &'a str), Fault> {
        let form = self.address.len() == 5
            && self.address.bytes().all(|b| b.is_ascii_uppercase() || b.is_ascii_digit())
            && !self.address.starts_with('P');
        if !form {
            return Err(Fault::Address);
        }
        let (talker, formatter) = self.address.split_at(2);
        Talker::new(talker).map(|talker| (talker, formatter)).ok_or(Fault::Address)
    }

    /// The fields, from the first after the address.
    #[must_use]
    pub fn fields(&self) -> Fields<'a> {
        Fields::new(self.body)
    }

    /// The fields of a sentence of this formatter.
    ///
    /// # Errors
    /// [`Fault::Address`] or [`Fault::OtherSentence`].
    pub fn fields_of(&self, formatter: &str) -> Result<Fields<'a>, Fault> {
        let (_, own) = self.approved()?;
        if own == formatter { Ok(self.fields()) } else { Err(Fault::OtherSentence) }
    }
}

fn split_checksum(content: &[u8]) -> Result<(&[u8], u8), Fault> {
    let star = content.len().checked_sub(3).ok_or(Fault::NoChecksum)?;
    let (text, tail) = content.split_at(star);
    match tail {
        [b'*', high, low] => match (hex(*high), hex(*low)) {
            (Some(high), Some(low)) => Ok((text, high << 4 | low)),
            _ => Err(Fault::NoChecksum),
        },
        _ => Err(Fault::NoChecksum),
    }
}

fn hex(byte: u8) -> Option<u8> {
    (byte as char).to_digit(16).and_then(|digit| u8::try_from(digit).ok())
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
        assert_eq!(fault(b""), Fault::NoStart);
        assert_eq!(fault(b"HETHS,316.70,E*1A"), Fault::NoStart);
        assert_eq!(fault(b"$"), Fault::NoChecksum);
        assert_eq!(fault(b"$HETHS,316.70,E"), Fault::NoChecksum);
        assert_eq!(fault(b"$HETHS,316.70,E*1G"), Fault::NoChecksum);
        assert_eq!(fault(b"$HETHS,3\xFF6.70,E*1A"), Fault::IllegalByte { at: 8 });
        assert_eq!(
            fault(b"$HETHS,316.71,E*1A"),
            Fault::WrongChecksum { stated: 0x1A, computed: 0x1B }
        );
    }

    #[test]
    fn a_proprietary_address_is_framed_but_not_approved() {
        let frame = Frame::parse(b"$PSXN,20,0,0,0,0*3B\r\n").unwrap();
        assert_eq!(frame.address(), "PSXN");
        assert_eq!(frame.approved(), Err(Fault::Address));
    }
}
