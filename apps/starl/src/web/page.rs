//! The files of the page: those that were built into the command, or those in a folder.

use crate::console;
use crate::failure::Failure;
use axum::extract::{Request, State};
use axum::http::StatusCode;
use axum::http::header::CONTENT_TYPE;
use axum::response::{IntoResponse, Response};
use std::borrow::Cow;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Files by path.
type Files = &'static [(&'static str, &'static [u8])];

/// The files of `playground/dist` when the command was built, listed by `build.rs`.
static BUILT_IN: Files = include!(concat!(env!("OUT_DIR"), "/page.rs"));

/// The first file that a browser asks for.
const INDEX: &str = "index.html";

/// The source of the page's files.
#[derive(Debug)]
pub enum Page {
    /// The command itself.
    BuiltIn(Files),
    /// A folder, with all links in its path resolved.
    Folder(PathBuf),
}

impl Page {
    /// The page in this folder, or else the one in the command.
    pub fn of(folder: Option<&Path>) -> Result<Page, Failure> {
        match folder {
            Some(folder) => Page::in_folder(folder),
            None => Page::built_in(BUILT_IN),
        }
    }

    fn in_folder(folder: &Path) -> Result<Page, Failure> {
        match folder.canonicalize() {
            Ok(root) if root.join(INDEX).is_file() => Ok(Page::Folder(root)),
            _ => Err(Failure(format!(
                "--page {}: there is no {INDEX} here; name the folder that the page was built into",
                folder.display()
            ))),
        }
    }

    fn built_in(files: Files) -> Result<Page, Failure> {
        if files.iter().any(|(path, _)| *path == INDEX) {
            return Ok(Page::BuiltIn(files));
        }
        let command = console::command();
        Err(Failure(format!(
            "this {command} was built without the page; run `make page` in StarL's repository, then build {command} \
             again; or name a folder that holds the built page with --page"
        )))
    }

    /// The content of a file; none if there is no such file in the page.
    fn file(&self, path: &str) -> Option<Cow<'static, [u8]>> {
        match self {
            Page::BuiltIn(files) => {
                let (_, content) = files.iter().find(|(own, _)| *own == path)?;
                Some(Cow::Borrowed(*content))
            }
            Page::Folder(root) => {
                // The path may hold `..` and links; the file that it leads to must be in the folder.
                let found = root.join(path).canonicalize().ok()?;
                let content = found.starts_with(root).then(|| fs::read(found))?;
                content.ok().map(Cow::Owned)
            }
        }
    }
}

/// Answers with a file of the page.
pub async fn answer(State(page): State<Arc<Page>>, request: Request) -> Response {
    let path = match request.uri().path() {
        "/" => INDEX,
        path => path.trim_start_matches('/'),
    };
    // A service worker outlives the server: at this port it would answer in place of the next one, with an old page,
    // and the next token would never reach its server.
    let is_for_service_worker = request.headers().contains_key("service-worker");
    let found = page.file(path).filter(|_| !is_for_service_worker);
    match found {
        Some(content) => ([(CONTENT_TYPE, content_type(path))], content).into_response(),
        None => (StatusCode::NOT_FOUND, "the page has no such file\n").into_response(),
    }
}

/// By the end of a file's name; a header forbids browsers to guess.
fn content_type(path: &str) -> &'static str {
    match path.rsplit('.').next().unwrap_or_default() {
        "html" => "text/html; charset=utf-8",
        "js" | "mjs" => "text/javascript; charset=utf-8",
        "css" => "text/css; charset=utf-8",
        "wasm" => "application/wasm",
        "json" | "map" => "application/json",
        "webmanifest" => "application/manifest+json",
        "svg" => "image/svg+xml",
        "png" => "image/png",
        "webp" => "image/webp",
        "ico" => "image/x-icon",
        "woff2" => "font/woff2",
        "txt" => "text/plain; charset=utf-8",
        _ => "application/octet-stream",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_command_without_the_page_says_how_to_build_it() {
        let refused = Page::built_in(&[]).unwrap_err();
        assert!(refused.0.contains("make page"));
    }

    #[test]
    fn a_page_that_is_built_in_is_served() {
        let page = Page::built_in(&[("index.html", b"<p>"), ("assets/a.js", b"1")]).unwrap();
        assert_eq!(page.file("index.html").as_deref(), Some(&b"<p>"[..]));
        assert_eq!(page.file("assets/a.js").as_deref(), Some(&b"1"[..]));
        assert_eq!(page.file("../Cargo.toml"), None);
    }

    #[test]
    fn a_folder_without_a_page_is_refused() {
        let refused = Page::of(Some(Path::new("src"))).unwrap_err();
        assert!(refused.0.contains("--page src: there is no index.html"));
    }
}
