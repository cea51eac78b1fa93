//! What became of the measurements.

use std::collections::BTreeMap;

use insd_base::{AidInnovation, Counts, Time};
use insd_web::snapshot::{Cause, Samples, ShownAid};

use super::spans::age;

/// An aid that was used so long ago is still in use, s.
const IN_USE: f64 = 15.0;

/// What was said of each aid last.
#[derive(Debug, Default)]
pub(super) struct Aids {
    last: BTreeMap<&'static str, Last>,
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
