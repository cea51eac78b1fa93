use insd_web::snapshot::{Alert, Sensor, SensorState, ShownMotion, ShownPriority, Snapshot};
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
    let motion = ShownMotion {
        heading_deg: Some(62.04),
        sigma_heading_deg: Some(0.062),
        speed_kn: Some(12.6),
        course_deg: Some(64.2),
        pitch_deg: Some(-1.25),
        ..ShownMotion::default()
    };
    let sensor = Sensor { name: "imu".to_owned(), state: SensorState::Silent, ..Sensor::default() };
    let alert = Alert {
        title: "Heading lost".to_owned(),
        priority: ShownPriority::Warning,
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
fn at_80_by_24_speed_course_pitch_and_alerts_are_seen() {
    let mut snapshot = board().snapshot().unwrap();
    let input = insd_web::snapshot::ShownInput { name: "port".to_owned(), ..Default::default() };
    snapshot.inputs = vec![input; 9];
    snapshot.sensors = vec![snapshot.sensors[0].clone(); 7];
    let board = Board::default();
    board.connect();
    board.take("snapshot", &serde_json::to_string(&snapshot).unwrap());
    let picture = drawn(&board, 80, 24);
    for text in ["12.60 kn", "64.2°", "-1.25°", "62.04°", "warning Heading lost", "imu"] {
        assert!(picture.contains(text), "{text} is not in\n{picture}");
    }
}

#[test]
fn of_many_alerts_as_many_are_seen_as_there_is_room_for_and_the_rest_is_counted() {
    let mut snapshot = board().snapshot().unwrap();
    snapshot.alerts = vec![snapshot.alerts[0].clone(); 12];
    let board = Board::default();
    board.connect();
    board.take("snapshot", &serde_json::to_string(&snapshot).unwrap());
    assert!(drawn(&board, 100, 40).contains("and 5 more"));
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
