//! Serves a made-up ship, so that the page can be looked at and worked on without sensors:
//!
//! ```text
//! cargo run -p insd-web --example show -- [alignment|underway|fault] [ADDRESS]
//! ```
//!
//! The token is `example-token-0123`.

use std::net::SocketAddr;
use std::time::Duration;

use insd_web::{Listen, WebConfig};

#[path = "../tests/scene/mod.rs"]
mod scene;

use scene::{Scene, Show};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut words = std::env::args().skip(1);
    let word = words.next().unwrap_or_else(|| "underway".to_owned());
    let scene = Scene::from_word(&word).ok_or("one of: alignment, underway, fault")?;
    let address: SocketAddr = words.next().as_deref().unwrap_or("127.0.0.1:8470").parse()?;
    let (publisher, viewer) = insd_web::channel();
    let (sender, mut orders) = insd_web::orders::channel();
    let config = WebConfig {
        listen: Listen::Address(address),
        token: Some("example-token-0123".to_owned()),
        ..WebConfig::default()
    };
    let page = insd_web::start(config, viewer, sender)?;
    println!("http://{}/", page.address());
    let mut show = Show::from_the_start(scene);
    // the past at twenty times its pace, so that there is a track
    while show.is_past() {
        publisher.publish(show.skip());
        std::thread::sleep(Duration::from_millis(55));
    }
    loop {
        show.obey(&mut orders);
        publisher.publish(show.next());
        std::thread::sleep(Duration::from_secs_f64(scene::STEP));
    }
}
