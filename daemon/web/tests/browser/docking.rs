//! The docking view.

use std::time::Duration;

use serde_json::{Value, json};

use crate::driver::Browser;
use crate::live::{Live, TOKEN};
use crate::scene::Scene;
use crate::{choose, looking_at};

/// A browser that looks at the docking view.
fn docking(scene: Scene) -> (Live, Browser) {
    let (live, browser) = looking_at(scene);
    choose(&browser, "view", "docking");
    (live, browser)
}

/// All texts of the view at one instant, by their names.
fn texts(browser: &Browser) -> Value {
    browser.run(
        "return Object.fromEntries([...document.querySelectorAll('[id^=d-]')]
            .map((node) => [node.id, node.textContent]))",
    )
}

/// The texts of a view that has drawn the last word and does not hold it for old yet: a busy
/// machine may look too late, and then the ship goes on for another try.
fn drawn(live: &Live, browser: &Browser) -> Value {
    let mut shown = Value::Null;
    browser.until("a look in time", || {
        live.be_still(false);
        browser.until("it is valid", || browser.text("#d-state") == "valid");
        live.be_still(true);
        std::thread::sleep(Duration::from_millis(200));
        shown = texts(browser);
        shown["d-state"] == "valid"
    });
    shown
}

/// A number as the view has it: no sign of minus but its own, no thin spaces.
fn number(shown: &Value, id: &str) -> f64 {
    shown[id].as_str().unwrap().replace('−', "-").parse().unwrap()
}

/// What the interface tells of the berth.
fn told(live: &Live) -> Value {
    let text = ureq::get(format!("{}api/v1/status", live.url())).call().unwrap();
    let whole: Value = serde_json::from_str(&text.into_body().read_to_string().unwrap()).unwrap();
    whole["docking"].clone()
}

#[test]
#[ignore = "needs chromium and chromedriver"]
fn the_numbers_on_the_docking_view_are_those_of_the_solution() {
    let (live, browser) = docking(Scene::Underway);
    browser.until("a distance", || browser.text("#d-bow-distance").len() > 3);
    let shown = drawn(&live, &browser);
    let own = told(&live);
    for part in ["bow", "stern", "manifold"] {
        let tell = |key: &str| own[part][key].as_f64().unwrap();
        let (distance, closing) = (
            number(&shown, &format!("d-{part}-distance")),
            number(&shown, &format!("d-{part}-closing")),
        );
        let digits = if distance < 10.0 { 0.005_1 } else { 0.051 };
        assert!((distance - tell("distance_m")).abs() < digits, "{part}: {distance} {own}");
        assert!((closing - tell("closing_mps").abs()).abs() < 0.005_1, "{part}: {closing} {own}");
        assert_eq!(shown[format!("d-{part}-way")], "closing");
        let sure = shown[format!("d-{part}-sure")].as_str().unwrap();
        assert!(
            sure.contains("0.060") && sure.contains(&format!("level {:.2} m", tell("level_m"))),
            "{sure}"
        );
    }
    let angle = number(&shown, "d-angle");
    assert!((angle - own["angle_deg"].as_f64().unwrap().abs()).abs() < 0.051);
    let contact = number(&shown, "d-contact-speed");
    assert!((contact - own["contact"]["speed_mps"].as_f64().unwrap()).abs() < 0.005_1);
    assert_eq!(shown["d-contact-part"], "stern");
    assert_eq!(shown["d-name"], "Pier 3");
}

#[test]
#[ignore = "needs chromium and chromedriver"]
fn the_docking_view_moves_at_least_five_times_a_second() {
    let (_live, browser) = docking(Scene::Underway);
    browser.until("a distance", || browser.text("#d-bow-distance").len() > 3);
    browser.run(
        "window.seen = 0;
         const node = document.getElementById('d-plan').querySelector('.d-hull');
         new MutationObserver(() => { window.seen += 1; }).observe(node, { attributes: true });",
    );
    // a busy machine gives a second now and then, not each
    browser.until("fifteen in three seconds", || {
        browser.run("window.seen = 0");
        std::thread::sleep(Duration::from_secs(3));
        browser.run("return window.seen").as_u64() >= Some(15)
    });
}

#[test]
#[ignore = "needs chromium and chromedriver"]
fn what_is_not_valid_is_called_so_and_shows_no_number() {
    let bare =
        "return [...document.querySelectorAll('#docking .num')].map((node) => node.textContent)
        .filter((text) => text !== '–')";
    for (scene, why) in [
        (Scene::Fault, "the sensors contradict each other"),
        (Scene::Alignment, "the heading is not known yet"),
    ] {
        let (_live, browser) = docking(scene);
        browser.until("the reason", || browser.text("#d-why") == why);
        assert_eq!(browser.text("#d-state"), "not valid");
        assert_eq!(browser.run(bare), json!([]));
    }
    let (live, browser) = docking(Scene::Underway);
    browser.until("it is valid", || browser.text("#d-state") == "valid");
    live.be_still(true);
    browser.until("it is old", || browser.text("#d-why") == "what is shown is not new");
    browser.until("it is gone", || browser.run(bare) == json!([]));
    assert_eq!(browser.text("#d-state"), "not valid");
}

#[test]
#[ignore = "needs chromium and chromedriver"]
fn a_berth_is_chosen_with_a_token_and_not_without() {
    let (_live, browser) = docking(Scene::Underway);
    let disabled = "return document.getElementById('d-berth').disabled";
    browser.until("berths", || browser.elements("#d-berth option").len() == 3);
    assert_eq!(browser.run(disabled), Value::Bool(true));
    choose(&browser, "view", "page");
    browser.write("#token", TOKEN);
    browser.press("#token-save");
    choose(&browser, "view", "docking");
    browser.until("it can be chosen", || browser.run(disabled) == Value::Bool(false));
    choose(&browser, "d-berth", "Ölhafen 2");
    browser.until("it is chosen", || browser.text("#d-name") == "Ölhafen 2");
    assert!(browser.text("#d-choice").starts_with("chosen"));
    choose(&browser, "d-berth", "");
    browser.until("the nearest", || browser.text("#d-choice").starts_with("the nearest"));
}

#[test]
#[ignore = "needs chromium and chromedriver"]
fn the_docking_view_is_one_screen_with_large_figures_and_nothing_is_cut_off() {
    let (_live, browser) = docking(Scene::Underway);
    let cut = "return [...document.querySelectorAll('#docking .d-value dd, #docking .d-sure, #docking h2')].filter((node) => {
        const tile = (node.closest('.d-tile') ?? document.body).getBoundingClientRect();
        const range = document.createRange();
        range.selectNodeContents(node);
        const own = range.getBoundingClientRect();
        return own.width > 0 && (own.right > tile.right + 1 || own.bottom > tile.bottom + 1);
    }).map((node) => node.textContent)";
    for (width, height) in [(1920, 1080), (1280, 720), (1024, 768), (390, 844)] {
        browser.size(width, height);
        std::thread::sleep(Duration::from_millis(400));
        assert_eq!(browser.run(cut), json!([]), "{width} x {height}");
        let wide = browser.run("return document.documentElement.scrollWidth").as_u64().unwrap();
        assert!(wide <= u64::from(width), "{wide} at {width}");
        if width > 700 {
            let high =
                browser.run("return document.documentElement.scrollHeight").as_u64().unwrap();
            assert!(high <= u64::from(height), "{high} at {height}");
        }
    }
    browser.size(1920, 1080);
    let letters = |id: &str| {
        let script = format!(
            "return parseFloat(getComputedStyle(document.getElementById('{id}')).fontSize)"
        );
        browser.run(&script).as_f64().unwrap()
    };
    for id in ["d-bow-distance", "d-bow-closing", "d-stern-distance", "d-stern-closing", "d-angle"]
    {
        assert!(letters(id) >= 90.0, "{id}: {} px", letters(id));
    }
}
