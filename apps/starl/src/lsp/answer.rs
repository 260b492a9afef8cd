//! The requests of an editor, each with its answer.

use super::capabilities::Client;
use super::documents::{Checked, Documents};
use super::transport::Fault;
use super::{assist, diagnostics, navigate, rename, show};
use lsp_types::request as ask;
use lsp_types::request::Request;
use lsp_types::{
    CodeActionOrCommand, CompletionResponse, DocumentSymbolResponse, GotoDefinitionResponse,
    SemanticTokens, SemanticTokensRangeResult, SemanticTokensResult, TextDocumentIdentifier, Uri,
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
            ask::HoverRequest::METHOD => self.of::<ask::HoverRequest>(params, |this, params| {
                let at = params.text_document_position_params;
                let checked = this.checked(&at.text_document)?;
                Ok(assist::hover(&checked, at.position))
            }),
            ask::Completion::METHOD => self.of::<ask::Completion>(params, |this, params| {
                let at = params.text_document_position;
                let checked = this.checked(&at.text_document)?;
                let snippets = this.client.snippets;
                let list = assist::completions(this.documents, &checked, at.position, snippets);
                Ok(Some(CompletionResponse::List(list)))
            }),
            ask::SignatureHelpRequest::METHOD => {
                self.of::<ask::SignatureHelpRequest>(params, |this, params| {
                    let at = params.text_document_position_params;
                    let checked = this.checked(&at.text_document)?;
                    Ok(assist::signature(&checked, at.position))
                })
            }
            ask::GotoDefinition::METHOD => {
                self.of::<ask::GotoDefinition>(params, |this, params| {
                    let at = params.text_document_position_params;
                    let checked = this.checked(&at.text_document)?;
                    let place =
                        navigate::definition(&checked, at.position, this.client.built_in_texts);
                    Ok(place.map(GotoDefinitionResponse::Scalar))
                })
            }
            ask::References::METHOD => self.of::<ask::References>(params, |this, params| {
                let at = params.text_document_position;
                let checked = this.checked(&at.text_document)?;
                let with = params.context.include_declaration;
                Ok(navigate::references(
                    this.documents,
                    &checked,
                    at.position,
                    with,
                ))
            }),
            ask::DocumentHighlightRequest::METHOD => {
                self.of::<ask::DocumentHighlightRequest>(params, |this, params| {
                    let at = params.text_document_position_params;
                    let checked = this.checked(&at.text_document)?;
                    Ok(navigate::highlights(&checked, at.position))
                })
            }
            ask::PrepareRenameRequest::METHOD => {
                self.of::<ask::PrepareRenameRequest>(params, |this, at| {
                    let checked = this.checked(&at.text_document)?;
                    rename::prepare(&checked, at.position)
                        .map(Some)
                        .map_err(|refused| (Fault::Failed, refused.to_string()))
                })
            }
            ask::Rename::METHOD => self.of::<ask::Rename>(params, |this, params| {
                let at = params.text_document_position;
                let checked = this.checked(&at.text_document)?;
                rename::rename(this.documents, &checked, at.position, &params.new_name)
                    .map(Some)
                    .map_err(|refused| (Fault::Failed, refused.to_string()))
            }),
            _ => self.to_whole(method, params),
        }
    }

    /// The answer to a request about a whole text.
    fn to_whole(&self, method: &str, params: Value) -> Answer {
        match method {
            ask::DocumentSymbolRequest::METHOD => {
                self.of::<ask::DocumentSymbolRequest>(params, |this, params| {
                    let checked = this.checked(&params.text_document)?;
                    let outline = show::outline(&checked);
                    Ok(Some(DocumentSymbolResponse::Nested(outline)))
                })
            }
            ask::FoldingRangeRequest::METHOD => {
                self.of::<ask::FoldingRangeRequest>(params, |this, params| {
                    let checked = this.checked(&params.text_document)?;
                    Ok(Some(show::folds(&checked)))
                })
            }
            ask::Formatting::METHOD => self.of::<ask::Formatting>(params, |this, params| {
                let checked = this.checked(&params.text_document)?;
                Ok(Some(show::layout(&checked)))
            }),
            ask::CodeActionRequest::METHOD => {
                self.of::<ask::CodeActionRequest>(params, |this, params| {
                    let checked = this.checked(&params.text_document)?;
                    let fixes = diagnostics::fixes(&checked, params.range);
                    let fixes = fixes.into_iter().map(CodeActionOrCommand::CodeAction);
                    Ok(Some(fixes.collect()))
                })
            }
            ask::SemanticTokensFullRequest::METHOD => {
                self.of::<ask::SemanticTokensFullRequest>(params, |this, params| {
                    let checked = this.checked(&params.text_document)?;
                    let data = show::tokens(&checked, None);
                    let tokens = SemanticTokens {
                        result_id: None,
                        data,
                    };
                    Ok(Some(SemanticTokensResult::Tokens(tokens)))
                })
            }
            ask::SemanticTokensRangeRequest::METHOD => {
                self.of::<ask::SemanticTokensRangeRequest>(params, |this, params| {
                    let checked = this.checked(&params.text_document)?;
                    let data = show::tokens(&checked, Some(params.range));
                    let tokens = SemanticTokens {
                        result_id: None,
                        data,
                    };
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

    /// The answer to a request whose parameters and result have types.
    fn of<R: Request>(
        &self,
        params: Value,
        answer: impl FnOnce(&Self, R::Params) -> Result<R::Result, (Fault, String)>,
    ) -> Answer {
        let params: R::Params = read(params)?;
        let result = answer(self, params)?;
        serde_json::to_value(result).map_err(|error| (Fault::Internal, error.to_string()))
    }

    fn checked(&self, document: &TextDocumentIdentifier) -> Result<Rc<Checked>, (Fault, String)> {
        self.documents.checked(&document.uri).ok_or_else(|| {
            let name = document.uri.as_str();
            (Fault::InvalidParams, format!("{name} is not open"))
        })
    }
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
