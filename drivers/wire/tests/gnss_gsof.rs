//! Trimble GSOF: the values that the maker's own driver has in its tests, and reports of several pages.

#![allow(clippy::unwrap_used, clippy::panic)] // helpers of tests are not seen as tests

use insd_base::{FixQuality, GpsTime};
use insd_wire::gnss::EpochTime;
use insd_wire::gnss::gsof::{GsofRecord, GsofReport, Page, Pages, PositionTime};
use insd_wire::stream::{Cutter, Look, Protocol};

/// A report of the records whose values stand in the tests of `trimble-oss/trimble_driver_ros` (BSD-2-Clause, copyright Trimble Inc.):
/// 1, 2, 8, 9, 12, 16 and 27, packed by Python's `struct`.
const REPORT: &str = "01 0a 09a9b58f08b119af0000
    02 18 3fe87e6b7599e010bff633d4feca75da4065080000000000
    08 0d 053bc3ae2b4003fb9cba266c09
    09 10 3f6668dc3efa30863f417e6f3f91daf1
    0c 26 3a83126f3e4d45af3c9f7984b998c57e3c8ab5393e4d47143c9f067742b4d6ba3f8000000000
    10 09 09a9b58f08b1001203
    1b 46 09a9b58f0f1b0300bf7c5cb042bccef740090e121e46755c400916046c5934c80000000000000000000a36841a0837e36a1636806cdb00000000000000000000000000000000";

fn hex(text: &str) -> Vec<u8> {
    let digits: Vec<u8> = text.bytes().filter(u8::is_ascii_hexdigit).collect();
    let byte = |pair: &[u8]| u8::from_str_radix(std::str::from_utf8(pair).unwrap(), 16).unwrap();
    digits.chunks(2).map(byte).collect()
}

fn near(found: Option<f64>, expected: f64) {
    let found = found.unwrap();
    assert!((found - expected).abs() <= 1e-7 * expected.abs(), "{found} {expected}");
}

#[test]
fn a_report_has_the_values_of_the_makers_driver() {
    let part = GsofReport::read(&hex(REPORT)).unwrap().part().unwrap();
    let time = GpsTime::from_week(2225, 162_117_007_000_000);
    assert_eq!(part.epoch, Some(EpochTime::Gps(time)));
    assert_eq!((part.quality, part.satellites), (Some(FixQuality::Autonomous), Some(25)));
    assert_eq!((part.leap_seconds, part.invalid), (Some(18), false));
    let place = part.position.unwrap();
    assert_eq!(
        (place.latitude, place.longitude, place.height),
        (0.765_432_1, -1.387_654_3, 168.25)
    );
    near(part.hdop, 0.488_651_454);
    let [north, east, down] = part.position_std;
    near(north, 0.019_467_122_9);
    near(east, 0.200_461_134);
    near(down, 0.016_932_116_8);
    let [north, east, down] = part.velocity;
    near(north, 0.005_971_69 * 2.062_232_f64.cos());
    near(east, 0.005_971_69 * 2.062_232_f64.sin());
    near(down, 0.000_634_849_6);
}

#[test]
fn a_fixed_line_of_two_antennas_is_a_heading_with_its_sigma() {
    let heading = GsofReport::read(&hex(REPORT)).unwrap().heading().unwrap();
    assert_eq!(heading.epoch, Some(EpochTime::TimeOfWeek(162_117_007_000_000)));
    near(heading.heading, 3.131_870_495_343_419);
    near(heading.heading_std, 0.000_027_109_908_8_f64.sqrt());
    let mut floating = hex(REPORT);
    let mode = floating.len() - 72 + 2 + 6;
    floating[mode] = 2;
    assert_eq!(GsofReport::read(&floating).unwrap().heading().unwrap().heading, None);
}

#[test]
fn a_report_is_written_as_it_came_on_one_page_and_on_several() {
    let records = hex(REPORT);
    assert_eq!(GsofReport::read(&records).unwrap().write(), records);
    let long = records.repeat(3);
    let pages = Page::pages(9, &long);
    assert_eq!(
        pages.iter().map(|page| (page.page, page.last)).collect::<Vec<_>>(),
        [(0, 2), (1, 2), (2, 2)]
    );
    let mut whole = Pages::default();
    let told: Vec<_> = pages.iter().map(|page| whole.take(page)).collect();
    assert_eq!(told, [None, None, Some(long)]);
    let mut torn = Pages::default();
    assert_eq!([&pages[0], &pages[2], &pages[1]].map(|page| torn.take(page)), [None, None, None]);
    let other = Page { transmission: 8, ..pages[1].clone() };
    assert_eq!([&pages[0], &other, &pages[2]].map(|page| torn.take(page)), [None, None, None]);
}

#[test]
fn packets_are_found_in_noise_whatever_the_chunks_and_flipped_ones_are_not() {
    let packets: Vec<u8> = Page::pages(1, &hex(REPORT)).iter().flat_map(Page::write).collect();
    let stream = [&b"\x02\x28\x40noise\x02"[..], &packets, &packets].concat();
    for size in [1, 7, stream.len()] {
        let mut cutter = Cutter::new(&Protocol::ALL);
        let mut found = 0;
        for chunk in stream.chunks(size) {
            cutter.push(chunk);
            while let Some(cut) = cutter.cut() {
                assert_eq!((cut.protocol, cut.bytes), (Protocol::Gsof, &packets[..]));
                found += 1;
            }
        }
        assert_eq!(found, 2, "chunks of {size}");
    }
    for bit in 0..packets.len() * 8 {
        let mut flipped = packets.clone();
        flipped[bit / 8] ^= 1 << (bit % 8);
        assert_ne!(Protocol::Gsof.look(&flipped), Look::Frame(packets.len()), "bit {bit}");
    }
}

#[test]
fn qualities_are_those_of_the_flags_and_an_old_position_is_none() {
    let of = |calculated, corrected| {
        let (milliseconds, week, satellites, initialisation) = (0, 2225, 9, 0);
        let time =
            PositionTime { milliseconds, week, satellites, calculated, corrected, initialisation };
        let report = GsofReport { records: vec![GsofRecord::Time(time)] };
        GsofReport::read(&report.write()).unwrap().part().unwrap().quality.unwrap()
    };
    for (corrected, quality) in [
        (0b000, FixQuality::Autonomous),
        (0b100, FixQuality::Differential),
        (0b001, FixQuality::Differential),
        (0b011, FixQuality::RtkFloat),
        (0b111, FixQuality::RtkFixed),
    ] {
        assert_eq!(of(0xAF, corrected), quality);
        assert_eq!(of(0xAE, corrected), FixQuality::Invalid, "not a new one");
        assert_eq!(of(0xAB, corrected), FixQuality::Invalid, "no horizontal place");
    }
}

#[test]
fn a_report_without_its_time_says_nothing_and_one_cut_short_is_refused() {
    let records = hex(REPORT);
    assert_eq!(GsofReport::read(&records[12..]).unwrap().part(), None);
    for length in (1..12).chain(13..38) {
        assert!(GsofReport::read(&records[..length]).is_err(), "{length}");
    }
}
