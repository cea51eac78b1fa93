//! A page that is served for a test, and the simplest of clients.

#![allow(dead_code)] // each test uses a part of it

use std::io::{Read, Write};
use std::net::{SocketAddr, TcpListener, TcpStream};
use std::time::Duration;

use insd_web::{Listen, OrderReceiver, Publisher, Viewer, WebConfig, WebHandle};

use crate::scene::{Scene, Show};

pub(crate) const TOKEN: &str = "a token for the tests";

/// A page with a scene to show.
pub(crate) struct House {
    pub(crate) publisher: Publisher,
    pub(crate) viewer: Viewer,
    pub(crate) orders: OrderReceiver,
    pub(crate) show: Show,
    pub(crate) handle: Option<WebHandle>,
    pub(crate) address: SocketAddr,
}

/// Anywhere on this computer, with a token.
pub(crate) fn with_token() -> WebConfig {
    WebConfig { token: Some(TOKEN.to_owned()), ..WebConfig::default() }
}

impl House {
    /// Served at any free port; one snapshot is published, and seen.
    pub(crate) fn open(config: WebConfig) -> Self {
        House::showing(Scene::Underway, config)
    }

    pub(crate) fn showing(scene: Scene, config: WebConfig) -> Self {
        let listener = TcpListener::bind(("127.0.0.1", 0)).unwrap();
        let address = listener.local_addr().unwrap();
        let (publisher, viewer) = insd_web::channel();
        let (sender, orders) = insd_web::orders::channel();
        let config = WebConfig { listen: Listen::Inherited(listener), ..config };
        let handle = Some(insd_web::start(config, viewer.clone(), sender).unwrap());
        let show = Show::new(scene);
        let mut house = House { publisher, viewer, orders, show, handle, address };
        house.publish();
        while !house.get("/health").starts_with("HTTP/1.1 200") {
            std::thread::sleep(Duration::from_millis(5));
        }
        house
    }

    pub(crate) fn publish(&mut self) {
        self.show.obey(&mut self.orders);
        self.publisher.publish(self.show.next());
    }

    pub(crate) fn connect(&self) -> TcpStream {
        let stream = TcpStream::connect(self.address).unwrap();
        stream.set_read_timeout(Some(Duration::from_secs(20))).unwrap();
        stream.set_write_timeout(Some(Duration::from_secs(20))).unwrap();
        stream
    }

    /// What is answered to these bytes until the connection ends.
    pub(crate) fn raw(&self, request: &str) -> String {
        let mut stream = self.connect();
        // the other side may answer before it has read all
        let _ = stream.write_all(request.as_bytes());
        let mut answer = Vec::new();
        let _ = stream.read_to_end(&mut answer);
        String::from_utf8_lossy(&answer).into_owned()
    }

    pub(crate) fn get(&self, path: &str) -> String {
        self.raw(&format!("GET {path} HTTP/1.1\r\nhost: localhost\r\nconnection: close\r\n\r\n"))
    }

    pub(crate) fn post(&self, path: &str, token: Option<&str>, body: &str) -> String {
        let token = token.map(|token| format!("authorization: Bearer {token}\r\n"));
        let head = format!(
            "POST {path} HTTP/1.1\r\nhost: localhost\r\nconnection: close\r\n{}content-length: {}\r\n\r\n",
            token.unwrap_or_default(),
            body.len()
        );
        self.raw(&(head + body))
    }
}

/// The body of an answer.
pub(crate) fn body(answer: &str) -> &str {
    answer.split_once("\r\n\r\n").map_or("", |(_, body)| body)
}
