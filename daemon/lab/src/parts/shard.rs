//! A share of the voyages of a campaign, for one of several computers or jobs.

use std::str::FromStr;

/// The largest number of shards.
const MOST: u64 = 1_000_000;

/// The `index`th of `of` shares, counted from 0: every `of`th voyage, so that all are equally long.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    index: u64,
    of: u64,
}

impl Shard {
    /// All voyages.
    pub const ALL: Shard = Shard { index: 0, of: 1 };

    /// Whether the voyage with this number, from 0 on, belongs to it.
    #[must_use]
    pub fn holds(self, voyage: usize) -> bool {
        voyage as u64 % self.of == self.index
    }

    fn new(index: u64, of: u64) -> Result<Self, String> {
        if index < of && of <= MOST {
            Ok(Shard { index, of })
        } else {
            Err(format!(
                "there is no shard {index} of {of}: they are counted from 0, at most {MOST}"
            ))
        }
    }
}

/// What `--shard` says.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ShardChoice {
    /// This one.
    Stated(Shard),
    /// The one that the job system has given out, of so many if it does not tell.
    Given {
        /// Number of shards.
        of: Option<u64>,
    },
}

impl FromStr for ShardChoice {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let expected = || "expected K/N with K from 0 to N - 1, auto, or auto/N".to_owned();
        let number = |text: &str| text.parse::<u64>().map_err(|_| expected());
        match text.split_once('/') {
            Some(("auto", of)) => Ok(ShardChoice::Given { of: Some(number(of)?) }),
            Some((index, of)) => Ok(ShardChoice::Stated(Shard::new(number(index)?, number(of)?)?)),
            None if text == "auto" => Ok(ShardChoice::Given { of: None }),
            None => Err(expected()),
        }
    }
}

impl ShardChoice {
    /// The shard, with what the environment says.
    ///
    /// # Errors
    /// No job system has given one out, or it does not say how many there are.
    pub fn resolve(self, variable: impl Fn(&str) -> Option<String>) -> Result<Shard, String> {
        let of = match self {
            ShardChoice::Stated(shard) => return Ok(shard),
            ShardChoice::Given { of } => of,
        };
        let number = |name: &str| variable(name).and_then(|text| text.trim().parse::<u64>().ok());
        if let Some(task) = number("SLURM_ARRAY_TASK_ID") {
            let first = number("SLURM_ARRAY_TASK_MIN").unwrap_or(0);
            let step = number("SLURM_ARRAY_TASK_STEP").unwrap_or(1).max(1);
            let of = of.or_else(|| number("SLURM_ARRAY_TASK_COUNT"));
            let of = of.ok_or("SLURM_ARRAY_TASK_COUNT is not set: say --shard auto/N")?;
            return Shard::new(task.saturating_sub(first) / step, of);
        }
        match (number("JOB_COMPLETION_INDEX"), of) {
            (Some(index), Some(of)) => Shard::new(index, of),
            (Some(_), None) => {
                Err("Kubernetes does not tell how many jobs there are: say --shard auto/N".into())
            }
            (None, _) => {
                Err("neither SLURM_ARRAY_TASK_ID nor JOB_COMPLETION_INDEX is set: say --shard K/N"
                    .into())
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn resolved(text: &str, set: &[(&str, &str)]) -> Result<Shard, String> {
        let share: ShardChoice = text.parse()?;
        share.resolve(|name| {
            set.iter().find(|(own, _)| *own == name).map(|(_, value)| (*value).to_owned())
        })
    }

    #[test]
    fn every_voyage_belongs_to_exactly_one_shard() {
        for voyage in 0..20 {
            let owners = (0..7).filter(|k| Shard::new(*k, 7).unwrap().holds(voyage));
            assert_eq!(owners.count(), 1);
        }
    }

    #[test]
    fn slurm_and_kubernetes_give_shards_out() {
        let slurm = [
            ("SLURM_ARRAY_TASK_ID", "15"),
            ("SLURM_ARRAY_TASK_MIN", "5"),
            ("SLURM_ARRAY_TASK_STEP", "5"),
            ("SLURM_ARRAY_TASK_COUNT", "4"),
        ];
        assert_eq!(resolved("auto", &slurm), Ok(Shard { index: 2, of: 4 }));
        assert_eq!(
            resolved("auto/8", &[("JOB_COMPLETION_INDEX", "7")]),
            Ok(Shard { index: 7, of: 8 })
        );
        assert_eq!(resolved("3/4", &[]), Ok(Shard { index: 3, of: 4 }));
    }

    #[test]
    fn what_is_no_shard_is_told() {
        for text in ["", "3", "4/4", "a/4", "auto/x", "0/0"] {
            assert!(text.parse::<ShardChoice>().is_err(), "{text}");
        }
        assert!(resolved("auto", &[]).unwrap_err().contains("--shard K/N"));
        assert!(resolved("auto", &[("JOB_COMPLETION_INDEX", "1")]).unwrap_err().contains("auto/N"));
        assert!(resolved("auto/2", &[("JOB_COMPLETION_INDEX", "2")]).is_err());
    }
}
