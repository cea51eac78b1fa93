//! The mistakes that show only on the computer: `insd doctor`.

use std::fs;
use std::net::{TcpListener, UdpSocket};
use std::os::unix::fs::PermissionsExt;
use std::path::Path;
use std::time::Duration;

use insd::doctor::{Diagnosis, Extent, Person};
use insd_config::Severity::{self, Error, Warning};

/// What is tried below, for the documentation.
pub(crate) const ROWS: &[(&str, Severity, &str)] = &[
    ("device that is not there", Error, "device-absent"),
    ("file where a device should be", Error, "device-kind"),
    ("device of a group that the user is not in", Error, "device-denied"),
    ("device that another program has open", Error, "device-busy"),
    ("one device under two names", Error, "device-twice"),
    ("CAN interface that is not there", Error, "interface-absent"),
    ("address of another computer", Error, "address-foreign"),
    ("port of another program", Error, "address-busy"),
    ("token file that is not there", Error, "token-absent"),
    ("token of 15 characters", Error, "token-short"),
    ("token that everybody may read", Warning, "token-open"),
    ("folder of recordings that is not there", Error, "recording-folder"),
    ("folder of the state that is not there", Error, "state-folder"),
    ("time for a chronyd that does not listen", Warning, "chrony-socket"),
    ("UBX arrives, configured as NMEA", Error, "kind-arrives"),
    ("sentences without checksums", Error, "no-checksum"),
    ("bytes that nobody can read", Error, "unreadable"),
    ("silent cable", Warning, "silent"),
];

const SHIP: &str = include_str!("../../../systemd/examples/minimal.toml");

/// Causes of a configuration on this computer.
fn causes(text: &str, listen: f64) -> Vec<(Severity, &'static str, String)> {
    causes_for(text, listen, Person::here())
}

fn causes_for(text: &str, listen: f64, person: Person) -> Vec<(Severity, &'static str, String)> {
    let listen = Duration::from_secs_f64(listen);
    let diagnosis = Diagnosis::of_ship(text, &Extent { listen, person, file: None }).unwrap();
    let told = |own: &insd_config::ConfigFinding| (own.severity, own.cause, own.to_string());
    diagnosis.findings.iter().map(told).collect()
}

fn assert_told(text: &str, listen: f64, expected: &[&str]) {
    let told = causes(text, listen);
    for cause in expected {
        let (_, severity, _) =
            ROWS.iter().find(|row| row.2 == *cause).map(|r| (r.0, r.1, r.2)).unwrap();
        let is_it = |own: &&(Severity, &str, String)| own.0 == severity && own.1 == *cause;
        assert!(told.iter().any(|own| is_it(&own)), "{cause} is not in {told:#?}");
    }
}

#[test]
fn devices_interfaces_and_addresses_that_are_not_there_are_told() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("ttyS0");
    fs::write(&file, "no device").unwrap();
    let text = SHIP.replace("/dev/ttyUSB0", &file.display().to_string());
    let more = "[[port]]\nname = \"bus\"\ntransport = { kind = \"socketcan\", interface = \"can77\" }\n\
        [[port]]\nname = \"far\"\ntransport = { kind = \"udp\", bind = \"203.0.113.7:60004\" }\n";
    let expected = ["device-absent", "device-kind", "interface-absent", "address-foreign"];
    assert_told(&format!("{text}\n{more}"), 0.0, &expected);
}

/// A pseudo terminal: its master, which keeps it, and its path.
fn terminal() -> (std::os::fd::OwnedFd, String) {
    use rustix::pty::{OpenptFlags, grantpt, openpt, ptsname, unlockpt};
    let master = openpt(OpenptFlags::RDWR | OpenptFlags::NOCTTY).unwrap();
    grantpt(&master).unwrap();
    unlockpt(&master).unwrap();
    let path = ptsname(&master, Vec::new()).unwrap().into_string().unwrap();
    (master, path)
}

#[test]
fn a_device_that_is_denied_or_open_elsewhere_or_known_by_two_names_is_told() {
    let folder = tempfile::tempdir().unwrap();
    let (_master, device) = terminal();
    let link = folder.path().join("imu");
    std::os::unix::fs::symlink(&device, &link).unwrap();
    let text =
        SHIP.replace("/dev/ttyUSB0", &device).replace("/dev/ttyUSB1", &link.display().to_string());
    let has = |told: &[(Severity, &'static str, String)], cause: &str| {
        told.iter().any(|own| own.1 == cause)
    };
    let told = causes(&text, 0.0);
    assert!(has(&told, "device-twice") && !has(&told, "device-busy"), "{told:#?}");
    let stranger = Person::named("nobody").unwrap();
    assert!(has(&causes_for(&text, 0.0, stranger), "device-denied"));
    let open = fs::File::options().read(true).write(true).open(&device).unwrap();
    let mut other = std::process::Command::new("sleep").arg("60").stdin(open).spawn().unwrap();
    let told = causes(&text, 0.0);
    other.kill().unwrap();
    other.wait().unwrap();
    let busy = with("device-busy", &told);
    assert!(busy.contains("sleep"), "{busy}");
}

#[test]
fn a_port_that_another_program_has_is_told() {
    let other = TcpListener::bind("127.0.0.1:0").unwrap();
    let address = other.local_addr().unwrap();
    let text = format!("{SHIP}\n[web]\nlisten = \"{address}\"\n");
    assert_told(&text, 0.0, &["address-busy"]);
}

#[test]
fn files_and_folders_that_are_wrong_are_told() {
    let folder = tempfile::tempdir().unwrap();
    let token = folder.path().join("token");
    let none = folder.path().join("none");
    let text = |token: &Path| {
        format!(
            "{SHIP}\n[web]\ntoken_file = \"{}\"\n[recording]\nfolder = \"{none}\"\nquota_mb = 1\n\
             [state]\nfolder = \"{none}\"\n[chrony]\nsocket = \"{none}\"\n",
            token.display(),
            none = none.display()
        )
    };
    let folders = ["token-absent", "recording-folder", "state-folder", "chrony-socket"];
    assert_told(&text(&token), 0.0, &folders);
    fs::write(&token, "fifteen letters\n").unwrap();
    fs::set_permissions(&token, fs::Permissions::from_mode(0o644)).unwrap();
    assert_told(&text(&token), 0.0, &["token-short", "token-open"]);
    fs::write(&token, "sixteen letters.\n").unwrap();
    fs::set_permissions(&token, fs::Permissions::from_mode(0o600)).unwrap();
    assert!(!causes(&text(&token), 0.0).iter().any(|own| own.1.starts_with("token")));
}

/// A receiver at a port of the network, and what it is told to be.
fn heard(kind: &str, datagram: Option<&[u8]>) -> Vec<(Severity, &'static str, String)> {
    let free = UdpSocket::bind("127.0.0.1:0").unwrap().local_addr().unwrap();
    let line = "{ kind = \"serial\", device = \"/dev/ttyUSB1\", baud = 115200 }";
    let text = SHIP
        .replace(line, &format!("{{ kind = \"udp\", bind = \"{free}\" }}"))
        .replace("kind = \"ubx\"", &format!("kind = \"{kind}\""));
    let datagram = datagram.map(<[u8]>::to_vec);
    let sender = std::thread::spawn(move || {
        let socket = UdpSocket::bind("127.0.0.1:0").unwrap();
        for _ in 0..30 {
            let Some(bytes) = &datagram else { return };
            let _ = socket.send_to(bytes, free);
            std::thread::sleep(Duration::from_millis(50));
        }
    });
    let told = causes(&text, 1.2);
    sender.join().unwrap();
    told
}

/// An empty UBX-NAV-EOE, which every receiver of u-blox may send.
fn ubx() -> Vec<u8> {
    let mut frame = vec![0xB5, 0x62, 0x01, 0x61, 4, 0, 1, 2, 3, 4];
    let (mut a, mut b) = (0_u8, 0_u8);
    for byte in &frame[2..] {
        a = a.wrapping_add(*byte);
        b = b.wrapping_add(a);
    }
    frame.extend([a, b]);
    frame
}

fn with(cause: &str, told: &[(Severity, &'static str, String)]) -> String {
    let own = told.iter().find(|own| own.1 == cause);
    own.unwrap_or_else(|| panic!("{cause} is not in {told:#?}")).2.clone()
}

#[test]
fn what_arrives_is_held_against_what_is_configured() {
    let told = with("kind-arrives", &heard("nmea_gnss", Some(&ubx())));
    assert!(told.contains("speaks ubx") && told.contains("configured as nmea_gnss"), "{told}");
    let gga = b"$GPGGA,120000.00,3526.4,N,13939.0,E,1,12,0.9,40.0,M,36.7,M,,\r\n";
    with("no-checksum", &heard("nmea_gnss", Some(gga)));
    with("unreadable", &heard("ubx", Some(&[0x55; 200])));
    let silent = with("silent", &heard("ubx", None));
    assert!(silent.contains("gnss"), "{silent}");
}
