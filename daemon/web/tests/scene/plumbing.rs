//! Sensors, ports and measurements of the made-up ship.

use insd_web::snapshot::{
    Age, Bus, BusNode, BusState, CameraState, Cause, OutputMessage, Rejected, Samples, Schedule,
    Sensor, SensorState, ShownAid, ShownCamera, ShownChoice, ShownEstimate, ShownInput,
    ShownOutput, ShownPortState, ShownWatch, Snapshot,
};

use super::{Scene, utc};

fn cause(reason: &str, count: u64) -> Cause {
    Cause { reason: reason.to_owned(), count }
}

fn count(t: f64, rate: f64) -> u64 {
    (t * rate) as u64
}

/// Enters sensors and ports.
pub(super) fn fill(snapshot: &mut Snapshot, t: f64, scene: Scene) {
    snapshot.sensors = sensors(t, scene);
    snapshot.choices = choices(scene);
    snapshot.inputs = inputs(t, scene);
    snapshot.outputs = outputs(t, scene);
    snapshot.buses = vec![bus(t)];
    snapshot.schedule = Schedule { epochs: count(t, 40.0), late: 3, skipped: 0 };
}

/// A camera that looks to starboard; in the fault its lens is wet.
pub(super) fn camera(t: f64, scene: Scene) -> ShownCamera {
    let state = match scene {
        Scene::Alignment => CameraState::Waiting,
        Scene::Underway => CameraState::Used,
        Scene::Fault => CameraState::Doubtful,
    };
    let own = ShownCamera {
        sensor: "eyes".to_owned(),
        state,
        has_picture: true,
        ..ShownCamera::default()
    };
    if !own.is_looked_at() {
        return own;
    }
    let estimate = |value, sigma| ShownEstimate { value: Some(value), sigma: Some(sigma) };
    ShownCamera {
        valid_at_s: Some(t - 0.1),
        points: Some(if scene == Scene::Fault { 9 } else { 84 }),
        poses: Some(10),
        landmarks: Some(12),
        turned: vec![estimate(0.31, 0.12), estimate(-0.84, 0.1), estimate(0.22, 0.19)],
        delay: Some(estimate(0.012, 0.004)),
        ..own
    }
}

fn sensors(t: f64, scene: Scene) -> Vec<Sensor> {
    let fault = scene == Scene::Fault;
    let sensor = |name: &str, kind: &str, port: &str, rate: f64, used: &[&str]| Sensor {
        name: name.to_owned(),
        kind: kind.to_owned(),
        port: port.to_owned(),
        state: if used.is_empty() { SensorState::Received } else { SensorState::Valid },
        rate_hz: Some(rate),
        age_s: Some((t * 7.3).fract() / rate),
        used_for: used.iter().map(|word| (*word).to_owned()).collect(),
        why: (!used.is_empty()).then(|| "first".to_owned()),
        passed: count(t, rate),
        ..Sensor::default()
    };
    let mut imu = sensor("imu", "sbg", "imu", 200.0, &["inertial"]);
    imu.temperature_c = Some(41.3);
    imu.status_word = Some(0x03FF);
    imu.status = vec!["self-tests passed".to_owned()];
    let mut gnss = sensor("gnss", "ubx", "gnss", 5.0, &["gnss"]);
    gnss.fix = Some("differential".to_owned());
    gnss.satellites = Some(17);
    gnss.refused = vec![cause("time_doubted", 2)];
    if fault {
        gnss.state = SensorState::Rejected;
        gnss.used_for.clear();
        gnss.why = Some("invalid".to_owned());
        gnss.fix = Some("no fix".to_owned());
        gnss.satellites = Some(2);
        gnss.refused.push(cause("invalid", count(t - 230.0, 5.0)));
    }
    let mut compass = sensor("gyro-compass", "compass", "bridge", 10.0, &["heading"]);
    if fault {
        compass.state = SensorState::Silent;
        compass.used_for.clear();
        compass.why = Some("silent".to_owned());
        compass.rate_hz = Some(0.0);
        compass.age_s = Some(t - 248.0);
    }
    let log = if scene == Scene::Alignment { vec![] } else { vec!["bottom_velocity"] };
    let mut n2k = sensor("n2k-gnss", "n2k_gnss", "backbone", 1.0, &[]);
    n2k.device = Some("address 127, NAME C07891001CA0CB8F".to_owned());
    n2k.refused = vec![cause("not_chosen", count(t, 1.0)), cause("other_device", 41)];
    let waiting = Sensor {
        name: "fix by hand".to_owned(),
        kind: "manual".to_owned(),
        port: "bridge".to_owned(),
        state: SensorState::Waiting,
        ..Sensor::default()
    };
    vec![imu, gnss, n2k, sensor("doppler", "pd6", "log", 2.0, &log), compass, waiting]
}

/// The ship's old compasses.
pub(crate) fn watched(scene: Scene) -> Vec<ShownWatch> {
    let differs = scene == Scene::Fault;
    let row = |sensor: &str, against: Option<&str>, difference: f64, wrong: bool| ShownWatch {
        sensor: sensor.to_owned(),
        against: against.map(str::to_owned),
        quantity: "heading".to_owned(),
        difference_deg: Some(difference),
        sigma_deg: Some(0.51),
        limit_deg: Some(1.5),
        differs: wrong,
        wrong: wrong.then(|| "old gyro 2".to_owned()),
        age_s: Some(0.4),
        ..ShownWatch::default()
    };
    if scene == Scene::Alignment {
        return vec![ShownWatch {
            sensor: "old gnss".to_owned(),
            quantity: "position".to_owned(),
            difference_m: Some(3.2),
            sigma_m: Some(4.1),
            limit_m: Some(12.0),
            age_s: Some(0.4),
            ..ShownWatch::default()
        }];
    }
    let off = if differs { 2.1 } else { 0.2 };
    vec![
        row("old gyro 1", None, 0.1, false),
        row("old gyro 1", Some("old gyro 2"), 0.1 - off, differs),
        row("old gyro 2", None, off, differs),
    ]
}

fn choices(scene: Scene) -> Vec<ShownChoice> {
    let choice = |quantity: &str, sensor: Option<&str>, why: &str| ShownChoice {
        quantity: quantity.to_owned(),
        sensor: sensor.map(str::to_owned),
        why: Some(why.to_owned()),
    };
    let fault = scene == Scene::Fault;
    vec![
        choice("inertial", Some("imu"), "first"),
        choice("gnss", (!fault).then_some("gnss"), if fault { "none_left" } else { "first" }),
        choice("bottom_velocity", Some("doppler"), "first"),
        choice(
            "heading",
            (!fault).then_some("gyro-compass"),
            if fault { "silent" } else { "first" },
        ),
    ]
}

fn inputs(t: f64, scene: Scene) -> Vec<ShownInput> {
    let input = |name: &str, transport: &str, what: &str, rate: f64| ShownInput {
        name: name.to_owned(),
        transport: transport.to_owned(),
        what: what.to_owned(),
        state: ShownPortState::Open,
        bytes: count(t, rate),
        rate_bytes_s: Some(rate),
        age_s: Some((t * 7.3).fract() * 0.1),
        frames: count(t, rate / 60.0),
        ..ShownInput::default()
    };
    let mut gnss = input("gnss", "serial", "usb-u-blox_GNSS-if00, 115200 baud", 2140.0);
    gnss.damaged = 3;
    gnss.skipped_bytes = 214;
    let mut bridge = input("bridge", "udp", "239.192.0.4:60004 on eth0", 610.0);
    if scene == Scene::Fault {
        bridge.state = ShownPortState::Silent;
        bridge.rate_bytes_s = Some(0.0);
        bridge.age_s = Some(t - 248.0);
        bridge.reopened = 2;
        bridge.last_error = Some("silent for 3.0 s".to_owned());
    }
    vec![
        input("imu", "serial", "usb-FTDI_IMU-if00-port0, 921600 baud", 9600.0),
        gnss,
        input("pulse", "pps", "/dev/pps0", 1.0),
        input("log", "serial", "/dev/ttyS1, 9600 baud", 236.0),
        bridge,
        input("backbone", "socketcan", "can0", 1240.0),
    ]
}

fn outputs(t: f64, scene: Scene) -> Vec<ShownOutput> {
    let age = |ms: f64| Age {
        last: ms * (0.9 + 0.2 * (t * 3.1).fract()),
        max: ms * 2.7,
        p50: ms,
        p99: ms * 1.6,
    };
    let message = |name: &str, rate: f64, ms: f64, dropped: u64| OutputMessage {
        name: name.to_owned(),
        rate_hz: Some(rate),
        sent: count(t, rate),
        dropped,
        age_ms: Some(age(ms)),
    };
    let output = |name: &str, transport: &str, what: &str, messages: Vec<OutputMessage>| {
        let rate: f64 = messages.iter().filter_map(|message| message.rate_hz).sum();
        ShownOutput {
            name: name.to_owned(),
            transport: transport.to_owned(),
            what: what.to_owned(),
            state: ShownPortState::Open,
            sent: messages.iter().map(|message| message.sent).sum(),
            dropped: messages.iter().map(|message| message.dropped).sum(),
            bytes: count(t, rate * 52.0),
            rate_bytes_s: Some(rate * 52.0),
            age_ms: messages.iter().filter_map(|message| message.age_ms).next_back(),
            messages,
            ..ShownOutput::default()
        }
    };
    let ecdis = ["THS", "ROT", "GGA", "VTG"].map(|name| message(name, 10.0, 9.0, 0));
    let mut serial = output("ecdis", "serial", "usb-Moxa-port1, 38400 baud", ecdis.to_vec());
    serial.capacity_bytes_s = Some(3840.0);
    let mut sounder = output(
        "echo sounder",
        "udp",
        "192.168.3.40:31000",
        vec![message("KMB", 100.0, 0.4, 0), message("ZDA", 1.0, 0.3, 0)],
    );
    sounder.point = Some("echo sounder".to_owned());
    let mut pilot = output(
        "autopilot",
        "serial",
        "/dev/ttyS3, 4800 baud",
        vec![message("HDT", 10.0, 61.0, 418), message("ROT", 10.0, 74.0, 402)],
    );
    pilot.waiting = 1;
    pilot.capacity_bytes_s = Some(480.0);
    if scene == Scene::Fault {
        pilot.state = ShownPortState::Lost;
        pilot.last_error = Some("Input/output error (os error 5)".to_owned());
    }
    let bridge = vec![message("ALF", 0.1, 1.0, 0), message("HBT", 0.017, 1.0, 0)];
    vec![serial, sounder, pilot, output("bridge", "lan", "eth0, NAVD and SATD", bridge)]
}

fn bus(t: f64) -> Bus {
    let node = |address: u8, name: &str| BusNode { address, name: name.to_owned() };
    Bus {
        port: "backbone".to_owned(),
        state: BusState::Active,
        errors: 4,
        offs: 0,
        dropped: 0,
        rate_hz: Some(154.0),
        load: Some(0.088 + 0.004 * (t / 3.0).sin()),
        node_state: Some("held".to_owned()),
        address: Some(35),
        name: Some("C0328C0010200001".to_owned()),
        nodes: vec![node(127, "C07891001CA0CB8F"), node(128, "C0788C0010E0038B")],
    }
}

/// What became of the measurements.
pub(super) fn aids(t: f64, scene: Scene) -> Vec<ShownAid> {
    let fault = scene == Scene::Fault;
    let aid = |name: &str, rate: f64, reasons: Vec<Cause>, lost: bool| ShownAid {
        name: name.to_owned(),
        in_use: !lost,
        age_s: Some(if lost { t - 230.0 } else { (t * 3.7).fract() / rate }),
        accepted: count(if lost { 230.0 } else { t }, rate),
        rejected: reasons.iter().map(|cause| cause.count).sum(),
        reasons,
        floored: 0,
        last_normalised_innovation: Some(if lost { 7.4 } else { 1.6 * (t * 1.7).sin() }),
    };
    let refused = vec![
        cause("chi_square", 11),
        cause("no_fix", if fault { count(t - 230.0, 5.0) } else { 0 }),
    ];
    let mut aids = vec![
        aid("gnss_position", 5.0, refused, fault),
        aid("gnss_velocity", 5.0, vec![cause("source_suspect", 4)], fault),
        aid("heading", 10.0, Vec::new(), fault),
    ];
    if scene != Scene::Alignment {
        aids.push(aid("log_bottom", 2.0, vec![cause("chi_square", 1)], false));
    }
    aids
}

/// What became of the samples of the IMU.
pub(super) fn samples(t: f64) -> Samples {
    Samples { used: count(t, 200.0), gaps: 1, duplicates: 0, out_of_order: 0, out_of_range: 0 }
}

/// The last measurements that were not used.
pub(super) fn rejections(t: f64, scene: Scene) -> Vec<Rejected> {
    let rejected = |at_s: f64, aid: &str, reason: &str| Rejected {
        at_s,
        utc: Some(utc(at_s)),
        source: "gnss".to_owned(),
        aid: aid.to_owned(),
        reason: reason.to_owned(),
    };
    let mut all = vec![
        rejected(112.4, "gnss_position", "chi_square"),
        rejected(112.4, "gnss_velocity", "source_suspect"),
        rejected(113.4, "gnss_position", "chi_square"),
    ];
    if scene == Scene::Fault {
        let last = (t * 5.0).floor() / 5.0;
        let late = (0..20).map(|back| last - 0.2 * f64::from(20 - back));
        all.extend(late.map(|at| rejected(at, "gnss_position", "no_fix")));
    }
    all
}
