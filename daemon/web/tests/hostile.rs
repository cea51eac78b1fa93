//! Requests that mean no good, over real sockets: none takes memory without bound, none keeps others from
//! being served, and none delays the engine.

#![allow(clippy::unwrap_used)] // helpers of tests are not seen as tests
#![allow(clippy::disallowed_methods)] // what is measured here is time

mod house;
mod scene;

use std::io::{Read, Write};
use std::net::{SocketAddr, TcpStream};
use std::time::{Duration, Instant};

use house::{House, TOKEN};
use insd_web::WebConfig;

/// Longest that a publication takes beside hostile clients, but for one in ten, as this test may itself
/// have to wait for a busy computer.
const PROMPT: Duration = Duration::from_millis(1);

fn published_promptly(house: &mut House, times: u32) {
    let mut all: Vec<Duration> = Vec::new();
    for _ in 0..times {
        let snapshot = house.show.next();
        let begun = Instant::now();
        house.publisher.publish(snapshot);
        all.push(begun.elapsed());
        std::thread::sleep(Duration::from_millis(5));
    }
    all.sort();
    let most = all[all.len() * 9 / 10];
    assert!(most < PROMPT, "{all:?}");
}

/// Resident memory of this process, bytes.
fn memory() -> usize {
    let text = std::fs::read_to_string("/proc/self/statm").unwrap();
    text.split(' ').nth(1).unwrap().parse::<usize>().unwrap() * 4096
}

#[test]
fn a_name_that_is_not_ours_is_refused() {
    let config =
        WebConfig { allowed_hosts: vec!["ins.ship.example".to_owned()], ..WebConfig::default() };
    let house = House::open(config);
    let ask = |head: &str| {
        house.raw(&format!("GET /api/v1/status HTTP/1.1\r\n{head}connection: close\r\n\r\n"))
    };
    for good in ["localhost:8470", "127.0.0.1", "[::1]:8470", "ins.ship.example"] {
        assert!(ask(&format!("host: {good}\r\n")).starts_with("HTTP/1.1 200"), "{good}");
    }
    for bad in ["host: evil.example\r\n", "host: a\r\nhost: localhost\r\n", ""] {
        let answer = ask(bad);
        assert!(answer.starts_with("HTTP/1.1 4"), "{bad}: {answer}");
        assert!(!answer.contains("heading"), "{bad}");
        let is_named = answer.contains("the key `hosts` of the section [web]");
        assert!(is_named || answer.starts_with("HTTP/1.1 400"), "{bad}: {answer}");
    }
    let line = "GET http://evil.example/api/v1/status HTTP/1.1\r\nhost: localhost\r\nconnection: close\r\n\r\n";
    assert!(house.raw(line).starts_with("HTTP/1.1 421"));
}

#[test]
fn nothing_outside_the_table_of_files_is_served() {
    let house = House::open(WebConfig::default());
    for path in [
        "/assets/../Cargo.toml",
        "/assets/..%2f..%2fCargo.toml",
        "/assets/%2e%2e/Cargo.toml",
        "/assets//etc/passwd",
        "/assets/%2fetc%2fpasswd",
        "/assets/app.js%00.svg",
        "/../../etc/passwd",
    ] {
        let answer = house.get(path);
        assert!(answer.starts_with("HTTP/1.1 404"), "{path}: {answer}");
    }
    assert!(house.get("/assets/app.js").contains("text/javascript"));
}

#[test]
fn browsers_are_told_to_trust_nothing_else() {
    let house = House::open(WebConfig::default());
    for path in ["/", "/api/v1/status", "/assets/app.js", "/no-such-thing", "/metrics"] {
        let answer = house.get(path).to_lowercase();
        assert!(answer.contains("content-security-policy: default-src 'self'"), "{path}: {answer}");
        assert!(answer.contains("frame-ancestors 'none'"), "{path}");
        assert!(answer.contains("x-content-type-options: nosniff"), "{path}");
        assert!(!answer.contains("access-control-allow"), "{path}");
    }
    assert!(house.get("/api/v1/status").contains("cache-control: no-store"));
}

#[test]
fn garbage_ends_the_connection_and_nothing_else() {
    let mut house = House::open(WebConfig::default());
    for garbage in [
        &b"\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03"[..],
        &[0_u8; 5000][..],
        &b"GET\r\n\r\n"[..],
        &b"GET / HTTP/9.9\r\nhost: localhost\r\n\r\n"[..],
        &b"POST / HTTP/1.1\r\nhost: localhost\r\ncontent-length: 99999999999999999999\r\n\r\n"[..],
        &b"POST / HTTP/1.1\r\nhost: localhost\r\ntransfer-encoding: chunked\r\n\r\nzzzz\r\n"[..],
    ] {
        let mut stream = house.connect();
        // the other side may have closed before all is written
        let _ = stream.write_all(garbage);
        let mut answer = Vec::new();
        let _ = stream.read_to_end(&mut answer);
        assert!(answer.len() < 4096);
    }
    published_promptly(&mut house, 20);
    assert!(house.get("/health").starts_with("HTTP/1.1 200"));
}

#[test]
fn endless_headers_and_large_bodies_are_cut_off() {
    let house = House::open(house::with_token());
    let before = memory();
    let mut stream = house.connect();
    let _ = stream.write_all(b"GET / HTTP/1.1\r\nhost: localhost\r\n");
    let line = format!("x-{}: {}\r\n", "a".repeat(100), "b".repeat(800));
    let mut sent = 0;
    while sent < 50_000_000 && stream.write_all(line.as_bytes()).is_ok() {
        sent += line.len();
    }
    assert!(sent < 50_000_000, "it reads for ever");
    let body = "x".repeat(200_000);
    let head = format!(
        "POST /api/v1/log-level HTTP/1.1\r\nhost: localhost\r\nauthorization: Bearer {TOKEN}\r\n\
         connection: close\r\ncontent-length: {}\r\n\r\n",
        body.len()
    );
    let answer = house.raw(&(head + &body));
    assert!(answer.is_empty() || answer.starts_with("HTTP/1.1 413"), "{answer}");
    assert!(memory().saturating_sub(before) < 20_000_000);
}

#[test]
fn who_trickles_a_request_is_cut_off() {
    let house = House::open(WebConfig::default());
    let mut stream = house.connect();
    let begun = Instant::now();
    stream.write_all(b"GET / HTTP/1.1\r\n").unwrap();
    stream.set_read_timeout(Some(Duration::from_millis(200))).unwrap();
    let mut buffer = [0; 256];
    loop {
        // a letter now and then does not buy more time
        let gone = stream.write_all(b"x").is_err();
        match stream.read(&mut buffer) {
            Ok(0) => break,
            Ok(_) => {}
            Err(fault) if fault.kind() == std::io::ErrorKind::WouldBlock && !gone => {}
            Err(_) => break,
        }
        assert!(begun.elapsed() < Duration::from_secs(15));
    }
    assert!(begun.elapsed() > Duration::from_secs(3));
}

#[test]
fn who_trickles_a_body_is_cut_off() {
    let house = House::open(house::with_token());
    let mut stream = house.connect();
    let head = format!(
        "POST /api/v1/log-level HTTP/1.1\r\nhost: localhost\r\nauthorization: Bearer {TOKEN}\r\n\
         connection: close\r\ncontent-length: 1000\r\n\r\n{{"
    );
    stream.write_all(head.as_bytes()).unwrap();
    let begun = Instant::now();
    let mut answer = String::new();
    stream.read_to_string(&mut answer).unwrap();
    assert!(answer.starts_with("HTTP/1.1 408"), "{answer}");
    assert!(begun.elapsed() < Duration::from_secs(15));
}

#[test]
fn clients_that_never_read_take_little_memory_and_delay_nobody() {
    let config = WebConfig { max_per_address: 600, ..WebConfig::default() };
    let mut house = House::open(config);
    published_promptly(&mut house, 5);
    let before = memory();
    let mut deaf: Vec<TcpStream> = Vec::new();
    for _ in 0..100 {
        let mut stream = house.connect();
        stream.write_all(b"GET /api/v1/stream HTTP/1.1\r\nhost: localhost\r\n\r\n").unwrap();
        deaf.push(stream);
    }
    for _ in 0..300 {
        house.publish();
        std::thread::sleep(Duration::from_millis(5));
    }
    published_promptly(&mut house, 100);
    let grown = memory().saturating_sub(before);
    assert!(grown < 20_000_000, "{grown} bytes more");
    assert!(house.get("/health").starts_with("HTTP/1.1 200"));
}

#[test]
fn a_host_with_silent_connections_without_end_keeps_no_other_from_the_page() {
    let house = House::open(WebConfig { max_clients: 40, ..WebConfig::default() });
    let mut silent = Vec::new();
    for _ in 0..100 {
        silent.push(house.connect());
    }
    let turned_away = |stream: &mut TcpStream| {
        let mut head = [0; 12];
        stream.read_exact(&mut head).is_ok_and(|()| &head == b"HTTP/1.1 503")
    };
    assert!(turned_away(&mut silent[16]), "the seventeenth of one address");
    // another address of this computer is served although the others still hold their places
    let socket = socket2::Socket::new(socket2::Domain::IPV4, socket2::Type::STREAM, None).unwrap();
    socket.bind(&SocketAddr::from(([127, 0, 0, 2], 0)).into()).unwrap();
    socket.connect(&house.address.into()).unwrap();
    socket.set_read_timeout(Some(Duration::from_secs(20))).unwrap();
    let mut other = TcpStream::from(socket);
    other.write_all(b"GET / HTTP/1.1\r\nhost: localhost\r\nconnection: close\r\n\r\n").unwrap();
    let mut answer = String::new();
    other.read_to_string(&mut answer).unwrap();
    assert!(answer.starts_with("HTTP/1.1 200"), "{answer}");
    // who says nothing at all is let go, and has his places again
    let mut first = silent.swap_remove(0);
    assert_eq!(first.read(&mut [0]).unwrap_or(0), 0);
    let begun = Instant::now();
    while !house.get("/").starts_with("HTTP/1.1 200") {
        assert!(begun.elapsed() < Duration::from_secs(20), "room does not come back");
        std::thread::sleep(Duration::from_millis(100));
    }
}

#[test]
fn five_hundred_clients_are_served_and_the_next_are_told_that_it_is_too_many() {
    let config = WebConfig { max_clients: 500, max_per_address: 500, ..WebConfig::default() };
    let mut house = House::open(config);
    house.publish();
    let mut clients: Vec<TcpStream> = Vec::new();
    for _ in 0..500 {
        let mut stream = house.connect();
        stream.write_all(b"GET /api/v1/stream?hz=10 HTTP/1.1\r\nhost: localhost\r\n\r\n").unwrap();
        clients.push(stream);
    }
    published_promptly(&mut house, 100);
    // until all have been taken the next one may still find room
    let begun = Instant::now();
    while !house.get("/health").starts_with("HTTP/1.1 503") {
        assert!(begun.elapsed() < Duration::from_secs(5), "{}", house.get("/health"));
    }
    for stream in &mut clients {
        let mut buffer = [0; 12];
        stream.read_exact(&mut buffer).unwrap();
        assert_eq!(&buffer, b"HTTP/1.1 200");
    }
    drop(clients);
    let begun = Instant::now();
    while !house.get("/health").starts_with("HTTP/1.1 200") {
        house.publish();
        assert!(begun.elapsed() < Duration::from_secs(5), "room does not come back");
    }
}
