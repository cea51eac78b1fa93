//! Whole files with known numbers of epochs and records, in a folder that `INSD_RAW_GNSS` names; it is too large to stand here.

#![allow(clippy::unwrap_used)] // helpers of tests are not seen as tests

mod checks;

use std::path::{Path, PathBuf};
use std::process::Command;

use insd_rinex::read_navigation;

/// Folder, file and number of epochs. All are without flaws.
const OBSERVATIONS: [(&str, &str, usize); 8] = [
    ("moving-5km", "SEPT265G.21O.gz", 360),
    ("moving-5km", "3034265G.21O.gz", 360),
    ("pair-1m", "rover.obs.gz", 301),
    ("pair-1m", "base.obs.gz", 301),
    ("common-clock-1p6m", "WTZR00DEU_R_20201770000_01D_30S_MO_120epoch.rnx.gz", 120),
    ("common-clock-1p6m", "WTZZ00DEU_R_20201770000_01D_30S_MO_120epoch.rnx.gz", 120),
    ("geonet-3km", "07590920.05o", 120),
    ("geonet-3km", "30400920.05o", 120),
];

/// Folder, file and number of records.
const MESSAGES: [(&str, &str, usize); 6] = [
    ("moving-5km", "SEPT2650.21P", 321),
    ("pair-1m", "base.nav", 134),
    ("common-clock-1p6m", "ESBC00DNK_R_20201770000_01D_MN.rnx.gz", 2216),
    ("common-clock-1p6m", "ESBC00DNK_R_20201770000_01D_RN.rnx", 510),
    ("geonet-3km", "07590920.05n", 162),
    ("geonet-3km", "30400920.05n", 164),
];

fn folder() -> Option<PathBuf> {
    let folder = std::env::var_os("INSD_RAW_GNSS").map(PathBuf::from);
    if folder.is_none() {
        println!("skipped: INSD_RAW_GNSS names no folder");
    }
    folder
}

fn contents(path: &Path) -> Vec<u8> {
    if path.extension().is_some_and(|extension| extension == "gz") {
        return Command::new("gzip").arg("-dc").arg(path).output().unwrap().stdout;
    }
    std::fs::read(path).unwrap()
}

#[test]
fn whole_files_of_observations_have_their_epochs_and_come_back() {
    let Some(folder) = folder() else { return };
    for (set, name, count) in OBSERVATIONS {
        let bytes = contents(&folder.join(set).join(name));
        let (header, epochs, flaws) = checks::observations(&bytes).unwrap();
        assert_eq!((epochs.len(), flaws.len()), (count, 0), "{name}: {flaws:?}");
        let text = insd_rinex::write_observations(&header, &epochs);
        let (again, back, flaws) = checks::observations(text.as_bytes()).unwrap();
        assert!(flaws.is_empty() && back == epochs, "{name} does not come back");
        assert!(
            insd_rinex::write_observations(&again, &back) == text,
            "{name} is written otherwise"
        );
    }
}

/// Records by their first lines: those that do not begin with a blank, or in version 2 with a number in two columns.
fn first_lines(bytes: &[u8]) -> usize {
    let text = String::from_utf8_lossy(bytes);
    let body = text.split("END OF HEADER").last().unwrap_or_default();
    body.lines().skip(1).filter(|line| line.len() > 2 && !line[..2].trim().is_empty()).count()
}

#[test]
fn whole_files_of_messages_have_their_records_and_come_back() {
    let Some(folder) = folder() else { return };
    for (set, name, count) in MESSAGES {
        let bytes = contents(&folder.join(set).join(name));
        let read = read_navigation(&bytes).unwrap();
        assert_eq!((read.flaws.total, read.skipped), (0, 0), "{name}: {:?}", read.flaws);
        assert_eq!((read.records.len(), first_lines(&bytes)), (count, count), "{name}");
        let text = insd_rinex::write_navigation(&read.records, &read.ionosphere, read.leap_seconds);
        let back = read_navigation(&text).unwrap();
        assert!(back.records == read.records, "{name} does not come back");
        assert_eq!(back.ionosphere, read.ionosphere);
    }
}
