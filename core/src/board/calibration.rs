//! Baseline and gains: the tare under way, and the calibration from which the gains come.

use super::effects::Effects;
use super::perception::Perception;
use super::refusal::Refusal;
use crate::condition::{Certificate, Tare};
use crate::wire::{Report, Request};

/// Number of `Tare`, which is answered when it is done.
const TARE: u8 = Request::Tare { frames: 0 }.number();

/// State of baseline and gains.
pub(super) struct Calibration {
    is_taring: bool,
    /// True if the garment has a baseline of its own, by tare or restored.
    is_tared: bool,
    /// Calibration from which the gains come.
    certificate: Option<Certificate>,
}

impl Calibration {
    pub const fn new() -> Calibration {
        Calibration { is_taring: false, is_tared: false, certificate: None }
    }

    /// True while a tare is under way.
    pub fn is_taring(&self) -> bool {
        self.is_taring
    }

    /// True if the garment has a baseline of its own.
    pub fn is_tared(&self) -> bool {
        self.is_tared
    }

    /// Calibration from which the gains come.
    pub fn certificate(&self) -> Option<&Certificate> {
        self.certificate.as_ref()
    }

    /// The garment has changed: nothing is known of the new one.
    pub fn forget<const TAXELS: usize>(&mut self, effects: &mut Effects<'_, TAXELS>) {
        if self.is_taring {
            effects.answer(TARE, Some(Refusal::of("the garment was changed")));
        }
        *self = Calibration::new();
    }

    /// Begins a tare. Refused while something touches.
    pub fn tare<const TAXELS: usize, const RUNS: usize, const PARTS: usize>(
        &mut self,
        frames: u16,
        perception: &mut Perception<'_, TAXELS, RUNS, PARTS>,
    ) -> Result<(), Refusal> {
        if !(1..=4096).contains(&frames) {
            return Err(Refusal::of("frames must be 1 to 4096"));
        }
        // Without a baseline the garment at rest looks like a touch, so only a tared one is checked.
        if self.is_tared && perception.state.is_touched() {
            return Err(Refusal::of("something touches the garment"));
        }
        perception.state.condition.tare(frames);
        self.is_taring = true;
        Ok(())
    }

    /// Takes the progress of the tare with a frame.
    pub fn progress<const TAXELS: usize>(&mut self, tare: Tare, effects: &mut Effects<'_, TAXELS>) {
        if self.is_taring && tare == Tare::Done {
            (self.is_taring, self.is_tared) = (false, true);
            effects.answer(TARE, None);
        }
    }

    /// Takes the baseline of a taxel that was stored.
    pub fn restored(&mut self, is_set: bool) {
        self.is_tared |= is_set;
    }

    /// A gain was set: the gains are no longer those of the calibration.
    pub fn gain_set<const TAXELS: usize>(&mut self, effects: &mut Effects<'_, TAXELS>) {
        if self.certificate.take().is_some() {
            effects.outbox.flag(Report::HELLO);
        }
    }

    /// Sets the calibration from which the gains of a garment of so many taxels come.
    pub fn certify<const TAXELS: usize>(
        &mut self,
        certificate: Certificate,
        taxels: usize,
        effects: &mut Effects<'_, TAXELS>,
    ) -> Result<(), Refusal> {
        certificate.check().map_err(Refusal::of)?;
        if usize::from(certificate.taxels) != taxels {
            return Err(Refusal::of("the calibration is of another garment"));
        }
        self.certificate = Some(certificate);
        effects.outbox.flag(Report::HELLO);
        Ok(())
    }
}
