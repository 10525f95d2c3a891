//! The server: admits clients, and runs two threads for each.

use super::hub::FoxgloveHub;
use super::protocol::{self, PROTOCOLS};
use super::subscriber::Subscriber;
use crate::serve::http::{self, Refusal, Sites};
use crate::serve::{self, Guest, Mute};
use anyhow::Result;
use std::net::{Shutdown, TcpListener, TcpStream};
use std::sync::Arc;
use std::thread;
use tungstenite::protocol::{Role, WebSocketConfig};
use tungstenite::{Message, WebSocket};

/// Connections at a time besides those of clients.
const CONNECTIONS: usize = 16;
/// Longest message from a client.
const LONGEST: usize = 1 << 16;
/// Sites of Foxglove itself.
const FOXGLOVE: [&str; 2] = ["https://app.foxglove.dev", "https://studio.foxglove.dev"];

/// Serves a hub's channels in a thread of its own. Returns the port. Pages of these `sites` are admitted
/// besides Foxglove's own.
pub fn serve(listener: TcpListener, hub: Arc<FoxgloveHub>, label: &str, sites: &[String]) -> Result<u16> {
    let hello = [protocol::server_info(label), protocol::advertise()];
    let sites: Vec<String> = FOXGLOVE.into_iter().map(String::from).chain(sites.iter().cloned()).collect();
    serve::open("foxglove client", listener, CONNECTIONS, move |stream, guest| {
        connection(stream, &guest, &hub, (&hello, &sites))
    })
}

fn config() -> WebSocketConfig {
    WebSocketConfig::default()
        .max_message_size(Some(LONGEST))
        .max_frame_size(Some(LONGEST))
        .write_buffer_size(0)
}

/// Serves a client until it closes, or does not read for a while.
fn connection(
    mut stream: TcpStream,
    guest: &Guest,
    hub: &FoxgloveHub,
    (hello, sites): (&[String], &[String]),
) -> Result<()> {
    let Some(request) = http::read(&mut stream, Sites::Named(sites)) else { return Ok(()) };
    let agreed = request.and_then(|request| {
        let protocol = PROTOCOLS.iter().find(|name| request.protocols.iter().any(|offered| offered == *name));
        let why = "this server speaks foxglove.sdk.v1 and foxglove.websocket.v1, as Foxglove does";
        let refusal = Refusal { status: "400 Bad Request", why };
        Ok((request.key.ok_or(refusal)?, *protocol.ok_or(refusal)?, request.rest))
    });
    let (key, protocol, rest) = match agreed {
        Ok(agreed) => agreed,
        Err(refusal) => return Ok(http::refuse(&mut stream, refusal)?),
    };
    let Some(client) = hub.join() else {
        let why = "too many clients are connected";
        return Ok(http::refuse(&mut stream, Refusal { status: "503 Service Unavailable", why })?);
    };
    // Clients are counted by the hub.
    guest.stay();
    let done = http::upgrade(&mut stream, &key, Some(protocol)).map_err(anyhow::Error::from);
    let done = done.and_then(|()| talk(stream, rest, hub, &client, hello));
    hub.leave(&client);
    done
}

fn talk(
    stream: TcpStream,
    rest: Vec<u8>,
    hub: &FoxgloveHub,
    client: &Subscriber,
    hello: &[String],
) -> Result<()> {
    let (end, reading) = (stream.try_clone()?, stream.try_clone()?);
    let mut socket = WebSocket::from_raw_socket(stream, Role::Server, Some(config()));
    // A client may be silent for any time.
    reading.set_read_timeout(None)?;
    thread::scope(|scope| {
        let reader = thread::Builder::new().name("foxglove reader".into());
        let reader = reader.spawn_scoped(scope, || {
            read(reading, rest, hub, client);
            client.close();
        });
        let is_sent =
            reader.is_ok() && hello.iter().all(|line| socket.send(Message::text(line.clone())).is_ok());
        while is_sent && let Some(message) = client.next() {
            if socket.send(message).is_err() {
                break;
            }
        }
        // Wakes the reader.
        let _ = end.shutdown(Shutdown::Both);
    });
    Ok(())
}

fn read(stream: TcpStream, rest: Vec<u8>, hub: &FoxgloveHub, client: &Subscriber) {
    let mut socket = WebSocket::from_partially_read(Mute(stream), rest, Role::Server, Some(config()));
    // Any error ends it: the client is gone, or does not speak WebSocket.
    while let Ok(said) = socket.read() {
        match said {
            Message::Text(text) => {
                protocol::request(&text).into_iter().for_each(|request| hub.request(client, request));
            }
            Message::Ping(bytes) => client.pong(bytes),
            _ => {}
        }
    }
}
