//! What the page looks like: light, size, and what fits.

use serde_json::{Value, json};

use crate::driver::Browser;
use crate::scene::Scene;
use crate::{LIGHTS, choose, looking_at};

/// Mean and greatest luminance of what the style gives to grounds and letters, 0 to 1.
const BRIGHTNESS: &str = "
    const luminance = (text) => {
        const [r, g, b] = text.match(/[\\d.]+/g).map(Number).map((part) => part / 255)
            .map((part) => (part <= 0.04045 ? part / 12.92 : ((part + 0.055) / 1.055) ** 2.4));
        return 0.2126 * r + 0.7152 * g + 0.0722 * b;
    };
    const all = [...document.querySelectorAll('main *:not(svg *)')].filter((node) => node.offsetParent);
    const letters = all.map((node) => luminance(getComputedStyle(node).color));
    const card = luminance(getComputedStyle(document.querySelector('.card')).backgroundColor);
    return [card, Math.max(card, ...letters)]";

#[test]
#[ignore = "needs chromium and chromedriver"]
fn night_is_the_dimmest_day_the_brightest_and_dusk_is_between() {
    let (_live, browser) = looking_at(Scene::Underway);
    let [day, dusk, night] = LIGHTS.map(|light| {
        choose(&browser, "theme", light);
        let found = browser.run(BRIGHTNESS);
        [0, 1].map(|index| found[index].as_f64().unwrap())
    });
    for index in [0, 1] {
        assert!(day[index] > 1.5 * dusk[index], "{day:?} {dusk:?}");
        assert!(dusk[index] > 1.5 * night[index], "{dusk:?} {night:?}");
    }
    assert!(night[1] < 0.25, "{night:?}");
}

#[test]
#[ignore = "needs chromium and chromedriver"]
fn the_dimmer_darkens_all_and_never_wholly() {
    let (_live, browser) = looking_at(Scene::Underway);
    let shade = "return Number(getComputedStyle(document.querySelector('.shade')).opacity)";
    assert_eq!(browser.run(shade).as_f64(), Some(0.0));
    browser.run(
        "const d = document.getElementById('dimmer'); d.value = 0; d.dispatchEvent(new Event('input'))",
    );
    assert_eq!(browser.run(shade).as_f64(), Some(0.85));
    // it is remembered, and what lies under it can still be pressed
    browser.press("#zoom-in");
    browser.run("location.reload()");
    browser.until("it is dim again", || browser.run(shade).as_f64() == Some(0.85));
}

/// Height of the letters of an element, pixels on the screen.
fn height(browser: &Browser, selector: &str) -> f64 {
    let script = format!(
        "const node = document.querySelector('{selector}');
         const scale = node.ownerSVGElement ? node.ownerSVGElement.getScreenCTM().a : 1;
         return parseFloat(getComputedStyle(node).fontSize) * scale"
    );
    browser.run(&script).as_f64().unwrap()
}

const LARGE: [&str; 6] = ["lat_deg", "lon_deg", "speed_kn", "course_deg", "roll_deg", "pitch_deg"];

#[test]
#[ignore = "needs chromium and chromedriver"]
fn on_a_screen_of_the_bridge_position_speed_and_level_are_as_large_as_the_heading() {
    let (_live, browser) = looking_at(Scene::Underway);
    browser.size(1920, 1080);
    for (view, root) in [("page", "#ship"), ("bridge", "#bridge")] {
        choose(&browser, "view", view);
        browser.until("a picture", || browser.text("#rose .big").ends_with('°'));
        let heading = height(&browser, &format!("{root} .big"));
        for name in LARGE {
            let own = height(&browser, &format!("{root} [data-bind=\"motion.{name}\"]"));
            assert!(own >= 46.0 && own > 0.6 * heading, "{view}, {name}: {own} of {heading}");
        }
        let beyond = "return [...document.querySelectorAll('.b-value dd, .large dd')].filter((node) =>
            node.offsetParent && node.scrollWidth > node.clientWidth + 1).map((node) => node.textContent)";
        assert_eq!(browser.run(beyond), json!([]), "{view}: cut off");
    }
}

#[test]
#[ignore = "needs chromium and chromedriver"]
fn a_value_that_is_not_valid_is_never_large() {
    let (_live, browser) = looking_at(Scene::Alignment);
    browser.size(1920, 1080);
    browser.until("a heading", || browser.text("#rose .big").ends_with('°'));
    assert_eq!(browser.text("#heading-quality"), "not valid");
    assert!(height(&browser, "#rose .big") < 24.0);
    choose(&browser, "view", "bridge");
    assert!(height(&browser, "#b-rose .big") < 40.0);
    // the same for the others, whatever they say of themselves
    for (view, root) in [("bridge", "#bridge"), ("page", "#ship")] {
        choose(&browser, "view", view);
        let largest = browser.run(&format!(
            "document.body.className = 'position-not-valid velocity-not-valid level-not-valid';
             return Math.max(...{LARGE:?}.map((name) => parseFloat(getComputedStyle(
                 document.querySelector(`{root} [data-bind=\"motion.${{name}}\"]`)).fontSize)))"
        ));
        assert!(largest.as_f64().unwrap() < 24.0, "{view}: {largest}");
    }
}

#[test]
#[ignore = "needs chromium and chromedriver"]
fn the_view_for_the_bridge_is_one_screen() {
    for scene in [Scene::Underway, Scene::Fault] {
        let (_live, browser) = looking_at(scene);
        choose(&browser, "view", "bridge");
        for (width, height) in [(1920, 1080), (1280, 720), (1024, 768)] {
            browser.size(width, height);
            let whole = browser.run(
                "const root = document.documentElement;
                 const low = [...document.querySelectorAll('.b-tile')].map((node) => node.getBoundingClientRect().bottom);
                 return [root.scrollWidth, root.scrollHeight, Math.max(...low)]",
            );
            let whole = [0, 1, 2].map(|index| whole[index].as_f64().unwrap());
            assert!(whole[0] <= f64::from(width) && whole[1] <= f64::from(height), "{whole:?}");
            assert!(whole[2] <= f64::from(height), "{whole:?} at {width} x {height}");
        }
        if scene == Scene::Fault {
            browser.until("alerts", || browser.text("#b-alerts").contains("Position lost"));
        }
    }
}

#[test]
#[ignore = "needs chromium and chromedriver"]
fn on_a_phone_no_table_is_cut_off() {
    for scene in [Scene::Alignment, Scene::Fault] {
        let (_live, browser) = looking_at(scene);
        browser.size(390, 844);
        browser.until("rows", || !browser.elements("#sensor-table tbody tr").is_empty());
        let cut = browser.run(
            "return [...document.querySelectorAll('.scroll')].filter((node) =>
                node.clientWidth > 0 && node.scrollWidth > node.clientWidth + 1)
                .map((node) => node.firstElementChild.id)",
        );
        assert_eq!(cut, json!([]), "{scene:?}");
        let head = browser.run("return document.querySelector('#sensor-table td').dataset.head");
        assert_eq!(head, Value::String("State".to_owned()));
    }
}

#[test]
#[ignore = "needs chromium and chromedriver"]
fn what_is_found_of_the_installation_is_read_on_the_page_and_only_then() {
    for (scene, told) in [(Scene::Fault, true), (Scene::Underway, false)] {
        let (_live, browser) = looking_at(scene);
        let text = "return document.getElementById('found').innerText";
        let is_told = || browser.run(text).as_str().unwrap_or("").contains("28.0 m higher");
        if told {
            browser.until("the lever arm is told", is_told);
        }
        assert_eq!(is_told(), told);
        let hidden = "return document.getElementById('found').hidden";
        assert_eq!(browser.run(hidden), json!(!told));
    }
}

#[test]
#[ignore = "needs chromium and chromedriver"]
fn each_satellite_stands_in_the_sky_in_the_bars_and_in_the_table_and_no_name_covers_another() {
    let (_live, browser) = looking_at(Scene::Underway);
    browser.until("a sky", || !browser.elements("#sky-plot .sat").is_empty());
    assert_eq!(browser.elements("#sky-table tbody tr").len(), 34);
    assert_eq!(browser.elements("#cn0 .cn0").len(), 34);
    assert_eq!(browser.elements("#sky-plot .sat-name").len(), 31);
    assert!(browser.text("#sky-elsewhere").ends_with("R19, E24, S23"));
    assert_eq!(browser.text("#sky-tally"), "26 of 34 used");
    let table = browser.text("#sky-table");
    for told in ["left out", "its ranges contradict the others", "below 10 degrees", "code only"] {
        assert!(table.contains(told), "{told} is not in {table}");
    }
    let covering = browser.run(
        "const names = [...document.querySelectorAll('.sat-name')].map((node) => [node.textContent, node.getBoundingClientRect()]);
         return names.flatMap(([a, own], k) => names.slice(k + 1).filter(([, other]) => {
             const wide = Math.min(own.right, other.right) - Math.max(own.left, other.left);
             const high = Math.min(own.bottom, other.bottom) - Math.max(own.top, other.top);
             return wide > 3 && high > 5;
         }).map(([b]) => `${a} ${b}`))",
    );
    assert_eq!(covering, json!([]));
    // who does not see colours sees shapes
    let shapes = "return new Set([...document.querySelectorAll('#sky-legend svg')].map((node) => node.innerHTML
        .replaceAll(/class=\"[^\"]*\"/g, ''))).size";
    assert_eq!(browser.run(shapes), json!(7));
}

#[test]
#[ignore = "needs chromium and chromedriver"]
fn a_receiver_that_sends_fixes_only_is_said_to() {
    let (live, browser) = looking_at(Scene::Alignment);
    browser.until("words", || browser.text("#no-sky").contains("sends fixes only"));
    for hidden in ["#sky-box", "#signals-card"] {
        let script = format!("return document.querySelector('{hidden}').hidden");
        assert_eq!(browser.run(&script), json!(true), "{hidden}");
    }
    live.be_still(true);
    browser.until("nothing is known", || {
        browser.text("#no-sky") == "Nothing is known of the satellites."
    });
}
