//! What the front end costs at 640 x 480 px, 10 images a second and 200 tracks: `cargo run --release -p insd-capture --example front_end_cost`.
//! Processor time of all threads, not time on the wall; beside it that of copying each image into numbers and halving it once.

use anyhow::Context;
use insd_base::Time;
use insd_vision::{CameraCalibration, CameraImage, FrontEnd, FrontEndConfig, Hints, Lens};
use nalgebra::{Rotation3, Vector2};
use rustix::time::{ClockId, clock_gettime};

const SIZE: [u32; 2] = [640, 480];
const IMAGES: u32 = 200;
/// Side of the scene that the camera sails along, px.
const SCENE: usize = 2048;

fn main() -> anyhow::Result<()> {
    let scene = scene();
    let images: Vec<Vec<u8>> = (0..IMAGES).map(|i| view(&scene, i)).collect();
    let (focal, centre) = (Vector2::new(500.0, 500.0), Vector2::new(320.0, 240.0));
    let lens = Lens::RadialTangential { k: [-0.05, 0.01, 0.0, 0.0, 0.0, 0.0], p: [0.0; 2] };
    let camera = CameraCalibration { focal, centre, size: SIZE, lens };
    let mut eyes = FrontEnd::new(camera, FrontEndConfig::default()).context("small images")?;
    let known = Hints { rotation: Some(Rotation3::identity()), down: None };
    let (mut tracks, mut kept) = (0, 0);
    let start = processor_seconds();
    for (i, pixels) in images.iter().enumerate() {
        let picture = CameraImage { time: Time::from_seconds(i as f64 / 10.0), size: SIZE, pixels };
        let seen = eyes.take(&picture, &known).map_err(|reason| anyhow::anyhow!(reason.text()))?;
        tracks += seen.seen.len();
        kept += seen.seen.iter().filter(|track| track.length > 1).count();
    }
    let front_end = (processor_seconds() - start) / f64::from(IMAGES);
    let start = processor_seconds();
    let halved: f32 = images.iter().map(|pixels| halve(pixels)).sum();
    let copying = (processor_seconds() - start) / f64::from(IMAGES);
    let mean = |count: usize| count as f64 / f64::from(IMAGES);
    println!(
        "{:.0} tracks an image, of which {:.0} go on (mean grey level of halves {:.1})",
        mean(tracks),
        mean(kept),
        halved / IMAGES as f32
    );
    println!(
        "front end {:.1} ms an image: {:.1} % of a core at 10 images a second",
        1e3 * front_end,
        1e3 * front_end
    );
    println!(
        "copy and one halving {:.2} ms an image: the front end is {:.0} times that",
        1e3 * copying,
        front_end / copying
    );
    Ok(())
}

fn processor_seconds() -> f64 {
    let time = clock_gettime(ClockId::ProcessCPUTime);
    time.tv_sec as f64 + time.tv_nsec as f64 * 1e-9
}

/// Squares of all sizes and greys.
fn scene() -> Vec<u8> {
    let mut scene = vec![100; SCENE * SCENE];
    let mut state = 1_u64;
    let mut draw = |below: usize| {
        state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as usize % below
    };
    for _ in 0..6000 {
        let (x, y, grey) = (draw(SCENE - 40), draw(SCENE - 40), draw(256) as u8);
        let (width, height) = (6 + draw(30), 6 + draw(30));
        for row in y..y + height {
            scene[row * SCENE + x..row * SCENE + x + width].fill(grey);
        }
    }
    scene
}

/// The scene as it has gone by.
fn view(scene: &[u8], image: u32) -> Vec<u8> {
    let [width, height] = SIZE.map(|side| side as usize);
    let (x, y) = (5 * image as usize % (SCENE - width), 2 * image as usize % (SCENE - height));
    (y..y + height)
        .flat_map(|row| scene[row * SCENE + x..row * SCENE + x + width].iter().copied())
        .collect()
}

/// Copies an image into numbers, halves it, and tells its mean.
fn halve(pixels: &[u8]) -> f32 {
    let numbers: Vec<f32> = pixels.iter().map(|pixel| f32::from(*pixel)).collect();
    let [width, height] = SIZE.map(|side| side as usize);
    let mut half = Vec::with_capacity(width * height / 4);
    for rows in numbers.chunks_exact(2 * width) {
        let (above, below) = rows.split_at(width);
        let pairs = above.chunks_exact(2).zip(below.chunks_exact(2));
        half.extend(pairs.map(|(a, b)| (a[0] + a[1] + b[0] + b[1]) / 4.0));
    }
    half.iter().sum::<f32>() / half.len() as f32
}
