//! The WebSocket of one page: one thread reads its requests, this one writes its messages.

use super::hub::PageHub;
use super::mailbox::{Mailbox, Parcel};
use super::message;
use super::past::Past;
use crate::serve::Mute;
use std::io::{self, Read};
use std::net::{Shutdown, TcpStream};
use std::sync::Arc;
use std::thread;
use tungstenite::protocol::{Role, WebSocketConfig};
use tungstenite::{Bytes, Message, Utf8Bytes, WebSocket};

/// Longest message from a page.
const LONGEST: usize = 4096;

/// Serves a page until it closes, or has not read for the stream's timeout.
pub fn talk(stream: TcpStream, rest: Vec<u8>, hub: &PageHub, mailbox: &Arc<Mailbox>) -> io::Result<()> {
    let end = stream.try_clone()?;
    let reading = stream.try_clone()?;
    // A page may be silent for any time.
    reading.set_read_timeout(None)?;
    thread::scope(|scope| {
        let reader = thread::Builder::new().name("page reader".into());
        let reader = reader.spawn_scoped(scope, || {
            hear(reading, rest, hub, mailbox);
            mailbox.close();
        })?;
        let written = write(stream, hub, mailbox);
        // Wakes the reader.
        let _ = end.shutdown(Shutdown::Both);
        let _ = reader.join();
        written
    })
}

fn config() -> WebSocketConfig {
    WebSocketConfig::default()
        .max_message_size(Some(LONGEST))
        .max_frame_size(Some(LONGEST))
        .write_buffer_size(0)
}

fn write(stream: TcpStream, hub: &PageHub, mailbox: &Mailbox) -> io::Result<()> {
    let mut socket = WebSocket::from_raw_socket(stream, Role::Server, Some(config()));
    let mut send = |parcel| {
        let message = match parcel {
            Parcel::Line(line) => Message::Text(Utf8Bytes::from(&*line)),
            Parcel::Image(bytes) => Message::Binary(Bytes::from(bytes)),
            Parcel::Closed => return Ok(false),
        };
        socket.send(message).map(|()| true).map_err(io::Error::other)
    };
    // The current state, then earlier images, then the stream.
    while let Some(line) = mailbox.line_now() {
        send(line)?;
    }
    // If many pages open at once, some get no earlier images, because these take memory for each page.
    if let Some((_transfer, bytes)) = hub.transfer().and_then(|kept| Some((kept, hub.recording()?))) {
        for parcel in Past::of(&bytes, hub) {
            if mailbox.is_closed() || !send(parcel)? {
                return Ok(());
            }
        }
    }
    while send(mailbox.next())? {}
    Ok(())
}

/// Handles a page's requests until it closes. `rest` holds its first bytes, read already.
pub fn hear(stream: impl Read, rest: Vec<u8>, hub: &PageHub, mailbox: &Mailbox) {
    let mut socket = WebSocket::from_partially_read(Mute(stream), rest, Role::Server, Some(config()));
    // Any error ends it: the page is closed, or does not speak WebSocket.
    while let Ok(said) = socket.read() {
        if let Message::Text(text) = said
            && let Some(request) = message::request(&text)
        {
            hub.request(mailbox, request);
        }
    }
}
