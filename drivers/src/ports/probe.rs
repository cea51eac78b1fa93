//! Finding the baud rate of a serial line by listening. Nothing is ever written.

use std::time::Duration;

use tokio::io::AsyncRead;
use tokio::time::timeout;

use super::judge::{BaudJudge, BaudJudgement, forget_oldest};
use super::stream::read;

/// How often bytes are judged while probing.
const SLICE: Duration = Duration::from_millis(100);

/// Listens for so long at one rate. Gives whether it fits.
///
/// # Errors
/// The reason for which the stream is lost.
pub(super) async fn probe<R: AsyncRead + Unpin>(
    reader: &mut R,
    judge: &BaudJudge,
    span: Duration,
) -> Result<bool, String> {
    let mut heard = Vec::new();
    let slices = (span.as_secs_f64() / SLICE.as_secs_f64()).ceil() as u32;
    for _ in 0..slices {
        let before = heard.len();
        // the end of a slice is not an error
        if let Ok(lost) = timeout(SLICE, gather(reader, &mut heard)).await {
            return Err(lost);
        }
        match judge.judge(&heard) {
            BaudJudgement::Fits => return Ok(true),
            BaudJudgement::Wrong if heard.len() > before => return Ok(false),
            _ => {}
        }
        forget_oldest(&mut heard);
    }
    Ok(false)
}

/// Collects until the stream is lost: it ends by being dropped.
async fn gather<R: AsyncRead + Unpin>(reader: &mut R, heard: &mut Vec<u8>) -> String {
    let mut bytes = Vec::new();
    loop {
        match read(reader, &mut bytes).await {
            Ok(()) => heard.extend_from_slice(&bytes),
            Err(reason) => return reason,
        }
        forget_oldest(heard);
        tokio::task::yield_now().await;
    }
}
