//! One connection to the broker. When it breaks it is gone: what was in flight is still in the spool, and the
//! next connection is a new one.

use std::time::Duration;

use rumqttc::v5::mqttbytes::QoS;
use rumqttc::v5::mqttbytes::v5::{PubAckReason, PublishProperties};
use rumqttc::v5::{AsyncClient, Event, EventLoop, Incoming, MqttOptions};
use tokio::sync::mpsc;
use tokio::task::JoinHandle;

use crate::payload::FleetMessage;
use crate::plan::BrokerPlan;

/// Time between two signs of life where nothing else is sent. Thin links pay for it, so it is long: what is in
/// flight has a patience of its own.
pub(crate) const KEEP_ALIVE: Duration = Duration::from_secs(300);
/// How long a connection may take to come about, s: over a satellite on a bad day.
const CONNECT_S: u64 = 30;
/// Messages that may wait for the connection.
const WAITING: usize = 8;
/// Largest message that is taken in, bytes.
pub(crate) const MAX_PACKET: u32 = 1 << 20;

/// What comes of a connection.
#[derive(Debug)]
pub(crate) enum LinkEvent {
    /// It has come about.
    Up,
    /// The message in flight was taken; whether anybody ashore has asked for such.
    Taken {
        /// Whether the broker has somebody to give it to.
        is_wanted: bool,
    },
    /// The broker does not take the message in flight.
    Refused(String),
    /// It is gone.
    Down(String),
}

/// A connection.
#[derive(Debug)]
pub(crate) struct Link {
    client: AsyncClient,
    events: mpsc::Receiver<LinkEvent>,
    task: JoinHandle<()>,
}

/// What the broker is called with.
///
/// # Errors
/// It is to be called over TLS, and that cannot be had.
pub(crate) fn options(plan: &BrokerPlan) -> Result<MqttOptions, String> {
    let mut options = MqttOptions::new(&plan.client, &plan.host, plan.port);
    options.set_keep_alive(KEEP_ALIVE).set_connection_timeout(CONNECT_S);
    options.set_max_packet_size(Some(MAX_PACKET));
    if let Some((user, password)) = &plan.login {
        options.set_credentials(user, password);
    }
    if let Some(authority) = &plan.tls {
        options.set_transport(crate::tls::transport(authority.as_deref())?);
    }
    Ok(options)
}

impl Link {
    /// Calls the broker. Within a runtime.
    pub(crate) fn open(plan: &BrokerPlan) -> Result<Self, String> {
        let (client, eventloop) = AsyncClient::new(options(plan)?, WAITING);
        let (sender, events) = mpsc::channel(WAITING);
        // the event loop must not be interrupted in the middle of a write, so it has a task of its own
        let task = tokio::spawn(drive(eventloop, sender));
        Ok(Link { client, events, task })
    }

    /// What comes next.
    pub(crate) async fn event(&mut self) -> LinkEvent {
        let gone = || LinkEvent::Down("the connection has ended".to_owned());
        self.events.recv().await.unwrap_or_else(gone)
    }

    /// Sends a message that the broker is to acknowledge.
    pub(crate) fn send(&self, message: FleetMessage) -> Result<(), String> {
        publish(&self.client, message)
    }

    /// Says farewell.
    pub(crate) fn close(&self) {
        // a connection that is gone needs none
        let _ = self.client.try_disconnect();
    }
}

impl Drop for Link {
    fn drop(&mut self) {
        self.task.abort();
    }
}

/// Hands a message over to a connection.
fn publish(client: &AsyncClient, message: FleetMessage) -> Result<(), String> {
    let properties = properties(&message);
    let FleetMessage { topic, payload, retain, .. } = message;
    let sent =
        client.try_publish_with_properties(topic, QoS::AtLeastOnce, retain, payload, properties);
    sent.map_err(|fault| fault.to_string())
}

/// The same, and waits until there is room for it.
pub(crate) async fn publish_waiting(
    client: &AsyncClient,
    message: FleetMessage,
) -> Result<(), String> {
    let properties = properties(&message);
    let FleetMessage { topic, payload, retain, .. } = message;
    let sent = client.publish_with_properties(topic, QoS::AtLeastOnce, retain, payload, properties);
    sent.await.map_err(|fault| fault.to_string())
}

fn properties(message: &FleetMessage) -> PublishProperties {
    let (run, first, last) = message.keys;
    let seconds =
        message.expiry.map(|span| span.as_seconds().clamp(1.0, f64::from(u32::MAX)) as u32);
    PublishProperties {
        payload_format_indicator: (message.content == "application/json").then_some(1),
        message_expiry_interval: seconds,
        content_type: Some(message.content.to_owned()),
        user_properties: vec![
            ("schema".to_owned(), crate::payload::SCHEMA.to_string()),
            ("run".to_owned(), run.to_string()),
            ("seq".to_owned(), format!("{first}-{last}")),
        ],
        ..PublishProperties::default()
    }
}

async fn drive(mut eventloop: EventLoop, sender: mpsc::Sender<LinkEvent>) {
    loop {
        let event = match eventloop.poll().await {
            Ok(Event::Incoming(Incoming::ConnAck(_))) => LinkEvent::Up,
            Ok(Event::Incoming(Incoming::PubAck(ack))) => match ack.reason {
                PubAckReason::Success => LinkEvent::Taken { is_wanted: true },
                PubAckReason::NoMatchingSubscribers => LinkEvent::Taken { is_wanted: false },
                reason => LinkEvent::Refused(format!("{reason:?}")),
            },
            Ok(_) => continue,
            Err(fault) => LinkEvent::Down(fault.to_string()),
        };
        let is_end = matches!(event, LinkEvent::Down(_));
        if sender.send(event).await.is_err() || is_end {
            return;
        }
    }
}
