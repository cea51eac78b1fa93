use insd_web::snapshot::{
    Alert, SatelliteFate, Sensor, SensorState, ShownMotion, ShownPriority, ShownSatellite,
    ShownSignal, ShownSky, ShownSource, SkyState, Snapshot,
};
use ratatui::Terminal;
use ratatui::backend::TestBackend;

use super::super::board::Board;
use super::{MonitorView, draw};

fn drawn(board: &Board, width: u16, height: u16) -> String {
    seen(board, width, height, MonitorView::Ship)
}

fn seen(board: &Board, width: u16, height: u16, view: MonitorView) -> String {
    let mut terminal = Terminal::new(TestBackend::new(width, height)).unwrap();
    terminal.draw(|frame| draw(frame, board, "http://ship:8470", view)).unwrap();
    let buffer = terminal.backend().buffer();
    let row = |y| (0..width).map(move |x| buffer[(x, y)].symbol()).collect::<String>();
    (0..height).map(|y| row(y) + "\n").collect()
}

fn board() -> Board {
    let source = ShownSource {
        name: "carrier".to_owned(),
        text: "carrier phases".to_owned(),
        since_s: Some(72.0),
        reason: Some("the base moves".to_owned()),
        ..ShownSource::default()
    };
    let motion = ShownMotion {
        heading_deg: Some(62.04),
        sigma_heading_deg: Some(0.062),
        speed_kn: Some(12.6),
        course_deg: Some(64.2),
        pitch_deg: Some(-1.25),
        source: Some(source),
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
    for text in [
        "DEAD RECKONING",
        "62.04°",
        "± 0.062",
        "silent",
        "warning Heading lost",
        "Lives by carrier phases",
    ] {
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

/// A ship that hears many satellites: one is left out, one stands too low.
fn under_satellites(count: usize) -> Board {
    let satellite = |number: usize| {
        let signal = ShownSignal { cn0_db_hz: Some(44.0), ..ShownSignal::default() };
        ShownSatellite {
            name: format!("G{number:02}"),
            azimuth_deg: Some(131.0),
            elevation_deg: Some(62.0),
            signals: vec![signal],
            fate: SatelliteFate::Used,
            ..ShownSatellite::default()
        }
    };
    let mut satellites: Vec<_> = (1..=count).map(satellite).collect();
    satellites[6].fate = SatelliteFate::Refused;
    satellites[6].text = Some("below 10 degrees".to_owned());
    satellites[7].fate = SatelliteFate::LeftOut;
    satellites[7].left_out_for_s = Some(72.0);
    satellites[7].text = Some("its ranges contradict the others".to_owned());
    let sky = ShownSky {
        state: SkyState::Raw,
        valid_at_s: Some(0.0),
        used: u32::try_from(count - 2).ok(),
        satellites,
        ..ShownSky::default()
    };
    let snapshot = Snapshot { sky, ..board().snapshot().unwrap() };
    let board = Board::default();
    board.connect();
    board.take("snapshot", &serde_json::to_string(&snapshot).unwrap());
    board
}

#[test]
fn each_satellite_is_seen_in_a_small_terminal_and_of_those_not_used_why() {
    let view = MonitorView::Ship.after('x').after('s');
    let picture = seen(&under_satellites(34), 80, 24, view);
    for number in 1..=34 {
        assert!(picture.contains(&format!(" G{number:02} ")), "{number} is not in\n{picture}");
    }
    for text in [
        "32 of 34 used",
        "○ G07  62  131     44   below 10 degrees",
        "out 1 min 12 s: its ranges contradict the others",
        "DEAD RECKONING",
    ] {
        assert!(picture.contains(text), "{text} is not in\n{picture}");
    }
    assert!(seen(&under_satellites(80), 80, 20, view).contains("and 45 more"));
    assert!(drawn(&under_satellites(34), 100, 30).contains("Satellites: 32 of 34 used"));
    assert_eq!(view.after('s'), MonitorView::Ship);
}

#[test]
fn a_receiver_that_sends_fixes_only_is_said_to() {
    let mut snapshot = board().snapshot().unwrap();
    snapshot.sky.state = SkyState::FixesOnly;
    let board = Board::default();
    board.connect();
    board.take("snapshot", &serde_json::to_string(&snapshot).unwrap());
    let told = seen(&board, 80, 24, MonitorView::Satellites);
    assert!(told.contains("The receiver sends fixes only"), "{told}");
    assert!(drawn(&board, 80, 24).contains("Satellites: fixes only"));
}
