//! The board as a list of inputs.

mod folds;
mod requests;
mod settings;
mod stream;
mod surface;
mod tables;

pub use surface::flat;

use taxel_core::acquire::{Scan, ScanReport};
use taxel_core::board::{Board, BoardInfo, Input, Job};
use taxel_core::format::{Code, Micros};
use taxel_core::garment::Garment;
use taxel_core::scene::Scene;
use taxel_core::wire::{self, Receiver, Report, Request};

const TAXELS: usize = 64;
type Small = Board<TAXELS, 32>;

/// A board in one hand and a host in the other.
pub struct BoardAndHost {
    pub board: Box<Small>,
    pub now: u64,
    codes: [Code; TAXELS],
    receiver: Box<Receiver<8192>>,
    next_seq: Option<u32>,
}

fn info() -> BoardInfo {
    BoardInfo::feather("test 1.0")
}

impl BoardAndHost {
    pub fn new(scene: Scene) -> BoardAndHost {
        let board = Small::new(info(), Garment::block(), scene).expect("garment and scene fit");
        BoardAndHost {
            board: Box::new(board),
            now: 0,
            codes: [Code(0); TAXELS],
            receiver: Box::new(Receiver::new()),
            next_seq: None,
        }
    }

    pub fn ask(&mut self, request: &Request<'_>) {
        let mut frame = [0; 4200];
        let frame = wire::encode(request, &mut frame).expect("it fits");
        // In uneven pieces, as a UART delivers them.
        for piece in frame.chunks(7) {
            assert_eq!(self.board.step(Micros(self.now), Input::Received(piece), &mut ()), None);
        }
    }

    /// One scan of the present codes, 5 ms later.
    pub fn scan(&mut self) {
        self.now += 5_000;
        let report =
            ScanReport { start: Micros(self.now), duration_us: 4_000, overruns: 0, temperature: None };
        let scan = Scan { codes: &self.codes, report };
        self.board.step(Micros(self.now), Input::Scanned(Ok(scan)), &mut ());
    }

    pub fn tick(&mut self) -> Option<Job> {
        self.board.step(Micros(self.now), Input::Tick, &mut ())
    }

    /// Takes up to `budget` bytes off the board and calls `take` for every message; seq must not jump.
    pub fn drain(&mut self, mut budget: usize, mut take: impl FnMut(&Report<'_>)) {
        while budget > 0 {
            let bytes = self.board.pending(Micros(self.now), &mut ()).to_vec();
            let taken = bytes.len().min(budget);
            if taken == 0 {
                break;
            }
            budget -= taken;
            self.board.sent(taken);
            for byte in &bytes[..taken] {
                let Some(frame) = self.receiver.push(*byte) else { continue };
                let (seq, report): (u32, Report) =
                    wire::decode(frame.expect("the board's frames are good")).expect("and its messages");
                assert_eq!(self.next_seq.replace(seq + 1).unwrap_or(seq), seq);
                take(&report);
            }
        }
    }

    /// What a request is answered with: none is yes.
    pub fn answer(&mut self, request: &Request<'_>) -> Option<String> {
        self.ask(request);
        let mut answer = None;
        self.drain(usize::MAX, |report| {
            if let Report::Answer(take) = report {
                assert_eq!(take.request, request.number());
                answer = Some(take.refusal.map(str::to_string));
            }
        });
        answer.expect("every request is answered")
    }

    pub fn press(&mut self, taxels: &[usize], code: u16) {
        for taxel in taxels {
            self.codes[*taxel] = Code(code);
        }
    }
}

/// Taxels under a fingertip.
pub const FINGER: [usize; 4] = [17, 18, 33, 34];
