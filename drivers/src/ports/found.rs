//! What ports the computer has, found in the file system without opening any of them.

use std::fs;
use std::net::IpAddr;
use std::path::{Path, PathBuf};

use rustix::fs::{Access, access};

/// A port of the computer.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FoundPort {
    /// What kind of port.
    pub kind: FoundKind,
    /// The system's name, for example `ttyUSB0` or `can0`; it may be another after the next start.
    pub name: String,
    /// The device, if it is one.
    pub device: Option<PathBuf>,
    /// Names that stay, best first: below `/dev/serial/by-id`, then `/dev/serial/by-path`.
    pub stable: Vec<PathBuf>,
    /// Driver in the kernel.
    pub driver: Option<String>,
    /// Number of the maker on USB or PCI, in hexadecimal digits.
    pub vendor: Option<String>,
    /// Number of the product on USB or PCI, in hexadecimal digits.
    pub product: Option<String>,
    /// What maker and product call themselves; of a pulse, its source.
    pub description: Option<String>,
    /// Addresses of a network interface.
    pub addresses: Vec<IpAddr>,
    /// Of an interface, what the kernel says of its state: up, down, unknown.
    pub state: Option<String>,
    /// Whether this process has the permission to read and write it; it was not opened. `None` for
    /// what is no device.
    pub may_open: Option<bool>,
}

/// Kinds of ports.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum FoundKind {
    /// A serial line.
    Serial,
    /// A pulse per second.
    Pps,
    /// A CAN interface.
    Can,
    /// A network interface.
    Network,
}

/// Type numbers of interfaces (`linux/if_arp.h`).
const ARPHRD_CAN: &str = "280";
const ARPHRD_LOOPBACK: &str = "772";

/// All ports below this root of the file system, by kind and name. The addresses of interfaces are
/// asked of the kernel, and so only known for the real root `/`.
#[must_use]
pub fn list(root: &Path) -> Vec<FoundPort> {
    let tree = Tree { root };
    let serial = tree.names("sys/class/tty").into_iter().filter_map(|name| tree.serial(name));
    let mut ports: Vec<FoundPort> = serial.collect();
    ports.extend(tree.names("sys/class/pps").into_iter().map(|name| tree.pps(name)));
    let addresses = if root == Path::new("/") { addresses() } else { Vec::new() };
    let interfaces = tree.names("sys/class/net").into_iter();
    ports.extend(interfaces.filter_map(|name| tree.interface(name, &addresses)));
    ports.sort_by(|a, b| (a.kind, &a.name).cmp(&(b.kind, &b.name)));
    ports
}

struct Tree<'a> {
    root: &'a Path,
}

impl Tree<'_> {
    fn names(&self, folder: &str) -> Vec<String> {
        let entries = fs::read_dir(self.root.join(folder)).into_iter().flatten().flatten();
        entries.filter_map(|entry| entry.file_name().into_string().ok()).collect()
    }

    /// A terminal that is a real serial line: it has a driver, and is not one of the places that the
    /// driver for 8250 keeps for hardware that is not there (type 0).
    fn serial(&self, name: String) -> Option<FoundPort> {
        let class = self.root.join("sys/class/tty").join(&name);
        let device = class.join("device");
        let driver = serial_driver(&device)?;
        if text(&class.join("type")).is_some_and(|kind| kind == "0") {
            return None;
        }
        let mut port = self.with_device(FoundKind::Serial, name);
        port.driver = Some(driver);
        port.stable = self.stable(&port.name);
        self.describe(&device, &mut port);
        Some(port)
    }

    fn pps(&self, name: String) -> FoundPort {
        let class = self.root.join("sys/class/pps").join(&name);
        let mut port = self.with_device(FoundKind::Pps, name);
        port.driver = text(&class.join("name"));
        port.description = text(&class.join("path"));
        port
    }

    fn interface(&self, name: String, addresses: &[(String, IpAddr)]) -> Option<FoundPort> {
        let class = self.root.join("sys/class/net").join(&name);
        let kind = match text(&class.join("type"))?.as_str() {
            ARPHRD_LOOPBACK => return None,
            ARPHRD_CAN => FoundKind::Can,
            _ => FoundKind::Network,
        };
        let mut port = FoundPort::new(kind, name);
        port.driver = link_name(&class.join("device/driver"));
        port.state = text(&class.join("operstate"));
        let own = addresses.iter().filter(|(interface, _)| *interface == port.name);
        port.addresses = own.map(|(_, address)| *address).collect();
        self.describe(&class.join("device"), &mut port);
        Some(port)
    }

    fn with_device(&self, kind: FoundKind, name: String) -> FoundPort {
        let device = self.root.join("dev").join(&name);
        let mut port = FoundPort::new(kind, name);
        port.may_open = Some(access(&device, Access::READ_OK | Access::WRITE_OK).is_ok());
        port.device = Some(device);
        port
    }

    /// Links to this device, by-id before by-path.
    fn stable(&self, name: &str) -> Vec<PathBuf> {
        let mut stable = Vec::new();
        for folder in ["dev/serial/by-id", "dev/serial/by-path"] {
            let path = self.root.join(folder);
            let mut links = self.names(folder);
            links.retain(|link| link_name(&path.join(link)).is_some_and(|target| target == name));
            links.sort();
            stable.extend(links.into_iter().map(|link| path.join(link)));
        }
        stable
    }

    /// Maker and product: of the USB device or PCI function that is nearest above.
    fn describe(&self, device: &Path, port: &mut FoundPort) {
        let Ok(real) = device.canonicalize() else { return };
        for folder in real.ancestors().take_while(|folder| *folder != self.root) {
            let usb = text(&folder.join("idVendor")).zip(text(&folder.join("idProduct")));
            let pci = || text(&folder.join("vendor")).zip(text(&folder.join("device")));
            if let Some((vendor, product)) = usb.or_else(pci) {
                port.vendor = Some(vendor.trim_start_matches("0x").to_owned());
                port.product = Some(product.trim_start_matches("0x").to_owned());
                let names = ["manufacturer", "product"].map(|name| text(&folder.join(name)));
                let names: Vec<String> = names.into_iter().flatten().collect();
                port.description = Some(names.join(" ")).filter(|names| !names.is_empty());
                return;
            }
        }
    }
}

impl FoundPort {
    fn new(kind: FoundKind, name: String) -> Self {
        FoundPort {
            kind,
            name,
            device: None,
            stable: Vec::new(),
            driver: None,
            vendor: None,
            product: None,
            description: None,
            addresses: Vec::new(),
            state: None,
            may_open: None,
        }
    }
}

/// The driver of a serial line. Where the kernel puts its own two layers in between (`port`, `ctrl`,
/// since Linux 6.5), the one that is nearest above them.
fn serial_driver(device: &Path) -> Option<String> {
    let nearest = link_name(&device.join("driver"))?;
    let is_layer = |driver: &String| driver == "port" || driver == "ctrl";
    let real = device.canonicalize().ok()?;
    let mut drivers = real.ancestors().filter_map(|folder| link_name(&folder.join("driver")));
    Some(drivers.find(|driver| !is_layer(driver)).unwrap_or(nearest))
}

/// The first line of a small file.
fn text(path: &Path) -> Option<String> {
    let text = fs::read_to_string(path).ok()?;
    text.lines().next().map(|line| line.trim().to_owned()).filter(|line| !line.is_empty())
}

/// The last part of what a link points to.
fn link_name(path: &Path) -> Option<String> {
    fs::read_link(path).ok()?.file_name()?.to_str().map(str::to_owned)
}

/// Addresses of all interfaces, as the kernel has them.
fn addresses() -> Vec<(String, IpAddr)> {
    let all = nix::ifaddrs::getifaddrs().into_iter().flatten();
    let address = |interface: nix::ifaddrs::InterfaceAddress| {
        let storage = interface.address?;
        let v4 = storage.as_sockaddr_in().map(|address| IpAddr::from(address.ip()));
        let v6 = || storage.as_sockaddr_in6().map(|address| IpAddr::from(address.ip()));
        Some((interface.interface_name.clone(), v4.or_else(v6)?))
    };
    all.filter_map(address).collect()
}
