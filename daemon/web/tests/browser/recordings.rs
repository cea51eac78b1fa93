//! Raw recordings on the page, and reports of them.

use crate::looking_at;
use crate::scene::Scene;

#[test]
#[ignore = "needs chromium and chromedriver"]
fn a_report_is_ordered_waited_for_and_opened_or_said_to_have_failed() {
    let (live, browser) = looking_at(Scene::Underway);
    live.record("echo 'error: it holds nothing' >&2; exit 2");
    browser.press("#recordings-switch");
    let button = "#recordings li button";
    browser.until("a recording", || browser.elements(button).len() == 1);
    browser.press(button);
    let why = "the report cannot be made: error: it holds nothing";
    browser.until("why there is none", || browser.text("#recordings-outcome") == why);
    live.record(r#"read line < "${10%/*}/go"; echo "<h1>a report</h1>" > "$8""#);
    let pipe = live.picture().with_file_name("go");
    assert!(std::process::Command::new("mkfifo").arg(&pipe).status().unwrap().success());
    browser.press(button);
    let making = "The report is being made …";
    browser.until("that it is made", || browser.text("#recordings-outcome") == making);
    std::fs::write(&pipe, "go\n").unwrap();
    let link = "#recordings li a[target]";
    browser.until("a link", || browser.elements(link).len() == 1);
    assert_eq!(browser.text("#recordings-outcome"), "");
    let address = browser.run(&format!("return document.querySelector('{link}').href"));
    browser.go(address.as_str().unwrap());
    browser.until("the report", || browser.text("h1") == "a report");
}
