//! Frames that are sound and say anything at all.

use insd_base::{Arrival, Input, PortId, Span, Time, Voyage};
use insd_tests::feed::{Encoding, FeedConfig, Reception, noise};
use insd_wire::gnss::{sbf, ubx};
use insd_wire::imu::kvh::{KvhMessage, KvhRest};
use insd_wire::imu::mip::Packet;
use insd_wire::imu::sbg::ImuShort;
use insd_wire::imu::stdbin::{Navigation, Telegram};
use insd_wire::imu::xbus::{MtData2, Precision};
use insd_wire::nmea::checksum;

use super::{moored, taken};

/// Numbers of any size that look random.
struct Dice {
    bytes: std::vec::IntoIter<u8>,
}

impl Dice {
    fn new(seed: u64) -> Self {
        Dice { bytes: noise(seed, 4096).into_iter() }
    }

    fn byte(&mut self) -> u8 {
        self.bytes.next().unwrap_or(0)
    }

    fn some(&mut self, count: usize) -> Vec<u8> {
        (0..count).map(|_| self.byte()).collect()
    }

    /// Of all lengths alike.
    fn word(&mut self) -> u64 {
        let bits = self.byte() % 65;
        let word = self.some(8).iter().fold(0, |word, byte| word << 8 | u64::from(*byte));
        word.checked_shr(64 - u32::from(bits)).unwrap_or(0)
    }

    fn below(&mut self, limit: u64) -> u64 {
        self.word() % limit
    }

    fn real(&mut self) -> f64 {
        f64::from_bits(self.word() << (self.byte() % 64))
    }

    fn reals(&mut self) -> [f64; 3] {
        [self.real(), self.real(), self.real()]
    }
}

fn sentence(dice: &mut Dice) -> Vec<u8> {
    let clock = format!(
        "{:02}{:02}{:02}.{}",
        dice.below(24),
        dice.below(60),
        dice.below(61),
        dice.below(100)
    );
    let (day, month, year) = (dice.below(32), dice.below(13), dice.below(10_000));
    let place = format!("{:02}00.0,N,{:03}00.0,E", dice.below(91), dice.below(181));
    let body = match dice.below(4) {
        0 => format!("GNZDA,{clock},{day:02},{month:02},{year:04},,"),
        1 => format!(
            "GNGGA,{clock},{place},{},12,0.9,{}.0,M,36.0,M,,",
            dice.below(9),
            dice.below(99_999)
        ),
        2 => format!(
            "GNRMC,{clock},A,{place},{}.0,9.0,{day:02}{month:02}{:02},,,A,V",
            dice.below(9999),
            year % 100
        ),
        _ => format!("GNGST,{clock},,,,,{}.0,1.0,1.0", dice.below(999_999)),
    };
    format!("${body}*{:02X}\r\n", checksum(body.as_bytes())).into_bytes()
}

/// A frame that is sound.
fn frame(encoding: Encoding, dice: &mut Dice) -> Vec<u8> {
    match encoding {
        Encoding::Sbg => {
            let (time_stamp, status) = (dice.word() as u32, dice.word() as u16);
            let (accel, gyro, temperature) = (dice.reals(), dice.reals(), dice.real());
            ImuShort { time_stamp, status, accel, gyro, temperature }.write()
        }
        Encoding::Mip => Packet {
            reference_nanos: Some(dice.word()),
            delta_theta: Some(dice.reals()),
            delta_velocity: Some(dice.reals()),
            ..Packet::default()
        }
        .write(),
        Encoding::Xbus(precision) => MtData2 {
            counter: Some(dice.word() as u16),
            fine_time: Some(dice.word() as u32),
            rate_of_turn: Some(dice.reals()),
            acceleration: Some(dice.reals()),
            ..MtData2::default()
        }
        .write(precision),
        Encoding::Stdbin => telegram(dice).write(),
        Encoding::Kvh { .. } => {
            let (rotation, linear) = (dice.reals(), dice.reals());
            let rest = KvhRest::B { time: dice.word() as u32, temperature: 0 };
            let [rotation, linear] = [rotation, linear].map(|own| own.map(|own| own as f32));
            let (status, sequence) = (dice.byte(), dice.byte());
            KvhMessage { rotation, linear, status, sequence, rest }.write()
        }
        Encoding::Ubx => {
            let id = if dice.below(2) == 0 { 0x07 } else { 0x36 };
            let mut payload = dice.some(if id == 0x07 { 92 } else { 64 });
            // half of them with a date, a time and a fix that count
            if id == 0x07 && dice.below(2) == 0 {
                (payload[6], payload[7]) = (1 + payload[6] % 12, 1 + payload[7] % 28);
                (payload[8], payload[9], payload[10]) =
                    (payload[8] % 24, payload[9] % 60, payload[10] % 61);
                (payload[11], payload[20], payload[21]) = (7, 3, 1);
            }
            ubx::Frame { class: 1, id, payload: &payload }.write()
        }
        Encoding::Sbf => {
            let mut block = sbf_block(dice);
            block[8..14].copy_from_slice(&dice.some(6));
            sealed(block)
        }
        _ => sentence(dice),
    }
}

fn telegram(dice: &mut Dice) -> Telegram {
    let date = (dice.word() as u16, dice.byte(), dice.byte());
    Telegram {
        version: 3,
        validity: dice.word() as u32,
        counter: dice.word() as u32,
        navigation: Navigation {
            date: Some(date),
            user_status: Some([dice.word() as u32]),
            raw_acceleration: Some(dice.reals()),
            raw_rotation: Some(dice.reals()),
            ..Navigation::default()
        },
        ..Telegram::default()
    }
}

fn sbf_block(dice: &mut Dice) -> Vec<u8> {
    let state = insd_wire::gnss::GnssEpoch {
        time: insd_base::GpsTime::from_week(2000, 0),
        leap_seconds: 18,
        time_std: 1e-8,
        position: insd_base::Geodetic { latitude: 0.5, longitude: 1.0, height: dice.real() },
        position_std: dice.reals(),
        undulation: 0.0,
        velocity: dice.reals(),
        velocity_std: dice.reals(),
        satellites: 9,
        pdop: 1.0,
        hdop: 1.0,
        quality: insd_base::FixQuality::Autonomous,
    };
    sbf::PvtGeodetic::of(&state).write()
}

/// The block with its sum, CRC-CCITT from zero over all that follows the sum, put right.
fn sealed(mut block: Vec<u8>) -> Vec<u8> {
    let sum = block[4..].iter().fold(0_u16, |sum, byte| {
        (0..8).fold(sum ^ u16::from(*byte) << 8, |sum, _| {
            if sum & 0x8000 == 0 { sum << 1 } else { sum << 1 ^ 0x1021 }
        })
    });
    block[2..4].copy_from_slice(&sum.to_le_bytes());
    block
}

/// Two thousand frames of each sensor, some at once and some after up to two seconds.
fn wild(voyage: &Voyage, encodings: &[Encoding], seed: u64) -> (FeedConfig, Vec<Arrival>) {
    let config = FeedConfig::new(voyage, encodings);
    let reception = Reception::new(config.sensors[0].calendar.start, seed);
    let mut now = Time::START;
    let mut all = Vec::new();
    for index in 0..2000_u64 {
        for (port, encoding) in encodings.iter().enumerate() {
            let mut dice = Dice::new(seed << 30 | index << 4 | port as u64);
            now = now + Span::from_nanos(dice.below(2_000_000_000) as i64);
            let input = Input::Bytes(frame(*encoding, &mut dice));
            all.push(Arrival { stamp: reception.stamp(now), port: PortId(port as u16), input });
        }
    }
    (config, all)
}

#[test]
fn sound_frames_that_say_anything_do_not_stop_the_intake() {
    let voyage = moored();
    let ships = [
        [Encoding::Sbg, Encoding::Ubx],
        [Encoding::Mip, Encoding::Sbf],
        [Encoding::Xbus(Precision::Float64), Encoding::NmeaGnss],
        [Encoding::Stdbin, Encoding::Ubx],
        [Encoding::Kvh { stamped: true }, Encoding::NmeaGnss],
    ];
    for (seed, encodings) in (1..).zip(ships) {
        let (config, arrivals) = wild(&voyage, &encodings, seed);
        let all = taken(&config.intake(&voyage), &arrivals);
        let count =
            |is: &dyn Fn(&insd_intake::Intaken) -> bool| all.iter().filter(|own| is(own)).count();
        let told = count(&|own| matches!(own, insd_intake::Intaken::Measured(_)));
        println!("{encodings:?}: {told} measurements, {} events", all.len() - told);
        assert!(all.len() > 100, "{encodings:?}");
    }
}
