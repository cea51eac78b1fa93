//! A base beside a receiver of the ship: its epochs are offered, and taken for nothing else.

#![allow(clippy::unwrap_used)] // helpers of tests are not seen as tests

use insd_base::{
    Arrival, BaseEpoch, Ecef, Geodetic, GpsTime, Input, Message, PortId, Source, Stamp, Time,
    UtcTime, earth,
};
use insd_intake::base::{BaseNews, BaseSettings};
use insd_intake::config::{IntakeConfig, Kind, PortSpec, SensorConfig};
use insd_intake::event::{Happening, Refusal};
use insd_intake::port::Link;
use insd_intake::{Intake, Intaken};
use insd_wire::gnss::rtcm::{Correction, MsmCollector};
use insd_wire::stream::{Cutter, Protocol};

/// Messages of a recorded base: where it is, and one epoch (its licence is beside it).
const RECORDED: &[u8] = include_bytes!("../../wire/tests/data/rtcm3.bin");

/// When the recorded epoch was, and where.
fn recorded() -> (GpsTime, Geodetic) {
    let about = UtcTime::from_civil((2023, 1, 3), (12, 0, 0), 0).unwrap().to_gps();
    let (mut cutter, mut collector) = (Cutter::new(&[Protocol::Rtcm]), MsmCollector::new());
    cutter.push(RECORDED);
    let (mut tag, mut place) = (None, None);
    while let Some(cut) = cutter.cut() {
        for told in collector.take(cut.bytes, about).unwrap() {
            match told {
                Correction::Epoch(epoch) => tag = Some(epoch.tag),
                Correction::Base(base) => place = Some(base.position),
                Correction::Record(_) => {}
            }
        }
    }
    (tag.unwrap(), earth::geodetic(&Ecef(place.unwrap().into())))
}

fn sentence(inside: &str) -> String {
    let sum = inside.bytes().fold(0, |sum, byte| sum ^ byte);
    format!("${inside}*{sum:02X}\r\n")
}

/// What the ship's receiver says at an instant of UTC, so many degrees north of the base.
fn said(utc: UtcTime, base: &Geodetic, north_deg: f64) -> Vec<u8> {
    let of_day = utc.as_nanos().div_euclid(1_000_000_000).rem_euclid(86_400);
    let time = format!("{:02}{:02}{:02}.00", of_day / 3600, of_day / 60 % 60, of_day % 60);
    let minutes = |degrees: f64, width: usize| {
        let degrees = degrees.abs();
        format!("{:0width$}{:07.4}", degrees.trunc(), degrees.fract() * 60.0)
    };
    let (lat, lon) = (base.latitude.to_degrees() + north_deg, base.longitude.to_degrees());
    let (ns, ew) = (if lat < 0.0 { 'S' } else { 'N' }, if lon < 0.0 { 'W' } else { 'E' });
    let place = format!("{},{ns},{},{ew}", minutes(lat, 2), minutes(lon, 3));
    let text = sentence(&format!("GPZDA,{time},03,01,2023,00,00"))
        + &sentence(&format!("GPGGA,{time},{place},1,12,0.9,40.0,M,36.7,M,,"));
    text.into_bytes()
}

struct Heard {
    bases: Vec<BaseEpoch>,
    others: usize,
    ranges: usize,
    news: Vec<BaseNews>,
    intake: Intake,
}

/// Ten seconds of the ship's receiver, and then the base's bytes, in pieces of a size.
fn hear(settings: BaseSettings, north_deg: f64, size: usize) -> Heard {
    let (tag, place) = recorded();
    let port = |name: &str| PortSpec { name: name.to_owned(), link: Link::Stream };
    let base =
        SensorConfig { base: settings, ..SensorConfig::new("base", "caster", Kind::RtcmBase) };
    let config = IntakeConfig {
        ports: vec![port("gnss"), port("caster")],
        sensors: vec![SensorConfig::new("gnss", "gnss", Kind::NmeaGnss), base],
        ..IntakeConfig::default()
    };
    let mut heard = Heard {
        bases: Vec::new(),
        others: 0,
        ranges: 0,
        news: Vec::new(),
        intake: Intake::new(&config),
    };
    let utc = tag.to_utc(Some(18));
    let at = |nanos: i64| Stamp {
        monotonic: Time::from_nanos(20_000_000_000 + nanos),
        system: UtcTime::from_nanos(utc.as_nanos() + nanos),
    };
    let whole = utc.as_nanos().rem_euclid(1_000_000_000);
    for second in -10..=1_i64 {
        let valid = second * 1_000_000_000 - whole;
        let bytes = said(UtcTime::from_nanos(utc.as_nanos() + valid), &place, north_deg);
        heard.take(0, at(valid + 50_000_000), bytes);
    }
    for (piece, number) in RECORDED.chunks(size).zip(0..) {
        heard.take(1, at(1_500_000_000 + number * 1_000), piece.to_vec());
    }
    heard
}

impl Heard {
    fn take(&mut self, port: u16, stamp: Stamp, bytes: Vec<u8>) {
        let (port, input) = (PortId(port), Input::Bytes(bytes));
        self.intake.handle(&Arrival { stamp, port, input });
        while let Some(output) = self.intake.poll_output() {
            match output {
                Intaken::Measured(received) => match received.message {
                    Message::Base(base) => {
                        assert_eq!(received.source, Source::Base(0));
                        self.bases.push((*base).clone());
                    }
                    Message::Ranges(_) => self.ranges += 1,
                    _ => self.others += 1,
                },
                Intaken::Watched(_) => {}
                Intaken::Event(event) => {
                    if let Happening::Base { sensor: 1, news } = event.what {
                        self.news.push(news);
                    }
                }
                Intaken::Temperature(..) => {}
            }
        }
    }
}

#[test]
fn a_base_is_offered_with_its_place_and_never_as_a_receiver_of_the_ship() {
    for size in [1, 7, 100, 100_000] {
        let heard = hear(BaseSettings::default(), 0.1, size);
        let [base] = &heard.bases[..] else { panic!("{} epochs", heard.bases.len()) };
        assert_eq!(base.epoch.signals.len(), 51);
        assert!(base.position.is_some() && base.station.is_some() && !base.is_moving);
        // the tag is at 20 s of the time line, known to the delay of the receiver's sentences
        assert!((base.time.as_seconds() - 20.0).abs() < 0.2, "{:?}", base.time);
        assert!(heard.ranges == 0 && heard.others > 5, "{} fixes", heard.others);
        assert!(matches!(heard.news[..], [BaseNews::Placed { .. }]), "{:?}", heard.news);
        let status = heard.intake.status();
        let own = status.sensors[1].base.as_ref().unwrap();
        assert_eq!((own.epochs, own.stations, status.sensors[1].passed), (1, 1, 1));
        assert!((10_000.0..13_000.0).contains(&own.distance.unwrap()), "{own:?}");
        assert!(status.choices.iter().all(|choice| choice.sensor != Some(1)));
    }
}

#[test]
fn a_base_far_away_or_elsewhere_than_configured_is_told() {
    let heard = hear(BaseSettings::default(), 2.0, 1000);
    assert!(heard.news.iter().any(|news| matches!(news, BaseNews::Far { .. })), "{:?}", heard.news);
    let (_, place) = recorded();
    let settings = BaseSettings {
        lat_deg: Some(place.latitude.to_degrees()),
        lon_deg: Some(place.longitude.to_degrees()),
        height_m: Some(place.height + 30.0),
        moving: false,
    };
    let heard = hear(settings, 0.1, 1000);
    let contradicted =
        |news: &BaseNews| matches!(news, BaseNews::Contradicts { by } if (by - 30.0).abs() < 0.01);
    assert!(heard.news.iter().any(contradicted), "{:?}", heard.news);
}

#[test]
fn a_base_is_refused_while_nobody_knows_the_time() {
    let config = IntakeConfig {
        ports: vec![PortSpec { name: "caster".to_owned(), link: Link::Stream }],
        sensors: vec![SensorConfig::new("base", "caster", Kind::RtcmBase)],
        ..IntakeConfig::default()
    };
    let mut intake = Intake::new(&config);
    let system = UtcTime::from_civil((2023, 1, 3), (12, 0, 0), 0).unwrap();
    let stamp = Stamp { monotonic: Time::from_seconds(1.0), system };
    let input = Input::Bytes(RECORDED.to_vec());
    intake.handle(&Arrival { stamp, port: PortId(0), input });
    let status = intake.status();
    assert_eq!(status.sensors[0].passed, 0);
    assert!(status.sensors[0].refused.contains_key(&Refusal::NoTime), "{status:?}");
}

#[test]
fn half_a_place_and_a_base_that_is_none_are_faults_of_the_configuration() {
    let faults = |kind, base| {
        let config = IntakeConfig {
            ports: vec![PortSpec { name: "port".to_owned(), link: Link::Stream }],
            sensors: vec![SensorConfig { base, ..SensorConfig::new("own", "port", kind) }],
            ..IntakeConfig::default()
        };
        config.faults().into_iter().filter(|fault| fault.key == "base").count()
    };
    let half = BaseSettings { lat_deg: Some(53.0), ..BaseSettings::default() };
    let moving = BaseSettings { moving: true, ..BaseSettings::default() };
    assert_eq!(faults(Kind::RtcmBase, BaseSettings::default()), 0);
    assert_eq!(faults(Kind::RtcmBase, half), 1);
    assert_eq!(faults(Kind::RtcmBase, moving), 0);
    assert_eq!(faults(Kind::Rtcm, moving), 1);
}
