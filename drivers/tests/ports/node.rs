//! Nodes of NMEA 2000 that ports drive on a bus in memory, in tokio's time, which passes when all wait.

use std::sync::Arc;
use std::time::Duration;

use insd_base::{BusEvent, CanFrame, PortId, Span, Stamp, Time, UtcTime};
use insd_drivers::can::memory::{MemoryBus, MemoryEnd};
use insd_drivers::can::{CanBus, Heard, Sending, SharedSpeaker, spawn_on};
use insd_drivers::ports::{Clock, PortHandle, Receiver, Surroundings, WAITING_LIMIT, queue};
use insd_n2k::node::{Node, NodeConfig, ProductInfo, Transmit};
use insd_n2k::{ADDRESS_CLAIM, Assembler, BROADCAST, N2kId, NameParts};
use tokio::time::{sleep, timeout};

const PRODUCT: u32 = 126_996;
const HEADING: u32 = 127_250;

struct TokioTime(tokio::time::Instant);

impl TokioTime {
    #[expect(clippy::disallowed_methods, reason = "tests run on tokio's clock")]
    fn start() -> Arc<dyn Clock> {
        Arc::new(TokioTime(tokio::time::Instant::now()))
    }
}

impl Clock for TokioTime {
    fn now(&self) -> Stamp {
        let nanos = self.0.elapsed().as_nanos() as i64;
        Stamp { monotonic: Time::from_nanos(nanos), system: UtcTime::from_nanos(nanos) }
    }
}

fn node(unique_number: u32) -> Node {
    let name = NameParts {
        unique_number,
        manufacturer: 999,
        instance_lower: 0,
        instance_upper: 0,
        function: 175,
        class: 60,
        system_instance: 0,
        industry: 4,
        arbitrary_address: true,
    };
    let interval = Span::from_seconds(0.1);
    let heading = Transmit { pgn: HEADING, priority: 2, interval, enabled: true };
    let config = NodeConfig {
        name: name.name().unwrap(),
        address: 40,
        product: ProductInfo {
            n2k_version: 2100,
            product_code: 1,
            model: "insd".to_owned(),
            software: "0.1.0".to_owned(),
            hardware: "none".to_owned(),
            serial: unique_number.to_string(),
            certification: 255,
            load: 0,
        },
        installation: [String::new(), String::new()],
        manufacturer_info: String::new(),
        transmit: vec![heading],
        receive: Vec::new(),
        commands: true,
    };
    Node::new(config, u64::from(unique_number))
}

/// Two nodes that want the same address, each on a port of its own, and somebody who listens.
struct Ship {
    bus: MemoryBus,
    clock: Arc<dyn Clock>,
    nodes: Vec<SharedSpeaker<Node>>,
    listener: MemoryEnd,
    _ports: Vec<PortHandle>,
    _receiver: Receiver,
}

impl Ship {
    async fn under_way() -> Self {
        let clock = TokioTime::start();
        let (queue, receiver) = queue(WAITING_LIMIT);
        let surroundings = Surroundings { clock: Arc::clone(&clock), queue, judge: None };
        let bus = MemoryBus::new(Arc::clone(&clock));
        let listener = bus.end().unwrap();
        let nodes = vec![SharedSpeaker::new(node(1000)), SharedSpeaker::new(node(2000))];
        let ports = nodes.iter().zip(1..).map(|(node, port)| {
            let (patience, node) = (Span::from_seconds(3.0), Some(node.for_port()));
            spawn_on(PortId(port), bus.clone(), patience, surroundings.clone(), node)
        });
        let ports = ports.collect();
        let mut ship = Ship { bus, clock, nodes, listener, _ports: ports, _receiver: receiver };
        sleep(Duration::from_secs(2)).await;
        ship.heard().await;
        ship
    }

    fn addresses(&self) -> Vec<Option<u8>> {
        self.nodes.iter().map(|node| node.with(|node| node.address())).collect()
    }

    /// All frames since the last call.
    async fn heard(&mut self) -> Vec<(N2kId, CanFrame)> {
        let mut frames = Vec::new();
        while let Ok(heard) = timeout(Duration::from_millis(1), self.listener.next(false)).await {
            if let Heard::Frame(_, frame) = heard.unwrap() {
                frames.push((N2kId::parse(frame.id()).unwrap(), frame));
            }
        }
        frames
    }

    fn ask(&mut self, pgn: u32, destination: u8) {
        let [low, middle, high, _] = pgn.to_le_bytes();
        let id = N2kId { priority: 6, pgn: 59_904, source: 99, destination };
        let request = CanFrame::new(id.compose(), &[low, middle, high]).unwrap();
        assert_eq!(self.listener.try_send(&request), Ok(Sending::Sent));
    }
}

#[tokio::test(start_paused = true)]
async fn nodes_agree_on_addresses_and_answer_within_milliseconds() {
    let mut ship = Ship::under_way().await;
    let [Some(one), Some(two)] = ship.addresses()[..] else { panic!("{:?}", ship.addresses()) };
    assert!(one == 40 && two != 40, "the lower NAME has the address");
    let asked = ship.clock.now().monotonic;
    ship.ask(ADDRESS_CLAIM, BROADCAST);
    let mut claims = Vec::new();
    while claims.len() < 2 {
        if let Ok(Heard::Frame(_, frame)) = ship.listener.next(false).await {
            let id = N2kId::parse(frame.id()).unwrap();
            assert_eq!(id.pgn, ADDRESS_CLAIM);
            claims.push(id.source);
        }
    }
    let span = ship.clock.now().monotonic - asked;
    assert!(span < Span::from_seconds(0.02), "{span:?}");
    claims.sort_unstable();
    assert_eq!(claims, [one, two]);
}

#[tokio::test(start_paused = true)]
async fn a_message_of_twenty_frames_leaves_whole_while_there_is_little_room() {
    let mut ship = Ship::under_way().await;
    ship.ask(PRODUCT, 40);
    let mut assembler = Assembler::new();
    let mut product = None;
    for step in 0..200_u32 {
        ship.bus.room(Some(2));
        let now = ship.clock.now().monotonic;
        // a heading every time comes between
        ship.nodes[0].with(|node| node.send(HEADING, &[step as u8; 8], now));
        sleep(Duration::from_millis(7)).await;
        for (_, frame) in ship.heard().await {
            let whole = assembler.take(&frame, ship.clock.now().monotonic);
            product = product.or(whole.filter(|whole| whole.message.pgn == PRODUCT));
        }
    }
    assert_eq!(product.unwrap().message.data.len(), 134);
    let counts = assembler.counts();
    assert_eq!((counts.gaps, counts.orphans, counts.superseded, counts.stale), (0, 0, 0, 0));
}

#[tokio::test(start_paused = true)]
async fn the_address_is_claimed_anew_when_the_bus_or_the_controller_is_back() {
    let mut ship = Ship::under_way().await;
    let addresses = ship.addresses();
    for trouble in ["bus off", "bus off without a word of its end", "down"] {
        match trouble {
            "down" => ship.bus.down(),
            _ => ship.bus.say(BusEvent::BusOff),
        }
        sleep(Duration::from_millis(100)).await;
        assert_eq!(ship.addresses(), [None, None], "{trouble}");
        match trouble {
            "down" => {
                ship.bus.up();
                ship.listener = ship.bus.end().unwrap();
            }
            "bus off" => ship.bus.say(BusEvent::Restarted),
            _ => sleep(Duration::from_secs(1)).await,
        }
        sleep(Duration::from_secs(2)).await;
        assert_eq!(ship.addresses(), addresses, "{trouble}");
        let heard = ship.heard().await;
        let claims = heard.iter().filter(|(id, _)| id.pgn == ADDRESS_CLAIM).count();
        assert!(claims >= 2, "{trouble}: {claims} claims");
    }
}
