//! Boards behind TCP that play a stream at its own time and answer what a board must answer.

use super::stream::Stream;
use anyhow::{Context, Result};
use clap::Args;
use serde::ser::{Serialize, SerializeTuple, Serializer};
use std::io::{ErrorKind, Read, Write};
use std::net::{Ipv4Addr, TcpListener, TcpStream};
use std::path::PathBuf;
use std::sync::mpsc::{Sender, channel};
use std::thread;
use std::time::{Duration, Instant};
use taxel_core::format::Micros;
use taxel_core::wire::{
    Answer, LONGEST_REQUEST, Receiver, Report, Request, SyncReport, decode, encode, frame_bound,
};

/// Longest message of a board.
const LONGEST: usize = 8192;
/// Longest wait before requests are read again.
const LOOK: Duration = Duration::from_millis(10);

/// Arguments of a player.
#[derive(Debug, Clone, Args)]
pub struct PlayArgs {
    /// Stream to play
    stream: PathBuf,
    /// Number of boards
    boards: usize,
}

/// Plays boards until nobody listens any longer. Prints their ports, and once all are played the latest of their
/// messages, us behind its time.
pub fn run(args: &PlayArgs) -> Result<()> {
    let stream = Stream::read(&args.stream)?;
    let boards: Result<Vec<_>, _> =
        (0..args.boards).map(|_| TcpListener::bind((Ipv4Addr::LOCALHOST, 0))).collect();
    let boards = boards.context("no port is free")?;
    let ports: Result<Vec<_>, _> = boards.iter().map(TcpListener::local_addr).collect();
    println!("{}", ports?.iter().map(|at| at.port().to_string()).collect::<Vec<_>>().join(" "));
    let (played, late) = channel();
    thread::scope(|scope| {
        for board in boards {
            let (stream, played) = (&stream, played.clone());
            scope.spawn(move || serve(&board, stream, &played));
        }
        let latest = late.iter().take(args.boards).max().unwrap_or_default();
        println!("{}", latest.as_micros());
    });
    Ok(())
}

/// Plays a board to whoever connects first; says once it is played by how much its latest message was late. Ends
/// when the connection does.
pub fn serve(listener: &TcpListener, stream: &Stream, played: &Sender<Duration>) -> Result<()> {
    let (link, _) = listener.accept()?;
    link.set_nodelay(true)?;
    let mut player = Player {
        link,
        stream,
        requests: Receiver::new(),
        seq: 0,
        begun: None,
        next: 0,
        outgoing: Vec::new(),
        late: Duration::ZERO,
    };
    while player.hear()? {
        let rest = player.play()?;
        player.link.write_all(&player.outgoing)?;
        player.outgoing.clear();
        if rest.is_none() && player.next == stream.messages.len() {
            player.next += 1;
            // Whoever listens may be gone.
            let _ = played.send(player.late);
        }
        thread::sleep(rest.unwrap_or(LOOK).min(LOOK));
    }
    Ok(())
}

/// A board.
struct Player<'a> {
    link: TcpStream,
    stream: &'a Stream,
    requests: Receiver<{ frame_bound(LONGEST_REQUEST) }>,
    seq: u32,
    /// When it was asked to start.
    begun: Option<Instant>,
    /// Number of the next message.
    next: usize,
    /// What is to be sent: all that is due leaves together, as from a board's ring.
    outgoing: Vec<u8>,
    late: Duration,
}

/// A message with its number; the bytes of the report are as they are on the wire.
struct Numbered<'a>(u32, &'a [u8]);

impl Serialize for Numbered<'_> {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        let mut tuple = to.serialize_tuple(1 + self.1.len())?;
        tuple.serialize_element(&self.0)?;
        self.1.iter().try_for_each(|byte| tuple.serialize_element(byte))?;
        tuple.end()
    }
}

impl Player<'_> {
    /// Reads and answers requests. Returns false once the connection is closed.
    fn hear(&mut self) -> Result<bool> {
        let mut buffer = [0; 512];
        self.link.set_nonblocking(true)?;
        let read = self.link.read(&mut buffer);
        self.link.set_nonblocking(false)?;
        let count = match read {
            Ok(0) => return Ok(false),
            Ok(count) => count,
            Err(error) if error.kind() == ErrorKind::WouldBlock => return Ok(true),
            Err(error) if error.kind() == ErrorKind::ConnectionReset => return Ok(false),
            Err(error) => return Err(error.into()),
        };
        let received = Instant::now();
        for byte in &buffer[..count] {
            let Some(message) = self.requests.push(*byte) else { continue };
            let message = message?.to_vec();
            self.answer(&decode(&message)?, received)?;
        }
        Ok(true)
    }

    fn answer(&mut self, request: &Request<'_>, received: Instant) -> Result<()> {
        if let Request::Sync { token } = request {
            let [received, sent] = [received, Instant::now()].map(|at| self.time(at));
            let report = Report::Sync(SyncReport { token: *token, received, sent });
            return self.send(&postcard::to_allocvec(&report)?);
        }
        if matches!(request, Request::Start) {
            self.begun.get_or_insert(received);
            let stream = self.stream;
            self.send(&stream.hello)?;
        }
        let answer = Report::Answer(Answer { request: request.number(), refusal: None });
        self.send(&postcard::to_allocvec(&answer)?)
    }

    /// The board's time of a moment.
    fn time(&self, at: Instant) -> Micros {
        let passed = self.begun.map_or(Duration::ZERO, |begun| at.saturating_duration_since(begun));
        Micros(self.stream.messages.first().map_or(0, |(first, _)| *first) + passed.as_micros() as u64)
    }

    /// Sends what is due. Returns the time until the next message; none if there is none.
    fn play(&mut self) -> Result<Option<Duration>> {
        let stream = self.stream;
        while self.begun.is_some()
            && let Some((at_us, report)) = stream.messages.get(self.next)
        {
            let now = self.time(Instant::now());
            if *at_us > now.0 {
                return Ok(Some(Duration::from_micros(*at_us - now.0)));
            }
            self.late = self.late.max(Duration::from_micros(now.0 - *at_us));
            self.next += 1;
            self.send(report)?;
        }
        Ok(None)
    }

    fn send(&mut self, report: &[u8]) -> Result<()> {
        let mut room = [0; frame_bound(LONGEST)];
        self.outgoing.extend_from_slice(encode(&Numbered(self.seq, report), &mut room)?);
        self.seq = self.seq.wrapping_add(1);
        Ok(())
    }
}
