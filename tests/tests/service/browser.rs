//! The daemon's own page in a browser: what a mate would do, on a ship that sails.

use std::sync::Arc;

use super::daemon::{Daemon, status, wait_until};
use super::driver::Browser;
use super::ship::{IMU, Ship};

const ALIGNED: f64 = 240.0;
const TOKEN: &str = "a word for the bridge only";

/// Writes a picture of the page, if a folder for it is named.
fn picture(browser: &Browser, name: &str) {
    let Some(folder) = std::env::var_os("INSD_PICTURES") else { return };
    std::fs::write(std::path::Path::new(&folder).join(name), browser.picture()).unwrap();
}

#[test]
#[ignore = "needs chromium and chromedriver"]
fn the_heading_moves_an_alert_is_acknowledged_and_the_page_outlives_a_crash() {
    let ship = Arc::new(Ship::under_way(ALIGNED + 120.0, 3));
    let token = ship.path().join("token");
    std::fs::write(&token, TOKEN).unwrap();
    let text = ship.text("");
    let text = text.replace("[web]\n", &format!("[web]\ntoken_file = {token:?}\n"));
    std::fs::write(ship.config(), text).unwrap();
    ship.leave_state(ALIGNED);
    let sailing = ship.sail(ALIGNED);
    let daemon = Daemon::start(&ship);
    wait_until("aided", || status(ship.page).is_some_and(|own| own["mode"]["name"] == "aided"));

    let browser = Browser::start();
    browser.size(1280, 900);
    browser.go(&format!("http://{}/", ship.page));
    browser.until("data come", || browser.text("#link") == "live");
    let heading = || browser.text("#rose .big");
    browser.until("a heading", || heading().ends_with('°'));
    let before = heading();
    browser.until("another heading", || heading() != before);
    picture(&browser, "daemon.png");

    sailing.mute(&[IMU]);
    let fault = ".alert.warning.unacknowledged";
    browser.until("an alert", || !browser.elements(fault).is_empty());
    browser.write("#token", TOKEN);
    browser.press("#token-save");
    browser.press(&format!("{fault} .acknowledge"));
    browser.until("the answer", || !browser.elements(".alert.warning.acknowledged").is_empty());
    sailing.mute(&[]);
    wait_until("she navigates again", || {
        status(ship.page).is_some_and(|own| own["motion"]["heading_deg"].is_number())
    });

    daemon.kill();
    browser.until("the loss is told", || browser.text("#link") != "live");
    let daemon = Daemon::start(&ship);
    browser.until("it is back", || browser.text("#link") == "live");
    let before = heading();
    browser.until("it moves again", || heading() != before);
    let strangers: Vec<String> = browser
        .log("performance")
        .into_iter()
        .filter(|line| line.contains("Network.requestWillBeSent\""))
        .filter(|line| !line.contains(&ship.page.to_string()) && !line.contains("\"data:"))
        .collect();
    assert_eq!(strangers, Vec::<String>::new());
    daemon.stop();
}
