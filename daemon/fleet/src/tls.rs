//! The broker over TLS, where the program is built with it (feature `tls`).

use std::path::Path;

use rumqttc::Transport;

/// Encrypted; `authority` is a file of the certificates that are believed, in PEM, else those of the computer.
#[cfg(feature = "tls")]
pub(crate) fn transport(authority: Option<&Path>) -> Result<Transport, String> {
    use tokio_rustls::rustls::crypto::ring;

    // another part of the program may have chosen it already, and the same
    let _ = ring::default_provider().install_default();
    let Some(file) = authority else { return Ok(Transport::tls_with_default_config()) };
    let ca = std::fs::read(file).map_err(|fault| format!("{}: {fault}", file.display()))?;
    Ok(Transport::tls(ca, None, None))
}

/// This program was built without it.
#[cfg(not(feature = "tls"))]
pub(crate) fn transport(_: Option<&Path>) -> Result<Transport, String> {
    Err("this program was built without TLS for fleets (feature `tls`)".to_owned())
}
