//! A board under a garment that a person touches, and its announcements.

use crate::people::kind::{Act, Session};
use taxel::sim::FRAME_PERIOD_US;
use taxel_core::acquire::{Scan, ScanReport};
use taxel_core::board::{BoardInfo, Input, Shipped};
use taxel_core::capacity::TAXELS;
use taxel_core::format::{Code, Micros};
use taxel_core::garment::Pins;
use taxel_core::intent::Leading;
use taxel_core::scene::Scene;
use taxel_core::wire::{self, Receiver, Report, Request};

/// Frames averaged by the tare, and of rest before the first touch.
const TARE: u16 = 16;
/// Time after the end of an act in which announcements still belong to it, us.
const AFTER_US: u64 = 300_000;

/// Result of an act.
#[derive(Debug, Clone)]
pub struct Heard {
    /// The act.
    pub act: Act,
    /// Announcements during the act, with the number of frames since its force began.
    pub announced: Vec<(Leading, u64)>,
}

impl Heard {
    /// The gravest announcement, on which the robot acts.
    pub fn gravest(&self) -> Leading {
        self.announced.iter().map(|(leading, _)| *leading).max_by_key(|l| *l as u8).unwrap_or_default()
    }

    /// The last announcement.
    pub fn last(&self) -> Leading {
        let said = self.announced.iter().rev().map(|(leading, _)| *leading);
        said.into_iter().find(|leading| *leading != Leading::None).unwrap_or_default()
    }

    /// Frames until the intended announcement.
    pub fn delay(&self) -> Option<u64> {
        let meant = self.act.kind.meaning();
        self.announced.iter().find(|(leading, _)| *leading == meant).map(|(_, frames)| *frames)
    }
}

/// Results of all acts of a session, and the number of attacks announced without a touch.
pub fn play(session: &mut impl Session) -> (Vec<Heard>, usize) {
    let info =
        BoardInfo { firmware: "", chip: "", pins: Pins::ANY, full_scale: 4095, link_bytes_per_s: 1_000_000 };
    let board = Shipped::new(info, session.garment(), Scene::shipped());
    let mut board = Box::new(board.expect("garment and scene fit"));
    let mut receiver = Box::new(Receiver::<8192>::new());
    for request in [Request::Start, Request::Tare { frames: TARE }] {
        let mut frame = [0; 64];
        let frame = wire::encode(&request, &mut frame).expect("it is short");
        board.step(Micros(0), Input::Received(frame), &mut ());
    }
    let mut heard: Vec<Heard> =
        session.acts().iter().map(|act| Heard { act: act.clone(), announced: Vec::new() }).collect();
    let (mut untouched, mut leading) = (0, Leading::None);
    let mut raw = vec![0; TAXELS];
    let end = heard.last().map_or(0, |last| last.act.span.1) + 1_000_000;
    for start in (0..end).step_by(FRAME_PERIOD_US as usize) {
        session.frame(start, &mut raw);
        let codes: Vec<Code> = raw.iter().map(|code| Code(*code)).collect();
        let report = ScanReport { start: Micros(start), duration_us: 5_000, overruns: 0, temperature: None };
        let scanned = Input::Scanned(Ok(Scan { codes: &codes, report }));
        board.step(Micros(start + 5_000), scanned, &mut ());
        let Some(said) = read(&mut board, &mut receiver, start).filter(|said| *said != leading) else {
            continue;
        };
        leading = said;
        let during = |act: &Act| (act.span.0..act.span.1 + AFTER_US).contains(&start);
        match heard.iter_mut().find(|heard| during(&heard.act)) {
            Some(heard) => {
                let frames = (start - heard.act.span.0) / FRAME_PERIOD_US + 1;
                heard.announced.push((said, frames));
            }
            None => untouched += usize::from(said == Leading::Attack),
        }
    }
    (heard, untouched)
}

/// Reads the board's messages. Returns the latest intention among them.
fn read(board: &mut Shipped, receiver: &mut Receiver<8192>, now: u64) -> Option<Leading> {
    let mut said = None;
    loop {
        let bytes = board.pending(Micros(now + 5_000), &mut ());
        let count = bytes.len();
        if count == 0 {
            return said;
        }
        for byte in bytes {
            let Some(frame) = receiver.push(*byte) else { continue };
            let (_, report): (u32, Report) =
                wire::decode(frame.expect("the board's frames are good")).expect("and its messages");
            if let Report::Intent(intent) = report {
                said = Some(intent.leading);
            }
        }
        board.sent(count);
    }
}
