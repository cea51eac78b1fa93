//! Four receivers on one clock, from their bytes to what they tell as a compass.

use insd_base::satellites::CompassReading;
use insd_base::units::{DEG, wrap_pi};
use insd_base::{Arrival, Message, Source, Truth};
use insd_engine::{Engine, EngineConfig, Output};
use insd_intake::config::{IntakeConfig, PortSpec, SensorConfig};
use insd_intake::{Intake, Intaken};
use insd_simulator::{raw_gnss, simulate};
use insd_tests::feed::{Calendar, Encoding, FeedConfig, Reception, arrivals, feed};
use insd_tests::raw_feed;

const DURATION: f64 = 120.0;
const GNSS: usize = 1;
const SQUARE: [[f64; 3]; 4] =
    [[-5.95, -0.85, -14.0], [-5.95, -0.75, -14.0], [-6.05, -0.75, -14.0], [-6.05, -0.85, -14.0]];

/// A ship whose four receivers are an array, and what reaches her computer.
struct Ship {
    intake: IntakeConfig,
    arrivals: Vec<Arrival>,
    engine: EngineConfig,
    truth: Vec<Truth>,
}

impl Ship {
    /// The last of the receivers falls silent at a time, s.
    fn new(silent: f64) -> Self {
        let scenario = insd_tests::variant(29, &[]).with_duration(DURATION);
        let (voyage, raw) = (simulate(&scenario, 5), raw_gnss(&scenario, 5).unwrap());
        let feeds = FeedConfig::new(&voyage, &[Encoding::Sbg, Encoding::Ubx]);
        let utc = Calendar::new(&voyage.header.start_utc).unwrap().start;
        let mut sendings = feed(&voyage, &feeds);
        for antenna in 0..SQUARE.len() {
            let own = raw_feed::ubx_of(&raw, antenna, utc.to_gps(), GNSS + antenna);
            let is_heard = |at: f64| antenna + 1 < SQUARE.len() || at < silent;
            sendings.extend(own.into_iter().filter(|own| is_heard(own.at.as_seconds())));
        }
        sendings.sort_by_key(|sending| sending.at);
        let intake = with_array(feeds.intake(&voyage));
        Ship {
            intake,
            arrivals: arrivals(&sendings, &Reception::new(utc, 5)),
            engine: EngineConfig::for_voyage(&voyage.header, 1.0),
            truth: voyage.truth,
        }
    }

    /// What the antennas told, and how far off the heading of the last solution is, rad, with its claim.
    fn sailed(&self) -> (Vec<CompassReading>, f64, f64) {
        assert_eq!(self.intake.faults(), []);
        let (mut intake, mut engine) =
            (Intake::new(&self.intake), Engine::new(self.engine.clone()));
        let (mut told, mut last) = (Vec::new(), None);
        for arrival in &self.arrivals {
            intake.handle(arrival);
            while let Some(taken) = intake.poll_output() {
                let Intaken::Measured(received) = taken else { continue };
                if let Message::Compass(reading) = &received.message {
                    assert_eq!(received.source, Source::Gnss(0));
                    told.push(reading.as_ref().clone());
                }
                engine.handle(&received);
                while let Some(output) = engine.poll_output() {
                    if let Output::Solution(solution) = output {
                        last = Some(solution);
                    }
                }
            }
        }
        let last = last.unwrap();
        let nearest = |truth: &&Truth| (truth.time - last.time).as_nanos().abs();
        let truth = self.truth.iter().min_by_key(nearest).unwrap();
        let off = wrap_pi(last.attitude.heading - truth.attitude.unwrap().heading);
        (told, off, last.sigma.heading)
    }
}

/// Three more receivers like the first, each on a port of its own.
fn with_array(mut intake: IntakeConfig) -> IntakeConfig {
    let (port, first) = (intake.ports[GNSS].clone(), intake.sensors[GNSS].clone());
    intake.ports.truncate(GNSS);
    intake.sensors.truncate(GNSS);
    for (antenna, lever) in SQUARE.iter().enumerate() {
        let name = format!("antenna {}", antenna + 1);
        intake.ports.push(PortSpec { name: name.clone(), ..port.clone() });
        intake.sensors.push(SensorConfig {
            name: name.clone(),
            port: name,
            lever_m: Some(*lever),
            array: true,
            clock: Some("rack".to_owned()),
            priority: antenna as u8 + 1,
            ..first.clone()
        });
    }
    intake
}

#[test]
fn four_receivers_on_four_ports_tell_how_the_hull_stands() {
    let (told, off, sigma) = Ship::new(f64::INFINITY).sailed();
    let found = told.iter().filter(|reading| reading.told.is_ok()).count();
    assert!(told.len() > 100 && found > told.len() * 9 / 10, "{found} of {}", told.len());
    assert!(told.iter().all(|reading| reading.faults.is_empty()));
    assert!(off.abs() < 3.0 * sigma && sigma < 2.5 * DEG, "{} of {}", off / DEG, sigma / DEG);
}

#[test]
fn three_of_four_go_on_when_one_falls_silent() {
    let (told, off, sigma) = Ship::new(60.0).sailed();
    let begun = told[0].time;
    let late = told.iter().filter(|reading| (reading.time - begun).as_seconds() > 70.0);
    let antennas = |reading: &&CompassReading| {
        let told = reading.told.as_ref().ok();
        told.map_or(0, |own| own.signals.iter().map(|one| one.phases.len()).max().unwrap_or(0))
    };
    let heard: Vec<usize> = late.map(|reading| antennas(&reading)).collect();
    let three = heard.iter().filter(|count| **count == 3).count();
    assert!(heard.len() > 40 && three > heard.len() * 9 / 10, "{heard:?}");
    assert!(off.abs() < 3.0 * sigma, "{} of {}", off / DEG, sigma / DEG);
}
