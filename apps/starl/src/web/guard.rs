//! Decides which requests are answered: only those of pages from this server, in the browser of the user who started
//! it.
//!
//! Other programs on the machine can reach the server, and pages from anywhere can make a browser send requests to
//! it. So a request needs the cookie that the printed address sets, must name this server as its host (else a name
//! that leads to 127.0.0.1 would do, "DNS rebinding"), and must not come from a page of another origin.

use crate::failure::Failure;
use axum::extract::{Request, State};
use axum::http::header::{
    CACHE_CONTROL, CONTENT_SECURITY_POLICY, COOKIE, HOST, HeaderMap, HeaderName, HeaderValue,
    LOCATION, ORIGIN, REFERRER_POLICY, SEC_WEBSOCKET_KEY, SET_COOKIE, X_CONTENT_TYPE_OPTIONS,
};
use axum::http::{StatusCode, Uri};
use axum::middleware::Next;
use axum::response::{IntoResponse, Response};
use std::sync::Arc;

/// The page may load files from this server, and nothing else.
const POLICY: &str = "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; worker-src 'self'; style-src 'self'; \
    img-src 'self' data: blob:; font-src 'self'; connect-src 'self'; manifest-src 'self'; base-uri 'none'; \
    form-action 'none'; frame-ancestors 'none'";

/// Every answer has these headers.
const HEADERS: [(HeaderName, &str); 5] = [
    (CONTENT_SECURITY_POLICY, POLICY),
    (X_CONTENT_TYPE_OPTIONS, "nosniff"),
    (REFERRER_POLICY, "no-referrer"),
    (
        HeaderName::from_static("cross-origin-resource-policy"),
        "same-origin",
    ),
    // Another server may be at this address tomorrow.
    (CACHE_CONTROL, "no-store"),
];

/// Checks requests.
pub struct Guard {
    /// The server's address and port, as browsers name its host.
    host: String,
    /// The cookie's name and value. Browsers do not tell ports apart when they send cookies, so the port is in the
    /// name.
    cookie: String,
    token: String,
}

impl Guard {
    /// A guard of the server at this port of 127.0.0.1, with a token that cannot be guessed.
    pub fn new(port: u16) -> Result<Guard, Failure> {
        let mut random = [0; 32];
        getrandom::fill(&mut random)
            .map_err(|error| Failure(format!("no random token can be made: {error}")))?;
        let token: String = random.iter().map(|byte| format!("{byte:02x}")).collect();
        Ok(Guard {
            host: format!("127.0.0.1:{port}"),
            cookie: format!("starl-{port}={token}"),
            token,
        })
    }

    /// The address that lets a browser in.
    pub fn address(&self) -> String {
        format!("http://{}/?token={}", self.host, self.token)
    }

    /// The answer to a request that is refused, or that shows the token; none if the request may pass.
    fn stop(&self, uri: &Uri, headers: &HeaderMap) -> Option<Response> {
        if headers.get(HOST).is_none_or(|host| *host != self.host) {
            return Some(refuse("the request names another host"));
        }
        let is_own = |origin: &HeaderValue| *origin == format!("http://{}", self.host);
        // Browsers always say where a WebSocket comes from.
        let is_foreign = match headers.get(ORIGIN) {
            Some(origin) => !is_own(origin),
            None => headers.contains_key(SEC_WEBSOCKET_KEY),
        };
        if is_foreign {
            return Some(refuse("the request comes from a page of another origin"));
        }
        let token = uri.query().and_then(|query| query.strip_prefix("token="));
        if let ("/", Some(token)) = (uri.path(), token) {
            return Some(match same(token, &self.token) {
                true => self.let_in(),
                false => refuse("the token in this address is wrong"),
            });
        }
        let cookies = headers.get_all(COOKIE).iter();
        let mut cookies = cookies
            .filter_map(|header| header.to_str().ok())
            .flat_map(|header| header.split(';'));
        match cookies.any(|cookie| same(cookie.trim(), &self.cookie)) {
            true => None,
            false => Some(refuse("this browser has not shown the token")),
        }
    }

    /// Leaves the token in a cookie, and takes it out of the address.
    fn let_in(&self) -> Response {
        let cookie = format!("{}; Path=/; HttpOnly; SameSite=Strict", self.cookie);
        let headers = [(SET_COOKIE, cookie), (LOCATION, "/".to_string())];
        (StatusCode::SEE_OTHER, headers).into_response()
    }
}

/// Lets requests pass that may, and gives every answer the headers that protect the page.
pub async fn guarded(State(guard): State<Arc<Guard>>, request: Request, next: Next) -> Response {
    let mut response = match guard.stop(request.uri(), request.headers()) {
        Some(response) => response,
        None => next.run(request).await,
    };
    for (name, value) in HEADERS {
        let value = HeaderValue::from_static(value);
        response.headers_mut().insert(name, value);
    }
    response
}

fn refuse(why: &str) -> Response {
    let text = format!("403: {why}; open the address that starl has printed in the terminal\n");
    (StatusCode::FORBIDDEN, text).into_response()
}

/// Whether two texts are the same, in a time that does not tell where they differ.
fn same(a: &str, b: &str) -> bool {
    let differences = a.bytes().zip(b.bytes()).map(|(a, b)| a ^ b);
    a.len() == b.len() && differences.fold(0, |all, one| all | one) == 0
}
