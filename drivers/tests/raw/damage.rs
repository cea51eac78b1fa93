//! Recordings that were cut short or damaged.

use std::fs;

use insd_base::Arrival;
use insd_drivers::raw::{RawFault, RawReader};
use proptest::prelude::*;
use tempfile::tempdir;

use crate::arrivals::{blocks, few_blocks, one_file, read, record};

/// The file that holds these blocks. Where the stamps leap by a second it has more and smaller ones.
fn file_of(blocks: &[Vec<Arrival>]) -> Vec<u8> {
    let folder = tempdir().unwrap();
    record(folder.path(), &one_file(), blocks);
    fs::read(folder.path().join("ship-000001.insdraw")).unwrap()
}

/// Whether `left` is `whole` without one piece.
fn lacks_one_piece(left: &[Arrival], whole: &[Arrival]) -> bool {
    let same = left.iter().zip(whole).take_while(|(a, b)| a == b).count();
    (0..=same).any(|start| whole[whole.len() - (left.len() - start)..] == left[start..])
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(12))]

    #[test]
    fn a_file_cut_anywhere_gives_the_arrivals_before(blocks in few_blocks()) {
        let whole = blocks.concat();
        let file = file_of(&blocks);
        let mut most = 0;
        for end in 1..=file.len() {
            let reader = RawReader::from_bytes("cut", file[..end].to_vec()).unwrap();
            let (arrivals, faults) = read(reader);
            prop_assert!(whole.starts_with(&arrivals));
            prop_assert!(arrivals.len() >= most, "a longer file gives less");
            prop_assert!(faults.len() <= 1, "{:?}", faults);
            most = arrivals.len();
        }
        prop_assert_eq!(most, whole.len());
    }

    #[test]
    fn a_wrong_bit_costs_its_block_alone_and_is_told(blocks in few_blocks()) {
        let whole = blocks.concat();
        let mut file = file_of(&blocks);
        for bit in 0..file.len() * 8 {
            file[bit / 8] ^= 1 << (bit % 8);
            let (arrivals, faults) = read(RawReader::from_bytes("bit", file.clone()).unwrap());
            file[bit / 8] ^= 1 << (bit % 8);
            prop_assert!(!faults.is_empty(), "bit {} is not told", bit);
            prop_assert!(arrivals.len() <= whole.len() && lacks_one_piece(&arrivals, &whole));
            let most = blocks.iter().map(Vec::len).max().unwrap_or(0);
            prop_assert!(whole.len() - arrivals.len() <= most, "bit {} costs too much", bit);
        }
    }

    #[test]
    fn many_wrong_bytes_do_no_harm(
        blocks in few_blocks(),
        wrong in proptest::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..20),
    ) {
        let whole = blocks.concat();
        let mut file = file_of(&blocks);
        for (at, byte) in wrong {
            let at = at.index(file.len());
            file[at] = byte;
        }
        if let Ok(reader) = RawReader::from_bytes("wrong", file) {
            let (arrivals, _) = read(reader);
            let mut rest = whole.iter();
            prop_assert!(arrivals.iter().all(|arrival| rest.any(|other| other == arrival)));
        }
    }
}

#[test]
fn a_damaged_block_is_told_with_its_place_and_what_it_held() {
    let blocks = blocks(3);
    let mut file = file_of(&blocks);
    let marker = b"\xB1ins";
    let starts: Vec<usize> = (0..file.len()).filter(|at| file[*at..].starts_with(marker)).collect();
    file[starts[1] + 40] ^= 4;
    let (arrivals, faults) = read(RawReader::from_bytes("x", file).unwrap());
    assert_eq!(arrivals, [blocks[0].clone(), blocks[2].clone()].concat());
    let length = (starts[2] - starts[1]) as u64;
    assert!(matches!(&faults[0], RawFault::Damaged { offset, bytes, .. }
        if *offset == starts[1] as u64 && *bytes == length));
    assert_eq!(faults[0].to_string(), format!("x: {length} damaged bytes at byte {}", starts[1]));
}

#[test]
fn what_is_no_recording_is_refused_with_its_reason() {
    let mut newer = file_of(&blocks(1));
    let refuse = |bytes: &[u8]| RawReader::from_bytes("x", bytes.to_vec()).unwrap_err();
    assert!(matches!(refuse(b""), RawFault::Empty { .. }));
    assert!(matches!(refuse(b"t_s,dtheta_x_rad\n0,0\n"), RawFault::Foreign { .. }));
    newer[8] = 7;
    let length = 20 + u32::from_le_bytes(newer[12..16].try_into().unwrap()) as usize;
    let check = crc32fast::hash(&[&newer[8..16], &newer[20..length]].concat());
    newer[16..20].copy_from_slice(&check.to_le_bytes());
    assert_eq!(refuse(&newer).to_string(), "x: format version 7; this program reads up to 1");
}
