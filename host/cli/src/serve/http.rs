//! The part of HTTP that local servers need: the head of a request, and a response after which the connection
//! is closed.

use std::io::{self, Read, Write};
use std::time::{Duration, Instant};

/// Size limit of a request's head.
const HEAD: usize = 16 * 1024;
/// Time limit for a request.
const PATIENCE: Duration = Duration::from_secs(5);
/// Restricts the page to what this program serves.
const POLICY: &str = "default-src 'self'; connect-src 'self'; img-src 'self' data: blob:; \
                      style-src 'self' 'unsafe-inline'; script-src 'self'; \
                      frame-ancestors 'none'; base-uri 'none'";

/// A refused request.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Refusal {
    /// `400 Bad Request`
    pub status: &'static str,
    /// Reason, as a sentence.
    pub why: &'static str,
}

const fn refusal(status: &'static str, why: &'static str) -> Refusal {
    Refusal { status, why }
}

/// Head of a request, as far as it is used.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Request {
    /// Path without the query.
    pub path: String,
    /// `Sec-WebSocket-Key` of a WebSocket request.
    pub key: Option<String>,
    /// Names of `Sec-WebSocket-Protocol`.
    pub protocols: Vec<String>,
    /// Bytes behind the head.
    pub rest: Vec<u8>,
}

/// Sites whose pages are served. Programs other than browsers send no `Origin`.
#[derive(Debug, Clone, Copy)]
pub enum Sites<'a> {
    /// Only this server's own pages, under a name of this machine.
    Own,
    /// Only this server's own pages, under whatever name other machines have for this one: who may read them is decided
    /// by a secret in their address.
    Any,
    /// These sites (`https://app.example.org`), any local server, and local files.
    Named(&'a [String]),
}

impl Sites<'_> {
    fn are_of(self, host: &str, origin: &str) -> bool {
        match self {
            Sites::Own | Sites::Any => origin.strip_prefix("http://") == Some(host),
            Sites::Named(names) => {
                let local = origin.strip_prefix("http://").is_some_and(is_this_machine);
                local || origin == "file://" || names.iter().any(|name| name == origin)
            }
        }
    }
}

/// Reads a request; none if the client is gone or too slow.
pub fn read(stream: &mut impl Read, sites: Sites<'_>) -> Option<Result<Request, Refusal>> {
    let (mut bytes, mut buffer, begun) = (Vec::new(), [0; 2048], Instant::now());
    loop {
        let count = stream.read(&mut buffer).ok()?;
        if count == 0 || begun.elapsed() > PATIENCE {
            return None;
        }
        bytes.extend_from_slice(&buffer[..count]);
        match parse(&bytes, sites) {
            Ok(None) if bytes.len() > HEAD => {
                let why = "the head of the request is too long";
                return Some(Err(refusal("431 Request Header Fields Too Large", why)));
            }
            Ok(None) => {}
            Ok(Some(request)) => return Some(Ok(request)),
            Err(refusal) => return Some(Err(refusal)),
        }
    }
}

/// Parses the head of a request; none if it is incomplete.
pub fn parse(bytes: &[u8], sites: Sites<'_>) -> Result<Option<Request>, Refusal> {
    let mut headers = [httparse::EMPTY_HEADER; 64];
    let mut head = httparse::Request::new(&mut headers);
    let bad = refusal("400 Bad Request", "malformed HTTP request");
    let length = match head.parse(bytes).map_err(|_| bad)? {
        httparse::Status::Complete(length) => length,
        httparse::Status::Partial => return Ok(None),
    };
    let value = |name: &str| {
        let mut all = head.headers.iter().filter(|header| header.name.eq_ignore_ascii_case(name));
        let one = all.next().and_then(|header| std::str::from_utf8(header.value).ok());
        // Duplicate headers are ambiguous.
        one.filter(|_| all.next().is_none())
    };
    let all = |name: &'static str| {
        let all = head.headers.iter().filter(move |header| header.name.eq_ignore_ascii_case(name));
        all.map(|header| String::from_utf8_lossy(header.value).into_owned())
    };
    let has_origin = all("origin").next().is_some();
    check_names(value("host").unwrap_or_default(), has_origin, value("origin"), sites)?;
    if head.method != Some("GET") {
        return Err(refusal("405 Method Not Allowed", "only GET is answered"));
    }
    let path = head.path.and_then(|path| path.split('?').next()).unwrap_or("/").to_string();
    let upgrade = value("upgrade").is_some_and(|to| to.eq_ignore_ascii_case("websocket"));
    let key = upgrade.then(|| value("sec-websocket-key").map(String::from)).flatten();
    if upgrade && (key.is_none() || value("sec-websocket-version") != Some("13")) {
        return Err(refusal("400 Bad Request", "this is not a request for a WebSocket of version 13"));
    }
    let offered: Vec<String> = all("sec-websocket-protocol").collect();
    let protocols =
        offered.iter().flat_map(|names| names.split(',')).map(|name| name.trim().into()).collect();
    Ok(Some(Request { path, key, protocols, rest: bytes.get(length..).unwrap_or_default().to_vec() }))
}

/// Refuses pages of other sites, which may reach this port under their own name (DNS rebinding) or under
/// ours. The port may differ if it is forwarded.
fn check_names(host: &str, has_origin: bool, origin: Option<&str>, sites: Sites<'_>) -> Result<(), Refusal> {
    if !matches!(sites, Sites::Any) && !is_this_machine(host) {
        return Err(refusal("403 Forbidden", "this server only answers to 127.0.0.1 and localhost"));
    }
    // Duplicates count as invalid.
    if has_origin && !origin.is_some_and(|origin| sites.are_of(host, origin)) {
        return Err(refusal("403 Forbidden", "pages of other sites are not answered"));
    }
    Ok(())
}

fn is_this_machine(host: &str) -> bool {
    let (name, port) = match host.strip_prefix("[::1]") {
        Some("") => ("[::1]", None),
        Some(port) => ("[::1]", port.strip_prefix(':').or(Some("none"))),
        None => host.split_once(':').map_or((host, None), |(name, port)| (name, Some(port))),
    };
    let known = ["127.0.0.1", "localhost", "[::1]"].iter().any(|known| name.eq_ignore_ascii_case(known));
    known && port.is_none_or(|port| port.parse::<u16>().is_ok())
}

/// Sends a file.
pub fn answer(stream: &mut impl Write, kind: &str, more: &str, body: &[u8]) -> io::Result<()> {
    send(stream, "200 OK", kind, more, body)
}

/// Begins a response of unknown length, whose body follows in chunks.
pub fn begin(stream: &mut impl Write, kind: &str, more: &str) -> io::Result<()> {
    stream.write_all(head("200 OK", kind, "Transfer-Encoding: chunked", more).as_bytes())
}

/// Sends a refusal as text.
pub fn refuse(stream: &mut impl Write, refusal: Refusal) -> io::Result<()> {
    send(stream, refusal.status, "text/plain; charset=utf-8", "", format!("{}\n", refusal.why).as_bytes())
}

fn send(stream: &mut impl Write, status: &str, kind: &str, more: &str, body: &[u8]) -> io::Result<()> {
    let length = format!("Content-Length: {}", body.len());
    stream.write_all(head(status, kind, &length, more).as_bytes())?;
    stream.write_all(body)?;
    stream.flush()
}

/// Head of a response; `length` is the header that delimits the body.
fn head(status: &str, kind: &str, length: &str, more: &str) -> String {
    format!(
        "HTTP/1.1 {status}\r\nContent-Type: {kind}\r\n{length}\r\nConnection: close\r\n\
         Cache-Control: no-cache\r\nX-Content-Type-Options: nosniff\r\nCross-Origin-Resource-Policy: same-origin\r\n\
         Referrer-Policy: no-referrer\r\nContent-Security-Policy: {POLICY}\r\n{more}\r\n"
    )
}

/// Accepts a WebSocket, with the subprotocol `protocol` if there is one.
pub fn upgrade(stream: &mut impl Write, key: &str, protocol: Option<&str>) -> io::Result<()> {
    let accept = tungstenite::handshake::derive_accept_key(key.as_bytes());
    let protocol = protocol.map_or(String::new(), |name| format!("Sec-WebSocket-Protocol: {name}\r\n"));
    let head = format!(
        "HTTP/1.1 101 Switching Protocols\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n\
         Sec-WebSocket-Accept: {accept}\r\n{protocol}\r\n"
    );
    stream.write_all(head.as_bytes())?;
    stream.flush()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parsed(text: &str) -> Result<Option<Request>, &'static str> {
        parse(text.replace('\n', "\r\n").as_bytes(), Sites::Own).map_err(|refusal| &refusal.status[..3])
    }

    #[test]
    fn a_request_is_read_in_any_split() {
        let text = b"GET /panels.js?x=1 HTTP/1.1\r\nHost: localhost:8295\r\n\r\nrest";
        for end in 0..text.len() - 4 {
            assert_eq!(parse(&text[..end], Sites::Own), Ok(None), "{end}");
        }
        let request = parse(text, Sites::Own).unwrap().unwrap();
        assert_eq!(
            (request.path.as_str(), request.key, request.rest.as_slice()),
            ("/panels.js", None, &b"rest"[..])
        );
        assert!(read(&mut &text[..40], Sites::Own).is_none());
        let long = [b"GET / HTTP/1.1\r\nHost: localhost\r\nX: ".as_slice(), &[b'x'; 2 * HEAD]].concat();
        assert!(read(&mut long.as_slice(), Sites::Own).unwrap().unwrap_err().status.starts_with("431"));
    }

    #[test]
    fn only_this_machine_and_this_page_are_answered() {
        let get = |headers: &str| {
            parsed(&format!("GET / HTTP/1.1\n{headers}\n\n")).map(|request| request.is_some())
        };
        for host in ["localhost", "127.0.0.1", "127.0.0.1:8295", "LocalHost:1", "[::1]", "[::1]:80"] {
            assert_eq!(get(&format!("Host: {host}")), Ok(true), "{host}");
        }
        let wrong = [
            "",
            "X: y",
            "Host: evil.example",
            "Host: localhost.evil.example:8295",
            "Host: 127.0.0.1.evil",
            "Host: [::1]x",
            "Host: localhost:x",
            "Host: localhost\nHost: localhost",
            "Host: 127.0.0.2",
        ];
        for headers in wrong {
            assert_eq!(get(headers), Err("403"), "{headers}");
        }
        assert_eq!(get("Host: localhost:1\nOrigin: http://localhost:1"), Ok(true));
        for origin in ["http://evil.example", "null", "https://localhost:1", "http://localhost:2", ""] {
            assert_eq!(get(&format!("Host: localhost:1\nOrigin: {origin}")), Err("403"), "{origin}");
        }
        let twice = "Host: localhost:1\nOrigin: http://localhost:1\nOrigin: http://localhost:1";
        assert_eq!(get(twice), Err("403"));
    }

    #[test]
    fn sites_that_are_named_are_answered_beside_those_of_this_machine() {
        let names = ["https://app.example.org".to_string()];
        let get = |origin: &str| {
            let text = format!("GET / HTTP/1.1\r\nHost: localhost:1\r\nOrigin: {origin}\r\n\r\n");
            parse(text.as_bytes(), Sites::Named(&names)).is_ok()
        };
        for origin in ["https://app.example.org", "http://localhost:2", "http://127.0.0.1:1", "file://"] {
            assert!(get(origin), "{origin}");
        }
        for origin in [
            "http://app.example.org",
            "https://app.example.org.evil",
            "null",
            "",
            "https://localhost:1",
            "http://evil",
        ] {
            assert!(!get(origin), "{origin}");
        }
    }

    #[test]
    fn protocols_are_read_from_one_line_and_from_several() {
        let text =
            "GET / HTTP/1.1\nHost: localhost\nSec-WebSocket-Protocol: a, b\nSec-WebSocket-Protocol: c\n\n";
        assert_eq!(parsed(text).unwrap().unwrap().protocols, ["a", "b", "c"]);
    }

    #[test]
    fn what_is_no_request_is_refused() {
        assert_eq!(parsed("GET\n\n"), Err("400"));
        assert_eq!(parse(&[0xff; 64], Sites::Own).unwrap_err().status, "400 Bad Request");
        assert_eq!(parsed("POST / HTTP/1.1\nHost: localhost\n\n"), Err("405"));
        let many: String = (0..100).map(|n| format!("X{n}: y\n")).collect();
        assert_eq!(parsed(&format!("GET / HTTP/1.1\nHost: localhost\n{many}\n")), Err("400"));
        let socket = "GET /socket HTTP/1.1\nHost: localhost\nUpgrade: websocket\n";
        assert_eq!(parsed(&format!("{socket}\n")), Err("400"));
        assert_eq!(
            parsed(&format!("{socket}Sec-WebSocket-Key: a\nSec-WebSocket-Version: 8\n\n")),
            Err("400")
        );
        let asked = parsed(&format!("{socket}Sec-WebSocket-Key: a\nSec-WebSocket-Version: 13\n\n"));
        assert_eq!(asked.unwrap().unwrap().key.as_deref(), Some("a"));
    }

    #[test]
    fn garbage_never_panics() {
        let mut noise = fastrand::Rng::with_seed(5);
        let good = b"GET /a HTTP/1.1\r\nHost: localhost:8295\r\nOrigin: http://localhost:8295\r\n\r\n";
        for _ in 0..20_000 {
            let mut bytes = good.to_vec();
            for _ in 0..noise.usize(1..6) {
                let at = noise.usize(..bytes.len());
                bytes[at] = noise.u8(..);
            }
            let _ = parse(&bytes, Sites::Own);
        }
    }
}
