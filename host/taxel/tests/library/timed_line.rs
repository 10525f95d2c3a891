//! A client and a board with a clock of its own, on a link with delays of its own. All times are the truth,
//! us, which the client does not see.

use super::delays::Delays;
use std::collections::VecDeque;
use std::f64::consts::TAU;
use taxel::client::Client;
use taxel_core::board::{Board, BoardInfo, Input};
use taxel_core::format::Micros;
use taxel_core::garment::{Garment, Pins};
use taxel_core::scene::Scene;
use taxel_core::wire::StartOfFrame;

/// The host's time when the simulation begins, us.
pub const EPOCH: f64 = 1.8e15;
const INFO: BoardInfo =
    BoardInfo { firmware: "test", chip: "", pins: Pins::ANY, full_scale: 4095, link_bytes_per_s: 92_160 };

/// A board's clock: fast by `ppm`, and by up to `wander_ppm` more or less in the course of `period_s`.
#[derive(Debug, Clone, Copy)]
pub struct DriftingClock {
    /// Rate, ppm.
    pub ppm: f64,
    /// Amplitude of the rate's change, ppm.
    pub wander_ppm: f64,
    /// Its period, s.
    pub period_s: f64,
    /// When the clock shows 0, us.
    pub booted: f64,
}

impl DriftingClock {
    /// The board's time.
    pub fn at(&self, now: f64) -> Micros {
        let period = self.period_s * 1e6;
        let wandered = |t: f64| self.wander_ppm * 1e-6 * period / TAU * (1.0 - (TAU * t / period).cos());
        let since = (now - self.booted) * (1.0 + self.ppm * 1e-6) + wandered(now) - wandered(self.booted);
        Micros(since as u64)
    }
}

/// A USB host controller: when its frames start, and which numbers they have.
#[derive(Debug, Clone, Copy)]
pub struct Controller {
    /// By the crystal of the controller, which shows 0 at the start of frame 0.
    pub clock: DriftingClock,
    /// Most by which a board notices a start late, us.
    pub late_us: u16,
}

impl Controller {
    /// The first start after a time: its number, and when it is.
    fn after(&self, now: f64) -> (u16, f64) {
        let frame = self.clock.at(now).0 / 1_000 + 1;
        let left = (frame * 1_000 - self.clock.at(now).0) as f64;
        ((frame % 2_048) as u16, now + left / (1.0 + self.clock.ppm * 1e-6))
    }
}

/// A client and a board.
pub struct TimedLine {
    /// The host's end.
    pub client: Client,
    /// The board's clock.
    pub clock: DriftingClock,
    board: Box<Board<64, 32>>,
    delays: Delays,
    /// Bytes on their way to the host, and their times of arrival.
    coming: VecDeque<(f64, Vec<u8>)>,
    /// The controller that the board is on, if it is on USB.
    pub controller: Option<Controller>,
}

impl TimedLine {
    /// A client that has just asked for the stream.
    pub fn new(clock: DriftingClock, delays: Delays) -> TimedLine {
        let mut client = Client::new();
        client.start(0).unwrap();
        TimedLine { client, clock, board: board(), delays, coming: VecDeque::new(), controller: None }
    }

    /// The board restarts, and says so on a link that has lost everything.
    pub fn restart(&mut self, now: f64) {
        (self.board, self.clock.booted) = (board(), now);
        self.coming.clear();
        // Its first messages, before any request.
        let hello = self.answers(now + 1_000.0);
        self.coming.push_back((now + 2_000.0, hello));
    }

    /// The host sends due requests, and handles arrived bytes.
    pub fn poll(&mut self, now: f64) {
        while let Some((at, bytes)) = self.coming.pop_front_if(|(at, _)| *at <= now) {
            self.client.set_time((EPOCH + at) as u64);
            bytes.into_iter().for_each(|byte| drop(self.client.push(byte)));
        }
        self.client.set_time((EPOCH + now) as u64);
        let asked = self.client.take_requests();
        if asked.is_empty() {
            return;
        }
        let read = now + self.delays.there();
        self.board.step(self.clock.at(read), Input::Received(&asked), &mut ());
        let sent = read + self.delays.on_board();
        let mut bytes = self.answers(sent);
        if self.board.asks_start_of_frame()
            && let Some(controller) = self.controller
        {
            let (number, starts) = controller.after(read);
            let noticed = self.clock.at(starts + self.delays.notice(controller.late_us));
            let start = StartOfFrame { number, noticed, late_us: controller.late_us };
            self.board.step(noticed, Input::StartOfFrame(start), &mut ());
            bytes.extend(self.answers(starts + f64::from(controller.late_us)));
        }
        let mut arrives = sent + self.delays.back(now);
        if let Some((last, _)) = self.coming.back() {
            arrives = arrives.max(*last);
        }
        if !self.delays.is_lost() || now < 1e6 {
            self.coming.push_back((arrives, bytes));
        }
    }

    /// Everything that the board sends.
    fn answers(&mut self, now: f64) -> Vec<u8> {
        let (time, mut bytes) = (self.clock.at(now), Vec::new());
        loop {
            let count = self.board.pending(time, &mut ()).len();
            if count == 0 {
                return bytes;
            }
            bytes.extend_from_slice(self.board.pending(time, &mut ()));
            self.board.sent(count);
        }
    }
}

fn board() -> Box<Board<64, 32>> {
    Box::new(Board::new(INFO, Garment::block(), Scene::shipped()).unwrap())
}
