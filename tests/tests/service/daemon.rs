//! The daemon as a process, with a service manager that hears what it says.

use std::io::{Read, Write};
use std::net::{SocketAddr, TcpStream};
use std::os::unix::net::UnixDatagram;
use std::path::PathBuf;
use std::process::{Child, Command, Stdio};
use std::time::Duration;

use insd::clock::Clock;
use rustix::process::{Pid, Signal, kill_process};

use super::ship::Ship;

/// The program: the one named by `INSD_PROGRAM`, or that which the tests of the workspace build.
fn program() -> PathBuf {
    if let Some(named) = std::env::var_os("INSD_PROGRAM") {
        return named.into();
    }
    let own = std::env::current_exe().unwrap();
    let program = own.ancestors().nth(2).unwrap().join("insd");
    assert!(program.exists(), "cargo build -p insd comes first");
    program
}

/// A running daemon; killed when this is dropped.
pub(crate) struct Daemon {
    child: Child,
    /// What it says to the service manager.
    manager: UnixDatagram,
    log: PathBuf,
}

impl Daemon {
    /// Starts it as systemd would.
    pub(crate) fn start(ship: &Ship) -> Self {
        let socket = ship.path().join("notify");
        let _ = std::fs::remove_file(&socket);
        let manager = UnixDatagram::bind(&socket).unwrap();
        manager.set_read_timeout(Some(Duration::from_millis(50))).unwrap();
        let [memory, disk] = ship.folders();
        let log = std::fs::File::options()
            .create(true)
            .append(true)
            .open(ship.path().join("log"))
            .unwrap();
        let child = Command::new(program())
            .args(["run", "--config"])
            .arg(ship.config())
            .env("NOTIFY_SOCKET", &socket)
            .env("WATCHDOG_USEC", "2000000")
            .env("RUNTIME_DIRECTORY", memory)
            .env("STATE_DIRECTORY", disk)
            .env_remove("RUST_LOG")
            .stdout(Stdio::null())
            .stderr(log)
            .spawn()
            .unwrap();
        Daemon { child, manager, log: ship.path().join("log") }
    }

    pub(crate) fn signal(&self, signal: Signal) {
        kill_process(Pid::from_child(&self.child), signal).unwrap();
    }

    /// Ends it without a warning.
    pub(crate) fn kill(mut self) {
        self.child.kill().unwrap();
        self.child.wait().unwrap();
    }

    /// Tells it to stop, and waits until it has.
    pub(crate) fn stop(mut self) {
        self.signal(Signal::TERM);
        assert!(self.child.wait().unwrap().success());
    }

    pub(crate) fn is_running(&mut self) -> bool {
        self.child.try_wait().unwrap().is_none()
    }

    /// What it said to the service manager since the last look.
    pub(crate) fn said(&self) -> Vec<String> {
        let mut buffer = [0; 4096];
        let mut said = Vec::new();
        while let Ok(length) = self.manager.recv(&mut buffer) {
            let text = String::from_utf8_lossy(&buffer[..length]).into_owned();
            said.extend(text.lines().map(str::to_owned));
        }
        said
    }

    /// Waits until it has said something.
    pub(crate) fn wait_for(&self, wanted: &str) -> Vec<String> {
        let mut said = Vec::new();
        wait_until(wanted, || {
            said.extend(self.said());
            said.iter().any(|line| line.contains(wanted))
        });
        said
    }
}

impl Drop for Daemon {
    fn drop(&mut self) {
        if std::thread::panicking() {
            println!("{}", std::fs::read_to_string(&self.log).unwrap_or_default());
        }
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// Waits until something holds, as long as a busy machine may need.
pub(crate) fn wait_until(what: &str, mut holds: impl FnMut() -> bool) {
    let clock = Clock::start();
    while !holds() {
        assert!(clock.elapsed() < Duration::from_secs(60), "never: {what}");
        std::thread::sleep(Duration::from_millis(20));
    }
}

/// The body of an answer of the page; `None` if there is none.
pub(crate) fn get(page: SocketAddr, path: &str) -> Option<String> {
    let mut stream = TcpStream::connect(page).ok()?;
    stream.set_read_timeout(Some(Duration::from_secs(5))).ok()?;
    write!(stream, "GET {path} HTTP/1.1\r\nHost: {page}\r\nConnection: close\r\n\r\n").ok()?;
    let mut answer = String::new();
    stream.read_to_string(&mut answer).ok()?;
    let (head, body) = answer.split_once("\r\n\r\n")?;
    head.starts_with("HTTP/1.1 200").then(|| body.to_owned())
}

/// The state of the daemon as its page tells it.
pub(crate) fn status(page: SocketAddr) -> Option<serde_json::Value> {
    serde_json::from_str(&get(page, "/api/v1/status")?).ok()
}
