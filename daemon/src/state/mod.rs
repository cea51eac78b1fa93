//! What a run leaves for the next one: its navigation ([`Kept`]), saved a few times a second in memory and
//! every few seconds on the disk, and the state of a ship at her berth ([`insd_config::stored`]).

mod boot;
mod saver;
mod store;

pub use boot::Boot;
pub use saver::{Folders, Saver, SaverState};
pub use store::{Kept, Loaded, Store};

use std::path::{Path, PathBuf};

use insd_base::Span;
use insd_config::learning::newest;

/// Name of the files with the navigation.
const NAVIGATION: &str = "navigation";
/// Name of the file with the state of a ship at her berth.
const BERTH: &str = "berth.toml";
/// Name of the file with what was learnt of the sensors.
const LEARNT: &str = "sensors.toml";

/// What the run before has left.
#[derive(Clone, Debug, Default)]
pub struct Remains {
    /// Its navigation, and how old it is.
    pub navigation: Option<(Span, Vec<u8>)>,
    /// The state of the ship at her berth, as its file has it.
    pub berth: Option<String>,
    /// What was learnt of the sensors, as its file has it.
    pub learnt: Option<String>,
    /// What was found damaged or cannot be used, in words.
    pub faults: Vec<String>,
}

/// Looks for what the run before has left in the folders in memory and on the disk.
#[must_use]
pub fn remains(folders: &[PathBuf], now: &Boot) -> Remains {
    let mut remains = Remains::default();
    for folder in folders {
        let loaded = Store::new(folder, NAVIGATION).load();
        remains.faults.extend(loaded.faults);
        let berth = std::fs::read_to_string(berth(folder)).ok();
        remains.berth = remains.berth.or(berth);
        let learnt = newest(&learnt(folder));
        remains.faults.extend(learnt.faults);
        remains.learnt = remains.learnt.or(learnt.model.map(|(_, text)| text));
        let Some(kept) = loaded.kept else { continue };
        match now.since(&kept.made) {
            Some(age) => {
                let is_newer = remains.navigation.as_ref().is_none_or(|(other, _)| age < *other);
                if is_newer {
                    remains.navigation = Some((age, kept.state));
                }
            }
            None => remains.faults.push(format!(
                "{}: its age is not known, as the clock was set since",
                folder.display()
            )),
        }
    }
    remains
}

/// The file with what was learnt of the sensors.
#[must_use]
pub fn learnt(folder: &Path) -> PathBuf {
    folder.join(LEARNT)
}

/// The file with the state of a ship at her berth.
#[must_use]
pub fn berth(folder: &Path) -> PathBuf {
    folder.join(BERTH)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_two_folders_the_newer_navigation_counts() {
        let (memory, disk) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
        let at = |seconds: f64| Boot::made_up(7, seconds);
        for (folder, seconds, state) in [(&disk, 10.0, [1]), (&memory, 12.0, [2])] {
            let kept = Kept { made: at(seconds), state: state.to_vec() };
            Store::new(folder.path(), NAVIGATION).save(&kept, true).unwrap();
        }
        let folders = [memory.path().to_owned(), disk.path().to_owned()];
        let found = remains(&folders, &at(12.5));
        assert_eq!(found.navigation, Some((Span::from_seconds(0.5), vec![2])));
        assert_eq!(found.faults, Vec::<String>::new());
    }

    #[test]
    fn navigation_of_unknown_age_is_no_use_and_that_is_told() {
        let disk = tempfile::tempdir().unwrap();
        let later = Boot::made_up(7, 100.0);
        Store::new(disk.path(), NAVIGATION)
            .save(&Kept { made: later, state: vec![1] }, true)
            .unwrap();
        let found = remains(&[disk.path().to_owned()], &Boot::made_up(8, 50.0));
        assert_eq!(found.navigation, None);
        assert!(found.faults[0].contains("age is not known"), "{:?}", found.faults);
    }
}
