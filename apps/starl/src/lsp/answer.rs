//! The requests of an editor, each with its answer.

use super::capabilities::Client;
use super::documents::{Checked, Documents};
use super::rename::Refused;
use super::transport::Fault;
use super::{assist, diagnostics, navigate, rename, show};
use lsp_types::request as ask;
use lsp_types::request::Request;
use lsp_types::{
    CodeActionOrCommand, CompletionResponse, DocumentSymbolResponse, GotoDefinitionResponse,
    SemanticTokensRangeResult, SemanticTokensResult, TextDocumentIdentifier, Uri,
};
use serde::de::DeserializeOwned;
use serde_json::Value;
use starl_editor::BUILT_IN;
use starl_lang::check::{Libraries, PRELUDE, StandardLibraries};
use std::rc::Rc;

/// The request for a text that is part of the command.
const LIBRARY: &str = "starl/library";

/// The parts of an answer.
pub struct Answers<'a> {
    pub documents: &'a Documents,
    pub client: Client,
}

type Answer = Result<Value, (Fault, String)>;

impl Answers<'_> {
    /// The answer to a request.
    pub fn to(&self, method: &str, params: Value) -> Answer {
        match method {
            ask::HoverRequest::METHOD => self.of::<ask::HoverRequest>(params, |checked, params| {
                let at = params.text_document_position_params.position;
                Ok(assist::hover(checked, at))
            }),
            ask::Completion::METHOD => self.of::<ask::Completion>(params, |checked, params| {
                let at = params.text_document_position.position;
                let snippets = self.client.snippets;
                let list = assist::completions(self.documents, checked, at, snippets);
                Ok(Some(CompletionResponse::List(list)))
            }),
            ask::SignatureHelpRequest::METHOD => {
                self.of::<ask::SignatureHelpRequest>(params, |checked, params| {
                    let at = params.text_document_position_params.position;
                    Ok(assist::signature(checked, at))
                })
            }
            ask::GotoDefinition::METHOD => {
                self.of::<ask::GotoDefinition>(params, |checked, params| {
                    let at = params.text_document_position_params.position;
                    let place = navigate::definition(checked, at, self.client.built_in_texts);
                    Ok(place.map(GotoDefinitionResponse::Scalar))
                })
            }
            ask::References::METHOD => self.of::<ask::References>(params, |checked, params| {
                let at = params.text_document_position.position;
                let with = params.context.include_declaration;
                Ok(navigate::references(self.documents, checked, at, with))
            }),
            ask::DocumentHighlightRequest::METHOD => {
                self.of::<ask::DocumentHighlightRequest>(params, |checked, params| {
                    let at = params.text_document_position_params.position;
                    Ok(navigate::highlights(checked, at))
                })
            }
            ask::PrepareRenameRequest::METHOD => {
                self.of::<ask::PrepareRenameRequest>(params, |checked, at| {
                    let found = rename::prepare(checked, at.position);
                    found.map(Some).map_err(failed)
                })
            }
            ask::Rename::METHOD => self.of::<ask::Rename>(params, |checked, params| {
                let at = params.text_document_position.position;
                let edit = rename::rename(self.documents, checked, at, &params.new_name);
                edit.map(Some).map_err(failed)
            }),
            _ => self.to_whole(method, params),
        }
    }

    /// The answer to a request about a whole text.
    fn to_whole(&self, method: &str, params: Value) -> Answer {
        match method {
            ask::DocumentSymbolRequest::METHOD => {
                self.of::<ask::DocumentSymbolRequest>(params, |checked, _| {
                    let outline = show::outline(checked);
                    Ok(Some(DocumentSymbolResponse::Nested(outline)))
                })
            }
            ask::FoldingRangeRequest::METHOD => self
                .of::<ask::FoldingRangeRequest>(params, |checked, _| {
                    Ok(Some(show::folds(checked)))
                }),
            ask::Formatting::METHOD => {
                self.of::<ask::Formatting>(params, |checked, _| Ok(Some(show::layout(checked))))
            }
            ask::CodeActionRequest::METHOD => {
                self.of::<ask::CodeActionRequest>(params, |checked, params| {
                    let fixes = diagnostics::fixes(checked, params.range);
                    let fixes = fixes.into_iter().map(CodeActionOrCommand::CodeAction);
                    Ok(Some(fixes.collect()))
                })
            }
            ask::SemanticTokensFullRequest::METHOD => {
                self.of::<ask::SemanticTokensFullRequest>(params, |checked, _| {
                    let tokens = show::tokens(checked, None);
                    Ok(Some(SemanticTokensResult::Tokens(tokens)))
                })
            }
            ask::SemanticTokensRangeRequest::METHOD => {
                self.of::<ask::SemanticTokensRangeRequest>(params, |checked, params| {
                    let tokens = show::tokens(checked, Some(params.range));
                    Ok(Some(SemanticTokensRangeResult::Tokens(tokens)))
                })
            }
            LIBRARY => {
                let params: TextDocumentIdentifier = read(params)?;
                Ok(built_in_text(&params.uri).map_or(Value::Null, Value::String))
            }
            _ => Err((
                Fault::MethodNotFound,
                format!("there is no request `{method}`"),
            )),
        }
    }

    /// The answer to a request about an open text, whose parameters and result have types.
    fn of<R: Request>(
        &self,
        params: Value,
        answer: impl FnOnce(&Rc<Checked>, R::Params) -> Result<R::Result, (Fault, String)>,
    ) -> Answer {
        let document = params["textDocument"].clone();
        let params: R::Params = read(params)?;
        let document: TextDocumentIdentifier = read(document)?;
        let checked = self.documents.checked(&document.uri).ok_or_else(|| {
            let name = document.uri.as_str();
            (Fault::InvalidParams, format!("{name} is not open"))
        })?;
        let result = answer(&checked, params)?;
        serde_json::to_value(result).map_err(|error| (Fault::Internal, error.to_string()))
    }
}

fn failed(refused: Refused) -> (Fault, String) {
    (Fault::Failed, refused.to_string())
}

/// Parameters of the right shape.
pub fn read<T: DeserializeOwned>(params: Value) -> Result<T, (Fault, String)> {
    serde_json::from_value(params).map_err(|error| (Fault::InvalidParams, error.to_string()))
}

/// A text that is part of the command.
fn built_in_text(uri: &Uri) -> Option<String> {
    let name = uri.as_str().strip_prefix(BUILT_IN)?;
    match name.strip_suffix(".starl")? {
        "prelude" => Some(PRELUDE.to_string()),
        name => StandardLibraries.source(name),
    }
}
