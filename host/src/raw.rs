//! A board that is asked for raw codes, and that wears what it is told meanwhile.

use crate::client::{Client, Event, Worn, cleaned, scene_bytes};
use crate::fault::Fault;
use crate::session::{Returns, Session, Turn};
use crate::source::{self, Source, SourceOptions, SourceSpec};
use crate::stop;
use anyhow::{Context, Result, bail};
use std::collections::BTreeMap;
use std::time::{Duration, Instant};
use taxel_core::garment::Garment;
use taxel_core::health::TaxelHealth;
use taxel_core::scene::{Scene, StreamConfig};
use taxel_core::wire::Request;

/// How long a board may say nothing that is waited for.
const PATIENCE: Duration = Duration::from_secs(5);
/// Seconds that a simulation lasts: longer than anybody waits.
const DAYS: f64 = 1e6;

/// Raw codes of a frame.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Codes {
    /// Start of the scan, us of the board.
    pub time_us: u64,
    /// By taxel of the garment that is worn.
    pub codes: Vec<u16>,
}

/// A board that streams raw codes and nothing else. One that is dropped without [`RawBoard::leave`] or
/// [`RawBoard::give_back`], be it by an error or Ctrl-C, gets the garment and the scene back that it had.
pub struct RawBoard {
    session: Session,
    scene: Scene,
    garment: Garment,
    /// Garment or scene are not what they are to be in the end.
    borrowed: bool,
    /// Nothing ends it now.
    leaving: bool,
}

impl RawBoard {
    /// Connects and asks for raw codes. A board with a scene of its own gets it back by [`RawBoard::leave`].
    pub fn open(spec: &SourceSpec) -> Result<RawBoard> {
        stop::catch()?;
        RawBoard::on(source::open(spec, &RawBoard::options())?)
    }

    /// With which its source is to be opened.
    pub fn options() -> SourceOptions {
        SourceOptions { seconds: Some(DAYS), ..SourceOptions::default() }
    }

    /// The same over a source that is open.
    pub fn on(source: Source) -> Result<RawBoard> {
        let mut session = Session::new(source, Returns::Within(PATIENCE));
        session.parts().0.start(0)?;
        let mut board = RawBoard {
            session,
            scene: Scene::shipped(),
            garment: Garment::recorded(1, 1),
            borrowed: false,
            leaving: false,
        };
        board.until("Hello", |client, _| client.worn().is_some())?;
        if let Some(worn) = board.session.client().worn() {
            (board.scene, board.garment) = (worn.scene.clone(), worn.garment.clone());
        }
        board.borrowed = true;
        board.use_for(&raw_scene())?;
        Ok(board)
    }

    /// What it is, in a few words.
    pub fn label(&self) -> &str {
        &self.session.source().label
    }

    /// The garment that it wore when it was found.
    pub fn garment(&self) -> &Garment {
        &self.garment
    }

    /// Puts a garment on; an error is the board's own where it refuses.
    pub fn wear(&mut self, garment: &Garment) -> Result<()> {
        let bytes = postcard::to_allocvec(garment).context("the garment cannot be written")?;
        self.ask(&Request::SetGarment(&bytes))?;
        let mut told = garment.clone();
        cleaned::garment(&mut told);
        self.until("the new garment", |client, _| client.worn().is_some_and(|worn| worn.garment == told))
    }

    /// Gives the board a garment, and its own scene back.
    pub fn leave(&mut self, garment: &Garment) -> Result<()> {
        self.wear(garment)?;
        self.give_back()
    }

    /// Gives the board its own scene back; garment and gains stay.
    pub fn give_back(&mut self) -> Result<()> {
        self.use_for(&self.scene.clone())?;
        self.borrowed = false;
        Ok(())
    }

    /// What the board says of itself.
    pub fn worn(&self) -> Option<&Worn> {
        self.session.client().worn()
    }

    /// Taxels that are ill, as told last.
    pub fn ill(&self) -> &BTreeMap<u16, TaxelHealth> {
        self.session.client().ill()
    }

    /// The temperature of its converter as told last, degrees Celsius; none: it has no thermometer.
    pub fn celsius(&self) -> Option<f64> {
        self.session.client().celsius().map(|celsius| celsius.to_f64())
    }

    /// The next frame.
    pub fn frame(&mut self) -> Result<Codes> {
        let mut time_us = 0;
        self.until("raw codes", |_, event| match event {
            Event::Raw { time, whole: true, .. } => {
                time_us = time.0;
                true
            }
            _ => false,
        })?;
        Ok(Codes { time_us, codes: self.session.client().raw().to_vec() })
    }

    fn use_for(&mut self, scene: &Scene) -> Result<()> {
        self.ask(&Request::SetScene(&scene_bytes(scene)?))
    }

    /// Makes a request and waits for its answer.
    pub fn ask(&mut self, request: &Request<'_>) -> Result<()> {
        let number = request.number();
        self.session.request(request)?;
        let mut refused = None;
        self.until("an answer", |_, event| match event {
            Event::Answer { request, refusal } if *request == number => {
                refused = refusal.clone();
                true
            }
            _ => false,
        })?;
        match refused {
            Some(why) => bail!(Fault::board(format!("{}: refused: {why}", self.session.source().label))),
            None => Ok(()),
        }
    }

    /// Reads until an event is the one.
    fn until(&mut self, what: &str, mut is_it: impl FnMut(&Client, &Event) -> bool) -> Result<()> {
        let began = Instant::now();
        loop {
            if !self.leaving {
                stop::check()?;
            }
            while let Some(event) = self.session.next_event() {
                if is_it(self.session.client(), &event) {
                    return Ok(());
                }
            }
            while let Some(note) = self.session.note() {
                if let Event::Log { text, .. } = note {
                    eprintln!("{text}");
                }
            }
            let turn = self.session.turn(&mut |_, _| Ok(()))?;
            let label = &self.session.source().label;
            if turn == Turn::End {
                bail!(Fault::board(format!("{label} ended before {what} came")));
            }
            // A board that is gone is waited for on its own.
            if began.elapsed() > PATIENCE && turn != Turn::Waiting && !self.session.client().is_restoring() {
                let seconds = PATIENCE.as_secs();
                bail!(Fault::board(format!("{label}: {what} did not come in {seconds} s")));
            }
        }
    }
}

impl Drop for RawBoard {
    fn drop(&mut self) {
        self.leaving = true;
        if self.borrowed && !self.session.is_gone() {
            let garment = self.garment.clone();
            let worn = self.worn().is_some_and(|worn| worn.garment == garment);
            // Whoever was told of an error is not told of another one.
            let _ = if worn { self.give_back() } else { self.leave(&garment) };
        }
    }
}

/// Raw codes, as many as the link takes; nothing that names a region, which the garment may not have.
fn raw_scene() -> Scene {
    let shipped = Scene::shipped();
    let stream = StreamConfig {
        frames_hz: 0,
        contacts_hz: 0,
        symbols: false,
        intent: false,
        raw_hz: u16::MAX,
        ..shipped.stream
    };
    let mut scene = Scene { stream, intent: None, shape: None, ..shipped };
    scene.friendliness.clear();
    scene.react.clear();
    scene.joints.clear();
    scene
}
