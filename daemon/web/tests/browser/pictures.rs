//! The pictures of the documentation, on request.

use std::path::{Path, PathBuf};
use std::time::Duration;

use crate::driver::Browser;
use crate::live::Live;
use crate::scene::{Scene, Show};

/// Largest picture, bytes.
const LARGEST: usize = 300_000;

/// Name, scene, size, light, and how far down; what ends on `-ja` is Japanese.
type Picture = (&'static str, Scene, [u32; 2], &'static str, &'static str);

const PICTURES: [Picture; 17] = [
    ("underway", Scene::Underway, [1920, 1080], "day", "#ship"),
    ("underway-dusk", Scene::Underway, [1600, 900], "dusk", "#ship"),
    ("underway-night", Scene::Underway, [1600, 900], "night", "#ship"),
    ("bridge", Scene::Underway, [1920, 1080], "day", "#bridge"),
    ("bridge-night", Scene::Fault, [1920, 1080], "night", "#bridge"),
    ("docking", Scene::Underway, [1920, 1080], "day", "#docking"),
    ("docking-night", Scene::Underway, [1920, 1080], "night", "#docking"),
    ("docking-phone", Scene::Underway, [390, 844], "day", "#docking"),
    ("docking-phone-night", Scene::Fault, [390, 844], "night", "#docking"),
    ("alignment", Scene::Alignment, [1280, 800], "day", "#alignment"),
    ("satellites", Scene::Underway, [1440, 860], "day", "#satellites"),
    ("camera", Scene::Underway, [1280, 720], "day", "#camera"),
    ("fault", Scene::Fault, [1280, 860], "dusk", "#alerts"),
    ("phone", Scene::Underway, [390, 844], "day", "#ship"),
    ("phone-sensors", Scene::Fault, [390, 844], "night", "#sensors"),
    ("bridge-ja", Scene::Fault, [1920, 1080], "day", "#bridge"),
    ("phone-ja", Scene::Underway, [390, 844], "day", "#ship"),
];

#[test]
#[ignore = "needs chromium and chromedriver; writes into the folder INSD_PICTURES"]
fn pictures() {
    let Some(folder) = std::env::var_os("INSD_PICTURES").map(PathBuf::from) else { return };
    // relative to the workspace, not to the crate
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(folder);
    let scenes = [Scene::Alignment, Scene::Underway, Scene::Fault];
    let lives = scenes.map(|scene| (scene, Live::of(Show::from_the_start(scene))));
    // all of the past is gone through
    std::thread::sleep(Duration::from_secs(18));
    let browser = Browser::start();
    browser.be_calm();
    for (name, scene, [width, height], theme, place) in PICTURES {
        let live = lives.iter().find(|(own, _)| *own == scene).map(|(_, live)| live).unwrap();
        let language = if name.ends_with("-ja") { "ja" } else { "en" };
        browser.size(width, height);
        browser.go(&live.url());
        let view = ["bridge", "docking"].into_iter().find(|view| place == format!("#{view}"));
        let view = view.unwrap_or("page");
        browser.run(&format!(
            "localStorage.setItem('theme', '{theme}'); localStorage.setItem('view', '{view}');
             localStorage.setItem('language', '{language}')"
        ));
        browser.go(&live.url());
        browser.until("data come", || {
            browser.run("return document.getElementById('link').dataset.state") == "live"
        });
        let down = "if (!['#ship', '#bridge', '#docking'].includes('PLACE')) document.querySelector('PLACE').scrollIntoView()";
        browser.run(&down.replace("PLACE", place));
        std::thread::sleep(Duration::from_millis(2500));
        let png = browser.picture();
        assert!(png.len() < LARGEST, "{name}: {} bytes", png.len());
        std::fs::write(folder.join(format!("{name}.png")), png).unwrap();
    }
}
