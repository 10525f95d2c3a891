//! `taxel view` from outside: access, served files, and messages to a page while a simulated board is
//! watched.

use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::io::{Read, Write};
use std::net::{Ipv4Addr, TcpListener, TcpStream};
use std::sync::Arc;
use std::thread::{self, JoinHandle};
use std::time::Duration;
use taxel::client::{Client, Event, ImageNews, Stamp};
use taxel::session::Observer;
use taxel::source::{self, SourceOptions};
use taxel_cli::on_robot::ShownRobot;
use taxel_cli::view::{PageHub, Said, Shot, Token, Viewer, serve, serve_guests};
use taxel_cli::watch::{WatchOptions, watch};
use tungstenite::client::IntoClientRequest;
use tungstenite::{Message, WebSocket};

fn served() -> (Arc<PageHub>, u16) {
    let hub = Arc::new(PageHub::default());
    let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, 0)).unwrap();
    let port = serve(listener, hub.clone()).unwrap();
    (hub, port)
}

/// Response to a request.
fn answer(port: u16, request: &str) -> String {
    let mut stream = TcpStream::connect((Ipv4Addr::LOCALHOST, port)).unwrap();
    stream.write_all(request.as_bytes()).unwrap();
    stream.shutdown(std::net::Shutdown::Write).unwrap();
    let mut text = Vec::new();
    stream.read_to_end(&mut text).unwrap();
    String::from_utf8_lossy(&text).into_owned()
}

/// A page.
fn page(port: u16) -> WebSocket<TcpStream> {
    let stream = TcpStream::connect((Ipv4Addr::LOCALHOST, port)).unwrap();
    stream.set_read_timeout(Some(Duration::from_secs(60))).unwrap();
    let request = format!("ws://127.0.0.1:{port}/socket").into_client_request().unwrap();
    tungstenite::client(request, stream).unwrap().0
}

/// A message to a page: a line, or an image with its head.
enum PageMessage {
    Line(Value),
    Image { head: Value, image: Vec<u16>, highest: Vec<u16> },
}

fn next(page: &mut WebSocket<TcpStream>) -> PageMessage {
    match page.read().unwrap() {
        Message::Text(text) => PageMessage::Line(serde_json::from_str(&text).unwrap()),
        Message::Binary(bytes) => {
            let length = u32::from_le_bytes(bytes[..4].try_into().unwrap()) as usize;
            let (head, values) = bytes[4..].split_at(length);
            let values: Vec<u16> = values.chunks(2).map(|b| u16::from_le_bytes([b[0], b[1]])).collect();
            let (image, highest) = values.split_at(values.len() / 2);
            let head = serde_json::from_slice(head).unwrap();
            PageMessage::Image { head, image: image.into(), highest: highest.into() }
        }
        other => panic!("{other:?}"),
    }
}

/// Reads until a line of this type meets the condition.
fn line(page: &mut WebSocket<TcpStream>, kind: &str, wanted: impl Fn(&Value) -> bool) -> Value {
    loop {
        if let PageMessage::Line(line) = next(page)
            && line["type"] == kind
            && wanted(&line)
        {
            return line;
        }
    }
}

/// Watches a simulated scene for the pages of a hub.
fn watched(hub: &Arc<PageHub>, scene: &str, frames: u64, realtime: bool) -> JoinHandle<()> {
    let args = WatchOptions { frames: Some(frames), ..WatchOptions::of(scene.parse().unwrap()) };
    let options = SourceOptions { frames: Some(frames), realtime, ..SourceOptions::default() };
    let hub = hub.clone();
    thread::spawn(move || {
        let source = source::open(&args.board.source(), &options).unwrap();
        let mut viewer = Viewer::new(hub, None);
        watch(&args, source, &mut viewer).unwrap();
    })
}

/// Images of a run, by frame number.
#[derive(Default)]
struct Images(BTreeMap<u64, Vec<u16>>);

impl Observer for Images {
    fn event(&mut self, client: &Client, event: &Event, _: Stamp) -> taxel::Result<()> {
        if let (Event::Frame { frame, image: ImageNews::Whole, .. }, Some((_, image))) =
            (event, client.image())
        {
            self.0.insert(u64::from(*frame), image.into());
        }
        Ok(())
    }
}

fn images(scene: &str, frames: u64) -> BTreeMap<u64, Vec<u16>> {
    let args = WatchOptions { frames: Some(frames), ..WatchOptions::of(scene.parse().unwrap()) };
    let options = SourceOptions { frames: Some(frames), ..SourceOptions::default() };
    let mut images = Images::default();
    watch(&args, source::open(&args.board.source(), &options).unwrap(), &mut images).unwrap();
    images.0
}

#[test]
fn files_are_served_to_this_machine_alone_and_nothing_else_is() {
    let (_, port) = served();
    let get = |path: &str, headers: &str| answer(port, &format!("GET {path} HTTP/1.1\r\n{headers}\r\n\r\n"));
    let own = format!("Host: localhost:{port}");
    let page = get("/", &own);
    assert!(page.starts_with("HTTP/1.1 200 OK\r\n") && page.contains("<title>taxel</title>"), "{page}");
    assert!(
        page.contains("Content-Security-Policy: default-src 'self'; ") && !page.contains("Access-Control")
    );
    assert!(get("/main.js?x", &own).contains("Content-Type: text/javascript"));
    for (request, status) in [
        (get("/../Cargo.toml", &own), "404"),
        (get("/recording.mcap", &own), "404"),
        (get("/", "Host: evil.example"), "403"),
        (get("/", "X: y"), "403"),
        (get("/socket", &own), "404"),
        (answer(port, &format!("POST / HTTP/1.1\r\n{own}\r\n\r\n")), "405"),
        (answer(port, "\u{1}\u{2}\u{3}\r\n\r\n"), "400"),
    ] {
        assert_eq!(request.get(9..12), Some(status), "{request}");
    }
    assert_eq!(answer(port, "GET / HT"), "");
    let upgrade =
        "Upgrade: websocket\r\nSec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==";
    let other = get("/socket", &format!("{own}\r\n{upgrade}\r\nOrigin: http://evil.example"));
    assert_eq!(other.get(9..12), Some("403"), "{other}");
    // The key and its answer are those of RFC 6455.
    let agreed = get("/socket", &format!("{own}\r\n{upgrade}\r\nOrigin: http://localhost:{port}"));
    assert!(agreed.contains("101 Switching") && agreed.contains("s3pPLMBiTxaQ9kYGzzhZRbK+xOo="), "{agreed}");
}

#[test]
fn whoever_has_the_token_is_let_in_from_other_machines_and_nobody_else() {
    let token = Token::random();
    let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, 0)).unwrap();
    let port = serve_guests(listener, Arc::new(PageHub::default()), token.clone()).unwrap();
    let get = |path: &str, headers: &str| answer(port, &format!("GET {path} HTTP/1.1\r\n{headers}\r\n\r\n"));
    let (own, elsewhere) = (format!("/{}", token.as_str()), "Host: robot.local:8295");
    let upgrade =
        "Upgrade: websocket\r\nSec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==";
    let from = |origin: &str| format!("{elsewhere}\r\n{upgrade}\r\nOrigin: {origin}");
    for (answer, status) in [
        (get(&format!("{own}/"), elsewhere), "200"),
        (get(&format!("{own}/main.js"), elsewhere), "200"),
        (get(&format!("{own}/socket"), &from("http://robot.local:8295")), "101"),
        (get(&format!("{own}/socket"), &from("http://evil.example")), "403"),
        (get("/", elsewhere), "403"),
        (get("/socket", &from("http://robot.local:8295")), "403"),
        (get("/main.js", &format!("Host: localhost:{port}")), "403"),
        (get(&format!("/{}/", Token::random().as_str()), elsewhere), "403"),
        (get(&own, elsewhere), "403"),
    ] {
        assert_eq!(answer.get(9..12), Some(status), "{answer}");
    }
}

#[test]
fn a_page_is_sent_the_garment_and_the_very_images_of_the_board() {
    let (hub, port) = served();
    let mut page = page(port);
    let run = watched(&hub, "sim:pat", 200, true);
    let hello = line(&mut page, "hello", |_| true);
    assert_eq!((&hello["label"], &hello["counts_per_newton"]), (&"sim:pat".into(), &1000.0.into()));
    assert_eq!(hello["panels"][1]["region"], "back");
    assert_eq!(hello["map"]["concepts"].as_array().unwrap().len(), 22);
    let expected = images("sim:pat", 200);
    let (mut last, mut seen, mut times) = (0, 0, Vec::new());
    let mut replaced = 0;
    let end = loop {
        match next(&mut page) {
            PageMessage::Line(line) if line["type"] == "end" => break line,
            PageMessage::Line(_) => {}
            PageMessage::Image { head, image, highest } => {
                let frame = head["frame"]["frame"].as_u64().unwrap();
                assert!(frame > last, "{frame} after {last}");
                assert_eq!(Some(&image), expected.get(&frame), "frame {frame}");
                let since = expected.range(last + 1..=frame);
                let most = |taxel: usize| since.clone().map(|(_, image)| image[taxel]).max().unwrap();
                assert!(
                    highest.iter().enumerate().all(|(taxel, value)| *value == most(taxel)),
                    "frame {frame}"
                );
                times.extend(
                    head["samples"].as_array().unwrap().iter().map(|sample| sample[0].as_u64().unwrap()),
                );
                replaced = head["replaced"].as_u64().unwrap();
                assert_eq!(head["missed"], 0);
                (last, seen) = (frame, seen + 1);
            }
        }
    };
    run.join().unwrap();
    assert_eq!(end["text"], "sim:pat has ended");
    // Each frame up to the last one shown has its sample once, whether it was shown or replaced.
    assert_eq!((times.len() as u64, seen + replaced), (last, last));
    assert!(times.is_sorted_by(|a, b| a < b) && seen > 20, "{seen} images");
}

#[test]
fn the_last_half_minute_reads_as_a_recording() {
    let (hub, _) = served();
    watched(&hub, "sim:stroke", 400, false).join().unwrap();
    let bytes = hub.recording().unwrap();
    let (mut client, mut frames) = (Client::new(), BTreeMap::new());
    for byte in &bytes {
        if let Some(Event::Frame { frame, image, .. }) = client.push(*byte) {
            assert_eq!(image, ImageNews::Whole);
            frames.insert(u64::from(frame), client.image().unwrap().1.to_vec());
        }
    }
    // A board faster than real time may have sent more than was waited for.
    frames.retain(|frame, _| *frame <= 400);
    assert_eq!(frames, images("sim:stroke", 400));
    assert_eq!((client.counts().lost, client.counts().refused()), (0, 0));
    assert!(client.description().is_some());
}

#[test]
fn the_board_sends_raw_codes_while_a_pointer_is_on_a_taxel() {
    let (hub, port) = served();
    let mut page = page(port);
    let run = watched(&hub, "sim:idle", 400, true);
    line(&mut page, "hello", |_| true);
    page.send(Message::Text(r#"{"hover": 629}"#.into())).unwrap();
    let shown = line(&mut page, "taxel", |line| !line["code"].is_null());
    // Row 7, column 5 of the back: in its second block of four rows.
    assert_eq!(
        (&shown["taxel"], &shown["wired_row"], &shown["wired_column"]),
        (&629.into(), &3.into(), &5.into())
    );
    assert!((1..1000).contains(&shown["code"].as_u64().unwrap()), "{shown}");
    // Nonsense is ignored, as is a taxel that does not exist.
    for nonsense in ["{", "{\"hover\": 65535}", "{\"tare\": 0}", "[]"] {
        page.send(Message::Text(nonsense.into())).unwrap();
    }
    page.send(Message::Binary(vec![0; 100].into())).unwrap();
    page.send(Message::Text(r#"{"tare": 16}"#.into())).unwrap();
    line(&mut page, "say", |line| line["said"].as_str().unwrap().contains("tare: done"));
    page.send(Message::Text(r#"{"why": {"of": null, "concepts": [-0.5, 1, 0, 0, 0.9]}}"#.into())).unwrap();
    let why = line(&mut page, "why", |_| true);
    assert_eq!((&why["concept"], &why["activation"]), (&"kindness".into(), &json!(0.899993896484375)));
    page.send(Message::Text(r#"{"why": {"of": "press", "concepts": []}}"#.into())).unwrap();
    line(&mut page, "none", |line| line["of"] == "why");
    page.send(Message::Text(r#"{"hover": 0}"#.into())).unwrap();
    assert_eq!(
        line(&mut page, "taxel", |line| line["taxel"] == 0 && !line["code"].is_null())["wired_row"],
        0
    );
    run.join().unwrap();
}

#[test]
fn a_page_that_says_too_much_goes_and_the_others_stay() {
    let (hub, port) = served();
    let (mut bad, mut good) = (page(port), page(port));
    hub.say(&Said::note("here"));
    line(&mut bad, "say", |_| true);
    line(&mut good, "say", |_| true);
    let _ = bad.send(Message::Text("x".repeat(100_000).into()));
    while bad.read().is_ok() {}
    hub.say(&Said::note("still here"));
    line(&mut good, "say", |line| line["said"] == "still here");
    // Its threads end shortly after.
    let gone = (0..2000).any(|_| {
        thread::sleep(Duration::from_millis(5));
        hub.pages() == 1
    });
    assert!(gone, "{} pages", hub.pages());
}

#[test]
fn a_page_that_does_not_read_is_waited_for_by_nobody() {
    let (hub, port) = served();
    let (mut dead, mut alive) = (page(port), page(port));
    let reader = thread::spawn(move || {
        let mut last = 0;
        while last < 1500 {
            if let PageMessage::Image { head, .. } = next(&mut alive) {
                last = head["frame"].as_u64().unwrap();
            }
        }
    });
    // Images so large that a few dozen of them fill the buffers of a connection.
    let image: Arc<[u16]> = vec![7; usize::from(u16::MAX)].into();
    for number in 1..=1500u64 {
        hub.shot(&Shot { line: number.to_string().into(), image: image.clone(), time_us: number, total: 0 });
        thread::sleep(Duration::from_millis(2));
    }
    reader.join().unwrap();
    // Messages in transit arrive, then the newest.
    let (mut numbers, mut missed) = (Vec::new(), 0);
    while numbers.last() != Some(&1500) {
        if let PageMessage::Image { head, .. } = next(&mut dead) {
            numbers.push(head["frame"].as_u64().unwrap());
            missed = head["missed"].as_u64().unwrap();
        }
    }
    // On a busy machine there are several gaps. As many samples as are kept arrive with the image after each;
    // the others are counted.
    let gaps = numbers.windows(2).map(|pair| pair[1] - pair[0]);
    assert!(gaps.clone().max() > Some(256), "{numbers:?}");
    assert_eq!(missed, gaps.map(|gap| gap.saturating_sub(256)).sum::<u64>());
}

#[test]
fn pages_see_the_garment_on_the_robot_and_what_presses_there() {
    let (hub, port) = served();
    hub.show_robot(ShownRobot::read("reference", Some("reference"), "left_elbow=90deg").unwrap());
    let mut page = page(port);
    let run = watched(&hub, "sim:five", 200, true);
    let body = line(&mut page, "body", |_| true);
    let links = body["links"].as_array().unwrap();
    assert_eq!((&links[0]["name"], &links[0]["parent"]), (&"base_link".into(), &Value::Null));
    let torso = links.iter().position(|link| link["name"] == "torso").unwrap();
    // The first taxel of the chest: on the torso, 61 mm from its axis, facing away from it.
    let [link, at, normal] = &body["taxels"][0].as_array().unwrap()[..] else {
        panic!("{}", body["taxels"][0])
    };
    let number = |value: &Value| value.as_f64().unwrap();
    assert_eq!(link, torso);
    assert!((number(&at[0]).hypot(number(&at[1])) - 0.06112).abs() < 1e-5, "{at}");
    assert!(number(&at[0]) * number(&normal[0]) + number(&at[1]) * number(&normal[1]) > 0.06, "{normal}");
    assert_eq!(body["taxels"].as_array().unwrap().len(), 2048);
    // Each link has a pose; that of the hand is the elbow's.
    let poses = line(&mut page, "poses", |_| true);
    assert_eq!(poses["links"].as_object().unwrap().len(), links.len());
    let turn = &poses["links"]["left_hand"]["turn"];
    assert!((number(&turn[3]) - std::f64::consts::FRAC_1_SQRT_2).abs() < 1e-9, "{turn}");
    // The board has no body: what presses is computed.
    let pressing = loop {
        if let PageMessage::Image { head, .. } = next(&mut page)
            && head["frame"]["contacts"].as_array().is_some_and(|contacts| contacts.len() == 5)
        {
            assert_eq!(head["frame"]["pressing"]["frame"], head["frame"]["frame"]);
            break head["frame"]["pressing"].clone();
        }
    };
    assert_eq!(pressing["contacts"].as_array().unwrap().len(), 5);
    let pressed: Vec<&str> =
        pressing["links"].as_array().unwrap().iter().map(|link| link["link"].as_str().unwrap()).collect();
    assert_eq!(pressed, ["torso", "left_upper_arm", "right_upper_arm"]);
    run.join().unwrap();
    // A page that comes late sees it, too, and so do the images from before.
    let mut late = self::page(port);
    line(&mut late, "body", |_| true);
    let figure = line(&mut late, "figure", |_| true);
    let shape = figure["links"].as_array().unwrap().iter().find(|link| link["name"] == "torso").unwrap();
    let count = |key: &str| shape[key].as_array().unwrap().len();
    assert!(count("points") > 40 && count("triangles") > 80, "{shape}");
    line(&mut late, "poses", |_| true);
    let PageMessage::Image { head, .. } = std::iter::repeat_with(|| next(&mut late))
        .find(|shown| matches!(shown, PageMessage::Image { .. }))
        .unwrap()
    else {
        panic!("no image")
    };
    assert_eq!((&head["frame"]["past"], head["frame"]["pressing"].is_object()), (&true.into(), true));
}

#[test]
fn cloth_that_slides_is_reported_again() {
    let folder = std::env::temp_dir().join(format!("taxel-slides-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let file = folder.join("slides.toml");
    let text = "[[patches]]\npanel = \"left arm\"\nslides = [{ joint = \"left_elbow\", down = 0.005 }]\n\
                on.cone = { at = [0, 0, -0.16], axis = [0, 0, -1], radius = 0.04, angle = 1.5, facing = [0, 1, 0] }\n";
    std::fs::write(&file, text).unwrap();
    let (hub, port) = served();
    let shown_robot = ShownRobot::read(file.to_str().unwrap(), Some("reference"), "").unwrap();
    hub.show_robot(shown_robot);
    let mut page = page(port);
    let run = watched(&hub, "sim:idle", 20, false);
    // Row 15, column 8 of the left arm; the chest has no place.
    let height = |body: &Value| body["taxels"][2 * 512 + 15 * 16 + 8][1][2].as_f64().unwrap();
    let body = line(&mut page, "body", |_| true);
    assert!(body["taxels"][0].is_null());
    let before = height(&body);
    run.join().unwrap();
    hub.joints(&[("left_elbow".into(), 1.0)]).unwrap();
    let slid = height(&line(&mut page, "body", |body| height(body) != before));
    // 5 mm along the cloth, which narrows by 1.5 degrees.
    assert!((before - slid - 0.005).abs() < 1e-5, "{before} to {slid}");
    std::fs::remove_dir_all(folder).unwrap();
}

#[test]
fn a_body_that_does_not_fit_the_garment_is_named() {
    let (hub, _) = served();
    hub.show_robot(ShownRobot::read("reference", None, "").unwrap());
    let args = WatchOptions::of("sim:idle".parse().unwrap());
    let options =
        SourceOptions { garment: Some("mat-64x32".into()), frames: Some(9), ..SourceOptions::default() };
    let source = source::open(&args.board.source(), &options).unwrap();
    let mut viewer = Viewer::new(hub, None);
    let error = watch(&args, source, &mut viewer).unwrap_err();
    let text = format!("{error:#}");
    assert!(
        text.starts_with("reference, line ") && text.contains("must be a panel of the garment: mat"),
        "{text}"
    );
}
