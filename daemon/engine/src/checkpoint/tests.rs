//! What the head of the bytes is for.

use super::*;

/// Bytes with a good sum that hold what is not a state.
fn sealed(version: u16, state: &[u8]) -> Vec<u8> {
    let mut bytes = MARK.to_vec();
    bytes.extend(version.to_le_bytes());
    bytes.extend(u32::try_from(state.len()).unwrap().to_le_bytes());
    bytes.extend(state);
    let sum = CRC.checksum(&bytes);
    bytes.extend(sum.to_le_bytes());
    bytes
}

#[test]
fn another_version_and_another_state_are_told_from_damage() {
    assert_eq!(read(&sealed(VERSION + 1, &[1, 2, 3])), Err(ResumeDoubt::OtherVersion));
    assert_eq!(read(&sealed(VERSION, &[1, 2, 3])), Err(ResumeDoubt::OtherVersion));
    assert_eq!(read(&sealed(VERSION, &[0; 30_000])), Err(ResumeDoubt::OtherVersion));
    let mut other = sealed(VERSION, &[1, 2, 3]);
    other[0] = b'x';
    assert_eq!(read(&other), Err(ResumeDoubt::Damaged));
    assert_eq!(read(&[0; LONGEST + 1]), Err(ResumeDoubt::Damaged));
}
