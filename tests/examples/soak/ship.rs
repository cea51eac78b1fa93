//! A ship on a long voyage, and what her sensors send.

use std::io::Write;

use insd_base::{Input, Stamped, Time, Voyage};
use insd_simulator::{Scenario, shipped, simulate};
use insd_tests::feed::{Encoding, FeedConfig, Reception, arrivals, feed};

/// What is turned into bytes at a time, s.
const PIECE: f64 = 600.0;

/// Ports that are written to.
const OUTPUTS: usize = 10;

/// The whole voyage.
pub(crate) struct Ship {
    voyage: Voyage,
    feeds: FeedConfig,
    duration: f64,
}

impl Ship {
    pub(crate) fn new(hours: f64, imu_rate: f64) -> Self {
        let duration = hours * 3600.0;
        let overrides = [format!("imu.rate_hz={imu_rate}"), "truth.rate_hz=0.1".to_owned()];
        let overrides = overrides.map(|text| text.parse().unwrap());
        let scenario = Scenario::with_overrides(shipped()[9].1, &overrides).unwrap();
        let voyage = simulate(&scenario.with_duration(duration), 1);
        let feeds = FeedConfig::new(&voyage, &[Encoding::Sbg, Encoding::Ubx, Encoding::Vbw]);
        Ship { voyage, feeds, duration }
    }

    /// The configuration of her daemon.
    pub(crate) fn configuration(&self) -> String {
        let shipped = include_str!("../../../systemd/examples/survey.toml");
        let imu = shipped.find("[imu]").unwrap()..shipped.find("[[port]]").unwrap();
        let arms = &self.voyage.header.lever_arms;
        let arm = |arm: &insd_base::Body| format!("[{:?}, {:?}, {:?}]", arm.0.x, arm.0.y, arm.0.z);
        let mut text = format!(
            "[ship]\nstart = \"underway\"\ngnss_lever_m = {}\nlog_lever_m = {}\n{}",
            arm(&arms.gnss),
            arm(&arms.log),
            &shipped[imu]
        );
        for sensor in self.feeds.intake(&self.voyage).sensors {
            let transport = "{ kind = \"udp\", bind = \"127.0.0.1:1\" }";
            text += &format!("[[port]]\nname = {:?}\ntransport = {transport}\n", sensor.port);
            let table = toml::Table::try_from(sensor).unwrap();
            text +=
                &toml::Table::from_iter([("sensor".to_owned(), vec![table].into())]).to_string();
        }
        for number in 0..OUTPUTS {
            text += &format!(
                "[[output]]\nname = \"out{number}\"\nprofile = \"bridge\"\n\
                 messages = {{ HDT = 10, ROT = 10, ZDA = 1 }}\n\
                 destination = {{ kind = \"udp\", to = \"127.0.0.1:9\" }}\n"
            );
        }
        text
    }

    /// Sends everything; what was sent, in words.
    pub(crate) fn send(&self, mut to: impl Write) -> String {
        let mut reception = Reception::new(self.feeds.sensors[0].calendar.start, 1);
        let (mut messages, mut bytes) = (0_u64, 0_u64);
        let pieces = (self.duration / PIECE).ceil() as u64;
        // what is late arrives with the next piece
        let mut held = Vec::new();
        for piece in 0..pieces {
            reception.seed = piece + 1;
            let border = |piece: u64| Time::from_seconds(PIECE * piece as f64);
            let sendings = feed(&self.piece(border(piece), border(piece + 1)), &self.feeds);
            held.extend(arrivals(&sendings, &reception));
            held.sort_by_key(|arrival| arrival.stamp.monotonic);
            let until = reception.stamp(border(piece + 1)).monotonic;
            let is_last = piece + 1 == pieces;
            let ready = held.partition_point(|own| is_last || own.stamp.monotonic < until);
            for arrival in held.drain(..ready) {
                if let Input::Bytes(own) = &arrival.input {
                    (messages, bytes) = (messages + 1, bytes + own.len() as u64);
                }
                super::pipe::write(&mut to, &arrival).unwrap();
            }
        }
        to.flush().unwrap();
        format!("{messages} messages, {bytes} bytes")
    }

    /// The part of the voyage in which messages become valid from one instant up to another.
    fn piece(&self, from: Time, until: Time) -> Voyage {
        Voyage {
            header: self.voyage.header.clone(),
            imu: part(&self.voyage.imu, |sample| sample.time, from, until),
            gnss: part(&self.voyage.gnss, |fix| fix.time, from, until),
            log: part(&self.voyage.log, |log| log.time, from, until),
            reference: Vec::new(),
            truth: Vec::new(),
        }
    }
}

fn part<T: Copy>(
    all: &[Stamped<T>],
    time: impl Fn(&T) -> Time,
    from: Time,
    until: Time,
) -> Vec<Stamped<T>> {
    let begin = all.partition_point(|row| time(&row.message) < from);
    let end = all.partition_point(|row| time(&row.message) < until);
    all[begin..end].to_vec()
}
