//! What a simulated camera sees is what the intake takes in.

use insd_base::Message;
use insd_intake::Intaken;
use insd_simulator::feed::film;
use insd_simulator::footage;
use insd_tests::feed::{Encoding, FeedConfig, Reception, arrivals};

use super::taken;

/// Images are taken later than is told by what the way to the computer jitters at the least, s.
const TIME: f64 = 1e-3;
/// Sentences tell hundredths of a pixel.
const PIXELS: f64 = 0.0051;

#[test]
fn the_images_of_a_camera_come_through_its_sentences() {
    let scenario = insd_tests::variant(30, &[]).with_duration(60.0);
    let voyage = insd_simulator::simulate(&scenario.clone().with_duration(1.0), 3);
    let sent = footage(&scenario, 3).unwrap().frames;
    let config = FeedConfig::new(&voyage, &[Encoding::Sbg, Encoding::Tracks]);
    let reception = Reception::new(config.sensors[0].calendar.start, 7);
    let all = taken(&config.intake(&voyage), &arrivals(&film(&sent, &config), &reception));
    let mut seen = 0;
    for intaken in &all {
        let Intaken::Measured(received) = intaken else { continue };
        let Message::Camera(frame) = &received.message else { panic!("{received:?}") };
        let time = frame.time - reception.offset;
        let of = |own: &&insd_base::CameraFrame| (own.time - time).as_seconds().abs() < TIME;
        let own = sent.iter().find(of).unwrap();
        assert_eq!(own.points.len(), frame.points.len());
        for (one, other) in own.points.iter().zip(&frame.points) {
            assert_eq!(one.track, other.track);
            assert!((one.at - other.at).amax() < PIXELS, "{one:?} {other:?}");
        }
        seen += 1;
    }
    // those before the clock is tied are not passed on
    assert!(seen + 5 > sent.len(), "{seen} of {}", sent.len());
}
