//! The mistakes that a configuration alone shows.

use insd_config::Severity::{self, Error, Note, Warning};

/// How a mistake gets into the configuration.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Change {
    /// One text stands there instead of another.
    Write(&'static str, &'static str),
    /// More stands there.
    Add(&'static str),
    /// The environment says so.
    Say(&'static str, &'static str),
}

use Change::{Add, Say, Write};

/// One mistake.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Mistake {
    /// What was done.
    pub(crate) what: &'static str,
    pub(crate) severity: Severity,
    pub(crate) cause: &'static str,
    pub(crate) change: Change,
}

const fn row(
    what: &'static str,
    severity: Severity,
    cause: &'static str,
    change: Change,
) -> Mistake {
    Mistake { what, severity, cause, change }
}

const LEVER: &str = "gnss_lever_m = [-3.0, 0.5, -18.0]";
const LOG: &str = "log_lever_m = [20.0, 0.0, 4.0]";
const ROTATION: &str = "rotation_deg = [0.0, 0.0, 0.0]";
const AXES: &str = "axes = [\"forward\", \"starboard\", \"down\"]";
const IMU: &str = "\"/dev/serial/by-id/usb-FTDI_IMU-if00-port0\", baud = 921600";
const GNSS: &str = "\"/dev/serial/by-id/usb-u-blox_GNSS-if00\"";
const BRIDGE: &str = "\"/dev/serial/by-id/usb-FTDI_bridge-if00-port0\", baud = 38400";
const UDP_PORT: &str = "transport = { kind = \"udp\"";
const UDP: &str = "kind = \"udp\", bind = \"0.0.0.0:60004\", multicast = \"239.192.0.4\"";

pub(crate) const TABLE: &[Mistake] = &[
    row(
        "antenna below the IMU: sign of down",
        Warning,
        "lever-sign",
        Write(LEVER, "gnss_lever_m = [-3.0, 0.5, 18.0]"),
    ),
    row(
        "lever in millimetres",
        Error,
        "lever-long",
        Write(LEVER, "gnss_lever_m = [-3000.0, 500.0, -18000.0]"),
    ),
    row(
        "lever longer than any ship",
        Error,
        "lever-long",
        Write(LEVER, "gnss_lever_m = [-600.0, 0.5, -18.0]"),
    ),
    row(
        "lever ten times too long",
        Warning,
        "lever-wide",
        Write("[-3.0, 0.5, -18.0]", "[-30.0, 50.0, -80.0]"),
    ),
    row(
        "forward and starboard changed places",
        Warning,
        "lever-wide",
        Write(LEVER, "gnss_lever_m = [0.5, -60.0, -18.0]"),
    ),
    row(
        "antenna higher than any mast",
        Warning,
        "lever-high",
        Write(LEVER, "gnss_lever_m = [-3.0, 0.5, -180.0]"),
    ),
    row(
        "antenna not measured",
        Note,
        "lever-unmeasured",
        Write(LEVER, "gnss_lever_m = [0.0, 0.0, 0.0]"),
    ),
    row(
        "log above the IMU: sign of down",
        Warning,
        "log-above",
        Write(LOG, "log_lever_m = [20.0, 0.0, -4.0]"),
    ),
    row("log not measured", Note, "log-lever", Write(LOG, "")),
    row(
        "monitoring point on land",
        Error,
        "lever-long",
        Write("lever_m = [35.0, 0.0, -12.0]", "lever_m = [350.0, 400.0, -12.0]"),
    ),
    row(
        "receiver's own lever with the wrong sign",
        Warning,
        "lever-sign",
        Write("priority = 1", "priority = 1\nlever_m = [2.0, 1.0, 18.0]"),
    ),
    row(
        "lever of a receiver written for a log",
        Error,
        "range",
        Write("talkers = [\"VD\"]", "delay_s = 0.1"),
    ),
    row(
        "latitude and longitude changed places",
        Error,
        "place-range",
        Write(
            "lat_deg = 35.44                    # the berth; optional where a receiver tells\nlon_deg = 139.65",
            "lat_deg = 139.65\nlon_deg = 35.44",
        ),
    ),
    row(
        "place left at 0, 0",
        Warning,
        "place-zero",
        Write(
            "lat_deg = 35.44                    # the berth; optional where a receiver tells\nlon_deg = 139.65",
            "lat_deg = 0.0\nlon_deg = 0.0",
        ),
    ),
    row("height of a mountain", Warning, "height", Write("height_m = 40.0", "height_m = 4000.0")),
    row(
        "mounting of 400 deg",
        Error,
        "mounting-angle",
        Write(ROTATION, "rotation_deg = [0.0, 0.0, 400.0]"),
    ),
    row(
        "quarter turn as what is left of one",
        Warning,
        "mounting-turn",
        Write(ROTATION, "rotation_deg = [0.0, 0.0, 90.0]"),
    ),
    row(
        "mirrored axes",
        Error,
        "mounting-axes",
        Write(AXES, "axes = [\"forward\", \"port\", \"down\"]"),
    ),
    row(
        "a direction twice",
        Error,
        "mounting-axes",
        Write(AXES, "axes = [\"forward\", \"forward\", \"down\"]"),
    ),
    row(
        "misspelt direction",
        Error,
        "unknown-word",
        Write(AXES, "axes = [\"foreward\", \"starboard\", \"down\"]"),
    ),
    row(
        "gyro bias of 3600 deg/h",
        Error,
        "imu-spec",
        Write("gyro_bias_std_deg_h = 0.01", "gyro_bias_std_deg_h = 3600.0"),
    ),
    row(
        "gyro bias in rad/s",
        Error,
        "imu-spec",
        Write("gyro_bias_std_deg_h = 0.01", "gyro_bias_std_deg_h = 4.8e-8"),
    ),
    row(
        "angle random walk in rad/sqrt(s)",
        Error,
        "imu-spec",
        Write("angle_random_walk_deg_sqrt_h = 0.003", "angle_random_walk_deg_sqrt_h = 8.7e-7"),
    ),
    row(
        "accelerometer bias in mg",
        Error,
        "imu-spec",
        Write("accel_bias_std_ug = 50.0", "accel_bias_std_ug = 0.05"),
    ),
    row(
        "velocity random walk in micro-g/sqrt(Hz)",
        Error,
        "imu-spec",
        Write("velocity_random_walk_mps_sqrt_h = 0.003", "velocity_random_walk_mps_sqrt_h = 50.0"),
    ),
    row(
        "scale factor as a ratio",
        Error,
        "imu-spec",
        Write("gyro_scale_factor_std_ppm = 10.0", "gyro_scale_factor_std_ppm = 1e-5"),
    ),
    row(
        "time constant in hours",
        Warning,
        "imu-time-constant",
        Write("gyro_bias_time_constant_s = 3600.0", "gyro_bias_time_constant_s = 1.0"),
    ),
    row(
        "error of the IMU set to zero",
        Warning,
        "imu-zero",
        Write("angle_random_walk_deg_sqrt_h = 0.003", "angle_random_walk_deg_sqrt_h = 0.0"),
    ),
    row(
        "model of a laser gyro left for a MEMS unit",
        Warning,
        "imu-grade",
        Write("kind = \"sbg\"", "kind = \"xbus\""),
    ),
    row("two samples a second", Warning, "imu-rate", Write("rate_hz = 200.0", "rate_hz = 2.0")),
    row(
        "IMU on a line that is too slow",
        Error,
        "imu-baud",
        Write(IMU, "\"/dev/serial/by-id/usb-FTDI_IMU-if00-port0\", baud = 9600"),
    ),
    row(
        "no IMU",
        Error,
        "no-imu",
        Write(
            "name = \"imu\"\nport = \"imu\"\nkind = \"sbg\"",
            "name = \"imu\"\nport = \"imu\"\nkind = \"psxn\"",
        ),
    ),
    row("name of a Windows port", Error, "device-windows", Write(GNSS, "\"COM3\"")),
    row("device without its folder", Error, "device-relative", Write(GNSS, "\"ttyS3\"")),
    row("USB device by its number", Note, "device-numbered", Write(GNSS, "\"/dev/ttyUSB0\"")),
    row(
        "one device for two ports",
        Error,
        "device-twice",
        Write(GNSS, "\"/dev/serial/by-id/usb-FTDI_IMU-if00-port0\""),
    ),
    row(
        "output on an input's device",
        Error,
        "output-on-input",
        Write(BRIDGE, "\"/dev/serial/by-id/usb-FTDI_IMU-if00-port0\", baud = 921600"),
    ),
    row("slip in a baud rate", Warning, "baud-odd", Write("baud = 115200", "baud = 115000")),
    row(
        "more messages than the line carries",
        Error,
        "overload",
        Write(BRIDGE, "\"/dev/ttyS5\", baud = 4800"),
    ),
    row(
        "a line that is nearly full",
        Warning,
        "load",
        Write("messages = { HDT = 10.0, GNS = 0 }", "messages = { HDT = 140.0, GNS = 0 }"),
    ),
    row("misspelt key", Error, "unknown-key", Write("rate_hz = 10.0", "rate_herz = 10.0")),
    row("misspelt section", Error, "unknown-section", Add("[weeb]\nenabled = true")),
    row(
        "one bracket where there may be several",
        Error,
        "section-form",
        Write("[[point]]", "[point]"),
    ),
    row("number in quotes", Error, "type", Write("baud = 115200", "baud = \"115200\"")),
    row("a key is missing", Error, "missing-key", Write(", baud = 115200", "")),
    row("decimal comma", Error, "syntax", Write("height_m = 40.0", "height_m = 40,0")),
    row(
        "maker instead of format",
        Error,
        "unknown-word",
        Write("kind = \"ubx\"", "kind = \"ublox\""),
    ),
    row(
        "sensor on a port that is not there",
        Error,
        "unknown-port",
        Write("name = \"log\"\nport = \"bridge-in\"", "name = \"log\"\nport = \"bridge\""),
    ),
    row(
        "port without a sensor",
        Warning,
        "port-unused",
        Add(
            "[[port]]\nname = \"spare\"\ntransport = { kind = \"serial\", device = \"/dev/ttyS7\", baud = 4800 }",
        ),
    ),
    row(
        "two sensors of one name",
        Error,
        "duplicate-name",
        Write("name = \"log\"", "name = \"gnss\""),
    ),
    row(
        "two sensors on the same frames",
        Error,
        "sensor-twice",
        Add("[[sensor]]\nname = \"second\"\nport = \"gnss\"\nkind = \"ubx\""),
    ),
    row(
        "IMU of a CAN bus on a serial line",
        Error,
        "kind-transport",
        Write("kind = \"ubx\"", "kind = \"can_imu\"\nlayout = \"sbg\""),
    ),
    row(
        "sensor on the pulse",
        Error,
        "kind-transport",
        Add("[[sensor]]\nname = \"compass\"\nport = \"pulse\"\nkind = \"compass\""),
    ),
    row(
        "talker with its dollar sign",
        Error,
        "talker",
        Write("talkers = [\"VD\"]", "talkers = [\"$VDVBW\"]"),
    ),
    row(
        "latency in milliseconds",
        Error,
        "range",
        Write("priority = 1", "priority = 1\nlatency_s = 80.0"),
    ),
    row(
        "latency of a second",
        Warning,
        "latency",
        Write("priority = 1", "priority = 1\nlatency_s = 1.0"),
    ),
    row(
        "page on the port of an output",
        Error,
        "address-twice",
        Add(
            "[web]\nlisten = \"0.0.0.0:10110\"\n[[output]]\nname = \"nmea\"\ndestination = { kind = \"tcp-server\", bind = \"127.0.0.1:10110\" }",
        ),
    ),
    row("page on a port of root", Error, "port-privileged", Add("[web]\nlisten = \"0.0.0.0:80\"")),
    row(
        "address of a page instead of a name",
        Warning,
        "host-form",
        Add("[web]\nhosts = [\"http://bridge:8470/\"]"),
    ),
    row(
        "address with a part missing",
        Error,
        "address",
        Write(UDP, "kind = \"udp\", bind = \"0.0.0:60004\""),
    ),
    row(
        "host that is neither an address nor a network",
        Error,
        "address",
        Write("multicast = \"239.192.0.4\"", "from = [\"192.168.1.0/33\"]"),
    ),
    row(
        "commands about alerts over a network, and nobody may give them",
        Warning,
        "commands-nobody",
        Add(
            "[[port]]\nname = \"bam\"\nalerts = true\ntransport = { kind = \"udp\", bind = \"0.0.0.0:60010\" }",
        ),
    ),
    row(
        "hosts that may command a port that hears no commands",
        Warning,
        "commands-unheard",
        Write(UDP_PORT, "commands_from = [\"192.168.1.30\"]\ntransport = { kind = \"udp\""),
    ),
    row(
        "server without a port",
        Error,
        "address-port",
        Write(UDP, "kind = \"tcp-client\", address = \"192.168.1.20\""),
    ),
    row(
        "Signal K server that is not asked",
        Warning,
        "server-unasked",
        Add(
            "[[port]]\nname = \"boat\"\ntransport = { kind = \"tcp-client\", address = \"192.168.1.40:8375\" }\n\
             [[sensor]]\nname = \"boat compass\"\nport = \"boat\"\nkind = \"signalk_heading\"\nsource = \"n2k.115\"",
        ),
    ),
    row(
        "output that comes back as an input",
        Warning,
        "hears-itself",
        Add(
            "[[output]]\nname = \"echo\"\ndestination = { kind = \"udp\", to = \"239.192.0.4:60004\" }",
        ),
    ),
    row(
        "misspelt monitoring point",
        Error,
        "unknown-point",
        Write("point = \"conning\"", "point = \"coning\""),
    ),
    row(
        "misspelt compass that is to be watched",
        Error,
        "unknown-sensor",
        Add(
            "[[sensor]]\nname = \"old gyro\"\nport = \"bridge-in\"\nkind = \"compass\"\n[[watch]]\nsensor = \"old giro\"",
        ),
    ),
    row(
        "receiver that is to be watched as a compass",
        Error,
        "unknown-sensor",
        Add("[[watch]]\nsensor = \"gnss\""),
    ),
    row(
        "watched compass with a limit that everything is beyond",
        Error,
        "range",
        Add(
            "[[sensor]]\nname = \"gyro\"\nport = \"bridge-in\"\nkind = \"compass\"\n[[watch]]\nsensor = \"gyro\"\nheading_deg = 0.0",
        ),
    ),
    row(
        "misspelt profile",
        Error,
        "unknown-profile",
        Write("profile = \"ecdis\"", "profile = \"ekdis\""),
    ),
    row("misspelt message", Error, "unknown-word", Write("HDT = 10.0", "HTD = 10.0")),
    row(
        "fleet whose broker is written as a URL",
        Error,
        "range",
        Add("[[fleet]]\nname = \"shore\"\nhost = \"mqtt://shore.example\"\nship = \"imo9074729\""),
    ),
    row(
        "ship whose name would be two levels of a topic",
        Error,
        "range",
        Add("[[fleet]]\nname = \"shore\"\nhost = \"shore.example\"\nship = \"fleet/ada\""),
    ),
    row(
        "password for a broker that goes over the network as it is",
        Warning,
        "fleet-open",
        Add(
            "[[fleet]]\nname = \"shore\"\nhost = \"shore.example\"\nship = \"imo9074729\"\nuser = \"ada\"\npassword_file = \"/etc/insd/fleet\"\ntls = false",
        ),
    ),
    row(
        "budget of a fleet that what is to be sent goes beyond",
        Warning,
        "fleet-budget",
        Add(
            "[[fleet]]\nname = \"shore\"\nhost = \"shore.example\"\nship = \"imo9074729\"\nhistory_s = 1.0\nbudget_bytes_h = 60000",
        ),
    ),
    row("recording without a quota", Warning, "recording-quota", Write("quota_mb = 20000", "")),
    row(
        "simulated sensors, and nobody is told",
        Warning,
        "simulated-unsaid",
        Write(GNSS, "\"/run/insd-sensors/gnss\""),
    ),
    row(
        "environment that says nonsense",
        Error,
        "environment",
        Say("INSD__SHIP__RATE_HZ", "often"),
    ),
];
