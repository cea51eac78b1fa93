use insd_web::snapshot::{Alert, AlertPriority, Motion, Sensor, SensorState, Snapshot};
use ratatui::Terminal;
use ratatui::backend::TestBackend;

use super::super::board::Board;
use super::draw;

fn drawn(board: &Board, width: u16, height: u16) -> String {
    let mut terminal = Terminal::new(TestBackend::new(width, height)).unwrap();
    terminal.draw(|frame| draw(frame, board, "http://ship:8470")).unwrap();
    let buffer = terminal.backend().buffer();
    let row = |y| (0..width).map(move |x| buffer[(x, y)].symbol()).collect::<String>();
    (0..height).map(|y| row(y) + "\n").collect()
}

fn board() -> Board {
    let motion =
        Motion { heading_deg: Some(62.04), sigma_heading_deg: Some(0.062), ..Motion::default() };
    let sensor = Sensor { name: "imu".to_owned(), state: SensorState::Silent, ..Sensor::default() };
    let alert = Alert {
        title: "Heading lost".to_owned(),
        priority: AlertPriority::Warning,
        ..Alert::default()
    };
    let mut snapshot = Snapshot {
        motion: Some(motion),
        sensors: vec![sensor],
        alerts: vec![alert],
        ..Snapshot::default()
    };
    snapshot.mode.name = "dead_reckoning".to_owned();
    let board = Board::default();
    board.connect();
    board.take("snapshot", &serde_json::to_string(&snapshot).unwrap());
    board
}

#[test]
fn the_picture_shows_ship_sensors_and_alerts() {
    let picture = drawn(&board(), 100, 30);
    for text in ["DEAD RECKONING", "62.04°", "± 0.062", "silent", "warning Heading lost"] {
        assert!(picture.contains(text), "{text} is not in\n{picture}");
    }
}

#[test]
fn a_small_window_still_tells_the_heading() {
    assert!(drawn(&board(), 60, 12).contains("62.04"));
}

#[test]
fn data_of_a_lost_connection_are_called_old() {
    let board = board();
    board.disconnect("gone".to_owned());
    assert!(drawn(&board, 100, 30).contains("CONNECTION LOST"));
}

#[test]
fn without_data_it_says_why() {
    let board = Board::default();
    board.disconnect("connection refused".to_owned());
    assert!(drawn(&board, 100, 30).contains("connection refused"));
}
