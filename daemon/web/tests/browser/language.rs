//! The page in another language.

use insd_languages::Language;
use serde_json::json;

use crate::driver::Browser;
use crate::live::Live;
use crate::scene::{Scene, Show};
use crate::{LIGHTS, choose, looking_at};

/// Sizes of a phone, of a smaller one, and of screens of a bridge.
const SCREENS: [[u32; 2]; 5] = [[390, 844], [360, 740], [1920, 1080], [1280, 720], [1024, 768]];
const VIEWS: [&str; 3] = ["page", "bridge", "docking"];

/// Words with small Latin letters that are seen, but for names that the ship gives and lines of the journal.
const LATIN: &str = r#"
    const seen = new Set();
    const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
    for (let node = walker.nextNode(); node; node = walker.nextNode()) {
        const own = node.parentElement;
        if (own.closest('.sr, [hidden], .skip, [translate=no], #journal, svg') || !own.getClientRects().length) continue;
        for (const word of node.data.match(/[A-Za-z][a-z]{2,}/g) ?? []) seen.add(word);
    }
    return [...seen].sort()"#;

/// A browser that looks at a scene in Japanese.
fn japanese(scene: Scene) -> (Live, Browser) {
    let (live, browser) = looking_at(scene);
    choose(&browser, "language", "ja");
    browser.until("it is Japanese", || browser.text("#link") == "受信中");
    (live, browser)
}

#[test]
#[ignore = "needs chromium and chromedriver"]
fn the_language_changes_while_the_page_is_shown_and_is_remembered() {
    let (_live, browser) = looking_at(Scene::Fault);
    browser.until("alerts", || browser.text("#alert-list").contains("Position lost"));
    browser.run("window.mark = 'the same page'");
    choose(&browser, "language", "ja");
    browser.until("it is Japanese", || browser.text("#alert-list").contains("船位喪失"));
    assert_eq!(browser.run("return window.mark"), json!("the same page"));
    assert_eq!(browser.run("return document.documentElement.lang"), json!("ja"));
    for (place, text) in [
        ("#mode-chip strong", "推測航法"),
        ("#mode-chip .mode-why", "GNSSなし、船速計または基準で航法"),
        (".jump a", "本船"),
        (".alert.alarm small", "警報・未確認"),
        (".alert.alarm .acknowledge", "確認"),
        ("#sensor-table thead th", "センサ"),
        ("#sensor-table tbody tr:nth-child(2) td", "棄却"),
        ("#rose .label", "真方位"),
        ("#sky-legend", "使用"),
        ("#token-state", "トークンがない"),
        ("#findings", "GNSSアンテナは設定より28.0 m高い位置にある"),
    ] {
        browser.until(text, || browser.text(place).contains(text));
    }
    let label =
        "return document.querySelector('.alert.alarm .acknowledge').getAttribute('aria-label')";
    assert_eq!(browser.run(label), json!("確認：船位喪失"));
    let head = "return document.querySelector('#sensor-table td').dataset.head";
    assert_eq!(browser.run(head), json!("状態"));
    browser.run("location.reload()");
    browser.until("it is remembered", || browser.text("#link") == "受信中");
    choose(&browser, "language", "en");
    browser.until("it is English again", || browser.text("#alert-list").contains("Position lost"));
    assert_eq!(browser.text("#link"), "live");
    assert_eq!(browser.text(".jump a"), "Ship");
    assert!(browser.log("browser").is_empty());
}

#[test]
#[ignore = "needs chromium and chromedriver"]
fn who_has_not_chosen_reads_the_configured_language() {
    let live = Live::in_language(Show::new(Scene::Underway), Language::Japanese);
    let browser = Browser::start();
    browser.go(&live.url());
    browser.until("it is Japanese", || browser.text("#link") == "受信中");
    let chosen = "return document.getElementById('language').value";
    assert_eq!(browser.run(chosen), json!("ja"));
}

#[test]
#[ignore = "needs chromium and chromedriver"]
fn no_japanese_text_is_cut_off_on_a_phone_and_on_a_bridge() {
    for scene in [Scene::Alignment, Scene::Underway, Scene::Fault] {
        let (_live, browser) = japanese(scene);
        browser.until("rows", || !browser.elements("#sensor-table tbody tr").is_empty());
        for view in VIEWS {
            choose(&browser, "view", view);
            for [width, height] in SCREENS {
                browser.size(width, height);
                let place = format!("{scene:?}, {view}, {width} x {height}");
                let cut = browser.run(include_str!("cut.js"));
                assert_eq!(cut, json!([]), "cut off: {place}");
                let wide = browser.run("return document.documentElement.scrollWidth");
                assert!(wide.as_u64().unwrap() <= u64::from(width), "{wide}: {place}");
            }
        }
    }
}

#[test]
#[ignore = "needs chromium and chromedriver"]
fn no_english_is_left_on_the_japanese_page_but_names() {
    for scene in [Scene::Alignment, Scene::Underway, Scene::Fault] {
        let (_live, browser) = japanese(scene);
        browser.until("rows", || !browser.elements("#sensor-table tbody tr").is_empty());
        for view in VIEWS {
            choose(&browser, "view", view);
            let seen = browser.run(LATIN);
            let words = seen.as_array().unwrap().iter().filter_map(|word| word.as_str());
            let english: Vec<&str> =
                words.filter(|word| !NAMES.split(' ').any(|name| name == *word)).collect();
            assert!(english.is_empty(), "{scene:?}, {view}: {english:?}");
        }
    }
}

/// Names of the scenes' ship, of her sensors, ports and files, of systems, units and keys, and what the operating system says.
const NAMES: &str = "insd Example Moxa autopilot backbone baud blox bridge can compass dev doppler ecdis echo etc eth fix and gnss \
    gyro hand hot imu lan lib log main min old port ppm pps pulse recording sbg serial socketcan sounder toml tty ubx udp usb var \
    Pier eyes manual Galileo lever Input device error left output space";

#[test]
#[ignore = "needs chromium and chromedriver"]
fn japanese_words_can_be_told_from_their_ground_in_every_light() {
    let (_live, browser) = japanese(Scene::Fault);
    browser.until("alerts", || !browser.elements(".alert .acknowledge").is_empty());
    for view in VIEWS {
        choose(&browser, "view", view);
        for light in LIGHTS {
            choose(&browser, "theme", light);
            let faint = browser.run(include_str!("contrast.js"));
            assert_eq!(faint, json!([]), "{light}, {view}: contrast below 4.5");
        }
    }
}
