//! A board that streams raw codes, and takes other garments meanwhile.

use super::stop;
use crate::fault::Fault;
use anyhow::{Context, Result, bail};
use std::collections::BTreeMap;
use std::time::{Duration, Instant};
use taxel::client::{BoardDescription, Client, Event, cleaned, scene_bytes};
use taxel::session::{Poll, Returns, Session};
use taxel::source::{self, Source, SourceOptions, SourceSpec};
use taxel_core::garment::Garment;
use taxel_core::health::TaxelHealth;
use taxel_core::scene::{Scene, StreamConfig};
use taxel_core::wire::Request;

/// Longest wait for an expected message.
const PATIENCE: Duration = Duration::from_secs(5);
/// Duration of a simulation, s: longer than anybody waits.
const DAYS: f64 = 1e6;

/// Raw codes of a frame.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Codes {
    /// Start of the scan, us of the board.
    pub time_us: u64,
    /// Codes by taxel of the current garment.
    pub codes: Vec<u16>,
}

/// A board that streams raw codes and nothing else. When dropped without [`RawBoard::leave`] or
/// [`RawBoard::give_back`], by an error or Ctrl-C, it restores the board's garment and scene.
pub struct RawBoard {
    session: Session,
    scene: Scene,
    garment: Garment,
    /// Garment or scene are not the final ones.
    borrowed: bool,
    /// Ctrl-C is ignored while the board is being restored.
    leaving: bool,
}

impl RawBoard {
    /// Connects and requests raw codes. [`RawBoard::leave`] restores the board's own scene.
    pub fn open(spec: &SourceSpec) -> Result<RawBoard> {
        stop::catch()?;
        RawBoard::on(source::open(spec, &RawBoard::options())?)
    }

    /// Options with which its source is opened.
    pub fn options() -> SourceOptions {
        SourceOptions { seconds: Some(DAYS), ..SourceOptions::default() }
    }

    /// Requests raw codes from an open source.
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
        board.until("Hello", |client, _| client.description().is_some())?;
        if let Some(description) = board.session.client().description() {
            (board.scene, board.garment) = (description.scene.clone(), description.garment.clone());
        }
        board.borrowed = true;
        board.use_for(&raw_scene())?;
        board.ask(&Request::Stream { raw_hz: u16::MAX, budget_hz: 1 })?;
        Ok(board)
    }

    /// Short name of the source.
    pub fn label(&self) -> &str {
        &self.session.source().label
    }

    /// The garment that the board had at the start.
    pub fn garment(&self) -> &Garment {
        &self.garment
    }

    /// Sends a garment. Error if the board refuses it.
    pub fn use_garment(&mut self, garment: &Garment) -> Result<()> {
        let bytes = postcard::to_allocvec(garment).context("the garment cannot be written")?;
        self.ask(&Request::SetGarment(&bytes))?;
        let mut cleaned_garment = garment.clone();
        cleaned::garment(&mut cleaned_garment);
        self.until("the new garment", |client, _| {
            client.description().is_some_and(|description| description.garment == cleaned_garment)
        })
    }

    /// Sends a garment, and restores the board's own scene.
    pub fn leave(&mut self, garment: &Garment) -> Result<()> {
        self.use_garment(garment)?;
        self.give_back()
    }

    /// Restores the board's own scene; garment and gains stay.
    pub fn give_back(&mut self) -> Result<()> {
        self.ask(&Request::Stream { raw_hz: 0, budget_hz: 1 })?;
        self.use_for(&self.scene.clone())?;
        self.borrowed = false;
        Ok(())
    }

    /// The board's last `Hello`.
    pub fn description(&self) -> Option<&BoardDescription> {
        self.session.client().description()
    }

    /// Faulty taxels, by the latest report.
    pub fn faulty(&self) -> &BTreeMap<u16, TaxelHealth> {
        self.session.client().faulty()
    }

    /// Latest temperature of its converter, degrees Celsius; none if it has no thermometer.
    pub fn celsius(&self) -> Option<f64> {
        self.session.client().celsius().map(|celsius| celsius.to_f64())
    }

    /// Reads the next frame.
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

    /// Sends a request and waits for its answer.
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

    /// Reads until an event meets the condition.
    fn until(&mut self, what: &str, mut is_it: impl FnMut(&Client, &Event) -> bool) -> Result<()> {
        let began = Instant::now();
        loop {
            if !self.leaving {
                stop::check()?;
            }
            let found = self.session.poll()?;
            let label = &self.session.source().label;
            match found {
                Poll::Event(Event::Other { why }) => {
                    // It is not the board whose garment and scene are to be restored.
                    self.borrowed = false;
                    bail!(Fault::board(why));
                }
                Poll::Event(event) => {
                    event.remark().iter().for_each(|remark| eprintln!("{remark}"));
                    if is_it(self.session.client(), &event) {
                        return Ok(());
                    }
                }
                // The session itself limits the wait for a lost board.
                Poll::Nothing if self.session.is_gone() || self.session.client().is_restoring() => {}
                Poll::Nothing if began.elapsed() > PATIENCE => {
                    let seconds = PATIENCE.as_secs();
                    bail!(Fault::board(format!("{label}: {what} did not come in {seconds} s")));
                }
                Poll::Nothing => {}
                Poll::End => bail!(Fault::board(format!("{label} ended before {what} came"))),
            }
        }
    }
}

impl Drop for RawBoard {
    fn drop(&mut self) {
        self.leaving = true;
        if self.borrowed && !self.session.is_gone() {
            let garment = self.garment.clone();
            let is_used = self.description().is_some_and(|description| description.garment == garment);
            // An error has been reported already.
            let _ = if is_used { self.give_back() } else { self.leave(&garment) };
        }
    }
}

/// Scene that leaves the link to raw codes. It names no region, because the garment may not have it.
fn raw_scene() -> Scene {
    let shipped = Scene::shipped();
    let stream =
        StreamConfig { frames_hz: 0, contacts_hz: 0, symbols: false, intent: false, ..shipped.stream };
    let mut scene = Scene { stream, intent: None, shape: None, ..shipped };
    scene.friendliness.clear();
    scene.react.clear();
    scene.joints.clear();
    scene
}
