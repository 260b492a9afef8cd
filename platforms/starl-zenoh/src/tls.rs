//! The certificates of a member, and their check before they are used.
//!
//! A member whose certificate the others refuse would retry for ever without a word. The check is the one that they make
//! (RFC 5280, by rustls), so that the member itself reports the error.

use rustls::client::WebPkiServerVerifier;
use rustls::client::danger::ServerCertVerifier;
use rustls::crypto::CryptoProvider;
use rustls::pki_types::pem::{self, PemObject};
use rustls::pki_types::{CertificateDer, PrivateKeyDer, ServerName, UnixTime};
use rustls::server::WebPkiClientVerifier;
use rustls::sign::CertifiedKey;
use rustls::version::TLS13;
use rustls::{CertificateError, ClientConfig, Error, InconsistentKeys, RootCertStore};
use std::fmt;
use std::net::IpAddr;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Certificates and keys, as files in PEM.
#[derive(Clone, Debug)]
pub struct Tls {
    /// The authority that signs the certificates of all members.
    pub authority: PathBuf,
    /// This member's certificate.
    pub certificate: PathBuf,
    /// The key to it.
    pub key: PathBuf,
}

/// Why a file cannot be used.
#[derive(Debug, PartialEq, Eq)]
pub struct TlsError {
    /// Its field in [`Tls`].
    pub field: &'static str,
    /// The file.
    pub path: PathBuf,
    /// The problem, and what to do.
    pub problem: String,
}

impl fmt::Display for TlsError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{}: {}: {}",
            self.field,
            self.path.display(),
            self.problem
        )
    }
}

impl std::error::Error for TlsError {}

impl Tls {
    /// Checks that others will accept this member, which they reach at `address` if it listens.
    ///
    /// # Errors
    /// A file cannot be read or is of another kind, the key does not belong to the certificate, or the certificate has
    /// expired, is not for the address, or is not signed by the authority.
    pub fn check(&self, address: Option<IpAddr>) -> Result<(), TlsError> {
        let provider = Arc::new(rustls::crypto::ring::default_provider());
        let roots = self.roots()?;
        let chain = read_certificates("certificate", &self.certificate)?;
        let key = self.private_key()?;
        CertifiedKey::from_der(chain.clone(), key, &provider).map_err(|error| {
            let problem = match error {
                Error::InconsistentKeys(InconsistentKeys::KeyMismatch) => {
                    let certificate = self.certificate.display();
                    format!("does not belong to the certificate {certificate}")
                }
                other => text(&other),
            };
            TlsError::new("key", &self.key, problem)
        })?;
        accepted(&chain, Arc::new(roots), provider, address).map_err(|error| {
            let problem = match &error {
                Error::InvalidCertificate(
                    CertificateError::UnknownIssuer | CertificateError::BadSignature,
                ) => {
                    format!(
                        "is not signed by the authority {}",
                        self.authority.display()
                    )
                }
                other => text(other),
            };
            TlsError::new("certificate", &self.certificate, problem)
        })
    }

    /// The configuration with which this member connects to others.
    pub(crate) fn client(&self) -> Result<ClientConfig, TlsError> {
        let unusable = |error: Error| TlsError::new("certificate", &self.certificate, text(&error));
        let provider = Arc::new(rustls::crypto::ring::default_provider());
        // Zenoh takes no other version where both ends have certificates.
        let builder = ClientConfig::builder_with_provider(provider)
            .with_protocol_versions(&[&TLS13])
            .map_err(unusable)?;
        builder
            .with_root_certificates(self.roots()?)
            .with_client_auth_cert(
                read_certificates("certificate", &self.certificate)?,
                self.private_key()?,
            )
            .map_err(unusable)
    }

    fn roots(&self) -> Result<RootCertStore, TlsError> {
        let mut roots = RootCertStore::empty();
        for root in read_certificates("authority", &self.authority)? {
            let added = roots.add(root);
            added.map_err(|error| TlsError::new("authority", &self.authority, text(&error)))?;
        }
        Ok(roots)
    }

    fn private_key(&self) -> Result<PrivateKeyDer<'static>, TlsError> {
        PrivateKeyDer::from_pem_file(&self.key)
            .map_err(|error| unreadable("key", &self.key, &error, "a private key"))
    }
}

impl TlsError {
    fn new(field: &'static str, path: &Path, problem: String) -> TlsError {
        TlsError {
            field,
            path: path.to_path_buf(),
            problem,
        }
    }
}

/// Makes the checks of the members to which this one connects, and of those that connect to it.
fn accepted(
    chain: &[CertificateDer<'_>],
    roots: Arc<RootCertStore>,
    provider: Arc<CryptoProvider>,
    address: Option<IpAddr>,
) -> Result<(), Error> {
    let now = UnixTime::now();
    let other = |error: rustls::server::VerifierBuilderError| Error::General(error.to_string());
    let (own, intermediates) = chain.split_first().ok_or(Error::NoCertificatesPresented)?;
    let client = WebPkiClientVerifier::builder_with_provider(roots.clone(), provider.clone());
    let client = client.build().map_err(other)?;
    client.verify_client_cert(own, intermediates, now)?;
    if let Some(address) = address {
        let server = WebPkiServerVerifier::builder_with_provider(roots, provider);
        let server = server.build().map_err(other)?;
        let name = ServerName::from(address);
        server.verify_server_cert(own, intermediates, &name, &[], now)?;
    }
    Ok(())
}

fn read_certificates(
    field: &'static str,
    path: &Path,
) -> Result<Vec<CertificateDer<'static>>, TlsError> {
    let read = CertificateDer::pem_file_iter(path).and_then(Iterator::collect);
    let error = match read {
        Ok(certificates) if Vec::is_empty(&certificates) => pem::Error::NoItemsFound,
        Ok(certificates) => return Ok(certificates),
        Err(error) => error,
    };
    Err(unreadable(field, path, &error, "a certificate"))
}

fn unreadable(field: &'static str, path: &Path, error: &pem::Error, wanted: &str) -> TlsError {
    let problem = match error {
        pem::Error::Io(error) => format!("cannot be read: {error}"),
        pem::Error::NoItemsFound => format!("contains no {}; give {wanted} in PEM", &wanted[2..]),
        other => format!("is damaged: {other}; give {wanted} in PEM"),
    };
    TlsError::new(field, path, problem)
}

/// The problem of a certificate in plain words.
pub(crate) fn text(error: &Error) -> String {
    let Error::InvalidCertificate(problem) = error else {
        return format!("cannot be used: {error}");
    };
    match problem {
        CertificateError::Expired | CertificateError::ExpiredContext { .. } => {
            "has expired; sign a new one".to_string()
        }
        CertificateError::NotValidYet | CertificateError::NotValidYetContext { .. } => {
            "is not valid yet; check the clock of this computer".to_string()
        }
        CertificateError::NotValidForNameContext {
            expected,
            presented,
        } => {
            let expected = expected.to_str();
            let presented = match presented.is_empty() {
                true => "no name".to_string(),
                false => presented.join(", "),
            };
            format!("is for {presented}; it needs the subject alternative name {expected}")
        }
        other => format!("cannot be used: {other}"),
    }
}
