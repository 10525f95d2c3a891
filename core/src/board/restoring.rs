//! Settings that survive a restart: what the board stores, and takes back.

use super::refusal::Refusal;
use super::settings::{Part, Settings};
use super::setup::Setup;
use super::{Board, reading};
use crate::format::{Code, Micros};
use crate::garment::Garment;
use crate::scene::Scene;
use crate::wire::decode;
use core::fmt;

impl<const TAXELS: usize, const RUNS: usize, const PARTS: usize> Board<TAXELS, RUNS, PARTS> {
    /// Settings to store.
    pub fn settings(&self) -> Settings<'_> {
        let Setup { garment, scene, layout, .. } = &self.setup;
        let condition = &self.state.condition;
        let gain = condition.gain();
        let baseline = condition.baseline().filter(|_| self.tared);
        Settings {
            garment,
            scene,
            gain: gain.get(..layout.taxels()).unwrap_or(gain),
            faulty: self.monitor.faulty(),
            baseline: baseline.map(|all| all.get(..layout.taxels()).unwrap_or(all)),
            calibration: self.certificate.as_ref(),
            saves: self.saving.left_after(),
        }
    }

    /// Takes a part of stored settings. A part that does not fit is ignored, and the reason is logged.
    #[inline(never)] // own frame: its stack is free again on return
    pub fn restore(&mut self, part: Part, bytes: &[u8]) {
        self.begin();
        let done = match part {
            Part::Garment => self.restore_garment(bytes),
            Part::Scene => self.restore_scene(bytes),
            Part::Gain => self.restore_numbers(bytes, |board, taxel, gain| board.put_gain(taxel, gain)),
            Part::Baseline => self.restore_numbers(bytes, |board, taxel, code| {
                board.tared |= board.state.condition.set_baseline(taxel, Code(code));
            }),
            Part::Calibration => {
                decode(bytes).map_err(Refusal::of).and_then(|certificate| self.certify(certificate))
            }
        };
        if let Err(why) = done {
            self.outbox.log(format_args!("stored {part}: {}", why.sentence()));
        }
    }

    /// Logs why the stored settings were not used.
    pub fn forgot(&mut self, why: impl fmt::Display) {
        self.outbox.log(format_args!("stored settings: {why}; this is what ships"));
    }

    /// Sets a stored garment, with a scene that fits any garment; the stored scene follows.
    #[inline(never)]
    fn restore_garment(&mut self, bytes: &[u8]) -> Result<(), Refusal> {
        let mut garment = Garment::default();
        reading::garment(bytes, &mut garment)?;
        let reactions = core::mem::take(&mut self.setup.scene.react);
        let done = self.setup.change_garment(&self.info, &mut garment, TAXELS).map_err(Refusal::of);
        match done {
            Ok(()) => self.garment_changed(),
            Err(_) => self.setup.scene.react = reactions,
        }
        done
    }

    fn restore_scene(&mut self, bytes: &[u8]) -> Result<(), Refusal> {
        let done = self.take_scene(bytes, Micros(0));
        if done.is_err() {
            self.ship_scene();
        }
        done
    }

    /// Sets the shipped scene, if the garment leaves its pins free.
    #[inline(never)]
    fn ship_scene(&mut self) {
        let _ = self.setup.change_scene(&self.info, &mut Scene::shipped());
        self.scene_changed();
    }

    fn restore_numbers(&mut self, bytes: &[u8], set: fn(&mut Self, usize, u16)) -> Result<(), Refusal> {
        let (numbers, rest) = bytes.as_chunks();
        if numbers.len() != self.setup.layout.taxels() || !rest.is_empty() {
            return Err(Refusal::of("it is of another garment"));
        }
        for (taxel, number) in numbers.iter().enumerate() {
            set(self, taxel, u16::from_le_bytes(*number));
        }
        Ok(())
    }
}
