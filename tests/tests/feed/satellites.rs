//! Raw messages of a receiver, from its bytes to ranges and solutions.

use std::collections::BTreeMap;
use std::sync::OnceLock;

use insd_base::satellites::SatelliteRanges;
use insd_base::{
    Arrival, Event, GpsTime, Input, Message, PortId, Received, Source, Span, Time, Voyage, earth,
};
use insd_engine::{Engine, EngineConfig, Output};
use insd_intake::config::{IntakeConfig, Kind, PortSpec, SensorConfig};
use insd_intake::event::{BroadcastFault, Happening, Refusal};
use insd_intake::port::Link;
use insd_intake::satellites::RawUse;
use insd_intake::{Intake, Intaken};
use insd_lab::raw_receivers::RawReceivers;
use insd_lab::sniff::Sniffed;
use insd_rinex::{
    ObservationHeader, ObservationReader, read_navigation, write_navigation, write_observations,
};
use insd_simulator::{RawGnss, raw_gnss, simulate};
use insd_tests::feed::{Calendar, Encoding, FeedConfig, Reception, arrivals, feed};
use insd_tests::raw_feed;
use insd_wire::gnss::ubx::RxmRawx;
use insd_wire::stream::Protocol;

/// Length of the voyage, s.
const DURATION: f64 = 150.0;
const IMU: u16 = 0;
const GNSS: u16 = 1;

/// A ship with an IMU and a u-blox receiver, all that reaches her computer, and where it began.
struct Ship {
    voyage: Voyage,
    raw: RawGnss,
    intake: IntakeConfig,
    arrivals: Vec<Arrival>,
    reception: Reception,
    start: GpsTime,
}

impl Ship {
    /// With the receiver's own fixes, or without; with raw messages, or without.
    fn new(fixes: bool, satellites: bool) -> Self {
        let text = [("grade = \"mems\"", "grade = \"navigation\"")];
        let scenario = insd_tests::variant(26, &text).with_duration(DURATION);
        let (voyage, raw) = (simulate(&scenario, 3), raw_gnss(&scenario, 3).unwrap());
        let feeds = FeedConfig::new(&voyage, &[Encoding::Sbg, Encoding::Ubx]);
        let utc = Calendar::new(&voyage.header.start_utc).unwrap().start;
        let start = utc.to_gps();
        let reception = Reception::new(utc, 5);
        let mut sendings = feed(&voyage, &feeds);
        sendings.retain(|sending| sending.port != usize::from(GNSS) || fixes);
        if satellites {
            sendings.extend(raw_feed::ubx(&raw, start, usize::from(GNSS)));
        }
        sendings.sort_by_key(|sending| sending.at);
        let arrivals = arrivals(&sendings, &reception);
        let intake = feeds.intake(&voyage);
        Ship { voyage, raw, intake, arrivals, reception, start }
    }

    fn usual() -> &'static Ship {
        static SHIP: OnceLock<Ship> = OnceLock::new();
        SHIP.get_or_init(|| Ship::new(true, true))
    }

    fn taken(&self) -> Taken {
        Taken::of(&self.intake, &self.arrivals)
    }

    /// The first measurement of an epoch, changed as wished.
    fn changed(&self, mut change: impl FnMut(usize, RxmRawx) -> Vec<RxmRawx>) -> Vec<Arrival> {
        let mut number = 0;
        let each = |arrival: &Arrival| {
            let Input::Bytes(bytes) = &arrival.input else { return vec![arrival.clone()] };
            let Ok(raw) = RxmRawx::read(bytes) else { return vec![arrival.clone()] };
            number += 1;
            let told = change(number, raw);
            let input = |raw: &RxmRawx| Input::Bytes(raw.write());
            told.iter().map(|raw| Arrival { input: input(raw), ..arrival.clone() }).collect()
        };
        self.arrivals.iter().flat_map(each).collect()
    }
}

/// What an intake makes of it.
struct Taken {
    measured: Vec<Received>,
    happened: Vec<(Time, Happening)>,
    refused: BTreeMap<Refusal, u64>,
    intake: Intake,
}

impl Taken {
    fn of(config: &IntakeConfig, arrivals: &[Arrival]) -> Self {
        assert_eq!(config.faults(), []);
        let mut intake = Intake::new(config);
        let (mut measured, mut happened) = (Vec::new(), Vec::new());
        for arrival in arrivals {
            intake.handle(arrival);
            while let Some(taken) = intake.poll_output() {
                match taken {
                    Intaken::Measured(received) => measured.push(received),
                    Intaken::Event(event) => happened.push((event.time, event.what)),
                    Intaken::Temperature(..) | Intaken::Watched(_) => {}
                }
            }
        }
        let refused = intake.status().sensors[usize::from(GNSS)].refused.clone();
        Taken { measured, happened, refused, intake }
    }

    /// Epochs with ranges; those before any orbit is known tell which satellites are heard.
    fn ranges(&self) -> Vec<(&Received, &SatelliteRanges)> {
        let ranges = self.measured.iter().filter_map(|received| match &received.message {
            Message::Ranges(told) if !told.ranges.is_empty() => Some((received, told.as_ref())),
            _ => None,
        });
        ranges.collect()
    }

    fn refusals(&self, reason: Refusal) -> u64 {
        self.refused.get(&reason).copied().unwrap_or(0)
    }
}

#[test]
fn raw_messages_become_ranges_at_their_instant_on_the_ships_time_line() {
    let ship = Ship::usual();
    let taken = ship.taken();
    let ranges = taken.ranges();
    assert!(ranges.len() > 130, "{} epochs, refused {:?}", ranges.len(), taken.refused);
    let clocks = &ship.raw.antennas[0];
    for (received, told) in &ranges {
        assert_eq!(received.source, Source::Gnss(0));
        assert!(told.time <= received.receipt);
        // true time to a millisecond, whatever the receiver's own clock says
        let voyage = (told.time - ship.reception.offset).as_seconds();
        let second = voyage.round();
        assert!((voyage - second).abs() < 2e-3, "{voyage}");
        assert!(told.ranges.len() >= 5, "{} satellites", told.ranges.len());
    }
    assert!(clocks.len() >= ranges.len());
    let heard = taken.measured.iter().find_map(|received| match &received.message {
        Message::Ranges(told) => Some(told),
        _ => None,
    });
    assert!(heard.is_some_and(|told| told.ranges.is_empty() && told.heard.len() >= 5));
    let receipts: Vec<Time> = taken.measured.iter().map(|received| received.receipt).collect();
    assert!(receipts.is_sorted());
    let begun = |own: &(Time, Happening)| matches!(own.1, Happening::Ranges { used: true, .. });
    assert_eq!(taken.happened.iter().filter(|own| begun(own)).count(), 1);
    let fixes = taken.measured.iter().filter(|own| matches!(own.message, Message::Gnss(_)));
    let without = Taken::of(&ship.intake, &Ship::new(true, false).arrivals);
    let others = without.measured.iter().filter(|own| matches!(own.message, Message::Gnss(_)));
    assert_eq!(fixes.count(), others.count());
}

#[test]
fn a_ship_navigates_by_ranges_alone() {
    let ship = Ship::new(false, true);
    let taken = ship.taken();
    let config = EngineConfig::for_voyage(&ship.voyage.header, 1.0);
    let mut engine = Engine::new(config);
    let (mut codes, mut last) = (0, None);
    for received in &taken.measured {
        engine.handle(received);
        while let Some(output) = engine.poll_output() {
            match output {
                Output::Solution(solution) => last = Some(solution),
                Output::Innovation(own) => codes += usize::from(own.aid == "satellite_code"),
                _ => {}
            }
        }
    }
    let (last, accepted) = (last.unwrap(), &engine.counts().accepted);
    assert!(last.mode.is_navigating(), "{:?} {:?} {accepted:?}", last.mode, taken.refused);
    assert!(accepted.get("satellite_code").is_some_and(|own| *own > 30), "{codes} {accepted:?}");
    let time = last.time - ship.reception.offset;
    let nearest = |truth: &&insd_base::Truth| (truth.time - time).as_nanos().abs();
    let truth = ship.voyage.truth.iter().min_by_key(nearest).unwrap();
    let apart = earth::ecef(&last.position).0 - earth::ecef(&truth.position).0;
    let off = (earth::c_ne(&truth.position) * apart).xy().norm();
    assert!(off < 8.0, "{off} m off");
    // the receiver told no time but that of its raw epochs
    let utc = taken.intake.utc_at(last.time).unwrap().to_gps();
    let right = ship.start.plus(time - Time::START);
    assert!(utc.since(right).as_seconds().abs() < 0.1, "{:?}", utc.since(right));
}

#[test]
fn whatever_pieces_bytes_come_in_the_same_is_measured() {
    let ship = Ship::usual();
    let whole = ship.taken();
    // one read cut into pieces that return at the same instant
    let cut = |arrival: &Arrival, size: usize| -> Vec<Arrival> {
        let Input::Bytes(bytes) = &arrival.input else { return vec![arrival.clone()] };
        let pieces = bytes.chunks(size).map(|piece| Input::Bytes(piece.to_vec()));
        pieces.map(|input| Arrival { input, ..arrival.clone() }).collect()
    };
    let mut intake = ship.intake.clone();
    // a serial line would say that the last piece's bytes came later
    intake.ports.iter_mut().for_each(|port| port.link = Link::Stream);
    let whole_of_stream = Taken::of(&intake, &ship.arrivals);
    assert_eq!(whole.ranges().len(), whole_of_stream.ranges().len());
    for size in [1, 7, 64, 1000] {
        let pieces: Vec<_> = ship.arrivals.iter().flat_map(|own| cut(own, size)).collect();
        assert_eq!(Taken::of(&intake, &pieces).measured, whole_of_stream.measured, "{size}");
    }
}

#[test]
fn raw_messages_that_are_switched_off_change_nothing() {
    let ship = Ship::usual();
    let mut config = ship.intake.clone();
    config.sensors[usize::from(GNSS)].raw = RawUse::Off;
    let off = Taken::of(&config, &ship.arrivals);
    assert!(off.ranges().is_empty() && off.refused.is_empty(), "{:?}", off.refused);
}

#[test]
fn an_epoch_that_comes_twice_or_late_is_counted_and_left_out() {
    let ship = Ship::usual();
    let sound = ship.taken();
    let mut before = None;
    let arrivals = ship.changed(|number, raw| {
        let last = before.replace(raw.clone());
        match number {
            60 => vec![raw.clone(), raw],
            80 => vec![raw, last.unwrap()],
            _ => vec![raw],
        }
    });
    let taken = Taken::of(&ship.intake, &arrivals);
    assert_eq!(taken.refusals(Refusal::Repeated), 2);
    assert_eq!(taken.ranges().len(), sound.ranges().len());
}

#[test]
fn a_tag_that_jumps_is_doubted_and_the_next_one_counts_again() {
    let ship = Ship::usual();
    let sound = ship.taken();
    let arrivals = ship.changed(|number, mut raw| {
        if number == 70 {
            raw.time_of_week += 300.0;
        }
        vec![raw]
    });
    let taken = Taken::of(&ship.intake, &arrivals);
    assert_eq!(taken.refusals(Refusal::TimeDoubted), 1);
    // five epochs in a row, before those behind the one that jumped are believed to be the next
    let lost = sound.ranges().len() - taken.ranges().len();
    assert_eq!((lost, taken.refusals(Refusal::Repeated)), (1, 0), "{:?}", taken.refused);
}

#[test]
fn a_satellite_whose_words_are_damaged_is_told_once_and_the_others_count() {
    let ship = Ship::usual();
    let mut arrivals = ship.arrivals.clone();
    let record = ship.raw.broadcast.iter().find_map(|record| match record {
        insd_base::BroadcastRecord::Kepler(own) => raw_feed::subframe(own, 0).map(|_| *own),
        insd_base::BroadcastRecord::Glonass(_) => None,
    });
    let record = record.unwrap();
    let damaged = || {
        let mut words = insd_wire::gnss::navigation::lnav_words(&record)[0].clone();
        words[4] ^= 1 << 12;
        let signal = insd_base::SignalCode::new(1, b'C');
        let signal = insd_wire::gnss::ubx::Signal::of(record.satellite, signal, None).unwrap();
        insd_wire::gnss::ubx::RxmSfrbx { signal, channel: 0, version: 2, words }.write()
    };
    for seconds in [0.5, 0.6, 0.7] {
        let stamp = ship.reception.stamp(Time::from_seconds(seconds + 2.0));
        arrivals.push(Arrival { stamp, port: PortId(GNSS), input: Input::Bytes(damaged()) });
    }
    arrivals.sort_by_key(|arrival| arrival.stamp.monotonic);
    let taken = Taken::of(&ship.intake, &arrivals);
    assert_eq!(taken.refusals(Refusal::Broadcast), 3);
    let told: Vec<_> = taken.happened.iter().filter(|(_, own)| is_of_words(own)).collect();
    assert_eq!(told.len(), 1, "{told:?}");
    assert_eq!(taken.ranges().len(), ship.taken().ranges().len());
}

fn is_of_words(happening: &Happening) -> bool {
    let fault = |fault: &Option<BroadcastFault>| matches!(fault, Some(BroadcastFault::Words(_)));
    matches!(happening, Happening::Satellite { fault: own, .. } if fault(own))
}

#[test]
fn only_the_ranges_of_the_receiver_in_use_count() {
    let ship = Ship::usual();
    let mut config = ship.intake.clone();
    config.ports.push(PortSpec { name: "second".to_owned(), link: Link::Stream });
    let second = SensorConfig { priority: 9, ..SensorConfig::new("second", "second", Kind::Ubx) };
    config.sensors.push(second);
    let both = ship.arrivals.iter().flat_map(|arrival| {
        let again = Arrival { port: PortId(2), ..arrival.clone() };
        [Some(arrival.clone()), (arrival.port == PortId(GNSS)).then_some(again)]
    });
    let both: Vec<_> = both.flatten().collect();
    let taken = Taken::of(&config, &both);
    assert!(taken.ranges().iter().all(|(received, _)| received.source == Source::Gnss(0)));
    let second = &taken.intake.status().sensors[2].refused;
    assert!(second[&Refusal::NotChosen] > 100, "{second:?}");
    // the first falls silent: the second's count
    let silent = ship.reception.stamp(Time::from_seconds(100.0)).monotonic;
    let left =
        both.into_iter().filter(|own| own.port != PortId(GNSS) || own.stamp.monotonic < silent);
    let taken = Taken::of(&config, &left.collect::<Vec<_>>());
    let later = silent + Span::from_seconds(5.0);
    let sources = taken.ranges().into_iter().filter(|(received, _)| received.receipt > later);
    let sources: Vec<Source> = sources.map(|(received, _)| received.source).collect();
    assert!(sources.len() > 30 && sources.iter().all(|own| *own == Source::Gnss(1)));
}

#[test]
fn another_receiver_with_another_clock_takes_over_and_no_satellite_is_left_out() {
    let ship = Ship::usual();
    let mut config = ship.intake.clone();
    config.ports.push(PortSpec { name: "second".to_owned(), link: Link::Stream });
    let arm = ship.voyage.header.lever_arms.gnss.0;
    let lever_m = |down: f64| Some([arm.x, arm.y, arm.z + down]);
    config.sensors[usize::from(GNSS)].lever_m = lever_m(0.0);
    let second = SensorConfig::new("second", "second", Kind::Ubx);
    config.sensors.push(SensorConfig { priority: 9, lever_m: lever_m(0.25), ..second });
    let of_second = ship.changed(|_, mut raw| {
        raw.measurements.iter_mut().for_each(|own| {
            own.pseudorange = own.pseudorange.map(|range| range + 200.0);
        });
        vec![raw]
    });
    let of_second = of_second.into_iter().filter(|own| own.port == PortId(GNSS));
    let silent = ship.reception.stamp(Time::from_seconds(100.0)).monotonic;
    let is_heard = |own: &&Arrival| own.port != PortId(GNSS) || own.stamp.monotonic < silent;
    let mut both: Vec<_> = ship.arrivals.iter().filter(is_heard).cloned().collect();
    both.extend(of_second.map(|own| Arrival { port: PortId(2), ..own }));
    both.sort_by_key(|arrival| arrival.stamp.monotonic);
    let taken = Taken::of(&config, &both);
    let mut engine = Engine::new(EngineConfig::for_voyage(&ship.voyage.header, 1.0));
    let (mut excluded, mut accepted) = (Vec::new(), Vec::new());
    for received in &taken.measured {
        engine.handle(received);
        while let Some(output) = engine.poll_output() {
            match output {
                Output::Event(Event::SatelliteJudged { time, satellite, is_excluded: true }) => {
                    excluded.push((time, satellite));
                }
                Output::Solution(_) => {
                    accepted.push(engine.counts().accepted.get("satellite_code").copied());
                }
                _ => {}
            }
        }
    }
    excluded.retain(|(time, _)| *time > silent);
    assert_eq!(excluded, []);
    let at_end = accepted.last().copied().flatten().unwrap_or(0);
    let at_change = accepted[accepted.len() - 50].unwrap_or(0);
    assert!(at_end > at_change + 30, "{at_change} {at_end}");
    // its antenna is that of its sensor, though its fixes are not used
    let configured = engine.estimates().unwrap().gnss_lever_configured.0;
    assert!((configured.z - arm.z - 0.25).abs() < 1e-9, "{configured}");
}

#[test]
fn what_a_receiver_measured_is_read_back_from_rinex() {
    let ship = Ship::usual();
    let mut receivers = RawReceivers::new(&ship.intake);
    for arrival in &ship.arrivals {
        receivers.take(arrival, Some(arrival.stamp.system.to_gps()));
    }
    let told: Vec<_> = receivers.told().collect();
    let [own] = told[..] else { panic!("{} receivers", told.len()) };
    assert_eq!((own.epochs.len(), own.refused), (ship.raw.antennas[0].len(), 0));
    assert_eq!((own.interval(), own.leap_seconds), (Some(1.0), Some(18)));
    let header = ObservationHeader { version: 305, ..ObservationHeader::default() };
    let text = write_observations(&header, &own.epochs);
    let back: Vec<_> = ObservationReader::new(&text).unwrap().map(Result::unwrap).collect();
    assert_eq!(back.len(), own.epochs.len());
    for (back, own) in back.iter().zip(&own.epochs) {
        assert_eq!((back.tag, back.signals.len()), (own.tag, own.signals.len()));
    }
    let text = write_navigation(&own.records, &[], own.leap_seconds);
    let records = read_navigation(&text).unwrap().records;
    assert_eq!(records.len(), own.records.len());
    assert!(records.len() >= 6, "{} orbits", records.len());
}

#[test]
fn sniffing_shows_satellites_and_signals_and_suggests_the_receiver() {
    for fixes in [true, false] {
        let ship = Ship::new(fixes, true);
        let mut sniffed = Sniffed::new(&Protocol::ALL);
        ship.arrivals.iter().for_each(|arrival| sniffed.take(arrival));
        let report = sniffed.report(sniffed.last().unwrap());
        let port = &report.ports[usize::from(GNSS)];
        let satellites = port.satellites.as_ref().unwrap();
        let gps = &satellites.constellations[0];
        assert_eq!((gps.constellation.as_str(), gps.signals.len()), ("GPS", 1));
        // one may have risen too late to send the whole of its record
        assert!(gps.satellites >= 6 && gps.orbits + 1 >= gps.satellites, "{gps:?}");
        assert!(gps.least_dbhz.unwrap() > 10.0 && gps.greatest_dbhz.unwrap() < 60.0, "{gps:?}");
        assert!(satellites.epochs > 100 && satellites.refused == 0, "{satellites:?}");
        let suggested = port.suggestions.join("\n");
        let sensors: toml::Table = suggested.parse().unwrap();
        let sensor = &sensors["sensor"][0];
        assert_eq!(sensor["kind"].as_str(), Some("ubx"), "{suggested}");
        assert_eq!(suggested.contains("no fixes of its own"), !fixes, "{suggested}");
        let text = insd_lab::sniff::text::port(port);
        assert!(text.contains("GPS") && text.contains("1C"), "{text}");
        assert!(report.ports[usize::from(IMU)].satellites.is_none());
    }
}

#[test]
fn measurements_that_are_no_ranges_do_no_harm() {
    const NONE: [f64; 8] = [0.0, -2e7, 1e9, 1e12, 1e18, 1e300, f64::NAN, f64::INFINITY];
    let ship = Ship::usual();
    let sound = ship.taken();
    for all in [true, false] {
        let arrivals = ship.changed(|number, mut raw| {
            let value = NONE.get(number.wrapping_sub(60) / 2).filter(|_| number % 2 == 0);
            let count = if all { raw.measurements.len() } else { 1 };
            for own in raw.measurements.iter_mut().take(count) {
                own.pseudorange = value.copied().or(own.pseudorange);
                own.carrier_phase = value.copied().or(own.carrier_phase);
                own.doppler = value.map_or(own.doppler, |value| *value as f32);
            }
            vec![raw]
        });
        let taken = Taken::of(&ship.intake, &arrivals);
        let lost = sound.ranges().len() - taken.ranges().len();
        assert!(lost <= NONE.len(), "{lost} {:?}", taken.refused);
        for (received, told) in taken.ranges() {
            assert!(told.time <= received.receipt);
            let codes = told.ranges.iter().filter_map(|range| range.code);
            codes.for_each(|code| assert!(code.value.is_finite() && code.variance > 0.0));
        }
        let last = taken.ranges().last().unwrap().1.ranges.len();
        assert_eq!(last, sound.ranges().last().unwrap().1.ranges.len());
    }
}
