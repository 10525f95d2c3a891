//! The server: a thread that accepts, and two for each client.

use super::hub::Hub;
use super::protocol::{self, PROTOCOLS};
use super::subscriber::Subscriber;
use crate::view::Mute;
use anyhow::{Context, Result};
use std::net::{Shutdown, TcpListener, TcpStream};
use std::sync::Arc;
use std::thread;
use std::time::Duration;
use tungstenite::handshake::server::{ErrorResponse, Request, Response};
use tungstenite::http::{HeaderValue, StatusCode, header};
use tungstenite::protocol::{Role, WebSocketConfig};
use tungstenite::{Message, WebSocket};

/// How long a client may take for its first words, and a write may stand still.
const PATIENCE: Duration = Duration::from_secs(5);
/// Longest message of a client.
const LONGEST: usize = 1 << 16;

/// Serves a hub's channels of a source from a thread of its own; the port.
pub fn serve(listener: TcpListener, hub: Arc<Hub>, label: &str) -> Result<u16> {
    let port = listener.local_addr().context("the server has no address")?.port();
    let hello: Arc<[String]> = [protocol::server_info(label), protocol::advertise()].into();
    let accept = move || {
        for stream in listener.incoming() {
            let Ok(stream) = stream else {
                // Too many files are open, say: it may pass.
                thread::sleep(Duration::from_millis(50));
                continue;
            };
            let (hub, hello) = (hub.clone(), hello.clone());
            // Whoever goes away in the middle is no error of ours, and who finds no thread may come again.
            let _ = thread::Builder::new()
                .name("foxglove client".into())
                .spawn(move || _ = connection(stream, &hub, &hello));
        }
    };
    thread::Builder::new().name("foxglove".into()).spawn(accept)?;
    Ok(port)
}

/// Agrees on a name of the protocol.
#[expect(clippy::result_large_err, reason = "tungstenite's own type")]
fn agree(request: &Request, mut response: Response) -> Result<Response, ErrorResponse> {
    let offered = request.headers().get_all(header::SEC_WEBSOCKET_PROTOCOL);
    let offered: Vec<&str> =
        offered.iter().filter_map(|names| names.to_str().ok()).flat_map(|names| names.split(',')).collect();
    let known = PROTOCOLS.iter().find(|name| offered.iter().any(|offer| offer.trim() == **name));
    let Some(name) = known else {
        let why = format!("this server speaks {}, for Foxglove and its like", PROTOCOLS.join(" and "));
        let mut refusal = ErrorResponse::new(Some(why));
        *refusal.status_mut() = StatusCode::BAD_REQUEST;
        return Err(refusal);
    };
    response.headers_mut().insert(header::SEC_WEBSOCKET_PROTOCOL, HeaderValue::from_static(name));
    Ok(response)
}

fn config() -> WebSocketConfig {
    WebSocketConfig::default()
        .max_message_size(Some(LONGEST))
        .max_frame_size(Some(LONGEST))
        .write_buffer_size(0)
}

/// Talks to a client until it goes, or does not read for a while.
fn connection(stream: TcpStream, hub: &Hub, hello: &[String]) -> Result<()> {
    stream.set_read_timeout(Some(PATIENCE))?;
    stream.set_write_timeout(Some(PATIENCE))?;
    stream.set_nodelay(true)?;
    let (end, reading) = (stream.try_clone()?, stream.try_clone()?);
    let Ok(mut socket) = tungstenite::accept_hdr_with_config(stream, agree, Some(config())) else {
        return Ok(());
    };
    // From now on a client may say nothing for ever.
    reading.set_read_timeout(None)?;
    let Some(client) = hub.join() else { return Ok(()) };
    thread::scope(|scope| {
        let reader = thread::Builder::new().name("foxglove reader".into());
        let reader = reader.spawn_scoped(scope, || {
            read(reading, hub, &client);
            client.close();
        });
        let told =
            reader.is_ok() && hello.iter().all(|line| socket.send(Message::text(line.clone())).is_ok());
        while told && let Some(message) = client.next() {
            if socket.send(message).is_err() {
                break;
            }
        }
        // Wakes the reader.
        let _ = end.shutdown(Shutdown::Both);
    });
    hub.leave(&client);
    Ok(())
}

fn read(stream: TcpStream, hub: &Hub, client: &Subscriber) {
    let mut socket = WebSocket::from_raw_socket(Mute(stream), Role::Server, Some(config()));
    // Any error ends it: the client has gone, or does not speak WebSocket.
    while let Ok(said) = socket.read() {
        match said {
            Message::Text(text) => {
                protocol::wish(&text).into_iter().for_each(|wish| hub.wish(client, wish));
            }
            Message::Ping(bytes) => client.pong(bytes),
            _ => {}
        }
    }
}
