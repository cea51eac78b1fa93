//! The camera on the page.

use serde_json::Value;

use crate::looking_at;
use crate::scene::Scene;

/// Any picture.
const PICTURE: &[u8] = include_bytes!("../../../../docs/page/phone.png");

#[test]
#[ignore = "needs chromium and chromedriver"]
fn the_picture_of_a_camera_is_shown_to_who_asks_and_why_there_is_none() {
    let (live, browser) = looking_at(Scene::Underway);
    browser.until("the camera is told", || browser.text("#camera-state") == "used");
    let width = "return document.getElementById('camera-picture').hidden ? 0
        : document.getElementById('camera-picture').naturalWidth";
    assert_eq!(browser.run(width), Value::from(0));
    browser.press("#camera-switch");
    let why = "there is no picture yet: the front end of the camera has written none";
    browser.until("why there is none", || browser.text("#camera-outcome") == why);
    std::fs::write(live.picture(), PICTURE).unwrap();
    browser.until("a picture", || browser.run(width).as_u64().is_some_and(|width| width > 100));
    assert_eq!(browser.text("#camera-outcome"), "");
    browser.press("#camera-switch");
    assert_eq!(browser.run(width), Value::from(0));
}
