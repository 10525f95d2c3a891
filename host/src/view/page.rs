//! The WebSocket of one page: one thread reads what the page asks for, this one writes what it is told.

use super::hub::Hub;
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

/// Longest message of a page.
const LONGEST: usize = 4096;

/// Talks to a page until it goes, or has not read for as long as the stream's timeout.
pub fn talk(stream: TcpStream, rest: Vec<u8>, hub: &Hub, mailbox: &Arc<Mailbox>) -> io::Result<()> {
    let end = stream.try_clone()?;
    let reading = stream.try_clone()?;
    // A page may say nothing for ever.
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

fn write(stream: TcpStream, hub: &Hub, mailbox: &Mailbox) -> io::Result<()> {
    let mut socket = WebSocket::from_raw_socket(stream, Role::Server, Some(config()));
    let mut send = |parcel| {
        let message = match parcel {
            Parcel::Line(line) => Message::Text(Utf8Bytes::from(&*line)),
            Parcel::Image(bytes) => Message::Binary(Bytes::from(bytes)),
            Parcel::Closed => return Ok(false),
        };
        socket.send(message).map(|()| true).map_err(io::Error::other)
    };
    // What is known, then what was before, then what comes.
    while let Some(line) = mailbox.line_now() {
        send(line)?;
    }
    // Where many come at once, some see no more than what comes: what was before takes memory for each.
    if let Some((_transfer, bytes)) = hub.transfer().and_then(|kept| Some((kept, hub.recording()?))) {
        for parcel in Past::of(&bytes) {
            if mailbox.is_closed() || !send(parcel)? {
                return Ok(());
            }
        }
    }
    while send(mailbox.next())? {}
    Ok(())
}

/// Does what a page asks for over its WebSocket, until it goes. `rest` are the first bytes, which have been
/// read already.
pub fn hear(stream: impl Read, rest: Vec<u8>, hub: &Hub, mailbox: &Mailbox) {
    let mut socket = WebSocket::from_partially_read(Mute(stream), rest, Role::Server, Some(config()));
    // Any error ends it: the page has gone, or does not speak WebSocket.
    while let Ok(said) = socket.read() {
        if let Message::Text(text) = said
            && let Some(wish) = message::wish(&text)
        {
            hub.wish(mailbox, wish);
        }
    }
}
