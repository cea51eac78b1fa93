//! What the navigator says of itself has its Japanese: a page, a report or a check of a configuration that finds none shows English.

#![allow(clippy::unwrap_used)] // helpers of tests are not seen as tests

use std::collections::BTreeSet;

use insd_base::{
    Fault, Mode, ModeReason, Party, RtkSilence, SolutionSource, SourceReason, Standing, Stands,
    Time,
};
use insd_languages::Language;
use insd_output::alerts::Condition;
use insd_output::docking::{DockingDoubt, DockingState, NotDocking};
use insd_vessel::words;

/// Those of some sentences that have no Japanese.
fn lacking(sentences: impl IntoIterator<Item = String>) -> BTreeSet<String> {
    let catalogue = Language::Japanese.catalogue();
    sentences.into_iter().filter(|own| catalogue.sentence(own).is_none()).collect()
}

fn none_lacks(sentences: impl IntoIterator<Item = String>) {
    assert_eq!(lacking(sentences), BTreeSet::new());
}

#[test]
fn every_alert_has_its_title_and_its_description() {
    let texts = |own: Condition| [own.title().to_owned(), own.description().to_owned()];
    none_lacks(Condition::ALL.into_iter().flat_map(texts));
    let watched =
        ["old gyro 2 wrong. Do not use", "old gyro 1 and insd differ", "Differ. See page"];
    none_lacks(watched.map(str::to_owned));
}

#[test]
fn the_titles_of_alerts_are_short_and_each_its_own() {
    let catalogue = Language::Japanese.catalogue();
    let titles: BTreeSet<String> =
        Condition::ALL.iter().map(|own| catalogue.said(own.title())).collect();
    assert_eq!(titles.len(), Condition::ALL.len());
    let long: Vec<&String> = titles.iter().filter(|title| title.chars().count() > 12).collect();
    assert!(long.is_empty(), "{long:?}");
}

#[test]
fn every_mode_and_every_reason_of_a_change_has_its_words() {
    none_lacks(Mode::ALL.map(|mode| words::mode(mode).to_owned()));
    let reasons = [
        ModeReason::ImuHeard,
        ModeReason::ImuSilent,
        ModeReason::Level,
        ModeReason::HeadingFound,
        ModeReason::HeadingSettled,
        ModeReason::HeadingUnsure,
        ModeReason::GnssInUse,
        ModeReason::GnssLost,
        ModeReason::LogInUse,
        ModeReason::AidsLost,
        ModeReason::LeftBerth,
        ModeReason::Resumed,
        ModeReason::ResumeDropped,
        ModeReason::NotFinite,
        ModeReason::GapTooLong,
        ModeReason::HeadingRefuted,
        ModeReason::ImuDoubted,
        ModeReason::ImuBelieved,
        ModeReason::StartedOver,
    ];
    none_lacks(reasons.map(|reason| reason.to_string()));
}

#[test]
fn what_the_position_lives_by_has_its_words_and_reasons() {
    let sources = ["rtk", "float", "carrier", "code", "doppler", "dr"];
    let sources = sources.map(|word| SolutionSource::from_word(word).unwrap().text().to_owned());
    none_lacks(sources);
    let silences = [
        RtkSilence::BaseSilent,
        RtkSilence::BaseUnplaced,
        RtkSilence::BaseMoves,
        RtkSilence::BaseElsewhere,
        RtkSilence::TooFew,
        RtkSilence::Unclear,
        RtkSilence::Residuals,
        RtkSilence::Settling,
        RtkSilence::Contradicted,
    ];
    let reasons = [SourceReason::Better, SourceReason::Unheard].into_iter();
    none_lacks(reasons.chain(silences.map(SourceReason::NoRtk)).map(|reason| reason.to_string()));
}

#[test]
fn what_is_found_of_each_sensor_has_its_words() {
    let faults = [
        Fault::Jump,
        Fault::Drag,
        Fault::Slide,
        Fault::Creep,
        Fault::Velocity,
        Fault::Height,
        Fault::Delay,
        Fault::GnssNoise,
        Fault::SpareNoise,
        Fault::LogGain,
        Fault::LogOffset,
        Fault::LogFlow,
        Fault::HeadingOffset,
        Fault::HeadingDrift,
        Fault::DockingJump(1),
        Fault::DockingDrift(1),
        Fault::DockingMark(1),
        Fault::GyroBias,
        Fault::AccelBias,
        Fault::GyroScale,
        Fault::ImuUseless,
        Fault::ImuWorse,
    ];
    let standings =
        [Standing::Trusted, Standing::Doubtful, Standing::Excluded, Standing::Probation];
    let mut told = Vec::new();
    for party in Party::ALL {
        for standing in standings {
            for fault in faults.iter().copied().map(Some).chain([None]) {
                told.push(Stands { party, standing, since: Time::START, fault }.to_string());
            }
        }
    }
    none_lacks(told);
}

#[test]
fn why_docking_is_not_valid_has_its_words() {
    let doubts = [DockingDoubt::Unproven, DockingDoubt::Level].map(DockingState::Doubtful);
    let reasons = [
        NotDocking::NoSolution,
        NotDocking::NotNavigating,
        NotDocking::Fault,
        NotDocking::Contradiction,
        NotDocking::Away,
        NotDocking::Ashore,
        NotDocking::Behind,
    ];
    let states = reasons.map(DockingState::NotValid).into_iter().chain(doubts);
    none_lacks(states.filter_map(|state| state.why().map(str::to_owned)));
}
