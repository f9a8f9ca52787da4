//! A small server for one folder of files, for this machine only: to try the page, and for the judge to drive.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::thread::{self, JoinHandle};

use anyhow::{Context, Result, anyhow};
use tiny_http::{Header, Method, Request, Response};

use super::files::{ENCODINGS, with_ending};

/// Kinds of content by ending. A browser compiles WebAssembly while it arrives only if it is called so.
const KINDS: [(&str, &str); 8] = [
    ("css", "text/css; charset=utf-8"),
    ("html", "text/html; charset=utf-8"),
    ("js", "text/javascript; charset=utf-8"),
    ("json", "application/json"),
    ("png", "image/png"),
    ("svg", "image/svg+xml"),
    ("wasm", "application/wasm"),
    ("webmanifest", "application/manifest+json"),
];

/// A server that runs until it is dropped.
pub(crate) struct Server {
    http: Arc<tiny_http::Server>,
    port: u16,
    thread: Option<JoinHandle<()>>,
}

impl Server {
    /// Hands out the files of `folder`; port 0 takes any that is free.
    pub(crate) fn start(folder: &Path, port: u16) -> Result<Self> {
        let http = tiny_http::Server::http(("127.0.0.1", port))
            .map_err(|error| anyhow!("cannot serve on port {port}: {error}; choose another by --port"))?;
        let port = http.server_addr().to_ip().context("the server has no port")?.port();
        let (http, folder) = (Arc::new(http), folder.to_owned());
        let thread = thread::spawn({
            let http = Arc::clone(&http);
            move || {
                for request in http.incoming_requests() {
                    answer(request, &folder);
                }
            }
        });
        Ok(Self { http, port, thread: Some(thread) })
    }

    /// Where the page is.
    pub(crate) fn url(&self) -> String {
        format!("http://localhost:{}/", self.port)
    }

    /// Serves until this program is interrupted.
    pub(crate) fn wait(mut self) {
        if let Some(thread) = self.thread.take() {
            // It ends by a panic only, which has been printed then.
            let _ = thread.join();
        }
    }
}

impl Drop for Server {
    fn drop(&mut self) {
        self.http.unblock();
        if let Some(thread) = self.thread.take() {
            let _ = thread.join();
        }
    }
}

fn answer(request: Request, folder: &Path) {
    let accepted = header(&request, "Accept-Encoding").unwrap_or_default();
    let found = match request.method() {
        Method::Get | Method::Head => find(folder, request.url(), &accepted),
        _ => None,
    };
    let sent = match found.and_then(|found| Some((fs::read(&found.path).ok()?, found))) {
        Some((bytes, found)) => {
            let mut response = Response::from_data(bytes)
                .with_header(field("Content-Type", found.kind))
                // The next build is asked for, and the usual browser keeps what has not changed.
                .with_header(field("Cache-Control", "no-cache"))
                .with_header(field("Vary", "Accept-Encoding"))
                .with_chunked_threshold(usize::MAX);
            if let Some(encoding) = found.encoding {
                response.add_header(field("Content-Encoding", encoding));
            }
            request.respond(response)
        }
        None => request.respond(Response::from_string("There is no such file.\n").with_status_code(404)),
    };
    // A browser that went away needs no answer.
    let _ = sent;
}

/// A file that answers a request.
#[derive(Debug, PartialEq)]
struct Found {
    path: PathBuf,
    kind: &'static str,
    encoding: Option<&'static str>,
}

/// The file for a path of the web, in the best form that the browser takes. The page has no folders, so no path leads out of it.
fn find(folder: &Path, url: &str, accepted: &str) -> Option<Found> {
    let name = url.split(['?', '#']).next()?.strip_prefix('/')?;
    let name = if name.is_empty() { "index.html" } else { name };
    let plain = |c: char| c.is_ascii_alphanumeric() || matches!(c, '.' | '-' | '_');
    if !name.chars().all(plain) || name.starts_with('.') {
        return None;
    }
    let path = folder.join(name);
    let ending = path.extension()?.to_str()?;
    let kind = KINDS.iter().find(|(known, _)| *known == ending)?.1;
    for (ending, encoding) in ENCODINGS {
        let takes = accepted.split(',').any(|one| one.split(';').next().is_some_and(|one| one.trim() == encoding));
        let compressed = with_ending(&path, ending);
        if takes && compressed.is_file() {
            return Some(Found { path: compressed, kind, encoding: Some(encoding) });
        }
    }
    path.is_file().then_some(Found { path, kind, encoding: None })
}

fn header(request: &Request, name: &'static str) -> Option<String> {
    request.headers().iter().find(|header| header.field.equiv(name)).map(|header| header.value.as_str().to_owned())
}

fn field(name: &str, value: &str) -> Header {
    Header::from_bytes(name, value).expect("our own fields are plain text")
}

#[cfg(test)]
mod tests {
    use std::io::{Read, Write};
    use std::net::TcpStream;

    use super::*;

    /// A folder with one page, one program and its gzipped form.
    fn folder(name: &str) -> PathBuf {
        let folder = std::env::temp_dir().join(format!("fairpath-serve-{}-{name}", std::process::id()));
        fs::create_dir_all(&folder).unwrap();
        fs::write(folder.join("index.html"), "<p>here</p>").unwrap();
        fs::write(folder.join("a.wasm"), "plain").unwrap();
        fs::write(folder.join("a.wasm.gz"), "zip").unwrap();
        folder
    }

    #[test]
    fn a_compressed_form_is_given_to_those_who_take_it_only() {
        let folder = folder("forms");
        let encoding = |accepted| find(&folder, "/a.wasm?v=1", accepted).unwrap().encoding;
        assert_eq!(encoding("gzip, deflate, br;q=0.9"), Some("gzip"));
        assert_eq!(encoding("deflate"), None);
        assert_eq!(find(&folder, "/a.wasm", "").unwrap().kind, "application/wasm");
        fs::remove_dir_all(folder).unwrap();
    }

    #[test]
    fn nothing_outside_the_folder_is_found() {
        let folder = folder("outside");
        fs::write(folder.with_extension("html"), "secret").unwrap();
        let name = folder.with_extension("html").file_name().unwrap().to_string_lossy().into_owned();
        for url in
            [format!("/../{name}"), format!("/..%2f{name}"), format!("//{name}"), "/etc/passwd".into(), "/.html".into()]
        {
            assert_eq!(find(&folder, &url, ""), None, "{url}");
        }
        fs::remove_file(folder.with_extension("html")).unwrap();
        fs::remove_dir_all(folder).unwrap();
    }

    #[test]
    fn the_page_comes_over_the_wire_and_what_is_missing_is_said_to_be() {
        let folder = folder("wire");
        let server = Server::start(&folder, 0).unwrap();
        let ask = |path: &str| {
            let mut stream = TcpStream::connect(("127.0.0.1", server.port)).unwrap();
            write!(stream, "GET {path} HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n").unwrap();
            let mut text = String::new();
            stream.read_to_string(&mut text).unwrap();
            text
        };
        let page = ask("/");
        assert!(
            page.starts_with("HTTP/1.1 200") && page.contains("text/html") && page.ends_with("<p>here</p>"),
            "{page}"
        );
        assert!(ask("/none.html").starts_with("HTTP/1.1 404"));
        drop(server);
        fs::remove_dir_all(folder).unwrap();
    }
}
