//! A board that can be unplugged.

use std::io::{Read, Write};
use std::net::{TcpListener, TcpStream};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};
use taxel::source::{self, SourceOptions};

/// Longest wait for a program that follows a board.
const PATIENCE: Duration = Duration::from_secs(60);

/// A place behind TCP into which a simulated board of any garment can be plugged; each connection finds it just
/// after power-up.
pub struct Socket {
    pub address: String,
    plugged: Arc<Mutex<Plugged>>,
}

#[derive(Default)]
struct Plugged {
    garment: Option<&'static str>,
    /// Number of times that something was plugged in or out: older connections are cut.
    times: u64,
    /// Bytes that the plugged board has sent.
    sent: usize,
}

impl Socket {
    pub fn new(garment: &'static str) -> Socket {
        let listener = TcpListener::bind("127.0.0.1:0").unwrap();
        let address = listener.local_addr().unwrap().to_string();
        let plugged = Arc::new(Mutex::new(Plugged { garment: Some(garment), ..Plugged::default() }));
        let known = plugged.clone();
        std::thread::spawn(move || {
            for stream in listener.incoming() {
                serve(stream.unwrap(), &known);
            }
        });
        Socket { address, plugged }
    }

    pub fn plug(&self, garment: Option<&'static str>) {
        let mut plugged = self.plugged.lock().unwrap();
        *plugged = Plugged { garment, times: plugged.times + 1, sent: 0 };
    }

    /// Waits until the board that is plugged in has sent enough to be known.
    pub fn await_client(&self) {
        let until = Instant::now() + PATIENCE;
        while self.plugged.lock().unwrap().sent < 50_000 {
            assert!(Instant::now() < until, "nobody follows the board");
            std::thread::sleep(Duration::from_millis(5));
        }
    }
}

/// Passes bytes between a connection and a simulated board until the board is unplugged.
fn serve(mut stream: TcpStream, plugged: &Mutex<Plugged>) {
    let (garment, times) = {
        let plugged = plugged.lock().unwrap();
        (plugged.garment, plugged.times)
    };
    let Some(garment) = garment else { return };
    let options = SourceOptions {
        garment: Some(garment.into()),
        realtime: true,
        repeat: true,
        ..SourceOptions::default()
    };
    let mut board = source::open(&"sim:press".parse().unwrap(), &options).unwrap();
    stream.set_read_timeout(Some(Duration::from_millis(1))).unwrap();
    let mut buffer = [0; 4096];
    while plugged.lock().unwrap().times == times {
        match stream.read(&mut buffer) {
            Ok(0) => return,
            Ok(count) => drop(board.port.write(&buffer[..count]).unwrap()),
            Err(_) => {}
        }
        let Ok(Some(count)) = board.port.read(&mut buffer) else { return };
        if stream.write_all(&buffer[..count]).is_err() {
            return;
        }
        let mut plugged = plugged.lock().unwrap();
        plugged.sent += if plugged.times == times { count } else { 0 };
    }
}
