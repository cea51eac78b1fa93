//! What the picture says, at both sizes and in every state.

use insd_base::units::{DEG, KNOT};
use insd_base::{
    Attitude, Body, Geodetic, Mode, Ned, Rejection, Solution, SolutionSigma, Span, Time,
};
use ratatui::Terminal;
use ratatui::backend::TestBackend;

use super::draw;
use crate::demo::board::{Board, DemoPort, Phase};
use crate::demo::sensors::{DemoSensor, DemoSensorStatus};
use crate::demo::truth::TrueError;

fn solution(mode: Mode) -> Solution {
    Solution {
        time: Time::from_seconds(754.0),
        position: Geodetic::from_degrees(35.205_76, 139.752_057, 38.0),
        velocity: Ned::new(0.0, 12.34 * KNOT, 0.0),
        attitude: Attitude { roll: -2.3 * DEG, pitch: 0.4 * DEG, heading: 85.67 * DEG },
        rate: Body::new(0.0, 0.0, -3.2 * DEG / 60.0),
        sigma: SolutionSigma {
            position: Ned::new(0.6, 0.6, 1.0),
            velocity: Ned::new(0.01, 0.01, 0.01),
            roll: 0.01 * DEG,
            pitch: 0.01 * DEG,
            heading: 0.05 * DEG,
        },
        mode,
        judgement: insd_base::Judgement::default(),
        source: None,
        hidden: insd_base::Protection::default(),
    }
}

fn board() -> Board {
    let gnss = DemoSensorStatus {
        kind: DemoSensor::Gnss,
        age: Some(Span::from_seconds(0.3)),
        rate: 1.0,
        used: 1480,
        rejected: 15,
        silent: false,
    };
    let mut board = Board {
        title: "harbour, seed 1".to_owned(),
        speed: 10.0,
        phase: Phase::Sailing,
        now: Time::from_seconds(754.0),
        solution: Some(solution(Mode::Aided)),
        true_error: Some(TrueError { horizontal: 0.84, heading: Some(-0.013 * DEG) }),
        sensors: vec![gnss],
        port: DemoPort { path: "/dev/pts/7".to_owned(), written: 12_345, dropped: 0 },
        ..Board::default()
    };
    board.counts.rejected.insert(("gnss_position", Rejection::DopTest), 15);
    board.events.add(Time::from_seconds(700.0), "Dead reckoning, no GNSS".to_owned());
    for point in 0..50 {
        board.tracks.own.offer((f64::from(point), 3.0 * f64::from(point)));
    }
    board
}

fn picture(board: &Board, width: u16, height: u16) -> String {
    let mut terminal = Terminal::new(TestBackend::new(width, height)).unwrap();
    terminal.draw(|frame| draw(frame, board)).unwrap();
    terminal.backend().to_string()
}

fn says(picture: &str, text: &str) {
    assert!(picture.contains(text), "{text:?} is missing in\n{picture}");
}

#[test]
fn the_least_terminal_shows_all_that_matters_uncut() {
    let picture = picture(&board(), 80, 24);
    for text in [
        "SIMULATED SHIP",
        "NAVIGATING  with GNSS",
        "35°12.346' N         ± 1.5 m",
        "139°45.123' E",
        "12.34 kn",
        "090.00°",
        "085.67°              ± 0.10°",
        "2.3° to port",
        "0.4° bow up",
        "3.2°/min to port",
        "True error 0.8 m, heading 0.01°",
        "GNSS      0.3 s   1.0  1480       15",
        "15 GNSS position: jumped",
        "00:11:40 Dead reckoning, no GNSS",
        "cat /dev/pts/7   12 kB written",
        "voyage 00:12:34, time x 10",
        "heading ▼   ◇ course",
    ] {
        says(&picture, text);
    }
}

#[test]
fn how_she_stands_to_her_berth_is_told_over_the_whole_width_and_hides_nothing_else() {
    let text = "Pier 1: bow 123.45 m at +0.15 m/s, stern 123.42 m at +0.16 m/s";
    let board = Board { alongside: Some(text.to_owned()), ..board() };
    let picture = picture(&board, 80, 24);
    for text in [text, "True error 0.8 m", "GNSS position: jumped", "heading ▼   ◇ course"] {
        says(&picture, text);
    }
}

#[test]
fn a_roomy_terminal_shows_the_track_too() {
    says(&picture(&board(), 120, 40), "own truth GNSS · north up");
}

#[test]
fn every_mode_says_what_it_means_for_the_bridge() {
    for (mode, words) in [
        (Mode::CoarseAlignment, "ALIGNING  levelling and seeking north: do not use"),
        (Mode::FineAlignment, "ALIGNING  at the berth, heading settling: do not use"),
        (Mode::InMotionAlignment, "ALIGNING  under way, finding the heading: do not use"),
        (Mode::DeadReckoning, "NAVIGATING  without GNSS: dead reckoning"),
        (Mode::Inertial, "NAVIGATING  on the IMU alone: position drifts"),
        (Mode::Fault, "FAULT  do not use"),
    ] {
        says(&picture(&Board { solution: Some(solution(mode)), ..board() }, 80, 24), words);
    }
}

#[test]
fn an_old_solution_is_not_shown_as_the_present() {
    let now = Time::from_seconds(760.0);
    says(&picture(&Board { now, ..board() }, 80, 24), "NO NEW SOLUTION");
}

#[test]
fn before_the_first_solution_nothing_is_claimed() {
    let preparing = picture(&Board::default(), 80, 24);
    says(&preparing, "PREPARING  making the voyage");
    says(&preparing, "nothing is known yet");
    let sailing = Board { phase: Phase::Sailing, ..Board::default() };
    says(&picture(&sailing, 80, 24), "WAITING  for the first solution");
}

#[test]
fn values_that_are_not_numbers_are_unknown_and_no_size_panics() {
    let mut lost = solution(Mode::Aided);
    lost.position.latitude = f64::NAN;
    lost.attitude.heading = f64::NAN;
    lost.sigma.heading = f64::INFINITY;
    let board = Board { solution: Some(lost), ..board() };
    says(&picture(&board, 80, 24), "unknown");
    for (width, height) in [(1, 1), (10, 3), (79, 24), (80, 23), (81, 25), (100, 32), (300, 100)] {
        let _ = picture(&board, width, height);
    }
}
