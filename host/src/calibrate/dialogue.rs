//! The weights, one after the other, on one plate after the other.

use super::plates::Plate;
use super::reading::{Reading, Rest};
use super::steady::{Steady, mean};
use crate::raw::RawBoard;
use anyhow::{Result, bail};
use serde_json::json;
use std::io::{IsTerminal, Write, stdout};

/// Frames of the garment at rest.
const REST_FRAMES: usize = 64;
/// Least step from nothing, counts.
const FAINT: f64 = 2.0;
/// Least step to the next weight by what the last ones lead to expect, part of it.
const STEP: f64 = 0.5;

/// Somebody before a board, who is asked for weights.
pub struct Dialogue<'a> {
    /// The board, which sends raw codes.
    pub board: &'a mut RawBoard,
    /// Pressure lowers the code.
    pub falling: bool,
    /// Seconds of the board to wait for a weight.
    pub wait: f64,
    /// One JSON object a line instead of sentences.
    pub json: bool,
}

impl Dialogue<'_> {
    /// Says that nothing is to be touched now.
    pub fn ask_for_rest(&self) {
        self.say("Hands off for a moment.", json!({ "type": "rest" }));
    }

    /// The garment at rest.
    pub fn rest(&mut self) -> Result<Rest> {
        let frames: Vec<Vec<u16>> =
            (0..REST_FRAMES).map(|_| Ok(self.board.frame()?.codes)).collect::<Result<_>>()?;
        Ok(Rest::of(&frames))
    }

    /// All weights (N, ascending) on each of the plates, and off again. A plate over one taxel that does not feel the first is
    /// passed over.
    pub fn readings(&mut self, plates: &[Plate], weights: &[f64], rest: &[f64]) -> Result<Vec<Reading>> {
        let mut readings = Vec::new();
        for (index, plate) in plates.iter().enumerate() {
            let coming = weights.iter().map(|weight| (*weight, false));
            let going = weights.iter().rev().skip(1).map(|weight| (*weight, true));
            // Weight and mean counts of what lies there.
            let mut last = (0.0, 0.0);
            let mut per_newton = 0.0;
            for (newtons, going) in coming.chain(going) {
                let least = (STEP * per_newton * (newtons - last.0).abs()).max(FAINT);
                let steady = Steady::away_from(last.1, least);
                let Some(reading) = self.weigh(index, plate, (newtons, going), steady, rest)? else {
                    if plate.taxels.len() == 1 && last.0 == 0.0 {
                        self.say("  nothing is felt here.", json!({ "type": "silent", "plate": index }));
                        break;
                    }
                    bail!("{}: no steady weight of {newtons} N came in {} s", plate.name, self.wait);
                };
                last = (newtons, mean(reading.counts.iter().copied()));
                per_newton = (last.1 / newtons).max(0.0);
                readings.push(reading);
            }
        }
        self.say("Take everything off.", json!({ "type": "end" }));
        Ok(readings)
    }

    /// One weight; none where it does not come in time.
    fn weigh(
        &mut self,
        index: usize,
        plate: &Plate,
        (newtons, going): (f64, bool),
        mut steady: Steady,
        rest: &[f64],
    ) -> Result<Option<Reading>> {
        let again = if going { "again only " } else { "" };
        let ask = json!({ "type": "ask", "plate": plate.name, "newtons": newtons, "going": going });
        self.say(&format!("{}: put {again}{newtons} N on the plate.", plate.name), ask);
        let (mut began, mut shown) = (None, 0.0);
        loop {
            let frame = self.board.frame()?;
            let now = frame.time_us as f64 / 1e6;
            let sign = if self.falling { -1.0 } else { 1.0 };
            let above = |taxel: &u16| {
                let taxel = usize::from(*taxel);
                sign * (frame.codes.get(taxel).map_or(0.0, |code| f64::from(*code)) - rest[taxel])
            };
            if let Some(held) = steady.take(plate.taxels.iter().map(above).collect()) {
                let (counts, noise) = (held.counts, held.noise);
                let reading = Reading { plate: index, newtons, going, counts, noise };
                self.tell(&reading);
                return Ok(Some(reading));
            }
            if now - *began.get_or_insert(now) > self.wait {
                return Ok(None);
            }
            if now - shown > 0.2 {
                shown = now;
                self.progress(steady.now());
            }
        }
    }

    fn tell(&self, reading: &Reading) {
        let (counts, noise) = (mean(reading.counts.iter().copied()), mean(reading.noise.iter().copied()));
        let line = json!({
            "type": "reading", "plate": reading.plate, "newtons": reading.newtons, "going": reading.going,
            "counts": counts, "noise": noise,
        });
        self.say(&format!("  {counts:.1} counts a taxel, noise {noise:.1}."), line);
    }

    fn say(&self, sentence: &str, line: serde_json::Value) {
        if self.json { println!("{line}") } else { println!("{sentence}") }
    }

    /// What the plate shows now, on a line that the next sentence overwrites.
    fn progress(&self, counts: f64) {
        if !self.json && stdout().is_terminal() {
            print!("  {counts:7.1}\r");
            let _ = stdout().flush();
        }
    }
}
