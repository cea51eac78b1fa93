//! Prints sentences of our writers, of the kinds that public logs lack, with values spread over their
//! ranges and some unknown. For the comparison with other decoders in `tests/conformance/nmea.py`.

use std::io::{BufWriter, Write};

use insd_base::UtcTime;
use insd_wire::nmea::{
    Dtm, Gns, Hdg, Hdm, HeadingMode, NavStatus, NortekBottomTrack, NortekSensors, Position,
    PositionMode, Psxn, PsxnQuality, Rmc, Sentence, Talker, Ths, TimeOfDay, Vbw, VbwStern,
    VbwVelocity, Vdr, Vhw, Vlw,
};

/// Sentences of each kind.
const EACH: u32 = 500;

/// Numbers that look like chance and are the same each time (a linear congruential generator).
struct Spread(u64);

impl Spread {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.next()
    }

    /// Unknown one time in ten.
    fn perhaps(&mut self, low: f64, high: f64) -> Option<f64> {
        let value = self.between(low, high);
        (self.next() > 0.1).then_some(value)
    }

    fn turn(&mut self) -> Option<f64> {
        self.perhaps(0.0, std::f64::consts::TAU)
    }

    fn of<T: Copy>(&mut self, choices: &[T]) -> Option<T> {
        choices.get((self.next() * choices.len() as f64) as usize).copied()
    }

    fn yes(&mut self) -> bool {
        self.next() > 0.5
    }

    fn time(&mut self) -> Option<TimeOfDay> {
        TimeOfDay::from_nanos(self.between(0.0, 86_400.0) as i64 * 1_000_000_000)
    }

    fn position(&mut self) -> Option<Position> {
        let latitude = self.perhaps(-1.5, 1.5)?;
        Some(Position { latitude, longitude: self.between(-3.1, 3.1) })
    }
}

fn main() -> std::io::Result<()> {
    let mut out = BufWriter::new(std::io::stdout().lock());
    let mut spread = Spread(1);
    for _ in 0..EACH {
        let all = approved(&mut spread).into_iter().chain(own(&mut spread));
        for sentence in all {
            out.write_all(sentence.write(Talker::IN).as_bytes())?;
        }
    }
    Ok(())
}

fn approved(s: &mut Spread) -> Vec<Sentence> {
    let modes = [PositionMode::Autonomous, PositionMode::RtkFixed, PositionMode::NotValid];
    let mode = s.of(&modes);
    let mut gns = Gns { time: s.time(), position: s.position(), ..Gns::default() };
    gns.satellites = Some(s.between(0.0, 99.0) as u8);
    gns.hdop = s.perhaps(0.0, 50.0);
    gns.altitude = s.perhaps(-99.0, 99.0);
    gns.geoid_separation = s.perhaps(-99.0, 80.0);
    gns.nav_status = s.of(&[NavStatus::Safe, NavStatus::Unsafe]);
    gns.modes[..2].copy_from_slice(&[mode, s.of(&modes)]);
    vec![
        Sentence::Gns(gns),
        Sentence::Hdm(Hdm { heading: s.turn() }),
        Sentence::Hdg(Hdg {
            reading: s.turn(),
            deviation: s.perhaps(-0.2, 0.2),
            variation: s.perhaps(-0.5, 0.5),
        }),
        Sentence::Ths(Ths {
            heading: s.turn(),
            mode: s
                .of(&[HeadingMode::Autonomous, HeadingMode::Estimated])
                .unwrap_or(HeadingMode::NotValid),
        }),
        Sentence::Rmc(Rmc {
            time: s.time(),
            valid: s.yes(),
            position: s.position(),
            speed: s.perhaps(0.0, 30.0),
            course: s.turn(),
            date: None,
            variation: s.perhaps(-0.5, 0.5),
            mode,
            nav_status: Some(NavStatus::Caution),
        }),
        Sentence::Dtm(Dtm {
            datum: Some(insd_wire::nmea::Datum::WGS84),
            subdivision: None,
            latitude_offset: s.perhaps(-1e-4, 1e-4),
            longitude_offset: s.perhaps(-1e-4, 1e-4),
            altitude_offset: s.perhaps(-99.0, 99.0),
            reference: Some(insd_wire::nmea::Datum::WGS84),
        }),
        Sentence::Vbw(vbw(s)),
        Sentence::Vdr(Vdr { set: s.turn(), set_magnetic: s.turn(), drift: s.perhaps(0.0, 5.0) }),
        Sentence::Vhw(Vhw {
            heading: s.turn(),
            heading_magnetic: s.turn(),
            speed: s.perhaps(-5.0, 20.0),
        }),
        Sentence::Vlw(Vlw {
            water: s.perhaps(0.0, 1e9),
            water_trip: s.perhaps(0.0, 1e6),
            ground: s.perhaps(0.0, 1e9),
            ground_trip: s.perhaps(0.0, 1e6),
        }),
    ]
}

fn vbw(s: &mut Spread) -> Vbw {
    let mut velocity = || VbwVelocity {
        longitudinal: s.perhaps(-10.0, 20.0),
        transverse: s.perhaps(-3.0, 3.0),
        valid: s.yes(),
    };
    let (water, ground) = (velocity(), velocity());
    let mut stern = || VbwStern { transverse: s.perhaps(-3.0, 3.0), valid: s.yes() };
    Vbw { water, ground, stern_water: stern(), stern_ground: stern(), without_stern: false }
}

fn own(s: &mut Spread) -> Vec<Sentence> {
    let mut quality = || s.of(&[PsxnQuality::Normal, PsxnQuality::Reduced, PsxnQuality::Invalid]);
    let (horizontal, height, heading, attitude) = (quality(), quality(), quality(), quality());
    let track = NortekBottomTrack {
        tagged: false,
        time: Some(UtcTime::from_nanos(s.between(1e9, 2e9) as i64 * 1_000_000_000)),
        trigger_to_echo: s.perhaps(0.0, 0.2),
        echo_to_output: s.perhaps(-0.1, 0.2),
        velocity: [s.perhaps(-9.0, 9.0), s.perhaps(-9.0, 9.0), s.perhaps(-1.0, 1.0)],
        figure_of_merit: s.perhaps(0.0, 9.0),
        distances: [s.perhaps(1.0, 200.0), s.perhaps(1.0, 200.0), s.perhaps(1.0, 200.0), None],
        sensors: None,
    };
    let sensors = NortekSensors {
        voltage: s.perhaps(10.0, 48.0),
        sound_speed: s.perhaps(1400.0, 1600.0),
        pressure: s.perhaps(0.0, 1e6),
        temperature: s.perhaps(-2.0, 40.0),
        status: Some((s.next() * 1e6) as u32),
    };
    vec![
        Sentence::Psxn(Psxn::Quality { horizontal, height, heading, attitude }),
        Sentence::Psxn(Psxn::Motion {
            roll: s.perhaps(-1.0, 1.0),
            pitch: s.perhaps(-1.0, 1.0),
            heading: s.turn(),
            heave: s.perhaps(-9.0, 9.0),
        }),
        Sentence::NortekBottomTrack(track),
        Sentence::NortekBottomTrack(NortekBottomTrack { sensors: Some(sensors), ..track }),
    ]
}
