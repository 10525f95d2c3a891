//! A board served over TCP, touched at random, with occasional disconnections, restarts and bit errors.

use crate::session::rig::Rig;
use std::io::{ErrorKind, Read, Write};
use std::net::{TcpListener, TcpStream};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};
use taxel_core::format::Code;

/// Number of breaks.
static BREAKS: AtomicUsize = AtomicUsize::new(0);

/// Number of breaks over all boards.
pub fn breaks() -> usize {
    BREAKS.load(Ordering::Relaxed)
}

/// A frame of the wire as sent by a board, including its 0x00.
#[derive(Debug, Clone)]
pub struct Sent {
    pub bytes: Vec<u8>,
    pub at: Instant,
    /// A bit was flipped on the way.
    pub is_damaged: bool,
}

/// An event on a link.
#[derive(Debug, Clone)]
pub enum Happened {
    /// The link was opened.
    Opened,
    Sent(Sent),
    /// The link was cut, or the board restarted.
    Broken(Instant),
}

/// A board being served.
pub struct Served {
    history: Arc<Mutex<Vec<Happened>>>,
    address: String,
}

impl Served {
    /// Serves a board, and breaks it at times.
    pub fn begin(seed: u64) -> Served {
        let listener = TcpListener::bind("127.0.0.1:0").unwrap();
        let address = listener.local_addr().unwrap().to_string();
        let rig = Arc::new(Mutex::new(Rig::new()));
        let history = Arc::new(Mutex::new(Vec::new()));
        let (served, shared) = (rig.clone(), history.clone());
        std::thread::spawn(move || {
            let mut random = fastrand::Rng::with_seed(seed);
            for stream in listener.incoming() {
                pass(stream.unwrap(), &served, &shared, &mut random);
            }
        });
        let shared = history.clone();
        std::thread::spawn(move || trouble(&rig, &shared, fastrand::Rng::with_seed(!seed)));
        Served { history, address }
    }

    /// The board as a source.
    pub fn spec(&self) -> String {
        format!("tcp:{}", self.address)
    }

    /// Events so far.
    pub fn sent(&self) -> Vec<Happened> {
        self.history.lock().unwrap().clone()
    }
}

/// Touches the board ten times per second, and breaks something every few seconds.
fn trouble(rig: &Mutex<Rig>, history: &Mutex<Vec<Happened>>, mut random: fastrand::Rng) {
    let mut next = Instant::now() + Duration::from_secs(5);
    loop {
        std::thread::sleep(Duration::from_millis(100));
        let mut rig = rig.lock().unwrap();
        rig.codes = [Code(100); 64];
        let (first, width) = (random.usize(..60), random.usize(..4));
        rig.codes[first..first + width].fill(Code(random.u16(100..4000)));
        if Instant::now() < next {
            continue;
        }
        next = Instant::now() + Duration::from_millis(random.u64(2_000..10_000));
        BREAKS.fetch_add(1, Ordering::Relaxed);
        history.lock().unwrap().push(Happened::Broken(Instant::now()));
        let what = random.u8(..3);
        if what != 0 {
            rig.restart();
        }
        if what != 1 {
            rig.cut();
        }
    }
}

/// Passes bytes between a connection and the board until its link is cut. One bit in some 100 KB is flipped.
fn pass(mut stream: TcpStream, rig: &Mutex<Rig>, history: &Mutex<Vec<Happened>>, random: &mut fastrand::Rng) {
    stream.set_read_timeout(Some(Duration::from_millis(1))).unwrap();
    let link = rig.lock().unwrap().link;
    history.lock().unwrap().push(Happened::Opened);
    let (mut buffer, mut frame, mut is_damaged) = ([0; 1024], Vec::new(), false);
    loop {
        match stream.read(&mut buffer) {
            Ok(0) => return,
            Ok(count) => rig.lock().unwrap().receive(&buffer[..count]),
            Err(error) if matches!(error.kind(), ErrorKind::WouldBlock | ErrorKind::TimedOut) => {}
            Err(_) => return,
        }
        let count = {
            let mut rig = rig.lock().unwrap();
            if rig.link != link {
                return;
            }
            rig.speak(&mut buffer)
        };
        let flipped = (random.u32(..100_000) < count as u32).then(|| random.usize(..count));
        let flipped = flipped.filter(|at| buffer[*at] != 0);
        for (at, byte) in buffer[..count].iter().enumerate() {
            frame.push(*byte);
            is_damaged |= flipped == Some(at);
            if *byte == 0 {
                let sent = Sent { bytes: std::mem::take(&mut frame), at: Instant::now(), is_damaged };
                history.lock().unwrap().push(Happened::Sent(sent));
                is_damaged = false;
            }
        }
        if let Some(at) = flipped {
            // The change creates no delimiter.
            buffer[at] ^= if buffer[at] == 1 { 2 } else { 1 };
        }
        if stream.write_all(&buffer[..count]).is_err() {
            return;
        }
    }
}
