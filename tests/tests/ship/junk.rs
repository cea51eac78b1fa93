//! Whatever the sensors send, the engine neither panics nor says something that is not a number.

use std::sync::Arc;

use insd_base::{
    Body, FixQuality, Geodetic, Message, Ned, Received, Solution, Source, Span, Time, Voyage,
};
use insd_engine::EngineConfig;
use insd_simulator::simulate;
use insd_tests::sailing::sail_messages;
use insd_tests::variant;
use proptest::prelude::*;
use proptest::sample::Index;

/// One thing that goes wrong on a line.
#[derive(Clone, Debug)]
enum Mischief {
    /// One field of a message holds this number.
    Field(Index, u8, f64),
    /// A message comes twice.
    Twice(Index),
    /// Two messages change places.
    Swap(Index, Index),
    /// A message is lost, and so many after it.
    Loss(Index, u8),
    /// The time of validity is off by this, s.
    Stamp(Index, f64),
    /// A message says that it comes from another sensor.
    Source(Index, u8),
}

fn number() -> impl Strategy<Value = f64> {
    prop_oneof![
        Just(f64::NAN),
        Just(f64::INFINITY),
        Just(f64::NEG_INFINITY),
        Just(f64::MAX),
        Just(f64::MIN_POSITIVE),
        Just(-0.0),
        -1e12..1e12,
        -10.0..10.0,
        any::<f64>(),
    ]
}

fn stamp() -> impl Strategy<Value = f64> {
    prop_oneof![-3.0..3.0, Just(-1e9), Just(1e9), Just(1e300), -100.0..100.0]
}

fn mischief() -> impl Strategy<Value = Mischief> {
    let at = any::<Index>;
    prop_oneof![
        4 => (at(), any::<u8>(), number()).prop_map(|(i, f, x)| Mischief::Field(i, f, x)),
        1 => at().prop_map(Mischief::Twice),
        1 => (at(), at()).prop_map(|(a, b)| Mischief::Swap(a, b)),
        1 => (at(), any::<u8>()).prop_map(|(i, n)| Mischief::Loss(i, n)),
        1 => (at(), stamp()).prop_map(|(i, s)| Mischief::Stamp(i, s)),
        1 => (at(), any::<u8>()).prop_map(|(i, s)| Mischief::Source(i, s)),
    ]
}

impl Mischief {
    fn play(&self, messages: &mut Vec<Received>) {
        if messages.is_empty() {
            return;
        }
        let length = messages.len();
        match self {
            Mischief::Field(at, field, value) => {
                spoil(at.get_mut(messages), *field, *value);
            }
            Mischief::Twice(at) => messages.insert(at.index(length), at.get(messages).clone()),
            Mischief::Swap(a, b) => messages.swap(a.index(length), b.index(length)),
            Mischief::Loss(at, count) => {
                let from = at.index(length);
                messages.drain(from..length.min(from + usize::from(*count)));
            }
            Mischief::Stamp(at, off) => restamp(at.get_mut(messages), *off),
            Mischief::Source(at, index) => at.get_mut(messages).source = Source::Gnss(*index),
        }
    }
}

fn restamp(received: &mut Received, off: f64) {
    let span = Span::from_seconds(off);
    match &mut received.message {
        Message::Imu(m) => m.time = m.time + span,
        Message::Gnss(m) => m.time = m.time + span,
        Message::Log(m) => m.time = m.time + span,
        Message::Reference(m) => m.time = m.time + span,
        Message::Rtk(m) => m.time = m.time + span,
        Message::Ranging(m) => m.time = m.time + span,
        Message::Odometry(m) => m.time = m.time + span,
        Message::Camera(m) => {
            let frame = Arc::make_mut(m);
            frame.time = frame.time + span;
        }
        Message::Base(m) => {
            let base = Arc::make_mut(m);
            base.time = base.time + span;
        }
        Message::Compass(m) => {
            let reading = Arc::make_mut(m);
            reading.time = reading.time + span;
        }
        Message::Ranges(m) => {
            let ranges = Arc::make_mut(m);
            ranges.time = ranges.time + span;
        }
    }
}

fn spoil(received: &mut Received, field: u8, value: f64) {
    let axis = usize::from(field) % 3;
    match &mut received.message {
        Message::Imu(m) if field & 4 == 0 => m.delta_theta.0[axis] = value,
        Message::Imu(m) => m.delta_velocity = Body::new(value, value, value),
        Message::Gnss(m) => match field % 6 {
            0 => {
                m.position = Some(Geodetic { latitude: value, longitude: value, height: 0.0 });
            }
            1 => m.velocity = Some(Ned::new(value, 0.0, 0.0)),
            2 => m.position_std = Some(Ned::new(value, value, value)),
            3 => m.velocity_std = Some(Ned::new(value, 1.0, value)),
            4 => m.hdop = Some(value),
            _ => m.quality = FixQuality::from_gga(value as u8).unwrap_or_default(),
        },
        Message::Log(m) => match field % 4 {
            0 => m.u = Some(value),
            1 => m.v = Some(value),
            2 => m.w = None,
            _ => m.std = Some(value),
        },
        Message::Reference(m) => match field % 4 {
            0 => m.v_north = Some(value),
            1 => m.heading = Some(value),
            2 => m.heading_std = Some(value),
            _ => m.position = Some(Geodetic { latitude: value, longitude: 0.0, height: value }),
        },
        Message::Ranges(m) => Arc::make_mut(m).ranges.clear(),
        Message::Base(m) => Arc::make_mut(m).epoch.signals.clear(),
        Message::Compass(m) => {
            let told = Arc::make_mut(m).told.as_mut().ok();
            let phases = told.into_iter().flat_map(|told| &mut told.signals);
            phases.flat_map(|own| &mut own.phases).for_each(|phase| phase.phase = value);
        }
        Message::Rtk(m) => {
            m.place.iter_mut().for_each(|place| place.antenna[axis] = value);
        }
        Message::Ranging(m) if field & 4 == 0 => m.distance = value,
        Message::Ranging(m) => m.std = value,
        Message::Odometry(m) => m.translation[axis] = value,
        Message::Camera(m) => {
            Arc::make_mut(m).points.iter_mut().for_each(|point| point.at[axis % 2] = value);
        }
    }
}

/// A minute and a half of a ship with every sensor, at 10 Hz to be quick.
fn voyage() -> Voyage {
    let every_sensor = [
        ("mode = \"moored\"", "mode = \"underway\""),
        ("duration_s = 600.0", "duration_s = 15.0"),
        ("[imu]", "[imu]\nrate_hz = 10.0"),
    ];
    simulate(&variant(1, &every_sensor).with_duration(90.0), 1)
}

fn is_finite(solution: &Solution) -> bool {
    let sigma = &solution.sigma;
    let place = &solution.position;
    let attitude = &solution.attitude;
    let vectors = [&solution.velocity.0, &solution.rate.0, &sigma.position.0, &sigma.velocity.0];
    let scalars = [place.latitude, place.longitude, place.height, attitude.roll, attitude.pitch];
    let more = [attitude.heading, sigma.roll, sigma.pitch, sigma.heading];
    vectors.into_iter().flat_map(|v| v.iter()).chain(&scalars).chain(&more).all(|x| x.is_finite())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn junk_makes_no_panic_and_no_solution_that_is_not_a_number(
        tricks in prop::collection::vec(mischief(), 1..60)
    ) {
        let voyage = voyage();
        let mut messages = voyage.received();
        for trick in &tricks {
            trick.play(&mut messages);
        }
        let log = sail_messages(&EngineConfig::for_voyage(&voyage.header, 10.0), &messages, 1);
        for solution in &log.solutions {
            prop_assert!(is_finite(solution), "{solution:?}");
            let sigma = &solution.sigma;
            prop_assert!(sigma.position.0.iter().all(|s| *s >= 0.0));
        }
    }
}

#[test]
fn a_message_from_the_far_future_does_not_stop_the_clock() {
    let voyage = voyage();
    let mut messages = voyage.received();
    for share in [3, 5] {
        let at = messages.len() / share;
        let mut astray = messages[at].clone();
        restamp(&mut astray, 1e9);
        messages.insert(at, astray);
    }
    let log = sail_messages(&EngineConfig::for_voyage(&voyage.header, 10.0), &messages, 1);
    let last = log.solutions.last().map(|solution| solution.time);
    assert!(
        last.is_some_and(|time| time > Time::from_seconds(85.0) && time < Time::from_seconds(91.0)),
        "{last:?}"
    );
}
