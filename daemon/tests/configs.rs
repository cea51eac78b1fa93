//! The configurations that are shipped, and the commands about configurations.

#![allow(clippy::unwrap_used, clippy::panic)] // helpers of tests are not seen as tests

use std::fs;
use std::path::Path;

use assert_cmd::Command;
use insd::commands::example_config::EXAMPLES;
use insd_base::Voyage;
use insd_config::Config;
use insd_config::check::shape::{ConfigKey, Shape, sections};
use insd_intake::config::Kind;
use insd_simulator::feed::{Encoding, FeedConfig};
use insd_simulator::{Scenario, shipped, simulate};
use toml::{Table, Value};

fn installed() -> &'static str {
    EXAMPLES[0].text
}

fn insd() -> Command {
    Command::cargo_bin("insd").unwrap()
}

fn text_of(mut command: Command) -> String {
    String::from_utf8(command.assert().success().get_output().stdout.clone()).unwrap()
}

/// A file with all its settings switched on that are there as comments: those without a space.
fn uncommented(text: &str) -> String {
    let line = |line: &str| match line.strip_prefix('#') {
        Some(own) if own.starts_with(|c: char| c.is_ascii_lowercase() || c == '[') => {
            own.to_owned()
        }
        _ => line.to_owned(),
    };
    text.lines().map(line).collect::<Vec<_>>().join("\n")
}

/// The keys of a section, or all sections.
fn keys(section: &str) -> Vec<String> {
    let sections = sections();
    let names = |keys: &[ConfigKey]| keys.iter().map(|key| key.name.clone()).collect();
    if section.is_empty() {
        return names(&sections);
    }
    match &sections.iter().find(|own| own.name == section).unwrap().shape {
        Shape::Table(keys) => names(keys),
        shape => panic!("{section}: {shape:?}"),
    }
}

/// All keys of a table and of those below it, but for the sections themselves.
fn leaves(table: &Table, place: &[String]) -> Vec<Vec<String>> {
    let mut all = Vec::new();
    for (key, value) in table {
        let own = [place, std::slice::from_ref(key)].concat();
        if !place.is_empty() {
            all.push(own.clone());
        }
        match value {
            Value::Table(below) => all.extend(leaves(below, &own)),
            Value::Array(list) => {
                for (index, below) in list.iter().enumerate() {
                    let own = [own.clone(), vec![index.to_string()]].concat();
                    all.extend(below.as_table().into_iter().flat_map(|below| leaves(below, &own)));
                }
            }
            _ => {}
        }
    }
    all
}

fn without(value: &mut Value, place: &[String]) {
    let [key, rest @ ..] = place else { return };
    match value {
        Value::Array(list) => without(&mut list[key.parse::<usize>().unwrap()], rest),
        Value::Table(table) if rest.is_empty() => drop(table.remove(key)),
        Value::Table(table) => without(&mut table[key], rest),
        _ => {}
    }
}

#[test]
fn every_example_has_no_faults_neither_as_it_is_nor_with_all_its_comments_switched_on() {
    for example in EXAMPLES {
        for text in [example.text.to_owned(), uncommented(example.text)] {
            Config::of_text(&text).unwrap_or_else(|fault| panic!("{}: {fault}", example.name));
        }
    }
}

#[test]
fn what_the_installed_file_says_is_what_holds_without_it() {
    let whole: Table = installed().parse().unwrap();
    let config = Config::of_text(installed()).unwrap();
    let mut optional = 0;
    for place in leaves(&whole, &[]) {
        let mut left = Value::Table(whole.clone());
        without(&mut left, &place);
        // what must be said has no default
        if let Ok(other) = Config::of_text(&left.as_table().unwrap().to_string()) {
            assert_eq!(other, config, "{}: not the default", place.join("."));
            optional += 1;
        }
    }
    assert!(optional >= 12, "only {optional} keys that need not be said");
}

#[test]
fn the_installed_file_shows_every_section_there_is_and_all_of_the_ship() {
    let text = uncommented(installed());
    for section in keys("") {
        let shown = text.lines().any(|line| {
            line.starts_with(&format!("[{section}]")) || line.starts_with(&format!("[[{section}]]"))
        });
        assert!(shown, "[{section}] is not in the installed file");
    }
    for key in keys("ship") {
        assert!(text.lines().any(|line| line.starts_with(&format!("{key} = "))), "{key}");
    }
}

/// The voyage that is fed without a word, but short.
fn fed() -> Voyage {
    let (_, text) = shipped()[1];
    simulate(&Scenario::from_toml(text).unwrap().with_duration(5.0), 1)
}

#[test]
fn the_simulated_configuration_fits_what_is_fed() {
    let example = EXAMPLES.iter().find(|example| example.name == "simulated").unwrap();
    let config = Config::of_text(example.text).unwrap();
    let voyage = fed();
    let feeds = FeedConfig::new(&voyage, &[Encoding::Sbg, Encoding::Ubx, Encoding::Vbw]);
    let (own, fitting) = (config.intake(), feeds.intake(&voyage));
    for (own, fitting) in own.ports.iter().zip(&fitting.ports) {
        assert_eq!(own.link, fitting.link, "{}", own.name);
    }
    for (own, fitting) in own.sensors.iter().zip(fitting.sensors) {
        assert_eq!((own.kind, own.latency_s), (fitting.kind, fitting.latency_s), "{}", own.name);
        assert_eq!(own.mounting, fitting.mounting);
        if own.kind == Kind::NmeaLog {
            assert_eq!(own.velocity_std_mps, fitting.velocity_std_mps);
        }
    }
    let engine = config.engine();
    assert_eq!(engine.imu, voyage.header.imu);
    assert_eq!(engine.lever_arms, voyage.header.lever_arms);
    assert!(config.outputs.iter().all(|output| output.simulated));
}

#[test]
fn examples_are_listed_and_printed_and_an_unknown_one_is_told() {
    let mut command = insd();
    command.args(["example-config", "--list"]);
    let list = text_of(command);
    assert!(EXAMPLES.iter().all(|example| list.contains(example.name)), "{list}");
    let mut command = insd();
    command.arg("example-config");
    assert_eq!(text_of(command), installed());
    insd().args(["example-config", "sihp"]).assert().code(2);
}

#[test]
fn a_check_says_what_a_file_amounts_to_or_all_that_is_wrong() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("insd.toml");
    fs::write(&file, installed()).unwrap();
    let mut command = insd();
    command.arg("check-config").arg(&file);
    let told = text_of(command);
    assert!(told.contains(&format!("{}: 1 note\n", file.display())), "{told}");
    assert!(told.contains("  sensor    gnss: ubx on gnss\n"), "{told}");

    let wrong = installed().replace("rate_hz = 10.0", "rate_hz = -1.0");
    fs::write(&file, wrong.replace("port = \"gnss\"", "port = \"gps\"")).unwrap();
    let outcome = insd().arg("check-config").arg(&file).assert().code(2);
    let told = String::from_utf8(outcome.get_output().stdout.clone()).unwrap();
    for part in ["line 18: [ship]: rate_hz: expected", "port: expected the name", "2 errors"] {
        assert!(told.contains(part), "{part} is not in: {told}");
    }
}

#[test]
fn a_check_for_programs_has_severity_cause_place_value_and_advice() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("insd.toml");
    fs::write(&file, installed().replace("kind = \"ubx\"", "kind = \"ublox\"")).unwrap();
    let outcome = insd().args(["check-config", "--json"]).arg(&file).assert().code(2);
    let told: serde_json::Value = serde_json::from_slice(&outcome.get_output().stdout).unwrap();
    assert_eq!(told["accepted"], false);
    let finding = &told["findings"][0];
    for (key, value) in [("severity", "error"), ("cause", "unknown-word"), ("value", "\"ublox\"")] {
        assert_eq!(finding[key], value, "{told}");
    }
    assert_eq!(finding["place"]["name"], "gnss", "{told}");
    assert_eq!(finding["advice"], "did you mean `ubx`?", "{told}");
}

#[test]
fn what_owners_have_is_a_sensor_by_its_kind() {
    let folder = tempfile::tempdir().unwrap();
    let mut text = fs::read_to_string("../systemd/examples/minimal.toml").unwrap();
    for kind in ["gsof", "vectornav", "vectornav_ins", "ad2cp"] {
        let port = "kind = \"serial\", device = \"/dev/serial/by-id/usb-";
        text.push_str(&format!(
            "[[port]]\nname = \"{kind}\"\ntransport = {{ {port}{kind}\", baud = 921600 }}\n\
             [[sensor]]\nname = \"{kind}\"\nport = \"{kind}\"\nkind = \"{kind}\"\npriority = 2\n"
        ));
    }
    text.push_str("[[watch]]\nsensor = \"vectornav_ins\"\n");
    let path = folder.path().join("insd.toml");
    fs::write(&path, text).unwrap();
    let mut command = insd();
    command.arg("check-config").arg(&path);
    let told = text_of(command);
    assert!(told.contains("gsof") && told.contains("ad2cp"), "{told}");
}

#[test]
fn warnings_end_a_check_only_where_it_is_strict() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("insd.toml");
    let lever = "gnss_lever_m = [0.0, 0.0, 18.0]";
    fs::write(&file, installed().replace("gnss_lever_m = [0.0, 0.0, 0.0]", lever)).unwrap();
    insd().arg("check-config").arg(&file).assert().code(0);
    insd().args(["check-config", "--strict"]).arg(&file).assert().code(1);
}

#[test]
fn every_command_has_a_manual_page_and_completions() {
    let folder = tempfile::tempdir().unwrap();
    for what in ["man", "completions"] {
        insd().args(["generate", what]).arg(folder.path()).assert().success();
    }
    let read = |name: &str| fs::read_to_string(folder.path().join(name)).unwrap();
    assert!(read("insd.1").contains("check\\-config"));
    assert!(read("insd-feed.1").contains("insd\\-sensors"));
    assert!(read("insd.toml.5").contains("heading_offset_deg"));
    for name in ["insd.bash", "_insd", "insd.fish"] {
        assert!(read(name).contains("example-config"), "{name}");
    }
    assert!(!folder.path().join("insd-generate.1").exists());
}

/// Bytes that come at a link within a few seconds.
fn listen(link: &Path, enough: usize) -> Vec<u8> {
    use std::io::Read;
    let mut heard = Vec::new();
    for _ in 0..500 {
        let Ok(mut file) = fs::File::open(link) else {
            std::thread::sleep(std::time::Duration::from_millis(10));
            continue;
        };
        let mut bytes = [0; 4096];
        while heard.len() < enough {
            let count = file.read(&mut bytes).unwrap();
            heard.extend_from_slice(&bytes[..count]);
        }
        break;
    }
    heard
}

#[test]
fn a_fed_log_is_heard_in_real_time_on_its_terminal() {
    let folder = tempfile::tempdir().unwrap();
    let mut feed = std::process::Command::new(assert_cmd::cargo::cargo_bin("insd"))
        .args(["feed", "01", "--seconds", "4", "--sensor", "log=nmea_log", "--folder"])
        .arg(folder.path())
        .spawn()
        .unwrap();
    let heard = String::from_utf8(listen(&folder.path().join("log"), 60)).unwrap();
    assert!(heard.starts_with("$VDVBW,"), "{heard}");
    assert!(feed.wait().unwrap().success());
    assert!(!folder.path().join("log").is_symlink());
}

/// A backbone behind a gateway: its transport, and the hosts that may command.
fn gateway(transport: &str, commanders: &str) -> Config {
    let mut text = installed().to_owned();
    text += &format!("[[port]]\nname = \"bus\"\ntransport = {{ {transport} }}\n{commanders}\n");
    text += "[[node]]\nport = \"bus\"\n";
    Config::of_text(&text).unwrap()
}

#[test]
fn a_node_behind_a_gateway_obeys_only_if_all_who_can_send_there_are_listed() {
    let udp = "kind = \"gateway-udp\", bind = \"0.0.0.0:1456\", format = \"ydwg\"";
    let known = format!("{udp}, from = [\"10.0.0.7\"]");
    let tcp = |host: &str| {
        format!("kind = \"gateway-tcp\", address = \"{host}:1457\", format = \"ydwg\"")
    };
    let list = "commands_from = [\"10.0.0.7\"]";
    for (transport, commanders, obeys) in [
        (udp, "", false),
        (udp, list, false),
        (known.as_str(), "", false),
        (known.as_str(), list, true),
        (&tcp("10.0.0.7"), list, true),
        (&tcp("10.0.0.7"), "", false),
        (&tcp("10.0.0.8"), list, false),
        (&tcp("gateway"), list, false),
        ("kind = \"socketcan\", interface = \"can0\"", "", true),
    ] {
        let config = gateway(transport, commanders);
        let bus = config.ports.iter().find(|port| port.name == "bus").unwrap();
        assert_eq!(bus.obeys_bus(), obeys, "{transport} {commanders}");
    }
}

#[test]
fn hosts_and_levels_that_make_no_sense_are_told_with_their_line_and_what_was_expected() {
    let mut text = installed().replace("level = \"info\"", "level = \"info,security=off\"");
    text += "[[port]]\nname = \"own\"\ntransport = { kind = \"udp\", bind = \"0.0.0.0:1456\", from = [\"bridge\"] }\n";
    let fault = Config::of_text(&text).unwrap_err();
    for part in ["line ", "transport.from", "a network like \"10.0.0.0/24\"", "always written"] {
        assert!(fault.contains(part), "{part}: {fault}");
    }
}
