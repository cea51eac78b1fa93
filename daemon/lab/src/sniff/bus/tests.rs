use insd_base::{Arrival, BusEvent, CanFrame, CanId, Input, PortId, Stamp, Time, UtcTime};
use insd_n2k::groups::ProductInfo;
use insd_n2k::pgn::{Group, Heading, North};
use insd_n2k::{BROADCAST, N2kId, NameParts, fast_packet};

use crate::sniff::report::PortReport;
use crate::sniff::{PortToHear, Sniffed, SuggestedTransport, text};

const NAME: NameParts = NameParts {
    unique_number: 7,
    manufacturer: 229,
    instance_lower: 0,
    instance_upper: 0,
    function: 140,
    class: 60,
    system_instance: 0,
    industry: 4,
    arbitrary_address: true,
};

/// A port whose arrivals are made here.
struct Bench(Sniffed);

impl Bench {
    fn new() -> Self {
        let mut sniffed = Sniffed::new(&[]);
        let table = "{ kind = \"socketcan\", interface = \"can0\" }".to_owned();
        let transport = Some(SuggestedTransport::Other(table));
        sniffed.announce(PortId(0), PortToHear { name: "can0".to_owned(), timed: true, transport });
        Bench(sniffed)
    }

    fn take(&mut self, seconds: f64, input: Input) {
        let monotonic = Time::from_seconds(seconds);
        let stamp = Stamp { monotonic, system: UtcTime::from_nanos(0) };
        self.0.take(&Arrival { stamp, port: PortId(0), input });
    }

    fn message(&mut self, seconds: f64, pgn: u32, source: u8, data: &[u8]) {
        let id = N2kId { priority: 3, pgn, source, destination: BROADCAST };
        let frames = match CanFrame::new(id.compose(), data) {
            Some(frame) => vec![frame],
            None => fast_packet::split(id, data, 1).unwrap(),
        };
        for frame in frames {
            self.take(seconds, Input::Can(frame));
        }
    }

    fn claim(&mut self, seconds: f64, source: u8) {
        self.message(seconds, 60_928, source, &NAME.name().unwrap().bytes());
    }

    fn headings(&mut self, from: f64, source: u8) {
        for n in 0..20 {
            let heading = Heading {
                sid: None,
                heading: Some(1.0),
                deviation: None,
                variation: None,
                reference: Some(North::True),
            };
            self.message(from + f64::from(n) * 0.1, Heading::PGN, source, &heading.write());
        }
    }

    fn report(&self, seconds: f64) -> PortReport {
        self.0.report(Time::from_seconds(seconds)).ports.remove(0)
    }
}

#[test]
fn a_device_is_listed_with_its_product_and_what_it_sends() {
    let mut bench = Bench::new();
    bench.claim(0.0, 3);
    let product = ProductInfo {
        model: "Steadycast".to_owned(),
        software: "2.10".to_owned(),
        serial: "4711".to_owned(),
        ..ProductInfo::default()
    };
    bench.message(0.1, ProductInfo::PGN, 3, &product.write());
    bench.headings(0.2, 3);
    let report = bench.report(2.2);
    let bus = report.bus.as_ref().unwrap();
    assert_eq!((bus.devices.len(), bus.frames, bus.broken), (1, 1 + 20 + 20, 0));
    let device = &bus.devices[0];
    assert_eq!(device.model.as_deref(), Some("Steadycast"));
    let heading = device.groups.iter().find(|group| group.pgn == 127_250).unwrap();
    assert!((heading.rate_hz.unwrap() - 10.0).abs() < 1e-6 && heading.used);
    let load = bus.load.unwrap();
    assert!(load > 0.005 && load < 0.02, "{load}");
    let shown = text::port(&report);
    for part in ["Garmin Steadycast", "software 2.10", "serial 4711", "127250  heading"] {
        assert!(shown.contains(part), "{part} is not in\n{shown}");
    }
    let sections = report.suggestions.join("\n");
    let name = NAME.name().unwrap();
    for part in [
        "interface = \"can0\"",
        "kind = \"n2k_heading\"",
        &format!("device = {{ name = \"{name}\" }}"),
    ] {
        assert!(sections.contains(part), "{part} is not in\n{sections}");
    }
}

#[test]
fn a_device_that_changes_its_address_is_the_same() {
    let mut bench = Bench::new();
    bench.claim(0.0, 3);
    bench.headings(0.1, 3);
    bench.claim(2.2, 9);
    bench.headings(2.3, 9);
    let bus = bench.report(4.3).bus.unwrap();
    assert_eq!(bus.devices.len(), 1);
    assert_eq!((bus.devices[0].address, bus.devices[0].addresses_before.as_slice()), (9, &[3][..]));
    assert_eq!(bus.devices[0].groups.iter().map(|group| group.count).max(), Some(40));
}

#[test]
fn what_is_not_nmea_2000_goes_by_its_identifier_and_errors_are_told() {
    let mut bench = Bench::new();
    for n in 0..100 {
        let frame = CanFrame::new(CanId::Standard(0x121), &[1, 2, 3]).unwrap();
        bench.take(f64::from(n) * 0.01, Input::Can(frame));
    }
    bench.take(1.0, Input::Bus(BusEvent::BusOff));
    let report = bench.report(1.0);
    let bus = report.bus.as_ref().unwrap();
    assert_eq!((bus.others[0].id.as_str(), bus.others[0].last.as_str()), ("121", "01 02 03"));
    assert_eq!((bus.events[0].name.as_str(), bus.events[0].count), ("bus off", 1));
    assert!(report.hints.iter().any(|hint| hint.contains("terminators")), "{:?}", report.hints);
}

#[test]
fn an_imu_is_suggested_by_its_frames() {
    let mut bench = Bench::new();
    for n in 0..200 {
        for id in [0x120, 0x121, 0x122] {
            let frame = CanFrame::new(CanId::Standard(id), &[0; 8]).unwrap();
            bench.take(f64::from(n) * 0.01, Input::Can(frame));
        }
    }
    let sections = bench.report(2.0).suggestions.join("\n");
    for part in ["kind = \"can_imu\"", "layout = \"sbg\"", "rate_hz = 100.0"] {
        assert!(sections.contains(part), "{part} is not in\n{sections}");
    }
}

#[test]
fn memory_is_bounded_whatever_comes() {
    let mut bench = Bench::new();
    for n in 0..60_000_u32 {
        let id = CanId::Extended(n.wrapping_mul(0x9E37_79B9) & CanId::MAX_EXTENDED);
        bench.take(f64::from(n) * 1e-3, Input::Can(CanFrame::new(id, &[0; 8]).unwrap()));
        let other = CanId::Standard(n as u16 & CanId::MAX_STANDARD);
        bench.take(f64::from(n) * 1e-3, Input::Can(CanFrame::new(other, &[0; 8]).unwrap()));
    }
    let bus = bench.report(60.0).bus.unwrap();
    assert!(bus.devices.iter().all(|device| device.groups.len() <= 64));
    assert!(bus.devices.len() <= 254 && bus.others.len() <= 64 && bus.more > 0);
}
