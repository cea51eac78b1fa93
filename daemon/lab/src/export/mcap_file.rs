//! The container MCAP, version 0 (<https://mcap.dev/spec>): chunks of messages, each with its index, and a summary at the end, by which a
//! reader finds what it wants. Nothing is compressed. Written here, as the crate for it brings sixteen others into the program.
//!
//! Numbers are little-endian. A record is its kind, the number of bytes and as many bytes; a text is a number of bytes (u32) and the bytes.

use std::collections::BTreeMap;
use std::io::{self, Write};

use super::schemas::Schema;

const MAGIC: &[u8] = b"\x89MCAP0\r\n";
/// A chunk is written when it has grown so large, bytes.
const CHUNK: usize = 1 << 20;

/// Kinds of records.
mod kind {
    pub(super) const HEADER: u8 = 0x01;
    pub(super) const FOOTER: u8 = 0x02;
    pub(super) const SCHEMA: u8 = 0x03;
    pub(super) const CHANNEL: u8 = 0x04;
    pub(super) const MESSAGE: u8 = 0x05;
    pub(super) const CHUNK: u8 = 0x06;
    pub(super) const MESSAGE_INDEX: u8 = 0x07;
    pub(super) const CHUNK_INDEX: u8 = 0x08;
    pub(super) const STATISTICS: u8 = 0x0B;
    pub(super) const DATA_END: u8 = 0x0F;
}

/// How messages are written.
#[derive(Clone, Copy)]
pub(super) struct Encoding {
    profile: &'static str,
    schema: &'static str,
    message: &'static str,
}

impl Encoding {
    /// Messages of JSON.
    pub(super) const JSON: Encoding =
        Encoding { profile: "", schema: "jsonschema", message: "json" };
    /// Messages of ROS 2.
    pub(super) const ROS2: Encoding =
        Encoding { profile: "ros2", schema: "ros2msg", message: "cdr" };
}

/// A file in the making.
pub(super) struct McapFile<W: Write> {
    encoding: Encoding,
    target: W,
    /// Bytes written.
    position: u64,
    /// Schemas and channels, as they stand in the summary again.
    declared: Vec<u8>,
    channels: u16,
    chunk: Chunk,
    /// Indexes of the chunks that are written.
    chunks: Vec<Vec<u8>>,
    counts: BTreeMap<u16, u64>,
    span: Option<Span>,
}

/// Messages that are not written yet.
#[derive(Default)]
struct Chunk {
    records: Vec<u8>,
    /// Of each channel times of messages and where they stand.
    index: BTreeMap<u16, Vec<(u64, u64)>>,
    span: Option<Span>,
}

/// The first and the last time, ns.
#[derive(Clone, Copy)]
struct Span(u64, u64);

impl Span {
    fn with(span: Option<Span>, time: u64) -> Option<Span> {
        Some(span.map_or(Span(time, time), |own| Span(own.0.min(time), own.1.max(time))))
    }
}

impl<W: Write> McapFile<W> {
    pub(super) fn new(target: W, encoding: Encoding) -> io::Result<Self> {
        let mut file = McapFile {
            encoding,
            target,
            position: 0,
            declared: Vec::new(),
            channels: 0,
            chunk: Chunk::default(),
            chunks: Vec::new(),
            counts: BTreeMap::new(),
            span: None,
        };
        file.put(MAGIC)?;
        file.put(&record(kind::HEADER, &[text(encoding.profile), text("insd")].concat()))?;
        Ok(file)
    }

    /// Declares a channel of messages of a schema, and gives its number.
    pub(super) fn channel(&mut self, topic: &str, schema: &Schema) -> io::Result<u16> {
        self.channels += 1;
        let number = self.channels.to_le_bytes();
        let content =
            [&number[..], &text(schema.name), &text(self.encoding.schema), &text(schema.text)]
                .concat();
        let mut declared = record(kind::SCHEMA, &content);
        let metadata = 0_u32.to_le_bytes();
        let content =
            [&number[..], &number, &text(topic), &text(self.encoding.message), &metadata].concat();
        declared.extend(record(kind::CHANNEL, &content));
        self.put(&declared)?;
        self.declared.extend(declared);
        Ok(self.channels)
    }

    /// Writes a message of a channel at a time, ns since 1970.
    pub(super) fn write(&mut self, channel: u16, time: u64, data: &[u8]) -> io::Result<()> {
        let (number, sequence) = (channel.to_le_bytes(), 0_u32.to_le_bytes());
        let stamp = time.to_le_bytes();
        let content = [&number[..], &sequence, &stamp, &stamp, data].concat();
        let chunk = &mut self.chunk;
        chunk.index.entry(channel).or_default().push((time, chunk.records.len() as u64));
        chunk.records.extend(record(kind::MESSAGE, &content));
        chunk.span = Span::with(chunk.span, time);
        self.span = Span::with(self.span, time);
        *self.counts.entry(channel).or_default() += 1;
        if self.chunk.records.len() >= CHUNK { self.flush() } else { Ok(()) }
    }

    /// Writes what is left, and the summary.
    pub(super) fn finish(mut self) -> io::Result<()> {
        self.flush()?;
        self.put(&record(kind::DATA_END, &0_u32.to_le_bytes()))?;
        let start = self.position;
        let mut summary = self.declared.clone();
        summary.extend(record(kind::STATISTICS, &self.statistics()));
        self.chunks.iter().for_each(|index| summary.extend(record(kind::CHUNK_INDEX, index)));
        let mut footer = vec![kind::FOOTER];
        footer.extend([20_u64, start, 0].into_iter().flat_map(u64::to_le_bytes));
        summary.extend(footer);
        let check = crc32fast::hash(&summary);
        summary.extend(check.to_le_bytes());
        self.put(&summary)?;
        self.put(MAGIC)?;
        self.target.flush()
    }

    fn put(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.position += bytes.len() as u64;
        self.target.write_all(bytes)
    }

    /// Writes the chunk, behind it the index of each channel, and keeps note of both for the summary.
    fn flush(&mut self) -> io::Result<()> {
        let chunk = std::mem::take(&mut self.chunk);
        let Some(Span(first, last)) = chunk.span else { return Ok(()) };
        let (begin, size) = (self.position, chunk.records.len() as u64);
        let mut content: Vec<u8> =
            [first, last, size].into_iter().flat_map(u64::to_le_bytes).collect();
        content.extend(crc32fast::hash(&chunk.records).to_le_bytes());
        content.extend(text(""));
        content.extend(size.to_le_bytes());
        content.extend(&chunk.records);
        self.put(&record(kind::CHUNK, &content))?;
        let indexes = self.position;
        let mut places = Vec::new();
        for (channel, messages) in &chunk.index {
            places.extend(channel.to_le_bytes());
            places.extend(self.position.to_le_bytes());
            let pairs = messages.iter().flat_map(|(time, place)| [*time, *place]);
            let entries: Vec<u8> = pairs.flat_map(u64::to_le_bytes).collect();
            let content = [&channel.to_le_bytes()[..], &counted(&entries)].concat();
            self.put(&record(kind::MESSAGE_INDEX, &content))?;
        }
        let mut index: Vec<u8> =
            [first, last, begin, indexes - begin].into_iter().flat_map(u64::to_le_bytes).collect();
        index.extend(counted(&places));
        index.extend((self.position - indexes).to_le_bytes());
        index.extend(text(""));
        index.extend([size, size].into_iter().flat_map(u64::to_le_bytes));
        self.chunks.push(index);
        Ok(())
    }

    fn statistics(&self) -> Vec<u8> {
        let Span(first, last) = self.span.unwrap_or(Span(0, 0));
        let mut content = self.counts.values().sum::<u64>().to_le_bytes().to_vec();
        content.extend(self.channels.to_le_bytes());
        content.extend(u32::from(self.channels).to_le_bytes());
        // neither attachments nor metadata
        content.extend([0_u32, 0, self.chunks.len() as u32].into_iter().flat_map(u32::to_le_bytes));
        content.extend([first, last].into_iter().flat_map(u64::to_le_bytes));
        let count = |(channel, count): (&u16, &u64)| {
            [&channel.to_le_bytes()[..], &count.to_le_bytes()].concat()
        };
        content.extend(counted(&self.counts.iter().flat_map(count).collect::<Vec<u8>>()));
        content
    }
}

fn record(kind: u8, content: &[u8]) -> Vec<u8> {
    [&[kind][..], &(content.len() as u64).to_le_bytes(), content].concat()
}

/// Bytes behind their number.
fn counted(bytes: &[u8]) -> Vec<u8> {
    [&(bytes.len() as u32).to_le_bytes()[..], bytes].concat()
}

fn text(text: &str) -> Vec<u8> {
    counted(text.as_bytes())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Kinds and contents of the records of a file.
    fn records(bytes: &[u8]) -> Vec<(u8, &[u8])> {
        let mut rest = bytes.strip_prefix(MAGIC).and_then(|own| own.strip_suffix(MAGIC)).unwrap();
        let mut all = Vec::new();
        while let [kind, tail @ ..] = rest {
            let (size, tail) = tail.split_at(8);
            let (content, tail) =
                tail.split_at(u64::from_le_bytes(size.try_into().unwrap()) as usize);
            all.push((*kind, content));
            rest = tail;
        }
        all
    }

    #[test]
    fn a_file_has_its_messages_in_chunks_and_finds_them_by_its_summary() {
        let mut bytes = Vec::new();
        let mut file = McapFile::new(&mut bytes, Encoding::JSON).unwrap();
        let channel = file.channel("/a", &Schema { name: "b", text: "{}" }).unwrap();
        let data = vec![b'x'; CHUNK / 2];
        for time in [5, 7, 6] {
            file.write(channel, time, &data).unwrap();
        }
        file.finish().unwrap();
        let all = records(&bytes);
        let kinds: Vec<u8> = all.iter().map(|own| own.0).collect();
        assert_eq!(kinds, [1, 3, 4, 6, 7, 6, 7, 0x0F, 3, 4, 0x0B, 8, 8, 2]);
        let number =
            |content: &[u8], at: usize| u64::from_le_bytes(content[at..at + 8].try_into().unwrap());
        let (_, statistics) = all[10];
        assert_eq!(
            (number(statistics, 0), number(statistics, 26), number(statistics, 34)),
            (3, 5, 7)
        );
        // the second chunk stands where its index says
        let begin = number(all[12].1, 16) as usize;
        assert_eq!(bytes[begin], kind::CHUNK);
        assert_eq!(number(&bytes[begin + 1..], 0) + 9, number(all[12].1, 24));
        // and the summary where the footer says
        assert_eq!(bytes[number(all[13].1, 0) as usize], kind::SCHEMA);
    }
}
