//! A base behind a caster: corrections over the network and a receiver on a serial line bring centimetres.

use std::fs;
use std::os::unix::fs::PermissionsExt;
use std::path::Path;

use insd::run::RunOptions;
use insd_base::{GpsTime, Solution, SolutionSource, Span, Time, UtcTime, Voyage};
use insd_config::Config;
use insd_simulator::{raw_gnss, simulate};
use insd_tests::caster::Caster;
use insd_tests::feed::{Encoding, FeedConfig, feed};
use insd_tests::scores::horizontal_error;
use insd_tests::{port_with_base, raw_feed};

use crate::{ELSEWHERE, configuration, replay, send, start};

/// Seconds that are sailed, and when the caster drops its caller.
const SAILED: f64 = 90.0;
const DROPPED: f64 = 75.0;
/// `ship` and `tOpSecret`.
const WANTED: &str = "Authorization: Basic c2hpcDp0T3BTZWNyZXQ=";

#[test]
fn corrections_of_a_caster_and_a_receiver_on_a_line_bring_centimetres() {
    let folder = tempfile::tempdir().unwrap();
    let dir = folder.path();
    let grade = [("grade = \"mems\"", "grade = \"navigation\"")];
    let scenario = port_with_base(&grade).with_duration(SAILED + 5.0);
    let (voyage, raw) = (simulate(&scenario, 1), raw_gnss(&scenario, 1).unwrap());
    let feeds = FeedConfig::new(&voyage, &[Encoding::Sbg, Encoding::Ubx]);
    let caster = Caster::new(WANTED).unwrap();
    let text = configuration(dir, &feeds, &voyage) + &of_caster(dir, caster.address());
    let config = Config::of_text(&text).unwrap();
    let start_gps = feeds.sensors[1].calendar.start.to_gps();
    let mut sendings = feed(&voyage, &feeds);
    sendings.extend(raw_feed::ubx(&raw, start_gps, 1));
    sendings.extend(raw_feed::rtcm(&raw, start_gps, ELSEWHERE));
    sendings.sort_by_key(|sending| sending.at);
    let options = RunOptions { seconds: Some(SAILED + 3.0), ..RunOptions::default() };
    let daemon = start(&config, &text, options);
    let mut is_dropped = false;
    send(dir, &sendings, SAILED, 0.0..0.0, |sending| {
        if !is_dropped && sending.at.as_seconds() > DROPPED {
            is_dropped = true;
            caster.drop_caller();
        }
        caster.send(sending.bytes());
    });
    daemon.join().unwrap();

    let replayed = replay(dir, &config);
    let errors: Vec<f64> = replayed
        .solutions
        .iter()
        .filter(|(own, _)| own.source == Some(SolutionSource::Rtk))
        .filter_map(|(own, utc)| error(&voyage, start_gps, own, (*utc)?))
        .collect();
    let last = errors.iter().rev().take(errors.len() / 2).copied().fold(0.0, f64::max);
    println!(
        "{} solutions by RTK, worst of the later half {last:.3} m; {:?}",
        errors.len(),
        replayed.sources
    );
    assert!(replayed.sources.contains(&"rtk"), "{:?}", replayed.sources);
    assert!(errors.len() > 100 && last < 0.15, "{} {last}", errors.len());
    // it was called again, and asked the same
    let asked = caster.asked();
    assert!(asked.len() == 2 && asked[0] == asked[1], "{asked:?}");
    assert!(caster.heard().contains("GGA,"), "{}", caster.heard());
    let states = replayed.states.join("\n");
    assert!(states.contains("closed by the other end"), "{states}");
    assert!(!states.contains("tOpSecret") && !states.contains("c2hp"), "{states}");
}

/// How far a solution is from the truth, m.
fn error(voyage: &Voyage, start: GpsTime, own: &Solution, utc: UtcTime) -> Option<f64> {
    let time = Time::START + Span::from_nanos(utc.to_gps().since(start).as_nanos());
    horizontal_error(&voyage.truth, time, &own.position)
}

/// The caster's port, with the base on it, and its password in a file that nobody else can read.
fn of_caster(dir: &Path, address: &str) -> String {
    let secret = dir.join("secret");
    fs::write(&secret, "tOpSecret\n").unwrap();
    fs::set_permissions(&secret, fs::Permissions::from_mode(0o600)).unwrap();
    format!(
        "[[port]]\nname = \"caster\"\n[port.transport]\nkind = \"ntrip\"\naddress = {address:?}\nmount = \"QUAY\"\n\
         user = \"ship\"\npassword_file = {secret:?}\ngga_s = 5.0\n\
         [[sensor]]\nname = \"base\"\nport = \"caster\"\nkind = \"rtcm_base\"\n"
    )
}
