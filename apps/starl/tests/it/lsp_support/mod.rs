//! An editor that talks to `starl lsp`, run as a child process.

use serde_json::{Value, json};
use std::io::{BufRead, BufReader, Read, Write};
use std::path::Path;
use std::process::{Child, ChildStdin, ChildStdout, Command, ExitStatus, Stdio};

/// An editor with a server of its own.
pub struct Editor {
    server: Child,
    input: Option<ChildStdin>,
    output: BufReader<ChildStdout>,
    asked: u64,
    /// Messages of the server besides answers that have not been read.
    told: Vec<Value>,
}

impl Editor {
    /// A server that has received no message.
    pub fn new() -> Editor {
        let mut server = Command::new(env!("CARGO_BIN_EXE_starl"))
            .args(["lsp", "--stdio"])
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .expect("the command was built");
        let input = server.stdin.take();
        let output = server.stdout.take().expect("its output is piped");
        Editor {
            server,
            input,
            output: BufReader::new(output),
            asked: 0,
            told: Vec::new(),
        }
    }

    /// A server that is ready, for an editor with snippets and built-in texts.
    pub fn ready() -> Editor {
        let mut editor = Editor::new();
        let params = json!({
            "processId": null,
            "rootUri": null,
            "capabilities": {"textDocument": {"completion": {"completionItem": {"snippetSupport": true}}}},
            "initializationOptions": {"libraryDocuments": true},
        });
        editor.ask("initialize", params).expect("it can be started");
        editor.tell("initialized", json!({}));
        editor
    }

    /// Sends bytes.
    pub fn send_bytes(&mut self, bytes: &[u8]) {
        let input = self.input.as_mut().expect("the input is open");
        input.write_all(bytes).expect("the server reads");
        input.flush().expect("the server reads");
    }

    /// Sends a message.
    pub fn send(&mut self, message: &Value) {
        let text = message.to_string();
        let header = format!("Content-Length: {}\r\n\r\n", text.len());
        self.send_bytes(header.as_bytes());
        self.send_bytes(text.as_bytes());
    }

    /// Sends the server a notification.
    pub fn tell(&mut self, method: &str, params: Value) {
        self.send(&json!({"jsonrpc": "2.0", "method": method, "params": params}));
    }

    /// Asks the server: the result, or the error.
    pub fn ask(&mut self, method: &str, params: Value) -> Result<Value, Value> {
        self.asked += 1;
        let id = self.asked;
        self.send(&json!({"jsonrpc": "2.0", "id": id, "method": method, "params": params}));
        loop {
            let message = self.receive().expect("the server answers");
            if message["id"] != id || message.get("method").is_some() {
                self.told.push(message);
                continue;
            }
            return match message.get("error") {
                Some(error) => Err(error.clone()),
                None => Ok(message["result"].clone()),
            };
        }
    }

    /// The next message; none at the end.
    pub fn receive(&mut self) -> Option<Value> {
        let mut length = 0;
        loop {
            let mut line = String::new();
            if self.output.read_line(&mut line).expect("the server writes") == 0 {
                return None;
            }
            match line.trim().strip_prefix("Content-Length: ") {
                Some(number) => length = number.parse().expect("a length is a number"),
                None if line.trim().is_empty() => break,
                None => panic!("a header with {line:?}"),
            }
        }
        let mut bytes = vec![0; length];
        self.output
            .read_exact(&mut bytes)
            .expect("the server writes");
        Some(serde_json::from_slice(&bytes).expect("a message is JSON"))
    }

    /// Opens a text.
    pub fn open(&mut self, uri: &str, text: &str) {
        let document = json!({"uri": uri, "languageId": "starl", "version": 1, "text": text});
        self.tell("textDocument/didOpen", json!({"textDocument": document}));
    }

    /// Replaces a part of a text: from line and column to line and column.
    pub fn change(&mut self, uri: &str, version: u32, part: [u32; 4], text: &str) {
        let [line, column, end_line, end_column] = part;
        let range = json!({
            "start": {"line": line, "character": column},
            "end": {"line": end_line, "character": end_column},
        });
        let params = json!({
            "textDocument": {"uri": uri, "version": version},
            "contentChanges": [{"range": range, "text": text}],
        });
        self.tell("textDocument/didChange", params);
    }

    /// The next problems of a text that the server reports, in a version if that matters.
    pub fn problems(&mut self, uri: &str, version: u32) -> Vec<Value> {
        loop {
            let message = match self.told.is_empty() {
                true => self.receive().expect("the server tells"),
                false => self.told.remove(0),
            };
            let params = &message["params"];
            if message["method"] == "textDocument/publishDiagnostics"
                && params["uri"] == uri
                && params["version"] == version
            {
                return params["diagnostics"].as_array().expect("a list").clone();
            }
        }
    }

    /// Asks about a place of a text.
    pub fn at(&mut self, method: &str, uri: &str, place: (u32, u32)) -> Result<Value, Value> {
        self.ask(method, position(uri, place))
    }

    /// Ends the input and waits for the server.
    pub fn wait(mut self) -> ExitStatus {
        self.input = None;
        self.server.wait().expect("the server ends")
    }
}

impl Drop for Editor {
    fn drop(&mut self) {
        // The server ends with its input; a test that failed before leaves none behind.
        self.input = None;
        let _ = self.server.wait();
    }
}

/// A place of a text, as a request names it.
pub fn position(uri: &str, (line, column): (u32, u32)) -> Value {
    json!({
        "textDocument": {"uri": uri},
        "position": {"line": line, "character": column},
    })
}

/// How a file is named.
pub fn uri(path: &Path) -> String {
    format!("file://{}", path.display())
}

/// The place of `$0` in a text, and the text without it.
pub fn cursor(text: &str) -> (String, (u32, u32)) {
    let at = text.find("$0").expect("the text has a cursor");
    let before = &text[..at];
    let line = before.matches('\n').count() as u32;
    let start = before.rfind('\n').map_or(0, |end| end + 1);
    let column = before[start..].encode_utf16().count() as u32;
    (text.replacen("$0", "", 1), (line, column))
}

/// Applies changes of a text, as the server gives them.
pub fn applied(text: &str, edits: &Value) -> String {
    let mut changed = text.to_string();
    let edits = edits.as_array().expect("a list of changes");
    for edit in edits.iter().rev() {
        let start = offset(text, &edit["range"]["start"]);
        let end = offset(text, &edit["range"]["end"]);
        changed.replace_range(start..end, edit["newText"].as_str().expect("a text"));
    }
    changed
}

/// The byte of a place.
pub fn offset(text: &str, position: &Value) -> usize {
    let line = position["line"].as_u64().expect("a number") as usize;
    let column = position["character"].as_u64().expect("a number") as usize;
    let start: usize = text.split_inclusive('\n').take(line).map(str::len).sum();
    let mut units = 0;
    let rest = text[start..].char_indices();
    let mut before = rest.take_while(|(_, letter)| {
        let is_before = units < column;
        units += letter.len_utf16();
        is_before
    });
    let last = before.by_ref().last();
    start + last.map_or(0, |(at, letter)| at + letter.len_utf8())
}
