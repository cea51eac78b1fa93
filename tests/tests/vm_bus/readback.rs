//! What another decoder makes of the frames of a bus: the crate `kinavis-nmea2000`. Groups that it does not
//! know it still puts together, and their fields are read here by their place.

use kinavis_kernel::{Instant, TrueCourse, Utc};
use kinavis_nmea2000::{Assembler, CanId, Frame, Message, Payload, Transport};

use super::tap::Heard;

/// A message as the other decoder has it: degrees, metres, m/s.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Read {
    /// When its last frame was heard, s.
    pub(crate) at: f64,
    pub(crate) pgn: u32,
    /// The number of the epoch, of groups that have one.
    pub(crate) sid: Option<u8>,
    pub(crate) what: What,
}

#[derive(Clone, Copy, Debug)]
pub(crate) enum What {
    /// True heading.
    Heading(f64),
    /// Latitude and longitude.
    Position([f64; 2]),
    /// True course and speed.
    Course([f64; 2]),
    /// UTC, s since 1970; latitude, longitude, height.
    Fix(f64, [f64; 3]),
    /// Yaw, pitch, roll.
    Attitude([f64; 3]),
    /// UTC, s since 1970.
    Clock(f64),
    /// Nothing of it is known, or it is not looked at.
    Nothing,
}

/// Reads all messages of a sender.
pub(crate) fn read(frames: &[Heard], source: u8) -> Vec<Read> {
    let mut assembler: Assembler = Assembler::new();
    let mut all = Vec::new();
    for heard in frames.iter().filter(|frame| frame.source() == source) {
        let frame = Frame::new(CanId::new(heard.id).unwrap(), heard.data()).unwrap();
        let transport = match heard.pgn() {
            126_996 | 126_998 | 129_029 | 129_542 | 130_578 => Transport::FastPacket,
            _ => Transport::SingleFrame,
        };
        let now = Instant::<Utc>::from_unix_nanos((heard.at * 1e9) as i64);
        let payload = assembler.push_as(&frame, transport, now);
        if let Some(payload) = payload.expect("every frame fits") {
            let (sid, what) = told(&payload);
            all.push(Read { at: heard.at, pgn: heard.pgn(), sid, what });
        }
    }
    all
}

fn told(payload: &Payload) -> (Option<u8>, What) {
    match Message::decode(payload).expect("values in range") {
        Message::VesselHeading(own) => {
            let heading = own.heading.and_then(|own| own.as_true());
            (own.sid, heading.map_or(What::Nothing, |own| What::Heading(own.degrees())))
        }
        Message::PositionRapidUpdate(own) => {
            let place = own.position.map(|at| [at.latitude().degrees(), at.longitude().degrees()]);
            (None, place.map_or(What::Nothing, What::Position))
        }
        Message::CourseAndSpeed(own) => {
            let course = own.course.and_then(|own| own.as_true()).map(TrueCourse::degrees);
            let both = course.zip(own.speed).map(|(course, own)| [course, own.metres_per_second()]);
            (own.sid, both.map_or(What::Nothing, What::Course))
        }
        Message::GnssPosition(own) => {
            let fix = || {
                let (time, at, height) = (own.taken_at?, own.position?, own.altitude?);
                let place = [at.latitude().degrees(), at.longitude().degrees()];
                let utc = time.seconds() as f64 + f64::from(time.subsec_nanos()) * 1e-9;
                Some(What::Fix(utc, [place[0], place[1], height.value().metres()]))
            };
            (own.sid, fix().unwrap_or(What::Nothing))
        }
        Message::Unsupported { pgn } => by_place(pgn.number(), payload),
        other => panic!("{other:?}"),
    }
}

/// Groups with their fields' places and steps by canboat's list.
fn by_place(pgn: u32, payload: &Payload) -> (Option<u8>, What) {
    let sid = payload.u8(0).filter(|sid| *sid <= 252);
    match pgn {
        127_257 => {
            let angle = |place| payload.signed(place, 2).filter(|angle| *angle != 0x7FFF);
            let all =
                [1, 3, 5].map(|place| angle(place).map(|own| (own as f64 * 1e-4).to_degrees()));
            let what = match all {
                [Some(yaw), Some(pitch), Some(roll)] => What::Attitude([yaw, pitch, roll]),
                _ => What::Nothing,
            };
            (sid, what)
        }
        126_992 => {
            let days = payload.unsigned(2, 2).filter(|days| *days != 0xFFFF);
            let ticks = payload.unsigned(4, 4).filter(|ticks| *ticks != 0xFFFF_FFFF);
            let utc = days.zip(ticks).map(|(days, own)| days as f64 * 86400.0 + own as f64 * 1e-4);
            (sid, utc.map_or(What::Nothing, What::Clock))
        }
        127_251 | 127_252 | 127_258 | 128_259 | 129_542 => (sid, What::Nothing),
        _ => (None, What::Nothing),
    }
}
