//! Fleets whose robots identify themselves by certificates: over Zenoh with TLS.

use crate::fleet::{PATIENCE, RACE, Up, ports};
use crate::support::*;
use rcgen::{BasicConstraints, CertificateParams, IsCa, Issuer, KeyPair};
use std::io::{BufRead, BufReader};
use std::path::Path;
use std::sync::mpsc;
use std::time::Instant;

/// Makes an authority, and certificates that it signs for these members of this machine.
fn certify(folder: &Path, authority: &str, members: &[&str]) {
    let mut params = CertificateParams::new(Vec::new()).expect("there are no names");
    params.is_ca = IsCa::Ca(BasicConstraints::Unconstrained);
    let key = KeyPair::generate().expect("keys can be made");
    let certificate = params.self_signed(&key).expect("it can be signed");
    file(folder, &format!("{authority}.pem"), &certificate.pem());
    let issuer = Issuer::new(params, key);
    for member in members {
        let here = vec!["127.0.0.1".to_string()];
        let params = CertificateParams::new(here).expect("it is an address");
        let key = KeyPair::generate().expect("keys can be made");
        let certificate = params.signed_by(&key, &issuer).expect("it can be signed");
        file(folder, &format!("{member}.pem"), &certificate.pem());
        file(folder, &format!("{member}.key"), &key.serialize_pem());
    }
}

/// A fleet file with certificates, whose robots have these ports.
fn fleet_file(folder: &Path, name: &str, first: u16, authority: &str) {
    let text = format!(
        "scenario = \"race.toml\"\nname = \"race\"\n[link]\nkind = \"zenoh\"\nfirst_port = {first}\n\
         tls = {{ authority = \"{authority}\", certificate = \"NAME.pem\", key = \"NAME.key\" }}\n"
    );
    file(folder, name, &text);
}

/// Waits until the fleet has said all of these, then stops it.
fn hears(mut up: Up, wanted: &[&str]) {
    let messages = up.0.stderr.take().expect("it is a pipe");
    let (sender, lines) = mpsc::channel();
    std::thread::spawn(move || {
        let mut lines = BufReader::new(messages).lines().map_while(Result::ok);
        lines.try_for_each(|line| sender.send(line).ok())
    });
    let begun = Instant::now();
    let mut heard = String::new();
    while !wanted.iter().all(|text| heard.contains(text)) {
        let patience = PATIENCE.saturating_sub(begun.elapsed());
        let line = lines.recv_timeout(patience);
        heard += &line.unwrap_or_else(|_| panic!("{wanted:?} are not in:\n{heard}"));
        heard.push('\n');
    }
}

#[test]
fn a_fleet_with_certificates_of_one_authority_finishes() {
    let folder = folder("fleet_certificates");
    file(&folder, "race.toml", RACE);
    certify(&folder, "ca", &["robot0", "robot1", "operator"]);
    fleet_file(&folder, "fleet.toml", ports(2), "ca.pem");
    let output = Up::start(&folder, &[]).end();
    let (text, messages) = (stdout(&output), stderr(&output));
    assert_eq!(status(&output), 0, "{text}{messages}");
    assert!(!messages.contains("link.tls"), "{messages}");
    assert!(text.contains("broadcast.integrity   holds"), "{text}");
}

#[test]
fn robots_of_two_authorities_name_each_other() {
    let folder = folder("fleet_authorities");
    file(&folder, "race.toml", RACE);
    certify(&folder, "robot0-ca", &["robot0"]);
    certify(&folder, "robot1-ca", &["robot1"]);
    certify(&folder, "operator-ca", &["operator"]);
    fleet_file(&folder, "fleet.toml", ports(2), "NAME-ca.pem");
    let up = Up::start(&folder, &["--keep"]);
    let unsigned =
        |one: &str, other: &str| format!("{one}: fleet.toml: link.tls: {other} at 127.0.0.1:");
    let first = unsigned("robot0", "robot1");
    let second = unsigned("robot1", "robot0");
    let why = "has a certificate that is not signed by the authority robot0-ca.pem";
    hears(up, &[&first, &second, why]);
}

#[test]
fn a_robot_without_certificates_is_named() {
    let folder = folder("fleet_plain");
    file(&folder, "race.toml", RACE);
    certify(&folder, "ca", &["robot0", "robot1", "operator"]);
    let first = ports(2);
    fleet_file(&folder, "fleet.toml", first, "ca.pem");
    let text = format!(
        "scenario = \"race.toml\"\nname = \"race\"\n[link]\nkind = \"zenoh\"\nfirst_port = {first}\nkey = \"fleet.key\"\n"
    );
    file(&folder, "plain.toml", &text);
    assert_eq!(status(&starl(&folder, &["fleet", "key", "fleet.toml"])), 0);
    let start = |robot: &str, fleet: &str| {
        let arguments = ["robot", "--id", robot, "--fleet", fleet, "--folder", "."];
        let mut command = command(&folder, &arguments);
        command.stdout(std::process::Stdio::null());
        command.stderr(std::process::Stdio::piped());
        Up(command.spawn().expect("the command was built"))
    };
    let plain = start("robot1", "plain.toml");
    let secure = start("robot0", "fleet.toml");
    let address = format!("robot1 at 127.0.0.1:{} does not answer by TLS", first + 1);
    hears(
        secure,
        &[&address, "give `link.tls` to all members or to none"],
    );
    drop(plain);
}
