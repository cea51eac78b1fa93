//! A browser without a screen, driven by the W3C WebDriver protocol.

use std::net::TcpListener;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use serde_json::{Value, json};

/// How long anything may take to come about.
const PATIENCE: Duration = Duration::from_secs(15);

/// Chromium with one window. It ends when this is dropped.
pub(crate) struct Browser {
    driver: Child,
    agent: ureq::Agent,
    base: String,
    session: String,
}

/// The key of an element's reference, by the standard.
const ELEMENT: &str = "element-6066-11e4-a52e-4f735466cecf";

impl Browser {
    /// Starts it.
    pub(crate) fn start() -> Self {
        let listener = TcpListener::bind(("127.0.0.1", 0)).unwrap();
        let port = listener.local_addr().unwrap().port();
        drop(listener);
        let driver = Command::new("chromedriver")
            .arg(format!("--port={port}"))
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        let agent = ureq::Agent::config_builder()
            .http_status_as_error(false)
            .timeout_global(Some(Duration::from_secs(60)))
            .build()
            .into();
        let base = format!("http://127.0.0.1:{port}");
        let mut browser = Browser { driver, agent, base, session: String::new() };
        browser.until("the driver answers", || {
            let url = format!("{}/status", browser.base);
            browser.agent.get(&url).call().is_ok()
        });
        browser.session = browser.open_session();
        browser
    }

    fn open_session(&self) -> String {
        let arguments = ["--headless=new", "--no-sandbox", "--disable-gpu", "--hide-scrollbars"];
        let wanted = json!({ "capabilities": { "alwaysMatch": {
            "goog:chromeOptions": { "args": arguments },
            "goog:loggingPrefs": { "browser": "ALL", "performance": "ALL" },
        } } });
        let url = format!("{}/session", self.base);
        let mut answer = self.agent.post(&url).send(wanted.to_string()).unwrap();
        let text = answer.body_mut().read_to_string().unwrap();
        let value: Value = serde_json::from_str(&text).unwrap();
        let id = value["value"]["sessionId"].as_str();
        assert!(id.is_some(), "no session: {text}");
        id.unwrap_or_default().to_owned()
    }

    fn post(&self, path: &str, body: &Value) -> Value {
        let url = format!("{}/session/{}/{path}", self.base, self.session);
        let mut answer = self.agent.post(&url).send(body.to_string()).unwrap();
        let text = answer.body_mut().read_to_string().unwrap();
        assert!(answer.status().is_success(), "{path}: {text}");
        serde_json::from_str::<Value>(&text).unwrap()["value"].take()
    }

    fn get(&self, path: &str) -> Value {
        let url = format!("{}/session/{}/{path}", self.base, self.session);
        let mut answer = self.agent.get(&url).call().unwrap();
        let text = answer.body_mut().read_to_string().unwrap();
        serde_json::from_str::<Value>(&text).unwrap()["value"].take()
    }

    /// Goes to a page.
    pub(crate) fn go(&self, url: &str) {
        self.post("url", &json!({ "url": url }));
    }

    /// The value of a script.
    pub(crate) fn run(&self, script: &str) -> Value {
        self.post("execute/sync", &json!({ "script": script, "args": [] }))
    }

    /// Makes the window so wide and high, in CSS pixels.
    pub(crate) fn size(&self, width: u32, height: u32) {
        let metrics =
            json!({ "width": width, "height": height, "deviceScaleFactor": 1, "mobile": false });
        self.tools("Emulation.setDeviceMetricsOverride", &metrics);
    }

    /// Lets nothing flash.
    pub(crate) fn be_calm(&self) {
        let feature = json!({ "name": "prefers-reduced-motion", "value": "reduce" });
        self.tools("Emulation.setEmulatedMedia", &json!({ "features": [feature] }));
    }

    /// A picture of the window, as PNG.
    pub(crate) fn picture(&self) -> Vec<u8> {
        let picture = self.tools("Page.captureScreenshot", &json!({ "format": "png" }));
        decoded(picture["data"].as_str().unwrap())
    }

    fn tools(&self, command: &str, parameters: &Value) -> Value {
        self.post("goog/cdp/execute", &json!({ "cmd": command, "params": parameters }))
    }

    /// The text of the first element that a selector finds.
    pub(crate) fn text(&self, selector: &str) -> String {
        let found = self.run(&format!("return document.querySelector('{selector}')?.textContent"));
        found.as_str().unwrap_or_default().to_owned()
    }

    /// References to all elements that a selector finds.
    pub(crate) fn elements(&self, selector: &str) -> Vec<String> {
        let found = self.post("elements", &json!({ "using": "css selector", "value": selector }));
        let id = |element: &Value| element[ELEMENT].as_str().unwrap().to_owned();
        found.as_array().unwrap().iter().map(id).collect()
    }

    /// What assistive technology calls an element.
    pub(crate) fn label(&self, element: &str) -> String {
        self.get(&format!("element/{element}/computedlabel")).as_str().unwrap_or("").to_owned()
    }

    /// Presses the first element that a selector finds.
    pub(crate) fn press(&self, selector: &str) {
        let element = self.elements(selector).swap_remove(0);
        self.post(&format!("element/{element}/click"), &json!({}));
    }

    /// Types into the first element that a selector finds.
    pub(crate) fn write(&self, selector: &str, text: &str) {
        let element = self.elements(selector).swap_remove(0);
        self.post(&format!("element/{element}/value"), &json!({ "text": text }));
    }

    /// Lines of a log: `browser`, `performance`.
    pub(crate) fn log(&self, kind: &str) -> Vec<String> {
        let lines = self.post("se/log", &json!({ "type": kind }));
        let text = |line: &Value| line["message"].as_str().unwrap_or("").to_owned();
        lines.as_array().unwrap().iter().map(text).collect()
    }

    /// Waits until something has come about.
    #[allow(clippy::disallowed_methods)] // a test may look at the clock
    pub(crate) fn until(&self, what: &str, mut is_so: impl FnMut() -> bool) {
        let begun = Instant::now();
        while !is_so() {
            assert!(begun.elapsed() < PATIENCE, "waited in vain: {what}");
            std::thread::sleep(Duration::from_millis(50));
        }
    }
}

impl Drop for Browser {
    fn drop(&mut self) {
        let url = format!("{}/session/{}", self.base, self.session);
        // whatever becomes of the session, the driver ends
        let _ = self.agent.delete(&url).call();
        let _ = self.driver.kill();
        let _ = self.driver.wait();
    }
}

/// Bytes of base 64 (RFC 4648).
fn decoded(text: &str) -> Vec<u8> {
    let mut bytes = Vec::new();
    let (mut bits, mut held) = (0_u32, 0);
    for letter in text.bytes() {
        let value = match letter {
            b'A'..=b'Z' => letter - b'A',
            b'a'..=b'z' => letter - b'a' + 26,
            b'0'..=b'9' => letter - b'0' + 52,
            b'+' => 62,
            b'/' => 63,
            _ => continue,
        };
        bits = bits << 6 | u32::from(value);
        held += 6;
        if held >= 8 {
            held -= 8;
            bytes.push((bits >> held & 0xFF) as u8);
        }
    }
    bytes
}
