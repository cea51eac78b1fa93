use insd_base::UtcTime;
use insd_wire::gnss::rtcm::Frame;
use insd_wire::stream::{Cutter, Protocol};

use super::*;

/// Messages of a recorded base: where it is, and one epoch (its licence is beside it).
const RECORDED: &[u8] = include_bytes!("../../../wire/tests/data/rtcm3.bin");

fn received() -> GpsTime {
    UtcTime::from_civil((2023, 1, 3), (12, 0, 0), 0).unwrap().to_gps()
}

fn frames(bytes: &[u8]) -> Vec<Vec<u8>> {
    let (mut cutter, mut frames) = (Cutter::new(&[Protocol::Rtcm]), Vec::new());
    cutter.push(bytes);
    while let Some(cut) = cutter.cut() {
        frames.push(cut.bytes.to_vec());
    }
    frames
}

fn number(frame: &[u8]) -> u16 {
    Frame::open(frame).unwrap().number().unwrap()
}

#[test]
fn a_recorded_base_is_one_epoch_with_its_place() {
    let mut base = Base::new(BaseSettings::default());
    let when = (Time::from_seconds(5.0), received());
    let mut told = Vec::new();
    for frame in frames(RECORDED) {
        told.extend(base.take(&frame, when, None));
    }
    let [BaseTold::News(BaseNews::Placed { .. }), BaseTold::Epoch(epoch)] = &told[..] else {
        panic!("{told:?}")
    };
    let (offered, news) = base.offer(epoch.clone(), Time::from_seconds(4.0), when.0);
    assert_eq!((news, offered.epoch.signals.len(), offered.is_moving), (None, 51, false));
    assert!(offered.position.is_some() && offered.station == base.status.station);
    assert_eq!((base.status.epochs, base.status.stations, base.status.signals), (1, 1, 51));

    // the same epoch again is no other
    let again: Vec<_> =
        frames(RECORDED).iter().flat_map(|frame| base.take(frame, when, None)).collect();
    assert!(again.contains(&BaseTold::Refused(Refusal::Repeated)));
    let is_same = |told: &BaseTold| matches!(told, BaseTold::Epoch(own) if own.tag == epoch.tag);
    assert!(!again.iter().any(is_same));
}

#[test]
fn a_base_without_coordinates_is_told_once() {
    let mut base = Base::new(BaseSettings::default());
    let now = Time::from_seconds(5.0);
    let measured = frames(RECORDED).into_iter().filter(|frame| number(frame) != 1005);
    let told: Vec<_> =
        measured.flat_map(|frame| base.take(&frame, (now, received()), None)).collect();
    let [BaseTold::Epoch(epoch)] = &told[..] else { panic!("{told:?}") };
    let offers = (0..200).map(|_| base.offer(epoch.clone(), now, now));
    let news = offers.filter_map(|(offered, news)| {
        assert_eq!(offered.position, None);
        news
    });
    assert_eq!(news.collect::<Vec<_>>(), [BaseNews::Unplaced]);
}

#[test]
fn damaged_frames_are_refused_and_nothing_panics() {
    let mut base = Base::new(BaseSettings::default());
    let when = (Time::from_seconds(5.0), received());
    for frame in frames(RECORDED) {
        let message = Frame::open(&frame).unwrap().message.to_vec();
        for bit in 0..message.len() * 8 {
            let mut wrong = message.clone();
            wrong[bit / 8] ^= 1 << (bit % 8);
            base.take(&Frame { message: &wrong }.write(), when, None);
            base.take(&Frame { message: &message[..bit / 8] }.write(), when, None);
        }
    }
}
