//! A caster of NTRIP 2 on a port of this computer: one mount point, one caller after the other.

use std::io::{Read, Write};
use std::net::{TcpListener, TcpStream};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread;

/// What it says when it likes the call.
const STREAM: &[u8] = b"HTTP/1.1 200 OK\r\nNtrip-Version: Ntrip/2.0\r\nContent-Type: gnss/data\r\n\
                        Transfer-Encoding: chunked\r\n\r\n";
const REFUSED: &[u8] = b"HTTP/1.1 401 Unauthorized\r\n\r\n";

/// A caster that is fed by a test.
#[derive(Debug)]
pub struct Caster {
    address: String,
    shared: Arc<Mutex<Shared>>,
}

#[derive(Debug, Default)]
struct Shared {
    caller: Option<TcpStream>,
    asked: Vec<String>,
    heard: Vec<u8>,
}

impl Caster {
    /// A caster that wants these words in each request, as `Authorization: Basic ...`; another one is refused.
    ///
    /// # Errors
    /// What the system says.
    pub fn new(wanted: &'static str) -> std::io::Result<Self> {
        let door = TcpListener::bind("127.0.0.1:0")?;
        let address = door.local_addr()?.to_string();
        let shared = Arc::new(Mutex::new(Shared::default()));
        let own = Arc::clone(&shared);
        // it ends with the process
        thread::spawn(move || {
            for mut caller in door.incoming().flatten() {
                let Some(asked) = request(&mut caller) else { continue };
                let is_wanted = asked.contains(wanted);
                own.lock().unwrap_or_else(PoisonError::into_inner).asked.push(asked);
                let answer = if is_wanted { STREAM } else { REFUSED };
                if caller.write_all(answer).is_err() || !is_wanted {
                    continue;
                }
                let Ok(reader) = caller.try_clone() else { continue };
                own.lock().unwrap_or_else(PoisonError::into_inner).caller = Some(caller);
                listen(reader, &own);
            }
        });
        Ok(Caster { address, shared })
    }

    /// Host and port.
    #[must_use]
    pub fn address(&self) -> &str {
        &self.address
    }

    /// Sends bytes as one chunk to who calls; to nobody if nobody does.
    pub fn send(&self, bytes: &[u8]) {
        let mut own = self.shared.lock().unwrap_or_else(PoisonError::into_inner);
        let Some(caller) = &mut own.caller else { return };
        let chunk = [format!("{:x}\r\n", bytes.len()).as_bytes(), bytes, b"\r\n"].concat();
        if caller.write_all(&chunk).is_err() {
            own.caller = None;
        }
    }

    /// Drops who calls.
    pub fn drop_caller(&self) {
        let caller = self.shared.lock().unwrap_or_else(PoisonError::into_inner).caller.take();
        if let Some(caller) = caller {
            let _ = caller.shutdown(std::net::Shutdown::Both);
        }
    }

    /// All requests so far.
    #[must_use]
    pub fn asked(&self) -> Vec<String> {
        self.shared.lock().unwrap_or_else(PoisonError::into_inner).asked.clone()
    }

    /// All that callers have told.
    #[must_use]
    pub fn heard(&self) -> String {
        let own = self.shared.lock().unwrap_or_else(PoisonError::into_inner);
        String::from_utf8_lossy(&own.heard).into_owned()
    }
}

/// The request of a call; `None` if it ends before.
fn request(caller: &mut TcpStream) -> Option<String> {
    let mut asked = Vec::new();
    while !asked.ends_with(b"\r\n\r\n") {
        let mut byte = [0];
        caller.read_exact(&mut byte).ok()?;
        asked.extend(byte);
    }
    String::from_utf8(asked).ok()
}

/// Hears what a caller tells until it ends.
fn listen(mut reader: TcpStream, shared: &Mutex<Shared>) {
    let mut bytes = [0; 1024];
    while let Ok(count) = reader.read(&mut bytes) {
        if count == 0 {
            return;
        }
        let mut own = shared.lock().unwrap_or_else(PoisonError::into_inner);
        own.heard.extend_from_slice(&bytes[..count]);
    }
}
