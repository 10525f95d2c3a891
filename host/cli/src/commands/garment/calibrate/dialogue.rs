//! Asks for the weights, one after the other, on one plate after the other.

use super::steady::Steady;
use crate::watch::raw::RawBoard;
use anyhow::{Result, bail};
use serde_json::json;
use std::io::{IsTerminal, Write, stdout};
use taxel::files::calibrate::{Plate, Reading, Rest, mean};

/// Frames for the codes at rest.
const REST_FRAMES: usize = 64;
/// Least step from no load: counts, and multiple of the plate's noise at rest in one frame.
const FAINT: (f64, f64) = (2.0, 3.0);
/// Least step to the next weight, as a share of the expected one.
const STEP: f64 = 0.5;

/// Share of a plate's usual signal under its first weight from which a load counts as the first weight.
const FIRST: f64 = 0.25;
/// Share of the signal under the first weight below which the plate counts as unloaded.
const OFF: f64 = 0.4;

/// Least time between two evaluated frames, s: the frames of a small garment are so fast that a weight being
/// put on seems to be steady.
const APART: f64 = 0.004;

/// A dialogue with a user who puts weights on a board's garment.
pub struct Dialogue<'a> {
    /// The board, which sends raw codes.
    pub board: &'a mut RawBoard,
    /// Pressure lowers the code.
    pub falling: bool,
    /// Longest wait of the board for a weight, s.
    pub wait: f64,
    /// Print JSON, one object per line.
    pub json: bool,
    /// Time of the last evaluated frame, s.
    seen: f64,
}

impl<'a> Dialogue<'a> {
    /// A dialogue about a board whose codes fall or rise under pressure, with `wait` seconds for each weight.
    pub fn new(board: &'a mut RawBoard, falling: bool, wait: f64, json: bool) -> Dialogue<'a> {
        Dialogue { board, falling, wait, json, seen: f64::NEG_INFINITY }
    }

    /// Asks the user not to touch the garment.
    pub fn ask_for_rest(&self) {
        self.say("Hands off for a moment.", json!({ "type": "rest" }));
    }

    /// Reads the garment at rest.
    pub fn rest(&mut self) -> Result<Rest> {
        let frames: Vec<Vec<u16>> =
            (0..REST_FRAMES).map(|_| Ok(self.board.frame()?.codes)).collect::<Result<_>>()?;
        Ok(Rest::of(&frames))
    }

    /// Readings of all weights (N, ascending) on each plate, loading and unloading. A single taxel that does
    /// not respond to the first weight is skipped.
    pub fn readings(&mut self, plates: &[Plate], weights: &[f64], rest: &Rest) -> Result<Vec<Reading>> {
        let mut readings: Vec<Reading> = Vec::new();
        // Counts per newton on a taxel.
        let mut usual = 0.0;
        for (index, plate) in plates.iter().enumerate() {
            let coming = weights.iter().map(|weight| (*weight, false));
            let going = weights.iter().rev().skip(1).map(|weight| (*weight, true));
            // Last weight and its mean counts.
            let mut last = (0.0, 0.0);
            let mut per_newton = 0.0;
            let first = FIRST * usual * weights.first().copied().unwrap_or(0.0) / plate.taxels.len() as f64;
            let faint = FAINT.0.max(FAINT.1 * rest.noise / (plate.taxels.len() as f64).sqrt());
            for (newtons, going) in coming.chain(going) {
                let least = (STEP * per_newton * (newtons - last.0).abs()).max(faint);
                let least = if last.0 == 0.0 { least.max(first) } else { least };
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
            let lightest = readings.iter().find(|reading| reading.plate == index);
            if let (Some(lightest), true) = (lightest, index + 1 < plates.len()) {
                let shown = mean(lightest.counts.iter().copied());
                usual = shown / lightest.each();
                self.take_off(plate, OFF * shown, rest)?;
            }
        }
        self.say("Take everything off.", json!({ "type": "end" }));
        Ok(readings)
    }

    /// Reads one weight; none if it is not put on in time.
    fn weigh(
        &mut self,
        index: usize,
        plate: &Plate,
        (newtons, going): (f64, bool),
        mut steady: Steady,
        rest: &Rest,
    ) -> Result<Option<Reading>> {
        let again = if going { "only " } else { "" };
        let ask = json!({ "type": "ask", "plate": plate.name, "newtons": newtons, "going": going });
        self.say(&format!("{}: put {again}{newtons} N on the plate.", plate.name), ask);
        let (mut began, mut shown) = (None, 0.0);
        loop {
            let (now, counts) = self.counts(plate, rest)?;
            if let Some(held) = steady.take(counts) {
                let (counts, noise) = (held.counts, held.noise);
                let reading = Reading { plate: index, newtons, going, counts, noise };
                self.show(&reading);
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

    /// Waits until a plate shows fewer counts than `below`: it would press on its neighbours, too.
    fn take_off(&mut self, plate: &Plate, below: f64, rest: &Rest) -> Result<()> {
        self.say("  Take it off.", json!({ "type": "off" }));
        let mut began = None;
        loop {
            let (now, counts) = self.counts(plate, rest)?;
            if mean(counts.into_iter()) < below {
                return Ok(());
            }
            if now - *began.get_or_insert(now) > self.wait {
                bail!("{}: the weight was not taken off in {} s", plate.name, self.wait);
            }
        }
    }

    /// Reads a frame some time after the last: its time, s, and counts above rest of the plate's taxels.
    fn counts(&mut self, plate: &Plate, rest: &Rest) -> Result<(f64, Vec<f64>)> {
        let mut frame = self.board.frame()?;
        while (0.0..APART).contains(&(frame.time_us as f64 / 1e6 - self.seen)) {
            frame = self.board.frame()?;
        }
        self.seen = frame.time_us as f64 / 1e6;
        let sign = if self.falling { -1.0 } else { 1.0 };
        let above = |taxel: &u16| {
            let taxel = usize::from(*taxel);
            sign * (frame.codes.get(taxel).map_or(0.0, |code| f64::from(*code)) - rest.codes[taxel])
        };
        Ok((self.seen, plate.taxels.iter().map(above).collect()))
    }

    fn show(&self, reading: &Reading) {
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

    /// Shows the plate's present counts on a line that the next sentence overwrites.
    fn progress(&self, counts: f64) {
        if !self.json && stdout().is_terminal() {
            print!("  {counts:7.1}\r");
            let _ = stdout().flush();
        }
    }
}
