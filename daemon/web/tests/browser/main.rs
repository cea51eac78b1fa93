//! The page in a browser: headless Chromium, driven by chromedriver.
//!
//! ```text
//! apt-get install --no-install-recommends chromium chromium-driver fonts-noto-cjk
//! cargo test -p insd-web --test browser -- --ignored
//! INSD_PICTURES=docs/page cargo test -p insd-web --test browser -- --ignored pictures
//! ```

#![allow(clippy::unwrap_used)] // helpers of tests are not seen as tests

mod camera;
mod docking;
mod driver;
mod language;
mod live;
mod look;
mod pictures;
#[path = "../recorded/mod.rs"]
mod recorded;
mod recordings;
#[path = "../scene/mod.rs"]
mod scene;

use driver::Browser;
use live::{Live, TOKEN};
use scene::Scene;
use serde_json::Value;

/// From the brightest to the dimmest.
const LIGHTS: [&str; 3] = ["day", "dusk", "night"];

/// Chooses an option.
fn choose(browser: &Browser, select: &str, option: &str) {
    browser.run(&format!(
        "const s = document.getElementById('{select}'); s.value = '{option}';
         s.dispatchEvent(new Event('change'))"
    ));
}

/// A browser that looks at a scene.
fn looking_at(scene: Scene) -> (Live, Browser) {
    let live = Live::new(scene);
    let browser = Browser::start();
    browser.size(1280, 900);
    browser.go(&live.url());
    browser.until("data come", || browser.text("#link") == "live");
    (live, browser)
}

#[test]
#[ignore = "needs chromium and chromedriver"]
fn the_heading_moves() {
    let (_live, browser) = looking_at(Scene::Underway);
    let heading = || browser.text("#rose .big");
    browser.until("a heading", || heading().ends_with('°'));
    let first = heading();
    browser.until("another heading", || heading() != first);
    let turned = browser.run("return document.querySelector('#rose g').getAttribute('transform')");
    assert!(turned.as_str().unwrap().starts_with("rotate("));
    assert!(browser.text("#mode-chip strong").contains("aided"));
}

#[test]
#[ignore = "needs chromium and chromedriver"]
fn what_the_position_lives_by_is_said_with_its_reason_and_only_when_it_is_known() {
    let hidden = |browser: &Browser| {
        browser.run("return document.getElementById('source').hidden") == Value::Bool(true)
    };
    let (_live, browser) = looking_at(Scene::Underway);
    browser.until("RTK", || browser.text("#source").starts_with("Lives by RTK: carrier phases"));
    assert!(browser.text("#source").ends_with("it has come"), "{}", browser.text("#source"));
    assert!(!hidden(&browser));
    let (_live, browser) = looking_at(Scene::Alignment);
    browser.until("nothing", || hidden(&browser));
}

#[test]
#[ignore = "needs chromium and chromedriver"]
fn an_alert_is_acknowledged_with_a_token_and_not_without() {
    let (_live, browser) = looking_at(Scene::Fault);
    let alarm = ".alert.alarm";
    browser.until("the alarm", || !browser.elements(".alert.alarm.unacknowledged").is_empty());
    let disabled = format!("return document.querySelector('{alarm} .acknowledge').disabled");
    assert_eq!(browser.run(&disabled), Value::Bool(true));
    browser.write("#token", "a wrong token, but long");
    browser.press("#token-save");
    browser.press(&format!("{alarm} .acknowledge"));
    browser.until("the refusal", || browser.text(alarm).contains("a token is needed"));
    browser.write("#token", TOKEN);
    browser.press("#token-save");
    browser.press(&format!("{alarm} .acknowledge"));
    browser.until("the answer", || !browser.elements(".alert.alarm.acknowledged").is_empty());
    assert!(browser.text("#say").contains("Position lost"));
}

#[test]
#[ignore = "needs chromium and chromedriver"]
fn the_page_comes_back_after_the_program_was_started_again() {
    let (mut live, browser) = looking_at(Scene::Underway);
    live.close();
    browser.until("the loss is told", || browser.text("#link") == "connection lost");
    assert!(browser.text("#lost").contains("Last data 08:17:"), "{}", browser.text("#lost"));
    assert_eq!(browser.run("return document.body.classList.contains('stale')"), Value::Bool(true));
    live.open();
    browser.until("it is back", || browser.text("#link") == "live");
    assert_eq!(browser.run("return document.body.classList.contains('stale')"), Value::Bool(false));
    assert_eq!(browser.run("return document.getElementById('lost').hidden"), Value::Bool(true));
}

#[test]
#[ignore = "needs chromium and chromedriver"]
fn what_is_old_never_looks_as_if_it_were_new() {
    let (live, browser) = looking_at(Scene::Underway);
    live.be_still(true);
    browser.until("the silence is told", || browser.text("#link") == "no new data");
    let faded = "return getComputedStyle(document.querySelector('main')).filter";
    assert_eq!(browser.run(faded), Value::String("grayscale(1)".to_owned()));
    assert!(browser.text("#lost").contains("Nothing below is the present"));
    assert_eq!(browser.text("#rose .big"), "–");
    assert!(browser.text("#mode-chip strong").contains("fault"));
    live.be_still(false);
    browser.until("it is new again", || browser.text("#link") == "live");
    assert_eq!(browser.run(faded), Value::String("none".to_owned()));
}

#[test]
#[ignore = "needs chromium and chromedriver"]
fn nobody_else_is_asked_for_anything_and_nothing_is_complained_of() {
    for scene in [Scene::Alignment, Scene::Underway, Scene::Fault] {
        let (live, browser) = looking_at(scene);
        for theme in LIGHTS {
            browser.run(&format!(
                "const s = document.getElementById('theme'); s.value = '{theme}';
                 s.dispatchEvent(new Event('change'))"
            ));
        }
        for button in ["#zoom-in", "#zoom-out", "#fit", "#follow"] {
            browser.press(button);
        }
        std::thread::sleep(std::time::Duration::from_secs(2));
        let complaints = browser.log("browser");
        assert!(complaints.is_empty(), "{complaints:?}");
        let mut asked = 0;
        for line in browser.log("performance") {
            let event: Value = serde_json::from_str(&line).unwrap();
            let message = &event["message"];
            if message["method"] == "Network.requestWillBeSent" {
                let url = message["params"]["request"]["url"].as_str().unwrap();
                assert!(url.starts_with(&live.url()) || url.starts_with("data:"), "{url}");
                asked += 1;
            }
        }
        assert!(asked > 10, "{asked} requests were seen");
    }
}

#[test]
#[ignore = "needs chromium and chromedriver"]
fn everything_that_can_be_reached_has_a_name() {
    let (_live, browser) = looking_at(Scene::Fault);
    browser.until("alerts", || !browser.elements(".alert .acknowledge").is_empty());
    browser.run(
        "document.querySelectorAll('button, input, select, a[href], [role=img], [role=region], ' +
            '[role=progressbar], nav').forEach((node) => {
            if (!node.closest('[hidden]') && node.getClientRects().length > 0) node.dataset.seen = '';
        })",
    );
    let all = browser.elements("[data-seen]");
    assert!(all.len() > 40);
    for element in all {
        let label = browser.label(&element);
        assert!(!label.trim().is_empty(), "no name: {element}");
    }
    let bare = "return [...document.querySelectorAll('table')].filter((table) => !table.caption
        || [...table.tHead.rows[0].cells].some((cell) => cell.scope !== 'col')).map((table) => table.id)";
    assert_eq!(browser.run(bare), serde_json::json!([]));
}

#[test]
#[ignore = "needs chromium and chromedriver"]
fn nothing_goes_beyond_the_edge_of_any_screen() {
    for scene in [Scene::Alignment, Scene::Fault] {
        let (_live, browser) = looking_at(scene);
        for width in [360, 768, 1280, 1920] {
            browser.size(width, 800);
            let wide = browser.run("return document.documentElement.scrollWidth");
            assert!(wide.as_u64().unwrap() <= u64::from(width), "{wide} at {width}");
        }
    }
}

#[test]
#[ignore = "needs chromium and chromedriver"]
fn words_can_be_told_from_their_ground_in_every_light() {
    let (_live, browser) = looking_at(Scene::Fault);
    browser.until("alerts", || !browser.elements(".alert .acknowledge").is_empty());
    for view in ["page", "bridge", "docking"] {
        choose(&browser, "view", view);
        for light in LIGHTS {
            choose(&browser, "theme", light);
            let faint = browser.run(include_str!("contrast.js"));
            assert_eq!(faint, serde_json::json!([]), "{light}, {view}: contrast below 4.5");
        }
    }
}

#[test]
#[ignore = "needs chromium and chromedriver"]
fn unknown_is_a_dash() {
    let (publisher, viewer) = insd_web::channel();
    let (sender, _orders) = insd_web::orders::channel();
    let listener = std::net::TcpListener::bind(("127.0.0.1", 0)).unwrap();
    let listen = insd_web::Listen::Inherited(listener);
    let config = insd_web::WebConfig { listen, ..Default::default() };
    let page = insd_web::start(config, viewer, sender).unwrap();
    let publish = || publisher.publish(insd_web::snapshot::Snapshot::default());
    let browser = Browser::start();
    browser.go(&format!("http://{}/", page.address()));
    browser.until("data come", || {
        publish();
        browser.text("#link") == "no motion"
    });
    let known = "return [...document.querySelectorAll('#ship [data-bind].num')]
        .map((node) => node.textContent).filter((text) => text !== '–')";
    browser.until("a picture", || browser.text("#rose .big") == "–");
    assert_eq!(browser.run(known), serde_json::json!([]));
    assert!(browser.log("browser").is_empty());
}
