//! What is learnt of the sensors, as it is shown.

use insd_engine::{LearningStatus, learnt_words};
use insd_web::snapshot::ShownLearning;

/// What is shown of it.
pub(super) fn learning(own: &LearningStatus) -> ShownLearning {
    let outage = own.kept.outage();
    let [uses_log, uses_current, uses_temperature] = own.used;
    ShownLearning {
        may_be_used: own.may_be_used,
        uses_log,
        uses_current,
        uses_temperature,
        learnt_h: own.kept.hours(),
        voyages: own.kept.voyages,
        outage_m: outage.map(|[_, with]| with),
        outage_without_m: outage.map(|[without, _]| without),
        words: learnt_words(&own.kept),
    }
}

#[cfg(test)]
mod tests {
    use insd_engine::KeptModel;

    use super::*;

    #[test]
    fn what_is_learnt_is_shown_in_words_and_in_numbers() {
        let text = include_str!("../../../config/tests/learnt.toml");
        let kept = KeptModel::parse(text).unwrap();
        let status = LearningStatus { kept, may_be_used: true, used: [true, true, false] };
        let shown = learning(&status);
        assert!((shown.learnt_h - 41.0).abs() < 1e-9);
        assert_eq!((shown.outage_m, shown.outage_without_m), (Some(12.0), Some(25.0)));
        assert!(shown.words.iter().any(|line| line == "at 12 kn the log reads 1.4 % high"));
        assert!((shown.uses_log, shown.uses_temperature) == (true, false));
    }
}
