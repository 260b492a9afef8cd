//! The page in a browser, and its server on this machine: `starl run --open`, `starl view` and `starl web`.
//!
//! The server does not change a run: the page sends the same requests to the same
//! [`Service`](starl_catalog::service::Service) as with the simulator in WebAssembly.

mod engine;
mod growing;
mod guard;
mod page;
mod start;
mod trace;

use crate::args::{PageArguments, RunArguments, ViewArguments};
use crate::failure::Failure;
use crate::{console, fleet, replay, run, target, threads};
use axum::extract::{State, WebSocketUpgrade};
use axum::http::header::CONTENT_TYPE;
use axum::http::{HeaderMap, StatusCode};
use axum::response::{IntoResponse, Response};
use axum::routing::get;
use axum::{Router, middleware};
use engine::Origin;
use growing::Growing;
use guard::{Guard, guarded};
use page::Page;
use starl_catalog::disk::reason;
use starl_catalog::programs::Registry;
use starl_catalog::session::Session;
use std::io;
use std::net::Ipv4Addr;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::Arc;
use std::thread;
use tokio::net::TcpListener;
use tokio::runtime;
use tokio::sync::Notify;

/// The content of the page.
enum Content {
    /// Programs and scenarios that its user writes in it.
    Page,
    /// A run, which the page drives.
    Run {
        /// The answer to `/start.json`.
        start: serde_json::Value,
        origin: Box<Origin>,
    },
    /// A recorded run.
    Trace { path: PathBuf, name: String },
    /// A fleet that runs.
    Fleet { name: String, trace: Growing },
}

/// Serves the page alone.
pub fn serve_page(arguments: &PageArguments) -> Result<bool, Failure> {
    let page = Page::of(arguments.folder.as_deref())?;
    serve(page, Content::Page, arguments)
}

/// Serves a run of the arguments' target, from its start.
pub fn serve_run(arguments: &RunArguments, registry: &Registry) -> Result<bool, Failure> {
    let page = Page::of(arguments.page.folder.as_deref())?;
    let selection = target::read(arguments, registry)?;
    let application = &selection.application;
    let mut run = run::start(application)?;
    let threads = threads::count(arguments.threads, application.scenario().fleet.len());
    run.set_parallel(threads > 1);
    let session = Session::of_run(run, application, selection.origin.global_names());
    let content = Content::Run {
        start: start::of_run(&session, application),
        origin: Box::new(Origin::new(
            session,
            registry.clone(),
            threads::pool(threads)?,
        )),
    };
    serve(page, content, &arguments.page)
}

/// Serves what a trace has recorded, or what happens in a fleet.
pub fn serve_view(arguments: &ViewArguments, registry: &Registry) -> Result<bool, Failure> {
    let page = Page::of(arguments.page.folder.as_deref())?;
    let path = &arguments.what;
    if path
        .extension()
        .is_some_and(|extension| extension == "toml")
    {
        return serve(page, follow(path, registry)?, &arguments.page);
    }
    // The page reads the rest of it; a file that is not a trace is reported immediately.
    replay::open(path)?;
    if !path.is_file() {
        return Err(Failure::file(
            path,
            "is not a regular file; copy the trace to one",
        ));
    }
    let name = path.file_name().unwrap_or_default();
    let content = Content::Trace {
        path: path.clone(),
        name: name.display().to_string(),
    };
    serve(page, content, &arguments.page)
}

/// Follows the fleet of a file in a thread of its own.
fn follow(path: &Path, registry: &Registry) -> Result<Content, Failure> {
    let follower = fleet::follow(path, registry)?;
    let name = follower.name().to_string();
    let (trace, mut writer) = Growing::create()?;
    thread::spawn(move || {
        if let Err(failure) = follower.run(|bytes| writer.append(bytes)) {
            console::error(&failure.0);
        }
    });
    Ok(Content::Fleet { name, trace })
}

/// Serves the page and what it shows until someone presses Ctrl-C.
fn serve(page: Page, content: Content, arguments: &PageArguments) -> Result<bool, Failure> {
    let failed = |error: io::Error| Failure(format!("the server has failed: {}", reason(&error)));
    let runtime = runtime::Builder::new_current_thread()
        .enable_all()
        .build()
        .map_err(failed)?;
    let stop = Arc::new(Notify::new());
    let stopped = stop.clone();
    run::on_interrupt(move || stopped.notify_one());
    let served = runtime.block_on(async {
        let listener = listen(arguments.port).await?;
        let port = listener.local_addr().map_err(failed)?.port();
        let guard = Guard::new(port)?;
        let address = guard.address();
        console::print(&format!("open {address} in a browser\n"))?;
        if !arguments.no_browser {
            open_browser(&address);
        }
        let router = router(page, content, guard);
        tokio::select! {
            served = axum::serve(listener, router) => served.map_err(failed),
            () = stop.notified() => Ok(()),
        }
    });
    // Requests under way are not waited for.
    runtime.shutdown_background();
    served.map(|()| true)
}

/// Listens where only this machine can connect.
async fn listen(port: Option<u16>) -> Result<TcpListener, Failure> {
    let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, port.unwrap_or(0))).await;
    listener.map_err(|error| {
        let why = match error.kind() {
            io::ErrorKind::AddrInUse => "another program listens there".to_string(),
            _ => reason(&error),
        };
        match port {
            Some(port) => Failure(format!(
                "--port {port}: {why}; name another port, or none to have one chosen"
            )),
            None => Failure(format!("the server cannot listen on 127.0.0.1: {why}")),
        }
    })
}

fn router(page: Page, content: Content, guard: Guard) -> Router {
    Router::new()
        .route("/start.json", get(tell_start))
        .route("/trace", get(give_trace))
        .route("/engine", get(connect))
        .with_state(Arc::new(content))
        .fallback_service(get(page::answer).with_state(Arc::new(page)))
        .layer(middleware::from_fn_with_state(Arc::new(guard), guarded))
}

async fn tell_start(State(content): State<Arc<Content>>) -> Response {
    match &*content {
        Content::Page => json(&start::of_page()),
        Content::Run { start, .. } => json(start),
        Content::Fleet { name, .. } => json(&start::of_fleet(name)),
        Content::Trace { path, name } => match path.metadata() {
            Ok(file) => json(&start::of_trace(name, file.len())),
            Err(error) => {
                let text = format!("{name}: cannot be read: {}\n", reason(&error));
                (StatusCode::INTERNAL_SERVER_ERROR, text).into_response()
            }
        },
    }
}

fn json(value: &serde_json::Value) -> Response {
    ([(CONTENT_TYPE, "application/json")], value.to_string()).into_response()
}

async fn give_trace(State(content): State<Arc<Content>>, headers: HeaderMap) -> Response {
    match &*content {
        Content::Trace { path, .. } => trace::answer(path, &headers).await,
        Content::Fleet { trace, .. } => trace.answer().await,
        _ => (StatusCode::NOT_FOUND, "this server has no trace\n").into_response(),
    }
}

async fn connect(State(content): State<Arc<Content>>, upgrade: WebSocketUpgrade) -> Response {
    match &*content {
        Content::Run { origin, .. } => engine::connect(origin, upgrade),
        _ => {
            let text = "this server has no simulations; the page brings its own\n";
            (StatusCode::NOT_FOUND, text).into_response()
        }
    }
}

/// Has the system open an address. Where that does not work, the person has the address.
fn open_browser(address: &str) {
    let opener = match cfg!(target_os = "macos") {
        true => "open",
        false => "xdg-open",
    };
    let mut command = Command::new(opener);
    command
        .arg(address)
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::null());
    if let Ok(mut opening) = command.spawn() {
        thread::spawn(move || opening.wait());
    }
}

#[cfg(test)]
mod tests;
