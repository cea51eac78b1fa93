//! A receiver's raw messages and a base's corrections, from their bytes to places by integers.

use std::collections::BTreeMap;

use insd_base::{Arrival, Event, Input, Message, PortId, SolutionSource, Source, Time};
use insd_engine::{Engine, EngineConfig, Output};
use insd_intake::Intaken;
use insd_intake::config::{IntakeConfig, Kind, PortSpec, SensorConfig};
use insd_intake::port::Link;
use insd_simulator::{raw_gnss, simulate};
use insd_tests::feed::{Calendar, Encoding, FeedConfig, Reception, arrivals, feed};
use insd_tests::raw_feed;
use insd_tests::scores::horizontal_error;
use insd_wire::gnss::rtcm::Frame;
use insd_wire::stream::{Cutter, Protocol};

/// Length of the voyage, s.
const DURATION: f64 = 150.0;
const GNSS: usize = 1;
const BASE: u16 = 2;

/// A ship with an IMU and a u-blox receiver, which hears a base; all that reaches her computer.
struct Ship {
    voyage: insd_base::Voyage,
    intake: IntakeConfig,
    arrivals: Vec<Arrival>,
    reception: Reception,
}

/// What came of it.
struct Sailed {
    /// Horizontal errors while the source is RTK, m, after the first seconds of it.
    errors: Vec<f64>,
    sources: Vec<&'static str>,
    rtk: BTreeMap<&'static str, u64>,
    intake: insd_intake::Intake,
}

impl Ship {
    fn new() -> Self {
        let scenario =
            insd_tests::port_with_base(&[("grade = \"mems\"", "grade = \"navigation\"")])
                .with_duration(DURATION);
        let (voyage, raw) = (simulate(&scenario, 3), raw_gnss(&scenario, 3).unwrap());
        let feeds = FeedConfig::new(&voyage, &[Encoding::Sbg, Encoding::Ubx]);
        let utc = Calendar::new(&voyage.header.start_utc).unwrap().start;
        let reception = Reception::new(utc, 5);
        let mut sendings = feed(&voyage, &feeds);
        sendings.extend(raw_feed::ubx(&raw, utc.to_gps(), GNSS));
        sendings.extend(raw_feed::rtcm(&raw, utc.to_gps(), BASE.into()));
        sendings.sort_by_key(|sending| sending.at);
        let mut intake = feeds.intake(&voyage);
        intake.ports.push(PortSpec { name: "caster".to_owned(), link: Link::Stream });
        intake.sensors.push(SensorConfig::new("base", "caster", Kind::RtcmBase));
        Ship { arrivals: arrivals(&sendings, &reception), voyage, intake, reception }
    }

    /// The bytes of the base, changed.
    fn with_base(mut self, mut change: impl FnMut(f64, Vec<u8>) -> Vec<u8>) -> Self {
        for arrival in self.arrivals.iter_mut().filter(|own| own.port == PortId(BASE)) {
            let at = (arrival.stamp.monotonic - self.reception.offset).as_seconds();
            if let Input::Bytes(bytes) = &mut arrival.input {
                *bytes = change(at, std::mem::take(bytes));
            }
        }
        self
    }

    fn sail(&self) -> Sailed {
        assert_eq!(self.intake.faults(), []);
        let mut intake = insd_intake::Intake::new(&self.intake);
        let mut engine = Engine::new(EngineConfig::for_voyage(&self.voyage.header, 1.0));
        let (mut errors, mut sources) = (Vec::new(), Vec::new());
        let mut by_rtk = 0;
        for arrival in &self.arrivals {
            intake.handle(arrival);
            while let Some(taken) = intake.poll_output() {
                let Intaken::Measured(received) = taken else { continue };
                let is_of_base = matches!(received.message, Message::Base(_));
                assert_eq!(is_of_base, received.source == Source::Base(0));
                engine.handle(&received);
                while let Some(output) = engine.poll_output() {
                    match output {
                        Output::Event(Event::SourceChanged { to, .. }) => sources.push(to.as_str()),
                        Output::Solution(own) if own.source == Some(SolutionSource::Rtk) => {
                            by_rtk += 1;
                            errors.extend(self.error(&own).filter(|_| by_rtk > 20));
                        }
                        _ => {}
                    }
                }
            }
        }
        Sailed { errors, sources, rtk: engine.counts().rtk.clone(), intake }
    }

    /// How far a solution is from the truth, m.
    fn error(&self, own: &insd_base::Solution) -> Option<f64> {
        let time: Time = own.time - self.reception.offset;
        horizontal_error(&self.voyage.truth, time, &own.position)
    }
}

#[test]
fn bytes_of_a_receiver_and_of_a_base_bring_centimetres() {
    let sailed = Ship::new().sail();
    let worst = sailed.errors.iter().copied().fold(0.0, f64::max);
    println!(
        "{} solutions, worst {worst:.3} m, {:?} {:?}",
        sailed.errors.len(),
        sailed.sources,
        sailed.rtk
    );
    assert_eq!(sailed.sources.last(), Some(&"rtk"));
    assert!(sailed.errors.len() > 30 && worst < 0.1, "{worst}");
    let base = sailed.intake.status().sensors[usize::from(BASE)].base.clone().unwrap();
    assert_eq!((base.station, base.epochs), (Some(7), 150), "{base:?}");
}

#[test]
fn a_base_whose_bytes_are_damaged_or_cut_loses_epochs_and_nothing_else() {
    let mut number = 0_usize;
    let damaged = Ship::new().with_base(|_, mut bytes| {
        number += 1;
        match number % 8 {
            0 => {
                let at = number * 7919 % bytes.len();
                bytes[at] ^= 0x41;
            }
            4 => bytes.truncate(bytes.len() * 2 / 3),
            _ => {}
        }
        bytes
    });
    let sailed = damaged.sail();
    let worst = sailed.errors.iter().copied().fold(0.0, f64::max);
    println!("worst {worst:.3} m, {:?} {:?}", sailed.sources, sailed.rtk);
    assert_eq!(sailed.sources.last(), Some(&"rtk"));
    assert!(sailed.errors.len() > 20 && worst < 0.1, "{worst}");
    let counts = &sailed.intake.status().ports[usize::from(BASE)].counts;
    assert!(counts.damaged > 0, "{counts:?}");
}

#[test]
fn a_base_that_falls_silent_is_missed_and_one_without_its_place_never_used() {
    let silent = Ship::new().with_base(|at, bytes| if at > 100.0 { Vec::new() } else { bytes });
    let sailed = silent.sail();
    println!("{:?} {:?}", sailed.sources, sailed.rtk);
    assert!(sailed.sources.contains(&"rtk") && sailed.sources.last() != Some(&"rtk"));
    assert!(sailed.rtk.contains_key("base_silent"), "{:?}", sailed.rtk);
    let unplaced = Ship::new().with_base(|_, bytes| {
        let mut cutter = Cutter::new(&[Protocol::Rtcm]);
        cutter.push(&bytes);
        let frames = std::iter::from_fn(|| cutter.cut().map(|cut| cut.bytes.to_vec()));
        let place = |frame: &Vec<u8>| Frame::open(frame).unwrap().number() == Some(1005);
        frames.filter(|frame| !place(frame)).collect::<Vec<_>>().concat()
    });
    let sailed = unplaced.sail();
    assert!(!sailed.sources.contains(&"rtk"), "{:?}", sailed.sources);
    assert_eq!(sailed.rtk.keys().collect::<Vec<_>>(), [&"base_unplaced"]);
}
