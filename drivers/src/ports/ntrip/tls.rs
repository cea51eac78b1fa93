//! TLS towards a caster: who answers is who was called, and nobody in between hears the password.

use std::fs;
use std::io;
use std::path::Path;
use std::sync::Arc;
use std::time::Duration;

use insd_base::UtcTime;
use tokio::net::TcpStream;
use tokio::time::timeout;
use tokio_rustls::TlsConnector;
use tokio_rustls::client::TlsStream;
use tokio_rustls::rustls::client::ClientConfig;
use tokio_rustls::rustls::crypto::ring;
use tokio_rustls::rustls::pki_types::pem::PemObject;
use tokio_rustls::rustls::pki_types::{CertificateDer, ServerName, UnixTime};
use tokio_rustls::rustls::time_provider::TimeProvider;
use tokio_rustls::rustls::{CertificateError, Error, RootCertStore};

use super::config::Ntrip;

/// The authorities of the system, as Debian's `ca-certificates` has them.
const SYSTEM: &str = "/etc/ssl/certs/ca-certificates.crt";

/// The one time by which certificates are judged: that of the port's clock when it called.
#[derive(Debug)]
struct Called(UnixTime);

impl TimeProvider for Called {
    fn current_time(&self) -> Option<UnixTime> {
        Some(self.0)
    }
}

/// A connection that is secured, by certificates that are good now.
///
/// # Errors
/// Why it is not, in words.
pub(in super::super) async fn secure(
    stream: TcpStream,
    config: &Ntrip,
    now: UtcTime,
) -> Result<TlsStream<TcpStream>, String> {
    let host = config.address.rsplit_once(':').map_or("", |(host, _)| host);
    let host = host.trim_start_matches('[').trim_end_matches(']');
    let name = ServerName::try_from(host.to_owned())
        .map_err(|_| format!("TLS: {host} is no name that a certificate can be of"))?;
    let connector = TlsConnector::from(Arc::new(client(config, now)?));
    let limit = Duration::from_secs_f64(config.timeout_s);
    match timeout(limit, connector.connect(name, stream)).await {
        Ok(Ok(stream)) => Ok(stream),
        Ok(Err(error)) => Err(in_words(&error, host)),
        Err(_) => Err(format!("no TLS in {} s", config.timeout_s)),
    }
}

fn client(config: &Ntrip, now: UtcTime) -> Result<ClientConfig, String> {
    let since = Duration::from_nanos(now.as_nanos().max(0).unsigned_abs());
    let called = Arc::new(Called(UnixTime::since_unix_epoch(since)));
    let path = config.ca_file.as_deref().unwrap_or(Path::new(SYSTEM));
    let roots = roots(path).map_err(|why| format!("TLS: {}: {why}", path.display()))?;
    let builder = ClientConfig::builder_with_details(Arc::new(ring::default_provider()), called);
    let builder =
        builder.with_safe_default_protocol_versions().map_err(|error| error.to_string())?;
    Ok(builder.with_root_certificates(roots).with_no_client_auth())
}

/// The authorities of a file. It is read at each call, so that one that has become better needs no new start.
fn roots(path: &Path) -> Result<RootCertStore, String> {
    let text = fs::read(path).map_err(|error| error.to_string())?;
    let mut roots = RootCertStore::empty();
    // a system's file may hold one that is not understood
    let read = CertificateDer::pem_slice_iter(&text).filter_map(Result::ok);
    let (taken, _) = roots.add_parsable_certificates(read);
    if taken == 0 {
        return Err("there is no certificate in it".to_owned());
    }
    Ok(roots)
}

/// Why there is no TLS.
fn in_words(error: &io::Error, host: &str) -> String {
    use CertificateError as Bad;
    let told = error.get_ref().and_then(|inner| inner.downcast_ref::<Error>());
    let why = match told {
        Some(Error::InvalidCertificate(bad)) => match bad {
            Bad::Expired | Bad::ExpiredContext { .. } => {
                "its certificate has expired, by the clock of this computer".to_owned()
            }
            Bad::NotValidYet | Bad::NotValidYetContext { .. } => {
                "its certificate is not valid yet, by the clock of this computer".to_owned()
            }
            Bad::UnknownIssuer => {
                "nobody who is trusted has signed its certificate; ca_file names who else is"
                    .to_owned()
            }
            Bad::NotValidForName | Bad::NotValidForNameContext { .. } => {
                format!("its certificate is of another name than {host}")
            }
            other => format!("its certificate is refused: {other}"),
        },
        Some(Error::InvalidMessage(_)) => "the caster speaks no TLS there".to_owned(),
        Some(other) => other.to_string(),
        None if error.kind() == io::ErrorKind::UnexpectedEof => {
            "closed by the caster while TLS began".to_owned()
        }
        None => error.to_string(),
    };
    format!("TLS: {why}")
}
