//! A board whose link and power a test can cut.

use std::collections::VecDeque;
use std::io::{self, ErrorKind};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};
use taxel::source::{Port, Source};
use taxel_core::acquire::{Scan, ScanReport};
use taxel_core::board::{Board, BoardInfo, Input, Job, Saved};
use taxel_core::format::{Code, Micros};
use taxel_core::garment::{Garment, Pins};
use taxel_core::scene::Scene;
use taxel_core::selftest::Findings;
use taxel_core::wire::{LONGEST_REQUEST, Receiver, Request, decode, frame_bound};

const INFO: BoardInfo =
    BoardInfo { firmware: "test", chip: "", pins: Pins::ANY, full_scale: 4095, link_bytes_per_s: 1_000_000 };
/// Time between two scans.
const SCAN: Duration = Duration::from_millis(2);
/// Most bytes queued for the host.
const ROOM: usize = 1 << 16;

/// The board.
pub struct Rig {
    board: Box<Board<64, 32>>,
    /// Time of the last power-up.
    booted: Instant,
    scanned: Instant,
    to_host: VecDeque<u8>,
    receiver: Receiver<{ frame_bound(LONGEST_REQUEST) }>,
    /// Numbers of the requests read since power-up, except for `Sync`.
    pub asked: Vec<u8>,
    /// Number of the plugged link; other links are broken.
    pub link: u64,
    /// True if the link can be opened.
    pub plugged: bool,
    /// Pins from the next restart on; with other pins, the board refuses garments.
    pub pins: Pins,
    /// Id of its chip.
    pub chip: &'static str,
    /// True if it reads nothing.
    pub deaf: bool,
    /// Codes of its converter.
    pub codes: [Code; 64],
    /// Garment at its start.
    garment_at_start: Garment,
}

impl Rig {
    /// A board just after power-up.
    pub fn new() -> Rig {
        Rig::with_garment(Garment::block())
    }

    /// A board of 64 taxels that ships with this garment, just after power-up.
    pub fn with_garment(garment: Garment) -> Rig {
        let now = Instant::now();
        Rig {
            board: board(Pins::ANY, "", &garment),
            booted: now,
            scanned: now,
            to_host: VecDeque::new(),
            receiver: Receiver::new(),
            asked: Vec::new(),
            link: 0,
            plugged: true,
            pins: Pins::ANY,
            chip: "",
            deaf: false,
            codes: [Code(100); 64],
            garment_at_start: garment,
        }
    }

    /// Cycles the power.
    pub fn restart(&mut self) {
        self.board = board(self.pins, self.chip, &self.garment_at_start);
        self.booted = Instant::now();
        self.to_host.clear();
        self.receiver = Receiver::new();
        self.asked.clear();
    }

    /// Breaks the link.
    pub fn cut(&mut self) {
        self.link += 1;
        self.to_host.clear();
    }

    /// Its garment.
    pub fn garment(&self) -> &Garment {
        &self.board.setup().garment
    }

    /// Its scene.
    pub fn scene(&self) -> &Scene {
        &self.board.setup().scene
    }

    /// Gain of its first taxel, and number of its calibration.
    pub fn calibration(&self) -> (u16, Option<u32>) {
        let settings = self.board.settings();
        (settings.gain[0], settings.calibration.map(|certificate| certificate.id))
    }

    fn now(&self) -> Micros {
        Micros(self.booted.elapsed().as_micros() as u64)
    }

    /// Takes bytes of the host.
    pub fn receive(&mut self, bytes: &[u8]) {
        for byte in bytes {
            if let Some(Ok(message)) = self.receiver.push(*byte)
                && let Ok(request) = decode::<Request<'_>>(message)
                && !matches!(request, Request::Sync { .. } | Request::KeyFrame)
            {
                self.asked.push(request.number());
            }
        }
        let now = self.now();
        self.board.step(now, Input::Received(bytes), &mut ());
    }

    /// Works, and returns the bytes that it sends.
    pub fn speak(&mut self, buffer: &mut [u8]) -> usize {
        for _ in 0..8 {
            if self.scanned.elapsed() < SCAN {
                break;
            }
            let now = self.now();
            match self.board.step(now, Input::Tick, &mut ()) {
                Some(Job::Scan(_)) => {
                    let report = ScanReport { start: now, duration_us: 500, ..ScanReport::default() };
                    let codes = self.codes;
                    self.board.step(now, Input::Scanned(Ok(Scan { codes: &codes, report })), &mut ());
                    self.scanned = Instant::now();
                }
                Some(Job::Examine) => {
                    let findings = Findings { lines: 6, inputs: 1, faults: Default::default() };
                    self.board.step(now, Input::Examined(Ok(findings)), &mut ());
                }
                Some(Job::Save) => _ = self.board.step(now, Input::Saved(Ok(Saved::Unchanged)), &mut ()),
                Some(Job::Drive(..)) => {}
                Some(job) => panic!("nobody asks for {job:?}"),
                None => break,
            }
        }
        let now = self.now();
        while self.to_host.len() < ROOM {
            let pending = self.board.pending(now, &mut ());
            let count = pending.len();
            if count == 0 {
                break;
            }
            self.to_host.extend(pending);
            self.board.sent(count);
        }
        let count = buffer.len().min(self.to_host.len());
        for (slot, byte) in buffer.iter_mut().zip(self.to_host.drain(..count)) {
            *slot = byte;
        }
        count
    }
}

fn board(pins: Pins, chip: &'static str, garment: &Garment) -> Box<Board<64, 32>> {
    Box::new(Board::new(BoardInfo { pins, chip, ..INFO }, garment.clone(), Scene::shipped()).unwrap())
}

/// A link in memory.
struct Wire {
    rig: Arc<Mutex<Rig>>,
    number: u64,
}

impl Wire {
    fn with<T>(&mut self, act: impl FnOnce(&mut Rig) -> T) -> io::Result<T> {
        let mut rig = self.rig.lock().unwrap();
        if rig.link == self.number { Ok(act(&mut rig)) } else { Err(ErrorKind::BrokenPipe.into()) }
    }
}

impl Port for Wire {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<Option<usize>> {
        let count = self.with(|rig| rig.speak(buffer))?;
        if count == 0 {
            std::thread::sleep(Duration::from_millis(1));
        }
        Ok(Some(count))
    }

    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.with(|rig| {
            if rig.deaf {
                return 0;
            }
            rig.receive(bytes);
            bytes.len()
        })
    }
}

/// A source on the board's link, which comes back as long as it is plugged in.
pub fn source(rig: &Arc<Mutex<Rig>>) -> Source {
    open(rig).unwrap()
}

/// Opens its link, if it is plugged in.
pub fn open(rig: &Arc<Mutex<Rig>>) -> taxel::Result<Source> {
    let known = rig.lock().unwrap();
    if !known.plugged {
        return Err(taxel::Error::other("nothing is plugged in"));
    }
    let (again, wire) = (rig.clone(), Wire { rig: rig.clone(), number: known.link });
    Ok(Source::real("rig", wire, move || open(&again)))
}
