//! Members that identify themselves by certificates, and files that cannot be used for that.

use rcgen::{BasicConstraints, CertificateParams, IsCa, Issuer, KeyPair};
use starl_node::link::{Arrival, Transport};
use starl_zenoh::{Answer, Probed, Tls, Zenoh, ZenohOptions};
use std::net::{IpAddr, Ipv4Addr};
use std::path::{Path, PathBuf};
use std::sync::mpsc::{self, Receiver};
use std::time::{Duration, Instant};

const HERE: IpAddr = IpAddr::V4(Ipv4Addr::LOCALHOST);

/// An empty folder of a test.
fn folder(test: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("tls_{test}"));
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).unwrap();
    folder
}

/// An authority with its certificate in a file.
struct Authority {
    folder: PathBuf,
    name: &'static str,
    issuer: Issuer<'static, KeyPair>,
}

impl Authority {
    fn new(folder: &Path, name: &'static str) -> Authority {
        let mut params = CertificateParams::new(Vec::new()).unwrap();
        params.is_ca = IsCa::Ca(BasicConstraints::Unconstrained);
        let key = KeyPair::generate().unwrap();
        let certificate = params.self_signed(&key).unwrap();
        std::fs::write(folder.join(format!("{name}.pem")), certificate.pem()).unwrap();
        Authority {
            folder: folder.to_path_buf(),
            name,
            issuer: Issuer::new(params, key),
        }
    }

    /// Signs a certificate for an address, and writes it and its key to files.
    fn sign(&self, member: &str, address: &str) -> Tls {
        self.sign_changed(member, address, |_| {})
    }

    fn sign_changed(
        &self,
        member: &str,
        address: &str,
        change: impl FnOnce(&mut CertificateParams),
    ) -> Tls {
        let mut params = CertificateParams::new(vec![address.to_string()]).unwrap();
        change(&mut params);
        let key = KeyPair::generate().unwrap();
        let certificate = params.signed_by(&key, &self.issuer).unwrap();
        let file = |suffix| self.folder.join(format!("{member}.{suffix}"));
        std::fs::write(file("pem"), certificate.pem()).unwrap();
        std::fs::write(file("key"), key.serialize_pem()).unwrap();
        Tls {
            authority: self.folder.join(format!("{}.pem", self.name)),
            certificate: file("pem"),
            key: file("key"),
        }
    }
}

fn endpoint() -> String {
    format!("tls/127.0.0.1:{}", crate::network::free_port())
}

fn join(
    me: u32,
    listen: Option<&String>,
    connect: Option<&String>,
    tls: Tls,
) -> (Zenoh, Receiver<Arrival>) {
    let (sender, inbox) = mpsc::channel();
    let options = ZenohOptions {
        listen: listen.into_iter().cloned().collect(),
        connect: connect.into_iter().cloned().collect(),
        tls: Some(tls),
        ..ZenohOptions::default()
    };
    let deliver = move |arrival| sender.send(arrival).is_ok();
    (Zenoh::open("fleet", me, &options, deliver).unwrap(), inbox)
}

/// Whether something arrives within this time, if it is sent ten times a second.
fn meets(from: &mut Zenoh, to: u32, inbox: &Receiver<Arrival>, patience: Duration) -> bool {
    let begun = Instant::now();
    while begun.elapsed() < patience {
        from.send(to, b"hello").unwrap();
        if inbox.recv_timeout(Duration::from_millis(100)).is_ok() {
            return true;
        }
    }
    false
}

#[test]
fn members_of_one_authority_hear_each_other_and_a_stranger_does_not() {
    let folder = folder("meet");
    let authority = Authority::new(&folder, "authority");
    let place = endpoint();
    let first = authority.sign("first", "127.0.0.1");
    first.check(Some(HERE)).unwrap();
    let (mut first, from_second) = join(0, Some(&place), None, first);
    let second = authority.sign("second", "127.0.0.1");
    let (mut second, from_first) = join(1, None, Some(&place), second);
    let patience = Duration::from_secs(20);
    assert!(meets(&mut first, 1, &from_first, patience));
    assert!(meets(&mut second, 0, &from_second, patience));

    // It trusts the fleet's authority, but has its own certificate from another one.
    let other = Authority::new(&folder, "other");
    let mut stranger = other.sign("stranger", "127.0.0.1");
    stranger.authority = folder.join("authority.pem");
    let (mut stranger, from_fleet) = join(2, None, Some(&place), stranger);
    while from_second.try_recv().is_ok() {}
    let patience = Duration::from_secs(3);
    assert!(!meets(&mut stranger, 0, &from_second, patience));
    assert!(!meets(&mut first, 2, &from_fleet, Duration::from_secs(1)));
}

#[test]
fn a_file_that_cannot_be_used_is_named_with_its_problem() {
    let folder = folder("files");
    let authority = Authority::new(&folder, "authority");
    let good = authority.sign("robot", "127.0.0.1");
    good.check(Some(HERE)).unwrap();
    let stranger = Authority::new(&folder, "other").sign("stranger", "127.0.0.1");
    let old = authority.sign_changed("old", "127.0.0.1", |params| {
        params.not_after = rcgen::date_time_ymd(2020, 1, 1);
    });
    let elsewhere = authority.sign("elsewhere", "10.0.0.1");
    std::fs::write(folder.join("text"), "no certificate").unwrap();
    std::fs::write(folder.join("cut"), "-----BEGIN CERTIFICATE-----\nMII").unwrap();
    let file = |name: &str| folder.join(name);
    let with = |change: fn(&mut Tls, PathBuf), name: &str| {
        let mut tls = good.clone();
        change(&mut tls, file(name));
        tls
    };
    let cases = [
        (
            with(|tls, path| tls.authority = path, "missing"),
            "authority",
            "cannot be read: No such file or directory (os error 2)",
        ),
        (
            with(|tls, path| tls.authority = path, "text"),
            "authority",
            "contains no certificate; give a certificate in PEM",
        ),
        (
            with(|tls, path| tls.certificate = path, "robot.key"),
            "certificate",
            "contains no certificate; give a certificate in PEM",
        ),
        (
            with(|tls, path| tls.certificate = path, "cut"),
            "certificate",
            "is damaged: ",
        ),
        (
            with(|tls, path| tls.key = path, "robot.pem"),
            "key",
            "contains no private key; give a private key in PEM",
        ),
        (
            with(|tls, path| tls.key = path, "stranger.key"),
            "key",
            "does not belong to the certificate ",
        ),
        (
            with(|tls, path| tls.authority = path, "other.pem"),
            "certificate",
            "is not signed by the authority ",
        ),
        (
            stranger_of(&stranger, &good),
            "certificate",
            "is not signed",
        ),
        (old, "certificate", "has expired; sign a new one"),
        (
            elsewhere,
            "certificate",
            "it needs the subject alternative name 127.0.0.1",
        ),
    ];
    for (tls, field, problem) in cases {
        let error = tls.check(Some(HERE)).unwrap_err();
        assert_eq!(error.field, field, "{error}");
        assert!(error.problem.contains(problem), "{error}");
        let path = match field {
            "authority" => &tls.authority,
            "certificate" => &tls.certificate,
            _ => &tls.key,
        };
        assert_eq!(&error.path, path);
    }
}

/// The certificate of one with the authority of another.
fn stranger_of(stranger: &Tls, good: &Tls) -> Tls {
    Tls {
        authority: good.authority.clone(),
        ..stranger.clone()
    }
}

#[test]
fn a_member_that_only_connects_needs_no_address_in_its_certificate() {
    let folder = folder("operator");
    let authority = Authority::new(&folder, "authority");
    let operator = authority.sign("operator", "10.0.0.1");
    operator.check(None).unwrap();
    operator.check(Some(HERE)).unwrap_err();
}

/// A member that listens at an endpoint.
fn at(endpoint: &str) -> Probed {
    let (_, address) = endpoint.split_once('/').unwrap();
    Probed {
        name: "first".to_string(),
        address: address.to_string(),
    }
}

#[test]
fn a_probe_tells_why_two_members_cannot_meet() {
    let folder = folder("probe");
    let authority = Authority::new(&folder, "authority");
    let other = Authority::new(&folder, "other");
    let place = endpoint();
    let second = authority.sign("second", "127.0.0.1");
    assert_eq!(second.probe(&at(&place)).unwrap(), Answer::Absent);

    let first = authority.sign("first", "127.0.0.1");
    let (_first, _inbox) = join(0, Some(&place), None, first);
    assert_eq!(second.probe(&at(&place)).unwrap(), Answer::Accepted);

    let reason = |tls: &Tls| match tls.probe(&at(&place)).unwrap() {
        Answer::Refused(reason) => reason,
        answer => panic!("{answer:?}"),
    };
    // It trusts the fleet's authority, but has its own certificate from another one.
    let stranger = other.sign("stranger", "127.0.0.1");
    let unsigned = stranger_of(&stranger, &second);
    let refused = reason(&unsigned);
    assert!(refused.starts_with("first at 127.0.0.1:"), "{refused}");
    assert!(
        refused.contains(" refuses this member's certificate "),
        "{refused}"
    );
    // It trusts another authority.
    let refused = reason(&stranger);
    let text = " has a certificate that is not signed by the authority ";
    assert!(refused.contains(text), "{refused}");

    // A member with a certificate for another address.
    let place = endpoint();
    let elsewhere = authority.sign("elsewhere", "10.0.0.1");
    let (_elsewhere, _inbox) = join(1, Some(&place), None, elsewhere);
    let Answer::Refused(refused) = second.probe(&at(&place)).unwrap() else {
        panic!("its address is another");
    };
    let text = "it needs the subject alternative name 127.0.0.1";
    assert!(refused.contains(text), "{refused}");
}

#[test]
fn a_probe_finds_a_member_without_tls() {
    let folder = folder("plain");
    let authority = Authority::new(&folder, "authority");
    let member = authority.sign("member", "127.0.0.1");
    let place = endpoint().replace("tls/", "tcp/");
    let options = ZenohOptions {
        listen: vec![place.clone()],
        ..ZenohOptions::default()
    };
    let _plain = Zenoh::open("fleet", 0, &options, |_| true).unwrap();
    let Answer::Refused(refused) = member.probe(&at(&place)).unwrap() else {
        panic!("it has no TLS");
    };
    assert!(refused.contains(" does not answer by TLS; "), "{refused}");
}
