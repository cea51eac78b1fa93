//! What a caster is called with.

use std::path::PathBuf;

use schemars::JsonSchema;
use serde::Deserialize;

/// Longest time-out and longest interval of positions, s.
const LONGEST: f64 = 3600.0;
/// Shortest time-out, s.
const SHORTEST: f64 = 1.0;

/// A mount point of an NTRIP caster, of version 1 or 2.
#[derive(Clone, Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Ntrip {
    /// Host and port of the caster, for example `caster.example.org:2101`.
    pub address: String,
    /// The mount point.
    pub mount: String,
    /// Whether the connection is secured by TLS, and the caster has to be who was called.
    #[serde(default)]
    pub tls: bool,
    /// File with the certificates (PEM) of who may sign that of the caster; those of the system if left out.
    #[serde(default)]
    pub ca_file: Option<PathBuf>,
    /// Who calls, where the caster asks for it.
    #[serde(default)]
    pub user: Option<String>,
    /// File that holds the password, and nothing else. Only its owner may read it (mode 0600 or less).
    #[serde(default)]
    pub password_file: Option<PathBuf>,
    /// Name of the credential that systemd hands over with the password (`LoadCredential=`), in place of a file.
    #[serde(default)]
    pub credential: Option<String>,
    /// Version that is asked for: 1 or 2. What answers is understood in either.
    #[serde(default = "default_version")]
    pub version: u8,
    /// Seconds between the positions of the ship (GGA) that the caster is told; 0: it is told none. A network of
    /// virtual stations wants to know it.
    #[serde(default)]
    pub gga_s: f64,
    /// Seconds in which something must come: the answer, or as much of the corrections as an epoch takes. Else the
    /// caster is called anew.
    #[serde(default = "default_timeout")]
    pub timeout_s: f64,
}

fn default_version() -> u8 {
    2
}

fn default_timeout() -> f64 {
    30.0
}

impl Ntrip {
    /// A mount point of a caster that asks for no password.
    #[must_use]
    pub fn new(address: String, mount: String) -> Self {
        Ntrip {
            address,
            mount,
            tls: false,
            ca_file: None,
            user: None,
            password_file: None,
            credential: None,
            version: default_version(),
            gga_s: 0.0,
            timeout_s: default_timeout(),
        }
    }

    /// All that is wrong with it, in words.
    pub(crate) fn faults(&self) -> Vec<String> {
        let has_port = self.address.rsplit_once(':').is_some_and(|(host, port)| {
            !host.is_empty() && port.parse::<u16>().is_ok_and(|port| port > 0)
        });
        let is_name = |byte: u8| byte.is_ascii_graphic() && byte != b'/' && byte != b'?';
        let mount = !self.mount.is_empty() && self.mount.len() <= 100;
        let is_line = |text: &String| !text.contains(char::is_control);
        let user = self.user.iter().all(|user| is_line(user) && !user.contains(':'));
        let secrets = u8::from(self.password_file.is_some()) + u8::from(self.credential.is_some());
        let checks = [
            (has_port, "address: expected HOST:PORT"),
            (mount && self.mount.bytes().all(is_name), "mount: expected the name of a mount point"),
            (user, "user: expected a name without a colon"),
            (self.tls || self.ca_file.is_none(), "ca_file: expected tls = true beside it"),
            (secrets <= 1, "password_file: expected either this or credential"),
            (secrets == 0 || self.user.is_some(), "user: expected one, as there is a password"),
            (
                self.credential.iter().all(|name| !name.contains('/') && !name.is_empty()),
                "credential: expected the name of a credential of the service",
            ),
            (matches!(self.version, 1 | 2), "version: expected 1 or 2"),
            (
                self.gga_s == 0.0 || (1.0..=LONGEST).contains(&self.gga_s),
                "gga_s: expected 0, or 1 to 3600 s",
            ),
            ((SHORTEST..=LONGEST).contains(&self.timeout_s), "timeout_s: expected 1 to 3600 s"),
        ];
        checks.iter().filter(|(good, _)| !good).map(|(_, fault)| (*fault).to_owned()).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mount_point_is_read_from_toml_and_its_faults_are_told_together() {
        let text = "address = \"caster.example.org:2101\"\nmount = \"BASE1\"";
        let own: Ntrip = toml::from_str(text).unwrap();
        assert_eq!(own, Ntrip::new("caster.example.org:2101".to_owned(), "BASE1".to_owned()));
        assert_eq!(own.faults(), Vec::<String>::new());
        let wrong = "address = \"caster\"\nmount = \"A B\"\nversion = 3\npassword_file = \"a\"\n\
                     credential = \"b\"\nca_file = \"c\"\ngga_s = 0.1\ntimeout_s = 0.0";
        let faults = toml::from_str::<Ntrip>(wrong).unwrap().faults();
        assert_eq!(faults.len(), 8, "{faults:?}");
        assert!(toml::from_str::<Ntrip>(&format!("{text}\npassword = \"x\"")).is_err());
    }
}
