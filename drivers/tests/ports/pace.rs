//! Lines that carry less than is handed over, and how quickly the others are written to.

use std::path::{Path, PathBuf};
use std::time::Duration;

use insd_base::{Span, Time};
use insd_drivers::ports::{
    Destination, Outgoing, OutputConfig, OutputPort, OutputStatus, Pty, Serial, UdpOutput,
};
use rustix::fs::{Mode, OFlags, open};
use tokio::time::{MissedTickBehavior, interval, sleep};

use crate::host::{Device, Host};

/// A sentence of a list: period and length, bytes.
type Kind = (Duration, usize);

const FAST: Duration = Duration::from_millis(100);
const SLOW: Duration = Duration::from_millis(200);

/// Eight sentences, 2375 bytes per second: five times what 4800 baud can carry.
const LIST: [Kind; 8] = [
    (FAST, 20),
    (FAST, 40),
    (SLOW, 75),
    (SLOW, 45),
    (FAST, 30),
    (SLOW, 40),
    (FAST, 60),
    (SLOW, 82),
];

/// What a machine under load may add, seconds.
const LOAD: f64 = 0.06;

/// How early a message may be given to the system, seconds.
const LEAD: f64 = 0.004;

/// A line that says its slot and when it was valid.
fn sentence(slot: u16, valid: Time, (period, length): Kind) -> Outgoing {
    let bytes = format!("{slot} {:0width$}\n", valid.as_nanos(), width = length - 3).into_bytes();
    assert_eq!(bytes.len(), length);
    Outgoing { slot, bytes, valid, period: Span::from_seconds(period.as_secs_f64()) }
}

/// A line that was read: it was not there yet at one look, and was at the next.
struct Heard {
    slot: u16,
    valid: Time,
    after: Time,
    before: Time,
    length: usize,
}

/// What reads the far end of a line.
struct Reader {
    text: String,
    lines: Vec<Heard>,
    looked: Time,
}

impl Reader {
    fn new() -> Self {
        Reader { text: String::new(), lines: Vec::new(), looked: Time::START }
    }

    fn take(&mut self, bytes: &[u8], before: Time) {
        let after = std::mem::replace(&mut self.looked, before);
        self.text.push_str(std::str::from_utf8(bytes).unwrap());
        while let Some(end) = self.text.find('\n') {
            let line: String = self.text.drain(..=end).collect();
            let (slot, valid) = line.trim_end().split_once(' ').unwrap();
            let valid = Time::from_nanos(valid.parse().unwrap());
            let (slot, length) = (slot.parse().unwrap(), line.len());
            self.lines.push(Heard { slot, valid, after, before, length });
        }
    }
}

/// Hands the list over for so long, and looks every millisecond what has come.
async fn overfill(
    host: &Host,
    output: &OutputPort,
    seconds: f64,
    mut hear: impl FnMut() -> Vec<u8>,
) -> (u64, Vec<Heard>) {
    let mut tick = interval(Duration::from_millis(1));
    tick.set_missed_tick_behavior(MissedTickBehavior::Skip);
    let (mut handed, mut reader, start) = (0, Reader::new(), host.time());
    let mut due = [Duration::ZERO; LIST.len()];
    loop {
        tick.tick().await;
        let now = host.time();
        reader.take(&hear(), now);
        let since = Duration::try_from_secs_f64((now - start).as_seconds()).unwrap();
        if since.as_secs_f64() > seconds {
            return (handed, reader.lines);
        }
        for (slot, (due, kind)) in due.iter_mut().zip(LIST).enumerate() {
            if since >= *due {
                let valid = start + Span::from_seconds(due.as_secs_f64());
                output.send(sentence(slot as u16, valid, kind));
                handed += 1;
                *due += kind.0;
            }
        }
    }
}

/// Nothing is too old, every slot got through, and no more came than the line carries. What is written to
/// this terminal is there at once: it came when the line started it.
fn assert_paced(lines: &[Heard], seconds: f64, bytes_per_second: f64) {
    let (mut worst, mut bytes, start) = (f64::MIN, 0, lines[0].after);
    for line in lines {
        let (period, _) = LIST[usize::from(line.slot)];
        let late = (line.after - line.valid).as_seconds() - period.as_secs_f64();
        worst = worst.max(late);
        assert!(late <= LOAD, "slot {} left {late} s too late", line.slot);
        let carried = ((line.before - start).as_seconds() + LEAD) * bytes_per_second;
        assert!(f64::from(bytes) <= carried, "{bytes} bytes where {carried} fit");
        bytes += line.length as u32;
    }
    let count = |slot| lines.iter().filter(|line| usize::from(line.slot) == slot).count();
    let counts: Vec<usize> = (0..LIST.len()).map(count).collect();
    let share = f64::from(bytes) / (seconds * bytes_per_second);
    eprintln!(
        "left of each: {counts:?}, {:.0} % of the line; {:.1} ms were left of the period of the oldest",
        share * 100.0,
        -worst * 1e3
    );
    assert!(counts.iter().all(|count| *count >= 2), "each gets through: {counts:?}");
    assert!(share > 0.7, "the line is used");
}

fn assert_counts(status: &OutputStatus, handed: u64) {
    assert_eq!(status.sent + status.dropped + status.waiting, handed);
    assert!(status.dropped > handed / 2, "most were replaced");
    for (slot, (period, length)) in status.slots.iter().zip(LIST) {
        assert!(slot.sent > 0 && slot.dropped > 0 && slot.waiting <= 2);
        assert_eq!(slot.bytes, slot.sent * length as u64);
        let age = slot.age.unwrap();
        assert!(age.p50 <= age.p99 && age.p99 <= age.max && age.last <= age.max);
        // the last byte is reckoned to leave after the time that the sentence takes
        let own = length as f64 / 480.0;
        assert!(age.max.as_seconds() <= period.as_secs_f64() + own + LOAD, "{slot:?}");
        assert!(age.p50.as_seconds() >= own);
    }
}

#[tokio::test]
async fn at_4800_baud_an_overfull_list_leaves_fresh_and_each_sentence_gets_through() {
    const SECONDS: f64 = 6.0;
    let mut device = Device::new();
    let mut host = Host::new();
    let config =
        OutputConfig::new(Destination::Serial(Serial::new(device.path().to_owned(), 4800)));
    let capacity = config.capacity().unwrap();
    let output = host.spawn_output(1, config);
    host.opened(1).await;
    let (handed, lines) = overfill(&host, &output, SECONDS, || device.heard()).await;
    assert_paced(&lines, SECONDS, capacity);
    assert_counts(&output.status(), handed);
}

#[tokio::test]
async fn a_made_terminal_with_a_baud_rate_is_paced_as_a_serial_line() {
    const SECONDS: f64 = 3.0;
    let folder = tempfile::tempdir().unwrap();
    let link = folder.path().join("nmea");
    let mut host = Host::new();
    let pty = Pty { baud: Some(4800), ..Pty::new(link.clone()) };
    let config = OutputConfig::new(Destination::Pty(pty));
    let capacity = config.capacity().unwrap();
    let output = host.spawn_output(1, config);
    host.opened(1).await;
    let terminal = terminal(&link);
    let (handed, lines) = overfill(&host, &output, SECONDS, || heard_of(&terminal)).await;
    assert_paced(&lines, SECONDS, capacity);
    assert_counts(&output.status(), handed);
}

fn terminal(link: &Path) -> rustix::fd::OwnedFd {
    open(link, OFlags::RDONLY | OFlags::NOCTTY | OFlags::NONBLOCK, Mode::empty()).unwrap()
}

fn heard_of(terminal: &rustix::fd::OwnedFd) -> Vec<u8> {
    let mut bytes = vec![0; 4096];
    let count = rustix::io::read(terminal, &mut bytes).unwrap_or(0);
    bytes.truncate(count);
    bytes
}

#[tokio::test]
async fn an_epoch_leaves_in_the_order_in_which_it_was_handed_over() {
    const ORDER: [u16; 6] = [5, 0, 7, 2, 3, 1];
    let mut device = Device::new();
    let mut host = Host::new();
    let serial = Serial::new(device.path().to_owned(), 115_200);
    let output = host.spawn_output(1, OutputConfig::new(Destination::Serial(serial)));
    host.opened(1).await;
    let mut reader = Reader::new();
    for _ in 0..10 {
        let valid = host.time();
        for slot in ORDER {
            let (_, length) = LIST[usize::from(slot)];
            let period = Duration::from_secs(1 + u64::from(slot));
            output.send(sentence(slot, valid, (period, length)));
        }
        while output.status().waiting > 0 {
            sleep(Duration::from_millis(2)).await;
        }
    }
    while reader.lines.len() < 10 * ORDER.len() {
        reader.take(&device.heard(), host.time());
        sleep(Duration::from_millis(2)).await;
    }
    let slots: Vec<u16> = reader.lines.iter().map(|line| line.slot).collect();
    for epoch in slots.chunks(ORDER.len()) {
        assert_eq!(epoch, ORDER);
    }
    assert_eq!(output.dropped(), 0);
}

#[tokio::test]
async fn a_quick_line_is_not_held_up_by_the_timers() {
    // 5000 bytes take 54 ms at 921600 baud
    let mut device = Device::new();
    let mut host = Host::new();
    let serial = Serial::new(device.path().to_owned(), 921_600);
    let output = host.spawn_output(1, OutputConfig::new(Destination::Serial(serial)));
    host.opened(1).await;
    let start = host.time();
    for slot in 0..50 {
        output.send(host.message(slot, vec![b'x'; 100]));
    }
    let mut heard = 0;
    while heard < 5000 {
        sleep(Duration::from_millis(1)).await;
        heard += device.heard().len();
    }
    let took = host.time() - start;
    eprintln!("5000 bytes at 921600 baud took {:.1} ms", took.as_seconds() * 1e3);
    assert!(took.as_seconds() > 0.045, "no quicker than the line");
    assert_eq!(output.dropped(), 0);
}

/// Hands messages over from a thread that is none of the runtime, each valid at that moment, and gives
/// what became of them.
async fn quickness(destination: Destination) -> (Span, OutputStatus) {
    const MESSAGES: u64 = 300;
    let mut host = Host::new();
    let output = host.spawn_output(1, OutputConfig::new(destination));
    host.opened(1).await;
    let clock = host.surroundings.clock.clone();
    let engine = std::thread::spawn(move || {
        let mut longest = Span::ZERO;
        for _ in 0..MESSAGES {
            std::thread::sleep(Duration::from_millis(3));
            let (valid, period) = (clock.now().monotonic, Span::from_seconds(1.0));
            output.send(Outgoing { slot: 1, bytes: vec![b'x'; 60], valid, period });
            longest = longest.max(clock.now().monotonic - valid);
        }
        (longest, output)
    });
    let (longest, output) = tokio::task::spawn_blocking(|| engine.join().unwrap()).await.unwrap();
    while output.status().waiting > 0 {
        sleep(Duration::from_millis(2)).await;
    }
    assert_eq!(output.status().sent + output.dropped(), MESSAGES);
    (longest, output.status())
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn how_long_a_message_takes_until_it_is_written_is_told() {
    let folder = tempfile::tempdir().unwrap();
    let link: PathBuf = folder.path().join("nmea");
    let heard = std::net::UdpSocket::bind("127.0.0.1:0").unwrap();
    let device = Device::new();
    let destinations = [
        ("udp", Destination::Udp(UdpOutput::new(heard.local_addr().unwrap()))),
        ("made terminal", Destination::Pty(Pty::new(link.clone()))),
        // the time on the wire, 60 bytes, counts: 0.15 ms
        ("serial line", Destination::Serial(Serial::new(device.path().to_owned(), 4_000_000))),
    ];
    let reading = tokio::spawn(async move {
        loop {
            sleep(Duration::from_millis(5)).await;
            if link.exists() {
                heard_of(&terminal(&link));
            }
        }
    });
    for (name, destination) in destinations {
        let (longest, status) = quickness(destination).await;
        let age = status.slots[0].age.unwrap();
        let micros = |span: Span| span.as_nanos() / 1000;
        eprintln!(
            "{name}: {} sent; written after {} us in the median, 99 % within {} us, all within {} us; \
             handing over took {} us at most",
            status.sent,
            micros(age.p50),
            micros(age.p99),
            micros(age.max),
            micros(longest),
        );
    }
    reading.abort();
}
