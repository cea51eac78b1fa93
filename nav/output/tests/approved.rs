//! The approved sentences to the byte, and when they are silent.

#![allow(clippy::unwrap_used)] // helpers of tests are not seen as tests

use insd_base::units::{DEG, KNOT};
use insd_base::{
    AlignmentPhase, AlignmentStatus, Attitude, Body, Forecast, Geodetic, Heave, HeaveQuality, Lack,
    Mode, Ned, Solution, SolutionSigma, Time, UtcTime,
};
use insd_output::{Manner, MessageKind, OutputEpoch, OutputPortConfig, Port, Rate, Talker};
use insd_wire::nmea::Sentence;

fn solution(mode: Mode) -> Solution {
    Solution {
        time: Time::START,
        position: Geodetic::from_degrees(35.5, -139.25, 40.0),
        velocity: Ned::new(0.0, 10.0 * KNOT, 0.0),
        attitude: Attitude { roll: -3.4 * DEG, pitch: -0.3 * DEG, heading: 91.54 * DEG },
        sigma: SolutionSigma {
            position: Ned::new(0.5, 0.7, 1.25),
            heading: 0.02 * DEG,
            ..SolutionSigma::default()
        },
        rate: Body::default(),
        mode,
        judgement: insd_base::Judgement::default(),
        source: None,
        hidden: insd_base::Protection::default(),
    }
}

fn heave(quality: HeaveQuality) -> Option<Heave> {
    let (rate, acceleration, sigma) = (0.1, 0.0, 0.02);
    let time = Time::START;
    Some(Heave { time, heave: 0.42, rate, acceleration, sigma, quality, delayed: None })
}

fn epoch(mode: Mode) -> OutputEpoch {
    OutputEpoch {
        solution: Some(solution(mode)),
        heave: heave(HeaveQuality::Settled),
        utc: UtcTime::from_civil((2026, 1, 2), (3, 4, 0), 0),
        ..OutputEpoch::unknown(Time::START)
    }
}

fn port(kind: &str) -> OutputPortConfig {
    let kind = MessageKind::named(kind).unwrap();
    OutputPortConfig {
        messages: vec![(kind, Rate::from_hertz(0.1))],
        ..OutputPortConfig::default()
    }
}

fn simulated(kind: &str) -> OutputPortConfig {
    OutputPortConfig { manner: Manner { simulated: true, ..Manner::default() }, ..port(kind) }
}

fn said(config: OutputPortConfig, epoch: &OutputEpoch) -> String {
    let messages = Port::new(config).messages(epoch);
    messages.iter().map(|message| String::from_utf8(message.content.to_bytes()).unwrap()).collect()
}

/// Without its checksum.
fn stem(config: OutputPortConfig, epoch: &OutputEpoch) -> String {
    said(config, epoch).split('*').next().unwrap().to_owned()
}

#[test]
fn expected_errors_are_those_of_the_solution() {
    assert_eq!(stem(port("GBS"), &epoch(Mode::Aided)), "$INGBS,030400.00,0.50,0.70,1.25,,,,");
    assert_eq!(stem(port("GBS"), &epoch(Mode::Fault)), "$INGBS,030400.00,,,,,,,");
    assert_eq!(said(simulated("GBS"), &epoch(Mode::Aided)), "", "it has no mark");
}

#[test]
fn roll_and_pitch_are_named_as_the_consumer_reads_them() {
    let aided = epoch(Mode::Aided);
    let xdr = "$INXDR,A,-0.30,D,PITCH,A,-3.40,D,ROLL,D,0.42,M,HEAVE";
    assert_eq!(stem(port("XDR"), &aided), xdr);
    let ii = OutputPortConfig { talker: Talker::new("II"), ..port("XDR.PTCH") };
    assert_eq!(said(ii, &aided), "$IIXDR,A,-0.3,D,PTCH,A,-3.4,D,ROLL*58\r\n");
}

#[test]
fn a_measurement_that_is_not_known_is_left_out_and_none_is_silence() {
    let level = OutputEpoch { heave: heave(HeaveQuality::Unsettled), ..epoch(Mode::Aided) };
    assert_eq!(stem(port("XDR"), &level), "$INXDR,A,-0.30,D,PITCH,A,-3.40,D,ROLL");
    let mut heaving = epoch(Mode::Aided);
    heaving.solution.as_mut().unwrap().sigma.roll = 1.0;
    assert_eq!(stem(port("XDR"), &heaving), "$INXDR,D,0.42,M,HEAVE");
    assert_eq!(said(port("XDR"), &OutputEpoch { heave: None, ..heaving }), "");
    assert_eq!(said(simulated("XDR"), &epoch(Mode::Aided)), "", "it has no mark");
}

#[test]
fn a_heading_has_its_corrections_in_it_or_is_not_told() {
    let aided = epoch(Mode::Aided);
    assert_eq!(stem(port("HCR"), &aided), "$HEHCR,91.5,A,A,");
    assert_eq!(stem(simulated("HCR"), &aided), "$HEHCR,91.5,S,A,");
    assert_eq!(stem(port("HCR"), &epoch(Mode::FineAlignment)), "$HEHCR,,V,V,");
}

#[test]
fn a_sign_of_life_has_its_interval_and_counts_to_nine() {
    let mut port = Port::new(port("HBT"));
    let mut sentences = Vec::new();
    for step in 0..12 {
        let time = Time::from_nanos(step * 10_000_000_000);
        let epoch = OutputEpoch { time, utc: None, ..epoch(Mode::CoarseAlignment) };
        let [message] = &port.messages(&epoch)[..] else { continue };
        sentences.push(String::from_utf8(message.content.to_bytes()).unwrap());
    }
    let stems: Vec<&str> = sentences.iter().map(|line| line.split('*').next().unwrap()).collect();
    assert_eq!(stems.len(), 12);
    assert_eq!(stems[..2], ["$INHBT,10,A,0", "$INHBT,10,A,1"]);
    assert_eq!(stems[9..11], ["$INHBT,10,A,9", "$INHBT,10,A,0"]);
}

#[test]
fn a_system_that_has_failed_says_so_as_long_as_it_lives() {
    let silent = OutputEpoch { solution: None, ..epoch(Mode::Aided) };
    for config in [port("HBT"), simulated("HBT")] {
        assert_eq!(stem(config.clone(), &epoch(Mode::Aided)), "$INHBT,10,A,0");
        assert_eq!(stem(config.clone(), &epoch(Mode::Fault)), "$INHBT,10,V,0");
        assert_eq!(stem(config, &silent), "$INHBT,10,V,0");
    }
}

#[test]
fn a_system_that_levels_has_not_failed_but_one_that_has_come_to_a_halt_has() {
    let levelling = |told: f64| {
        let alignment = AlignmentStatus {
            time: Time::from_seconds(told),
            phase: AlignmentPhase::Levelling,
            moored: true,
            sigma: None,
            target: None,
            gyrocompass: None,
            ready: Forecast::Unknown { lacks: Lack::Time },
            sea: None,
            fit: None,
            shifts: 0,
        };
        OutputEpoch { solution: None, alignment: Some(alignment), ..epoch(Mode::Aided) }
    };
    assert_eq!(stem(port("HBT"), &levelling(-10.0)), "$INHBT,10,A,0");
    assert_eq!(stem(port("TXT"), &levelling(-10.0)), "$INTXT,01,01,02,insd: levelling");
    assert_eq!(stem(port("HBT"), &levelling(-15.1)), "$INHBT,10,V,0");
    assert_eq!(stem(port("TXT"), &levelling(-15.1)), "$INTXT,01,01,00,insd: no solution");
}

#[test]
fn the_mode_is_told_in_words() {
    let said = |config, mode| stem(config, &epoch(mode));
    assert_eq!(said(port("TXT"), Mode::Aided), "$INTXT,01,01,02,insd: aided navigation");
    assert_eq!(said(port("TXT"), Mode::Fault), "$INTXT,01,01,00,insd: fault");
    let simulated = said(simulated("TXT"), Mode::DeadReckoning);
    assert_eq!(simulated, "$INTXT,01,01,02,insd: dead reckoning (simulated)");
}

#[test]
fn every_line_is_reckoned_with_the_longest_of_its_sentences() {
    for kind in MessageKind::all() {
        let formatter = kind.name().get(..3).unwrap();
        let known = Sentence::LONGEST.iter().find(|(name, _)| *name == formatter);
        if let (Some((_, longest)), Some(_)) = (known, kind.talker()) {
            let sentences = match formatter {
                "ALC" => 7,
                "ALF" => 2,
                _ => 1,
            };
            assert_eq!(kind.longest(), sentences * longest, "{}", kind.name());
        }
    }
}
