//! Clients that take all connections, read slowly, or come from another site do not shut others out.

use std::io::{Read, Write};
use std::net::{Ipv4Addr, TcpListener, TcpStream};
use std::sync::Arc;
use std::time::{Duration, Instant};
use taxel::client::{Client, Event, Stamp};
use taxel::record::Origin;
use taxel::robot::BoardConfig;
use taxel::session::Observer;
use taxel::source::{self, SourceOptions};
use taxel_cli::view::{PageHub, Tape, serve};
use taxel_cli::watch::{BoardArgs, WatchOptions, watch};

/// Keeps the bytes of a board for the pages.
struct Keeper(Arc<PageHub>);

impl Observer for Keeper {
    fn event(&mut self, client: &Client, event: &Event, _: Stamp) -> taxel::Result<()> {
        self.0.keep(client, event);
        Ok(())
    }
}

/// A page with a recording of some megabytes behind it.
fn page() -> u16 {
    let hub = Arc::new(PageHub::default());
    let spec: source::SourceSpec = "sim:five".parse().unwrap();
    let options = SourceOptions { seconds: Some(25.0), ..SourceOptions::default() };
    let source = source::open(&spec, &options).unwrap();
    let config = BoardConfig { raw: true, ..BoardConfig::of(spec) };
    let board = WatchOptions::on(BoardArgs { config, ..BoardArgs::default() });
    watch(&WatchOptions { seconds: Some(25.0), ..board }, source, &mut Keeper(hub.clone())).unwrap();
    assert!(hub.recording().unwrap().len() > 4 << 20);
    let origin = Origin { label: "sim:five".into(), ..Origin::default() };
    hub.tape(Tape::Live(Arc::new(origin)));
    serve(TcpListener::bind((Ipv4Addr::LOCALHOST, 0)).unwrap(), hub).unwrap()
}

fn ask(port: u16, path: &str) -> TcpStream {
    let mut stream = TcpStream::connect((Ipv4Addr::LOCALHOST, port)).unwrap();
    stream.set_read_timeout(Some(Duration::from_secs(20))).unwrap();
    write!(stream, "GET {path} HTTP/1.1\r\nHost: localhost\r\n\r\n").unwrap();
    stream
}

/// Time until the page sends its first file.
#[track_caller]
fn is_served(port: u16) -> Duration {
    let begun = Instant::now();
    let mut answer = String::new();
    ask(port, "/").read_to_string(&mut answer).unwrap();
    assert!(answer.starts_with("HTTP/1.1 200 OK") && answer.ends_with("</html>\n"), "{answer}");
    begun.elapsed()
}

#[test]
fn who_takes_large_files_and_does_not_read_them_shuts_nobody_out() {
    let port = page();
    for path in ["/recording.mcap", "/store.js", "/"] {
        let held: Vec<TcpStream> = (0..150).map(|_| ask(port, path)).collect();
        let waited = is_served(port);
        assert!(waited < Duration::from_secs(4), "{path}: {waited:?}");
        drop(held);
    }
    // Some silent clients.
    let held: Vec<_> = (0..150).map(|_| TcpStream::connect((Ipv4Addr::LOCALHOST, port)).unwrap()).collect();
    let waited = is_served(port);
    assert!(waited < Duration::from_secs(4), "{waited:?}");
    drop(held);
    // A recording can still be downloaded.
    let begun = Instant::now();
    loop {
        let mut answer = Vec::new();
        ask(port, "/recording.mcap").read_to_end(&mut answer).unwrap();
        if answer.starts_with(b"HTTP/1.1 200 OK") {
            assert!(answer.len() > 4 << 20);
            break;
        }
        assert!(answer.starts_with(b"HTTP/1.1 503 "), "{}", String::from_utf8_lossy(&answer));
        assert!(begun.elapsed() < Duration::from_secs(30), "no recording in {:?}", begun.elapsed());
        std::thread::sleep(Duration::from_millis(200));
    }
}
