//! The session with one editor: its messages and the answers.

use super::answer::{Answers, read};
use super::capabilities::{Client, capabilities};
use super::convert::place;
use super::diagnostics::diagnostics;
use super::documents::Documents;
use super::transport::{Fault, Incoming, Output};
use lsp_types::notification as told;
use lsp_types::notification::Notification;
use lsp_types::{
    InitializeParams, InitializeResult, PublishDiagnosticsParams, ServerInfo,
    TextDocumentContentChangeEvent,
};
use serde_json::{Value, json};
use starl_editor::replaced;
use std::io;
use std::io::Write;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// How far an editor has come.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Phase {
    New,
    Ready,
    ShutDown,
}

/// The next step after a message.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Step {
    /// Take the next one.
    Continue,
    /// End.
    Exit {
        /// Whether the editor announced it.
        after_shutdown: bool,
    },
}

/// One editor.
pub struct Session {
    output: Output,
    phase: Phase,
    client: Client,
    documents: Documents,
}

impl Session {
    /// An editor that has said nothing yet.
    pub fn new(output: Box<dyn Write>) -> Session {
        Session {
            output: Output(output),
            phase: Phase::New,
            client: Client::default(),
            documents: Documents::default(),
        }
    }

    /// Handles a message.
    pub fn take(&mut self, incoming: Incoming) -> io::Result<Step> {
        let mut message = match incoming {
            Incoming::Message(message) => message,
            Incoming::Malformed(problem) => {
                self.output
                    .answer(&Value::Null, Err((Fault::Parse, problem.to_string())))?;
                return Ok(Step::Continue);
            }
        };
        let params = message
            .get_mut("params")
            .map(Value::take)
            .unwrap_or_default();
        let id = message.get("id");
        let method = message.get("method").and_then(Value::as_str);
        match (id, method) {
            (Some(id), Some(method)) => {
                let answer = self.answer(method, params);
                self.output.answer(id, answer)?;
            }
            (None, Some("exit")) => {
                let after_shutdown = self.phase == Phase::ShutDown;
                return Ok(Step::Exit { after_shutdown });
            }
            (None, Some(method)) => self.note(method, params)?,
            // An answer of the editor.
            (Some(_), None) if message.get("result").or(message.get("error")).is_some() => {}
            (id, None) => {
                let id = id.cloned().unwrap_or_default();
                let problem = "this is neither a request nor a notification".to_string();
                self.output
                    .answer(&id, Err((Fault::InvalidRequest, problem)))?;
            }
        }
        Ok(Step::Continue)
    }

    fn answer(&mut self, method: &str, params: Value) -> Result<Value, (Fault, String)> {
        match (self.phase, method) {
            (Phase::New, "initialize") => {
                let params: InitializeParams = read(params)?;
                self.client = Client::new(&params);
                let result = InitializeResult {
                    capabilities: capabilities(),
                    server_info: Some(ServerInfo {
                        name: "starl".to_string(),
                        version: Some(env!("CARGO_PKG_VERSION").to_string()),
                    }),
                };
                self.phase = Phase::Ready;
                serde_json::to_value(result).map_err(|error| (Fault::Internal, error.to_string()))
            }
            (Phase::New, _) => {
                let problem = "`initialize` must come first".to_string();
                Err((Fault::NotInitialized, problem))
            }
            (Phase::Ready, "shutdown") => {
                self.phase = Phase::ShutDown;
                Ok(Value::Null)
            }
            (Phase::Ready, "initialize") | (Phase::ShutDown, _) => {
                let problem = format!("`{method}` cannot be asked for now");
                Err((Fault::InvalidRequest, problem))
            }
            (Phase::Ready, _) => {
                let answers = Answers {
                    documents: &self.documents,
                    client: self.client,
                };
                // A fault of ours costs the editor one answer, not the server.
                let answer = catch_unwind(AssertUnwindSafe(|| answers.to(method, params)));
                answer.unwrap_or_else(|_| {
                    let problem = format!("`{method}` failed because of an internal error");
                    Err((Fault::Internal, problem))
                })
            }
        }
    }

    /// Takes in a notification. One that cannot be read is ignored: the protocol has no answer to
    /// it.
    fn note(&mut self, method: &str, params: Value) -> io::Result<()> {
        if self.phase != Phase::Ready {
            return Ok(());
        }
        match method {
            told::Initialized::METHOD => return self.watch(),
            told::DidOpenTextDocument::METHOD => {
                if let Some(params) = noted::<told::DidOpenTextDocument>(params) {
                    let opened = params.text_document;
                    self.documents.open(opened.uri, opened.version, opened.text);
                }
            }
            told::DidChangeTextDocument::METHOD => {
                if let Some(params) = noted::<told::DidChangeTextDocument>(params) {
                    let document = params.text_document;
                    let changes = params.content_changes;
                    let changed = |text: &str| changed(text, changes);
                    self.documents
                        .change(&document.uri, document.version, changed);
                }
            }
            told::DidCloseTextDocument::METHOD => {
                if let Some(params) = noted::<told::DidCloseTextDocument>(params) {
                    let uri = params.text_document.uri;
                    self.documents.close(&uri);
                    let nothing = PublishDiagnosticsParams::new(uri, Vec::new(), None);
                    return self.tell(&nothing);
                }
            }
            told::DidSaveTextDocument::METHOD | told::DidChangeWatchedFiles::METHOD => {
                self.documents.forget();
            }
            _ => {}
        }
        Ok(())
    }

    /// Asks the editor to report files that change.
    fn watch(&mut self) -> io::Result<()> {
        if !self.client.watches_files {
            return Ok(());
        }
        let params = json!({"registrations": [{
            "id": "starl-files",
            "method": told::DidChangeWatchedFiles::METHOD,
            "registerOptions": {"watchers": [{"globPattern": "**/*.{starl,onnx}"}]},
        }]});
        self.output
            .request("starl-files", "client/registerCapability", &params)
    }

    /// Publishes the problems of texts that have not been published yet.
    pub fn publish(&mut self) -> io::Result<()> {
        if self.phase != Phase::Ready {
            return Ok(());
        }
        let documents = &mut self.documents;
        let untold = catch_unwind(AssertUnwindSafe(|| documents.untold()));
        for (checked, version) in untold.unwrap_or_default() {
            let problems = diagnostics(&checked);
            let uri = checked.uri.clone();
            self.tell(&PublishDiagnosticsParams::new(uri, problems, Some(version)))?;
        }
        Ok(())
    }

    fn tell(&mut self, params: &PublishDiagnosticsParams) -> io::Result<()> {
        let params = serde_json::to_value(params).unwrap_or_default();
        self.output
            .notify(told::PublishDiagnostics::METHOD, &params)
    }
}

fn noted<N: Notification>(params: Value) -> Option<N::Params> {
    read(params).ok()
}

/// The text after changes, one after the other.
fn changed(text: &str, changes: Vec<TextDocumentContentChangeEvent>) -> String {
    let mut text = text.to_string();
    for change in changes {
        text = match change.range {
            Some(range) => replaced(&text, place(range.start), place(range.end), &change.text),
            None => change.text,
        };
    }
    text
}
