//! A board that has been on for an hour, answers all requests and sends no image. On a USB it reports the last
//! start of a frame after each round trip.

use std::io::{Read, Write};
use std::net::{SocketAddr, TcpListener, TcpStream};
use std::thread;
use std::time::Instant;
use taxel::session::Session;
use taxel::source::{self, SourceOptions};
use taxel_core::format::Micros;
use taxel_core::wire::{
    self, Answer, LONGEST_REQUEST, Receiver, Report, Request, StartOfFrame, SyncReport, encode, frame_bound,
};

/// Longest message of these boards.
const LONGEST: usize = 8192;
/// Time for which they were on before anybody asked, us: an hour.
const ON_US: u64 = 3_600_000_000;

/// What a board says first.
fn hello() -> Vec<u8> {
    let board = source::open(&"sim:idle".parse().unwrap(), &SourceOptions::default()).unwrap();
    let mut session = Session::over(board).unwrap();
    loop {
        session.wait().unwrap().expect("it has not ended");
        for line in session.client().lines() {
            let mut line = line.to_vec();
            line.pop();
            let (_, report) = postcard::take_from_bytes::<u32>(wire::open(&mut line).unwrap()).unwrap();
            if postcard::take_from_bytes::<u32>(report).unwrap().0 == Report::HELLO {
                return report.to_vec();
            }
        }
    }
}

/// Plugs one in. `first`: the number of its USB's frame at that time; none if it is on no USB. Returns its address.
pub fn answering_board(began: Instant, first: Option<u64>) -> SocketAddr {
    let listener = TcpListener::bind("127.0.0.1:0").unwrap();
    let address = listener.local_addr().unwrap();
    thread::spawn(move || {
        for link in listener.incoming() {
            AnsweringBoard { link: link.unwrap(), first, began, seq: 0 }.serve(&hello());
        }
    });
    address
}

struct AnsweringBoard {
    link: TcpStream,
    first: Option<u64>,
    began: Instant,
    seq: u32,
}

impl AnsweringBoard {
    fn now_us(&self) -> u64 {
        ON_US + self.began.elapsed().as_micros() as u64
    }

    fn send(&mut self, report: &Report<'_>) {
        let mut room = [0; frame_bound(LONGEST)];
        // Whoever has heard enough is gone.
        _ = self.link.write_all(encode(&(self.seq, report), &mut room).unwrap());
        self.seq += 1;
    }

    fn answer(&mut self, request: &Request<'_>, hello: &[u8]) {
        if let Request::Sync { token } = request {
            let now_us = self.now_us();
            let [received, sent] = [Micros(now_us); 2];
            let sync = Report::Sync(SyncReport { token: *token, received, sent });
            self.send(&sync);
            let Some(first) = self.first else { return };
            let (frame, noticed) = (now_us / 1000, Micros(now_us / 1000 * 1000));
            let number = ((first + frame) % 2048) as u16;
            let start = Report::StartOfFrame(StartOfFrame { number, noticed, late_us: 1 });
            return self.send(&start);
        }
        if matches!(request, Request::Start) {
            let Report::Hello(mut hello) = postcard::from_bytes(hello).unwrap() else { panic!("no Hello") };
            let now = postcard::to_allocvec(&Micros(self.now_us())).unwrap();
            hello.clock = &now;
            self.send(&Report::Hello(hello));
        }
        let answer = Report::Answer(Answer { request: request.number(), refusal: None });
        self.send(&answer);
    }

    fn serve(mut self, hello: &[u8]) {
        let mut requests = Receiver::<{ frame_bound(LONGEST_REQUEST) }>::new();
        let mut buffer = [0; 512];
        while let Ok(count @ 1..) = self.link.read(&mut buffer) {
            for byte in &buffer[..count] {
                let Some(message) = requests.push(*byte) else { continue };
                let message = message.unwrap().to_vec();
                self.answer(&wire::decode(&message).unwrap(), hello);
            }
        }
    }
}
