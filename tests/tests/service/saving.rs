//! Killed at any instant while it saves: what was saved can always be read, the newest or the one before.

use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::Duration;

use insd::clock::{HostClock, boot_now};
use insd::state::{Kept, Store};

const FOLDER: &str = "INSD_TEST_SAVES_TO";

/// Saves for ever, and says the number of each state when it is saved.
#[test]
#[ignore = "the other end of the next test"]
fn saves_until_it_is_killed() {
    let Some(folder) = std::env::var_os(FOLDER) else { return };
    let mut store = Store::new(Path::new(&folder), "navigation");
    let made = boot_now(&HostClock::start().now());
    for number in 0_u64.. {
        let mut state = vec![number as u8; 12_000];
        state[..8].copy_from_slice(&number.to_le_bytes());
        store.save(&Kept { made: made.clone(), state }, true).unwrap();
        println!("saved {number}");
    }
}

#[test]
fn killed_at_two_hundred_instants_while_it_saves_the_newest_state_or_the_one_before_can_be_read() {
    let folder = tempfile::tempdir().unwrap();
    let mut random = 88_172_645_463_325_252_u64;
    for round in 0..200 {
        let mut child = Command::new(std::env::current_exe().unwrap())
            .args(["--ignored", "--exact", "--nocapture", "saving::saves_until_it_is_killed"])
            .env(FOLDER, folder.path())
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        let mut lines = BufReader::new(child.stdout.take().unwrap()).lines();
        lines.find(|line| line.as_ref().is_ok_and(|line| line.contains("saved"))).unwrap().unwrap();
        random ^= random << 13;
        random ^= random >> 7;
        random ^= random << 17;
        std::thread::sleep(Duration::from_micros(random % 10_000));
        child.kill().unwrap();
        child.wait().unwrap();
        let said = lines.map_while(Result::ok).filter_map(|line| {
            line.split_once("saved ").and_then(|(_, number)| number.trim().parse::<u64>().ok())
        });
        let said = said.last().unwrap_or(0);
        let loaded = Store::new(folder.path(), "navigation").load();
        let state =
            loaded.kept.unwrap_or_else(|| panic!("round {round}: {:?}", loaded.faults)).state;
        let number = u64::from_le_bytes(state[..8].try_into().unwrap());
        assert!(number == said || number == said + 1, "round {round}: {number}, said {said}");
        assert!(state[8..].iter().all(|byte| *byte == number as u8));
        assert_eq!(loaded.faults, Vec::<String>::new());
    }
}
