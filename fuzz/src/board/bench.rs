//! A board with a flash, its host, and the time.

use super::garments::Outfit;
use taxel::client::{Client, Event, ImageNews};
use taxel::sim::SimFlash;
use taxel_core::acquire::{Scan, ScanReport};
use taxel_core::board::{Board, BoardInfo, Input, Job, Part};
use taxel_core::boot::Boot;
use taxel_core::format::{Celsius, Code, Micros};
use taxel_core::garment::{Garment, Pins};
use taxel_core::scene::Scene;
use taxel_core::selftest::Findings;
use taxel_store::{Found, Store};

const INFO: BoardInfo =
    BoardInfo { firmware: "fuzz", chip: "", pins: Pins::ANY, full_scale: 4095, link_bytes_per_s: 1_000_000 };

/// A board and all around it.
pub struct Bench<const T: usize, const R: usize, const P: usize> {
    outfit: Outfit,
    board: Box<Board<T, R, P>>,
    client: Client,
    flash: SimFlash,
    /// Contents of the flash: garment and scene.
    stored: Option<(Garment, Scene)>,
    now: Micros,
    codes: [Code; T],
    /// Frames that the converter has made since the last scan and nobody fetched.
    pub overruns: u32,
    /// The converter's temperature, as the next scan reports it.
    pub temperature: Option<Celsius>,
}

impl<const T: usize, const R: usize, const P: usize> Bench<T, R, P> {
    /// A board that has just been powered, with its host.
    pub fn new(outfit: Outfit) -> Bench<T, R, P> {
        let mut client = Client::new();
        // Streams; a request of a byte fits.
        let _ = client.start(0);
        let mut bench = Bench {
            board: Box::new(powered(&outfit)),
            outfit,
            client,
            flash: SimFlash::default(),
            stored: None,
            now: Micros(1_000),
            codes: [Code(90); T],
            overruns: 0,
            temperature: None,
        };
        bench.ask();
        bench
    }

    /// Its garment.
    pub fn garment(&self) -> &Garment {
        &self.board.setup().garment
    }

    /// The scene that it plays.
    pub fn scene(&self) -> &Scene {
        &self.board.setup().scene
    }

    /// Something happens.
    pub fn step(&mut self, input: Input<'_>) {
        assert_eq!(self.board.step(self.now, input, &mut ()), None, "only a tick is answered with a job");
    }

    /// Bytes of the host.
    pub fn receive(&mut self, bytes: &[u8]) {
        self.step(Input::Received(bytes));
    }

    /// Time goes by.
    pub fn pass(&mut self, us: u64) {
        self.now = Micros(self.now.0.saturating_add(us));
    }

    /// Codes of taxels that follow each other.
    pub fn press(&mut self, first: u16, count: u8, code: Code) {
        let first = usize::from(first) % T;
        self.codes.iter_mut().skip(first).take(count.into()).for_each(|to| *to = code);
    }

    /// A part of stored settings that nobody has stored here.
    pub fn restore(&mut self, part: Part, bytes: &[u8]) {
        self.board.restore(part, bytes);
    }

    /// The loop goes round: what is to be done is done, and what is to be said is said.
    pub fn turn(&mut self) {
        self.pass(2_500);
        match self.board.step(self.now, Input::Tick, &mut ()) {
            Some(Job::Scan(_)) => self.scan(),
            Some(Job::Examine) => self.step(Input::Examined(Ok(Findings::default()))),
            Some(Job::Save) => self.save(),
            Some(Job::ResetSettings { undo }) => {
                let done = Store::new(&mut self.flash, 0..SimFlash::BYTES).unwrap().put_aside(!undo);
                self.step(Input::SettingsReset(done.map_err(|error| error.sentence())));
            }
            Some(Job::Restart) => self.restart(),
            // A flash that gives nothing back: a table is refused.
            Some(Job::StoreTable) => {
                let piece = self.board.piece_to_store();
                let is_whole = piece.offset as usize + piece.bytes.len() == piece.length as usize;
                self.step(Input::TableStored(Ok(is_whole.then_some(&[]))));
            }
            Some(Job::KeepTable(kind)) => self.step(Input::TableKept(kind, Ok(()))),
            Some(Job::Drive(..)) | None => {}
        }
        let taxel = (self.now.0 % T as u64) as u16;
        let (_, _, _) = (self.board.reflexes(), self.board.reacting(), self.board.inactive_code(taxel));
        self.ask();
        self.drain(usize::MAX);
    }

    fn scan(&mut self) {
        let overruns = std::mem::take(&mut self.overruns);
        let report =
            ScanReport { start: self.now, duration_us: 2_000, overruns, temperature: self.temperature };
        self.pass(2_000);
        let scan = Scan { codes: &self.codes[..self.board.setup().layout.taxels()], report };
        self.board.step(self.now, Input::Scanned(Ok(scan)), &mut ());
    }

    fn save(&mut self) {
        let done = Store::new(&mut self.flash, 0..SimFlash::BYTES).unwrap().save(&self.board.settings());
        assert!(done.is_ok(), "what a board holds can be stored: {done:?}");
        self.stored = Some((self.garment().clone(), self.scene().clone()));
        self.step(Input::Saved(done.map_err(|error| error.sentence())));
    }

    /// The board starts anew, with what is stored.
    pub fn restart(&mut self) {
        *self.board = powered(&self.outfit);
        let found = Store::new(&mut self.flash, 0..SimFlash::BYTES).unwrap().load(&mut *self.board);
        match (found, &self.stored) {
            (Ok(Found::Settings), Some((garment, scene))) => {
                assert_eq!((garment, scene), (self.garment(), self.scene()), "what was stored is in force");
            }
            (Ok(Found::Aside), Some(_)) | (Ok(Found::Nothing), None) => {}
            other => panic!("the flash holds something else than was stored: {other:?}"),
        }
        self.board.booted(Boot::default());
        self.client = Client::new();
        let _ = self.client.start(0);
        self.ask();
    }

    /// Requests that the host makes by itself: to start, for an image that stands alone, for the time.
    fn ask(&mut self) {
        let requests = self.client.take_requests();
        self.receive(&requests);
    }

    /// The host reads up to so many bytes.
    pub fn drain(&mut self, mut budget: usize) {
        while budget > 0 {
            let bytes = self.board.pending(self.now, &mut ()).to_vec();
            let taken = bytes.len().min(budget);
            if taken == 0 {
                return;
            }
            budget -= taken;
            self.board.sent(taken);
            for byte in &bytes[..taken] {
                if let Some(event) = self.client.push(*byte) {
                    self.hear(&event);
                }
            }
        }
    }

    /// Checks that the host understands what the board says.
    fn hear(&self, event: &Event) {
        match event {
            Event::Refused(why) => panic!("a message of the board cannot be read: {why}"),
            Event::Unusable(why) => panic!("what the board plays is refused by the host: {why}"),
            Event::Frame { image, .. } => assert_ne!(*image, ImageNews::Wrong, "an image is not as it was"),
            _ => {}
        }
        assert_eq!(self.client.counts().lost, 0, "no message is lost on a whole link");
    }
}

fn powered<const T: usize, const R: usize, const P: usize>(outfit: &Outfit) -> Board<T, R, P> {
    let mut board = Board::new(INFO, outfit.garment.clone(), outfit.scene.clone())
        .or_else(|_| Board::new(INFO, outfit.garment.clone(), Scene::shipped()))
        .expect("what ships fits its garments");
    board.booted(Boot::default());
    board
}
