//! A caster over TLS, with a certificate that holds, and with those that do not.

use std::fs;
use std::path::PathBuf;
use std::sync::Arc;

use insd_base::PortState;
use insd_drivers::ports::{Ntrip, PortHandle, Transport};
use rcgen::{BasicConstraints, CertificateParams, IsCa, Issuer, KeyPair, date_time_ymd};
use tempfile::TempDir;
use tokio::io::{AsyncReadExt, AsyncWriteExt};
use tokio::net::{TcpListener, TcpStream};
use tokio_rustls::TlsAcceptor;
use tokio_rustls::rustls::ServerConfig;
use tokio_rustls::rustls::crypto::ring;
use tokio_rustls::rustls::pki_types::{CertificateDer, PrivateKeyDer, PrivatePkcs8KeyDer};

use crate::host::Host;
use crate::ntrip::{FIRST, FRAME};

/// Who signs certificates, with its file.
struct Authority {
    issuer: Issuer<'static, KeyPair>,
    file: PathBuf,
}

impl Authority {
    fn new(dir: &TempDir, name: &str) -> Self {
        let key = KeyPair::generate().unwrap();
        let mut own = CertificateParams::new(Vec::new()).unwrap();
        own.is_ca = IsCa::Ca(BasicConstraints::Unconstrained);
        own.distinguished_name.push(rcgen::DnType::CommonName, name);
        let file = dir.path().join(format!("{name}.pem"));
        fs::write(&file, own.self_signed(&key).unwrap().pem()).unwrap();
        Authority { issuer: Issuer::new(own, key), file }
    }

    /// A caster that shows a certificate of a name, changed.
    fn signs(&self, name: &str, change: impl FnOnce(&mut CertificateParams)) -> TlsAcceptor {
        let key = KeyPair::generate().unwrap();
        let mut own = CertificateParams::new(vec![name.to_owned()]).unwrap();
        change(&mut own);
        let shown: CertificateDer<'static> = own.signed_by(&key, &self.issuer).unwrap().into();
        let secret = PrivateKeyDer::Pkcs8(PrivatePkcs8KeyDer::from(key.serialize_der()));
        let builder = ServerConfig::builder_with_provider(Arc::new(ring::default_provider()));
        let builder = builder.with_safe_default_protocol_versions().unwrap();
        let config = builder.with_no_client_auth().with_single_cert(vec![shown], secret).unwrap();
        TlsAcceptor::from(Arc::new(config))
    }
}

/// A caster and a port that calls it.
struct Scene {
    door: TcpListener,
    host: Host,
    _port: PortHandle,
}

impl Scene {
    async fn new(ca_file: PathBuf) -> Self {
        let door = TcpListener::bind("127.0.0.1:0").await.unwrap();
        let address = format!("localhost:{}", door.local_addr().unwrap().port());
        let host = Host::new();
        let own = Ntrip {
            tls: true,
            ca_file: Some(ca_file),
            timeout_s: 1.0,
            ..Ntrip::new(address, "BASE".to_owned())
        };
        let port = host.spawn(1, Transport::Ntrip(own));
        Scene { door, host, _port: port }
    }

    async fn call(&self) -> TcpStream {
        self.door.accept().await.unwrap().0
    }

    /// Waits until the port says that there is no stream, in these words among others.
    async fn told(&mut self, words: &str) {
        let is_it = |state: &PortState| match state {
            PortState::Absent { reason } | PortState::Lost { reason } => reason.contains(words),
            _ => false,
        };
        self.host.state(1, is_it).await;
    }

    /// A caster whose certificate holds answers the next call.
    async fn recovers(&mut self, good: &TlsAcceptor) {
        let mut stream = good.accept(self.call().await).await.unwrap();
        let mut asked = Vec::new();
        while !asked.ends_with(b"\r\n\r\n") {
            asked.push(stream.read_u8().await.unwrap());
        }
        assert!(asked.starts_with(b"GET /BASE HTTP/1.1\r\n"));
        stream.write_all(&[FIRST, &FRAME[..]].concat()).await.unwrap();
        stream.flush().await.unwrap();
        self.host.bytes(1, &FRAME).await;
        let states = self.host.states(Some(1)).join("\n");
        assert!(states.contains("NTRIP 1, TLS"), "{states}");
    }
}

#[tokio::test]
async fn each_certificate_that_does_not_hold_is_told_in_its_own_words_and_recovered_from() {
    let dir = tempfile::tempdir().unwrap();
    let (own, stranger) = (Authority::new(&dir, "own"), Authority::new(&dir, "stranger"));
    let good = own.signs("localhost", |_| ());
    let past = |own: &mut CertificateParams| own.not_after = date_time_ymd(2020, 1, 1);
    let to_come = |own: &mut CertificateParams| own.not_before = date_time_ymd(2999, 1, 1);
    let cases = [
        (own.signs("localhost", past), "has expired"),
        (own.signs("localhost", to_come), "is not valid yet"),
        (own.signs("caster.example.org", |_| ()), "is of another name than localhost"),
        (stranger.signs("localhost", |_| ()), "nobody who is trusted has signed"),
    ];
    for (bad, words) in cases {
        let mut scene = Scene::new(own.file.clone()).await;
        assert!(bad.accept(scene.call().await).await.is_err());
        scene.told(words).await;
        scene.recovers(&good).await;
    }
}

#[tokio::test]
async fn a_caster_without_tls_one_that_is_silent_and_a_missing_file_are_told_and_recovered_from() {
    let dir = tempfile::tempdir().unwrap();
    let own = Authority::new(&dir, "own");
    let good = own.signs("localhost", |_| ());
    let mut scene = Scene::new(own.file.clone()).await;
    scene.call().await.write_all(b"ICY 200 OK\r\n\r\n").await.unwrap();
    scene.told("the caster speaks no TLS there").await;
    let held = scene.call().await;
    scene.told("no TLS in 1 s").await;
    drop(held);
    drop(scene.call().await);
    scene.told("TLS: ").await;
    fs::rename(&own.file, dir.path().join("away")).unwrap();
    scene.told("own.pem: No such file or directory").await;
    fs::write(&own.file, "no certificate").unwrap();
    scene.told("own.pem: there is no certificate in it").await;
    fs::rename(dir.path().join("away"), &own.file).unwrap();
    loop {
        // calls of the time without the file are dropped before TLS begins
        let stream = scene.call().await;
        if stream.peer_addr().is_ok() && good.accept(stream).await.is_ok() {
            break;
        }
    }
    scene.told("closed by").await;
    scene.recovers(&good).await;
}
