//! The interface as programs use it, over real sockets.

#![allow(clippy::unwrap_used)] // helpers of tests are not seen as tests
#![allow(clippy::disallowed_methods)] // what is measured here is time

mod house;
mod recorded;
mod scene;

use std::collections::{BTreeMap, BTreeSet};
use std::io::{BufRead, BufReader, Write};
use std::net::SocketAddr;
use std::process::Command;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use insd_languages::Language;
use insd_web::snapshot::{SensorState, ShownAlertState, Snapshot};
use insd_web::{Listen, WebConfig, WebError};

use house::{House, TOKEN, body, with_token};
use recorded::{REPORTER, record};
use scene::{Scene, Show};
use serde_json::Value;

/// The description of the interface.
const PAGE: &str = include_str!("../../../docs/api.md");

/// Runs a scene on a thread of its own while something is asked.
fn while_it_runs(house: &mut House, ask: impl FnOnce(SocketAddr) + Send) {
    let done = AtomicBool::new(false);
    let address = house.address;
    std::thread::scope(|scope| {
        scope.spawn(|| {
            let _done = Done(&done);
            ask(address);
        });
        while !done.load(Ordering::Relaxed) {
            house.publish();
            std::thread::sleep(Duration::from_millis(100));
        }
    });
}

/// Tells that something is over, also when it failed.
struct Done<'a>(&'a AtomicBool);

impl Drop for Done<'_> {
    fn drop(&mut self) {
        self.0.store(true, Ordering::Relaxed);
    }
}

/// Names of all fields of a value, at any depth.
fn fields(value: &Value, all: &mut BTreeSet<String>) {
    match value {
        Value::Object(map) => {
            for (name, value) in map {
                all.insert(name.clone());
                fields(value, all);
            }
        }
        Value::Array(list) => list.iter().for_each(|value| fields(value, all)),
        _ => {}
    }
}

#[test]
fn what_is_published_is_what_is_read() {
    for scene in [Scene::Alignment, Scene::Underway, Scene::Fault] {
        let house = House::showing(scene, WebConfig::default());
        let sent = Show::new(scene).next();
        // until it is read before it has grown older
        let read = loop {
            house.publisher.publish(sent.clone());
            std::thread::sleep(Duration::from_millis(60));
            let answer = house.get("/api/v1/status");
            let read: Snapshot = serde_json::from_str(body(&answer)).unwrap();
            if read.time.told_ago_s == 0.0 {
                break read;
            }
        };
        // once through JSON, whose reader may be off by the last bit of a number
        let sent = serde_json::to_string(&sent.after(0.0)).unwrap();
        assert!(read == serde_json::from_str(&sent).unwrap(), "{scene:?}");
    }
}

#[test]
fn every_field_is_described() {
    let mut all = BTreeSet::new();
    for scene in [Scene::Alignment, Scene::Underway, Scene::Fault] {
        fields(&serde_json::to_value(Show::new(scene).next()).unwrap(), &mut all);
    }
    let silent: Vec<_> = all.iter().filter(|name| !PAGE.contains(&format!("`{name}`"))).collect();
    assert!(silent.is_empty(), "docs/api.md does not tell of {silent:?}");
    let house = House::open(WebConfig::default());
    assert_eq!(body(&house.get("/api/v1/schema")), PAGE);
}

#[test]
fn readers_of_this_version_bear_what_later_ones_add_or_leave_out() {
    let text = r#"{ "version": 1, "a_field_to_come": [1], "alerts": [{ "id": 7, "priority": "to_come" }] }"#;
    let read: Snapshot = serde_json::from_str(text).unwrap();
    assert_eq!(read.alerts[0].id, 7);
    assert_eq!(read.alerts[0].state, ShownAlertState::Unknown);
    assert_eq!(read.motion, None);
}

#[test]
fn unknown_is_null_and_never_zero() {
    let snapshot = Snapshot {
        motion: Some(insd_web::snapshot::ShownMotion {
            roll_deg: Some(f64::NAN),
            ..Default::default()
        }),
        ..Snapshot::default()
    };
    let value = serde_json::to_value(snapshot).unwrap();
    assert_eq!(value["motion"]["heading_deg"], Value::Null);
    assert_eq!(value["motion"]["roll_deg"], Value::Null);
    assert_eq!(value["alignment"], Value::Null);
}

#[test]
fn the_stream_begins_with_all_and_goes_on_with_what_changes() {
    let mut house = House::open(WebConfig::default());
    while_it_runs(&mut house, |address| {
        let mut stream = std::net::TcpStream::connect(address).unwrap();
        stream.write_all(b"GET /api/v1/stream?hz=10 HTTP/1.1\r\nhost: localhost\r\n\r\n").unwrap();
        let begun = Instant::now();
        let mut events = Vec::new();
        for line in BufReader::new(stream).lines().map_while(Result::ok) {
            if let Some(name) = line.strip_prefix("event: ") {
                events.push(name.to_owned());
            }
            if let Some(data) = line.strip_prefix("data: ") {
                let value: Value = serde_json::from_str(data).unwrap();
                assert!(value["motion"]["heading_deg"].is_number());
            }
            if begun.elapsed() > Duration::from_secs(3) {
                break;
            }
        }
        let whole = events.iter().filter(|name| *name == "snapshot").count();
        assert_eq!(events.first().map(String::as_str), Some("snapshot"));
        assert!((3..=4).contains(&whole), "{events:?}");
        assert!((20..=31).contains(&events.len()), "{events:?}");
    });
    assert!(house.get("/api/v1/stream?hz=50").starts_with("HTTP/1.1 400"));
}

#[test]
fn the_stream_tells_at_once_that_a_sensor_has_fallen_silent() {
    let mut house = House::open(WebConfig::default());
    let stream = house.connect();
    let mut asking = stream.try_clone().unwrap();
    asking.write_all(b"GET /api/v1/stream?hz=10 HTTP/1.1\r\nhost: localhost\r\n\r\n").unwrap();
    let mut events = BufReader::new(stream).lines().map_while(Result::ok);
    let mut next = || events.find_map(|line| line.strip_prefix("event: ").map(str::to_owned));
    assert_eq!(next().as_deref(), Some("snapshot"));
    std::thread::sleep(Duration::from_millis(110));
    house.publish();
    assert_eq!(next().as_deref(), Some("live"), "nothing has changed");
    std::thread::sleep(Duration::from_millis(110));
    let mut silent = house.show.next();
    silent.sensors[0].state = SensorState::Silent;
    house.publisher.publish(silent);
    assert_eq!(next().as_deref(), Some("snapshot"));
}

#[test]
fn health_ends_when_the_engine_publishes_no_more() {
    let mut house = House::open(WebConfig::default());
    house.publish();
    assert!(house.get("/health").starts_with("HTTP/1.1 200"));
    std::thread::sleep(Duration::from_millis(2400));
    assert!(house.get("/health").starts_with("HTTP/1.1 503"));
    assert!(house.get("/metrics").contains("insd_publishing 0.0"));
    // what is known stays to be seen
    assert!(house.get("/api/v1/status").starts_with("HTTP/1.1 200"));
}

/// Names of metrics in a text.
fn metrics(text: &str) -> BTreeSet<String> {
    let words = text.split(|own: char| !own.is_ascii_alphanumeric() && own != '_');
    let named = words.filter(|word| word.starts_with("insd_") && !word.ends_with('_'));
    named.map(|name| name.trim_end_matches("_total").to_owned()).collect()
}

#[test]
fn every_metric_that_a_page_of_docs_a_dashboard_or_a_rule_names_is_told() {
    let mut told = BTreeSet::new();
    for scene in [Scene::Alignment, Scene::Underway, Scene::Fault] {
        let house = House::showing(scene, WebConfig::default());
        told.extend(metrics(body(&house.get("/metrics"))));
    }
    let section = PAGE.split("## Metrics").nth(1).unwrap().split("## Fields").next().unwrap();
    for text in [
        section,
        include_str!("../../../contrib/grafana/insd.json"),
        include_str!("../../../contrib/prometheus/insd.rules.yml"),
        include_str!("../../../contrib/prometheus/insd.test.yml"),
    ] {
        let unknown: Vec<String> = metrics(text).difference(&told).cloned().collect();
        assert!(unknown.is_empty(), "{unknown:?} are not among {told:?}");
    }
}

#[test]
fn recordings_are_listed_and_fetched_and_nothing_else_of_the_disk() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("insd-000001.insdraw"), "recorded").unwrap();
    std::fs::write(folder.path().join("secret"), "token").unwrap();
    let recordings = Some(folder.path().to_owned());
    let house = House::open(WebConfig { recordings, ..WebConfig::default() });
    let listed: Value = serde_json::from_str(body(&house.get("/api/v1/recordings"))).unwrap();
    assert_eq!(
        (&listed[0]["name"], listed.as_array().unwrap().len()),
        (&"insd-000001.insdraw".into(), 1)
    );
    assert_eq!(listed[0]["bytes"], 8);
    let fetched = house.get("/api/v1/recordings/insd-000001.insdraw");
    assert!(fetched.contains("attachment; filename=\"insd-000001.insdraw\""), "{fetched}");
    assert_eq!(body(&fetched), "recorded");
    for name in ["secret", "..%2Fsecret", "insd-000002.insdraw", "%2e%2e%2fsecret.insdraw"] {
        let answer = house.get(&format!("/api/v1/recordings/{name}"));
        assert!(answer.starts_with("HTTP/1.1 404"), "{name}: {answer}");
    }
    let without = House::open(WebConfig::default());
    assert!(without.get("/api/v1/recordings").starts_with("HTTP/1.1 404"));
}

/// A page over one recording whose reports this script makes.
fn with_reporter(script: &str) -> (House, tempfile::TempDir) {
    let folder = tempfile::tempdir().unwrap();
    record(folder.path(), script);
    let (recordings, reporter) = (Some(folder.path().to_owned()), Some(REPORTER.into()));
    (House::open(WebConfig { recordings, reporter, ..WebConfig::default() }), folder)
}

/// Asks until it is not in the making any more.
fn report(house: &House, query: &str) -> String {
    let path = format!("/api/v1/recordings/insd-000001.insdraw/report{query}");
    loop {
        let answer = house.get(&path);
        if !answer.starts_with("HTTP/1.1 202") {
            return answer;
        }
        std::thread::sleep(Duration::from_millis(20));
    }
}

#[test]
fn a_report_is_made_by_another_process_and_told_when_it_is_there() {
    let (house, folder) = with_reporter(r#"echo "$4 $6 ${10} ${HOME:-alone}" > "$8""#);
    let path = "/api/v1/recordings/insd-000001.insdraw/report?language=ja";
    assert!(house.get(path).starts_with("HTTP/1.1 202"));
    let told = report(&house, "?language=ja");
    let recording = folder.path().join("insd-000001.insdraw");
    assert_eq!(body(&told).trim(), format!("ja 1 {} alone", recording.display()));
    assert!(told.contains("content-type: text/html") && told.contains("default-src 'none'"));
    assert!(body(&report(&house, "")).starts_with("en "), "of another language it is another");
    assert!(body(&report(&house, "?run=3")).starts_with("en 3 "));
    assert!(report(&house, "?run=0").starts_with("HTTP/1.1 400"));
    assert!(report(&house, "?language=xx").starts_with("HTTP/1.1 400"));
    let none = house.get("/api/v1/recordings/insd-000002.insdraw/report");
    assert!(none.starts_with("HTTP/1.1 404"), "{none}");
}

#[test]
fn a_report_that_fails_says_why_and_may_be_asked_for_again() {
    let (house, folder) =
        with_reporter("echo working >&2; echo 'error: nothing in it' >&2; exit 2");
    let told = report(&house, "");
    assert!(told.starts_with("HTTP/1.1 500"), "{told}");
    assert!(body(&told).contains("the report cannot be made: error: nothing in it"), "{told}");
    record(folder.path(), r#"echo done > "$8""#);
    assert_eq!(body(&report(&house, "")).trim(), "done");
}

#[test]
fn one_report_is_made_after_the_other() {
    let (house, folder) = with_reporter(r#"read line < "${10%/*}/go"; echo done > "$8""#);
    let pipe = folder.path().join("go");
    assert!(Command::new("mkfifo").arg(&pipe).status().unwrap().success());
    std::fs::write(folder.path().join("insd-000002.insdraw"), "recorded").unwrap();
    let other = "/api/v1/recordings/insd-000002.insdraw/report";
    assert!(house.get("/api/v1/recordings/insd-000001.insdraw/report").starts_with("HTTP/1.1 202"));
    assert!(house.get(other).starts_with("HTTP/1.1 503"));
    std::fs::write(&pipe, "go\n").unwrap();
    assert_eq!(body(&report(&house, "")).trim(), "done");
    assert!(house.get(other).starts_with("HTTP/1.1 202"));
}

#[test]
fn before_the_first_snapshot_there_is_nothing_to_show() {
    let (_publisher, viewer) = insd_web::channel();
    let (sender, _orders) = insd_web::orders::channel();
    let listen = Listen::Address(([127, 0, 0, 1], 0).into());
    let config = WebConfig { listen, ..WebConfig::default() };
    let page = insd_web::start(config, viewer, sender).unwrap();
    for path in ["health", "api/v1/status", "metrics"] {
        let url = format!("http://{}/{path}", page.address());
        assert!(matches!(ureq::get(&url).call(), Err(ureq::Error::StatusCode(503))), "{path}");
    }
}

#[test]
fn track_and_history_are_kept_for_pages_that_are_loaded_later() {
    let mut house = House::open(WebConfig::default());
    for _ in 0..20 {
        house.publisher.publish(house.show.skip());
        std::thread::sleep(Duration::from_millis(70));
    }
    let track: Value = serde_json::from_str(body(&house.get("/api/v1/track"))).unwrap();
    let history: Value = serde_json::from_str(body(&house.get("/api/v1/history"))).unwrap();
    assert!(track["lat_deg"].as_array().unwrap().len() >= 3);
    assert!(history["sigma_heading_deg"].as_array().unwrap().len() >= 15);
}

#[test]
fn without_a_token_nothing_can_be_changed() {
    let mut house = House::open(WebConfig::default());
    for path in
        ["/api/v1/alerts/10001/acknowledge", "/api/v1/alerts/10001/silence", "/api/v1/log-level"]
    {
        assert!(house.post(path, None, "").starts_with("HTTP/1.1 403"));
        assert!(house.post(path, Some(TOKEN), "").starts_with("HTTP/1.1 403"));
    }
    assert!(house.orders.poll().is_none());
    let why = r#"{"enabled":false,"why":"no token is configured"}"#;
    assert_eq!(body(&house.get("/api/v1/orders")), why);
}

#[test]
fn who_has_the_token_can_acknowledge_and_who_has_not_cannot() {
    let mut house = House::showing(Scene::Fault, with_token());
    while_it_runs(&mut house, |address| {
        let agent: ureq::Agent =
            ureq::Agent::config_builder().http_status_as_error(false).build().into();
        let post = |path: &str, token: &str, body: &str| {
            let url = format!("http://{address}/api/v1/{path}");
            let request = agent.post(&url).header("Authorization", &format!("Bearer {token}"));
            request.send(body).unwrap().status().as_u16()
        };
        assert_eq!(post("alerts/10001/acknowledge", "wrong", ""), 401);
        assert_eq!(post("alerts/10001/acknowledge", TOKEN, "{\"instance\":null}"), 204);
        assert_eq!(post("alerts/10001/acknowledge", TOKEN, ""), 409);
        assert_eq!(post("alerts/10002/silence", TOKEN, ""), 204);
        assert_eq!(post("alerts/99/silence", TOKEN, ""), 409);
        assert_eq!(post("alerts/x/silence", TOKEN, ""), 400);
        assert_eq!(post("log-level", TOKEN, "{\"level\":\"insd=debug\"}"), 204);
        assert_eq!(post("log-level", TOKEN, "{\"level\":\"a b\"}"), 400);
        assert_eq!(post("log-level", TOKEN, "nonsense"), 400);
        for _ in 0..12 {
            post("log-level", "guess", "");
        }
        assert_eq!(post("log-level", TOKEN, "{\"level\":\"info\"}"), 429);
    });
    let state = |id| {
        let snapshot: Snapshot = serde_json::from_str(body(&house.get("/api/v1/status"))).unwrap();
        snapshot.alerts.iter().find(|alert| alert.id == id).unwrap().state
    };
    assert_eq!(
        (state(10_001), state(10_002)),
        (ShownAlertState::Acknowledged, ShownAlertState::Silenced)
    );
}

#[test]
fn an_engine_that_does_not_answer_is_told_of() {
    let house = House::open(with_token());
    let answer = house.post("/api/v1/log-level", Some(TOKEN), "{\"level\":\"info\"}");
    assert!(answer.starts_with("HTTP/1.1 504"), "{answer}");
}

#[test]
fn files_are_sent_again_only_when_they_have_changed() {
    let house = House::open(WebConfig::default());
    let answer = house.get("/");
    let tag = answer.lines().find_map(|line| line.strip_prefix("etag: ")).unwrap();
    let again = format!(
        "GET / HTTP/1.1\r\nhost: localhost\r\nif-none-match: {tag}\r\nconnection: close\r\n\r\n"
    );
    assert!(house.raw(&again).starts_with("HTTP/1.1 304"));
}

#[test]
fn with_a_token_that_could_be_guessed_the_page_is_read_only_and_says_why() {
    let short = "fifteen letters";
    let token = Some(short.to_owned());
    let house = House::open(WebConfig { token, ..WebConfig::default() });
    assert!(house.get("/").starts_with("HTTP/1.1 200"));
    assert!(house.get("/api/v1/status").starts_with("HTTP/1.1 200"));
    let why = "the token has 15 characters, 16 is the least";
    assert!(house.get("/api/v1/orders").contains(why));
    let answer = house.post("/api/v1/log-level", Some(short), "{\"level\":\"info\"}");
    assert!(answer.starts_with("HTTP/1.1 403") && answer.contains(why), "{answer}");
}

#[test]
fn the_texts_of_each_language_are_there_and_the_interface_speaks_english() {
    let house = House::open(WebConfig { language: Language::Japanese, ..WebConfig::default() });
    let told: Value = serde_json::from_str(body(&house.get("/api/v1/texts"))).unwrap();
    assert_eq!(told["configured"], "ja");
    assert_eq!(told["languages"][1]["name"], "日本語");
    let keys = ["en", "ja"].map(|code| {
        let texts = house.get(&format!("/api/v1/texts/{code}"));
        let texts: BTreeMap<String, String> = serde_json::from_str(body(&texts)).unwrap();
        texts.into_keys().collect::<Vec<_>>()
    });
    assert_eq!(keys[0], keys[1]);
    assert!(keys[0].iter().all(|key| !key.starts_with("check.") && !key.starts_with("report.")));
    assert!(house.get("/api/v1/texts/fr").starts_with("HTTP/1.1 404"));
    assert!(house.get("/api/v1/status").contains("GNSS is used"));
}

#[test]
fn an_address_that_another_has_is_taken_as_soon_as_it_is_free_and_one_that_is_forbidden_refused() {
    let start = |address| {
        let (_publisher, viewer) = insd_web::channel();
        let (sender, _orders) = insd_web::orders::channel();
        let config = WebConfig { listen: Listen::Address(address), ..WebConfig::default() };
        insd_web::start(config, viewer, sender)
    };
    let other = std::net::TcpListener::bind(("127.0.0.1", 0)).unwrap();
    let address = other.local_addr().unwrap();
    let page = start(address).unwrap();
    assert_eq!(page.address(), address);
    drop(other);
    let begun = Instant::now();
    while std::net::TcpStream::connect(address).is_err() {
        assert!(begun.elapsed() < Duration::from_secs(10), "the page never came");
        std::thread::sleep(Duration::from_millis(50));
    }
    // an address of a link, without saying which
    let astray = "[fe80::1]:8470".parse().unwrap();
    assert!(matches!(start(astray), Err(WebError::Bind { .. })));
}

#[test]
fn the_page_ends_at_once_although_clients_hang_on() {
    let mut house = House::open(WebConfig::default());
    let mut stream = house.connect();
    stream.write_all(b"GET /api/v1/stream HTTP/1.1\r\nhost: localhost\r\n\r\n").unwrap();
    house.publish();
    std::thread::sleep(Duration::from_millis(200));
    let begun = Instant::now();
    drop(house.handle.take());
    assert!(begun.elapsed() < Duration::from_secs(1));
}
