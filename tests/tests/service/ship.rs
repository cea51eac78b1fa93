//! A ship with sensors on UDP: her configuration, what her sensors send, and the truth.

use std::net::{Ipv4Addr, SocketAddr, TcpListener, UdpSocket};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU32, AtomicU64, Ordering};
use std::thread::JoinHandle;
use std::time::Duration;

use insd::clock::{Clock, HostClock, boot_now};
use insd::state::{Kept, Store};
use insd_base::{Time, Voyage};
use insd_config::Config;
use insd_simulator::simulate;
use insd_tests::feed::{Encoding, FeedConfig, LineSending, Reception, arrivals, feed};

/// Sensors by their place in the configuration.
pub(crate) const IMU: usize = 0;
pub(crate) const GNSS: usize = 1;
pub(crate) const LOG: usize = 2;

/// A ship under way, and a folder for all that her daemon needs.
pub(crate) struct Ship {
    pub(crate) folder: tempfile::TempDir,
    pub(crate) voyage: Voyage,
    pub(crate) sendings: Vec<LineSending>,
    /// Where her sensors send to.
    sensors: Vec<SocketAddr>,
    /// What the daemon sends.
    pub(crate) output: UdpSocket,
    /// Where the page is.
    pub(crate) page: SocketAddr,
    feeds: FeedConfig,
}

/// Ports that nobody else has at the moment, nor is given by the system to who asks for any: a client of another test would
/// else take one between now and the start of the daemon.
pub(crate) fn free_ports<const COUNT: usize>() -> [SocketAddr; COUNT] {
    /// Below those that systems give away (32768 and up, or 49152).
    const RANGE: std::ops::Range<u32> = 10_000..32_768;
    static NEXT: AtomicU32 = AtomicU32::new(0);
    let own = std::process::id().wrapping_mul(997);
    let next = || {
        let step = own.wrapping_add(NEXT.fetch_add(1, Ordering::Relaxed));
        let port = RANGE.start + step % (RANGE.end - RANGE.start);
        SocketAddr::from((Ipv4Addr::LOCALHOST, u16::try_from(port).unwrap()))
    };
    let is_free =
        |port: &SocketAddr| TcpListener::bind(port).is_ok() && UdpSocket::bind(port).is_ok();
    let mut free = std::iter::repeat_with(next).filter(is_free);
    std::array::from_fn(|_| free.next().unwrap())
}

impl Ship {
    /// A coaster under way for so many seconds.
    pub(crate) fn under_way(seconds: f64, seed: u64) -> Self {
        Self::on(&[("[gnss]", "[log]\n\n[gnss]\nrate_hz = 5.0")], seconds, seed)
    }

    /// The same with other sensors: pieces of the scenario's text and what stands in their place.
    pub(crate) fn on(changes: &[(&str, &str)], seconds: f64, seed: u64) -> Self {
        let voyage = simulate(&insd_tests::variant(10, changes).with_duration(seconds), seed);
        let feeds = FeedConfig::new(&voyage, &[Encoding::Sbg, Encoding::Ubx, Encoding::Vbw]);
        let sendings = feed(&voyage, &feeds);
        let [imu, gnss, log, page] = free_ports();
        let output = UdpSocket::bind((Ipv4Addr::LOCALHOST, 0)).unwrap();
        output.set_read_timeout(Some(Duration::from_millis(50))).unwrap();
        let folder = tempfile::tempdir().unwrap();
        let ship =
            Ship { folder, voyage, sendings, sensors: vec![imu, gnss, log], output, page, feeds };
        Config::of_text(&ship.text("")).unwrap();
        std::fs::write(ship.config(), ship.text("")).unwrap();
        ship
    }

    /// The file of her configuration.
    pub(crate) fn config(&self) -> PathBuf {
        self.folder.path().join("insd.toml")
    }

    /// Folders of the state: in memory, and on the disk.
    pub(crate) fn folders(&self) -> [PathBuf; 2] {
        ["run", "lib"].map(|name| {
            let folder = self.folder.path().join(name);
            std::fs::create_dir_all(&folder).unwrap();
            folder
        })
    }

    /// The text of her configuration, with more behind it.
    pub(crate) fn text(&self, more: &str) -> String {
        let shipped = include_str!("../../../systemd/examples/survey.toml");
        let imu = shipped.find("[imu]").unwrap()..shipped.find("[[port]]").unwrap();
        let arms = &self.voyage.header.lever_arms;
        let arm = |arm: &insd_base::Body| format!("[{:?}, {:?}, {:?}]", arm.0.x, arm.0.y, arm.0.z);
        let mut text = format!(
            "[ship]\nstart = \"underway\"\npriority = 0\ngnss_lever_m = {}\nlog_lever_m = {}\n{}",
            arm(&arms.gnss),
            arm(&arms.log),
            &shipped[imu]
        );
        text += &format!("[web]\nlisten = {:?}\nmax_per_address = 600\n", self.page.to_string());
        for (port, sensor) in self.feeds.intake(&self.voyage).sensors.iter().enumerate() {
            let (name, bind) = (&sensor.port, self.sensors[port].to_string());
            let transport = format!("{{ kind = \"udp\", bind = {bind:?} }}");
            text += &format!("[[port]]\nname = {name:?}\ntransport = {transport}\n");
            let table = toml::Table::try_from(sensor).unwrap();
            text +=
                &toml::Table::from_iter([("sensor".to_owned(), vec![table].into())]).to_string();
        }
        let to = self.output.local_addr().unwrap().to_string();
        text += &format!(
            "[[output]]\nname = \"bridge\"\nmessages = {{ \"PASHR.novatel\" = 10, HDT = 10 }}\n\
             destination = {{ kind = \"udp\", to = {to:?} }}\n"
        );
        text + more
    }

    /// Puts what a run of the daemon up to an instant of the voyage would have left into the folders of the
    /// state.
    pub(crate) fn leave_state(&self, until: f64) {
        let config = Config::of_text(&self.text("")).unwrap();
        let mut pipeline = config.pipeline();
        let early = self.sendings.iter().take_while(|sending| sending.at.as_seconds() < until);
        let early: Vec<LineSending> = early.cloned().collect();
        let reception = Reception::new(self.feeds.sensors[0].calendar.start, 1);
        for arrival in arrivals(&early, &reception) {
            pipeline.handle(&arrival, |_| {});
        }
        assert!(pipeline.engine().mode().is_navigating(), "{:?}", pipeline.engine().mode());
        let state = pipeline.checkpoint().unwrap();
        let made = boot_now(&HostClock::start().now());
        for folder in self.folders() {
            let kept = Kept { made: made.clone(), state: state.clone() };
            Store::new(&folder, "navigation").save(&kept, true).unwrap();
        }
    }

    /// Lets her sensors send from an instant of the voyage on.
    pub(crate) fn sail(self: &Arc<Self>, from: f64) -> Sailing {
        let shared = Arc::new(Shared::default());
        let thread = std::thread::spawn({
            let (ship, shared) = (Arc::clone(self), Arc::clone(&shared));
            move || ship.send(from, &shared)
        });
        Sailing { shared, thread: Some(thread) }
    }

    fn send(&self, from: f64, shared: &Shared) {
        let socket = UdpSocket::bind((Ipv4Addr::LOCALHOST, 0)).unwrap();
        let clock = Clock::start();
        for sending in self.sendings.iter().filter(|own| own.at.as_seconds() >= from) {
            let wait = sending.at.as_seconds() - from - clock.elapsed().as_secs_f64();
            if wait > 0.0 {
                std::thread::sleep(Duration::from_secs_f64(wait));
            }
            if shared.stop.load(Ordering::Relaxed) {
                return;
            }
            if shared.mute.load(Ordering::Relaxed) & (1 << sending.port) == 0 {
                // nobody listens while the daemon is down
                let _ = socket.send_to(sending.bytes(), self.sensors[sending.port]);
            }
        }
    }

    /// True heading at an instant of the voyage, rad.
    pub(crate) fn heading(&self, at: Time) -> f64 {
        let truth = &self.voyage.truth;
        let after = truth.partition_point(|row| row.time < at).clamp(1, truth.len() - 1);
        let (one, other) = (&truth[after - 1], &truth[after]);
        let share = (at - one.time).as_seconds() / (other.time - one.time).as_seconds();
        let heading = |row: &insd_base::Truth| row.attitude.unwrap().heading;
        heading(one) + share * insd_base::units::wrap_pi(heading(other) - heading(one))
    }

    /// Time of the voyage at a time of day, s.
    pub(crate) fn time_of(&self, time_of_day: f64) -> Time {
        let start = self.feeds.sensors[0].calendar.start.as_nanos() as f64 * 1e-9;
        Time::from_seconds((time_of_day - start).rem_euclid(86_400.0))
    }

    pub(crate) fn path(&self) -> &Path {
        self.folder.path()
    }
}

#[derive(Default)]
struct Shared {
    stop: AtomicBool,
    /// A bit for each sensor that sends nothing.
    mute: AtomicU64,
}

/// Sensors at work; they stop when this is dropped.
pub(crate) struct Sailing {
    shared: Arc<Shared>,
    thread: Option<JoinHandle<()>>,
}

impl Sailing {
    /// From now on these sensors send nothing.
    pub(crate) fn mute(&self, sensors: &[usize]) {
        let bits = sensors.iter().fold(0, |bits, sensor| bits | 1 << sensor);
        self.shared.mute.store(bits, Ordering::Relaxed);
    }
}

impl Drop for Sailing {
    fn drop(&mut self) {
        self.shared.stop.store(true, Ordering::Relaxed);
        if let Some(thread) = self.thread.take() {
            thread.join().unwrap();
        }
    }
}
