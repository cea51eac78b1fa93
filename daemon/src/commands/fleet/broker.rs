//! The broker, as the command line names it.

use std::path::PathBuf;

use insd_config::BadInput;
use insd_fleet::BrokerPlan;

/// The broker, and as who it is called.
#[derive(Clone, Debug, clap::Args)]
pub(super) struct BrokerArgs {
    /// The broker: name or address, and port
    #[arg(long, value_name = "HOST[:PORT]", default_value = "localhost:1883")]
    broker: String,
    /// What topics begin with
    #[arg(long, value_name = "TOPIC", default_value = "insd/v1")]
    pub(super) topic: String,
    /// User at the broker
    #[arg(long, value_name = "NAME")]
    user: Option<String>,
    /// File with the password
    #[arg(long, value_name = "FILE", requires = "user")]
    password_file: Option<PathBuf>,
    /// Encrypted; needs a program that was built with the feature `tls`
    #[arg(long)]
    tls: bool,
    /// File with the certificates that are believed, PEM
    #[arg(long, value_name = "FILE", requires = "tls")]
    tls_ca_file: Option<PathBuf>,
}

impl BrokerArgs {
    pub(super) fn plan(&self, client: &str) -> anyhow::Result<BrokerPlan> {
        let standard = if self.tls { 8883 } else { 1883 };
        let (host, port) = match self.broker.rsplit_once(':') {
            Some((host, port)) if !host.is_empty() && !host.contains(':') => {
                let port =
                    port.parse().map_err(|_| BadInput(format!("{port}: expected a port")))?;
                (host, port)
            }
            _ => (self.broker.as_str(), standard),
        };
        let login = crate::run::login(self.user.as_deref(), self.password_file.as_deref());
        Ok(BrokerPlan {
            host: host.to_owned(),
            port,
            client: client.to_owned(),
            login: login.map_err(BadInput)?,
            tls: self.tls.then(|| self.tls_ca_file.clone()),
        })
    }
}
