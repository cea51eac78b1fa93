//! Raw measurements and navigation words of a recorded receiver, against RINEX that an independent program made of the same bytes.
//!
//! A piece of the recording is in `tests/data`; the whole of it is read where `INSD_RAW_GNSS` names the folder that holds `gnss_1730.ubx.gz`.

#![allow(clippy::unwrap_used, clippy::panic)] // helpers of tests are not seen as tests

#[path = "raw_gnss/rinex.rs"]
mod rinex;

use std::collections::{BTreeMap, BTreeSet};
use std::path::PathBuf;
use std::process::Command;

use insd_base::GpsTime;
use insd_base::satellites::{
    BroadcastKind, BroadcastRecord, KeplerRecord, SatelliteEpoch, SatelliteId, SignalObservation,
};
use insd_wire::gnss::Locks;
use insd_wire::gnss::navigation::{Broadcast, NavigationAssembler};
use insd_wire::gnss::ubx::UbxMessage;
use insd_wire::stream::{Cutter, Protocol};

/// What a recording held.
#[derive(Default)]
struct Heard {
    epochs: Vec<SatelliteEpoch>,
    told: Vec<Broadcast>,
    /// Refusals by their text, and how often.
    refused: BTreeMap<String, usize>,
    words: usize,
}

/// Reads all of a recording.
fn hear(bytes: &[u8]) -> Heard {
    let mut heard = Heard::default();
    let (mut cutter, mut locks) = (Cutter::new(&[Protocol::Ubx, Protocol::Nmea]), Locks::new());
    let mut assembler = NavigationAssembler::new();
    let mut now = GpsTime::from_week(2381, 0);
    cutter.push(bytes);
    while let Some(cut) = cutter.cut() {
        if cut.protocol != Protocol::Ubx {
            continue;
        }
        match UbxMessage::read(cut.bytes) {
            Ok(UbxMessage::RxmRawx(raw)) => {
                let mut epoch = raw.epoch().unwrap();
                locks.mark(&mut epoch);
                now = epoch.tag;
                heard.epochs.push(epoch);
            }
            Ok(UbxMessage::RxmSfrbx(raw)) => {
                let Some(words) = raw.navigation() else { continue };
                heard.words += 1;
                match assembler.take(&words, now) {
                    Ok(told) => heard.told.extend(told),
                    Err(refusal) => {
                        let name = format!("{} {}: {refusal}", words.satellite, words.signal);
                        *heard.refused.entry(name).or_default() += 1;
                    }
                }
            }
            _ => {}
        }
    }
    heard
}

impl Heard {
    fn records(&self, kind: BroadcastKind) -> Vec<KeplerRecord> {
        let record = |told: &Broadcast| match told {
            Broadcast::Record(BroadcastRecord::Kepler(record)) => Some(*record),
            _ => None,
        };
        self.told.iter().filter_map(record).filter(|record| record.kind == kind).collect()
    }

    fn signals(&self) -> impl Iterator<Item = &SignalObservation> {
        self.epochs.iter().flat_map(|epoch| &epoch.signals)
    }

    /// Every record of a file is among those of one kind, all numbers the same; gives how many.
    fn compare_records(&self, navigation: &str, kind: BroadcastKind) -> usize {
        let own = self.records(kind);
        let is_same = |satellite| own.iter().filter(move |own| own.satellite == satellite);
        let told = rinex::records(navigation);
        let told = told.iter().filter(|(satellite, _)| is_same(*satellite).next().is_some());
        let compare = |(satellite, numbers): &(SatelliteId, Vec<f64>)| {
            let differing: Vec<_> =
                is_same(*satellite).map(|own| rinex::differing(own, numbers)).collect();
            assert!(differing.iter().any(Vec::is_empty), "{satellite}: {differing:?}");
        };
        told.map(compare).count()
    }

    /// Galileo sends the same orbit in two messages that are laid out otherwise; gives how many satellites sent both.
    fn compare_messages_of_galileo(&self) -> usize {
        let pages = self.records(BroadcastKind::Fnav);
        let same = |words: &&KeplerRecord| {
            let mut pages = pages.iter();
            let same = |page: &&KeplerRecord| {
                (page.satellite, page.issue) == (words.satellite, words.issue)
            };
            pages.find(same).is_some_and(|page| {
                assert_eq!((page.orbit, page.accuracy), (words.orbit, words.accuracy));
                assert_eq!(page.group_delays[0], words.group_delays[0]);
                true
            })
        };
        self.records(BroadcastKind::Inav).iter().filter(same).count()
    }
}

#[test]
fn a_piece_of_a_recording_says_what_rinex_of_another_program_says() {
    let heard = hear(include_bytes!("data/walk_1730.ubx"));
    assert!(heard.refused.is_empty(), "{:?}", heard.refused);
    let told = include_str!("data/walk_1730.obs");
    let compared = rinex::compare_observations(&heard.epochs, told, |_| false);
    assert_eq!(compared.phases, PIECE_PHASES);
    assert_eq!(compared.half_cycles, PIECE_HALF_CYCLES);
    let navigation = include_str!("data/walk_1730.nav");
    for kind in [BroadcastKind::Lnav, BroadcastKind::D1] {
        assert_eq!(heard.compare_records(navigation, kind), 1, "{kind:?}");
    }
    assert_eq!(heard.compare_messages_of_galileo(), 1);
    assert!(heard.told.contains(&Broadcast::LeapSeconds(18)));
}

/// Phases of the piece that RINEX has, and how many of them may be half a cycle off.
const PIECE_PHASES: usize = 126;
const PIECE_HALF_CYCLES: usize = 7;

#[test]
fn a_recording_that_is_cut_or_has_wrong_bits_makes_nothing_panic() {
    let piece = include_bytes!("data/walk_1730.ubx");
    for length in (0..piece.len()).step_by(97) {
        hear(&piece[..length]);
    }
    for byte in (0..piece.len()).step_by(61) {
        let mut wrong = piece.to_vec();
        wrong[byte] ^= 1 << (byte % 8);
        hear(&wrong);
    }
}

#[test]
fn words_with_a_wrong_bit_are_refused_or_say_the_same() {
    let piece = include_bytes!("data/walk_1730.ubx");
    let (mut cutter, mut words) = (Cutter::new(&[Protocol::Ubx]), Vec::new());
    cutter.push(piece);
    while let Some(cut) = cutter.cut() {
        if let Ok(UbxMessage::RxmSfrbx(raw)) = UbxMessage::read(cut.bytes) {
            words.extend(raw.navigation());
        }
    }
    for bit in 0..320 {
        let mut assembler = NavigationAssembler::new();
        for (number, words) in words.iter().enumerate() {
            let mut wrong = words.clone();
            let word = (bit / 32 + number) % wrong.words.len();
            wrong.words[word] ^= 1 << (bit % 32);
            let _ = assembler.take(&wrong, GpsTime::from_week(2381, 0));
        }
    }
}

#[test]
fn the_whole_recording_says_what_rinex_of_another_program_says() {
    let Some(folder) = std::env::var_os("INSD_RAW_GNSS").map(PathBuf::from) else { return };
    let unpacked = Command::new("gzip").arg("-dc").arg(folder.join("gnss_1730.ubx.gz")).output();
    let bytes = unpacked.unwrap().stdout;
    let heard = hear(&bytes);
    assert_eq!(heard.epochs.len(), 536);
    assert!(heard.refused.is_empty(), "{:?} of {} words", heard.refused, heard.words);
    for (kind, satellites) in [
        (BroadcastKind::Lnav, "G10 G23 G27 G32"),
        (BroadcastKind::Inav, "E07 E08 E13 E14 E26 E29 E33"),
        (BroadcastKind::D1, "C11 C21 C22 C34 C42 C43 C44 C50"),
    ] {
        let own: BTreeSet<_> = heard.records(kind).iter().map(|own| own.satellite).collect();
        let own: Vec<_> = own.iter().map(ToString::to_string).collect();
        assert_eq!(own.join(" "), satellites);
    }
    assert_eq!(heard.compare_messages_of_galileo(), 7);
    assert_eq!(heard.signals().filter(|signal| signal.phase.is_some()).count(), 33_560);
    assert_eq!(heard.signals().filter(|signal| signal.half_cycle).count(), 3243);
    against_convbin(&bytes, &heard);
}

/// Compares with what RTKLIB's convbin makes of the same bytes, where it is installed.
fn against_convbin(bytes: &[u8], heard: &Heard) {
    let folder = tempfile::tempdir().unwrap();
    let place = |name: &str| folder.path().join(name);
    std::fs::write(place("log.ubx"), bytes).unwrap();
    let mut command = Command::new("convbin");
    command.args(["-r", "ubx", "-v", "3.04", "-od", "-os", "-f", "5"]);
    command.arg("-o").arg(place("log.obs")).arg("-n").arg(place("log.nav"));
    let Ok(_) = command.arg(place("log.ubx")).output() else { return };
    let read = |name: &str| std::fs::read_to_string(place(name)).unwrap();
    let compared = rinex::compare_observations(&heard.epochs, &read("log.obs"), |_| false);
    assert_eq!(compared.codes, 12_735);
    assert_eq!(compared.phases, 8432);
    let navigation = read("log.nav");
    assert_eq!(heard.compare_records(&navigation, BroadcastKind::Lnav), 4);
    assert_eq!(heard.compare_records(&navigation, BroadcastKind::D1), 8);
}
