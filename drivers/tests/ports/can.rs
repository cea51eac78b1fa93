//! CAN adapters at a serial line, gateways, logs.

use std::time::Duration;

use insd_base::{BusEvent, CanFrame, CanId, Input, PortId, PortState, Time};
use insd_drivers::can::{
    CanFilter, Candump, GatewayFormat, GatewayTcp, GatewayUdp, SharedSpeaker, Slcan, Speaker, spawn,
};
use insd_drivers::ports::{PortConfig, PortHandle, Transport};
use tokio::io::{AsyncReadExt, AsyncWriteExt};
use tokio::net::{TcpListener, UdpSocket};
use tokio::time::sleep;

use crate::host::{Device, Host};

/// Says what it was given.
#[derive(Default)]
struct Sayer(std::collections::VecDeque<CanFrame>);

impl Speaker for Sayer {
    fn up(&mut self, _: Time) {}
    fn down(&mut self, _: Time) {}
    fn bus_event(&mut self, _: BusEvent, _: Time) {}
    fn hear(&mut self, _: &CanFrame, _: Time) {}
    fn wake(&mut self, _: Time) {}
    fn wake_at(&self) -> Option<Time> {
        None
    }
    fn next_frame(&mut self, _: Time) -> Option<CanFrame> {
        self.0.front().copied()
    }
    fn sent(&mut self, _: Time) {
        self.0.pop_front();
    }
    fn refused(&mut self, _: Time) {}
}

fn frame(data: &[u8]) -> CanFrame {
    CanFrame::new(CanId::Extended(0x09F1_1223), data).unwrap()
}

/// A node that says this frame.
fn saying(frame: CanFrame) -> SharedSpeaker {
    SharedSpeaker::new(Sayer([frame].into())).for_port()
}

fn can_port(host: &Host, transport: Transport, node: Option<SharedSpeaker>) -> PortHandle {
    let config = PortConfig::new(transport);
    assert_eq!(config.faults(), Vec::<String>::new());
    let config = config.as_can().unwrap();
    spawn(PortId(1), config, host.surroundings.clone(), node)
}

impl Host {
    /// Waits for the next frames; nothing but states may come between them.
    async fn frames(&mut self, count: usize) -> Vec<CanFrame> {
        let mut frames = Vec::new();
        while frames.len() < count {
            match self.next().await.input {
                Input::Can(frame) => frames.push(frame),
                Input::State(_) => {}
                other => panic!("{other:?}"),
            }
        }
        frames
    }
}

async fn heard_by(device: &mut Device, wanted: &[u8]) {
    let mut heard = Vec::new();
    while heard.len() < wanted.len() {
        sleep(Duration::from_millis(5)).await;
        heard.extend(device.heard());
    }
    assert_eq!(String::from_utf8_lossy(&heard), String::from_utf8_lossy(wanted));
}

fn slcan(device: &Device) -> Transport {
    let device = device.path().to_owned();
    Transport::Slcan(Slcan { device, baud: 115_200, bitrate: 250_000 })
}

#[tokio::test]
async fn an_adapter_is_told_nothing_unless_it_may_be() {
    let mut device = Device::new();
    let mut host = Host::new();
    let _port = host.spawn(1, slcan(&device));
    host.opened(1).await;
    device.say(b"\rT09F11223201");
    device.say(b"02\rr1230\rt12330102\rz\r\x07T09F11223103\r");
    assert_eq!(host.frames(2).await, [frame(&[1, 2]), frame(&[3])]);
    assert_eq!(device.heard(), b"");
}

#[tokio::test]
async fn an_adapter_that_may_be_written_to_is_opened_and_sends_for_a_node_only() {
    let mut device = Device::new();
    let mut host = Host::new();
    let config = PortConfig { write: true, ..PortConfig::new(slcan(&device)) };
    let port = host.spawn_with(1, config);
    host.opened(1).await;
    heard_by(&mut device, b"\rC\rZ0\rS5\rO\r").await;
    drop(port);
    sleep(Duration::from_millis(50)).await;
    let _port = can_port(&host, slcan(&device), Some(saying(frame(&[1, 0xAB]))));
    heard_by(&mut device, b"\rC\rZ0\rS5\rO\rT09F11223201AB\r").await;
}

#[tokio::test]
async fn an_unplugged_adapter_is_opened_again() {
    let folder = tempfile::tempdir().unwrap();
    let link = folder.path().join("can");
    let mut host = Host::new();
    let device = Device::at(&link);
    let config = Slcan { device: link.clone(), baud: 115_200, bitrate: 250_000 };
    let _port = can_port(&host, Transport::Slcan(config), Some(saying(frame(&[1]))));
    host.opened(1).await;
    drop(device);
    std::fs::remove_file(&link).unwrap();
    host.state(1, |state| matches!(state, PortState::Absent { .. })).await;
    let mut device = Device::at(&link);
    host.opened(1).await;
    device.say(b"T09F11223109\r");
    assert_eq!(host.frames(1).await, [frame(&[9])]);
}

#[tokio::test]
async fn a_gateway_is_called_and_asked_to_send() {
    let cases = [
        (
            GatewayFormat::Ydwg,
            "16:29:27.082 R 09F11223 01 02\r\n16:29:27.083 T 09F11223 05\r\njunk\r\n\
             16:29:27.084 R 09F11223 03\r\n",
            "09F11223 FF 00\r\n",
        ),
        (
            GatewayFormat::Candump,
            "(1436509052.249713) can0 09F11223#0102\n(1.0) can0 123#R\n(1.0) can0 09F11223#03\n",
            ") can0 09F11223#FF00\n",
        ),
        (
            GatewayFormat::CanboatPlain,
            "2023-06-13T10:39:46.245Z,2,127250,35,255,2,01,02\n# x\n\
             2023-06-13T10:39:46.245Z,2,127250,35,255,1,03\n",
            "Z,2,127250,35,255,2,ff,00\n",
        ),
    ];
    for (format, said, asked) in cases {
        let server = TcpListener::bind("127.0.0.1:0").await.unwrap();
        let address = server.local_addr().unwrap().to_string();
        let mut host = Host::new();
        let transport = Transport::GatewayTcp(GatewayTcp { address, format });
        let _port = can_port(&host, transport, Some(saying(frame(&[0xFF, 0]))));
        let (mut gateway, _) = server.accept().await.unwrap();
        for piece in said.as_bytes().chunks(7) {
            gateway.write_all(piece).await.unwrap();
            gateway.flush().await.unwrap();
        }
        assert_eq!(host.frames(2).await, [frame(&[1, 2]), frame(&[3])], "{format:?}");
        let mut heard = String::new();
        while !heard.ends_with(asked) {
            let mut bytes = [0; 64];
            let count = gateway.read(&mut bytes).await.unwrap();
            heard.push_str(std::str::from_utf8(&bytes[..count]).unwrap());
        }
        drop(gateway);
        host.state(1, |state| matches!(state, PortState::Lost { .. })).await;
    }
}

/// A message of nine bytes of the group 129029, which goes as a fast packet of two frames.
const NINE: &str = "010203040506070809";

fn nine(counter: u8) -> Vec<CanFrame> {
    let id = CanId::Extended(0x0DF8_0523);
    let first = [counter << 5, 9, 1, 2, 3, 4, 5, 6];
    let second = [counter << 5 | 1, 7, 8, 9, 255, 255, 255, 255];
    [first, second].iter().map(|data| CanFrame::new(id, data).unwrap()).collect()
}

#[tokio::test]
async fn a_gateway_of_whole_messages_speaks_them_and_the_port_frames() {
    let said = format!("A173321.107 23FF2 1F112 0102\r\nA173321.108 23FF3 1F805 {NINE}\r\n");
    let spaced = "01,02,03,04,05,06,07,08,09";
    let fast = format!("2023-06-13T10:39:46.245Z,3,129029,35,255,9,{spaced}");
    let cases = [
        (GatewayFormat::Actisense, said, format!("A000000.000 23FF3 1F805 {NINE}\r\n"), 1),
        (GatewayFormat::CanboatFast, format!("{fast}\n{fast}\n"), fast[24..].to_owned(), 0),
    ];
    for (format, said, asked, single) in cases {
        let server = TcpListener::bind("127.0.0.1:0").await.unwrap();
        let address = server.local_addr().unwrap().to_string();
        let mut host = Host::new();
        let transport = Transport::GatewayTcp(GatewayTcp { address, format });
        let node = SharedSpeaker::new(Sayer(nine(3).into())).for_port();
        let _port = can_port(&host, transport, Some(node));
        let (mut gateway, _) = server.accept().await.unwrap();
        gateway.write_all(said.as_bytes()).await.unwrap();
        let expected = match single {
            1 => [vec![frame(&[1, 2])], nine(0)].concat(),
            _ => [nine(0), nine(1)].concat(),
        };
        assert_eq!(host.frames(expected.len()).await, expected);
        let mut heard = String::new();
        while !heard.contains(&asked) {
            let mut bytes = [0; 64];
            let count = gateway.read(&mut bytes).await.unwrap();
            heard.push_str(std::str::from_utf8(&bytes[..count]).unwrap());
        }
    }
}

#[tokio::test]
async fn a_gateway_sends_datagrams_of_several_lines() {
    let gateway = UdpSocket::bind("127.0.0.1:0").await.unwrap();
    let own = std::net::UdpSocket::bind("127.0.0.1:0").unwrap().local_addr().unwrap();
    let mut host = Host::new();
    let to = Some(gateway.local_addr().unwrap());
    let config = GatewayUdp { bind: own, to, from: None, format: GatewayFormat::Ydwg };
    let _port = can_port(&host, Transport::GatewayUdp(config), Some(saying(frame(&[7]))));
    let mut bytes = [0; 64];
    let count = gateway.recv(&mut bytes).await.unwrap();
    assert_eq!(&bytes[..count], b"09F11223 07\r\n");
    let two = b"16:29:27.082 R 09F11223 01\r\n16:29:27.082 R 09F11223 02";
    gateway.send_to(two, own).await.unwrap();
    gateway.send_to(b" 03\r\n16:29:27.082 R 09F11223 04", own).await.unwrap();
    let expected = [frame(&[1]), frame(&[2]), frame(&[4])];
    assert_eq!(host.frames(3).await, expected, "no line goes over the end of a datagram");
}

#[tokio::test]
async fn a_log_is_read_to_its_end_however_slow_the_consumer() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("log");
    let lines: String = (0..20_000)
        .map(|number| format!("({number}.000000) can0 09F11223#{number:08X}\n"))
        .collect();
    std::fs::write(&path, lines.trim_end()).unwrap();
    let mut host = Host::new();
    let _port = host.spawn(1, Transport::Candump(Candump { path }));
    let frames = host.frames(20_000).await;
    let good = (0..20_000_u32).zip(frames).all(|(n, got)| got == frame(&n.to_be_bytes()));
    assert!(good);
    host.state(1, |state| *state == PortState::Ended).await;
}

#[tokio::test]
async fn what_the_filters_refuse_is_not_told() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("log");
    std::fs::write(&path, "(1.0) can0 09F11323#01\n(1.0) can0 123#02\n(1.0) can0 09F11223#03\n")
        .unwrap();
    let mut host = Host::new();
    let filters = vec![CanFilter { id: 0x09F1_1200, mask: 0x1FFF_FF00, standard: false }];
    let transport = Transport::Candump(Candump { path });
    let _port = host.spawn_with(1, PortConfig { filters, ..PortConfig::new(transport) });
    assert_eq!(host.frames(1).await, [frame(&[3])]);
}
