use super::*;

const SHIPPED: &str = include_str!("../../../systemd/insd.toml");

#[test]
fn the_shipped_file_has_no_faults_and_says_what_it_seems_to_say() {
    let config = Config::of_text(SHIPPED).unwrap();
    assert_eq!(config.ports.len(), 4);
    let engine = config.engine();
    assert_eq!((engine.imu.rate, engine.output_rate), (200.0, 10.0));
    assert_eq!(engine.time_std, None, "a pulse ties receiver and IMU");
    let intake = config.intake();
    assert_eq!(intake.ports[0].link, Link::Serial { byte_time: 10.0 / 921_600.0 });
    assert_eq!(intake.ports[3].link, Link::Datagrams);
}

#[test]
fn all_faults_are_told_together_with_their_place() {
    let text = SHIPPED
        .replace("lat_deg = 35.44", "lat_deg = 135.44")
        .replace("port = \"gnss\"", "port = \"gps\"")
        .replace("[\"forward\", \"starboard\", \"down\"]", "[\"forward\", \"port\", \"down\"]")
        .replace("angle_random_walk_deg_sqrt_h = 0.003", "angle_random_walk_deg_sqrt_h = nan");
    let message = Config::of_text(&text).unwrap_err();
    for part in [
        "4 faults",
        "[ship]: lat_deg: expected -90 to 90",
        "[imu]: angle_random_walk_deg_sqrt_h: expected 0 to 1e9",
        "[[sensor]] \"gnss\": port: expected the name of a port",
        "[[sensor]] \"imu\": mounting: expected three directions",
    ] {
        assert!(message.contains(part), "{part} is not in: {message}");
    }
}

#[test]
fn an_unknown_key_is_shown_with_its_line() {
    let text = SHIPPED.replace("rate_hz = 10.0", "rate_herz = 10.0");
    let message = Config::of_text(&text).unwrap_err();
    assert!(message.contains("rate_herz") && message.contains("line 12"), "{message}");
}

#[test]
fn the_environment_overrides_a_key_and_is_checked_like_the_file() {
    let with = |value: &str| {
        let variables = [("INSD__SHIP__RATE_HZ".to_owned(), value.to_owned())].into_iter();
        let environment = environment().source(Some(variables.collect()));
        Config::parse(SHIPPED, environment)
    };
    assert_eq!(with("50").unwrap().ship.rate_hz, 50.0);
    assert!(with("-1").unwrap_err().contains("rate_hz: expected 0.1 to 1000"));
}

#[test]
fn without_pulse_and_utc_receiver_and_imu_are_tied_by_receipts_alone() {
    let start = SHIPPED.find("[[port]]\nname = \"pulse\"").unwrap();
    let end = SHIPPED.find("[[port]]\nname = \"bridge-in\"").unwrap();
    let text = format!("{}{}", &SHIPPED[..start], &SHIPPED[end..]);
    assert_eq!(Config::of_text(&text).unwrap().engine().time_std, Some(TIME_STD));
}
