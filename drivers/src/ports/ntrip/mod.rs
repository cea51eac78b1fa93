//! A mount point of an NTRIP caster: called, asked, listened to, told where the ship is.
//!
//! What the caster answers is told apart ([`answer`]); a stream that is silent, too slow or no RTCM 3 is given up
//! ([`watch`]). Whatever it is, the caster is called again, after pauses that grow up to a minute. No password is
//! in any word of ours ([`secret`]).

mod answer;
mod chunks;
mod config;
mod request;
mod secret;
mod tls;
mod watch;

use std::time::Duration;

use insd_base::Span;
use tokio::io::{AsyncRead, AsyncWrite, AsyncWriteExt};
use tokio::time::timeout;

use self::answer::Answer;
use self::chunks::Chunks;
pub use self::config::Ntrip;
pub(super) use self::secret::password;
pub use self::secret::read_password;
pub(super) use self::tls::secure;
use self::watch::Watch;
use super::outbox::Outbox;
use super::stream::{read, talk};
use super::teller::Teller;

/// Longest table of a caster, bytes.
const TABLE: usize = 256 * 1024;

/// Asks for the stream, listens and talks until it is lost; gives why. `password`: what [`password`] has given.
///
/// # Errors
/// Why there is no stream.
pub(super) async fn converse<S: AsyncRead + AsyncWrite + Unpin>(
    mut stream: S,
    config: &Ntrip,
    password: &str,
    teller: &mut Teller,
    outbox: Option<&Outbox>,
) -> Result<String, String> {
    let name = format!("ntrip {}/{}", config.address, config.mount);
    let limit = Duration::from_secs_f64(config.timeout_s);
    let asked = match timeout(limit, ask(&mut stream, config, password)).await {
        Ok(asked) => asked,
        Err(_) => Err(format!("no whole answer in {} s", config.timeout_s)),
    };
    let (version, is_chunked, rest) = match asked {
        Ok(Answer::Stream { version, is_chunked, rest }) => (version, is_chunked, rest),
        Ok(Answer::Table { rest }) => {
            let mut table = rest;
            let _ = timeout(limit, read_table(&mut stream, &mut table)).await;
            return Err(answer::of_table(&table, &config.mount));
        }
        Ok(Answer::Refused(why)) | Err(why) => return Err(why),
    };
    let secured = if config.tls { ", TLS" } else { "" };
    teller.open(format!("{name} ({version}{secured})"));
    let (reader, writer) = tokio::io::split(stream);
    Ok(tokio::select! {
        reason = follow(reader, (is_chunked, rest), config, teller) => reason,
        reason = talk(writer, outbox, None) => reason,
    })
}

/// Asks, and waits for the answer.
async fn ask<S: AsyncRead + AsyncWrite + Unpin>(
    stream: &mut S,
    config: &Ntrip,
    password: &str,
) -> Result<Answer, String> {
    let request = request::request(config, password);
    stream.write_all(&request).await.map_err(|error| error.to_string())?;
    let (mut heard, mut bytes) = (Vec::new(), Vec::new());
    loop {
        let is_closed = read(stream, &mut bytes).await.is_err();
        // who closes says no more: an answer without an end is a whole one
        heard.extend_from_slice(if is_closed { b"\r\n\r\n" } else { &bytes });
        let answer = answer::read(&heard, &config.mount).filter(|_| heard.len() > 4);
        match answer {
            Some(answer) => return Ok(answer),
            None if is_closed => return Err("closed by the caster without an answer".to_owned()),
            None => {}
        }
    }
}

/// The rest of a table, as far as it comes.
async fn read_table<S: AsyncRead + Unpin>(stream: &mut S, table: &mut Vec<u8>) {
    let mut bytes = Vec::new();
    while table.len() < TABLE && !answer::is_whole(table) {
        if read(stream, &mut bytes).await.is_err() {
            break;
        }
        table.extend_from_slice(&bytes);
    }
}

/// Tells what the stream says until it is lost; gives the reason.
async fn follow<R: AsyncRead + Unpin>(
    mut reader: R,
    (is_chunked, rest): (bool, Vec<u8>),
    config: &Ntrip,
    teller: &mut Teller,
) -> String {
    let mut chunks = is_chunked.then(Chunks::new);
    let mut watch = Watch::new(Span::from_seconds(config.timeout_s), teller.now().monotonic);
    let (mut bytes, mut held) = (rest, Vec::new());
    loop {
        let stamp = teller.now();
        held.clear();
        let taken = match &mut chunks {
            Some(chunks) => chunks.take(&bytes, &mut held),
            None => {
                held.extend_from_slice(&bytes);
                Ok(())
            }
        };
        if !held.is_empty() {
            teller.bytes(stamp, &held);
            watch.hear(&held);
        }
        let is_over = chunks.as_ref().is_some_and(Chunks::is_over);
        if let Err(reason) = taken {
            return reason;
        }
        if is_over {
            return "the caster ends the stream".to_owned();
        }
        if let Some(reason) = watch.look(stamp.monotonic) {
            return reason;
        }
        let rest = teller.rest().min(watch.rest(stamp.monotonic));
        match timeout(rest, read(&mut reader, &mut bytes)).await {
            Ok(Ok(())) => {}
            Ok(Err(reason)) => return reason,
            Err(_) => {
                bytes.clear();
                teller.tick();
            }
        }
    }
}
