//! The host's time of a board's frames over an hour, against a simulated truth that the client does not see.
//!
//! The board's clock runs 50 ppm fast, and wanders by 5 ppm with a period of ten minutes, as with the
//! temperature of a room (0.052 ppm/s at most). The way to the board takes 0.1 to 5 ms, because the board
//! reads its link between two stages of a frame. The way back takes at least 0.8 ms, on average 0.3 ms more;
//! in bursts, ten seconds of each half minute, on average 20 ms more, as behind images on a busy link. One
//! answer in twenty is lost.

use fastrand::Rng;
use std::collections::VecDeque;
use std::f64::consts::TAU;
use taxel::client::Client;
use taxel_core::board::{Board, BoardInfo, Input};
use taxel_core::format::Micros;
use taxel_core::garment::{Garment, Pins};
use taxel_core::scene::Scene;

const SECOND: f64 = 1e6;
/// Time between two frames, us.
const FRAME: f64 = 5_120.0;
/// Time from the start of a scan until its frame is read, us.
const LATE: f64 = 9_000.0;
/// The host's time when the simulation begins, us.
const EPOCH: f64 = 1.8e15;
const INFO: BoardInfo =
    BoardInfo { firmware: "test", pins: Pins::ANY, full_scale: 4095, link_bytes_per_s: 92_160 };

/// A client and a board on a bad link. All times are the truth, us.
struct Line {
    client: Client,
    board: Box<Board<64, 32>>,
    /// When the board's clock showed 0.
    booted: f64,
    rng: Rng,
    /// Bytes on their way to the host, and their times of arrival.
    coming: VecDeque<(f64, Vec<u8>)>,
}

impl Line {
    fn new() -> Line {
        let mut client = Client::new();
        client.start(0).unwrap();
        Line {
            client,
            board: board(),
            booted: -3.0 * SECOND,
            rng: Rng::with_seed(8),
            coming: VecDeque::new(),
        }
    }

    fn board_time(&self, now: f64) -> Micros {
        let period = 600.0 * SECOND;
        let wandered = |t: f64| 5e-6 * period / TAU * (1.0 - (TAU * t / period).cos());
        let since = (now - self.booted) * (1.0 + 50e-6) + wandered(now) - wandered(self.booted);
        Micros(since as u64)
    }

    fn wait(&mut self, mean: f64) -> f64 {
        -mean * (1.0 - self.rng.f64()).ln()
    }

    /// The host sends due requests, and handles arrived bytes.
    fn poll(&mut self, now: f64) {
        while let Some((at, bytes)) = self.coming.pop_front_if(|(at, _)| *at <= now) {
            self.client.tell_time((EPOCH + at) as u64);
            bytes.into_iter().for_each(|byte| drop(self.client.push(byte)));
        }
        self.client.tell_time((EPOCH + now) as u64);
        let asked = self.client.take_requests();
        if asked.is_empty() {
            return;
        }
        let read = now + 100.0 + self.rng.f64() * 4_900.0;
        let time = self.board_time(read);
        self.board.step(time, Input::Received(&asked), &mut ());
        let sent = read + self.rng.f64() * 300.0;
        let bytes = self.answers(sent);
        let burst = now % (30.0 * SECOND) < 10.0 * SECOND;
        let mut arrives = sent + 800.0 + self.wait(if burst { 20_000.0 } else { 300.0 });
        if let Some((last, _)) = self.coming.back() {
            arrives = arrives.max(*last);
        }
        if self.rng.u8(..20) > 0 || now < SECOND {
            self.coming.push_back((arrives, bytes));
        }
    }

    /// Everything that the board sends.
    fn answers(&mut self, now: f64) -> Vec<u8> {
        let (time, mut bytes) = (self.board_time(now), Vec::new());
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

fn quantile(values: &mut [f64], part: f64) -> f64 {
    values.sort_by(f64::total_cmp);
    values[((values.len() - 1) as f64 * part) as usize]
}

#[test]
fn an_hour_of_frames_has_the_right_host_time() {
    let mut line = Line::new();
    let (mut errors, mut stated) = (Vec::new(), Vec::new());
    for frame in 0..(3_600.0 * SECOND / FRAME) as u32 {
        let started = f64::from(frame) * FRAME;
        line.poll(started + LATE);
        let Some(time) = line.client.host_time(line.board_time(started)) else {
            assert!(started < SECOND, "no host time yet after a second");
            continue;
        };
        let error = (time.us as f64 - (EPOCH + started)).abs();
        assert!(error <= time.uncertainty_us as f64, "frame {frame}: {error} us off, stated {time:?}");
        errors.push(error);
        stated.push(time.uncertainty_us as f64);
    }
    let (p50, p99) = (quantile(&mut errors, 0.5), quantile(&mut errors, 0.99));
    let (width, widest) = (quantile(&mut stated, 0.5), quantile(&mut stated, 0.99));
    println!("{} frames: {p50:.0} us off, p99 {p99:.0}; stated {width:.0}, p99 {widest:.0}", errors.len());
    assert!(p99 <= 1_000.0, "p99 {p99} us");
    assert!(width <= 1_000.0, "stated {width} us");
}

#[test]
fn after_a_restart_of_the_board_its_time_is_learnt_anew() {
    let mut line = Line::new();
    for step in 0..2_000 {
        line.poll(f64::from(step) * FRAME);
    }
    let now = 2_000.0 * FRAME;
    (line.board, line.booted) = (board(), now);
    line.coming.clear();
    // Its first messages, before any request.
    let hello = line.answers(now + 1_000.0);
    line.coming.push_back((now + 2_000.0, hello));
    line.poll(now + 2_500.0);
    assert_eq!(line.client.counts().restarts, 1);
    assert_eq!(line.client.host_time(Micros(1_000)), None, "the old clock holds no more");
    for step in 1..400 {
        line.poll(now + f64::from(step) * FRAME);
    }
    let then = now + 300.0 * FRAME;
    let time = line.client.host_time(line.board_time(then)).unwrap();
    let error = (time.us as f64 - (EPOCH + then)).abs();
    assert!(error <= time.uncertainty_us as f64 && time.uncertainty_us < 5_000, "{error} us off, {time:?}");
}
