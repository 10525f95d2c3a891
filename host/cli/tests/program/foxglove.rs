//! The live server for Foxglove: messages to a client that subscribes to a simulated pat, and to one that
//! does not read.

use serde_json::{Value, json};
use std::net::{Ipv4Addr, TcpListener, TcpStream};
use std::sync::Arc;
use std::time::Duration;
use taxel::client::{Client, Event, Stamp};
use taxel::record::json_message;
use taxel::session::Observer;
use taxel::source::{self, SourceOptions};
use taxel_cli::foxglove::{FoxgloveHub, Publisher, channel, serve};
use taxel_cli::watch::{WatchOptions, watch};
use taxel_core::format::Micros;
use taxel_core::wire::Level;
use tungstenite::client::IntoClientRequest;
use tungstenite::http::HeaderValue;
use tungstenite::{Bytes, Message, WebSocket};

fn connected(port: u16, protocols: &'static str) -> Result<WebSocket<TcpStream>, String> {
    connected_from(port, protocols, Some("https://app.foxglove.dev"))
}

fn connected_from(
    port: u16,
    protocols: &'static str,
    origin: Option<&'static str>,
) -> Result<WebSocket<TcpStream>, String> {
    let stream = TcpStream::connect((Ipv4Addr::LOCALHOST, port)).unwrap();
    stream.set_read_timeout(Some(Duration::from_secs(60))).unwrap();
    let mut request = format!("ws://127.0.0.1:{port}/").into_client_request().unwrap();
    request.headers_mut().insert("Sec-WebSocket-Protocol", HeaderValue::from_static(protocols));
    if let Some(origin) = origin {
        request.headers_mut().insert("Origin", HeaderValue::from_static(origin));
    }
    let (socket, response) = tungstenite::client(request, stream).map_err(|error| error.to_string())?;
    assert!(protocols.ends_with(response.headers()["Sec-WebSocket-Protocol"].to_str().unwrap()));
    Ok(socket)
}

fn line(socket: &mut WebSocket<TcpStream>) -> Value {
    serde_json::from_str(socket.read().unwrap().to_text().unwrap()).unwrap()
}

fn subscribe(socket: &mut WebSocket<TcpStream>, hub: &FoxgloveHub, id: u32, topic: &str) {
    let channel = channel(topic).unwrap();
    let request = json!({ "op": "subscribe", "subscriptions": [{ "id": id, "channelId": channel }] });
    socket.send(Message::text(request.to_string())).unwrap();
    while !hub.wants(channel) {
        std::thread::yield_now();
    }
}

/// Sends to the clients, and keeps the messages about contacts.
struct Both(Publisher, Vec<Value>);

impl Observer for Both {
    fn event(&mut self, client: &Client, event: &Event, stamp: Stamp) -> taxel::Result<()> {
        if let Event::Contacts { .. } = event {
            self.1.push(serde_json::from_slice(&json_message(client, event, stamp)?)?);
        }
        self.0.event(client, event, stamp)
    }
}

fn play(hub: Arc<FoxgloveHub>) -> Vec<Value> {
    let spec: source::SourceSpec = "sim:pat".parse().unwrap();
    let source = source::open(&spec, &SourceOptions::default()).unwrap();
    let mut both = Both(Publisher::new(hub), Vec::new());
    watch(&WatchOptions::of(spec), source, &mut both).unwrap();
    both.1
}

#[test]
fn a_client_sees_the_contact_of_a_pat_and_one_that_does_not_read_stops_nothing() {
    let hub = Arc::new(FoxgloveHub::default());
    let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, 0)).unwrap();
    let port = serve(listener, hub.clone(), "sim:pat", &[]).unwrap();
    let why = connected(port, "chat").unwrap_err();
    assert!(why.contains("400"), "{why}");

    let mut one = connected(port, "foxglove.websocket.v1, foxglove.sdk.v1").unwrap();
    let info = line(&mut one);
    assert_eq!((&info["op"], &info["metadata"]["source"]), (&json!("serverInfo"), &json!("sim:pat")));
    let advertised = line(&mut one);
    let channels = advertised["channels"].as_array().unwrap();
    let contacts = channels.iter().find(|channel| channel["topic"] == "/taxel/contacts").unwrap();
    assert_eq!((&contacts["encoding"], &contacts["schemaEncoding"]), (&json!("json"), &json!("jsonschema")));
    let schema: Value = serde_json::from_str(contacts["schema"].as_str().unwrap()).unwrap();
    assert!(schema["properties"]["contacts"]["items"]["properties"]["azimuth_rad"].is_object());
    let images = channels.iter().find(|channel| channel["topic"] == "/taxel/image").unwrap();
    assert_eq!(
        (&images["encoding"], &images["schemaName"]),
        (&json!("protobuf"), &json!("foxglove.RawImage"))
    );

    let mut slow = connected(port, "foxglove.websocket.v1").unwrap();
    let request = json!({ "op": "subscribe", "subscriptions": [{ "id": 1, "channelId": images["id"] }] });
    slow.send(Message::text(request.to_string())).unwrap();
    while !hub.wants(images["id"].as_u64().unwrap() as u32) {
        std::thread::yield_now();
    }
    subscribe(&mut one, &hub, 77, "contacts");
    one.send(Message::Ping(Bytes::from_static(b"still there?"))).unwrap();
    let seen = play(hub.clone());

    let (mut received, mut answered) = (Vec::new(), false);
    while received.len() < seen.len() {
        match one.read().unwrap() {
            Message::Binary(bytes) => {
                assert_eq!((bytes[0], &bytes[1..5]), (1, &77u32.to_le_bytes()[..]));
                let value: Value = serde_json::from_slice(&bytes[13..]).unwrap();
                let host = value["host_time_us"].as_u64().unwrap();
                assert_eq!(u64::from_le_bytes(bytes[5..13].try_into().unwrap()), host * 1000);
                received.push(value);
            }
            Message::Pong(bytes) => answered |= bytes == b"still there?"[..],
            other => panic!("{other:?}"),
        }
    }
    assert!(received == seen, "{:?} is not {:?}", received.first(), seen.first());
    assert!(answered);
    let backs = received.iter().flat_map(|said| said["contacts"].as_array().unwrap());
    assert!(backs.filter(|contact| contact["panel_name"] == "back").count() > 10);

    // Behind the server's own words, an image of 64 x 32 taxels.
    let shown = std::iter::from_fn(|| slow.read().ok()).find(Message::is_binary).unwrap().into_data();
    assert!(shown.len() > 2 * 2048 && shown.windows(6).any(|name| name == b"mono16"), "{}", shown.len());

    let mut late = connected(port, "foxglove.websocket.v1").unwrap();
    let _ = (line(&mut late), line(&mut late));
    subscribe(&mut late, &hub, 5, "hello");
    let known = late.read().unwrap().into_data();
    let hello: Value = serde_json::from_slice(&known[13..]).unwrap();
    assert_eq!(hello["garment"], "reference", "who comes late is sent what is known");
}

#[test]
fn pages_of_other_sites_are_not_let_in() {
    let hub = Arc::new(FoxgloveHub::default());
    let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, 0)).unwrap();
    let port = serve(listener, hub, "sim:pat", &[]).unwrap();
    for origin in
        ["https://evil.example", "null", "http://localhost.evil.example", "https://app.foxglove.dev.evil"]
    {
        let why = connected_from(port, "foxglove.sdk.v1", Some(origin)).err().unwrap_or_default();
        assert!(why.contains("403"), "{origin}: {why}");
    }
    for origin in [None, Some("https://app.foxglove.dev"), Some("http://localhost:8080"), Some("file://")] {
        assert!(connected_from(port, "foxglove.sdk.v1", origin).is_ok(), "{origin:?}");
    }
}

#[test]
fn clients_that_say_nothing_shut_nobody_out_and_subscriptions_are_bounded() {
    let hub = Arc::new(FoxgloveHub::default());
    let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, 0)).unwrap();
    let port = serve(listener, hub.clone(), "sim:pat", &[]).unwrap();
    let held: Vec<_> = (0..200).map(|_| TcpStream::connect((Ipv4Addr::LOCALHOST, port)).unwrap()).collect();
    let begun = std::time::Instant::now();
    let mut one = connected(port, "foxglove.sdk.v1").unwrap();
    assert!(begun.elapsed() < Duration::from_secs(4), "{:?}", begun.elapsed());
    let _ = (line(&mut one), line(&mut one));
    drop(held);
    // A hundred thousand subscriptions to one channel: it gets some messages, and no more.
    let channel = channel("log").unwrap();
    for first in (0..100_000u32).step_by(1000) {
        let all: Vec<Value> =
            (first..first + 1000).map(|id| json!({ "id": id, "channelId": channel })).collect();
        one.send(Message::text(json!({ "op": "subscribe", "subscriptions": all }).to_string())).unwrap();
    }
    one.send(Message::Ping(Bytes::from_static(b"done?"))).unwrap();
    let mut refused = 0;
    loop {
        match one.read().unwrap() {
            Message::Pong(_) => break,
            Message::Text(text) => refused += usize::from(text.contains("subscriptions")),
            other => panic!("{other:?}"),
        }
    }
    assert!(refused > 0, "it is said that there are too many");
    let said = Event::Log { time: Micros(1), level: Level::Info, text: "one".into() };
    let stamp = Stamp { board_us: 1, host_us: 1, uncertainty_us: None };
    Publisher::new(hub).event(&Client::new(), &said, stamp).unwrap();
    one.get_ref().set_read_timeout(Some(Duration::from_secs(1))).unwrap();
    let received = std::iter::from_fn(|| one.read().ok()).filter(Message::is_binary).count();
    assert!((1..=64).contains(&received), "{received}");
}
