//! Bad input: told, counted, and nothing else disturbed.

use insd_vision::{
    BadImage, CameraImage, Eyesight, FrontEnd, FrontEndConfig, Hints, ImageMask, Lens, Tracked,
};
use nalgebra::{Vector2, Vector3};
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64;

use super::scene::{Wall, camera, picture};
use super::{hints, pose};

fn eyes() -> FrontEnd {
    FrontEnd::new(camera(Lens::STRAIGHT), FrontEndConfig::default()).unwrap()
}

/// Images of the wall as the camera sails.
fn images(count: usize) -> Vec<Vec<u8>> {
    let (wall, mut rng) = (Wall::new(7), Pcg64::seed_from_u64(8));
    (0..count).map(|i| wall.image(&camera(Lens::STRAIGHT), &pose(i), 1.0, &mut rng)).collect()
}

fn take(eyes: &mut FrontEnd, t: f64, pixels: &[u8]) -> Result<Tracked, BadImage> {
    eyes.take(&picture(&camera(Lens::STRAIGHT), t, pixels), &Hints::default())
}

#[test]
fn each_kind_of_bad_image_is_counted_and_tracks_go_on() {
    let images = images(3);
    let mut eyes = eyes();
    let first = take(&mut eyes, 0.0, &images[0]).unwrap();
    let torn = &images[1][..40_000];
    let small = CameraImage {
        size: [160, 120],
        ..picture(&camera(Lens::STRAIGHT), 0.1, &images[1][..19_200])
    };
    assert_eq!(take(&mut eyes, 0.1, torn), Err(BadImage::Torn));
    assert_eq!(eyes.take(&small, &Hints::default()), Err(BadImage::WrongSize));
    assert_eq!(take(&mut eyes, 0.0, &images[1]), Err(BadImage::TimeStoodStill));
    assert_eq!(take(&mut eyes, -1.0, &images[1]), Err(BadImage::TimeBackwards));
    assert_eq!(take(&mut eyes, 0.1, &images[0]), Err(BadImage::Repeated));
    assert_eq!(eyes.counts().refused_total(), 5);
    let next = take(&mut eyes, 0.1, &images[1]).unwrap();
    let goes_on =
        next.seen.iter().filter(|track| first.seen.iter().any(|t| t.id == track.id)).count();
    assert!(goes_on > 80, "{goes_on}");
    assert_eq!(eyes.counts().used, 2);
}

#[test]
fn ten_seconds_of_the_same_image_are_told() {
    let images = images(2);
    let mut eyes = eyes();
    take(&mut eyes, 0.0, &images[0]).unwrap();
    for i in 1..=100 {
        assert!(take(&mut eyes, f64::from(i) / 10.0, &images[0]) == Err(BadImage::Repeated));
    }
    assert!(
        (eyes.frozen_for(insd_base::Time::from_seconds(10.0)).as_seconds() - 10.0).abs() < 1e-9
    );
    assert_eq!(eyes.counts().refused[&BadImage::Repeated], 100);
    // a picture that comes to life begins a new row: nobody knows what happened meanwhile
    let alive = take(&mut eyes, 10.1, &images[1]).unwrap();
    assert!(alive.seen.iter().all(|track| track.length == 1));
}

#[test]
fn a_clock_that_is_set_back_for_good_is_followed_in_the_end() {
    let images = images(30);
    let mut eyes = eyes();
    take(&mut eyes, 1000.0, &images[0]).unwrap();
    let used = (1..30).filter(|&i| take(&mut eyes, i as f64 / 10.0, &images[i]).is_ok()).count();
    assert_eq!((used, eyes.counts().clock_set_back), (10, 1));
}

#[test]
fn noise_yields_no_tracks_that_are_believed() {
    let mut rng = Pcg64::seed_from_u64(5);
    let mut eyes = eyes();
    let (mut long, mut started) = (0, 0);
    for i in 0..60 {
        let mut pixels = vec![0; 320 * 240];
        rng.fill_bytes(&mut pixels);
        let seen = take(&mut eyes, f64::from(i) / 10.0, &pixels).unwrap();
        long += seen.seen.iter().filter(|track| track.length == 4).count();
        started += seen.seen.iter().filter(|track| track.length == 1).count();
        if i > 20 {
            assert!(seen.sight == Eyesight::Doubtful && seen.frame.points.is_empty());
        }
    }
    assert!(long * 100 < started, "{long} of {started} lived for four images");
}

#[test]
fn a_camera_that_is_covered_is_doubtful_after_two_seconds_and_sees_again_when_it_is_not() {
    let images = images(40);
    let mut eyes = eyes();
    let mut sights = Vec::new();
    for (i, pixels) in images.iter().enumerate() {
        // dark, with the flicker of its last bit
        let covered: Vec<u8> = pixels.iter().map(|p| 20 + p % 2).collect();
        let shown = if (5..32).contains(&i) { &covered } else { pixels };
        sights.push(take(&mut eyes, i as f64 / 10.0, shown).unwrap().sight);
    }
    assert_eq!(
        (sights[20], sights[30], sights[39]),
        (Eyesight::Sees, Eyesight::Doubtful, Eyesight::Sees)
    );
}

#[test]
fn nothing_is_followed_on_water() {
    let images = images(8);
    let mut eyes = eyes();
    let quay = [(40.0, 130.0), (280.0, 130.0), (280.0, 170.0), (40.0, 170.0)];
    let quay = quay.map(|(x, y)| Vector2::new(x, y)).to_vec();
    eyes.mask = ImageMask { quay: vec![quay], own_ship: Vec::new() };
    for (i, pixels) in images.iter().enumerate() {
        let known =
            Hints { down: Some(Vector3::y_axis()), ..hints(&pose(i), &pose(i.saturating_sub(1))) };
        let t = i as f64 / 10.0;
        let seen = eyes.take(&picture(&camera(Lens::STRAIGHT), t, pixels), &known).unwrap();
        let on_water = |y: f32, x: f32| {
            y > 120.0 && !((40.0..280.0).contains(&x) && (130.0..170.0).contains(&y))
        };
        assert!(seen.seen.iter().all(|track| !on_water(track.at[1], track.at[0])));
        assert!(seen.seen.iter().any(|track| track.at[1] > 130.0));
    }
}

#[test]
fn a_camera_too_small_to_be_halved_is_refused_at_once() {
    let mut tiny = camera(Lens::STRAIGHT);
    tiny.size = [32, 24];
    assert!(FrontEnd::new(tiny, FrontEndConfig::default()).is_none());
}
