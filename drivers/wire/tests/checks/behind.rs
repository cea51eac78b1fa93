//! What lies behind a reader: readings, parts of epochs, pulses, and the writer.

use std::f64::consts::FRAC_PI_2;
use std::hint::black_box;

use insd_base::satellites::SatelliteEpoch;
use insd_base::{GpsTime, LogReference};
use insd_wire::gnss::navigation::NavigationAssembler;
use insd_wire::gnss::{
    GnssPart, Locks, NavigationWords, gsof, nmea as gnss_nmea, novatel, rtcm, sbf, ubx,
};
use insd_wire::imu::kvh::{KvhFormat, KvhLinear, KvhMessage, KvhRotation, KvhTemperature};
use insd_wire::imu::stim::{StimConfiguration, StimDatagram, StimFormat, StimKind, StimRange};
use insd_wire::imu::vectornav::VnMessage;
use insd_wire::imu::{ImuReading, mip, sbg, stdbin, xbus};
use insd_wire::log::{LogReading, ad2cp, pd0, pd6};
use insd_wire::motion::em::EmAttitude;
use insd_wire::motion::kmb::Kmb;
use insd_wire::motion::tss1::Tss1;
use insd_wire::ngt1::NgtFrame;
use insd_wire::nmea::{ChecksumPolicy, Frame, PashrDialect, Sentence, TagBlock, Talker};
use insd_wire::signalk::{ServerLine, ServerValue};
use insd_wire::stream::Protocol;

use super::again::Keeps::{AfterOnce, Everything};
use super::again::again;

/// Makes everything of a frame that can be made of it.
pub(crate) fn look(protocol: Protocol, frame: &[u8]) {
    match protocol {
        Protocol::Nmea => nmea(frame),
        Protocol::Ubx => ubx(frame),
        Protocol::Sbf => sbf(frame),
        Protocol::Rtcm => rtcm(frame),
        Protocol::Sbg => sbg(frame),
        Protocol::StdBin => stdbin(frame),
        Protocol::Mip => mip(frame),
        Protocol::Xbus => xbus(frame),
        Protocol::Kvh => kvh(frame),
        Protocol::Stim => stim(frame),
        Protocol::Pd0 => pd0(frame),
        Protocol::Pd6 => pd6(frame),
        Protocol::Novatel => novatel(frame),
        Protocol::Kmb => kmb(frame),
        Protocol::Em3000 => em(frame),
        Protocol::Tss1 => tss1(frame),
        Protocol::Ngt1 => adapter(frame),
        Protocol::Gsof => gsof(frame),
        Protocol::VectorNav => vectornav(frame),
        Protocol::Ad2cp => ad2cp(frame),
        Protocol::SignalK => server(frame),
    }
}

/// Something whose making must not panic; what it says is not looked at.
fn make<T>(made: T) {
    black_box(made);
}

/// A number that is told is a number.
fn is_finite(numbers: impl IntoIterator<Item = Option<f64>>) -> bool {
    numbers.into_iter().flatten().all(f64::is_finite)
}

fn is_sane_part(part: &GnssPart) {
    let place = part.position.map(|place| [place.latitude, place.longitude, place.height]);
    let horizontal = part.horizontal.map(|place| [place.latitude, place.longitude]);
    let numbers = [part.time_std, part.heading, part.heading_std, part.hdop].into_iter();
    let numbers = numbers.chain(part.position_std).chain(part.velocity).chain(part.velocity_std);
    assert!(is_finite(numbers), "{part:?}");
    assert!(place.iter().flatten().all(|number| number.is_finite()), "{part:?}");
    let latitudes =
        [place.map(|[latitude, ..]| latitude), horizontal.map(|[latitude, _]| latitude)];
    let on_earth = |latitude: &f64| latitude.abs() <= FRAC_PI_2 + 1e-9;
    assert!(latitudes.iter().flatten().all(on_earth), "{part:?}");
    let sigmas = part.position_std.iter().chain(&part.velocity_std).chain([&part.heading_std]);
    assert!(sigmas.flatten().all(|sigma| *sigma >= 0.0), "{part:?}");
}

fn is_sane_sample(reading: &ImuReading) {
    assert!(!reading.valid || reading.motion.is_finite(), "{reading:?}");
    assert!(is_finite([reading.temperature, reading.latency]), "{reading:?}");
}

fn is_sane_log(reading: &LogReading) {
    assert!(is_finite(reading.velocity.into_iter().chain([reading.std, reading.age])));
}

fn nmea(line: &[u8]) {
    if let Ok(frame) = Frame::parse_with(line, ChecksumPolicy::Optional) {
        make(Sentence::read_frame(&frame));
        if let Some(tag) = frame.tag() {
            tag_block(&tag);
        }
    }
    let write = |(talker, sentence): &(Option<Talker>, Sentence)| {
        sentence.write(talker.unwrap_or(Talker::IN)).as_bytes().to_vec()
    };
    let Some((_, sentence)) = again(line, AfterOnce, Sentence::read, write) else { return };
    gnss_nmea::part(&sentence).iter().for_each(is_sane_part);
    if let Sentence::Pashr(own) = &sentence {
        for dialect in DIALECTS {
            make((own.quality(dialect), own.status(dialect)));
            let heave = own.heave_down(dialect);
            let mut other = *own;
            other.set_heave_down(heave, dialect);
            assert_eq!(other.heave_down(dialect), heave, "{dialect:?}");
        }
    }
}

/// All dialects of PASHR.
const DIALECTS: [PashrDialect; 6] = [
    PashrDialect::Sbg,
    PashrDialect::SbgWassp,
    PashrDialect::Ixblue,
    PashrDialect::Novatel,
    PashrDialect::Trimble,
    PashrDialect::Applanix,
];

fn tag_block(tag: &TagBlock<'_>) {
    let written = tag.write();
    let inside = std::str::from_utf8(&written).unwrap().trim_matches('\\');
    let content = inside.rsplit_once('*').map_or("", |(content, _)| content);
    assert_eq!(TagBlock::read(content), *tag);
}

fn ubx(frame: &[u8]) {
    use ubx::UbxMessage;
    let Ok(open) = ubx::Frame::open(frame) else { return };
    assert_eq!(open.write(), frame);
    let read = UbxMessage::read;
    let write = |message: &UbxMessage| match message {
        UbxMessage::NavPvt(message) => message.write(),
        UbxMessage::NavDop(message) => message.write(),
        UbxMessage::NavCov(message) => message.write(),
        UbxMessage::NavHpPosLlh(message) => message.write(),
        UbxMessage::NavPosLlh(message) => message.write(),
        UbxMessage::NavVelNed(message) => message.write(),
        UbxMessage::NavSol(message) => message.write(),
        UbxMessage::NavStatus(message) => message.write(),
        UbxMessage::NavTimeUtc(message) => message.write(),
        UbxMessage::NavRelPosNed(message) => message.write(),
        UbxMessage::NavTimeGps(message) => message.write(),
        UbxMessage::NavTimeLs(message) => message.write(),
        UbxMessage::TimTp(message) => message.write(),
        UbxMessage::RxmRawx(message) => message.write(),
        UbxMessage::RxmSfrbx(message) => message.write(),
        UbxMessage::Other { .. } => frame.to_vec(),
    };
    let Some(message) = again(frame, Everything, read, write) else { return };
    message.part().iter().for_each(is_sane_part);
    make(message.pulse());
    match message {
        UbxMessage::RxmRawx(message) => message.epoch().iter().for_each(is_sane_epoch),
        UbxMessage::RxmSfrbx(message) => message.navigation().iter().for_each(are_sane_words),
        _ => {}
    }
}

fn sbf(frame: &[u8]) {
    use sbf::SbfMessage;
    let Ok(open) = sbf::Frame::open(frame) else { return };
    assert_eq!(open.write(), frame);
    let read = SbfMessage::read;
    let write = |message: &SbfMessage| match message {
        SbfMessage::PvtGeodetic(block) => block.write(),
        SbfMessage::PvtCartesian(block) => block.write(),
        SbfMessage::BaseVectorGeod(block) => block.write(),
        SbfMessage::PosCovGeodetic(block) => block.write(),
        SbfMessage::VelCovGeodetic(block) => block.write(),
        SbfMessage::AttEuler(block) => block.write(),
        SbfMessage::AttCovEuler(block) => block.write(),
        SbfMessage::ReceiverTime(block) => block.write(),
        SbfMessage::XppsOffset(block) => block.write(),
        SbfMessage::MeasEpoch(block) => block.write(),
        SbfMessage::RawNavigation(block) => block.write(),
        SbfMessage::Other { .. } => frame.to_vec(),
    };
    let Some(message) = again(frame, Everything, read, write) else { return };
    message.part().iter().for_each(is_sane_part);
    make(message.pulse());
    match message {
        SbfMessage::MeasEpoch(block) => block.epoch(Some(0)).iter().for_each(is_sane_epoch),
        SbfMessage::RawNavigation(block) => block.navigation().iter().for_each(are_sane_words),
        _ => {}
    }
}

fn rtcm(frame: &[u8]) {
    if let Ok(open) = rtcm::Frame::open(frame) {
        assert_eq!(open.write(), frame);
        make(open.number());
    }
    for received in [GpsTime::from_week(2381, 0), GpsTime::from_nanos(i64::MAX)] {
        let told = rtcm::MsmCollector::new().take(frame, received).unwrap_or_default();
        for correction in told {
            if let rtcm::Correction::Epoch(epoch) = correction {
                is_sane_epoch(&epoch);
            }
        }
    }
}

fn is_sane_epoch(epoch: &SatelliteEpoch) {
    let mut marked = epoch.clone();
    Locks::new().mark(&mut marked);
    for own in &marked.signals {
        let numbers = [own.code, own.phase, own.doppler, own.cn0, own.lock];
        assert!(is_finite(numbers), "{own:?}");
        assert!(own.lock.is_none_or(|lock| lock >= 0.0), "{own:?}");
        assert!(own.phase.is_some() || !own.half_cycle && !own.slip, "{own:?}");
        make(own.wavelength());
    }
}

/// Whatever is assembled of words, alone and as every page of one satellite one after the other, at any time.
fn are_sane_words(words: &NavigationWords) {
    let mut assembler = NavigationAssembler::new();
    for nanos in [0, 1_440_437_460_000_000_000, i64::MIN, i64::MAX] {
        make(assembler.take(words, GpsTime::from_nanos(nanos)));
    }
}

fn sbg(frame: &[u8]) {
    use sbg::SbgMessage;
    let write = |message: &SbgMessage| match message {
        SbgMessage::ImuShort(log) => log.write(),
        SbgMessage::ImuData(log) => log.write(),
        SbgMessage::Time(log) => log.write(),
        SbgMessage::Euler(log) => log.write(),
        SbgMessage::Other { .. } => frame.to_vec(),
    };
    let Some(message) = again(frame, AfterOnce, SbgMessage::read, write) else { return };
    message.reading().iter().for_each(is_sane_sample);
    match message {
        SbgMessage::Time(log) => make((log.utc(), log.device_time())),
        SbgMessage::Euler(log) => make((log.device_time(), log.is_heading_valid())),
        _ => {}
    }
}

fn stdbin(frame: &[u8]) {
    use stdbin::Telegram;
    let Some(telegram) = again(frame, Everything, Telegram::read, Telegram::write) else { return };
    telegram.reading().iter().for_each(is_sane_sample);
    telegram.log_readings().iter().for_each(is_sane_log);
}

fn mip(frame: &[u8]) {
    use mip::Packet;
    let Some(packet) = again(frame, Everything, Packet::read, Packet::write) else { return };
    packet.reading().iter().for_each(is_sane_sample);
    make(packet.gps.map(|stamp| stamp.utc()));
}

fn xbus(frame: &[u8]) {
    use xbus::{FINE_DAY, MtData2, Precision};
    for precision in Precision::ALL {
        let write = |message: &MtData2| message.write(precision);
        let Some(message) = again(frame, AfterOnce, MtData2::read, write) else { return };
        message.reading().iter().for_each(is_sane_sample);
        message.reading_wrapping(FINE_DAY).iter().for_each(is_sane_sample);
        make(message.utc.map(|utc| utc.utc()));
    }
}

fn kvh(frame: &[u8]) {
    let Some(message) = again(frame, Everything, KvhMessage::read, KvhMessage::write) else {
        return;
    };
    for format in kvh_formats() {
        let reading = message.reading(&format);
        is_sane_sample(&reading);
        make(format.numbers(&reading.motion));
    }
}

fn kvh_formats() -> Vec<KvhFormat> {
    use KvhTemperature::{Celsius, CentiCelsius, CentiFahrenheit, Fahrenheit};
    let mut formats = Vec::new();
    for rotation in [KvhRotation::Delta, KvhRotation::Rate] {
        for linear in [KvhLinear::Acceleration, KvhLinear::DeltaMetres, KvhLinear::DeltaFeet] {
            for temperature in [Celsius, CentiCelsius, Fahrenheit, CentiFahrenheit] {
                let degrees = temperature == Fahrenheit;
                formats.push(KvhFormat { rotation, degrees, linear, temperature, interval: 1e-3 });
            }
        }
    }
    formats
}

fn stim(frame: &[u8]) {
    let read = StimConfiguration::read;
    if let Some(told) = again(frame, Everything, read, StimConfiguration::write) {
        make(told.format);
    }
    let Some(datagram) = again(frame, Everything, StimDatagram::read, StimDatagram::write) else {
        return;
    };
    for format in stim_formats() {
        if let Some(reading) = datagram.reading(&format) {
            is_sane_sample(&reading);
            make(format.counts(&reading.motion));
        }
    }
}

fn stim_formats() -> Vec<StimFormat> {
    let kinds = [StimKind::Rate, StimKind::Increment, StimKind::Integrated];
    let ranges = [StimRange::G2, StimRange::G5, StimRange::G10, StimRange::G30, StimRange::G80];
    let mut formats = Vec::new();
    for (gyro, accel) in kinds.into_iter().flat_map(|gyro| kinds.map(|accel| (gyro, accel))) {
        for (range, interval) in ranges.into_iter().zip([None, Some(5e-4)].into_iter().cycle()) {
            formats.push(StimFormat { gyro, accel, range, interval });
        }
    }
    formats
}

fn pd0(frame: &[u8]) {
    use pd0::Ensemble;
    let Some(ensemble) = again(frame, AfterOnce, Ensemble::read, Ensemble::write) else { return };
    for reference in [LogReference::Bottom, LogReference::Water] {
        let Some(reading) = ensemble.reading(reference) else { continue };
        is_sane_log(&reading);
        if let Some(geometry) = ensemble.fixed.geometry {
            geometry.instrument_reading(&reading).iter().for_each(is_sane_log);
        }
    }
    if let Some((geometry, bottom)) = ensemble.fixed.geometry.zip(ensemble.bottom) {
        let janus = geometry.instrument(bottom.velocity);
        let finite = janus.is_none_or(|own| is_finite([Some(own.x), Some(own.z), own.error]));
        assert!(finite, "{janus:?}");
    }
}

fn kmb(frame: &[u8]) {
    let Ok(told) = Kmb::read(frame) else { return };
    let heading = told.heading.map(|heading| heading.value);
    let numbers = told.rates.map(Some).into_iter().chain([heading, told.sigma.heading]);
    assert!(is_finite(numbers), "{told:?}");
    if let Some(written) = told.write() {
        make(Kmb::read(&written));
    }
}

fn em(frame: &[u8]) {
    let read = |bytes: &[u8]| EmAttitude::read(bytes);
    let Some(told) = again(frame, AfterOnce, read, |told| told.write().to_vec()) else { return };
    assert!(is_finite([told.roll, told.pitch, told.heave, told.heading]), "{told:?}");
}

fn tss1(frame: &[u8]) {
    let write = |told: &Tss1| told.write().map_or_else(Vec::new, Vec::from);
    let Some(told) = again(frame, Everything, Tss1::read, write) else { return };
    assert!(is_finite([told.roll, told.pitch, told.heave].map(Some)), "{told:?}");
}

fn adapter(frame: &[u8]) {
    let Ok(NgtFrame::Received(_)) = NgtFrame::read(frame) else { return };
    let write = |told: &NgtFrame| match told {
        NgtFrame::Received(message) => message.write().unwrap_or_default(),
        NgtFrame::Other(_) => Vec::new(),
    };
    let told = again(frame, Everything, NgtFrame::read, write);
    assert!(told.is_some());
}

fn novatel(frame: &[u8]) {
    use novatel::OemLog;
    let Some(log) = again(frame, Everything, OemLog::read, OemLog::write) else { return };
    log.part().iter().for_each(is_sane_part);
    log.imu().iter().for_each(is_sane_sample);
    let told = log.attitude();
    assert!(told.is_none_or(|(heading, std)| is_finite([heading, std])), "{log:?}");
}

/// The pages of a report are read as if each were one.
fn gsof(frame: &[u8]) {
    use gsof::{GsofReport, Page, Pages};
    let Ok(page) = Page::open(frame) else { return };
    assert_eq!(page.write(), frame);
    make(Pages::default().take(&page));
    let write = |report: &GsofReport| report.write();
    let Some(report) = again(&page.records, AfterOnce, GsofReport::read, write) else { return };
    report.part().iter().chain(&report.heading()).for_each(is_sane_part);
}

fn vectornav(frame: &[u8]) {
    let read = |bytes: &[u8]| VnMessage::read(bytes);
    let Some(told) = again(frame, Everything, read, VnMessage::write) else { return };
    told.reading().iter().filter(|sample| sample.valid).for_each(is_sane_sample);
    assert!(is_finite([told.true_heading()]), "{told:?}");
    make(told.utc());
}

fn ad2cp(frame: &[u8]) {
    use ad2cp::Ad2cpBottomTrack;
    let (read, write) = (Ad2cpBottomTrack::read, Ad2cpBottomTrack::write);
    let Some(track) = again(frame, AfterOnce, read, write) else { return };
    track.reading().iter().for_each(is_sane_log);
}

fn pd6(frame: &[u8]) {
    use pd6::Pd6;
    let Some(line) = again(frame, AfterOnce, Pd6::read, Pd6::write) else { return };
    line.reading().iter().for_each(is_sane_log);
}

fn server(frame: &[u8]) {
    let Ok(ServerLine::Delta { updates, .. }) = ServerLine::read(frame) else { return };
    for value in updates.iter().flat_map(|update| &update.values) {
        let numbers = match *value {
            ServerValue::HeadingTrue(own)
            | ServerValue::HeadingMagnetic(own)
            | ServerValue::SpeedThroughWater(own) => [own, None],
            ServerValue::Position(at) => [at.map(|at| at.latitude), at.map(|at| at.longitude)],
            ServerValue::Bad(_) => continue,
        };
        assert!(is_finite(numbers), "{value:?}");
    }
}
