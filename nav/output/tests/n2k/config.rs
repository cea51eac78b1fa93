//! The section of the configuration.

use insd_n2k::pgn::{Attitude, GnssPosition, Group, Heading, Heave};
use insd_output::n2k::{N2kGroups, default_transmit, least_interval};

fn read(text: &str) -> N2kGroups {
    toml::from_str(text).unwrap()
}

#[test]
fn nothing_said_is_the_default() {
    let groups = read("");
    assert_eq!(groups, N2kGroups::default());
    assert_eq!(groups.transmit(), default_transmit());
    assert_eq!(groups.faults(), Vec::<String>::new());
}

#[test]
fn a_group_is_found_by_name_or_number_and_only_what_is_said_changes() {
    let groups = read(
        "heading = { interval_ms = 50, priority = 3 }\n127257 = { interval_ms = 100 }\n\
         heave = { enabled = false }",
    );
    assert_eq!(groups.faults(), Vec::<String>::new());
    let table = groups.transmit();
    assert_eq!(table.len(), default_transmit().len());
    for (line, default) in table.iter().zip(default_transmit()) {
        let told = (line.interval.as_nanos() / 1_000_000, line.priority, line.enabled);
        match line.pgn {
            Heading::PGN => assert_eq!(told, (50, 3, true)),
            Attitude::PGN => assert_eq!(told, (100, 3, true)),
            Heave::PGN => assert_eq!(told, (100, 3, false)),
            _ => assert_eq!(*line, default),
        }
    }
}

#[test]
fn all_faults_are_told_together_in_words() {
    let groups = read(
        "127250 = { interval_ms = 9 }\nheading = { priority = 8 }\n\
         gnss_position = { interval_ms = 60 }\nattitude = { interval_ms = 60001 }\nspeeed = {}",
    );
    let faults = groups.faults();
    assert_eq!(
        faults[..5],
        [
            "127250: interval_ms: expected 10 to 60000",
            "attitude: interval_ms: expected 10 to 60000",
            "gnss_position: interval_ms: expected 70 to 60000",
            "heading: expected each group once, 127250 is the same",
            "heading: priority: expected 0 to 7",
        ]
    );
    assert!(faults[5].starts_with("speeed: expected one of heading, rate_of_turn, "), "{faults:?}");
    assert_eq!(faults.len(), 6);
}

#[test]
fn a_table_that_floods_the_bus_is_a_fault() {
    let all = default_transmit();
    let single = |pgn| least_interval(pgn).is_some_and(|least| least.as_nanos() <= 10_000_000);
    let every = |ms: i64| {
        let lines = all.iter().filter(|line| single(line.pgn));
        lines.map(|line| format!("{} = {{ interval_ms = {ms} }}\n", line.pgn)).collect::<String>()
    };
    assert_eq!(read(&every(20)).faults(), Vec::<String>::new());
    let faults = read(&every(10)).faults();
    assert_eq!(faults, ["all groups: 65 % of the bus, expected at most 50 %"]);
}

#[test]
fn a_key_that_is_not_known_is_refused() {
    assert!(toml::from_str::<N2kGroups>("heading = { interval = 50 }").is_err());
    assert!(toml::from_str::<N2kGroups>("heading = { interval_ms = -50 }").is_err());
}

#[test]
fn each_frame_of_a_message_takes_ten_milliseconds() {
    let least = |pgn| least_interval(pgn).map(|span| span.as_nanos() / 1_000_000);
    assert_eq!(least(Heading::PGN), Some(10));
    assert_eq!(least(GnssPosition::PGN), Some(70));
    assert_eq!(least(126_993), None);
}
