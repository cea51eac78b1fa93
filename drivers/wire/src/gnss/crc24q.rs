//! Qualcomm's CRC of 24 bits, which RTCM 10403 and Galileo's pages have in common.

use crc::{CRC_24_LTE_A, Crc, Table};

/// The polynomial of LTE-A with the same start.
const CRC_24Q: Crc<u32, Table<16>> = Crc::<u32, Table<16>>::new(&CRC_24_LTE_A);

/// The sum of some bytes.
pub(super) fn crc24q(bytes: &[u8]) -> u32 {
    CRC_24Q.checksum(bytes)
}
