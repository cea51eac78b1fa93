//! What became of the measurements.

use std::collections::BTreeMap;

use insd_base::{AidInnovation, Counts, SatelliteInnovation, Time};
use insd_web::snapshot::{Cause, Samples, ShownAid};

use super::spans::age;

/// An aid that was used so long ago is still in use, s.
const IN_USE: f64 = 15.0;

/// Why a single satellite is not used, as the sky has it.
const CONTRADICTS: &str = "contradicts";

/// What was said of each aid last.
#[derive(Debug, Default)]
pub(super) struct Aids {
    last: BTreeMap<&'static str, Last>,
    satellites: BTreeMap<&'static str, Told>,
}

/// How often what single satellites told was used, and was not.
#[derive(Clone, Copy, Debug, Default)]
struct Told {
    used: u64,
    refused: u64,
}

#[derive(Clone, Copy, Debug, Default)]
struct Last {
    /// When one was used.
    used: Option<Time>,
    /// When the last innovation was valid, and its greatest component over its sigma.
    normalised: Option<(Time, f64)>,
}

impl Aids {
    pub(super) fn note(&mut self, innovation: &AidInnovation) {
        let last = self.last.entry(innovation.aid).or_default();
        if innovation.accepted {
            last.used = Some(innovation.time);
        }
        let own = innovation.innovation / innovation.sigma;
        let same_epoch = last.normalised.filter(|(time, _)| *time == innovation.time);
        if own.is_finite() && same_epoch.is_none_or(|(_, other)| own.abs() > other.abs()) {
            last.normalised = Some((innovation.time, own));
        }
    }

    /// What one satellite told: each counts, where the engine counts epochs.
    pub(super) fn note_satellite(&mut self, told: &SatelliteInnovation) {
        let counts = self.satellites.entry(told.aid).or_default();
        counts.used += u64::from(told.accepted);
        counts.refused += u64::from(!told.accepted);
        self.note(&told.of_aid());
    }

    pub(super) fn aids(&self, counts: &Counts, now: Time) -> Vec<ShownAid> {
        let mut aids: BTreeMap<&str, ShownAid> = BTreeMap::new();
        for (name, count) in &counts.accepted {
            entry(&mut aids, name).accepted = *count;
        }
        for ((name, reason), count) in &counts.rejected {
            let aid = entry(&mut aids, name);
            aid.rejected += count;
            aid.reasons.push(Cause { reason: reason.as_str().to_owned(), count: *count });
        }
        for (name, told) in &self.satellites {
            let aid = entry(&mut aids, name);
            aid.accepted = told.used;
            aid.rejected += told.refused;
            if told.refused > 0 {
                let reason = CONTRADICTS.to_owned();
                aid.reasons.push(Cause { reason, count: told.refused });
            }
        }
        for (name, count) in &counts.floored {
            entry(&mut aids, name).floored = *count;
        }
        for (name, aid) in &mut aids {
            let last = self.last.get(name).copied().unwrap_or_default();
            aid.age_s = age(now, last.used);
            aid.in_use = aid.age_s.is_some_and(|age| age < IN_USE);
            aid.last_normalised_innovation = last.normalised.map(|(_, value)| value);
        }
        aids.into_values().collect()
    }
}

fn entry<'a, 'n>(aids: &'a mut BTreeMap<&'n str, ShownAid>, name: &'n str) -> &'a mut ShownAid {
    aids.entry(name).or_insert_with(|| ShownAid { name: name.to_owned(), ..ShownAid::default() })
}

pub(super) fn samples(counts: &Counts) -> Samples {
    Samples {
        used: counts.imu_samples,
        gaps: counts.imu_gaps,
        duplicates: counts.imu_duplicates,
        out_of_order: counts.imu_out_of_order,
        out_of_range: counts.imu_out_of_range,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use insd_base::Rejection;

    #[test]
    fn each_satellite_that_is_used_or_refused_counts_among_the_aids_and_tells_that_it_is_in_use() {
        let mut own = Aids::default();
        let told = |name: &str, innovation, accepted| SatelliteInnovation {
            time: Time::from_seconds(10.0),
            aid: "satellite_code",
            satellite: name.parse().unwrap(),
            innovation,
            sigma: 2.0,
            accepted,
        };
        let all = [told("G07", 1.0, true), told("G08", -3.0, true), told("E11", 30.0, false)];
        all.iter().for_each(|told| own.note_satellite(told));
        let mut counts = Counts::default();
        counts.accepted.insert("satellite_code", 1);
        counts.rejected.insert(("satellite_code", Rejection::SourceSuspect), 4);
        let shown = own.aids(&counts, Time::from_seconds(11.0));
        let [shown] = &shown[..] else { panic!("{shown:?}") };
        assert_eq!((shown.accepted, shown.rejected), (2, 5));
        let reasons = shown.reasons.iter().map(|own| (own.reason.as_str(), own.count));
        assert_eq!(reasons.collect::<Vec<_>>(), [("source_suspect", 4), ("contradicts", 1)]);
        assert!(shown.in_use && shown.age_s == Some(1.0), "{shown:?}");
        assert_eq!(shown.last_normalised_innovation, Some(15.0));
        assert!(Aids::default().aids(&Counts::default(), Time::START).is_empty());
    }
}
