//! Serves the pages and their files.

use super::hub::PageHub;
use super::hubs::PageHubs;
use super::said::Said;
use super::token::Token;
use super::transfer::Transfer;
use super::{assets, page};
use crate::serve::http::{self, Refusal, Sites};
use crate::serve::{self, Guest, Hurry};
use anyhow::Result;
use std::io::BufWriter;
use std::net::{TcpListener, TcpStream};

/// Connections at a time besides those of pages: those that browsers open for the files of a few pages.
const CONNECTIONS: usize = 48;
/// The file does not exist.
const MISSING: Refusal = Refusal { status: "404 Not Found", why: "no such file" };
/// The address lacks the token.
const STRANGE: Refusal = Refusal {
    status: "403 Forbidden",
    why: "this page is for whoever has its whole address: the program that serves it has printed it",
};
/// Too many transfers.
const BUSY: Refusal = Refusal {
    status: "503 Service Unavailable",
    why: "recordings are being sent to others: try again in a moment",
};

/// Serves the pages of a hub, or of the boards of a robot, in a thread of its own. Returns the port.
pub fn serve(listener: TcpListener, hubs: impl Into<PageHubs>) -> Result<u16> {
    let hubs = hubs.into();
    serve::open("page", listener, CONNECTIONS, move |stream, guest| {
        Ok(connection(stream, &guest, &hubs, None)?)
    })
}

/// Serves the pages to other machines, too, if their addresses begin with the token. Returns the port.
pub fn serve_guests(listener: TcpListener, hubs: impl Into<PageHubs>, token: Token) -> Result<u16> {
    let hubs = hubs.into();
    serve::open("page", listener, CONNECTIONS, move |stream, guest| {
        Ok(connection(stream, &guest, &hubs, Some(&token))?)
    })
}

/// Answers one request, or serves a page until it closes.
fn connection(
    mut stream: TcpStream,
    guest: &Guest,
    hubs: &PageHubs,
    token: Option<&Token>,
) -> std::io::Result<()> {
    let sites = if token.is_some() { Sites::Any } else { Sites::Own };
    let Some(request) = http::read(&mut stream, sites) else { return Ok(()) };
    let request = match request {
        Ok(request) => request,
        Err(refusal) => return http::refuse(&mut stream, refusal),
    };
    let behind = token.map_or(Some(request.path.as_str()), |token| token.behind(&request.path));
    let Some(path) = behind else { return http::refuse(&mut stream, STRANGE) };
    let Some((hub, path)) = hubs.at(path) else { return http::refuse(&mut stream, MISSING) };
    match (path, request.key) {
        ("/socket", Some(key)) => match hub.join() {
            Some(mailbox) => {
                // Pages are counted by the hub.
                guest.stay();
                let end = http::upgrade(&mut stream, &key, None)
                    .and_then(|()| page::talk(stream, request.rest, hub, &mailbox));
                hub.leave(&mailbox);
                end
            }
            None => {
                let why = "too many pages are open";
                http::refuse(&mut stream, Refusal { status: "503 Service Unavailable", why })
            }
        },
        ("/recording.mcap", None) => match hub.transfer() {
            Some(_transfer) => recording(stream, hub),
            None => http::refuse(&mut stream, BUSY),
        },
        ("/touches.toml", None) => match hub.touches() {
            Some(Ok(text)) => {
                let name = "Content-Disposition: attachment; filename=\"touches.toml\"\r\n";
                http::answer(&mut Hurry::new(stream), "application/toml", name, text.as_bytes())
            }
            Some(Err(error)) => {
                hub.say(&Said::note(format!("the touches could not be saved: {error:#}")));
                http::refuse(&mut stream, MISSING)
            }
            None => http::refuse(&mut stream, MISSING),
        },
        (path, None) => match assets::find(path) {
            Some(asset) => http::answer(&mut Hurry::new(stream), asset.kind, "", asset.bytes),
            None => http::refuse(&mut stream, MISSING),
        },
        _ => http::refuse(&mut stream, MISSING),
    }
}

/// Sends a recording to be saved.
fn recording(mut stream: TcpStream, hub: &PageHub) -> std::io::Result<()> {
    if !hub.has_tape() {
        return http::refuse(&mut stream, MISSING);
    }
    let name = "Content-Disposition: attachment; filename=\"recording.mcap\"\r\n";
    let mut stream = Hurry::new(stream);
    http::begin(&mut stream, "application/octet-stream", name)?;
    let mut transfer = Transfer(BufWriter::new(stream));
    // On failure the end of the body is missing, which the browser reports.
    match hub.save(&mut transfer) {
        Ok(()) => transfer.end(),
        Err(error) => {
            hub.say(&Said::note(format!("the recording could not be saved: {error:#}")));
            Ok(())
        }
    }
}
