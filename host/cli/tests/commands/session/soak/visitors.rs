//! Programs that watch and reconfigure a board all the time.

use super::served::Served;
use std::io::{BufRead, BufReader};
use std::net::TcpStream;
use std::process::Child;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};
use taxel::client::Event;
use taxel::session::{Poll, Returns, Session};
use taxel::source::{self, SourceOptions};
use taxel_core::format::name;
use taxel_core::garment::Garment;
use taxel_core::scene::Scene;
use taxel_core::wire::Request;
use tungstenite::Message;
use tungstenite::client::IntoClientRequest;

/// A visitor that a flag ends, and its count.
struct Visitor {
    ends: Arc<AtomicBool>,
    thread: JoinHandle<usize>,
}

impl Visitor {
    fn begin(visit: impl FnOnce(&AtomicBool) -> usize + Send + 'static) -> Visitor {
        let ends = Arc::new(AtomicBool::new(false));
        let shared = ends.clone();
        Visitor { ends, thread: std::thread::spawn(move || visit(&shared)) }
    }

    fn end(self) -> usize {
        self.ends.store(true, Ordering::Relaxed);
        self.thread.join().unwrap()
    }
}

/// A user who opens the page, moves the mouse over taxels, tares, leaves, and comes back.
pub struct Page(Visitor);

impl Page {
    pub fn visit(viewer: &mut Child) -> Page {
        let mut lines = BufReader::new(viewer.stdout.take().unwrap()).lines();
        let line = lines.find_map(|line| line.ok().filter(|line| line.contains("http://"))).unwrap();
        let host = line.split("http://").nth(1).unwrap().split('/').next().unwrap().to_string();
        Page(Visitor::begin(move |ends| {
            // Its output is read to the end.
            std::thread::spawn(move || lines.for_each(drop));
            let mut random = fastrand::Rng::with_seed(7);
            let mut count = 0;
            while !ends.load(Ordering::Relaxed) {
                count += look(&host, &mut random, ends);
            }
            count
        }))
    }

    /// Number of messages received.
    pub fn leave(self) -> usize {
        self.0.end()
    }
}

/// Reads all lines of a program. Returns their number.
pub fn listen(program: &mut Child) -> JoinHandle<usize> {
    let lines = BufReader::new(program.stdout.take().unwrap()).lines();
    std::thread::spawn(move || lines.map_while(Result::ok).count())
}

/// One visit of the page.
fn look(host: &str, random: &mut fastrand::Rng, ends: &AtomicBool) -> usize {
    let stream = TcpStream::connect(host).unwrap();
    stream.set_read_timeout(Some(Duration::from_secs(60))).unwrap();
    let request = format!("ws://{host}/socket").into_client_request().unwrap();
    let (mut page, _) = tungstenite::client(request, stream).unwrap();
    let leaves = Instant::now() + Duration::from_millis(random.u64(100..20_000));
    let mut count = 0;
    while Instant::now() < leaves && !ends.load(Ordering::Relaxed) {
        page.read().unwrap();
        count += 1;
        let request = match random.u16(..1000) {
            0..=9 => format!(r#"{{"hover": {}}}"#, random.u8(..64)),
            10..=14 => r#"{"hover": null}"#.into(),
            15 => r#"{"tare": 16}"#.into(),
            _ => continue,
        };
        page.send(Message::text(request)).unwrap();
    }
    _ = page.close(None);
    count
}

/// A program that sets another scene or garment every second.
pub struct Setter(Visitor);

impl Setter {
    pub fn begin(board: &Served) -> Setter {
        let spec = board.spec();
        Setter(Visitor::begin(move |ends| {
            let source = source::open(&spec.parse().unwrap(), &SourceOptions::default()).unwrap();
            let mut session = Session::new(source, Returns::Always);
            let mut random = fastrand::Rng::with_seed(9);
            session.parts().0.start(0).unwrap();
            let mut answers = 0;
            let mut asked = Instant::now();
            while !ends.load(Ordering::Relaxed) {
                if let Poll::Event(Event::Answer { request, refusal: None }) = session.poll().unwrap() {
                    answers += usize::from([5, 6].contains(&request));
                }
                if asked.elapsed() > Duration::from_secs(1) {
                    asked = Instant::now();
                    let client = session.parts().0;
                    client.request(&Request::SetScene(&scene(&mut random))).unwrap();
                    if random.u8(..4) == 0 {
                        client.request(&Request::SetGarment(&garment(&mut random))).unwrap();
                    }
                }
            }
            answers
        }))
    }

    /// Number of changes that the board accepted.
    pub fn end(self) -> usize {
        self.0.end()
    }
}

fn scene(random: &mut fastrand::Rng) -> Vec<u8> {
    let mut scene = Scene { name: name(["one", "two", "three"][random.usize(..3)]), ..Scene::shipped() };
    scene.contact.high += random.u16(..40);
    postcard::to_allocvec(&scene).unwrap()
}

fn garment(random: &mut fastrand::Rng) -> Vec<u8> {
    let garment = Garment { name: name(["mine", "yours"][random.usize(..2)]), ..Garment::block() };
    postcard::to_allocvec(&garment).unwrap()
}
