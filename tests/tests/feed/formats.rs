//! Raw messages in other formats than u-blox', from bytes to solutions.

use insd_base::{Message, Source, Time, earth};
use insd_engine::{Engine, EngineConfig, Output};
use insd_intake::{Intake, Intaken};
use insd_simulator::{raw_gnss, simulate};
use insd_tests::feed::{Calendar, Encoding, FeedConfig, Reception, arrivals, feed};
use insd_tests::raw_feed;

const GNSS: usize = 1;

#[test]
fn a_ship_navigates_by_what_a_receiver_measures_and_hears_in_sbf_alone() {
    let text = [("grade = \"mems\"", "grade = \"navigation\"")];
    let scenario = insd_tests::variant(26, &text).with_duration(150.0);
    let (voyage, raw) = (simulate(&scenario, 3), raw_gnss(&scenario, 3).unwrap());
    let feeds = FeedConfig::new(&voyage, &[Encoding::Sbg, Encoding::Sbf]);
    let utc = Calendar::new(&voyage.header.start_utc).unwrap().start;
    let reception = Reception::new(utc, 5);
    let mut sendings = feed(&voyage, &feeds);
    sendings.retain(|sending| sending.port != GNSS);
    sendings.extend(raw_feed::sbf(&raw, utc.to_gps(), GNSS));
    sendings.sort_by_key(|sending| sending.at);
    let mut intake = Intake::new(&feeds.intake(&voyage));
    let mut engine = Engine::new(EngineConfig::for_voyage(&voyage.header, 1.0));
    let (mut epochs, mut last) = (0, None);
    for arrival in arrivals(&sendings, &reception) {
        intake.handle(&arrival);
        while let Some(taken) = intake.poll_output() {
            let Intaken::Measured(received) = taken else { continue };
            if let Message::Ranges(told) = &received.message {
                assert_eq!(received.source, Source::Gnss(0));
                epochs += usize::from(told.ranges.len() >= 5);
            }
            engine.handle(&received);
        }
        while let Some(output) = engine.poll_output() {
            if let Output::Solution(solution) = output {
                last = Some(solution);
            }
        }
    }
    let refused = &intake.status().sensors[GNSS].refused;
    assert!(epochs > 130, "{epochs} epochs, {refused:?}");
    let (last, counts) = (last.unwrap(), engine.counts());
    assert!(last.mode.is_navigating(), "{:?} {refused:?}", last.mode);
    for aid in ["satellite_code", "satellite_phase"] {
        assert!(counts.accepted.get(aid).is_some_and(|own| *own > 30), "{aid}: {counts:?}");
    }
    let time: Time = last.time - reception.offset;
    let nearest = |truth: &&insd_base::Truth| (truth.time - time).as_nanos().abs();
    let truth = voyage.truth.iter().min_by_key(nearest).unwrap();
    let apart = earth::ecef(&last.position).0 - earth::ecef(&truth.position).0;
    let off = (earth::c_ne(&truth.position) * apart).xy().norm();
    assert!(off < 8.0, "{off} m off");
}
