//! A board that a thread offers, in a network of its own on this machine.

use crate::rig::{Rig, source};
use serde_json::{Value, json};
use std::net::TcpListener;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, Mutex};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};
use taxel::client::{Event, Stamps};
use taxel::network::{self, BoardPlace, NetworkEnd};
use taxel::offer::BoardOffer;
use taxel::session::{Observer, Poll, Session};
use taxel::source::{self, SourceOptions, SourceSpec};
use zenoh::Wait;

/// Longest wait for what a test expects.
pub const PATIENCE: Duration = Duration::from_secs(20);

/// Files by which programs meet on a port of this machine.
pub struct Network {
    pub router: PathBuf,
    pub client: PathBuf,
}

impl Network {
    /// A network that nobody else is in.
    pub fn new() -> Network {
        static NUMBER: AtomicU64 = AtomicU64::new(0);
        let number = NUMBER.fetch_add(1, Ordering::Relaxed);
        let port = TcpListener::bind("127.0.0.1:0").unwrap().local_addr().unwrap().port();
        let meeting = format!("tcp/127.0.0.1:{port}");
        let file = |name: &str, text: String| {
            let path = folder().join(format!("{number}-{name}.json5"));
            std::fs::write(&path, text).unwrap();
            path
        };
        let router = json!({ "mode": "router", "listen": { "endpoints": [meeting] } });
        let client = json!({ "mode": "client", "connect": { "endpoints": [meeting] } });
        Network { router: file("router", router.to_string()), client: file("client", client.to_string()) }
    }

    /// Follows the board, once it is offered.
    pub fn view(&self) -> Session {
        let until = Instant::now() + PATIENCE;
        loop {
            match self.source() {
                Ok(source) => return Session::over(source).unwrap(),
                // A busy machine begins the offer later than a viewer looks for one.
                Err(error) => assert!(Instant::now() < until, "{error}"),
            }
        }
    }

    /// The board as a source.
    pub fn source(&self) -> taxel::Result<source::Source> {
        let spec: SourceSpec = format!("zenoh:arm/left@{}", self.client.display()).parse().unwrap();
        source::open(&spec, &SourceOptions::default())
    }

    /// A session of another program.
    pub fn other(&self) -> zenoh::Session {
        zenoh::open(zenoh::Config::from_file(&self.client).unwrap()).wait().unwrap()
    }
}

/// State of the offered board, as another program gets it.
pub fn state(other: &zenoh::Session) -> Value {
    let reply = other.get(place().state()).wait().unwrap().recv().unwrap();
    serde_json::from_slice(&reply.result().unwrap().payload().to_bytes()).unwrap()
}

/// Folder for files of these tests.
pub fn folder() -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("zenoh");
    std::fs::create_dir_all(&folder).unwrap();
    folder
}

/// The board's name.
pub fn place() -> BoardPlace {
    "arm/left".parse().unwrap()
}

/// A board that is offered until this is dropped.
pub struct Offered {
    pub rig: Arc<Mutex<Rig>>,
    /// All bytes that the board has sent.
    pub sent: Arc<Mutex<Vec<u8>>>,
    ends: Arc<AtomicBool>,
    thread: Option<JoinHandle<()>>,
}

impl Offered {
    /// Offers a new board.
    pub fn begin(network: &Network) -> Offered {
        Offered::of(network, Arc::new(Mutex::new(Rig::new())))
    }

    /// Offers this board.
    pub fn of(network: &Network, rig: Arc<Mutex<Rig>>) -> Offered {
        let session = network::open(NetworkEnd::Offer, Some(&network.router)).unwrap();
        let mut offer = BoardOffer::open(&session, &place()).unwrap();
        let (ends, sent) = (Arc::new(AtomicBool::new(false)), Arc::<Mutex<Vec<u8>>>::default());
        let (reported, kept, board) = (ends.clone(), sent.clone(), source(&rig));
        let thread = std::thread::spawn(move || {
            let mut session = Session::over(board).unwrap();
            while !reported.load(Ordering::Relaxed) {
                turn(&mut session, &mut offer, &kept).unwrap();
            }
            let stamp = Stamps::start().now(session.client());
            offer.ended(session.client(), stamp).unwrap();
        });
        Offered { rig, sent, ends, thread: Some(thread) }
    }
}

impl Drop for Offered {
    fn drop(&mut self) {
        self.ends.store(true, Ordering::Relaxed);
        let ended = self.thread.take().map(JoinHandle::join);
        assert!(std::thread::panicking() || ended.is_some_and(|ended| ended.is_ok()));
    }
}

/// Handles what has come, as the program does.
fn turn(session: &mut Session, offer: &mut dyn Observer, sent: &Mutex<Vec<u8>>) -> taxel::Result<()> {
    while let Poll::Event(event) = session.poll()? {
        let client = session.client();
        client.lines().for_each(|line| sent.lock().unwrap().extend_from_slice(line));
        let stamp = Stamps::start().of(client, &event);
        offer.event(client, &event, stamp)?;
    }
    offer.idle(session.parts().0)
}

/// Waits for an event that `is` what is expected, and returns it.
pub fn wait_for(session: &mut Session, what: &str, mut is: impl FnMut(&Event) -> bool) -> Event {
    let until = Instant::now() + PATIENCE;
    while Instant::now() < until {
        match session.poll().unwrap() {
            Poll::Event(event) if is(&event) => return event,
            Poll::End => panic!("the stream ended before {what}"),
            _ => {}
        }
    }
    panic!("there was no {what}")
}

/// Waits for a remark of the host that holds these words.
pub fn wait_for_words(session: &mut Session, words: &str) -> String {
    let holds = |event: &Event| event.remark().is_some_and(|text| text.contains(words));
    wait_for(session, words, holds).remark().unwrap_or_default().to_string()
}
