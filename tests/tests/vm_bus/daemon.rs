//! The whole daemon between two buses: sensors on one, its node on the other.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::Duration;

use insd_base::units::{DEG, wrap_pi};
use insd_base::{CanId, Input, Solution, Time, Truth, Voyage, earth};
use insd_drivers::recording::read_nav;
use insd_intake::config::SensorConfig;
use insd_simulator::simulate;
use insd_tests::feed::{Encoding, FeedConfig, LineSending, feed};
use insd_wire::imu::can::Shipped;

use super::guest::{SECOND, make, turn};
use super::order::check;
use super::peer::{PRODUCT, Peer};
use super::readback::{Read, What, read};
use super::tap::Tap;
use super::unit::{HEADING, HOME};

/// Length of the voyage, s, and from when on the solution is held against the truth.
const DURATION: f64 = 120.0;
const SETTLED: f64 = 80.0;
/// Nobody can know the heading before that, s.
const ALIGNING: f64 = 20.0;
/// Solutions per second.
const RATE: f64 = 10.0;

/// The error model that the coarse steps of the maker's frames need.
const IMU: &str = "[imu]
gyro_bias_std_deg_h = 60.0
gyro_bias_instability_deg_h = 20.0
gyro_bias_time_constant_s = 600.0
angle_random_walk_deg_sqrt_h = 0.3
gyro_scale_factor_std_ppm = 1000.0
accel_bias_std_ug = 1000.0
accel_bias_instability_ug = 300.0
accel_bias_time_constant_s = 600.0
velocity_random_walk_mps_sqrt_h = 0.1
accel_scale_factor_std_ppm = 1000.0
";

/// A coaster under way in a moderate sea.
fn voyage() -> Voyage {
    let changes = [("[gnss]", "[gnss]\nrate_hz = 5.0"), ("[imu]", "[imu]\nrate_hz = 50.0")];
    simulate(&insd_tests::variant(10, &changes).with_duration(DURATION), 3)
}

fn configuration(voyage: &Voyage, feeds: &FeedConfig) -> String {
    let lever = voyage.header.lever_arms.gnss.0;
    let lever = format!("gnss_lever_m = [{:?}, {:?}, {:?}]", lever.x, lever.y, lever.z);
    let mut text = format!("[ship]\nstart = \"underway\"\nrate_hz = {RATE:?}\n{lever}\n{IMU}");
    for (name, interface) in [("sensors", "vcan0"), ("bridge", "vcan1")] {
        let transport = format!("{{ kind = \"socketcan\", interface = \"{interface}\" }}");
        text.push_str(&format!("[[port]]\nname = \"{name}\"\ntransport = {transport}\n"));
    }
    for sensor in feeds.intake(voyage).sensors {
        let sensor = SensorConfig { port: "sensors".to_owned(), ..sensor };
        let table = toml::Table::try_from(&sensor).unwrap();
        let wrapped = toml::Table::from_iter([("sensor".to_owned(), vec![table].into())]);
        text.push_str(&wrapped.to_string());
    }
    text.push_str("[[node]]\nport = \"bridge\"\nunique = 1000\n");
    text
}

/// The program, which `cargo build -p insd` puts beside the folder of the tests.
fn program() -> PathBuf {
    let own = std::env::current_exe().unwrap();
    let program = own.ancestors().nth(2).unwrap().join("insd");
    // what is read from the host for the first time makes the clock leap
    let mut file = fs::File::open(&program).expect("cargo build -p insd comes first");
    std::io::copy(&mut file, &mut std::io::sink()).unwrap();
    program
}

/// The daemon at work.
struct Daemon(Child);

impl Daemon {
    fn start(program: &Path, config: &Path, nav: &Path) -> Self {
        let mut command = Command::new(program);
        command.arg("run").arg("--config").arg(config).arg("--nav").arg(nav);
        Daemon(command.stdout(Stdio::inherit()).stderr(Stdio::inherit()).spawn().unwrap())
    }

    /// Tells it to stop, and waits until it has.
    fn stop(mut self) {
        let id = rustix::process::Pid::from_child(&self.0);
        rustix::process::kill_process(id, rustix::process::Signal::TERM).unwrap();
        assert!(self.0.wait().unwrap().success());
    }
}

/// Sends what the sensors send in its own time.
fn send(bus: &Peer, sendings: &[LineSending], tap: &Tap) {
    let begun = tap.now();
    for sending in sendings {
        let wait = begun + sending.at.as_seconds() - tap.now();
        std::thread::sleep(Duration::from_secs_f64(wait.max(0.0)));
        let Input::Can(frame) = &sending.input else { panic!("{sending:?}") };
        let id = match frame.id() {
            CanId::Standard(id) => id.into(),
            CanId::Extended(id) => id | 0x8000_0000,
        };
        bus.try_say(id, frame.data()).unwrap();
    }
}

/// Truth between its instants.
fn truth_at(voyage: &Voyage, seconds: f64) -> Option<(Truth, Truth, f64)> {
    let time = Time::from_seconds(seconds);
    let next = voyage.truth.partition_point(|own| own.time <= time);
    let (before, after) = (voyage.truth.get(next.checked_sub(1)?)?, voyage.truth.get(next)?);
    let share = (time - before.time).as_seconds() / (after.time - before.time).as_seconds();
    Some((*before, *after, share))
}

/// The greatest differences from the truth.
#[derive(Debug, Default)]
struct Worst {
    epochs: usize,
    heading_deg: f64,
    roll_pitch_deg: f64,
    course_deg: f64,
    speed: f64,
    horizontal: f64,
    vertical: f64,
}

fn raise(worst: &mut f64, value: f64) {
    *worst = worst.max(value.abs());
}

/// Degrees apart, the short way.
fn apart(one: f64, other: f64) -> f64 {
    wrap_pi((one - other) * DEG) / DEG
}

impl Worst {
    fn take(&mut self, what: What, (before, after, share): &(Truth, Truth, f64)) {
        let between = |one: f64, other: f64| one + (other - one) * share;
        let angle = |one: f64, other: f64| (one + wrap_pi(other - one) * share) / DEG;
        let (first, second) = (before.attitude.unwrap(), after.attitude.unwrap());
        let velocity = before.velocity.unwrap().0.lerp(&after.velocity.unwrap().0, *share);
        let heading = angle(first.heading, second.heading);
        match what {
            What::Heading(own) => raise(&mut self.heading_deg, apart(own, heading)),
            What::Attitude([yaw, pitch, roll]) => {
                raise(&mut self.heading_deg, apart(yaw, heading));
                raise(&mut self.roll_pitch_deg, apart(pitch, angle(first.pitch, second.pitch)));
                raise(&mut self.roll_pitch_deg, apart(roll, angle(first.roll, second.roll)));
            }
            What::Course([course, speed]) => {
                raise(&mut self.course_deg, apart(course, velocity.y.atan2(velocity.x) / DEG));
                raise(&mut self.speed, speed - velocity.xy().norm());
            }
            What::Fix(_, [latitude, longitude, height]) => {
                self.epochs += 1;
                let (one, other) = (before.position, after.position);
                let (meridian, transverse) = earth::radii(one.latitude);
                let (north, east) = (meridian + one.height, transverse + one.height);
                let off = |own: f64, one: f64, other: f64| own * DEG - between(one, other);
                let off = [
                    off(latitude, one.latitude, other.latitude) * north,
                    off(longitude, one.longitude, other.longitude) * east * one.latitude.cos(),
                ];
                raise(&mut self.horizontal, off[0].hypot(off[1]));
                raise(&mut self.vertical, height - between(one.height, other.height));
            }
            _ => {}
        }
    }
}

/// Holds every message that has a number of an epoch whose time is told against the truth of that time.
fn against_truth(voyage: &Voyage, start: f64, all: &[Read]) -> Worst {
    let mut worst = Worst::default();
    for (index, fix) in all.iter().enumerate() {
        let What::Fix(utc, _) = fix.what else { continue };
        let seconds = utc - start;
        let Some(truth) = truth_at(voyage, seconds).filter(|_| seconds >= SETTLED) else {
            continue;
        };
        let near = &all[index.saturating_sub(40)..(index + 40).min(all.len())];
        let same = |own: &&Read| own.sid == fix.sid && (own.at - fix.at).abs() < 0.09;
        for own in near.iter().filter(same) {
            if let What::Clock(clock) = own.what {
                assert!((clock - utc).abs() < 2e-4, "{clock} beside {utc}");
            }
            worst.take(own.what, &truth);
        }
    }
    worst
}

/// Of a meridian, to a percent.
const METRES_PER_DEGREE: f64 = 111_000.0;

/// How far a place is from the way between two rows of the solution, and how far along it is, deg.
fn beside(pair: &[Solution], place: [f64; 2]) -> (f64, f64) {
    let at = |own: &Solution| [own.position.latitude / DEG, own.position.longitude / DEG];
    let (one, other) = (at(&pair[0]), at(&pair[1]));
    let way = [other[0] - one[0], other[1] - one[1]];
    let to = [place[0] - one[0], place[1] - one[1]];
    let length = (way[0] * way[0] + way[1] * way[1]).max(1e-18);
    let share = ((way[0] * to[0] + way[1] * to[1]) / length).clamp(0.0, 1.0);
    ((to[0] - share * way[0]).abs().max((to[1] - share * way[1]).abs()), share)
}

/// Each position of the bus lies between two rows of the solution, and the heading beside it does, too.
/// Gives how many there are.
fn against_nav(nav: &[Solution], all: &[Read]) -> usize {
    let mut compared = 0;
    for (index, read) in all.iter().enumerate() {
        let What::Position(place) = read.what else { continue };
        let near = |pair: &[Solution]| beside(pair, place);
        let pair = nav.windows(2).min_by(|one, other| near(one).0.total_cmp(&near(other).0));
        let pair = pair.unwrap();
        let (off, share) = near(pair);
        // a correction between two rows is a step: centimetres, or, as long as the place is not known well yet
        // (and on a busy machine a burst meets another part of it), a share of what is claimed
        let claimed = pair[0].sigma.position.0.xy().norm() / METRES_PER_DEGREE;
        assert!(off < 6e-7 + 0.2 * claimed, "{read:?} is on no way of the solution: {off}");
        let before = all[index.saturating_sub(6)..index].iter().rev();
        let mut headings = before.filter_map(|own| match own.what {
            What::Heading(heading) if read.at - own.at < 0.05 => Some(heading),
            _ => None,
        });
        if let Some(heading) = headings.next() {
            let ends = [pair[0].attitude.heading / DEG, pair[1].attitude.heading / DEG];
            let off = apart(heading, ends[0] + share * apart(ends[1], ends[0]));
            assert!(off.abs() < 0.05, "heading {heading} beside {off} deg off");
            assert!(pair[1].mode.is_navigating(), "a heading in mode {:?}", pair[1].mode);
            compared += 1;
        }
    }
    compared
}

/// Time between messages of a group, s: the mean and the greatest.
fn intervals(all: &[Read], pgn: u32) -> (f64, f64) {
    let times: Vec<f64> = all.iter().filter(|own| own.pgn == pgn).map(|own| own.at).collect();
    let gaps = times.windows(2).map(|pair| pair[1] - pair[0]);
    let mean = gaps.clone().sum::<f64>() / (times.len() - 1) as f64;
    (mean, gaps.fold(0.0, f64::max))
}

/// Numbers of epochs go on by one from burst to burst, and all messages of a burst have the same.
fn sids_are_linked(all: &[Read]) {
    let numbered: Vec<&Read> = all.iter().filter(|own| own.sid.is_some()).collect();
    let mut jumps = 0;
    for pair in numbered.windows(2) {
        let [one, other] = [pair[0].sid.unwrap(), pair[1].sid.unwrap()];
        let next = if one == 252 { 0 } else { one + 1 };
        assert!(other == one || other == next, "SID {other} after {one}: {:?}", pair[1]);
        jumps += usize::from(other != one);
        if other == one {
            assert!(pair[1].at - pair[0].at < 0.09, "SID {one} again much later");
        }
    }
    assert!(jumps as f64 > 0.9 * RATE * (DURATION - SETTLED), "{jumps} epochs");
}

const INTERVALS: [(u32, f64); 12] = [
    (127_250, 0.1),
    (127_251, 0.1),
    (129_025, 0.1),
    (127_252, 0.1),
    (129_026, 0.25),
    (130_578, 0.25),
    (127_257, 1.0),
    (128_259, 1.0),
    (129_029, 1.0),
    (126_992, 1.0),
    (129_033, 1.0),
    (127_258, 1.0),
];

#[test]
#[ignore = "needs the guest: tests/vm/runner"]
fn a_ship_navigates_by_one_bus_and_tells_another() {
    let _turn = turn();
    let program = program();
    make("vcan0");
    make("vcan1");
    let folder = tempfile::tempdir().unwrap();
    let (config, nav) = (folder.path().join("insd.toml"), folder.path().join("nav.csv"));
    let voyage = voyage();
    let encodings = [Encoding::CanImu(Some(Shipped::Sbg)), Encoding::N2kGnss];
    let feeds = FeedConfig::new(&voyage, &encodings);
    fs::write(&config, configuration(&voyage, &feeds)).unwrap();
    let sendings = feed(&voyage, &feeds);

    let (tap, listener) = (Tap::on("vcan1"), Tap::on("vcan0"));
    let (sensors, peer) = (Peer::on("vcan0", 0), Peer::on("vcan1", 200));
    let daemon = Daemon::start(&program, &config, &nav);
    let took = peer.insist(HOME, &tap, 10 * SECOND).expect("the daemon's node");
    println!("the node answers {took:.3} s after the program was started");
    let begun = tap.now();
    send(&sensors, &sendings, &tap);
    let ended = tap.now();
    let (took, product) = peer.ask(PRODUCT, HOME, &tap).unwrap();
    assert!(took < 1.0 && product.len() == 134);
    daemon.stop();

    // without a node nothing is ever written
    assert_eq!(listener.frames().len(), sendings.iter().filter(is_extended).count());
    let frames = tap.frames();
    assert!(check(&frames, &[], |source| source == HOME).whole > 100);
    let under_way: Vec<_> = tap.since(begun + SETTLED);
    let all = read(&under_way, HOME);
    for (pgn, wanted) in INTERVALS {
        let (mean, greatest) = intervals(&all, pgn);
        println!("{pgn}: every {mean:.4} s, {greatest:.4} s at most");
        // a message leaves with the first solution of its interval
        assert!((mean - wanted).abs() < 0.02 * wanted && greatest < wanted + 1.2 / RATE, "{pgn}");
    }
    sids_are_linked(&all);
    let start = feeds.sensors[0].calendar.start.as_nanos() as f64 * 1e-9;
    let worst = against_truth(&voyage, start, &all);
    println!("{worst:?}");
    assert!(worst.epochs as f64 > DURATION - SETTLED - 5.0, "{worst:?}");
    assert!(worst.heading_deg < 2.0 && worst.roll_pitch_deg < 0.3, "{worst:?}");
    assert!(worst.course_deg < 2.0 && worst.speed < 0.2, "{worst:?}");
    assert!(worst.horizontal < 5.0 && worst.vertical < 8.0, "{worst:?}");
    let early: Vec<_> = frames.iter().filter(|own| own.at < begun + ALIGNING).copied().collect();
    let early = read(&early, HOME);
    let unknown = |own: &&Read| own.pgn == HEADING && matches!(own.what, What::Nothing);
    assert!(early.iter().filter(unknown).count() as f64 > 0.9 * RATE * ALIGNING);
    assert!(!early.iter().any(|own| matches!(own.what, What::Heading(_))));
    let solutions = read_nav(&nav).unwrap();
    // she is carried on beyond the last row of the solution, where there is nothing to compare
    let last_row = ended - 2.0 / RATE;
    let fed: Vec<_> = frames.iter().filter(|own| own.at < last_row).copied().collect();
    let compared = against_nav(&solutions, &read(&fed, HOME));
    println!("{compared} headings are those of {} solutions", solutions.len());
    assert!(compared as f64 > 0.9 * RATE * (DURATION - SETTLED));
}

fn is_extended(sending: &&LineSending) -> bool {
    matches!(&sending.input, Input::Can(frame) if matches!(frame.id(), CanId::Extended(_)))
}
