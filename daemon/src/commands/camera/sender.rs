//! The tracks of images as sentences, `$PINSD,TRK`, to a socket or a file.

use std::fs::File;
use std::io::{BufWriter, Write};
use std::net::{Ipv6Addr, ToSocketAddrs, UdpSocket};
use std::path::Path;

use anyhow::Context;
use insd_base::{CameraFrame, ImagePoint};
use insd_config::BadInput;
use insd_wire::nmea::{Pinsd, PinsdTracks, TRACK_NUMBERS, TrackedPoint};

/// What goes into one datagram, bytes: no network on board cuts it.
const DATAGRAM: usize = 1400;
/// Times of the sentences begin anew after so long, s.
const TURN: f64 = 1e6;

/// Where sentences go.
pub(super) struct TrackSender {
    socket: Option<UdpSocket>,
    file: Option<BufWriter<File>>,
    /// Datagrams that could not be sent: nobody listens, or the network is down.
    lost: u64,
    fault: Option<std::io::Error>,
}

impl TrackSender {
    /// Opens what is asked for.
    pub(super) fn open(address: Option<&str>, file: Option<&Path>) -> anyhow::Result<Self> {
        let socket = address.map(connected).transpose()?;
        let create = |path: &Path| File::create(path).with_context(|| path.display().to_string());
        let file = file.map(create).transpose()?.map(BufWriter::new);
        Ok(TrackSender { socket, file, lost: 0, fault: None })
    }

    /// Tells an image. A receiver that is not there costs its datagrams.
    pub(super) fn tell(&mut self, frame: &CameraFrame) {
        if self.socket.is_none() && self.file.is_none() {
            return;
        }
        let lines = sentences(frame);
        if let Some(file) = &mut self.file {
            self.fault = self.fault.take().or(file.write_all(&lines.concat()).err());
        }
        if let Some(socket) = &self.socket {
            let sent = datagrams(&lines).into_iter().map(|own| socket.send(&own));
            self.lost += sent.filter(Result::is_err).count() as u64;
        }
    }

    /// All is written, or why not.
    pub(super) fn finish(mut self) -> anyhow::Result<()> {
        if self.lost > 0 {
            eprintln!("insd: {} datagrams could not be sent", self.lost);
        }
        let flushed = self.file.as_mut().map_or(Ok(()), Write::flush);
        self.fault.map_or(flushed, Err).context("cannot write the sentences")
    }
}

fn connected(address: &str) -> anyhow::Result<UdpSocket> {
    let unknown = || BadInput(format!("--send {address}: expected HOST:PORT of a UDP port"));
    let place =
        address.to_socket_addrs().ok().and_then(|mut all| all.next()).ok_or_else(unknown)?;
    let own =
        if place.is_ipv4() { "0.0.0.0".to_owned() } else { Ipv6Addr::UNSPECIFIED.to_string() };
    let socket = UdpSocket::bind((own.as_str(), 0)).context("cannot open a socket")?;
    socket.connect(place).with_context(|| address.to_owned())?;
    Ok(socket)
}

/// The sentences of an image.
fn sentences(frame: &CameraFrame) -> Vec<Vec<u8>> {
    let point = |own: &ImagePoint| TrackedPoint {
        track: (own.track % u64::from(TRACK_NUMBERS)) as u32,
        at: own.at.into(),
    };
    let points: Vec<TrackedPoint> = frame.points.iter().map(point).collect();
    let told = PinsdTracks::of_image(frame.time.as_seconds().rem_euclid(TURN), &points);
    told.into_iter().map(|own| Pinsd::Tracks(own).write().as_bytes().to_vec()).collect()
}

/// Sentences together, as many as go into one datagram.
fn datagrams(lines: &[Vec<u8>]) -> Vec<Vec<u8>> {
    let mut all: Vec<Vec<u8>> = Vec::new();
    for line in lines {
        match all.last_mut().filter(|last| last.len() + line.len() <= DATAGRAM) {
            Some(last) => last.extend(line),
            None => all.push(line.clone()),
        }
    }
    all
}

#[cfg(test)]
mod tests {
    use insd_base::Time;
    use nalgebra::Vector2;

    use super::*;

    fn frame() -> CameraFrame {
        let point = |track: u64| ImagePoint { track, at: Vector2::new(track as f64, 0.5) };
        let points = (0..200).map(point).collect();
        CameraFrame { time: Time::from_seconds(2_000_012.5), points }
    }

    #[test]
    fn an_image_goes_in_few_datagrams_and_to_the_socket_as_to_the_file() {
        let desk = tempfile::tempdir().unwrap();
        let path = desk.path().join("tracks.nmea");
        let ear = UdpSocket::bind("127.0.0.1:0").unwrap();
        ear.set_read_timeout(Some(std::time::Duration::from_secs(5))).unwrap();
        let address = ear.local_addr().unwrap().to_string();
        let mut sender = TrackSender::open(Some(&address), Some(&path)).unwrap();
        sender.tell(&frame());
        sender.finish().unwrap();
        let written = std::fs::read(path).unwrap();
        assert!(written.starts_with(b"$PINSD,TRK,12.500,1,34,0,0.00,0.50,1,1.00,0.50,"));
        let mut heard: Vec<u8> = Vec::new();
        let mut buffer = [0; 2000];
        while heard.len() < written.len() {
            let count = ear.recv(&mut buffer).unwrap();
            assert!(count <= DATAGRAM);
            heard.extend(&buffer[..count]);
        }
        assert_eq!(heard, written);
    }

    #[test]
    fn an_address_that_is_none_is_bad_input() {
        assert!(TrackSender::open(Some("nowhere"), None).is_err());
    }
}
