//! SBF of a recorded receiver against RINEX that an independent program made of the same bytes.

#![allow(clippy::unwrap_used, clippy::panic, dead_code)] // helpers of tests are not seen as tests

#[path = "raw_gnss/rinex.rs"]
mod rinex;

use insd_base::satellites::{SatelliteEpoch, SignalObservation};
use insd_wire::gnss::navigation::NavigationAssembler;
use insd_wire::gnss::sbf::{MeasEpoch, RawNavigation, SbfMessage, SbfStamp};
use insd_wire::stream::{Cutter, Protocol};
use rinex::Compared;

const MEASUREMENTS: &[u8] = include_bytes!("data/x5_measurements.sbf");
const NAVIGATION: &[u8] = include_bytes!("data/x5_rawnav.sbf");

fn blocks(bytes: &[u8]) -> Vec<Vec<u8>> {
    let mut cutter = Cutter::new(&[Protocol::Sbf]);
    cutter.push(bytes);
    std::iter::from_fn(|| cutter.cut().map(|cut| cut.bytes.to_vec())).collect()
}

fn messages(bytes: &[u8]) -> Vec<SbfMessage> {
    blocks(bytes).iter().filter_map(|block| SbfMessage::read(block).ok()).collect()
}

fn measured() -> (MeasEpoch, SatelliteEpoch) {
    let block = messages(MEASUREMENTS).into_iter().find_map(|message| match message {
        SbfMessage::MeasEpoch(block) => Some(block),
        _ => None,
    });
    let block = block.unwrap();
    let epoch = block.epoch(block.clock_jumps).unwrap();
    (block, epoch)
}

#[test]
fn a_recorded_epoch_says_what_rinex_of_another_program_says() {
    let (_, epoch) = measured();
    let told = include_str!("data/x5_measurements.obs");
    // convbin 2.4.3 writes densities in other units, and a phase where the block says that there is none
    let is_left_out = |name: &str| name[4..].starts_with('S') || name == "E10 L7Q";
    let compared = rinex::compare_observations(std::slice::from_ref(&epoch), told, is_left_out);
    let Compared { codes, phases, dopplers, half_cycles, .. } = compared;
    assert_eq!([codes, phases, dopplers, half_cycles], [78, 76, 78, 0]);
    let density = |own: &SignalObservation| own.cn0.unwrap();
    assert!(epoch.signals.iter().map(density).all(|cn0| (15.0..60.0).contains(&cn0)));
}

#[test]
fn the_clock_was_set_where_its_jumps_are_another_count() {
    let (block, epoch) = measured();
    assert!(!epoch.clock_reset);
    let other = block.clock_jumps.map(|jumps| jumps.wrapping_add(1));
    assert!(block.epoch(other).unwrap().clock_reset);
    assert!(!block.epoch(None).unwrap().clock_reset);
}

#[test]
fn what_is_written_is_read() {
    let (block, _) = measured();
    assert_eq!(MeasEpoch::read(&block.write()), Ok(block));
    let raw = |message: SbfMessage| match message {
        SbfMessage::RawNavigation(block) => Some(block),
        _ => None,
    };
    let blocks: Vec<_> = messages(NAVIGATION).into_iter().filter_map(raw).collect();
    for block in blocks {
        assert_eq!(RawNavigation::read(&block.write()), Ok(block));
    }
}

#[test]
fn recorded_navigation_bits_pass_the_checks_of_their_messages() {
    let mut heard = Vec::new();
    for message in messages(NAVIGATION) {
        let SbfMessage::RawNavigation(block) = message else { continue };
        let words = block.navigation().unwrap();
        let taken = NavigationAssembler::new().take(&words, block.stamp.gps().unwrap());
        assert_eq!(taken, Ok(Vec::new()), "{words:?}");
        heard.push(format!("{} {}", words.satellite, words.signal));
    }
    assert_eq!(heard, ["E36 1B", "C05 2I", "R19 1C", "G01 1C", "E36 5I"]);
}

#[test]
fn recorded_blocks_that_are_cut_or_have_wrong_bits_make_nothing_panic() {
    for block in [blocks(MEASUREMENTS), blocks(NAVIGATION)].concat() {
        let frame = insd_wire::gnss::sbf::Frame::open(&block).unwrap();
        for bit in 0..frame.payload.len() * 8 {
            let mut payload = frame.payload.to_vec();
            payload[bit / 8] ^= 1 << (bit % 8);
            for payload in [&payload[..], &frame.payload[..bit / 8]] {
                let wrong = insd_wire::gnss::sbf::Frame { payload, ..frame }.write();
                match SbfMessage::read(&wrong) {
                    Ok(SbfMessage::MeasEpoch(block)) => drop(block.epoch(None)),
                    Ok(SbfMessage::RawNavigation(block)) => {
                        let words = block.navigation();
                        let now = SbfStamp::default()
                            .gps()
                            .unwrap_or(insd_base::GpsTime::from_week(2381, 0));
                        words.map(|words| NavigationAssembler::new().take(&words, now));
                    }
                    _ => {}
                }
            }
        }
    }
}
