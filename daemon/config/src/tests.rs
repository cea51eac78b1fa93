use insd_base::{Body, CanId};
use insd_intake::config::{IntakeConfig, Kind, PortSpec, SensorConfig};
use insd_intake::port::Link;
use insd_languages::Language;
use insd_n2k::NameParts;
use insd_wire::imu::can::{LayoutChoice, Shipped};
use serde::Deserialize;

use super::*;
use crate::file::TIME_STD;

const SHIPPED: &str = include_str!("../../../systemd/examples/survey.toml");

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
    let with =
        |value: &str| Config::of_text(&format!("{SHIPPED}\n#! INSD__SHIP__RATE_HZ={value}\n"));
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

#[test]
fn a_receiver_may_have_an_antenna_of_its_own_seen_from_each_engines_imu() {
    let own = "kind = \"ubx\"\nlever_m = [5.0, 1.0, -9.0]";
    let text = SHIPPED.replace("kind = \"ubx\"", own);
    let config = Config::of_text(&text).unwrap();
    let lever = |intake: &IntakeConfig| intake.sensors.iter().find_map(SensorConfig::lever);
    assert_eq!(lever(&config.intake()), Some(Body::new(5.0, 1.0, -9.0)));
    assert_eq!(config.engine().lever_arms.gnss, Body::new(-3.0, 0.5, -18.0));
    let spare = "#imu = \"imu\"";
    let second = "[[sensor]]\nname = \"imu-2\"\nport = \"imu-2\"\nkind = \"sbg\"\n[[port]]\nname = \"imu-2\"\n\
        transport = { kind = \"serial\", device = \"/dev/ttyS9\", baud = 921600 }\n[[spare]]\nname = \"s\"\n\
        imu = \"imu-2\"\noffset_m = [2.0, 0.0, 1.0]\n";
    let text = format!("{}\n{second}", text.replace(spare, "imu = \"imu\""));
    let config = Config::of_text(&text).unwrap();
    let spares = config.spares(&config.engine());
    assert_eq!(lever(&spares[0].intake), Some(Body::new(3.0, 1.0, -10.0)));
    let unsaid = text.replace("gnss_lever_m = [-3.0, 0.5, -18.0]", "");
    let engine = Config::of_text(&unsaid).unwrap().engine();
    assert_eq!(engine.lever_arms.gnss, Body::new(5.0, 1.0, -9.0), "better than unmeasured");
}

/// The shipped file with the example of a node that it holds as comments.
fn with_node() -> String {
    let (own, example) = SHIPPED.split_once("# An NMEA 2000 backbone").unwrap();
    let lines = example.lines().skip(2).map(|line| line.trim_start_matches('#').trim_start());
    format!("{own}{}", lines.collect::<Vec<_>>().join("\n"))
}

#[test]
fn the_example_of_a_node_is_a_good_one() {
    let config = Config::of_text(&with_node()).unwrap();
    let node = config.nodes[0].node(7, &NodeMemory::default());
    assert_eq!((node.address, node.name.parts().unique_number), (35, 7));
    assert_eq!(node.installation[0], "wheelhouse");
    assert!(config.nodes[0].faults().is_empty());
}

#[test]
fn a_node_remembers_what_it_was_told_but_not_the_past_of_another() {
    let section = Config::of_text(&with_node()).unwrap().nodes.remove(0);
    let own = section.node(7, &NodeMemory::default()).name.parts();
    let moved = NameParts { instance_lower: 3, ..own };
    let installation = Some(["bridge".to_owned(), String::new()]);
    let memory = NodeMemory { address: Some(77), name: moved.name(), installation };
    let node = section.node(7, &memory);
    assert_eq!((node.address, node.name.parts().instance()), (77, 3));
    assert_eq!(node.installation[0], "bridge");
    let other = section.node(8, &memory);
    assert_eq!((other.address, other.name.parts().instance()), (35, 0));
    assert_eq!(other.installation[0], "wheelhouse");
}

#[test]
fn an_interface_hears_what_its_node_and_sensors_need_unless_told_otherwise() {
    let imu = "[[sensor]]\nname = \"can imu\"\nport = \"backbone\"\nkind = \"can_imu\"\nlayout = \"sbg\"\n";
    let text = format!("{}\n{imu}", with_node());
    let accepted = |text: &str, id: CanId| {
        let opened = Config::of_text(text).unwrap().port_configs().pop().unwrap();
        opened.filters.is_empty() || opened.filters.iter().any(|filter| filter.accepts(id))
    };
    for (id, wanted) in [
        (CanId::Extended(0x18EA_23FE), true),
        (CanId::Extended(0x09F1_1201), true),
        (CanId::Extended(0x09FD_0201), false),
        (CanId::Standard(0x121), true),
        (CanId::Standard(0x7FF), false),
    ] {
        assert_eq!(accepted(&text, id), wanted, "{id}");
        let all = text.replace("name = \"backbone\"", "name = \"backbone\"\nfilters = []");
        assert!(accepted(&all, id), "{id}");
    }
}

#[test]
fn a_node_needs_a_can_port_of_its_own() {
    let twice = format!("{}\n[[node]]\nport = \"imu\"\naddress = 252\n", with_node());
    let message = Config::of_text(&twice).unwrap_err();
    for part in ["port: expected the name of a CAN port", "address: expected 0 to 251"] {
        assert!(message.contains(part), "{part} is not in: {message}");
    }
    let group = with_node().replace("interval_ms = 100", "interval_ms = 1");
    assert!(Config::of_text(&group).unwrap_err().contains("groups.attitude.interval_ms"));
}

#[derive(Debug, Deserialize)]
struct Sensors {
    sensor: Vec<SensorConfig>,
}

/// Sensors read both ways, as the file is.
fn layered(text: &str) -> Vec<SensorConfig> {
    let strict: Sensors = toml::from_str(text).unwrap();
    let source = config::File::from_str(text, config::FileFormat::Toml);
    let layered = config::Config::builder().add_source(source).build().unwrap();
    assert_eq!(layered.try_deserialize::<Sensors>().unwrap().sensor, strict.sensor);
    strict.sensor
}

/// The sections of the documentation, whose ports a bus of the test carries.
#[test]
fn the_documented_sensors_of_a_bus_are_read() {
    let documented = include_str!("../../../docs/sensors.md");
    let examples = documented.split("```toml").skip(1).filter_map(|rest| rest.split("```").next());
    let has = |own: &&str| own.contains("[[sensor]]") && !own.contains("tcp-client");
    let sections: Vec<&str> = examples.filter(has).collect();
    assert_eq!(sections.len(), 2);
    for section in sections {
        let sensors = layered(section);
        assert!(sensors.iter().all(|sensor| sensor.kind.protocol().is_none()));
        let ports = sensors.iter().map(|sensor| PortSpec {
            name: sensor.port.clone(),
            link: Link::Can { bit_time: 4e-6 },
        });
        let mut config =
            IntakeConfig { ports: ports.collect(), sensors, ..IntakeConfig::default() };
        config.ports.dedup();
        config.sensors.push(SensorConfig {
            layout: Some(LayoutChoice::Shipped(Shipped::Sbg)),
            ..SensorConfig::new("another imu", &config.ports[0].name, Kind::CanImu)
        });
        assert_eq!(config.faults(), []);
    }
}

#[test]
fn a_table_of_a_can_imu_is_read_from_toml_and_its_faults_are_told() {
    let table = r#"
        [[sensor]]
        name = "imu"
        port = "can"
        kind = "can_imu"
        layout = { frames = [ { id = 0x174, extended = true, fields = [
            { what = "rate_x", start = 0, width = 16, signed = true, order = "big", scale = 1e-3, missing = 0x8000 },
            { what = "time", start = 32, width = 32, scale = 1 } ] } ] }
    "#;
    let sensor = layered(table).remove(0);
    let port = PortSpec { name: "can".to_owned(), link: Link::Can { bit_time: 2e-6 } };
    let config =
        IntakeConfig { ports: vec![port], sensors: vec![sensor], ..IntakeConfig::default() };
    let told = config.faults();
    assert!(told.iter().all(|fault| fault.key == "layout") && told.len() == 2, "{told:?}");
    let fault = toml::from_str::<Sensors>(&table.replace("width", "witdh")).unwrap_err();
    assert!(fault.to_string().contains("witdh"), "{fault}");
    let unknown =
        "[[sensor]]\nname = \"imu\"\nport = \"can\"\nkind = \"can_imu\"\nlayout = \"xsense\"";
    let fault = toml::from_str::<Sensors>(unknown).unwrap_err();
    assert!(fault.to_string().contains("xsense"), "{fault}");
}

#[test]
fn a_name_that_is_not_there_or_there_twice_is_a_fault() {
    let nodes = format!("{}\n[[node]]\nport = \"imu\"\npoint = \"bwo\"\n", with_node());
    let fault = Config::of_text(&nodes).unwrap_err();
    assert!(fault.contains("point: expected the name of a [[point]]"), "{fault}");
    let twice = SHIPPED.replace("name = \"network\"", "name = \"ecdis\"");
    let fault = Config::of_text(&twice).unwrap_err();
    assert!(fault.contains("expected a name that no other output has"), "{fault}");
}

#[test]
fn the_language_is_told_by_a_file_with_faults_as_well() {
    let japanese = SHIPPED.replacen("[ship]", "[ship]\nlanguage = \"ja\"", 1);
    assert_eq!(Config::of_text(&japanese).unwrap().ship.language, Language::Japanese);
    let faulty = japanese.replace("lat_deg = 35.44", "lat_deg = 135.44");
    assert_eq!(Config::language_of(&faulty), Language::Japanese);
    for english in [SHIPPED, "", "no file of this kind", "[ship]\nlanguage = \"fr\""] {
        assert_eq!(Config::language_of(english), Language::English);
    }
}
