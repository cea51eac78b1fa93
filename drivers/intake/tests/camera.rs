//! A camera's front end, from its sentences to what the navigator is told.

#![allow(clippy::unwrap_used, clippy::panic)] // helpers of tests are not seen as tests

use insd_base::{
    Arrival, CameraFrame, Input, Message, PortId, Source, Stamp, Time, UtcTime, VisualOdometry,
};
use insd_intake::config::{IntakeConfig, Kind, PortSpec, SensorConfig};
use insd_intake::event::{Happening, Refusal};
use insd_intake::port::Link;
use insd_intake::{Intake, Intaken};
use insd_wire::nmea::{Pinsd, PinsdStep, PinsdTracks, TrackedPoint};

/// Noon of a day in 2026, ns since 1970.
const NOON: i64 = 1_780_315_200_000_000_000;
/// What the clock of the front end is behind ours, s.
const BEHIND: f64 = 123.0;
/// From an image to its first sentence, s.
const LATENCY: f64 = 0.04;

struct Ship {
    intake: Intake,
    frames: Vec<CameraFrame>,
    steps: Vec<VisualOdometry>,
    stepped: usize,
}

impl Ship {
    fn new() -> Self {
        let sensor =
            SensorConfig { latency_s: LATENCY, ..SensorConfig::new("eyes", "port", Kind::Camera) };
        let ports = vec![PortSpec { name: "port".to_owned(), link: Link::Datagrams }];
        let config = IntakeConfig { ports, sensors: vec![sensor], ..IntakeConfig::default() };
        let (frames, steps) = (Vec::new(), Vec::new());
        Ship { intake: Intake::new(&config), frames, steps, stepped: 0 }
    }

    /// Bytes that come at an instant, s.
    fn hear(&mut self, at: f64, bytes: &[u8]) {
        let stamp = Stamp {
            monotonic: Time::from_seconds(at),
            system: UtcTime::from_nanos(NOON + (at * 1e9) as i64),
        };
        self.intake.handle(&Arrival {
            port: PortId(0),
            stamp,
            input: Input::Bytes(bytes.to_vec()),
        });
        while let Some(output) = self.intake.poll_output() {
            match output {
                Intaken::Measured(received) => {
                    assert_eq!(received.source, Source::Camera(0));
                    match received.message {
                        Message::Camera(frame) => self.frames.push((*frame).clone()),
                        Message::Odometry(step) => self.steps.push(step),
                        other => panic!("{other:?}"),
                    }
                }
                Intaken::Watched(_) => {}
                Intaken::Event(event) => {
                    let stepped = matches!(event.what, Happening::DeviceClockStepped { .. });
                    self.stepped += usize::from(stepped);
                }
                Intaken::Temperature(..) => {}
            }
        }
    }

    fn refused(&self, reason: Refusal) -> u64 {
        self.intake.status().sensors[0].refused.get(&reason).copied().unwrap_or(0)
    }
}

fn point(track: u32) -> TrackedPoint {
    TrackedPoint { track, at: [640.25 + f64::from(track), 360.5] }
}

/// The sentences of an image of the front end's time.
fn image(own: f64, points: u32) -> Vec<Vec<u8>> {
    let points: Vec<TrackedPoint> = (0..points).map(point).collect();
    let all = PinsdTracks::of_image(own, &points);
    all.into_iter().map(|told| Pinsd::Tracks(told).write().as_bytes().to_vec()).collect()
}

fn step(own: f64) -> Vec<u8> {
    let step = PinsdStep {
        time: Some(own),
        since: Some(own - 0.5),
        map: Some(3),
        turn: [Some(0.001), Some(-0.002), Some(0.0)],
        way: [Some(0.75), Some(0.0), Some(0.25)],
        turn_std: Some(3e-4),
        way_std: Some(0.02),
    };
    Pinsd::Step(step).write().as_bytes().to_vec()
}

/// A front end that tells 40 points ten times a second from `from` to `to`, s.
fn sail(ship: &mut Ship, from: i64, to: i64) {
    for tenth in 10 * from..10 * to {
        let at = tenth as f64 * 0.1;
        ship.hear(at, &image(at - BEHIND, 40).concat());
    }
}

#[test]
fn an_image_is_put_together_and_its_time_is_that_of_our_clock() {
    let mut ship = Ship::new();
    sail(&mut ship, 200, 230);
    assert!(ship.frames.len() > 280, "{}", ship.frames.len());
    let frame = ship.frames.last().unwrap();
    assert_eq!(frame.points.len(), 40);
    assert_eq!((frame.points[7].track, frame.points[7].at.x), (7, 647.25));
    assert!((frame.time.as_seconds() - (229.9 - LATENCY)).abs() < 1e-3, "{:?}", frame.time);
    assert_eq!(ship.intake.status().sensors[0].valid, Some(true));
}

#[test]
fn a_step_lies_between_two_times_of_our_clock() {
    let mut ship = Ship::new();
    for half in 400..440 {
        let at = f64::from(half) * 0.5;
        ship.hear(at, &step(at - BEHIND));
    }
    assert!(ship.steps.len() > 30, "{}", ship.steps.len());
    let last = ship.steps.last().unwrap();
    assert!((last.time.as_seconds() - (219.5 - LATENCY)).abs() < 1e-3);
    assert!(((last.time - last.since).as_seconds() - 0.5).abs() < 1e-4);
    assert!((last.rotation.scaled_axis().y + 0.002).abs() < 1e-6 && last.map == 3);
    assert!((last.translation.x, last.translation_std) == (0.75, 0.02));
}

#[test]
fn a_torn_sentence_costs_its_points_and_is_told() {
    let mut ship = Ship::new();
    sail(&mut ship, 200, 210);
    let before = ship.frames.len();
    for tenth in 2100..2200_i64 {
        let at = tenth as f64 * 0.1;
        let mut all = image(at - BEHIND, 40);
        all[3].truncate(20);
        all[5][30] ^= 1;
        ship.hear(at, &all.concat());
    }
    let own = &ship.frames[before..];
    assert!(own.len() >= 99, "{}", own.len());
    // one that is cut off takes the next along
    assert!(own.iter().all(|frame| (22..=28).contains(&frame.points.len())), "{own:?}");
    assert!(ship.refused(Refusal::Incomplete) >= 99);
}

#[test]
fn a_time_that_stands_still_is_counted_and_nothing_is_passed_on() {
    let mut ship = Ship::new();
    sail(&mut ship, 200, 210);
    let before = ship.frames.len();
    for tenth in 2100..2200_i64 {
        ship.hear(tenth as f64 * 0.1, &image(209.9 - BEHIND, 40).concat());
    }
    assert_eq!(ship.frames.len(), before);
    assert!(ship.refused(Refusal::Repeated) > 500);
    sail(&mut ship, 220, 221);
    assert_eq!(ship.frames.len(), before + 10);
}

#[test]
fn of_a_flood_no_more_than_thirty_images_a_second_are_passed_on() {
    let mut ship = Ship::new();
    sail(&mut ship, 200, 210);
    let before = ship.frames.len();
    for millisecond in 0..5000 {
        let at = 210.0 + f64::from(millisecond) * 1e-3;
        ship.hear(at, &image(at - BEHIND, 40).concat());
    }
    let passed = ship.frames.len() - before;
    assert!((140..=170).contains(&passed), "{passed}");
    assert!(ship.refused(Refusal::TimeDoubted) > 4000);
}

#[test]
fn a_front_end_that_begins_anew_is_heard_again_with_its_new_clock() {
    let mut ship = Ship::new();
    sail(&mut ship, 200, 210);
    let before = ship.frames.len();
    for tenth in 2100..2300_i64 {
        let at = tenth as f64 * 0.1;
        ship.hear(at, &image(at - 209.0, 40).concat());
    }
    assert!(ship.stepped >= 1);
    let own = &ship.frames[before..];
    assert!(own.len() > 120, "{}", own.len());
    let last = own.last().unwrap().time.as_seconds();
    assert!((last - (229.9 - LATENCY)).abs() < 1e-3, "{last}");
}

#[test]
fn noise_disturbs_nobody() {
    let mut ship = Ship::new();
    sail(&mut ship, 200, 210);
    let before = ship.frames.len();
    let noise: Vec<u8> =
        (0..200_000_u32).map(|i| (i.wrapping_mul(2_654_435_761) >> 24) as u8).collect();
    for (part, bytes) in noise.chunks(1000).enumerate() {
        ship.hear(210.0 + part as f64 * 0.01, bytes);
    }
    assert_eq!(ship.frames.len(), before);
    sail(&mut ship, 213, 214);
    assert_eq!(ship.frames.len(), before + 10);
}
