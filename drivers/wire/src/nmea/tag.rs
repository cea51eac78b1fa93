//! TAG blocks (NMEA 4.10) and datagrams of IEC 61162-450.
//!
//! ```text
//! UdPbC<NUL>\s:IN0001,n:123*hh\$HETHS,316.70,A*1E<CR><LF>
//! ```
//! A datagram is the header and lines, each with a TAG block before it. The checksum of the block is
//! over what stands between the backslashes, before `*`. Two digits are the rule; a sender that
//! prints one for a checksum below 16 (codekilo nmea0183-iec61121-450-server) is read too.
//!
//! Of the fields s, d, n, g, c and t are read; unknown ones, and values that are none, are left out.

use insd_base::UtcTime;

use super::checksum::checksum;
use super::civil::nanoseconds;
use super::decimal::parse_digits;
use super::line::NmeaLine;

/// First bytes of a datagram with sentences.
pub const DATAGRAM_HEADER: &[u8; 6] = b"UdPbC\0";

/// Longest datagram, bytes.
pub const MAX_DATAGRAM: usize = 1472;

/// Longest name of a source or destination.
const MAX_NAME: usize = 15;

/// What a TAG block says of the line behind it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub struct TagBlock<'a> {
    /// s: who sent it, for example `IN0001`.
    pub source: Option<&'a str>,
    /// d: whom it is for.
    pub destination: Option<&'a str>,
    /// n: the sender's count of lines, 1 to 999.
    pub line: Option<u16>,
    /// g: the group of lines that this one belongs to.
    pub group: Option<TagGroup>,
    /// c: when, to the millisecond; seconds or, if it has 12 digits or more, milliseconds since 1970.
    pub time: Option<UtcTime>,
    /// t: free text.
    pub text: Option<&'a str>,
}

/// Place of a line in a group.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TagGroup {
    /// Number of the line, from 1.
    pub line: u16,
    /// Lines of the group.
    pub lines: u16,
    /// Which group.
    pub id: u32,
}

impl<'a> TagBlock<'a> {
    /// Reads what stands between the backslashes, without its checksum.
    #[must_use]
    pub fn read(content: &'a str) -> Self {
        let mut block = TagBlock::default();
        for (key, value) in content.split(',').filter_map(|field| field.split_once(':')) {
            match key {
                "s" => block.source = name(value),
                "d" => block.destination = name(value),
                "n" => block.line = small(value).filter(|n| (1..=999).contains(n)),
                "g" => block.group = TagGroup::read(value),
                "c" => block.time = unix_time(value),
                "t" => block.text = name(value),
                _ => {}
            }
        }
        block
    }

    /// Writes the block from backslash to backslash; nothing if it says nothing. Names that are too
    /// long or would break the line are left out.
    #[must_use]
    pub fn write(&self) -> Vec<u8> {
        let mut fields = Vec::new();
        let mut put = |key: char, value: Option<String>| {
            fields.extend(value.map(|value| format!("{key}:{value}")));
        };
        let own = |value: Option<&'a str>| value.and_then(name).map(str::to_owned);
        put('g', self.group.map(TagGroup::write));
        put('s', own(self.source));
        put('d', own(self.destination));
        put('n', self.line.filter(|n| (1..=999).contains(n)).map(|n| n.to_string()));
        put('c', self.time.and_then(write_time));
        put('t', own(self.text));
        if fields.is_empty() {
            return Vec::new();
        }
        let content = fields.join(",");
        format!("\\{content}*{:02X}\\", checksum(content.as_bytes())).into_bytes()
    }

    /// Whether the next line belongs to the same group.
    fn is_continued_by(&self, next: &TagBlock<'_>) -> bool {
        let groups = self.group.zip(next.group);
        groups.is_some_and(|(own, next)| own.id == next.id && own.line < next.line)
    }

    /// The text of a block's inside whose checksum is good.
    pub(crate) fn check(inside: &[u8]) -> Option<&str> {
        let (content, stated) = std::str::from_utf8(inside).ok()?.rsplit_once('*')?;
        let digits = (1..=2).contains(&stated.len()) && !stated.starts_with('+');
        let stated = u8::from_str_radix(stated, 16).ok().filter(|_| digits)?;
        (stated == checksum(content.as_bytes())).then_some(content)
    }
}

impl TagGroup {
    fn read(text: &str) -> Option<Self> {
        let mut parts = text.split('-');
        let (line, lines) = (small(parts.next()?)?, small(parts.next()?)?);
        let id = parse_digits(parts.next()?)?;
        let good = parts.next().is_none() && (1..=lines).contains(&line);
        good.then_some(TagGroup { line, lines, id })
    }

    fn write(self) -> String {
        format!("{}-{}-{}", self.line, self.lines, self.id)
    }
}

/// A line with the TAG block that goes before it.
pub type Tagged<'a> = (TagBlock<'a>, &'a NmeaLine);

/// One datagram of lines with their TAG blocks; `None` if it would exceed [`MAX_DATAGRAM`].
#[must_use]
pub fn datagram(lines: &[Tagged<'_>]) -> Option<Vec<u8>> {
    let bytes = [DATAGRAM_HEADER.as_slice(), &bytes_of(lines)].concat();
    (bytes.len() <= MAX_DATAGRAM).then_some(bytes)
}

/// As few datagrams as the lines need in their order, each of at most [`MAX_DATAGRAM`] bytes. Lines of
/// one group that stand one after the other stay together; `None` if such a group is too long for a
/// datagram.
#[must_use]
pub fn datagrams(lines: &[Tagged<'_>]) -> Option<Vec<Vec<u8>>> {
    let mut datagrams: Vec<Vec<u8>> = Vec::new();
    for group in lines.chunk_by(|(one, _), (next, _)| one.is_continued_by(next)) {
        let bytes = bytes_of(group);
        match datagrams.last_mut().filter(|last| last.len() + bytes.len() <= MAX_DATAGRAM) {
            Some(last) => last.extend(bytes),
            None => datagrams.push(datagram(group)?),
        }
    }
    Some(datagrams)
}

fn bytes_of(lines: &[Tagged<'_>]) -> Vec<u8> {
    let pieces = lines.iter().flat_map(|(block, line)| [block.write(), line.as_bytes().to_vec()]);
    pieces.flatten().collect()
}

fn name(text: &str) -> Option<&str> {
    let plain = |byte: u8| (b' '..=b'~').contains(&byte) && !b",*\\:$!".contains(&byte);
    (!text.is_empty() && text.len() <= MAX_NAME && text.bytes().all(plain)).then_some(text)
}

fn small(text: &str) -> Option<u16> {
    parse_digits(text).and_then(|number| u16::try_from(number).ok())
}

fn unix_time(text: &str) -> Option<UtcTime> {
    let (whole, fraction) = text.split_once('.').unwrap_or((text, "0"));
    let plain = whole.len() <= 13 && whole.bytes().all(|byte| byte.is_ascii_digit());
    let whole: i64 = whole.parse().ok().filter(|_| plain)?;
    let unit = if text.len() >= 12 && !text.contains('.') { 1_000_000 } else { 1_000_000_000 };
    let nanos = whole.checked_mul(unit)?.checked_add(nanoseconds(fraction)?.into())?;
    Some(UtcTime::from_nanos(nanos))
}

fn write_time(time: UtcTime) -> Option<String> {
    let millis = time.as_nanos().div_euclid(1_000_000);
    match millis {
        ..100_000_000_000 => None,
        _ if millis % 1000 == 0 => Some((millis / 1000).to_string()),
        _ => Some(millis.to_string()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::nmea::{Frame, HeadingMode, NmeaFault, Talker, Ths};

    #[test]
    fn the_published_datagram_is_written_byte_for_byte() {
        let ths = Ths { heading: Some(316.7_f64.to_radians()), mode: HeadingMode::Autonomous };
        let block = TagBlock { source: Some("IN0001"), line: Some(1), ..TagBlock::default() };
        let bytes = datagram(&[(block, &ths.write(Talker::HE))]).unwrap();
        assert_eq!(bytes, b"UdPbC\0\\s:IN0001,n:1*06\\$HETHS,316.70,A*1E\r\n");
    }

    #[test]
    fn a_frame_gives_its_tag_block_and_its_sentence() {
        let frame = Frame::parse(b"\\s:IN0001,n:1*6\\$HETHS,316.70,A*1E\r\n").unwrap();
        let block = frame.tag().unwrap();
        assert_eq!((block.source, block.line), (Some("IN0001"), Some(1)));
        assert_eq!(frame.address(), "HETHS");
        assert_eq!(Frame::parse(b"$HETHS,316.70,A*1E\r\n").unwrap().tag(), None);
    }

    #[test]
    fn a_damaged_tag_block_is_named() {
        for line in ["\\s:IN0001,n:2*06\\$HETHS,316.70,A*1E", "\\s:IN0001$HETHS,316.70,A*1E"] {
            assert_eq!(Frame::parse(line.as_bytes()), Err(NmeaFault::TagBlock));
        }
    }

    #[test]
    fn seconds_and_milliseconds_are_told_apart_and_unknown_fields_are_left_out() {
        let at = |text| TagBlock::read(text).time.map(UtcTime::as_nanos);
        assert_eq!(at("c:1120959341"), Some(1_120_959_341_000_000_000));
        assert_eq!(at("c:1120959341250"), Some(1_120_959_341_250_000_000));
        assert_eq!(at("c:1120959341.25"), Some(1_120_959_341_250_000_000));
        assert_eq!(at("c:x"), None);
        let block = TagBlock::read("1G2:98,s:r3669961,x:y,n:1000,g:3-2-1,d:a:b");
        assert_eq!(block, TagBlock { source: Some("r3669961"), ..TagBlock::default() });
    }
}
