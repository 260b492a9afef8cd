//! The server of the page answers only pages that it has served itself, in the browser that opened the address
//! with the token.

use crate::support::*;
use crate::web_support::*;
use std::net::TcpStream;

const PATHS: [&str; 5] = ["/", "/assets/index.js", "/start.json", "/trace", "/engine"];

fn refused(response: &Response, why: &str) {
    assert_eq!(response.status, 403, "{}", response.text());
    assert!(response.text().contains(why), "{}", response.text());
    assert!(response.text().contains("open the address"));
}

#[test]
fn the_printed_address_sets_a_cookie_that_opens_the_page() {
    let folder = folder("web_address");
    let server = Server::start(&folder, &["web"]);
    let host = server.host();
    let address = format!("/?token={}", server.token);
    let let_in = server.send("GET", &address, &[("host", &host)]);
    assert_eq!((let_in.status, &*let_in.headers["location"]), (303, "/"));
    let cookie = let_in.headers["set-cookie"].split("; ").collect::<Vec<_>>();
    let own = server.cookie();
    assert_eq!(cookie, [&own, "Path=/", "HttpOnly", "SameSite=Strict"]);
    let page = server.send("GET", "/", &[("host", &host), ("cookie", cookie[0])]);
    assert_eq!(page.status, 200);
    assert_eq!(page.headers["content-type"], "text/html; charset=utf-8");
    assert!(page.text().starts_with("<!doctype html>"));
    // A browser has cookies of other servers on this machine too.
    let several = format!("starl-1=00; a=b; {own}");
    let script = server.send(
        "GET",
        "/assets/index.js",
        &[("host", &host), ("cookie", &several)],
    );
    assert_eq!((script.status, script.text()), (200, SCRIPT.to_string()));
}

#[test]
fn without_the_cookie_nothing_is_answered() {
    let folder = folder("web_cookie");
    let server = Server::start(&folder, &["web"]);
    let (host, port) = (server.host(), server.port);
    let wrong = [
        format!("starl-{port}={}", "0".repeat(64)),
        format!("starl-{port}="),
        format!("starl={}", server.token),
    ];
    for path in PATHS {
        refused(&server.send("GET", path, &[("host", &host)]), "token");
        for cookie in &wrong {
            let headers = [("host", &*host), ("cookie", cookie)];
            refused(&server.send("GET", path, &headers), "token");
        }
    }
}

#[test]
fn a_wrong_token_is_refused() {
    let folder = folder("web_token");
    let server = Server::start(&folder, &["web"]);
    let (host, token) = (server.host(), &server.token);
    assert_eq!(token.len(), 64);
    for wrong in ["", "0", &token[1..], &"0".repeat(64), &format!("{token}0")] {
        let response = server.send("GET", &format!("/?token={wrong}"), &[("host", &host)]);
        refused(&response, "token");
        assert!(!response.headers.contains_key("set-cookie"));
    }
    let other = Server::start(&folder, &["web"]);
    assert_ne!(&other.token, token);
}

#[test]
fn another_host_or_origin_is_refused() {
    let folder = folder("web_origin");
    let server = Server::start(&folder, &["web"]);
    let (own, cookie, port) = (server.host(), server.cookie(), server.port);
    let hosts = ["example.org", "127.0.0.1", &format!("example.org:{port}")];
    let origins = [
        "http://example.org".to_string(),
        "null".to_string(),
        format!("https://{own}"),
        format!("http://localhost:{port}"),
        format!("http://127.0.0.1:{}", port ^ 1),
    ];
    for path in PATHS {
        for host in hosts {
            let headers = [("host", host), ("cookie", &cookie)];
            refused(&server.send("GET", path, &headers), "another host");
        }
        for origin in &origins {
            let headers = [("host", &*own), ("cookie", &cookie), ("origin", origin)];
            refused(&server.send("GET", path, &headers), "another origin");
        }
    }
    let own_origin = server.origin();
    assert_eq!(server.get("/", &[("origin", &own_origin)]).status, 200);
    let token = format!("/?token={}", server.token);
    refused(
        &server.send("GET", &token, &[("host", "example.org")]),
        "address",
    );
}

#[test]
fn only_this_machine_can_connect() {
    let folder = folder("web_loopback");
    let server = Server::start(&folder, &["web"]);
    assert!(TcpStream::connect(("127.0.0.1", server.port)).is_ok());
    // Would be reached by a server that listens on all addresses.
    assert!(TcpStream::connect(("127.0.0.2", server.port)).is_err());
}

#[test]
fn every_answer_has_the_headers_that_protect_the_page() {
    let folder = folder("web_headers");
    let server = Server::start(&folder, &["web"]);
    let host = server.host();
    let forbidden = server.send("GET", "/", &[("host", &host)]);
    let missing = server.get("/none", &[]);
    assert_eq!((forbidden.status, missing.status), (403, 404));
    for response in [
        forbidden,
        missing,
        server.get("/", &[]),
        server.get("/start.json", &[]),
    ] {
        let policy = &response.headers["content-security-policy"];
        assert_eq!(
            policy.split("; ").collect::<Vec<_>>(),
            [
                "default-src 'none'",
                "script-src 'self' 'wasm-unsafe-eval'",
                "worker-src 'self'",
                "style-src 'self'",
                "img-src 'self' data: blob:",
                "font-src 'self'",
                "connect-src 'self'",
                "manifest-src 'self'",
                "base-uri 'none'",
                "form-action 'none'",
                "frame-ancestors 'none'",
            ]
        );
        assert_eq!(response.headers["x-content-type-options"], "nosniff");
        assert_eq!(response.headers["referrer-policy"], "no-referrer");
        assert_eq!(
            response.headers["cross-origin-resource-policy"],
            "same-origin"
        );
        assert_eq!(response.headers["cache-control"], "no-store");
    }
}

#[test]
fn a_path_that_leaves_the_page_is_not_found() {
    let folder = folder("web_paths");
    let server = Server::start(&folder, &["web"]);
    file(&folder, "secret.txt", "secret");
    file(&folder, "page/.hidden", "of the page");
    #[cfg(unix)]
    std::os::unix::fs::symlink("../secret.txt", folder.join("page/link.txt")).expect("a link");
    let whole = folder.join("secret.txt");
    let paths = [
        "/../secret.txt".to_string(),
        "/assets/../../secret.txt".to_string(),
        "/%2e%2e/secret.txt".to_string(),
        "/..%2fsecret.txt".to_string(),
        "/..\\secret.txt".to_string(),
        "/link.txt".to_string(),
        format!("/{}", whole.display()),
        format!("//{}", whole.display()),
        "/assets".to_string(),
        "/assets/".to_string(),
    ];
    for path in paths {
        let response = server.get(&path, &[]);
        assert_eq!(response.status, 404, "{path}: {}", response.text());
    }
    assert_eq!(server.get("/.hidden", &[]).text(), "of the page");
}

/// Browsers ask for the scripts of service workers with this header.
#[test]
fn no_service_worker_is_installed_that_would_outlive_the_server() {
    let folder = folder("web_service_worker");
    let server = Server::start(&folder, &["web"]);
    file(&folder, "page/sw.js", "self.onfetch = undefined");
    assert_eq!(server.get("/sw.js", &[]).status, 200);
    let asked = server.get("/sw.js", &[("service-worker", "script")]);
    assert_eq!(asked.status, 404);
}

#[test]
fn only_get_and_head_are_allowed() {
    let folder = folder("web_methods");
    let server = Server::start(&folder, &["web"]);
    let (host, cookie) = (server.host(), server.cookie());
    let headers = [("host", &*host), ("cookie", &*cookie)];
    for method in ["POST", "PUT", "DELETE", "OPTIONS"] {
        for path in ["/", "/start.json", "/trace"] {
            assert_eq!(
                server.send(method, path, &headers).status,
                405,
                "{method} {path}"
            );
        }
    }
    let head = server.send("HEAD", "/assets/index.js", &headers);
    assert_eq!((head.status, head.body.len()), (200, 0));
    assert_eq!(head.headers["content-length"], SCRIPT.len().to_string());
}
