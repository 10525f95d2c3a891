//! The server: a thread that accepts, and one for each connection.

use super::assets;
use super::http::{self, Refusal};
use super::hub::{Hub, PAGES};
use super::page;
use super::said::Said;
use super::transfer::Transfer;
use anyhow::{Context, Result};
use std::io::BufWriter;
use std::net::{TcpListener, TcpStream};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;
use std::time::Duration;

/// Connections at a time: all pages, and what a browser opens for the files of a few.
const CONNECTIONS: usize = PAGES + 48;
/// How long a read or a write of a file may stand still.
const PATIENCE: Duration = Duration::from_secs(5);

/// Serves the pages of a hub from a thread of its own; the port.
pub fn serve(listener: TcpListener, hub: Arc<Hub>) -> Result<u16> {
    let port = listener.local_addr().context("the page has no address")?.port();
    let accept = move || {
        let open = Arc::new(AtomicUsize::new(0));
        for stream in listener.incoming() {
            let Ok(stream) = stream else {
                // Too many files are open, say: it may pass.
                thread::sleep(Duration::from_millis(50));
                continue;
            };
            let (hub, open) = (hub.clone(), open.clone());
            if open.fetch_add(1, Ordering::Relaxed) >= CONNECTIONS {
                open.fetch_sub(1, Ordering::Relaxed);
                continue;
            }
            let counted = open.clone();
            let spawned = thread::Builder::new().name("page".into()).spawn(move || {
                // A disconnect mid-response is not an error.
                let _ = connection(stream, &hub);
                counted.fetch_sub(1, Ordering::Relaxed);
            });
            if spawned.is_err() {
                open.fetch_sub(1, Ordering::Relaxed);
            }
        }
    };
    thread::Builder::new().name("pages".into()).spawn(accept)?;
    Ok(port)
}

/// Answers one request, or talks to a page until it goes.
fn connection(mut stream: TcpStream, hub: &Hub) -> std::io::Result<()> {
    stream.set_read_timeout(Some(PATIENCE))?;
    stream.set_write_timeout(Some(PATIENCE))?;
    stream.set_nodelay(true)?;
    let Some(request) = http::read(&mut stream) else { return Ok(()) };
    let missing = Refusal { status: "404 Not Found", why: "there is nothing of that name" };
    let request = match request {
        Ok(request) => request,
        Err(refusal) => return http::refuse(&mut stream, refusal),
    };
    match (request.path.as_str(), request.key) {
        ("/socket", Some(key)) => match hub.join() {
            Some(mailbox) => {
                let end = http::upgrade(&mut stream, &key)
                    .and_then(|()| page::talk(stream, request.rest, hub, &mailbox));
                hub.leave(&mailbox);
                end
            }
            None => {
                let why = "too many pages are open";
                http::refuse(&mut stream, Refusal { status: "503 Service Unavailable", why })
            }
        },
        ("/recording.taxel", None) => match hub.recording() {
            Some(bytes) => {
                let name = "Content-Disposition: attachment; filename=\"recording.taxel\"\r\n";
                http::answer(&mut stream, "application/octet-stream", name, &bytes)
            }
            None => http::refuse(&mut stream, missing),
        },
        ("/recording.mcap", None) if hub.has_tape() => {
            let name = "Content-Disposition: attachment; filename=\"recording.mcap\"\r\n";
            http::begin(&mut stream, "application/octet-stream", name)?;
            let mut transfer = Transfer(BufWriter::new(stream));
            // Where it fails, the end is missing, and the browser says so.
            match hub.save(&mut transfer) {
                Ok(()) => transfer.end(),
                Err(error) => {
                    hub.say(&Said::note(format!("the recording could not be saved: {error:#}")));
                    Ok(())
                }
            }
        }
        (path, None) => match assets::find(path) {
            Some(asset) => http::answer(&mut stream, asset.kind, "", asset.bytes),
            None => http::refuse(&mut stream, missing),
        },
        _ => http::refuse(&mut stream, missing),
    }
}
