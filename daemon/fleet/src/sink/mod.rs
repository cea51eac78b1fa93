//! Takes in ashore what ships tell. A message is acknowledged when its records are written, so what a crash of
//! anybody interrupts comes again; what comes twice has the same key.

pub mod board;
pub mod columns;
pub mod lines;
pub mod postgres;
pub mod row;

use std::io::{self, Write};
use std::time::Duration;

use rumqttc::v5::mqttbytes::QoS;
use rumqttc::v5::mqttbytes::v5::{Publish, SubscribeReasonCode};
use rumqttc::v5::{AsyncClient, Event, EventLoop, Incoming};
use tokio::sync::mpsc;

use crate::link;
use crate::plan::BrokerPlan;
use board::FleetBoard;
use postgres::PostgresSession;
use row::FleetRow;

/// Messages that may be on their way without an acknowledgement.
const INFLIGHT: u16 = 4096;
/// The broker keeps for so long what comes while nobody is here, s: thirty days.
const SESSION_S: u32 = 30 * 86_400;
/// Messages that are written together at the most, and the time for which others are waited for.
const TOGETHER: usize = 2000;
const GATHER: Duration = Duration::from_millis(20);
/// Time between two attempts.
const AGAIN: Duration = Duration::from_secs(2);
/// Time between two lines of the journal on how it is going.
const ACCOUNT: Duration = Duration::from_secs(60);

/// Where rows go.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum SinkTarget {
    /// A database of PostgreSQL, as psql takes it.
    Postgres(String),
    /// Line protocol on standard output.
    Lines,
    /// Nowhere: for the page alone.
    Nowhere,
}

/// What a sink is told.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SinkPlan {
    /// The broker. The name of the client is that of the session which the broker keeps.
    pub broker: BrokerPlan,
    /// What topics begin with.
    pub prefix: String,
    /// Where rows go.
    pub target: SinkTarget,
}

/// What was taken in.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub struct SinkCounts {
    /// Messages.
    pub messages: u64,
    /// Rows in them, repeats among them.
    pub rows: u64,
    /// Bytes of their payloads.
    pub bytes: u64,
    /// Messages that are none of ours.
    pub refused: u64,
}

/// A message, and who is to acknowledge it.
type Came = (AsyncClient, Publish);

/// Takes in what comes, for ever. Within a runtime.
///
/// # Errors
/// Standard output takes no more lines, or the broker is to be called over TLS and that cannot be had.
pub async fn run(plan: SinkPlan, board: FleetBoard) -> io::Result<()> {
    // whoever can be called at all can be called again
    link::options(&plan.broker).map_err(io::Error::other)?;
    let (sender, mut receiver) = mpsc::channel(TOGETHER);
    let caller = tokio::spawn(call(plan.clone(), sender));
    let mut writer = Writer::new(plan.target.clone());
    let mut counts = SinkCounts::default();
    let mut account = tokio::time::interval(ACCOUNT);
    loop {
        let first = tokio::select! {
            first = receiver.recv() => first,
            _ = account.tick() => {
                tell(&counts, &board);
                continue;
            }
        };
        let Some(first) = first else { break };
        let came = gather(first, &mut receiver).await;
        let rows = read(&plan.prefix, &came, &mut counts);
        writer.write(&rows).await?;
        rows.iter().for_each(|row| board.note(row));
        for (client, publish) in &came {
            // a connection that is gone takes no word; the broker sends the message again
            let _ = client.try_ack(publish);
        }
    }
    caller.await.map_err(io::Error::other)
}

fn tell(counts: &SinkCounts, board: &FleetBoard) {
    let SinkCounts { messages, rows, bytes, refused } = *counts;
    tracing::info!(ships = board.ships(), messages, rows, bytes, refused, "taken in");
}

/// Those that come close together.
async fn gather(first: Came, receiver: &mut mpsc::Receiver<Came>) -> Vec<Came> {
    let mut came = vec![first];
    let until = tokio::time::sleep(GATHER);
    tokio::pin!(until);
    while came.len() < TOGETHER {
        tokio::select! {
            next = receiver.recv() => match next {
                Some(next) => came.push(next),
                None => break,
            },
            () = &mut until => break,
        }
    }
    came
}

fn read(prefix: &str, came: &[Came], counts: &mut SinkCounts) -> Vec<FleetRow> {
    let mut all = Vec::new();
    for (_, publish) in came {
        let topic = String::from_utf8_lossy(&publish.topic);
        counts.messages += 1;
        counts.bytes += publish.payload.len() as u64;
        match row::rows(prefix, &topic, &publish.payload) {
            Ok(rows) => all.extend(rows),
            Err(why) => {
                counts.refused += 1;
                tracing::warn!(%topic, why, "a message is left out");
            }
        }
    }
    counts.rows += all.len() as u64;
    all
}

/// Writes rows, and does not give up.
struct Writer {
    target: SinkTarget,
    session: Option<PostgresSession>,
}

impl Writer {
    fn new(target: SinkTarget) -> Self {
        Writer { target, session: None }
    }

    async fn write(&mut self, rows: &[FleetRow]) -> io::Result<()> {
        match self.target.clone() {
            SinkTarget::Nowhere => Ok(()),
            SinkTarget::Lines => {
                let text: String =
                    rows.iter().filter_map(lines::line).map(|line| line + "\n").collect();
                let mut out = io::stdout().lock();
                out.write_all(text.as_bytes())?;
                out.flush()
            }
            SinkTarget::Postgres(target) => {
                while let Err(fault) = self.transact(&target, rows).await {
                    tracing::error!(%fault, "the database does not take it: again in a moment");
                    self.session = None;
                    tokio::time::sleep(AGAIN).await;
                }
                Ok(())
            }
        }
    }

    async fn transact(&mut self, target: &str, rows: &[FleetRow]) -> io::Result<()> {
        if self.session.is_none() {
            self.session = Some(PostgresSession::start(target).await?);
        }
        match &mut self.session {
            Some(session) => session.write(rows).await,
            None => Ok(()),
        }
    }
}

/// Calls the broker again and again, and hands over what comes.
async fn call(plan: SinkPlan, sender: mpsc::Sender<Came>) {
    loop {
        let Ok(mut options) = link::options(&plan.broker) else { return };
        options.set_clean_start(false).set_manual_acks(true);
        options.set_session_expiry_interval(Some(SESSION_S));
        options.set_receive_maximum(Some(INFLIGHT));
        // room for all acknowledgements: the connection waits for the writer, never the writer for it
        let (client, eventloop) = AsyncClient::new(options, usize::from(INFLIGHT) + 16);
        if let Err(why) = listen(&plan, client, eventloop, &sender).await {
            tracing::warn!(why, "the broker cannot be reached: again in a moment");
        }
        if sender.is_closed() {
            return;
        }
        tokio::time::sleep(AGAIN).await;
    }
}

/// Subscribes, and hands over what comes until the connection is gone.
async fn listen(
    plan: &SinkPlan,
    client: AsyncClient,
    mut eventloop: EventLoop,
    sender: &mpsc::Sender<Came>,
) -> Result<(), String> {
    // the state is kept by the broker anyway: what is missed of it is not worth queueing
    let wanted =
        [("log", QoS::AtLeastOnce), ("alert", QoS::AtLeastOnce), ("state", QoS::AtMostOnce)];
    for (what, quality) in wanted {
        let filter = format!("{}/+/{what}", plan.prefix);
        client.try_subscribe(filter, quality).map_err(|fault| fault.to_string())?;
    }
    loop {
        let event = eventloop.poll().await.map_err(|fault| fault.to_string())?;
        if let Some(publish) = heard(plan, event)?
            && sender.send((client.clone(), publish)).await.is_err()
        {
            return Ok(());
        }
    }
}

/// What somebody has told, if it is that.
fn heard(plan: &SinkPlan, event: Event) -> Result<Option<Publish>, String> {
    match event {
        Event::Incoming(Incoming::Publish(publish)) => return Ok(Some(publish)),
        Event::Incoming(Incoming::ConnAck(_)) => {
            tracing::info!(host = plan.broker.host, port = plan.broker.port, "the broker answers");
        }
        Event::Incoming(Incoming::SubAck(ack)) => {
            let is_granted =
                |code: &SubscribeReasonCode| matches!(code, SubscribeReasonCode::Success(_));
            if !ack.return_codes.iter().all(is_granted) {
                return Err(format!("the broker grants no subscription: {:?}", ack.return_codes));
            }
        }
        _ => {}
    }
    Ok(None)
}
