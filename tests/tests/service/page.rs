//! Clients of the page that mean no good, or are many: what is sent to the bridge does not suffer.

use std::io::{Read, Write};
use std::net::TcpStream;
use std::sync::Arc;
use std::time::Duration;

use super::daemon::{Daemon, status, wait_until};
use super::heard::{attitudes, forget};
use super::ship::Ship;

const ALIGNED: f64 = 240.0;

fn stream(ship: &Ship) -> Option<TcpStream> {
    let mut stream = TcpStream::connect(ship.page).ok()?;
    let host = ship.page;
    write!(stream, "GET /api/v1/stream HTTP/1.1\r\nHost: {host}\r\n\r\n").ok()?;
    Some(stream)
}

#[test]
fn five_hundred_clients_that_read_and_one_that_never_does_cost_the_bridge_no_message() {
    let ship = Arc::new(Ship::under_way(ALIGNED + 90.0, 3));
    ship.leave_state(ALIGNED);
    let _sailing = ship.sail(ALIGNED);
    let mut daemon = Daemon::start(&ship);
    wait_until("navigating", || {
        status(ship.page).is_some_and(|own| own["mode"]["name"] == "aided")
    });
    let idle = stream(&ship).unwrap();
    let mut clients: Vec<TcpStream> = (0..500).filter_map(|_| stream(&ship)).collect();
    let mut garbage = TcpStream::connect(ship.page).unwrap();
    garbage.set_write_timeout(Some(Duration::from_secs(1))).unwrap();
    garbage.write_all(&[0xFF; 100_000]).ok();
    std::thread::sleep(Duration::from_secs(1));
    forget(&ship.output);
    let all = attitudes(&ship, 4.0);
    let is_served = |client: &mut TcpStream| {
        client.set_read_timeout(Some(Duration::from_millis(500))).unwrap();
        client.read(&mut [0; 64]).is_ok_and(|length| length > 0)
    };
    let served = clients.iter_mut().map(is_served).filter(|served| *served).count();
    println!("{} attitudes in four seconds, {served} clients served", all.len());
    let gaps = all.windows(2).map(|pair| (pair[1].at - pair[0].at).as_seconds());
    assert!(gaps.fold(0.0, f64::max) < 0.15, "an attitude is missing");
    assert!(all.len() > 30, "{} attitudes", all.len());
    assert!(served > 450, "{served} of 500 clients were served");
    drop((idle, clients, garbage));
    wait_until("the page is as before", || status(ship.page).is_some());
    let own = status(ship.page).unwrap();
    assert_eq!(own["outputs"][0]["dropped"], 0);
    let position =
        own["aids"].as_array().unwrap().iter().find(|aid| aid["name"] == "gnss_position");
    assert_eq!(position.unwrap()["in_use"], true);
    assert!(daemon.is_running());
    daemon.stop();
}
