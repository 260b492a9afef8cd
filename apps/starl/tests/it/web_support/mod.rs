//! A server that was started as a user would start it, and what browsers and others send to it.

use crate::support::{command, file};
use std::collections::BTreeMap;
use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::path::Path;
use std::process::{Child, ChildStdout, Stdio};
use tungstenite::client::IntoClientRequest;
use tungstenite::{Message, WebSocket, client};

/// A script of the page of these tests.
pub const SCRIPT: &str = "console.log('a page')";

/// A page as small as can be, in a folder `page`.
pub fn page(folder: &Path) {
    std::fs::create_dir_all(folder.join("page/assets")).expect("the folder can be written to");
    file(
        folder,
        "page/index.html",
        "<!doctype html><title>StarL</title>",
    );
    file(folder, "page/assets/index.js", SCRIPT);
}

/// A server, stopped when the test is over.
pub struct Server {
    pub process: Child,
    pub output: BufReader<ChildStdout>,
    pub port: u16,
    pub token: String,
}

/// An answer to a request.
pub struct Response {
    pub status: u16,
    pub headers: BTreeMap<String, String>,
    pub body: Vec<u8>,
}

impl Response {
    pub fn text(&self) -> String {
        String::from_utf8(self.body.clone()).expect("the answer is text")
    }

    pub fn json(&self) -> serde_json::Value {
        serde_json::from_slice(&self.body)
            .unwrap_or_else(|error| panic!("{error}: {}", self.text()))
    }
}

impl Server {
    /// Starts the command in a folder, which also contains the page.
    pub fn start(folder: &Path, arguments: &[&str]) -> Server {
        page(folder);
        let all = [arguments, &["--no-browser", "--page", "page"]].concat();
        Server::of(&mut command(folder, &all))
    }

    /// Starts a command that serves.
    pub fn of(command: &mut std::process::Command) -> Server {
        let process = command.stdout(Stdio::piped()).spawn();
        let mut process = process.expect("the command was built");
        let mut output = BufReader::new(process.stdout.take().expect("it is piped"));
        let mut line = String::new();
        output.read_line(&mut line).expect("it is text");
        let address = line.strip_prefix("open http://127.0.0.1:");
        let address = address.and_then(|rest| rest.strip_suffix(" in a browser\n"));
        let (port, token) = address
            .and_then(|address| address.split_once("/?token="))
            .unwrap_or_else(|| panic!("no address: {line:?}"));
        Server {
            port: port.parse().expect("a port is a number"),
            token: token.to_string(),
            process,
            output,
        }
    }

    pub fn host(&self) -> String {
        format!("127.0.0.1:{}", self.port)
    }

    pub fn origin(&self) -> String {
        format!("http://{}", self.host())
    }

    pub fn cookie(&self) -> String {
        format!("starl-{}={}", self.port, self.token)
    }

    /// The answer to a page of this server.
    pub fn get(&self, path: &str, headers: &[(&str, &str)]) -> Response {
        let (host, cookie) = (self.host(), self.cookie());
        let own = [("host", &*host), ("cookie", &*cookie)];
        self.send("GET", path, &[&own, headers].concat())
    }

    /// The answer to a request with these headers and no others.
    pub fn send(&self, method: &str, path: &str, headers: &[(&str, &str)]) -> Response {
        let mut stream = TcpStream::connect(self.host()).expect("the server listens");
        let headers: String = headers
            .iter()
            .map(|(name, value)| format!("{name}: {value}\r\n"))
            .collect();
        let request = format!("{method} {path} HTTP/1.1\r\nconnection: close\r\n{headers}\r\n");
        stream.write_all(request.as_bytes()).expect("it is read");
        let mut answer = Vec::new();
        stream.read_to_end(&mut answer).expect("it is answered");
        let split = answer.windows(4).position(|four| four == b"\r\n\r\n");
        let split = split.expect("there is a head");
        let head = String::from_utf8(answer[..split].to_vec()).expect("heads are text");
        let mut lines = head.split("\r\n");
        let status = lines.next().and_then(|line| line.split(' ').nth(1));
        let headers = lines.filter_map(|line| line.split_once(": "));
        Response {
            status: status.and_then(|word| word.parse().ok()).expect("a status"),
            headers: headers
                .map(|(name, value)| (name.to_lowercase(), value.to_string()))
                .collect(),
            body: answer[split + 4..].to_vec(),
        }
    }

    /// Connects to the simulations, as a page of this server does.
    pub fn engine(&self) -> Engine {
        let (origin, cookie) = (self.origin(), self.cookie());
        let engine = self.engine_with(&[("origin", &origin), ("cookie", &cookie)]);
        engine.unwrap_or_else(|status| panic!("the connection is refused: {status}"))
    }

    /// Connects with these headers; the status where that is refused.
    pub fn engine_with(&self, headers: &[(&'static str, &str)]) -> Result<Engine, u16> {
        let address = format!("ws://{}/engine", self.host());
        let mut request = address.into_client_request().expect("it is an address");
        for &(name, value) in headers {
            let value = value.parse().expect("it is a header's value");
            request.headers_mut().insert(name, value);
        }
        let stream = TcpStream::connect(self.host()).expect("the server listens");
        match client::client(request, stream) {
            Ok((socket, _)) => Ok(Engine { socket, id: 0 }),
            Err(tungstenite::HandshakeError::Failure(tungstenite::Error::Http(response))) => {
                Err(response.status().as_u16())
            }
            Err(error) => panic!("{error}"),
        }
    }
}

impl Drop for Server {
    fn drop(&mut self) {
        let _ = self.process.kill();
        let _ = self.process.wait();
    }
}

/// The simulations of one page.
pub struct Engine {
    pub socket: WebSocket<TcpStream>,
    id: u32,
}

impl Engine {
    /// The answer to a request.
    pub fn ask(&mut self, request: &serde_json::Value) -> serde_json::Value {
        let answer = self.message("request", request);
        let answer: serde_json::Value =
            serde_json::from_str(answer.to_text().expect("it is text")).expect("it is JSON");
        assert_eq!(answer["id"], self.id);
        answer
    }

    /// The result of a request, which must be carried out.
    pub fn ok(&mut self, request: &serde_json::Value) -> serde_json::Value {
        let mut answer = self.ask(request);
        assert!(answer.get("error").is_none(), "{request}: {answer}");
        answer["ok"].take()
    }

    /// The numbers of a binary answer.
    pub fn numbers(&mut self, kind: &str, simulation: u32) -> Vec<f64> {
        let message = self.message(kind, &simulation.into());
        assert!(message.is_binary(), "{message}");
        let bytes = message.into_data();
        assert_eq!(bytes[..4], self.id.to_le_bytes());
        assert_eq!(bytes[4..8], [0; 4]);
        let numbers = bytes[8..].chunks_exact(8);
        assert!(numbers.remainder().is_empty());
        numbers
            .map(|eight| f64::from_le_bytes(eight.try_into().expect("eight bytes")))
            .collect()
    }

    /// The answer to a message.
    fn message(&mut self, kind: &str, content: &serde_json::Value) -> Message {
        self.id += 1;
        let text = serde_json::json!({ "id": self.id, kind: content }).to_string();
        self.socket.send(text.into()).expect("it is read");
        self.socket.read().expect("it is answered")
    }
}
