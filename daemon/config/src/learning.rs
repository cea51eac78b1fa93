//! Learning the sensors: `[learning]`, and the file of what was learnt with the generations before it.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use insd_engine::KeptModel;
use schemars::JsonSchema;
use serde::Deserialize;

use crate::output_file;

/// Generations that stay beside the file, as FILE.1, the one before, to FILE.4.
const BEFORE: u32 = 4;

/// Learning what repeats of the errors of log and IMU while she is well aided (docs/learning.md).
#[derive(Clone, Copy, Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct LearningSection {
    /// Whether anything is learnt.
    pub enabled: bool,
    /// Whether it may be used; what is learnt and kept does not depend on it.
    #[serde(rename = "use")]
    pub is_used: bool,
    /// Time between two states of what is learnt on the disk, in the folder of `[state]`, s.
    pub interval_s: f64,
}

impl Default for LearningSection {
    fn default() -> Self {
        LearningSection { enabled: true, is_used: true, interval_s: 600.0 }
    }
}

impl LearningSection {
    pub(crate) fn faults(&self) -> impl Iterator<Item = String> {
        let is_sane = (10.0..=86_400.0).contains(&self.interval_s);
        let fault = "[learning]: interval_s: expected 10 to 86400 s".to_owned();
        (!is_sane).then_some(fault).into_iter()
    }
}

/// What a file was found to hold.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct FoundModel {
    /// The newest generation that can be read, with its text.
    pub model: Option<(KeptModel, String)>,
    /// What is wrong with newer ones, in words.
    pub faults: Vec<String>,
}

/// The newest generation of a file that can be read: one that is damaged is passed over.
#[must_use]
pub fn newest(file: &Path) -> FoundModel {
    let mut found = FoundModel::default();
    for place in std::iter::once(file.to_owned()).chain((1..=BEFORE).map(|n| before(file, n))) {
        let text = match fs::read_to_string(&place) {
            Ok(text) => text,
            Err(fault) if fault.kind() == io::ErrorKind::NotFound => continue,
            Err(fault) => {
                found.faults.push(format!("{}: {fault}", place.display()));
                continue;
            }
        };
        match KeptModel::parse(&text) {
            Ok(model) => {
                found.model = Some((model, text));
                break;
            }
            Err(fault) => found.faults.push(format!("{}: {fault}", place.display())),
        }
    }
    found
}

/// Puts a model in the place of the file, whole or not at all. A generation before it that can be read stays beside it.
///
/// # Errors
/// What the system said; then what was there can still be read.
pub fn keep(file: &Path, model: &KeptModel) -> io::Result<()> {
    let there = fs::read_to_string(file).ok().and_then(|text| KeptModel::parse(&text).ok());
    if there.is_some_and(|there| there.generation != model.generation) {
        for n in (1..BEFORE).rev() {
            match fs::rename(before(file, n), before(file, n + 1)) {
                Err(fault) if fault.kind() != io::ErrorKind::NotFound => return Err(fault),
                _ => {}
            }
        }
        // copied, not moved: whoever is stopped here leaves the file in its place
        fs::copy(file, before(file, 1))?;
    }
    output_file::replace(file, &model.text())
}

fn before(file: &Path, n: u32) -> PathBuf {
    let mut name = file.as_os_str().to_owned();
    name.push(format!(".{n}"));
    name.into()
}

#[cfg(test)]
mod tests {
    use insd_base::{Arrival, Input, Order, PortId, Stamp, Time, UtcTime};
    use insd_engine::KeptFault;
    use insd_vessel::{Obeyed, Product};

    use super::*;
    use crate::file::Config;

    fn model(generation: u32) -> KeptModel {
        let text = include_str!("../tests/learnt.toml");
        let mut own = KeptModel::parse(text).unwrap();
        own.generation = generation;
        own
    }

    #[test]
    fn a_model_is_an_order_and_a_switch_keeps_it_from_being_used() {
        let config = Config::of_text(include_str!("../../../systemd/insd.toml")).unwrap();
        let mut pipeline = config.pipeline();
        let mut order = |order: Order| {
            let at = Time::from_seconds(1.0);
            let stamp = Stamp { monotonic: at, system: UtcTime::from_nanos(0) };
            let arrival = Arrival { stamp, port: PortId(9), input: Input::Order(order) };
            let mut obeyed = None;
            pipeline.handle(&arrival, |product| {
                if let Product::Order(own) = product {
                    obeyed = Some(own);
                }
            });
            (obeyed.unwrap(), pipeline.engine().learning().unwrap())
        };
        let text = include_str!("../tests/learnt.toml");
        let (obeyed, status) = order(Order::LearntModel(text.to_owned()));
        assert_eq!(obeyed, Obeyed::LearntOffered);
        assert_eq!((status.kept.log.labels, status.kept.generation), (4920, 4));
        assert_eq!((status.may_be_used, status.used), (true, [false, true, false]));
        let (obeyed, status) = order(Order::UseLearnt(false));
        assert_eq!(obeyed, Obeyed::LearntUse(false));
        assert_eq!((status.may_be_used, status.used), (false, [false; 3]));
        let (obeyed, status) = order(Order::LearntModel(text.replace("labels", "lables")));
        assert_eq!(obeyed, Obeyed::LearntRefused(KeptFault::Checksum));
        assert_eq!((status.may_be_used, status.kept.log.labels), (false, 4920));
        assert_eq!(order(Order::UseLearnt(true)).1.used, [false, true, false]);
    }

    #[test]
    fn five_generations_are_kept_and_one_that_is_written_again_is_one() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("sensors.toml");
        assert_eq!(newest(&file), FoundModel::default());
        for generation in [1, 2, 2, 3, 4, 5, 6, 6] {
            keep(&file, &model(generation)).unwrap();
        }
        let kept = |place: PathBuf| newest(&place).model.unwrap().0.generation;
        assert_eq!(kept(file.clone()), 6);
        assert_eq!([1, 2, 3, 4].map(|n| kept(before(&file, n))), [5, 4, 3, 2]);
        assert!(!before(&file, 5).exists());
    }

    #[test]
    fn a_damaged_one_is_rolled_back_told_and_never_becomes_a_generation() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("sensors.toml");
        keep(&file, &model(7)).unwrap();
        keep(&file, &model(8)).unwrap();
        let whole = fs::read_to_string(&file).unwrap();
        fs::write(&file, whole.replace("labels", "lables")).unwrap();
        let found = newest(&file);
        assert_eq!(found.model.map(|(model, _)| model.generation), Some(7));
        assert!(found.faults[0].contains("checksum"), "{:?}", found.faults);
        keep(&file, &model(8)).unwrap();
        assert_eq!(newest(&file).model.map(|(model, _)| model.generation), Some(8));
        assert_eq!(newest(&before(&file, 1)).model.map(|(model, _)| model.generation), Some(7));
    }
}
