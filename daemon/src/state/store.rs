//! Two files in turn, each whole or not there, each with a version and a checksum: whatever happens while
//! one is written, the other can be read.

use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use crc::{CRC_32_ISO_HDLC, Crc};

use super::Boot;

/// What a file begins with; the last two bytes are the version of the format.
const MAGIC: [u8; 10] = *b"INSDKEPT\x00\x01";
/// Longest file that is read, bytes.
const MAX_LENGTH: u64 = 1 << 20;

const CRC: Crc<u32> = Crc::<u32>::new(&CRC_32_ISO_HDLC);

/// What is kept of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct Kept {
    /// When it was valid.
    pub made: Boot,
    /// What the engine made.
    pub state: Vec<u8>,
}

/// What was found.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Loaded {
    /// The newest that is whole.
    pub kept: Option<Kept>,
    /// What is wrong with the others, in words.
    pub faults: Vec<String>,
}

/// Two files of a folder.
#[derive(Clone, Debug)]
pub struct Store {
    files: [PathBuf; 2],
    /// Number of what is written next; grows. `None` before it was looked what there is.
    next: Option<u64>,
}

impl Store {
    /// The files `NAME.0` and `NAME.1` of a folder. Nothing is read or written yet.
    #[must_use]
    pub fn new(folder: &Path, name: &str) -> Self {
        Store { files: [0, 1].map(|half| folder.join(format!("{name}.{half}"))), next: None }
    }

    /// Reads the newest that is whole.
    #[must_use]
    pub fn load(&self) -> Loaded {
        let (found, faults) = self.look();
        let kept = found.into_iter().max_by_key(|(number, _)| *number).map(|(_, kept)| kept);
        Loaded { kept, faults }
    }

    /// Writes what is to be kept in the place of the older of the two; `durable` waits until the disk has it.
    ///
    /// # Errors
    /// What the system said; then both files are as they were.
    pub fn save(&mut self, kept: &Kept, durable: bool) -> io::Result<()> {
        let number = self.next.unwrap_or_else(|| {
            let (found, _) = self.look();
            found.iter().map(|(number, _)| number + 1).max().unwrap_or(0)
        });
        let place = &self.files[usize::from(number % 2 == 1)];
        let fresh = place.with_extension("new");
        let written = write(&fresh, &bytes(number, kept)?, durable);
        let moved = written.and_then(|()| fs::rename(&fresh, place));
        if moved.is_err() {
            // a file that is half written would fill a disk that is full already
            let _ = fs::remove_file(&fresh);
        } else {
            self.next = Some(number + 1);
        }
        moved
    }

    fn look(&self) -> (Vec<(u64, Kept)>, Vec<String>) {
        let (mut found, mut faults) = (Vec::new(), Vec::new());
        for file in &self.files {
            match read(file) {
                Ok(Some(numbered)) => found.push(numbered),
                Ok(None) => {}
                Err(fault) => faults.push(format!("{}: {fault}", file.display())),
            }
        }
        (found, faults)
    }
}

fn write(place: &Path, bytes: &[u8], durable: bool) -> io::Result<()> {
    let mut file = File::create(place)?;
    file.write_all(bytes)?;
    if durable { file.sync_all() } else { Ok(()) }
}

fn bytes(number: u64, kept: &Kept) -> io::Result<Vec<u8>> {
    let made = serde_json::to_vec(&kept.made)?;
    let length = u32::try_from(made.len()).unwrap_or(u32::MAX);
    let mut body = number.to_le_bytes().to_vec();
    body.extend(length.to_le_bytes());
    body.extend(made);
    body.extend(&kept.state);
    let mut bytes = MAGIC.to_vec();
    bytes.extend(CRC.checksum(&body).to_le_bytes());
    bytes.extend(body);
    Ok(bytes)
}

/// `None` where there is no file.
fn read(place: &Path) -> Result<Option<(u64, Kept)>, String> {
    let about = match fs::metadata(place) {
        Err(fault) if fault.kind() == io::ErrorKind::NotFound => return Ok(None),
        about => about.map_err(|fault| fault.to_string())?,
    };
    if about.len() > MAX_LENGTH {
        return Err(format!("longer than {MAX_LENGTH} bytes, which no kept state is"));
    }
    let bytes = fs::read(place).map_err(|fault| fault.to_string())?;
    parse(&bytes).map(Some)
}

fn parse(bytes: &[u8]) -> Result<(u64, Kept), String> {
    let (magic, rest) = bytes.split_at_checked(MAGIC.len()).ok_or("too short")?;
    if magic != MAGIC {
        let known = magic.starts_with(&MAGIC[..8]);
        let fault = if known { "of a version that is not known" } else { "not a kept state" };
        return Err(fault.to_owned());
    }
    let (sum, body) = rest.split_first_chunk::<4>().ok_or("too short")?;
    if CRC.checksum(body) != u32::from_le_bytes(*sum) {
        return Err("damaged: the checksum is wrong".to_owned());
    }
    let (number, rest) = body.split_first_chunk::<8>().ok_or("too short")?;
    let (length, rest) = rest.split_first_chunk::<4>().ok_or("too short")?;
    let length = usize::try_from(u32::from_le_bytes(*length)).unwrap_or(usize::MAX);
    let (made, state) = rest.split_at_checked(length).ok_or("too short")?;
    let made = serde_json::from_slice(made).map_err(|fault| fault.to_string())?;
    Ok((u64::from_le_bytes(*number), Kept { made, state: state.to_vec() }))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn kept(state: &[u8]) -> Kept {
        Kept { made: Boot::made_up(1, 2.5), state: state.to_vec() }
    }

    #[test]
    fn the_newest_is_read_and_the_one_before_when_that_is_damaged() {
        let folder = tempfile::tempdir().unwrap();
        let mut store = Store::new(folder.path(), "own");
        assert_eq!(store.load(), Loaded::default());
        for number in 0..5 {
            store.save(&kept(&[number]), true).unwrap();
            assert_eq!(store.load().kept, Some(kept(&[number])));
        }
        // another process goes on with the numbers
        let mut other = Store::new(folder.path(), "own");
        other.save(&kept(&[5]), false).unwrap();
        assert_eq!(other.load().kept, Some(kept(&[5])));
        fs::write(folder.path().join("own.1"), b"nothing good").unwrap();
        let loaded = other.load();
        assert_eq!(loaded.kept, Some(kept(&[4])));
        assert_eq!(loaded.faults.len(), 1);
    }

    #[test]
    fn what_cannot_be_written_leaves_both_files_as_they_were() {
        let folder = tempfile::tempdir().unwrap();
        let mut store = Store::new(&folder.path().join("gone"), "own");
        assert!(store.save(&kept(&[1]), true).is_err());
    }

    proptest! {
        #[test]
        fn any_damage_is_found(flip in 0_usize..60, bit in 0_u8..8, cut in 0_usize..60) {
            let good = bytes(7, &kept(&[1, 2, 3])).unwrap();
            prop_assert_eq!(parse(&good), Ok((7, kept(&[1, 2, 3]))));
            let mut bad = good.clone();
            bad[flip % good.len()] ^= 1 << bit;
            prop_assert!(parse(&bad).is_err());
            prop_assert!(parse(&good[..cut % good.len()]).is_err());
        }

        #[test]
        fn no_bytes_make_it_panic(bytes in proptest::collection::vec(any::<u8>(), 0..200)) {
            prop_assert!(parse(&bytes).is_err());
        }
    }
}
