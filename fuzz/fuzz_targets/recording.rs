//! Any bytes as a recording, and as the body of a good block: no panic, an end, and the same answer
//! however the bytes are read.
#![no_main]

use std::io::{self, Cursor, Read};

use insd_drivers::raw::RawReader;
use libfuzzer_sys::fuzz_target;

/// A stream that gives a few bytes at a time.
struct Drops(Cursor<Vec<u8>>);

impl Read for Drops {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let length = buffer.len().min(7);
        self.0.read(&mut buffer[..length])
    }
}

/// All that a reader tells, as text.
fn told(input: impl Read + Send + 'static) -> Vec<String> {
    match RawReader::from_read("fuzz", input) {
        Ok(reader) => reader.map(|item| format!("{item:?}")).collect(),
        Err(fault) => vec![format!("{fault:?}")],
    }
}

/// A file with one block, as `docs/recording.md` describes it. The first byte is the number of records,
/// the next two how much longer the body becomes when it is unpacked.
fn file_with(bytes: &[u8]) -> Option<Vec<u8>> {
    let ([records, low, high], body) = bytes.split_first_chunk()?;
    let longer = u32::from(u16::from_le_bytes([*low, *high]));
    let stored = u32::try_from(body.len()).ok()?;
    let mut header = vec![1, 0, 0, 0, 26, 0, 0, 0];
    let check = crc32fast::hash(&[header.as_slice(), &[0; 26]].concat());
    header.extend(check.to_le_bytes());
    header.extend([0; 26]);
    let mut head = b"\xB1ins".to_vec();
    for number in [stored, stored + longer, u32::from(*records), 0, 0, crc32fast::hash(body)] {
        head.extend(number.to_le_bytes());
    }
    head.extend(crc32fast::hash(&head).to_le_bytes());
    Some([b"\x89INSDRAW".as_slice(), &header, &head, body].concat())
}

fuzz_target!(|bytes: &[u8]| {
    let whole = told(Cursor::new(bytes.to_vec()));
    assert_eq!(told(Drops(Cursor::new(bytes.to_vec()))), whole);
    // no item takes less than two bytes, apart from faults, which take a marker or a file each
    assert!(whole.len() <= 3 + bytes.len());
    if let Some(file) = file_with(bytes) {
        let told = told(Cursor::new(file));
        assert!(!told.iter().any(|item| item.contains("Header")), "{told:?}");
    }
});
