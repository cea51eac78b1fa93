//! Files, named pipes, and the list of ports.

use std::fs;
use std::io::Write;
use std::path::Path;
use std::time::Duration;

use insd_base::{Input, PortState};
use insd_drivers::ports::{Edge, File, FoundKind, Pps, Transport, list};

use tokio::time::sleep;

use crate::host::Host;

#[tokio::test]
async fn a_file_is_read_whole_however_slow_the_consumer() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("log");
    let content: Vec<u8> = (0..2_000_000_u32).map(|at| (at / 7) as u8).collect();
    fs::write(&path, &content).unwrap();
    let mut host = Host::new();
    let _port = host.spawn(1, Transport::File(File { path }));
    host.state(1, |state| *state == PortState::Ended).await;
    let mut read = Vec::new();
    for arrival in &host.seen {
        if let Input::Bytes(bytes) = &arrival.input {
            read.extend_from_slice(bytes);
        }
    }
    assert!(read == content, "{} of {} bytes", read.len(), content.len());
    assert_eq!(host.states(Some(1)).len(), 2);
}

fn make_fifo(path: &Path) {
    use rustix::fs::{CWD, FileType, Mode, mknodat};
    mknodat(CWD, path, FileType::Fifo, Mode::RUSR | Mode::WUSR, 0).unwrap();
}

#[tokio::test]
async fn a_pipe_is_opened_again_for_its_next_writer() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("fifo");
    make_fifo(&path);
    let mut host = Host::new();
    let port = host.spawn(1, Transport::Pipe(File { path: path.clone() }));
    host.opened(1).await;
    for message in [&b"first"[..], b"second"] {
        // opening waits for the reader, so not on this thread
        let (path, text) = (path.clone(), message.to_vec());
        let writer = tokio::task::spawn_blocking(move || {
            fs::OpenOptions::new().write(true).open(path).unwrap().write_all(&text).unwrap();
        });
        host.bytes(1, message).await;
        writer.await.unwrap();
        host.state(1, |state| matches!(state, PortState::Lost { .. })).await;
        host.opened(1).await;
    }
    assert!(port.attempts() < 20, "{} attempts", port.attempts());
}

#[tokio::test]
async fn what_is_no_pulse_is_told_once() {
    let folder = tempfile::tempdir().unwrap();
    let device = folder.path().join("pps0");
    let mut host = Host::new();
    let port = host.spawn(1, Transport::Pps(Pps { device: device.clone(), edge: Edge::Assert }));
    host.state(1, |state| matches!(state, PortState::Absent { .. })).await;
    fs::write(&device, "no device").unwrap();
    host.state(1, |state| matches!(state, PortState::Absent { .. })).await;
    let attempts = port.attempts();
    while port.attempts() < attempts + 2 {
        sleep(Duration::from_millis(20)).await;
    }
    host.drain();
    let states = host.states(Some(1));
    assert!(states[0].contains("No such file") && states[1].contains("ioctl"), "{states:?}");
    assert_eq!(states.len(), 2);
}

/// A made-up computer: a receiver on USB, a serial line on the board, one that is not there, a
/// terminal without hardware, a pulse, a CAN interface.
fn made_up_computer(root: &Path) {
    let usb = "sys/devices/usb1/1-1";
    let files = [
        (format!("{usb}/idVendor"), "1546"),
        (format!("{usb}/idProduct"), "01a8"),
        (format!("{usb}/manufacturer"), "u-blox AG"),
        (format!("{usb}/product"), "GNSS receiver"),
        ("sys/devices/board/ttyS0/type".to_owned(), "4"),
        ("sys/devices/board/ttyS1/type".to_owned(), "0"),
        ("sys/class/pps/pps0/name".to_owned(), "pps-gpio"),
        ("sys/class/pps/pps0/path".to_owned(), ""),
        ("sys/class/net/can0/type".to_owned(), "280"),
        ("sys/class/net/can0/operstate".to_owned(), "up"),
        ("sys/class/net/lo/type".to_owned(), "772"),
        ("dev/ttyACM0".to_owned(), ""),
    ];
    for (path, text) in files {
        let path = root.join(path);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, format!("{text}\n")).unwrap();
    }
    let links = [
        ("sys/class/tty/ttyACM0", "../../devices/usb1/1-1/1-1:1.0/tty/ttyACM0"),
        ("sys/devices/usb1/1-1/1-1:1.0/tty/ttyACM0/device", "../../../1-1:1.0"),
        ("sys/devices/usb1/1-1/1-1:1.0/driver", "../../drivers/cdc_acm"),
        ("sys/class/tty/ttyS0", "../../devices/board/ttyS0"),
        ("sys/class/tty/ttyS1", "../../devices/board/ttyS1"),
        ("sys/devices/board/ttyS0/device", "../uart/port"),
        ("sys/devices/board/ttyS1/device", "../uart/port"),
        ("sys/devices/board/uart/port/driver", "../../../bus/serial-base/drivers/port"),
        ("sys/devices/board/uart/driver", "../../../bus/platform/drivers/serial8250"),
        ("dev/serial/by-id/usb-u-blox-if00", "../../ttyACM0"),
        ("dev/serial/by-path/pci-usb-0:1:1.0", "../../ttyACM0"),
    ];
    for (path, target) in links {
        let path = root.join(path);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::os::unix::fs::symlink(target, path).unwrap();
    }
    fs::create_dir_all(root.join("sys/class/tty/tty1")).unwrap();
}

#[test]
fn real_ports_are_listed_with_their_stable_names_and_makers() {
    let folder = tempfile::tempdir().unwrap();
    let root = folder.path().canonicalize().unwrap();
    made_up_computer(&root);
    let ports = list(&root);
    let names: Vec<_> = ports.iter().map(|port| (port.kind, port.name.as_str())).collect();
    let serial = [(FoundKind::Serial, "ttyACM0"), (FoundKind::Serial, "ttyS0")];
    assert_eq!(names[..2], serial);
    assert_eq!(names[2..], [(FoundKind::Pps, "pps0"), (FoundKind::Can, "can0")]);

    let receiver = &ports[0];
    assert_eq!(receiver.driver.as_deref(), Some("cdc_acm"));
    assert_eq!(receiver.vendor.as_deref(), Some("1546"));
    assert_eq!(receiver.product.as_deref(), Some("01a8"));
    assert_eq!(receiver.description.as_deref(), Some("u-blox AG GNSS receiver"));
    assert_eq!(receiver.may_open, Some(true));
    let stable = ["dev/serial/by-id/usb-u-blox-if00", "dev/serial/by-path/pci-usb-0:1:1.0"]
        .map(|p| root.join(p));
    assert_eq!(receiver.stable, stable);
    assert_eq!(ports[1].driver.as_deref(), Some("serial8250"));
    assert_eq!((ports[1].may_open, ports[1].vendor.as_deref()), (Some(false), None));
    assert_eq!(ports[2].driver.as_deref(), Some("pps-gpio"));
    assert_eq!((ports[3].state.as_deref(), ports[3].may_open), (Some("up"), None));
}

#[test]
fn a_computer_without_any_of_it_has_no_ports() {
    let folder = tempfile::tempdir().unwrap();
    assert_eq!(list(folder.path()), []);
}
