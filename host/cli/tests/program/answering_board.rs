//! A board that answers all requests and sends no image. On a USB it tells the last start of a frame after each round
//! trip.

use serde::ser::{Serialize, SerializeTuple, Serializer};
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
/// A report with its number.
struct Numbered<'a>(u32, &'a [u8]);

impl Serialize for Numbered<'_> {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        let mut tuple = to.serialize_tuple(1 + self.1.len())?;
        tuple.serialize_element(&self.0)?;
        self.1.iter().try_for_each(|byte| tuple.serialize_element(byte))?;
        tuple.end()
    }
}

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
        self.began.elapsed().as_micros() as u64
    }

    fn send(&mut self, report: &[u8]) {
        let mut room = [0; frame_bound(LONGEST)];
        // Whoever has heard enough is gone.
        _ = self.link.write_all(encode(&Numbered(self.seq, report), &mut room).unwrap());
        self.seq += 1;
    }

    fn answer(&mut self, request: &Request<'_>, hello: &[u8]) {
        if let Request::Sync { token } = request {
            let now_us = self.now_us();
            let [received, sent] = [Micros(now_us); 2];
            let sync = Report::Sync(SyncReport { token: *token, received, sent });
            self.send(&postcard::to_allocvec(&sync).unwrap());
            let Some(first) = self.first else { return };
            let (frame, noticed) = (now_us / 1000, Micros(now_us / 1000 * 1000));
            let number = ((first + frame) % 2048) as u16;
            let start = Report::StartOfFrame(StartOfFrame { number, noticed, late_us: 1 });
            return self.send(&postcard::to_allocvec(&start).unwrap());
        }
        if matches!(request, Request::Start) {
            self.send(hello);
        }
        let answer = Report::Answer(Answer { request: request.number(), refusal: None });
        self.send(&postcard::to_allocvec(&answer).unwrap());
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
