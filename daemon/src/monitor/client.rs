//! Reads the interface of the status page.

use std::io::{BufRead, BufReader, Read};
use std::sync::Arc;
use std::thread::JoinHandle;
use std::time::Duration;

use anyhow::Context;

use super::board::Board;

/// How long a connection or an answer may take to begin.
const PATIENCE: Duration = Duration::from_secs(5);
/// Pause before another attempt.
const PAUSE: Duration = Duration::from_secs(1);
/// Longest line of the stream, and longest answer, bytes.
const LONGEST: u64 = 8 * 1024 * 1024;

/// A program whose status is read.
#[derive(Clone, Debug)]
pub struct Client {
    url: String,
    agent: ureq::Agent,
}

impl Client {
    /// The program whose page is at this address.
    #[must_use]
    pub fn new(url: &str) -> Self {
        let config = ureq::Agent::config_builder()
            .timeout_connect(Some(PATIENCE))
            .timeout_recv_response(Some(PATIENCE))
            .build();
        Client { url: url.trim_end_matches('/').to_owned(), agent: config.into() }
    }

    /// Where it is.
    #[must_use]
    pub fn url(&self) -> &str {
        &self.url
    }

    /// The snapshot of this moment, as JSON.
    ///
    /// # Errors
    /// The program cannot be reached, or has nothing to tell yet.
    pub fn fetch(&self) -> anyhow::Result<String> {
        let url = format!("{}/api/v1/status", self.url);
        let mut answer = self.agent.get(&url).call().with_context(|| url.clone())?;
        let body = answer.body_mut().with_config().limit(LONGEST);
        body.read_to_string().with_context(|| url)
    }

    /// Follows the stream on a thread of its own, again and again, until the program ends.
    ///
    /// # Errors
    /// The system grants no thread.
    pub fn follow(self, board: Arc<Board>) -> std::io::Result<JoinHandle<()>> {
        std::thread::Builder::new().name("monitor".to_owned()).spawn(move || {
            loop {
                let fault = match self.read(&board) {
                    Ok(()) => "the program has ended the connection".to_owned(),
                    Err(fault) => format!("{fault:#}"),
                };
                board.disconnect(fault);
                std::thread::sleep(PAUSE);
            }
        })
    }

    fn read(&self, board: &Board) -> anyhow::Result<()> {
        let url = format!("{}/api/v1/stream?hz=5", self.url);
        let answer = self.agent.get(&url).call().with_context(|| url)?;
        board.connect();
        let mut reader = BufReader::new(answer.into_body().into_reader());
        let (mut event, mut line) = (String::new(), String::new());
        loop {
            line.clear();
            if reader.by_ref().take(LONGEST).read_line(&mut line)? == 0 {
                return Ok(());
            }
            if let Some(name) = line.strip_prefix("event: ") {
                name.trim_end().clone_into(&mut event);
            } else if let Some(data) = line.strip_prefix("data: ") {
                board.take(&event, data.trim_end());
            }
        }
    }
}
