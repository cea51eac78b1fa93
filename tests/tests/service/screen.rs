//! Everything that shows the ship, through twelve faults: what is older than a second is shown by none of them
//! as if it were the present.
//!
//! A made-up ship is published, something goes wrong, and after two seconds it is looked what each of
//! them shows: the interface as JSON, its stream, the metrics, the terminal in its three forms, and the page
//! in a browser. Her numbers change all the time: a number that is shown must be one of the last second.

use std::collections::VecDeque;
use std::io::{BufRead, BufReader};
use std::net::TcpListener;
use std::sync::Arc;
use std::time::Duration;

use insd::clock::Clock;
use insd::monitor::{self, Board, MonitorView};
use insd_web::snapshot::{ShownMotion, Snapshot};
use insd_web::{Listen, Publisher, WebConfig, WebHandle};
use ratatui::Terminal;
use ratatui::backend::TestBackend;
use serde_json::Value;

use super::driver::Browser;
use super::scene::faults::Trouble;
use super::scene::{STEP, Scene, Show};

/// How long after the beginning of a fault it is looked, s: a log of 2 Hz is silent after a second and a half.
/// And what the way to a screen may take, s.
const LOOKED: f64 = 2.0;
const WAY: f64 = 0.4;

/// What one of them shows.
#[derive(Debug)]
struct Shown {
    who: &'static str,
    /// Numbers of heading, roll and speed, whichever it shows.
    numbers: [Option<f64>; 3],
    /// Its words for what the ship does, and whether all is well.
    mode: String,
    is_well: Option<bool>,
    /// What it shows of the sensor that is lost: its state, and its rate.
    row: Option<[String; 2]>,
}

/// A ship that is published, and what was told of her in the last second.
struct Stage {
    publisher: Publisher,
    web: Option<WebHandle>,
    url: String,
    show: Show,
    clock: Clock,
    trouble: Trouble,
    began: Option<f64>,
    last: Snapshot,
    told: VecDeque<(f64, [f64; 3])>,
}

fn numbers(motion: &ShownMotion) -> [f64; 3] {
    [motion.heading_deg, motion.roll_deg, motion.speed_kn].map(Option::unwrap_or_default)
}

impl Stage {
    fn open(trouble: Trouble) -> Self {
        let listener = TcpListener::bind(("127.0.0.1", 0)).unwrap();
        let url = format!("http://{}", listener.local_addr().unwrap());
        let (publisher, viewer) = insd_web::channel();
        let (sender, _) = insd_web::orders::channel();
        let config = WebConfig { listen: Listen::Inherited(listener), ..WebConfig::default() };
        let web = Some(insd_web::start(config, viewer, sender).unwrap());
        let mut show = Show::new(Scene::Underway);
        let last = show.next();
        let (clock, told) = (Clock::start(), VecDeque::new());
        Stage { publisher, web, url, show, clock, trouble, began: None, last, told }
    }

    fn now(&self) -> f64 {
        self.clock.elapsed().as_secs_f64()
    }

    /// Publishes ten times a second for so long; with the fault once that has begun.
    fn play(&mut self, seconds: f64) {
        let end = self.now() + seconds;
        while self.now() < end {
            let next = self.show.next();
            let next = match self.began {
                Some(began) => self.trouble.strike(next, &self.last, self.now() - began),
                None => {
                    self.last = next.clone();
                    Some(next)
                }
            };
            let now = self.now();
            if let Some(next) = next {
                let is_new = self.began.is_none() || self.trouble.leaves_motion();
                if let Some(motion) = next.motion.as_ref().filter(|_| is_new) {
                    self.told.push_back((now, numbers(motion)));
                }
                self.publisher.publish(next);
            }
            while self.told.front().is_some_and(|(at, _)| now - at > 1.0 + WAY) {
                self.told.pop_front();
            }
            std::thread::sleep(Duration::from_secs_f64(STEP));
        }
    }

    fn begin(&mut self) {
        self.began = Some(self.now());
        if self.trouble == Trouble::ConnectionLost {
            drop(self.web.take());
        }
    }

    /// Everything that one of them shows is true, and of the last second.
    fn judge(&self, shown: &Shown) {
        let Shown { who, numbers, mode, is_well, row } = shown;
        let what = format!("{who}, {:?}: {shown:?}", self.trouble);
        if self.trouble.leaves_motion() {
            assert!(numbers[0].is_some(), "nothing is shown: {what}");
            assert_eq!((mode.as_str(), *is_well != Some(false)), ("aided", true), "{what}");
        } else {
            assert_eq!(*numbers, [None; 3], "{what}");
            assert!(!["aided", "dead reckoning"].contains(&mode.as_str()), "{what}");
            assert!(*is_well != Some(true), "{what}");
        }
        for (index, number) in numbers.iter().enumerate() {
            let Some(number) = number else { continue };
            let is_it = |(_, own): &(f64, [f64; 3])| (own[index] - number).abs() < 0.051;
            assert!(self.told.iter().any(is_it), "{number} is old: {what}\n{:?}", self.told);
        }
        if let Some([state, rate]) = row {
            assert!(["silent", "unknown"].contains(&state.as_str()), "{what}");
            assert_eq!(rate, "", "{what}");
        }
    }
}

/// The first number of a text, if it begins with one.
fn number(text: &str) -> Option<f64> {
    let text = text.trim_start().replace('−', "-");
    let end = text.find(|c: char| !"+-.0123456789".contains(c)).unwrap_or(text.len());
    text.get(..end)?.parse().ok()
}

/// What follows a word in a text, as a number.
fn behind(text: &str, word: &str) -> Option<f64> {
    number(text.split_once(word)?.1)
}

fn of_json(who: &'static str, told: &Value, lost: Option<&str>) -> Shown {
    let motion = &told["motion"];
    let is_fresh = motion["freshness"] == "fresh";
    let of = |name: &str| motion[name].as_f64();
    let of_sensors = told["sensors"].as_array();
    let own = |name: &str| of_sensors?.iter().find(|row| row["name"] == name);
    let row = lost.and_then(own).map(|row| {
        let rate = row["rate_hz"].as_f64().map(|rate| rate.to_string());
        [row["state"].as_str().unwrap_or_default().to_owned(), rate.unwrap_or_default()]
    });
    Shown {
        who,
        numbers: ["heading_deg", "roll_deg", "speed_kn"].map(of),
        mode: told["mode"]["name"].as_str().unwrap_or_default().replace('_', " "),
        is_well: Some(is_fresh),
        row,
    }
}

fn asked(url: &str) -> Option<String> {
    ureq::get(url).call().ok()?.body_mut().read_to_string().ok()
}

/// The first event of the stream.
fn streamed(url: &str) -> Option<Value> {
    let answer = ureq::get(&format!("{url}/api/v1/stream")).call().ok()?;
    let lines = BufReader::new(answer.into_body().into_reader()).lines();
    let data =
        lines.map_while(Result::ok).find_map(|line| line.strip_prefix("data: ").map(str::to_owned));
    serde_json::from_str(&data?).ok()
}

fn measured(text: &str, lost: Option<&str>) -> Shown {
    let of = |name: &str| behind(text, &format!("\ninsd_{name} "));
    let mode = text.split_once("insd_mode{mode=\"").map_or("", |(_, rest)| rest);
    let rate = |name: &str| behind(text, &format!("insd_sensor_rate_hertz{{sensor=\"{name}\"}} "));
    let state = |name: &str| {
        let head = format!("insd_sensor_state{{sensor=\"{name}\",state=\"");
        text.split_once(&head).and_then(|(_, rest)| rest.split_once('"')).map(|(word, _)| word)
    };
    Shown {
        who: "metrics",
        numbers: ["heading_degrees", "roll_degrees", "speed_knots"].map(of),
        mode: mode.split('"').next().unwrap_or_default().replace('_', " "),
        is_well: of("navigating").map(|navigating| navigating == 1.0),
        row: lost.map(|name| {
            let rate = rate(name).map(|rate| rate.to_string());
            [state(name).unwrap_or_default().to_owned(), rate.unwrap_or_default()]
        }),
    }
}

fn drawn(board: &Board) -> String {
    let mut terminal = Terminal::new(TestBackend::new(100, 44)).unwrap();
    terminal.draw(|frame| monitor::draw(frame, board, "http://ship", MonitorView::Ship)).unwrap();
    let buffer = terminal.backend().buffer();
    let row = |y| (0..100).map(move |x| buffer[(x, y)].symbol()).collect::<String>();
    (0..44).map(|y| row(y) + "\n").collect()
}

fn of_terminal(picture: &str) -> Shown {
    let banner = picture.lines().nth(1).unwrap_or_default().trim().to_lowercase();
    let mode = banner.split("  ").next().unwrap_or_default().to_owned();
    let of = |name: &str| behind(picture, &format!(" {name}"));
    let numbers = ["Heading", "Roll", "Speed"].map(of);
    Shown { who: "monitor", numbers, mode, is_well: None, row: None }
}

fn of_text(who: &'static str, text: &str, snapshot: &Snapshot) -> Shown {
    let of = |name: &str| behind(text, name);
    // a line of text has no room for the word
    let bare = || number(text.split_once(" kn")?.0.rsplit(' ').next()?);
    let speed = if text.contains("speed ") { of("speed ") } else { bare() };
    Shown {
        who,
        numbers: [of("heading "), of("roll "), speed],
        mode: snapshot.mode.name.replace('_', " "),
        is_well: Some(snapshot.is_navigating()),
        row: None,
    }
}

/// All that ask the program itself, and the terminal that has followed it.
fn all_shown(stage: &Stage, board: &Board) -> Vec<Shown> {
    let (url, lost) = (&stage.url, stage.trouble.lost_sensor());
    let mut all = Vec::new();
    if let Some(text) = asked(&format!("{url}/api/v1/status")) {
        let told: Value = serde_json::from_str(&text).unwrap();
        all.push(of_json("JSON", &told, lost));
        // as `insd monitor --once` has it
        let snapshot: Snapshot = serde_json::from_str(&text).unwrap();
        all.push(of_text("monitor --once", &monitor::summary(&snapshot), &snapshot));
    }
    all.extend(streamed(url).map(|told| of_json("stream", &told, lost)));
    all.extend(asked(&format!("{url}/metrics")).map(|text| measured(&text, lost)));
    all.push(of_terminal(&drawn(board)));
    let snapshot = board.snapshot().unwrap();
    all.push(of_text("monitor --plain", &monitor::line(&snapshot), &snapshot));
    let expected = if stage.web.is_some() { 6 } else { 2 };
    assert_eq!(all.len(), expected, "{:?}: {all:?}", stage.trouble);
    all
}

fn walk(trouble: Trouble) {
    let mut stage = Stage::open(trouble);
    stage.play(0.5);
    let board = Arc::new(Board::default());
    monitor::Client::new(&stage.url).follow(Arc::clone(&board)).unwrap();
    stage.play(1.0);
    assert!(drawn(&board).contains("AIDED"), "{}", drawn(&board));
    stage.begin();
    stage.play(LOOKED);
    for shown in all_shown(&stage, &board) {
        stage.judge(&shown);
    }
}

#[test]
fn in_twelve_faults_no_number_older_than_a_second_is_shown_as_the_present() {
    let all = Trouble::ALL.map(|trouble| std::thread::spawn(move || walk(trouble)));
    for (trouble, thread) in Trouble::ALL.into_iter().zip(all) {
        assert!(thread.join().is_ok(), "{trouble:?}");
    }
}

/// The page as it is seen.
fn of_page(browser: &Browser, lost: Option<&str>) -> Shown {
    let text = |selector: &str| number(&browser.text(selector));
    let bound = |path: &str| text(&format!("#ship [data-bind=\"{path}\"]"));
    let script = format!(
        "const row = [...document.querySelectorAll('#sensor-table tbody tr')]
             .find((row) => row.cells[0].firstChild.textContent === '{}');
         return row ? [1, 3].map((k) => row.cells[k].textContent.replace('–', '')) : null",
        lost.unwrap_or_default()
    );
    let cells = browser.run(&script);
    let cell = |index: usize| cells[index].as_str().unwrap_or_default().to_owned();
    Shown {
        who: "page",
        numbers: [text("#rose .big"), bound("motion.roll_deg"), bound("motion.speed_kn")],
        mode: browser.text("#mode-chip strong"),
        is_well: Some(browser.text("#link") == "live"),
        row: cells.is_array().then(|| [cell(0), cell(1)]),
    }
}

#[test]
#[ignore = "needs chromium and chromedriver"]
fn in_a_browser_too_no_number_older_than_a_second_is_shown_as_the_present() {
    let browser = Browser::start();
    for trouble in Trouble::ALL {
        let mut stage = Stage::open(trouble);
        stage.play(0.3);
        browser.go(&format!("{}/", stage.url));
        stage.play(1.5);
        assert_eq!(browser.text("#link"), "live");
        stage.begin();
        stage.play(LOOKED);
        // while it is looked the ship sails on
        let shown = std::thread::scope(|scope| {
            let looking = scope.spawn(|| of_page(&browser, trouble.lost_sensor()));
            while !looking.is_finished() {
                stage.play(STEP);
            }
            looking.join().unwrap()
        });
        stage.judge(&shown);
        browser.run("localStorage.clear()");
    }
}
