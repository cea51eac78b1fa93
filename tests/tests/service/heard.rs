//! What the daemon sends: attitudes with their sigmas.

use std::net::UdpSocket;
use std::time::Duration;

use insd::clock::Clock;
use insd_base::Time;
use insd_base::units::{DEG, wrap_pi};

use super::ship::Ship;

/// One attitude that was sent.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Attitude {
    /// When it was valid, on the time line of the voyage.
    pub(crate) at: Time,
    /// Heading minus the true one, rad.
    pub(crate) error: f64,
    /// What is claimed of it, 1-sigma, rad.
    pub(crate) sigma: f64,
}

/// Throws away what was sent until now.
pub(crate) fn forget(output: &UdpSocket) {
    let mut buffer = [0; 2048];
    output.set_nonblocking(true).unwrap();
    while output.recv(&mut buffer).is_ok() {}
    output.set_nonblocking(false).unwrap();
}

/// The attitudes that are sent in so many seconds.
pub(crate) fn attitudes(ship: &Ship, seconds: f64) -> Vec<Attitude> {
    let clock = Clock::start();
    let mut all = Vec::new();
    while clock.elapsed().as_secs_f64() < seconds {
        all.extend(next(ship));
    }
    all
}

/// How long it takes until a heading is sent.
pub(crate) fn first_heading(ship: &Ship, patience: Duration) -> Option<Duration> {
    let clock = Clock::start();
    while clock.elapsed() < patience {
        let Some(text) = datagram(ship) else { continue };
        let heading = |line: &str| {
            let fields = line.strip_prefix('$')?.split(',');
            let mut fields = fields.skip_while(|address| !address.ends_with("HDT"));
            fields.nth(1)?.parse::<f64>().ok()
        };
        if text.lines().any(|line| heading(line).is_some()) {
            return Some(clock.elapsed());
        }
    }
    None
}

fn datagram(ship: &Ship) -> Option<String> {
    let mut buffer = [0; 2048];
    let length = ship.output.recv(&mut buffer).ok()?;
    Some(String::from_utf8_lossy(&buffer[..length]).into_owned())
}

fn next(ship: &Ship) -> Option<Attitude> {
    let text = datagram(ship)?;
    text.lines().filter(|line| line.starts_with("$PASHR")).find_map(|line| parse(ship, line))
}

/// `$PASHR,hhmmss.sss,heading,T,roll,pitch,heave,roll std,pitch std,heading std,...`
fn parse(ship: &Ship, line: &str) -> Option<Attitude> {
    let fields: Vec<&str> = line.split(',').collect();
    let number = |index: usize| fields.get(index)?.parse::<f64>().ok();
    let (heading, sigma) = (number(2)? * DEG, number(9)? * DEG);
    let clock = fields.get(1)?;
    let part = |range: std::ops::Range<usize>| clock.get(range)?.parse::<f64>().ok();
    let seconds = clock.get(4..)?.parse::<f64>().ok()?;
    let at = ship.time_of(part(0..2)? * 3600.0 + part(2..4)? * 60.0 + seconds);
    Some(Attitude { at, error: wrap_pi(heading - ship.heading(at)), sigma })
}
