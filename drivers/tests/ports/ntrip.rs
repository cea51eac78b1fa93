//! A caster over loopback, with all that can be wrong with it.

use std::fs;
use std::os::unix::fs::PermissionsExt;

use insd_base::PortState;
use insd_drivers::ports::{Ntrip, PortHandle, Transport};
use tokio::io::{AsyncReadExt, AsyncWriteExt};
use tokio::net::{TcpListener, TcpStream};

use crate::host::Host;

/// 1005 of a published example (RTCM 10403, 4.2).
pub(crate) const FRAME: [u8; 25] = [
    0xD3, 0x00, 0x13, 0x3E, 0xD7, 0xD3, 0x02, 0x02, 0x98, 0x0E, 0xDE, 0xEF, 0x34, 0xB4, 0xBD, 0x62,
    0xAC, 0x09, 0x41, 0x98, 0x6F, 0x33, 0x36, 0x0B, 0x98,
];
pub(crate) const FIRST: &[u8] = b"ICY 200 OK\r\n\r\n";
const SECOND: &[u8] = b"HTTP/1.1 200 OK\r\nNtrip-Version: Ntrip/2.0\r\nContent-Type: gnss/data\r\n\
                        Transfer-Encoding: chunked\r\n\r\n";

/// A caster and a port that calls it.
struct Scene {
    caster: TcpListener,
    host: Host,
    port: PortHandle,
}

impl Scene {
    async fn new(change: impl FnOnce(Ntrip) -> Ntrip) -> Self {
        let caster = TcpListener::bind("127.0.0.1:0").await.unwrap();
        let address = caster.local_addr().unwrap().to_string();
        let host = Host::new();
        let config = change(Ntrip::new(address, "BASE".to_owned()));
        let port = host.spawn(1, Transport::Ntrip(config));
        Scene { caster, host, port }
    }

    /// The next call, and what is asked.
    async fn call(&self) -> (TcpStream, String) {
        let (mut stream, _) = self.caster.accept().await.unwrap();
        let mut asked = Vec::new();
        while !asked.ends_with(b"\r\n\r\n") {
            asked.push(stream.read_u8().await.unwrap());
        }
        (stream, String::from_utf8(asked).unwrap())
    }

    /// Answers the next call and closes it; gives what was asked.
    async fn answer(&self, answer: &[u8]) -> String {
        let (mut stream, asked) = self.call().await;
        stream.write_all(answer).await.unwrap();
        asked
    }

    /// Waits until the port says that it is absent or lost, in these words among others.
    async fn told(&mut self, words: &str) {
        let is_it = |state: &PortState| match state {
            PortState::Absent { reason } | PortState::Lost { reason } => reason.contains(words),
            _ => false,
        };
        self.host.state(1, is_it).await;
    }

    /// A good caster answers the next call: the port recovers.
    async fn recovers(&mut self) {
        let (mut stream, _) = self.call().await;
        stream.write_all(&[FIRST, &FRAME[..]].concat()).await.unwrap();
        self.host.bytes(1, &FRAME).await;
    }
}

#[tokio::test]
async fn casters_of_both_versions_are_listened_to() {
    let mut scene = Scene::new(|own| own).await;
    let (mut stream, asked) = scene.call().await;
    assert!(asked.starts_with("GET /BASE HTTP/1.1\r\n"), "{asked}");
    stream.write_all(SECOND).await.unwrap();
    for part in FRAME.chunks(7) {
        let chunk = [format!("{:x}\r\n", part.len()).as_bytes(), part, b"\r\n"].concat();
        stream.write_all(&chunk).await.unwrap();
    }
    scene.host.bytes(1, &FRAME).await;
    let states = scene.host.states(Some(1));
    assert!(states[0].contains("NTRIP 2, chunked"), "{states:?}");
    stream.write_all(b"0\r\n\r\n").await.unwrap();
    scene.told("the caster ends the stream").await;

    let mut scene = Scene::new(|own| Ntrip { version: 1, ..own }).await;
    let (mut stream, asked) = scene.call().await;
    assert!(asked.starts_with("GET /BASE HTTP/1.0\r\n"), "{asked}");
    stream.write_all(&[FIRST, &FRAME[..]].concat()).await.unwrap();
    scene.host.bytes(1, &FRAME).await;
}

#[tokio::test]
async fn each_refusal_is_told_in_its_own_words_and_recovered_from() {
    let table = b"SOURCETABLE 200 OK\r\n\r\nSTR;NORTH;x\r\nSTR;SOUTH;x\r\nENDSOURCETABLE\r\n";
    let page = b"HTTP/1.1 200 OK\r\nContent-Type: text/html\r\n\r\n<html>";
    let cases: [(&[u8], &str); 9] = [
        (table, "there is no mount point BASE: the caster has NORTH, SOUTH"),
        (b"HTTP/1.1 404 Not Found\r\n\r\n", "there is no mount point BASE"),
        (b"HTTP/1.1 401 Unauthorized\r\n\r\n", "user or password refused"),
        (b"ERROR - Bad Password", "user or password refused"),
        (b"HTTP/1.1 503 Too busy\r\n\r\n", "503 Too busy"),
        (page, "a web page comes in place of a stream"),
        (b"", "closed by the caster without an answer"),
        (b"\x00\x01\xFFrubbish", "that is no NTRIP caster"),
        (b"HTTP/1.1 200 OK\r\nTransfer-Encoding: chunked\r\n\r\nzz\r\n", "chunks"),
    ];
    for (answer, words) in cases {
        let mut scene = Scene::new(|own| own).await;
        scene.answer(answer).await;
        scene.told(words).await;
        scene.recovers().await;
    }
}

#[tokio::test]
async fn streams_that_are_silent_slow_or_rubbish_or_drop_are_given_up_and_called_again() {
    let cases: [(Vec<u8>, &str); 4] = [
        // half open: the call is taken, and nothing is ever said
        (Vec::new(), "no whole answer in 1 s"),
        (FIRST.to_vec(), "nothing for 1 s"),
        ([FIRST, &FRAME[..]].concat(), "too slow: 25 bytes in 1 s"),
        ([FIRST, &[b'x'; 500][..]].concat(), "no RTCM 3 in 1 s"),
    ];
    for (said, words) in cases {
        let mut scene = Scene::new(|own| Ntrip { timeout_s: 1.0, ..own }).await;
        let (mut held, _) = scene.call().await;
        held.write_all(&said).await.unwrap();
        scene.told(words).await;
        scene.recovers().await;
    }
    let mut scene = Scene::new(|own| own).await;
    let (mut dropped, _) = scene.call().await;
    dropped.write_all(&[FIRST, &FRAME.repeat(3)[..]].concat()).await.unwrap();
    scene.host.bytes(1, &FRAME).await;
    drop(dropped);
    scene.told("closed by the other end").await;
    scene.recovers().await;
}

#[tokio::test]
async fn a_password_goes_to_the_caster_and_nowhere_else() {
    let dir = tempfile::tempdir().unwrap();
    let file = dir.path().join("caster");
    fs::write(&file, "tOpSecret\n").unwrap();
    let allow = |mode| fs::set_permissions(&file, fs::Permissions::from_mode(mode)).unwrap();
    allow(0o644);
    let (user, password_file) = (Some("ship".to_owned()), Some(file.clone()));
    let mut scene = Scene::new(|own| Ntrip { user, password_file, ..own }).await;
    scene.told("others can read it (mode 0644)").await;
    allow(0o600);
    let asked = scene.answer(b"HTTP/1.1 401 Unauthorized\r\n\r\n").await;
    assert!(asked.contains("Authorization: Basic c2hpcDp0T3BTZWNyZXQ=\r\n"), "{asked}");
    scene.told("user or password refused").await;
    scene.recovers().await;
    let states = scene.host.states(None).join("\n");
    assert!(!states.contains("tOpSecret") && !states.contains("c2hp"), "{states}");
}

#[tokio::test]
async fn the_caster_is_told_where_the_ship_is_only_if_that_is_asked_for() {
    let mut scene = Scene::new(|own| Ntrip { gga_s: 10.0, ..own }).await;
    let gga = b"$GPGGA,120000.00,5330.0,N,00806.0,E,1,08,1.0,5.0,M,45.0,M,,*42\r\n".to_vec();
    assert!(scene.port.offer(scene.host.message(0, gga.clone())));
    let (mut stream, _) = scene.call().await;
    stream.write_all(FIRST).await.unwrap();
    scene.host.opened(1).await;
    let mut told = vec![0; gga.len()];
    stream.read_exact(&mut told).await.unwrap();
    assert_eq!(told, gga);

    let scene = Scene::new(|own| own).await;
    assert!(!scene.port.offer(scene.host.message(0, gga)));
}
