//! Files and named pipes.

use tokio::fs::OpenOptions;
use tokio::io::{AsyncReadExt, AsyncWriteExt};
use tokio::net::unix::pipe;

use super::attempt::Outcome;
use super::config::File;
use super::outbox::Outbox;
use super::stream::{READ, listen as listen_to};
use super::teller::Teller;

/// Reads a file once to its end, waiting for the consumer: a file does not run away. A file that
/// fails half-way ends there, as it could only be read again from its beginning.
pub(super) async fn read_whole(config: &File, teller: &mut Teller) -> Outcome {
    let path = config.path.display();
    let mut file = match tokio::fs::File::open(&config.path).await {
        Ok(file) => file,
        Err(error) => return Outcome::Absent(format!("{path}: {error}")),
    };
    teller.open(path.to_string());
    let mut bytes = Vec::with_capacity(READ);
    loop {
        teller.room().await;
        bytes.clear();
        match file.read_buf(&mut bytes).await {
            Ok(0) => return Outcome::Ended,
            Ok(_) => teller.bytes(teller.now(), &bytes),
            Err(error) => {
                teller.lost(error.to_string());
                return Outcome::Ended;
            }
        }
    }
}

/// Listens to a named pipe until its writer goes.
pub(super) async fn listen(config: &File, teller: &mut Teller) -> Outcome {
    let path = config.path.display();
    let receiver = match pipe::OpenOptions::new().open_receiver(&config.path) {
        Ok(receiver) => receiver,
        Err(error) => return Outcome::Absent(format!("{path}: {error}")),
    };
    teller.open(path.to_string());
    Outcome::Lost(listen_to(receiver, teller, None, None).await)
}

/// Writes messages at the end of a file until it fails: a full disk, for example. Then the last
/// message may be there in part.
pub(super) async fn append(config: &File, teller: &mut Teller, outbox: &Outbox) -> Outcome {
    let path = config.path.display();
    let mut file = match OpenOptions::new().append(true).create(true).open(&config.path).await {
        Ok(file) => file,
        Err(error) => return Outcome::Absent(format!("{path}: {error}")),
    };
    teller.open(path.to_string());
    loop {
        let message = outbox.next().await;
        let written = file.write_all(message.bytes()).await;
        // the file is written by another thread, which tells here what became of it
        match written.and(file.flush().await) {
            Ok(()) => message.written(outbox.now()),
            Err(error) => return Outcome::Lost(error.to_string()),
        }
    }
}
